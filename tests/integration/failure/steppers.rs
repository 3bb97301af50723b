//! Fixed steps that fail: the state stays before the step, and the loop may go on with another one.

use lagrangian::prelude::*;

/// A bead that slides down a funnel z = ln r.
struct Funnel;

#[lagrangian(coordinates = [r], inputs = [pull])]
impl Funnel {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.r.powi(2)
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        q.r.ln()
    }

    #[potential]
    fn floor(&self, q: &Coordinates) -> f64 {
        (1.0 - q.r * q.r).sqrt()
    }

    #[force(on = r)]
    fn pull(&self, u: &Inputs) -> f64 {
        u.pull
    }
}

#[test]
fn a_step_out_of_the_domain_leaves_the_state() {
    let mut motion = Funnel.stepper::<Rk4>(State::new([0.9], [0.5]));
    motion.step(0.01, &[0.0]).unwrap();
    let good = *motion.state();
    let error = motion.step(10.0, &[0.0]).unwrap_err();
    assert_eq!(error, MotionError { cause: Cause::NotFinite, t: good.t });
    assert_eq!(motion.state(), &good);
    // A shorter step with another input is possible from there.
    let next = motion.step(0.01, &[-5.0]).unwrap();
    assert!(next.is_finite() && next.t > good.t);
}

#[test]
fn bad_steps_and_inputs_are_refused() {
    let start = State::new([0.5], [0.0]);
    let mut motion = Funnel.stepper::<Rk4>(start);
    for h in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(motion.step(h, &[0.0]).unwrap_err().cause, Cause::InvalidStep);
    }
    assert_eq!(motion.step(0.1, &[f64::NAN]).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(motion.state(), &start);
}

#[test]
fn a_stepper_goes_backward_as_well() {
    let start = State::new([0.5], [0.1]);
    let mut motion = Funnel.stepper::<Rk4>(start);
    for h in [0.001, -0.001] {
        for _ in 0..50 {
            motion.step(h, &[0.2]).unwrap();
        }
    }
    let end = motion.state();
    assert!(end.t.abs() < 1e-15 && (end.q[0] - 0.5).abs() < 1e-11, "{end:?}");
}
