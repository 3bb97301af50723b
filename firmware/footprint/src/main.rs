//! The smallest program that steps one system by one method. Its size is what both take.
//!
//! Features choose: `--features double_pendulum,jet6,f32`. Further features add code that is linked only if a
//! program calls it. `panic` adds a panic: a program that can panic does not link. `computed_torque` and
//! `regulator` link a controller of the arm alone.
#![no_std]
#![no_main]
#![allow(unsafe_code, reason = "the symbol that does not exist")]

#[cfg(any(feature = "computed_torque", feature = "regulator"))]
#[cortex_m_rt::entry]
fn main() -> ! {
    use arm::Control;
    use core::hint::black_box;

    let control = if cfg!(feature = "regulator") { Control::Regulator } else { Control::ComputedTorque };
    let mut state = black_box(arm::wanted(0.0_f32).state);
    let mut sample = 0;
    loop {
        let _ = black_box(control.torque(sample, &state));
        state = black_box(state);
        sample = sample.wrapping_add(1);
    }
}

#[cfg(not(any(feature = "computed_torque", feature = "regulator")))]
mod steps;

unsafe extern "C" {
    /// Defined nowhere, so that a program that can panic does not link.
    fn this_program_can_panic() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: it is never linked.
    unsafe { this_program_can_panic() }
}
