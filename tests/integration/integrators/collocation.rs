//! Gauss collocation on generated systems: orders, long runs, stiffness, damping, inputs, failure, `f32`.

use lagrangian::FixedStep;
use lagrangian::prelude::*;

use crate::support::close::{between, close};
use crate::support::motion::state_at;
use crate::support::reference::classical;

/// A pendulum on an elastic rod, in polar coordinates: the mass matrix depends on them.
struct Elastic<R> {
    stiffness: R,
}

#[lagrangian(coordinates = [theta, r], jacobians)]
impl<R: Real> Elastic<R> {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * q.r
    }

    #[potential]
    fn energy_of_place(&self, q: &Coordinates<R>) -> R {
        9.81 * self.bob(q).y + 0.5 * self.stiffness * (q.r - 1.0).powi(2)
    }
}

const ELASTIC: Elastic<f64> = Elastic { stiffness: 40.0 };

/// C06: a pendulum on a spring whose period is 2π ε, in Cartesian coordinates.
struct StiffSpring {
    eps: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl StiffSpring {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.bob(q).y
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        (self.bob(q).norm() - 1.0).powi(2) / (2.0 * self.eps.powi(2))
    }
}

/// The same with a rigid rod.
struct Rod;

#[lagrangian(coordinates = [theta])]
impl Rod {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.cos(), q.theta.sin())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.bob(q).y
    }
}

/// A cart with a pole, dampers of which one is very stiff, and a motor.
struct CartPole;

#[lagrangian(coordinates = [x, theta], inputs = [motor], jacobians)]
impl CartPole {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = 0.2)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.2 * 9.81 * self.tip(q).y
    }

    #[dissipation]
    fn dampers(&self, v: &Velocities) -> f64 {
        5e3 * v.x.powi(2) + 0.05 * v.theta.powi(2)
    }

    #[force(at = cart)]
    fn drive(&self, u: &Inputs, t: f64) -> Vector2<f64> {
        Vector2::new(u.motor * t.cos(), 0.0)
    }
}

/// A bead in a funnel whose floor ends at r = 1.
struct Funnel;

#[lagrangian(coordinates = [r], inputs = [pull], jacobians)]
impl Funnel {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.r.powi(2)
    }

    #[potential]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.r.ln() + (1.0 - q.r * q.r).sqrt()
    }

    #[force(on = r)]
    fn pull(&self, u: &Inputs) -> f64 {
        u.pull
    }
}

fn distance<const N: usize>(found: &State<f64, N>, exact: &State<f64, N>) -> f64 {
    found.iter().zip(exact.iter()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn start() -> State<f64, 2> {
    State::new([1.0, 1.1], [0.5, 0.0])
}

fn order<M: FixedStep<Elastic<f64>, 2, 0>>(steps: u32) -> f64 {
    let exact = state_at(&ELASTIC, start(), 2.0);
    let error = |steps: u32| {
        let mut motion = ELASTIC.stepper::<M>(start());
        for _ in 0..steps {
            motion.step(2.0 / f64::from(steps), &[]).unwrap();
        }
        distance(motion.state(), &exact)
    };
    (error(steps) / error(2 * steps)).log2()
}

#[test]
fn orders_four_six_and_eight() {
    between(3.9, order::<Gauss4>(100), 4.1);
    between(5.9, order::<Gauss6>(50), 6.1);
    between(7.8, order::<Gauss8>(30), 8.2);
}

/// The largest relative error of the energy in each half of a run.
fn energy_errors<M: FixedStep<Elastic<f64>, 2, 0>>(h: f64, steps: u32) -> [f64; 2] {
    let mut motion = ELASTIC.stepper::<M>(start());
    let energy = motion.energy();
    let mut worst = [0.0_f64; 2];
    for half in &mut worst {
        for _ in 0..steps / 2 {
            motion.step(h, &[]).unwrap();
            *half = half.max((motion.energy() / energy - 1.0).abs());
        }
    }
    worst
}

#[test]
fn the_energy_of_a_chaotic_pendulum_stays_in_a_band() {
    let [first, second] = energy_errors::<Gauss4>(0.05, 20_000);
    between(5e-7, first, 2e-6);
    between(0.8, second / first, 1.2);
}

#[test]
fn where_steps_resolve_the_motion_the_energy_walks_by_rounding() {
    let [first, second] = energy_errors::<Gauss8>(0.01, 40_000);
    between(1e-17, first, 1e-14);
    between(1e-17, second, 1e-14);
}

#[test]
fn steps_backward_undo_steps_forward() {
    let mut motion = ELASTIC.stepper::<Gauss6>(start());
    for h in [0.02, -0.02] {
        for _ in 0..100 {
            motion.step(h, &[]).unwrap();
        }
    }
    between(-1.0, distance(motion.state(), &start()), 1e-14);
}

/// Error of the state at t = 5 and the largest error of the energy.
fn stiff<M: FixedStep<StiffSpring, 2, 0>>(eps: f64, key: &str, steps: u32) -> [f64; 2] {
    let system = StiffSpring { eps };
    let exact: [f64; 4] = classical(&format!("C06_stiff_spring_pendulum_eps_{key}")).numbers("state(5)");
    let mut motion = system.stepper::<M>(State::at_rest([1.0, 0.0]));
    let mut energy = 0.0_f64;
    for _ in 0..steps {
        motion.step(5.0 / f64::from(steps), &[]).unwrap();
        energy = energy.max(motion.energy().abs());
    }
    let exact = State::new([exact[0], exact[1]], [exact[2], exact[3]]);
    [distance(motion.state(), &exact), energy]
}

#[test]
fn a_stiff_spring_needs_no_short_steps() {
    // Four periods of the spring a step: 200 steps where explicit methods need some 2000 to be stable.
    let [error, energy] = stiff::<Gauss8>(1e-3, "0.001", 200);
    between(1e-9, error, 1e-7);
    between(-1.0, energy, 1e-12);
    let [error, energy] = stiff::<Gauss6>(1e-3, "0.001", 500);
    between(1e-9, error, 1e-7);
    between(-1.0, energy, 1e-12);
    let [error, _] = stiff::<Gauss4>(1e-3, "0.001", 5000);
    between(1e-9, error, 1e-7);
    // Resolved, it is as good as any method.
    let [error, energy] = stiff::<Gauss8>(1e-3, "0.001", 20_000);
    between(-1.0, error, 1e-12);
    between(-1.0, energy, 1e-14);
}

#[test]
fn a_spring_stiffer_still_turns_far_within_a_step() {
    // Eight hundred periods of the spring and at most a thousandth of a turn a step.
    let system = StiffSpring { eps: 1e-6 };
    let mut motion = system.stepper::<Gauss6>(State::at_rest([1.0, 0.0]));
    for _ in 0..1000 {
        motion.step(0.005, &[]).unwrap();
    }
    between(-1e-8, motion.energy(), 1e-8);
    between(1.0 - 1e-9, motion.state().coordinates().norm(), 1.0 + 1e-9);
    // The rod pendulum, θ″ = −cos θ, from the horizontal.
    let rod = Rod.simulate(State::at_rest([0.0])).with_tolerance(1e-13).advance_to(5.0).unwrap().q[0];
    close(motion.state().q[0], rod.cos(), 1e-6);
}

#[test]
fn a_stiff_damper_and_a_motor_that_switches() {
    let segments = [(0.5, 30.0), (0.5, -2000.0), (0.5, 0.0)];
    let start = State::new([0.1, 0.3], [0.0, 0.2]);
    let mut exact = CartPole.simulate(start).with_tolerance(1e-12);
    let mut motion = CartPole.stepper::<Gauss6>(start);
    for (length, u) in segments {
        exact.set_inputs([u]);
        exact.advance_by(length).unwrap();
        // The damper acts within 0.1 ms. Long steps would not damp it out at once, so the steps start short.
        for k in 1..=60 {
            let weight = f64::from(k * k * k) - f64::from((k - 1) * (k - 1) * (k - 1));
            motion.step(length * weight / 216_000.0, &[u]).unwrap();
        }
    }
    between(-1.0, distance(motion.state(), exact.state()), 1e-8);
}

#[test]
fn a_step_that_cannot_be_solved_leaves_the_state() {
    let mut motion = Funnel.stepper::<Gauss4>(State::new([0.5], [0.1]));
    motion.step(0.01, &[0.0]).unwrap();
    let good = *motion.state();
    let error = motion.step(10.0, &[0.0]).unwrap_err();
    assert_eq!(error, MotionError { cause: Cause::NotConverged, t: good.t });
    assert_eq!(motion.state(), &good);
    assert_eq!(motion.step(0.01, &[f64::NAN]).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(motion.step(f64::NAN, &[0.0]).unwrap_err().cause, Cause::InvalidStep);
    assert_eq!(motion.state(), &good);
    let mut other = Funnel.stepper::<Gauss4>(State::new([0.5], [0.1]));
    other.step(0.01, &[0.0]).unwrap();
    let next = *motion.step(0.01, &[-1.0]).unwrap();
    assert_eq!(&next, other.step(0.01, &[-1.0]).unwrap());
    // A step of no length goes nowhere.
    assert_eq!(motion.step(0.0, &[0.0]).unwrap(), &next);
}

#[test]
fn a_singular_mass_matrix_is_named() {
    let mut motion = ELASTIC.stepper::<Gauss4>(State::new([1.0, 0.0], [0.0, 1.0]));
    let error = motion.step(0.01, &[]).unwrap_err();
    assert!(matches!(error.cause, Cause::SingularMassMatrix { pivot: 0, .. }), "{error}");
}

#[test]
fn single_precision_conserves_to_its_rounding() {
    let system = Elastic { stiffness: 40.0_f32 };
    let mut motion = system.stepper::<Gauss6>(State::new([1.0, 1.1], [0.5, 0.0]));
    let energy = motion.energy();
    for _ in 0..5_000 {
        motion.step(0.02, &[]).unwrap();
    }
    let error = f64::from(motion.energy() / energy - 1.0);
    between(-2e-6, error, 2e-6);
}

#[test]
fn derivatives_of_a_pendulum_by_hand() {
    // q″ = −(g/r) sin θ − 2 ṙ θ̇ / r, r″ = r θ̇² + g cos θ − k (r − 1).
    let state = State::new([0.7, 1.2], [0.4, -0.3]);
    let found = ELASTIC.jacobians(&state, &[]).unwrap();
    close(found.by_q[(0, 0)], -9.81 / 1.2 * 0.7_f64.cos(), 1e-14);
    close(found.by_q[(0, 1)], (9.81 * 0.7_f64.sin() + 2.0 * -0.3 * 0.4) / 1.44, 1e-14);
    close(found.by_q[(1, 1)], 0.16 - 40.0, 1e-14);
    close(found.by_v[(0, 0)], 2.0 * 0.3 / 1.2, 1e-14);
    close(found.by_v[(1, 0)], 2.0 * 1.2 * 0.4, 1e-14);
    assert_eq!(found.by_u.shape(), (2, 0));
}
