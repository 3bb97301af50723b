//! [`Words`]: values that travel between a machine and its processor as words of 64 bits.
//!
//! Two targets need not agree on the layout of a type. So values are taken apart into words and put together
//! again.

use lagrange_runtime::State;

/// A value that can be handed to a processor and back: a fixed number of words of 64 bits.
///
/// Numbers, `bool`, [`State`], arrays and tuples are made of words. A type of yours becomes one by two short
/// functions that go through its fields in the same order:
///
/// ```
/// use lagrange_gpu::Words;
///
/// struct Landing {
///     time: f64,
///     upright: bool,
/// }
///
/// impl Words for Landing {
///     const WORDS: usize = f64::WORDS + bool::WORDS;
///
///     fn put(&self, to: &mut impl FnMut(u64)) {
///         self.time.put(to);
///         self.upright.put(to);
///     }
///
///     fn take(from: &mut impl FnMut() -> u64) -> Self {
///         Self { time: Words::take(from), upright: Words::take(from) }
///     }
/// }
/// ```
pub trait Words: Sized {
    /// How many words [`put`](Words::put) gives and [`take`](Words::take) takes.
    const WORDS: usize;

    /// Gives the words, in order.
    fn put(&self, to: &mut impl FnMut(u64));

    /// Takes the words, in the same order.
    fn take(from: &mut impl FnMut() -> u64) -> Self;
}

macro_rules! number {
    ($($number:ty: $to:expr, $from:expr;)*) => {$(
        impl Words for $number {
            const WORDS: usize = 1;

            #[inline]
            fn put(&self, to: &mut impl FnMut(u64)) {
                to($to(*self));
            }

            #[inline]
            fn take(from: &mut impl FnMut() -> u64) -> Self {
                $from(from())
            }
        }
    )*};
}

number! {
    f64: f64::to_bits, f64::from_bits;
    f32: |number: f32| u64::from(number.to_bits()), |word| f32::from_bits(word as u32);
    u64: |number| number, |word| word;
    u32: u64::from, |word| word as u32;
    u8: u64::from, |word| word as u8;
    i64: i64::cast_unsigned, u64::cast_signed;
    i32: |number: i32| u64::from(number.cast_unsigned()), |word| (word as u32).cast_signed();
    bool: u64::from, |word| word != 0;
}

impl<T: Words, const N: usize> Words for [T; N] {
    const WORDS: usize = N * T::WORDS;

    #[inline]
    fn put(&self, to: &mut impl FnMut(u64)) {
        self.iter().for_each(|value| value.put(to));
    }

    #[inline]
    fn take(from: &mut impl FnMut() -> u64) -> Self {
        core::array::from_fn(|_| T::take(from))
    }
}

/// The time, the coordinates, the velocities.
impl<R: Words, const N: usize> Words for State<R, N> {
    const WORDS: usize = (1 + 2 * N) * R::WORDS;

    #[inline]
    fn put(&self, to: &mut impl FnMut(u64)) {
        self.t.put(to);
        self.q.put(to);
        self.v.put(to);
    }

    #[inline]
    fn take(from: &mut impl FnMut() -> u64) -> Self {
        Self { t: R::take(from), q: Words::take(from), v: Words::take(from) }
    }
}

macro_rules! tuple {
    ($($name:ident)*) => {
        impl<$($name: Words),*> Words for ($($name,)*) {
            const WORDS: usize = 0 $(+ $name::WORDS)*;

            #[inline]
            #[allow(non_snake_case, unused_variables)]
            fn put(&self, to: &mut impl FnMut(u64)) {
                let ($($name,)*) = self;
                $($name.put(to);)*
            }

            #[inline]
            #[allow(unused_variables, clippy::unused_unit)]
            fn take(from: &mut impl FnMut() -> u64) -> Self {
                ($($name::take(from),)*)
            }
        }
    };
}

tuple! {}
tuple! { A }
tuple! { A B }
tuple! { A B C }
tuple! { A B C D }
tuple! { A B C D E }
tuple! { A B C D E F }

#[cfg(test)]
mod tests {
    use super::*;

    /// The words of a value. There must be as many as it says, and they must give the value again.
    fn words<T: Words + PartialEq + core::fmt::Debug>(value: T) -> Vec<u64> {
        let mut words = Vec::new();
        value.put(&mut |word| words.push(word));
        assert_eq!(words.len(), T::WORDS);
        let mut all = words.iter();
        assert_eq!(T::take(&mut || *all.next().expect("no more words than it says")), value);
        assert!(all.next().is_none());
        words
    }

    #[test]
    fn values_come_back_as_they_were() {
        assert_eq!(words(-0.0_f64), [1 << 63]);
        assert_eq!(words(1.0_f32), [0x3f80_0000]);
        assert_eq!(words((-1_i64, -1_i32, 7_u8, true, 3_u32)), [u64::MAX, 0xffff_ffff, 7, 1, 3]);
        assert_eq!(words([[1_u64, 2], [3, 4]]), [1, 2, 3, 4]);
        assert_eq!(words(State { t: 1.0, q: [2.0, 3.0], v: [4.0, 5.0] }).len(), 5);
        assert!(words(()).is_empty());
    }
}
