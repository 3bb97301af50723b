//! Euler–Lagrange jets: Taylor recurrences on the Lagrangian itself.
//!
//! With p = ∂L/∂v and f = ∂L/∂q + Q the equations of motion are d/dt p = f. On normalised Taylor coefficients
//! x\[k] along the motion that reads (k + 1) p\[k + 1] = f\[k] and (k + 1) q\[k + 1] = v\[k], and p\[k + 1]
//! is affine in the unknown v\[k + 1] with the mass matrix at the point of expansion:
//!
//! M v\[k + 1] = f\[k] / (k + 1) − p\[k + 1] at v\[k + 1] = 0.
//!
//! Constraints join at the level of velocities: with w = df/dt or g, each order of w is affine in v\[k + 1]
//! with A = ∂w/∂v at the point of expansion, and each order of Aᵀλ in λ\[k]. Shifted by one order, μ\[k + 1]
//! = λ\[k], multipliers are unknowns of the same order as the velocities, and both come from one solution of
//! the saddle-point system with M and A:
//!
//! M v\[k + 1] − Aᵀμ\[k + 1] / (k + 1) = …,  A v\[k + 1] = −w\[k + 1] at v\[k + 1] = 0.
//!
//! So the series obeys the constraints at every order, although they are differentiated once only.
//!
//! Where a momentum is Σ a b and the force has all terms of Σ a′ b, as with points at given positions, d/dt s
//! = f − Σ a′ b with s′ = Σ a b′ has fewer products (`parts`).
//!
//! The recurrences have no Coriolis terms and no inverse of M. `auxiliary` makes p and f polynomial,
//! `recurrence` sorts the operations of the polynomial by when their coefficients of one order are known.
//! Pryce and Nedialkov (*Solving differential-algebraic equations by Taylor series*, BIT 2005) have the
//! mathematics.

mod auxiliary;
mod bundles;
mod conditions;
mod followed;
mod parts;
mod recurrence;
mod rewriting;
mod sides;
mod steep;
mod watched;

use crate::expr::{Dependence, Graph, NodeId};
use crate::mechanics::Equations;
use crate::model::Model;
use crate::number::Number;
use crate::schedule::plan;
use crate::simplify::simplify;
use auxiliary::{Auxiliary, NotSmooth, Rewriter};
pub use auxiliary::{Relation, Value};
pub use bundles::{Bundle, bundles};
use conditions::Restrictions;
pub use followed::Along;
pub use recurrence::{Coefficient, Convolution, Jets, Operand, Series};
use rewriting::{contract_angles, meet_flows};
pub use sides::Switch;
pub use steep::{Hidden, hidden_beside};
pub use watched::Watched;

/// The most convolutions whose outermost terms are kept out of the tables. The sweep over these terms would
/// wait for the row just written; with more convolutions there is other work in between.
pub const FEW: usize = 16;

/// The most nodes of a system whose forms are compared. Each form costs time in proportion to the nodes, so
/// of larger systems only the plainest are made.
const COMPARABLE: usize = 4_000;

/// What depends on the state of a system on the sides of its switches and can hide from a step, if anything
/// can; and the recurrences, `None` if the equations have kinks or jumps, where no series exists.
pub fn derive(
    model: &mut Model,
    equations: &Equations,
    switches: &[Switch],
) -> (Option<Hidden>, Option<Jets>) {
    let count = equations.momenta.len();
    let conditions = &equations.conditions;
    let mut roots: Vec<NodeId> = equations.momenta.iter().chain(&equations.momentum_rates).copied().collect();
    let restrictions = Restrictions::of(&mut model.graph, conditions, count);
    roots.extend(restrictions.reactions.iter().chain(&restrictions.rates));
    roots.extend(conditions.relaxation.iter().flatten());
    let scope = Scope { coordinates: count, turning: &equations.turning, switches };
    let lengths = lengths_of_gradients(&mut model.graph, &conditions.jacobian);
    let hidden = steep::hidden(&mut model.graph, &roots, &lengths, switches);
    (hidden, shortest(&mut *model, equations, scope, (roots, restrictions)))
}

/// The squared lengths of the gradients that depend on velocities: those of Chetaev's rule. Where one of them
/// vanishes, as where a motion stops, nothing determines its reaction and how the motion goes on, though a
/// series may lead past it.
fn lengths_of_gradients(graph: &mut Graph, jacobian: &[Vec<NodeId>]) -> Vec<NodeId> {
    let depends = |graph: &Graph, row: &[NodeId]| {
        row.iter().any(|&entry| graph.dependence(entry).meets(Dependence::VELOCITIES))
    };
    let rows = jacobian.iter().filter(|row| depends(graph, row)).collect::<Vec<_>>();
    rows.into_iter()
        .map(|row| {
            let squares: Vec<_> = row.iter().map(|&entry| (graph.powi(entry, 2), Number::ONE)).collect();
            graph.sum(Number::ZERO, &squares)
        })
        .collect()
}

/// The shortest recurrences.
fn shortest(
    model: &mut Model,
    equations: &Equations,
    scope: Scope<'_>,
    (mut roots, restrictions): (Vec<NodeId>, Restrictions),
) -> Option<Jets> {
    let conditions = &equations.conditions;
    let (followed, along) = followed::of(&mut model.graph, equations, scope);
    roots.extend(&followed);
    let counts = Counts {
        coordinates: scope.coordinates,
        constraints: conditions.count(),
        relaxed: conditions.relaxation.is_some(),
        followed: followed.len(),
    };
    let mut forms = vec![roots];
    if model.graph.cone(forms[0].iter().copied()).len() <= COMPARABLE {
        forms.push(simplify(&mut model.graph, &mut model.hints, &forms[0]));
        for index in 0..forms.len() {
            let contracted = contract_angles(&mut model.graph, &forms[index]);
            if contracted != forms[index] {
                forms.push(contracted);
            }
        }
    }
    let mut best: Option<Jets> = None;
    for form in forms {
        for by_parts in [false, true] {
            for meeting in [false, true] {
                let proposal = Proposal { by_parts, meeting };
                let jets = recurrences(&mut model.graph, counts, scope, &form, proposal).ok()?;
                // With few products an order takes as long as the path from its velocities to its sums. The
                // rates b′ make that path longer.
                if let Some(jets) = jets
                    && (!by_parts || jets.convolutions.len() > FEW)
                    && best.as_ref().is_none_or(|best| jets.cost() < best.cost())
                {
                    best = Some(jets);
                }
            }
        }
    }
    if let Some(jets) = &mut best {
        jets.gradients = restrictions.gradients;
        jets.along = along;
    }
    best
}

/// What the series of a system have in common.
#[derive(Clone, Copy)]
struct Scope<'a> {
    coordinates: usize,
    /// The orientations whose matrices are variables.
    turning: &'a [usize],
    switches: &'a [Switch],
}

/// The number of roots of each kind.
#[derive(Clone, Copy, Debug)]
struct Counts {
    coordinates: usize,
    constraints: usize,
    /// Whether the constraints' rates are not zero but given.
    relaxed: bool,
    /// The number of functions that are followed.
    followed: usize,
}

/// An equal form of polynomial equations.
#[derive(Clone, Copy)]
struct Proposal {
    /// Momenta integrated by parts.
    by_parts: bool,
    /// Products multiplied out where that makes the flow of an auxiliary.
    meeting: bool,
}

/// The recurrences of d/dt p = f. The roots are p, f, of a constrained system Aᵀμ, w and, with stabilisation,
/// dw/dt, and the functions that are followed. `None` if there is nothing to integrate by parts.
fn recurrences(
    graph: &mut Graph,
    counts: Counts,
    scope: Scope,
    roots: &[NodeId],
    Proposal { by_parts, meeting }: Proposal,
) -> Result<Option<Jets>, NotSmooth> {
    let mut rewriter = Rewriter::new(graph, scope);
    let mut polynomials = rewriter.polynomials(roots)?;
    let mut auxiliaries = std::mem::take(&mut rewriter.auxiliaries);
    if by_parts {
        let direction = std::mem::take(&mut rewriter.rates);
        let rates = parts::Rates { direction: &direction, auxiliaries: &auxiliaries };
        let added = parts::by_parts(graph, &mut polynomials, counts.coordinates, &rates);
        if added.is_empty() {
            return Ok(None);
        }
        auxiliaries.extend(added);
    }
    if meeting {
        let flow = |auxiliary: &Auxiliary| match auxiliary.relation {
            Relation::Flow(rate) => Some(rate),
            _ => None,
        };
        let flows: Vec<NodeId> = auxiliaries.iter().filter_map(flow).collect();
        polynomials = meet_flows(graph, &polynomials, &flows, &mut auxiliaries);
    }
    for auxiliary in &auxiliaries {
        match &auxiliary.relation {
            Relation::Chain(terms) => polynomials.extend(terms.iter().flat_map(|&(a, b)| [a, b])),
            Relation::Flow(node) | Relation::Power(node, _) | Relation::Same(node) => polynomials.push(*node),
        }
        polynomials.extend(operands(&auxiliary.value));
    }
    let program = plan(graph, &polynomials);
    Ok(Some(Jets::of(program, auxiliaries, counts)))
}

fn operands(value: &Value<NodeId>) -> Vec<NodeId> {
    match *value {
        Value::Unary(_, x) | Value::Power(x, _) | Value::Same(x) => vec![x],
        Value::Binary(_, x, y) => vec![x, y],
    }
}
