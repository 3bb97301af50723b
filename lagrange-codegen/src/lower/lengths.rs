//! Const parameters of helpers: counts that follow from the arguments of a call.

use super::interpreter::Interpreter;
use super::shape::Shape;
use super::value::Value;
use crate::diagnostics::{Origin, catalogue};
use crate::syntax::Function;
use crate::syntax::body::{Expr, ExprKind, Name, Owner};
use crate::syntax::hygiene::written;
use crate::syntax::types::{Type, TypeKind};

/// The const parameters of a call with their values.
pub type Lengths = Vec<(Name, usize)>;

impl<'a> Interpreter<'a> {
    /// The const parameters of a function for some arguments. Those that do not follow are reported.
    pub fn lengths(
        &mut self,
        function: &'a Function,
        arguments: &[Value],
        origin: Origin,
    ) -> Option<Lengths> {
        let mut lengths = Lengths::new();
        for (parameter, argument) in function.parameters.iter().zip(arguments) {
            collect(&function.lengths, &parameter.ty, argument, &mut lengths);
        }
        let unknown = function.lengths.iter().find(|name| lengths.iter().all(|(known, _)| known != *name));
        if let Some(unknown) = unknown {
            self.report(origin, catalogue::unknown_length(unknown, &function.name));
            return None;
        }
        Some(lengths)
    }

    /// The shapes of the parameters of a function.
    pub fn parameter_shapes(&mut self, function: &'a Function, lengths: &Lengths) -> Vec<Shape> {
        let mark = self.scope.enter();
        self.bind_lengths(lengths);
        let shapes = function.parameters.iter().map(|parameter| self.shape(&parameter.ty)).collect();
        self.scope.leave(mark);
        shapes
    }

    /// Makes the const parameters of a call constants of the function.
    pub fn bind_lengths(&mut self, lengths: &Lengths) {
        for (name, length) in lengths {
            self.scope.bind_item(name.clone(), Value::index(*length));
        }
    }
}

/// Adds what an argument tells of the const parameters `names` in its type.
fn collect(names: &[Name], ty: &Type, argument: &Value, lengths: &mut Lengths) {
    let mut note = |length: &Expr, count: usize| {
        if let ExprKind::Path(path) = &length.kind
            && matches!(path.owner, Owner::None)
            && let Some(name) = names.iter().find(|name| ***name == *written(&path.last))
            && lengths.iter().all(|(known, _)| known != name)
        {
            lengths.push((name.clone(), count));
        }
    };
    match (&ty.kind, argument) {
        (TypeKind::Vector(length), Value::Vector(nodes)) => note(length, nodes.len()),
        (TypeKind::Matrix(rows, columns), Value::Vector(nodes)) => {
            note(rows, nodes.len());
            note(columns, 1);
        }
        (TypeKind::Matrix(rows, columns), Value::Matrix(matrix)) => {
            note(rows, matrix.rows);
            note(columns, matrix.columns);
        }
        (TypeKind::Array(element, length), Value::Array(elements)) => {
            note(length, elements.len());
            elements.iter().for_each(|argument| collect(names, element, argument, lengths));
        }
        (TypeKind::Slice(element), Value::Array(elements)) => {
            elements.iter().for_each(|argument| collect(names, element, argument, lengths));
        }
        (TypeKind::Tuple(types), Value::Tuple(elements)) => {
            let pairs = types.iter().zip(elements.iter());
            pairs.for_each(|(ty, argument)| collect(names, ty, argument, lengths));
        }
        _ => {}
    }
}
