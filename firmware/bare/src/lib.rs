//! The common part of the programs for bare metal: text by semihosting, and a count of instructions.
#![no_std]

#[cfg(target_arch = "arm")]
pub mod count;

use core::fmt;

use semihosting::io::{self, Stdout, Write};
use semihosting::process;

/// The terminal of whoever runs the program.
#[derive(Debug)]
pub struct Console(Stdout);

impl fmt::Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write_all(text.as_bytes()).map_err(|_| fmt::Error)
    }
}

/// Runs a program and ends the emulator; its exit code says whether all text was written.
pub fn run(program: impl FnOnce(&mut Console) -> fmt::Result) -> ! {
    let written = io::stdout().map(|out| program(&mut Console(out)));
    process::exit(if matches!(written, Ok(Ok(()))) { 0 } else { 1 })
}
