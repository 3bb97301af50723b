//! A table on four rough feet, which share impulses: whatever the shares are, they make the change of the
//! velocities.

use lagrangian::prelude::*;

use crate::support::close::close;

/// The sides on which the feet are.
const SIDES: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
const INERTIA: Vector3<f64> = Vector3::new(0.1, 0.15, 0.2);

#[derive(Clone, Copy)]
struct Table {
    roughness: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [top: Pose])]
impl Table {
    #[body(mass = 2.0, inertia = [0.1, 0.15, 0.2])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        q.top
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        19.62 * q.top.translation.vector.z
    }

    fn feet(&self, q: &Coordinates) -> [Vector3<f64>; 4] {
        let sides: [[f64; 2]; 4] = SIDES;
        sides.map(|side| {
            q.top.translation.vector + q.top.rotation * Vector3::new(0.5 * side[0], 0.33 * side[1], -0.39)
        })
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> [f64; 4] {
        self.feet(q).map(|foot| foot.z)
    }

    #[friction(coefficient = self.roughness, normal = floor[0])]
    fn first(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let foot = self.feet_velocity(q, v)[0];
        Vector2::new(foot.x, foot.y)
    }

    #[friction(coefficient = self.roughness, normal = floor[1])]
    fn second(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let foot = self.feet_velocity(q, v)[1];
        Vector2::new(foot.x, foot.y)
    }

    #[friction(coefficient = self.roughness, normal = floor[2])]
    fn third(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let foot = self.feet_velocity(q, v)[2];
        Vector2::new(foot.x, foot.y)
    }

    #[friction(coefficient = self.roughness, normal = floor[3])]
    fn fourth(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let foot = self.feet_velocity(q, v)[3];
        Vector2::new(foot.x, foot.y)
    }
}

/// The first impact of a table that stands on two feet, tilted by an angle, and moves with a velocity and a
/// rate about the vertical: its impulses sum up to the change of both momenta, and are within friction.
fn falls(table: Table, tilt: f64, velocity: Vector3<f64>, rate: f64) -> [f64; 4] {
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), tilt);
    let height = -(rotation * Vector3::new(0.5, 0.33, -0.39)).z;
    let top = Isometry3::from_parts(Translation3::new(0.0, 0.0, height), rotation);
    let angular = rotation.inverse() * Vector3::new(0.0, 0.0, rate);
    let speeds = TableVelocities { top: PoseVelocity { linear: velocity, angular } };
    let mut motion = table.simulate(table.state(TableCoordinates { top }, speeds));
    loop {
        let switch = motion.advance_to_switch(2.0).unwrap().expect("an impact");
        let told = motion.impulses();
        let total: f64 = told.floor.iter().sum();
        if total < 0.01 {
            continue;
        }
        let place = table.coordinates(&switch.before).top;
        let [before, after] = [&switch.before, &switch.state].map(|state| table.velocities(state).top);
        let (mut impulse, mut moment) = (Vector3::zeros(), Vector3::zeros());
        let along = [told.first, told.second, told.third, told.fourth];
        for (side, (along, press)) in SIDES.iter().zip(along.iter().zip(told.floor)) {
            let own = Vector3::new(along[0], along[1], press);
            impulse += own;
            moment += (place.rotation * Vector3::new(0.5 * side[0], 0.33 * side[1], -0.39)).cross(&own);
            let limit = table.roughness * press;
            assert!(press >= 0.0 && along[0].hypot(along[1]) <= limit + 1e-11, "{told:?}");
        }
        let turned = place.rotation * (after.angular - before.angular).component_mul(&INERTIA);
        for i in 0..3 {
            close(impulse[i], 2.0 * (after.linear - before.linear)[i], 1e-11);
            close(moment[i], turned[i], 1e-11);
        }
        return told.floor;
    }
}

#[test]
fn impulses_of_a_table_that_falls_straight_are_symmetric() {
    for tilt in [0.02, 0.1, 0.2] {
        for roughness in [0.1, 0.4, 1.2] {
            let table = Table { roughness, restitution: 0.0 };
            let [a, b, c, d] = falls(table, tilt, Vector3::zeros(), 0.0);
            close(a, b, 1e-9);
            close(c, d, 1e-9);
        }
    }
}

#[test]
fn impulses_of_a_table_are_its_changes_of_momentum() {
    for (restitution, rate) in [(0.0, 0.8), (0.4, 0.0), (0.4, -1.5)] {
        for roughness in [0.4, 0.9, 1.2] {
            let velocity = Vector3::new(0.3, -0.5, 0.0) * rate;
            falls(Table { roughness, restitution }, 0.2, velocity, rate);
        }
    }
}
