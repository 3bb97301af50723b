//! Friction whose load passes zero: the size of several reactions has a kink there, and no direction.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close};
use crate::support::sample::Samples;

/// A balanced rotor that a force shakes along a line: the load of its bearing passes zero, or nearly so where
/// another force is across the line.
struct Rotor {
    strength: f64,
    line: f64,
    rate: f64,
    across: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Rotor {
    #[point(mass = 1.0)]
    fn hub(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * v.phi.powi(2)
    }

    #[force(at = hub)]
    fn shake(&self, t: f64) -> Vector2<f64> {
        let (sin, cos) = self.line.sin_cos();
        let along = self.strength * (self.rate * t).cos();
        Vector2::new(along * cos - self.across * sin, along * sin + self.across * cos)
    }

    #[holonomic]
    fn one(&self, q: &Coordinates) -> f64 {
        self.hub(q).x
    }

    #[holonomic]
    fn other(&self, q: &Coordinates) -> f64 {
        self.hub(q).y
    }

    #[friction(coefficient = 0.5, normal = [one, other])]
    fn slip(&self, v: &Velocities) -> f64 {
        0.1 * v.phi
    }
}

/// The rate of a rotor of 3 N whose load has passed zero.
fn rate_at(t: f64, rate: f64) -> f64 {
    // ∫ |cos|: two for each half turn.
    let turns = ((rate * t + 0.5 * std::f64::consts::PI) / std::f64::consts::PI).floor();
    let part = (rate * t).sin();
    let passed = 2.0 * turns + if (turns as u64).is_multiple_of(2) { part } else { -part };
    5.0 - 0.05 * 3.0 * passed / rate
}

#[test]
fn a_load_that_passes_zero_goes_on_as_a_size() {
    let start = State::new([0.0; 3], [0.0, 0.0, 5.0]);
    let rotor = Rotor { strength: 3.0, line: 0.8_f64.atan2(0.6), rate: 1.0, across: 0.0 };
    let mut motion = rotor.simulate(start).with_tolerance(TIGHT);
    for t in [1.0, 2.0, 4.0, 9.0] {
        close(motion.advance_to(t).unwrap().v[2], rate_at(t, 1.0), 1e-11);
    }
    // Without a force there is no load.
    let end = *Rotor { strength: 0.0, ..rotor }.simulate(start).advance_to(9.0).unwrap();
    assert_eq!(end.v[2], 5.0);
}

/// Where both components of the load are rounding errors at its zero, or nearly so, they have no direction.
#[test]
fn a_load_passes_zero_along_any_line_and_beside_it() {
    let mut samples = Samples::new(7);
    for across in [0.0, 1e-17, 1e-16, 1e-13, 1e-12] {
        for _ in 0..20 {
            let line = samples.number(-3.0, 3.0);
            let (rate, t) = (samples.number(0.5, 5.0), samples.number(4.0, 6.0));
            let rotor = Rotor { strength: 3.0, line, rate, across };
            let start = State::new([0.0; 3], [0.0, 0.0, 5.0]);
            for (tolerance, error) in [(1e-9, 1e-7), (1e-12, 1e-10)] {
                let mut motion = rotor.simulate(start).with_tolerance(tolerance);
                let end = motion.advance_to(t).unwrap_or_else(|error| panic!("{line} {rate}: {error}"));
                close(end.v[2], rate_at(t, rate), error);
            }
        }
    }
}

/// A step ladder slides apart. By symmetry its hinge bears along the horizontal alone, and this load passes
/// zero while the ladder falls; what it bears along the vertical are rounding errors.
struct Ladder {
    floor: f64,
    hinge: f64,
}

#[lagrangian(coordinates = [x: [2], y: [2], a: [2]])]
impl Ladder {
    #[body(mass = 2.0, inertia = 2.0 / 3.0)]
    fn legs(&self, q: &Coordinates) -> [Isometry2<f64>; 2] {
        [0, 1].map(|leg| Isometry2::new(Vector2::new(q.x[leg], q.y[leg]), q.a[leg]))
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * 2.0 * (q.y[0] + q.y[1])
    }

    fn tops(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        self.legs(q).map(|leg| (leg * Point2::new(0.0, 1.0)).coords)
    }

    fn feet(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        self.legs(q).map(|leg| (leg * Point2::new(0.0, -1.0)).coords)
    }

    #[holonomic]
    fn joint(&self, q: &Coordinates) -> Vector2<f64> {
        let tops = self.tops(q);
        tops[0] - tops[1]
    }

    #[friction(coefficient = self.hinge, normal = [joint])]
    fn turn(&self, v: &Velocities) -> f64 {
        0.02 * (v.a[0] - v.a[1])
    }

    #[unilateral]
    fn ground(&self, q: &Coordinates) -> [f64; 2] {
        self.feet(q).map(|foot| foot.y)
    }

    #[friction(coefficient = self.floor, normal = ground)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        self.feet_velocity(q, v).map(|velocity| velocity.x)
    }
}

/// One leg, whose top moves along a wall: its load is one reaction that changes its sign.
struct Leg {
    floor: f64,
    hinge: f64,
}

#[lagrangian(coordinates = [x, y, a])]
impl Leg {
    #[body(mass = 2.0, inertia = 2.0 / 3.0)]
    fn leg(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.a)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * 2.0 * q.y
    }

    #[holonomic]
    fn wall(&self, q: &Coordinates) -> f64 {
        (self.leg(q) * Point2::new(0.0, 1.0)).x
    }

    #[friction(coefficient = self.hinge, normal = wall)]
    fn turn(&self, v: &Velocities) -> f64 {
        0.02 * v.a
    }

    fn foot(&self, q: &Coordinates) -> Vector2<f64> {
        (self.leg(q) * Point2::new(0.0, -1.0)).coords
    }

    #[unilateral]
    fn ground(&self, q: &Coordinates) -> f64 {
        self.foot(q).y
    }

    #[friction(coefficient = self.floor, normal = ground)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.foot_velocity(q, v).x
    }
}

#[test]
fn a_step_ladder_falls_as_one_of_its_legs_does() {
    let (mut samples, mut fell) = (Samples::new(8), 0);
    for _ in 0..40 {
        let (floor, hinge) = (samples.number(0.0, 0.2), samples.number(0.1, 0.8));
        let angle = samples.number(0.3, 0.7);
        let (x, y) = angle.sin_cos();
        let half = Leg { floor, hinge };
        let mut leg = half.simulate(State::at_rest([-x, y, -angle])).with_tolerance(1e-12);
        // Not all slide apart.
        let passed = leg.advance_to_event(|state: &State<f64, 3>| state.q[2] + 1.4, 5.0);
        let Some(there) = passed.unwrap() else { continue };
        fell += 1;
        let ladder = Ladder { floor, hinge };
        let start = State::at_rest([-x, x, y, y, -angle, angle]);
        for (tolerance, error) in [(1e-6, 1e-4), (1e-9, 1e-7), (1e-12, 1e-10)] {
            let mut motion = ladder.simulate(start).with_tolerance(tolerance);
            let end =
                motion.advance_to(there.state.t).unwrap_or_else(|error| panic!("{floor} {hinge}: {error}"));
            all_close(
                [end.q[4], end.q[5], end.v[4]],
                [there.state.q[2], -there.state.q[2], there.state.v[2]],
                error,
            );
        }
    }
    assert!(fell > 30, "{fell}");
}
