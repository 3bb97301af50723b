//! Functions that can hide from a Taylor series.
//!
//! An exponential, a wall ∝ r⁻¹² or a smoothed sign v/√(v² + ε²) vanishes beside other terms, or underflows,
//! a few of its widths away, and the series there does not show it. Neither does it show x²² or cos⁴⁰t from
//! near their zeros. Sines, cosines and the powers of gravitation are as large as anything else wherever a
//! series starts.

use super::sides::{Switch, forms};
use crate::collections::Lookup;
use crate::expr::{Binary, Dependence, Exponent, Graph, Node, NodeId, Unary};
use crate::number::Number;

/// This power, counted in halves, and those below it are steep: x⁻⁴, or s⁻⁴ of a squared distance s.
const STEEPEST: i32 = -8;

/// The lowest positive power, counted in halves, that is flat: a series from near its zero to fewer orders
/// does not show it. Of lower ones the orders of a tolerance of 1e-4 and finer see something: x⁷ as a force
/// enters the coordinate at order nine, and these are ten.
const FLATTEST: i32 = 16;

/// The most functions whose arguments are looked at in a step. Those of all pairs of hundreds of bodies would
/// cost more than the step itself.
const MOST: usize = 256;

/// What such functions depend on, along a motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hidden {
    /// Whether functions hide at all, beside roots.
    pub is_steep: bool,
    /// The arguments of functions. Those of opposite ones are listed once.
    pub arguments: Vec<NodeId>,
    /// The bases of powers, and the largest power of each without its sign.
    pub bases: Vec<(NodeId, u32)>,
    /// Functions that vanish where others have a kink or a pole: what a root or a logarithm is taken of, and
    /// what divides.
    pub roots: Vec<NodeId>,
    /// The angles that all these turn with. Where forces hardly change, a series is good for several turns,
    /// and a few places of the step would tell nothing of a function of the angle.
    pub angles: Vec<NodeId>,
}

impl Hidden {
    /// All of them: arguments, bases, roots, angles.
    pub fn all(&self) -> Vec<NodeId> {
        let bases = self.bases.iter().map(|&(base, _)| base);
        let (arguments, roots) = (self.arguments.iter().copied(), self.roots.iter().copied());
        arguments.chain(bases).chain(roots).chain(self.angles.iter().copied()).collect()
    }

    /// The line in `STRUCTURE`.
    pub fn describe(&self) -> String {
        if !self.is_steep {
            return "steps are compared with the equations where a root or a denominator comes near zero"
                .to_owned();
        }
        let functions = match self.arguments.len() + self.bases.len() {
            0 => return "steep: steps are compared with the equations".to_owned(),
            1 => "a function".to_owned(),
            count => format!("{count} functions"),
        };
        format!("steep: steps are compared with the equations, also where {functions} may be narrow")
    }
}

/// Finds what the functions in the equations depend on that can hide from a series. The `divisors` divide in
/// what solves the equations. `None` means that no function can.
pub(super) fn hidden(
    graph: &mut Graph,
    roots: &[NodeId],
    divisors: &[NodeId],
    switches: &[Switch],
) -> Option<Hidden> {
    let mut found = found(graph, (roots, divisors), switches, argument_of)?;
    found.angles = angles(graph, found.all());
    found.angles.truncate(MOST);
    Some(found)
}

/// The angles whose sines, cosines and tangents are in these functions.
fn angles(graph: &Graph, functions: Vec<NodeId>) -> Vec<NodeId> {
    let mut angles = Vec::new();
    for id in graph.cone(functions) {
        match *graph.node(id) {
            Node::Unary(Unary::Sin | Unary::Cos | Unary::Tan, angle)
                if is_known(graph, angle) && !angles.contains(&angle) =>
            {
                angles.push(angle);
            }
            _ => {}
        }
    }
    angles
}

/// The same of functions beside the equations, whose roots have no say in a step. They count where they are
/// largest, so that a square is looked at by itself: its vertex is the middle of a Gaussian.
pub fn hidden_beside(graph: &mut Graph, root: &[NodeId], switches: &[Switch]) -> Option<Hidden> {
    let hidden = found(graph, (root, &[]), switches, argument_itself).filter(|hidden| hidden.is_steep)?;
    Some(Hidden { roots: Vec::new(), ..hidden })
}

/// What can hide in these functions, by what `argument` makes of the argument of one, and beside divisors.
fn found(
    graph: &mut Graph,
    (roots, divisors): (&[NodeId], &[NodeId]),
    switches: &[Switch],
    argument: impl Fn(&mut Graph, NodeId) -> NodeId,
) -> Option<Hidden> {
    let mut found = Found::default();
    for &divisor in divisors {
        found.base(graph, divisor, 1);
    }
    for id in graph.cone(roots.iter().copied()) {
        if graph.dependence(id).is_fixed() {
            continue;
        }
        match graph.node(id).clone() {
            Node::Unary(function, of) if hides(function) => {
                let own = argument(graph, of);
                found.argument(graph, own);
            }
            Node::Unary(function, argument) if is_singular(function) => {
                let root = vanishing(graph, function, argument);
                found.root(graph, root);
            }
            Node::Binary(Binary::Powf | Binary::PowfLn, base, exponent) => {
                let power = graph.as_constant(exponent).map_or(1.0, |power| power.value().abs().ceil());
                found.base(graph, base, power as u32);
            }
            Node::Binary(Binary::Atan2, y, x) => {
                let [y, x] = [y, x].map(|side| graph.powi(side, 2));
                let square = graph.add(y, x);
                found.base(graph, square, 1);
            }
            Node::Product(factors) => {
                let is_flat = order_of_zero(graph, &factors) >= FLATTEST;
                for (base, power) in factors {
                    let is_steep = is_flat && flatness(graph, base, power) > 0;
                    if is_steep || is_steep_somewhere(graph, base, power, switches) {
                        found.base(graph, base, power.0.unsigned_abs().div_ceil(2));
                        // A base that is smallest somewhere may also pass zero.
                        if power.0 < 0 && has_either_sign(graph, base) {
                            found.root(graph, base);
                        }
                    } else if is_singular_power(graph, base, power) {
                        found.root(graph, base);
                    }
                }
            }
            _ => {}
        }
    }
    found.hidden.arguments.truncate(MOST);
    found.hidden.bases.truncate(MOST - found.hidden.arguments.len());
    found.hidden.roots.truncate(MOST - found.hidden.arguments.len() - found.hidden.bases.len());
    (found.hidden.is_steep || !found.hidden.roots.is_empty()).then_some(found.hidden)
}

/// Functions that have been found.
#[derive(Default)]
struct Found {
    /// The places of arguments and bases in their lists.
    seen: Lookup<(NodeId, bool), usize>,
    hidden: Hidden,
}

impl Found {
    fn argument(&mut self, graph: &Graph, argument: NodeId) {
        self.hidden.is_steep = true;
        if is_known(graph, argument) && self.seen.insert((argument, false), 0).is_none() {
            self.hidden.arguments.push(argument);
        }
    }

    fn base(&mut self, graph: &Graph, base: NodeId, power: u32) {
        self.hidden.is_steep = true;
        let bases = &mut self.hidden.bases;
        match self.seen.get(&(base, true)) {
            Some(&place) => bases[place].1 = bases[place].1.max(power),
            None if is_known(graph, base) => {
                self.seen.insert((base, true), bases.len());
                bases.push((base, power.max(1)));
            }
            None => {}
        }
    }

    fn root(&mut self, graph: &Graph, root: NodeId) {
        if is_known(graph, root) && !self.hidden.roots.contains(&root) {
            self.hidden.roots.push(root);
        }
    }
}

/// The argument of a function, with a positive sign.
fn argument_itself(graph: &mut Graph, argument: NodeId) -> NodeId {
    let (coefficient, _) = graph.scaled(argument);
    if coefficient.is_negative() { graph.neg(argument) } else { argument }
}

/// The same, but of a square its root, which shows by its sign where it passes zero: as much of
/// exp(−(x/w)²) as of any function of x/w lies between −1 and 1.
fn argument_of(graph: &mut Graph, argument: NodeId) -> NodeId {
    let (coefficient, node) = graph.scaled(argument);
    let positive = argument_itself(graph, argument);
    let mut factors = graph.factors(node);
    let is_moving = |graph: &Graph, node: NodeId| !graph.dependence(node).is_fixed();
    if factors.iter().any(|&(factor, power)| power.0 % if is_moving(graph, factor) { 4 } else { 2 } != 0) {
        return positive;
    }
    for (factor, power) in &mut factors {
        power.0 /= 2;
        if power.as_integer().is_none() {
            *factor = graph.unary(Unary::Abs, *factor);
        }
    }
    let root = graph.product(&factors);
    graph.sum(Number::ZERO, &[(root, coefficient.abs().sqrt())])
}

/// Whether a function has a kink or a pole where some function of its argument vanishes.
fn is_singular(function: Unary) -> bool {
    matches!(
        function,
        Unary::Tan
            | Unary::Asin
            | Unary::Acos
            | Unary::Atanh
            | Unary::Acosh
            | Unary::Ln
            | Unary::Ln1p
            | Unary::Cbrt
    )
}

/// That function.
fn vanishing(graph: &mut Graph, function: Unary, argument: NodeId) -> NodeId {
    let mut beside_one = |power: i32, sign: Number| {
        let other = graph.powi(argument, power);
        graph.sum(Number::ONE, &[(other, sign)])
    };
    match function {
        Unary::Asin | Unary::Acos | Unary::Atanh | Unary::Acosh => beside_one(2, Number::MINUS_ONE),
        Unary::Ln1p => beside_one(1, Number::ONE),
        Unary::Tan => graph.unary(Unary::Cos, argument),
        _ => argument,
    }
}

/// Whether a power that is not steep has a kink or a pole where its base vanishes, and a motion may come
/// there: a root, or a pole that the base crosses. Of the poles of r⁻³ and higher ones, which are those of
/// gravitation, series know.
fn is_singular_power(graph: &Graph, base: NodeId, exponent: Exponent) -> bool {
    match exponent.as_integer() {
        _ if graph.dependence(base).is_fixed() => false,
        Some(power) => power < 0 && has_either_sign(graph, base),
        None => exponent.0 >= -1,
    }
}

/// Whether a function may be positive and negative, as far as its form tells. Parameters count as positive.
fn has_either_sign(graph: &Graph, node: NodeId) -> bool {
    if graph.dependence(node).is_fixed() {
        return false;
    }
    match graph.node(node) {
        Node::Sum { offset, terms } => {
            offset.is_negative()
                || terms.iter().any(|&(term, c)| c.is_negative() || has_either_sign(graph, term))
        }
        Node::Product(factors) => {
            factors.iter().any(|&(factor, power)| power.0 % 4 == 2 && has_either_sign(graph, factor))
        }
        Node::Unary(function, _) => {
            !matches!(function, Unary::Exp | Unary::Cosh | Unary::Sech | Unary::Logistic | Unary::Abs)
        }
        _ => true,
    }
}

/// Whether a node changes with the state or with time, and is known there.
pub(super) fn is_known(graph: &Graph, node: NodeId) -> bool {
    let moving = Dependence::COORDINATES.union(Dependence::VELOCITIES).union(Dependence::TIME);
    let dependence = graph.dependence(node);
    dependence.meets(moving) && !dependence.meets(Dependence::MULTIPLIERS)
}

/// Whether a power is steep on some side of the switches in its base.
fn is_steep_somewhere(graph: &mut Graph, base: NodeId, exponent: Exponent, switches: &[Switch]) -> bool {
    is_steep_power(graph, base, exponent)
        && forms(graph, base, switches, &|_, _| [true; 2])
            .is_none_or(|forms| forms.into_iter().any(|form| is_steep_power(graph, form, exponent)))
}

/// How many derivatives of a product, counted in halves, vanish where all its factors do that are powers
/// above the second. Others are the products of sines and cosines of mechanisms, which are not zero together.
fn order_of_zero(graph: &Graph, factors: &[(NodeId, Exponent)]) -> i32 {
    factors.iter().map(|&(base, power)| flatness(graph, base, power)).sum()
}

/// The same of one factor. A sum of other than variables, such as 1 − cos x or x² + y², may have a double
/// zero.
fn flatness(graph: &Graph, base: NodeId, power: Exponent) -> i32 {
    if power.0 <= 4 || graph.dependence(base).is_fixed() {
        return 0;
    }
    let is_variable = |node: NodeId| matches!(graph.node(node), Node::Variable(_));
    let is_curved = |&(term, _): &(NodeId, Number)| {
        let mut moving = graph.factors(term);
        moving.retain(|&(factor, _)| !graph.dependence(factor).is_fixed());
        moving.iter().any(|&(factor, power)| power.0 != 2 || !is_variable(factor)) || moving.len() > 1
    };
    match graph.node(base) {
        Node::Sum { terms, .. } if terms.iter().any(is_curved) => 2 * power.0,
        _ => power.0,
    }
}

fn hides(function: Unary) -> bool {
    match function {
        Unary::Exp
        | Unary::ExpM1
        | Unary::Sinh
        | Unary::Cosh
        | Unary::Tanh
        | Unary::Sech
        | Unary::Logistic
        | Unary::Asinh
        | Unary::Atan => true,
        Unary::Sin
        | Unary::Cos
        | Unary::Tan
        | Unary::Asin
        | Unary::Acos
        | Unary::Acosh
        | Unary::Atanh
        | Unary::Ln
        | Unary::Ln1p
        | Unary::Cbrt
        | Unary::Abs
        | Unary::Signum
        | Unary::PositivePart
        | Unary::Step
        | Unary::Below => false,
    }
}

/// Whether a power is [`STEEPEST`] or below, or is a root or reciprocal of a sum with a fixed part, which is
/// how kinks are smoothed.
fn is_steep_power(graph: &Graph, base: NodeId, exponent: Exponent) -> bool {
    if graph.dependence(base).is_fixed() {
        return false;
    }
    let smooths = |node: &Node| match node {
        Node::Sum { offset, terms } => {
            !offset.is_zero() || terms.iter().any(|&(term, _)| graph.dependence(term).is_fixed())
        }
        _ => false,
    };
    let is_root = exponent.as_integer().is_none();
    let is_kink = if is_root { !is_difference(graph, base) } else { exponent.0 < 0 };
    exponent.0 <= STEEPEST || is_kink && smooths(graph.node(base))
}

/// Whether the base is L² − y², the square of a side of a triangle. Its root is as large as anything else
/// until it vanishes.
fn is_difference(graph: &Graph, base: NodeId) -> bool {
    let Node::Sum { offset, terms } = graph.node(base) else { return false };
    let is_square =
        |node: NodeId| graph.factors(node).iter().all(|&(_, exponent)| exponent.0 > 0 && exponent.0 % 4 == 0);
    let (fixed, moving): (Vec<_>, Vec<_>) =
        terms.iter().partition(|&&(term, _)| graph.dependence(term).is_fixed());
    !offset.is_negative()
        && fixed.iter().all(|&&(term, c)| is_square(term) && !c.is_negative())
        && moving.iter().all(|&&(term, c)| is_square(term) && c.is_negative())
}

#[cfg(test)]
mod tests;
