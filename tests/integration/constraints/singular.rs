//! Configurations in which constraints lose their independence, and systems that constraints leave no motion.

use std::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

use crate::support::close::{all_close, close, close_on};

/// A slider-crank with equal links: at the dead centre, with both links upright, one more motion is possible.
struct Slider {
    l: f64,
}

#[lagrangian(coordinates = [a, b, s])]
impl Slider {
    #[point(mass = 1.0)]
    fn knee(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a.cos(), q.a.sin()) * self.l
    }

    #[point(mass = 1.0)]
    fn piston(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.s, 0.0)
    }

    #[kinetic]
    fn rod(&self, v: &Velocities) -> f64 {
        0.05 * v.b * v.b
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        (Vector2::new(q.a.cos(), q.a.sin()) + Vector2::new(q.b.cos(), q.b.sin())) * self.l - self.piston(q)
    }
}

/// A parallelogram with a third crank, which is redundant; flat, it could fold.
struct Parallelogram {
    l: f64,
    a: f64,
}

#[lagrangian(coordinates = [t1, t2, t3, x, y, phi], allow(redundant))]
impl Parallelogram {
    #[kinetic]
    fn cranks(&self, v: &Velocities) -> f64 {
        0.15 * (v.t1.powi(2) + v.t2.powi(2) + v.t3.powi(2))
    }

    #[body(mass = 2.0, inertia = 0.4)]
    fn coupler(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        19.62 * q.y
    }

    fn pin(&self, q: &Coordinates, turn: f64, at: f64) -> Vector2<f64> {
        Vector2::new(q.x, q.y) + Vector2::new(q.phi.cos(), q.phi.sin()) * at
            - Vector2::new(at + self.l * turn.cos(), self.l * turn.sin())
    }

    #[holonomic]
    fn pins(&self, q: &Coordinates) -> [f64; 6] {
        let (p, r, s) = (self.pin(q, q.t1, -self.a), self.pin(q, q.t2, self.a), self.pin(q, q.t3, 0.0));
        [p.x, p.y, r.x, r.y, s.x, s.y]
    }
}

/// A bar that cannot move.
struct Held {
    m: f64,
}

#[lagrangian(coordinates = [x, y, turn])]
impl Held {
    #[body(mass = self.m, inertia = self.m / 12.0)]
    fn bar(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.m * q.y
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y) - 0.5 * Vector2::new(q.turn.cos(), q.turn.sin())
    }

    #[holonomic]
    fn angle(&self, q: &Coordinates) -> f64 {
        q.turn - 0.3
    }
}

/// A beam on three supports.
struct Beam;

#[lagrangian(coordinates = [x, y, turn], allow(redundant))]
impl Beam {
    #[body(mass = 2.0, inertia = 0.4)]
    fn beam(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * 2.0 * q.y
    }

    #[holonomic]
    fn supports(&self, q: &Coordinates) -> [f64; 3] {
        [q.y - 0.7 * q.turn.sin(), q.y, q.y + 0.3 * q.turn.sin()]
    }

    #[holonomic]
    fn end(&self, q: &Coordinates) -> f64 {
        q.x
    }
}

#[test]
fn a_slider_crank_passes_its_dead_centre_at_any_tolerance() {
    let slider = Slider { l: 1.0 };
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13] {
        for k in 0..20 {
            let speed = 0.55 + 0.25 * f64::from(k);
            let start =
                slider.consistent(State::new([1.0, -1.0, 1.08], [speed, -speed, 0.0])).expect("a start");
            let mut motion = slider.simulate(start).with_tolerance(tolerance);
            let end = *motion.advance_to(3.0).expect("a motion");
            let energy = slider.energy(&start);
            close(slider.energy(&end) / energy, 1.0, 1e-6);
            // The motion goes straight on and takes no corner.
            close((end.q[0] + end.q[1]).sin(), 0.0, 1e-5);
            close((end.v[0] + end.v[1]) / speed, 0.0, 1e-5);
        }
    }
}

#[test]
fn other_methods_lose_no_energy_in_silence() {
    let slider = Slider { l: 1.0 };
    for k in 0..20 {
        let speed = 0.5 + 0.25 * f64::from(k);
        let start = slider.consistent(State::new([1.0, -1.0, 1.08], [speed, -speed, 0.0])).expect("a start");
        for tolerance in [1e-10, 1e-12] {
            let mut motion = slider.simulate_with::<Dop853>(start).with_tolerance(tolerance);
            match motion.advance_to(2.0) {
                Ok(end) => close(slider.energy(end) / slider.energy(&start), 1.0, 1e-6),
                Err(error) => {
                    assert!(
                        matches!(
                            error.cause,
                            Cause::ToleranceTooFine { .. } | Cause::StepTooSmall | Cause::Undetermined { .. }
                        ),
                        "{error}"
                    )
                }
            }
        }
    }
}

#[test]
fn a_motion_may_begin_in_the_dead_centre() {
    let slider = Slider { l: 1.0 };
    for v in [[1.0, 1.0, 0.0], [1.0, -1.0, -2.0]] {
        let start = State::new([FRAC_PI_2, -FRAC_PI_2, 0.0], v);
        let found = slider.consistent(start).expect("a start");
        all_close(found.q, start.q, 1e-12);
        all_close(found.v, start.v, 1e-12);
        for state in [start, found] {
            // The motion from there is not determined, but the state violates no constraint.
            let mut motion = slider.simulate(state);
            if let Err(error) = motion.advance_to(1e-3) {
                assert_eq!(error.cause, Cause::StepTooSmall);
            }
        }
    }
}

#[test]
fn a_flat_parallelogram_goes_on_as_one() {
    let linkage = Parallelogram { l: 1.0, a: 0.7 };
    for tolerance in [1e-8, 1e-10, 1e-13] {
        for k in 0..10 {
            let w = 1.0 + 0.6 * f64::from(k);
            let start = linkage
                .consistent(State::new([1.0, 1.0, 1.0, 0.54, 0.84, 0.0], [w, w, w, 0.0, 0.0, 0.0]))
                .expect("a start");
            let mut motion = linkage.simulate(start).with_tolerance(tolerance);
            let end = *motion.advance_to(3.0).expect("a motion");
            // Errors of some tens of steps, and the rounding of states that end 1e-5 beside the flat
            // position.
            let allowed = 100.0 * tolerance + f64::EPSILON / 1e-5;
            close_on(30.0, linkage.energy(&end), linkage.energy(&start), allowed);
            close_on(1.0, end.q[5], 0.0, allowed);
            close_on(1.0, end.q[0], end.q[1], allowed);
        }
    }
}

#[test]
fn what_is_held_stays_in_a_few_steps() {
    let held = Held { m: 2.0 };
    let start = held.consistent(State::at_rest([0.47, 0.15, 0.3])).expect("a start");
    let mut motion = held.simulate(start).with_max_steps(10);
    let end = *motion.advance_to(1.0).expect("rest");
    all_close(end.q, start.q, 1e-15);
    all_close(end.v, [0.0; 3], 1e-15);

    let mut motion = Beam.simulate(State::at_rest([0.0; 3])).with_max_steps(10);
    let end = *motion.advance_to(1.0).expect("rest");
    all_close(end.q, [0.0; 3], 1e-15);
    all_close(end.v, [0.0; 3], 1e-15);
}
