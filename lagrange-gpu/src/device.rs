//! The part of a kernel that runs on a processor only: it finds its motion, reads and writes memory, and
//! refuses to panic.

use core::arch::nvptx::{_block_dim_x, _block_idx_x, _thread_idx_x};
use core::panic::PanicInfo;

use crate::kernel::{self, MISMATCHED};
use crate::words::Words;

/// The motion of this thread: number `first` and following, `count` of them, one a thread.
///
/// # Safety
/// `setting` points to as many words as the upper half of `shape` says, and `cells` to `count` times one more
/// than the lower half says, which nobody else uses.
#[allow(unsafe_code)]
#[inline(always)]
pub unsafe fn enter<S: Words, R: Words, E>(
    row: impl Fn(u64, &S) -> Result<R, E>,
    first: u64,
    count: u64,
    shape: u64,
    setting: *const u64,
    cells: *mut u64,
) {
    // SAFETY: these registers can always be read.
    let (block, width, thread) = unsafe { (_block_idx_x(), _block_dim_x(), _thread_idx_x()) };
    // Compilers differ in whether these are signed; none is negative.
    let place = block as u64 * width as u64 + thread as u64;
    if place >= count {
        return;
    }
    let put = |column: usize, word: u64| {
        let at = column as u64 * count + place;
        // SAFETY: the column is the first one, or one of the words of a row, whose number was compared.
        unsafe { cells.add(at as usize).write(word) }
    };
    if shape != kernel::shape::<S, R>() {
        put(0, MISMATCHED);
        return;
    }
    let mut taken = 0;
    let setting = S::take(&mut || {
        // SAFETY: no more words are taken than the type has, whose number was compared.
        let word = unsafe { setting.add(taken).read() };
        taken += 1;
        word
    });
    kernel::compute(row, first + place, &setting, put);
}

/// A kernel that could panic names a function that exists nowhere, so it is not assembled.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    #[allow(unsafe_code)]
    unsafe extern "C" {
        fn this_kernel_can_panic() -> !;
    }
    // SAFETY: it is never linked, so never called.
    #[allow(unsafe_code)]
    unsafe {
        this_kernel_can_panic()
    }
}
