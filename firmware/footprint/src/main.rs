//! The smallest program that steps one system by one method: what it links is what they take.
//!
//! Features choose: `--features double_pendulum,jet6,f32`. A panic anywhere would not link.
#![no_std]
#![no_main]
#![allow(unsafe_code, reason = "the symbol that does not exist")]

use core::hint::black_box;

use lagrangian::prelude::*;
use systems::Experiment;

#[cfg(feature = "f32")]
type R = f32;
#[cfg(feature = "f64")]
type R = f64;

#[cfg(feature = "double_pendulum")]
type S = systems::DoublePendulum<R>;
#[cfg(feature = "rod")]
type S = systems::Rod<R>;
#[cfg(feature = "cart_pole")]
type S = systems::CartPole<R>;

/// Inputs of the system.
const K: usize = if cfg!(feature = "cart_pole") { 1 } else { 0 };

#[cfg(feature = "rk4")]
type M = Rk4;
#[cfg(feature = "jet4")]
type M = Jet<4>;
#[cfg(feature = "jet6")]
type M = Jet<6>;

#[cortex_m_rt::entry]
fn main() -> ! {
    // What the compiler cannot know: parameters, start and step.
    let system = black_box(<S as Experiment<K>>::new());
    let mut motion = system.stepper::<M>(black_box(<S as Experiment<K>>::start()));
    let h = black_box(R::from_f64(1e-3));
    loop {
        let inputs = <S as Experiment<K>>::inputs(motion.state());
        let _ = black_box(motion.step(h, &inputs));
    }
}

unsafe extern "C" {
    /// Defined nowhere, so that a program that can panic does not link.
    fn this_program_can_panic() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: it is never linked.
    unsafe { this_program_can_panic() }
}
