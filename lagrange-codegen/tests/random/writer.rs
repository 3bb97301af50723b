//! Expressions and functions of a random system as text.

use crate::constraint::{Kind, Rows};
use crate::expression::{Body, Expr, NOWHERE, Operator, RATIO, Vector};
use crate::source::{COMPONENTS, PARAMETERS, quantity, scalar_type};
use crate::system::{Energy, Form, Inertia, Place, Role, Rotation, Scalar, System, TILTED};

/// Writes one function.
#[derive(Clone, Copy)]
pub struct Writer<'a> {
    pub system: &'a System,
    pub visible: usize,
    pub locals: usize,
}

impl Writer<'_> {
    pub fn number(&self, value: f64) -> String {
        match self.system.scalar {
            Scalar::F64 | Scalar::F32 => format!("{value:?}"),
            Scalar::Generic => format!("R::from_f64({value:?})"),
        }
    }

    /// An expression that a method is called on.
    pub fn receiver(&self, expr: &Expr) -> String {
        match (expr, self.system.scalar) {
            (Expr::Number(value), Scalar::F64) => format!("{value:?}_f64"),
            (Expr::Number(value), Scalar::F32) => format!("{value:?}_f32"),
            _ => self.scalar(expr),
        }
    }

    pub fn scalar(&self, expr: &Expr) -> String {
        let Writer { system, .. } = self;
        match expr {
            Expr::Number(value) => self.number(*value),
            Expr::Coordinate(i) => quantity("q", &system.coordinates, i % system.count()),
            Expr::Velocity(i) => quantity("v", &system.coordinates, i % system.count()),
            Expr::Time => "t".to_owned(),
            Expr::Input(i) if system.inputs.is_empty() => self.scalar(&Expr::Parameter(*i)),
            Expr::Input(i) => quantity("u", &system.inputs, i % system.input_count()),
            Expr::Parameter(i) => PARAMETERS[i % PARAMETERS.len()].to_owned(),
            Expr::Ratio => self.ratio(),
            Expr::Local(_) if self.locals == 0 => self.ratio(),
            Expr::Local(i) => format!("w{}", i % self.locals),
            Expr::Argument(i) => ["x", "y"][i % 2].to_owned(),
            Expr::Element => "element".to_owned(),
            Expr::Negative(a) => format!("(-{})", self.scalar(a)),
            Expr::Operation(operator, a, b) => {
                let sign = match operator {
                    Operator::Add => "+",
                    Operator::Subtract => "-",
                    Operator::Multiply => "*",
                    Operator::Divide => "/",
                };
                format!("({} {sign} {})", self.scalar(a), self.scalar(b))
            }
            Expr::Call(function, a) => format!("{}.{}()", self.receiver(a), function.name()),
            Expr::Combine(pair, a, b) => format!("{}.{}({})", self.receiver(a), pair.name(), self.scalar(b)),
            Expr::Power(a, power) => format!("{}.powi({power})", self.receiver(a)),
            Expr::Helper(i, a, b) => {
                let i = i % system.helpers.len();
                format!("self.helper_{i}(q, t, {}, {})", self.scalar(a), self.scalar(b))
            }
            Expr::Sum(which, body) => self.sum(*which, body),
            Expr::Dot(dimension, a, b) => {
                format!("{}.dot(&{})", self.vector(a, *dimension), self.vector(b, *dimension))
            }
            Expr::Norm(dimension, a) => format!("{}.norm()", self.vector(a, *dimension)),
            Expr::Component(index, dimension, a) => {
                format!("{}.{}", self.vector(a, *dimension), COMPONENTS[index % dimension])
            }
        }
    }

    pub fn ratio(&self) -> String {
        match self.system.scalar {
            Scalar::F64 | Scalar::F32 => "Self::RATIO".to_owned(),
            Scalar::Generic => self.number(RATIO),
        }
    }

    /// The elements that a loop runs over.
    pub fn elements(&self, which: usize) -> String {
        match self.system.looped(which) {
            (Some(group), _) => format!("q.{}", group.name),
            (None, range) => {
                let all: Vec<String> = range.map(|i| quantity("q", &self.system.coordinates, i)).collect();
                format!("[{}]", all.join(", "))
            }
        }
    }

    pub fn sum(&self, which: usize, body: &Expr) -> String {
        let (elements, zero, body) = (self.elements(which), self.number(0.0), self.scalar(body));
        match which / 4 % 3 {
            0 => format!("{elements}.iter().map(|&element| {body}).sum::<{}>()", scalar_type(self.system)),
            1 => format!("{elements}.iter().fold({zero}, |total, &element| total + {body})"),
            _ => format!(
                "{{ let elements = {elements}; let mut total = {zero}; \
                 for i in 0..{} {{ let element = elements[i]; total += {body}; }} total }}",
                self.system.looped(which).1.len()
            ),
        }
    }

    pub fn vector(&self, vector: &Vector, dimension: usize) -> String {
        let infix = |a: &Vector, sign: &str, b: &Vector| {
            format!("({} {sign} {})", self.vector(a, dimension), self.vector(b, dimension))
        };
        match vector {
            Vector::New(components) => {
                let components: Vec<String> =
                    components[..dimension].iter().map(|c| self.scalar(c)).collect();
                format!("Vector{dimension}::new({})", components.join(", "))
            }
            Vector::Place(which) => match self.system.place(*which, dimension, self.visible) {
                Some(place) => self.place(place),
                None => format!("Vector{dimension}::repeat({})", self.number(NOWHERE)),
            },
            Vector::Negative(a) => format!("(-{})", self.vector(a, dimension)),
            Vector::Add(a, b) => infix(a, "+", b),
            Vector::Subtract(a, b) => infix(a, "-", b),
            Vector::Scale(factor, a) => {
                let (factor, a) = (self.scalar(factor), self.vector(a, dimension));
                match self.system.scalar {
                    Scalar::F64 | Scalar::F32 => format!("({factor} * {a})"),
                    Scalar::Generic => format!("({a} * {factor})"),
                }
            }
            Vector::Cross(a, b) if dimension == 3 => {
                format!("{}.cross(&{})", self.vector(a, 3), self.vector(b, 3))
            }
            Vector::Cross(a, b) => infix(a, "+", b),
            Vector::Turn(angle, a) => {
                let (angle, a) = (self.scalar(angle), self.vector(a, dimension));
                match dimension {
                    1 => a,
                    2 => format!("(Rotation2::new({angle}) * {a})"),
                    _ => format!("(Rotation3::from_axis_angle(&Vector3::z_axis(), {angle}) * {a})"),
                }
            }
        }
    }

    /// The position of a particle or body, by a call of its function.
    pub fn place(&self, Place { role, index }: Place) -> String {
        let call = format!("self.place_{role}(q, t)");
        match &self.system.roles[role] {
            Role::Planar { form, .. } | Role::Spatial { form, .. } => match form {
                Form::Isometry => format!("{call}.translation.vector"),
                Form::Tuple => format!("{call}.0"),
            },
            Role::Chain { .. } => format!("{call}[{index}]"),
            _ => call,
        }
    }

    pub fn rotation(&self, turn: &Rotation) -> String {
        let about =
            |axis: &str, angle: &Expr| format!("Rotation3::from_axis_angle(&{axis}, {})", self.scalar(angle));
        match turn {
            Rotation::Axis(axis, angle) => about(&format!("Vector3::{}_axis()", COMPONENTS[axis % 3]), angle),
            Rotation::Tilted(angle) => {
                let [x, y, z] = TILTED.map(|component| self.number(component));
                about(&format!("Unit::new_unchecked(Vector3::new({x}, {y}, {z}))"), angle)
            }
            Rotation::Euler(angles) => {
                let [roll, pitch, yaw] = [0, 1, 2].map(|i| self.scalar(&angles[i]));
                format!("Rotation3::from_euler_angles({roll}, {pitch}, {yaw})")
            }
            Rotation::Product(left, right) => format!("({} * {})", self.rotation(left), self.rotation(right)),
            Rotation::Inverse(inner) => format!("{}.inverse()", self.rotation(inner)),
            Rotation::Entries(inner) => {
                format!("Rotation3::from_matrix_unchecked(*{}.matrix())", self.rotation(inner))
            }
        }
    }

    pub fn inertia(&self, Inertia { moments, product }: &Inertia) -> String {
        let [a, b, c] = [0, 1, 2].map(|i| self.scalar(&moments[i]));
        let (zero, product) = (self.number(0.0), product.as_ref().map(|product| self.scalar(product)));
        match product {
            None => format!("[{a}, {b}, {c}]"),
            Some(p) => format!("Matrix3::new({a}, {p}, {zero}, {p}, {b}, {zero}, {zero}, {zero}, {c})"),
        }
    }

    /// `fn name(&self, …) -> output { lets; result }`.
    pub fn function<S>(
        mut self,
        (attribute, name, arguments, output): (&str, String, &str, &str),
        body: &Body<S>,
        result: impl FnOnce(&Self, &S) -> String,
    ) -> String {
        let scalar = scalar_type(self.system);
        let arguments = arguments.replace("f64", scalar);
        let mut text =
            format!("{attribute}\nfn {name}(&self, {arguments}) -> {} {{\n", output.replace("f64", scalar));
        for expr in &body.lets {
            text += &format!("let w{} = {};\n", self.locals, self.scalar(expr));
            self.locals += 1;
        }
        text + &result(&self, &body.result) + "\n}\n"
    }

    pub fn helper(self, index: usize, body: &Body<Expr>) -> String {
        let arguments = format!("{Q_T}, x: f64, y: f64");
        self.function(("", format!("helper_{index}"), &arguments, "f64"), body, Self::scalar)
    }

    pub fn role(self, role: &Role) -> String {
        let system = self.system;
        let name = |kind: &str| format!("{kind}_{}", self.visible);
        let in_force =
            if system.inputs.is_empty() { Q_V_T.to_owned() } else { format!("{Q_V_T}, u: &Inputs") };
        match role {
            Role::Point { dimension, mass, position } => {
                let attribute = format!("#[point(mass = {})]", self.scalar(mass));
                let output = format!("Vector{dimension}<f64>");
                self.function((&attribute, name("place"), Q_T, &output), position, |writer, result| {
                    writer.vector(result, *dimension)
                })
            }
            Role::Planar { mass, inertia, pose, form } => {
                let (mass, inertia) = (self.scalar(mass), self.scalar(inertia));
                let attribute = format!("#[body(mass = {mass}, inertia = {inertia})]");
                let (output, call) = match form {
                    Form::Isometry => ("Isometry2<f64>", "Isometry2::new"),
                    Form::Tuple => ("(Vector2<f64>, f64)", ""),
                };
                self.function((&attribute, name("place"), Q_T, output), pose, |writer, (shift, angle)| {
                    format!("{call}({}, {})", writer.vector(shift, 2), writer.scalar(angle))
                })
            }
            Role::Spatial { mass, inertia, pose, form } => {
                let (mass, inertia) = (self.scalar(mass), self.inertia(inertia));
                let attribute = format!("#[body(mass = {mass}, inertia = {inertia})]");
                let output = match form {
                    Form::Isometry => "Isometry3<f64>",
                    Form::Tuple => "(Vector3<f64>, Rotation3<f64>)",
                };
                self.function((&attribute, name("place"), Q_T, output), pose, |writer, (shift, turn)| {
                    let (shift, turn) = (writer.vector(shift, 3), writer.rotation(turn));
                    match form {
                        Form::Isometry => format!(
                            "Isometry3::from_parts(Translation3::from({shift}), UnitQuaternion::from_rotation_matrix(&{turn}))"
                        ),
                        Form::Tuple => format!("({shift}, {turn})"),
                    }
                })
            }
            Role::Chain { which, relative, mass, length } => {
                let (count, elements) = (system.looped(*which).1.len(), self.elements(*which));
                let (attribute, zero) = (format!("#[point(mass = {})]", self.scalar(mass)), self.number(0.0));
                let angle = if *relative { "angle += angles[i];" } else { "angle = angles[i];" };
                let link = match system.scalar {
                    Scalar::F64 | Scalar::F32 => {
                        format!("{} * Vector2::new(angle.sin(), -angle.cos())", self.scalar(length))
                    }
                    Scalar::Generic => {
                        format!("Vector2::new(angle.sin(), -angle.cos()) * {}", self.scalar(length))
                    }
                };
                let output = format!("[Vector2<f64>; {count}]");
                let body = Body { lets: Vec::new(), result: () };
                self.function((&attribute, name("place"), Q_T, &output), &body, |_, ()| {
                    format!(
                        "let angles = {elements}; let mut angle = {zero}; let mut end = Vector2::zeros();\n\
                         let mut joints = [Vector2::zeros(); {count}];\n\
                         for i in 0..{count} {{ {angle} end += {link}; joints[i] = end; }}\njoints"
                    )
                })
            }
            Role::Energy(energy, body) => {
                let (attribute, arguments) = match energy {
                    Energy::Kinetic => ("#[kinetic]", Q_V_T),
                    Energy::Potential => ("#[potential]", Q_T),
                    Energy::Lagrangian => ("#[lagrangian]", Q_V_T),
                    Energy::Dissipation => ("#[dissipation]", Q_V_T),
                };
                self.function((attribute, name("energy"), arguments, "f64"), body, Self::scalar)
            }
            Role::ForceOn(which, body) => {
                let target = quantity("", &system.coordinates, which % system.count());
                let attribute = format!("#[force(on = {})]", target.trim_start_matches('.'));
                self.function((&attribute, name("force"), &in_force, "f64"), body, Self::scalar)
            }
            Role::ForceOnAll(body) => {
                let output = format!("[f64; {}]", system.count());
                self.function(("#[force]", name("force"), &in_force, &output), body, |writer, entries| {
                    let entries = entries.iter().cycle().take(system.count());
                    format!("[{}]", entries.map(|e| writer.scalar(e)).collect::<Vec<_>>().join(", "))
                })
            }
            Role::ForceAt(which, body) => {
                let (attribute, dimension) = self.target(system.any_place(*which));
                let output = format!("Vector{dimension}<f64>");
                self.function((&attribute, name("force"), &in_force, &output), body, |writer, force| {
                    writer.vector(force, dimension)
                })
            }
            Role::Wrench(which, body) => {
                let (attribute, dimension) = self.target(system.any_body(*which));
                let torque = if dimension == 2 { "f64" } else { "Vector3<f64>" };
                let output = format!("(Vector{dimension}<f64>, {torque})");
                self.function(
                    (&attribute, name("force"), &in_force, &output),
                    body,
                    |writer, (force, torque)| {
                        let torque = writer.vector(torque, 3);
                        let component = if dimension == 2 { ".x" } else { "" };
                        format!("({}, {torque}{component})", writer.vector(force, dimension))
                    },
                )
            }
            Role::Constraint(kind, _, body) => {
                let (attribute, arguments) = match kind {
                    Kind::Holonomic => ("#[holonomic]", Q_T),
                    Kind::Affine => ("#[nonholonomic]", Q_V_T),
                    Kind::Chetaev => ("#[nonholonomic(chetaev)]", Q_V_T),
                };
                let output = match &body.result {
                    Rows::Scalar(_) => "f64".to_owned(),
                    Rows::Array(rows) => format!("[f64; {}]", rows.len()),
                    Rows::Vector(dimension, _) => format!("Vector{dimension}<f64>"),
                };
                let name = system.constraint_name(self.visible);
                self.function((attribute, name, arguments, &output), body, |writer, rows| match rows {
                    Rows::Scalar(row) => writer.scalar(row),
                    Rows::Array(rows) => {
                        format!(
                            "[{}]",
                            rows.iter().map(|row| writer.scalar(row)).collect::<Vec<_>>().join(", ")
                        )
                    }
                    Rows::Vector(dimension, rows) => writer.vector(rows, *dimension),
                })
            }
        }
    }

    /// `#[force(at = …)]` and the dimension of the place.
    pub fn target(&self, place: Option<(Place, usize)>) -> (String, usize) {
        let Some((Place { role, index }, dimension)) = place else {
            unreachable!("source: a force without a place to act at")
        };
        let element = match &self.system.roles[role] {
            Role::Chain { .. } => format!("[{index}]"),
            _ => String::new(),
        };
        (format!("#[force(at = place_{role}{element})]"), dimension)
    }
}

const Q_T: &str = "q: &Coordinates, t: f64";
const Q_V_T: &str = "q: &Coordinates, v: &Velocities, t: f64";
