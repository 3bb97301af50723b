//! The controllers of the target on a plant that is integrated in `f64` under error control.

extern crate std;

use lagrangian::prelude::*;

use super::arm::ArmCoordinates;
use super::{Arm, Control, DURATION, RATE, wanted};

/// The largest distance of the tool from its place, in the second half of the motion \[m].
fn astray(control: Control) -> f64 {
    let arm = Arm { payload: 0.0_f64 };
    let mut begin = wanted(0.0).state;
    begin.q = begin.q.map(|q| q + 0.03);
    let mut motion = arm.simulate(begin);
    let mut worst = 0.0_f64;
    for sample in 0..u32::from(RATE) {
        let State { t, q, v } = *motion.state();
        let small = State { t: t as f32, q: q.map(|q| q as f32), v: v.map(|v| v as f32) };
        let torque = control.torque(sample, &small).expect("a finite state");
        motion.set_inputs(torque.map(f64::from));
        let end = motion.advance_to(f64::from(sample + 1) / f64::from(RATE)).expect("a motion");
        if end.t > 0.5 * DURATION {
            let [found, aim] = [end.q, wanted(end.t).state.q].map(|q| arm.tool(&ArmCoordinates::from(q)));
            worst = worst.max((found - aim).norm());
        }
    }
    std::println!("{control:?}: {worst:.2e} m");
    worst
}

#[test]
fn both_controllers_follow_the_motion() {
    // Errors of 0.03 rad on an arm of 1.5 m have decayed by (1 + λt) exp(−λt) with λt = 6; the regulator is
    // faster.
    assert!(astray(Control::ComputedTorque) < 0.03 * 1.5 * 7.0 * (-6.0_f64).exp());
    assert!(astray(Control::Regulator) < 0.1e-3);
}
