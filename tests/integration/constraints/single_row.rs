//! A single constraint whose gradient vanishes on the way: branches cross there, and the velocity decides.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};

/// A four-bar with a base of 2, cranks of 1 and a coupler of 2, by the angles of its cranks. Where both lie
/// along the base, its two forms meet: the parallelogram, ψ = θ, and the antiparallelogram, tan ψ/2 = −3 tan
/// θ/2.
struct FourBar;

#[lagrangian(coordinates = [theta, psi], jacobians)]
impl FourBar {
    #[point(mass = 1.0)]
    fn left(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.cos(), q.theta.sin())
    }

    #[point(mass = 0.6)]
    fn right(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(2.0 + q.psi.cos(), q.psi.sin())
    }

    #[holonomic]
    fn coupler(&self, q: &Coordinates) -> f64 {
        (self.right(q) - self.left(q)).norm_squared() - 4.0
    }
}

/// A slider-crank with links of 1. Where the slider is at the crank's bearing, it could also stay there: x =
/// 2 cos θ, or x = 0.
struct Isosceles;

#[lagrangian(coordinates = [theta, x])]
impl Isosceles {
    #[kinetic]
    fn crank(&self, v: &Velocities) -> f64 {
        0.5 * v.theta * v.theta
    }

    #[point(mass = 0.8)]
    fn slider(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        (Vector2::new(q.x, 0.0) - Vector2::new(q.theta.cos(), q.theta.sin())).norm() - 1.0
    }
}

/// On the antiparallelogram, on its way to the crossing.
fn crossed(speed: f64) -> State<f64, 2> {
    let theta = 0.7_f64;
    let psi = -2.0 * (3.0 * (theta / 2.0).tan()).atan();
    let ratio = -3.0 * ((psi / 2.0).cos() / (theta / 2.0).cos()).powi(2);
    State::new([theta, psi], [-speed, -speed * ratio])
}

fn upright(speed: f64) -> State<f64, 2> {
    let (sin, cos) = 0.5_f64.sin_cos();
    State::new([0.5, 2.0 * cos], [speed, -2.0 * speed * sin])
}

const TOLERANCES: [f64; 7] = [1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];

fn speeds() -> impl Iterator<Item = f64> {
    (0..20).map(|k| 0.6 + 0.1 * f64::from(k))
}

/// The residual of the equation of the branch, and the change of the energy.
fn branch<S: System<2, 0, Scalar = f64>>(
    system: &S,
    [start, end]: [&State<f64, 2>; 2],
    lack: fn(&[f64; 2]) -> f64,
    tolerance: f64,
) {
    let energy = |state: &State<f64, 2>| system.energy_at(&system.constants(), state.t, &state.q, &state.v);
    // Errors of some tens of steps add up; at the tightest tolerances rounding errors remain.
    let allowed = 1e3 * tolerance + 1e-11;
    close(lack(&end.q), 0.0, allowed);
    close(energy(end) / energy(start), 1.0, allowed);
}

const CROSSED: fn(&[f64; 2]) -> f64 = |q| (q[1] / 2.0).tan() + 3.0 * (q[0] / 2.0).tan();
const SIDE_BY_SIDE: fn(&[f64; 2]) -> f64 = |q| q[1] - q[0];
const FOLLOWING: fn(&[f64; 2]) -> f64 = |q| q[1] - 2.0 * q[0].cos();

#[test]
fn a_motion_stays_on_its_branch_at_any_tolerance() {
    for tolerance in TOLERANCES {
        for speed in speeds() {
            macro_rules! check {
                ($system:expr, $start:expr, $span:expr, $lack:expr) => {
                    let start = $start;
                    let mut motion = $system.simulate(start).with_tolerance(tolerance);
                    let end = *motion.advance_to($span / speed).expect("a motion");
                    branch(&$system, [&start, &end], $lack, tolerance);
                };
            }
            check!(FourBar, crossed(speed), 1.5, CROSSED);
            check!(FourBar, State::new([0.7, 0.7], [-speed; 2]), 1.5, SIDE_BY_SIDE);
            check!(Isosceles, upright(speed), 2.0, FOLLOWING);
        }
    }
}

#[test]
fn samples_of_any_spacing_are_on_the_same_branch() {
    for interval in [0.3, 0.1, 0.01, 0.001] {
        let start = crossed(1.0);
        let mut motion = FourBar.simulate(start);
        let count = (1.5_f64 / interval).round() as usize + 1;
        for state in motion.every(interval).take(count) {
            branch(&FourBar, [&start, &state.expect("a motion")], CROSSED, 1e-10);
        }
    }
}

#[test]
fn dop853_stays_on_its_branch_or_says_that_it_cannot() {
    for tolerance in [1e-6, 1e-8, 1e-10] {
        for speed in speeds() {
            let start = crossed(speed);
            let motion = FourBar.simulate_with::<Dop853>(start).with_tolerance(tolerance);
            match motion.with_max_steps(2000).advance_to(1.5 / speed) {
                Ok(end) => branch(&FourBar, [&start, end], CROSSED, tolerance),
                Err(error) => assert!(tolerance < 1e-6, "{error}"),
            }
            let start = upright(speed);
            let motion = Isosceles.simulate_with::<Dop853>(start).with_tolerance(tolerance);
            match motion.with_max_steps(2000).advance_to(2.0 / speed) {
                Ok(end) => branch(&Isosceles, [&start, end], FOLLOWING, tolerance),
                Err(error) => assert!(tolerance < 1e-6, "{error}"),
            }
        }
    }
}

/// A single row depends on no other, so a stage beside it has its own accelerations, close to the crossing
/// too.
#[test]
fn derivatives_beside_the_row_are_those_of_the_accelerations() {
    for theta in [1e-2, 1e-3, 3e-4] {
        let psi = -2.0 * (3.0 * (0.5_f64 * theta).tan()).atan();
        let (q, v) = ([theta, psi + 0.1 * theta], [1.0, -5.0]);
        let accelerations =
            |q: &[f64; 2], v: &[f64; 2]| FourBar.accelerations_at(&FourBar.constants(), 0.0, q, v, &[]);
        let a = accelerations(&q, &v);
        let found = FourBar.linearization_at(&FourBar.constants(), 0.0, &q, &v, &a, &[]);
        for j in 0..2 {
            let moved =
                |x: [f64; 2], by: f64| core::array::from_fn(|i| if i == j { x[i] + by } else { x[i] });
            let step = 1e-4 * theta;
            let (before, after) = (accelerations(&moved(q, -step), &v), accelerations(&moved(q, step), &v));
            let (slower, faster) = (accelerations(&q, &moved(v, -1e-4)), accelerations(&q, &moved(v, 1e-4)));
            for i in 0..2 {
                let scale = (a[i] / theta).abs();
                close_on(scale, found.by_q[i][j], (after[i] - before[i]) / (2.0 * step), 1e-5);
                close_on(scale, found.by_v[i][j], (faster[i] - slower[i]) / 2e-4, 1e-5);
            }
        }
    }
}
