//! Inputs in the laws of contacts and in what switches: a pedal, a clutch, a drive that saturates.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close;

struct Brake {
    inertia: f64,
}

#[lagrangian(coordinates = [angle], inputs = [pedal, drive])]
impl Brake {
    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        0.5 * self.inertia * v.angle * v.angle
    }

    #[force(on = angle)]
    fn engine(&self, u: &Inputs) -> f64 {
        u.drive
    }

    fn grip(&self, u: &Inputs) -> f64 {
        2.0 * u.pedal
    }

    fn hold(&self, u: &Inputs) -> f64 {
        3.0 * u.pedal
    }

    #[friction(limit = grip, static_limit = hold)]
    fn pads(&self, v: &Velocities) -> f64 {
        v.angle
    }
}

#[test]
fn a_pedal_limits_a_brake() {
    let brake = Brake { inertia: 2.0 };
    let mut motion = brake.simulate(State::new([0.0], [5.0])).with_tolerance(TIGHT).with_inputs([0.5, 0.0]);
    // 2 v' = −1.
    close(motion.advance_to(4.0).unwrap().v[0], 3.0, 1e-14);
    close(motion.state().q[0], 16.0, 1e-14);
    // 2 v' = −4: it stops after 1.5 s.
    motion.set_inputs([2.0, 0.0]);
    let stop = motion.advance_to_switch(10.0).unwrap().expect("it stops").state.t;
    close(stop, 5.5, 1e-14);
    close(motion.state().q[0], 18.25, 1e-14);
    // The engine is held as long as its torque is less than 3 · 2.
    motion.set_inputs([2.0, 5.0]);
    close(motion.advance_to(7.0).unwrap().q[0], 18.25, 1e-14);
    assert_eq!(motion.state().v[0], 0.0);
    // 2 v' = 5 − 3: the static limit is 4.5.
    motion.set_inputs([1.5, 5.0]);
    close(motion.advance_to(9.0).unwrap().v[0], 2.0, 1e-14);
    close(motion.state().q[0], 20.25, 1e-14);
}

#[test]
fn a_limit_below_zero_is_refused_when_it_is_given() {
    let brake = Brake { inertia: 2.0 };
    let mut motion = brake.simulate(State::new([0.0], [5.0])).with_inputs([0.5, 0.0]);
    motion.advance_to(1.0).unwrap();
    motion.set_inputs([-0.5, 0.0]);
    let Cause::InvalidContact { name, .. } = motion.advance_to(2.0).unwrap_err().cause else { panic!() };
    assert_eq!(name.as_str(), "pads");
}

struct Puck;

#[lagrangian(coordinates = [y], inputs = [bounce])]
impl Puck {
    #[point(mass = 2.0)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(0.0, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        20.0 * q.y
    }

    fn restitution(&self, u: &Inputs) -> f64 {
        u.bounce
    }

    #[unilateral(restitution = restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

#[test]
fn an_input_gives_a_restitution() {
    for bounce in [0.25, 0.5] {
        let mut motion = Puck.simulate(State::at_rest([5.0])).with_tolerance(TIGHT).with_inputs([bounce]);
        let impact = motion.advance_to_switch(2.0).unwrap().expect("it lands");
        close(impact.before.v[0], -10.0, 1e-14);
        close(impact.state.v[0], 10.0 * bounce, 1e-14);
    }
}

/// v' = 2 (demand − v), at most 1 in size.
struct Saturated;

#[lagrangian(coordinates = [x], inputs = [demand], jacobians)]
impl Saturated {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn drive(&self, v: &Velocities, u: &Inputs) -> f64 {
        (2.0 * (u.demand - v.x)).clamp(-1.0, 1.0)
    }
}

#[test]
fn a_drive_saturates() {
    let mut motion = Saturated.simulate(State::at_rest([0.0])).with_tolerance(TIGHT).with_inputs([3.0]);
    close(motion.advance_to(2.0).unwrap().v[0], 2.0, 1e-13);
    // It is saturated until v = 2.5.
    let fast = 3.0 - 0.5 * (-3.0_f64).exp();
    close(motion.advance_to(4.0).unwrap().v[0], fast, 1e-13);
    motion.set_inputs([0.0]);
    // Until v = 0.5.
    let slow = 0.5 * (-2.0 * (7.0 - (4.0 + fast - 0.5))).exp();
    close(motion.advance_to(7.0).unwrap().v[0], slow, 1e-12);
}

#[test]
fn a_saturated_drive_has_derivatives() {
    // Saturation ends at 2.5 − v₀, so that v(4) = 3 − exp(−2 (1.5 + v₀)) / 2.
    let varied = Saturated.variational();
    let mut motion = varied.motion(State::at_rest([0.0])).unwrap().with_tolerance(TIGHT).with_inputs([3.0]);
    let end = motion.advance_to(4.0).unwrap();
    close(end.state.v[0], 3.0 - 0.5 * (-3.0_f64).exp(), 1e-13);
    close(end.v_by_v[0], (-3.0_f64).exp(), 1e-12);
}

#[test]
fn fixed_steps_take_the_inputs_too() {
    let brake = Brake { inertia: 2.0 };
    let mut motion = brake.stepper::<Jet<6>>(State::new([0.0], [5.0]));
    (0..40).for_each(|_| motion.step(0.1, &[0.5, 0.0]).map(|_| ()).unwrap());
    (0..20).for_each(|_| motion.step(0.1, &[2.0, 0.0]).map(|_| ()).unwrap());
    close(motion.state().q[0], 18.25, 1e-13);
    assert_eq!(motion.state().v[0], 0.0);
}
