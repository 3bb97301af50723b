//! Car axis of the Test Set for IVP Solvers: a rod between two wheels on springs, one of which runs over a
//! wavy road.
//!
//! The left end stays on a line that turns by ψ(t) with the axle (cos ψ, sin ψ), where sin ψ = 0.1 sin 10t.

use super::first_order::FirstOrder;
use super::number::Number;

/// Mass of an end of the rod [kg] and free length of the springs [m]; stiffness and gravity are one.
const MASS: f64 = 10.0 * 1e-2 * 1e-2 / 2.0;
const FREE_LENGTH: f64 = 0.5;

/// The axle: cosine and sine of its angle, and the angle's first and second derivative.
struct Axle {
    unit: [f64; 2],
    rate: f64,
    acceleration: f64,
}

impl Axle {
    #[inline]
    fn new(t: f64) -> Self {
        let (wave, slope) = (10.0 * t).sin_cos();
        let sin = 0.1 * wave;
        let cos = (1.0 - sin * sin).sqrt();
        let rate = slope / cos;
        Self { unit: [cos, sin], rate, acceleration: (rate * rate - 100.0) * sin / cos }
    }

    /// Components of a vector along the axle and across it.
    fn components(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = self.unit;
        [cos * x + sin * y, cos * y - sin * x]
    }

    /// The vector that has these components.
    fn vector(&self, [along, across]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = self.unit;
        [cos * along - sin * across, cos * across + sin * along]
    }
}

/// Acceleration by a spring of length √`square`, for each metre.
#[inline]
fn spring<R: Number>(square: R) -> R {
    (square.sqrt().inverse() * FREE_LENGTH - 1.0) * MASS.recip()
}

/// Minimal coordinates: height of the left end above the axle, and angle of the rod with the axle.
#[derive(Clone, Copy)]
pub struct CarAxisReduced;

impl FirstOrder<4> for CarAxisReduced {
    #[inline]
    fn slope<R: Number>(t: f64, &[height, lean, climb, turn]: &[R; 4], slope: &mut [R; 4]) {
        let axle = Axle::new(t);
        let (sin, cos) = lean.sin_cos();
        let (along, across) = (cos - 1.0, height + sin);
        let right = spring(along * along + across * across);
        let (rate, square) = (turn + axle.rate, axle.rate * axle.rate);
        let [axle_cos, axle_sin] = axle.unit;
        let upward = sin * rate * rate + height * (2.0 * square) - (height - FREE_LENGTH) * MASS.recip()
            + right * across
            - 2.0 * axle_cos;
        let round = cos * height * square - sin * (climb * (2.0 * axle.rate) + height * axle.acceleration)
            + right * (sin + height * cos)
            + sin * axle_sin
            - cos * axle_cos;
        let inverse = (sin * sin + 1.0).inverse();
        *slope = [
            climb,
            turn,
            (upward - cos * round) * inverse,
            (round * 2.0 - cos * upward) * inverse - axle.acceleration,
        ];
    }

    fn begin(motion: &[f64]) -> [f64; 4] {
        let axle = Axle::new(0.0);
        let [x0, y0, x1, y1, u0, v0, u1, v1] = motion.try_into().expect("coordinates and velocities");
        let [_, height] = axle.components([x0, y0]);
        let [cos, sin] = axle.components([x1 - x0, y1 - y0]);
        let [_, climb] = axle.components([u0, v0]);
        let [back, up] = axle.components([u1 - u0, v1 - v0]);
        [height, sin.atan2(cos), climb, cos * up - sin * back - axle.rate]
    }

    fn motion(t: f64, &[height, lean, climb, turn]: &[f64; 4]) -> Vec<f64> {
        let axle = Axle::new(t);
        let ((sin, cos), rate) = (lean.sin_cos(), turn + axle.rate);
        let left = axle.vector([0.0, height]);
        let right = axle.vector([cos, height + sin]);
        let left_rate = axle.vector([-height * axle.rate, climb]);
        let right_rate = axle.vector([-height * axle.rate - sin * rate, climb + cos * rate]);
        [left, right, left_rate, right_rate].concat()
    }
}

/// Coordinates, velocities and both multipliers, the accelerations eliminated: index 1.
#[derive(Clone, Copy)]
pub struct CarAxisMultipliers;

impl FirstOrder<10> for CarAxisMultipliers {
    const ALGEBRAIC: usize = 2;

    #[inline]
    fn slope<R: Number>(t: f64, &[x0, y0, x1, y1, u0, v0, u1, v1, line, rod]: &[R; 10], slope: &mut [R; 10]) {
        let Axle { unit: [cos, sin], rate, acceleration } = Axle::new(t);
        let (dx, dy, du, dv) = (x0 - x1, y0 - y1, u0 - u1, v0 - v1);
        let (right_x, right_y) = (x1 - cos, y1 - sin);
        let left = spring(x0 * x0 + y0 * y0);
        let right = spring(right_x * right_x + right_y * right_y);
        let (line, rod) = (line * MASS.recip(), rod * (2.0 / MASS));
        let a = [
            left * x0 + line * cos + rod * dx,
            left * y0 + line * sin + rod * dy - 1.0,
            right * right_x - rod * dx,
            right * right_y - rod * dy - 1.0,
        ];
        // Derivatives of the axle's unit vector.
        let square = rate * rate;
        let (first, second) = (
            [-sin * rate, cos * rate],
            [-sin * acceleration - cos * square, cos * acceleration - sin * square],
        );
        *slope = [
            u0,
            v0,
            u1,
            v1,
            a[0],
            a[1],
            a[2],
            a[3],
            a[0] * cos + a[1] * sin + (u0 * first[0] + v0 * first[1]) * 2.0 + x0 * second[0] + y0 * second[1],
            dx * (a[0] - a[2]) + dy * (a[1] - a[3]) + du * du + dv * dv,
        ];
    }
}
