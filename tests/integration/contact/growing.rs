//! Slips in two directions that a growing load begins, and bodies on several feet with friction.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// A block of 2 kg under a push of t newtons, whose direction turns from t = 3 on.
struct Pushed {
    angle: f64,
    turn: f64,
    limit: f64,
    /// What friction holds more while it sticks \[N].
    more: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.limit, self.angle])]
impl Pushed {
    #[point(mass = 2.0)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[friction(limit = self.limit, static_limit = self.limit + self.more)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y)
    }

    #[force(at = block)]
    fn push(&self, t: f64) -> Vector2<f64> {
        let phi = self.angle + self.turn * (t - 3.0);
        Vector2::new(t * phi.cos(), t * phi.sin())
    }
}

impl Pushed {
    fn ends(&self, tolerance: f64, end: f64) -> (f64, [f64; 2]) {
        let mut motion = self.simulate(State::at_rest([0.0; 2])).with_tolerance(tolerance);
        let switch = motion.advance_to_switch(end).unwrap().unwrap();
        // The slip begins at rest, and the switch is told at its own time.
        all_close(switch.state.v, [0.0; 2], 1e-9);
        (switch.state.t, motion.advance_to(end).unwrap().v)
    }
}

fn breaks_away(directions: impl Iterator<Item = u8>) {
    for k in directions {
        let angle = 0.3 * f64::from(k);
        for (tolerance, error) in [(1e-6, 1e-5), (1e-10, 1e-9), (1e-14, 1e-11)] {
            let (t, v) = Pushed { angle, turn: 0.0, limit: 3.0, more: 0.0 }.ends(tolerance, 5.0);
            close(t, 3.0, 1e-13);
            // m v = ∫ (t − 3) dt from 3 to 5.
            all_close(v, [angle.cos(), angle.sin()], error);
        }
    }
}

#[test]
fn a_block_breaks_away_under_a_growing_push() {
    breaks_away((0..24).step_by(4));
}

#[test]
#[ignore = "all directions: scripts/check.sh runs them"]
fn a_block_breaks_away_under_a_growing_push_in_all_directions() {
    breaks_away(0..24);
}

#[test]
fn a_push_that_turns_takes_the_slip_along() {
    // In polar coordinates of the velocity, from the slow manifold at 3 + 1e-4: Radau of SciPy at 1e-13.
    let angle = 0.64350110879;
    let references = [(0.1, [0.6871610783115, 0.7257697701797]), (1.0, [-0.6613094369422, 0.6798155872642])];
    for (turn, reference) in references {
        for (tolerance, error) in [(1e-8, 1e-7), (1e-14, 2e-12)] {
            let (_, v) = Pushed { angle, turn, limit: 3.0, more: 0.0 }.ends(tolerance, 5.0);
            all_close(v, reference, error);
        }
    }
}

#[test]
fn friction_that_holds_more_lets_go_with_a_jerk() {
    for angle in [0.0, 0.7, 2.0] {
        let (t, v) = Pushed { angle, turn: 0.0, limit: 3.0, more: 1.0 }.ends(TIGHT, 5.0);
        close(t, 4.0, 1e-13);
        // m v = ∫ (t − 3) dt from 4 to 5.
        all_close(v, [0.75 * angle.cos(), 0.75 * angle.sin()], 1e-11);
    }
}

/// A slip that begins too slowly takes millions of steps.
const STEPS: u64 = 100_000;

#[test]
fn derivatives_go_through_the_break_away() {
    for angle in [0.0, 0.6, 2.0] {
        let block = Pushed { angle, turn: 0.0, limit: 3.0, more: 0.0 };
        let varied = block.variational();
        let mut motion = varied.motion(State::at_rest([0.0; 2])).unwrap().with_max_steps(STEPS);
        let end = motion.advance_to(5.0).unwrap();
        // m v = (5 − limit)²/2 along the push.
        let (along, across) = ([angle.cos(), angle.sin()], [-angle.sin(), angle.cos()]);
        all_close([0, 1].map(|i| end.v_by_p[(i, 0)]), along.map(|x| -x), 1e-10);
        all_close([0, 1].map(|i| end.v_by_p[(i, 1)]), across, 1e-10);
    }
    // A push that turns: against motions beside it.
    let at = |limit: f64| {
        let block = Pushed { angle: 0.6, turn: 0.5, limit, more: 0.0 };
        block.simulate(State::at_rest([0.0; 2])).with_tolerance(1e-13).advance_to(5.0).unwrap().v
    };
    let (step, block) = (1e-4, Pushed { angle: 0.6, turn: 0.5, limit: 3.0, more: 0.0 });
    let varied = block.variational();
    let mut motion = varied.motion(State::at_rest([0.0; 2])).unwrap().with_max_steps(STEPS);
    let end = motion.advance_to(5.0).unwrap();
    let (above, below) = (at(3.0 + step), at(3.0 - step));
    let slopes = [0, 1].map(|i| (above[i] - below[i]) / (2.0 * step));
    all_close([0, 1].map(|i| end.v_by_p[(i, 0)]), slopes, 1e-8);
}

/// Two blocks that know nothing of each other.
struct Pair {
    limits: [f64; 2],
}

#[lagrangian(coordinates = [ax, ay, bx, by])]
impl Pair {
    #[point(mass = 2.0)]
    fn one(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.ax, q.ay)
    }

    #[point(mass = 1.0)]
    fn other(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.bx, q.by)
    }

    #[friction(limit = self.limits[0])]
    fn slip_of_one(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.ax, v.ay)
    }

    #[friction(limit = self.limits[1])]
    fn slip_of_other(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.bx, v.by)
    }

    #[force(at = one)]
    fn push(&self, t: f64) -> Vector2<f64> {
        Vector2::new(0.6 * t, 0.8 * t)
    }

    #[force(at = other)]
    fn pull(&self, t: f64) -> Vector2<f64> {
        Vector2::new(-0.28 * t, 0.96 * t)
    }
}

#[test]
fn blocks_break_away_at_their_own_times_also_together() {
    for limits in [[3.0, 3.0], [3.0, 2.0], [2.0, 3.0], [3.0, 3.0 + 1e-9], [3.0, 3.001]] {
        let pair = Pair { limits };
        let mut motion = pair.simulate(State::at_rest([0.0; 4])).with_tolerance(1e-12);
        let v = motion.advance_to(5.0).unwrap().v;
        let speeds = [v[0].hypot(v[1]), v[2].hypot(v[3])];
        let expected = [(5.0 - limits[0]).powi(2) / 4.0, (5.0 - limits[1]).powi(2) / 2.0];
        all_close(speeds, expected, 1e-10);
    }
}

/// A box on the floor: four corners with friction in both directions.
struct Crate {
    friction: f64,
    slope: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [place: Pose])]
impl Crate {
    #[body(mass = 2.0, inertia = [0.02, 0.03, 0.04])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        q.place
    }

    fn corner(&self, q: &Coordinates, k: usize) -> Vector3<f64> {
        let x = if k == 0 || k == 3 { 0.2 } else { -0.2 };
        let y = if k < 2 { 0.15 } else { -0.15 };
        q.place.translation.vector + q.place.rotation * Vector3::new(x, y, -0.1)
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, k: usize) -> Vector2<f64> {
        let slip = self.body_velocity(q, v).at(self.corner(q, k));
        Vector2::new(slip.x, slip.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        let place = q.place.translation.vector;
        2.0 * 9.81 * (place.z * self.slope.cos() + place.x * self.slope.sin())
    }

    #[unilateral(restitution = self.restitution)]
    fn east(&self, q: &Coordinates) -> f64 {
        self.corner(q, 0).z
    }

    #[unilateral(restitution = self.restitution)]
    fn north(&self, q: &Coordinates) -> f64 {
        self.corner(q, 1).z
    }

    #[unilateral(restitution = self.restitution)]
    fn west(&self, q: &Coordinates) -> f64 {
        self.corner(q, 2).z
    }

    #[unilateral(restitution = self.restitution)]
    fn south(&self, q: &Coordinates) -> f64 {
        self.corner(q, 3).z
    }

    #[friction(coefficient = self.friction, normal = east)]
    fn slip_east(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0)
    }

    #[friction(coefficient = self.friction, normal = north)]
    fn slip_north(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 1)
    }

    #[friction(coefficient = self.friction, normal = west)]
    fn slip_west(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 2)
    }

    #[friction(coefficient = self.friction, normal = south)]
    fn slip_south(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 3)
    }
}

/// Where a box starts.
struct Start {
    height: f64,
    yaw: f64,
    speed: f64,
    spin: f64,
}

impl Crate {
    fn at(&self, Start { height, yaw, speed, spin }: Start) -> State<f64, 6> {
        let place = Isometry3::from_parts(
            Translation3::new(0.0, 0.0, 0.1 + height),
            UnitQuaternion::from_euler_angles(0.0, 0.0, yaw),
        );
        let velocity =
            PoseVelocity { linear: Vector3::new(speed, 0.0, 0.0), angular: Vector3::new(0.0, 0.0, spin) };
        self.state(CrateCoordinates { place }, CrateVelocities { place: velocity })
    }
}

#[test]
fn a_box_rests_on_four_feet() {
    for (yaw, slope) in [(0.0, 0.0), (0.3, 0.0), (0.0, 0.2), (1.1, 0.2)] {
        let body = Crate { friction: 0.5, slope, restitution: 0.0 };
        let start = body.at(Start { height: 0.0, yaw, speed: 0.0, spin: 0.0 });
        let mut motion = body.simulate(start);
        let state = *motion.advance_to(100.0).unwrap();
        assert_eq!(state.v, [0.0; 6], "{yaw}, {slope}");
        all_close(state.q, start.q, 1e-15);
        let reactions = motion.reactions();
        let load = reactions.east + reactions.north + reactions.west + reactions.south;
        close(load, 2.0 * 9.81 * slope.cos(), 1e-12);
    }
}

#[test]
fn a_box_slides_and_spins_until_it_rests() {
    let body = Crate { friction: 0.5, slope: 0.0, restitution: 0.0 };
    for yaw in [0.0, 0.3, 0.9] {
        let mut motion = body.simulate(body.at(Start { height: 0.0, yaw, speed: 1.0, spin: 0.0 }));
        let switch = motion.advance_to_switch(5.0).unwrap().unwrap();
        close(switch.state.t, 1.0 / (0.5 * 9.81), 1e-9);
        let end = *motion.advance_to(5.0).unwrap();
        assert_eq!(end.v, [0.0; 6]);
        close_on(0.1, end.q[0], 1.0 / 9.81, 1e-9);
        // The feet are 0.25 m from the centre, and all bear the same: ω̇ = −µ m g r / I.
        let mut motion = body.simulate(body.at(Start { height: 0.0, yaw, speed: 0.0, spin: 2.0 }));
        let switch = motion.advance_to_switch(5.0).unwrap().unwrap();
        close(switch.state.t, 2.0 * 0.04 / (0.5 * 2.0 * 9.81 * 0.25), 1e-9);
        let end = *motion.advance_to(5.0).unwrap();
        assert_eq!(end.v, [0.0; 6]);
        // Both at once: nothing is known but that it comes to rest, and loses energy all the time.
        let mut motion = body.simulate(body.at(Start { height: 0.0, yaw, speed: 1.0, spin: 3.0 }));
        let mut energy = motion.energy();
        for k in 1..=50 {
            motion.advance_to(0.02 * f64::from(k)).unwrap();
            assert!(motion.energy() <= energy + 1e-9, "{yaw}, {k}");
            energy = motion.energy();
        }
        assert_eq!(motion.state().v, [0.0; 6]);
    }
}

#[test]
fn a_box_on_a_steep_slope_slides_and_one_that_falls_comes_to_rest() {
    let body = Crate { friction: 0.2, slope: 0.3, restitution: 0.0 };
    let end = *body
        .simulate(body.at(Start { height: 0.0, yaw: 0.3, speed: 0.0, spin: 0.0 }))
        .advance_to(5.0)
        .unwrap();
    close_on(1.0, end.v[0], -9.81 * 5.0 * (0.3_f64.sin() - 0.2 * 0.3_f64.cos()), 1e-9);
    for restitution in [0.0, 0.3] {
        let body = Crate { friction: 0.5, slope: 0.0, restitution };
        let start = body.at(Start { height: 0.1, yaw: 0.3, speed: 0.0, spin: 0.0 });
        let mut motion = body.simulate(start);
        assert_eq!(motion.advance_to(6.0).unwrap().v, [0.0; 6], "{restitution}");
        let reactions = motion.reactions();
        for reaction in [reactions.east, reactions.north, reactions.west, reactions.south] {
            close(reaction, 0.5 * 9.81, 1e-9);
        }
    }
}

/// A plate on four feet that press with a given force.
struct Plate {
    pull: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Plate {
    #[body(mass = 2.0, inertia = 0.04)]
    fn body(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, x: f64, y: f64) -> Vector2<f64> {
        let foot = Vector2::new(q.x, q.y) + Rotation2::new(q.phi) * Vector2::new(x, y);
        self.body_velocity(q, v).at(foot)
    }

    #[friction(limit = 2.45)]
    fn east(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0.2, 0.15)
    }

    #[friction(limit = 2.45)]
    fn north(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, -0.2, 0.15)
    }

    #[friction(limit = 2.45)]
    fn west(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, -0.2, -0.15)
    }

    #[friction(limit = 2.45)]
    fn south(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0.2, -0.15)
    }

    #[force(at = body)]
    fn pull(&self, t: f64) -> Vector2<f64> {
        Vector2::new(self.pull * t, 0.0)
    }
}

#[test]
fn a_plate_on_four_feet_breaks_away_and_comes_to_rest() {
    let pulled = Plate { pull: 1.0 };
    let mut motion = pulled.simulate(State::at_rest([0.0; 3]));
    close(motion.advance_to_switch(20.0).unwrap().unwrap().state.t, 9.8, 1e-13);
    // m v = ∫ (t − 9.8) dt.
    all_close(motion.advance_to(20.0).unwrap().v, [10.2_f64.powi(2) / 4.0, 0.0, 0.0], 1e-8);
    let free = Plate { pull: 0.0 };
    let mut motion = free.simulate(State::new([0.0; 3], [1.0, 0.0, 0.0]));
    all_close(motion.advance_to(1.0).unwrap().q, [1.0 / 9.8, 0.0, 0.0], 1e-9);
    for start in [[0.0, 0.0, 2.0], [1.0, 0.0, 3.0], [1.0, 0.5, 10.0]] {
        let mut motion = free.simulate(State::new([0.0; 3], start));
        assert_eq!(motion.advance_to(20.0).unwrap().v, [0.0; 3], "{start:?}");
    }
}
