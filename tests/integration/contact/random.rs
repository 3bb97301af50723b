//! Random systems with several contacts and friction: what the laws of contact promise of every motion.
//!
//! No impact adds kinetic energy, no motion adds energy, nothing penetrates, and what ends a motion is a
//! paradox of rigid bodies, never a failure of numbers.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A rod between a floor and a wall, all four contacts rough.
struct Rod {
    mass: f64,
    half: f64,
    spread: f64,
    restitution: [f64; 2],
    friction: [f64; 2],
}

#[lagrangian(coordinates = [x, y, angle])]
impl Rod {
    #[body(mass = self.mass, inertia = self.mass * self.spread * self.half * self.half)]
    fn rod(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.angle)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.mass * 9.81 * q.y
    }

    #[unilateral(restitution = self.restitution[0])]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        let up = self.half * q.angle.sin();
        [q.y - up, q.y + up]
    }

    #[unilateral(restitution = self.restitution[1])]
    fn wall(&self, q: &Coordinates) -> [f64; 2] {
        let along = self.half * q.angle.cos();
        [q.x - along, q.x + along]
    }

    #[friction(coefficient = self.friction[0], normal = floor)]
    fn floor_slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let turn = self.half * q.angle.sin() * v.angle;
        [v.x + turn, v.x - turn]
    }

    #[friction(coefficient = self.friction[1], normal = wall)]
    fn wall_slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let turn = self.half * q.angle.cos() * v.angle;
        [v.y - turn, v.y + turn]
    }
}

/// Two discs in a box that spin, rough on the floor and on each other.
struct Discs {
    masses: [f64; 2],
    radii: [f64; 2],
    width: f64,
    restitution: [f64; 3],
    friction: [f64; 2],
}

#[lagrangian(coordinates = [x0, y0, a0, x1, y1, a1])]
impl Discs {
    #[body(mass = self.masses[0], inertia = 0.5 * self.masses[0] * self.radii[0] * self.radii[0])]
    fn first(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x0, q.y0), q.a0)
    }

    #[body(mass = self.masses[1], inertia = 0.5 * self.masses[1] * self.radii[1] * self.radii[1])]
    fn second(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x1, q.y1), q.a1)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (self.masses[0] * q.y0 + self.masses[1] * q.y1)
    }

    #[unilateral(restitution = self.restitution[0])]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        [q.y0 - self.radii[0], q.y1 - self.radii[1]]
    }

    #[unilateral(restitution = self.restitution[1])]
    fn sides(&self, q: &Coordinates) -> [f64; 2] {
        [q.x0 - self.radii[0], self.width - q.x1 - self.radii[1]]
    }

    #[unilateral(restitution = self.restitution[2])]
    fn meeting(&self, q: &Coordinates) -> f64 {
        (q.x1 - q.x0).hypot(q.y1 - q.y0) - self.radii[0] - self.radii[1]
    }

    #[friction(coefficient = self.friction[0], normal = floor)]
    fn rolling(&self, v: &Velocities) -> [f64; 2] {
        [v.x0 + self.radii[0] * v.a0, v.x1 + self.radii[1] * v.a1]
    }

    #[friction(coefficient = self.friction[1], normal = meeting)]
    fn rubbing(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let (x, y) = (q.x1 - q.x0, q.y1 - q.y0);
        let across = (x * (v.y1 - v.y0) - y * (v.x1 - v.x0)) / x.hypot(y);
        across - self.radii[0] * v.a0 - self.radii[1] * v.a1
    }
}

/// Three particles one above the other, the lowest of which meets a moving floor.
struct Column {
    masses: [f64; 3],
    restitution: f64,
    swing: f64,
    rate: f64,
}

#[lagrangian(coordinates = [y0, y1, y2])]
impl Column {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * (self.masses[0] * v.y0 * v.y0 + self.masses[1] * v.y1 * v.y1 + self.masses[2] * v.y2 * v.y2)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (self.masses[0] * q.y0 + self.masses[1] * q.y1 + self.masses[2] * q.y2)
    }

    #[unilateral(restitution = self.restitution)]
    fn gaps(&self, q: &Coordinates, t: f64) -> [f64; 3] {
        [q.y0 - self.swing * (self.rate * t).sin(), q.y1 - q.y0, q.y2 - q.y1]
    }
}

/// Counts of motions and their ends.
#[derive(Debug, Default)]
pub struct Tally {
    pub motions: usize,
    pub switches: usize,
    pub paradoxes: usize,
    pub most_steps: u64,
}

/// The most switches of a motion that are followed.
const MOST: usize = 1000;

/// Follows motions of one kind for a second from switch to switch. `gap` gives the smallest gap of a state.
/// If `conserves`, nothing adds energy.
macro_rules! follow {
    ($tally:expr, $number:expr, $system:expr, $start:expr, $gap:expr, $conserves:expr) => {{
        let (system, gap) = (&$system, $gap);
        let mut motion = system.simulate($start).with_tolerance(1e-12).with_max_steps(20_000);
        let size = {
            let (kinetic, potential) = (system.kinetic_energy(motion.state()), system.energy(motion.state()));
            kinetic.abs() + potential.abs() + 1.0
        };
        let mut energy = system.energy(motion.state());
        $tally.motions += 1;
        // An elastic rod clatters on and on; this many switches show what it does.
        for _ in 0..MOST {
            match motion.advance_to_switch(1.0) {
                Ok(switch) => {
                    $tally.switches += 1;
                    if let Some(switch) = &switch {
                        assert!(switch.before.t <= switch.state.t, "{}: {switch:?}", $number);
                        let [from, to] =
                            [&switch.before, &switch.state].map(|state| system.kinetic_energy(state));
                        assert!(
                            to <= from + 1e-10 * size || !$conserves,
                            "{}: T grows from {from} to {to} at {switch:?}",
                            $number
                        );
                    }
                    let state = *motion.state();
                    let now = system.energy(&state);
                    assert!(
                        now <= energy + 1e-9 * size || !$conserves,
                        "{}: E grows to {now} from {energy} at {state:?}",
                        $number
                    );
                    energy = now;
                    let least: f64 = gap(system, &state);
                    assert!(least >= -1e-12, "{}: penetration {least} at {state:?}", $number);
                    if switch.is_none() {
                        break;
                    }
                }
                Err(error) => {
                    assert!(
                        matches!(error.cause, Cause::NoReaction { .. } | Cause::SeveralReactions { .. }),
                        "{}: {error} {:?}",
                        $number,
                        motion.state()
                    );
                    $tally.paradoxes += 1;
                    break;
                }
            }
        }
        $tally.most_steps = $tally.most_steps.max(motion.steps().accepted);
    }};
}

mod corner;

/// Follows the motion of a number.
pub fn follow(number: u64, tally: &mut Tally) {
    let mut random = Samples::new(number);
    let mut pick = |low: f64, high: f64| random.number(low, high);
    // A third each of plastic, elastic and other impacts, and of smooth, rough and very rough contacts.
    let coefficient = |unit: f64, most: f64| ((3.0 * unit - 1.0).clamp(0.0, 1.0)) * most;
    match number % 3 {
        0 => {
            let half = pick(0.2, 2.0);
            let rod = Rod {
                mass: pick(0.1, 3.0),
                half,
                spread: pick(0.1, 1.0),
                restitution: [pick(0.0, 1.0), pick(0.0, 1.0)].map(|unit| coefficient(unit, 1.0)),
                friction: [pick(0.0, 1.0), pick(0.0, 1.0)].map(|unit| coefficient(unit, 0.6)),
            };
            let angle = pick(-3.0, 3.0);
            let place = [half * f64::cos(angle).abs(), half * f64::sin(angle).abs()];
            // Half of them begin on the floor or against the wall.
            let apart = [pick(-0.5, 0.5), pick(-0.5, 0.5)].map(|gap| gap.max(0.0));
            let start = State::new(
                [place[0] + apart[0], place[1] + apart[1], angle],
                [pick(-2.0, 2.0), pick(-2.0, 2.0), pick(-3.0, 3.0)],
            );
            let gap = |rod: &Rod, state: &State<f64, 3>| {
                let [x, y, angle] = state.q;
                (x - rod.half * angle.cos().abs()).min(y - rod.half * angle.sin().abs())
            };
            follow!(tally, number, rod, start, gap, true);
        }
        1 => {
            let radii = [pick(0.1, 0.4), pick(0.1, 0.4)];
            let discs = Discs {
                masses: [pick(0.1, 3.0), pick(0.1, 3.0)],
                radii,
                width: 2.0,
                restitution: [pick(0.0, 1.0), pick(0.0, 1.0), pick(0.0, 1.0)]
                    .map(|unit| coefficient(unit, 1.0)),
                friction: [pick(0.0, 1.0), pick(0.0, 1.0)].map(|unit| coefficient(unit, 0.8)),
            };
            let apart = [pick(-0.3, 0.5), pick(-0.3, 0.5)].map(|gap| gap.max(0.0));
            let start = State::new(
                [
                    radii[0] + pick(0.0, 0.2),
                    radii[0] + apart[0],
                    0.0,
                    2.0 - radii[1] - pick(0.0, 0.2),
                    radii[1] + apart[1],
                    0.0,
                ],
                [
                    pick(-1.0, 3.0),
                    pick(-1.0, 1.0),
                    pick(-9.0, 9.0),
                    pick(-3.0, 1.0),
                    pick(-1.0, 1.0),
                    pick(-9.0, 9.0),
                ],
            );
            let gap = |discs: &Discs, state: &State<f64, 6>| {
                let [x0, y0, _, x1, y1, _] = state.q;
                let [r0, r1] = discs.radii;
                let own = (y0 - r0).min(y1 - r1).min(x0 - r0).min(discs.width - x1 - r1);
                own.min((x1 - x0).hypot(y1 - y0) - r0 - r1)
            };
            follow!(tally, number, discs, start, gap, true);
        }
        _ => {
            let column = Column {
                masses: [pick(0.1, 3.0), pick(0.1, 3.0), pick(0.1, 3.0)],
                restitution: coefficient(pick(0.0, 1.0), 0.9),
                swing: pick(0.0, 0.1),
                rate: pick(1.0, 20.0),
            };
            let gaps = [pick(-0.2, 0.3), pick(-0.2, 0.3), pick(-0.2, 0.3)].map(|gap| gap.max(0.0));
            let start = State::new(
                [gaps[0], gaps[0] + gaps[1], gaps[0] + gaps[1] + gaps[2]],
                [pick(-1.0, 1.0), pick(-1.0, 1.0), pick(-1.0, 1.0)],
            );
            let gap = |column: &Column, state: &State<f64, 3>| {
                let [y0, y1, y2] = state.q;
                (y0 - column.swing * (column.rate * state.t).sin()).min(y1 - y0).min(y2 - y1)
            };
            follow!(tally, number, column, start, gap, false);
        }
    }
}

#[test]
#[ignore = "ten thousand motions: scripts/check.sh runs them"]
fn ten_thousand_random_contacts_obey_their_laws() {
    let mut tally = Tally::default();
    (0..10_000).for_each(|number| follow(number, &mut tally));
    assert!(tally.switches > 5 * tally.motions && 1000 * tally.paradoxes < tally.motions, "{tally:?}");
}

/// A rod that comes to lie flat on the floor with one end at a wall. The wall bears nothing there, and its
/// gradient is that of the friction of the foot about which the rod rocks.
#[test]
fn a_rod_comes_to_lie_between_a_floor_and_a_wall() {
    let mut tally = Tally::default();
    follow(8472, &mut tally);
    assert!(tally.switches > 5 && tally.paradoxes == 0, "{tally:?}");
}

/// Discs that slip on the floor and on each other under constant forces: a polynomial in time, which bounds
/// no step.
#[test]
fn discs_with_constant_accelerations_obey_their_laws() {
    let mut tally = Tally::default();
    [235, 1267, 2338, 3091, 7444].into_iter().for_each(|number| follow(number, &mut tally));
    assert!(tally.switches > 5 * tally.motions && tally.paradoxes == 0, "{tally:?}");
}
