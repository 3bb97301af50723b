//! Joints must make a tree: one root, every other link moved by one joint, no loops.

use super::report::Sink;
use super::robot::{Joint, Kind, Robot};

/// The tree of the links.
#[derive(Debug)]
pub struct Tree {
    /// The link that nothing moves.
    pub root: usize,
    /// All joints, those nearer to the root first, branch by branch.
    pub order: Vec<usize>,
}

/// Builds the tree of links. An error says why the links do not form one.
pub fn tree(robot: &Robot, sink: &mut Sink) -> Option<Tree> {
    let before = sink.problems.len();
    let name = |link: usize| &robot.links[link].name;
    let mut above: Vec<Option<usize>> = vec![None; robot.links.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        match above[joint.child] {
            Some(first) => {
                let (first, child) = (&robot.joints[first].name, name(joint.child));
                let text = format!(
                    "the link `{child}` is moved by the joint `{first}` already; a link has one joint above it. Write a \
                     closed loop as a tree, and close it with a #[holonomic] function in the description"
                );
                sink.problem(&joint.mark, text);
            }
            None => above[joint.child] = Some(index),
        }
    }
    let roots: Vec<usize> = (0..robot.links.len()).filter(|&link| above[link].is_none()).collect();
    for &other in roots.iter().skip(1) {
        let text = format!(
            "nothing moves this link, nor `{}`: the robot would have two roots; connect it by a joint, \
             <joint type=\"fixed\"> if it stands still, or remove it",
            name(roots[0])
        );
        sink.problem(&robot.links[other].mark, text);
    }
    let mut order = Vec::new();
    let mut reached: Vec<bool> = (0..robot.links.len()).map(|link| roots.contains(&link)).collect();
    let mut open: Vec<usize> = roots.iter().rev().copied().collect();
    while let Some(link) = open.pop() {
        if let Some(joint) = above[link] {
            order.push(joint);
        }
        for joint in robot.joints.iter().rev().filter(|joint| joint.parent == link && !reached[joint.child]) {
            open.push(joint.child);
        }
        reached[link] = true;
    }
    if let Some(joint) = robot.joints.iter().find(|joint| !reached[joint.child]) {
        let mut loop_of = vec![joint];
        while let Some(next) = above[loop_of[loop_of.len() - 1].parent].map(|joint| &robot.joints[joint]) {
            if loop_of.iter().any(|joint| std::ptr::eq(*joint, next)) {
                break;
            }
            loop_of.push(next);
        }
        let names: Vec<String> = loop_of.iter().rev().map(|joint| format!("`{}`", joint.name)).collect();
        let text = format!(
            "the joints {} close a loop, which hangs on nothing; let the first of them hang on a link of the tree",
            names.join(", ")
        );
        sink.problem(&joint.mark, text);
    }
    match roots.first() {
        Some(&root) if sink.problems.len() == before => Some(Tree { root, order }),
        _ => None,
    }
}

/// A joint that lets the root move freely.
pub fn add_floating_base(robot: &mut Robot, tree: &Tree) {
    use super::geometry::Pose;
    use super::robot::{Action, Link};
    let mark = robot.links[tree.root].mark.clone();
    robot.links.push(Link {
        name: "world".to_owned(),
        mark: mark.clone(),
        inertials: Vec::new(),
        doubtful: None,
    });
    let joint = Joint {
        name: String::new(),
        mark,
        parent: robot.links.len() - 1,
        child: tree.root,
        pose: Pose::IDENTITY,
        back: [0.0; 3],
        kind: Kind::Free,
        action: Action::default(),
        mimics: Vec::new(),
        drives: Vec::new(),
    };
    robot.joints.insert(0, joint);
    for mimic in robot.joints.iter_mut().flat_map(|joint| &mut joint.mimics) {
        mimic.of = mimic.of.map(|of| of + 1);
    }
}
