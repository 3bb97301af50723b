//! Checks of constraints that restrict nothing, too much, or something else than they say.

use super::exactness::is_exact;
use super::matching::Matching;
use crate::calculus::{beyond_degree, pullback};
use crate::diagnostics::{Diagnostics, Origin, physics};
use crate::expr::{Dependence, Exponent, Graph, Node, NodeId, Unary, Variable};
use crate::model::{Constraint, ConstraintKind, Model};
use crate::number::Number;
use crate::simplify::simplify;

/// A constraint with its gradient, ∂f/∂q or ∂g/∂v.
struct Row {
    constraint: Constraint,
    gradient: Vec<NodeId>,
    /// The columns in which the gradient is not zero.
    columns: Vec<usize>,
    /// Whether a mistake in it is reported.
    faulty: bool,
}

/// Reports mistakes in constraints. Returns the patterns of the gradients that can be independent.
pub(in crate::mechanics) fn constraints(
    model: &mut Model,
    allows: &dyn Fn(&str) -> bool,
    diagnostics: &mut Diagnostics,
) -> Vec<Vec<bool>> {
    let mut rows: Vec<Row> = Vec::with_capacity(model.constraints.len());
    // Rows that hold at times need not hold together.
    let always = model.constraints.len() - model.at_times.len();
    for (place, constraint) in model.constraints.clone().into_iter().enumerate() {
        let gradient = gradient(model, &constraint);
        let fault = fault(model, &constraint, &gradient, place >= always, allows);
        let faulty = fault.is_some();
        if let Some((origin, message)) = fault {
            diagnostics.at(origin, message);
        }
        let columns = (0..gradient.len()).filter(|&i| !model.graph.is_zero(gradient[i])).collect();
        rows.push(Row { constraint, gradient, columns, faulty });
    }
    for later in 1..always {
        for earlier in 0..later {
            if let Some(message) = repetition(model, &rows[earlier], &rows[later], allows)
                && !std::mem::replace(&mut rows[later].faulty, true)
            {
                diagnostics.at(rows[later].constraint.origin, message);
            }
        }
    }
    for (slip, normal) in model.at_times.clone().into_iter().enumerate() {
        let slip = &rows[always + slip];
        if let Some(normal) = normal.and_then(|normal| rows.get(normal))
            && is_rate(&mut model.graph, slip, normal)
        {
            let message =
                physics::slip_along_normal(&slip.constraint.written(), &normal.constraint.written());
            diagnostics.at(slip.constraint.origin, message);
        }
    }
    let count = model.coordinates.len();
    let pattern = |row: &Row| -> Vec<bool> {
        let mut pattern = vec![false; count];
        row.columns.iter().for_each(|&column| pattern[column] = true);
        pattern
    };
    let patterns: Vec<Vec<bool>> = rows.iter().map(pattern).collect();
    let mut matching = Matching::new(count, |row: usize, column: usize| patterns[row][column]);
    let mut independent = Vec::with_capacity(rows.len());
    for (place, row) in rows.iter().enumerate().take(always) {
        if matching.add(place) {
            independent.push(patterns[place].clone());
        } else if !row.faulty && !allows("redundant") {
            diagnostics.at(row.constraint.origin, physics::overdetermined(&row.constraint.written()));
        }
    }
    independent
}

fn gradient(model: &mut Model, constraint: &Constraint) -> Vec<NodeId> {
    let variable = match constraint.kind {
        ConstraintKind::Holonomic => Variable::Coordinate,
        ConstraintKind::Nonholonomic { .. } => Variable::Velocity,
    };
    let graph = &mut model.graph;
    let variables: Vec<NodeId> =
        (0..model.coordinates.len() as u32).map(|i| graph.variable(variable(i))).collect();
    let one = graph.one();
    pullback(graph, &[(constraint.value, one)], &variables)
}

/// The mistake in a constraint by itself, and its origin. A constraint on velocities that holds at times is a
/// friction.
fn fault(
    model: &mut Model,
    constraint: &Constraint,
    gradient: &[NodeId],
    at_times: bool,
    allows: &dyn Fn(&str) -> bool,
) -> Option<(Origin, String)> {
    let name = constraint.written();
    let at_name = |message: String| Some((constraint.origin, message));
    let moving = match constraint.kind {
        ConstraintKind::Holonomic => Dependence::COORDINATES,
        ConstraintKind::Nonholonomic { .. } => Dependence::VELOCITIES,
    };
    if gradient.iter().all(|&slope| model.graph.is_zero(slope)) {
        let eliminated = !model.eliminated.is_empty();
        let depends = model.graph.dependence(constraint.value).meets(Dependence::COORDINATES);
        return at_name(match constraint.kind {
            ConstraintKind::Nonholonomic { .. } if at_times => physics::slip_without_velocity(&name),
            ConstraintKind::Nonholonomic { .. } if depends => physics::without_velocity(&name),
            _ => physics::restrains_nothing(&name, eliminated),
        });
    }
    if constraint.kind == (ConstraintKind::Nonholonomic { chetaev: false }) {
        let beyond = beyond_degree(&model.graph, constraint.value, 1);
        // A constraint is affine in the velocities, too, if its terms of higher degree cancel.
        if !beyond.is_empty() {
            let slopes = simplify(&mut model.graph, &mut model.hints, gradient);
            if slopes.iter().any(|&slope| model.graph.dependence(slope).meets(Dependence::VELOCITIES)) {
                let place = model.origin_in(constraint, &beyond);
                let message = match at_times {
                    true => physics::slip_not_affine(&name),
                    false => physics::not_affine_in_velocities(&name),
                };
                return Some((place, message));
            }
        }
    }
    if let Some(advice) = vanishing_gradient(&model.graph, constraint.value, moving) {
        let place = model.origin_in(constraint, &[model.graph.scaled(constraint.value).1]);
        return Some((place, physics::vanishing_gradient(&name, advice)));
    }
    let is_affine =
        || gradient.iter().all(|&slope| !model.graph.dependence(slope).meets(Dependence::VELOCITIES));
    if moving == Dependence::VELOCITIES
        && !allows("integrable")
        && is_affine()
        && is_exact(model, constraint.value, gradient)
    {
        return at_name(physics::integrable(&name));
    }
    None
}

/// A remedy for an expression whose gradient vanishes, or has no value, wherever the expression is zero.
fn vanishing_gradient(graph: &Graph, value: NodeId, moving: Dependence) -> Option<&'static str> {
    let (_, value) = graph.scaled(value);
    let moves = |node: NodeId| graph.dependence(node).meets(moving);
    if let Node::Unary(Unary::Abs, _) = graph.node(value) {
        return Some("leave out `abs`");
    }
    let factors = graph.factors(value);
    let mut bases = factors.iter().filter(|&&(factor, _)| moves(factor));
    let is_power = bases.clone().all(|&(_, exponent)| exponent != Exponent(2));
    let is_norm = |base: NodeId| is_sum_of_squares(graph, base, moving);
    match bases.next() {
        Some(&(base, _)) if is_norm(base) && bases.next().is_none() => {
            Some("let it return the components as an array instead of their norm")
        }
        Some(_) if is_power => Some("write the base without the power"),
        _ => None,
    }
}

/// Whether an expression is a sum of squares, so that it vanishes only where all its terms do.
fn is_sum_of_squares(graph: &Graph, base: NodeId, moving: Dependence) -> bool {
    let Node::Sum { offset, terms } = graph.node(base) else { return false };
    let is_square = |&(term, _): &(NodeId, Number)| {
        graph.dependence(term).meets(moving)
            && graph.factors(term).iter().all(|(_, exponent)| exponent.0 > 0 && exponent.0 % 4 == 0)
    };
    let negative = terms.first().is_some_and(|&(_, coefficient)| coefficient.is_negative());
    offset.is_zero()
        && terms.len() > 1
        && terms.iter().all(|&(_, coefficient)| coefficient.is_negative() == negative)
        && terms.iter().all(is_square)
}

/// The ratio of the gradients of two rows, if these are parallel everywhere.
fn ratio(graph: &mut Graph, earlier: &Row, later: &Row) -> Option<NodeId> {
    if earlier.faulty || later.faulty || earlier.columns != later.columns {
        return None;
    }
    let mut ratio = None;
    for &column in &later.columns {
        let quotient = graph.div(later.gradient[column], earlier.gradient[column]);
        if *ratio.get_or_insert(quotient) != quotient {
            return None;
        }
    }
    ratio
}

/// Whether a slip is a multiple of the rate of a gap or constraint.
fn is_rate(graph: &mut Graph, slip: &Row, normal: &Row) -> bool {
    ratio(graph, normal, slip).is_some_and(|ratio| graph.as_constant(ratio).is_some())
}

/// Whether a constraint repeats an earlier one: their gradients are parallel everywhere.
fn repetition(
    model: &mut Model,
    earlier: &Row,
    later: &Row,
    allows: &dyn Fn(&str) -> bool,
) -> Option<String> {
    let graph = &mut model.graph;
    let ratio = ratio(graph, earlier, later)?;
    let (name, other) = (later.constraint.written(), earlier.constraint.written());
    if earlier.constraint.kind == later.constraint.kind
        && let Some(factor) = graph.as_constant(ratio)
    {
        let difference = graph
            .sum(Number::ZERO, &[(later.constraint.value, Number::ONE), (earlier.constraint.value, -factor)]);
        let difference = simplify(graph, &mut model.hints, &[difference])[0];
        if model.graph.as_constant(difference).is_some_and(|difference| !difference.is_zero()) {
            return Some(physics::contradiction(&name, &other));
        }
    }
    (!allows("redundant")).then(|| physics::repetition(&name, &other))
}
