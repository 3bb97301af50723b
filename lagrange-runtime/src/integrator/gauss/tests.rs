//! Orders, long runs, stiffness and failure, on systems with derivatives by hand.

use core::cell::Cell;

use super::*;
use crate::integrator::samples::{Kepler, distance, pericentre};
use crate::system::System;
use crate::system::linearized::Linearization;

impl Linearized<2> for Kepler {
    fn residual_at(
        &self,
        (): &(),
        t: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        a: &[f64; 2],
        u: &[f64; 0],
    ) -> [f64; 2] {
        let f = self.accelerations_at(&(), t, q, v, u);
        [f[0] - a[0], f[1] - a[1]]
    }

    fn linearization_at(
        &self,
        (): &(),
        _: f64,
        &[x, y]: &[f64; 2],
        _: &[f64; 2],
        _: &[f64; 2],
        _: &[f64; 0],
    ) -> Linearization<f64, 2> {
        let r = x.hypot(y);
        let (third, fifth) = (r.powi(-3), 3.0 * r.powi(-5));
        let off = fifth * x * y;
        Linearization {
            mass: [[1.0, 0.0], [0.0, 1.0]],
            by_q: [[fifth * x * x - third, off], [off, fifth * y * y - third]],
            by_v: [[0.0; 2]; 2],
        }
    }

    fn by_inputs_at(&self, (): &(), _: f64, _: &[f64; 2], _: &[f64; 2], _: &[f64; 0]) -> [[f64; 0]; 2] {
        [[]; 2]
    }
}

fn period<const STAGES: usize>(steps: u32) -> f64
where
    Gauss<STAGES>: FixedStep<Kepler, 2, 0>,
{
    let start = pericentre(0.4);
    let mut motion = Kepler.stepper::<Gauss<STAGES>>(start);
    for _ in 0..steps {
        motion.step(core::f64::consts::TAU / f64::from(steps), &[]).unwrap();
    }
    distance(motion.state(), &start)
}

#[test]
fn methods_have_their_order() {
    fn check<const STAGES: usize>(steps: u32, order: f64)
    where
        Gauss<STAGES>: FixedStep<Kepler, 2, 0>,
    {
        let measured = (period::<STAGES>(steps) / period::<STAGES>(2 * steps)).log2();
        assert!((measured - order).abs() < 0.2, "measured order {measured} instead of {order}");
    }
    check::<2>(80, 4.0);
    check::<3>(80, 6.0);
    check::<4>(60, 8.0);
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn where_steps_resolve_the_motion_the_energy_does_not_drift() {
    let mut motion = Kepler.stepper::<Gauss8>(pericentre(0.4));
    let energy = motion.energy();
    let mut after = [0.0; 5];
    for after in &mut after {
        for _ in 0..100 * 60 {
            motion.step(core::f64::consts::TAU / 60.0, &[]).unwrap();
        }
        *after = motion.energy() / energy - 1.0;
    }
    // A hundred periods each. Corrections that stop early, or coefficients rounded one by one, drift by
    // 1e-14.
    assert!(after.iter().all(|error| error.abs() < 5e-15), "{after:?}");
}

/// q″ = u − k q − c q′ with k, c as stiff as they come, which counts evaluations.
struct Linear {
    k: f64,
    c: f64,
    evaluations: Cell<u32>,
    matrices: Cell<u32>,
}

impl Linear {
    fn new(k: f64, c: f64) -> Self {
        Self { k, c, evaluations: Cell::new(0), matrices: Cell::new(0) }
    }
}

impl System<1, 1> for Linear {
    type Scalar = f64;
    type Method = crate::integrator::Dop853;
    type Constants = ();

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), _: f64, q: &[f64; 1], v: &[f64; 1], u: &[f64; 1]) -> [f64; 1] {
        self.evaluations.set(self.evaluations.get() + 1);
        [u[0] - self.k * q[0] - self.c * v[0]]
    }

    fn energy_at(&self, (): &(), _: f64, q: &[f64; 1], v: &[f64; 1]) -> f64 {
        0.5 * (v[0] * v[0] + self.k * q[0] * q[0])
    }
}

impl Linearized<1, 1> for Linear {
    fn residual_at(
        &self,
        (): &(),
        t: f64,
        q: &[f64; 1],
        v: &[f64; 1],
        a: &[f64; 1],
        u: &[f64; 1],
    ) -> [f64; 1] {
        [self.accelerations_at(&(), t, q, v, u)[0] - a[0]]
    }

    fn linearization_at(
        &self,
        (): &(),
        _: f64,
        _: &[f64; 1],
        _: &[f64; 1],
        _: &[f64; 1],
        _: &[f64; 1],
    ) -> Linearization<f64, 1> {
        self.matrices.set(self.matrices.get() + 1);
        Linearization { mass: [[1.0]], by_q: [[-self.k]], by_v: [[-self.c]] }
    }

    fn by_inputs_at(&self, (): &(), _: f64, _: &[f64; 1], _: &[f64; 1], _: &[f64; 1]) -> [[f64; 1]; 1] {
        [[1.0]]
    }
}

#[test]
fn a_linear_oscillator_turns_by_the_diagonal_pade_approximant() {
    // (1 + z/2 + z²/12) / (1 − z/2 + z²/12) at z = i h ω, of modulus 1.
    let (system, h) = (Linear::new(1e6, 0.0), 0.1);
    let mut motion = system.stepper::<Gauss4>(State::new([1.0], [0.0]));
    let energy = motion.energy();
    let x = 1e3 * h;
    let angle = 2.0 * (x / 2.0).atan2(1.0 - x * x / 12.0);
    for k in 1..=1000 {
        motion.step(h, &[0.0]).unwrap();
        let expected = (f64::from(k) * angle).cos();
        assert!((motion.state().q[0] - expected).abs() < 1e-10, "step {k}: {:?}", motion.state());
    }
    assert!((motion.energy() / energy - 1.0).abs() < 1e-11);
}

#[test]
fn a_start_that_is_not_finite_says_so() {
    fn cause<const STAGES: usize>(start: State<f64, 2>) -> Cause
    where
        Gauss<STAGES>: FixedStep<Kepler, 2, 0>,
    {
        Kepler.stepper::<Gauss<STAGES>>(start).step(0.1, &[]).unwrap_err().cause
    }
    // The acceleration at the start is finite.
    for speed in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let start = State::new([1.0, 0.0], [0.0, speed]);
        let causes = [cause::<2>(start), cause::<3>(start), cause::<4>(start)];
        assert_eq!(causes, [Cause::NotFinite; 3], "{speed}");
    }
}

#[test]
fn a_smooth_motion_takes_few_corrections() {
    let system = Linear::new(1.0, 0.1);
    let mut motion = system.stepper::<Gauss6>(State::new([1.0], [0.0]));
    for _ in 0..100 {
        motion.step(0.1, &[0.5]).unwrap();
    }
    assert_eq!(system.matrices.get(), 100);
    assert!((300..=1200).contains(&system.evaluations.get()), "{}", system.evaluations.get());
}

#[test]
fn overdamped_velocities_follow_the_force() {
    let system = Linear::new(0.0, 1e9);
    let mut motion = system.stepper::<Gauss6>(State::new([1.0], [2e-9]));
    for _ in 0..100 {
        motion.step(0.1, &[2.0]).unwrap();
    }
    assert!((motion.state().q[0] - 1.0 - 2e-8).abs() < 1e-15, "{:?}", motion.state());
}

/// q″ = e^q.
struct Explosive;

impl System<1> for Explosive {
    type Scalar = f64;
    type Method = crate::integrator::Dop853;
    type Constants = ();

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), _: f64, q: &[f64; 1], _: &[f64; 1], _: &[f64; 0]) -> [f64; 1] {
        [q[0].exp()]
    }

    fn energy_at(&self, (): &(), _: f64, q: &[f64; 1], v: &[f64; 1]) -> f64 {
        0.5 * v[0] * v[0] - q[0].exp()
    }
}

impl Linearized<1> for Explosive {
    fn residual_at(
        &self,
        (): &(),
        _: f64,
        q: &[f64; 1],
        _: &[f64; 1],
        a: &[f64; 1],
        _: &[f64; 0],
    ) -> [f64; 1] {
        [q[0].exp() - a[0]]
    }

    fn linearization_at(
        &self,
        (): &(),
        _: f64,
        q: &[f64; 1],
        _: &[f64; 1],
        _: &[f64; 1],
        _: &[f64; 0],
    ) -> Linearization<f64, 1> {
        Linearization { mass: [[1.0]], by_q: [[q[0].exp()]], by_v: [[0.0]] }
    }

    fn by_inputs_at(&self, (): &(), _: f64, _: &[f64; 1], _: &[f64; 1], _: &[f64; 0]) -> [[f64; 0]; 1] {
        [[]]
    }
}

#[test]
fn a_step_without_a_solution_is_an_error_and_nothing_moves() {
    // At h = 10 the second stage would need a > exp(h² a / 24) > a.
    let mut motion = Explosive.stepper::<Gauss4>(State::new([0.0], [0.0]));
    let before = *motion.step(0.1, &[]).unwrap();
    let error = motion.step(10.0, &[]).unwrap_err();
    assert_eq!(error.cause, Cause::NotConverged);
    assert_eq!(motion.state(), &before);
    assert!(motion.step(0.1, &[]).is_ok());
}

#[test]
fn a_step_of_no_length_goes_nowhere() {
    let start = pericentre(0.5);
    assert_eq!(Gauss8::step(&mut None, &Kepler, &(), &start, 0.0, &[]), Ok(start));
}

#[test]
fn accelerations_go_on_as_a_polynomial() {
    // Of degree two, for three stages.
    let polynomial = |x: f64| 1.0 - 2.0 * x + 3.0 * x * x;
    let Collocation { c, .. } = GAUSS6;
    let nothing = Start { state: State::new([0.0], [0.0]), lost_q: [0.0], lost_v: [0.0] };
    let last = LastStep { h: 0.1, u: [7.0], a: c.map(|node| [polynomial(node)]), end: nothing };
    let found = last.extrapolated(&c, 0.13, &[7.0]).unwrap();
    for (found, node) in found.iter().zip(c) {
        assert!((found[0] - polynomial(1.0 + 1.3 * node)).abs() < 1e-13, "{found:?}");
    }
    // Neither further out, nor back, nor under other inputs.
    for (h, u) in [(0.3, 7.0), (-0.1, 7.0), (0.1, 8.0)] {
        assert_eq!(last.extrapolated(&c, h, &[u]), None, "{h} {u}");
    }
}

#[test]
fn the_middle_of_a_step_is_its_average() {
    let (state, h) = (pericentre(0.3).at_time(2.0), 1e-3);
    let from = Start { state, lost_q: [0.0; 2], lost_v: [0.0; 2] };
    let stages = Stages::new(&Kepler, &(), &GAUSS6, &from, h, &[]);
    let a = [[0.5, -2.0]; 3];
    let (middle, average) = stages.middle(&a);
    assert_eq!(middle.t, 2.0 + 0.5e-3);
    for i in 0..2 {
        assert!((average[i] - a[0][i]).abs() < 1e-14);
        // Under a constant acceleration.
        assert!((middle.v[i] - (state.v[i] + 0.5 * h * a[0][i])).abs() < 1e-15);
        let q = state.q[i] + 0.5 * h * state.v[i] + h * h * a[0][i] / 6.0;
        assert!((middle.q[i] - q).abs() < 1e-15);
    }
}
