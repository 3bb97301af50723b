//! A function for the frame of each link.

use super::Writer;
use super::text::{axis, code, grouped, number, shift, sum, turn};
use crate::import::geometry::{Pose, Vector, add, cross, norm, scaled};
use crate::import::motions::{Coordinate, Motion, Shape};
use crate::import::robot::{Joint, Kind};

impl Writer<'_> {
    /// Writes all frames, parents first.
    pub fn frames(&mut self) {
        for &index in &self.plan.tree.order {
            let joint = &self.plan.robot.joints[index];
            if !self.plan.frames[joint.child].is_world {
                self.frame(index, joint);
            }
        }
    }

    fn frame(&mut self, index: usize, joint: &Joint) {
        let frame = &self.plan.frames[joint.child];
        let link = code(&self.plan.robot.links[joint.child].name);
        let by = code(&joint.name);
        let doc = match joint.kind {
            Kind::Fixed if frame.moves => {
                format!("{link}, fixed to {}.", code(&self.plan.robot.links[joint.parent].name))
            }
            Kind::Fixed => format!("{link}, which stands still."),
            Kind::Turns(_) => format!("{link}, turned by {by}."),
            Kind::Slides(_) => format!("{link}, shifted by {by}."),
            Kind::Free if joint.name.is_empty() => format!("{link}, which moves freely."),
            Kind::Planar(_) | Kind::Ball | Kind::Free => format!("{link}, moved by {by}."),
        };
        let name = format!("{}_frame", frame.name);
        let mut factors: Vec<String> = self.parent(joint.parent).into_iter().collect();
        let reference = factors.is_empty();
        factors.extend(self.pose(&joint.pose, &frame.name.clone()));
        let moving = self.moving(index, joint);
        if !moving.is_empty() {
            factors.extend(moving);
            factors.extend(shift(joint.back.map(number)));
        }
        // A product is a pose only if it has a shift and a rotation.
        let turns = |factor: &String| {
            factor.starts_with("Rotation3")
                || factor.ends_with("_orientation(q)")
                || factor.ends_with(".to_rotation_matrix()")
        };
        let shifts = |factor: &String| factor.starts_with("Translation3") || factor.ends_with(".translation");
        if reference && !factors.iter().any(turns) {
            factors.push("Rotation3::identity()".to_owned());
        }
        if reference && !factors.iter().any(shifts) {
            factors.insert(0, "Translation3::identity()".to_owned());
        }
        let argument = if self.plan.frames[joint.child].moves { ", q: &Coordinates" } else { "" };
        if matches!(joint.kind, Kind::Free | Kind::Ball) && self.plan.oriented(index).is_none() {
            self.orientation(index, joint);
        }
        self.out.doc(4, &format!("The frame of {doc}"));
        self.out.line(4, &format!("pub fn {name}(&self{argument}) -> IsometryMatrix3<f64> {{"));
        self.out.chain(8, "", '*', &factors, "");
        self.out.line(4, "}");
        self.out.empty();
    }

    /// The call of the frame of a link; none for the world.
    pub fn parent(&self, link: usize) -> Option<String> {
        let frame = &self.plan.frames[link];
        let argument = if frame.moves { "q" } else { "" };
        (!frame.is_world).then(|| format!("self.{}_frame({argument})", frame.name))
    }

    /// The factors of a fixed pose.
    fn pose(&mut self, pose: &Pose, link: &str) -> Vec<String> {
        let is_field = self.parameters.lengths;
        let entries = std::array::from_fn(|i| {
            let along = ["x", "y", "z"][i];
            let name = || format!("{link}_{along}");
            let doc = || format!("How far `{link}` is off along {along} of what it hangs on, in m.");
            self.value(is_field, pose.shift[i], name, doc)
        });
        shift(entries).into_iter().chain(turn(&pose.turn)).collect()
    }

    /// The factors of what a joint does.
    fn moving(&self, index: usize, joint: &Joint) -> Vec<String> {
        let own = match &self.plan.motions[index] {
            Motion::Own(own) => own.iter().map(|&own| self.coordinate(own, 'q')).collect(),
            Motion::Follows { .. } => Vec::new(),
        };
        let reference = joint.action.reference;
        let single = || match reference {
            0.0 => self.joint_value(index, 'q'),
            _ => sum(&[(1.0, grouped(self.joint_value(index, 'q'))), (-reference, String::new())]),
        };
        if let Some(coordinate) = self.plan.oriented(index) {
            return oriented(coordinate);
        }
        match joint.kind {
            Kind::Fixed => Vec::new(),
            Kind::Turns(about) => vec![about_axis(about, single())],
            Kind::Slides(along) => shift(multiples(&[(along, single())])).into_iter().collect(),
            Kind::Planar(normal) => {
                let [first, second] = across(normal);
                let moved = multiples(&[(first, own[0].clone()), (second, own[1].clone())]);
                shift(moved).into_iter().chain([about_axis(normal, own[2].clone())]).collect()
            }
            Kind::Ball => vec![format!("self.{}(q)", self.orientation_name(joint))],
            Kind::Free => {
                let moved = format!("Translation3::new({})", own[..3].join(", "));
                vec![moved, format!("self.{}(q)", self.orientation_name(joint))]
            }
        }
    }

    /// The one place that says how an orientation is described by angles.
    fn orientation(&mut self, index: usize, joint: &Joint) {
        let Motion::Own(own) = &self.plan.motions[index] else { return };
        let angles: Vec<String> =
            own.iter().skip(own.len() - 3).map(|&own| self.coordinate(own, 'q')).collect();
        let link = code(&self.plan.robot.links[joint.child].name);
        let name = self.orientation_name(joint);
        self.out.doc(4, &format!("The orientation of {link}: roll, pitch and yaw about fixed axes."));
        self.out.line(4, &format!("pub fn {name}(&self, q: &Coordinates) -> Rotation3<f64> {{"));
        self.out.line(8, &format!("Rotation3::from_euler_angles({})", angles.join(", ")));
        self.out.line(4, "}");
        self.out.empty();
    }

    fn orientation_name(&self, joint: &Joint) -> String {
        format!("{}_orientation", self.plan.frames[joint.child].name)
    }
}

/// The factors of an orientation or a pose.
fn oriented(Coordinate { name, shape }: &Coordinate) -> Vec<String> {
    match shape {
        Shape::Pose => {
            vec![format!("q.{name}.translation"), format!("q.{name}.rotation.to_rotation_matrix()")]
        }
        Shape::Rotation | Shape::Number => vec![format!("q.{name}.to_rotation_matrix()")],
    }
}

fn about_axis(about: Vector, angle: String) -> String {
    let (axis, turned) = axis(about);
    let angle = if turned { negated(&angle) } else { angle };
    match axis.len() + angle.len() {
        0..=70 => format!("Rotation3::from_axis_angle({axis}, {angle})"),
        _ => format!("Rotation3::from_axis_angle(\n{axis},\n{angle},\n)"),
    }
}

/// The opposite.
fn negated(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(name) if !name.contains(' ') => name.to_owned(),
        _ => format!("-{}", grouped(text.to_owned())),
    }
}

/// The entries of Σ direction · amount.
fn multiples(parts: &[(Vector, String)]) -> [String; 3] {
    std::array::from_fn(|i| {
        let terms: Vec<(f64, String)> = parts
            .iter()
            .filter(|(along, _)| along[i] != 0.0)
            .map(|(along, amount)| (along[i], amount.clone()))
            .collect();
        match terms.as_slice() {
            [(1.0, only)] => only.clone(),
            [(-1.0, only)] => negated(only),
            _ => {
                sum(&terms.into_iter().map(|(factor, amount)| (factor, grouped(amount))).collect::<Vec<_>>())
            }
        }
    })
}

/// Two unit vectors across a third one, right-handed with it.
fn across(normal: Vector) -> [Vector; 2] {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let next = match normal.iter().position(|entry| entry.abs() == 1.0) {
        Some(main) => axes[(main + 1) % 3],
        None => {
            let off = axes.into_iter().find(|axis| norm(cross(*axis, normal)) > 0.5).unwrap_or(axes[0]);
            let along: f64 = off.iter().zip(normal).map(|(a, b)| a * b).sum();
            let off = add(off, scaled(-along, normal));
            scaled(1.0 / norm(off), off)
        }
    };
    [next, cross(normal, next)]
}
