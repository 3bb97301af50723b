//! The equations as a linear function of lumped parameters: M a + b = Y(q, v, a, t) π.
//!
//! L = Σ πₖ Lₖ with monomials πₖ of the parameters and Lₖ without any, so the columns of Y are Lagrange's
//! expressions of the Lₖ. Monomials that multiply the same Lₖ form one lumped parameter. Those that do not
//! enter the equations are left out (Siciliano et al., *Robotics*, section 7.2.2; Khalil and Dombre,
//! *Modeling, Identification and Control of Robots*, section 9.4).

use super::monomials::polynomial;
use crate::calculus::{pullback, pushforward};
use crate::expr::{NodeId, Variable};
use crate::kinematics::time_direction;
use crate::mechanics::Equations;
use crate::model::Model;
use crate::number::Number;
use crate::simplify::simplify;

/// Y and π.
#[derive(Clone, Debug)]
pub struct Regressor {
    /// π, functions of the parameters.
    pub lumped: Vec<NodeId>,
    /// Y with the accelerations as variables, a column for each lumped parameter.
    pub columns: Vec<Vec<NodeId>>,
}

impl Regressor {
    /// Takes L apart; `None` if it is no polynomial in the parameters, or one with too many terms.
    pub fn of(model: &mut Model, equations: &Equations) -> Option<Regressor> {
        let lagrangian = lagrangian(model, equations);
        let parts = polynomial(&mut model.graph, lagrangian)?;
        let (monomials, values): (Vec<NodeId>, Vec<NodeId>) = parts.into_iter().unzip();
        let values = simplify(&mut model.graph, &mut model.hints, &values);

        let graph = &mut model.graph;
        let mut groups: Vec<(NodeId, Vec<(NodeId, Number)>)> = Vec::new();
        for (monomial, value) in monomials.into_iter().zip(values) {
            let (scale, value) = graph.scaled(value);
            match groups.iter_mut().find(|(other, _)| *other == value) {
                Some((_, terms)) => terms.push((monomial, scale)),
                None => groups.push((value, vec![(monomial, scale)])),
            }
        }
        let count = equations.momenta.len() as u32;
        let direction = time_direction(graph, equations.momenta.len());
        let q: Vec<NodeId> = (0..count).map(|i| graph.variable(Variable::Coordinate(i))).collect();
        let v: Vec<NodeId> = (0..count).map(|i| graph.variable(Variable::Velocity(i))).collect();
        let a: Vec<NodeId> = (0..count).map(|i| graph.variable(Variable::Acceleration(i))).collect();
        let one = graph.one();
        let moving: Vec<_> = direction.into_iter().chain(v.iter().copied().zip(a)).collect();
        let mut regressor = Regressor { lumped: Vec::new(), columns: Vec::new() };
        for (value, terms) in groups {
            let momenta = pullback(graph, &[(value, one)], &v);
            let rates = pushforward(graph, &momenta, &moving);
            let forces = pullback(graph, &[(value, one)], &q);
            let column: Vec<NodeId> =
                rates.into_iter().zip(forces).map(|(rate, force)| graph.sub(rate, force)).collect();
            if column.iter().any(|&entry| !graph.is_zero(entry)) {
                // The first monomial has coefficient one.
                let scale = terms[0].1;
                let inverse = scale.recip().unwrap_or(Number::ONE);
                let terms: Vec<_> = terms.into_iter().map(|(node, c)| (node, c * inverse)).collect();
                regressor.lumped.push(graph.sum(Number::ZERO, &terms));
                regressor.columns.push(column.into_iter().map(|entry| graph.scale(entry, scale)).collect());
            }
        }
        Some(regressor)
    }
}

/// L = T − V, or L from the momenta if a Lagrangian is given as a whole.
fn lagrangian(model: &mut Model, equations: &Equations) -> NodeId {
    let graph = &mut model.graph;
    if model.lagrangian.is_empty() {
        return graph.sub(equations.kinetic_energy, equations.potential_energy);
    }
    let integral = equations.jacobi_integral.unwrap_or(equations.energy);
    let mut terms: Vec<_> = (0..equations.momenta.len())
        .map(|i| {
            let v = graph.variable(Variable::Velocity(i as u32));
            (graph.mul(equations.momenta[i], v), Number::ONE)
        })
        .collect();
    terms.push((integral, Number::MINUS_ONE));
    graph.sum(Number::ZERO, &terms)
}
