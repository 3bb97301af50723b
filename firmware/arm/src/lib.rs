//! An arm of six joints under control at 1 kHz in `f32`: by computed torque, and by a linear-quadratic
//! regulator about a motion.
//!
//! The description, the motion and the controllers are those of `examples/arm_control.rs`. `build.rs` designs
//! the regulator where the firmware is built.
#![no_std]

use lagrangian::prelude::*;

#[path = "../../../examples/support/arm.rs"]
mod arm;
mod table {
    include!(concat!(env!("OUT_DIR"), "/gains.rs"));
}
#[cfg(test)]
mod tests;

pub use arm::{Arm, DURATION, ENDS, Gains, Wanted, computed_torque, needed, regulated, wanted};
pub use table::{GAINS, HELD, RATE};

/// The arm with an empty hand.
pub const EMPTY: Arm<f32> = Arm { payload: 0.0 };

/// The length of a sample \[s].
pub const STEP: f32 = 1.0 / RATE as f32;

/// The law that sets the torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Computed torque.
    ComputedTorque,
    /// The regulator.
    Regulator,
}

impl Control {
    /// The torques for a sample \[N m]; `None` where the state is not finite.
    #[inline]
    #[must_use]
    pub fn torque(self, sample: u32, state: &State<f32, 6>) -> Option<[f32; 6]> {
        match self {
            Control::ComputedTorque => computed_torque(&EMPTY, state, &wanted(state.t)).ok(),
            Control::Regulator => regulated(&EMPTY, state, STEP, &gains(sample)).ok(),
        }
    }
}

/// The gains at a sample; after the end of the motion, the last ones.
fn gains(sample: u32) -> Gains<f32> {
    let place = (sample / HELD) as usize;
    let last = GAINS.last().copied().unwrap_or_default();
    GAINS.get(place).copied().unwrap_or(last).into()
}
