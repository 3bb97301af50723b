//! A state of named velocities, which are not its numbers.
use lagrangian::prelude::*;

struct Body;

#[lagrangian(coordinates = [hull: Pose])]
impl Body {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }
}

fn main() {
    let velocity = PoseVelocity { linear: Vector3::zeros(), angular: Vector3::x() };
    let hull = Isometry3::identity();
    let state = State::new(BodyCoordinates { hull }, BodyVelocities { hull: velocity });
    let _ = Body.energy(&state);
}
