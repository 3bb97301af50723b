//! The state of the abstract interpretation, and the dispatch over expressions.

use std::rc::Rc;

use super::coordinates;
use super::guarded::Sides;
use super::parameter::Parameters;
use super::rounded::Rounded;
use super::scalar::LARGEST_POWER;
use super::scope::{Scope, View};
use super::shape::Shape;
use super::value::{Callable, Value};
use crate::collections::Lookup;
use crate::diagnostics::{Diagnostics, Origin, catalogue};
use crate::expr::{Graph, Node, NodeId};
use crate::model::{Meaning, Model};
use crate::number::Number;
use crate::syntax::body::{Expr, ExprKind, Name, Owner};
use crate::syntax::integers::Integers;
use crate::syntax::{Item, Record};

/// Steps, an expression each, after which a description counts as runaway: about three seconds of an engine
/// without optimisation. Five hundred coordinates of which each meets each take a third of them, a chain of a
/// hundred links a hundredth.
const BUDGET: usize = 1_000_000;

/// Subexpressions of the largest description: those of fifty particles that attract each other.
/// Differentiating them takes most of the time of an expansion.
const LARGEST: usize = 20_000;

/// Where execution goes after a statement.
#[derive(Debug)]
pub enum Flow {
    /// To the next statement.
    Next,
    /// Out of a loop.
    Break(Option<Name>),
    /// To the next turn of a loop.
    Continue(Option<Name>),
    /// Out of the function.
    Return(Value),
}

/// A way out of a function or a loop that is taken where a condition holds.
#[derive(Debug)]
pub struct Exit {
    /// The condition, beside those that stand in the path before `since`: of all branches on the way, and
    /// that no earlier exit was taken.
    pub weight: NodeId,
    /// The length of the path from which on the condition counts.
    pub since: usize,
    /// The sides in which its branch stands, and the one on which all goes on.
    pub open: Vec<u32>,
    pub beside: u32,
    pub flow: Flow,
    /// The values of all variables there.
    pub values: Vec<Value>,
    pub origin: Origin,
}

/// The amount that may still be unrolled.
#[derive(Debug)]
enum Budget {
    Left(usize),
    /// The runaway is reported.
    Exhausted,
}

/// An interpreter of the user's functions.
pub struct Interpreter<'a> {
    /// The description.
    pub item: &'a Item,
    /// Where mistakes go.
    pub diagnostics: &'a mut Diagnostics,
    /// The model that is being built.
    pub model: Model,
    /// Paths that start at `self`.
    pub parameters: Parameters,
    /// Local variables.
    pub scope: Scope,
    /// Where execution goes next.
    pub flow: Flow,
    /// Results of calls: function and arguments to value.
    pub memo: Lookup<(usize, Vec<u64>), Value>,
    /// Conditions on the state, as numbers, with their opposites.
    pub opposites: Lookup<NodeId, NodeId>,
    /// The sides of branches on the state.
    pub sides: Sides,
    /// The conditions of the sides that are open in the present function.
    pub path: Vec<NodeId>,
    /// Ways out of the present function and its loops that are taken on some sides.
    pub exits: Vec<Exit>,
    /// Functions whose return type their role refuses.
    pub misshapen: Vec<usize>,
    /// The functions being evaluated.
    pub calls: Vec<usize>,
    /// Rates of functions whose velocities the description names, once they are derived.
    pub rates: Vec<Option<Value>>,
    /// Constants of the impl block: evaluated, or being evaluated (`Unknown`).
    pub constants: Vec<Option<Value>>,
    /// The fields of each record, in the order of [`crate::syntax::Record::ALL`].
    pub fields: [Vec<Value>; 3],
    /// Constants of the enclosing blocks that are not evaluated yet.
    pub later: Vec<&'a Name>,
    /// While a closure of a lazy iterator runs, the height of the stack of variables where it began:
    /// variables below are outside the closure.
    pub lazy: Option<usize>,
    /// Closures in variables, with what they have in sight.
    pub closures: Vec<(Callable<'a>, View)>,
    /// The names whose meaning the emitted statements check so far.
    meant: Lookup<String, ()>,
    /// Whether an attribute argument such as a mass is evaluated.
    pub in_attribute: bool,
    /// How many variables stand for components of positions.
    pub positions: u32,
    /// The number of reports, repetitions included.
    pub reports: usize,
    budget: Budget,
}

impl<'a> Interpreter<'a> {
    /// An interpreter with the variables of a description.
    pub fn new(item: &'a Item, diagnostics: &'a mut Diagnostics) -> Interpreter<'a> {
        let mut model = Model {
            coordinates: coordinates::quantities(&item.coordinates),
            orientations: coordinates::orientations(&item.coordinates),
            turning: coordinates::orientations(&item.coordinates),
            inputs: coordinates::quantities(&item.inputs),
            ..Model::default()
        };
        let graph = &mut model.graph;
        let fields = [
            coordinates::fields(graph, &item.coordinates, Record::Coordinates),
            coordinates::fields(graph, &item.coordinates, Record::Velocities),
            coordinates::fields(graph, &item.inputs, Record::Inputs),
        ];
        Interpreter {
            item,
            diagnostics,
            model,
            parameters: Parameters::default(),
            scope: Scope::default(),
            flow: Flow::Next,
            memo: Lookup::default(),
            opposites: Lookup::default(),
            sides: Sides::default(),
            path: Vec::new(),
            exits: Vec::new(),
            misshapen: Vec::new(),
            calls: Vec::new(),
            rates: vec![None; item.velocities.len()],
            constants: vec![None; item.constants.len()],
            fields,
            later: Vec::new(),
            lazy: None,
            closures: Vec::new(),
            meant: Lookup::default(),
            in_attribute: false,
            positions: 0,
            reports: 0,
            budget: Budget::Left(BUDGET),
        }
    }

    /// The graph under construction.
    pub fn graph(&mut self) -> &mut Graph {
        &mut self.model.graph
    }

    /// A number that stands in the source, or has a name of its own.
    pub fn constant(&mut self, number: Number) -> Value {
        Value::Scalar(self.graph().constant(number), Rounded::literal(number))
    }

    /// An integer result of a type; [`Value::Unknown`] where Rust would overflow, which is reported.
    pub fn integer(&mut self, value: i128, types: Integers, origin: Origin) -> Value {
        match types.holding(value) {
            Some(types) => Value::Integer(value, types),
            None => self.refuse(origin, catalogue::integer_overflow()),
        }
    }

    /// Emits a statement that compiles only if a name means what the interpreter took it for.
    pub fn meaning(&mut self, statement: String, origin: Origin) {
        self.meant(statement.clone(), statement, origin);
    }

    /// Emits such a statement once for each name.
    pub fn meant(&mut self, name: String, statement: String, origin: Origin) {
        if self.meant.insert(name, ()).is_none() {
            self.model.meanings.push(Meaning { statement, origin });
        }
    }

    /// Reports a mistake.
    pub fn report(&mut self, origin: Origin, message: String) {
        self.reports += 1;
        self.diagnostics.at(origin, message);
    }

    /// Reports a mistake and gives the value that silences its consequences.
    pub fn refuse(&mut self, origin: Origin, message: String) -> Value {
        self.report(origin, message);
        Value::Unknown
    }

    /// Pays for one statement or iteration; false when the description runs away.
    pub fn pay(&mut self, origin: Origin) -> bool {
        self.pay_for(1, origin)
    }

    /// Pays for a number of elements.
    pub fn pay_for(&mut self, count: usize, origin: Origin) -> bool {
        let Budget::Left(left) = self.budget else { return false };
        let message = match left.checked_sub(count) {
            Some(left) if self.model.graph.size() <= LARGEST => {
                self.budget = Budget::Left(left);
                return true;
            }
            Some(_) => catalogue::too_large(LARGEST),
            None => catalogue::runaway(BUDGET),
        };
        self.report(origin, message);
        self.budget = Budget::Exhausted;
        false
    }

    /// Pays for some copies of a value.
    fn pay_for_parts(&mut self, value: &Value, copies: usize, origin: Origin) -> bool {
        let parts = value.parts(BUDGET).saturating_mul(copies);
        self.pay_for(parts, origin)
    }

    /// The value of an expression.
    pub fn expression(&mut self, expr: &'a Expr) -> Value {
        if !matches!(self.flow, Flow::Next) {
            return Value::Unknown;
        }
        let origin = expr.origin;
        if !self.pay(origin) {
            self.stop();
            return Value::Unknown;
        }
        let value = match &expr.kind {
            ExprKind::Float(number) => self.constant(*number),
            ExprKind::Integer(value, types) => Value::Integer(*value, *types),
            ExprKind::Boolean(value) => Value::Boolean(*value),
            ExprKind::Path(path) => self.path(path),
            ExprKind::Unary(operator, operand) => {
                let operand = self.expression(operand);
                self.unary(*operator, operand, origin)
            }
            ExprKind::Binary(operator, left, right) => self.binary(*operator, left, right, origin),
            ExprKind::Assign(place, value) => self.assign(place, value),
            ExprKind::Update(operator, place, value) => self.update(*operator, place, value, origin),
            ExprKind::Cast(value, ty) => self.cast(value, ty, origin),
            ExprKind::Field(base, word) => {
                let base = self.expression(base);
                self.field(base, word, origin)
            }
            ExprKind::Pointee(pointer) => match self.expression(pointer) {
                Value::Parameter(id) => Value::Parameter(self.pointee(id, origin)),
                other => other,
            },
            ExprKind::Index(base, index) => self.index(base, index),
            ExprKind::Call(path, arguments) => self.call_path(path, arguments, origin),
            ExprKind::Method(call) => self.method(call, origin),
            ExprKind::Tuple(elements) if elements.is_empty() => Value::Unit,
            ExprKind::Tuple(elements) => Value::tuple(self.expressions(elements)),
            ExprKind::Array(elements) => Value::array(self.expressions(elements)),
            ExprKind::Repeat(element, length) => {
                let element = self.expression(element);
                match self.length(length) {
                    Some(count) if self.pay_for_parts(&element, count, origin) => {
                        Value::array(vec![element; count])
                    }
                    Some(_) | None => Value::Unknown,
                }
            }
            ExprKind::Vector(components) => self.vector_of(components).map_or(Value::Unknown, Value::Vector),
            ExprKind::Point(components) => self.vector_of(components).map_or(Value::Unknown, Value::Point),
            ExprKind::Matrix(rows) => self.matrix_literal(rows, origin),
            ExprKind::Range(range) => self.range(range),
            ExprKind::Block(block) => self.block(block),
            ExprKind::If(branch) => self.branch(branch),
            ExprKind::Match(value, arms) => self.matching(value, arms, origin),
            ExprKind::For(each) => self.each(each),
            ExprKind::Return(value) => {
                let value = value.as_ref().map_or(Value::Unit, |value| self.expression(value));
                self.leave(Flow::Return(value))
            }
            ExprKind::Break(label) => self.leave(Flow::Break(label.clone())),
            ExprKind::Continue(label) => self.leave(Flow::Continue(label.clone())),
            ExprKind::Closure(closure) => self.stored(closure, origin),
            ExprKind::Wild => self.refuse(origin, catalogue::unsupported_syntax("`_`")),
            ExprKind::Unsupported(message) => self.refuse(origin, message.clone()),
        };
        // Arrays share their elements, but a walk over an array pays for each element.
        let is_new = matches!(
            expr.kind,
            ExprKind::Array(_) | ExprKind::Tuple(_) | ExprKind::Method(_) | ExprKind::Call(..)
        );
        if is_new && !self.pay_for_parts(&value, 1, origin) {
            self.stop();
            return Value::Unknown;
        }
        let reports = self.reports;
        self.record(&value, origin);
        if self.reports > reports { Value::Unknown } else { value }
    }

    /// The values of some expressions.
    pub fn expressions(&mut self, list: &'a [Expr]) -> Vec<Value> {
        list.iter().map(|expr| self.expression(expr)).collect()
    }

    /// The node of an expression that must be a scalar.
    pub fn scalar_of(&mut self, expr: &'a Expr) -> Option<NodeId> {
        let value = self.expression(expr);
        match self.coerce_of(value, &Shape::Scalar, expr) {
            Value::Scalar(node, ..) => Some(node),
            _ => None,
        }
    }

    /// The components of a vector literal.
    pub fn vector_of(&mut self, components: &'a [Expr]) -> Option<Rc<[NodeId]>> {
        // All are evaluated, so that all mistakes are found.
        let nodes: Vec<Option<NodeId>> = components.iter().map(|expr| self.scalar_of(expr)).collect();
        nodes.into_iter().collect()
    }

    /// The value of an expression that must be a constant integer.
    pub fn integer_of(&mut self, expr: &'a Expr) -> Option<i128> {
        match self.expression(expr) {
            Value::Integer(value, ..) => Some(value),
            Value::Unknown => None,
            Value::Parameter(id) => {
                let text = self.parameters.text(id).to_string();
                self.report(expr.origin, catalogue::parameter_as_integer(text));
                None
            }
            other => {
                self.report(expr.origin, catalogue::not_an_integer(other.describe()));
                None
            }
        }
    }

    /// The value of an expression that must be a length or an index.
    pub fn length(&mut self, expr: &'a Expr) -> Option<usize> {
        match usize::try_from(self.integer_of(expr)?) {
            // Longer arrays could not be unrolled anyway.
            Ok(length) if length <= BUDGET => Some(length),
            Ok(_) | Err(_) => {
                self.report(expr.origin, catalogue::integer_overflow());
                None
            }
        }
    }

    fn leave(&mut self, flow: Flow) -> Value {
        self.flow = flow;
        Value::Unknown
    }

    /// Remembers where the nodes of a value were first written. Operands that have no place of
    /// their own, such as the products within a dot product, share it.
    pub fn record(&mut self, value: &Value, origin: Origin) {
        let mut stack = Vec::new();
        for &node in value.nodes() {
            if !self.model.origins.contains(&node) {
                stack.push(node);
            }
        }
        while let Some(node) = stack.pop() {
            if self.model.origins.contains(&node) {
                continue;
            }
            self.model.origins.insert(node, origin);
            if let Node::Product(factors) = self.model.graph.node(node)
                && factors.iter().any(|(_, power)| u128::from(power.0.unsigned_abs()) > 2 * LARGEST_POWER)
            {
                self.report(origin, catalogue::bad_power(LARGEST_POWER));
            }
            self.model.graph.operands(node, |operand| stack.push(operand));
        }
    }

    /// Whether a path is the bare word `self`.
    pub fn is_self(expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Path(path) => matches!(path.owner, Owner::None) && &*path.last == "self",
            _ => false,
        }
    }
}
