//! The tree of bodies with their joints and inertias.

use std::collections::BTreeSet;

use roxmltree::Node;

use super::attributes::{Attributes, Element, ORIENTATIONS};
use super::geom;
use crate::import::Options;
use crate::import::geometry::{Pose, direction, scaled};
use crate::import::inertia::Inertial;
use crate::import::links;
use crate::import::report::Mark;
use crate::import::robot::{Action, Doubtful, Joint, Kind, Link, Robot};
use crate::import::xml::{Reader, child, children};

/// Fills a robot with bodies.
pub struct Bodies<'r, 'a> {
    reader: &'r mut Reader<'a>,
    attributes: &'r Attributes<'a>,
    options: &'r Options,
    robot: &'r mut Robot,
    names: BTreeSet<String>,
}

impl<'r, 'a> Bodies<'r, 'a> {
    /// No bodies yet.
    pub fn new(
        reader: &'r mut Reader<'a>,
        attributes: &'r Attributes<'a>,
        options: &'r Options,
        robot: &'r mut Robot,
    ) -> Self {
        Bodies { reader, attributes, options, robot, names: BTreeSet::new() }
    }

    /// Reads all bodies of a file.
    pub fn world(&mut self, root: Element<'a>) {
        if self.options.floating {
            self.reader
                .problem(root, "--floating is for URDF; write <freejoint/> into the body that moves freely");
        }
        let mark = self.reader.mark(root);
        self.robot.links.push(Link { name: "world".to_owned(), mark, inertials: Vec::new(), doubtful: None });
        let mut open: Vec<(Element<'a>, usize)> = Vec::new();
        let push = |open: &mut Vec<(Element<'a>, usize)>, node: Element<'a>, parent: usize| {
            let first = open.len();
            open.extend(children(node, "body").map(|body| (body, parent)));
            open[first..].reverse();
        };
        for world in children(root, "worldbody") {
            push(&mut open, world, 0);
        }
        if open.is_empty() {
            self.reader.problem(root, "the model has no bodies; write them into a <worldbody>");
        }
        let free = root.descendants().filter(|node| is_free(*node)).count();
        while let Some((node, parent)) = open.pop() {
            let link = self.body(node, parent, free);
            push(&mut open, node, link);
        }
    }

    fn body(&mut self, node: Element<'a>, parent: usize, free: usize) -> usize {
        let mark = self.reader.mark(node);
        let name = match node.attribute("name") {
            Some(name) => name.to_owned(),
            None => format!("body_{}", self.robot.links.len()),
        };
        if !self.names.insert(name.clone()) {
            self.reader.problem(node, "another body has this name; rename one of them");
        }
        let pose = self.attributes.pose(self.reader, node, self.options);
        let joints: Vec<Element<'a>> = node.children().filter(|node| is_joint(*node)).collect();
        let (inertials, doubtful) = self.inertials(node);
        if joints.is_empty() {
            let link = self.link(&name, &mark, inertials);
            self.robot.links[link].doubtful = doubtful;
            let action = Action::default();
            self.robot.joints.push(joint(name, mark, [parent, link], pose, [0.0; 3], Kind::Fixed, action));
            return link;
        }
        let (mut above, mut pose) = (parent, pose);
        let mut inertials = Some(inertials);
        let before = self.robot.joints.len();
        for (index, &joint) in joints.iter().enumerate() {
            let is_last = index + 1 == joints.len();
            let part = if is_last { name.clone() } else { format!("{name}_part_{}", index + 1) };
            let link = self.link(&part, &mark, inertials.take_if(|_| is_last).unwrap_or_default());
            self.joint(joint, &name, [above, link], pose, free);
            (above, pose) = (link, Pose::IDENTITY);
        }
        self.robot.links[above].doubtful = doubtful;
        self.freedom(node, before);
        above
    }

    /// Reports a body that its own joints move in more ways than there are: their mass matrix is singular.
    fn freedom(&mut self, body: Element<'a>, before: usize) {
        let kinds = self.robot.joints[before..].iter().rev().map(|joint| joint.kind);
        let freedom: usize = kinds.clone().map(Kind::freedom).sum();
        // From the last joint on.
        let turned = kinds.skip_while(|kind| !matches!(kind, Kind::Ball | Kind::Turns(_))).skip(1);
        if freedom > 6 {
            let text = format!("its joints have {freedom} degrees of freedom, and a body 6; remove some");
            self.reader.problem(body, text);
        } else if turned.into_iter().any(|kind| kind == Kind::Ball) {
            let text = "a ball joint turns it in all directions; remove what turns it after that";
            self.reader.problem(body, text);
        }
    }

    fn link(&mut self, name: &str, mark: &Mark, inertials: Vec<Inertial>) -> usize {
        self.robot.links.push(Link { name: name.to_owned(), mark: mark.clone(), inertials, doubtful: None });
        self.robot.links.len() - 1
    }

    fn joint(&mut self, node: Element<'a>, body: &str, ends: [usize; 2], pose: Pose, free: usize) {
        let mark = self.reader.mark(node);
        let written = node.attribute("name");
        let mut name = written.unwrap_or(body).to_owned();
        let is_taken = self.robot.joints.iter().any(|joint| joint.kind != Kind::Fixed && joint.name == name);
        match (is_taken, written) {
            (true, Some(_)) => self.reader.problem(node, "another joint has this name; rename one of them"),
            (true, None) => name = format!("{name}_{}", self.robot.joints.len()),
            (false, _) => {}
        }
        let Some(kind) = self.kind(node) else { return };
        let mut place: [f64; 3] = self.attributes.vector(self.reader, node, "pos").unwrap_or([0.0; 3]);
        let action = self.action(node, kind, &name);
        let mut frame = Pose { shift: pose.compose(&Pose { shift: place, ..Pose::IDENTITY }).shift, ..pose };
        if kind == Kind::Free {
            if ends[0] != 0 {
                self.reader.problem(
                    node,
                    "only bodies of the world move freely; put the body there, or use other joints",
                );
            }
            let start = pose.shift;
            let text = format!(
                "`{body}` starts at {start:?} in the file; its coordinates are its place in the world"
            );
            self.reader.sink.note(text);
            (frame, place) = (Pose::IDENTITY, [0.0; 3]);
            if free == 1 {
                name.clear();
            }
        }
        let back = scaled(-1.0, place).map(|entry| entry + 0.0);
        self.robot.joints.push(self::joint(name, mark, ends, frame, back, kind, action));
    }

    fn kind(&mut self, node: Element<'a>) -> Option<Kind> {
        if node.has_tag_name("freejoint") {
            return Some(Kind::Free);
        }
        let axis = |bodies: &mut Self| {
            let written = bodies.attributes.vector(bodies.reader, node, "axis").unwrap_or([0.0, 0.0, 1.0]);
            let unit = direction(written, bodies.options.tolerance);
            if unit.is_none() {
                let text = "the axis is zero; write a direction such as axis=\"0 0 1\"";
                bodies.reader.problem_of(node, "axis", text);
            }
            unit
        };
        match self.attributes.text(self.reader, node, "type").unwrap_or("hinge") {
            "hinge" => axis(self).map(Kind::Turns),
            "slide" => axis(self).map(Kind::Slides),
            "ball" => Some(Kind::Ball),
            "free" => Some(Kind::Free),
            other => {
                let near = links::near(other, ["hinge", "slide", "ball", "free"].into_iter());
                let text = format!("`{other}` is no type of joint{near}; there are hinge, slide, ball, free");
                self.reader.problem_of(node, "type", text);
                None
            }
        }
    }

    fn action(&mut self, node: Element<'a>, kind: Kind, joint: &str) -> Action {
        // A free joint has no such attributes and takes none from defaults.
        if node.has_tag_name("freejoint") {
            return Action::default();
        }
        let turns = matches!(kind, Kind::Turns(_));
        let attributes = self.attributes;
        let value = |reader: &mut Reader<'a>, name: &str| {
            let value = attributes.number(reader, node, name).unwrap_or(0.0);
            if turns { attributes.radians(value) } else { value }
        };
        let (reference, relaxed) = (value(self.reader, "ref"), value(self.reader, "springref"));
        let [damping, friction, armature, stiffness] = ["damping", "frictionloss", "armature", "stiffness"]
            .map(|name| {
                let found = attributes.find(self.reader, node, name);
                found.map_or(0.0, |found| self.reader.size(found, name))
            });
        let limits = self.range(node, kind);
        let limits =
            limits.map(|limits| if turns { limits.map(|limit| attributes.radians(limit)) } else { limits });
        if kind.freedom() > 1 {
            let others = [
                (friction != 0.0, "frictionloss"),
                (stiffness != 0.0, "stiffness"),
                (limits.is_some() && kind == Kind::Ball, "range"),
            ];
            let left_out: Vec<&str> =
                others.iter().filter(|(is_there, _)| *is_there).map(|(_, name)| *name).collect();
            if !left_out.is_empty() {
                self.reader.sink.note(format!("left out: {} of `{joint}`", left_out.join(", ")));
            }
            return Action { damping, armature, ..Action::default() };
        }
        Action { damping, friction, armature, stiffness, relaxed, reference, limits }
    }

    /// The stops of a joint as the file writes them.
    fn range(&mut self, node: Element<'a>, kind: Kind) -> Option<[f64; 2]> {
        let range: Option<[f64; 2]> = self.attributes.vector(self.reader, node, "range");
        let limited = self.attributes.text(self.reader, node, "limited").unwrap_or("auto");
        let range = range.filter(|_| limited != "false");
        if let Some([lower, upper]) = range.filter(|[lower, upper]| lower > upper) {
            self.reader.problem_of(node, "range", format!("{lower} is above {upper}; exchange the two"));
            return None;
        }
        let limits = range.filter(|[lower, upper]| lower < upper);
        if limited == "true" && limits.is_none() && kind.freedom() == 1 {
            let text = "limited=\"true\" asks for stops, and `range` gives none; write range=\"LOWER UPPER\"";
            self.reader.problem_of(node, "limited", text);
        }
        if limited == "auto" && limits.is_some() && !self.attributes.autolimits && kind != Kind::Free {
            let text =
                "`range` makes no stops under autolimits=\"false\"; write limited=\"true\", or remove it";
            self.reader.problem_of(node, "range", text);
        }
        limits
    }

    /// The masses of a body: as given, or those of its geoms.
    fn inertials(&mut self, body: Element<'a>) -> (Vec<Inertial>, Option<Doubtful>) {
        let compiler = body.document().root_element().children().filter(|node| node.has_tag_name("compiler"));
        let from_geoms =
            compiler.filter_map(|node| node.attribute("inertiafromgeom")).next_back().unwrap_or("auto");
        let given = child(body, "inertial");
        let reads_geoms = match from_geoms {
            "true" => true,
            "false" => false,
            _ => given.is_none(),
        };
        let (reader, attributes, options) = (&mut *self.reader, self.attributes, self.options);
        let counts = moves(body) || totals(body);
        let geoms = children(body, "geom").filter(|_| reads_geoms);
        let of_geoms: Vec<Inertial> =
            geoms.filter_map(|node| geom::inertial(reader, attributes, node, counts, options)).collect();
        // Where no geom has a mass, what is given counts in any case.
        match given.filter(|_| of_geoms.iter().all(|geom| geom.mass == 0.0)).and_then(|node| self.given(node))
        {
            Some((inertial, doubtful)) => (vec![inertial], doubtful),
            None => (of_geoms, None),
        }
    }

    fn given(&mut self, node: Element<'a>) -> Option<(Inertial, Option<Doubtful>)> {
        let frame = self.attributes.pose(self.reader, node, self.options);
        let mass = self.reader.required(node, "mass")?;
        let full: Option<[f64; 6]> = self.reader.vector(node, "fullinertia");
        let diagonal: Option<[f64; 3]> = self.reader.vector(node, "diaginertia");
        if full.is_some() {
            let others = ORIENTATIONS.into_iter().chain(["diaginertia"]);
            for other in others.filter(|other| node.has_attribute(*other)) {
                let text =
                    format!("`fullinertia`, in the axes of the body, excludes `{other}`; remove one of them");
                self.reader.problem_of(node, other, text);
            }
        }
        let tensor = match (full, diagonal) {
            (Some([xx, yy, zz, xy, xz, yz]), _) => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            (None, Some([xx, yy, zz])) => [[xx, 0.0, 0.0], [0.0, yy, 0.0], [0.0, 0.0, zz]],
            (None, None) => {
                let text = "it has no inertia; write diaginertia=\"…\" or fullinertia=\"…\"";
                self.reader.problem(node, text);
                return None;
            }
        };
        let inertial = Inertial::in_frame(&frame, mass, &tensor);
        let doubtful = links::check_inertia(self.reader, (node, "mass"), node, &inertial);
        Some((inertial, doubtful))
    }
}

fn joint(
    name: String,
    mark: Mark,
    ends: [usize; 2],
    pose: Pose,
    back: [f64; 3],
    kind: Kind,
    action: Action,
) -> Joint {
    let [parent, child] = ends;
    Joint { name, mark, parent, child, pose, back, kind, action, mimics: Vec::new(), drives: Vec::new() }
}

fn is_joint(node: Node<'_, '_>) -> bool {
    node.has_tag_name("joint") || node.has_tag_name("freejoint")
}

/// Whether a joint moves a body, be it that of a body around it.
fn moves(body: Node<'_, '_>) -> bool {
    body.ancestors().any(|around| around.children().any(is_joint))
}

/// Whether the file gives the sum of all masses, those of bodies that stand still among them.
fn totals(body: Node<'_, '_>) -> bool {
    let all = children(body.document().root_element(), "compiler");
    all.filter_map(|node| node.attribute("settotalmass"))
        .any(|sum| sum.trim().parse::<f64>().is_ok_and(|sum| sum > 0.0))
}

pub fn is_free(node: Node<'_, '_>) -> bool {
    node.has_tag_name("freejoint") || (node.has_tag_name("joint") && node.attribute("type") == Some("free"))
}
