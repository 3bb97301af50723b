//! Conditionals and loops whose course is known while the macro runs.

use std::rc::Rc;

use super::interpreter::{Flow, Interpreter};
use super::value::Value;
use crate::diagnostics::{Origin, catalogue};
use crate::syntax::body::{Arm, Expr, ExprKind, For, If, Name, RangeExpr};
use crate::syntax::integers::Integers;

impl<'a> Interpreter<'a> {
    /// The truth of a condition; `None` if it is not known, which is reported.
    pub fn condition(&mut self, expr: &'a Expr) -> Option<bool> {
        let value = self.expression(expr);
        self.truth(value, expr)
    }

    fn truth(&mut self, value: Value, expr: &'a Expr) -> Option<bool> {
        match value {
            Value::Boolean(value) => Some(value),
            Value::Choice(weight) => {
                let on = super::advice::dependence_words(self.model.graph.dependence(weight));
                self.report(expr.origin, catalogue::branch_on_variable(on, self.smooth_thing()));
                None
            }
            Value::Unknown => None,
            Value::Parameter(id) => {
                let text = self.parameters.text(id).to_string();
                self.report(expr.origin, catalogue::branch_on_parameter(text));
                None
            }
            other => {
                self.report(expr.origin, catalogue::wrong_shape("a `bool`", other.describe()));
                None
            }
        }
    }

    /// `if … else …`.
    pub fn branch(&mut self, branch: &'a If) -> Value {
        let condition = self.expression(&branch.condition);
        if let Value::Choice(weight) = condition {
            return self.chosen(branch, weight);
        }
        match self.truth(condition, &branch.condition) {
            Some(true) => self.block(&branch.then),
            Some(false) => match &branch.otherwise {
                Some(otherwise) => self.expression(otherwise),
                None => Value::Unit,
            },
            None => Value::Unknown,
        }
    }

    /// `match … { … }`.
    pub fn matching(&mut self, value: &'a Expr, arms: &'a [Arm], origin: Origin) -> Value {
        let place = value.origin;
        let value = self.expression(value);
        match &value {
            Value::Unknown => return Value::Unknown,
            Value::Choice(weight) => {
                let on = super::advice::dependence_words(self.model.graph.dependence(*weight));
                return self.refuse(place, catalogue::branch_on_variable(on, self.smooth_thing()));
            }
            Value::Scalar(node, ..) if self.model.graph.as_constant(*node).is_none() => {
                let on = super::advice::dependence_words(self.model.graph.dependence(*node));
                return self.refuse(place, catalogue::branch_on_variable(on, self.smooth_thing()));
            }
            Value::Parameter(id) => {
                let text = format!("the parameter `{}`", self.parameters.text(*id));
                return self.refuse(place, catalogue::branch_on_variable(text, self.smooth_thing()));
            }
            _ => {}
        }
        for arm in arms {
            let mark = self.scope.mark();
            let result = match self.matches(&arm.pattern, &value) {
                None => Some(Value::Unknown),
                Some(false) => None,
                Some(true) => match arm.guard.as_ref().map(|guard| self.condition(guard)) {
                    None | Some(Some(true)) => Some(self.expression(&arm.body)),
                    Some(Some(false)) => None,
                    Some(None) => Some(Value::Unknown),
                },
            };
            self.scope.leave(mark);
            if let Some(result) = result {
                return result;
            }
        }
        self.refuse(origin, catalogue::no_arm())
    }

    /// `for … in … { … }`.
    pub fn each(&mut self, each: &'a For) -> Value {
        let reports = self.reports;
        let over = match &each.over.kind {
            ExprKind::Range(range) => self.bounded_range(range, each.over.origin),
            _ => {
                let over = self.expression(&each.over);
                self.elements(over, each.over.origin)
            }
        };
        let Some(over) = over else {
            // Nothing is reported here: rustc refuses the loop, or an earlier message stands. What follows
            // would read variables that the loop has not changed.
            if self.reports == reports {
                self.stop();
            }
            return Value::Unknown;
        };
        let mine = |label: &Option<Name>| label.is_none() || *label == each.label;
        let origin = each.over.origin;
        let all = self.region();
        for element in over.iter() {
            if !self.pay(origin) {
                self.stop();
                return Value::Unknown;
            }
            let turn = self.region();
            let mark = self.scope.mark();
            self.bind(&each.pattern, element.clone());
            self.block(&each.body);
            self.scope.leave(mark);
            if matches!(&self.flow, Flow::Continue(label) if mine(label)) {
                self.flow = Flow::Next;
            }
            self.end_region(turn, |flow| matches!(flow, Flow::Continue(label) if mine(label)), origin);
            if !matches!(self.flow, Flow::Next) {
                break;
            }
        }
        if matches!(&self.flow, Flow::Break(label) if mine(label)) {
            self.flow = Flow::Next;
        }
        self.end_region(all, |flow| matches!(flow, Flow::Break(label) if mine(label)), origin);
        if matches!(self.flow, Flow::Next) { Value::Unit } else { Value::Unknown }
    }

    /// A range as a value.
    pub fn range(&mut self, range: &'a RangeExpr) -> Value {
        let mut valid = true;
        let mut bound = |interpreter: &mut Self, expr: &'a Option<Box<Expr>>| {
            let expr = expr.as_ref()?;
            let value = interpreter.bound(expr);
            valid &= value.is_some();
            value
        };
        let start = bound(self, &range.start);
        let end = bound(self, &range.end);
        match valid {
            true => {
                let types = |bound: Option<(i128, Integers)>| bound.map_or(Integers::ANY, |(_, types)| types);
                let end_of = |(end, _): (i128, Integers)| end.saturating_add(i128::from(range.inclusive));
                Value::Range(start.map(|(start, _)| start), end.map(end_of), types(start) & types(end))
            }
            false => Value::Unknown,
        }
    }

    fn bound(&mut self, expr: &'a Expr) -> Option<(i128, Integers)> {
        match self.expression(expr) {
            Value::Integer(value, types) => Some((value, types)),
            Value::Unknown => None,
            Value::Parameter(id) => {
                let text = self.parameters.text(id).to_string();
                self.report(expr.origin, catalogue::parameter_bound(text));
                None
            }
            other => {
                self.report(expr.origin, catalogue::bound_not_constant(other.describe()));
                None
            }
        }
    }

    fn bounded_range(&mut self, range: &'a RangeExpr, origin: Origin) -> Option<Rc<Vec<Value>>> {
        let range = self.range(range);
        self.elements(range, origin)
    }

    /// The elements that a loop or an iterator runs over.
    pub fn elements(&mut self, value: Value, origin: Origin) -> Option<Rc<Vec<Value>>> {
        match value {
            Value::Array(elements) | Value::Iterator(elements) => Some(elements),
            Value::Range(Some(start), Some(end), types) => {
                let count = usize::try_from(end.saturating_sub(start).max(0)).unwrap_or(usize::MAX);
                let affordable = self.pay_for(count, origin);
                affordable.then(|| Rc::new((start..end).map(|value| Value::Integer(value, types)).collect()))
            }
            Value::Range(..) => {
                self.report(origin, catalogue::open_range());
                None
            }
            Value::Vector(nodes) | Value::Point(nodes) => {
                Some(Rc::new(nodes.iter().map(|&node| Value::scalar(node)).collect()))
            }
            Value::Matrix(matrix) => {
                let column_major = (0..matrix.columns)
                    .flat_map(|column| (0..matrix.rows).map(move |row| (row, column)))
                    .map(|(row, column)| Value::scalar(matrix.at(row, column)));
                Some(Rc::new(column_major.collect()))
            }
            Value::Parameter(id) => {
                let text = self.parameters.text(id).to_string();
                let label = self.parameters.label(id).to_string();
                let scalar = self.item.scalar.to_string();
                self.report(origin, catalogue::loop_over_parameter(text, label, scalar));
                None
            }
            Value::Unknown => None,
            other => {
                self.report(origin, catalogue::not_iterable(other.describe()));
                None
            }
        }
    }
}
