//! Springs and forces with a kink.

use lagrangian::Dual;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::all_close_on_largest;
use crate::support::difference::{derivative, moved};

/// N14: springs that differ on both sides, and a force that jumps.
struct Kinks {
    right: f64,
    left: f64,
    jump: f64,
}

#[lagrangian(coordinates = [spring, force], sensitivities = [self.right, self.left, self.jump])]
impl Kinks {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.spring * v.spring + v.force * v.force)
    }

    #[potential]
    fn stored(&self, q: &Coordinates) -> f64 {
        let stiffness = if q.spring > 0.0 { self.right } else { self.left };
        0.5 * stiffness * q.spring * q.spring + self.jump * q.force.abs()
    }
}

/// A bilinear oscillator from rest at x > 0.
fn swung<R: Ordered>(x: R, right: R, left: R, t: R) -> [R; 2] {
    let half = R::from_f64(0.5);
    let (mut place, mut from, mut sign, mut stiffness) = (x, R::zero(), R::one(), [right, left]);
    loop {
        let rate = stiffness[0].sqrt();
        let quarter = half * R::pi() / rate;
        if t <= from + quarter {
            let (sin, cos) = (rate * (t - from)).sin_cos();
            return [sign * place * cos, -(sign * place * rate * sin)];
        }
        // Through zero to the other side, and to the next turning point.
        let speed = place * rate;
        stiffness.reverse();
        let rate = stiffness[0].sqrt();
        let crossed = from + quarter;
        from = crossed + half * R::pi() / rate;
        place = speed / rate;
        sign = -sign;
        if t < from {
            let (sin, cos) = (rate * (t - crossed)).sin_cos();
            return [sign * place * sin, sign * speed * cos];
        }
    }
}

/// ẍ = −c sign x from rest at x > 0.
fn pushed<R: Ordered>(x: R, c: R, t: R) -> [R; 2] {
    let [half, two] = [0.5, 2.0].map(R::from_f64);
    let quarter = (two * x / c).sqrt();
    let (mut from, mut sign) = (R::zero(), R::one());
    while from + quarter < t {
        (from, sign) = (from + two * quarter, -sign);
    }
    let s = t - from;
    [sign * (x - half * c * s * s), -(sign * c * s)]
}

#[test]
fn kinks_have_the_derivatives_of_closed_forms() {
    let kinks = Kinks { right: 4.0, left: 9.0, jump: 1.3 };
    let varied = kinks.variational();
    let mut motion = varied.motion(State::at_rest([1.0, 0.8])).unwrap().with_tolerance(TIGHT);
    for t in [0.3, 1.0, 2.0, 5.0, 9.0, 20.0] {
        let found = motion.advance_to(t).unwrap();
        let number = |value, direction| Dual::<f64, 3>::variable(value, direction);
        let time = Dual::constant(t);
        let exact = swung(number(1.0, 0), number(4.0, 1), number(9.0, 2), time);
        let rows = [(found.q_by_q, found.q_by_p), (found.v_by_q, found.v_by_p)];
        for ((by_q, by_p), exact) in rows.iter().zip(exact) {
            all_close_on_largest([by_q[(0, 0)], by_p[(0, 0)], by_p[(0, 1)]], exact.slopes, 1e-11);
        }
        let number = |value, direction| Dual::<f64, 2>::variable(value, direction);
        let exact = pushed(number(0.8, 0), number(1.3, 1), Dual::constant(t));
        for ((by_q, by_p), exact) in rows.iter().zip(exact) {
            all_close_on_largest([by_q[(1, 1)], by_p[(1, 2)]], exact.slopes, 1e-11);
        }
    }
}

#[test]
fn kinks_have_the_derivatives_of_differences_by_velocities() {
    let kinks = Kinks { right: 4.0, left: 9.0, jump: 1.3 };
    let start = State::new([1.0, 0.8], [0.4, -0.3]);
    let found = kinks.variational().motion(start).unwrap().with_tolerance(TIGHT).advance_to(7.0).unwrap();
    for column in 0..4 {
        let by = derivative(1e-3, |by| {
            let end =
                *kinks.simulate(moved(&start, column, by)).with_tolerance(TIGHT).advance_to(7.0).unwrap();
            [end.q[0], end.q[1], end.v[0], end.v[1]]
        });
        let column: [f64; 4] = std::array::from_fn(|row| found.entry(row, column));
        all_close_on_largest(column, by, 1e-9);
    }
}
