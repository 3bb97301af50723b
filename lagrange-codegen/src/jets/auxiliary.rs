//! Everything but sums and products becomes an auxiliary with a relation between Taylor series.
//!
//! What is left of a set of roots is polynomial in the variables and the auxiliaries, and the Taylor
//! coefficients of a polynomial are convolutions. Three kinds of relations are enough for the whole language
//! (Knuth, *The Art of Computer Programming* 2, 4.7; Griewank and Walther, *Evaluating Derivatives*, 13.2):
//!
//! * y = xᵉ satisfies x y′ = e x′ y: no division but one by x at the point of expansion;
//! * y = f(x) with x linear along the motion, x′ = Σ c v: y′ = f′(x) x′ is a product of the system itself,
//!   which velocities and momenta often share (sin θ and cos θ need cos θ · θ′ and sin θ · θ′, which are ẏ
//!   and ẋ of a rod);
//! * any other y = f(x₁, …) satisfies y′ = Σ ∂f/∂xᵢ · xᵢ′, taken on the series of xᵢ.

use super::Scope;
use super::sides::{self, Switch};
use crate::calculus::{derivative, partial_derivatives, pushforward, velocity_degrees};
use crate::collections::Lookup;
use crate::expr::{Binary, Dependence, Exponent, Graph, Node, NodeId, Unary, Variable};
use crate::kinematics::turning_direction;
use crate::number::Number;

/// The variables that change during a step. Inputs are held constant.
const MOVING: Dependence = Dependence::COORDINATES
    .union(Dependence::VELOCITIES)
    .union(Dependence::TIME)
    .union(Dependence::MULTIPLIERS);

/// A function value with its series.
#[derive(Clone, Debug)]
pub struct Auxiliary {
    /// The node of the given roots that it stands for; a power stands for itself.
    pub origin: NodeId,
    /// The value at the point of expansion.
    pub value: Value<NodeId>,
    /// The relation from which the other coefficients follow.
    pub relation: Relation<NodeId>,
}

/// A value of order zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value<T> {
    /// A function of one argument.
    Unary(Unary, T),
    /// A function of two arguments.
    Binary(Binary, T, T),
    /// A power.
    Power(T, Exponent),
    /// The value of a polynomial.
    Same(T),
}

/// A relation between the series of an auxiliary and others.
#[derive(Clone, Debug, PartialEq)]
pub enum Relation<T> {
    /// y′ is this polynomial.
    Flow(T),
    /// y′ = Σ slope · argument′, as `(slope, argument)`.
    Chain(Vec<(T, T)>),
    /// y is this power of the base.
    Power(T, Number),
    /// y is a name for this polynomial.
    Same(T),
}

/// Rewrites roots as polynomials.
pub(super) struct Rewriter<'g> {
    pub graph: &'g mut Graph,
    /// The direction (v, 0, 1) of (q, v, t), with R \[ω]ₓ for the matrices R of orientations.
    direction: Vec<(NodeId, NodeId)>,
    switches: &'g [Switch],
    /// The rate of each variable.
    pub rates: Lookup<NodeId, NodeId>,
    images: Lookup<NodeId, NodeId>,
    powers: Lookup<(NodeId, Exponent), NodeId>,
    pub auxiliaries: Vec<Auxiliary>,
}

/// A function whose series does not exist everywhere: it has a kink or a jump.
#[derive(Clone, Copy, Debug)]
pub(super) struct NotSmooth;

impl<'g> Rewriter<'g> {
    /// A rewriter for a system.
    pub fn new(graph: &'g mut Graph, scope: Scope<'g>) -> Self {
        let direction = turning_direction(graph, scope.coordinates, scope.turning);
        let mut rates = Lookup::default();
        direction.iter().for_each(|&(variable, rate)| _ = rates.insert(variable, rate));
        Rewriter {
            graph,
            direction,
            switches: scope.switches,
            rates,
            images: Lookup::default(),
            powers: Lookup::default(),
            auxiliaries: Vec::new(),
        }
    }

    /// The roots as polynomials.
    pub fn polynomials(&mut self, roots: &[NodeId]) -> Result<Vec<NodeId>, NotSmooth> {
        for id in self.graph.cone(roots.iter().copied()) {
            if !self.images.contains(&id) {
                let image = self.image(id)?;
                self.images.insert(id, image);
            }
        }
        Ok(roots.iter().map(|&root| self.of(root)).collect())
    }

    fn polynomial(&mut self, root: NodeId) -> Result<NodeId, NotSmooth> {
        self.polynomials(&[root]).map(|images| images[0])
    }

    fn of(&self, id: NodeId) -> NodeId {
        self.images.get(&id).copied().unwrap_or(id)
    }

    fn image(&mut self, id: NodeId) -> Result<NodeId, NotSmooth> {
        if self.is_held(id) {
            return Ok(id);
        }
        match self.graph.node(id).clone() {
            Node::Variable(Variable::Entry(_)) => self.entry(id),
            Node::Constant(_) | Node::Variable(_) => Ok(id),
            Node::Sum { offset, terms } => {
                let terms: Vec<_> = terms.iter().map(|&(term, c)| (self.of(term), c)).collect();
                Ok(self.graph.sum(offset, &terms))
            }
            Node::Product(factors) => {
                let mut polynomial = Vec::with_capacity(factors.len());
                for (factor, exponent) in factors {
                    polynomial.extend(self.power(factor, exponent)?);
                }
                Ok(self.graph.product(&polynomial))
            }
            Node::Unary(function, argument) => self.unary(id, function, argument),
            Node::Binary(function, first, second) => self.binary(id, function, first, second),
        }
    }

    /// A power as whole powers of polynomial nodes.
    fn power(&mut self, factor: NodeId, exponent: Exponent) -> Result<Vec<(NodeId, Exponent)>, NotSmooth> {
        let base = self.of(factor);
        if self.is_held(factor) {
            return Ok(vec![(base, exponent)]);
        }
        Ok(match exponent.as_integer() {
            Some(power) if power > 0 => vec![(base, exponent)],
            Some(power) => vec![(self.power_of(base, Exponent(-2)), Exponent(-2 * power))],
            _ if self.rests_at_zero(factor) => return Err(NotSmooth),
            None if exponent.0 > 0 => {
                let root = self.power_of(base, Exponent(1));
                let whole = (base, Exponent(exponent.0 - 1));
                if exponent.0 > 1 { vec![(root, Exponent(2)), whole] } else { vec![(root, Exponent(2))] }
            }
            // An odd number of halves below zero is one power: (x² + y²)^(−3/2).
            None => vec![(self.power_of(base, exponent), Exponent(2))],
        })
    }

    /// Whether the root of a node has a kink at rest.
    fn rests_at_zero(&mut self, id: NodeId) -> bool {
        sides::rests_at_zero(self.graph, id, &self.direction, self.switches)
    }

    fn power_of(&mut self, base: NodeId, exponent: Exponent) -> NodeId {
        if let Some(&known) = self.powers.get(&(base, exponent)) {
            return known;
        }
        let origin = self.graph.product(&[(base, exponent)]);
        let relation = Relation::Power(base, Number::halves(exponent.0));
        let (variable, _) = self.auxiliary(origin, Value::Power(base, exponent), relation);
        self.powers.insert((base, exponent), variable);
        variable
    }

    fn auxiliary(
        &mut self,
        origin: NodeId,
        value: Value<NodeId>,
        relation: Relation<NodeId>,
    ) -> (NodeId, usize) {
        let index = self.auxiliaries.len();
        self.auxiliaries.push(Auxiliary { origin, value, relation });
        (self.graph.variable(Variable::Auxiliary(index as u32)), index)
    }

    /// R′ = R \[ω]ₓ.
    fn entry(&mut self, id: NodeId) -> Result<NodeId, NotSmooth> {
        let (variable, index) = self.auxiliary(id, Value::Same(id), Relation::Chain(Vec::new()));
        // The rates of an entry's row contain each other, so the image is known before the rate is rewritten.
        self.images.insert(id, variable);
        let rate = self.rates(&[id])[0];
        self.auxiliaries[index].relation = Relation::Flow(self.polynomial(rate)?);
        Ok(variable)
    }

    fn unary(&mut self, id: NodeId, function: Unary, argument: NodeId) -> Result<NodeId, NotSmooth> {
        let x = self.of(argument);
        let value = Value::Unary(function, x);
        let (variable, index) = self.auxiliary(id, value, Relation::Chain(Vec::new()));
        // The derivative may contain the function itself, so the image is known before the derivative is
        // rewritten.
        self.images.insert(id, variable);
        let slope = match function {
            Unary::Abs | Unary::Signum | Unary::PositivePart | Unary::Step | Unary::Below => {
                return Err(NotSmooth);
            }
            Unary::Cbrt if self.rests_at_zero(argument) => return Err(NotSmooth),
            Unary::Cbrt => {
                self.auxiliaries[index].relation = Relation::Power(x, Number::Ratio(1, 3));
                return Ok(variable);
            }
            // On series the slope follows from the value itself, without cosh, which would overflow, and
            // without a second exponential.
            Unary::Tanh => {
                let square = self.graph.powi(variable, 2);
                self.graph.sum(Number::ONE, &[(square, Number::MINUS_ONE)])
            }
            Unary::Logistic => {
                let square = self.graph.powi(variable, 2);
                self.graph.sub(variable, square)
            }
            Unary::ExpM1 => self.graph.sum(Number::ONE, &[(variable, Number::ONE)]),
            _ => {
                let slope = derivative(self.graph, function, argument, id);
                self.polynomial(slope)?
            }
        };
        self.auxiliaries[index].relation = self.relation(&[(slope, argument)])?;
        Ok(variable)
    }

    fn binary(
        &mut self,
        id: NodeId,
        function: Binary,
        first: NodeId,
        second: NodeId,
    ) -> Result<NodeId, NotSmooth> {
        let value = Value::Binary(function, self.of(first), self.of(second));
        let (variable, index) = self.auxiliary(id, value, Relation::Chain(Vec::new()));
        self.images.insert(id, variable);
        let slopes = match function {
            Binary::Pivot => return Err(NotSmooth),
            Binary::Powf | Binary::PowfLn if self.rests_at_zero(first) => return Err(NotSmooth),
            Binary::Atan2 => {
                let (by_first, by_second) = partial_derivatives(self.graph, function, first, second);
                [(self.polynomial(by_first)?, first), (self.polynomial(by_second)?, second)]
            }
            Binary::Powf | Binary::PowfLn => {
                let reciprocal = self.power_of(self.of(first), Exponent(-2));
                let exponent = self.of(second);
                let mut grown = self.graph.mul(variable, exponent);
                if function == Binary::PowfLn {
                    let power = self.graph.powf(first, second);
                    let power = self.polynomial(power)?;
                    grown = self.graph.add(grown, power);
                }
                let by_base = self.graph.mul(grown, reciprocal);
                let logarithm = self.graph.unary(Unary::Ln, first);
                let moving = !self.is_held(second);
                let by_exponent = if moving {
                    let logarithm = self.polynomial(logarithm)?;
                    self.graph.mul(variable, logarithm)
                } else {
                    self.graph.zero()
                };
                [(by_base, first), (by_exponent, second)]
            }
        };
        self.auxiliaries[index].relation = self.relation(&slopes)?;
        Ok(variable)
    }

    /// The time derivatives of the arguments of functions at zero accelerations.
    fn rates(&mut self, arguments: &[NodeId]) -> Vec<NodeId> {
        let known = |argument: &NodeId| self.rates.get(argument).copied();
        // Most arguments are coordinates. For others a sweep takes time in proportion to the whole graph.
        match arguments.iter().map(known).collect() {
            Some(rates) => rates,
            None => pushforward(self.graph, arguments, &self.direction),
        }
    }

    /// Whether a node is constant during a step.
    fn is_held(&self, id: NodeId) -> bool {
        !self.graph.dependence(id).meets(MOVING)
    }

    /// The relation y′ = Σ slope · argument′ for slopes that are polynomials.
    fn relation(&mut self, slopes: &[(NodeId, NodeId)]) -> Result<Relation<NodeId>, NotSmooth> {
        let slopes: Vec<_> =
            slopes.iter().copied().filter(|&(_, argument)| !self.is_held(argument)).collect();
        let arguments: Vec<NodeId> = slopes.iter().map(|&(_, argument)| argument).collect();
        let rates = self.rates(&arguments);
        let bent = Dependence::COORDINATES.union(Dependence::TIME).union(Dependence::INPUTS);
        let straight = |graph: &Graph, argument: NodeId, rate: NodeId| {
            if let Node::Variable(variable) = graph.node(argument)
                && !matches!(variable, Variable::Entry(_))
            {
                return !graph.dependence(argument).meets(Dependence::VELOCITIES);
            }
            !graph.dependence(argument).meets(Dependence::VELOCITIES)
                && !graph.dependence(rate).meets(bent)
                && velocity_degrees(graph, rate).at_most(1)
        };
        if arguments.iter().zip(&rates).all(|(&argument, &rate)| straight(self.graph, argument, rate)) {
            let terms: Vec<_> = slopes
                .iter()
                .zip(&rates)
                .map(|(&(slope, _), &rate)| (self.graph.mul(slope, rate), Number::ONE))
                .collect();
            return Ok(Relation::Flow(self.graph.sum(Number::ZERO, &terms)));
        }
        let of = |&(slope, argument): &(NodeId, NodeId)| (slope, self.of(argument));
        Ok(Relation::Chain(slopes.iter().map(of).collect()))
    }
}
