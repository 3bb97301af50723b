//! Arrays from functions of their elements.
//!
//! [`core::array::from_fn`] and `map` of an array compile several functions of the standard library for each
//! closure. Optimised code has none of them left; in unoptimised code they took an eighth of the time of
//! compilation. So a loop takes their place there.

/// The array of `f(0)`, `f(1)`, …
#[cfg(not(debug_assertions))]
#[inline(always)]
pub fn array<T: Copy, const N: usize>(f: impl FnMut(usize) -> T) -> [T; N] {
    core::array::from_fn(f)
}

/// The array of `f(0)`, `f(1)`, …
#[cfg(debug_assertions)]
pub fn array<T: Copy, const N: usize>(mut f: impl FnMut(usize) -> T) -> [T; N] {
    if let Ok(empty) = <[T; N]>::try_from(&[][..]) {
        return empty;
    }
    let mut elements = [f(0); N];
    let mut index = 1;
    while index < N {
        elements[index] = f(index);
        index += 1;
    }
    elements
}

/// `map` of an array.
pub trait Each<T, const N: usize> {
    /// The array of `f` of each element.
    fn each<U: Copy>(self, f: impl FnMut(T) -> U) -> [U; N];
}

impl<T: Copy, const N: usize> Each<T, N> for [T; N] {
    #[cfg(not(debug_assertions))]
    #[inline(always)]
    fn each<U: Copy>(self, f: impl FnMut(T) -> U) -> [U; N] {
        self.map(f)
    }

    #[cfg(debug_assertions)]
    fn each<U: Copy>(self, mut f: impl FnMut(T) -> U) -> [U; N] {
        array(|index| f(self[index]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_made_in_order_and_once() {
        let mut calls = 0;
        let made: [usize; 5] = array(|index| {
            calls += 1;
            10 * index + calls
        });
        assert_eq!((made, calls), ([1, 12, 23, 34, 45], 5));
        let mut seen = 0;
        let doubled = made.each(|x| {
            seen += x;
            2 * x
        });
        assert_eq!((doubled, seen), ([2, 24, 46, 68, 90], 115));
    }

    #[test]
    fn an_array_of_nothing_calls_nothing() {
        let none: [u8; 0] = array(|_| unreachable!("there is no element"));
        assert_eq!(none.each(|x| x), []);
    }
}
