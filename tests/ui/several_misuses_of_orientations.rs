use lagrangian::prelude::*;

struct Body;

#[lagrangian(coordinates = [hull: Pose, gimbals: [Rotation; 2], attitude: Rotation])]
impl Body {
    #[kinetic]
    fn turning(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * v.attitude.norm_squared() + q.to_array()[0] + v.hull.torsional
    }

    #[holonomic(eliminate = attitude)]
    fn upright(&self, q: &Coordinates) -> f64 {
        (q.attitude * Vector3::z()).x
    }

    #[force]
    fn everything(&self) -> [f64; 15] {
        [0.0; 15]
    }

    #[force(on = hull)]
    fn thrust(&self) -> Vector3<f64> {
        Vector3::x()
    }

    #[force(on = attitude)]
    fn torque(&self) -> f64 {
        1.0
    }

    #[force(on = gimbals[2])]
    fn third(&self) -> Vector3<f64> {
        Vector3::x()
    }

    #[force(on = attitude[0])]
    fn element(&self) -> Vector3<f64> {
        Vector3::x()
    }

    #[force(on = gimbals)]
    fn pair(&self) -> [Vector3<f64>; 3] {
        [Vector3::x(); 3]
    }
}

fn main() {}
