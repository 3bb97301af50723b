//! Symplectic splittings on generated systems: orders, bounded energy, forces in time, held inputs, `f32`.

use lagrangian::prelude::*;
use lagrangian::{Conservative, ConstantMass, FixedStep, Separable};

use crate::support::close::{between, close};
use crate::support::motion::state_at;

/// Hénon and Heiles' model of a star in a galaxy.
struct HenonHeiles<R>(core::marker::PhantomData<R>);

#[lagrangian(coordinates = [x, y])]
impl<R: Real> HenonHeiles<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        (v.x * v.x + v.y * v.y) * 0.5
    }

    #[potential]
    fn potential(&self, q: &Coordinates<R>) -> R {
        (q.x * q.x + q.y * q.y) * 0.5 + q.x * q.x * q.y - q.y.powi(3) / 3.0
    }
}

/// A pendulum whose pivot is shaken up and down, and that a motor turns.
struct Shaken;

#[lagrangian(coordinates = [theta], inputs = [motor])]
impl Shaken {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.theta.powi(2)
    }

    #[potential]
    fn potential(&self, q: &Coordinates, t: f64) -> f64 {
        -(1.0 + 4.0 * (5.0 * t).cos()) * q.theta.cos()
    }

    #[force(on = theta)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

/// Two unequal masses on springs, in coordinates that couple them inertially.
struct Coupled;

#[lagrangian(coordinates = [centre, stretch])]
impl Coupled {
    #[point(mass = 1.0)]
    fn left(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.centre - 0.2 * q.stretch)
    }

    #[point(mass = 2.0)]
    fn right(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.centre + q.stretch)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        2.0 * q.stretch.powi(2) + 0.5 * q.centre.powi(4)
    }
}

fn proved<S: Separable<N, K> + ConstantMass<N, K>, const N: usize, const K: usize>(_: &S) {}

#[test]
fn what_is_separable_is_proved() {
    proved(&HENON_HEILES);
    proved(&Shaken);
    proved(&Coupled);
    fn conservative<S: Conservative<N>, const N: usize>(_: &S) {}
    conservative(&HENON_HEILES);
    conservative(&Coupled);
}

const HENON_HEILES: HenonHeiles<f64> = HenonHeiles(core::marker::PhantomData);

fn distance<const N: usize>(found: &State<f64, N>, exact: &State<f64, N>) -> f64 {
    found.iter().zip(exact.iter()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn order<S, M, const N: usize>(system: &S, start: State<f64, N>, t: f64, steps: u32) -> f64
where
    S: System<N, Scalar = f64>,
    M: FixedStep<S, N, 0>,
{
    let exact = state_at(system, start, t);
    let error = |steps: u32| {
        let mut motion = system.stepper::<M>(start);
        for _ in 0..steps {
            motion.step(t / f64::from(steps), &[]).unwrap();
        }
        distance(motion.state(), &exact)
    };
    (error(steps) / error(2 * steps)).log2()
}

#[test]
fn orders_on_henon_heiles() {
    let start = State::new([0.12, 0.1], [0.3, -0.2]);
    between(1.95, order::<_, Leapfrog, 2>(&HENON_HEILES, start, 5.0, 100), 2.05);
    between(3.9, order::<_, Yoshida4, 2>(&HENON_HEILES, start, 5.0, 100), 4.1);
    between(5.9, order::<_, Yoshida6, 2>(&HENON_HEILES, start, 5.0, 40), 6.1);
    between(7.8, order::<_, Yoshida8, 2>(&HENON_HEILES, start, 5.0, 20), 8.2);
    between(3.9, order::<_, BlanesMoan4, 2>(&HENON_HEILES, start, 5.0, 50), 4.1);
    between(5.8, order::<_, BlanesMoan6, 2>(&HENON_HEILES, start, 5.0, 20), 6.2);
}

#[test]
fn orders_with_a_mass_matrix_that_is_not_diagonal() {
    let start = State::new([0.5, 0.3], [0.2, -0.4]);
    between(1.95, order::<_, Leapfrog, 2>(&Coupled, start, 2.0, 100), 2.05);
    between(3.9, order::<_, BlanesMoan4, 2>(&Coupled, start, 2.0, 20), 4.1);
}

#[test]
fn orders_under_a_force_in_time_with_inputs_that_switch() {
    let segments = [(0.7, 1.0), (0.7, -2.0), (0.6, 0.5)];
    let start = State::new([1.0], [0.3]);
    let mut exact = Shaken.simulate(start).with_tolerance(1e-15);
    for (length, u) in segments {
        exact.set_inputs([u]);
        exact.advance_by(length).unwrap();
    }
    fn error<M: FixedStep<Shaken, 1, 1>>(segments: [(f64, f64); 3], exact: &State<f64, 1>, n: u32) -> f64 {
        let mut motion = Shaken.stepper::<M>(State::new([1.0], [0.3]));
        for (length, u) in segments {
            for _ in 0..n {
                motion.step(length / f64::from(n), &[u]).unwrap();
            }
        }
        close(motion.state().t, 2.0, 1e-15);
        distance(motion.state(), exact)
    }
    macro_rules! order {
        ($method:ty, $steps:literal) => {
            (error::<$method>(segments, exact.state(), $steps)
                / error::<$method>(segments, exact.state(), 2 * $steps))
            .log2()
        };
    }
    between(1.9, order!(Leapfrog, 40), 2.1);
    between(3.8, order!(Yoshida4, 40), 4.2);
    between(5.8, order!(Yoshida6, 20), 6.2);
    between(7.7, order!(Yoshida8, 10), 8.3);
    between(3.8, order!(BlanesMoan4, 20), 4.2);
    between(5.7, order!(BlanesMoan6, 8), 6.3);
}

#[test]
fn the_energy_of_a_chaotic_star_stays_in_a_band() {
    // E = 0.1198, a little below the chaotic case of Hénon and Heiles, 1/8; over 2 · 10⁴ time units.
    let start = State::new([0.0, 0.1], [0.479_861_09, 0.0]);
    let mut motion = HENON_HEILES.stepper::<BlanesMoan6>(start);
    let energy = motion.energy();
    let mut worst = [0.0_f64; 2];
    for half in &mut worst {
        for _ in 0..20_000 {
            motion.step(0.5, &[]).unwrap();
            *half = half.max((motion.energy() / energy - 1.0).abs());
        }
    }
    between(1e-9, worst[0], 4e-9);
    between(0.9, worst[1] / worst[0], 1.1);
}

#[test]
fn single_precision_conserves_to_its_rounding() {
    let system = HenonHeiles::<f32>(core::marker::PhantomData);
    let mut motion = system.stepper::<BlanesMoan4>(State::new([0.12, 0.1], [0.3, -0.2]));
    let energy = motion.energy();
    for _ in 0..10_000 {
        motion.step(0.1, &[]).unwrap();
    }
    let error = f64::from(motion.energy() / energy - 1.0);
    between(-5e-5, error, 5e-5);
}
