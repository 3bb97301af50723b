//! Redundant constraints: the same motion as without, and the shortest of all multipliers.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close, close_on};
use crate::support::motion::{TIGHT, numbers};

const G: f64 = 9.81;

/// A beam on cranks of equal length, which stay parallel: two cranks, and a third one in between.
#[derive(Clone, Copy)]
struct Swing {
    mass: f64,
    inertia: f64,
    crank: f64,
}

struct OnTwo(Swing);

#[lagrangian(coordinates = [x, y, turn])]
impl OnTwo {
    #[body(mass = self.0.mass, inertia = self.0.inertia)]
    fn beam(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.mass * G * q.y
    }

    /// The length of a crank to a pin at a distance from the middle of the beam.
    fn crank(&self, q: &Coordinates, at: f64) -> f64 {
        (Vector2::new(q.x - at, q.y) + at * Vector2::new(q.turn.cos(), q.turn.sin())).norm() - self.0.crank
    }

    #[holonomic]
    fn cranks(&self, q: &Coordinates) -> [f64; 2] {
        [self.crank(q, -1.0), self.crank(q, 1.0)]
    }
}

struct OnThree(Swing);

#[lagrangian(coordinates = [x, y, turn], allow(redundant))]
impl OnThree {
    #[body(mass = self.0.mass, inertia = self.0.inertia)]
    fn beam(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.mass * G * q.y
    }

    fn crank(&self, q: &Coordinates, at: f64) -> f64 {
        (Vector2::new(q.x - at, q.y) + at * Vector2::new(q.turn.cos(), q.turn.sin())).norm() - self.0.crank
    }

    #[holonomic]
    fn cranks(&self, q: &Coordinates) -> [f64; 3] {
        [self.crank(q, -1.0), self.crank(q, 0.5), self.crank(q, 1.0)]
    }
}

/// The motion of the beam: each of its points is a pendulum.
struct Pendulum(Swing);

#[lagrangian(coordinates = [angle])]
impl Pendulum {
    #[point(mass = self.0.mass)]
    fn beam(&self, q: &Coordinates) -> Vector2<f64> {
        self.0.crank * Vector2::new(q.angle.sin(), -q.angle.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.mass * G * self.beam(q).y
    }
}

/// A rod as a length, as its square, and as no velocity along it; and a mass matrix that moves.
struct Rod {
    m: [f64; 2],
}

#[lagrangian(coordinates = [x, y, z, r], allow(redundant, integrable))]
impl Rod {
    #[point(mass = self.m[0])]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    /// A collar on the rod, whose place is a coordinate.
    #[point(mass = self.m[1])]
    fn collar(&self, q: &Coordinates) -> Vector3<f64> {
        self.bob(q) * q.r
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.m[0] * q.z + self.m[1] * self.collar(q).z) + 20.0 * (q.r - 0.5).powi(2)
    }

    #[holonomic]
    fn length(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 1.0
    }

    #[holonomic]
    fn square(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm_squared() - 1.0
    }

    #[nonholonomic]
    fn across(&self, q: &Coordinates, v: &Velocities) -> f64 {
        q.x * v.x + q.y * v.y + q.z * v.z
    }
}

struct Plain {
    m: [f64; 2],
}

#[lagrangian(coordinates = [x, y, z, r])]
impl Plain {
    #[point(mass = self.m[0])]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[point(mass = self.m[1])]
    fn collar(&self, q: &Coordinates) -> Vector3<f64> {
        self.bob(q) * q.r
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.m[0] * q.z + self.m[1] * self.collar(q).z) + 20.0 * (q.r - 0.5).powi(2)
    }

    #[holonomic]
    fn length(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 1.0
    }
}

const SWING: Swing = Swing { mass: 2.0, inertia: 0.7, crank: 0.8 };

fn swinging(angle: f64, rate: f64) -> State<f64, 3> {
    let (sin, cos) = angle.sin_cos();
    let l = SWING.crank;
    State::new([l * sin, -l * cos, 0.0], [l * rate * cos, l * rate * sin, 0.0])
}

#[test]
fn a_third_crank_changes_nothing() {
    let (two, three, pendulum) = (OnTwo(SWING), OnThree(SWING), Pendulum(SWING));
    let mut on_two = two.simulate(swinging(0.9, 0.3)).with_tolerance(TIGHT);
    let mut on_three = three.simulate(swinging(0.9, 0.3)).with_tolerance(TIGHT);
    let mut dop853 = three.simulate_with::<Dop853>(swinging(0.9, 0.3)).with_tolerance(TIGHT);
    let mut point = pendulum.simulate(State::new([0.9], [0.3])).with_tolerance(TIGHT);
    for k in 1..=10 {
        let t = 0.7 * f64::from(k);
        let State { q: [angle], v: [rate], .. } = *point.advance_to(t).unwrap();
        let expected = numbers(&swinging(angle, rate));
        all_close(numbers(on_two.advance_to(t).unwrap()), &expected, 1e-11);
        all_close(numbers(on_three.advance_to(t).unwrap()), &expected, 1e-11);
        all_close(numbers(dop853.advance_to(t).unwrap()), &expected, 1e-11);
    }
    assert!(on_two.reactions().are_unique());
    assert!(!on_three.reactions().are_unique());
    assert!(!dop853.reactions().are_unique());
}

#[test]
fn three_cranks_share_the_load_by_the_least_squares() {
    let three = OnThree(SWING);
    for (angle, rate) in [(0.0, 2.0), (0.9, 0.3), (-1.4, 1.1)] {
        let state = swinging(angle, rate);
        let reactions = three.reactions(&state).unwrap();
        let [a, b, c] = reactions.cranks;
        // All pull along the cranks, and no moment is left about the middle of the beam.
        let tension = SWING.mass * (SWING.crank * rate * rate + G * angle.cos());
        close(a + b + c, -tension, 1e-13);
        close_on(tension, -a + 0.5 * b + c, 0.0, 1e-13);
        // Loads at −1, 1/2, 1 in the ratios 1 : −4 : 3 neither pull nor turn the beam. The shortest reactions
        // contain none of them.
        close_on(tension, a - 4.0 * b + 3.0 * c, 0.0, 1e-13);
        assert!(!reactions.are_unique());
    }
}

#[test]
fn one_rod_in_three_forms_is_one_rod() {
    let (rod, plain) = (Rod { m: [1.0, 0.5] }, Plain { m: [1.0, 0.5] });
    let start = State::new([0.6, 0.0, -0.8, 0.5], [0.4, 0.9, 0.3, 0.0]);
    let mut threefold = rod.simulate(start).with_tolerance(TIGHT);
    let mut dop853 = rod.simulate_with::<Dop853>(start).with_tolerance(TIGHT);
    let mut once = plain.simulate(start).with_tolerance(TIGHT);
    for k in 1..=8 {
        let t = 0.5 * f64::from(k);
        let expected = numbers(once.advance_to(t).unwrap());
        all_close(numbers(threefold.advance_to(t).unwrap()), &expected, 1e-10);
        all_close(numbers(dop853.advance_to(t).unwrap()), &expected, 1e-10);
    }
    let state = *threefold.state();
    let (reactions, single) = (rod.reactions(&state).unwrap(), plain.reactions(&state).unwrap());
    assert!(!reactions.are_unique() && single.are_unique());
    // Gradients 1 : 2 : 1 on the unit sphere, so the shortest multipliers are in the same ratios.
    let tension = single.length;
    all_close(
        [reactions.length, reactions.square, reactions.across],
        [tension / 6.0, tension / 3.0, tension / 6.0],
        1e-12,
    );
}

/// A pendulum whose rod is demanded three times, once with a factor that varies. Off the constraints its rows
/// are independent of each other.
struct Thrice;

#[lagrangian(coordinates = [x, y], jacobians, allow(redundant))]
impl Thrice {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * q.y
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 3] {
        let off = 0.5 * (q.x * q.x + q.y * q.y - 1.0);
        [off, 3.0 * off, off * (2.0 + q.x)]
    }
}

/// The same once.
struct Once;

#[lagrangian(coordinates = [angle], jacobians)]
impl Once {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.angle.sin(), -q.angle.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * self.bob(q).y
    }
}

#[test]
fn collocation_takes_redundant_rows() {
    let (angle, h) = (0.5_f64, 1.0 / 256.0);
    let mut motion = Thrice.stepper::<Gauss8>(State::at_rest([angle.sin(), -angle.cos()]));
    for _ in 0..256 {
        motion.step(h, &[]).unwrap();
    }
    let mut expected = Once.simulate(State::at_rest([angle])).with_tolerance(TIGHT);
    let angle = expected.advance_to(1.0).unwrap().q[0];
    all_close(motion.state().q, [angle.sin(), -angle.cos()], 1e-12);
}
