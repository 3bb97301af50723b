//! Results of role functions into the [`crate::model::Model`]: particles, bodies, energies.

use super::advice::counted;
use super::interpreter::Interpreter;
use super::shape::Shape;
use super::value::{Turn, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{NodeId, Variable};
use crate::model::{Attitude, Body, ConstraintKind, Point, Rotation, Term};
use crate::number::Number;
use crate::syntax::Record;
use crate::syntax::body::{Expr, ExprKind};
use crate::syntax::item::{Argument, Function, RoleKind};
use crate::syntax::returns;

/// Something in the plane or in space where forces can act.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The function, with an index if it returns an array.
    pub name: String,
    /// The position of the particle or of the centre of mass.
    pub position: Vec<NodeId>,
    /// The orientation of a body.
    pub turn: Option<Turn>,
}

impl<'a> Interpreter<'a> {
    /// Lowers all role functions, forces and frictions after what they act on or depend on, and then what the
    /// attribute and calls of velocities ask for.
    pub fn roles(&mut self) {
        let item = self.item;
        for (index, function) in item.functions.iter().enumerate() {
            let Some(role) = &function.role else { continue };
            match &role.kind {
                RoleKind::Point { mass } => self.point(index, mass),
                RoleKind::Body { mass, inertia } => self.body(index, mass, inertia),
                RoleKind::Kinetic => self.energy(index, |model| &mut model.kinetic),
                RoleKind::Potential => self.energy(index, |model| &mut model.potential),
                RoleKind::Lagrangian => self.energy(index, |model| &mut model.lagrangian),
                RoleKind::Dissipation => self.energy(index, |model| &mut model.dissipation),
                RoleKind::Holonomic { eliminate } => {
                    self.constraint(index, ConstraintKind::Holonomic, eliminate.as_ref());
                }
                RoleKind::Nonholonomic { chetaev } => {
                    self.constraint(index, ConstraintKind::Nonholonomic { chetaev: *chetaev }, None);
                }
                RoleKind::Unilateral { restitution, poisson } => {
                    self.gap(index, restitution.as_ref(), *poisson);
                }
                RoleKind::Event => self.energy(index, |model| &mut model.events),
                RoleKind::Force(_) | RoleKind::Friction(_) => {}
            }
        }
        for (index, function) in item.functions.iter().enumerate() {
            if let Some(RoleKind::Force(target)) = function.role.as_ref().map(|role| &role.kind) {
                self.force(index, target);
            }
        }
        self.places();
        self.frictions();
        if let Some(rate) = &item.baumgarte {
            self.baumgarte(rate);
        }
        self.sensitivities();
        self.velocities();
        self.readings();
    }

    /// The result of a role function; `None` if its signature is wrong or its value is unknown, which is
    /// reported.
    pub fn result(&mut self, index: usize) -> Option<Value> {
        let function: &'a Function = &self.item.functions[index];
        let arguments = self.role_arguments(index)?;
        let value = self.call(index, arguments, function.origin);
        self.hint(&value, &function.name);
        (!value.is_unknown()).then_some(value)
    }

    /// The arguments that a role function is called with; `None` if it takes what no role passes.
    pub fn role_arguments(&mut self, index: usize) -> Option<Vec<Value>> {
        let function: &'a Function = &self.item.functions[index];
        let mut arguments = Vec::with_capacity(function.parameters.len());
        for parameter in &function.parameters {
            arguments.push(match parameter.argument? {
                // Missing inputs have had their message.
                Argument::Record(Record::Inputs) if self.item.inputs.is_empty() => Value::Unknown,
                Argument::Record(record) => Value::Record(record),
                Argument::Time => Value::scalar(self.graph().variable(Variable::Time)),
            });
        }
        Some(arguments)
    }

    /// The declared return shape.
    pub fn declared(&mut self, function: &'a Function) -> Shape {
        function.output.as_ref().map_or(Shape::Unit, |ty| self.shape(ty))
    }

    /// Reports a result of the wrong shape.
    pub fn wrong_return(&mut self, function: &'a Function, shape: &Shape) {
        if let Some(role) = &function.role {
            let described = match shape {
                Shape::Any => "a type that the macro does not know".to_string(),
                known => known.describe(),
            };
            let message = catalogue::wrong_return(&function.name, returns(&role.kind), described);
            self.refuse_return(function, message);
        }
    }

    /// Reports a return type, and refuses calls of the function from then on.
    pub fn refuse_return(&mut self, function: &'a Function, message: String) {
        let origin = function.output.as_ref().map_or(function.origin, |ty| ty.origin);
        self.report(origin, message);
        self.misshapen.extend(self.item.functions.iter().position(|other| other.name == function.name));
    }

    fn energy(&mut self, index: usize, target: impl Fn(&mut crate::model::Model) -> &mut Vec<Term>) {
        let function: &'a Function = &self.item.functions[index];
        let shape = self.declared(function);
        if function.output.is_some() && shape != Shape::Scalar {
            return self.wrong_return(function, &shape);
        }
        if let Some(Value::Scalar(value, ..)) = self.result(index)
            && !self.looks_into_self(&[value])
        {
            let term = Term { name: function.name.to_string(), value, origin: function.origin };
            target(&mut self.model).push(term);
        }
    }

    fn point(&mut self, index: usize, mass: &'a Expr) {
        let function: &'a Function = &self.item.functions[index];
        let shape = self.declared(function);
        let (single, count) = match &shape {
            Shape::Array(element, length) => (&**element, Some(*length)),
            single => (single, None),
        };
        if !matches!(single, Shape::Scalar | Shape::Vector(1..=3) | Shape::Point(1..=3)) {
            return self.wrong_return(function, &shape);
        }
        let masses = self.masses(mass, count, "mass");
        let Some(value) = self.result(index) else { return };
        let places = self.placed(&function.name, &value);
        let Some(masses) = masses else { return };
        if places.iter().any(|place| self.looks_into_self(&place.position)) {
            return;
        }
        for (place, mass) in places.into_iter().zip(masses) {
            let Placed { name, position, .. } = place;
            self.model.points.push(Point { name, mass, position, origin: function.origin });
        }
    }

    fn body(&mut self, index: usize, mass: &'a Expr, inertia: &'a Expr) {
        let function: &'a Function = &self.item.functions[index];
        let shape = self.declared(function);
        let (single, count) = match &shape {
            Shape::Array(element, length) => (&**element, Some(*length)),
            single => (single, None),
        };
        let dimension = match single {
            Shape::Isometry(dimension) => *dimension,
            Shape::Tuple(parts) => match parts.as_slice() {
                [Shape::Vector(2) | Shape::Point(2), Shape::Scalar | Shape::Rotation(2)] => 2,
                [Shape::Vector(3) | Shape::Point(3), Shape::Rotation(3) | Shape::Quaternion] => 3,
                _ => return self.wrong_return(function, &shape),
            },
            _ => return self.wrong_return(function, &shape),
        };
        let masses = self.masses(mass, count, "mass");
        let scalar_inertias = if dimension == 2 { self.moments(inertia, count) } else { None };
        let tensors = if dimension == 3 { self.tensors(inertia, count) } else { None };
        let Some(value) = self.result(index) else { return };
        let places = self.placed(&function.name, &value);
        let Some(masses) = masses else { return };
        if places.iter().any(|place| self.looks_into_self(&place.position)) {
            return;
        }
        for (number, (place, mass)) in places.into_iter().zip(masses).enumerate() {
            let attitude = match (place.turn, &scalar_inertias, &tensors) {
                (Some(Turn::Plane(angle)), Some(inertias), _) => {
                    Attitude::Planar { angle, inertia: inertias[number] }
                }
                (Some(Turn::Space(rotation)), _, Some(tensors)) => {
                    Attitude::Spatial { rotation: Rotation::clone(&rotation), inertia: tensors[number] }
                }
                _ => return,
            };
            let Placed { name, position, .. } = Placed { turn: None, ..place };
            self.model.bodies.push(Body { name, mass, position, attitude, origin: function.origin });
        }
    }

    /// The particles or bodies that a function returns.
    pub fn placed(&mut self, name: &str, value: &Value) -> Vec<Placed> {
        match value {
            Value::Array(elements) => elements
                .iter()
                .enumerate()
                .flat_map(|(index, element)| self.placed(&format!("{name}[{index}]"), element))
                .collect(),
            Value::Scalar(..) | Value::Vector(_) | Value::Point(_) => {
                vec![Placed { name: name.into(), position: value.nodes().to_vec(), turn: None }]
            }
            Value::Isometry(shift, turn) => {
                vec![Placed { name: name.into(), position: shift.to_vec(), turn: Some(turn.clone()) }]
            }
            Value::Tuple(parts) => match parts.as_slice() {
                [Value::Vector(shift) | Value::Point(shift), turn] => {
                    let turn = match turn {
                        Value::Scalar(angle, ..) => Some(Turn::Plane(*angle)),
                        Value::Rotation(turn) => Some(turn.clone()),
                        _ => None,
                    };
                    vec![Placed { name: name.into(), position: shift.to_vec(), turn }]
                }
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    }

    /// The value of an attribute argument, in which only `self` is in sight.
    pub fn attribute(&mut self, expr: &'a Expr) -> Value {
        let mark = self.scope.enter();
        self.in_attribute = true;
        let value = self.expression(expr);
        self.in_attribute = false;
        self.scope.leave(mark);
        value
    }

    /// One scalar for each of `count` particles.
    fn masses(&mut self, expr: &'a Expr, count: Option<usize>, what: &str) -> Option<Vec<NodeId>> {
        let value = self.attribute(expr);
        let values = self.distributed(expr, value, count, what)?;
        let mut masses = Vec::with_capacity(values.len());
        for value in values {
            masses.push(self.scalar(value, expr.origin)?);
        }
        Some(masses)
    }

    /// One value for all, or one for each.
    pub fn distributed(
        &mut self,
        expr: &'a Expr,
        value: Value,
        count: Option<usize>,
        what: &str,
    ) -> Option<Vec<Value>> {
        let whole = matches!(&expr.kind, ExprKind::Index(_, index) if Self::is_whole(index));
        match (value, count) {
            (Value::Unknown, _) => None,
            (Value::Parameter(id), Some(count)) if whole => {
                Some(self.parameter_elements(id, count, expr.origin))
            }
            (Value::Array(elements), Some(count)) if elements.len() == count => Some(elements.to_vec()),
            (Value::Array(elements), Some(count)) => {
                self.report(
                    expr.origin,
                    catalogue::wrong_number_of(
                        what,
                        counted(count, "element"),
                        counted(elements.len(), "value"),
                    ),
                );
                None
            }
            (value @ (Value::Array(_) | Value::Parameter(_)), None)
                if whole || matches!(value, Value::Array(_)) =>
            {
                self.report(expr.origin, catalogue::array_for_single(what));
                None
            }
            (value, count) => Some(vec![value; count.unwrap_or(1)]),
        }
    }

    /// One inertia tensor for each of `count` bodies.
    fn tensors(&mut self, expr: &'a Expr, count: Option<usize>) -> Option<Vec<[[NodeId; 3]; 3]>> {
        let value = self.attribute(expr);
        let single = match &value {
            Value::Array(elements) => {
                (elements.len() == 3 || count.is_none())
                    && elements
                        .iter()
                        .all(|e| matches!(e, Value::Scalar(..) | Value::Parameter(_) | Value::Integer(..)))
            }
            _ => false,
        };
        let values = match single {
            true => vec![value; count.unwrap_or(1)],
            false => self.distributed(expr, value, count, "inertia")?,
        };
        let mut tensors = Vec::with_capacity(values.len());
        for value in values {
            tensors.push(self.tensor(value, expr.origin)?);
        }
        Some(tensors)
    }

    fn tensor(&mut self, value: Value, origin: Origin) -> Option<[[NodeId; 3]; 3]> {
        let moments = match value {
            Value::Matrix(matrix) if matrix.rows == 3 && matrix.columns == 3 => {
                let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix.at(row, column)));
                return self.symmetric(rows, origin);
            }
            Value::Parameter(id) => {
                let crate_path = self.crate_text();
                let inner = self.parameters.text(id);
                let call = format!("{crate_path}::__private::PrincipalMoments::principal_moments(&{inner})");
                let label = self.parameters.label(id).to_string();
                let call = self.parameters.intern(call, label, origin);
                let moments = Value::Parameter(call);
                self.vector(moments, 3, origin)?
            }
            Value::Array(elements) if elements.len() == 3 => {
                self.vector(Value::Array(elements), 3, origin)?
            }
            Value::Vector(nodes) if nodes.len() == 3 => nodes,
            Value::Unknown => return None,
            other => {
                self.report(origin, catalogue::wrong_inertia(other.describe()));
                return None;
            }
        };
        let zero = self.graph().zero();
        let mut tensor = [[zero; 3]; 3];
        for (axis, row) in tensor.iter_mut().enumerate() {
            row[axis] = moments[axis];
        }
        Some(tensor)
    }

    /// A tensor as the energy ½ ω·I ω knows it: by its symmetric part. Constants that differ are a mistake.
    fn symmetric(&mut self, rows: [[NodeId; 3]; 3], origin: Origin) -> Option<[[NodeId; 3]; 3]> {
        let mut tensor = rows;
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let (above, below) = (rows[i][j], rows[j][i]);
            if above == below {
                continue;
            }
            let graph = self.graph();
            if graph.as_constant(above).is_some() && graph.as_constant(below).is_some() {
                self.report(origin, catalogue::asymmetric_inertia());
                return None;
            }
            let half = Number::Ratio(1, 2);
            let middle = graph.sum(Number::ZERO, &[(above, half), (below, half)]);
            (tensor[i][j], tensor[j][i]) = (middle, middle);
        }
        Some(tensor)
    }

    /// One moment of inertia for each of `count` bodies in the plane.
    fn moments(&mut self, expr: &'a Expr, count: Option<usize>) -> Option<Vec<NodeId>> {
        if count.is_none() && matches!(expr.kind, ExprKind::Array(_)) {
            self.report(expr.origin, catalogue::moments_in_the_plane());
            return None;
        }
        self.masses(expr, count, "inertia")
    }

    /// The number of scalar coordinates or inputs.
    pub fn size(&self, record: Record) -> usize {
        match record {
            Record::Coordinates | Record::Velocities => self.model.coordinates.len(),
            Record::Inputs => self.model.inputs.len(),
        }
    }
}
