//! [`FirstOrder`]: a system in the form y' = f(t, y) that integrators of the peers take, possibly with
//! algebraic equations.

use super::hand::ByHand;
use super::number::Number;

/// `D` numbers, of which the last [`ALGEBRAIC`](Self::ALGEBRAIC) are multipliers with an equation 0 = f(t, y)
/// each.
pub trait FirstOrder<const D: usize>: Copy + 'static {
    /// How many numbers have no derivative.
    const ALGEBRAIC: usize = 0;

    /// Writes y', and behind it the residuals of the algebraic equations.
    fn slope<R: Number>(t: f64, y: &[R; D], slope: &mut [R; D]);

    /// The numbers that belong to coordinates and velocities `motion` at time zero; multipliers need not be
    /// right.
    fn begin(motion: &[f64]) -> [f64; D] {
        std::array::from_fn(|i| motion.get(i).copied().unwrap_or_default())
    }

    /// Coordinates and velocities that belong to the numbers.
    fn motion(_t: f64, y: &[f64; D]) -> Vec<f64> {
        y[..D - Self::ALGEBRAIC].to_vec()
    }
}

/// y = (q, v) with accelerations by hand, D = 2 N.
#[derive(Clone, Copy)]
pub struct Explicit<H, const N: usize>(pub H);

impl<H: ByHand<N>, const N: usize, const D: usize> FirstOrder<D> for Explicit<H, N> {
    #[inline(always)]
    fn slope<R: Number>(t: f64, y: &[R; D], slope: &mut [R; D]) {
        const { assert!(D == 2 * N) };
        let (q, v) = (y.first_chunk::<N>(), y.last_chunk::<N>());
        let (Some(q), Some(v)) = (q, v) else { return };
        if let Some(first) = slope.first_chunk_mut::<N>() {
            *first = *v;
        }
        if let Some(last) = slope.last_chunk_mut::<N>() {
            H::accelerations(t, q, v, last);
        }
    }
}
