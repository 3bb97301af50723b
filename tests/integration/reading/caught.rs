//! Names that no macro can see through are caught by the comparison at first use.

use lagrangian::prelude::*;

/// A method of the user that is named like one of nalgebra.
trait Square {
    fn square(self) -> f64;
}

impl Square for f64 {
    fn square(self) -> f64 {
        3.0 * self
    }
}

/// A macro of the user that is named like one of nalgebra.
macro_rules! vector {
    ($x:expr, $y:expr) => {
        Vector2::new($y, $x)
    };
}

struct Height;

#[lagrangian(coordinates = [x])]
impl Height {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        q.x.square()
    }
}

struct Swapped;

#[lagrangian(coordinates = [x, y])]
impl Swapped {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        vector![q.x, 2.0 * q.y]
    }
}

struct Weighed {
    mass: f64,
}

#[lagrangian(coordinates = [x])]
impl Weighed {
    #[point(mass = self.mass.square())]
    fn bob(&self, q: &Coordinates) -> f64 {
        q.x
    }
}

struct Pushed;

#[lagrangian(coordinates = [x], inputs = [u])]
impl Pushed {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn push(&self, u: &Inputs) -> f64 {
        u.u.square()
    }
}

struct Bound;

#[lagrangian(coordinates = [x, y])]
impl Bound {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        q.x.square() + q.y * q.y - 1.0
    }
}

struct Allowed;

#[lagrangian(coordinates = [x], allow(misread))]
impl Allowed {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        q.x.square()
    }
}

fn misread<T: core::fmt::Debug>(result: Result<T, MotionError<f64>>) -> &'static str {
    match result {
        Err(MotionError { cause: Cause::Misread { function, .. }, .. }) => function.name(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_first_use_compares() {
    let start = State::new([0.0], [0.0]);
    assert_eq!(misread(Height.simulate(start).advance_to(1.0)), "height");
    assert_eq!(misread(Height.simulate_with::<Dop853>(start).advance_to(1.0)), "height");
    assert_eq!(misread(Height.stepper::<Rk4>(start).step(0.1, &[])), "height");
    assert_eq!(misread(Height.accelerations(&start)), "height");
    let error = Height.accelerations(&start).unwrap_err().to_string();
    assert!(error.contains("`height` returns something else"), "{error}");
}

#[test]
fn positions_masses_forces_and_constraints_are_compared() {
    assert_eq!(misread(Swapped.accelerations(&State::new([0.3, 0.4], [0.0; 2]))), "bob");
    assert_eq!(misread(Weighed { mass: 2.0 }.accelerations(&State::new([0.3], [0.0]))), "mass of bob");
    assert_eq!(misread(Pushed.accelerations(&State::new([0.3], [0.0]), &[0.0])), "push");
    assert_eq!(misread(Bound.consistent(State::new([0.6, 0.8], [0.0; 2]))), "rod");
}

#[test]
fn the_comparison_can_be_left_out() {
    assert!(Allowed.accelerations(&State::new([0.3], [0.0])).is_ok());
}
