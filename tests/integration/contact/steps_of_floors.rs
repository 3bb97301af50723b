//! Gaps that jump: no step moves a body, and a body that loses what it lay on falls.

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// A particle over a floor with a step at x = 1.
struct Stairs {
    step: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Stairs {
    #[point(mass = 2.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        20.0 * q.y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        if q.x < 1.0 { q.y } else { q.y - self.step }
    }
}

#[test]
fn no_step_moves_a_body() {
    // It lies on the floor, or flies lower than the step is high.
    for (step, height) in [(0.3, 0.0), (0.3, 1.3)] {
        let stairs = Stairs { step };
        let mut motion = stairs.simulate(State::new([0.0, height], [2.0, 0.0])).with_tolerance(TIGHT);
        let error = motion.advance_to(1.0).unwrap_err();
        assert!(matches!(error.cause, Cause::GapJumps { name, .. } if name.as_str() == "floor"), "{error}");
        assert!(error.to_string().contains("`floor` jumps"), "{error}");
        close(error.t, 0.5, 1e-14);
        close_on(1.0, motion.state().q[1], if height > 0.0 { 0.05 } else { 0.0 }, 1e-13);
    }
}

#[test]
fn what_flies_over_a_step_lands_behind_it() {
    for step in [0.3, -0.3] {
        let stairs = Stairs { step };
        let mut motion = stairs.simulate(State::new([0.0, 1.8], [4.0, 0.0])).with_tolerance(TIGHT);
        let over = motion.advance_to_switch(9.0).unwrap().expect("it comes over the step");
        close(over.state.t, 0.25, 1e-14);
        let lands = motion.advance_to_switch(9.0).unwrap().expect("it lands");
        close(lands.state.t, ((1.8 - step) / 5.0_f64).sqrt(), 1e-14);
    }
}

#[test]
fn what_slides_over_an_edge_falls() {
    let mut samples = Samples::new(83);
    for _ in 0..50 {
        let [depth, from, speed] = [[0.01, 2.0], [0.0, 0.99], [0.1, 9.0]].map(|[a, b]| samples.number(a, b));
        let stairs = Stairs { step: -depth };
        let mut motion = stairs.simulate(State::new([from, 0.0], [speed, 0.0])).with_tolerance(TIGHT);
        let edge = (1.0 - from) / speed;
        let falls = motion.advance_to_switch(99.0).unwrap().expect("it comes to the edge");
        close(falls.state.t, edge, 1e-13);
        assert_eq!(motion.contacts().floor, Contact::Open);
        let lands = motion.advance_to_switch(99.0).unwrap().expect("it lands");
        close(lands.state.t, edge + (depth / 5.0).sqrt(), 1e-13);
        close(lands.before.v[1], -(20.0 * depth).sqrt(), 1e-12);
        close_on(depth, lands.state.q[1], -depth, 1e-13);
    }
}

/// A crate that slides over a floor with friction, whose coefficient and height are others behind an edge.
struct Ledge {
    depth: f64,
    friction: [f64; 2],
}

#[lagrangian(coordinates = [x, y])]
impl Ledge {
    #[point(mass = 2.0)]
    fn package(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        20.0 * q.y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        if q.x < 1.0 { q.y } else { q.y + self.depth }
    }

    #[friction(coefficient = roughness, normal = floor)]
    fn slide(&self, _q: &Coordinates, v: &Velocities) -> f64 {
        v.x
    }

    fn roughness(&self, q: &Coordinates) -> f64 {
        if q.x < 1.0 { self.friction[0] } else { self.friction[1] }
    }
}

#[test]
fn a_crate_brakes_flies_and_brakes_again() {
    let mut samples = Samples::new(89);
    for _ in 0..30 {
        let depth = samples.number(0.01, 1.0);
        let friction = [0.1, 0.2].map(|low| samples.number(low, 0.5));
        let speed = samples.number(4.0, 6.0);
        let ledge = Ledge { depth, friction };
        let mut motion = ledge.simulate(State::new([0.0, 0.0], [speed, 0.0])).with_tolerance(TIGHT);
        let end = *motion.advance_to(20.0).unwrap();
        let at_edge = (speed * speed - 20.0 * friction[0]).sqrt();
        // The impact takes the impulse m u from below, and friction μ m u from the speed.
        let falls = (20.0 * depth).sqrt();
        let lands = at_edge - friction[1] * falls;
        let fallen = (depth / 5.0).sqrt();
        let expected = 1.0 + at_edge * fallen + lands * lands / (20.0 * friction[1]);
        close(end.q[0], expected, 1e-12);
        close_on(depth, end.q[1], -depth, 1e-13);
        assert_eq!(end.v, [0.0; 2]);
    }
}

/// A bead on a wire that goes on at another height from x = 1.
struct Torn {
    step: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Torn {
    #[point(mass = 2.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        if q.x < 1.0 { q.y - 0.2 * q.x * q.x } else { q.y - 0.2 * q.x * q.x - self.step }
    }
}

#[test]
fn no_bead_leaps_from_wire_to_wire() {
    for step in [0.3, -0.3] {
        let torn = Torn { step };
        let mut motion = torn.simulate(State::new([0.0, 0.0], [2.0, 0.0])).with_tolerance(TIGHT);
        let error = motion.advance_to(2.0).unwrap_err();
        assert!(matches!(error.cause, Cause::GapJumps { name, .. } if name.as_str() == "wire"), "{error}");
        close(motion.state().q[0], 1.0, 1e-13);
    }
    let whole = Torn { step: 0.0 };
    let mut motion = whole.simulate(State::new([0.0, 0.0], [2.0, 0.0])).with_tolerance(TIGHT);
    let end = *motion.advance_to(1.0).unwrap();
    assert!(end.q[0] > 1.0);
    close(end.q[1], 0.2 * end.q[0] * end.q[0], 1e-13);
}

/// A round table above a floor.
struct RoundTable {
    radius: f64,
    height: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl RoundTable {
    #[point(mass = 1.0)]
    fn puck(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.z
    }

    #[unilateral]
    fn table(&self, q: &Coordinates) -> f64 {
        if q.x * q.x + q.y * q.y < self.radius * self.radius { q.z } else { q.z + self.height }
    }
}

/// Rounding errors of the state put it on either side of the edge where the motion crosses that.
#[test]
fn on_whichever_side_of_an_edge_a_state_is_rounded_to_a_body_falls() {
    let mut random = Samples::new(31);
    for _ in 0..60 {
        let table = RoundTable { radius: random.number(0.5, 2.0), height: random.number(0.05, 0.5) };
        let [x, y] = [(); 2].map(|()| random.number(-0.3, 0.3));
        let (speed, angle) = (random.number(0.5, 3.0), random.number(-3.1, 3.1));
        let (u, v) = (speed * angle.cos(), speed * angle.sin());
        let along = x * u + y * v;
        let left = along * along - speed * speed * (x * x + y * y - table.radius * table.radius);
        let edge = (left.sqrt() - along) / (speed * speed);
        let (start, falls) = (State::new([x, y, 0.0], [u, v, 0.0]), 0.02);
        let fallen = -0.5 * 9.81 * falls * falls;
        let mut motion = table.simulate(start).with_tolerance(1e-10);
        let switch = motion.advance_to_switch(2.0 * edge).unwrap().expect("it comes to the edge");
        close_on(1.0, switch.state.q[2], 0.0, 1e-15);
        close_on(1.0, motion.advance_to(edge + falls).unwrap().q[2], fallen, 1e-10);
        let mut stepper = table.stepper::<Jet<6>>(start);
        for _ in 0..20 {
            stepper.step((edge + falls) / 20.0, &[]).unwrap();
        }
        close_on(1.0, stepper.state().q[2], fallen, 1e-10);
    }
}
