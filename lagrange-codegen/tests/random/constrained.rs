//! Multipliers, reactions and their power in the oracle, from definitions.
//!
//! M a + b = Q − ∂D/∂v + Aᵀλ and A a = γ, with A = ∂f/∂q or ∂g/∂v, and A a − γ the time derivative of w =
//! df/dt or g. The states violate the constraints. The engine gives power and energy of a state with w = 0:
//! less than the power v·Aᵀλ by λ w.

#![allow(clippy::needless_range_loop, reason = "formulas with indices")]

use std::collections::{BTreeMap, BTreeSet};

use crate::constraint::Kind;
use crate::expression::{Expr, Instant, Scope, Vector};
use crate::number::{Dual, Number, Tracked};
use crate::system::{Place, Role, System};

/// The quantities of all constraints at one instant.
#[derive(Clone, Debug)]
pub struct Held {
    /// f or g.
    pub residuals: Vec<Tracked>,
    /// f of the holonomic ones, zero for the others.
    pub positions: Vec<Tracked>,
    /// w.
    pub rates: Vec<Tracked>,
    /// A, a row for each.
    pub jacobian: Vec<Vec<Tracked>>,
    /// γ.
    pub gamma: Vec<Tracked>,
    /// λ.
    pub multipliers: Vec<Tracked>,
    /// Rows of A times λ.
    pub forces: Vec<Vec<Tracked>>,
    /// v·Aᵀλ − λ w.
    pub power: Tracked,
    /// d(T + V)/dt along (v, a, 1) less λ w.
    pub energy_rate: Tracked,
    /// Cartesian forces by the role of the particles or bodies: by constraint, place and component.
    pub on_places: BTreeMap<usize, Vec<Tracked>>,
}

const ZERO: Tracked = Tracked { value: 0.0, roundings: 0.0 };

fn sum(terms: impl IntoIterator<Item = Tracked>) -> Tracked {
    terms.into_iter().fold(ZERO, |sum, term| sum + term)
}

fn product(a: &[Tracked], b: &[Tracked]) -> Tracked {
    sum(a.iter().zip(b).map(|(&a, &b)| a * b))
}

/// A and γ in any number.
pub fn gradients<T: Number>(system: &System, at: &Instant<T>) -> (Vec<Vec<T>>, Vec<T>) {
    let residuals = system.constraints(at, None);
    let moving = at.in_motion();
    let change = system.constraints(&moving, None);
    let curvature = system.constraints(&moving.in_motion(), None);
    let by_coordinates: Vec<_> =
        (0..system.count()).map(|i| system.constraints(&at.by_coordinate(i), None)).collect();
    let by_velocities: Vec<_> =
        (0..system.count()).map(|i| system.constraints(&at.by_velocity(i), None)).collect();
    let zero = T::constant(0.0);
    let relaxation = system.baumgarte.as_ref().map_or(zero, |rate| Scope::new(system, at, 0).scalar(rate));
    let (mut jacobian, mut gammas) = (Vec::new(), Vec::new());
    for (c, kind) in system.kinds().into_iter().enumerate() {
        let (slopes, gamma) = match kind {
            Kind::Holonomic => {
                let twice = relaxation + relaxation;
                let spring = relaxation * relaxation * residuals[c];
                (&by_coordinates, -curvature[c].slope.slope - twice * change[c].slope - spring)
            }
            Kind::Affine | Kind::Chetaev => (&by_velocities, -change[c].slope - relaxation * residuals[c]),
        };
        jacobian.push(slopes.iter().map(|slopes| slopes[c].slope).collect());
        gammas.push(gamma);
    }
    (jacobian, gammas)
}

impl Held {
    /// The quantities that are known before the equations are solved.
    pub fn of(system: &System, at: &Instant<Tracked>) -> Held {
        let kinds = system.kinds();
        let residuals = system.constraints(at, None);
        let change = system.constraints(&at.in_motion(), None);
        let (jacobian, gamma) = gradients(system, at);
        let mut held = Held {
            positions: residuals.clone(),
            rates: residuals.clone(),
            residuals,
            jacobian,
            gamma,
            multipliers: Vec::new(),
            forces: Vec::new(),
            power: ZERO,
            energy_rate: ZERO,
            on_places: BTreeMap::new(),
        };
        for (c, kind) in kinds.into_iter().enumerate() {
            match kind {
                Kind::Holonomic => held.rates[c] = change[c].slope,
                Kind::Affine | Kind::Chetaev => held.positions[c] = ZERO,
            }
        }
        held
    }

    /// (M −Aᵀ; A 0) and (f, γ).
    pub fn equations(&self, mass: &[Vec<Tracked>], force: &[Tracked]) -> (Vec<Vec<Tracked>>, Vec<Tracked>) {
        let mut matrix: Vec<Vec<Tracked>> = mass.to_vec();
        for (i, row) in matrix.iter_mut().enumerate() {
            row.extend(self.jacobian.iter().map(|gradient| -gradient[i]));
        }
        for gradient in &self.jacobian {
            matrix.push([&gradient[..], &vec![ZERO; self.jacobian.len()]].concat());
        }
        (matrix, [force, &self.gamma].concat())
    }

    /// Adds the quantities that follow from the solution (a, λ).
    pub fn complete(&mut self, system: &System, at: &Instant<Tracked>, solution: &[Tracked]) {
        let (accelerations, multipliers) = solution.split_at(system.count());
        self.multipliers = multipliers.to_vec();
        let times = |(row, &multiplier): (&Vec<Tracked>, &Tracked)| -> Vec<Tracked> {
            row.iter().map(|&slope| multiplier * slope).collect()
        };
        self.forces = self.jacobian.iter().zip(multipliers).map(times).collect();
        let carried = product(multipliers, &self.rates);
        self.power = sum(self.forces.iter().map(|force| product(force, &at.v))) - carried;
        let along = at.along(|i| at.v[i], |i| accelerations[i], 1.0);
        self.energy_rate = energy(system, &along).slope - carried;
        self.on_places = self.forces_on_places(system, at);
    }

    /// λ ∂f/∂r with f as a function of positions and coordinates. A coordinate that is a component of one
    /// position counts as that component; so do velocities, where the constraint is one on velocities.
    fn forces_on_places(&self, system: &System, at: &Instant<Tracked>) -> BTreeMap<usize, Vec<Tracked>> {
        let kinds = system.kinds();
        let components: Vec<(Place, usize, usize)> = system
            .all_places()
            .into_iter()
            .flat_map(|(place, dimension)| (0..dimension).map(move |k| (place, dimension, k)))
            .collect();
        let still = at.along(|_| ZERO, |_| ZERO, 0.0);
        // ∂f/∂r, a list by constraint for every component.
        let through: Vec<Vec<Tracked>> = components
            .iter()
            .map(|&(place, dimension, k)| {
                let mut by = vec![Dual::still(ZERO); dimension];
                by[k].slope = Tracked::constant(1.0);
                let values = system.constraints(&still, Some(&(place, by)));
                values.into_iter().map(|value| value.slope).collect()
            })
            .collect();
        let slope = |coordinate: usize, (place, _, k): (Place, usize, usize)| {
            system.positions(place.role, &at.by_coordinate(coordinate))[place.index][k].slope
        };
        let (coordinates, uncertain) = same_as_coordinates(system, at, &components);
        let mut forces: BTreeMap<usize, Vec<Vec<Tracked>>> = BTreeMap::new();
        for (number, &component) in components.iter().enumerate() {
            let rows =
                forces.entry(component.0.role).or_insert_with(|| vec![Vec::new(); self.multipliers.len()]);
            for (c, row) in rows.iter_mut().enumerate() {
                let holonomic = kinds[c] == Kind::Holonomic;
                let mut force = if holonomic { through[number][c] } else { ZERO };
                if let Some(i) = coordinates[number] {
                    // The part of the force that reaches the coordinate through positions.
                    let carried = components.iter().zip(&through).map(|(&other, by)| by[c] * slope(i, other));
                    let carried = if holonomic { sum(carried) } else { ZERO };
                    force = force + self.jacobian[c][i] - carried;
                }
                row.push(self.multipliers[c] * force);
            }
        }
        forces.retain(|role, _| !uncertain.contains(role));
        forces.into_iter().map(|(role, rows)| (role, rows.concat())).collect()
    }
}

/// The coordinate that each component of a position is, unless that coordinate is a component of others as
/// well. It is found at two instants that have nothing to do with the given one, and at which a sine differs
/// from its argument. Returns also the roles with a component that equals a coordinate by its value and not
/// by its form: the engine may see that or not.
fn same_as_coordinates(
    system: &System,
    at: &Instant<Tracked>,
    components: &[(Place, usize, usize)],
) -> (Vec<Option<usize>>, BTreeSet<usize>) {
    let elsewhere = |sign: f64| {
        let q = (0..system.count()).map(|i| Tracked::constant(sign * (0.7319 + 0.0473 * i as f64))).collect();
        Instant { q, t: Tracked::constant(1.2347 + sign), ..at.clone() }
    };
    let instants = [elsewhere(1.0), elsewhere(-1.0)];
    let is = |i: usize, (place, _, k): (Place, usize, usize)| {
        instants.iter().all(|at| {
            let value = system.positions(place.role, at)[place.index][k].value;
            (value - at.q[i].value).abs() <= 1e-14 * at.q[i].value.abs()
        })
    };
    let (mut found, mut uncertain) = (vec![None; components.len()], BTreeSet::new());
    for i in 0..system.count() {
        let same: Vec<usize> = (0..components.len()).filter(|&number| is(i, components[number])).collect();
        if same.iter().any(|&number| !is_written(system, i, components[number])) {
            uncertain.extend(same.iter().map(|&number| components[number].0.role));
        } else if let [one] = same[..] {
            found[one] = Some(i);
        }
    }
    (found, uncertain)
}

/// Whether a component of a position is written as nothing but a coordinate.
fn is_written(system: &System, coordinate: usize, (place, _, k): (Place, usize, usize)) -> bool {
    let position = match &system.roles[place.role] {
        Role::Point { position, .. } => &position.result,
        Role::Planar { pose, .. } => &pose.result.0,
        Role::Spatial { pose, .. } => &pose.result.0,
        _ => return false,
    };
    let Vector::New(written) = position else { return false };
    matches!(*written[k], Expr::Coordinate(i) if i % system.count() == coordinate)
}

/// T + V, where a Lagrangian that is given as a whole contributes v·∂L/∂v − L.
fn energy<T: Number>(system: &System, at: &Instant<T>) -> T {
    let energies = system.energies(at);
    let mut total = energies.kinetic + energies.potential - energies.whole;
    for i in 0..system.count() {
        total = total + at.v[i] * system.energies(&at.by_velocity(i)).whole.slope;
    }
    total
}
