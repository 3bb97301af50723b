//! Units change no result beyond roundings.

use lagrangian::{Equilibrium, EquilibriumError, prelude::*};

use crate::support::close::close;

/// An atom that a spring holds.
struct Atom<R> {
    mass: R,
    stiffness: R,
    place: R,
}

#[lagrangian(coordinates = [x], jacobians)]
impl<R: Real> Atom<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        0.5 * self.stiffness * (q.x - self.place).powi(2)
    }
}

#[test]
fn an_atom_comes_to_rest_in_single_precision() {
    for (stiffness, place) in [(10.0, 3e-10_f32), (1e-3, 3e-9), (1e-3, 5e-30), (1e10, 2e15)] {
        let atom = Atom { mass: 1e-26, stiffness, place };
        for guess in [1.2 * place, 0.0, -3.0 * place] {
            for found in [atom.equilibrium([guess], &[]), atom.stationary_point([guess], &[])] {
                let rest = found.unwrap();
                assert!((rest.state.q[0] - place).abs() <= 1e-6 * place, "{place:e} {:e}", rest.state.q[0]);
            }
        }
    }
}

/// A bead on a ring, tied to a weight beside it that sits on a bumpy ground.
struct Ring<R> {
    mass: R,
    stiffness: R,
    weight: R,
    radius: R,
    bump: R,
}

#[lagrangian(coordinates = [x, y, s], jacobians)]
impl<R: Real> Ring<R> {
    #[point(mass = self.mass)]
    fn bead(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[point(mass = 3.0 * self.mass)]
    fn other(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.s, q.y)
    }

    #[holonomic]
    fn ring(&self, q: &Coordinates<R>) -> R {
        q.x.hypot(q.y) - self.radius
    }

    #[potential]
    fn potential(&self, q: &Coordinates<R>) -> R {
        let bumps = 0.4 * self.stiffness * self.bump.powi(2) * (q.s / self.bump).cos();
        self.weight * q.y + 0.5 * self.stiffness * (q.s - q.x - self.bump).powi(2) + bumps
    }
}

type Found<R> = Result<Equilibrium<R, 3, 1>, EquilibriumError>;

/// Both searches, with the units of length, mass and time as numbers.
fn searched<R: Real + PartialOrd>([length, mass, time]: [f64; 3]) -> [Found<R>; 2] {
    let stiffness = 2.0 * mass / time / time;
    let [mass, stiffness, weight, radius, bump] =
        [mass, stiffness, 4.5 * stiffness * length, 0.7 * length, 0.3 * length].map(R::from_f64);
    let ring = Ring { mass, stiffness, weight, radius, bump };
    let guess = [0.5, -0.2, 0.9].map(|x| R::from_f64(x * length));
    [ring.equilibrium(guess, &[]), ring.stationary_point(guess, &[])]
}

/// Compares an equilibrium with that in other units, relative to the unit of length.
fn agrees<R: Copy + Into<f64>>(
    found: &Equilibrium<R, 3, 1>,
    wanted: &Equilibrium<f64, 3, 1>,
    units: [f64; 3],
    error: f64,
) {
    assert_eq!((found.stability, found.is_isolated), (wanted.stability, wanted.is_isolated), "{units:?}");
    for (found, wanted) in found.state.q.into_iter().zip(wanted.state.q) {
        close(found.into() / units[0], wanted, error);
    }
}

/// Numbers between zero and one.
fn chance() -> impl FnMut() -> f64 {
    let mut seed = 1_u64;
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn units_change_no_equilibrium() {
    let mut next = chance();
    let wanted = searched::<f64>([1.0; 3]).map(Result::unwrap);
    for _ in 0..300 {
        let units = [0; 3].map(|_| 10.0_f64.powf(24.0 * next() - 12.0));
        for (found, wanted) in searched::<f64>(units).into_iter().zip(&wanted) {
            agrees(&found.unwrap(), wanted, units, 1e-14);
        }
    }
}

#[test]
fn units_change_no_equilibrium_in_single_precision() {
    let mut next = chance();
    let wanted = searched::<f64>([1.0; 3]).map(Result::unwrap);
    let mut count = 0;
    while count < 300 {
        let units @ [length, mass, time] = [0; 3].map(|_| 10.0_f64.powf(70.0 * next() - 35.0));
        // What the equations compute has to be numbers: second derivatives of the constraint with its
        // multiplier divide force × length² by length³.
        let force = mass * length / time / time;
        let computed = [mass, force / length, force * length * length, length.powi(3), 1.0 / time / time];
        if !computed.into_iter().all(|x| (1e-33..1e33).contains(&x)) {
            continue;
        }
        count += 1;
        for (found, wanted) in searched::<f32>(units).into_iter().zip(&wanted) {
            agrees(&found.unwrap(), wanted, units, 1e-5);
        }
    }
}
