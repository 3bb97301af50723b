//! Orders, reversibility, cost, and when accelerations are reused.

use core::cell::Cell;

use super::*;
use crate::integrator::samples::{Kepler, Oscillator, distance, pericentre};
use crate::system::System;
use crate::system::proved::ConstantMass;

impl ConstantMass<2> for Kepler {}
impl Separable<2> for Kepler {}
impl ConstantMass<1, 1> for Oscillator {}
impl Separable<1, 1> for Oscillator {}

/// q″ = −(1 + ½ cos t + u) q − q³, which counts its evaluations.
struct Driven(Cell<u32>);

impl System<1, 1> for Driven {
    type Scalar = f64;
    type Method = crate::integrator::Dop853;
    type Constants = ();

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), t: f64, q: &[f64; 1], v: &[f64; 1], u: &[f64; 1]) -> [f64; 1] {
        self.0.set(self.0.get() + 1);
        assert!(v[0].is_finite());
        [-(1.0 + 0.5 * t.cos() + u[0]) * q[0] - q[0].powi(3)]
    }

    fn energy_at(&self, (): &(), _: f64, q: &[f64; 1], v: &[f64; 1]) -> f64 {
        0.5 * v[0] * v[0] + q[0] * q[0]
    }
}

impl ConstantMass<1, 1> for Driven {}
impl Separable<1, 1> for Driven {}

/// The state at t = 2.3 after some steps from t = 0.3, and the evaluations of all but the first step.
fn driven<M: FixedStep<Driven, 1, 1>>(steps: u32) -> (State<f64, 1>, u32) {
    let system = Driven(Cell::new(0));
    let mut motion = system.stepper::<M>(State::new([0.6], [0.4]).at_time(0.3));
    let mut first = 0;
    for _ in 0..steps {
        motion.step(2.0 / f64::from(steps), &[0.25]).unwrap();
        first = if first == 0 { system.0.get() } else { first };
    }
    (*motion.state(), system.0.get() - first)
}

fn has_order<M: FixedStep<Driven, 1, 1>>(order: f64, evaluations: u32, steps: u32) {
    let (exact, _) = driven::<Yoshida8>(400);
    let error = |steps: u32| distance(&driven::<M>(steps).0, &exact);
    let measured = (error(steps) / error(2 * steps)).log2();
    assert!((measured - order).abs() < 0.25, "measured order {measured} instead of {order}");
    assert_eq!(driven::<M>(11).1, 10 * evaluations);
}

#[test]
fn methods_have_their_order_and_cost_under_forces_that_depend_on_time_and_inputs() {
    has_order::<Leapfrog>(2.0, 1, 40);
    has_order::<Yoshida4>(4.0, 3, 40);
    has_order::<Yoshida6>(6.0, 7, 20);
    has_order::<Yoshida8>(8.0, 15, 10);
    has_order::<BlanesMoan4>(4.0, 6, 20);
    has_order::<BlanesMoan6>(6.0, 14, 10);
}

#[test]
fn a_change_of_inputs_is_felt_at_once() {
    let system = Oscillator;
    let start = State::new([1.0], [0.5]);
    let mut motion = system.stepper::<Leapfrog>(start);
    let middle = *motion.step(0.1, &[0.0]).unwrap();
    let mut fresh = system.stepper::<Leapfrog>(middle);
    let (found, expected) = (motion.step(0.1, &[3.0]).unwrap(), fresh.step(0.1, &[3.0]).unwrap());
    assert!(distance(found, expected) < 1e-15, "{found:?} instead of {expected:?}");
}

#[test]
fn reused_accelerations_change_no_bit() {
    let step =
        |memory: &mut Option<_>, from| BlanesMoan4::step(memory, &Kepler, &(), &from, 0.01, &[]).unwrap();
    let (mut known, mut forgetful) = (None, None);
    let mut states = [pericentre(0.5); 2];
    for _ in 0..100 {
        states = [step(&mut known, states[0]), step(&mut forgetful, states[1])];
        assert_eq!(states[0], states[1]);
        forgetful = forgetful.map(|last: LastSplit<_, 2, 0>| LastSplit { kick: None, ..last });
    }
}

#[test]
fn a_step_that_failed_leaves_nothing_behind() {
    let mut motion = Oscillator.stepper::<Yoshida4>(State::new([1.0], [0.0]));
    motion.step(0.1, &[0.0]).unwrap();
    let good = *motion.state();
    assert_eq!(motion.step(0.1, &[f64::NAN]).unwrap_err().cause, Cause::NotFinite);
    let mut fresh = Oscillator.stepper::<Yoshida4>(good);
    let (found, expected) = (motion.step(0.1, &[0.0]).unwrap(), fresh.step(0.1, &[0.0]).unwrap());
    assert!(distance(found, &expected.at_time(found.t)) < 1e-15, "{found:?} instead of {expected:?}");
}

#[test]
fn steps_backward_undo_steps_forward() {
    fn check<M: FixedStep<Kepler, 2, 0>>() {
        let start = pericentre(0.3);
        let mut motion = Kepler.stepper::<M>(start);
        for h in [0.02, -0.02] {
            for _ in 0..200 {
                motion.step(h, &[]).unwrap();
            }
        }
        assert!(distance(motion.state(), &start) < 1e-12, "{:?}", motion.state());
    }
    check::<Leapfrog>();
    check::<Yoshida4>();
    check::<Yoshida6>();
    check::<Yoshida8>();
    check::<BlanesMoan4>();
    check::<BlanesMoan6>();
}

/// Largest relative error of the energy of an orbit with eccentricity 0.3 over the first and the last tenth
/// of a run of a thousand periods, with about `evaluations` a period.
fn energy_errors<M: FixedStep<Kepler, 2, 0>>(evaluations: u32, stages: u32) -> [f64; 2] {
    let mut motion = Kepler.stepper::<M>(pericentre(0.3));
    let (start, steps) = (motion.energy(), evaluations / stages);
    let h = core::f64::consts::TAU / f64::from(steps);
    let mut worst = [0.0_f64; 10];
    for worst in &mut worst {
        for _ in 0..100 * steps {
            motion.step(h, &[]).unwrap();
            *worst = worst.max((motion.energy() / start - 1.0).abs());
        }
    }
    [worst[0], worst[9]]
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn the_error_of_the_energy_does_not_grow() {
    fn check<M: FixedStep<Kepler, 2, 0>>(stages: u32, least: f64, most: f64) {
        let [first, last] = energy_errors::<M>(420, stages);
        assert!(least < first && first < most, "{first:e}");
        assert!(last < 1.05 * first + 1e-13, "from {first:e} to {last:e}");
    }
    check::<Leapfrog>(1, 1e-4, 1.4e-4);
    check::<Yoshida4>(3, 6e-6, 9e-6);
    check::<Yoshida6>(7, 6e-7, 9e-7);
    check::<Yoshida8>(15, 6e-8, 9e-8);
    check::<BlanesMoan4>(6, 4e-9, 6e-9);
    check::<BlanesMoan6>(14, 1.8e-9, 2.5e-9);
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn roundings_do_not_add_up() {
    // Steps so short that the method's own error is below rounding.
    let mut motion = Kepler.stepper::<Yoshida8>(pericentre(0.3));
    let energy = motion.energy();
    for _ in 0..100_000 {
        motion.step(0.02, &[]).unwrap();
    }
    assert!((motion.energy() / energy - 1.0).abs() < 4e-15, "{:e}", motion.energy() / energy - 1.0);
}
