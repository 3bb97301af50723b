//! Every smooth function of the language in the place of an energy, an inertia and a force.

use lagrangian::prelude::*;

use super::oracle::agrees;
use crate::support::close::close;
use crate::support::motion::drift;
use crate::support::sample::Samples;

/// Springs hold the coordinates in (0.1, 0.9), where every function is defined.
struct Potentials {
    exponent: f64,
    stiffness: f64,
}

#[lagrangian(coordinates = [x: [41]])]
impl Potentials {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.iter().map(|v| v * v).sum::<f64>()
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x.iter().map(|x| (x - 0.5).powi(2)).sum::<f64>()
    }

    #[potential]
    fn functions(&self, q: &Coordinates) -> f64 {
        self.values(q).iter().sum()
    }

    fn values(&self, q: &Coordinates) -> [f64; 41] {
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
            0.1 * x[14].ln(),
            x[15].ln_1p(),
            sine * cosine * cosine,
            x[17].cbrt(),
            x[18].powf(2.5),
            x[19].sqrt(),
            0.01 * x[20].powi(-3),
            x[21].powi(5),
            x[22].powf(1.7),
            0.1 * x[23].powf(self.exponent),
            2.0_f64.powf(x[24]),
            x[25].exp2(),
            0.1 * x[26].log2(),
            0.1 * x[27].log10(),
            0.1 * x[28].log(3.0),
            x[29].atan2(0.5),
            1.5_f64.atan2(x[30] - 0.5),
            x[31].hypot(2.0 * x[31] - 1.0),
            0.1 * x[32].recip(),
            x[33].powf(x[33]),
            (100.0 * x[34]).to_radians().sin(),
            x[35] / (1.0 + x[35] / (2.0 + x[35] * x[35])) - 3.0 * x[35],
            x[36].exp().sin(),
            (1.0 + x[37] * x[37] + x[36].sqrt()).sqrt(),
            x[38].cosh().ln(),
            x[39].powf(1.5 + x[40]) * x[38],
            x[40].sin().atan2(x[39] + x[0] * x[1]),
        ]
    }
}

#[test]
fn every_function_in_a_potential() {
    let system = Potentials { exponent: -0.3, stiffness: 40.0 };
    let mut samples = Samples::new(3);
    let start = State { t: 0.0, ..samples.state::<41>(0.4, 0.6) };
    agrees(&system, start, [], 2.0, 2e-12);
    let mut motion = system.simulate(start).with_tolerance(1e-15);
    let energy = motion.energy();
    assert!(drift(&mut motion, 0.5, 20, |s| system.energy(s)) < 1e-13 * energy.abs().max(1.0));
}

/// Inertias that depend on a coordinate, one function each, and a dense one.
struct Inertias {
    exponent: f64,
    stiffness: f64,
}

#[lagrangian(coordinates = [x: [17], y, z])]
impl Inertias {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let x = &q.x;
        let inertias = [
            2.0 + x[0].sin() * x[1].cos(),
            1.0 + x[1].tan(),
            2.0 + x[2].asin() + x[3].acos(),
            1.0 + x[3].atan(),
            1.0 + x[4].sinh(),
            x[5].cosh(),
            1.0 + x[6].tanh(),
            1.0 + x[7].asinh(),
            (1.0 + x[8]).acosh(),
            1.0 + x[9].atanh(),
            x[10].exp(),
            2.0 + x[11].exp_m1(),
            3.0 + x[12].ln() + x[12].ln_1p(),
            x[13].cbrt() + x[13].sqrt(),
            x[14].powi(-2) + x[14].powf(self.exponent),
            1.0 + x[15].atan2(x[14]).powi(2),
            x[16].hypot(x[15]).recip(),
        ];
        let alone = (0..17).map(|i| 0.5 * inertias[i] * v.x[i].powi(2)).sum::<f64>();
        let (a, b) = ((q.y * q.z).sin(), (q.y - q.z).exp());
        alone + 0.5 * (v.y + a * v.z).powi(2) + 0.5 * (b * v.z + 0.3 * v.x[0]).powi(2) + 0.1 * v.y.powi(2)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let all = q.x.iter().map(|x| (x - 0.5).powi(2)).sum::<f64>();
        0.5 * self.stiffness * (all + (q.y - 0.5).powi(2) + (q.z - 0.5).powi(2))
    }
}

#[test]
fn every_function_in_an_inertia() {
    let system = Inertias { exponent: 1.3, stiffness: 40.0 };
    let mut samples = Samples::new(4);
    let start = State { t: 0.0, ..samples.state::<19>(0.4, 0.6) };
    agrees(&system, start, [], 2.0, 1e-11);
    let mut motion = system.simulate(start).with_tolerance(1e-15);
    let energy = motion.energy();
    assert!(drift(&mut motion, 0.5, 20, |s| system.energy(s)) < 1e-13 * energy.abs());
}

/// Forces that depend on velocities, time and inputs, and a dissipation.
struct Forces {
    c: f64,
    omega: f64,
    exponent: f64,
}

#[lagrangian(coordinates = [x: [10]], inputs = [push, gain])]
impl Forces {
    #[kinetic]
    fn kinetic(&self, v: &Velocities, t: f64) -> f64 {
        let inertia = 2.0 + (-t).exp() * (self.omega * t).sin() + 0.1 * t * t;
        0.5 * inertia * v.x[0].powi(2) + 0.5 * v.x.iter().map(|v| v * v).sum::<f64>()
    }

    #[potential]
    fn springs(&self, q: &Coordinates, t: f64) -> f64 {
        let stiffness = 3.0 + (self.omega * t).cos() + (1.0 + t * t).sqrt().recip();
        0.5 * stiffness * q.x.iter().map(|x| x * x).sum::<f64>()
    }

    #[dissipation]
    fn dashpot(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.1 * self.c * (1.0 + q.x[0].powi(2)) * (v.x[0] - v.x[1]).powi(2) + self.c * v.x[9].powi(4)
    }

    #[force]
    fn forces(&self, q: &Coordinates, v: &Velocities, t: f64, u: &Inputs) -> [f64; 10] {
        let v = &v.x;
        [
            -self.c * v[0].tanh(),
            -self.c * v[1].atan() + u.push * t.sin(),
            -self.c * (1.0 + v[2] * v[2]).sqrt() * v[2],
            -v[3].sin().exp() * v[3].asinh() + u.gain * q.x[3],
            -(v[4] * v[4] + v[5] * v[5] + 0.01).powf(0.7) * v[4],
            (u.gain * v[5]).sin() - v[5].cosh().ln() * v[5] + (t * t).cos(),
            -v[6].sinh() * u.push.powi(2) + (0.5 + t).ln(),
            (2.0 + v[7]).powf(self.exponent) - (2.0 + v[7]).cbrt() + t.powi(3) * 0.01,
            -v[8].exp_m1() + (3.0 + v[8]).ln_1p() * (1.0 + t).powf(u.gain),
            (v[9] * u.push).atan2(2.0 + q.x[9]) + v[9].hypot(1.0) - (3.0 + v[9]).powi(-2),
        ]
    }
}

#[test]
fn every_function_in_a_force() {
    let system = Forces { c: 0.7, omega: 2.0, exponent: 0.37 };
    let mut samples = Samples::new(5);
    for inputs in [[0.8, 0.6], [0.0, 0.0], [-0.5, -1.2]] {
        let start = State { t: 0.3, ..samples.state::<10>(-0.5, 0.5) };
        agrees(&system, start, inputs, 2.0, 1e-11);
    }
}

/// A relativistic charge in a magnetic field: the Lagrangian is no polynomial of the velocity.
struct Charge {
    c: f64,
    field: f64,
    stiffness: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Charge {
    #[lagrangian]
    fn lagrangian(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let beta = (v.x.powi(2) + v.y.powi(2)) / self.c.powi(2);
        let rest = -self.c.powi(2) * (1.0 - beta).sqrt();
        rest + 0.5 * self.field * (q.x * v.y - q.y * v.x) - 0.5 * self.stiffness * (q.x.powi(2) + q.y.powi(2))
    }
}

#[test]
fn a_relativistic_charge_gyrates_at_its_own_frequency() {
    let (c, field, speed) = (2.0_f64, 1.5, 1.2_f64);
    let charge = Charge { c, field, stiffness: 0.0 };
    let gamma = (1.0 - (speed / c).powi(2)).sqrt().recip();
    let (omega, radius) = (field / gamma, gamma * speed / field);
    let start = State::new([0.0, radius], [speed, 0.0]);
    agrees(&charge, start, [], 10.0, 1e-12);
    let mut motion = charge.simulate(start).with_tolerance(1e-15);
    for t in [0.5, 3.0, 100.0] {
        let state = motion.advance_to(t).unwrap();
        close(state.q[0], radius * (omega * t).sin(), 1e-13 * (10.0 + omega * t));
        close(state.q[1], radius * (omega * t).cos(), 1e-13 * (10.0 + omega * t));
        close(state.v[0], speed * (omega * t).cos(), 1e-13 * (10.0 + omega * t));
    }
}

#[test]
fn a_relativistic_oscillator_keeps_energy_and_angular_momentum() {
    let charge = Charge { c: 1.5, field: 0.4, stiffness: 1.0 };
    let start = State::new([0.3, 0.8], [1.1, -0.4]);
    agrees(&charge, start, [], 5.0, 1e-11);
    let mut motion = charge.simulate(start).with_tolerance(1e-15);
    let momentum = |s: &State<f64, 2>| {
        let p = charge.momenta(s);
        s.q[0] * p[1] - s.q[1] * p[0]
    };
    assert!(drift(&mut motion, 1.0, 50, |s| charge.energy(s)) < 5e-13);
    let mut motion = charge.simulate(start).with_tolerance(1e-15);
    assert!(drift(&mut motion, 1.0, 50, momentum) < 5e-13);
}

/// Drag by roots and powers of the speed, which have no series at rest.
struct Drag;

#[lagrangian(coordinates = [x, y])]
impl Drag {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2))
    }

    #[force(on = x)]
    fn resistance(&self, v: &Velocities) -> f64 {
        1.0 - (v.x.powi(2) + v.y.powi(2)).powf(0.85)
    }
}

struct CubeRoot;

#[lagrangian(coordinates = [x, y])]
impl CubeRoot {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2))
    }

    #[force(on = x)]
    fn root(&self, v: &Velocities) -> f64 {
        1.0 - v.x.cbrt()
    }
}

#[test]
fn a_power_of_a_speed_that_may_be_zero_is_not_smooth() {
    fn by_runge_kutta<S: System<2, 0, Scalar = f64, Method = Dop853>>(system: &S) {
        let mut motion = system.simulate(State::at_rest([0.0; 2]));
        assert!(motion.advance_to(1.0).unwrap().q[0] > 0.1);
    }
    by_runge_kutta(&Drag);
    by_runge_kutta(&CubeRoot);
}

/// A step of the potential by 1/(1 + eˣ): beyond 709 widths the exponential overflows and the quotient is
/// zero.
struct Step {
    width: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Step {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn step(&self, q: &Coordinates) -> f64 {
        1.0 / (1.0 + (-q.x / self.width).exp())
    }
}

#[test]
fn a_step_of_a_potential_begins_and_ends_where_its_exponential_overflows() {
    for width in [0.03, 0.01] {
        let step = Step { width };
        for (place, speed) in [(-30.0, 3.0), (30.0, -1.0), (-30.0, 1.0)] {
            let start = State::new([place], [speed]);
            let end = *step.simulate(start).with_tolerance(1e-13).advance_to(80.0).unwrap();
            // Up the step, down it, and back from it where the energy does not suffice.
            let after = match (place < 0.0, speed * speed > 2.0) {
                (true, true) => f64::sqrt(speed * speed - 2.0),
                (true, false) => -speed,
                (false, _) => -f64::sqrt(speed * speed + 2.0),
            };
            close(end.v[0], after, 1e-11);
            let varied = step.variational();
            let found = varied.motion(start).unwrap().with_tolerance(1e-13).advance_to(80.0).unwrap();
            close(found.v_by_v[(0, 0)], speed / after, 1e-10);
        }
    }
}
