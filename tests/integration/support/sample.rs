//! Random states that are the same in every run.

use lagrangian::State;

/// A linear congruential generator (Knuth, MMIX), of which the upper bits are used.
pub struct Samples(u64);

impl Samples {
    /// A generator with a seed.
    pub fn new(seed: u64) -> Self {
        let mut samples = Self(seed);
        samples.unit();
        samples
    }

    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number in [low, high).
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A state with every number in [low, high), time included.
    pub fn state<const N: usize>(&mut self, low: f64, high: f64) -> State<f64, N> {
        let mut numbers = || std::array::from_fn(|_| self.number(low, high));
        let (q, v) = (numbers(), numbers());
        State::new(q, v).at_time(self.number(low, high))
    }
}
