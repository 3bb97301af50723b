//! A ball that knocks against a tower of boxes: thirteen rows in one impact, of which frictions of one face
//! share a slip.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

#[derive(Clone, Copy)]
struct Tower {
    friction: [f64; 6],
    mass: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [x: [N], y: [N], phi: [N], bx, by])]
impl Tower {
    const N: usize = 3;
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let mut sum = 0.5 * self.mass * (v.bx * v.bx + v.by * v.by);
        for i in 0..Self::N {
            sum += 0.5 * (v.x[i] * v.x[i] + v.y[i] * v.y[i] + v.phi[i] * v.phi[i] / 6.0);
        }
        sum
    }
    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        let mut sum = 9.81 * self.mass * q.by;
        for i in 0..Self::N {
            sum += 9.81 * q.y[i];
        }
        sum
    }
    fn arm(&self, phi: f64, side: usize) -> Vector2<f64> {
        let half = if side == 0 { -0.5 } else { 0.5 };
        Vector2::new(half * phi.cos() + 0.5 * phi.sin(), half * phi.sin() - 0.5 * phi.cos())
    }
    #[unilateral]
    fn corners(&self, q: &Coordinates) -> [f64; 2 * Self::N] {
        let mut gaps = [0.0; 2 * Self::N];
        for i in 0..Self::N {
            for side in 0..2 {
                let corner = Vector2::new(q.x[i], q.y[i]) + self.arm(q.phi[i], side);
                gaps[2 * i + side] = if i == 0 {
                    corner.y
                } else {
                    let below = corner - Vector2::new(q.x[i - 1], q.y[i - 1]);
                    q.phi[i - 1].cos() * below.y - q.phi[i - 1].sin() * below.x - 0.5
                };
            }
        }
        gaps
    }
    #[friction(coefficient = self.friction[..], normal = corners)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2 * Self::N] {
        let mut slips = [0.0; 2 * Self::N];
        for i in 0..Self::N {
            for side in 0..2 {
                let arm = self.arm(q.phi[i], side);
                let corner = Vector2::new(v.x[i] - v.phi[i] * arm.y, v.y[i] + v.phi[i] * arm.x);
                slips[2 * i + side] = if i == 0 {
                    corner.x
                } else {
                    let at = Vector2::new(q.x[i] - q.x[i - 1], q.y[i] - q.y[i - 1]) + arm;
                    let (x, y) = (v.x[i - 1] - v.phi[i - 1] * at.y, v.y[i - 1] + v.phi[i - 1] * at.x);
                    q.phi[i - 1].cos() * (corner.x - x) + q.phi[i - 1].sin() * (corner.y - y)
                };
            }
        }
        slips
    }
    /// A ball of radius 0.1 m against the left face of the box in the middle.
    #[unilateral(restitution = self.restitution)]
    fn hit(&self, q: &Coordinates) -> f64 {
        let d = Vector2::new(q.bx - q.x[1], q.by - q.y[1]);
        -(q.phi[1].cos() * d.x + q.phi[1].sin() * d.y) - 0.6
    }
}

#[test]
fn a_tower_takes_the_knock_of_a_ball() {
    let mut random = Samples::new(23);
    let mut knocked = 0;
    for _ in 0..15 {
        let [low, middle, high] = [(); 3].map(|()| random.number(0.2, 0.9));
        let friction = [low, low, middle, middle, high, high];
        let [mass, restitution] = [[0.05, 1.0], [0.0, 0.8]].map(|[a, b]| random.number(a, b));
        let tower = Tower { friction, mass, restitution };
        let x: [f64; 3] = [(); 3].map(|()| random.number(-0.1, 0.1));
        let [height, speed, rise] = [[1.15, 1.85], [1.0, 6.0], [-1.0, 1.0]].map(|[a, b]| random.number(a, b));
        let q = [x[0], x[1], x[2], 0.5, 1.5, 2.5, 0.0, 0.0, 0.0, x[1] - 0.9, height];
        let start = State::new(q, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, speed, rise]);
        let mut motion = tower.simulate(start).with_tolerance(1e-9);
        let energy = motion.energy();
        let knock = motion.advance_to_switch(0.3 / speed + 0.1).unwrap().expect("the ball hits the box");
        close_on(1.0, knock.state.t, 0.3 / speed, 1e-13);
        // What the ball loses, the box gains, and friction hands on.
        let v = knock.state.v;
        let momentum = mass * v[9] + v[0] + v[1] + v[2];
        let by_floor = motion.impulses().slips;
        close_on(mass * speed, momentum, mass * speed + by_floor[0] + by_floor[1], 1e-12);
        let opening =
            v[1] - v[7] * (height + rise * knock.state.t - 4.905 * knock.state.t.powi(2) - 1.5) - v[9];
        assert!(opening > restitution * speed * (1.0 - 1e-9), "{opening} {speed}");
        motion.advance_to(knock.state.t + 0.3).unwrap();
        assert!(motion.energy() < energy * (1.0 + 1e-12));
        knocked += usize::from(v[7].abs() > 1e-3);
    }
    assert!(knocked > 5, "{knocked}");
}

/// A point in the corner of a floor and a wall that leans over it.
struct Corner {
    lean: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Corner {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral(restitution = 0.0)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.y * self.lean.cos() - q.x * self.lean.sin()
    }
}

#[test]
fn a_contact_that_hardly_opens_is_struck_like_one_that_touches() {
    let mut samples = Samples::new(3);
    for _ in 0..100 {
        // The wall pushes the point into the floor.
        let corner = Corner { lean: samples.number(1.7, 2.8), restitution: samples.number(0.0, 1.0) };
        let up = if samples.unit() < 0.2 { 0.0 } else { 10_f64.powf(samples.number(-15.0, -1.0)) };
        let along = [-corner.lean.sin(), corner.lean.cos()];
        let closing = along[0] + along[1] * up;
        let after = corner.simulate(State::new([0.0; 2], [1.0, up])).advance_to(1e-9).unwrap().v;
        // Both bear: the floor stops the point, and the wall returns it along the floor.
        let back = -corner.restitution * closing / along[0];
        if back * back < 1.0 {
            close_on(1.0, after[0], back, 1e-12);
            close_on(1.0, after[1], 0.0, 1e-12);
        }
    }
}
