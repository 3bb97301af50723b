//! The end of rest between rough planes: the load that the last possible shares bear, however often a motion
//! is asked on the way there.

use lagrangian::prelude::*;

use crate::support::close::close_on;

const PLACES: [[f64; 2]; 3] = [[-0.457, 0.056], [-0.611, 0.032], [-0.161, 0.163]];
const ANGLES: [f64; 3] = [0.6265, 1.9823, 2.8522];
const ROUGH: [f64; 3] = [0.367, 0.174, 0.386];
const LOAD: [f64; 3] = [0.783, -1.978, 0.8175];
const GROWTH: [f64; 3] = [-0.03125, -0.1756, -0.1807];

fn normal(plane: usize) -> Vector2<f64> {
    Vector2::new(ANGLES[plane].cos(), ANGLES[plane].sin())
}

/// A body that touches three planes, under a load that grows evenly.
struct Wedged {
    places: [Vector2<f64>; 3],
    normals: [Vector2<f64>; 3],
    rough: [f64; 3],
    load: [f64; 3],
    growth: [f64; 3],
}

#[lagrangian(coordinates = [x, y, turn])]
impl Wedged {
    #[body(mass = 1.0, inertia = 0.53)]
    fn body(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.turn)
    }

    #[force]
    fn pull(&self, t: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| self.load[i] + self.growth[i] * t)
    }

    fn foot(&self, q: &Coordinates, i: usize) -> Vector2<f64> {
        let (place, cos, sin) = (self.places[i], q.turn.cos(), q.turn.sin());
        self.body(q).0 + Vector2::new(place.x * cos - place.y * sin, place.x * sin + place.y * cos)
    }

    #[unilateral]
    fn plane(&self, q: &Coordinates) -> [f64; 3] {
        [0, 1, 2].map(|i| (self.foot(q, i) - self.places[i]).dot(&self.normals[i]))
    }

    #[friction(coefficient = self.rough[..], normal = plane)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 3] {
        [0, 1, 2].map(|i| {
            let speed = self.body_velocity(q, v).at(self.foot(q, i));
            speed.x * self.normals[i].y - speed.y * self.normals[i].x
        })
    }
}

/// The latest time at which edges of the cones of friction bear the load: the best vertex of the linear
/// programme.
fn limit() -> f64 {
    let wrench = |plane: usize, force: Vector2<f64>| {
        let [x, y] = PLACES[plane];
        Vector3::new(force.x, force.y, x * force.y - y * force.x)
    };
    let mut edges = Vec::new();
    for plane in 0..3 {
        let (n, rough) = (normal(plane), ROUGH[plane]);
        let along = Vector2::new(n.y, -n.x);
        edges.extend([1.0, -1.0].map(|side| wrench(plane, n + side * rough * along)));
    }
    let mut latest = 0.0_f64;
    for (i, &one) in edges.iter().enumerate() {
        for &other in &edges[i + 1..] {
            let table = Matrix3::from_columns(&[one, other, Vector3::from(GROWTH)]);
            if let Some(bears) = table.lu().solve(&-Vector3::from(LOAD))
                && bears.x >= 0.0
                && bears.y >= 0.0
            {
                latest = latest.max(bears.z);
            }
        }
    }
    latest
}

#[test]
fn rest_ends_at_its_limit_however_often_it_is_asked() {
    let body = Wedged {
        places: PLACES.map(Vector2::from),
        normals: [0, 1, 2].map(normal),
        rough: ROUGH,
        load: LOAD,
        growth: GROWTH,
    };
    let limit = limit();
    let start = State::at_rest([0.0; 3]).at_time(4.1);
    for parts in [1, 7, 700] {
        let mut motion = body.simulate(start);
        let mut asked = (1..=parts).map(|part| 4.1 + 0.7 * f64::from(part) / f64::from(parts));
        let end = asked.find_map(|t| motion.advance_to_switch(t).unwrap());
        close_on(1.0, end.map_or(f64::NAN, |switch| switch.state.t), limit, 1e-9);
    }
    // Fixed steps, each of which ends a piece.
    let mut motion = body.stepper::<Jet<6>>(start);
    while motion.state().t < limit - 1e-3 {
        motion.step(1e-3, &[]).unwrap();
        assert_eq!(motion.state().v, [0.0; 3]);
    }
}
