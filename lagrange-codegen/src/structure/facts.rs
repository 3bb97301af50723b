//! Facts about the equations of motion, and the lines of `STRUCTURE` about what was found and left out.

use crate::calculus::{Degrees, velocity_degrees, velocity_degrees_of};
use crate::expr::{Dependence, Graph, Node, NodeId, Variable};
use crate::mechanics::{Equations, MassMatrix};
use crate::model::{ConstraintKind, Model};

/// The facts.
#[derive(Clone, Debug)]
pub struct Facts {
    /// M is constant.
    pub constant_mass: bool,
    /// M is constant, no force depends on velocities, and there are no constraints.
    pub separable: bool,
    /// M has no entry off its diagonal.
    pub diagonal_mass: bool,
    /// Time appears neither in M and the forces nor in a constraint. L may depend on it all the same: t v,
    /// which is d(t q)/dt − q, has the equations of −q.
    pub autonomous: bool,
    /// L does not depend on time.
    pub timeless: bool,
    /// The Jacobi integral is not T + V.
    pub has_jacobi_integral: bool,
    /// There is neither `force` nor `dissipation`, and no constraint does work.
    pub conservative: bool,
    /// No constraint is on velocities alone.
    pub holonomic: bool,
    /// T = ½ v·M v, and neither energies nor constraints depend on time.
    pub scleronomic: bool,
    /// Coordinates that L does not depend on and that neither applied forces nor constraints act on. Their
    /// momenta are conserved.
    pub cyclic: Vec<usize>,
    /// Decoupled blocks of the mass matrix, ascending.
    pub blocks: Vec<Vec<usize>>,
}

impl Facts {
    /// Reads the facts off the equations.
    pub fn of(model: &Model, equations: &Equations) -> Facts {
        let graph = &model.graph;
        let count = equations.momenta.len();
        let energies = [equations.kinetic_energy, equations.potential_energy];
        let held = || equations.conditions.positions.iter().chain(&equations.conditions.rates).copied();
        let depends_on_time = |root: NodeId| graph.dependence(root).meets(Dependence::TIME);
        let fixed = |root: NodeId| graph.dependence(root).is_fixed();
        let lossless = equations.conditions.losses.iter().all(|&loss| graph.is_zero(loss));
        let conservative = model.forces.is_empty() && model.dissipation.is_empty() && lossless;
        // In a Lagrangian given as a whole the energies lack the terms linear in the velocities.
        let lagrangian = [energies[0], energies[1], equations.whole];
        let appearing = appearing_coordinates(graph, &lagrangian, count);
        let conditions = &equations.conditions;
        let idle = |i: usize| {
            graph.is_zero(equations.applied[i]) && conditions.jacobian.iter().all(|row| graph.is_zero(row[i]))
        };
        let constant_mass = match &equations.mass {
            MassMatrix::Formed(_) => equations.mass.entries().all(fixed),
            MassMatrix::Known { is_constant, .. } => *is_constant,
        };
        let resting = |&force: &NodeId| !graph.dependence(force).meets(Dependence::VELOCITIES);
        Facts {
            constant_mass,
            separable: constant_mass && conditions.count() == 0 && equations.force.iter().all(resting),
            diagonal_mass: match &equations.mass {
                MassMatrix::Formed(rows) => (0..count).all(|i| (0..i).all(|j| graph.is_zero(rows[i][j]))),
                MassMatrix::Known { .. } => false,
            },
            autonomous: !equations.roots().into_iter().chain(held()).any(depends_on_time)
                && !equations.mass.meets(graph, &equations.momenta, Dependence::TIME),
            timeless: !lagrangian.into_iter().any(depends_on_time),
            has_jacobi_integral: equations.jacobi_integral.is_some(),
            conservative,
            holonomic: model
                .constraints
                .iter()
                .all(|constraint| constraint.kind == ConstraintKind::Holonomic),
            scleronomic: is_quadratic(graph, equations) && !held().chain(energies).any(depends_on_time),
            cyclic: (0..count).filter(|&i| !appearing[i] && idle(i)).collect(),
            blocks: match &equations.mass {
                MassMatrix::Formed(rows) => blocks(graph, rows),
                MassMatrix::Known { blocks, .. } => blocks.clone(),
            },
        }
    }

    /// Whether the Jacobi integral v·∂L/∂v − L is conserved: dh/dt is the power of forces and reactions less
    /// ∂L/∂t.
    pub fn conserves(&self) -> bool {
        self.autonomous && self.timeless && self.conservative
    }

    /// The lines of `STRUCTURE` about what was found.
    pub fn found(&self, model: &Model) -> Vec<String> {
        let mut found = Vec::new();
        if !model.eliminated.is_empty() {
            let names: Vec<String> =
                model.eliminated.iter().map(|eliminated| eliminated.quantity.written()).collect();
            found.push(format!("eliminated by constraints: {}", names.join(", ")));
        }
        if !model.orientations.is_empty() {
            let mut names: Vec<&str> =
                model.orientations.iter().map(|&first| model.coordinates[first].name.as_str()).collect();
            names.dedup();
            found.push(format!("orientations without a singular attitude: {}", names.join(", ")));
        }
        let constrained = !model.constraints.is_empty();
        if self.constant_mass {
            let once = if constrained { "" } else { ": factored once per run" };
            found.push(format!("the mass matrix is constant{once}"));
        }
        if constrained {
            let names: Vec<String> =
                model.constraints.iter().map(|constraint| constraint.written()).collect();
            found.push(format!("constraints, each with a multiplier: {}", names.join(", ")));
        }
        if self.separable {
            found.push("separable: no force depends on velocities".to_owned());
        }
        if self.blocks.len() > 1 && !self.diagonal_mass {
            let names: Vec<String> = self
                .blocks
                .iter()
                .map(|block| {
                    block.iter().map(|&i| model.coordinates[i].written()).collect::<Vec<_>>().join(", ")
                })
                .collect();
            found.push(format!("inertially decoupled blocks: {}", names.join(" | ")));
        }
        if self.conserves() {
            let conserved = if self.has_jacobi_integral { "the Jacobi integral" } else { "the energy" };
            found.push(format!("conservative and autonomous: {conserved} is conserved"));
        }
        if !self.cyclic.is_empty() {
            let names: Vec<String> = self.cyclic.iter().map(|&i| model.coordinates[i].written()).collect();
            found.push(format!("cyclic coordinates: {}", names.join(", ")));
        }
        found
    }

    /// The lines of `STRUCTURE` about what the generated code leaves out.
    pub fn skipped(&self, model: &Model) -> Vec<String> {
        let mut skipped = Vec::new();
        let mut skip = |absent: bool, line: &str| {
            if absent {
                skipped.push(line.to_owned());
            }
        };
        skip(self.autonomous && self.timeless, "time: nothing depends on it");
        skip(model.inputs.is_empty(), "inputs");
        skip(model.dissipation.is_empty(), "dissipation");
        skip(model.forces.is_empty(), "applied forces");
        let unconstrained = model.constraints.is_empty();
        skip(
            self.diagonal_mass && unconstrained,
            "the solution of a linear system: the mass matrix is diagonal",
        );
        skip(unconstrained, "constraints and multipliers");
        skipped
    }
}

/// Whether T = ½ v·M v and the momenta are M v.
fn is_quadratic(graph: &Graph, equations: &Equations) -> bool {
    let is_homogeneous =
        |root: NodeId, degrees: Degrees, degree: u32| graph.is_zero(root) || degrees.is_homogeneous(degree);
    let (energy, momenta) = (equations.kinetic_energy, &equations.momenta);
    is_homogeneous(energy, velocity_degrees(graph, energy), 2)
        && momenta
            .iter()
            .zip(velocity_degrees_of(graph, momenta))
            .all(|(&momentum, degrees)| is_homogeneous(momentum, degrees, 1))
}

/// Coordinates that appear in any of the roots.
fn appearing_coordinates(graph: &Graph, roots: &[NodeId], count: usize) -> Vec<bool> {
    let mut appearing = vec![false; count];
    for id in graph.cone(roots.iter().copied()) {
        if let Node::Variable(Variable::Coordinate(i)) = graph.node(id) {
            appearing[*i as usize] = true;
        }
    }
    appearing
}

/// Connected components of the pattern of M.
fn blocks(graph: &Graph, mass: &[Vec<NodeId>]) -> Vec<Vec<usize>> {
    let count = mass.len();
    let mut label: Vec<usize> = (0..count).collect();
    for i in 0..count {
        for j in 0..i {
            if !graph.is_zero(mass[i][j]) && label[i] != label[j] {
                let (keep, drop) = (label[i].min(label[j]), label[i].max(label[j]));
                label.iter_mut().filter(|l| **l == drop).for_each(|l| *l = keep);
            }
        }
    }
    (0..count)
        .filter(|&i| label[i] == i)
        .map(|root| (0..count).filter(|&i| label[i] == root).collect())
        .collect()
}
