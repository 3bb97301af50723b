//! Constraints that are solved for a coordinate instead of being kept: Model to [`Model`] with fewer
//! coordinates.
//!
//! A constraint f(q, t) = 0 in which a coordinate e has a coefficient of parameters alone gives e = φ(q, t)
//! of the others and of time. φ and its total time derivative take the places of e and of its velocity in
//! every quantity. By d'Alembert's principle, δe = Σ ∂φ/∂qᵢ δqᵢ, a generalized force on e acts on the others
//! with the weights ∂φ/∂qᵢ; all other forces follow from what is substituted.

pub(crate) mod quantities;

use crate::calculus::{pullback, pushforward, sizes, substitute};
use crate::diagnostics::{Diagnostics, Origin, physics};
use crate::expr::{Exponent, Graph, Node, NodeId, Variable};
use crate::kinematics::{slopes, turning_direction};
use crate::model::{Action, Eliminated, Elimination, Force, Model, orientation};
use crate::simplify::simplify;

/// A coordinate, and its value as a function of the others and of time.
struct Solved {
    coordinate: usize,
    position: NodeId,
}

/// Carries out the eliminations of a model, or reports why it cannot.
pub fn eliminate(model: &mut Model, diagnostics: &mut Diagnostics) {
    // Sizes are taken from the functions as written. Once a coordinate is eliminated it cancels in its
    // constraint, though not in the user's function.
    let known = orientation::of_parameters(&mut model.graph, &model.turning);
    for reading in &mut model.readings {
        let nodes = substitute(&mut model.graph, &reading.nodes, &known);
        reading.sizes = sizes(&mut model.graph, &nodes);
    }
    let eliminations = std::mem::take(&mut model.eliminations);
    let Some(first) = eliminations.first() else { return };
    let named: Vec<usize> = eliminations.iter().filter_map(|elimination| elimination.coordinate).collect();
    let mut solved: Vec<Solved> = Vec::new();
    for elimination in &eliminations {
        match solve(model, elimination, &named, &solved) {
            Ok(one) => {
                let graph = &mut model.graph;
                let coordinate = graph.variable(Variable::Coordinate(one.coordinate as u32));
                for earlier in &mut solved {
                    earlier.position =
                        substitute(graph, &[earlier.position], &[(coordinate, one.position)])[0];
                }
                solved.push(one);
            }
            Err((origin, message)) => diagnostics.at(origin, message),
        }
    }
    if solved.len() == model.coordinates.len() {
        diagnostics.at(first.origin, physics::all_eliminated());
    }
    if !diagnostics.has_errors() {
        solved.sort_by_key(|one| one.coordinate);
        remove(model, &solved);
    }
}

/// Matrices of orientations and angular velocities as functions of a state's numbers, in every quantity.
pub fn in_parameters(model: &mut Model) {
    let turning = std::mem::take(&mut model.turning);
    let known = orientation::of_parameters(&mut model.graph, &turning);
    quantities::rewrite(model, &known);
}

/// Solves a constraint for a coordinate.
fn solve(
    model: &mut Model,
    elimination: &Elimination,
    named: &[usize],
    solved: &[Solved],
) -> Result<Solved, (Origin, String)> {
    let Elimination { constraint, coordinate, origin } = elimination;
    let graph = &mut model.graph;
    let q: Vec<NodeId> =
        (0..model.coordinates.len() as u32).map(|i| graph.variable(Variable::Coordinate(i))).collect();
    let known: Vec<(NodeId, NodeId)> = solved.iter().map(|one| (q[one.coordinate], one.position)).collect();
    let value = substitute(graph, &[constraint.value], &known)[0];
    let one = graph.one();
    let slopes = pullback(graph, &[(value, one)], &q);
    // A slope may turn out to be constant only after its terms have cancelled.
    let slopes = simplify(graph, &mut model.hints, &slopes);
    let graph = &mut model.graph;

    let quantity = |coordinate: usize| model.coordinates[coordinate].written();
    let occurs = |coordinate: &usize| !graph.is_zero(slopes[*coordinate]);
    let is_fixed = |coordinate: &usize| graph.dependence(slopes[*coordinate]).is_fixed();
    let refused = |message: String| Err((*origin, message));
    let coordinate = match *coordinate {
        Some(coordinate) if solved.iter().any(|one| one.coordinate == coordinate) => {
            return refused(physics::eliminated_twice(&quantity(coordinate)));
        }
        Some(coordinate) if !occurs(&coordinate) => {
            let free = |i: &usize| occurs(i) && is_fixed(i) && !named.contains(i);
            let others: Vec<String> = (0..q.len()).filter(free).map(quantity).collect();
            let name = constraint.written();
            return refused(match others.is_empty() {
                true => physics::nothing_to_eliminate(&name),
                false => physics::absent_coordinate(&quantity(coordinate), &name, &others.join("`, `")),
            });
        }
        Some(coordinate) => coordinate,
        None => {
            let oriented = |i: usize| orientation::holds(&model.orientations, i);
            let free: Vec<usize> =
                (0..q.len()).filter(|i| occurs(i) && !named.contains(i) && !oriented(*i)).collect();
            match free.iter().rev().find(|i| is_fixed(i)).or(free.last()) {
                Some(&last) => last,
                None => return refused(physics::nothing_to_eliminate(&constraint.written())),
            }
        }
    };
    if !is_fixed(&coordinate) {
        let culprits = not_affine(graph, constraint.value, q[coordinate]);
        let origin = model.origin_in(constraint, &culprits);
        return Err((origin, physics::not_solvable(&constraint.written(), &quantity(coordinate))));
    }
    let zero = graph.zero();
    let rest = substitute(graph, &[value], &[(q[coordinate], zero)])[0];
    let quotient = graph.div(rest, slopes[coordinate]);
    Ok(Solved { coordinate, position: graph.neg(quotient) })
}

/// The nodes of an expression, ascending, that are not affine in a variable with a coefficient of parameters
/// alone.
fn not_affine(graph: &Graph, root: NodeId, variable: NodeId) -> Vec<NodeId> {
    let mut moves = vec![false; graph.len()];
    let mut culprits: Vec<NodeId> = Vec::new();
    for id in graph.cone([root]) {
        let mut depends = id == variable;
        let mut is_affine = true;
        graph.operands(id, |operand| {
            depends |= moves[operand.index()];
            is_affine &= culprits.binary_search(&operand).is_err();
        });
        moves[id.index()] = depends;
        is_affine &= match graph.node(id) {
            Node::Constant(_) | Node::Variable(_) | Node::Sum { .. } => true,
            Node::Product(factors) => {
                let moving = |&&(factor, _): &&(NodeId, Exponent)| moves[factor.index()];
                let once = factors.iter().filter(moving).count() == 1;
                once && factors.iter().all(|&(factor, exponent)| {
                    graph.dependence(factor).is_fixed() || (moves[factor.index()] && exponent == Exponent(2))
                })
            }
            Node::Unary(..) | Node::Binary(..) => false,
        };
        if depends && !is_affine {
            culprits.push(id);
        }
    }
    culprits
}

/// Takes the solved coordinates, ascending, out of the model and numbers the others anew.
fn remove(model: &mut Model, solved: &[Solved]) {
    let count = model.coordinates.len();
    let index_of = |coordinate: usize| solved.iter().position(|one| one.coordinate == coordinate);
    let rest: Vec<usize> = (0..count).filter(|&coordinate| index_of(coordinate).is_none()).collect();
    let graph = &mut model.graph;
    let direction = turning_direction(graph, count, &model.turning);
    let (q, v): (Vec<NodeId>, Vec<NodeId>) = direction[..count].iter().copied().unzip();
    let positions: Vec<NodeId> = solved.iter().map(|one| one.position).collect();
    let velocities = pushforward(graph, &positions, &direction);

    let one = graph.one();
    let weights: Vec<Vec<NodeId>> =
        positions.iter().map(|&position| slopes(graph, &[(position, one)], &q, &model.turning)).collect();
    let mut torques = Vec::new();
    for force in &mut model.forces {
        let Action::Generalized(entries) = &mut force.action else { continue };
        let mut turned = Vec::new();
        let mut shared = Vec::with_capacity(entries.len());
        for &(coordinate, load) in entries.iter() {
            let Some(index) = index_of(coordinate) else {
                shared.push((coordinate, load));
                continue;
            };
            for &i in &rest {
                let share = model.graph.mul(weights[index][i], load);
                if model.graph.is_zero(share) {
                    continue;
                }
                match orientation::holds(&model.turning, i) {
                    true => turned.push((v[i], share)),
                    false => shared.push((i, share)),
                }
            }
        }
        for (coordinate, _) in &mut shared {
            *coordinate = rest.iter().position(|i| i == coordinate).unwrap_or_default();
        }
        *entries = shared;
        if !turned.is_empty() {
            torques.push(Force { action: Action::Along(turned), ..force.clone() });
        }
    }
    model.forces.extend(torques);

    let mut replacements: Vec<(NodeId, NodeId)> = Vec::with_capacity(2 * count);
    for (new, &old) in rest.iter().enumerate() {
        replacements.push((q[old], q[new]));
        replacements.push((v[old], v[new]));
    }
    let both = [positions, velocities].concat();
    let both = substitute(&mut model.graph, &both, &replacements);
    let (positions, velocities) = both.split_at(solved.len());
    for (index, one) in solved.iter().enumerate() {
        replacements.push((q[one.coordinate], positions[index]));
        replacements.push((v[one.coordinate], velocities[index]));
    }
    quantities::rewrite(model, &replacements);

    for first in model.orientations.iter_mut().chain(&mut model.turning) {
        *first = rest.iter().position(|i| i == first).unwrap_or_default();
    }
    for (declared_index, quantity) in std::mem::take(&mut model.coordinates).into_iter().enumerate() {
        let Some(index) = index_of(declared_index) else {
            model.coordinates.push(quantity);
            continue;
        };
        let (position, velocity) = (positions[index], velocities[index]);
        let label = quantity.label();
        for (node, name) in [(position, label.clone()), (velocity, format!("{label}_dot"))] {
            if !matches!(model.graph.node(node), Node::Constant(_) | Node::Variable(_)) {
                model.hints.suggest(node, name);
            }
        }
        model.eliminated.push(Eliminated { quantity, declared_index, position, velocity });
    }
}
