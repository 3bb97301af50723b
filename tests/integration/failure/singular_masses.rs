//! Mass matrices without an inverse: at a place, by a parameter, in every form in which M is solved.

use lagrangian::Name;
use lagrangian::prelude::*;

use crate::support::close::close;
use crate::support::motion::state_at;

/// Without inertia about the vertical at the poles.
struct SphericalPendulum;

#[lagrangian(coordinates = [phi, theta])]
impl SphericalPendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        let (sin, cos) = q.phi.sin_cos();
        Vector3::new(sin * q.theta.cos(), sin * q.theta.sin(), -cos)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).z
    }
}

#[test]
fn the_pole_of_a_spherical_pendulum_is_reported_with_coordinate_and_time() {
    let pole = State::new([0.0, 0.3], [0.5, 2.0]).at_time(7.0);
    let expected =
        MotionError { cause: Cause::SingularMassMatrix { pivot: 1, name: Name::new(&"theta") }, t: 7.0 };
    assert_eq!(SphericalPendulum.accelerations(&pole).unwrap_err(), expected);
    let mut motion = SphericalPendulum.simulate(pole);
    assert_eq!(motion.advance_to(8.0).unwrap_err(), expected);
    assert_eq!(motion.state(), &pole);
    let mut stepper = SphericalPendulum.stepper::<Rk4>(pole);
    assert_eq!(stepper.step(0.1, &[]).unwrap_err(), expected);
    assert_eq!(stepper.state(), &pole);
}

#[test]
fn a_swing_through_the_pole_is_no_obstacle() {
    // Without spin the accelerations stay bounded on the way.
    let end = state_at(&SphericalPendulum, State::new([0.5, 1.0], [-2.0, 0.0]), 0.5);
    assert!(end.q[0] < -0.1, "{end:?}");
    close(end.q[1], 1.0, 1e-15);
    close(SphericalPendulum.energy(&end), 2.0 - 9.81 * 0.5_f64.cos(), 1e-12);
}

#[test]
fn a_fast_spin_keeps_away_from_the_pole() {
    let start = State::new([0.01, 0.0], [-3.0, 1.0]);
    let mut motion = SphericalPendulum.simulate(start).with_tolerance(1e-13);
    let energy = motion.energy();
    motion.advance_to(10.0).unwrap();
    close(motion.energy(), energy, 1e-9);
}

/// A chain whose mass matrix the runtime factors.
struct Chain {
    m: [f64; 4],
}

#[lagrangian(coordinates = [theta: [4]])]
impl Chain {
    #[point(mass = self.m[..])]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 4] {
        let mut joints = [Vector2::zeros(); 4];
        let mut end = Vector2::zeros();
        for i in 0..4 {
            end += Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
            joints[i] = end;
        }
        joints
    }
}

#[test]
fn a_chain_that_ends_without_mass_names_its_first_free_coordinate() {
    let state = State::at_rest([0.1, 0.2, 0.3, 0.4]).at_time(1.5);
    for (m, pivot) in [([0.0; 4], 0), ([1.0, 0.0, 0.0, 0.0], 1), ([1.0, 1.0, 0.0, 0.0], 2)] {
        let name = Name::new(&Chain::NAMES.coordinates[pivot]);
        let expected = MotionError { cause: Cause::SingularMassMatrix { pivot, name }, t: 1.5 };
        assert_eq!(Chain { m }.accelerations(&state).unwrap_err(), expected);
        assert_eq!(Chain { m }.simulate(state).advance_to(2.0).unwrap_err(), expected);
    }
}

#[test]
fn mass_at_the_tip_alone_leaves_links_without_inertia() {
    // One particle in the plane cannot carry four angles.
    let error = Chain { m: [0.0, 0.0, 0.0, 1.0] }.accelerations(&State::at_rest([0.1, 1.2, 2.3, 3.0]));
    assert!(matches!(error.unwrap_err().cause, Cause::SingularMassMatrix { pivot: 2 | 3, .. }));
}

/// A constant M, factored once per run.
struct Carts {
    m: [f64; 5],
}

#[lagrangian(coordinates = [x: [5]])]
impl Carts {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let mut sum = 0.5 * self.m[0] * v.x[0].powi(2);
        for i in 1..5 {
            sum += 0.5 * self.m[i] * (v.x[i] - v.x[i - 1]).powi(2);
        }
        sum
    }

    #[potential]
    fn slope(&self, q: &Coordinates) -> f64 {
        q.x.iter().sum()
    }
}

#[test]
fn a_constant_mass_matrix_is_checked_too() {
    let state = State::at_rest([0.0; 5]).at_time(0.5);
    assert!(Carts { m: [1.0; 5] }.accelerations(&state).is_ok());
    for zero in 0..5 {
        let mut m = [1.0; 5];
        m[zero] = 0.0;
        let carts = Carts { m };
        let error = carts.accelerations(&state).unwrap_err();
        assert!(matches!(error.cause, Cause::SingularMassMatrix { .. }), "{error}");
        assert_eq!(error.t, 0.5);
        assert_eq!(carts.simulate(state).advance_to(1.0).unwrap_err(), error);
    }
}

/// A diagonal M, solved entry by entry.
struct Diagonal {
    m: [f64; 2],
}

#[lagrangian(coordinates = [x, y])]
impl Diagonal {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (self.m[0] * v.x.powi(2) + self.m[1] * v.y.powi(2))
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        q.x * q.y
    }
}

#[test]
fn a_vanishing_entry_of_a_diagonal_names_its_coordinate() {
    let state = State::at_rest([1.0, 1.0]);
    for (m, pivot) in [([0.0, 1.0], 0), ([1.0, 0.0], 1)] {
        let error = Diagonal { m }.accelerations(&state).unwrap_err();
        let name = Name::new(&Diagonal::NAMES.coordinates[pivot]);
        assert_eq!(error.cause, Cause::SingularMassMatrix { pivot, name });
    }
}
