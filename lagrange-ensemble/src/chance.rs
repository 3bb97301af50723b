//! [`Chance`]: random numbers of a motion.

use lagrange_runtime::Real;

/// Random numbers that follow from a seed and the index of a motion, whatever ran before: for Monte Carlo.
///
/// ```
/// use lagrange_ensemble::Chance;
///
/// let mass = |index| Chance::new(7, index).normal(2.0, 0.1);
/// assert_eq!(mass(41), mass(41));
/// assert_ne!(mass(41), mass(42));
/// ```
///
/// The k-th number of a motion is a hash of seed, index and k: the finaliser of SplitMix64 (Steele, Lea and
/// Flood, *Fast splittable pseudorandom number generators*, 2014), three times. For one k, each index has
/// another hash. The numbers are not fit for cryptography.
#[derive(Clone, Copy, Debug)]
pub struct Chance {
    motion: u64,
    taken: u64,
}

impl Chance {
    /// The numbers of a motion. Another seed gives other numbers: write it into the key of the study.
    pub fn new(seed: u64, index: u64) -> Self {
        Self { motion: scattered(scattered(seed) ^ index), taken: 0 }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.taken = self.taken.wrapping_add(1);
        scattered(self.motion ^ self.taken)
    }

    /// A number between two others, evenly distributed.
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        // The upper 53 bits and a half: never 0. The largest of these sums is rounded up, to a share of 1.
        let share = ((self.bits() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
        from * (1.0 - share) + to * share
    }

    /// A number with a normal distribution, by Box and Muller. It takes two of the motion's numbers.
    pub fn normal(&mut self, mean: f64, deviation: f64) -> f64 {
        let (radius, angle) = (self.between(0.0, 1.0), self.between(0.0, std::f64::consts::TAU));
        mean + deviation * Real::sqrt(-2.0 * Real::ln(radius)) * Real::cos(angle)
    }
}

/// A number that looks like chance: the finaliser of SplitMix64.
pub(crate) fn scattered(number: u64) -> u64 {
    let x = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first numbers of SplitMix64 with seed 0, as published; stored studies rely on the bits.
    #[test]
    fn the_finaliser_is_that_of_splitmix64() {
        assert_eq!(scattered(0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(scattered(0x9e37_79b9_7f4a_7c15), 0x6e78_9e6a_a1b9_65f4);
    }

    #[test]
    fn moments_are_those_of_the_distributions() {
        let count = 200_000_u64;
        // Averages over motions, and over the numbers of one motion.
        let mut one = Chance::new(3, 5);
        let all: Vec<_> = (0..count)
            .flat_map(|index| {
                let mut chance = Chance::new(3, index);
                [
                    [chance.between(-1.0, 3.0), chance.normal(2.0, 0.5)],
                    [one.between(-1.0, 3.0), one.normal(2.0, 0.5)],
                ]
            })
            .collect();
        for (from, step) in [(0, 2), (1, 2)] {
            let numbers = || all.iter().skip(from).step_by(step);
            for (which, mean, deviation) in [(0, 1.0, 4.0 / 12.0_f64.sqrt()), (1, 2.0, 0.5)] {
                let found = numbers().map(|row| row[which]).sum::<f64>() / count as f64;
                let square = numbers().map(|row| (row[which] - mean).powi(2)).sum::<f64>() / count as f64;
                // Five standard errors of the mean; for a square, of kurtosis 3 at most.
                let unit = 5.0 / (count as f64).sqrt();
                assert!((found - mean).abs() < unit * deviation, "{found}");
                assert!((square / deviation.powi(2) - 1.0).abs() < unit * 2.0_f64.sqrt(), "{square}");
            }
            let product = numbers().map(|row| (row[0] - 1.0) * (row[1] - 2.0)).sum::<f64>() / count as f64;
            assert!(product.abs() < 5.0 / (count as f64).sqrt() * 4.0 / 12.0_f64.sqrt() * 0.5, "{product}");
        }
        assert!(all.iter().all(|row| row[0] > -1.0 && row[0] < 3.0 && row[1].is_finite()));
    }
}
