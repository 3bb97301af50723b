//! Every elementary function: V = Σ fᵢ(xᵢ) has the force −fᵢ′(xᵢ) on coordinate i.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::difference::slope;
use crate::support::sample::Samples;

const COUNT: usize = 36;

struct Functions {
    exponent: f64,
}

#[lagrangian(coordinates = [x: [36]])]
impl Functions {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.iter().map(|v| v * v).sum::<f64>()
    }

    #[potential]
    fn sum(&self, q: &Coordinates) -> f64 {
        self.values(q).iter().sum()
    }

    /// Arguments lie in (0.2, 0.8).
    fn values(&self, q: &Coordinates) -> [f64; 36] {
        let x = &q.x;
        let (sine, cosine) = x[16].sin_cos();
        [
            x[0].sin(),
            x[1].cos(),
            x[2].tan(),
            x[3].asin(),
            x[4].acos(),
            x[5].atan(),
            x[6].sinh(),
            x[7].cosh(),
            x[8].tanh(),
            x[9].asinh(),
            (1.0 + x[10]).acosh(),
            x[11].atanh(),
            x[12].exp(),
            x[13].exp_m1(),
            x[14].ln(),
            x[15].ln_1p(),
            sine * cosine * cosine,
            x[17].cbrt(),
            (x[18] - 0.9).abs() * x[18],
            x[19].sqrt(),
            x[20].powi(-3),
            x[21].powi(5),
            x[22].powf(1.7),
            x[23].powf(self.exponent),
            2.0_f64.powf(x[24]),
            x[25].exp2(),
            x[26].log2(),
            x[27].log10(),
            x[28].log(3.0),
            x[29].atan2(0.5),
            1.5_f64.atan2(x[30] - 0.5),
            x[31].hypot(2.0 * x[31] - 1.0),
            x[32].recip(),
            x[33].mul_add(x[33], 2.0) * x[33].signum(),
            (100.0 * x[34]).to_radians().sin(),
            x[35] / (1.0 + x[35] / (2.0 + x[35] * x[35])) - 3.0 * x[35],
        ]
    }
}

const FUNCTIONS: Functions = Functions { exponent: -0.3 };

#[test]
fn values_are_the_users_own() {
    let mut samples = Samples::new(1);
    for _ in 0..20 {
        let state: State<f64, COUNT> = samples.state(0.2, 0.8);
        let expected: f64 = FUNCTIONS.values(&state.q.into()).iter().sum();
        close(FUNCTIONS.potential_energy(&state), expected, 1e-14);
    }
}

#[test]
fn forces_are_the_negative_derivatives() {
    let mut samples = Samples::new(2);
    for _ in 0..20 {
        let state: State<f64, COUNT> = samples.state(0.2, 0.8);
        let along = |i: usize| {
            slope(0.001, |h| {
                let mut q = state.q;
                q[i] += h;
                FUNCTIONS.values(&q.into())[i]
            })
        };
        let expected: [f64; COUNT] = std::array::from_fn(along);
        all_close(FUNCTIONS.bias(&state), expected, 1e-10);
        all_close(FUNCTIONS.accelerations(&state).unwrap(), expected.map(|x| -x), 1e-10);
    }
}

#[test]
fn forces_are_also_right_to_the_last_digits() {
    let state = State::at_rest([0.6; COUNT]);
    let x: f64 = 0.6;
    let bias = FUNCTIONS.bias(&state);
    for (i, expected) in [
        (0, x.cos()),
        (2, 1.0 / x.cos().powi(2)),
        (3, 1.0 / (1.0 - x * x).sqrt()),
        (4, -1.0 / (1.0 - x * x).sqrt()),
        (8, 1.0 / x.cosh().powi(2)),
        (10, 1.0 / ((1.0 + x).powi(2) - 1.0).sqrt()),
        (15, 1.0 / 1.6),
        (17, x.powf(-2.0 / 3.0) / 3.0),
        (18, 0.9 - 2.0 * x),
        (20, -3.0 * x.powi(-4)),
        (23, -0.3 * x.powf(-1.3)),
        (24, 2.0_f64.ln() * 2.0_f64.powf(x)),
        (29, 0.5 / (0.25 + x * x)),
        (32, -1.0 / (x * x)),
    ] {
        close(bias[i], expected, 1e-14);
    }
}
