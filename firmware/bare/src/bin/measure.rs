//! Prints how many instructions a step takes and how much stack it uses, for all systems and methods.
//!
//! QEMU counts: with `-icount shift=6` an instruction takes 64 ns of virtual time.
#![no_std]
#![no_main]
#![allow(unsafe_code, reason = "the stack is painted")]

use core::fmt::{self, Write};
use core::hint::black_box;
use core::ptr;

use bare::Console;
use bare::count::{Counter, KNOWN};
use lagrangian::FixedStep;
use lagrangian::prelude::*;
use systems::{Bits, Experiment, Visitor, each};

/// Steps whose instructions are counted.
const STEPS: u32 = 64;

/// The word with which the stack is painted.
const PAINT: u32 = 0xcccc_cccc;

#[cortex_m_rt::entry]
fn main() -> ! {
    bare::run(|out| {
        let Some(core) = cortex_m::Peripherals::take() else { return Err(fmt::Error) };
        let counter = Counter::start(core.SYST);
        writeln!(out, "# {KNOWN} instructions take {} ticks", counter.calibration)?;
        let mut table = Table { out, counter };
        each::<f32, _>(&mut table)?;
        each::<f64, _>(&mut table)
    })
}

struct Table<'a> {
    out: &'a mut Console,
    counter: Counter,
}

impl<R: Bits> Visitor<R> for Table<'_> {
    type Error = fmt::Error;

    fn visit<S, M, const K: usize>(&mut self, method: &'static str) -> fmt::Result
    where
        S: Experiment<K, Scalar = R>,
        M: FixedStep<S, 2, K>,
    {
        let paint = Paint::new();
        let total = steps::<S, M, K>(&self.counter);
        let stack = paint.used();
        let Some(total) = total else { return Err(fmt::Error) };
        let instructions = self.counter.instructions(total) / u64::from(STEPS);
        writeln!(self.out, "{} {method} {} {instructions} {stack}", S::NAME, R::NAME)
    }
}

/// Ticks of all steps.
#[inline(never)]
fn steps<S, M, const K: usize>(counter: &Counter) -> Option<u64>
where
    S: Experiment<K>,
    M: FixedStep<S, 2, K>,
{
    let system = black_box(S::new());
    let mut motion = system.stepper::<M>(black_box(S::start()));
    let h = black_box(S::Scalar::from_f64(1.0 / 128.0));
    let mut total = 0;
    for _ in 0..STEPS {
        let inputs = black_box(S::inputs(motion.state()));
        let mut good = false;
        total += u64::from(counter.ticks(|| good = motion.step(h, &inputs).is_ok()));
        if !good {
            return None;
        }
    }
    Some(total)
}

/// A painted stack.
struct Paint {
    top: *mut u32,
}

unsafe extern "C" {
    /// From the linker script: the lowest word that the stack may use.
    static mut _stack_end: u32;
}

impl Paint {
    /// Paints what lies below the frame of the caller.
    #[inline(always)]
    fn new() -> Self {
        let top = ptr::with_exposed_provenance_mut::<u32>(cortex_m::register::msp::read() as usize);
        // SAFETY: the words from the end of the stack to its pointer are free, and no interrupt is on.
        unsafe {
            let mut word = &raw mut _stack_end;
            while word < top {
                word.write_volatile(PAINT);
                word = word.add(1);
            }
        }
        Self { top }
    }

    /// Bytes that were used since.
    #[inline(always)]
    fn used(&self) -> usize {
        // SAFETY: reads the same words.
        unsafe {
            let mut word = &raw mut _stack_end;
            while word < self.top && word.read_volatile() == PAINT {
                word = word.add(1);
            }
            self.top.byte_offset_from_unsigned(word)
        }
    }
}
