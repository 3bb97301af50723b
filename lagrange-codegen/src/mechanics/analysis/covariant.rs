//! The mass matrix as a metric: Christoffel symbols and the Coriolis matrix.
//!
//! For momenta p = M(q, t) v + g(q, t) the inertial part of Lagrange's equations is
//!
//! d/dt p − ∂T/∂q = M a + C v + ½ ∂M/∂t v + G v + ∂g/∂t − ∂T₀/∂q, with
//! C = ½ (∂(Mv)/∂q − (∂(Mv)/∂q)ᵀ + Ṁ), G = ∂g/∂q − (∂g/∂q)ᵀ,
//!
//! so that Ṁ − 2C = (∂(Mv)/∂q)ᵀ − ∂(Mv)/∂q and G are skew and do no work, and C_kj = Σᵢ \[ij, k] vᵢ + ½
//! ∂M_kj/∂t with the Christoffel symbols of the first kind (Lurie, *Analytical Mechanics*, chapter 4;
//! Siciliano et al., *Robotics*, section 7.2.1). C takes one forward sweep for each coordinate, not the N³
//! symbols.

use crate::calculus::{pushforward, substitute};
use crate::expr::{Dependence, NodeId, Variable};
use crate::kinematics::time_direction;
use crate::mechanics::Equations;
use crate::model::Model;
use crate::number::Number;

/// The terms of equations whose momenta are affine in the velocities.
#[derive(Clone, Debug)]
pub struct Covariant {
    /// g: the momenta at rest.
    pub guiding: Vec<NodeId>,
    /// M v.
    pub relative: Vec<NodeId>,
    /// C, row by row.
    pub coriolis: Vec<Vec<NodeId>>,
    /// G, row by row.
    pub gyroscopic: Vec<Vec<NodeId>>,
}

impl Covariant {
    /// Differentiates the momenta; `None` if the mass matrix depends on velocities.
    pub fn of(model: &mut Model, equations: &Equations) -> Option<Covariant> {
        let graph = &mut model.graph;
        let mass = equations.mass.rows();
        let moving = |&entry: &NodeId| graph.dependence(entry).meets(Dependence::VELOCITIES);
        if mass.iter().flatten().any(moving) {
            return None;
        }
        let count = mass.len();
        let velocities: Vec<NodeId> =
            (0..count as u32).map(|i| graph.variable(Variable::Velocity(i))).collect();
        let zero = graph.zero();
        let at_rest: Vec<_> = velocities.iter().map(|&v| (v, zero)).collect();
        let guiding = substitute(graph, &equations.momenta, &at_rest);
        let relative: Vec<NodeId> = (0..count)
            .map(|k| {
                if graph.is_zero(guiding[k]) {
                    return equations.momenta[k];
                }
                let terms: Vec<_> = (0..count)
                    .map(|j| (graph.mul(mass[k.max(j)][k.min(j)], velocities[j]), Number::ONE))
                    .collect();
                graph.sum(Number::ZERO, &terms)
            })
            .collect();

        let one = graph.one();
        let mut by_coordinate = |nodes: &[NodeId]| -> Vec<Vec<NodeId>> {
            (0..count as u32)
                .map(|j| {
                    let q = graph.variable(Variable::Coordinate(j));
                    pushforward(graph, nodes, &[(q, one)])
                })
                .collect()
        };
        let (slopes, of_guiding) = (by_coordinate(&relative), by_coordinate(&guiding));
        let direction = time_direction(graph, count);
        let entries: Vec<NodeId> = mass.iter().flatten().copied().collect();
        let changes = pushforward(graph, &entries, &direction);
        let change = |k: usize, j: usize| {
            let (row, column) = (k.max(j), k.min(j));
            changes[row * (row + 1) / 2 + column]
        };
        let mut coriolis = vec![Vec::with_capacity(count); count];
        let mut gyroscopic = vec![Vec::with_capacity(count); count];
        for k in 0..count {
            for j in 0..count {
                let terms = [
                    (slopes[j][k], Number::HALF),
                    (slopes[k][j], -Number::HALF),
                    (change(k, j), Number::HALF),
                ];
                coriolis[k].push(graph.sum(Number::ZERO, &terms));
                gyroscopic[k].push(graph.sub(of_guiding[j][k], of_guiding[k][j]));
            }
        }
        Some(Covariant { guiding, relative, coriolis, gyroscopic })
    }
}

/// Christoffel symbols of the first kind \[ij, k] = ½ (∂M_ik/∂q_j + ∂M_jk/∂q_i − ∂M_ij/∂q_k), by k, then i,
/// then j ≤ i.
pub fn christoffel(model: &mut Model, mass: &[Vec<NodeId>]) -> Vec<Vec<Vec<NodeId>>> {
    let graph = &mut model.graph;
    let count = mass.len();
    let entries: Vec<NodeId> = mass.iter().flatten().copied().collect();
    let one = graph.one();
    let slopes: Vec<Vec<NodeId>> = (0..count as u32)
        .map(|j| {
            let q = graph.variable(Variable::Coordinate(j));
            pushforward(graph, &entries, &[(q, one)])
        })
        .collect();
    let slope = |i: usize, j: usize, by: usize| {
        let (row, column) = (i.max(j), i.min(j));
        slopes[by][row * (row + 1) / 2 + column]
    };
    let half = Number::HALF;
    (0..count)
        .map(|k| {
            (0..count)
                .map(|i| {
                    (0..=i)
                        .map(|j| {
                            let terms =
                                [(slope(i, k, j), half), (slope(j, k, i), half), (slope(i, j, k), -half)];
                            graph.sum(Number::ZERO, &terms)
                        })
                        .collect()
                })
                .collect()
        })
        .collect()
}
