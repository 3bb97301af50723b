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
        Region { exits: self.exits.len(), path: self.path.len(), sides: self.sides.open().len() }
    }

    /// Begins a side of a branch on the state.
    pub fn enter_side(&mut self, weight: NodeId) {
        let side = self.sides.another();
        self.go_on(side, weight);
    }

    fn go_on(&mut self, side: u32, weight: NodeId) {
        self.path.push(weight);
        self.sides.enter(side, self.model.graph.len());
    }

    /// Ends all sides that were begun in a region. Returns their conditions.
    pub fn leave_sides(&mut self, region: Region) -> Vec<NodeId> {
        let way = self.path.split_off(region.path);
        self.sides.leave(region.sides, self.model.graph.len());
        for exit in region.exits..self.exits.len() {
            let Exit { weight, since, origin, .. } = self.exits[exit];
            if let Some(before) = since.checked_sub(region.path).filter(|&before| before > 0) {
                let conditions = way[..before].iter().copied().chain([weight]);
                self.exits[exit].weight = self.all_of(conditions, origin).unwrap_or(weight);
                self.exits[exit].since = region.path;
            }
        }
        way
    }

    /// Notes that a flow has ended where conditions hold, beside those of the present path.
    pub fn exit(&mut self, way: Vec<NodeId>, flow: Flow, values: Vec<Value>, origin: Origin) {
        if let Some(weight) = self.all_of(way, origin) {
            let open = self.sides.open().to_vec();
            let (since, beside) = (self.path.len(), self.sides.another());
            self.exits.push(Exit { weight, since, open, beside, flow, values, origin });
        }
    }

    /// Counts ways out of a region as standing in the sides that are open around it.
    pub fn widen(&mut self, region: Region) {
        let open = self.sides.open();
        self.exits[region.exits..].iter_mut().for_each(|exit| exit.open = open.to_vec());
    }

    /// The condition that all of some conditions hold.
    fn all_of(&mut self, conditions: impl IntoIterator<Item = NodeId>, origin: Origin) -> Option<NodeId> {
        let conditions = conditions.into_iter().map(Value::Choice);
        match conditions.reduce(|all, one| self.both(BinaryOperator::And, all, one, origin)) {
            Some(Value::Choice(weight)) => Some(weight),
            _ => None,
        }
    }

    /// What follows a region runs where none of its remaining ways out was taken: on the other side of each.
    pub fn go_beside(&mut self, region: Region) {
        for exit in region.exits..self.exits.len() {
            let rest = self.opposite(self.exits[exit].weight);
            self.go_on(self.exits[exit].beside, rest);
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
        let mark = self.sides.mark();
        for Exit { weight, open, values, origin, .. } in here.into_iter().rev() {
            let after = self.scope.values();
            let merged = values
                .iter()
                .zip(&after)
                .map(|(then, after)| self.merged(weight, [then, after], &open, origin))
                .collect();
            self.scope.restore(merged);
        }
        self.sides.forget(mark);
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
        let mark = self.sides.mark();
        for Exit { weight, open, flow, origin: left, .. } in std::mem::take(&mut self.exits).into_iter().rev()
        {
            let early = if let Flow::Return(early) = flow { early } else { Value::Unknown };
            let early = self.coerce(early, shape, left);
            let late = self.coerce(value, shape, origin);
            value = self.merged(weight, [&early, &late], &open, left);
        }
        self.sides.forget(mark);
        (self.path, self.exits) = outside;
        value
    }

    /// w · `then` + w̄ · `after`, which an earlier exit may guard in its turn.
    fn merged(&mut self, weight: NodeId, [then, after]: [&Value; 2], open: &[u32], origin: Origin) -> Value {
        let region = self.region();
        self.enter_side(weight);
        let value = self.mixed(weight, [then, after], open, origin);
        self.leave_sides(region);
        value
    }
}
