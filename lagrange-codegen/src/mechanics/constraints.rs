//! Constraints: their time derivatives, gradients, reactions and power.
//!
//! With A = ∂f/∂q of the holonomic constraints f(q, t) = 0 and A = ∂g/∂v of the nonholonomic ones g(q, v, t)
//! = 0 (affine: d'Alembert; otherwise Chetaev's rule), the equations of motion are
//!
//! M a + b = Q − ∂D/∂v + Aᵀλ,  A a = γ,
//!
//! where A a = γ is the second time derivative of f and the first of g. Multipliers belong to the constraints
//! as the user wrote them (Lanczos, *The Variational Principles of Mechanics*, chapter II.12; Neimark and
//! Fufaev, *Dynamics of Nonholonomic Systems*, chapter III).

use super::mass::MassMatrix;
use super::motion::Motion;
use super::places;
use crate::calculus::{pullback, pushforward, substitute, velocity_degrees};
use crate::expr::{Exponent, Graph, Node, NodeId, Unary, Variable};
use crate::kinematics::slopes;
use crate::model::{Constraint, ConstraintKind, Model};
use crate::number::Number;

/// The contributions of a model's constraints, one entry for each constraint unless said otherwise.
#[derive(Clone, Debug, Default)]
pub struct Conditions {
    /// f of the holonomic constraints, zero for the others.
    pub positions: Vec<NodeId>,
    /// Σ |summands of f|, by which its rounding errors are measured.
    pub position_sizes: Vec<NodeId>,
    /// w: df/dt of the holonomic constraints, g of the others.
    pub rates: Vec<NodeId>,
    /// Σ |summands of w|.
    pub rate_sizes: Vec<NodeId>,
    /// A, a row for each constraint.
    pub jacobian: Vec<Vec<NodeId>>,
    /// γ.
    pub gamma: Vec<NodeId>,
    /// Aᵀμ with multipliers as variables, one entry for each coordinate.
    pub reactions: Vec<NodeId>,
    /// −A v on the constraints: the power that a unit multiplier takes from the motion. For holonomic
    /// constraints it is ∂f/∂t.
    pub losses: Vec<NodeId>,
    /// The Cartesian force of a unit multiplier on each of the model's places, by constraint, place and
    /// component.
    pub on_places: Vec<Vec<Vec<NodeId>>>,
    /// dw/dt with Baumgarte's stabilisation; `None` without, where it is zero.
    pub relaxation: Option<Vec<NodeId>>,
    /// The terms of rows that are constraints at times: contacts and frictions.
    pub switched: Option<Switched>,
}

/// Rows that are constraints at times, with the friction that reactions drive.
#[derive(Clone, Debug)]
pub struct Switched {
    /// The force of each row's reaction beside that along the row's gradient, by coordinate.
    pub coupling: Vec<Vec<NodeId>>,
    /// One for each row that holds, and zero for the others.
    pub active: Vec<NodeId>,
    /// The last rows, which are loads instead of constraints.
    pub loads: Vec<LoadRow>,
}

/// A row that is no constraint. Its multiplier follows from those of others.
#[derive(Clone, Debug)]
pub enum LoadRow {
    /// The sum of these multipliers, each with a factor.
    Sum(Vec<(usize, NodeId)>),
    /// The size of the force that has these components.
    Size(Vec<usize>),
}

impl Switched {
    /// Rows of sums, each with the rows and factors of its summands.
    pub fn sums(&self) -> impl Iterator<Item = (usize, &[(usize, NodeId)])> {
        let first = self.active.len() - self.loads.len();
        self.loads.iter().enumerate().filter_map(move |(place, load)| match load {
            LoadRow::Sum(terms) => Some((first + place, terms.as_slice())),
            LoadRow::Size(_) => None,
        })
    }
}

impl Conditions {
    /// The values that a factorisation needs of rows that hold at times: their coupling, whether they hold,
    /// and the factors of sums of multipliers.
    pub fn switches(&self) -> Vec<NodeId> {
        let Some(switched) = &self.switched else { return Vec::new() };
        let factors = switched.sums().flat_map(|(_, terms)| terms).map(|(_, factor)| factor);
        switched.coupling.iter().flatten().chain(&switched.active).chain(factors).copied().collect()
    }

    /// Whether some rows are no constraints.
    pub fn has_loads(&self) -> bool {
        self.switched.as_ref().is_some_and(|switched| !switched.loads.is_empty())
    }

    /// Adds rows that are no constraints.
    pub fn add_rows(&mut self, graph: &mut Graph, count: usize) {
        let zero = graph.zero();
        let width = self.jacobian.first().map_or(0, Vec::len);
        for list in [
            &mut self.positions,
            &mut self.position_sizes,
            &mut self.rates,
            &mut self.rate_sizes,
            &mut self.gamma,
            &mut self.losses,
        ] {
            list.resize(list.len() + count, zero);
        }
        self.jacobian.resize(self.jacobian.len() + count, vec![zero; width]);
        let places = self.on_places.first().cloned().unwrap_or_default();
        let nothing = places.into_iter().map(|force| vec![zero; force.len()]).collect();
        self.on_places.resize(self.on_places.len() + count, nothing);
    }

    /// Differentiates all constraints of a system with this mass matrix.
    pub(super) fn of(model: &mut Model, motion: &Motion, mass: &MassMatrix) -> Conditions {
        if model.constraints.is_empty() {
            return Conditions::default();
        }
        let (constraints, baumgarte) = (model.constraints.clone(), model.baumgarte);
        let graph = &mut model.graph;
        let (zero, one) = (graph.zero(), graph.one());
        let values: Vec<NodeId> = constraints.iter().map(|constraint| constraint.value).collect();
        let changes = pushforward(graph, &values, &motion.direction);
        let time = graph.variable(Variable::Time);
        let explicit = pushforward(graph, &values, &[(time, one)]);
        let rates: Vec<NodeId> = (0..values.len())
            .map(|c| if is_holonomic(&constraints[c]) { changes[c] } else { values[c] })
            .collect();
        let curvature = pushforward(graph, &rates, &motion.direction);
        let mut gamma: Vec<NodeId> = curvature.into_iter().map(|change| graph.neg(change)).collect();

        let jacobian: Vec<Vec<NodeId>> = constraints
            .iter()
            .map(|constraint| {
                let seeds = [(constraint.value, one)];
                match is_holonomic(constraint) {
                    true => slopes(graph, &seeds, &motion.q, &motion.turning),
                    false => pullback(graph, &seeds, &motion.v),
                }
            })
            .collect();
        let multipliers: Vec<NodeId> =
            (0..values.len() as u32).map(|c| graph.variable(Variable::Multiplier(c))).collect();
        let reactions = reactions(graph, &constraints, &multipliers, motion);
        let losses = (0..values.len())
            .map(|c| {
                if is_holonomic(&constraints[c]) {
                    explicit[c]
                } else {
                    drift(graph, values[c], &jacobian[c], motion)
                }
            })
            .collect();
        let on_places = places::forces(graph, &constraints, &model.places, &jacobian, motion);
        let positions: Vec<NodeId> = constraints
            .iter()
            .map(|constraint| if is_holonomic(constraint) { constraint.value } else { zero })
            .collect();
        let mut sizes = |values: &[NodeId], of: &[NodeId]| -> Vec<NodeId> {
            values
                .iter()
                .zip(&jacobian)
                .map(|(&value, row)| size_of(graph, value, row, of, mass.rows()))
                .collect()
        };
        let (position_sizes, rate_sizes) = (sizes(&positions, &motion.q), sizes(&rates, &motion.v));
        let relaxation = baumgarte.map(|rate| {
            let square = graph.powi(rate, 2);
            let terms = constraints.iter().zip(&positions).zip(&rates);
            terms
                .map(|((constraint, &position), &w)| {
                    let damping = graph.mul(rate, w);
                    let stiffness = graph.mul(square, position);
                    let twice = if is_holonomic(constraint) { Number::Ratio(2, 1) } else { Number::ONE };
                    graph.sum(Number::ZERO, &[(damping, -twice), (stiffness, Number::MINUS_ONE)])
                })
                .collect::<Vec<_>>()
        });
        if let Some(relaxation) = &relaxation {
            for (gamma, &change) in gamma.iter_mut().zip(relaxation) {
                *gamma = graph.add(*gamma, change);
            }
        }
        Conditions {
            positions,
            position_sizes,
            rates,
            rate_sizes,
            jacobian,
            gamma,
            reactions,
            losses,
            on_places,
            relaxation,
            switched: None,
        }
    }

    /// The number of constraints.
    pub fn count(&self) -> usize {
        self.rates.len()
    }

    /// The power v·Aᵀλ of the reactions, with the multipliers as variables.
    pub fn power(&self, graph: &mut Graph) -> NodeId {
        let terms: Vec<_> = (0..self.count())
            .map(|c| {
                let multiplier = graph.variable(Variable::Multiplier(c as u32));
                (graph.mul(multiplier, self.losses[c]), Number::MINUS_ONE)
            })
            .collect();
        graph.sum(Number::ZERO, &terms)
    }

    /// The entries of A and γ.
    pub fn roots(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.jacobian.iter().flatten().chain(&self.gamma).copied()
    }
}

fn is_holonomic(constraint: &Constraint) -> bool {
    constraint.kind == ConstraintKind::Holonomic
}

/// g − ∂g/∂v · v, which for a constraint affine in v is the part without v.
fn drift(graph: &mut Graph, value: NodeId, gradient: &[NodeId], motion: &Motion) -> NodeId {
    if velocity_degrees(graph, value).at_most(1) {
        let zero = graph.zero();
        let at_rest: Vec<_> = motion.v.iter().map(|&v| (v, zero)).collect();
        return substitute(graph, &[value], &at_rest)[0];
    }
    let mut terms = vec![(value, Number::ONE)];
    terms.extend(gradient.iter().zip(&motion.v).map(|(&a, &v)| (graph.mul(a, v), Number::MINUS_ONE)));
    graph.sum(Number::ZERO, &terms)
}

/// Aᵀμ by one reverse sweep, without writing the gradients out.
fn reactions(
    graph: &mut Graph,
    constraints: &[Constraint],
    multipliers: &[NodeId],
    motion: &Motion,
) -> Vec<NodeId> {
    let seeds = |holonomic: bool| -> Vec<(NodeId, NodeId)> {
        let all = constraints.iter().zip(multipliers);
        all.filter(|(constraint, _)| is_holonomic(constraint) == holonomic)
            .map(|(constraint, &multiplier)| (constraint.value, multiplier))
            .collect()
    };
    let through_q = slopes(graph, &seeds(true), &motion.q, &motion.turning);
    let through_v = pullback(graph, &seeds(false), &motion.v);
    through_q.into_iter().zip(through_v).map(|(q, v)| graph.add(q, v)).collect()
}

/// The scale of a constraint's rounding errors. A constraint without summands, such as z = 0, has none of its
/// own and takes that of the state: Σ |∂f/∂q[i]| |q[j]|, where √(M[j][j] / M[i][i]) relates coordinates of
/// different units.
fn size_of(
    graph: &mut Graph,
    value: NodeId,
    gradient: &[NodeId],
    state: &[NodeId],
    mass: &[Vec<NodeId>],
) -> NodeId {
    let own = size(graph, value);
    let is_sum =
        |factor: NodeId| graph.scaled(factor).1 == factor && matches!(graph.node(factor), Node::Sum { .. });
    let factors = graph.factors(graph.scaled(value).1);
    let has_summands = factors.into_iter().any(|(factor, exponent)| exponent.0 > 0 && is_sum(factor));
    if has_summands || graph.is_zero(value) {
        return own;
    }
    let inertia: Vec<NodeId> = (0..state.len()).map(|i| graph.unary(Unary::Abs, mass[i][i])).collect();
    // √M[i][i] is a unit only where it is constant: another one may vanish.
    let is_unit =
        |graph: &Graph, i: usize| !graph.is_zero(inertia[i]) && graph.dependence(inertia[i]).is_fixed();
    let mut terms = vec![(own, Number::ONE)];
    for i in (0..gradient.len()).filter(|&i| !graph.is_zero(gradient[i])).collect::<Vec<_>>() {
        let slope = graph.unary(Unary::Abs, gradient[i]);
        for j in 0..state.len() {
            let mut factors = vec![(slope, Exponent(2)), (graph.unary(Unary::Abs, state[j]), Exponent(2))];
            if is_unit(graph, i) && !graph.is_zero(inertia[j]) {
                factors.extend([(inertia[j], Exponent(1)), (inertia[i], Exponent(-1))]);
            }
            terms.push((graph.product(&factors), Number::ONE));
        }
    }
    graph.sum(Number::ZERO, &terms)
}

/// The scale of the rounding error of a value: the sum of the absolute values of its summands. The rounding
/// error of a sum within a product is multiplied by the other factors, as a small change of that sum would
/// be. For example, (a − b)² with large a and b and a small difference has the scale 2 |a − b| (|a| + |b|).
fn size(graph: &mut Graph, value: NodeId) -> NodeId {
    match graph.node(value).clone() {
        Node::Sum { offset, terms } => summed(graph, offset, terms, size),
        Node::Product(factors) => {
            // A root is measured by the root of the summands' sizes. For the root of a sum of squares that is
            // right even where it vanishes: √(a² + b²) changes by no more than a and b do.
            let is_whole = |exponent: Exponent| exponent.0 > 0 && exponent.0 % 2 == 0;
            let absolute = absolute(graph, &factors, |exponent| !is_whole(exponent));
            let mut changes = Vec::new();
            for (k, &(factor, exponent)) in factors.iter().enumerate() {
                if is_whole(exponent) && matches!(graph.node(factor), Node::Sum { .. }) {
                    let mut product = absolute.clone();
                    product[k].1 = Exponent(exponent.0 - 2);
                    product.push((size(graph, factor), Exponent(2)));
                    changes.push((graph.product(&product), Number::halves(exponent.0)));
                }
            }
            if changes.is_empty() { graph.product(&absolute) } else { graph.sum(Number::ZERO, &changes) }
        }
        _ => graph.unary(Unary::Abs, value),
    }
}

/// The value with all summands positive, also within products.
fn magnitude(graph: &mut Graph, value: NodeId) -> NodeId {
    match graph.node(value).clone() {
        Node::Sum { offset, terms } => summed(graph, offset, terms, magnitude),
        Node::Product(factors) => {
            let absolute = absolute(graph, &factors, |_| true);
            graph.product(&absolute)
        }
        _ => graph.unary(Unary::Abs, value),
    }
}

/// |offset| + Σ |c| · `of` a term.
fn summed(
    graph: &mut Graph,
    offset: Number,
    terms: Vec<(NodeId, Number)>,
    of: fn(&mut Graph, NodeId) -> NodeId,
) -> NodeId {
    let terms: Vec<_> = terms.into_iter().map(|(term, c)| (of(graph, term), c.abs())).collect();
    graph.sum(offset.abs(), &terms)
}

/// Factors without their signs. A sum to a positive power of which `of_summands` holds is replaced by its
/// [`magnitude`].
fn absolute(
    graph: &mut Graph,
    factors: &[(NodeId, Exponent)],
    of_summands: impl Fn(Exponent) -> bool,
) -> Vec<(NodeId, Exponent)> {
    let absolute = |&(factor, exponent): &(NodeId, Exponent)| {
        let is_sum = exponent.0 > 0 && matches!(graph.node(factor), Node::Sum { .. });
        let factor = if is_sum && of_summands(exponent) {
            magnitude(graph, factor)
        } else {
            graph.unary(Unary::Abs, factor)
        };
        (factor, exponent)
    };
    factors.iter().map(absolute).collect()
}
