//! MJCF → [`Robot`]: bodies, their joints and inertias, actuators, joints tied to each other.

mod attributes;
mod bodies;
mod flags;
mod geom;

use roxmltree::Node;

use super::Options;
use super::links;
use super::robot::{Drive, Kind, Mimic, Robot};
use super::xml::{Reader, children};
use attributes::{Attributes, Element};
use flags::Off;

/// Reads a `<mujoco>`; problems are in the reader.
pub fn read<'a>(reader: &mut Reader<'a>, root: Node<'a, 'a>, options: &Options) -> Robot {
    let attributes = Attributes::read(reader, root);
    refused(reader, root);
    let mut gravity = [0.0, 0.0, -9.81];
    for option in children(root, "option") {
        gravity = reader.vector(option, "gravity").unwrap_or(gravity);
        if option.attribute("actuatorgroupdisable").is_some_and(|groups| !groups.trim().is_empty()) {
            let text = "`actuatorgroupdisable` is left out: give the inputs of these groups zeros";
            reader.warning(option, text);
        }
        for medium in ["wind", "density", "viscosity"] {
            if reader
                .numbers(option, medium)
                .is_some_and(|numbers| numbers.iter().any(|number| *number != 0.0))
            {
                reader.warning(option, format!("`{medium}` is left out: nothing resists in the description"));
            }
        }
    }
    let off = Off::read(reader, root);
    if off.gravity {
        gravity = [0.0; 3];
    }
    let mut robot = Robot {
        name: root.attribute("model").map(str::to_owned),
        links: Vec::new(),
        joints: Vec::new(),
        gravity,
    };
    let mut bodies = bodies::Bodies::new(reader, &attributes, options, &mut robot);
    bodies.world(root);
    off.apply(&mut robot);
    total_mass(reader, root, &mut robot);
    let mut mjcf = Mjcf { reader, attributes: &attributes, robot: &mut robot };
    mjcf.actuators(root, options);
    if !off.equality {
        mjcf.equalities(root);
    }
    ignored(reader, root);
    robot
}

struct Mjcf<'r, 'a> {
    reader: &'r mut Reader<'a>,
    attributes: &'r Attributes<'a>,
    robot: &'r mut Robot,
}

impl<'a> Mjcf<'_, 'a> {
    fn actuators(&mut self, root: Element<'a>, options: &Options) {
        let mut count = 0;
        for node in children(root, "actuator").flat_map(|list| list.children().filter(Node::is_element)) {
            count += 1;
            let kind = node.tag_name().name();
            let Some(name) = self.attributes.text(self.reader, node, "joint") else {
                self.reader.warning(node, "an actuator without a `joint` is left out");
                continue;
            };
            let Some(joint) = self.joint(node, "joint", name) else { continue };
            let gear =
                self.attributes.numbers(self.reader, node, "gear").and_then(|gear| gear.first().copied());
            if kind != "motor" {
                let text =
                    format!("<{kind}> is taken as a motor: its input is a force, and its gains are left out");
                self.reader.warning(node, text);
            }
            for attribute in ["damping", "armature"] {
                let given = self.attributes.numbers(self.reader, node, attribute).unwrap_or_default();
                if given.iter().any(|number| *number != 0.0) {
                    let text = format!("`{attribute}` of an actuator is left out; give it to the joint");
                    self.reader.warning(node, text);
                }
            }
            for attribute in ["delay", "nsample"] {
                let given = self.attributes.number(self.reader, node, attribute);
                if given.is_some_and(|number| number != 0.0) {
                    let text = format!("`{attribute}` is left out: an input acts at once");
                    self.reader.warning(node, text);
                }
            }
            let gear = gear.unwrap_or(1.0);
            if gear == 0.0 {
                self.reader.warning(node, "its `gear` is zero: it drives nothing, and is left out");
                continue;
            }
            let drive = Drive { name: node.attribute("name").map(str::to_owned), gear, order: count };
            self.robot.joints[joint].drives.push(drive);
        }
        let is_all = options.inputs == super::Inputs::All || count == 0;
        for joint in self.robot.joints.iter_mut().filter(|joint| is_all && joint.drives.is_empty()) {
            joint.drives.push(Drive { name: None, gear: 1.0, order: usize::MAX });
        }
    }

    fn equalities(&mut self, root: Element<'a>) {
        for node in children(root, "equality").flat_map(|list| list.children().filter(Node::is_element)) {
            if self.attributes.text(self.reader, node, "active") == Some("false") {
                continue;
            }
            let kind = node.tag_name().name();
            let written = self.attributes.numbers(self.reader, node, "polycoef").unwrap_or_default();
            let factor = |index: usize| written.get(index).copied();
            // What a short list lacks has its default.
            let [constant, multiplier] = [factor(0).unwrap_or(0.0), factor(1).unwrap_or(1.0)];
            let to = node.attribute("joint2");
            // Without another joint the constant alone counts.
            let is_linear = to.is_none() || written.iter().skip(2).all(|factor| *factor == 0.0);
            if kind != "joint" || !is_linear {
                let what =
                    if kind == "joint" { "a polynomial in <joint>".to_owned() } else { format!("<{kind}>") };
                let text = format!("{what} is left out; write a #[holonomic] function in its place");
                self.reader.warning(node, text);
                continue;
            }
            let Some(first) =
                self.reader.text(node, "joint1", "finger").and_then(|name| self.joint(node, "joint1", name))
            else {
                continue;
            };
            let second = to.and_then(|name| self.joint(node, "joint2", name));
            let reference = |joint: usize| self.robot.joints[joint].action.reference;
            let shift = second.map_or(0.0, |second| multiplier * reference(second));
            let offset = constant + reference(first) - shift;
            let mimic = Mimic::new(self.reader.mark(node), second, multiplier, offset);
            self.robot.joints[first].mimics.push(mimic);
        }
    }

    /// A joint with one coordinate by its name.
    fn joint(&mut self, node: Element<'a>, attribute: &str, name: &str) -> Option<usize> {
        let joints = &self.robot.joints;
        let found = joints.iter().position(|joint| joint.name == name && joint.kind != Kind::Fixed);
        let text = match found {
            Some(joint) if joints[joint].kind.freedom() == 1 => return found,
            Some(_) => format!("`{name}` is neither a hinge nor a slide; name a joint of one coordinate"),
            None if self.moves_freely(node, name) => {
                format!("`{name}` moves freely; name a joint of one coordinate")
            }
            None => {
                let near = links::near(name, joints.iter().map(|joint| joint.name.as_str()));
                format!("`{name}` is no joint of the file{near}")
            }
        };
        self.reader.problem_of(node, attribute, text);
        None
    }

    /// Whether this is the name of a free joint: that of the only one names nothing in the description.
    fn moves_freely(&self, node: Element<'a>, name: &str) -> bool {
        let mut all = node.document().descendants();
        all.any(|joint| bodies::is_free(joint) && joint.attribute("name") == Some(name))
    }
}

/// Scales all masses where the file gives their sum.
fn total_mass(reader: &mut Reader<'_>, root: Node<'_, '_>, robot: &mut Robot) {
    let given = children(root, "compiler").filter_map(|node| reader.number(node, "settotalmass")).last();
    let masses = || robot.links.iter().flat_map(|link| &link.inertials).map(|inertial| inertial.mass);
    let Some(factor) = given.filter(|given| *given > 0.0).map(|given| given / masses().sum::<f64>()) else {
        return;
    };
    for inertial in robot.links.iter_mut().flat_map(|link| &mut link.inertials) {
        inertial.mass *= factor;
        inertial.tensor = inertial.tensor.map(|row| row.map(|entry| factor * entry));
    }
}

/// Reports elements that change the tree or its masses and are not read.
fn refused(reader: &mut Reader<'_>, root: Node<'_, '_>) {
    const WHOLE: &str =
        "MuJoCo writes the whole model with `mj_saveLastXML`, or `compile model.xml whole.xml`";
    for node in root.descendants().filter(Node::is_element) {
        let tag = node.tag_name().name();
        if matches!(tag, "include" | "attach" | "replicate" | "composite" | "flexcomp" | "frame") {
            reader.problem(node, format!("<{tag}> is not read; {WHOLE}"));
        }
        if tag == "freejoint" && node.attribute("align") == Some("true") {
            let text = format!("align=\"true\" moves the frame of the body, and is not read; {WHOLE}");
            reader.problem_of(node, "align", text);
        }
        if node.has_attribute("springdamper") {
            reader.problem_of(
                node,
                "springdamper",
                "`springdamper` is not read; write `stiffness` and `damping`",
            );
        }
        if tag == "body" && reader.number(node, "gravcomp").is_some_and(|share| share != 0.0) {
            reader.warning(node, "`gravcomp` is left out: the body has its weight");
        }
        let is_in_body = node.parent().is_some_and(|body| body.has_tag_name("body"));
        if tag == "plugin" && is_in_body {
            reader.warning(node, "a plugin is left out; write its forces as a #[force] function");
        }
        if tag == "compiler" {
            let groups =
                node.attribute("inertiagrouprange").map(|range| range.split_whitespace().collect::<Vec<_>>());
            if groups.is_some_and(|groups| groups != ["0", "5"]) {
                let text = format!("`inertiagrouprange` is not read; {WHOLE}");
                reader.problem_of(node, "inertiagrouprange", text);
            }
            for attribute in ["boundmass", "boundinertia"] {
                let given = reader.number(node, attribute).is_some_and(|number| number > 0.0);
                if given {
                    reader.problem_of(node, attribute, format!("`{attribute}` is not read; {WHOLE}"));
                }
            }
            for (attribute, value) in
                [("balanceinertia", "true"), ("coordinate", "global"), ("alignfree", "true")]
            {
                if node.attribute(attribute) == Some(value) {
                    reader.problem_of(
                        node,
                        attribute,
                        format!("{attribute}=\"{value}\" is not read; {WHOLE}"),
                    );
                }
            }
        }
    }
}

/// Says what the description leaves out.
fn ignored(reader: &mut Reader<'_>, root: Node<'_, '_>) {
    let known = [
        "compiler",
        "option",
        "default",
        "worldbody",
        "actuator",
        "equality",
        "asset",
        "visual",
        "size",
        "statistic",
    ];
    let mut found: Vec<String> = Vec::new();
    for node in root.children().filter(Node::is_element) {
        let tag = format!("<{}>", node.tag_name().name());
        if !known.contains(&node.tag_name().name()) && !found.contains(&tag) {
            found.push(tag);
        }
    }
    for tag in ["site", "camera", "light"] {
        if root.descendants().any(|node| node.has_tag_name(tag)) {
            found.push(format!("<{tag}>"));
        }
    }
    // In defaults as well.
    let has = |attribute: &&str| root.descendants().any(|node| node.has_attribute(*attribute));
    let limits: Vec<&str> =
        ["ctrlrange", "forcerange", "actuatorfrcrange", "actrange"].into_iter().filter(has).collect();
    if !limits.is_empty() {
        reader
            .sink
            .note(format!("left out: {}: inputs have no limits; clamp what you give", limits.join(", ")));
    }
    if !found.is_empty() {
        reader.sink.note(format!("left out: {}", found.join(", ")));
    }
}
