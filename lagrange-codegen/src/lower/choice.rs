//! Branches on the state: both sides are values, and a switch between them is a kink or a jump.
//!
//! A condition becomes a number, one where it holds and zero where it does not, made of signs of
//! differences. `if a > b { x } else { y }` is then w x + w̄ y, which the code of one regime knows as x or as
//! y. At equality it is what Rust says it is. The opposite w̄ of a condition is a number of its own, so that
//! nothing is subtracted from y.

use std::rc::Rc;

use super::interpreter::{Flow, Interpreter};
use super::value::{Matrix, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::NodeId;
use crate::number::Number;
use crate::syntax::body::{BinaryOperator, Expr, If};

impl<'a> Interpreter<'a> {
    /// A comparison as a number, one where it holds and zero elsewhere; `None` for a comparison for equality.
    pub fn choice(&mut self, operator: BinaryOperator, left: NodeId, right: NodeId) -> Option<NodeId> {
        // Zero is not negative, so equality counts as `>=`.
        let (more, less, strict) = match operator {
            BinaryOperator::GreaterEqual => (left, right, false),
            BinaryOperator::LessEqual => (right, left, false),
            BinaryOperator::Less => (left, right, true),
            BinaryOperator::Greater => (right, left, true),
            _ => return None,
        };
        let graph = self.graph();
        let difference = graph.sub(more, less);
        let [holds, fails] = graph.sides(difference);
        let [weight, opposite] = if strict { [fails, holds] } else { [holds, fails] };
        Some(self.noted(weight, opposite))
    }

    /// Notes that two conditions are opposites. Returns the first.
    fn noted(&mut self, weight: NodeId, opposite: NodeId) -> NodeId {
        self.opposites.insert(weight, opposite);
        self.opposites.insert(opposite, weight);
        weight
    }

    /// The second operand. After a condition on the state, `&&` and `||` ask for it on one side alone; what
    /// it assigns is assigned there.
    pub fn asked(
        &mut self,
        operator: BinaryOperator,
        first: &Value,
        second: &'a Expr,
        origin: Origin,
    ) -> Value {
        let region = self.region();
        let mut skipped = None;
        if let Value::Choice(weight) = *first {
            let asked = if operator == BinaryOperator::And { weight } else { self.opposite(weight) };
            skipped = Some((asked, self.scope.values()));
            self.enter_side(asked);
        }
        let second = self.expression(second);
        self.leave_sides(region);
        if let (Some((asked, before)), Flow::Next) = (skipped, &self.flow) {
            let (after, open) = (self.scope.values(), self.sides.open().to_vec());
            let both = after.iter().zip(&before);
            let merged =
                both.map(|(after, before)| self.mixed(asked, [after, before], &open, origin)).collect();
            self.scope.restore(merged);
        }
        self.go_beside(region);
        second
    }

    /// Two conditions joined.
    pub fn both(&mut self, operator: BinaryOperator, left: Value, right: Value, origin: Origin) -> Value {
        match (operator, left, right) {
            (_, Value::Choice(a), Value::Choice(b)) => {
                // That both hold, or for `||` that both fail. The opposite: the first decides, or else the
                // second.
                let [not_a, not_b] = [a, b].map(|weight| self.opposite(weight));
                // The second is asked for where the first does not decide.
                let asked = if operator == BinaryOperator::And { [a, not_a] } else { [not_a, a] };
                let guarded =
                    self.sides.guarded(&mut self.model.graph, &[b, not_b], asked, self.sides.open());
                let [b, not_b] = [guarded[0], guarded[1]];
                let all =
                    if operator == BinaryOperator::And { [a, b, not_a, not_b] } else { [not_a, not_b, a, b] };
                let [first, second, not_first, not_second] = all;
                let graph = self.graph();
                let both = graph.mul(first, second);
                let second_fails = graph.mul(first, not_second);
                let either_fails = graph.add(not_first, second_fails);
                let weight = self.noted(both, either_fails);
                Value::Choice(if operator == BinaryOperator::And { weight } else { either_fails })
            }
            // `binary` has stopped at a constant on the left that decides.
            (_, Value::Choice(weight), Value::Boolean(known))
            | (_, Value::Boolean(known), Value::Choice(weight)) => match (operator, known) {
                (BinaryOperator::And, true) | (BinaryOperator::Or, false) => Value::Choice(weight),
                (_, known) => Value::Boolean(known),
            },
            (_, left, right) => self.mismatch(operator, &left, &right, origin),
        }
    }

    /// The opposite of a condition.
    pub fn opposite(&mut self, weight: NodeId) -> NodeId {
        self.opposites.get(&weight).copied().unwrap_or_else(|| {
            // A condition that turned out to be constant.
            self.graph().sum(Number::ONE, &[(weight, Number::MINUS_ONE)])
        })
    }

    /// `if … else …` on the state.
    pub fn chosen(&mut self, branch: &'a If, weight: NodeId) -> Value {
        let origin = branch.condition.origin;
        let region = self.region();
        let rest = self.opposite(weight);
        let before = self.scope.values();
        self.enter_side(weight);
        let then = self.block(&branch.then);
        let way_then = self.leave_sides(region);
        let flow_then = std::mem::replace(&mut self.flow, Flow::Next);
        let after_then = self.scope.values();
        self.scope.restore(before);
        self.enter_side(rest);
        let otherwise = match &branch.otherwise {
            Some(otherwise) => self.expression(otherwise),
            None => Value::Unit,
        };
        let way_otherwise = self.leave_sides(region);
        let open = self.sides.open().to_vec();
        let value = match (flow_then, std::mem::replace(&mut self.flow, Flow::Next)) {
            (Flow::Next, Flow::Next) => {
                let after_otherwise = self.scope.values();
                let both = after_then.iter().zip(&after_otherwise);
                let merged = both
                    .map(|(then, otherwise)| self.mixed(weight, [then, otherwise], &open, origin))
                    .collect();
                self.scope.restore(merged);
                self.mixed(weight, [&then, &otherwise], &open, origin)
            }
            (Flow::Next, leaves) => {
                self.exit(way_otherwise, leaves, self.scope.values(), origin);
                self.scope.restore(after_then);
                then
            }
            (leaves, goes_on) => {
                self.exit(way_then, leaves, after_then, origin);
                self.flow = goes_on;
                otherwise
            }
        };
        self.widen(region);
        self.go_beside(region);
        value
    }

    /// w · (first value) + w̄ · (second one). `open` are the sides of other branches in which both stand.
    pub fn mixed(
        &mut self,
        weight: NodeId,
        [then, otherwise]: [&Value; 2],
        open: &[u32],
        origin: Origin,
    ) -> Value {
        let words = |value: &Value| {
            let mut words = Vec::new();
            value.fingerprint(&mut words);
            words
        };
        if words(then) == words(otherwise) {
            return then.clone();
        }
        let mix = |this: &mut Self, a: &[NodeId], b: &[NodeId]| -> Rc<[NodeId]> {
            let rest = this.opposite(weight);
            let graph = &mut this.model.graph;
            let a = this.sides.guarded(graph, a, [weight, rest], open);
            let b = this.sides.guarded(graph, b, [rest, weight], open);
            a.into_iter()
                .zip(b)
                .map(|(a, b)| {
                    let (a, b) = (graph.mul(weight, a), graph.mul(rest, b));
                    graph.add(a, b)
                })
                .collect()
        };
        match (then, otherwise) {
            (Value::Unknown, _) | (_, Value::Unknown) => Value::Unknown,
            (Value::Scalar(..) | Value::Parameter(_), Value::Scalar(..) | Value::Parameter(_)) => {
                let (a, b) = (self.scalar(then.clone(), origin), self.scalar(otherwise.clone(), origin));
                match (a, b) {
                    (Some(a), Some(b)) => Value::scalar(mix(self, &[a], &[b])[0]),
                    _ => Value::Unknown,
                }
            }
            (Value::Vector(a), Value::Vector(b)) if a.len() == b.len() => Value::Vector(mix(self, a, b)),
            (Value::Point(a), Value::Point(b)) if a.len() == b.len() => Value::Point(mix(self, a, b)),
            (Value::Matrix(a), Value::Matrix(b)) if (a.rows, a.columns) == (b.rows, b.columns) => {
                let entries = mix(self, &a.entries, &b.entries).to_vec();
                Value::Matrix(Rc::new(Matrix { rows: a.rows, columns: a.columns, entries }))
            }
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => Value::array(
                a.iter().zip(b.iter()).map(|(a, b)| self.mixed(weight, [a, b], open, origin)).collect(),
            ),
            (Value::Tuple(a), Value::Tuple(b)) if a.len() == b.len() => Value::tuple(
                a.iter().zip(b.iter()).map(|(a, b)| self.mixed(weight, [a, b], open, origin)).collect(),
            ),
            (a, b) => self.refuse(origin, catalogue::unmixed_choice(a.describe(), b.describe())),
        }
    }
}
