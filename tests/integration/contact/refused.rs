//! Starts and parameters that make no sense, by name.

use lagrangian::prelude::*;

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
