//! The bits of all motions in WebAssembly. `run.mjs` calls it.
#![no_std]
#![allow(unsafe_code, reason = "what crosses the border of the module has a fixed name and raw pointers")]

use core::fmt::{self, Write};

unsafe extern "C" {
    /// Takes text to print.
    fn print(text: *const u8, length: usize);
}

struct Console;

impl Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        // SAFETY: the host copies the text before it returns.
        unsafe { print(text.as_ptr(), text.len()) };
        Ok(())
    }
}

/// Prints the bits of all motions; returns whether that went well.
#[unsafe(no_mangle)]
pub extern "C" fn run() -> bool {
    systems::bits::report(&mut Console).is_ok()
}

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
