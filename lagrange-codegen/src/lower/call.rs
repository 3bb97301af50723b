//! Calls of functions of the impl block: inlined, each once for equal arguments.

use super::advice::{argument_count, counted};
use super::interpreter::Interpreter;
use super::lengths::Lengths;
use super::shape::Shape;
use super::value::{Callable, ClosureId, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::syntax::body::{Closure, Expr, ExprKind, Name, Owner, Path, Statement, Word};
use crate::syntax::velocity::SUFFIX;

impl<'a> Interpreter<'a> {
    /// `self.name(arguments)` or `Self::name(arguments)`; `with_self` tells whether `self` was
    /// given.
    pub fn call_helper(
        &mut self,
        word: &Word,
        arguments: Vec<Value>,
        with_self: bool,
        origin: Origin,
    ) -> Value {
        let item = self.item;
        let Some(index) = item.functions.iter().position(|function| function.name == word.name) else {
            if let Some(value) = self.velocity_call(word, &arguments, with_self, origin) {
                return value;
            }
            let own = item.functions.iter().map(|function| function.name.clone());
            let velocities =
                item.functions.iter().map(|function| format!("{}{SUFFIX}", function.name).into());
            let names: Vec<Name> = own.chain(velocities).collect();
            let near = self.near(&word.name, &names);
            return self.refuse(word.origin, catalogue::unknown_helper(&word.name, near));
        };
        let function = &item.functions[index];
        if function.receiver != with_self {
            let message = if with_self {
                catalogue::not_a_method(&word.name)
            } else {
                catalogue::needs_self(&word.name)
            };
            return self.refuse(word.origin, message);
        }
        self.call(index, arguments, origin)
    }

    /// The arguments for a function of the block, whose parameters tell their shapes.
    pub fn arguments(&mut self, name: &str, arguments: &'a [Expr]) -> Vec<Value> {
        let item = self.item;
        let function = item.functions.iter().find(|function| *function.name == *name);
        // Const parameters follow from the arguments, so the types say nothing before.
        let function = function.filter(|function| function.lengths.is_empty());
        let shapes = function.map(|function| self.parameter_shapes(function, &Lengths::new()));
        let shapes = shapes.unwrap_or_default();
        let mut values = Vec::with_capacity(arguments.len());
        for (position, argument) in arguments.iter().enumerate() {
            values.push(self.expression_as(argument, shapes.get(position).unwrap_or(&Shape::Any)));
        }
        values
    }

    /// The result of a function for some arguments, without `self`.
    pub fn call(&mut self, index: usize, arguments: Vec<Value>, origin: Origin) -> Value {
        let item = self.item;
        let function = &item.functions[index];
        if let Some(origin) = function.conditional {
            return self.refuse(origin, catalogue::conditional_code());
        }
        if arguments.iter().any(|argument| matches!(argument, Value::Closure(_))) {
            return self.refuse(origin, catalogue::closure_argument(&function.name));
        }
        // The refusal of its type is enough.
        if self.misshapen.contains(&index) {
            return Value::Unknown;
        }
        if arguments.len() != function.parameters.len() {
            let message = argument_count(&function.name, function.parameters.len(), arguments.len());
            return self.refuse(origin, message);
        }
        if self.calls.contains(&index) {
            let start = self.calls.iter().position(|&other| other == index).unwrap_or(0);
            let cycle: Vec<String> = self.calls[start..]
                .iter()
                .chain([&index])
                .map(|&i| item.functions[i].name.to_string())
                .collect();
            return self.refuse(origin, catalogue::recursion(cycle.join("` → `")));
        }
        let Some(lengths) = self.lengths(function, &arguments, origin) else { return Value::Unknown };
        let (shaped, key) = self.shaped(index, arguments, &lengths, origin);
        if let Some(value) = self.memo.get(&key) {
            return value.clone();
        }
        if !self.pay(origin) {
            self.stop();
            return Value::Unknown;
        }
        self.calls.push(index);
        let was_in_attribute = std::mem::replace(&mut self.in_attribute, false);
        let mark = self.scope.enter();
        let (later, lazy) = (std::mem::take(&mut self.later), self.lazy.take());
        self.bind_lengths(&lengths);
        for (argument, parameter) in shaped.into_iter().zip(&function.parameters) {
            self.bind(&parameter.pattern, argument);
        }
        let value = match &function.output {
            Some(ty) => {
                let shape = self.shape(ty);
                let body = |this: &mut Self| this.block_as(&function.body, &shape);
                let value = self.body_value(function.origin, &shape, body);
                match (&function.body.value, function.body.statements.last()) {
                    (Some(last), _) => self.coerce_of(value, &shape, last),
                    (None, Some(Statement::Expression(last)))
                        if matches!(value, Value::Unit) && shape != Shape::Unit && has_value(last) =>
                    {
                        self.refuse(last.origin, catalogue::trailing_semicolon(&function.name))
                    }
                    (None, _) => self.coerce(value, &shape, function.origin),
                }
            }
            None => self.body_value(function.origin, &Shape::Any, |this| this.block(&function.body)),
        };
        self.scope.leave(mark);
        (self.later, self.lazy) = (later, lazy);
        self.calls.pop();
        self.in_attribute = was_in_attribute;
        self.memo.insert(key, value.clone());
        value
    }

    /// The arguments of a call in the shapes that the function declares, and the key that its result is
    /// remembered by.
    pub fn shaped(
        &mut self,
        index: usize,
        arguments: Vec<Value>,
        lengths: &Lengths,
        origin: Origin,
    ) -> (Vec<Value>, (usize, Vec<u64>)) {
        let shapes = self.parameter_shapes(&self.item.functions[index], lengths);
        let pairs = arguments.into_iter().zip(&shapes);
        let shaped: Vec<Value> =
            pairs.map(|(argument, shape)| self.coerce(argument, shape, origin)).collect();
        let mut key = Vec::new();
        shaped.iter().for_each(|argument| argument.fingerprint(&mut key));
        (shaped, (index, key))
    }

    /// An argument that is called: a closure or the path of a function.
    pub fn callable(&mut self, expr: &'a Expr) -> Option<Callable<'a>> {
        match &expr.kind {
            ExprKind::Closure(closure) => Some(Callable::Closure(closure)),
            ExprKind::Path(path) => Some(Callable::Path(path)),
            _ => {
                self.report(expr.origin, catalogue::closure_expected());
                None
            }
        }
    }

    /// Calls a closure of a lazy iterator. When it runs, and how often, is unknown, so it may not assign to
    /// variables outside.
    pub fn apply_later(&mut self, callable: Callable<'a>, arguments: Vec<Value>, origin: Origin) -> Value {
        let inside = self.scope.length();
        let outer = self.lazy.replace(inside);
        let value = self.apply(callable, arguments, origin);
        self.lazy = outer;
        value
    }

    /// A closure in a variable. Wherever it is called, it sees the variables that are in sight here.
    pub fn stored(&mut self, closure: &'a Closure, origin: Origin) -> Value {
        if closure.is_move {
            return self.refuse(origin, catalogue::moving_closure());
        }
        self.kept(Callable::Closure(closure))
    }

    /// A function in a variable.
    pub fn kept(&mut self, callable: Callable<'a>) -> Value {
        self.closures.push((callable, self.scope.view()));
        Value::Closure(ClosureId(self.closures.len() - 1))
    }

    /// The closure that a path names, if it is a variable that holds one.
    pub fn closure_of(&self, path: &Path) -> Option<ClosureId> {
        match (&path.owner, self.scope.get(&path.last)) {
            (Owner::None, Some(Value::Closure(id))) => Some(*id),
            _ => None,
        }
    }

    /// Calls a closure from a variable.
    pub fn apply_stored(&mut self, id: ClosureId, arguments: Vec<Value>, origin: Origin) -> Value {
        let (callable, view) = self.closures[id.0].clone();
        let Some(here) = self.scope.look(&view) else {
            return self.refuse(origin, catalogue::escaped_closure());
        };
        let value = self.apply(callable, arguments, origin);
        self.scope.look_back(here);
        value
    }

    /// Calls a closure or a function.
    pub fn apply(&mut self, callable: Callable<'a>, arguments: Vec<Value>, origin: Origin) -> Value {
        match callable {
            Callable::Path(path) => self.call_values(path, arguments, origin),
            Callable::Closure(closure) => {
                if closure.parameters.len() != arguments.len() {
                    let message = catalogue::closure_arguments(
                        counted(arguments.len(), "argument"),
                        closure.parameters.len(),
                    );
                    return self.refuse(origin, message);
                }
                if !self.pay(origin) {
                    self.stop();
                    return Value::Unknown;
                }
                let mark = self.scope.mark();
                for (pattern, argument) in closure.parameters.iter().zip(arguments) {
                    self.bind(pattern, argument);
                }
                let value = self.body_value(origin, &Shape::Any, |this| this.expression(&closure.body));
                self.scope.leave(mark);
                value
            }
        }
    }
}

/// Whether an expression has a value that a semicolon throws away.
fn has_value(expr: &Expr) -> bool {
    matches!(
        expr.kind,
        ExprKind::Float(_)
            | ExprKind::Integer(..)
            | ExprKind::Path(_)
            | ExprKind::Unary(..)
            | ExprKind::Binary(..)
            | ExprKind::Field(..)
            | ExprKind::Index(..)
            | ExprKind::Call(..)
            | ExprKind::Method(_)
            | ExprKind::Tuple(_)
            | ExprKind::Array(_)
            | ExprKind::Vector(_)
            | ExprKind::Point(_)
            | ExprKind::Matrix(_)
    )
}
