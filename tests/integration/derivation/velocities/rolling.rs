//! Wheels that roll, by one line each: the velocity of the contact point is zero.

use lagrangian::prelude::*;

use crate::support::close::all_close;
use crate::support::sample::Samples;

/// A monocycle: a disc that may lean, with its rider's mass above the hub.
struct Monocycle {
    radius: f64,
    height: f64,
    g: f64,
}

#[lagrangian(coordinates = [x, y, heading, lean, spin, pitch])]
impl Monocycle {
    /// Heading and lean, without spin or pitch.
    fn fork(&self, q: &Coordinates) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&Vector3::z_axis(), q.heading)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.lean)
    }

    #[body(mass = 3.0, inertia = [0.2, 0.4, 0.2])]
    fn wheel(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let hub = self.contact(q) + self.fork(q) * Vector3::new(0.0, 0.0, self.radius);
        (hub, self.fork(q) * Rotation3::from_axis_angle(&Vector3::y_axis(), q.spin))
    }

    #[point(mass = 60.0)]
    fn rider(&self, q: &Coordinates) -> Vector3<f64> {
        let seat =
            Rotation3::from_axis_angle(&Vector3::y_axis(), q.pitch) * Vector3::new(0.0, 0.0, self.height);
        self.wheel(q).0 + self.fork(q) * seat
    }

    fn contact(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, 0.0)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (3.0 * self.wheel(q).0.z + 60.0 * self.rider(q).z)
    }

    #[nonholonomic]
    fn rolling(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let slip = self.wheel_velocity(q, v).at(self.contact(q));
        [slip.x, slip.y]
    }
}

#[test]
fn a_monocycle_rolls_without_a_formula() {
    let cycle = Monocycle { radius: 0.4, height: 0.9, g: 9.81 };
    let mut samples = Samples::new(3);
    for _ in 0..5 {
        let state = samples.state::<6>(-1.0, 1.0);
        let [_, _, heading, ..] = state.q;
        let [x, y, _, _, spin, _] = state.v;
        // The point of contact moves as far as the rim unrolls.
        let along = 0.4 * spin;
        let by_hand = [x - along * heading.cos(), y - along * heading.sin()];
        all_close(cycle.constraint_residuals(&state), by_hand, 1e-13);
        let jacobian = cycle.constraint_jacobian(&state);
        let rows = [
            [1.0, 0.0, 0.0, 0.0, -0.4 * heading.cos(), 0.0],
            [0.0, 1.0, 0.0, 0.0, -0.4 * heading.sin(), 0.0],
        ];
        for (row, expected) in rows.iter().enumerate() {
            let found: [f64; 6] = std::array::from_fn(|column| jacobian[(row, column)]);
            all_close(found, *expected, 1e-13);
        }
        // The user's own function is callable and agrees.
        all_close(cycle.rolling(&state.q.into(), &state.v.into()), by_hand, 1e-13);
    }
}

/// A cart on two wheels of one axle and a castor, seen from above; wheels stand upright.
struct Cart {
    radius: f64,
    track: f64,
    front: f64,
    trail: f64,
    castor: f64,
}

#[lagrangian(coordinates = [x, y, heading, left, right, steer, roll], inputs = [drive])]
impl Cart {
    #[body(mass = 12.0, inertia = [1.0, 1.0, 2.0])]
    fn chassis(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::new(Vector3::new(q.x, q.y, self.radius), Vector3::z() * q.heading)
    }

    fn wheel(&self, q: &Coordinates, side: f64, angle: f64) -> Isometry3<f64> {
        self.chassis(q) * Isometry3::new(Vector3::new(0.0, side, 0.0), Vector3::y() * angle)
    }

    #[body(mass = 1.5, inertia = [0.02, 0.04, 0.02])]
    fn left_wheel(&self, q: &Coordinates) -> Isometry3<f64> {
        self.wheel(q, self.track, q.left)
    }

    #[body(mass = 1.5, inertia = [0.02, 0.04, 0.02])]
    fn right_wheel(&self, q: &Coordinates) -> Isometry3<f64> {
        self.wheel(q, -self.track, q.right)
    }

    /// The castor trails behind its pivot.
    #[body(mass = 0.4, inertia = [0.001, 0.002, 0.001])]
    fn castor_wheel(&self, q: &Coordinates) -> Isometry3<f64> {
        let below = self.castor - self.radius;
        self.chassis(q)
            * Isometry3::new(Vector3::new(self.front, 0.0, below), Vector3::z() * q.steer)
            * Isometry3::new(Vector3::new(-self.trail, 0.0, 0.0), Vector3::y() * q.roll)
    }

    fn below(place: Vector3<f64>) -> Vector3<f64> {
        Vector3::new(place.x, place.y, 0.0)
    }

    #[nonholonomic]
    fn left_rolls(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let wheel = self.left_wheel_velocity(q, v);
        let slip = wheel.at(Self::below(wheel.position));
        [slip.x, slip.y]
    }

    /// Across the axle both wheels say the same.
    #[nonholonomic]
    fn right_rolls(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let wheel = self.right_wheel_velocity(q, v);
        wheel.at(Self::below(wheel.position)).dot(&Vector3::new(q.heading.cos(), q.heading.sin(), 0.0))
    }

    #[nonholonomic]
    fn castor_rolls(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let wheel = self.castor_wheel_velocity(q, v);
        let slip = wheel.at(Self::below(wheel.position));
        [slip.x, slip.y]
    }

    #[force(on = left)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.drive
    }
}

#[test]
fn a_cart_with_a_castor_rolls_without_a_formula() {
    let cart = Cart { radius: 0.15, track: 0.25, front: 0.5, trail: 0.06, castor: 0.05 };
    let mut samples = Samples::new(8);
    for _ in 0..5 {
        let state = samples.state::<7>(-1.0, 1.0);
        let [_, _, heading, _, _, steer, _] = state.q;
        let [x, y, turn, left, right, pivot, roll] = state.v;
        let (c, s) = (heading.cos(), heading.sin());
        let (castor_c, castor_s) = ((heading + steer).cos(), (heading + steer).sin());
        // Wheel centres by hand, then what rolling takes off along each wheel.
        let left_rolls = [x - 0.25 * c * turn - 0.15 * left * c, y - 0.25 * s * turn - 0.15 * left * s];
        let right_rolls = (x + 0.25 * c * turn) * c + (y + 0.25 * s * turn) * s - 0.15 * right;
        let swing = 0.06 * (turn + pivot);
        let castor_rolls = [
            x - 0.5 * s * turn + swing * castor_s - 0.05 * roll * castor_c,
            y + 0.5 * c * turn - swing * castor_c - 0.05 * roll * castor_s,
        ];
        let by_hand = [left_rolls[0], left_rolls[1], right_rolls, castor_rolls[0], castor_rolls[1]];
        all_close(cart.constraint_residuals(&state), by_hand, 1e-13);
    }
    // It rolls: the wheels keep to the ground through a turn.
    let start = cart.consistent(State::new([0.0; 7], [0.4, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0])).expect("a start");
    let mut motion = cart.simulate(start).with_inputs([0.3]);
    let end = *motion.advance_to(2.0).expect("the cart rolls");
    assert!(cart.constraint_residuals(&end).iter().all(|slip| slip.abs() < 1e-13));
    // The axle's midpoint moves along the heading with the mean of the wheels' speeds.
    let (c, s) = (end.q[2].cos(), end.q[2].sin());
    let mean = 0.15 * (end.v[3] + end.v[4]) / 2.0;
    all_close([end.v[0], end.v[1]], [mean * c, mean * s], 1e-12);
}

/// A skate at the end of a boom on a slider: it glides along the boom only.
struct Skate {
    boom: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Skate {
    #[point(mass = 2.0)]
    fn slider(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[point(mass = 0.5)]
    fn blade(&self, q: &Coordinates) -> Vector2<f64> {
        self.slider(q) + self.boom * Vector2::new(q.angle.cos(), q.angle.sin())
    }

    #[nonholonomic]
    fn edge(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.blade_velocity(q, v).dot(&Vector2::new(-q.angle.sin(), q.angle.cos()))
    }
}

#[test]
fn the_reaction_acts_on_the_place_whose_velocity_is_named() {
    let skate = Skate { boom: 0.7 };
    let mut state = State::new([0.1, 0.2, 0.6], [0.5, -0.3, 0.0]);
    let (s, c) = 0.6_f64.sin_cos();
    state.v[2] = (0.5 * s + 0.3 * c) / 0.7;
    let force = skate.reactions(&state).expect("reactions").edge;
    assert!(force.abs() > 1e-3);
    // All of it across the blade, none of it on the slider.
    let on_blade = skate.reactions_on_blade(&state).expect("forces").edge;
    all_close([on_blade.x, on_blade.y], [-force * s, force * c], 1e-13);
    // Newton's law of both points agrees: the slider feels the boom alone.
    let a = skate.accelerations(&state).expect("accelerations");
    let rate = state.v[2];
    let blade = [a[0] - 0.7 * (a[2] * s + rate * rate * c), a[1] + 0.7 * (a[2] * c - rate * rate * s)];
    let total = [2.0 * a[0] + 0.5 * blade[0], 2.0 * a[1] + 0.5 * blade[1]];
    all_close(total, [on_blade.x, on_blade.y], 1e-12);
}
