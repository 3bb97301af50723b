//! Whether a rewriting keeps the digits: a running error analysis at a few fixed points.
//!
//! Multiplied out, (a − b)² is a sum whose terms cancel where a is near b, and no way to evaluate it is as
//! accurate as the square. Every value is computed with the rounding errors that it gathers (Higham,
//! "Accuracy and Stability of Numerical Algorithms", 2nd ed., section 3.3). Variables and functions, which
//! rewriting does not touch, count as exact up to one rounding error. Near a cancellation the loss of digits
//! is unbounded, but it mostly shows at ordinary points too. In f + k (x − c) + h (x − c)² it does not: there
//! the second term has errors like those of the third multiplied out, until x and c are large. So sums are
//! tried with large terms and an ordinary value as well.

use crate::expr::{Exponent, Graph, Node, NodeId, Variable};
use crate::number::Number;

const POINTS: u32 = 8;

/// How much larger the terms of a sum are than its value where they cancel.
const LARGE: f64 = 1e4;

/// The largest acceptable growth of the rounding errors by a rewriting.
const MOST_LOSS: f64 = 4.0;

/// Whether `after`, which equals `before`, gathers about as few rounding errors.
pub(super) fn keeps_digits(graph: &Graph, before: NodeId, after: NodeId) -> bool {
    let ratio = |values: &dyn Fn(Variable) -> f64| {
        let [old, new] = roundings(graph, [before, after], values);
        new / old
    };
    let keeps = |ratio: f64| !ratio.is_finite() || ratio <= MOST_LOSS;
    let ratios: Vec<f64> = (0..POINTS).map(|point| ratio(&|variable| sample(variable, point))).collect();
    if !ratios.iter().any(|ratio| ratio.is_finite()) || !ratios.into_iter().all(keeps) {
        return false;
    }
    let shifts: Vec<Shift> = graph.cone([before]).into_iter().filter_map(|id| Shift::of(graph, id)).collect();
    let mut grown: Vec<Variable> = Vec::new();
    for variable in shifts.iter().flat_map(Shift::variables) {
        if !grown.contains(&variable) {
            grown.push(variable);
        }
    }
    grown.into_iter().all(|variable| {
        (0..2).all(|point| {
            let changed = cancelling(&shifts, variable, point);
            let values = |wanted| value_of(wanted, &changed, point);
            changed.len() < 2 || keeps(ratio(&values))
        })
    })
}

/// Variables with other values than at a point: one that is large, and others that take up its growth in all
/// sums, so that these keep their values.
fn cancelling(shifts: &[Shift], grown: Variable, point: u32) -> Vec<(Variable, f64)> {
    let mut changed = vec![(grown, LARGE * sample(grown, point))];
    for shift in shifts {
        changed.extend(shift.taking_up(&changed, point));
    }
    changed
}

/// The value of a variable at a point, unless it is `changed`.
fn value_of(wanted: Variable, changed: &[(Variable, f64)], point: u32) -> f64 {
    let own = changed.iter().find(|(variable, _)| *variable == wanted);
    own.map_or_else(|| sample(wanted, point), |&(_, value)| value)
}

/// A coefficient and the powers of variables.
type Monomial = (f64, Vec<(Variable, f64)>);

/// A sum of products of variables, as x − c.
struct Shift(Vec<Monomial>);

impl Shift {
    /// Of a node; `None` for others.
    fn of(graph: &Graph, id: NodeId) -> Option<Shift> {
        let Node::Sum { terms, .. } = graph.node(id) else { return None };
        let power = |&(factor, Exponent(half)): &(NodeId, Exponent)| match graph.node(factor) {
            Node::Variable(variable) => Some((*variable, f64::from(half) / 2.0)),
            _ => None,
        };
        let monomial = |&(term, coefficient): &(NodeId, Number)| {
            let powers = match graph.node(term) {
                Node::Product(factors) => factors.iter().map(power).collect::<Option<Vec<_>>>()?,
                _ => vec![power(&(term, Exponent(2)))?],
            };
            Some((coefficient.value(), powers))
        };
        terms.iter().map(monomial).collect::<Option<_>>().map(Shift)
    }

    fn variables(&self) -> impl Iterator<Item = Variable> + '_ {
        self.0.iter().flat_map(|(_, powers)| powers).map(|&(variable, _)| variable)
    }

    /// A variable of one term alone, and the value by which the sum stays as it is at a point beside others
    /// that have changed; `None` if none has, or no variable can.
    fn taking_up(&self, changed: &[(Variable, f64)], point: u32) -> Option<(Variable, f64)> {
        let has_changed = |wanted: Variable| changed.iter().any(|&(own, _)| own == wanted);
        if !self.variables().any(has_changed) {
            return None;
        }
        let is_alone = |wanted: Variable| self.variables().filter(|&own| own == wanted).count() == 1;
        let fits = |&(own, power): &(Variable, f64)| power == 1.0 && !has_changed(own) && is_alone(own);
        let (variable, _) = self.0.iter().flat_map(|(_, powers)| powers).copied().find(fits)?;
        let sum = |at: &dyn Fn(Variable) -> f64| {
            let value = |(coefficient, powers): &Monomial| {
                powers.iter().fold(*coefficient, |product, &(own, power)| product * at(own).powf(power))
            };
            self.0.iter().map(value).sum::<f64>()
        };
        let before = sum(&|own| sample(own, point));
        // The sum is linear in the variable.
        let [at_zero, at_one] = [0.0, 1.0]
            .map(|value| sum(&|own| if own == variable { value } else { value_of(own, changed, point) }));
        Some((variable, (before - at_zero) / (at_one - at_zero)))
    }
}

/// The rounding errors of two nodes with these values of variables, in units of ε.
fn roundings(graph: &Graph, roots: [NodeId; 2], variable: &dyn Fn(Variable) -> f64) -> [f64; 2] {
    let cone = graph.cone(roots);
    let values = graph.evaluate(&cone, variable);
    let mut gathered: Vec<f64> = Vec::with_capacity(cone.len());
    let at = |id: NodeId| cone.binary_search(&id).expect("accuracy: an operand outside the cone");
    for (&id, &value) in cone.iter().zip(&values) {
        let own = value.abs();
        let carried: f64 = match graph.node(id) {
            Node::Constant(_) | Node::Variable(_) | Node::Unary(..) | Node::Binary(..) => 0.0,
            Node::Sum { terms, .. } => {
                terms.iter().map(|&(term, c)| c.value().abs() * gathered[at(term)]).sum()
            }
            Node::Product(factors) => {
                let relative = |&(factor, exponent): &(NodeId, crate::expr::Exponent)| {
                    let i = at(factor);
                    f64::from(exponent.0).abs() / 2.0 * gathered[i] / values[i].abs()
                };
                own * factors.iter().map(relative).sum::<f64>()
            }
        };
        gathered.push(own + carried);
    }
    roots.map(|root| gathered[at(root)])
}

/// The value of a variable: for parameters between 0.3 and 1.7, for others between −1.5 and 1.5.
fn sample(variable: Variable, point: u32) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let (kind, index) = match variable {
        Variable::Coordinate(index) => (1, index),
        Variable::Velocity(index) => (2, index),
        Variable::Time => (3, 0),
        Variable::Input(index) => (4, index),
        Variable::Auxiliary(index) => (5, index),
        Variable::Acceleration(index) => (6, index),
        Variable::Multiplier(index) => (7, index),
        Variable::Position(index) => (8, index),
        Variable::Entry(index) => (9, index),
        Variable::Parameter(index) => {
            return 0.3 + 1.4 * (GOLDEN * f64::from(7 * index + 3 * point + 1)).fract();
        }
    };
    3.0 * (GOLDEN * f64::from(11 * index + 5 * point + kind)).fract() - 1.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_of_differences_lose_digits_when_multiplied_out() {
        let mut g = Graph::new();
        let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
        let difference = g.sub(x, y);
        let square = g.powi(difference, 2);
        let (xx, xy, yy) = (g.powi(x, 2), g.mul(x, y), g.powi(y, 2));
        let terms = [(xx, Number::ONE), (xy, Number::integer(-2)), (yy, Number::ONE)];
        let sum = g.sum(Number::ZERO, &terms);
        assert!(!keeps_digits(&g, square, sum));
        assert!(keeps_digits(&g, sum, square));
    }

    #[test]
    fn sums_with_large_terms_lose_digits_when_multiplied_out() {
        let mut g = Graph::new();
        let [x, y, c, w] = [
            Variable::Coordinate(0),
            Variable::Coordinate(1),
            Variable::Parameter(0),
            Variable::Parameter(1),
        ]
        .map(|variable| g.variable(variable));
        let [z, e] = [g.sub(x, c), g.sub(y, c)];
        // z + z², (z + w)² + (z − w)², z e + w
        let square = g.powi(z, 2);
        let quadratic = g.add(z, square);
        let sides = [g.add(z, w), g.sub(z, w)].map(|side| g.powi(side, 2));
        let even = g.add(sides[0], sides[1]);
        let product = g.mul(z, e);
        let bilinear = g.add(product, w);
        let [xx, cc, ww] = [x, c, w].map(|x| g.powi(x, 2));
        let [xc, xy, cy] = [g.mul(x, c), g.mul(x, y), g.mul(c, y)];
        let [one, two, minus] = [1, 2, -1].map(Number::integer);
        let open = [(xx, one), (xc, -two), (cc, one)];
        let flat_quadratic = g.sum(Number::ZERO, &[(x, one), (c, minus), open[0], open[1], open[2]]);
        let flat_even = g.sum(Number::ZERO, &[(xx, two), (xc, -two - two), (cc, two), (ww, two)]);
        let flat_bilinear = g.sum(Number::ZERO, &[(xy, one), (xc, minus), (cy, minus), (cc, one), (w, one)]);
        for (before, after) in [(quadratic, flat_quadratic), (even, flat_even), (bilinear, flat_bilinear)] {
            assert!(!keeps_digits(&g, before, after));
            assert!(keeps_digits(&g, after, before));
        }
    }
}
