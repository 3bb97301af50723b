//! Where systems come to rest, from anywhere, and how stable that is.

use std::f64::consts::PI;

use lagrangian::{EquilibriumError, FoundBy, Stability, prelude::*};

use crate::support::close::{all_close, close};
use crate::support::sample::Samples;

/// Charges on a sphere (J. J. Thomson, Phil. Mag. 7 (1904) 237).
macro_rules! charges {
    ($name:ident, $count:literal) => {
        struct $name;

        #[lagrangian(coordinates = [x: [$count], y: [$count], z: [$count]], jacobians)]
        impl $name {
            #[point(mass = 1.0)]
            fn charges(&self, q: &Coordinates) -> [Vector3<f64>; $count] {
                core::array::from_fn(|i| Vector3::new(q.x[i], q.y[i], q.z[i]))
            }

            #[potential]
            fn repulsion(&self, q: &Coordinates) -> f64 {
                let mut sum = 0.0;
                for i in 0..$count {
                    for j in 0..i {
                        let square =
                            (q.x[i] - q.x[j]).powi(2) + (q.y[i] - q.y[j]).powi(2) + (q.z[i] - q.z[j]).powi(2);
                        sum += 1.0 / square.sqrt();
                    }
                }
                sum
            }

            #[holonomic]
            fn sphere(&self, q: &Coordinates) -> [f64; $count] {
                core::array::from_fn(|i| q.x[i].powi(2) + q.y[i].powi(2) + q.z[i].powi(2) - 1.0)
            }
        }
    };
}

charges!(Four, 4);
charges!(Six, 6);
charges!(Ten, 10);

/// Random starts end where the energy is the one expected, a minimum but for rotations of the sphere.
macro_rules! settles {
    ($system:ident, $coordinates:literal, $energy:literal, $starts:literal) => {
        let mut samples = Samples::new($coordinates);
        for _ in 0..$starts {
            let guess: [f64; $coordinates] = core::array::from_fn(|_| samples.number(-1.0, 1.0));
            let rest = $system.equilibrium(guess, &[]).unwrap();
            close($system.potential_energy(&rest.state), $energy, 1e-9);
            assert_eq!(
                (rest.stability, rest.found_by),
                (Stability::Neutral { directions: 3 }, FoundBy::Descent)
            );
        }
    };
}

#[test]
fn charges_on_a_sphere_settle_at_the_least_energy() {
    // L. L. Whyte, Amer. Math. Monthly 59 (1952) 606.
    settles!(Four, 12, 3.674_234_614, 12);
    settles!(Six, 18, 9.985_281_374, 6);
    settles!(Ten, 30, 32.716_949_460, 4);
}

/// A double pendulum by angles from straight down, the second one absolute.
struct Pendulums;

#[lagrangian(coordinates = [a, b], jacobians)]
impl Pendulums {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a.sin(), -q.a.cos())
    }

    #[point(mass = 0.7)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + 0.8 * Vector2::new(q.b.sin(), -q.b.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.upper(q).y + 0.7 * self.lower(q).y)
    }
}

#[test]
fn a_double_pendulum_from_anywhere_ends_hanging_on_the_near_side() {
    let mut samples = Samples::new(8);
    for _ in 0..60 {
        let guess: [f64; 2] = core::array::from_fn(|_| samples.number(-3.1, 3.1));
        let rest = Pendulums.equilibrium(guess, &[]).unwrap();
        all_close(rest.state.q, [0.0, 0.0], 1e-12);
        assert!(rest.stability == Stability::Stable && rest.is_isolated);
    }
}

#[test]
fn a_guess_that_is_an_equilibrium_is_the_answer() {
    for (guess, down) in [([PI, PI], 2), ([0.0, PI], 1), ([PI, 0.0], 1)] {
        let rest = Pendulums.equilibrium(guess, &[]).unwrap();
        all_close(rest.state.q, guess, 1e-15);
        assert_eq!(
            (rest.stability, rest.found_by),
            (Stability::Unstable { directions: down }, FoundBy::Guess)
        );
        // Near it the one falls, and the other does not.
        let near = guess.map(|angle| angle - 0.05);
        let fallen = Pendulums.equilibrium(near, &[]).unwrap();
        all_close(fallen.state.q, [0.0, 0.0], 1e-12);
        let upright = Pendulums.stationary_point(near, &[]).unwrap();
        all_close(upright.state.q, guess, 1e-12);
        assert_eq!(
            (upright.stability, upright.found_by),
            (Stability::Unstable { directions: down }, FoundBy::Newton)
        );
    }
}

/// A chain of rods that hangs from the origin.
struct Chain;

#[lagrangian(coordinates = [x: [15], y: [15]], jacobians)]
impl Chain {
    #[point(mass = 0.1)]
    fn points(&self, q: &Coordinates) -> [Vector2<f64>; 15] {
        core::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        q.y.iter().map(|y| 0.981 * y).sum()
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 15] {
        core::array::from_fn(|i| {
            let (x, y) = if i == 0 { (0.0, 0.0) } else { (q.x[i - 1], q.y[i - 1]) };
            (q.x[i] - x).powi(2) + (q.y[i] - y).powi(2) - 0.04
        })
    }
}

#[test]
fn a_chain_of_rods_ends_hanging_straight() {
    let mut samples = Samples::new(15);
    for _ in 0..4 {
        let guess: [f64; 30] = core::array::from_fn(|_| samples.number(-1.0, 1.0));
        let rest = Chain.equilibrium(guess, &[]).unwrap();
        assert_eq!(rest.stability, Stability::Stable);
        for (i, y) in (1..).zip(&rest.state.q[15..]) {
            close(*y, -0.2 * f64::from(i), 1e-12);
        }
        // Rods are pulled by the weight of what hangs below: 2 λ l = −n m g.
        for (n, multiplier) in (1..).zip(rest.multipliers.iter().rev()) {
            close(*multiplier, -0.0981 * 25.0 * f64::from(n), 1e-11);
        }
    }
}

/// A bead on a whirling hoop, by the angle from the lowest point.
struct Hoop {
    rate: f64,
}

#[lagrangian(coordinates = [phi], jacobians)]
impl Hoop {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.125 * (v.phi.powi(2) + (self.rate * q.phi.sin()).powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -4.905 * q.phi.cos()
    }
}

#[test]
fn a_bead_on_a_whirling_hoop_rests_where_v_less_t0_is_least() {
    let hoop = Hoop { rate: 6.0 };
    let angle = (9.81_f64 / (36.0 * 0.5)).acos();
    for guess in [0.01, 0.5, 1.5, 3.0, -0.01, -2.9] {
        let rest = hoop.equilibrium([guess], &[]).unwrap();
        close(rest.state.q[0], angle.copysign(guess), 1e-14);
        assert_eq!(rest.stability, Stability::Stable);
    }
    let bottom = hoop.equilibrium([0.0], &[]).unwrap();
    assert_eq!((bottom.state.q[0], bottom.stability), (0.0, Stability::Unstable { directions: 1 }));
    assert_eq!(Hoop { rate: 3.0 }.equilibrium([1.0], &[]).unwrap().stability, Stability::Stable);
}

/// A particle on a turning table, held or pushed away by springs: ẍ − 2 W ẏ + (k − W²) x + c ẋ = 0.
struct Table {
    rate: f64,
    springs: [f64; 2],
    drag: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Table {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * ((v.x - self.rate * q.y).powi(2) + (v.y + self.rate * q.x).powi(2))
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (self.springs[0] * q.x.powi(2) + self.springs[1] * q.y.powi(2))
    }

    /// In the turning frame.
    #[dissipation]
    fn drag(&self, v: &Velocities) -> f64 {
        0.5 * self.drag * (v.x.powi(2) + v.y.powi(2))
    }
}

#[test]
fn gyroscopic_forces_hold_what_damping_lets_fall() {
    // s⁴ + (4 W² + a + b) s² + a b with a, b = k − W²: a turning shaft, stable below and beyond its critical
    // speeds, and unstable between them.
    let stability = |rate: f64, springs, drag| {
        let table = Table { rate, springs, drag };
        table.equilibrium([0.0, 0.0], &[]).unwrap().stability
    };
    assert_eq!(stability(1.0, [2.0, 3.0], 0.0), Stability::Stable);
    assert_eq!(stability(1.0, [2.0, 3.0], 0.1), Stability::Stable);
    assert_eq!(stability(1.6, [2.0, 3.0], 0.0), Stability::Unstable { directions: 1 });
    assert_eq!(stability(2.0, [2.0, 3.0], 0.0), Stability::Gyroscopic { directions: 2 });
    assert_eq!(stability(2.0, [2.0, 3.0], 0.1), Stability::Unstable { directions: 2 });
    assert_eq!(stability(2.0, [4.0, 5.0], 0.0), Stability::Neutral { directions: 1 });
    // The centrifugal force drives the search away without end.
    let off = Table { rate: 2.0, springs: [2.0, 3.0], drag: 0.0 }.equilibrium([0.1, 0.2], &[]);
    assert!(matches!(off, Err(EquilibriumError::RanAway { .. })), "{off:?}");
    let back = Table { rate: 2.0, springs: [2.0, 3.0], drag: 0.0 }.stationary_point([0.1, 0.2], &[]).unwrap();
    assert_eq!(back.stability, Stability::Gyroscopic { directions: 2 });
}

/// Two links with a force along the last one that follows it (Ziegler's column): m = 2, 1 at the joints, both
/// springs 1.
struct Column;

#[lagrangian(coordinates = [a, b], inputs = [thrust], jacobians)]
impl Column {
    #[point(mass = 2.0)]
    fn knee(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a.sin(), q.a.cos())
    }

    #[point(mass = 1.0)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.knee(q) + Vector2::new(q.b.sin(), q.b.cos())
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (q.a.powi(2) + (q.b - q.a).powi(2))
    }

    #[force(at = tip)]
    fn thrust(&self, q: &Coordinates, u: &Inputs) -> Vector2<f64> {
        -u.thrust * Vector2::new(q.b.sin(), q.b.cos())
    }
}

#[test]
fn followers_have_no_potential_and_flutter() {
    // H. Ziegler, Ing.-Arch. 20 (1952) 49: it flutters from P = (7/2 − √2) c/l on and never buckles.
    let critical = 3.5 - 2.0_f64.sqrt();
    for (thrust, is_stable) in [(0.5, true), (critical - 0.01, true), (critical + 0.01, false), (3.0, false)]
    {
        let rest = Column.equilibrium([0.2, -0.1], &[thrust]).unwrap();
        all_close(rest.state.q, [0.0, 0.0], 1e-12);
        assert_eq!(rest.found_by, FoundBy::Newton);
        let expected = if is_stable { Stability::Undecided } else { Stability::Unstable { directions: 2 } };
        assert_eq!(rest.stability, expected, "{thrust}");
    }
    // Without it the column is conservative.
    let rest = Column.equilibrium([2.0, -1.0], &[0.0]).unwrap();
    assert_eq!((rest.stability, rest.found_by), (Stability::Stable, FoundBy::Descent));
}

/// A bead on an ellipsoid, heavy, so that nothing can run away.
struct Ellipsoid;

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Ellipsoid {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        (-(q.x - 2.0).powi(2) - q.y.powi(2) - 8.0 * q.z.powi(2)).exp() + 0.01 * q.z
    }

    #[holonomic]
    fn surface(&self, q: &Coordinates) -> f64 {
        (q.x / 2.0).powi(2) + q.y.powi(2) + (q.z / 0.5).powi(2) - 1.0
    }
}

#[test]
fn nothing_runs_away_on_a_closed_surface() {
    let mut samples = Samples::new(3);
    for _ in 0..40 {
        let guess: [f64; 3] = core::array::from_fn(|_| samples.number(-2.0, 2.0));
        let rest = Ellipsoid.equilibrium(guess, &[]).unwrap();
        assert_eq!(rest.stability, Stability::Stable, "{guess:?}");
        // Newton's method may end without a result, but nowhere far away.
        let found = Ellipsoid.stationary_point(guess, &[]);
        assert!(!matches!(found, Err(EquilibriumError::RanAway { .. })), "{guess:?}: {found:?}");
    }
}

/// A well whose walls fade, as a Lagrangian given as a whole, in any precision.
struct Well<R> {
    width: R,
}

#[lagrangian(coordinates = [x], jacobians)]
impl<R: Real> Well<R> {
    #[lagrangian]
    fn lagrangian(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        0.5 * v.x.powi(2) + (-(q.x / self.width).powi(2)).exp()
    }
}

#[test]
fn a_well_is_found_from_where_the_squares_of_its_forces_are_no_numbers() {
    // The square of exp(−81) underflows to zero in single precision, that of exp(−400) in double.
    for guess in [0.1, 0.6, 2.0, 8.0, 9.0] {
        let rest = Well { width: 1.0_f32 }.equilibrium([guess], &[]).unwrap();
        assert_eq!((rest.state.q, rest.stability), ([0.0], Stability::Stable), "{guess}");
    }
    for guess in [0.1, 0.6, 2.0, 9.0, 20.0] {
        let rest = Well { width: 1e-12 }.equilibrium([1e-12 * guess], &[]).unwrap();
        close(rest.state.q[0] / 1e-12, 0.0, 1e-12);
        assert_eq!(rest.stability, Stability::Stable, "{guess}");
    }
}
