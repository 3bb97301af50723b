//! Euler–Lagrange jets: Taylor recurrences on the Lagrangian itself.
//!
//! With p = ∂L/∂v and f = ∂L/∂q + Q the equations of motion are d/dt p = f. On normalised Taylor coefficients
//! x\[k] along the motion that reads (k + 1) p\[k + 1] = f\[k] and (k + 1) q\[k + 1] = v\[k], and p\[k + 1] is affine in
//! the unknown v\[k + 1] with the mass matrix at the point of expansion:
//!
//! M v\[k + 1] = f\[k] / (k + 1) − p\[k + 1] at v\[k + 1] = 0.
//!
//! No time derivative, no Coriolis term and no inverse is ever formed. [`auxiliary`] makes p and f polynomial,
//! [`recurrence`] sorts the operations of the polynomial by when their coefficients of one order are known.
//! Pryce and Nedialkov (*Solving differential-algebraic equations by Taylor series*, BIT 2005) have the
//! mathematics.

mod auxiliary;
mod recurrence;

use crate::expr::{Graph, NodeId};
use crate::mechanics::Equations;
use crate::model::Model;
use crate::schedule::plan;
use crate::simplify::simplify;
pub use auxiliary::{Relation, Value};
use auxiliary::{NotSmooth, Rewriter};
pub use recurrence::{Coefficient, Jets, Lane, Operand, Series};

/// The recurrences of a system; `None` where its equations have kinks or jumps, at which no series exists.
pub fn derive(model: &mut Model, equations: &Equations) -> Option<Jets> {
    let count = equations.momenta.len();
    let roots: Vec<NodeId> = equations.momenta.iter().chain(&equations.momentum_rates).copied().collect();
    let simpler = simplify(&mut model.graph, &mut model.hints, &roots);
    let simple = recurrences(&mut model.graph, count, &simpler).ok()?;
    let plain = recurrences(&mut model.graph, count, &roots).ok()?;
    Some(if plain.cost() <= simple.cost() { plain } else { simple })
}

/// The recurrences of d/dt p = f for `roots` p and f.
fn recurrences(graph: &mut Graph, count: usize, roots: &[NodeId]) -> Result<Jets, NotSmooth> {
    let mut rewriter = Rewriter::new(graph, count);
    let mut polynomials = Vec::with_capacity(roots.len());
    for &root in roots {
        polynomials.push(rewriter.polynomial(root)?);
    }
    let auxiliaries = std::mem::take(&mut rewriter.auxiliaries);
    for auxiliary in &auxiliaries {
        match &auxiliary.relation {
            Relation::Flow(rate) => polynomials.push(*rate),
            Relation::Chain(terms) => polynomials.extend(terms.iter().flat_map(|&(a, b)| [a, b])),
            Relation::Power(base, _) => polynomials.push(*base),
        }
        polynomials.extend(operands(&auxiliary.value));
    }
    let program = plan(graph, &polynomials);
    Ok(Jets::of(program, auxiliaries, count))
}

fn operands(value: &Value<NodeId>) -> Vec<NodeId> {
    match *value {
        Value::Unary(_, x) | Value::Power(x, _) => vec![x],
        Value::Binary(_, x, y) => vec![x, y],
    }
}

