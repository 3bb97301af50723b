//! Robot → [`Plan`]: coordinates, inputs, frames and bodies with their Rust names, fixed parts lumped.

use std::collections::BTreeMap;

use super::geometry::Pose;
use super::inertia::{Flaw, Inertial};
use super::motions::{self, Coordinate, Motion, Shape};
use super::names::{Names, alone, camel, snake};
use super::report::Sink;
use super::robot::{Action, Doubtful, Drive, Joint, Kind, Robot};
use super::ties;
use super::tree::{Tree, add_floating_base, tree};
use super::weight::does_work;
use super::{Following, Inputs, Options};

/// All that a description says.
#[derive(Debug)]
pub struct Plan {
    /// The name of the struct.
    pub name: String,
    /// The name of the robot, for humans.
    pub title: String,
    /// The robot.
    pub robot: Robot,
    /// The tree of the links.
    pub tree: Tree,
    /// Declared coordinates in order.
    pub coordinates: Vec<Coordinate>,
    /// The motion of each joint.
    pub motions: Vec<Motion>,
    /// Inputs in order: name, joint, gear.
    pub inputs: Vec<(String, usize, f64)>,
    /// The name of each link, and the link that carries it.
    pub frames: Vec<Frame>,
    /// Moving masses.
    pub bodies: Vec<Body>,
    /// Whether gravity does work.
    pub is_heavy: bool,
    /// The elements that the description leaves out.
    pub left_out: Vec<String>,
}

/// The frame of a link.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The name of the link as an identifier.
    pub name: String,
    /// The link that it is lumped with, and its pose there.
    pub carrier: (usize, Pose),
    /// Whether it moves.
    pub moves: bool,
    /// Whether it is the world's.
    pub is_world: bool,
}

/// A moving mass.
#[derive(Clone, Debug)]
pub struct Body {
    /// The link.
    pub link: usize,
    /// All that is fixed to it.
    pub fixed: Vec<usize>,
    /// Mass and inertia in the frame of the link.
    pub inertial: Inertial,
}

/// Plans a description; what is wrong goes to the sink.
pub fn plan(mut robot: Robot, options: &Options, file: &str, sink: &mut Sink) -> Option<Plan> {
    let mut found = tree(&robot, sink)?;
    ties::settle(&mut robot, options, sink)?;
    if options.floating {
        add_floating_base(&mut robot, &found);
        found = tree(&robot, sink)?;
    }
    let title = robot.name.clone().unwrap_or_else(|| stem(file).to_owned());
    let name = options.name.clone().unwrap_or_else(|| camel(&title));
    let mut names = Names::default();
    let (coordinates, motions) = motions::motions(&robot, &found, options, &mut names, sink);
    let mut plan = Plan {
        name,
        title,
        inputs: inputs(&robot, &found, &motions, options, &mut names, sink),
        frames: frames(&robot, &found, &motions, sink),
        robot,
        tree: found,
        coordinates,
        motions,
        bodies: Vec::new(),
        is_heavy: false,
        left_out: Vec::new(),
    };
    if plan.coordinates.is_empty() {
        let mark = plan.robot.links[plan.tree.root].mark.clone();
        sink.problem(
            &mark,
            "no joint moves; add a joint that is not fixed, or let the robot move freely: a URDF with \
             --floating, a body of MJCF by <freejoint/>",
        );
        return None;
    }
    plan.bodies = bodies(&plan);
    plan.check_inertias(options, file, sink);
    plan.is_heavy = does_work(&plan);
    if !plan.is_heavy {
        sink.note("gravity does no work: the description has no weight");
    }
    plan.say(options, sink);
    Some(plan)
}

/// The name of a file without folders and endings.
fn stem(file: &str) -> &str {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    name.split('.').next().unwrap_or(name)
}

fn inputs(
    robot: &Robot,
    tree: &Tree,
    motions: &[Motion],
    options: &Options,
    names: &mut Names,
    sink: &mut Sink,
) -> Vec<(String, usize, f64)> {
    let mut drives = Vec::new();
    for &index in tree.order.iter().filter(|_| options.inputs != Inputs::None) {
        let joint = &robot.joints[index];
        let follows = matches!(motions[index], Motion::Follows { .. });
        if joint.kind.freedom() == 1 && !(follows && joint.drives.iter().all(|drive| drive.name.is_none())) {
            drives.extend(joint.drives.iter().map(|drive| (index, drive)));
        }
    }
    // Actuators come in the order of the file, other drives in that of the joints.
    drives.sort_by_key(|(_, drive)| drive.order);
    let name = |(index, drive): (usize, &Drive)| {
        let joint = &robot.joints[index];
        let unit = if matches!(joint.kind, Kind::Slides(_)) { "force" } else { "torque" };
        let of_joint = || format!("{}_{unit}", snake(&joint.name));
        // Motors are often named like the joints that they drive.
        let named = drive.name.as_deref().map(snake).map(alone).filter(|name| !names.has(name));
        let wanted = named.unwrap_or_else(of_joint);
        let written = drive.name.as_deref().unwrap_or(&joint.name);
        (names.take(written, &wanted, sink), index, drive.gear)
    };
    drives.into_iter().map(name).collect()
}

fn frames(robot: &Robot, tree: &Tree, motions: &[Motion], sink: &mut Sink) -> Vec<Frame> {
    let mut names = Names::default();
    let root =
        Frame { name: String::new(), carrier: (tree.root, Pose::IDENTITY), moves: false, is_world: true };
    let mut frames = vec![root; robot.links.len()];
    frames[tree.root].name =
        names.take(&robot.links[tree.root].name, &snake(&robot.links[tree.root].name), sink);
    for &index in &tree.order {
        let joint = &robot.joints[index];
        let link = &robot.links[joint.child].name;
        let parent = frames[joint.parent].clone();
        let still = joint.kind == Kind::Fixed && motions[index] == Motion::Own(Vec::new());
        let carrier = match still {
            true => (parent.carrier.0, parent.carrier.1.compose(&joint.pose)),
            false => (joint.child, Pose::IDENTITY),
        };
        frames[joint.child] = Frame {
            name: names.take(link, &snake(link), sink),
            carrier,
            moves: parent.moves || !still,
            is_world: parent.is_world && still && joint.pose.is_identity(),
        };
    }
    frames
}

fn bodies(plan: &Plan) -> Vec<Body> {
    let mut parts: BTreeMap<usize, (Vec<usize>, Vec<Inertial>)> = BTreeMap::new();
    let links = std::iter::once(plan.tree.root)
        .chain(plan.tree.order.iter().map(|&joint| plan.robot.joints[joint].child));
    let mut order = Vec::new();
    for link in links.filter(|&link| plan.frames[link].moves) {
        let (carrier, pose) = &plan.frames[link].carrier;
        let (fixed, inertials) = parts.entry(*carrier).or_default();
        if *carrier == link {
            order.push(link);
        }
        let own = plan.robot.links[link].inertials.iter().filter(|inertial| !inertial.is_nothing());
        let before = inertials.len();
        inertials.extend(own.map(|inertial| match *carrier == link {
            true => *inertial,
            false => inertial.seen_from(pose),
        }));
        if *carrier != link && inertials.len() > before {
            fixed.push(link);
        }
    }
    let body = |link: usize| {
        let (fixed, inertials) = &parts[&link];
        Inertial::together(inertials).map(|inertial| Body { link, fixed: fixed.clone(), inertial })
    };
    order.into_iter().filter_map(body).collect()
}

impl Plan {
    /// The joints whose actions matter, with their actions.
    pub fn actions(&self) -> impl Iterator<Item = (usize, &Joint, &Action)> {
        let joints = self.tree.order.iter().map(|&index| (index, &self.robot.joints[index]));
        joints
            .filter(|(_, joint)| joint.kind.freedom() == 1)
            .map(|(index, joint)| (index, joint, &joint.action))
    }

    /// The orientation or pose that is the coordinate of a joint.
    pub fn oriented(&self, joint: usize) -> Option<&Coordinate> {
        match &self.motions[joint] {
            Motion::Own(own) => own.first().map(|&own| &self.coordinates[own]),
            Motion::Follows { .. } => None,
        }
        .filter(|coordinate| coordinate.shape != Shape::Number)
    }

    /// Whether a coordinate is an orientation or a pose.
    pub fn has_orientations(&self) -> bool {
        self.coordinates.iter().any(|coordinate| coordinate.shape != Shape::Number)
    }

    /// Whether a joint follows another one.
    pub fn follows(&self, joint: usize) -> bool {
        matches!(self.motions[joint], Motion::Follows { .. })
    }

    /// Reports inertias that are not physical, if the lumped body that they are part of is not physical
    /// either.
    fn check_inertias(&self, options: &Options, file: &str, sink: &mut Sink) {
        for (link, frame) in self.robot.links.iter().zip(&self.frames).filter(|(_, frame)| frame.moves) {
            let Some(Doubtful { mark, moment }) = &link.doubtful else { continue };
            let mut text = format!(
                "the inertia is not positive definite, a principal moment is {moment:.3e}, which no body's is; write \
                 moments about the centre of mass, and products of inertia with their signs"
            );
            let body = self.bodies.iter().find(|body| body.link == frame.carrier.0);
            let is_bad = body.is_some_and(|body| matches!(body.inertial.flaw(), Some(Flaw::Negative(_))));
            match (is_bad, options.unphysical) {
                (true, false) => sink.problem(mark, text + ", or take it as it is with --unphysical"),
                (true, true) => sink.warning(file, mark, text),
                (false, _) => {
                    text.push_str("; that of all that is fixed to each other is");
                    sink.warning(file, mark, text);
                }
            }
        }
    }

    /// Tells what was decided.
    fn say(&mut self, options: &Options, sink: &mut Sink) {
        let list = |names: Vec<&str>| match names.len() {
            0..=6 => names.join(", "),
            count => format!("{}, … ({count} of them)", names[..4].join(", ")),
        };
        let mut left_out = Vec::new();
        let of = |filter: &dyn Fn(&Action) -> bool| -> Vec<&str> {
            self.actions().filter(|(.., action)| filter(action)).map(|(_, joint, _)| &*joint.name).collect()
        };
        let limited = of(&|action| action.limits.is_some());
        if !options.limits && !limited.is_empty() {
            left_out.push(format!("stops of {} (--limits)", list(limited)));
        }
        let rough = of(&|action| action.friction != 0.0);
        if !options.friction && !rough.is_empty() {
            left_out.push(format!("dry friction in {} (--friction)", list(rough)));
        }
        if options.mimic == Following::Ignore
            && self.robot.joints.iter().any(|joint| !joint.mimics.is_empty())
        {
            left_out
                .push("<mimic>: joints that follow others move by themselves (--mimic eliminate)".to_owned());
        }
        let idle: Vec<&str> = self
            .actions()
            .filter(|(index, joint, _)| joint.drives.is_empty() && !self.follows(*index))
            .map(|(_, joint, _)| &*joint.name)
            .collect();
        if options.inputs == Inputs::Actuated && !idle.is_empty() {
            sink.note(format!(
                "no transmission or actuator drives {}: no inputs for them (--inputs all)",
                list(idle)
            ));
        }
        let massless: Vec<&str> = self
            .tree
            .order
            .iter()
            .map(|&joint| &self.robot.joints[joint])
            .filter(|joint| {
                joint.kind.freedom() > 0
                    && !self.robot.joints.iter().any(|other| other.parent == joint.child)
                    && !self.bodies.iter().any(|body| body.link == joint.child)
            })
            .map(|joint| &*joint.name)
            .collect();
        if !massless.is_empty() {
            sink.caution(format!(
                "nothing with a mass hangs on {}: the mass matrix is singular",
                list(massless)
            ));
        }
        for joint in self.robot.joints.iter().filter(|_| options.euler) {
            if !matches!(joint.kind, Kind::Free | Kind::Ball) {
                continue;
            }
            let is_base = joint.name.is_empty();
            let name = if is_base { "the floating base".to_owned() } else { format!("`{}`", joint.name) };
            sink.note(format!(
                "{name} has the angles roll, pitch and yaw about fixed axes: the equations are singular at a pitch of ±90°"
            ));
            if joint.action.damping != 0.0 || joint.action.armature != 0.0 {
                left_out.push(format!("damping and armature of {name} (they are there without --euler)"));
            }
        }
        for text in &left_out {
            sink.note(format!("left out: {text}"));
        }
        self.left_out = left_out;
    }
}
