//! Counts instructions in an emulator that lets each take the same virtual time (`-icount`).
//!
//! SysTick runs on that time and is read before and after. A loop of known length tells how many ticks an
//! instruction has, so that no clock of the emulated board needs to be known.
#![allow(unsafe_code, reason = "the loop of known length is written in assembly")]

use core::hint::black_box;

use cortex_m::peripheral::{SYST, syst::SystClkSource};

/// Iterations of the loop of known length; each is two instructions.
const ITERATIONS: u32 = 100_000;

/// Instructions of the loop of known length.
pub const KNOWN: u32 = 2 * ITERATIONS;

/// A counter that knows its pace.
#[derive(Clone, Copy, Debug)]
pub struct Counter {
    /// Ticks of measuring nothing.
    nothing: u32,
    /// Ticks of the loop of known length.
    pub calibration: u32,
}

impl Counter {
    /// Starts the timer and finds out its pace.
    pub fn start(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(0x00ff_ffff);
        timer.clear_current();
        timer.enable_counter();
        let nothing = elapsed(|| ());
        Self { nothing, calibration: elapsed(known_loop) - nothing }
    }

    /// Ticks that something takes, less than 2²⁴.
    #[inline(always)]
    pub fn ticks<T>(&self, what: impl FnOnce() -> T) -> u32 {
        elapsed(what) - self.nothing
    }

    /// The instructions of some ticks.
    #[must_use]
    pub fn instructions(&self, ticks: u64) -> u64 {
        ticks * u64::from(KNOWN) / u64::from(self.calibration)
    }
}

#[inline(always)]
fn elapsed<T>(what: impl FnOnce() -> T) -> u32 {
    let before = SYST::get_current();
    black_box(what());
    let after = SYST::get_current();
    before.wrapping_sub(after) & 0x00ff_ffff
}

/// Takes 2 · ITERATIONS instructions and a few.
fn known_loop() {
    // SAFETY: counts a register down.
    unsafe {
        core::arch::asm!("2:", "subs {left}, #1", "bne 2b", left = inout(reg) ITERATIONS => _, options(nomem, nostack));
    }
}
