//! The rates of the energy and of the Jacobi integral along a motion.

use crate::expr::NodeId;
use crate::mechanics::{Equations, energy};
use crate::model::Model;
use crate::number::Number;

/// Rates along a motion, with its accelerations and multipliers as variables.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    /// d(T + V)/dt.
    pub energy_rate: NodeId,
    /// Rate of the Jacobi integral v·∂L/∂v − L.
    pub jacobi_rate: NodeId,
}

impl Balance {
    /// Both rates.
    pub fn of(model: &mut Model, equations: &Equations) -> Balance {
        let Equations { momenta, energy: total, jacobi_integral: jacobi, power, conditions, .. } = equations;
        let graph = &mut model.graph;
        let integral = jacobi.unwrap_or(*total);
        let terms = energy::balance(graph, momenta, integral, *power, conditions);
        Balance {
            energy_rate: energy::rate(graph, momenta, *total, *jacobi, *power, conditions),
            jacobi_rate: graph.sum(Number::ZERO, &terms),
        }
    }
}
