//! Classical problems: C13 the acrobot, C14 the cart-pole, and chains whose modes are known.

use std::f64::consts::PI;

use lagrangian::{EquilibriumError, prelude::*};

use crate::support::close::{all_close, close};
use crate::support::reference::classical;

/// Two links with friction in the joints and a motor at the elbow; angles from straight down, the second one
/// relative.
struct Acrobot;

#[lagrangian(coordinates = [shoulder, elbow], inputs = [motor], jacobians)]
impl Acrobot {
    #[body(mass = 1.0, inertia = 0.083)]
    fn upper(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (0.5 * Vector2::new(q.shoulder.sin(), -q.shoulder.cos()), q.shoulder)
    }

    #[body(mass = 1.0, inertia = 0.33)]
    fn lower(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let turn = q.shoulder + q.elbow;
        (2.0 * self.upper(q).0 + Vector2::new(turn.sin(), -turn.cos()), turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.upper(q).0.y + self.lower(q).0.y)
    }

    #[dissipation]
    fn friction(&self, v: &Velocities) -> f64 {
        0.05 * (v.shoulder.powi(2) + v.elbow.powi(2))
    }

    #[force(on = elbow)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

#[test]
fn c13_the_acrobot_upright() {
    let reference = classical("C13_acrobot");
    let rest = Acrobot.stationary_point([3.0, 0.2], &[0.0]).unwrap();
    all_close(rest.state.q, [PI, 0.0], 1e-13);
    let model = Acrobot.linearize(&State::at_rest([PI, 0.0]), &[0.0]).unwrap();
    let a = model.state_matrix::<4>().unwrap();
    for (i, row) in reference.rows::<4>("A_lower").iter().enumerate() {
        let found: Vec<f64> = a.row(2 + i).iter().copied().collect();
        all_close(found, row, 1e-13);
        let above: Vec<f64> = a.row(i).iter().copied().collect();
        assert_eq!(above, [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]][i]);
    }
    let b = model.input_matrix::<4>().unwrap();
    all_close([b[2], b[3]], reference.numbers::<2>("B_lower"), 1e-13);
    let mut found: Vec<f64> =
        Acrobot.modes(&rest.state, &[0.0]).unwrap().iter().map(|mode| mode.eigenvalue.re).collect();
    found.sort_by(f64::total_cmp);
    let expected: Vec<f64> = reference.rows::<2>("eig_upright").iter().map(|pair| pair[0]).collect();
    all_close(found, expected, 1e-13);
}

/// A cart with a uniform pole, its angle clockwise from upright.
struct CartPole;

#[lagrangian(coordinates = [x, theta], inputs = [push], jacobians)]
impl CartPole {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[body(mass = 0.1, inertia = 0.1 * 0.25 / 3.0)]
    fn pole(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (self.cart(q) + 0.5 * Vector2::new(q.theta.sin(), q.theta.cos()), -q.theta)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.1 * 9.8 * self.pole(q).0.y
    }

    #[force(at = cart)]
    fn push(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.push, 0.0)
    }
}

#[test]
fn c14_the_cart_pole_upright() {
    let rest = CartPole.stationary_point([0.7, 0.3], &[0.0]).unwrap();
    // The place of the cart does not matter, so the cart stays where it was. That is no isolated equilibrium.
    all_close(rest.state.q, [0.7, 0.0], 1e-12);
    assert!(!rest.is_isolated);
    let modes = CartPole.modes(&rest.state, &[0.0]).unwrap();
    let most = modes.iter().map(|mode| mode.eigenvalue.re).fold(f64::NEG_INFINITY, f64::max);
    close(most, classical("C14_cartpole").number("upright_unstable_eig"), 1e-14);
    assert_eq!(modes[0].frequency(), 0.0);
    close(modes[0].shape[1].re, 0.0, 1e-12);
    // Pushed, the cart cannot rest.
    assert!(CartPole.stationary_point([0.7, 0.3], &[1.0]).is_err());
    let Err(EquilibriumError::Unbalanced { coordinate: 0, force, .. }) =
        CartPole.equilibrium([0.7, 0.3], &[1.0])
    else {
        panic!("a cart that is pushed rests")
    };
    close(f64::from(force.0), 1.0, 1e-6);
}

/// Masses between equal springs in a row, walls at both ends.
struct Row;

#[lagrangian(coordinates = [x: [20]], jacobians)]
impl Row {
    #[point(mass = 0.5)]
    fn masses(&self, q: &Coordinates) -> [Vector1<f64>; 20] {
        q.x.map(Vector1::new)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let inner: f64 = q.x.windows(2).map(|pair| 4.0 * (pair[1] - pair[0]).powi(2)).sum();
        inner + 4.0 * (q.x[0].powi(2) + q.x[19].powi(2))
    }
}

#[test]
fn twenty_masses_in_a_row_have_the_frequencies_of_a_lattice() {
    // ω = 2 √(k/m) sin(nπ/42) and shapes sin(nπj/21), k/m = 16.
    let rest = Row.equilibrium([0.1; 20], &[]).unwrap();
    let modes = Row.modes(&rest.state, &[]).unwrap();
    assert_eq!(modes.len(), 20);
    for (n, mode) in (1..).zip(&modes) {
        close(mode.frequency(), 8.0 * (f64::from(n) * PI / 42.0).sin(), 1e-13);
        let component = |j: i32| (f64::from(n * j) * PI / 21.0).sin();
        let leading = mode.shape.iter().zip(1..).max_by(|a, b| a.0.re.total_cmp(&b.0.re)).unwrap();
        for (shape, j) in mode.shape.iter().zip(1..) {
            close(shape.re / leading.0.re, component(j) / component(leading.1), 1e-10);
            assert_eq!(shape.im, 0.0);
        }
        let norm: f64 = mode.shape.iter().map(|x| 0.5 * x.re.powi(2)).sum();
        close(norm, 1.0, 1e-14);
    }
}

/// Two equal oscillators with the same damping: eigenvalues of multiplicity two.
struct Twins;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Twins {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        2.0 * (q.x.powi(2) + q.y.powi(2))
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2))
    }
}

#[test]
fn equal_eigenvalues_have_independent_shapes() {
    let modes = Twins.modes(&State::at_rest([0.0, 0.0]), &[]).unwrap();
    assert_eq!(modes.len(), 2);
    for mode in &modes {
        close(mode.eigenvalue.re, -0.5, 1e-14);
        close(mode.eigenvalue.im, 3.75_f64.sqrt(), 1e-14);
    }
    let [a, b] = [modes[0].shape, modes[1].shape];
    let determinant = a[0] * b[1] - a[1] * b[0];
    assert!(determinant.re.hypot(determinant.im) > 0.1, "{determinant}");
}

/// Forces that fade with the distance and vanish nowhere.
struct Fading {
    power: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Fading {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        -self.power / q.x.hypot(q.y)
    }
}

struct FadingFaster;

#[lagrangian(coordinates = [z], jacobians)]
impl FadingFaster {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.z.powi(2)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        (-q.z).exp()
    }
}

/// A well whose walls fade.
struct Well;

#[lagrangian(coordinates = [x], jacobians)]
impl Well {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        -(-q.x.powi(2)).exp()
    }
}

#[test]
fn nothing_rests_at_infinity() {
    for power in [1.0, -1.0] {
        let found = Fading { power }.stationary_point([1.0, 0.0], &[]);
        assert!(matches!(found, Err(EquilibriumError::RanAway { coordinate: 0, .. })), "{found:?}");
        // An attraction leads into the centre, and a repulsion away from it in some direction.
        let found = Fading { power }.equilibrium([1.0, 0.0], &[]);
        assert!(matches!(found, Err(EquilibriumError::RanAway { .. })), "{found:?}");
    }
    let found = FadingFaster.equilibrium([1.0], &[]);
    assert!(matches!(found, Err(EquilibriumError::RanAway { coordinate: 0, .. })), "{found:?}");
    for guess in [0.6, 3.0] {
        let found = Well.stationary_point([guess], &[]);
        let Err(error @ EquilibriumError::RanAway { coordinate: 0, .. }) = found else { panic!("{found:?}") };
        assert!(error.to_string().contains("ran away along coordinate `x`"), "{error}");
        // Downhill there is the bottom.
        let rest = Well.equilibrium([guess], &[]).unwrap();
        close(rest.state.q[0], 0.0, 1e-15);
    }
    assert!(Well.equilibrium([0.3], &[]).unwrap().is_isolated);
}
