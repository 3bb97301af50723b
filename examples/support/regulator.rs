//! The discrete linear-quadratic regulator about the motion of the arm, designed on the desk.

use lagrangian::prelude::*;

use super::arm::{Arm, DURATION, Gains, needed, wanted};

type Square = SMatrix<f64, 12, 12>;
type Input = SMatrix<f64, 12, 6>;

/// How often the torques are set \[Hz].
pub const RATE: u32 = 1000;

/// The number of samples.
pub const SAMPLES: usize = (RATE as f64 * DURATION) as usize;

/// The weights of an error of 1 rad and of 1 rad/s, which last a second, and of a torque of 1 N m.
const WEIGHTS: [f64; 3] = [1e5, 1e2, 1e-1];

/// A regulator for all samples.
pub struct Regulator {
    /// K\[k] of u = u* − K (x − x*).
    pub gains: Vec<Gains<f64>>,
    /// P of xᵀ P x, the cost from the first sample to the last of a deviation x at the first.
    pub cost: Square,
}

/// The cost of one sample.
pub fn cost(deviation: &SVector<f64, 12>, torque: &SVector<f64, 6>) -> f64 {
    let [angle, rate, effort] = WEIGHTS.map(|weight| weight / f64::from(RATE));
    let (angles, rates) = (deviation.fixed_rows::<6>(0), deviation.fixed_rows::<6>(6));
    angle * angles.norm_squared() + rate * rates.norm_squared() + effort * torque.norm_squared()
}

/// x\[k + 1] = Φ x\[k] + Γ u\[k] for a torque that is held for a sample: Φ = exp(A h), Γ = ∫ exp(A s) ds B,
/// by their series.
fn sampled(a: &Square, b: &Input) -> (Square, Input) {
    let h = 1.0 / f64::from(RATE);
    let (mut phi, mut integral, mut term) = (Square::identity(), Square::identity() * h, Square::identity());
    // |A h| is below a tenth.
    for k in 1..8 {
        term = term * a * (h / f64::from(k));
        phi += term;
        integral += term * (h / f64::from(k + 1));
    }
    (phi, integral * b)
}

/// The linear model in the middle of a sample.
fn model(arm: &Arm<f64>, sample: usize) -> Result<(Square, Input), MotionError<f64>> {
    let (t, h) = (sample as f64 / f64::from(RATE), 1.0 / f64::from(RATE));
    let model = arm.linearize(&wanted(t + 0.5 * h).state, &needed(arm, t, h)?)?;
    let (Some(a), Some(b)) = (model.state_matrix(), model.input_matrix()) else {
        unreachable!("six angles and six rates")
    };
    Ok(sampled(&a, &b))
}

/// Riccati's recursion from the end of the motion, where the cost is that of one sample, to its beginning.
pub fn design(arm: &Arm<f64>) -> Result<Regulator, MotionError<f64>> {
    let [angle, rate, effort] = WEIGHTS.map(|weight| weight / f64::from(RATE));
    let weights = Square::from_diagonal(&SVector::from_fn(|i, _| if i < 6 { angle } else { rate }));
    let mut gains = vec![Gains::zeros(); SAMPLES];
    let mut cost = weights;
    for sample in (0..SAMPLES).rev() {
        let (phi, gamma) = model(arm, sample)?;
        let ahead = gamma.transpose() * cost;
        let scale = ahead * gamma + SMatrix::<f64, 6, 6>::identity() * effort;
        let inverse = scale.try_inverse().expect("a positive matrix");
        gains[sample] = inverse * ahead * phi;
        let closed = phi - gamma * gains[sample];
        cost = weights + phi.transpose() * cost * closed;
        cost = (cost + cost.transpose()) * 0.5;
    }
    Ok(Regulator { gains, cost })
}
