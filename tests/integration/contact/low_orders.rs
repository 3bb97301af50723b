//! Fixed steps of low order where something that holds lets go. Their series have no rates of reactions.

use lagrangian::prelude::*;

use super::TIGHT;

/// A mass on a spring to a block that a brake holds, until the spring pulls harder.
struct Brake;

#[lagrangian(coordinates = [x, s])]
impl Brake {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2) + 0.4 * v.s.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        2.0 * (q.s - q.x).powi(2)
    }

    #[friction(limit = 1.2)]
    fn shoe(&self, v: &Velocities) -> f64 {
        v.s
    }
}

/// A bob that is thrown up on a rope, which goes slack.
struct Rope;

#[lagrangian(coordinates = [x, y])]
impl Rope {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn slack(&self, q: &Coordinates) -> f64 {
        1.0 - self.bob(q).norm()
    }
}

/// A body on a board that tilts, until it slides.
struct Board;

#[lagrangian(coordinates = [s, n])]
impl Board {
    #[point(mass = 1.0)]
    fn body(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.s, q.n)
    }

    #[force(on = s)]
    fn along(&self, t: f64) -> f64 {
        -9.81 * (0.5 * t).sin()
    }

    #[force(on = n)]
    fn across(&self, t: f64) -> f64 {
        -9.81 * (0.5 * t).cos()
    }

    #[unilateral]
    fn board(&self, q: &Coordinates) -> f64 {
        q.n
    }

    #[friction(coefficient = 0.3, normal = board)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.s
    }
}

/// A force that grows against a brake whose static limit is higher: nothing moves on the steps before.
struct Breakaway;

#[lagrangian(coordinates = [s])]
impl Breakaway {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.s.powi(2)
    }

    #[force(on = s)]
    fn pull(&self, t: f64) -> f64 {
        3.0 * t * t
    }

    #[friction(limit = 1.0, static_limit = 2.0)]
    fn shoe(&self, v: &Velocities) -> f64 {
        v.s
    }
}

/// The largest error of the coordinates after steps of one order to a time. A regime that ends between two
/// steps ends late by up to a step, which an order of two or more has as an error of the step's square.
macro_rules! lets_go {
    ($system:expr, $start:expr, $t:expr, [$($order:literal)*]) => {{
        let (system, start, t) = ($system, $start, $t);
        let mut motion = system.simulate(start).with_tolerance(TIGHT);
        let right = *motion.advance_to(t).unwrap();
        $(for count in [100, 1000] {
            let h = t / f64::from(count);
            let mut motion = system.stepper::<Jet<$order>>(start);
            for _ in 0..count {
                motion.step(h, &[]).unwrap();
            }
            let apart = motion.state().q.iter().zip(&right.q).map(|(a, b)| (a - b).abs());
            let error = apart.fold(0.0, f64::max);
            // With the accelerations of these systems, which are below 40 m/s², and what follows from a
            // letting go that is late by a step.
            assert!(error < 40.0 * h * h, "order {} in {count} steps: {error:e}", $order);
        })*
    }};
}

#[test]
fn a_brake_lets_go_in_steps_of_low_order() {
    lets_go!(Brake, State::new([0.05, 0.0], [2.0, 0.0]), 0.9, [2 3 4]);
}

#[test]
fn a_rope_goes_slack_in_steps_of_low_order() {
    lets_go!(Rope, State::new([0.0, -1.0], [6.2, 0.0]), 0.6, [2 3 4]);
}

#[test]
fn a_body_slides_on_a_tilting_board_in_steps_of_low_order() {
    lets_go!(Board, State::at_rest([0.0; 2]), 1.5, [2 3 4]);
}

#[test]
fn a_brake_breaks_away_in_steps_of_low_order() {
    lets_go!(Breakaway, State::at_rest([0.0]), 1.0, [2 3 4]);
}

/// Straight lines are of the first order.
#[test]
fn a_brake_lets_go_in_straight_lines() {
    let start = State::new([0.05, 0.0], [2.0, 0.0]);
    let right = *Brake.simulate(start).with_tolerance(TIGHT).advance_to(0.9).unwrap();
    let mut motion = Brake.stepper::<Jet<1>>(start);
    for _ in 0..1000 {
        motion.step(0.9e-3, &[]).unwrap();
    }
    assert!((motion.state().q[1] - right.q[1]).abs() < 0.01, "{:?} {right:?}", motion.state());
}
