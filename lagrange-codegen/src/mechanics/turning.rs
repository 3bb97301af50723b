//! The equations of motion with angular velocities: Euler–Poincaré equations.
//!
//! With turns about body axes, δR = R \[δφ]ₓ, and ω in the same axes, the momentum p = ∂L/∂ω obeys
//! p′ = p × ω + ∂L/∂φ + torque. That is simpler than in parameters of the orientation and their rates: the
//! inertia of a body is constant there. (Marsden and Ratiu, *Introduction to Mechanics and Symmetry*, 2nd ed.,
//! section 13.5.)

use super::motion::{Axes, Motion};
use super::{Conditions, Equations, cheapest, composed, energy, equations, forces};
use crate::calculus::substitute;
use crate::expr::{NodeId, Variable};
use crate::model::{Model, orientation};

/// The terms that a motion is solved for with.
#[derive(Clone, Debug)]
pub struct Turning {
    orientations: Vec<usize>,
    mass: Vec<Vec<NodeId>>,
    force: Vec<NodeId>,
    momenta: Vec<NodeId>,
    momentum_rates: Vec<NodeId>,
    inertia: NodeId,
    conditions: Conditions,
}

impl Turning {
    /// Those of a model whose orientations are matrices; `None` where there are none.
    pub fn of(model: &mut Model) -> Option<Turning> {
        if model.turning.is_empty() {
            return None;
        }
        Some(cheapest(model, Turning::in_axes, Turning::roots))
    }

    /// The entries of the mass matrix and of the constraints' gradients, and the right-hand sides.
    fn roots(&self) -> Vec<NodeId> {
        self.mass.iter().flatten().chain(&self.force).copied().chain(self.conditions.roots()).collect()
    }

    fn in_axes(model: &mut Model, axes: Axes) -> Turning {
        let motion = Motion::of(model, axes);
        let momenta = equations::momenta(model, &motion);
        let mass = equations::mass_matrix(model, &motion, &momenta);
        let inertial = equations::inertial(model, &motion, &momenta);
        let conservative = equations::conservative(model);
        let applied = forces::loads(model, &motion).negated(model);
        let total = inertial.joined(conservative).joined(applied).sweep(model, &motion);
        let mut turning = Turning {
            orientations: model.turning.clone(),
            force: equations::negated(model, &total),
            momentum_rates: equations::momentum_rates(model, &motion, &momenta),
            inertia: energy::energies(model, &motion, &momenta).kinetic,
            conditions: Conditions::of(model, &motion, &mass),
            mass,
            momenta,
        };
        turning.name_velocities(model);
        if axes == Axes::Own {
            turning.mass = composed(&mut model.graph, turning.mass, turning.inertia);
        }
        turning
    }

    /// The angular velocities are the velocities here.
    fn name_velocities(&mut self, model: &mut Model) {
        let graph = &mut model.graph;
        let mut names = Vec::with_capacity(3 * self.orientations.len());
        for &first in &self.orientations {
            let velocities = (first as u32..).map(Variable::Velocity);
            for (spin, velocity) in orientation::spin(graph, first).into_iter().zip(velocities) {
                names.push((spin, graph.variable(velocity)));
            }
        }
        let Conditions { rates, jacobian, reactions, relaxation, .. } = &mut self.conditions;
        let lists = [&mut self.force, &mut self.momenta, &mut self.momentum_rates, rates, reactions];
        let rows = self.mass.iter_mut().chain(lists).chain(jacobian).chain(relaxation);
        let mut nodes: Vec<&mut NodeId> = rows.flatten().collect();
        nodes.push(&mut self.inertia);
        let roots: Vec<NodeId> = nodes.iter().map(|node| **node).collect();
        for (node, image) in nodes.into_iter().zip(substitute(graph, &roots, &names)) {
            *node = image;
        }
    }
}

impl Equations {
    /// With other terms to solve for the motion with: those that a series is made of.
    pub fn turned(&self, model: &mut Model, turning: Turning) -> Equations {
        let Turning { orientations, mass, force, momenta, momentum_rates, inertia, conditions } = turning;
        let Conditions { rates, jacobian, reactions, relaxation, .. } = conditions;
        let conditions = Conditions { rates, jacobian, reactions, relaxation, ..self.conditions.clone() };
        let mut turned = Equations {
            mass,
            force,
            momenta,
            momentum_rates,
            inertia,
            conditions,
            turning: orientations,
            ..self.clone()
        };
        turned.simplify_motion(model);
        turned
    }
}
