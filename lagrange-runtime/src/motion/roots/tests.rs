//! Zeros against the roots that functions were built from.

extern crate std;

use std::vec::Vec;

use super::*;

mod functions;
mod steps;

/// Random numbers: xorshift64*, G. Marsaglia (2003), S. Vigna (2016).
pub(super) struct Random(u64);

impl Random {
    pub(super) fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// In [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }
}

/// A product of factors, which has the sign of its exact value everywhere.
#[derive(Clone, Debug)]
pub(super) struct Product {
    pub(super) scale: f64,
    /// Real roots, in order, as often as they count.
    pub(super) roots: Vec<f64>,
    /// Real and imaginary parts of the others.
    pub(super) pairs: Vec<(f64, f64)>,
}

impl Product {
    pub(super) fn value(&self, theta: f64) -> f64 {
        let real: f64 = self.roots.iter().map(|root| theta - root).product();
        let pairs: f64 = self.pairs.iter().map(|(a, b)| (theta - a) * (theta - a) + b * b).product();
        self.scale * real * pairs
    }

    /// The function divided by the distance from a root to the power of its order, there, without sign.
    fn leading_at(&self, root: f64) -> f64 {
        let others = self.roots.iter().filter(|other| **other != root).map(|other| root - other);
        let pairs = self.pairs.iter().map(|(a, b)| (root - a) * (root - a) + b * b);
        (self.scale * others.product::<f64>() * pairs.product::<f64>()).abs()
    }

    /// Simple, double and triple roots, clusters, pairs down to a distance of 1e-9, conjugate pairs.
    pub(super) fn random(random: &mut Random) -> Self {
        let degree = 1 + random.below(24);
        let style = random.below(6);
        let (mut roots, mut pairs) = (Vec::new(), Vec::new());
        while roots.len() + 2 * pairs.len() < degree {
            let left = degree - roots.len() - 2 * pairs.len();
            let root = random.unit();
            let near = 10_f64.powf(-2.0 - 7.0 * random.unit());
            match random.below(8) {
                0 if style > 0 && left >= 2 => roots.extend([root, root]),
                1 if style > 1 && left >= 3 => roots.extend([root; 3]),
                2 if style > 2 && left >= 2 => roots.extend([root, root + near]),
                3 if style > 2 && left >= 3 => roots.extend([root, root + near, root - near * random.unit()]),
                4 if left >= 2 => pairs.push((root, 0.02 + random.unit())),
                5 => roots.push(-0.05 - random.unit()),
                6 => roots.push(1.05 + random.unit()),
                _ => roots.push(root),
            }
        }
        roots.sort_by(f64::total_cmp);
        Self { scale: if random.below(2) == 0 { 1.0 } else { -3.0 }, roots, pairs }
    }

    /// Points that show every change between certain and not, each with its value.
    fn samples(&self) -> Vec<(f64, f64)> {
        let mut ends: Vec<f64> = self.roots.iter().copied().filter(|r| (0.0..=1.0).contains(r)).collect();
        ends.extend([0.0, 1.0]);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let mut samples = Vec::new();
        for pair in ends.windows(2) {
            let between = (0..12).map(|i| pair[0] + (pair[1] - pair[0]) * f64::from(i) / 12.0);
            samples.extend(between.map(|theta| (theta, self.value(theta))));
        }
        samples.push((1.0, self.value(1.0)));
        samples
    }
}

/// An expected zero: its kind, and the ends of the part on which the function is not certain.
pub(super) type Expected = (Kind, f64, f64);

/// The zeros of a product that is not certain below a bound. `None` if a zero at an end of the step depends
/// on what is far outside.
fn expected(product: &Product, samples: &[(f64, f64)], bound: f64, degree: usize) -> Option<Vec<Expected>> {
    let sign = |value: f64| if value.abs() <= bound { 0.0 } else { value.signum() };
    let beyond = |at: f64, ahead: f64| {
        let outside = 0.2 / (degree * degree) as f64;
        let mut points = (0..40).map(|i| 1e-12 * 2_f64.powi(i)).take_while(|distance| *distance < outside);
        points.find_map(|distance| {
            let value = product.value(at + ahead * distance);
            (value.abs() > 8.0 * bound).then_some(value.signum())
        })
    };
    let kind = |before: f64, after: f64| match after - before {
        change if change > 0.5 => Kind::Rising,
        change if change < -0.5 => Kind::Falling,
        _ => Kind::Grazing,
    };
    let (mut found, mut last) = (Vec::new(), (sign(samples[0].1), 0.0));
    let mut low = None;
    if last.0 == 0.0 {
        last.0 = beyond(0.0, -1.0)?;
        low = Some(0.0);
    }
    for &(theta, value) in samples {
        let now = sign(value);
        if now == 0.0 {
            low = low.or(Some(last.1));
        } else {
            if let Some(low) = low.take() {
                found.push((kind(last.0, now), low, theta));
            }
            last = (now, theta);
        }
    }
    if let Some(low) = low.filter(|low| *low > 0.0) {
        found.push((kind(last.0, beyond(1.0, 1.0)?), low, 1.0));
    }
    Some(found)
}

/// Compares with what is expected; `false` where it depends on the noise.
fn check(product: &Product) -> bool {
    let polynomial = match Polynomial::interpolate(0.0, |theta| product.value(theta)) {
        Ok(polynomial) => polynomial,
        Err(error) => panic!("{error:?}: {product:?}"),
    };
    let noise = polynomial.noise();
    let samples = product.samples();
    for &(theta, value) in &samples {
        assert!((polynomial.value(theta) - value).abs() <= noise, "{theta}: {product:?}");
    }
    let expected = |part: f64| expected(product, &samples, part * noise, polynomial.degree());
    let (Some(narrow), Some(wide)) = (expected(0.2), expected(2.0)) else { return false };
    if narrow.len() != wide.len() || narrow.iter().zip(&wide).any(|(a, b)| a.0 != b.0) {
        return false;
    }
    let found: Vec<_> = polynomial.zeros(Memory::Unknown, 1.0).collect();
    assert_eq!(
        found.iter().map(|zero| zero.kind).collect::<Vec<_>>(),
        wide.iter().map(|zero| zero.0).collect::<Vec<_>>(),
        "{product:?}\n{found:?}\n{wide:?}"
    );
    for (zero, &(_, low, high)) in found.iter().zip(&wide) {
        assert!(low <= zero.theta && zero.theta <= high, "{product:?}\n{zero:?} in {low}..{high}");
        let inside: Vec<_> = product.roots.iter().filter(|root| (low..=high).contains(*root)).collect();
        if let [root] = inside[..] {
            let error = (zero.theta - root).abs();
            let bound = 1.01 * noise / product.leading_at(*root) + f64::EPSILON;
            assert!(
                error <= bound || product.leading_at(*root) * (high - low) < 9.0 * noise,
                "{error} {bound}"
            );
            let polished = zero.polish(|theta| product.value(theta));
            assert!((polished - root).abs() <= f64::EPSILON * root, "{polished} is not {root}: {product:?}");
        }
    }
    true
}

fn check_many(count: usize) {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let decided = (0..count).filter(|_| check(&Product::random(&mut random))).count();
    assert!(decided * 10 > count * 9, "only {decided} of {count} do not depend on the noise");
}

#[test]
#[ignore = "seconds; `scripts/check.sh features`"]
fn polynomials_have_the_zeros_they_were_built_from() {
    check_many(4_000);
}

#[test]
#[ignore = "minutes; for releases"]
fn a_million_polynomials() {
    check_many(1_000_000);
}

/// How many zeros of each kind: rising, falling, grazing.
pub(super) fn kinds<R: Ordered>(zeros: impl Iterator<Item = Zero<R>>) -> [usize; 3] {
    zeros.fold([0; 3], |[rising, falling, grazing], zero| match zero.kind {
        Kind::Rising => [rising + 1, falling, grazing],
        Kind::Falling => [rising, falling + 1, grazing],
        Kind::Grazing => [rising, falling, grazing + 1],
    })
}
