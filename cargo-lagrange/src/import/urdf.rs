//! URDF → [`Robot`].

use std::collections::BTreeMap;

use roxmltree::Node;

use super::geometry::{Pose, Rotation, Vector, direction};
use super::inertia::Inertial;
use super::links;
use super::report::Mark;
use super::robot::{Action, Doubtful, Drive, Joint, Kind, Link, Mimic, Robot};
use super::xml::{Reader, child, children};
use super::{Inputs, Options};

/// The acceleration of free fall at rest [m/s²], which URDF does not give.
const GRAVITY: Vector = [0.0, 0.0, -9.81];

/// Reads a `<robot>`; problems are in the reader.
pub fn read(reader: &mut Reader<'_>, root: Node<'_, '_>, options: &Options) -> Robot {
    let mut urdf = Urdf { reader, options, names: BTreeMap::new() };
    let links = urdf.links(root);
    let joints = urdf.joints(root, &links);
    urdf.ignored(root);
    let name = root.attribute("name").map(str::to_owned);
    Robot { name, links, joints, gravity: GRAVITY }
}

struct Urdf<'r, 'a> {
    reader: &'r mut Reader<'a>,
    options: &'r Options,
    /// Links by name.
    names: BTreeMap<String, usize>,
}

impl Urdf<'_, '_> {
    fn links(&mut self, root: Node<'_, '_>) -> Vec<Link> {
        let mut links = Vec::new();
        for node in children(root, "link") {
            let Some(name) = self.reader.text(node, "name", "base_link") else { continue };
            let mark = self.reader.mark(node);
            if self.names.insert(name.to_owned(), links.len()).is_some() {
                self.reader
                    .problem(node, "another link has this name; rename one, and the joints that mean it");
            }
            let inertial = child(node, "inertial").and_then(|inertial| self.inertial(inertial));
            let doubtful = inertial.as_ref().and_then(|(_, doubtful)| doubtful.clone());
            let inertials = inertial.into_iter().map(|(inertial, _)| inertial).collect();
            links.push(Link { name: name.to_owned(), mark, inertials, doubtful });
        }
        if links.is_empty() {
            self.reader.problem(root, "the robot has no links; write a <link name=\"base_link\"/> at least");
        }
        links
    }

    fn inertial(&mut self, node: Node<'_, '_>) -> Option<(Inertial, Option<Doubtful>)> {
        let frame = self.origin(node);
        let reader = &mut *self.reader;
        let mass = reader.child(node, "mass", "<mass value=\"1.0\"/>")?;
        let value = reader.required(mass, "value")?;
        let inertia = reader.child(
            node,
            "inertia",
            "<inertia ixx=\"…\" ixy=\"0\" ixz=\"0\" iyy=\"…\" iyz=\"0\" izz=\"…\"/>",
        )?;
        let [xx, yy, zz] = ["ixx", "iyy", "izz"].map(|name| reader.required(inertia, name));
        let [xy, xz, yz] = ["ixy", "ixz", "iyz"].map(|name| reader.number(inertia, name).unwrap_or(0.0));
        let (xx, yy, zz) = (xx?, yy?, zz?);
        let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let inertial = Inertial::in_frame(&frame, value, &tensor);
        let doubtful = links::check_inertia(reader, (mass, "value"), inertia, &inertial);
        Some((inertial, doubtful))
    }

    fn origin(&mut self, node: Node<'_, '_>) -> Pose {
        let Some(origin) = child(node, "origin") else { return Pose::IDENTITY };
        let shift = self.reader.vector(origin, "xyz").unwrap_or([0.0; 3]);
        let angles = self.reader.vector(origin, "rpy").unwrap_or([0.0; 3]);
        let angles = links::angles(self.reader, origin, angles, self.options);
        Pose { shift, turn: Rotation::of_angles(angles) }
    }

    fn joints(&mut self, root: Node<'_, '_>, links: &[Link]) -> Vec<Joint> {
        let mut joints: Vec<Joint> = Vec::new();
        let mut names: BTreeMap<String, usize> = BTreeMap::new();
        let mut mimics = Vec::new();
        for node in children(root, "joint") {
            let Some(name) = self.reader.text(node, "name", "shoulder") else { continue };
            let parent = self.end(node, "parent");
            let children = self.end(node, "child");
            let kind = self.kind(node);
            let pose = self.origin(node);
            let action = self.action(node, kind);
            if names.insert(name.to_owned(), joints.len()).is_some() {
                self.reader.problem(node, "another joint has this name; rename one of them");
            }
            // A fixed joint follows nothing.
            match child(node, "mimic").filter(|_| kind != Some(Kind::Fixed)) {
                Some(mimic) if kind.is_some_and(|kind| kind.freedom() != 1) => {
                    self.reader
                        .problem(mimic, "only joints that turn or slide can follow another one; remove it");
                }
                mimic => mimics.extend(mimic.map(|mimic| (joints.len(), mimic))),
            }
            let mark = self.reader.mark(node);
            // A link that is not there has been reported; the indices are never used.
            let (parent, child) = (parent.unwrap_or(links.len()), children.unwrap_or(links.len()));
            let (back, drives) = ([0.0; 3], vec![Drive { name: None, gear: 1.0, order: 0 }]);
            joints.push(Joint {
                name: name.to_owned(),
                mark,
                parent,
                child,
                pose,
                back,
                kind: kind.unwrap_or(Kind::Fixed),
                action,
                mimics: Vec::new(),
                drives,
            });
        }
        for (joint, node) in mimics {
            let mark = joints[joint].mark.clone();
            joints[joint].mimics = self.mimic(node, mark, &names, &joints).into_iter().collect();
        }
        self.transmissions(root, &names, &mut joints);
        joints
    }

    /// The link at an end of a joint.
    fn end(&mut self, joint: Node<'_, '_>, end: &str) -> Option<usize> {
        let node = self.reader.child(joint, end, &format!("<{end} link=\"…\"/>"))?;
        let name = self.reader.text(node, "link", "base_link")?;
        let found = self.names.get(name).copied();
        if found.is_none() {
            let near = links::near(name, self.names.keys().map(String::as_str));
            let text =
                format!("the {end} `{name}` is no link of the file; write <link name=\"{name}\"/>{near}");
            self.reader.problem_of(node, "link", text);
        }
        found
    }

    fn kind(&mut self, node: Node<'_, '_>) -> Option<Kind> {
        const KINDS: &str = "revolute, continuous, prismatic, planar, floating, fixed";
        let kind = self.reader.text(node, "type", "revolute")?;
        let axis = |urdf: &mut Self| {
            let axis = child(node, "axis");
            let written = match axis {
                Some(axis) => {
                    urdf.reader.text(axis, "xyz", "0 0 1")?;
                    urdf.reader.vector(axis, "xyz")?
                }
                // The default of the format.
                None => [1.0, 0.0, 0.0],
            };
            let unit = direction(written, urdf.options.tolerance);
            if unit.is_none() {
                let text = "the axis is zero; write a direction such as xyz=\"0 0 1\"";
                urdf.reader.problem_of(axis.unwrap_or(node), "xyz", text);
            }
            unit
        };
        match kind {
            "fixed" => Some(Kind::Fixed),
            "revolute" | "continuous" => axis(self).map(Kind::Turns),
            "prismatic" => axis(self).map(Kind::Slides),
            "planar" => axis(self).map(Kind::Planar),
            "floating" => Some(Kind::Free),
            _ => {
                let near = links::near(kind, KINDS.split(", "));
                self.reader.problem_of(
                    node,
                    "type",
                    format!("`{kind}` is no type of joint{near}; there are {KINDS}"),
                );
                None
            }
        }
    }

    fn action(&mut self, node: Node<'_, '_>, kind: Option<Kind>) -> Action {
        let mut action = Action::default();
        if let Some(dynamics) = child(node, "dynamics") {
            action.damping = self.reader.size(dynamics, "damping");
            action.friction = self.reader.size(dynamics, "friction");
            if kind.is_some_and(|kind| kind.freedom() > 1) && action != Action::default() {
                let name = node.attribute("name").unwrap_or_default();
                let text =
                    format!("left out: <dynamics> of `{name}`, which URDF gives for one coordinate only");
                self.reader.sink.note(text);
                action = Action::default();
            }
            // Programs that write URDF give all joints the same elements; a joint that stands still has no
            // forces.
            if kind == Some(Kind::Fixed) {
                action = Action::default();
            }
        }
        let bounded = matches!(node.attribute("type"), Some("revolute" | "prismatic")) && kind.is_some();
        let Some(limit) = child(node, "limit") else {
            if self.options.limits && bounded {
                let text = "no stops: the format asks for <limit lower=\"…\" upper=\"…\"/> here; write one, or \
                            another type, such as continuous";
                self.reader.warning(node, text);
            }
            return action;
        };
        let [lower, upper] = ["lower", "upper"].map(|side| self.reader.number(limit, side).unwrap_or(0.0));
        if bounded && lower > upper {
            let text = format!("{lower} is above upper=\"{upper}\"; exchange the two");
            self.reader.problem_of(limit, "lower", text);
        }
        // Files that mean no limits leave both limits at their default.
        action.limits = (bounded && lower < upper).then_some([lower, upper]);
        let is_given = bounded || limit.has_attribute("lower") || limit.has_attribute("upper");
        if self.options.limits && is_given && action.limits.is_none() {
            let why = if bounded { "both are the same" } else { "this type of joint has none" };
            self.reader.warning(limit, format!("left out as stops: {why}"));
        }
        action
    }

    fn mimic(
        &mut self,
        node: Node<'_, '_>,
        mark: Mark,
        names: &BTreeMap<String, usize>,
        joints: &[Joint],
    ) -> Option<Mimic> {
        let name = self.reader.text(node, "joint", "finger_left")?;
        let multiplier = self.reader.number(node, "multiplier").unwrap_or(1.0);
        let offset = self.reader.number(node, "offset").unwrap_or(0.0);
        let Some(&of) = names.get(name) else {
            let near = links::near(name, names.keys().map(String::as_str));
            self.reader.problem_of(node, "joint", format!("`{name}` is no joint of the file{near}"));
            return None;
        };
        if joints[of].kind.freedom() != 1 {
            let text =
                format!("`{name}` has no single coordinate to follow; name a joint that turns or slides");
            self.reader.problem_of(node, "joint", text);
            return None;
        }
        Some(Mimic::new(mark, Some(of), multiplier, offset))
    }

    /// Where a file has transmissions, other joints are passive.
    fn transmissions(&mut self, root: Node<'_, '_>, names: &BTreeMap<String, usize>, joints: &mut [Joint]) {
        let mut driven = vec![false; joints.len()];
        for node in children(root, "transmission").flat_map(|node| node.descendants()) {
            let reduction = node.text().filter(|_| node.has_tag_name("mechanicalReduction")).map(str::trim);
            if reduction.is_some_and(|text| text.parse() != Ok(1.0)) {
                let text = "the reduction is left out: inputs are torques and forces at the joints";
                self.reader.warning(node, text);
            }
        }
        for node in children(root, "transmission").flat_map(|node| node.children()) {
            if !node.has_tag_name("joint") && !node.has_tag_name("actuatedJoint") {
                continue;
            }
            let Some(name) = self.reader.text(node, "name", "shoulder") else { continue };
            match names.get(name) {
                Some(&joint) => driven[joint] = true,
                None => {
                    let near = links::near(name, names.keys().map(String::as_str));
                    self.reader
                        .warning(node, format!("`{name}` is no joint of the file{near}; it is left out"));
                }
            }
        }
        if self.options.inputs == Inputs::Actuated && driven.contains(&true) {
            for (joint, _) in joints.iter_mut().zip(driven).filter(|(_, driven)| !driven) {
                joint.drives.clear();
            }
        }
    }

    /// Says what the description leaves out.
    fn ignored(&mut self, root: Node<'_, '_>) {
        let count = |name: &str| root.descendants().filter(|node| node.has_tag_name(name)).count();
        let kinds = ["visual", "collision", "mesh", "sensor", "gazebo", "safety_controller", "calibration"];
        let found: Vec<String> = kinds
            .into_iter()
            .map(|kind| (kind, count(kind)))
            .filter(|(_, count)| *count > 0)
            .map(|(kind, count)| format!("{count} <{kind}>"))
            .collect();
        if !found.is_empty() {
            self.reader.sink.note(format!(
                "shapes and tools have no place in the equations: {} ignored",
                found.join(", ")
            ));
        }
    }
}
