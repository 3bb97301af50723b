//! Integers among the fields of the user's struct. The macro knows neither their values nor their types, and
//! formulas have no use for integers: what is computed of them is evaluated as the description writes it, up
//! to the conversion into a number.

use super::advice::counted_as_number;
use super::compare::is_comparison;
use super::interpreter::Interpreter;
use super::scalar;
use super::value::{ParameterId, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::syntax::body::{BinaryOperator, Expr, ExprKind, Owner, Path, UnaryOperator, Word};
use crate::syntax::types::TypeKind;

/// Methods that integers have as well as numbers of the scalar type.
const SHARED: [&str; 7] = ["abs", "signum", "min", "max", "clamp", "rem_euclid", "div_euclid"];

impl<'a> Interpreter<'a> {
    /// The value of an expression that is converted, or whose type is that of an integer. Operators on fields
    /// alone, such as `-self.n`, may be those of integers here.
    pub fn convertible(&mut self, expr: &'a Expr) -> Value {
        if !self.is_of_fields(expr) {
            return self.expression(expr);
        }
        let before = std::mem::replace(&mut self.parameters.as_written, true);
        let value = self.expression(expr);
        self.parameters.as_written = before;
        match value {
            // A number by which derivatives are taken is no integer, and its formula must be seen.
            Value::Parameter(id) if self.is_differentiated(id) => self.expression(expr),
            value => value,
        }
    }

    /// Whether an expression is made of fields and integers alone, by operators that integers have.
    fn is_of_fields(&mut self, expr: &'a Expr) -> bool {
        match &expr.kind {
            ExprKind::Integer(..) => true,
            ExprKind::Path(path) => self.is_field_or_integer(path),
            ExprKind::Unary(_, inner) | ExprKind::Field(inner, _) | ExprKind::Pointee(inner) => {
                self.is_of_fields(inner)
            }
            ExprKind::Binary(operator, left, right) => {
                !is_comparison(*operator) && self.is_of_fields(left) && self.is_of_fields(right)
            }
            ExprKind::Index(left, right) => self.is_of_fields(left) && self.is_of_fields(right),
            ExprKind::Cast(inner, ty) => matches!(ty.kind, TypeKind::Integer(_)) && self.is_of_fields(inner),
            ExprKind::Call(path, arguments) => {
                let is_of_integers =
                    matches!(&path.owner, Owner::Type(ty) if matches!(ty.kind, TypeKind::Integer(_)));
                is_of_integers && arguments.iter().all(|argument| self.is_of_fields(argument))
            }
            ExprKind::Method(call) => {
                let name = &*call.method.name;
                let is_of_numbers = scalar::METHODS.contains(&name) || scalar::REFUSED.contains(&name);
                (!is_of_numbers || SHARED.contains(&name))
                    && call.generic.is_none()
                    && !Self::is_self(&call.receiver)
                    && self.is_of_fields(&call.receiver)
                    && call.arguments.iter().all(|argument| self.is_of_fields(argument))
            }
            _ => false,
        }
    }

    fn is_field_or_integer(&mut self, path: &'a Path) -> bool {
        let is_either = |value: &Value| matches!(value, Value::Parameter(_) | Value::Integer(..));
        match &path.owner {
            Owner::None => match self.scope.get(&path.last) {
                Some(value) => is_either(value),
                None => &*path.last == "self" || super::path::is_constant_name(&path.last),
            },
            Owner::SelfType => match self.associated_constant(&path.last) {
                Some(value) => is_either(&value),
                None => super::path::is_constant_name(&path.last),
            },
            Owner::Other(_) => super::path::is_constant_name(&path.last),
            Owner::Type(_) | Owner::Local(_) => false,
        }
    }

    /// Whether derivatives are taken by a field in the text of a parameter.
    fn is_differentiated(&self, id: ParameterId) -> bool {
        let text = self.parameters.text(id);
        let names = |part: &str| {
            text.match_indices(part).any(|(start, _)| {
                !text[start + part.len()..].starts_with(|next: char| next.is_alphanumeric() || next == '_')
            })
        };
        self.item.sensitivities.iter().any(|parameter| root(parameter).is_some_and(|root| names(&root)))
    }

    /// `-x` or `!x` of a parameter.
    pub fn unary_of_parameter(&mut self, operator: UnaryOperator, id: ParameterId, origin: Origin) -> Value {
        let sign = operator.sign();
        if self.parameters.as_written || self.parameters.is_integer(id) {
            let text = format!("({sign}{})", self.parameters.text(id));
            return self.computed(text, id, self.parameters.is_integer(id), origin);
        }
        match operator {
            UnaryOperator::Negate => match self.scalar_parameter(id, origin) {
                Some(node) => Value::scalar(self.graph().neg(node)),
                None => Value::Unknown,
            },
            UnaryOperator::Not => {
                self.refuse(origin, catalogue::bad_operand(sign, Value::Parameter(id).describe()))
            }
        }
    }

    /// An operator on integers of which one is a parameter. An integer beside a field makes it an integer:
    /// where the result is taken for a number, the integer is the mistake.
    pub fn of_integers(
        &mut self,
        operator: BinaryOperator,
        [left, right]: [&Value; 2],
        written: Option<[&'a Expr; 2]>,
        origin: Origin,
    ) -> Option<Value> {
        let sign = match operator {
            BinaryOperator::Add => "+",
            BinaryOperator::Subtract => "-",
            BinaryOperator::Multiply => "*",
            BinaryOperator::Divide => "/",
            BinaryOperator::Remainder => "%",
            _ => return None,
        };
        let (id, literal) = match (left, right) {
            (Value::Parameter(id), Value::Parameter(_)) => (*id, None),
            (Value::Parameter(id), Value::Integer(value, _)) => (*id, Some((*value, 1))),
            (Value::Integer(value, _), Value::Parameter(id)) => (*id, Some((*value, 0))),
            _ => return None,
        };
        let is_integer = literal.is_some() || [left, right].into_iter().any(|value| self.is_integer(value));
        if !is_integer && !self.parameters.as_written {
            return None;
        }
        let text = format!("({} {sign} {})", self.operand(left)?, self.operand(right)?);
        let value = self.computed(text, id, is_integer, origin);
        if let (Some((number, side)), Value::Parameter(result)) = (literal, &value) {
            let (place, message) = match (operator, written) {
                (BinaryOperator::Remainder, _) => (origin, catalogue::remainder()),
                (BinaryOperator::Divide, Some(written)) => {
                    let quotient = self.parameters.text(*result);
                    let message = catalogue::integer_in_quotient(number, quotient, self.float());
                    (written[side].origin, message)
                }
                (_, Some(written)) => counted_as_number(number, written[side], self.float()),
                (_, None) => (origin, catalogue::integer_for_scalar(number)),
            };
            self.parameters.note_integer(*result, Some((place, message)));
        }
        Some(value)
    }

    /// A method that a description calls on a parameter, as it stands.
    pub fn method_as_written(
        &mut self,
        id: ParameterId,
        word: &Word,
        arguments: &[Value],
        origin: Origin,
    ) -> Option<Value> {
        let is_integer = self.parameters.is_integer(id);
        if !is_integer && !self.parameters.as_written {
            return None;
        }
        let arguments: Option<Vec<String>> =
            arguments.iter().map(|argument| self.operand(argument)).collect();
        let text = format!("{}.{}({})", self.parameters.text(id), word.name, arguments?.join(", "));
        Some(self.computed(text, id, is_integer, origin))
    }

    /// `i64::from(self.n)` and other functions of a type of integers; `f64::from(self.n)` in a description of
    /// another scalar.
    pub fn function_of_fields(&mut self, path: &Path, arguments: &[Value], origin: Origin) -> Option<Value> {
        let is_integer = match &path.owner {
            Owner::Type(ty) if matches!(ty.kind, TypeKind::Integer(_)) => true,
            Owner::Type(ty) if matches!(ty.kind, TypeKind::Scalar | TypeKind::OtherFloat) => {
                if *path.code == format!("{}::from", self.item.scalar) || &*path.last != "from" {
                    return None;
                }
                false
            }
            _ => return None,
        };
        let id = arguments.iter().find_map(|argument| match argument {
            Value::Parameter(id) => Some(*id),
            _ => None,
        })?;
        let arguments: Option<Vec<String>> =
            arguments.iter().map(|argument| self.operand(argument)).collect();
        let text = format!("{}({})", path.code, arguments?.join(", "));
        Some(self.computed(text, id, is_integer, origin))
    }

    /// Whether a value is an integer whose value only the running program knows.
    pub fn is_integer(&self, value: &Value) -> bool {
        matches!(value, Value::Parameter(id) if self.parameters.is_integer(*id))
    }

    /// A parameter whose type the description tells: an integer.
    pub fn known_integer(&mut self, id: ParameterId) -> Value {
        self.parameters.note_integer(id, None);
        Value::Parameter(id)
    }

    /// Reports an integer where a number of the scalar type is needed.
    pub fn refuses_integer(&mut self, id: ParameterId, origin: Origin) -> bool {
        let is_integer = self.parameters.is_integer(id);
        if is_integer {
            let known = || (origin, catalogue::integer_variable(self.parameters.text(id), self.float()));
            let (place, message) = self.parameters.mistake(id).unwrap_or_else(known);
            self.report(place, message);
        }
        is_integer
    }

    fn computed(&mut self, text: String, from: ParameterId, is_integer: bool, origin: Origin) -> Value {
        let label = self.parameters.label(from).to_owned();
        let id = self.parameters.intern(text, label, origin);
        if is_integer { self.known_integer(id) } else { Value::Parameter(id) }
    }

    /// A parameter or an integer as Rust text.
    fn operand(&self, value: &Value) -> Option<String> {
        match value {
            Value::Parameter(id) => Some(self.parameters.text(*id).to_owned()),
            Value::Integer(value, _) if *value < 0 => Some(format!("({value})")),
            Value::Integer(value, _) => Some(value.to_string()),
            _ => None,
        }
    }
}

/// The field or the constant that a path begins with, as the text of a parameter.
fn root(expr: &Expr) -> Option<String> {
    match &expr.kind {
        ExprKind::Path(path) => Some(path.code.to_string()),
        ExprKind::Field(base, word) => match &base.kind {
            ExprKind::Path(path) if &*path.last == "self" => Some(format!("self.{}", word.name)),
            _ => root(base),
        },
        ExprKind::Index(base, _) | ExprKind::Pointee(base) => root(base),
        _ => None,
    }
}
