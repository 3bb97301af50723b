//! Reactions of contacts that the motion does not determine: they are marked, and the shortest that are
//! possible.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};

/// A ladder of 3 kg and 2 m on a rough floor against a wall.
struct Ladder {
    floor: f64,
    wall: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Ladder {
    #[body(mass = 3.0, inertia = 1.0)]
    fn rod(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        3.0 * 9.81 * q.y
    }

    #[unilateral]
    fn foot(&self, q: &Coordinates) -> f64 {
        q.y - q.phi.sin()
    }

    #[unilateral]
    fn head(&self, q: &Coordinates) -> f64 {
        q.x - q.phi.cos()
    }

    #[friction(coefficient = self.floor, normal = foot)]
    fn along(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x - q.phi.sin() * v.phi
    }

    #[friction(coefficient = self.wall, normal = head)]
    fn up(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.y + q.phi.cos() * v.phi
    }
}

fn leaning(phi: f64, floor: f64, wall: f64) -> (Ladder, State<f64, 3>) {
    (Ladder { floor, wall }, State::at_rest([phi.cos(), phi.sin(), phi]))
}

#[test]
fn a_ladder_between_rough_surfaces_has_more_reactions_than_equations() {
    for (floor, wall) in [(0.8, 0.8), (0.5, 0.3)] {
        let (ladder, start) = leaning(1.2, floor, wall);
        let mut motion = ladder.simulate(start);
        assert_eq!(motion.advance_to(1.0).unwrap().q, start.q);
        assert!(!motion.reactions().are_unique());
    }
}

/// The force n at the foot determines the others: h = cot φ (n − W/2) at the head, −h along the floor, W − n
/// up the wall. Without limits Σ λ² is least at n = W/2.
#[test]
fn a_ladder_has_the_shortest_reactions_that_frictions_allow() {
    let (weight, cot) = (3.0 * 9.81, 1.2_f64.tan().recip());
    for (floor, wall) in [(0.8, 0.8), (0.5, 0.3), (0.5, 0.05)] {
        let (ladder, start) = leaning(1.2, floor, wall);
        let mut motion = ladder.simulate(start);
        motion.advance_to(1.0).unwrap();
        // The wall bears as much as its limit μ h allows.
        let foot = weight * (1.0 + 0.5 * wall * cot) / (1.0 + wall * cot);
        let head = cot * (foot - 0.5 * weight);
        let reactions = motion.reactions();
        close(reactions.foot, foot, 1e-12);
        close(reactions.head, head, 1e-12);
        close(reactions.along, -head, 1e-12);
        close(reactions.up, wall * head, 1e-12);
        assert!(head <= floor * foot);
    }
    // A floor with less friction limits the rest: at its limit μ n = h leaves no choice.
    let floor = cot * (1.0 - 0.5 * (1.0 + 0.8 * cot) / (1.0 + 0.5 * 0.8 * cot)) + 1e-9;
    let (ladder, start) = leaning(1.2, floor, 0.8);
    let reactions = ladder.simulate(start).reactions();
    close(reactions.up, 0.8 * reactions.head, 1e-7);
    close(reactions.foot + reactions.up, weight, 1e-12);
}

#[test]
fn a_smooth_wall_leaves_the_reactions_determined() {
    let phi = 1.2_f64;
    let (ladder, start) = leaning(phi, 0.8, 0.0);
    let mut motion = ladder.simulate(start);
    assert_eq!(motion.advance_to(1.0).unwrap().q, start.q);
    let reactions = motion.reactions();
    assert!(reactions.are_unique());
    close(reactions.foot, 3.0 * 9.81, 1e-12);
    close(reactions.head, 3.0 * 9.81 / (2.0 * phi.tan()), 1e-12);
    close(reactions.along, -reactions.head, 1e-12);
}

#[test]
fn a_ladder_that_slides_has_the_friction_of_its_slips() {
    let (ladder, start) = leaning(0.5, 0.1, 0.1);
    let mut motion = ladder.simulate(start);
    motion.advance_to(0.1).unwrap();
    let reactions = motion.reactions();
    assert!(reactions.are_unique());
    close(reactions.along.abs(), 0.1 * reactions.foot, 1e-12);
    close(reactions.up.abs(), 0.1 * reactions.head, 1e-12);
}

/// A table on legs at these places, with its weight at another.
struct Table<const LEGS: usize> {
    legs: [[f64; 2]; 4],
    load: [f64; 2],
}

macro_rules! table {
    ($legs:literal) => {
        #[lagrangian(coordinates = [z, roll, pitch])]
        impl Table<$legs> {
            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                0.5 * (8.0 * v.z * v.z + v.roll * v.roll + v.pitch * v.pitch)
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                8.0 * 9.81 * (q.z + q.roll * self.load[0] + q.pitch * self.load[1])
            }

            #[unilateral]
            fn feet(&self, q: &Coordinates) -> [f64; $legs] {
                core::array::from_fn(|i| q.z + q.roll * self.legs[i][0] + q.pitch * self.legs[i][1])
            }
        }
    };
}

table!(3);
table!(4);

#[test]
fn a_table_on_three_legs_is_determined_and_on_four_is_not() {
    let legs = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let rest = State::at_rest([0.0; 3]);
    let four = Table::<4> { legs, load: [0.0; 2] };
    let reactions = four.simulate(rest).reactions();
    assert!(!reactions.are_unique());
    reactions.feet.iter().for_each(|&foot| close(foot, 8.0 * 9.81 / 4.0, 1e-12));
    // Least squares alone would have the third leg pull.
    let reactions = Table::<4> { legs, load: [0.8, 0.8] }.simulate(rest).reactions();
    assert!(!reactions.are_unique());
    let shares = [0.8, 0.1, 0.0, 0.1];
    for (&foot, share) in reactions.feet.iter().zip(shares) {
        close_on(8.0 * 9.81, foot, 8.0 * 9.81 * share, 1e-14);
    }
    let three = Table::<3> { legs: [[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.8], [0.0, 0.0]], load: [0.0; 2] };
    let reactions = three.simulate(rest).reactions();
    assert!(reactions.are_unique());
    reactions.feet.iter().for_each(|&foot| close(foot, 8.0 * 9.81 / 3.0, 1e-12));
}

/// A sledge on four runners, whose weight is above them, on a rough floor.
struct Sledge;

#[lagrangian(coordinates = [x, z, roll, pitch])]
impl Sledge {
    const RUNNERS: [[f64; 2]; 4] = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (2.0 * (v.x * v.x + v.z * v.z) + v.roll * v.roll + v.pitch * v.pitch)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 10.0 * q.z
    }

    #[unilateral]
    fn runners(&self, q: &Coordinates) -> [f64; 4] {
        core::array::from_fn(|i| q.z + q.roll * Self::RUNNERS[i][0] + q.pitch * Self::RUNNERS[i][1])
    }

    #[friction(coefficient = 0.25, normal = runners)]
    fn slips(&self, v: &Velocities) -> [f64; 4] {
        core::array::from_fn(|_| v.x + 0.5 * v.roll)
    }
}

/// Friction at the floor, half a metre below the weight, presses down the runners ahead. Its moment is −μ W /
/// 2 at `roll`, so the runners bear as if the weight were at μ / 2.
#[test]
fn runners_that_slide_share_what_their_friction_adds() {
    let start = State::new([0.0; 4], [3.0, 0.0, 0.0, 0.0]);
    let reactions = Sledge.simulate(start).reactions();
    assert!(!reactions.are_unique());
    for (i, [ahead, _]) in Sledge::RUNNERS.iter().enumerate() {
        let force = 20.0 * (1.0 + 0.125 * ahead) / 4.0;
        close(reactions.runners[i], force, 1e-12);
        close(reactions.slips[i], -0.25 * force, 1e-12);
    }
}

/// A block in a groove between two planes of 45°, pulled along it: two contacts with friction in two
/// directions.
struct Groove {
    pull: f64,
    mu: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Groove {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        v.x * v.x + v.y * v.y + v.z * v.z
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        20.0 * q.z - self.pull * q.y
    }

    #[unilateral]
    fn left(&self, q: &Coordinates) -> f64 {
        (q.z + q.x) * 0.5_f64.sqrt()
    }

    #[unilateral]
    fn right(&self, q: &Coordinates) -> f64 {
        (q.z - q.x) * 0.5_f64.sqrt()
    }

    #[friction(coefficient = self.mu, normal = left)]
    fn on_left(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new((v.z - v.x) * 0.5_f64.sqrt(), v.y)
    }

    #[friction(coefficient = self.mu, normal = right)]
    fn on_right(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new((v.z + v.x) * 0.5_f64.sqrt(), v.y)
    }
}

/// Each side bears half: n + t = W/√2 with half of the pull along the groove. The shortest has t = n; where
/// the limit is less, t² + (P/2)² = μ² n².
#[test]
fn a_block_in_a_groove_presses_no_more_than_its_frictions_need() {
    let sum = 20.0 * 0.5_f64.sqrt();
    for (pull, mu) in [(2.0, 1.5), (2.0, 0.8), (12.0, 0.9), (14.0, 0.55)] {
        let half: f64 = 0.5 * pull;
        let groove = Groove { pull, mu };
        let mut motion = groove.simulate(State::at_rest([0.0; 3]));
        assert_eq!(motion.advance_to(1.0).unwrap().q, [0.0; 3]);
        let reactions = motion.reactions();
        assert!(!reactions.are_unique());
        let free = 0.5 * sum;
        let normal = if free.hypot(half) <= mu * free {
            free
        } else {
            // (1 − μ²) n² − 2 S n + S² + P²/4 = 0.
            let (a, c) = (1.0 - mu * mu, sum * sum + half * half);
            c / (sum + (sum * sum - a * c).sqrt())
        };
        for (found, along) in [(reactions.left, reactions.on_left), (reactions.right, reactions.on_right)] {
            close(found, normal, 1e-11);
            close(along[0], sum - normal, 1e-11);
            close(along[1], -half, 1e-11);
        }
    }
}

/// A table on four feet that slips and turns. Its feet slip in different directions, so the loads decide
/// how it goes on.
struct Turning;

#[lagrangian(coordinates = [hull: Pose])]
impl Turning {
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.15])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    fn feet(&self, q: &Coordinates) -> [Vector3<f64>; 4] {
        let hull = self.hull(q);
        [(0.5, 0.3), (-0.5, 0.3), (-0.5, -0.3), (0.5, -0.3)]
            .map(|(x, y)| hull.translation.vector + hull.rotation * Vector3::new(x, y, -0.2))
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.hull(q).translation.z
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 4] {
        self.feet(q).map(|foot| foot.z)
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, foot: usize) -> Vector2<f64> {
        let slip = self.hull_velocity(q, v).at(self.feet(q)[foot]);
        Vector2::new(slip.x, slip.y)
    }

    #[friction(coefficient = 0.3, normal = floor[0])]
    fn first(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0)
    }

    #[friction(coefficient = 0.3, normal = floor[1])]
    fn second(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 1)
    }

    #[friction(coefficient = 0.3, normal = floor[2])]
    fn third(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 2)
    }

    #[friction(coefficient = 0.3, normal = floor[3])]
    fn fourth(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 3)
    }
}

#[test]
fn reactions_of_feet_that_slip_apart_are_those_that_move_them() {
    for (v, turn) in [([1.0, 0.0], 0.0), ([1.0, 0.5], 1.0), ([1.0, 0.5], 4.0), ([0.0, 0.0], 3.0)] {
        let hull = Isometry3::translation(0.0, 0.0, 0.2);
        let moves =
            PoseVelocity { linear: Vector3::new(v[0], v[1], 0.0), angular: Vector3::new(0.0, 0.0, turn) };
        let start = Turning.state(TurningCoordinates { hull }, TurningVelocities { hull: moves });
        let mut motion = Turning.simulate(start).with_tolerance(1e-12);
        let span = 1e-4;
        let [before, now, after] = [0.05 - span, 0.05, 0.05 + span].map(|t| {
            let state = *motion.advance_to(t).unwrap();
            (Turning.velocities(&state).hull.linear, motion.reactions())
        });
        // Newton's law, by a central difference.
        let force = (after.0 - before.0) * (2.0 / (2.0 * span));
        let slips = [now.1.first, now.1.second, now.1.third, now.1.fourth];
        let sum = slips.iter().fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]]);
        close_on(1.0, sum[0], force.x, 1e-6);
        close_on(1.0, sum[1], force.y, 1e-6);
        close(now.1.floor.iter().sum(), 2.0 * 9.81, 1e-12);
        assert!(!now.1.are_unique());
    }
}
