//! From a [`Model`] to its equations of motion.
//!
//! d/dt ∂L/∂v − ∂L/∂q = Q − ∂D/∂v, written as M(q, v, t) a + b(q, v, t) = Q − ∂D/∂v. Energies given
//! as functions of (q, v, t) are differentiated as they stand. Particles and bodies take
//! d'Alembert's form instead, b = Σ (∂r/∂q)ᵀ m r̈|ₐ₌₀ + Σ (∂ω/∂v)ᵀ (I ω̇|ₐ₌₀ + ω × I ω), which is
//! the same vector without the terms that cancel between d/dt ∂T/∂v and ∂T/∂q.

pub mod analysis;
mod constraints;
mod energy;
mod equations;
mod forces;
mod frames;
mod linearization;
mod mass;
mod motion;
mod places;
pub(crate) mod quadratic;
mod screws;
mod turning;
mod validate;

pub use constraints::{Conditions, LoadRow, Switched};
pub use linearization::{Linearization, Sensitivities};
pub use mass::MassMatrix;
pub use screws::Screws;
pub use turning::turning;

use crate::diagnostics::Diagnostics;
use crate::expr::{Graph, NodeId};
use crate::model::{Hints, Model};
use crate::simplify::cost::cost;
use crate::simplify::{price, simplify};
use motion::{Axes, Motion};
use quadratic::Quadratic;

/// The equations of motion and the scalars that go with them.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Mass matrix ∂²L/∂v∂v.
    pub mass: MassMatrix,
    /// b(q, v, t): d/dt ∂L/∂v − ∂L/∂q at a = 0.
    pub bias: Vec<NodeId>,
    /// Q − ∂D/∂v.
    pub applied: Vec<NodeId>,
    /// Right-hand side of M a = f: the applied forces less the bias, from one sweep.
    pub force: Vec<NodeId>,
    /// Generalized momenta p = ∂L/∂v.
    pub momenta: Vec<NodeId>,
    /// Their rates: Lagrange's equations are d/dt p = ∂L/∂q + Q − ∂D/∂v.
    pub momentum_rates: Vec<NodeId>,
    /// T.
    pub kinetic_energy: NodeId,
    /// T before simplification. It keeps sums of velocities as the user nested the positions.
    pub inertia: NodeId,
    /// V.
    pub potential_energy: NodeId,
    /// The sum of the Lagrangians given as a whole.
    pub whole: NodeId,
    /// T + V.
    pub energy: NodeId,
    /// The Jacobi integral v·∂L/∂v − L, where it differs from T + V.
    pub jacobi_integral: Option<NodeId>,
    /// Power of the applied forces, where there are any.
    pub power: Option<NodeId>,
    /// d(T + V)/dt along the motion of a constrained system, with its accelerations and multipliers as
    /// variables.
    pub energy_rate: Option<NodeId>,
    /// The contributions of the constraints.
    pub conditions: Conditions,
    /// Functions of the state whose series along the motion are asked for. Only equations that switch have
    /// some.
    pub followed: Vec<NodeId>,
    /// Orientations whose matrices are variables. Their angular velocities replace the rates of their
    /// coordinates.
    pub turning: Vec<usize>,
    /// Whether the mass matrix is known to be symmetric positive semidefinite, by construction or because it
    /// is that of a kinetic energy. A Lagrangian given as a whole may have a mass matrix of any signature.
    pub definite: bool,
}

impl Equations {
    /// The entries of the mass matrix and of the constraints' gradients, and the right-hand sides.
    pub fn roots(&self) -> Vec<NodeId> {
        self.mass.entries().chain(self.force.iter().copied()).chain(self.conditions.roots()).collect()
    }

    /// The same with simplified roots where a motion is solved and facts are read: the mass matrix, the
    /// right-hand side, the gradients of the constraints with γ, and the energies.
    pub fn simplified(&self, model: &mut Model) -> Equations {
        let mut simpler = self.clone();
        simpler.simplify_motion(model);
        let energies = [self.kinetic_energy, self.potential_energy, self.whole];
        let energies = simplify(&mut model.graph, &mut model.hints, &energies);
        [simpler.kinetic_energy, simpler.potential_energy, simpler.whole] =
            [energies[0], energies[1], energies[2]];
        simpler
    }

    fn simplify_motion(&mut self, model: &mut Model) {
        let mut simpler = simplify(&mut model.graph, &mut model.hints, &self.roots()).into_iter();
        let Conditions { jacobian, gamma, .. } = &mut self.conditions;
        let rows = [&mut self.force].into_iter().chain(jacobian).chain([gamma]);
        let nodes = self.mass.entries_mut().chain(rows.flatten());
        nodes.zip(simpler.by_ref()).for_each(|(node, new)| *node = new);
    }
}

/// Derives the equations of motion, or reports why it cannot. `asks_for_mass` tells whether more than the
/// accelerations is made of the entries of the mass matrix.
pub fn derive(
    model: &mut Model,
    asks_for_mass: bool,
    allows: &dyn Fn(&str) -> bool,
    diagnostics: &mut Diagnostics,
) -> Option<Equations> {
    let are_inert = validate::contributions(model, allows, diagnostics);
    validate::constants(model, diagnostics);
    let independent = validate::constraints(model, allows, diagnostics);
    let asks_for_mass = asks_for_mass || !model.constraints.is_empty() || !model.contacts.is_empty();
    let equations =
        cheapest(model, |model, axes| Equations::in_axes(model, axes, asks_for_mass), Equations::roots);
    if !are_inert {
        validate::inertia(model, &equations, &independent, diagnostics);
    }
    validate::inputs(model, &equations, allows, diagnostics);
    (!diagnostics.has_errors()).then_some(equations)
}

/// A derivation in the axes in which its roots take fewer operations. A single top is written best in space
/// axes, where its spin does not appear, and an arm in the axes of its links.
fn cheapest<T>(
    model: &mut Model,
    derived: impl Fn(&mut Model, Axes) -> T,
    roots: impl Fn(&T) -> Vec<NodeId>,
) -> T {
    if !Motion::is_carried(model) {
        return derived(model, Axes::Space);
    }
    let mut trial = model.clone();
    let own = derived(&mut trial, Axes::Own);
    let space = derived(model, Axes::Space);
    let [of_own, of_space] = [(&trial, &own), (&*model, &space)].map(|(model, equations)| {
        let mut hints = Hints::default();
        price(&mut model.graph.clone(), &mut hints, &roots(equations))
    });
    if of_own < of_space {
        *model = trial;
        return own;
    }
    space
}

/// M from composite inertias, if that takes fewer operations than a sweep for each column.
fn composed(graph: &mut Graph, mass: Vec<Vec<NodeId>>, energy: NodeId) -> Vec<Vec<NodeId>> {
    let all: Vec<usize> = (0..mass.len()).collect();
    let Some(form) = Quadratic::of(graph, energy, &all) else { return mass };
    let formed = form.formed(graph);
    let [of_formed, of_mass] = [&formed, &mass].map(|rows| cost(graph, &rows.concat()));
    if of_formed < of_mass { formed } else { mass }
}

impl Equations {
    fn in_axes(model: &mut Model, axes: Axes, asks_for_mass: bool) -> Equations {
        let motion = Motion::of(model, axes);
        let momenta = equations::momenta(model, &motion);
        let count = momenta.len();
        let is_of_many =
            MassMatrix::is_of_many(count) && model.lagrangian.is_empty() && motion.turning.is_empty();
        let formed = (!is_of_many).then(|| MassMatrix::formed(model, &motion, &momenta));
        let energies = energy::energies(model, &motion, &momenta);
        let known = match formed {
            Some(mass) if axes == Axes::Own => {
                Some(MassMatrix::Formed(composed(&mut model.graph, mass, energies.kinetic)))
            }
            Some(mass) => Some(MassMatrix::Formed(mass)),
            None => MassMatrix::of_many(&mut model.graph, energies.kinetic, count, asks_for_mass),
        };
        let mass = known.unwrap_or_else(|| MassMatrix::Formed(MassMatrix::formed(model, &motion, &momenta)));
        let inertial = equations::inertial(model, &motion, &momenta);
        let conservative = equations::conservative(model);
        let applied_loads = forces::loads(model, &motion);
        let bias = inertial.clone().joined(conservative.clone()).sweep(model, &motion);
        let applied = applied_loads.clone().negated(model).sweep(model, &motion);
        let applied = equations::negated(model, &applied);
        let total = inertial.joined(conservative).joined(applied_loads.negated(model)).sweep(model, &motion);
        let force = equations::negated(model, &total);
        let momentum_rates = equations::momentum_rates(model, &motion, &momenta);
        let conditions = Conditions::of(model, &motion, &mass);
        let power = energy::power(model, &motion, &applied);
        let energy_rate = (conditions.count() > 0).then(|| {
            energy::rate(&mut model.graph, &momenta, energies.total, energies.jacobi, power, &conditions)
        });
        Equations {
            mass,
            bias,
            applied,
            force,
            momenta,
            momentum_rates,
            kinetic_energy: energies.kinetic,
            inertia: energies.kinetic,
            potential_energy: energies.potential,
            whole: energies.whole,
            energy: energies.total,
            jacobi_integral: energies.jacobi,
            power,
            energy_rate,
            conditions,
            followed: Vec::new(),
            turning: motion.turning,
            definite: model.lagrangian.is_empty(),
        }
    }
}

#[cfg(test)]
mod tests;
