//! Messages that need to know what is in sight: what the user probably meant, in the user's words.

use super::interpreter::Interpreter;
use super::scalar;
use super::value::Value;
use crate::collections::Lookup;
use crate::diagnostics::{Origin, catalogue};
use crate::expr::{Dependence, Node, NodeId, Variable};
use crate::syntax::body::{BinaryOperator, Expr, ExprKind, Name, Owner, Path};
use crate::syntax::hygiene::written as written_name;
use crate::syntax::item::{Argument, RoleKind};
use crate::syntax::suggest::in_rust;
use crate::syntax::{Group, Record, Scalar, refused};

impl<'a> Interpreter<'a> {
    /// A name that is no variable.
    pub fn unknown_name(&mut self, path: &'a Path) -> Value {
        if self.scope.other_context(&path.last) {
            return self.refuse(path.origin, catalogue::other_context(written_name(&path.last)));
        }
        let name = written_name(&path.last);
        let declared = self.declared_as(name);
        if self.in_attribute && (declared.is_some() || matches!(name, "q" | "v" | "t" | "u")) {
            return self.refuse(path.origin, catalogue::attribute_depends_on(name));
        }
        if let Some((record, kind)) = declared {
            let holder = self.holder(record);
            let message = match self.scope.find(&holder) {
                Some(_) => catalogue::bare_quantity(kind, name, format!("{holder}.{name}")),
                None => {
                    let parameter = format!("{holder}: {}", self.record_type(record));
                    catalogue::quantity_without_parameter(kind, name, parameter, format!("{holder}.{name}"))
                }
            };
            return self.refuse(path.origin, message);
        }
        let argument = match name {
            "q" => Some(Argument::Record(Record::Coordinates)),
            "v" => Some(Argument::Record(Record::Velocities)),
            "u" => Some(Argument::Record(Record::Inputs)),
            "t" => Some(Argument::Time),
            _ => None,
        };
        let message = match argument {
            Some(argument) => self.missing_argument(name, argument),
            None => catalogue::unknown_variable(name, self.near(name, &self.scope.names())),
        };
        self.refuse(path.origin, message)
    }

    fn missing_argument(&self, name: &str, argument: Argument) -> String {
        let item = self.item;
        let role = self.calls.last().and_then(|&index| item.functions[index].role.as_ref());
        if let Some(message) = role.and_then(|role| refused(&role.kind, argument)) {
            return message;
        }
        match argument {
            Argument::Record(Record::Inputs) if item.inputs.is_empty() => catalogue::no_inputs(),
            Argument::Record(record) => catalogue::missing_parameter(name, self.record_type(record)),
            Argument::Time => catalogue::missing_parameter(name, &item.scalar),
        }
    }

    fn record_type(&self, record: Record) -> String {
        match &self.item.scalar {
            Scalar::F64 => format!("&{}", record.name()),
            scalar => format!("&{}<{scalar}>", record.name()),
        }
    }

    /// Whether a name is declared in the attribute, and as what.
    fn declared_as(&self, name: &str) -> Option<(Record, &'static str)> {
        let among = |groups: &[Group]| groups.iter().any(|group| *group.name() == *name);
        match (among(&self.item.coordinates), among(&self.item.inputs)) {
            (true, _) => Some((Record::Coordinates, "a coordinate")),
            (_, true) => Some((Record::Inputs, "an input")),
            _ => None,
        }
    }

    /// The variable that holds a record, or its usual name.
    fn holder(&self, record: Record) -> String {
        let usual = match record {
            Record::Coordinates => "q",
            Record::Velocities => "v",
            Record::Inputs => "u",
        };
        let holds = |name: &str| matches!(self.scope.get(name), Some(Value::Record(own)) if *own == record);
        let names = self.scope.names();
        let found = names.iter().find(|name| holds(name));
        found.map_or_else(|| usual.to_string(), |name| name.to_string())
    }

    /// The message about a record, such as `q`, where one of its fields is meant.
    pub fn record_as_value(&self, record: Record) -> String {
        let holder = self.holder(record);
        let (groups, kind) = match record {
            Record::Coordinates => (&self.item.coordinates, "coordinates"),
            Record::Velocities => (&self.item.coordinates, "velocities"),
            Record::Inputs => (&self.item.inputs, "inputs"),
        };
        let field = groups.first().map_or_else(String::new, |group| {
            let index = if group.length.is_some() { "[0]" } else { "" };
            format!("{holder}.{}{index}", group.name())
        });
        catalogue::record_as_value(holder, kind, field)
    }

    /// Reports fields of `self` with the name of a coordinate or an input, if a result depends on no
    /// coordinate and no velocity: the user then means these. Beside coordinates such a field is as good as
    /// any other.
    pub fn looks_into_self(&mut self, nodes: &[NodeId]) -> bool {
        let moves = Dependence::COORDINATES.union(Dependence::VELOCITIES);
        let moving = nodes.iter().any(|&node| self.model.graph.dependence(node).meets(moves));
        if moving || self.item.allows("no_effect") {
            return false;
        }
        let mut stack = nodes.to_vec();
        let mut seen = Lookup::default();
        let mut found: Vec<(Origin, String)> = Vec::new();
        while let Some(node) = stack.pop() {
            if seen.insert(node, ()).is_some() {
                continue;
            }
            if let Node::Variable(Variable::Parameter(index)) = self.model.graph.node(node) {
                let parameter = &self.model.parameters[*index as usize];
                let field = parameter.path.strip_prefix("self.").unwrap_or_default();
                let name = field.split(['.', '[']).next().unwrap_or_default();
                if let Some((record, kind)) = self.declared_as(name) {
                    let usual = if record == Record::Inputs { "u" } else { "q" };
                    let message = catalogue::bare_quantity(kind, name, format!("{usual}.{field}"));
                    found.push((parameter.origin, message));
                }
            }
            self.model.graph.operands(node, |operand| stack.push(operand));
        }
        for (origin, message) in &found {
            self.report(*origin, message.clone());
        }
        !found.is_empty()
    }

    /// A call of a name that is no function of the block: `cos(x)`, `f(x)`.
    pub fn free_call(&mut self, path: &'a Path, arguments: &'a [Expr]) -> Value {
        let name = written_name(&path.last);
        match (self.scope.get(&path.last), arguments) {
            // A variable without a value has had its message.
            (Some(Value::Unknown), _) => Value::Unknown,
            (Some(_), _) => self.refuse(path.origin, catalogue::call_of_value()),
            // `square` and `modulus` are methods of nalgebra alone. A free function of that name is the
            // user's own.
            (None, [receiver, rest @ ..])
                if scalar::METHODS.contains(&name) && !matches!(name, "square" | "modulus") =>
            {
                // Where other languages have a function of the same name and other arguments.
                let method = match (name, rest) {
                    ("log", []) => "ln",
                    ("atan", [_]) => "atan2",
                    _ => name,
                };
                let call = call_of(method, receiver, rest);
                self.refuse(path.origin, catalogue::function_as_method(name, call))
            }
            (None, [_, ..]) if scalar::REFUSED.contains(&name) => {
                self.refuse(path.origin, catalogue::not_smooth(name, scalar::alternative(name)))
            }
            (None, _) if name.starts_with(char::is_uppercase) => {
                self.refuse(path.origin, catalogue::foreign_value(name))
            }
            (None, _) => match in_rust(name, &scalar::METHODS).zip(arguments.split_first()) {
                Some((methods, (receiver, rest))) => {
                    let is_whole = matches!(rest, [Expr { kind: ExprKind::Integer(..), .. }]);
                    let method = if is_whole { methods.first() } else { methods.last() };
                    let call = call_of(method.unwrap_or(&name), receiver, rest);
                    self.refuse(path.origin, catalogue::function_elsewhere(name, call))
                }
                None => self.refuse(path.origin, catalogue::free_function(name)),
            },
        }
    }

    /// The coordinate that a name such as `theta_dot` or `dx` means the velocity of.
    pub fn differentiated(&self, name: &str) -> Option<Name> {
        let means = |coordinate: &str| {
            let before = name.strip_suffix(coordinate).is_some_and(|rest| matches!(rest, "d" | "d_"));
            let behind = name.strip_prefix(coordinate).is_some_and(|rest| {
                matches!(
                    rest.trim_start_matches('_'),
                    "d" | "dot" | "dt" | "prime" | "rate" | "vel" | "velocity"
                )
            });
            before || behind
        };
        self.item.coordinates.iter().map(|group| group.name()).find(|coordinate| means(coordinate))
    }

    /// The field that a scalar is made of, if its expression is small and has one field only.
    pub fn taken_for_scalar(&self, value: &Value) -> Option<String> {
        /// Nodes of a field, a constant and an operation or two.
        const SMALL: usize = 6;
        let Value::Scalar(node, _) = value else { return None };
        let cone = self.model.graph.cone([*node]);
        if cone.len() > SMALL {
            return None;
        }
        let mut fields = cone.into_iter().filter_map(|node| match self.model.graph.node(node) {
            Node::Variable(Variable::Parameter(index)) => {
                let path = &self.model.parameters[*index as usize].path;
                path.starts_with("self.").then(|| path.clone())
            }
            _ => None,
        });
        // With several fields it is unknown which of them is meant.
        fields.next().filter(|_| fields.next().is_none())
    }

    /// Reports an integer where a number of the scalar type is needed.
    pub fn integer_as_number(&mut self, value: i128, expr: &'a Expr) -> Value {
        let (place, message) = counted_as_number(value, expr, self.float());
        self.refuse(place, message)
    }

    /// The type that integers are converted into.
    pub fn float(&self) -> &'static str {
        match &self.item.scalar {
            Scalar::F32 => "f32",
            Scalar::F64 | Scalar::Generic(_) => "f64",
        }
    }

    /// The thing that must be smooth: the result of the role that is evaluated.
    pub fn smooth_thing(&self) -> &'static str {
        let role = self.calls.first().and_then(|&index| self.item.functions[index].role.as_ref());
        match role.map(|role| &role.kind) {
            Some(RoleKind::Force(_)) => "a force",
            Some(RoleKind::Point { .. } | RoleKind::Body { .. }) => "a position",
            Some(RoleKind::Dissipation) => "a dissipation function",
            Some(RoleKind::Holonomic { .. } | RoleKind::Nonholonomic { .. }) => "a constraint",
            Some(RoleKind::Unilateral { .. }) => "a gap",
            Some(RoleKind::Friction(_)) => "a slip velocity",
            Some(RoleKind::Event) => "an event function",
            Some(RoleKind::Kinetic | RoleKind::Potential | RoleKind::Lagrangian) | None => "a Lagrangian",
        }
    }
}

/// What is said of a constant integer where a number of the scalar type is needed, and where.
pub fn counted_as_number(value: i128, expr: &Expr, float: &str) -> (Origin, String) {
    let message = match &expr.kind {
        ExprKind::Binary(BinaryOperator::Divide, left, right) => {
            let real = |expr: &Expr| match &expr.kind {
                ExprKind::Integer(value, _) => format!("{value}.0"),
                _ => format!("{} as {float}", written(expr)),
            };
            catalogue::integer_quotient(real(left), real(right))
        }
        // A product may contain the quotient: `1 / 2 * 3`.
        ExprKind::Binary(BinaryOperator::Multiply, left, right) => {
            let is_quotient =
                |side: &&Expr| matches!(side.kind, ExprKind::Binary(BinaryOperator::Divide, ..));
            match [&**left, &**right].into_iter().find(is_quotient) {
                Some(quotient) => return counted_as_number(value, quotient, float),
                None => catalogue::integer_for_scalar(value),
            }
        }
        ExprKind::Path(path) => catalogue::integer_variable(&path.text, float),
        _ => catalogue::integer_for_scalar(value),
    };
    (expr.origin, message)
}

/// The call of a method for a function of the arguments.
fn call_of(method: &str, receiver: &Expr, rest: &[Expr]) -> String {
    let receiver = written(receiver);
    if method.contains('(') {
        return format!("{receiver}.{method}");
    }
    let rest: Vec<String> = rest.iter().map(written).collect();
    format!("{receiver}.{method}({})", rest.join(", "))
}

/// A short expression as Rust text.
fn written(expr: &Expr) -> String {
    match &expr.kind {
        ExprKind::Path(path) if matches!(path.owner, Owner::None | Owner::SelfType) => path.text.to_string(),
        ExprKind::Integer(value, _) => value.to_string(),
        ExprKind::Field(base, word) => format!("{}.{}", written(base), word.name),
        ExprKind::Index(base, index) => format!("{}[{}]", written(base), written(index)),
        _ => "(…)".to_string(),
    }
}

/// A number of things in words: `1 argument`, `2 arguments`.
pub fn counted(count: usize, what: &str) -> String {
    match count {
        0 => format!("no {what}s"),
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

/// The valid indices of an array in words.
pub fn valid_indices(length: usize) -> String {
    match length {
        0 => "there are no elements".to_string(),
        1 => "only 0 is valid".to_string(),
        _ => format!("valid are 0 to {}", length - 1),
    }
}

/// The valid indices of a matrix in words.
pub fn valid_entries(rows: usize, columns: usize) -> String {
    format!("valid are (0, 0) to ({}, {})", rows.saturating_sub(1), columns.saturating_sub(1))
}

/// A function called with a wrong number of arguments.
pub fn argument_count(name: &str, expected: usize, given: usize) -> String {
    let given = match given {
        0 => "none is".to_string(),
        1 => "1 is".to_string(),
        _ => format!("{given} are"),
    };
    catalogue::argument_count(name, counted(expected, "argument"), given)
}

/// Whether an integer is a mistake beside a value: Rust does not convert it.
pub fn meets_integer(operator: BinaryOperator, other: &Value) -> bool {
    match other {
        Value::Scalar(..) | Value::Vector(_) | Value::Matrix(_) => operator != BinaryOperator::Remainder,
        _ => false,
    }
}

/// The variables of a set, in words.
pub fn dependence_words(dependence: Dependence) -> String {
    let kinds = [
        (Dependence::COORDINATES, "`q`"),
        (Dependence::VELOCITIES, "`v`"),
        (Dependence::TIME, "`t`"),
        (Dependence::INPUTS, "`u`"),
        (Dependence::PARAMETERS, "a parameter"),
    ];
    let words: Vec<&str> =
        kinds.into_iter().filter(|(kind, _)| dependence.meets(*kind)).map(|(_, word)| word).collect();
    words.join(" and ")
}
