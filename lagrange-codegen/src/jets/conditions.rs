//! Constraints in the form whose series cost least.
//!
//! A motion that obeys w = 0 also obeys s w = 0 with any factor s that does not vanish. The multipliers
//! become those of s w, which the motion does not show. So a constraint on a distance, d/dt |r| = r · v /
//! |r|, loses its root.

use crate::calculus::pullback;
use crate::expr::{Dependence, Graph, NodeId, Variable};
use crate::mechanics::{Conditions, Switched};
use crate::number::Number;

/// The constraints of a series.
#[derive(Clone, Debug, Default)]
pub(super) struct Restrictions {
    /// s w.
    pub rates: Vec<NodeId>,
    /// Their gradients by the velocities, a row each.
    pub gradients: Vec<Vec<NodeId>>,
    /// The contributions of their multipliers to the momentum rates, by coordinate.
    pub reactions: Vec<NodeId>,
}

impl Restrictions {
    /// Removes the denominators of the rates, unless some rows hold at times only or the rates are given
    /// values other than zero.
    pub fn of(graph: &mut Graph, conditions: &Conditions, coordinates: usize) -> Restrictions {
        let plain = Restrictions {
            rates: conditions.rates.clone(),
            gradients: conditions.jacobian.clone(),
            reactions: conditions.reactions.clone(),
        };
        // Friction is limited by the multipliers of the rows as the user wrote them.
        if let Some(switched) = &conditions.switched {
            return plain.with_sums(graph, switched);
        }
        if conditions.relaxation.is_some() {
            return plain;
        }
        let rates: Vec<NodeId> = plain.rates.iter().map(|&rate| numerator(graph, rate)).collect();
        if rates == plain.rates {
            return plain;
        }
        let velocities: Vec<NodeId> =
            (0..coordinates as u32).map(|i| graph.variable(Variable::Velocity(i))).collect();
        let one = graph.one();
        let gradients = rates.iter().map(|&rate| pullback(graph, &[(rate, one)], &velocities)).collect();
        let seeds: Vec<(NodeId, NodeId)> = rates
            .iter()
            .enumerate()
            .map(|(c, &rate)| (rate, graph.variable(Variable::Multiplier(c as u32))))
            .collect();
        let reactions = pullback(graph, &seeds, &velocities);
        Restrictions { rates, gradients, reactions }
    }

    /// Sets the rates of rows of sums: the sum of other multipliers times their factors, less the row's own
    /// multiplier. The coefficients of such a sum follow as those of other rates do.
    fn with_sums(mut self, graph: &mut Graph, switched: &Switched) -> Restrictions {
        for (row, terms) in switched.sums() {
            let mut multiplier = |row: usize| graph.variable(Variable::Multiplier(row as u32));
            let own = multiplier(row);
            let others: Vec<NodeId> = terms.iter().map(|&(other, _)| multiplier(other)).collect();
            let mut sum = vec![(own, Number::MINUS_ONE)];
            for (&(_, factor), other) in terms.iter().zip(others) {
                sum.push((graph.mul(factor, other), Number::ONE));
            }
            self.rates[row] = graph.sum(Number::ZERO, &sum);
        }
        self
    }
}

/// A product without its denominators that do not depend on velocities. They are not zero anywhere that the
/// product has a value.
fn numerator(graph: &mut Graph, rate: NodeId) -> NodeId {
    let (coefficient, product) = graph.scaled(rate);
    let denominators: Vec<_> = graph
        .factors(product)
        .into_iter()
        .filter(|&(factor, exponent)| {
            exponent.0 < 0 && !graph.dependence(factor).meets(Dependence::VELOCITIES)
        })
        .collect();
    if denominators.is_empty() {
        return rate;
    }
    let numerator = graph.without(product, &denominators);
    graph.sum(Number::ZERO, &[(numerator, coefficient)])
}
