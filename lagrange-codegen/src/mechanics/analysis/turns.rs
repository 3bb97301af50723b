//! Turns of one orientation as generators: ρ moves along a column of N, δρ = N δφ with the turn δφ in body
//! axes, or of Nᵀ with the turn in space axes.
//!
//! N = (1 − s) + ½ \[ρ]ₓ + ⅛ ρ ρᵀ with s = |ρ|²/16, see [`orientation`](crate::model::orientation).

use crate::expr::{Graph, NodeId, Variable};
use crate::kinematics::cross;
use crate::number::Number;

/// A turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    /// Where the numbers of the orientation begin.
    pub first: usize,
    /// 0 to 2.
    pub axis: usize,
    /// Whether the axis is one of the body, else of space.
    pub in_body: bool,
}

/// A component of a generator, such as a turn: its value, its rate along the motion, and bounds of the terms
/// of both.
#[derive(Clone, Copy, Debug)]
pub struct Shift {
    pub row: usize,
    pub value: f64,
    pub rate: f64,
    pub sizes: [f64; 2],
}

impl Turn {
    fn sign(self) -> f64 {
        if self.in_body { 1.0 } else { -1.0 }
    }

    /// The motion of the orientation's three numbers.
    pub fn field(self, q: &[f64], v: &[f64]) -> [Shift; 3] {
        let Turn { first, axis, .. } = self;
        let three = |all: &[f64]| [all[first], all[first + 1], all[first + 2]];
        let (rho, rates) = (three(q), three(v));
        let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
        let (s, s_rate) = (dot(rho, rho) / 16.0, dot(rho, rates) / 8.0);
        // The entry (i, axis) of [x]ₓ.
        let skew = |x: [f64; 3], i: usize| match (3 + i - axis) % 3 {
            1 => x[(axis + 2) % 3],
            2 => -x[(axis + 1) % 3],
            _ => 0.0,
        };
        [0, 1, 2].map(|i| {
            let diagonal = if i == axis { 1.0 } else { 0.0 };
            let half = 0.5 * self.sign();
            let products = [rho[i] * rho[axis] / 8.0, (rates[i] * rho[axis] + rho[i] * rates[axis]) / 8.0];
            let (across, across_rate) = (half * skew(rho, i), half * skew(rates, i));
            let size = |x: f64, y: f64, z: f64| diagonal * x.abs() + y.abs() + z.abs();
            let rate_size = (rates[i] * rho[axis]).abs() + (rho[i] * rates[axis]).abs();
            let speed: f64 = (0..3).map(|i| (rho[i] * rates[i]).abs()).sum();
            Shift {
                row: first + i,
                value: diagonal * (1.0 - s) + across + products[0],
                rate: -diagonal * s_rate + across_rate + products[1],
                sizes: [size(1.0 + s, across, products[0]), size(speed, across_rate, rate_size)],
            }
        })
    }

    /// p·ξ.
    pub fn momentum(self, graph: &mut Graph, momenta: &[NodeId]) -> NodeId {
        let Turn { first, axis, .. } = self;
        let rho = [0, 1, 2].map(|i| graph.variable(Variable::Coordinate((first + i) as u32)));
        let p = [0, 1, 2].map(|i| momenta[first + i]);
        let (zero, one) = (graph.zero(), graph.one());
        let unit = std::array::from_fn(|i| if i == axis { one } else { zero });
        let turned = cross(graph, &rho, &unit);
        let squares = rho.map(|x| (graph.powi(x, 2), Number::Ratio(-1, 16)));
        let remaining = graph.sum(Number::ONE, &squares);
        let half = if self.in_body { Number::HALF } else { -Number::HALF };
        let mut terms = vec![(graph.mul(remaining, p[axis]), Number::ONE)];
        for i in 0..3 {
            terms.push((graph.mul(turned[i], p[i]), half));
            let along = graph.mul(rho[i], p[i]);
            terms.push((graph.mul(rho[axis], along), Number::Ratio(1, 8)));
        }
        graph.sum(Number::ZERO, &terms)
    }
}
