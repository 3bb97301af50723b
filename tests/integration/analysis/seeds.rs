//! Cases of the seed documents: S02, S03, S04, S06, S08, S13, S14 in generalized coordinates.

use lagrangian::{EquilibriumError, Stability, prelude::*};
use std::f64::consts::{FRAC_PI_6, PI};

use crate::support::close::{all_close, between, close};
use crate::support::reference::seed;

const G: f64 = 9.81;

/// A mass on a spring with a damper, from the unstretched spring (S02).
struct Damped {
    m: f64,
    k: f64,
    c: f64,
    g: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Damped {
    #[point(mass = self.m)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        0.5 * self.k * q.x.powi(2) - self.m * self.g * q.x
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.c * v.x.powi(2)
    }
}

#[test]
fn s02_a_damped_mass_on_a_spring() {
    let reference = seed("S02");
    let system = Damped { m: 2.0, k: 18.0, c: 3.0, g: G };
    let rest = system.equilibrium([0.7], &[]).unwrap();
    close(rest.state.q[0], 2.0 * G / 18.0, 1e-15);
    assert!(rest.is_isolated && rest.are_unique);
    let modes = system.modes(&rest.state, &[]).unwrap();
    assert_eq!(modes.len(), 1);
    let eigenvalue: [f64; 2] = reference.numbers("eigenvalue");
    all_close([modes[0].eigenvalue.re, modes[0].eigenvalue.im], eigenvalue, 1e-14);
    close(modes[0].frequency(), 3.0, 1e-14);
    close(modes[0].damping_ratio(), 0.25, 1e-14);
    let undamped = Damped { c: 0.0, ..system };
    close(
        undamped.modes(&rest.state, &[]).unwrap()[0].frequency(),
        reference.number("undamped_omega"),
        1e-14,
    );
}

/// A pinned bar with masses at its ends and a spring at a quarter (S03).
struct PinnedBar {
    m: f64,
    k: f64,
    length: f64,
    g: f64,
}

#[lagrangian(coordinates = [theta], jacobians)]
impl PinnedBar {
    #[point(mass = self.m)]
    fn top(&self, q: &Coordinates) -> Vector2<f64> {
        0.5 * self.length * Vector2::new(q.theta.sin(), q.theta.cos())
    }

    #[point(mass = 3.0 * self.m)]
    fn bottom(&self, q: &Coordinates) -> Vector2<f64> {
        -0.5 * self.length * Vector2::new(q.theta.sin(), q.theta.cos())
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        let spring = 0.5 * self.k * (0.25 * self.length * q.theta.sin()).powi(2);
        spring + self.m * self.g * (self.top(q).y + 3.0 * self.bottom(q).y)
    }
}

#[test]
fn s03_a_pinned_bar_in_both_readings() {
    let reference = seed("S03");
    let bar = PinnedBar { m: 1.5, k: 200.0, length: 0.8, g: G };
    for (g, key) in [(0.0, "omega_printed_no_gravity"), (G, "omega_with_gravity")] {
        let bar = PinnedBar { g, ..bar };
        let rest = bar.equilibrium([0.4], &[]).unwrap();
        close(rest.state.q[0], 0.0, 1e-15);
        close(bar.modes(&rest.state, &[]).unwrap()[0].frequency(), reference.number(key), 1e-14);
    }
}

/// A mass on an incline with a spring, along the plane (S04).
struct Incline {
    m: f64,
    k: f64,
    angle: f64,
}

#[lagrangian(coordinates = [s], jacobians)]
impl Incline {
    #[point(mass = self.m)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.s)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        0.5 * self.k * q.s.powi(2) - self.m * G * q.s * self.angle.sin()
    }
}

#[test]
fn s04_a_mass_on_an_incline() {
    let reference = seed("S04");
    let system = Incline { m: 2.0, k: 50.0, angle: FRAC_PI_6 };
    let rest = system.equilibrium([0.0], &[]).unwrap();
    close(rest.state.q[0], reference.number("q_eq"), 1e-15);
    close(system.modes(&rest.state, &[]).unwrap()[0].frequency(), reference.number("omega"), 1e-15);
}

/// A spring-mass in a rotating frame (S06).
struct Rotating {
    m: f64,
    k: [f64; 2],
    c: f64,
    rate: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Rotating {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * self.m * ((v.x - self.rate * q.y).powi(2) + (v.y + self.rate * q.x).powi(2))
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (self.k[0] * q.x.powi(2) + self.k[1] * q.y.powi(2))
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.c * v.x.powi(2)
    }
}

#[test]
fn s06_matrices_and_eigenvalues_in_a_rotating_frame() {
    let reference = seed("S06");
    let system = Rotating { m: 1.0, k: [20.0, 30.0], c: 0.4, rate: 2.0 };
    let rest = system.equilibrium([0.3, -0.2], &[]).unwrap();
    all_close(rest.state.q, [0.0, 0.0], 1e-15);
    let model = system.linearize(&rest.state, &[]).unwrap();
    let entries = |matrix: &SMatrix<f64, 2, 2>| matrix.transpose().iter().copied().collect::<Vec<_>>();
    all_close(entries(&model.mass), [1.0, 0.0, 0.0, 1.0], 1e-16);
    all_close(entries(&model.damping), [0.4, 0.0, 0.0, 0.0], 1e-16);
    all_close(entries(&model.gyroscopic), [0.0, -4.0, 4.0, 0.0], 1e-16);
    all_close(entries(&model.stiffness), [16.0, 0.0, 0.0, 26.0], 1e-16);
    assert!(model.state_matrix::<3>().is_none());
    assert_eq!(model.drift::<4>().unwrap().norm(), 0.0);

    let expected: Vec<[f64; 2]> = reference.rows("eigenvalues");
    let mut expected: Vec<_> = expected.into_iter().filter(|value| value[1] > 0.0).collect();
    expected.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let modes = system.modes(&rest.state, &[]).unwrap();
    for (mode, expected) in modes.iter().zip(&expected) {
        all_close([mode.eigenvalue.re, mode.eigenvalue.im], expected, 1e-13);
    }
    let undamped = Rotating { c: 0.0, ..system };
    let modes = undamped.modes(&rest.state, &[]).unwrap();
    let frequencies: Vec<f64> = modes.iter().map(|mode| mode.frequency()).collect();
    all_close(frequencies, reference.numbers::<2>("undamped_frequencies"), 1e-14);
}

#[test]
fn s06_stability_is_lost_and_regained() {
    let critical: [f64; 2] = seed("S06").numbers("critical_Omega_undamped");
    let growth = |rate: f64| {
        let system = Rotating { m: 1.0, k: [20.0, 30.0], c: 0.0, rate };
        let modes = system.modes(&State::at_rest([0.0, 0.0]), &[]).unwrap();
        modes.iter().map(|mode| mode.eigenvalue.re).fold(f64::NEG_INFINITY, f64::max)
    };
    for (rate, is_stable) in [
        (critical[0] - 1e-6, true),
        (critical[0] + 1e-6, false),
        (critical[1] - 1e-6, false),
        (critical[1] + 1e-6, true),
        (20.0, true),
    ] {
        let growth = growth(rate);
        println!("{rate}: {growth:e}");
        assert_eq!(growth < 1e-6, is_stable, "at {rate}: {growth}");
    }
}

/// A double pendulum with its second angle relative (S08).
struct DoublePendulum;

#[lagrangian(coordinates = [theta: [2]], jacobians)]
impl DoublePendulum {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta[0].cos(), q.theta[0].sin())
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        let angle = q.theta[0] + q.theta[1];
        self.upper(q) + Vector2::new(angle.cos(), angle.sin())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -G * (self.upper(q).x + self.lower(q).x)
    }
}

#[test]
fn s08_small_oscillations_of_a_double_pendulum() {
    let rest = DoublePendulum.equilibrium([0.5, -0.8], &[]).unwrap();
    all_close(rest.state.q, [0.0, 0.0], 1e-15);
    let modes = DoublePendulum.modes(&rest.state, &[]).unwrap();
    let found: Vec<f64> = modes.iter().map(|mode| mode.frequency()).collect();
    all_close(found, seed("S08").numbers::<2>("linear_omegas"), 1e-14);
    // Absolute angles are in the ratio 1 : ±√2.
    for (mode, ratio) in modes.iter().zip([2.0_f64.sqrt(), -2.0_f64.sqrt()]) {
        close((mode.shape[0].re + mode.shape[1].re) / mode.shape[0].re, ratio, 1e-13);
    }
    // The other three equilibria, all unstable.
    for (guess, expected) in [([0.1, 3.0], [0.0, PI]), ([3.0, 0.2], [PI, 0.0]), ([3.3, -3.0], [PI, -PI])] {
        let rest = DoublePendulum.stationary_point(guess, &[]).unwrap();
        all_close(rest.state.q, expected, 1e-12);
        let modes = DoublePendulum.modes(&rest.state, &[]).unwrap();
        assert!(modes.iter().any(|mode| mode.eigenvalue.re > 1.0));
    }
}

/// A particle in a bowl by polar angles, with the angle from the upward vertical (S13).
struct Bowl {
    radius: f64,
}

#[lagrangian(coordinates = [phi, theta], jacobians)]
impl Bowl {
    #[point(mass = 0.8)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        let (sin, cos) = q.phi.sin_cos();
        self.radius * Vector3::new(sin * q.theta.cos(), sin * q.theta.sin(), cos)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.8 * G * self.particle(q).z
    }
}

#[test]
fn s13_horizontal_circles_in_a_bowl() {
    // No horizontal circle is an equilibrium, but the motion on one is steady: about it the polar angle
    // oscillates.
    let bowl = Bowl { radius: 1.2 };
    let phi: f64 = 2.2;
    let rate = (-G / (bowl.radius * phi.cos())).sqrt();
    let state = State::new([phi, 0.3], [0.0, rate]);
    let modes = bowl.modes(&state, &[]).unwrap();
    // ω² = Ω² (1 + 3 cos²), and a double zero for the phase of the circle and its rate.
    let expected = rate * (1.0 + 3.0 * phi.cos().powi(2)).sqrt();
    close(modes.last().unwrap().frequency(), expected, 1e-12);
    assert!(modes.iter().rev().skip(1).all(|mode| mode.frequency() < 1e-6));
    // Only the bottom and the top are equilibria; there the azimuth means nothing.
    let rest = bowl.equilibrium([2.5, 0.0], &[]).unwrap();
    close(rest.state.q[0], PI, 1e-14);
    assert!(!rest.is_isolated);
}

/// A bead on a whirling hoop, in the frame of the hoop (S14).
struct Hoop {
    radius: f64,
    rate: f64,
}

#[lagrangian(coordinates = [phi], jacobians)]
impl Hoop {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * self.radius.powi(2) * (v.phi.powi(2) + (self.rate * q.phi.sin()).powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * self.radius * q.phi.cos()
    }
}

#[test]
fn s14_equilibria_of_a_whirling_hoop() {
    let reference = seed("S14");
    let hoop = Hoop { radius: 0.5, rate: 6.0 };
    let raised = hoop.equilibrium([2.0], &[]).unwrap();
    close(raised.state.q[0], reference.number("phi_eq"), 1e-15);
    let frequency = |hoop: &Hoop, state: &State<f64, 1>| hoop.modes(state, &[]).unwrap()[0].frequency();
    close(frequency(&hoop, &raised.state), reference.number("omega_about_eq"), 1e-14);
    let bottom = hoop.stationary_point([PI - 0.01], &[]).unwrap();
    close(bottom.state.q[0], PI, 1e-15);
    assert!(hoop.modes(&bottom.state, &[]).unwrap().iter().any(|mode| mode.eigenvalue.re > 0.0));
    assert_eq!(bottom.stability, Stability::Unstable { directions: 1 });
    // From there it leaves.
    let left = hoop.equilibrium([PI - 0.01], &[]).unwrap();
    close(left.state.q[0], reference.number("phi_eq"), 1e-14);
    assert_eq!((left.stability, raised.stability), (Stability::Stable, Stability::Stable));

    let slow = Hoop { rate: 3.0, ..hoop };
    let bottom = slow.equilibrium([2.0], &[]).unwrap();
    close(bottom.state.q[0], PI, 1e-15);
    close(frequency(&slow, &bottom.state), reference.number("omega_bottom_at_Omega_3"), 1e-14);
}

#[test]
fn s14_at_the_bifurcation_the_equilibrium_is_still_found() {
    let critical = seed("S14").number("critical_Omega");
    let hoop = Hoop { radius: 0.5, rate: critical };
    let rest = hoop.equilibrium([2.6], &[]).unwrap();
    // The force is of third order in the distance, so rounding errors hide it up to their cube root.
    assert!((rest.state.q[0] - PI).abs() < 2e-5, "{:?}", rest.state);
    assert!(!rest.is_isolated);
    between(-1e-3, hoop.modes(&rest.state, &[]).unwrap()[0].frequency(), 1e-3);
}

/// Under a constant force nothing rests.
struct Falling;

#[lagrangian(coordinates = [x, z], jacobians)]
impl Falling {
    #[point(mass = 2.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.z)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        2.0 * G * q.z + 50.0 * q.x.powi(2)
    }
}

#[test]
fn without_an_equilibrium_the_error_says_what_is_left() {
    match Falling.equilibrium([0.3, 1.0], &[]) {
        Err(EquilibriumError::Unbalanced { coordinate, force, .. }) => {
            assert_eq!(coordinate, 1);
            close(f64::from(force.0), 2.0 * G, 1e-7);
        }
        other => panic!("{other:?}"),
    }
    assert!(matches!(
        Falling.equilibrium([f64::NAN, 1.0], &[]),
        Err(EquilibriumError::Constraints(Cause::NotFinite))
    ));
}
