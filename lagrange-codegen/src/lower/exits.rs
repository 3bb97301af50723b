//! Ways out of a function or a loop on one side of a branch on the state.
//!
//! After `if q.x < 0.0 { return 0.0; }` the rest of the function is computed everywhere, on the other side of
//! the branch. At the end its result is w · (what was returned) + w̄ · (what came after). In the same way
//! variables have two values where `continue` has ended a turn of a loop, or `break` the loop.

use super::interpreter::{Exit, Flow, Interpreter};
use super::shape::Shape;
use super::value::Value;
use crate::diagnostics::Origin;
use crate::expr::NodeId;
use crate::syntax::body::BinaryOperator;

/// A part of a function that ways out may lead out of: a branch, a loop, a turn of it.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    exits: usize,
    path: usize,
    sides: usize,
}

impl<'a> Interpreter<'a> {
    /// Begins a region.
    pub fn region(&self) -> Region {
        Region { exits: self.exits.len(), path: self.path.len(), sides: self.sides.depth() }
    }

    /// Begins a side of a branch on the state.
    pub fn enter_side(&mut self, weight: NodeId) {
        self.path.push(weight);
        self.sides.enter(self.model.graph.len());
    }

    /// Ends all sides that were begun in a region. Returns the conditions of the way so far.
    pub fn leave_sides(&mut self, region: Region) -> Vec<NodeId> {
        let way = self.path.clone();
        self.path.truncate(region.path);
        self.sides.leave(region.sides, self.model.graph.len());
        way
    }

    /// Notes that a flow has ended where these conditions hold.
    pub fn exit(&mut self, way: Vec<NodeId>, flow: Flow, values: Vec<Value>, origin: Origin) {
        let all = way
            .into_iter()
            .map(Value::Choice)
            .reduce(|all, one| self.both(BinaryOperator::And, all, one, origin));
        if let Some(Value::Choice(weight)) = all {
            self.exits.push(Exit { weight, flow, values, origin });
        }
    }

    /// What follows a region is on the other side of the branches that have left further.
    pub fn go_beside(&mut self, region: Region) {
        for exit in region.exits..self.exits.len() {
            let rest = self.opposite(self.exits[exit].weight);
            self.enter_side(rest);
        }
    }

    /// Ends a loop, or a turn of it, to whose end some ways out lead: variables have the values that they
    /// had there.
    pub fn end_region(&mut self, region: Region, leads_here: impl Fn(&Flow) -> bool, origin: Origin) {
        let leads = |exit: &Exit| leads_here(&exit.flow);
        if !self.exits[region.exits..].iter().any(leads) {
            self.leave_sides(region);
            return self.go_beside(region);
        }
        let values = self.scope.values();
        let way = self.leave_sides(region);
        // A flow that goes further does so only where no earlier exit leads here.
        if !matches!(self.flow, Flow::Next) {
            let flow = std::mem::replace(&mut self.flow, Flow::Next);
            self.exit(way, flow, values, origin);
        }
        let (here, further): (Vec<Exit>, Vec<Exit>) =
            self.exits.split_off(region.exits).into_iter().partition(leads);
        for Exit { weight, values, origin, .. } in here.into_iter().rev() {
            let after = self.scope.values();
            let merged = values
                .iter()
                .zip(&after)
                .map(|(then, after)| self.merged(weight, [then, after], origin))
                .collect();
            self.scope.restore(merged);
        }
        self.exits.extend(further);
        self.go_beside(region);
    }

    /// The value of a body: of its last expression or of `return`.
    pub fn body_value(
        &mut self,
        origin: Origin,
        shape: &Shape,
        body: impl FnOnce(&mut Self) -> Value,
    ) -> Value {
        let outside = (std::mem::take(&mut self.path), std::mem::take(&mut self.exits));
        let region = self.region();
        let value = body(self);
        let mut value = match std::mem::replace(&mut self.flow, Flow::Next) {
            Flow::Return(value) => value,
            Flow::Next => value,
            Flow::Break(_) | Flow::Continue(_) => Value::Unknown,
        };
        self.leave_sides(region);
        for Exit { weight, flow, origin: left, .. } in std::mem::take(&mut self.exits).into_iter().rev() {
            let early = if let Flow::Return(early) = flow { early } else { Value::Unknown };
            let early = self.coerce(early, shape, left);
            let late = self.coerce(value, shape, origin);
            value = self.merged(weight, [&early, &late], left);
        }
        (self.path, self.exits) = outside;
        value
    }

    /// w · `then` + w̄ · `after`, of which more may follow.
    fn merged(&mut self, weight: NodeId, [then, after]: [&Value; 2], origin: Origin) -> Value {
        let region = self.region();
        self.enter_side(weight);
        let value = self.mixed(weight, then, after, origin);
        self.leave_sides(region);
        value
    }
}
