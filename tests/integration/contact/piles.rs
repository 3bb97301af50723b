//! Many contacts and frictions at once: chains with dry joints, towers of boxes, discs in a box.

use lagrangian::prelude::*;

use crate::support::close::all_close;
use crate::support::sample::Samples;

/// Links in a row with friction in every joint, driven by motors.
#[derive(Clone, Copy)]
struct Chain {
    limits: [f64; 12],
    drive: [f64; 12],
}

#[lagrangian(coordinates = [theta: [LINKS]])]
impl Chain {
    const LINKS: usize = 12;

    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; Self::LINKS] {
        let (mut end, mut angle) = (Vector2::zeros(), 0.0);
        q.theta.map(|theta| {
            angle += theta;
            end += Vector2::new(angle.sin(), -angle.cos());
            end
        })
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| 9.81 * joint.y).sum()
    }

    #[force]
    fn motors(&self, t: f64) -> [f64; Self::LINKS] {
        let mut torques = [0.0; Self::LINKS];
        for i in 0..Self::LINKS {
            torques[i] = self.drive[i] * (3.0 * t + i as f64).sin();
        }
        torques
    }

    #[friction(limit = self.limits[..])]
    fn bearings(&self, v: &Velocities) -> [f64; Self::LINKS] {
        v.theta
    }
}

fn chains(count: usize) -> impl Iterator<Item = (Chain, State<f64, 12>)> {
    let mut random = Samples::new(3);
    (0..count).map(move |_| {
        // The torque of the weight of all that hangs on a joint, and parts of it.
        let mut torques = |low, high| -> [f64; 12] {
            std::array::from_fn(|i| 9.81 * (12 - i) as f64 * random.number(low, high))
        };
        let chain = Chain { limits: torques(0.05, 0.6), drive: torques(0.0, 0.5) };
        (chain, State::at_rest(std::array::from_fn(|_| random.number(-1.0, 1.0))))
    })
}

/// Each joint of a chain at rest sticks or begins to turn against its friction. 3¹² combinations could be so.
#[test]
fn twelve_dry_joints_begin_as_their_law_says() {
    let (mut slips, mut holds) = (0, 0);
    for (chain, start) in chains(40) {
        let accelerations = chain.accelerations(&start).unwrap();
        let reactions = chain.simulate(start).reactions();
        for ((&a, &torque), &limit) in accelerations.iter().zip(&reactions.bearings).zip(&chain.limits) {
            if a.abs() > 1e-6 {
                all_close([torque], [-limit * a.signum()], 1e-9 * limit);
                slips += 1;
            } else {
                assert!(torque.abs() <= limit * (1.0 + 1e-9), "{torque} {limit}");
                holds += 1;
            }
        }
    }
    assert!(slips > 100 && holds > 50, "{slips} {holds}");
}

#[test]
fn a_chain_with_dry_joints_goes_on_as_accurately_as_it_is_asked_for() {
    for (chain, start) in chains(2) {
        let [loose, tight] = [1e-7, 1e-11]
            .map(|tolerance| *chain.simulate(start).with_tolerance(tolerance).advance_to(0.5).unwrap());
        all_close(loose.q, tight.q, 1e-5);
    }
}

/// Boxes of one metre on each other, on a floor that shakes: in its frame they feel a force.
macro_rules! tower {
    ($name:ident, $boxes:literal) => {
        #[derive(Clone, Copy)]
        struct $name {
            /// Of the floor, then of each box below another.
            friction: [f64; 2 * $boxes],
            shakes: f64,
            rate: f64,
        }

        #[lagrangian(coordinates = [x: [N], y: [N], phi: [N]])]
        impl $name {
            const N: usize = $boxes;

            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                let mut sum = 0.0;
                for i in 0..Self::N {
                    sum += 0.5 * (v.x[i] * v.x[i] + v.y[i] * v.y[i] + v.phi[i] * v.phi[i] / 6.0);
                }
                sum
            }

            #[potential]
            fn weight(&self, q: &Coordinates, t: f64) -> f64 {
                let mut sum = 0.0;
                for i in 0..Self::N {
                    sum += 9.81 * q.y[i] + self.shakes * (self.rate * t).sin() * q.x[i];
                }
                sum
            }

            /// From the centre of a box to one of its lower corners.
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
        }
    };
}

tower!(Two, 2);
tower!(Three, 3);

/// The forces at two feet on one plane are not determined. They hold as long as any forces do.
#[test]
fn two_boxes_that_can_stay_stay_to_the_last_bit() {
    let mut random = Samples::new(5);
    for _ in 0..20 {
        // Below both the angle of friction and the edge: 0.4 m of a height of 1 m.
        let rough = random.number(0.4, 0.9);
        let shakes = 9.81 * random.number(0.3, 0.95) * 0.4;
        let tower = Two { friction: [rough; 4], shakes, rate: random.number(2.0, 8.0) };
        let mut numbers = [0.0, 0.0, 0.5, 1.5, 0.0, 0.0];
        numbers[..2].copy_from_slice(&[random.number(-0.1, 0.1), random.number(-0.1, 0.1)]);
        let start = State::at_rest(numbers);
        let mut motion = tower.simulate(start);
        assert_eq!(motion.advance_to(5.0).unwrap().q, start.q);
        let reactions = motion.reactions();
        for (slip, normal) in reactions.slips.iter().zip(&reactions.corners) {
            assert!(slip.abs() <= rough * normal * (1.0 + 1e-12), "{slip} {normal}");
        }
    }
}

/// A point on the same floor.
#[derive(Clone, Copy)]
struct Slider {
    tower: Two,
}

#[lagrangian(coordinates = [x])]
impl Slider {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force]
    fn shaking(&self, t: f64) -> [f64; 1] {
        [-self.tower.shakes * (self.tower.rate * t).sin()]
    }

    #[friction(limit = self.tower.friction[0] * 9.81)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn two_boxes_that_slide_on_the_floor_move_as_one() {
    let mut random = Samples::new(9);
    for _ in 0..10 {
        let smooth = random.number(0.1, 0.3);
        let shakes = 9.81 * (smooth + 0.05);
        let tower = Two { friction: [smooth, smooth, 0.9, 0.9], shakes, rate: random.number(2.0, 8.0) };
        let start = State::at_rest([0.02, -0.03, 0.5, 1.5, 0.0, 0.0]);
        let end = *tower.simulate(start).advance_to(4.0).unwrap();
        let moved = Slider { tower }.simulate(State::at_rest([0.0])).advance_to(4.0).unwrap().q[0];
        assert!(moved != 0.0);
        all_close(end.q, [0.02 + moved, moved - 0.03, 0.5, 1.5, 0.0, 0.0], 1e-9);
    }
}

/// Towers that slide, rock and rattle, and stand still in between.
fn towers_go_on(count: usize) {
    let mut random = Samples::new(11);
    for index in 0..count {
        let friction = [random.number(0.2, 0.9); 6];
        let tower = Three { friction, shakes: 6.0 * random.number(0.1, 1.0), rate: random.number(2.0, 8.0) };
        let mut numbers = [0.0, 0.0, 0.0, 0.5, 1.5, 2.5, 0.0, 0.0, 0.0];
        numbers[..3].iter_mut().for_each(|x| *x = random.number(-0.1, 0.1));
        let mut motion = tower.simulate(State::at_rest(numbers));
        let end = motion.advance_to(1.5).unwrap_or_else(|error| panic!("{index}: {error}"));
        let gaps = tower.corners(&ThreeCoordinates::from(end.q));
        assert!(gaps.iter().all(|&gap| gap > -1e-12), "{index}: {gaps:?}");
    }
}

#[test]
fn towers_of_three_boxes_rock_and_come_to_rest() {
    towers_go_on(4);
}

#[test]
#[ignore = "many motions: scripts/check.sh runs them"]
fn many_towers_of_three_boxes_rock_and_come_to_rest() {
    towers_go_on(100);
}

/// Three discs of one metre between two walls.
#[derive(Clone, Copy)]
struct Discs {
    restitution: f64,
    width: f64,
}

#[lagrangian(coordinates = [x: [N], y: [N], phi: [N]])]
impl Discs {
    const N: usize = 3;

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let mut sum = 0.0;
        for i in 0..Self::N {
            sum += 0.5 * (v.x[i] * v.x[i] + v.y[i] * v.y[i] + 0.125 * v.phi[i] * v.phi[i]);
        }
        sum
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (q.y[0] + q.y[1] + q.y[2])
    }

    #[unilateral(restitution = self.restitution)]
    fn gaps(&self, q: &Coordinates) -> [f64; 12] {
        let mut gaps = [0.0; 12];
        for i in 0..Self::N {
            gaps[3 * i] = q.y[i] - 0.5;
            gaps[3 * i + 1] = q.x[i] - 0.5;
            gaps[3 * i + 2] = self.width - 0.5 - q.x[i];
            let j = (i + 1) % Self::N;
            gaps[9 + i] = Vector2::new(q.x[i] - q.x[j], q.y[i] - q.y[j]).norm() - 1.0;
        }
        gaps
    }

    #[friction(coefficient = 0.3, normal = gaps)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 12] {
        let mut slips = [0.0; 12];
        for i in 0..Self::N {
            slips[3 * i] = v.x[i] + 0.5 * v.phi[i];
            slips[3 * i + 1] = v.y[i] - 0.5 * v.phi[i];
            slips[3 * i + 2] = v.y[i] + 0.5 * v.phi[i];
            let j = (i + 1) % Self::N;
            let n = Vector2::new(q.x[i] - q.x[j], q.y[i] - q.y[j]).normalize();
            let (x, y) = (v.x[i] - v.x[j], v.y[i] - v.y[j]);
            slips[9 + i] = n.x * y - n.y * x - 0.5 * (v.phi[i] + v.phi[j]);
        }
        slips
    }
}

/// Whether three discs stand from wall to wall as an arch that both contacts of an outer disc can jam: it is
/// flatter than twice the angle of friction.
fn are_a_flat_arch(state: &State<f64, 9>, width: f64) -> bool {
    let mut discs = [0, 1, 2];
    discs.sort_by(|&i, &j| state.q[i].total_cmp(&state.q[j]));
    let [left, middle, right] = discs.map(|i| Vector2::new(state.q[i], state.q[3 + i]));
    let touches = |gap: f64| gap < 1e-6;
    let stands = touches(left.x - 0.5) && touches(width - 0.5 - right.x);
    stands
        && [middle - left, middle - right].iter().all(|strut| {
            let steep = (strut.y / strut.x).abs().atan();
            touches(strut.norm() - 1.0) && strut.y > 0.0 && steep < 2.0 * 0.3_f64.atan()
        })
}

/// Discs fall on each other until they lie still, or slip into an arch that jams. Returns how many jam.
fn discs_fall(count: usize) -> usize {
    let mut random = Samples::new(13);
    let mut jammed = 0;
    for index in 0..count {
        let discs = Discs { restitution: random.number(0.0, 0.6), width: random.number(2.2, 3.4) };
        let mut places = [0.0; 9];
        for i in 0..3 {
            places[i] = random.number(0.6, discs.width - 0.6);
            places[3 + i] = 0.6 + 1.1 * i as f64;
        }
        let mut start = State::at_rest(places);
        start.v[..3].iter_mut().for_each(|v| *v = random.number(-1.0, 1.0));
        let mut motion = discs.simulate(start);
        let mut energy = f64::INFINITY;
        for step in 1..=30 {
            let state = match motion.advance_to(0.1 * f64::from(step)) {
                Ok(state) => *state,
                Err(error) => {
                    assert!(matches!(error.cause, Cause::NoReaction { .. }), "{index}: {error}");
                    assert!(are_a_flat_arch(motion.state(), discs.width), "{index}: {error}");
                    jammed += 1;
                    break;
                }
            };
            let now = discs.energy(&state);
            assert!(now <= energy + 1e-10, "{index}: {now} after {energy}");
            energy = now;
            let gaps = discs.gaps(&DiscsCoordinates::from(state.q));
            assert!(gaps.iter().all(|&gap| gap > -1e-11), "{index}: {gaps:?}");
        }
    }
    jammed
}

#[test]
fn discs_in_a_box_lose_energy_until_they_lie_still() {
    assert_eq!(discs_fall(4), 0);
}

#[test]
#[ignore = "many motions: scripts/check.sh runs them"]
fn many_discs_in_a_box_lose_energy_until_they_lie_still() {
    // Three are such arches.
    assert_eq!(discs_fall(60), 3);
}
