//! Coordinates that constraints eliminate: driven ones, geared ones, and forces on them.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::difference::{STEP, derivative};
use crate::support::identities::model;
use crate::support::motion::state_at;
use crate::support::sample::Samples;

/// A bead on a hoop that is driven about its vertical diameter. The driven angle is declared first, so that
/// the other coordinate changes its number.
struct Hoop {
    mass: f64,
    radius: f64,
    g: f64,
    rate: f64,
}

#[lagrangian(coordinates = [phi, theta])]
impl Hoop {
    #[point(mass = self.mass)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        let (sin, cos) = q.theta.sin_cos();
        self.radius * Vector3::new(sin * q.phi.cos(), sin * q.phi.sin(), -cos)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.bead(q).z
    }

    #[holonomic(eliminate = phi)]
    fn drive(&self, q: &Coordinates, t: f64) -> f64 {
        q.phi - self.rate * t
    }
}

const HOOP: Hoop = Hoop { mass: 0.4, radius: 0.7, g: 9.81, rate: 5.0 };

#[test]
fn a_driven_angle_leaves_the_centrifugal_force() {
    let mut samples = Samples::new(1);
    for _ in 0..10 {
        let state: State<f64, 1> = samples.state(-3.0, 3.0);
        let (sin, cos) = state.q[0].sin_cos();
        let Hoop { radius, g, rate, .. } = HOOP;
        close(HOOP.accelerations(&state).unwrap()[0], (rate * rate * cos - g / radius) * sin, 1e-14);
        let (q, v) = (HOOP.coordinates(&state), HOOP.velocities(&state));
        close(HOOP.drive(&q, state.t), 0.0, 1e-12);
        all_close([q.theta, v.phi, v.theta], [state.q[0], rate, state.v[0]], 1e-15);
        close(HOOP.potential_energy(&state), HOOP.gravity(&q), 1e-14);
    }
    assert_eq!(Hoop::COORDINATES, ["theta"]);
    assert!(Hoop::STRUCTURE.facts.contains(&"eliminated by constraints: phi"));
    model!(HOOP, jacobi).holds(-2.0, 2.0);
    let end = state_at(&HOOP, State::at_rest([0.5]), 2.0);
    close(HOOP.jacobi_integral(&end), HOOP.jacobi_integral(&State::at_rest([0.5])), 1e-13);
}

/// A wheel that rolls down an incline, with a motor and a bearing at its angle and a wind at its centre.
struct Wheel {
    mass: f64,
    inertia: f64,
    radius: f64,
    slope: f64,
    damping: f64,
}

#[lagrangian(coordinates = [x, angle], inputs = [motor, wind])]
impl Wheel {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2) + 0.5 * self.inertia * v.angle.powi(2)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.mass * 9.81 * self.slope.sin() * q.x
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.angle.powi(2)
    }

    #[force]
    fn drive(&self, u: &Inputs) -> [f64; 2] {
        [u.wind, u.motor]
    }

    #[holonomic(eliminate)]
    fn rolling(&self, q: &Coordinates) -> f64 {
        q.x - self.radius * q.angle
    }
}

#[test]
fn a_force_on_an_eliminated_coordinate_acts_on_the_others() {
    let wheel = Wheel { mass: 3.0, inertia: 0.2, radius: 0.4, slope: 0.3, damping: 0.7 };
    let state = State::new([1.5], [-2.0]);
    let inputs = [5.0, 11.0];
    let effective = 3.0 + 0.2 / 0.16;
    let force = 3.0 * 9.81 * 0.3_f64.sin() + 11.0 + 5.0 / 0.4 - 0.7 * -2.0 / 0.16;
    close(wheel.mass_matrix(&state)[(0, 0)], effective, 1e-15);
    close(wheel.accelerations(&state, &inputs).unwrap()[0], force / effective, 1e-14);
    all_close([wheel.coordinates(&state).angle, wheel.velocities(&state).angle], [3.75, -5.0], 1e-15);
}

/// Constraints that need one another, in single precision as well: a[0] = x + t² + …, a[1], and the height
/// over a parabola.
struct Linkage<R> {
    steepness: R,
    offset: R,
}

#[lagrangian(coordinates = [a: [2], x, z, y])]
impl<R: Real> Linkage<R> {
    #[point(mass = R::from_f64(2.0))]
    fn block(&self, q: &Coordinates<R>) -> Vector3<R> {
        Vector3::new(q.a[0] * q.y.cos(), q.a[1] + q.x, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        9.81 * 2.0 * q.z
    }

    #[force(on = a)]
    fn push(&self, q: &Coordinates<R>) -> [R; 2] {
        [1.0 + q.a[1], 3.0 * q.z]
    }

    #[holonomic(eliminate = a)]
    fn links(&self, q: &Coordinates<R>, t: R) -> [R; 2] {
        [q.a[0] + q.a[1] - 2.0 * q.x - self.offset, q.a[0] - 3.0 * q.a[1] - t.powi(2) + q.z]
    }

    #[holonomic(eliminate = z)]
    fn bowl(&self, q: &Coordinates<R>) -> R {
        q.z - self.steepness * (q.x.powi(2) + q.y.powi(2))
    }
}

/// The same by hand.
struct Reduced {
    steepness: f64,
    offset: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Reduced {
    fn z(&self, q: &Coordinates) -> f64 {
        self.steepness * (q.x.powi(2) + q.y.powi(2))
    }

    fn a(&self, q: &Coordinates, t: f64) -> [f64; 2] {
        let sum = 2.0 * q.x + self.offset;
        let second = (sum - t.powi(2) + self.z(q)) / 4.0;
        [sum - second, second]
    }

    #[point(mass = 2.0)]
    fn block(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        let a = self.a(q, t);
        Vector3::new(a[0] * q.y.cos(), a[1] + q.x, self.z(q))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * 2.0 * self.z(q)
    }

    #[force]
    fn push(&self, q: &Coordinates, t: f64) -> [f64; 2] {
        let (first, second) = (1.0 + self.a(q, t)[1], 3.0 * self.z(q));
        // ∂a/∂q by hand: a[1] = (2 x + z + …)/4, a[0] = 2 x − a[1] + ….
        let by_x = (2.0 + 2.0 * self.steepness * q.x) / 4.0;
        let by_y = 2.0 * self.steepness * q.y / 4.0;
        [first * (2.0 - by_x) + second * by_x, (second - first) * by_y]
    }
}

#[test]
fn eliminations_may_need_one_another() {
    let linkage = Linkage { steepness: 0.6, offset: 0.3 };
    let by_hand = Reduced { steepness: 0.6, offset: 0.3 };
    let mut samples = Samples::new(2);
    for _ in 0..10 {
        let state: State<f64, 2> = samples.state(-1.0, 1.0);
        all_close(linkage.accelerations(&state).unwrap(), by_hand.accelerations(&state).unwrap(), 1e-12);
        all_close(linkage.applied_forces(&state), by_hand.applied_forces(&state), 1e-12);
        let q = linkage.coordinates(&state);
        all_close(linkage.links(&q, state.t), [0.0; 2], 1e-12);
        close(linkage.bowl(&q), 0.0, 1e-12);
        all_close([q.x, q.y], state.q, 1e-15);
        let after = |h: f64| {
            let q = std::array::from_fn(|i| state.q[i] + h * state.v[i]);
            <[f64; 5]>::from(linkage.coordinates(&State::new(q, state.v).at_time(state.t + h)))
        };
        let rates = derivative(STEP, after);
        let velocities: [f64; 5] = linkage.velocities(&state).into();
        all_close(velocities, rates, 1e-11);
    }
    model!(linkage, forces, jacobi).holds(-1.0, 1.0);
    let single = Linkage { steepness: 0.6_f32, offset: 0.3 };
    let state = State::new([0.2_f32, -0.4], [0.5, 0.1]);
    let double = State::new([0.2, -0.4], [0.5, 0.1]);
    for (single, double) in
        single.accelerations(&state).unwrap().into_iter().zip(linkage.accelerations(&double).unwrap())
    {
        close(f64::from(single), double, 1e-5);
    }
}

/// A rotor on a driven turntable: a rotation that remembers how it was composed, and a torque at it.
struct Rotor {
    moments: [f64; 3],
    rate: f64,
}

#[lagrangian(coordinates = [spin, turn, tilt])]
impl Rotor {
    #[body(mass = 1.0, inertia = self.moments)]
    fn rotor(&self, q: &Coordinates) -> Isometry3<f64> {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.turn)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.tilt)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.spin);
        Isometry3::from_parts((attitude * Vector3::new(0.0, 0.0, 0.5)).into(), attitude.into())
    }

    #[force(at = rotor)]
    fn load(&self, v: &Velocities) -> (Vector3<f64>, Vector3<f64>) {
        (Vector3::new(1.0, 0.0, 2.0), Vector3::new(0.3, v.turn, -v.spin))
    }

    #[holonomic(eliminate = turn)]
    fn table(&self, q: &Coordinates, t: f64) -> f64 {
        2.0 * q.turn - 2.0 * (self.rate * t).sin()
    }
}

/// The same with the prescribed angle written out.
struct Turning {
    moments: [f64; 3],
    rate: f64,
}

#[lagrangian(coordinates = [spin, tilt])]
impl Turning {
    #[body(mass = 1.0, inertia = self.moments)]
    fn rotor(&self, q: &Coordinates, t: f64) -> Isometry3<f64> {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), (self.rate * t).sin())
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.tilt)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.spin);
        Isometry3::from_parts((attitude * Vector3::new(0.0, 0.0, 0.5)).into(), attitude.into())
    }

    #[force(at = rotor)]
    fn load(&self, v: &Velocities, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let turn = self.rate * (self.rate * t).cos();
        (Vector3::new(1.0, 0.0, 2.0), Vector3::new(0.3, turn, -v.spin))
    }
}

#[test]
fn rotations_follow_the_prescribed_angle() {
    let rotor = Rotor { moments: [0.3, 0.5, 0.4], rate: 2.0 };
    let turning = Turning { moments: [0.3, 0.5, 0.4], rate: 2.0 };
    let mut samples = Samples::new(3);
    for _ in 0..10 {
        let state: State<f64, 2> = samples.state(0.3, 1.5);
        all_close(rotor.accelerations(&state).unwrap(), turning.accelerations(&state).unwrap(), 1e-12);
        close(rotor.kinetic_energy(&state), turning.kinetic_energy(&state), 1e-14);
        close(rotor.velocities(&state).turn, 2.0 * (2.0 * state.t).cos(), 1e-14);
    }
}

/// A particle on a driven cart, held by a rod and guided by a blade, both of which know the cart.
struct Guided {
    length: f64,
    rate: f64,
}

#[lagrangian(coordinates = [x, cart, y, z])]
impl Guided {
    #[point(mass = 2.0)]
    fn block(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x + q.cart, q.y, q.z)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        Vector3::new(q.x, q.y, q.z - q.cart).norm() - self.length
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (v.x + v.cart) * q.z.sin() - v.y * (q.z + q.cart).cos()
    }

    #[holonomic(eliminate = cart)]
    fn drive(&self, q: &Coordinates, t: f64) -> f64 {
        q.cart - (self.rate * t).sin()
    }
}

/// The same with the prescribed path written out.
struct Written {
    length: f64,
    rate: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Written {
    fn cart(&self, t: f64) -> f64 {
        (self.rate * t).sin()
    }

    #[point(mass = 2.0)]
    fn block(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        Vector3::new(q.x + self.cart(t), q.y, q.z)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates, t: f64) -> f64 {
        Vector3::new(q.x, q.y, q.z - self.cart(t)).norm() - self.length
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        (v.x + self.rate * (self.rate * t).cos()) * q.z.sin() - v.y * (q.z + self.cart(t)).cos()
    }
}

#[test]
fn constraints_that_are_kept_follow_the_prescribed_path() {
    let (guided, written) = (Guided { length: 1.5, rate: 3.0 }, Written { length: 1.5, rate: 3.0 });
    let mut samples = Samples::new(4);
    for _ in 0..10 {
        let state: State<f64, 3> = samples.state(0.2, 1.2);
        all_close(guided.accelerations(&state).unwrap(), written.accelerations(&state).unwrap(), 1e-12);
        let (found, expected) = (guided.reactions(&state).unwrap(), written.reactions(&state).unwrap());
        all_close([found.rod, found.blade], [expected.rod, expected.blade], 1e-12);
        let (q, v) = (guided.coordinates(&state), guided.velocities(&state));
        all_close(guided.constraint_residuals(&state), [guided.rod(&q), guided.blade(&q, &v)], 1e-12);
    }
    assert_eq!(Guided::CONSTRAINTS, ["rod", "blade"]);
}
