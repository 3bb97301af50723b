//! The right value of every emitted quantity: dual numbers on the energies and forces of the system.
//!
//! It follows from the definition d/dt ∂L/∂v − ∂L/∂q = Q − ∂D/∂v with L as a whole. The engine's shorter ways
//! are not used.

#![allow(clippy::needless_range_loop, reason = "formulas with indices")]

use crate::constrained::Held;
use crate::expression::{Instant, Scope};
use crate::motion::space_rate;
use crate::number::{Number, Tracked};
use crate::system::{Energy, Place, Role, System};

/// The quantities of one system at one instant.
#[derive(Clone, Debug)]
pub struct Quantities {
    pub mass: Vec<Vec<Tracked>>,
    pub bias: Vec<Tracked>,
    pub applied: Vec<Tracked>,
    pub momenta: Vec<Tracked>,
    pub kinetic: Tracked,
    pub potential: Tracked,
    pub energy: Tracked,
    pub jacobi: Tracked,
    pub power: Tracked,
    pub accelerations: Vec<Tracked>,
    /// The quantities of constraints, one entry for each.
    pub held: Held,
    /// Condition of the equations in the maximum norm; infinite where they are singular.
    pub condition: f64,
}

impl Quantities {
    /// Evaluates the definitions.
    pub fn of(system: &System, at: &Instant<Tracked>) -> Quantities {
        let count = system.count();
        let nothing = Tracked::constant(0.0);
        let Balance { mass, bias, applied, momenta } = balance(system, at);
        let sum = |terms: &[Tracked]| {
            terms.iter().zip(&at.v).fold(nothing, |sum, (&term, &velocity)| sum + term * velocity)
        };
        let energies = system.energies(at);
        let at_rest = system.energies(&Instant { v: vec![nothing; count], ..at.clone() });
        let whole_momenta: Vec<Tracked> =
            (0..count).map(|i| system.energies(&at.by_velocity(i)).whole.slope).collect();
        let kinetic = energies.kinetic + sum(&whole_momenta) - energies.whole + at_rest.whole;
        let potential = energies.potential - at_rest.whole;
        let force: Vec<Tracked> = applied.iter().zip(&bias).map(|(&q, &b)| q - b).collect();
        let mut held = Held::of(system, at);
        let (matrix, right) = held.equations(&mass, &force);
        let (mut accelerations, condition) = solve(&matrix, &right);
        held.complete(system, at, &accelerations);
        accelerations.truncate(count);
        Quantities {
            energy: kinetic + potential,
            jacobi: sum(&momenta) - energies.lagrangian(),
            power: sum(&applied),
            mass,
            bias,
            applied,
            momenta,
            kinetic,
            potential,
            accelerations,
            held,
            condition,
        }
    }
}

/// The equations of motion of free coordinates, M a + b = Q − ∂D/∂v.
#[derive(Clone, Debug)]
pub struct Balance<T> {
    pub mass: Vec<Vec<T>>,
    pub bias: Vec<T>,
    pub applied: Vec<T>,
    pub momenta: Vec<T>,
}

/// The equations of motion in any number.
pub fn balance<T: Number>(system: &System, at: &Instant<T>) -> Balance<T> {
    let count = system.count();
    let nothing = T::constant(0.0);
    let moving = at.in_motion();
    let (mut momenta, mut bias) = (Vec::new(), Vec::new());
    let mut mass = vec![vec![nothing; count]; count];
    for i in 0..count {
        // The derivative by v[i] is outside; the one along the motion or by v[j] is inside.
        let along_motion = system.energies(&moving.by_velocity(i)).lagrangian().slope;
        let by_coordinate = system.energies(&at.by_coordinate(i)).lagrangian().slope;
        momenta.push(along_motion.value);
        bias.push(along_motion.slope - by_coordinate);
        for j in 0..=i {
            let entry = system.energies(&at.by_velocity(j).by_velocity(i)).lagrangian().slope.slope;
            mass[i][j] = entry;
            mass[j][i] = entry;
        }
    }
    let applied: Vec<T> = (0..count).map(|i| applied_force(system, at, i)).collect();
    Balance { mass, bias, applied, momenta }
}

/// Qᵢ − ∂D/∂vᵢ: the virtual power of all forces per unit of the velocity i.
pub fn applied_force<T: Number>(system: &System, at: &Instant<T>, coordinate: usize) -> T {
    let displaced = at.by_coordinate(coordinate);
    let work = |place: Place, force: &[T]| {
        let position = system.positions(place.role, &displaced).swap_remove(place.index);
        position.iter().zip(force).fold(T::constant(0.0), |sum, (x, &f)| sum + x.slope * f)
    };
    let mut total = T::constant(0.0);
    for (index, role) in system.roles.iter().enumerate() {
        match role {
            Role::Energy(Energy::Dissipation, body) => {
                let changed = at.by_velocity(coordinate);
                total = total - system.scalar_role(index, body, &changed).slope;
            }
            Role::ForceOn(which, body) => {
                if which % system.count() == coordinate {
                    total = total + system.scalar_role(index, body, at);
                }
            }
            Role::ForceOnAll(body) => {
                let scope = Scope::new(system, at, index);
                total = total
                    + scope.run(body, |scope, entries| scope.scalar(&entries[coordinate % entries.len()]));
            }
            Role::ForceAt(which, body) => {
                if let Some((place, dimension)) = system.any_place(*which) {
                    total = total + work(place, &system.vector_role(index, body, dimension, at));
                }
            }
            Role::Wrench(which, body) => {
                if let Some((place, dimension)) = system.any_body(*which) {
                    let scope = Scope::new(system, at, index);
                    let (force, torque) = scope.run(body, |scope, (force, torque)| {
                        (scope.vector(force, dimension), scope.vector(torque, 3))
                    });
                    total = total + work(place, &force);
                    if let Some(angle) = system.angle(place.role, &displaced) {
                        total = total + angle.slope * torque[0];
                    }
                    if let Some(attitude) = system.attitude(place.role, &displaced) {
                        let turn: [T; 3] = space_rate(&attitude);
                        total = turn.iter().zip(&torque).fold(total, |sum, (&a, &b)| sum + a * b);
                    }
                }
            }
            Role::Energy(..)
            | Role::Point { .. }
            | Role::Planar { .. }
            | Role::Spatial { .. }
            | Role::Chain { .. }
            | Role::Constraint(..) => {}
        }
    }
    total
}

/// M a = f. The uncertainty of a follows from those of M and f through |M⁻¹|.
pub fn solve(mass: &[Vec<Tracked>], force: &[Tracked]) -> (Vec<Tracked>, f64) {
    let count = mass.len();
    let values: Vec<Vec<f64>> =
        mass.iter().map(|row| row.iter().map(|entry| entry.value).collect()).collect();
    let column = |i: usize| (0..count).map(|j| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
    let mut right: Vec<Vec<f64>> = (0..count).map(column).collect();
    right.push(force.iter().map(|f| f.value).collect());
    let unknown = Tracked { value: f64::NAN, roundings: f64::NAN };
    let Some(mut solved) = gauss(&values, &right) else { return (vec![unknown; count], f64::INFINITY) };
    let solution = solved.pop().unwrap_or_default();
    // `solved[j]` is column j of the inverse.
    let disturbance: Vec<f64> = (0..count)
        .map(|i| {
            let entries = mass[i].iter().zip(&solution);
            force[i].roundings + entries.map(|(entry, a)| entry.roundings * a.abs()).sum::<f64>()
        })
        .collect();
    // The error that refinement leaves in a component that is zero.
    let left = f64::EPSILON * solution.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let accelerations = (0..count)
        .map(|i| Tracked {
            value: solution[i],
            roundings: (0..count).map(|j| solved[j][i].abs() * disturbance[j]).sum::<f64>() + left,
        })
        .collect();
    let norm = |entry: &dyn Fn(usize, usize) -> f64| {
        (0..count).map(|i| (0..count).map(|j| entry(i, j).abs()).sum::<f64>()).fold(0.0, f64::max)
    };
    let condition = norm(&|i, j| values[i][j]) * norm(&|i, j| solved[j][i]);
    (accelerations, condition)
}

/// Solves for several right-hand sides; `None` where the matrix is singular. Refinement makes the
/// errors small row by row, however differently the rows are scaled (Skeel 1980).
pub fn gauss(a: &[Vec<f64>], right: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let mut solutions = eliminate(a.to_vec(), right.to_vec())?;
    for _ in 0..2 {
        let residual = |(x, b): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
            let row = |row: &Vec<f64>| row.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
            b.iter().zip(a).map(|(b, a)| b - row(a)).collect()
        };
        let residuals = solutions.iter().zip(right).map(residual).collect();
        for (x, correction) in solutions.iter_mut().zip(eliminate(a.to_vec(), residuals)?) {
            x.iter_mut().zip(correction).for_each(|(x, correction)| *x += correction);
        }
    }
    Some(solutions)
}

/// Gaussian elimination with partial pivoting.
fn eliminate(mut a: Vec<Vec<f64>>, mut right: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let count = a.len();
    for k in 0..count {
        let pivot = (k..count).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        if !(a[pivot][k].abs() > 0.0 && a[pivot][k].is_finite()) {
            return None;
        }
        a.swap(k, pivot);
        right.iter_mut().for_each(|b| b.swap(k, pivot));
        for i in k + 1..count {
            let factor = a[i][k] / a[k][k];
            for j in k..count {
                a[i][j] -= factor * a[k][j];
            }
            right.iter_mut().for_each(|b| b[i] -= factor * b[k]);
        }
    }
    for b in &mut right {
        for i in (0..count).rev() {
            let known: f64 = (i + 1..count).map(|j| a[i][j] * b[j]).sum();
            b[i] = (b[i] - known) / a[i][i];
        }
    }
    Some(right)
}
