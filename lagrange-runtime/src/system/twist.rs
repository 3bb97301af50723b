//! Velocities of rigid bodies.

use nalgebra::{Vector2, Vector3};

use crate::number::real::Real;

/// Velocity of a rigid body in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist2<R> {
    /// Where the body's reference point is \[m\].
    pub position: Vector2<R>,
    /// Velocity of the reference point \[m/s\].
    pub velocity: Vector2<R>,
    /// The same in the axes of the body.
    pub velocity_in_body: Vector2<R>,
    /// Angular velocity, counter-clockwise \[rad/s\].
    pub angular_velocity: R,
}

/// Velocity of a rigid body in space, returned by `self.hub_velocity(q, v)`. The velocities of a state have a
/// [`PoseVelocity`](crate::attitude::PoseVelocity) for each pose among the coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist3<R> {
    /// Where the body's reference point is \[m\].
    pub position: Vector3<R>,
    /// Velocity of the reference point \[m/s\].
    pub velocity: Vector3<R>,
    /// The same in the axes of the body.
    pub velocity_in_body: Vector3<R>,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: Vector3<R>,
    /// The same in the axes of the body, as a gyroscope on it measures it.
    pub angular_velocity_in_body: Vector3<R>,
}

impl<R: Real> Twist2<R> {
    /// Velocity of the body's material point that is at a place now \[m/s\]: ṙ + ω × (place − r).
    #[inline]
    pub fn at(&self, place: Vector2<R>) -> Vector2<R> {
        let (arm, rate) = (place - self.position, self.angular_velocity);
        self.velocity + Vector2::new(-(rate * arm.y), rate * arm.x)
    }
}

impl<R: Real> Twist3<R> {
    /// Velocity of the body's material point that is at a place now \[m/s\]: ṙ + ω × (place − r).
    #[inline]
    pub fn at(&self, place: Vector3<R>) -> Vector3<R> {
        let (arm, rate) = (place - self.position, self.angular_velocity);
        let turned = Vector3::new(
            rate.y * arm.z - rate.z * arm.y,
            rate.z * arm.x - rate.x * arm.z,
            rate.x * arm.y - rate.y * arm.x,
        );
        self.velocity + turned
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contact_point_of_a_rolling_wheel_rests() {
        let (x, y, speed, radius) = (0.3, 2.0, 1.5, 0.5);
        let velocity = Vector2::new(speed, 0.0);
        let wheel = Twist2 {
            position: Vector2::new(x, y),
            velocity,
            velocity_in_body: velocity,
            angular_velocity: -speed / radius,
        };
        assert_eq!(wheel.at(Vector2::new(x, y - radius)), Vector2::zeros());
        assert_eq!(wheel.at(Vector2::new(x, y + radius)), 2.0 * velocity);
        assert_eq!(wheel.at(Vector2::new(x + radius, y)), Vector2::new(speed, -speed));
    }

    #[test]
    fn in_space_the_angular_velocity_crosses_the_arm() {
        let rate = Vector3::new(0.2, -1.1, 0.7);
        let (position, velocity) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(-0.4, 0.1, 0.9));
        let body = Twist3 {
            position,
            velocity,
            velocity_in_body: velocity,
            angular_velocity: rate,
            angular_velocity_in_body: rate,
        };
        let place = Vector3::new(-0.3, 0.8, 2.0);
        assert_eq!(body.at(place), velocity + rate.cross(&(place - position)));
        assert_eq!(body.at(position), velocity);
    }
}
