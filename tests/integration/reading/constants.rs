//! Constants are what Rust makes of them: casts of integers, remainders, signs.

use lagrangian::prelude::*;

/// A potential of one constant after the other, in double precision.
struct Double;

#[lagrangian(coordinates = [x])]
impl Double {
    const BIG: u64 = 123_456_789_012_345_678;
    const ODD: i64 = -9_007_199_254_740_993;

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn power(&self, q: &Coordinates) -> f64 {
        ((2_u64.pow(53) + 3) as f64 - 9_007_199_254_740_992.0) * q.x
    }

    #[potential]
    fn sums(&self, q: &Coordinates) -> f64 {
        ((Self::BIG + 9) as f64 - 123_456_789_012_345_600.0 + Self::beyond(Self::ODD)) * q.x
    }

    fn beyond(n: i64) -> f64 {
        n as f64 + 9_007_199_254_740_992.0
    }

    #[potential]
    fn remainders(&self, q: &Coordinates) -> f64 {
        (7.5 % 2.0 + -7.5 % 2.0 * 10.0 + (-7.5_f64).rem_euclid(2.0) * 100.0 + (-7.5_f64).div_euclid(2.0))
            * q.x
    }

    #[potential]
    fn signs(&self, q: &Coordinates) -> f64 {
        (0.75_f64.fract() + 3.0_f64.copysign(-1.0) * 10.0 + (0.3 - 0.1 * 3.0_f64).signum() * 100.0) * q.x
    }

    #[potential]
    fn advice(&self, q: &Coordinates) -> f64 {
        let (a, b) = (q.x > 0.0, q.x > 1.0);
        let turned = Rotation3::from_axis_angle(&Vector3::y_axis(), q.x);
        let doubled = *turned.matrix() * 2.0;
        let crossed = if (a && !b) || (!a && b) { 1.0 } else { 0.0 };
        crossed * q.x + turned.matrix().m31 + turned.matrix().trace() + doubled.m11 + f64::from(true)
    }
}

#[test]
fn constants_of_doubles_are_those_of_the_functions() {
    for x in [0.5, -0.25, 1.5] {
        let q = DoubleCoordinates::from([x]);
        let parts =
            [Double.power(&q), Double.sums(&q), Double.remainders(&q), Double.signs(&q), Double.advice(&q)];
        let (found, expected) = (Double.potential_energy(&State::at_rest([x])), parts.iter().sum::<f64>());
        assert!((found - expected).abs() <= 1e-13, "{found} instead of {expected} at {x}");
        assert!(Double.accelerations(&State::at_rest([x])).is_ok());
    }
}

/// The same in single precision.
struct Single;

#[lagrangian(coordinates = [x])]
impl Single {
    const BIG: u64 = 123_456_789_012_345_678;

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f32 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn casts(&self, q: &Coordinates) -> f32 {
        let [up, down] = [16_777_219_u32 as f32 - 16_777_216.0, (-16_777_221_i32) as f32 + 16_777_216.0];
        (up + 10.0 * down + Self::BIG as f32 * 1e-17) * q.x
    }

    #[potential]
    fn remainders(&self, q: &Coordinates) -> f32 {
        (7.5 % 2.0 + 9.81_f32.fract() + 1.0_f32.div_euclid(0.1) + (-0.3_f32).rem_euclid(0.25)) * q.x
    }
}

#[test]
fn constants_of_singles_are_those_of_the_functions() {
    let q = SingleCoordinates::from([1.0]);
    let found = Single.potential_energy(&State::at_rest([1.0]));
    let expected = Single.casts(&q) + Single.remainders(&q);
    assert!((found - expected).abs() <= 1e-5, "{found} instead of {expected}");
}
