//! The forms of velocities: of all that a position function may return, in any scalar.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::difference::{STEP, derivative};
use crate::support::sample::Samples;

/// Position functions of every form; the kinetic energy holds their velocities.
struct Forms<R: Real> {
    length: R,
    rate: R,
}

#[lagrangian(coordinates = [a, b: [2]])]
impl<R: Real> Forms<R> {
    fn frame(&self, t: R) -> Vector2<R> {
        Vector2::new((self.rate * t).cos(), (self.rate * t).sin())
    }

    fn points(&self, q: &Coordinates, t: R) -> [Vector2<R>; 2] {
        q.b.map(|b| self.frame(t) + Vector2::new(b.sin(), q.a * b.cos()) * self.length)
    }

    fn height(&self, q: &Coordinates) -> R {
        q.b[0].cos() * q.a
    }

    fn single(&self, q: &Coordinates) -> Vector1<R> {
        Vector1::new(q.a * q.a)
    }

    fn pose(&self, t: R, q: &Coordinates) -> (Vector2<R>, R) {
        (Vector2::new(q.a, q.b[0] * t), q.b[1] * q.a)
    }

    fn turn(q: &Coordinates) -> Rotation3<R> {
        let about_x = Rotation3::from_axis_angle(&Vector3::x_axis(), q.a);
        Rotation3::from_euler_angles(q.b[0], q.b[1], q.a) * about_x.inverse()
    }

    fn still(&self) -> Vector2<R> {
        Vector2::new(self.length, self.length)
    }

    fn entries(&self, q: &Coordinates) -> Matrix2<R> {
        Matrix2::new(q.a, q.b[0], q.b[1], q.a * q.b[0])
    }

    fn later(&self, q: &Coordinates, v: &Velocities, t: R) -> Twist2<R> {
        self.pose_velocity(t + 1.0, q, v)
    }

    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities, t: R) -> R {
        let [one, two] = self.points_velocity(q, v, t);
        let pose = self.later(q, v, t);
        let turn = Self::turn_velocity(q, v);
        0.5 * (one.norm_squared()
            + two.dot(&self.frame_velocity(t))
            + self.height_velocity(q, v).powi(2)
            + self.single_velocity(q, v).norm_squared()
            + pose.at(Vector2::new(0.3 * self.length, 0.4 * self.length)).norm_squared()
            + pose.velocity_in_body.x * pose.angular_velocity
            + turn.angular_velocity.norm_squared()
            + turn.angular_velocity_in_body.z.powi(2)
            + self.entries_velocity(q, v)[(1, 0)].powi(2)
            + self.still_velocity().norm_squared()
            + v.a * v.a)
    }
}

#[test]
fn every_form_has_its_velocity() {
    let forms = Forms { length: 0.7, rate: 1.3 };
    let mut samples = Samples::new(5);
    for _ in 0..3 {
        let State { t, q, v } = samples.state::<3>(-1.0, 1.0);
        let moved = |h: f64| FormsCoordinates::from(std::array::from_fn(|i| q[i] + h * v[i]));
        let (now, by) = (moved(0.0), FormsVelocities::from(v));
        let points = derivative(STEP, |h| {
            let [one, two] = forms.points(&moved(h), t + h);
            [one.x, one.y, two.x, two.y]
        });
        let [one, two] = forms.points_velocity(&now, &by, t);
        all_close([one.x, one.y, two.x, two.y], points, 1e-11);
        let frame = forms.frame_velocity(t);
        all_close([frame.x, frame.y], [-1.3 * (1.3 * t).sin(), 1.3 * (1.3 * t).cos()], 1e-13);
        let [height] = derivative(STEP, |h| [forms.height(&moved(h))]);
        close(forms.height_velocity(&now, &by), height, 1e-11);
        close(forms.single_velocity(&now, &by).x, 2.0 * q[0] * v[0], 1e-13);
        assert_eq!(forms.still_velocity(), Vector2::zeros());
        let entries =
            derivative(STEP, |h| <[f64; 4]>::try_from(forms.entries(&moved(h)).as_slice()).expect("four"));
        all_close(forms.entries_velocity(&now, &by).as_slice(), entries, 1e-11);

        // A material point of the body, by its own coordinates.
        let pose = forms.pose_velocity(t, &now, &by);
        let own = Vector2::new(0.2, -0.6);
        let place = |h: f64| {
            let (shift, angle) = forms.pose(t + h, &moved(h));
            shift + Rotation2::new(angle) * own
        };
        let moves = derivative(STEP, |h| [place(h).x, place(h).y]);
        let found = pose.at(place(0.0));
        all_close([found.x, found.y], moves, 1e-11);
        let in_body = Rotation2::new(forms.pose(t, &now).1).inverse() * pose.velocity;
        all_close(pose.velocity_in_body.as_slice(), in_body.as_slice(), 1e-13);

        // Ṙ = [ω]ₓ R = R [Ω]ₓ.
        let turn = Forms::<f64>::turn(&now);
        let rates = derivative(STEP, |h| {
            <[f64; 9]>::try_from(Forms::<f64>::turn(&moved(h)).matrix().as_slice()).expect("nine")
        });
        let velocity = Forms::<f64>::turn_velocity(&now, &by);
        let in_space = velocity.angular_velocity.cross_matrix() * turn.matrix();
        let in_body = turn.matrix() * velocity.angular_velocity_in_body.cross_matrix();
        for (entry, rate) in rates.into_iter().enumerate() {
            close(1.0 + in_space[entry], 1.0 + rate, 1e-11);
            close(1.0 + in_body[entry], 1.0 + rate, 1e-11);
        }
    }
}

#[test]
fn the_energy_made_of_them_is_that_of_the_users_function() {
    let state = State { t: 0.3, q: [0.4, 0.5, 0.6], v: [0.7, 0.8, 0.9] };
    let forms = Forms { length: 0.7, rate: 1.3 };
    close(forms.kinetic_energy(&state), forms.kinetic(&state.q.into(), &state.v.into(), 0.3), 1e-13);
    let single = Forms { length: 0.7_f32, rate: 1.3 };
    let near = State { t: 0.3_f32, q: [0.4, 0.5, 0.6], v: [0.7, 0.8, 0.9] };
    close(f64::from(single.kinetic_energy(&near)), forms.kinetic_energy(&state), 1e-5);
    assert!(forms.accelerations(&state).is_ok());
}

/// A slider whose guide is prescribed: its coordinate is eliminated, its velocity is not.
struct Guided;

#[lagrangian(coordinates = [guide, angle])]
impl Guided {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.guide + q.angle.sin(), -q.angle.cos())
    }

    #[holonomic(eliminate = guide)]
    fn drive(&self, q: &Coordinates, t: f64) -> f64 {
        q.guide - t.sin()
    }

    #[force(at = bob)]
    fn drag(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        -0.3 * self.bob_velocity(q, v)
    }
}

#[test]
fn velocities_take_eliminated_coordinates_too() {
    let state = State::new([0.7], [0.4]).at_time(0.2);
    let velocity = Vector2::new(0.2_f64.cos() + 0.4 * 0.7_f64.cos(), 0.4 * 0.7_f64.sin());
    let found = Guided.bob_velocity(&Guided.coordinates(&state), &Guided.velocities(&state));
    all_close(found.as_slice(), velocity.as_slice(), 1e-14);
    let arm = Vector2::new(0.7_f64.cos(), 0.7_f64.sin());
    all_close(Guided.applied_forces(&state), [-0.3 * velocity.dot(&arm)], 1e-13);
}
