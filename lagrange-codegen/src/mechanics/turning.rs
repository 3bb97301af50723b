//! The equations of motion with angular velocities: Euler–Poincaré equations.
//!
//! With turns about body axes, δR = R \[δφ]ₓ, and ω in the same axes, the momentum p = ∂L/∂ω obeys
//! p′ = p × ω + ∂L/∂φ + torque. That is simpler than in parameters of the orientation and their rates: the
//! inertia of a body is constant there. (Marsden and Ratiu, *Introduction to Mechanics and Symmetry*, 2nd
//! ed., section 13.5.)

use super::{Conditions, Equations, cheapest};
use crate::model::Model;

/// The equations of a model whose orientations are matrices; `None` for a model without orientations.
pub fn turning(model: &mut Model) -> Option<Equations> {
    (!model.turning.is_empty())
        .then(|| cheapest(model, |model, axes| Equations::in_axes(model, axes, true), Equations::roots))
}

impl Equations {
    /// These equations, with the terms of `others` that a motion is solved with and its series are made of.
    pub fn turned(&self, model: &mut Model, others: Equations) -> Equations {
        let Equations {
            mass, force, momenta, momentum_rates, inertia, conditions, followed, turning, ..
        } = others;
        let Conditions { rates, jacobian, reactions, relaxation, switched, .. } = conditions;
        let conditions =
            Conditions { rates, jacobian, reactions, relaxation, switched, ..self.conditions.clone() };
        let mut turned = Equations {
            mass,
            force,
            momenta,
            momentum_rates,
            inertia,
            conditions,
            followed,
            turning,
            ..self.clone()
        };
        turned.simplify_motion(model);
        turned
    }
}
