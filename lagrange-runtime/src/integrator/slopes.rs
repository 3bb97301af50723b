//! Slopes of Runge–Kutta stages and their weighted sums.

use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::state::State;

/// (dq/dt, dv/dt) at a stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope<R, const N: usize> {
    pub q: [R; N],
    pub v: [R; N],
}

/// The weighted sum Σⱼ `weights[j]` `slopes[j]` of the first `M` slopes. `weights[0]` is not zero.
#[inline(always)]
pub(crate) fn combine<R: Real, const N: usize, const M: usize, const W: usize, const L: usize>(
    weights: &[f64; W],
    slopes: &[Slope<R, N>; L],
) -> Slope<R, N> {
    let first = R::from_f64(weights[0]);
    let mut sum = Slope { q: slopes[0].q.each(|x| first * x), v: slopes[0].v.each(|x| first * x) };
    // The sum is written out, because LLVM does not unroll a loop over the stages, nor remove its tests of
    // constants.
    macro_rules! terms {
        ($($j:literal)*) => {$(
            if $j < M && weights[$j] != 0.0 {
                let weight = R::from_f64(weights[$j]);
                for n in 0..N {
                    sum.q[n] += weight * slopes[$j].q[n];
                    sum.v[n] += weight * slopes[$j].v[n];
                }
            }
        )*};
    }
    terms!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
    sum
}

/// `from` + h · `slope`, without compensated summation: coordinates and velocities of a stage.
#[inline(always)]
pub(crate) fn reach<R: Real, const N: usize>(
    from: &State<R, N>,
    h: R,
    slope: &Slope<R, N>,
) -> ([R; N], [R; N]) {
    let (mut q, mut v) = (from.q, from.v);
    for n in 0..N {
        q[n] += h * slope.q[n];
        v[n] += h * slope.v[n];
    }
    (q, v)
}
