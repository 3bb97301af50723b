//! Parts of T and balances of energy: S06, S13, S14, and forces.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, DIFFERENCES};
use crate::support::close::{all_close, close, close_on};
use crate::support::difference::{STEP, slope};
use crate::support::sample::Samples;

/// S06: a mass on springs in a rotating frame.
struct Frame {
    mass: f64,
    stiffness: [f64; 2],
    damping: f64,
    rate: f64,
    inertia: f64,
}

#[lagrangian(coordinates = [x, y], analysis)]
impl Frame {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let (along, across) = (v.x - self.rate * q.y, v.y + self.rate * q.x);
        0.5 * self.mass * (along.powi(2) + across.powi(2)) + 0.5 * self.inertia * self.rate.powi(2)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (self.stiffness[0] * q.x.powi(2) + self.stiffness[1] * q.y.powi(2))
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.x.powi(2)
    }
}

const FRAME: Frame = Frame { mass: 1.0, stiffness: [20.0, 30.0], damping: 0.4, rate: 2.0, inertia: 0.3 };

#[test]
fn the_rotating_frame_has_all_three_parts() {
    let state = State::new([0.1, -0.05], [0.7, 0.3]);
    let ([x, y], [vx, vy], rate) = (state.q, state.v, FRAME.rate);
    let (t2, t1, t0) = FRAME.kinetic_energy_parts(&state);
    close(t2, 0.5 * (vx * vx + vy * vy), CLOSED_FORM);
    close(t1, rate * (x * vy - y * vx), CLOSED_FORM);
    close(t0, 0.5 * rate * rate * (x * x + y * y) + 0.15 * rate * rate, CLOSED_FORM);
    all_close(FRAME.gyroscopic_matrix(&state), [0.0, 2.0 * rate, -2.0 * rate, 0.0], CLOSED_FORM);
    let forces = FRAME.inertia_forces(&state, &[5.0, 7.0]);
    all_close(forces.relative, [-5.0, -7.0], CLOSED_FORM);
    all_close(forces.coriolis, [0.0, 0.0], CLOSED_FORM);
    all_close(forces.gyroscopic, [2.0 * rate * vy, -2.0 * rate * vx], CLOSED_FORM);
    all_close(forces.transport, [rate * rate * x, rate * rate * y], CLOSED_FORM);
    // The damper takes from the Jacobi integral what it dissipates, and the motor feeds the energy.
    close(FRAME.jacobi_rate(&state), -0.4 * vx * vx, CLOSED_FORM);
    let along = |t: f64| {
        let a = FRAME.accelerations(&state).unwrap();
        let q = std::array::from_fn(|i| state.q[i] + t * state.v[i]);
        let v = std::array::from_fn(|i| state.v[i] + t * a[i]);
        FRAME.energy(&State::new(q, v))
    };
    close(FRAME.energy_rate(&state).unwrap(), slope(STEP, along), DIFFERENCES);
}

#[test]
fn without_damper_the_jacobi_integral_is_what_stays() {
    // Dissipation is part of the description, so the proof is not there, but the rate is zero.
    let calm = Frame { damping: 0.0, ..FRAME };
    assert_eq!(Frame::CONSERVED, [""; 0]);
    let mut samples = Samples::new(6);
    for _ in 0..20 {
        let state: State<f64, 2> = samples.state(-1.0, 1.0);
        close(calm.jacobi_rate(&state), 0.0, CLOSED_FORM);
        let (t2, _, t0) = calm.kinetic_energy_parts(&state);
        close(calm.jacobi_integral(&state), t2 - t0 + calm.potential_energy(&state), CLOSED_FORM);
    }
}

/// S13: a particle inside a hemisphere, the radius kept and constrained.
struct Hemisphere {
    mass: f64,
    radius: f64,
}

#[lagrangian(coordinates = [r, phi, theta], analysis)]
impl Hemisphere {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * self.mass
            * (v.r.powi(2) + q.r.powi(2) * (v.phi.powi(2) + q.phi.sin().powi(2) * v.theta.powi(2)))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.mass * q.r * q.phi.cos()
    }

    #[holonomic]
    fn bowl(&self, q: &Coordinates) -> f64 {
        q.r - self.radius
    }
}

#[test]
fn the_hemisphere_keeps_energy_and_the_momentum_about_the_vertical() {
    assert_eq!(Hemisphere::CYCLIC, ["theta"]);
    assert_eq!(Hemisphere::CONSERVED, ["energy", "momentum of theta"]);
    let bowl = Hemisphere { mass: 0.8, radius: 1.2 };
    let start = State::new([1.2, 2.2, 0.0], [0.0, 0.5, 1.8]);
    let expected = [-4.178369674229681, 1.3554427195936255];
    all_close(bowl.conserved(&start), expected, CLOSED_FORM);
    let mut motion = bowl.simulate(start).with_tolerance(1e-13);
    let end = motion.advance_to(5.0).unwrap();
    all_close(bowl.conserved(end), expected, 1e-11);
    close(bowl.energy_rate(end).unwrap(), 0.0, 1e-10);
}

/// S14: a bead on a hoop that whirls about its vertical diameter.
struct Hoop {
    mass: f64,
    radius: f64,
    rate: f64,
}

#[lagrangian(coordinates = [phi], analysis)]
impl Hoop {
    #[point(mass = self.mass)]
    fn bead(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        let ((sin_phi, cos_phi), (sin, cos)) = (q.phi.sin_cos(), (self.rate * t).sin_cos());
        self.radius * Vector3::new(sin_phi * cos, sin_phi * sin, cos_phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        9.81 * self.mass * self.bead(q, t).z
    }
}

#[test]
fn the_whirling_hoop_keeps_its_jacobi_integral() {
    assert_eq!(Hoop::CONSERVED, ["Jacobi integral"]);
    let hoop = Hoop { mass: 1.0, radius: 0.5, rate: 6.0 };
    let start = State::new([2.0], [0.3]);
    let mut motion = hoop.simulate(start).with_tolerance(1e-13);
    let later = *motion.advance_to(1.0).unwrap();
    let (phi, v) = (later.q[0], later.v[0]);
    // E′ = N R W sin φ with the sideways force N = m R W (2 φ′ cos φ).
    let sideways = 2.0 * 0.5 * 6.0 * v * phi.cos();
    close(sideways, 2.1223615591588994, 1e-10);
    close(hoop.energy_rate(&later).unwrap(), sideways * 0.5 * 6.0 * phi.sin(), 1e-10);
    close(hoop.jacobi_rate(&later), 0.0, CLOSED_FORM);
    let (t2, t1, t0) = hoop.kinetic_energy_parts(&start);
    close(t1, 0.0, CLOSED_FORM);
    close(t2 - t0 + hoop.potential_energy(&start), -5.75064838020686, CLOSED_FORM);
    all_close(hoop.conserved(motion.advance_to(5.0).unwrap()), [-5.75064838020686], 1e-11);
}

/// A driven pendulum with a motor and a moving support.
struct Driven {
    l: f64,
}

#[lagrangian(coordinates = [x, theta], inputs = [torque], analysis)]
impl Driven {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        Vector2::new(q.x + 0.1 * (3.0 * t).sin(), 0.0)
    }

    #[point(mass = 0.5)]
    fn bob(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        self.cart(q, t) + self.l * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        0.5 * 9.81 * self.bob(q, t).y + 0.2 * q.x * t
    }

    #[force(on = theta)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.torque
    }
}

#[test]
fn rates_of_the_energies_are_their_derivatives_along_the_motion() {
    let system = Driven { l: 0.8 };
    let mut samples = Samples::new(7);
    for _ in 0..10 {
        let (state, u): (State<f64, 2>, _) = (samples.state(-1.0, 1.0), [samples.number(-1.0, 1.0)]);
        let a = system.accelerations(&state, &u).unwrap();
        let at = |t: f64| {
            let q = std::array::from_fn(|i| state.q[i] + t * state.v[i]);
            let v = std::array::from_fn(|i| state.v[i] + t * a[i]);
            State::new(q, v).at_time(state.t + t)
        };
        let energy = slope(STEP, |t| system.energy(&at(t)));
        close_on(10.0, system.energy_rate(&state, &u).unwrap(), energy, DIFFERENCES);
        let jacobi = slope(STEP, |t| system.jacobi_integral(&at(t)));
        close_on(10.0, system.jacobi_rate(&state, &u), jacobi, DIFFERENCES);
    }
}

#[test]
fn certificates_are_given() {
    FRAME.verify().unwrap();
    Hemisphere { mass: 0.8, radius: 1.2 }.verify().unwrap();
    Hoop { mass: 1.0, radius: 0.5, rate: 6.0 }.verify().unwrap();
    Driven { l: 0.8 }.verify().unwrap();
}
