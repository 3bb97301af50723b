//! The program on the target.

use core::hint::black_box;

use arm::{Control, EMPTY, RATE, STEP, wanted};
use bare::count::Counter;
use lagrangian::prelude::*;
use semihosting::{println, process};

/// Runs the motion under both controllers.
#[cortex_m_rt::entry]
fn main() -> ! {
    let Some(core) = cortex_m::Peripherals::take() else { process::exit(2) };
    let counter = Counter::start(core.SYST);
    let mut good = true;
    for (name, control) in [("computed torque", Control::ComputedTorque), ("regulator", Control::Regulator)] {
        good &= follow(name, control, &counter);
    }
    println!("{}", if good { "followed" } else { "astray" });
    process::exit(i32::from(!good))
}

/// Whether the arm ends where it should.
fn follow(name: &str, control: Control, counter: &Counter) -> bool {
    let mut begin = wanted(0.0_f32).state;
    begin.q = begin.q.map(|q| q + 0.03);
    let mut motion = EMPTY.stepper::<Jet<4>>(begin);
    let mut ticks = 0;
    for sample in 0..u32::from(RATE) {
        let state = *motion.state();
        let mut torque = None;
        ticks += u64::from(counter.ticks(|| torque = control.torque(sample, black_box(&state))));
        let Some(torque) = torque else { return false };
        if motion.step(STEP, &torque).is_err() {
            println!("the plant has no next state");
            return false;
        }
    }
    let aim = wanted(motion.state().t).state;
    let worst =
        motion.state().q.iter().zip(aim.q).fold(0.0_f32, |worst, (q, aim)| worst.max((q - aim).abs()));
    // Printed as integers: text of floating-point numbers takes twenty kilobytes of code.
    let (micro, update) = ((1e6 * worst) as i32, counter.instructions(ticks) / u64::from(RATE));
    println!("{name}: {micro} µrad from the end, {update} instructions an update");
    worst < 1e-3
}
