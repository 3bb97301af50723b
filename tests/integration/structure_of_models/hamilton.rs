//! The Hamiltonian form.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, DIFFERENCES};
use crate::support::close::{all_close, close, close_on};
use crate::support::difference::{STEP, slope};
use crate::support::sample::Samples;

/// A pendulum on a cart that a motor pushes, in a frame that turns.
struct Cart {
    rate: f64,
}

#[lagrangian(coordinates = [x, theta], inputs = [push], analysis)]
impl Cart {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        let (sin, cos) = (self.rate * t).sin_cos();
        q.x * Vector3::new(cos, sin, 0.0) + Vector3::new(-0.3 * sin, 0.3 * cos, 0.0)
    }

    #[point(mass = 0.3)]
    fn bob(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        let (sin, cos) = (self.rate * t).sin_cos();
        self.cart(q, t) + 0.7 * Vector3::new(q.theta.sin() * cos, q.theta.sin() * sin, -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        9.81 * 0.3 * self.bob(q, t).z + q.x.powi(2) * (1.0 + 0.1 * t)
    }

    #[force(on = x)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.push
    }
}

#[test]
fn legendres_transformation_goes_both_ways() {
    let cart = Cart { rate: 1.3 };
    let mut samples = Samples::new(9);
    for _ in 0..20 {
        let state: State<f64, 2> = samples.state(-1.0, 1.0);
        let p = cart.momenta(&state);
        all_close(cart.velocities_from_momenta(state.t, &state.q, &p).unwrap(), state.v, CLOSED_FORM);
        let product: f64 = p.iter().zip(state.v).map(|(p, v)| p * v).sum();
        let (t2, t1, t0) = cart.kinetic_energy_parts(&state);
        let lagrangian = t2 + t1 + t0 - cart.potential_energy(&state);
        close_on(10.0, cart.hamiltonian(state.t, &state.q, &p).unwrap(), product - lagrangian, CLOSED_FORM);
    }
}

#[test]
fn canonical_equations_are_derivatives_of_the_hamiltonian() {
    let cart = Cart { rate: 1.3 };
    let mut samples = Samples::new(10);
    for _ in 0..20 {
        let (state, push): (State<f64, 2>, f64) = (samples.state(-1.0, 1.0), samples.number(-1.0, 1.0));
        let State { t, q, v } = state;
        let p = cart.momenta(&state);
        let (q_rate, p_rate) = cart.canonical_at(t, &q, &p, &[push]).unwrap();
        all_close(q_rate, v, CLOSED_FORM);
        for i in 0..2 {
            let by_p = slope(STEP, |x| {
                let mut p = p;
                p[i] += x;
                cart.hamiltonian(t, &q, &p).unwrap()
            });
            close_on(3.0, q_rate[i], by_p, DIFFERENCES);
            let by_q = slope(STEP, |x| {
                let mut q = q;
                q[i] += x;
                cart.hamiltonian(t, &q, &p).unwrap()
            });
            let force = if i == 0 { push } else { 0.0 };
            close_on(10.0, p_rate[i], force - by_q, DIFFERENCES);
        }
    }
}

/// A relativistic charge: momenta are not affine in the velocities.
struct Relativistic {
    c: f64,
}

#[lagrangian(coordinates = [x, y], analysis)]
impl Relativistic {
    #[lagrangian]
    fn particle(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let speed = v.x.powi(2) + v.y.powi(2);
        -self.c.powi(2) * (1.0 - speed / self.c.powi(2)).sqrt() + 0.5 * (q.x * v.y - q.y * v.x)
    }
}

#[test]
fn the_relativistic_hamiltonian_is_that_of_the_textbook() {
    let system = Relativistic { c: 2.0 };
    let mut samples = Samples::new(11);
    for _ in 0..20 {
        let state: State<f64, 2> = samples.state(-1.3, 1.3);
        let p = system.momenta(&state);
        all_close(system.velocities_from_momenta(0.0, &state.q, &p).unwrap(), state.v, 1e-11);
        let kinetic = [p[0] + 0.5 * state.q[1], p[1] - 0.5 * state.q[0]];
        let expected = 2.0 * (4.0 + kinetic[0].powi(2) + kinetic[1].powi(2)).sqrt();
        close(system.hamiltonian(0.0, &state.q, &p).unwrap(), expected, CLOSED_FORM);
    }
    assert_eq!(Relativistic::CONSERVED, ["energy", "angular momentum in the x–y plane"]);
}

/// A bead on a wire: constraint forces change momenta.
struct Wire;

#[lagrangian(coordinates = [x, y], analysis)]
impl Wire {
    #[point(mass = 2.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        19.62 * q.y
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        q.y - q.x.powi(2)
    }
}

#[test]
fn reactions_are_part_of_the_canonical_equations() {
    let state = State::new([0.5, 0.25], [0.8, 0.8]);
    let p = Wire.momenta(&state);
    let (q_rate, p_rate) = Wire.canonical_at(0.0, &state.q, &p).unwrap();
    let a = Wire.accelerations(&state).unwrap();
    all_close(q_rate, state.v, CLOSED_FORM);
    all_close(p_rate, a.map(|a| 2.0 * a), CLOSED_FORM);
}

#[test]
fn a_singular_transformation_is_an_error() {
    let system = Relativistic { c: 2.0 };
    let error = system.velocities_from_momenta(1.5, &[0.0, 0.0], &[f64::NAN, 0.0]).unwrap_err();
    assert_eq!(error.t, 1.5);
}

#[test]
fn certificates_are_given() {
    Cart { rate: 1.3 }.verify().unwrap();
    Relativistic { c: 2.0 }.verify().unwrap();
    Wire.verify().unwrap();
}
