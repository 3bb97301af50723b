//! N08, N10, N11, S10, S15: friction from reactions.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// N10: a block on a free wedge, rough between them. The block keeps its place on the wedge by a constraint
/// whose reaction is the normal force.
struct Wedge {
    friction: f64,
}

const ANGLE: f64 = core::f64::consts::PI / 6.0;

#[lagrangian(coordinates = [wedge, x, y])]
impl Wedge {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        1.5 * v.wedge * v.wedge + 0.5 * (v.x * v.x + v.y * v.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn slope(&self, q: &Coordinates) -> f64 {
        ANGLE.cos() * q.y + ANGLE.sin() * (q.x - q.wedge)
    }

    #[friction(coefficient = self.friction, normal = slope)]
    fn slip(&self, v: &Velocities) -> f64 {
        ANGLE.cos() * (v.x - v.wedge) - ANGLE.sin() * v.y
    }
}

#[test]
fn a_block_slides_down_a_free_wedge() {
    let wedge = Wedge { friction: 0.2 };
    let state = State::at_rest([0.0; 3]);
    let [pushed, x, y] = wedge.accelerations(&state).unwrap();
    close(pushed, -0.8776496286036762, 1e-13);
    close(ANGLE.cos() * (x - pushed) - ANGLE.sin() * y, 4.05368999462806, 1e-13);
    let mut motion = wedge.simulate(state).with_tolerance(TIGHT);
    close(motion.advance_to(1.0).unwrap().q[0], -0.5 * 0.8776496286036762, 1e-12);
    close(motion.reactions().slope, 8.056884396823506, 1e-13);
}

#[test]
fn a_block_sticks_to_a_rough_wedge() {
    let mut motion = Wedge { friction: 0.58 }.simulate(State::at_rest([0.0; 3])).with_tolerance(TIGHT);
    assert_eq!(motion.advance_to(1e6).unwrap().q, [0.0; 3]);
    let mut motion = Wedge { friction: 0.57 }.simulate(State::at_rest([0.0; 3])).with_tolerance(TIGHT);
    assert!(motion.advance_to(1.0).unwrap().q[0] < -1e-3);
}

/// N11: a bead on a rough vertical hoop.
struct Bead {
    radius: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Bead {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn hoop(&self, q: &Coordinates) -> f64 {
        q.x * q.x + q.y * q.y - self.radius * self.radius
    }

    #[friction(coefficient = self.friction, normal = bead)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (q.x * v.y - q.y * v.x) / self.radius
    }
}

#[test]
fn a_bead_on_a_rough_hoop_swings_and_sticks() {
    let hoop = Bead { radius: 0.5, friction: 0.2 };
    let place = |angle: f64| [0.5 * angle.sin(), -0.5 * angle.cos()];
    let mut motion = hoop.simulate(State::at_rest(place(1.2))).with_tolerance(TIGHT);
    let half_swings = [0.743743947144961, 0.7089741875605751];
    let turning = [-0.5833305635930566, 0.1521974451156583];
    let mut time = 0.0;
    for (half, angle) in half_swings.into_iter().zip(turning) {
        time += half;
        let state = motion.advance_to(time).unwrap();
        all_close(state.q, place(angle), 1e-11);
        assert!(state.v.iter().all(|v| v.abs() < 1e-10), "{state:?}");
    }
    let state = *motion.advance_to(100.0).unwrap();
    all_close(state.q, place(turning[1]), 1e-11);
}

/// S10: a particle on a rough helix, with the normal force as a function.
struct Helix {
    kinetic: f64,
    fixed: f64,
}

#[lagrangian(coordinates = [theta])]
impl Helix {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * 2.0 * 0.8 * 0.8 * (1.0 + 0.3 * 0.3) * v.theta * v.theta
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * 0.8 * 0.3 * q.theta
    }

    fn normal(&self, v: &Velocities) -> f64 {
        2.0 * ((0.8 * v.theta.powi(2)).powi(2) + 9.81_f64.powi(2) / (1.0 + 0.3 * 0.3)).sqrt()
    }

    fn kinetic_friction(&self, v: &Velocities) -> f64 {
        self.kinetic * self.normal(v)
    }

    fn static_friction(&self, v: &Velocities) -> f64 {
        self.fixed * self.normal(v)
    }

    #[friction(limit = kinetic_friction, static_limit = static_friction)]
    fn slip(&self, v: &Velocities) -> f64 {
        0.8 * 1.09_f64.sqrt() * v.theta
    }
}

#[test]
fn a_particle_climbs_a_rough_helix_and_comes_back() {
    let helix = Helix { kinetic: 0.2, fixed: 0.25 };
    let mut motion = helix.simulate(State::new([0.1], [3.0])).with_tolerance(TIGHT);
    let top = motion.advance_to(0.5223053881546121).unwrap();
    close(top.q[0], 0.8727044725184596, 1e-13);
    close_on(3.0, top.v[0], 0.0, 1e-12);
    let state = *motion.advance_to(0.5223053881546121 + 1.0674417908685246).unwrap();
    let arc = 0.8 * 1.09_f64.sqrt();
    close(-state.v[0] * arc, 1.0, 1e-11);
    close((0.8727044725184596 - state.q[0]) * arc, 0.5347856778342413, 1e-11);
    close(-motion.advance_to(200.0).unwrap().v[0] * arc, 3.026659914408635, 1e-11);
    let mut stuck = Helix { kinetic: 0.2, fixed: 0.31 }.simulate(State::at_rest([0.1]));
    assert_eq!(stuck.advance_to(100.0).unwrap().q[0], 0.1);
    close(stuck.reactions().slip, 5.637765514811697, 1e-13);
}

/// S15: a particle on a rough parabola without gravity.
struct Parabola {
    friction: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Parabola {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn curve(&self, q: &Coordinates) -> f64 {
        q.x - q.y * q.y + 4.0
    }

    #[friction(coefficient = self.friction, normal = particle)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (2.0 * q.y * v.x + v.y) / (1.0 + 4.0 * q.y * q.y).sqrt()
    }
}

#[test]
fn a_particle_slows_down_on_a_rough_parabola() {
    let along = |y: f64, speed: f64| {
        let size = (1.0 + 4.0 * y * y).sqrt();
        [2.0 * y * speed / size, speed / size]
    };
    let start = State::new([-3.0, -1.0], along(-1.0, 2.0));
    let mut motion = Parabola { friction: 0.3 }.simulate(start).with_tolerance(TIGHT);
    let vertex = motion.advance_to_event(|state: &State<f64, 2>| state.q[1], 10.0).unwrap().unwrap().state;
    close(vertex.v[1], 1.4347671413696667, 1e-12);
    let end = motion.advance_to_event(|state: &State<f64, 2>| state.q[1] - 1.0, 10.0).unwrap().unwrap().state;
    close(end.v[0].hypot(end.v[1]), 1.0292783749770426, 1e-12);
    close(end.t, 2.1269097680719534, 1e-12);
}

/// N08: Painlevé's rod, its lower end on a rough floor.
struct Rod {
    friction: f64,
}

#[lagrangian(coordinates = [x, y, theta])]
impl Rod {
    #[body(mass = 1.0, inertia = 1.0 / 3.0)]
    fn rod(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.theta)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    /// The lower end, a metre from the middle.
    #[unilateral]
    fn tip(&self, q: &Coordinates) -> f64 {
        q.y - q.theta.sin()
    }

    #[friction(coefficient = self.friction, normal = tip)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x + q.theta.sin() * v.theta
    }
}

/// The rod with its end on the floor, sliding at a speed. It leans at the angle where the least friction jams
/// it: tan θ = 2, with a coefficient of 4/3.
fn rod(speed: f64) -> State<f64, 3> {
    let angle = 2.0_f64.atan();
    State::new([0.0, angle.sin(), angle], [speed, 0.0, 0.0])
}

#[test]
fn painleves_rod_has_no_motion_beyond_a_friction() {
    for speed in [-1.0, 1.0] {
        let below = Rod { friction: 1.2 }.simulate(rod(speed)).advance_to(0.01).map(|state| state.t);
        assert_eq!(below, Ok(0.01));
    }
    let beyond = [-1.0, 1.0].map(|speed| Rod { friction: 1.5 }.simulate(rod(speed)).advance_to(0.01).err());
    let named = |error: &Option<MotionError<f64>>| match error.as_ref().map(|error| error.cause) {
        Some(Cause::NoReaction { name, .. } | Cause::SeveralReactions { name, .. }) => {
            name.to_string() == "tip"
        }
        _ => false,
    };
    assert!(beyond.iter().filter(|error| named(error)).count() == 1, "{beyond:?}");
}
