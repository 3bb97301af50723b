//! Blocks, bindings and assignments.

use super::advice::{valid_entries, valid_indices};
use super::interpreter::{Flow, Interpreter};
use super::path::is_constant_name;
use super::shape::Shape;
use super::value::Value;
use crate::diagnostics::{Origin, catalogue};
use crate::expr::NodeId;
use crate::syntax::body::{BinaryOperator, Block, Expr, ExprKind, Owner, Pattern, PatternKind, Statement};
use crate::syntax::hygiene::written;
use crate::syntax::types::Type;

/// A variable, or a part of one, that is assigned to.
struct Place {
    slot: usize,
    steps: Vec<Step>,
    /// A name for what is stored.
    name: String,
}

/// One step into a compound value.
#[derive(Clone, Copy)]
enum Step {
    Element(usize),
    Entry(usize, usize),
}

impl<'a> Interpreter<'a> {
    /// The value of a block.
    pub fn block(&mut self, block: &'a Block) -> Value {
        self.block_as(block, &Shape::Any)
    }

    /// The value of a block whose shape may be known.
    pub fn block_as(&mut self, block: &'a Block, shape: &Shape) -> Value {
        let mark = self.scope.mark();
        for statement in &block.statements {
            // Items are in sight in the whole block. Imports of everything are bound first, so that those by
            // name hide them.
            match statement {
                Statement::Glob => self.scope.bind_glob(),
                Statement::Constant(constant) => self.later.push(&constant.name),
                Statement::Use(..) | Statement::Let(..) | Statement::Expression(_) => {}
            }
        }
        for statement in &block.statements {
            if let Statement::Use(name, path) = statement
                && is_constant_name(name)
            {
                let value = self.path(path);
                self.scope.bind_item(name.clone(), value);
            }
        }
        for statement in &block.statements {
            if let Statement::Constant(constant) = statement {
                let value = self.expression_of_type(&constant.value, &constant.ty);
                self.later.retain(|name| **name != constant.name);
                self.scope.bind_item(constant.name.clone(), value);
            }
        }
        let mut value = Value::Unit;
        for statement in &block.statements {
            self.statement(statement);
            if !matches!(self.flow, Flow::Next) {
                value = Value::Unknown;
                break;
            }
        }
        if let (Flow::Next, Some(last)) = (&self.flow, &block.value) {
            value = self.expression_as(last, shape);
        }
        self.scope.leave(mark);
        value
    }

    fn statement(&mut self, statement: &'a Statement) {
        match statement {
            Statement::Let(pattern, init) => {
                if !self.pay(pattern.origin) {
                    return self.stop();
                }
                match init {
                    None => self.bind_unknown(pattern),
                    Some(init) => {
                        let value = match &pattern.kind {
                            PatternKind::Typed(_, ty) => {
                                let shape = self.shape(ty);
                                let value = self.expression_as(init, &shape);
                                self.coerce_of(value, &shape, init)
                            }
                            _ => self.expression(init),
                        };
                        if let PatternKind::Name(name) = &pattern.kind {
                            self.hint(&value, name);
                        }
                        self.bind(pattern, value);
                    }
                }
            }
            Statement::Expression(expr) => {
                if !self.pay(expr.origin) {
                    return self.stop();
                }
                self.expression(expr);
            }
            Statement::Constant(_) | Statement::Use(..) | Statement::Glob => {}
        }
    }

    /// The value of a constant.
    pub fn expression_of_type(&mut self, expr: &'a Expr, ty: &'a Type) -> Value {
        let value = self.expression(expr);
        let shape = self.shape(ty);
        self.coerce_of(value, &shape, expr)
    }

    /// Leaves the function with an unknown value, as after a description has run away.
    pub fn stop(&mut self) {
        self.flow = Flow::Return(Value::Unknown);
    }

    /// Declares the names of a pattern without a value.
    pub fn bind_unknown(&mut self, pattern: &'a Pattern) {
        self.bind(pattern, Value::Unknown);
    }

    /// The value of an expression whose shape is known, so that sums of parameters unfold and
    /// `array::from_fn` knows its length.
    pub fn expression_as(&mut self, expr: &'a Expr, shape: &Shape) -> Value {
        match (&expr.kind, shape) {
            (
                ExprKind::Binary(operator @ (BinaryOperator::Add | BinaryOperator::Subtract), left, right),
                Shape::Vector(_) | Shape::Matrix(..),
            ) => {
                let (first, second) = (self.expression_as(left, shape), self.expression_as(right, shape));
                let first = self.shaped_parameter(first, shape, left.origin);
                let second = self.shaped_parameter(second, shape, right.origin);
                let value = self.arithmetic(*operator, first, second, expr.origin);
                self.record(&value, expr.origin);
                value
            }
            (ExprKind::Block(block), _) => self.block_as(block, shape),
            (_, Shape::Integer(_)) => self.convertible(expr),
            (ExprKind::Call(path, arguments), Shape::Array(_, length))
                if &*path.last == "from_fn" && !matches!(path.owner, Owner::Type(_)) =>
            {
                match arguments.as_slice() {
                    [function] => self.array_by_function(*length, function, expr.origin),
                    _ => self.expression(expr),
                }
            }
            _ => self.expression(expr),
        }
    }

    fn shaped_parameter(&mut self, value: Value, shape: &Shape, origin: Origin) -> Value {
        match value {
            Value::Parameter(_) => self.coerce(value, shape, origin),
            known => known,
        }
    }

    /// `place = value`.
    pub fn assign(&mut self, place: &'a Expr, value: &'a Expr) -> Value {
        let origin = value.origin;
        let value = self.expression(value);
        self.assign_value(place, value, origin);
        Value::Unit
    }

    /// Assigns a value to a place, or its parts to several: `(a, b) = (b, a)`.
    pub fn assign_value(&mut self, place: &'a Expr, value: Value, origin: Origin) {
        match &place.kind {
            ExprKind::Wild => return,
            ExprKind::Tuple(places) | ExprKind::Array(places) => {
                return self.assign_parts(places, value, place.origin);
            }
            _ => {}
        }
        if let Some(place) = self.place(place) {
            let before = self.read(&place);
            let value = match (&value, &before) {
                (Value::Parameter(_), Value::Scalar(..) | Value::Vector(_) | Value::Matrix(_)) => {
                    let shape = like(&before);
                    self.coerce(value, &shape, origin)
                }
                _ => value,
            };
            self.hint(&value, &place.name);
            self.write(&place, value, origin);
        }
    }

    /// `place += value` and the like.
    pub fn update(
        &mut self,
        operator: BinaryOperator,
        place: &'a Expr,
        value: &'a Expr,
        origin: Origin,
    ) -> Value {
        let operand = self.expression(value);
        if let Some(place) = self.place(place) {
            let before = self.read(&place);
            let after = match (&before, operand) {
                (Value::Scalar(..) | Value::Vector(_), Value::Integer(number, ..)) => {
                    self.integer_as_number(number, value)
                }
                (_, operand) => self.arithmetic(operator, before, operand, origin),
            };
            self.write(&place, after, origin);
        }
        Value::Unit
    }

    fn place(&mut self, expr: &'a Expr) -> Option<Place> {
        match &expr.kind {
            ExprKind::Path(path) if matches!(path.owner, Owner::None) => match self.scope.find(&path.last) {
                Some(slot) => Some(Place { slot, steps: Vec::new(), name: written(&path.last).to_string() }),
                None => {
                    let message = if self.scope.other_context(&path.last) {
                        catalogue::other_context(written(&path.last))
                    } else if &*path.last == "self" {
                        catalogue::assignment_to_self()
                    } else {
                        catalogue::assignment_to_unknown(written(&path.last))
                    };
                    self.report(path.origin, message);
                    self.scope.bind(path.last.clone(), Value::Unknown);
                    None
                }
            },
            ExprKind::Index(base, index) => {
                let mut place = self.base_place(base)?;
                let step = match &index.kind {
                    ExprKind::Tuple(pair) if pair.len() == 2 => {
                        Step::Entry(self.length(&pair[0])?, self.length(&pair[1])?)
                    }
                    _ => Step::Element(self.length(index)?),
                };
                self.step(&mut place, step, index.origin)
            }
            ExprKind::Field(base, word) => {
                let mut place = self.base_place(base)?;
                let index = match &*word.name {
                    "x" => Some(0),
                    "y" => Some(1),
                    "z" => Some(2),
                    "w" => Some(3),
                    number => number.parse().ok(),
                };
                match index {
                    Some(index) => self.step(&mut place, Step::Element(index), word.origin),
                    None => {
                        self.report(word.origin, catalogue::bad_place());
                        None
                    }
                }
            }
            _ => {
                self.report(expr.origin, catalogue::bad_place());
                None
            }
        }
    }

    /// A place of which a part is assigned to.
    fn base_place(&mut self, expr: &'a Expr) -> Option<Place> {
        let place = self.place(expr)?;
        if let Value::Record(_) = self.read(&place) {
            self.report(expr.origin, catalogue::assignment_to_record(&place.name));
            return None;
        }
        Some(place)
    }

    /// Adds a step to a place and checks that it leads somewhere.
    fn step(&mut self, place: &mut Place, step: Step, origin: Origin) -> Option<Place> {
        let length = match (self.read(place), step) {
            (Value::Unknown, _) => return None,
            (Value::Array(elements) | Value::Tuple(elements), Step::Element(_)) => elements.len(),
            (Value::Vector(nodes) | Value::Point(nodes), Step::Element(_)) => nodes.len(),
            (Value::Matrix(matrix), Step::Entry(row, column)) => {
                if row >= matrix.rows || column >= matrix.columns {
                    let valid = valid_entries(matrix.rows, matrix.columns);
                    self.report(origin, catalogue::index_out_of_range(format!("({row}, {column})"), valid));
                    return None;
                }
                usize::MAX
            }
            (other, _) => {
                self.report(origin, catalogue::cannot_index(other.describe()));
                return None;
            }
        };
        let suffix = match step {
            Step::Element(index) if index >= length => {
                self.report(origin, catalogue::index_out_of_range(index, valid_indices(length)));
                return None;
            }
            Step::Element(index) => format!("_{index}"),
            Step::Entry(row, column) => format!("_{row}_{column}"),
        };
        let mut steps = std::mem::take(&mut place.steps);
        steps.push(step);
        Some(Place { slot: place.slot, steps, name: format!("{}{suffix}", place.name) })
    }

    fn read(&mut self, place: &Place) -> Value {
        let mut value = &*self.scope.slot(place.slot);
        for (position, step) in place.steps.iter().enumerate() {
            let node = match (value, step) {
                (Value::Array(elements) | Value::Tuple(elements), Step::Element(index)) => {
                    value = &elements[*index];
                    continue;
                }
                (Value::Vector(nodes) | Value::Point(nodes), Step::Element(index)) => nodes[*index],
                (Value::Matrix(matrix), Step::Entry(row, column)) => matrix.at(*row, *column),
                _ => return Value::Unknown,
            };
            debug_assert_eq!(position + 1, place.steps.len(), "statement: a step into a scalar");
            return Value::scalar(node);
        }
        value.clone()
    }

    fn write(&mut self, place: &Place, new: Value, origin: Origin) {
        if self.lazy.is_some_and(|outside| place.slot < outside) {
            let name = place.name.split('_').next().unwrap_or_default();
            return self.report(origin, catalogue::captured_change(name));
        }
        let component = match place.steps.is_empty() {
            true => None,
            false => match new.clone() {
                Value::Scalar(node, ..) => Some(node),
                Value::Parameter(id) => self.scalar_parameter(id, origin),
                _ => None,
            },
        };
        let mut value = self.scope.slot(place.slot);
        for step in &place.steps {
            match (value, step) {
                (Value::Array(elements) | Value::Tuple(elements), Step::Element(index)) => {
                    value = &mut std::rc::Rc::make_mut(elements)[*index];
                }
                (part @ (Value::Vector(_) | Value::Point(_) | Value::Matrix(_)), step) => {
                    match component {
                        Some(node) => set_component(part, *step, node),
                        None if new.is_unknown() => *part = Value::Unknown,
                        None => {
                            let message = catalogue::wrong_shape("a scalar", new.describe());
                            self.report(origin, message);
                        }
                    }
                    return;
                }
                _ => return,
            }
        }
        *value = new;
    }
}

fn set_component(value: &mut Value, step: Step, node: NodeId) {
    match (value, step) {
        (Value::Vector(nodes) | Value::Point(nodes), Step::Element(index)) => {
            let mut copy = nodes.to_vec();
            copy[index] = node;
            *nodes = copy.into();
        }
        (Value::Matrix(matrix), Step::Entry(row, column)) => {
            let matrix = std::rc::Rc::make_mut(matrix);
            let position = row * matrix.columns + column;
            matrix.entries[position] = node;
        }
        _ => {}
    }
}

/// The shape of a value of linear algebra.
pub fn like(value: &Value) -> Shape {
    match value {
        Value::Scalar(..) => Shape::Scalar,
        Value::Vector(nodes) => Shape::Vector(nodes.len()),
        Value::Point(nodes) => Shape::Point(nodes.len()),
        Value::Matrix(matrix) => Shape::Matrix(matrix.rows, matrix.columns),
        _ => Shape::Any,
    }
}
