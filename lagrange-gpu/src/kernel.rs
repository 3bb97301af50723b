//! [`Kernel`]: a function of an index, and the cells in which its rows stand.
//!
//! The cells of a launch are `1 + words` columns of `count` words: a mark for each motion, then the first
//! word of each row, and so on. Neighbouring threads write to neighbouring places.

use crate::words::Words;

/// The mark of a motion that has a row.
pub(crate) const DONE: u64 = 1;
/// The mark of a motion that ended in an error.
pub(crate) const FAILED: u64 = 2;
/// The mark of a motion of which the processor knows another kind of row, or other settings, than the host.
pub(crate) const MISMATCHED: u64 = 3;

/// A function of an index with its name: what a host launches on a processor, or computes itself. Made by
/// [`kernel!`](crate::kernel!).
///
/// Its arguments are the index and what all motions share.
#[derive(Debug)]
pub struct Kernel<S, R, E> {
    pub(crate) name: &'static str,
    pub(crate) row: fn(u64, &S) -> Result<R, E>,
}

impl<S, R, E> Clone for Kernel<S, R, E> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S, R, E> Copy for Kernel<S, R, E> {}

impl<S: Words, R: Words, E> Kernel<S, R, E> {
    /// The function `row`, whose kernel has the last part of a path as its name.
    #[doc(hidden)]
    pub const fn new(name: &'static str, row: fn(u64, &S) -> Result<R, E>) -> Self {
        Self { name, row }
    }

    /// The name of the function, which is that of the kernel.
    pub fn name(&self) -> &'static str {
        self.name.rsplit("::").next().unwrap_or_default().trim()
    }

    /// The result of one motion, computed here.
    ///
    /// # Errors
    /// Why the motion has no row.
    pub fn row(&self, index: u64, setting: &S) -> Result<R, E> {
        (self.row)(index, setting)
    }

    /// The words that a processor leaves of a motion: a mark, then those of its row. Zeros stand here where
    /// the motion has no row; a processor leaves those words as they were.
    #[cfg(not(target_arch = "nvptx64"))]
    #[doc(hidden)]
    pub fn cells(&self, index: u64, setting: &S) -> Vec<u64> {
        let mut cells = vec![0; 1 + R::WORDS];
        compute(self.row, index, setting, |column, word| {
            cells.get_mut(column).into_iter().for_each(|cell| *cell = word);
        });
        cells
    }

    /// The argument of a launch that tells the types.
    #[doc(hidden)]
    pub fn shape(&self) -> u64 {
        shape::<S, R>()
    }
}

/// How many words a kernel takes and gives, in one number: both sides must agree.
pub(crate) const fn shape<S: Words, R: Words>() -> u64 {
    (S::WORDS as u64) << 32 | R::WORDS as u64
}

/// The whole of a kernel but the memory: computes a motion and puts its mark and its words, by column. This
/// is what the processor does, and what tests do without one.
#[inline(always)]
pub(crate) fn compute<S: Words, R: Words, E>(
    row: impl Fn(u64, &S) -> Result<R, E>,
    index: u64,
    setting: &S,
    mut put: impl FnMut(usize, u64),
) {
    match row(index, setting) {
        Ok(row) => {
            let mut column = 0;
            row.put(&mut |word| {
                column += 1;
                put(column, word);
            });
            put(0, DONE);
        }
        Err(_) => put(0, FAILED),
    }
}

/// Makes kernels of functions of this crate, when it is built for a processor; elsewhere it checks their
/// types.
///
/// A function takes the index of a motion and a reference to what all motions share, and returns a `Result`:
/// both sides are [`Words`](crate::Words). It must not panic or allocate, and the build says if it could.
///
/// The crate begins with `#![no_std]` and `#![cfg_attr(target_arch = "nvptx64", feature(abi_ptx))]`.
#[macro_export]
macro_rules! kernels {
    ($($function:ident),+ $(,)?) => {$(
        #[cfg(target_arch = "nvptx64")]
        const _: () = {
            // SAFETY: no other name of the program is that of a kernel, or the compiler says so; whoever
            // launches it keeps what `enter` asks for.
            #[allow(unsafe_code)]
            #[unsafe(no_mangle)]
            unsafe extern "ptx-kernel" fn $function(
                first: u64,
                count: u64,
                shape: u64,
                setting: *const u64,
                cells: *mut u64,
            ) {
                unsafe { $crate::device::enter(self::$function, first, count, shape, setting, cells) }
            }
        };

        #[cfg(not(target_arch = "nvptx64"))]
        const _: fn() = || {
            let _ = $crate::kernel!(self::$function);
        };
    )+};
}

/// A function that [`kernels!`](crate::kernels!) made a kernel of, to be launched or computed:
/// `kernel!(path)`.
#[macro_export]
macro_rules! kernel {
    ($function:path) => {
        $crate::Kernel::new(stringify!($function), $function)
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halves(index: u64, &step: &u64) -> Result<(u64, f64), ()> {
        if index.is_multiple_of(step) { Ok((index / step, 0.5)) } else { Err(()) }
    }

    crate::kernels!(halves);

    #[test]
    fn a_kernel_has_the_name_of_its_function() {
        assert_eq!(crate::kernel!(self::halves).name(), "halves");
        assert_eq!(crate::kernel!(halves).name(), "halves");
    }

    #[test]
    fn rows_stand_in_columns_behind_their_mark() {
        let mut cells = [[0; 2]; 3];
        for index in 0..2 {
            compute(halves, 3 + index, &2, |column, word| cells[column][index as usize] = word);
        }
        assert_eq!(cells, [[FAILED, DONE], [0, 2], [0, 0.5_f64.to_bits()]]);
    }
}
