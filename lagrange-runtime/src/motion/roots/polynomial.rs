//! A function on \[0, 1] as a series of Chebyshev polynomials, with the bound of its rounding errors.
//!
//! Interpolation at nested points with an eye on the last coefficients: Z. Battles, L. N. Trefethen, "An
//! extension of MATLAB to continuous functions and operators", SIAM J. Sci. Comput. 25 (2004). Sums by
//! Clenshaw with Reinsch's modification, which loses nothing near the ends: J. Oliver, "An error analysis of
//! the modified Clenshaw method for evaluating Chebyshev and Fourier series", IMA J. Appl. Math. 20 (1977).

use crate::number::real::{Ordered, Real, larger};
use crate::system::error::Cause;

use super::{Kind, Memory, Zero, Zeros};

/// The highest degree.
pub(super) const DEGREE: usize = 64;

/// The degrees that are tried; the points of each are among those of the next.
const DEGREES: [usize; 4] = [8, 16, 32, 64];

/// Places beside all nodes where a polynomial must agree with its function: coefficients alone do not see
/// an oscillation that has a node at the same place in each period.
const PROBES: [f64; 3] = [0.213_117, 0.571_823, 0.938_371];

/// The largest ratio of a level tail of coefficients to the expected rounding errors. Such a tail consists of
/// rounding errors that the size of the function does not show.
const UNEXPECTED: f64 = 1024.0;

/// Why a function has no [`Polynomial`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unresolved {
    /// It is infinite or no number somewhere.
    NotFinite,
    /// No polynomial of degree 64 is equal to it up to rounding errors. Half the interval needs less.
    Degree,
}

impl Unresolved {
    /// The cause of the error of a motion that has to know the function.
    pub(crate) fn cause(self) -> Cause {
        match self {
            Self::NotFinite => Cause::NotFinite,
            Self::Degree => Cause::StepTooSmall,
        }
    }
}

/// A polynomial Σ cₖ Tₖ(2θ − 1) on θ in \[0, 1].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial<R> {
    coefficients: [R; DEGREE + 1],
    degree: usize,
    noise: R,
}

/// cos(jπ/64) as sums of two doubles, for j up to 32.
#[allow(clippy::approx_constant)]
const COSINES: [(f64, f64); 33] = [
    (1.0, 0.0),
    (0.998_795_456_205_172_4, -1.229_169_333_707_546_5e-17),
    (0.995_184_726_672_196_9, -4.248_691_367_830_441e-17),
    (0.989_176_509_964_781, -4.098_730_993_704_711e-17),
    (0.980_785_280_403_230_4, 1.854_693_999_782_500_6e-17),
    (0.970_031_253_194_544, 1.836_530_034_842_884_4e-17),
    (0.956_940_335_732_208_8, 4.055_386_986_187_57e-17),
    (0.941_544_065_183_020_8, -2.789_637_954_769_834e-17),
    (0.923_879_532_511_286_7, 1.764_504_708_433_667_7e-17),
    (0.903_989_293_123_443_3, -6.609_754_468_748_431e-18),
    (0.881_921_264_348_355, -1.984_324_840_589_056_2e-17),
    (0.857_728_610_000_272_1, -4.818_344_793_633_662e-17),
    (0.831_469_612_302_545_2, 1.407_385_698_472_802_4e-18),
    (0.803_207_531_480_644_9, -3.306_060_980_481_491e-17),
    (0.773_010_453_362_737, -3.256_590_703_364_977e-17),
    (0.740_951_125_354_959_1, -1.470_861_695_229_734_5e-17),
    (0.707_106_781_186_547_6, -4.833_646_656_726_457e-17),
    (0.671_558_954_847_018_4, -4.048_903_774_929_669e-17),
    (0.634_393_284_163_645_5, 1.042_090_192_928_003_5e-17),
    (0.595_699_304_492_433_4, -1.343_864_193_657_946_7e-17),
    (0.555_570_233_019_602_2, 4.709_410_940_561_677e-17),
    (0.514_102_744_193_221_8, -4.571_270_752_361_562_4e-17),
    (0.471_396_736_825_997_64, 6.516_678_136_069_013e-18),
    (0.427_555_093_430_282_1, 9.411_189_816_295_473e-18),
    (0.382_683_432_365_089_8, -1.005_077_269_646_158_8e-17),
    (0.336_889_853_392_220_05, -4.200_094_003_347_509e-19),
    (0.290_284_677_254_462_4, -1.892_797_870_777_425e-17),
    (0.242_980_179_903_263_9, -8.751_431_529_719_663e-18),
    (0.195_090_322_016_128_28, -7.991_079_068_461_731e-18),
    (0.146_730_474_455_361_75, 3.726_947_147_046_568e-18),
    (0.098_017_140_329_560_6, -1.634_582_362_244_256e-18),
    (0.049_067_674_327_418_015, -6.796_103_720_518_28e-19),
    (0.0, 0.0),
];

/// cos(jπ/64).
fn cosine<R: Real>(j: usize) -> R {
    let turn = j % (2 * DEGREE);
    let j = turn.min(2 * DEGREE - turn);
    let (high, low) = COSINES[j.min(DEGREE - j)];
    let cosine = R::from_parts(high, low);
    if j > DEGREE / 2 { -cosine } else { cosine }
}

/// The node j of 64, in \[0, 1]: (1 − cos φ)/2 without cancellation.
fn node<R: Real>(j: usize) -> R {
    let half = R::from_f64(0.5);
    let cosine_plus_one = R::one() + cosine::<R>(j.min(DEGREE - j));
    let sine = cosine::<R>(DEGREE / 2 - j.min(DEGREE - j).min(DEGREE / 2));
    let near = half * sine * sine / cosine_plus_one;
    if j > DEGREE / 2 { R::one() - near } else { near }
}

/// The distance of the samples for a degree, which is at least one.
fn stride(n: usize) -> usize {
    (DEGREE / n.max(1)).max(1)
}

/// Coefficients of the polynomial through samples at the nodes 0, 64/n, …, 64.
fn through<R: Real>(samples: &[R; DEGREE + 1], n: usize) -> [R; DEGREE + 1] {
    let stride = stride(n);
    let half = R::from_f64(0.5);
    let scale = R::from_f64(2.0 / n as f64);
    // All cosines that there are, once: cos(jπ/n) for j below 2n.
    let mut cosines = [R::zero(); 2 * DEGREE];
    for (j, entry) in cosines.iter_mut().enumerate().take(2 * n) {
        *entry = cosine(j * stride);
    }
    // Cosines of even orders are the same at nodes that lie opposite each other, those of odd ones opposite.
    let (mut sums, mut differences) = ([R::zero(); DEGREE / 2 + 1], [R::zero(); DEGREE / 2 + 1]);
    let parts = sums.iter_mut().zip(&mut differences).take(n / 2);
    for ((j, (sum, difference)), (&low, &high)) in
        parts.enumerate().zip(samples.iter().step_by(stride).zip(samples.iter().rev().step_by(stride)))
    {
        (*sum, *difference) = (low + high, low - high);
        if j == 0 {
            (*sum, *difference) = (half * *sum, half * *difference);
        }
    }
    if let Some(middle) = sums.get_mut(n / 2) {
        *middle = samples[DEGREE / 2];
    }
    let mut coefficients = [R::zero(); DEGREE + 1];
    for (k, coefficient) in coefficients.iter_mut().enumerate().take(n + 1) {
        let parts = if k % 2 == 0 { &sums } else { &differences };
        let (mut sum, mut turn) = (R::zero(), 0);
        for &part in parts.iter().take(n / 2 + 1) {
            sum = part.mul_add(cosines.get(turn).copied().unwrap_or(half), sum);
            turn += k;
            if turn >= 2 * n {
                turn -= 2 * n;
            }
        }
        let sum = if k == 0 || k == n { sum * half } else { sum };
        // θ grows from node to node, so x = 2θ − 1 is minus the cosine.
        *coefficient = if k % 2 == 1 { -(sum * scale) } else { sum * scale };
    }
    coefficients
}

/// The largest, without signs.
fn most<R: Ordered>(values: &[R]) -> R {
    values.iter().fold(R::zero(), |most, value| larger(value.abs(), most))
}

impl<R: Ordered> Polynomial<R> {
    /// Interpolates `g` on \[0, 1]. `size` is the sum of the magnitudes that a value of `g` is made of, at
    /// its largest: what the rounding errors of `g` are relative to, where that is more than `g` itself.
    pub(crate) fn interpolate(size: R, mut g: impl FnMut(R) -> R) -> Result<Self, Unresolved> {
        let mut samples = [R::zero(); DEGREE + 1];
        let mut scale = size.abs();
        let mut all = Err(Unresolved::Degree);
        for n in DEGREES {
            let stride = stride(n);
            for (j, sample) in samples.iter_mut().enumerate().step_by(stride) {
                if n > 8 && j % (2 * stride) == 0 {
                    continue;
                }
                *sample = g(node(j));
                if !sample.is_finite() {
                    return Err(Unresolved::NotFinite);
                }
                scale = larger(scale, sample.abs());
            }
            all = Self::resolved(through(&samples, n), n, scale);
            if let Ok(polynomial) = all {
                let agrees = PROBES.iter().map(|&probe| R::from_f64(probe)).all(|probe| {
                    let difference = (polynomial.value(probe) - g(probe)).abs();
                    difference <= polynomial.noise + polynomial.noise
                });
                all = if agrees { Ok(polynomial) } else { Err(Unresolved::Degree) };
            }
            if all.is_ok() {
                break;
            }
        }
        all
    }

    /// The polynomial with these coefficients, if the last of them are rounding errors.
    fn resolved(coefficients: [R; DEGREE + 1], n: usize, scale: R) -> Result<Self, Unresolved> {
        let (four, eight) = (R::from_f64(4.0), R::from_f64(8.0));
        // The rounding errors of samples and sums; those of the nodes by the slope, inside and at the end.
        let (mut inside, mut end) = (R::zero(), R::zero());
        for (k, &coefficient) in coefficients.iter().enumerate().take(n + 1) {
            let k = R::from_f64(k as f64);
            inside += k * coefficient.abs();
            end += k * k * coefficient;
        }
        let mut noise = (eight * scale + inside + end.abs()) * R::epsilon();
        let tail = most(coefficients.get(n + 1 - (n / 8).max(2)..=n).unwrap_or_default());
        if tail * four > noise {
            let level = most(&coefficients[DEGREE * 3 / 4 + 1..]);
            let before = most(&coefficients[DEGREE / 2 + 1..=DEGREE * 3 / 4]);
            let unexpected = level * four > before && level < R::from_f64(UNEXPECTED) * noise;
            if n < DEGREE || !unexpected {
                return Err(Unresolved::Degree);
            }
            // At a kink coefficients fall like 1/k². Beyond the last one the rest is up to n times as large,
            // and interpolation doubles it.
            noise += R::from_f64(2.0 * DEGREE as f64) * level;
        }
        // The neglected terms are a small part of the noise.
        let mut degree = n;
        let mut left = R::zero();
        for coefficient in coefficients.iter().take(n + 1).skip(1).rev() {
            left += coefficient.abs();
            if left * four > noise {
                break;
            }
            degree -= 1;
        }
        Ok(Self { coefficients, degree, noise })
    }

    /// The bound of the difference between this and the function, and of what counts as zero.
    pub(crate) fn noise(&self) -> R {
        self.noise
    }

    /// A bound of the magnitude on \[0, 1].
    pub(crate) fn extent(&self) -> R {
        self.coefficients().iter().fold(R::zero(), |sum, coefficient| sum + coefficient.abs())
    }

    /// The degree up to the noise.
    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    /// The coefficients up to the degree.
    pub(super) fn coefficients(&self) -> &[R] {
        self.coefficients.get(..=self.degree).unwrap_or(&self.coefficients)
    }

    /// The same less its value at θ = 0, so that it is zero there. Elsewhere it is then wrong by that value.
    pub(crate) fn deflated(mut self) -> Self {
        let start = self.value(R::zero());
        self.coefficients[0] -= start;
        self.noise += start.abs();
        self
    }

    /// The value at θ.
    pub(crate) fn value(&self, theta: R) -> R {
        sum(self.coefficients(), theta)
    }

    /// Half the derivative; its noise is not told.
    pub(super) fn slope(&self) -> Self {
        let (coefficients, degree) = derivative(self.coefficients());
        Self { coefficients, degree, noise: R::zero() }
    }

    /// The quotient by 2θ, but for the remainder; its noise is not told.
    pub(super) fn divided(&self) -> Self {
        let mut coefficients = [R::zero(); DEGREE + 1];
        let two = R::from_f64(2.0);
        let (mut last, mut last_but_one) = (R::zero(), R::zero());
        for (k, &coefficient) in self.coefficients().iter().enumerate().skip(1).rev() {
            let next = two * (coefficient - last) - last_but_one;
            let next = if k == 1 { next * R::from_f64(0.5) } else { next };
            last_but_one = last;
            last = next;
            if let Some(place) = coefficients.get_mut(k - 1) {
                *place = next;
            }
        }
        Self { coefficients, degree: self.degree.saturating_sub(1), noise: R::zero() }
    }

    /// The coefficients on the part of the step that starts at `low`, where `degree` is known to be enough,
    /// and the degree that is needed there.
    pub(super) fn on(&self, low: R, width: R, degree: usize) -> ([R; DEGREE + 1], usize) {
        let n = degree.max(2).next_power_of_two().min(DEGREE);
        let mut samples = [R::zero(); DEGREE + 1];
        for (j, sample) in samples.iter_mut().enumerate().step_by(stride(n)) {
            *sample = self.value(low + width * node(j));
        }
        let coefficients = through(&samples, n);
        (coefficients, self.shortened(&coefficients[..=n]))
    }

    /// The degree of a part up to a small part of the noise.
    fn shortened(&self, coefficients: &[R]) -> usize {
        let sixteen = R::from_f64(16.0);
        let mut left = R::zero();
        let negligible = coefficients.iter().rev().take_while(|coefficient| {
            left += coefficient.abs();
            left * sixteen <= self.noise
        });
        coefficients.len().saturating_sub(1 + negligible.count())
    }

    /// The zeros in [0, `until`], in order.
    pub(crate) fn zeros(&self, start: Memory, until: R) -> Zeros<R> {
        Zeros::new(self, start, until)
    }

    /// The first zero of a kind.
    pub(crate) fn first(&self, kind: Kind, start: Memory) -> Option<Zero<R>> {
        self.zeros(start, R::one()).find(|zero| zero.kind == kind)
    }
}

/// Coefficients of half the derivative in θ, and its degree.
pub(super) fn derivative<R: Real>(coefficients: &[R]) -> ([R; DEGREE + 1], usize) {
    let mut derivative = [R::zero(); DEGREE + 1];
    let (mut last, mut last_but_one) = (R::zero(), R::zero());
    for (k, &coefficient) in coefficients.iter().enumerate().skip(1).rev() {
        let next = last_but_one + R::from_f64(2.0 * k as f64) * coefficient;
        last_but_one = last;
        last = next;
        if let Some(place) = derivative.get_mut(k - 1) {
            *place = next;
        }
    }
    derivative[0] *= R::from_f64(0.5);
    (derivative, coefficients.len().saturating_sub(2))
}

/// Σ cₖ Tₖ(2θ − 1).
fn sum<R: Ordered>(coefficients: &[R], theta: R) -> R {
    let (zero, half) = (R::zero(), R::from_f64(0.5));
    let four = R::from_f64(4.0);
    let Some((&constant, others)) = coefficients.split_first() else { return zero };
    let (mut b, mut d) = (zero, zero);
    if theta < half {
        let a = four * theta;
        for &coefficient in others.iter().rev() {
            d = a.mul_add(b, coefficient - d);
            b = d - b;
        }
        constant + (half * a).mul_add(b, -d)
    } else {
        let a = four * (theta - R::one());
        for &coefficient in others.iter().rev() {
            d = a.mul_add(b, coefficient + d);
            b = d + b;
        }
        constant + (half * a).mul_add(b, d)
    }
}
