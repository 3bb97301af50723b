//! The end of rest between rough planes: the load that the last possible shares bear, however often a motion
//! is asked on the way there.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

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

/// A wedge between the floor and a block, which leans against a wall. A force that grows evenly pulls it out.
struct Press {
    masses: [f64; 2],
    weights: [f64; 2],
    angle: f64,
    rough: [f64; 3],
    pull: [f64; 2],
}

#[lagrangian(coordinates = [wedge_x, wedge_y, block_x, block_y])]
impl Press {
    #[point(mass = self.masses[0])]
    fn wedge(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.wedge_x, q.wedge_y)
    }

    #[point(mass = self.masses[1])]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.block_x, q.block_y)
    }

    #[force(at = wedge)]
    fn on_wedge(&self, t: f64) -> Vector2<f64> {
        Vector2::new(self.pull[0] - self.pull[1] * t, -self.weights[0])
    }

    #[force(at = block)]
    fn on_block(&self) -> Vector2<f64> {
        Vector2::new(0.0, -self.weights[1])
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        self.wedge(q).y
    }

    #[unilateral]
    fn slope(&self, q: &Coordinates) -> f64 {
        let apart = self.block(q) - self.wedge(q);
        apart.y * self.angle.cos() + apart.x * self.angle.sin()
    }

    #[unilateral]
    fn wall(&self, q: &Coordinates) -> f64 {
        -self.block(q).x
    }

    #[friction(coefficient = self.rough[0], normal = floor)]
    fn on_floor(&self, v: &Velocities) -> f64 {
        v.wedge_x
    }

    #[friction(coefficient = self.rough[1], normal = slope)]
    fn on_slope(&self, v: &Velocities) -> f64 {
        (v.block_x - v.wedge_x) * self.angle.cos() - (v.block_y - v.wedge_y) * self.angle.sin()
    }

    #[friction(coefficient = self.rough[2], normal = wall)]
    fn on_wall(&self, v: &Velocities) -> f64 {
        v.block_y
    }
}

impl Press {
    /// The pull with which the wedge has an acceleration where all three surfaces slip, and the reactions.
    /// With `way` = 1 it goes in, with −1 out.
    fn slipping(&self, way: f64, acceleration: f64) -> (f64, [f64; 3]) {
        let [floor, slope, wall] = self.rough.map(|rough| rough * way);
        let ((sin, cos), [light, heavy]) = (self.angle.sin_cos(), self.masses);
        let across = sin + slope * cos;
        let press =
            (self.weights[1] + heavy * acceleration * self.angle.tan()) / (cos - slope * sin - wall * across);
        let bears = self.weights[0] + press * (cos - slope * sin);
        (light * acceleration + press * across + floor * bears, [bears, press, press * across])
    }

    /// Whether reactions are possible with which all is at rest under a pull: all are linear in that of the
    /// slope and its friction, so some vertex of the polygon of these two keeps every limit.
    fn rests(&self, pull: f64) -> bool {
        let (sin, cos) = self.angle.sin_cos();
        let along = Vector3::new(sin, cos, 0.0);
        let normals = [Vector3::new(cos, -sin, self.weights[0]), Vector3::x(), along];
        let forces = [along - pull * Vector3::z(), Vector3::y(), Vector3::new(-cos, sin, self.weights[1])];
        let mut limits = Vec::from(normals);
        for i in 0..3 {
            limits.extend([1.0, -1.0].map(|way| self.rough[i] * normals[i] + way * forces[i]));
        }
        limits.iter().enumerate().any(|(i, one)| {
            limits[..i].iter().any(|other| {
                let corner = one.cross(other);
                corner.z.abs() > 1e-12 && limits.iter().all(|limit| limit.dot(&corner) / corner.z >= -1e-12)
            })
        })
    }
}

#[test]
fn a_wedge_that_sticks_is_pulled_out_at_its_limit() {
    let mut samples = Samples::new(12);
    let mut jumps = 0;
    for _ in 0..60 {
        let mut press = Press {
            masses: [samples.number(0.5, 2.0), samples.number(0.5, 2.0)],
            weights: [samples.number(1.0, 5.0), samples.number(5.0, 20.0)],
            angle: samples.number(0.1, 0.6),
            rough: [0; 3].map(|_| samples.number(0.03, 0.35)),
            pull: [0.0, samples.number(1.0, 20.0)],
        };
        let [(out, _), (pushed_in, _)] = [-1.0, 1.0].map(|way| press.slipping(way, 0.0));
        press.pull[0] = out + (pushed_in - out) * samples.number(0.1, 0.9);
        // A slope steeper than its friction, so that the block slides down when the wedge goes.
        if press.angle.tan() < 1.05 * press.rough[1] || !press.rests(press.pull[0]) {
            continue;
        }
        let rests_until = |t: f64| press.rests(press.pull[0] - press.pull[1] * t);
        let (mut last, mut first) = (0.0, 100.0);
        for _ in 0..60 {
            let middle = 0.5 * (last + first);
            *(if rests_until(middle) { &mut last } else { &mut first }) = middle;
        }
        let mut motion = press.simulate(State::at_rest([0.0; 4]));
        let before = motion.advance_to(last * (1.0 - 1e-8)).unwrap();
        assert_eq!((before.q, before.v), ([0.0; 4], [0.0; 4]));
        // The wedge jumps to an acceleration, or begins with none.
        let slope = press.slipping(-1.0, 1.0).0 - out;
        let acceleration = (press.pull[0] - press.pull[1] * last - out) / slope;
        assert!(press.slipping(-1.0, acceleration).1.iter().all(|&reaction| reaction > 0.0));
        jumps += usize::from(acceleration < -1e-3);
        let passed = 0.01_f64;
        let way = passed * passed * (acceleration / 2.0 - press.pull[1] / slope * passed / 6.0);
        close_on(1.0, motion.advance_to(last + passed).unwrap().q[0] / way, 1.0, 1e-4);
    }
    assert!(jumps > 10, "{jumps}");
}
