//! Forces and inertias in the joints: motors, damping, friction, springs, rotors, stops, gears between
//! joints.

use super::Writer;
use super::bodies::weighted;
use super::text::{code, grouped, number, sum};
use crate::import::motions::{Coordinate, Motion, Shape};
use crate::import::{Following, Options};

impl<'p> Writer<'p> {
    /// Writes all that acts in the joints.
    pub fn actions(&mut self, options: &Options) {
        self.quadratic('v', "armature", "kinetic", "The energy of rotors in the joints.", |action| {
            (action.armature, 0.0)
        });
        self.quadratic('q', "springs", "potential", "The energy of springs in the joints.", |action| {
            (action.stiffness, action.relaxed)
        });
        self.quadratic(
            'v',
            "damping",
            "dissipation",
            "Viscous damping in the joints: half its power.",
            |action| (action.damping, 0.0),
        );
        if options.friction {
            self.friction();
        }
        if options.limits {
            self.limits();
        }
        if options.mimic == Following::Constrain {
            self.mimics();
        }
        self.motors();
    }

    /// ½ Σ factor · (value − zero)².
    fn quadratic(
        &mut self,
        record: char,
        name: &str,
        role: &str,
        doc: &str,
        of: impl Fn(&crate::import::robot::Action) -> (f64, f64),
    ) {
        let plan = self.plan;
        let terms: Vec<String> = plan
            .tree
            .order
            .iter()
            .map(|&index| (index, of(&plan.robot.joints[index].action)))
            .filter(|(_, (factor, _))| *factor != 0.0)
            .filter_map(|(index, (factor, zero))| {
                if plan.robot.joints[index].kind.freedom() > 1 {
                    let square = self.square(plan.oriented(index)?, record);
                    return Some(format!("{} * {square}", number(factor)));
                }
                let value = self.joint_value(index, record);
                let value = match zero {
                    0.0 => grouped(value),
                    _ => format!("({})", sum(&[(1.0, grouped(value)), (-zero, String::new())])),
                };
                Some(format!("{} * {value}.powi(2)", number(factor)))
            })
            .collect();
        if terms.is_empty() {
            return;
        }
        let ty = if record == 'q' { "Coordinates" } else { "Velocities" };
        self.out.doc(4, doc);
        self.out.line(4, &format!("#[{role}]"));
        self.out.line(4, &format!("pub fn {name}(&self, {record}: &{ty}) -> f64 {{"));
        weighted(&mut self.out, "0.5", &terms);
        self.out.line(4, "}");
        self.out.empty();
    }

    /// The square of the velocity of an orientation or a pose.
    fn square(&self, Coordinate { name, shape }: &Coordinate, record: char) -> String {
        let own = format!("{record}.{name}");
        match shape {
            Shape::Pose => format!("({own}.linear.norm_squared() + {own}.angular.norm_squared())"),
            Shape::Rotation | Shape::Number => format!("{own}.norm_squared()"),
        }
    }

    fn friction(&mut self) {
        for (index, joint, action) in self.plan.actions().filter(|(.., action)| action.friction != 0.0) {
            let name = self.joint_name(index);
            let value = self.joint_value(index, 'v');
            self.out.doc(4, &format!("Dry friction in {}.", code(&joint.name)));
            self.out.line(4, &format!("#[friction(limit = {})]", number(action.friction)));
            self.out.line(4, &format!("pub fn {name}_friction(&self, v: &Velocities) -> f64 {{"));
            self.out.line(8, &value);
            self.out.line(4, "}");
            self.out.empty();
        }
    }

    fn limits(&mut self) {
        for (index, joint, action) in self.plan.actions() {
            let Some([lower, upper]) = action.limits else { continue };
            let name = self.joint_name(index);
            let value = self.joint_value(index, 'q');
            let value = grouped(value);
            let below = sum(&[(1.0, value.clone()), (-lower, String::new())]);
            let above = sum(&[(upper, String::new()), (-1.0, value)]);
            self.out.doc(4, &format!("The stops of {}, lower and upper.", code(&joint.name)));
            self.out.line(4, "#[unilateral]");
            self.out.line(4, &format!("pub fn {name}_limits(&self, q: &Coordinates) -> [f64; 2] {{"));
            self.out.line(8, &format!("[{below}, {above}]"));
            self.out.line(4, "}");
            self.out.empty();
        }
    }

    fn mimics(&mut self) {
        for (index, joint, _) in self.plan.actions() {
            for (count, mimic) in joint.mimics.iter().enumerate() {
                let mut terms = vec![(1.0, self.joint_value(index, 'q')), (-mimic.offset, String::new())];
                let own = code(&joint.name);
                let mut doc = format!("{own} is tied to a value.");
                if let Some(of) = mimic.of {
                    terms.insert(1, (-mimic.multiplier, grouped(self.joint_value(of, 'q'))));
                    doc = format!("{own} follows {}.", code(&self.plan.robot.joints[of].name));
                }
                let name = self.joint_name(index);
                let number = if count == 0 { String::new() } else { format!("_{}", count + 1) };
                self.out.doc(4, &doc);
                self.out.line(4, "#[holonomic]");
                self.out.line(4, &format!("pub fn {name}_mimic{number}(&self, q: &Coordinates) -> f64 {{"));
                self.out.line(8, &sum(&terms));
                self.out.line(4, "}");
                self.out.empty();
            }
        }
    }

    fn motors(&mut self) {
        let plan = self.plan;
        if plan.inputs.is_empty() {
            return;
        }
        let mut forces: Vec<Vec<(f64, String)>> = vec![Vec::new(); plan.coordinates.len()];
        for (input, joint, gear) in &plan.inputs {
            let (coordinate, factor) = match &plan.motions[*joint] {
                Motion::Own(own) => (own[0], *gear),
                Motion::Follows { of, multiplier, .. } => (*of, gear * multiplier),
            };
            forces[coordinate].push((factor, format!("u.{input}")));
        }
        if plan.has_orientations() {
            return self.motors_apart(&forces);
        }
        let forces: Vec<String> = forces.iter().map(|terms| sum(terms)).collect();
        self.out.doc(4, "The forces and torques of the motors.");
        self.out.line(4, "#[force]");
        self.out.line(4, &format!("pub fn motors(&self, u: &Inputs) -> [f64; {}] {{", forces.len()));
        self.out.list(8, "[", &forces, "]");
        self.out.line(4, "}");
        self.out.empty();
    }

    /// One force function for each driven coordinate. Descriptions with orientations do not take a force on
    /// all coordinates at once.
    fn motors_apart(&mut self, forces: &[Vec<(f64, String)>]) {
        for (coordinate, terms) in self.plan.coordinates.iter().zip(forces) {
            if terms.is_empty() {
                continue;
            }
            let name = &coordinate.name;
            let plain = name.trim_end_matches('_');
            self.out.doc(4, &format!("The motor of `{name}`."));
            self.out.line(4, &format!("#[force(on = {name})]"));
            self.out.line(4, &format!("pub fn {plain}_motor(&self, u: &Inputs) -> f64 {{"));
            self.out.line(8, &sum(terms));
            self.out.line(4, "}");
            self.out.empty();
        }
    }

    /// The identifier of a joint: that of its coordinate, or of the link that it moves.
    fn joint_name(&self, joint: usize) -> &'p str {
        let plan = self.plan;
        match &plan.motions[joint] {
            Motion::Own(own) => plan.coordinates[own[0]].name.trim_end_matches('_'),
            Motion::Follows { .. } => &plan.frames[plan.robot.joints[joint].child].name,
        }
    }
}
