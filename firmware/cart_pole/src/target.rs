//! The program on the target.

use cart_pole::{CartPole, RATE, control};
use cortex_m::peripheral::syst::SystClkSource;
use lagrangian::prelude::*;
use semihosting::{println, process};

/// Frequency of the processor \[Hz].
const CLOCK: u32 = 25_000_000;

/// How long it balances \[s].
const SECONDS: u32 = 4;

/// The control loop.
#[cortex_m_rt::entry]
fn main() -> ! {
    let Some(core) = cortex_m::Peripherals::take() else { process::exit(2) };
    let mut timer = core.SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(CLOCK / u32::from(RATE) - 1);
    timer.clear_current();
    timer.enable_counter();

    let period = 1.0 / f32::from(RATE);
    let plant = CartPole::<f32>::laboratory();
    let mut motion = plant.stepper::<Jet<4>>(State::at_rest([0.0, 0.3]));
    for tick in 0..SECONDS * u32::from(RATE) {
        while !timer.has_wrapped() {}
        let state = motion.state();
        let force = control(state);
        if tick.is_multiple_of(500) {
            // Printed as integers: text of floating-point numbers takes twenty kilobytes of code.
            let [x, theta, force] = [state.q[0], state.q[1], force].map(|value| (1000.0 * value) as i32);
            println!("{tick:4} ms: cart {x:+4} mm, pole {theta:+4} mrad, motor {force:+5} mN");
        }
        if motion.step(period, &[force]).is_err() {
            println!("the plant has no next state");
            process::exit(1);
        }
    }
    let upright = motion.state().iter().all(|x| x.abs() < 0.01);
    println!("{}", if upright { "balanced" } else { "fallen" });
    process::exit(i32::from(!upright))
}
