//! Quantities that are conserved where all directions of space are alike.

use lagrangian::prelude::*;

use crate::support::close::{all_close_on_largest, close_on};

struct Body {
    across: f64,
    along: f64,
}

#[lagrangian(coordinates = [attitude: Rotation], analysis)]
impl Body {
    #[body(mass = 1.0, inertia = [self.across, self.across, self.along])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

#[test]
fn the_momentum_of_a_free_body_is_found_in_space_and_about_its_axis() {
    let about = "angular momentum about";
    assert_eq!(
        Body::CONSERVED,
        [
            "energy".to_owned(),
            format!("{about} x"),
            format!("{about} y"),
            format!("{about} z"),
            "angular momentum of attitude about z in its own axes".to_owned(),
        ]
    );
    let body = Body { across: 2.0, along: 0.5 };
    let (attitude, omega) = (UnitQuaternion::from_euler_angles(2.0, 1.0, -3.0), Vector3::new(0.4, -1.0, 3.0));
    let start = body.state(BodyCoordinates { attitude }, BodyVelocities { attitude: omega });
    let own = Vector3::new(2.0 * omega.x, 2.0 * omega.y, 0.5 * omega.z);
    let space = attitude * own;
    let [_, found @ ..] = body.conserved(&start);
    all_close_on_largest(found, [space.x, space.y, space.z, own.z], 1e-14);
    let end = *body.simulate(start).with_tolerance(1e-14).advance_to(5.0).unwrap();
    let [_, then @ ..] = body.conserved(&end);
    all_close_on_largest(then, found, 1e-12);
}

/// A satellite that swings an arm, in space.
struct Satellite;

#[lagrangian(coordinates = [hull: Pose, hinge], analysis)]
impl Satellite {
    #[body(mass = 2.0, inertia = [1.0, 1.5, 2.0])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[body(mass = 0.5, inertia = [0.1, 0.02, 0.1])]
    fn arm(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
            * Translation3::new(0.5, 0.0, 0.2)
            * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q.hinge)
            * Translation3::new(0.0, 0.7, 0.0)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.3 * q.hinge.cos()
    }
}

#[test]
fn a_system_free_in_space_keeps_its_momentum() {
    let found: Vec<&str> = Satellite::CONSERVED.to_vec();
    for axis in ["x", "y", "z"] {
        assert!(found.contains(&format!("angular momentum about {axis}").as_str()), "{found:?}");
    }
    assert_eq!(found.len(), 7, "{found:?}");
    let start = Satellite.state(
        SatelliteCoordinates {
            hull: Isometry3::from_parts(
                Translation3::new(0.3, -0.2, 1.0),
                UnitQuaternion::from_euler_angles(1.0, 0.4, 2.0),
            ),
            hinge: 0.3,
        },
        SatelliteVelocities {
            hull: PoseVelocity {
                linear: Vector3::new(0.1, 0.3, -0.2),
                angular: Vector3::new(0.5, -1.0, 0.7),
            },
            hinge: 0.4,
        },
    );
    let before = Satellite.conserved(&start);
    // Σ r × m ṙ + R I ω, by velocities of the bodies.
    let (q, v) = (SatelliteCoordinates::from(start.q), Satellite.velocities(&start));
    let mut total = Vector3::zeros();
    let spin = q.hull * v.hull.angular;
    let at = |place: Vector3<f64>| v.hull.linear + spin.cross(&(place - q.hull.translation.vector));
    let arm = Satellite.arm(&q);
    let pivot = q.hull * Point3::new(0.5, 0.0, 0.2);
    let hinge = q.hull * Vector3::z() * v.hinge;
    let places = [
        (2.0, Vector3::new(1.0, 1.5, 2.0), q.hull, v.hull.linear, spin),
        (
            0.5,
            Vector3::new(0.1, 0.02, 0.1),
            arm,
            at(arm.translation.vector) + hinge.cross(&(arm.translation.vector - pivot.coords)),
            spin + hinge,
        ),
    ];
    for (mass, inertia, pose, velocity, spin) in places {
        let own = pose.rotation.inverse() * spin;
        total +=
            pose.translation.vector.cross(&(mass * velocity)) + pose.rotation * inertia.component_mul(&own);
    }
    for (axis, expected) in ["x", "y", "z"].into_iter().zip(total.iter()) {
        let name = format!("angular momentum about {axis}");
        let place = found.iter().position(|&other| other == name).unwrap();
        close_on(total.norm(), before[place], *expected, 1e-13);
    }
    let end = *Satellite.simulate(start).with_tolerance(1e-14).advance_to(5.0).unwrap();
    all_close_on_largest(Satellite.conserved(&end), before, 1e-12);
    Satellite.verify().unwrap();
}
