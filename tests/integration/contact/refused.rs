//! Starts and parameters that make no sense, by name.

use lagrangian::prelude::*;

use crate::support::close::close;

struct Puck {
    restitution: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

fn cause(puck: &Puck, start: State<f64, 2>) -> Cause {
    puck.simulate(start).advance_to(1.0).unwrap_err().cause
}

const PUCK: Puck = Puck { restitution: 0.5, friction: 0.3 };

#[test]
fn a_start_that_penetrates_is_refused() {
    let Cause::Penetrates { name, .. } = cause(&PUCK, State::at_rest([0.0, -1e-3])) else { panic!() };
    assert_eq!(name.to_string(), "floor");
    assert!(PUCK.simulate(State::at_rest([1.0, -1e-17])).advance_to(1.0).is_ok());
}

#[test]
fn coefficients_out_of_range_are_refused() {
    let start = State::at_rest([0.0, 1.0]);
    for restitution in [-0.1, 1.1, f64::NAN] {
        let Cause::InvalidContact { name, .. } = cause(&Puck { restitution, ..PUCK }, start) else {
            panic!()
        };
        assert_eq!(name.to_string(), "floor");
    }
    for friction in [1e200, -0.1, f64::NAN] {
        let Cause::InvalidContact { name, .. } = cause(&Puck { friction, ..PUCK }, start) else { panic!() };
        assert_eq!(name.to_string(), "slip");
    }
}

#[test]
fn time_does_not_run_backward() {
    let mut motion = PUCK.simulate(State::at_rest([0.0, 1.0]));
    assert_eq!(motion.advance_to(-1.0).unwrap_err().cause, Cause::Irreversible);
    assert_eq!(*motion.state(), State::at_rest([0.0, 1.0]));
}

#[test]
fn a_state_that_is_no_number_is_refused() {
    assert_eq!(cause(&PUCK, State::at_rest([f64::NAN, 1.0])), Cause::NotFinite);
}

struct Ball {
    restitution: f64,
}

#[lagrangian(coordinates = [y])]
impl Ball {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(0.0, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

#[test]
fn a_motion_begins_where_another_had_an_impact() {
    for restitution in [0.0, 0.3, 0.7] {
        let ball = Ball { restitution };
        let mut motion = ball.simulate(State::at_rest([1.0]));
        let (mut count, mut below) = (0, 0);
        while let Some(switch) = motion.advance_to_switch(100.0).unwrap() {
            for state in [switch.before, switch.state] {
                below += usize::from(state.q[0] < 0.0);
                let found = ball.simulate(state).advance_to(state.t + 1.0).map(|_| ());
                assert!(found.is_ok(), "{restitution} {state:?} {found:?}");
            }
            count += 1;
        }
        // Rounding puts some of them below the floor.
        assert!(count > 10 && below > 10 || restitution == 0.0, "{restitution} {count} {below}");
    }
    // At rest, or at time zero, the coordinate alone does not show the size of its rounding errors.
    let fall = State::new([-2.2e-16], [-1.0]);
    let ball = Ball { restitution: 0.7 };
    assert!(matches!(ball.simulate(fall).advance_to(1.0).unwrap_err().cause, Cause::Penetrates { .. }));
    assert!(ball.simulate(fall.at_time(2.0)).advance_to(3.0).is_ok());
}

/// A block whose friction has a limit that jumps after a second.
struct Jumping {
    late: f64,
}

#[lagrangian(coordinates = [x])]
impl Jumping {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> f64 {
        q.x
    }

    fn holds(&self, t: f64) -> f64 {
        if t < 1.0 { 0.5 } else { self.late }
    }

    #[friction(limit = holds)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_limit_that_jumps_below_zero_is_an_error() {
    let moved = |late: f64| Jumping { late }.simulate(State::new([0.0], [4.0])).advance_to(2.0).copied();
    close(moved(0.2).unwrap().v[0], 3.3, 1e-13);
    let error = moved(-0.2).unwrap_err();
    assert!(matches!(error.cause, Cause::InvalidContact { name, .. } if name.as_str() == "slip"), "{error}");
    close(error.t, 1.0, 1e-13);
}
