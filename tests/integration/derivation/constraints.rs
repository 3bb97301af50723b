//! Constraints: what a function may return, the signs of multipliers, forces on particles and bodies,
//! Chetaev's rule.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, state_at};

const G: f64 = 9.81;

/// A load in a lift that accelerates: as a vector, and as scalars of both signs.
struct Lift {
    mass: f64,
    pull: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Lift {
    #[point(mass = self.mass)]
    fn load(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * q.y
    }

    #[holonomic]
    fn cabin(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        self.load(q) - Vector2::new(0.3, 0.5 * self.pull * t.powi(2))
    }
}

struct Floor {
    mass: f64,
    pull: f64,
    sign: f64,
}

#[lagrangian(coordinates = [y])]
impl Floor {
    #[point(mass = self.mass)]
    fn load(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * q.y
    }

    #[holonomic]
    fn floor(&self, q: &Coordinates, t: f64) -> f64 {
        self.sign * (q.y - 0.5 * self.pull * t.powi(2))
    }
}

#[test]
fn a_moving_floor_lifts() {
    let (mass, pull, t) = (3.0, 2.0, 0.7);
    let weight = mass * (G + pull);
    let lift = Lift { mass, pull };
    let state = State::new([0.3, 0.49], [0.0, 1.4]).at_time(t);
    all_close(lift.accelerations(&state).unwrap(), [0.0, pull], 1e-15);
    all_close(lift.reactions(&state).unwrap().cabin, [0.0, weight], 1e-14);
    let [across, along] = lift.reactions_on_load(&state).unwrap().cabin;
    all_close([across.x, across.y, along.x, along.y], [0.0, 0.0, 0.0, weight], 1e-14);
    close(lift.reaction_power(&state).unwrap(), weight * pull * t, 1e-14);
    close(lift.energy_rate(&state).unwrap(), weight * pull * t, 1e-14);
    bound!(lift, [true; 2]).holds([state]);
    for sign in [1.0, -1.0, 2.5] {
        let floor = Floor { mass, pull, sign };
        let state = State::new([0.49], [1.4]).at_time(t);
        close(floor.accelerations(&state).unwrap()[0], pull, 1e-15);
        // The force has one sign whatever that of the multiplier.
        close(floor.reactions(&state).unwrap().floor, weight / sign, 1e-14);
        all_close(floor.reaction_forces(&state).unwrap().floor, [weight], 1e-14);
        all_close(floor.reactions_on_load(&state).unwrap().floor, [weight], 1e-14);
        close(floor.reaction_power(&state).unwrap(), weight * pull * t, 1e-14);
        close(floor.constraint_rates(&State::new([0.49], [2.0]).at_time(t))[0], 0.6 * sign, 1e-14);
    }
}

/// Three wagons on couplings, the last one pulled.
struct Train {
    mass: f64,
}

#[lagrangian(coordinates = [x: [3]], inputs = [pull])]
impl Train {
    #[point(mass = self.mass)]
    fn wagons(&self, q: &Coordinates) -> [Vector1<f64>; 3] {
        [Vector1::new(q.x[0]), Vector1::new(q.x[1]), Vector1::new(q.x[2])]
    }

    #[force(at = wagons[2])]
    fn engine(&self, u: &Inputs) -> Vector1<f64> {
        Vector1::new(u.pull)
    }

    #[holonomic]
    fn couplings(&self, q: &Coordinates) -> [f64; 2] {
        let wagons = self.wagons(q);
        std::array::from_fn(|i| wagons[i + 1].x - wagons[i].x - 1.5)
    }
}

#[test]
fn couplings_pull_each_wagon() {
    let train = Train { mass: 2.0 };
    let (state, pull) = (State::new([0.0, 1.5, 3.0], [0.4; 3]), 6.0);
    all_close(train.accelerations(&state, &[pull]).unwrap(), [1.0; 3], 1e-14);
    all_close(train.reactions(&state, &[pull]).unwrap().couplings, [-2.0, -4.0], 1e-14);
    let on_wagons = train.reactions_on_wagons(&state, &[pull]).unwrap().couplings;
    let flat: Vec<f64> = on_wagons.iter().flatten().map(|force| force.x).collect();
    all_close(flat, [2.0, -2.0, 0.0, 0.0, 4.0, -4.0], 1e-14);
    close(train.energy_rate(&state, &[pull]).unwrap(), pull * 0.4, 1e-14);
    assert_eq!(Train::CONSTRAINTS, ["couplings[0]", "couplings[1]"]);
    bound!(train, [true; 2], inputs = [pull]).holds([state]);
}

/// A skate that turns at a given rate, its lateral velocity with either sign.
struct Skate {
    mass: f64,
    turn: f64,
    sign: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Skate {
    #[point(mass = self.mass)]
    fn skate(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[nonholonomic]
    fn blade(&self, v: &Velocities, t: f64) -> f64 {
        let (sin, cos) = (self.turn * t).sin_cos();
        self.sign * (v.y * cos - v.x * sin)
    }
}

#[test]
fn a_blade_turns_the_velocity() {
    for sign in [1.0, -1.0] {
        let skate = Skate { mass: 60.0, turn: 0.5, sign };
        let (speed, t) = (4.0, 1.2);
        let (sin, cos) = (0.5_f64 * t).sin_cos();
        let state = State::new([0.0; 2], [speed * cos, speed * sin]).at_time(t);
        let lateral = 60.0 * speed * 0.5;
        all_close(skate.accelerations(&state).unwrap(), [-2.0 * sin, 2.0 * cos], 1e-14);
        close(skate.reactions(&state).unwrap().blade, sign * lateral, 1e-14);
        // Coordinates that are the components of a position are moved with it.
        all_close(skate.reactions_on_skate(&state).unwrap().blade, [-lateral * sin, lateral * cos], 1e-14);
        close(skate.reaction_power(&state).unwrap(), 0.0, 1e-14);
    }
}

/// A parcel that a belt carries along.
struct Belt {
    mass: f64,
}

#[lagrangian(coordinates = [x])]
impl Belt {
    #[point(mass = self.mass)]
    fn parcel(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[nonholonomic]
    fn carried(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        2.0 * (v.x - t.powi(2) + q.x)
    }
}

#[test]
fn a_belt_works_on_what_it_carries() {
    let belt = Belt { mass: 1.5 };
    let state = State::new([0.3], [0.51]).at_time(0.9);
    // v̇ = 2 t − v, and 2 λ is the force.
    let a = 1.8 - 0.51;
    close(belt.accelerations(&state).unwrap()[0], a, 1e-14);
    close(belt.reactions(&state).unwrap().carried, 0.75 * a, 1e-14);
    close(belt.reaction_power(&state).unwrap(), 1.5 * a * 0.51, 1e-14);
    bound!(belt, [false]).holds([state]);
}

/// The Appell–Hamel system: ż = k √(ẋ² + ẏ²).
struct AppellHamel {
    mass: f64,
    ratio: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl AppellHamel {
    #[point(mass = self.mass)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * q.z
    }

    #[nonholonomic(chetaev)]
    fn wheel(&self, v: &Velocities) -> f64 {
        v.z - self.ratio * v.x.hypot(v.y)
    }
}

#[test]
fn the_system_of_appell_and_hamel_falls_at_a_constant_rate() {
    let system = AppellHamel { mass: 1.2, ratio: 2.0 };
    // λ = m g / (1 + k²), and the particle keeps its direction.
    let (sin, cos) = 0.4_f64.sin_cos();
    let start = State::new([0.0; 3], [3.0 * cos, 3.0 * sin, 6.0]);
    let slowing = 2.0 * G / 5.0;
    close(system.reactions(&start).unwrap().wheel, 1.2 * G / 5.0, 1e-14);
    all_close(system.accelerations(&start).unwrap(), [-slowing * cos, -slowing * sin, -2.0 * slowing], 1e-14);
    close(system.energy_rate(&start).unwrap(), 0.0, 1e-13);
    let path = 3.0 * 0.5 - slowing * 0.125;
    all_close(state_at(&system, start, 0.5).q, [path * cos, path * sin, 2.0 * path], 1e-12);
    bound!(system, [false]).holds([start]);
}

/// A particle of constant speed in a uniform field.
struct Isokinetic {
    mass: f64,
    speed: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Isokinetic {
    #[point(mass = self.mass)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * q.y
    }

    #[nonholonomic(chetaev)]
    fn thermostat(&self, v: &Velocities) -> f64 {
        v.x.powi(2) + v.y.powi(2) - self.speed.powi(2)
    }
}

#[test]
fn a_thermostat_keeps_the_speed() {
    let system = Isokinetic { mass: 2.0, speed: 3.0 };
    let start = State::new([0.0; 2], [3.0, 0.0]);
    let mut motion = system.simulate(start).with_tolerance(TIGHT);
    let state = *motion.advance_to(0.4).unwrap();
    // sin φ = −tanh (g t / c) from the horizontal.
    let fall = (G * 0.4 / 3.0).tanh();
    all_close(state.v, [3.0 * (1.0 - fall * fall).sqrt(), -3.0 * fall], 1e-12);
    close(motion.reactions().thermostat, 2.0 * G * state.v[1] / 18.0, 1e-12);
    // The constraint takes the power that gravity gives: 2 λ v².
    close(system.reaction_power(&state).unwrap(), 2.0 * G * state.v[1], 1e-12);
    bound!(system, [false]).holds([state]);
}

/// A ladder on a smooth floor and a smooth wall, written through the pose of its centre.
struct Ladder {
    mass: f64,
    half: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Ladder {
    #[body(mass = self.mass, inertia = self.mass * self.half.powi(2) / 3.0)]
    fn ladder(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.angle)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * q.y
    }

    #[holonomic]
    fn floor(&self, q: &Coordinates) -> f64 {
        let (centre, angle) = self.ladder(q);
        centre.y - self.half * angle.cos()
    }

    #[holonomic]
    fn wall(&self, q: &Coordinates) -> f64 {
        let (centre, angle) = self.ladder(q);
        centre.x - self.half * angle.sin()
    }
}

#[test]
fn a_ladder_presses_on_floor_and_wall() {
    let (ladder, angle) = (Ladder { mass: 8.0, half: 1.5 }, 0.6_f64);
    let (sin, cos) = angle.sin_cos();
    let state = State::at_rest([1.5 * sin, 1.5 * cos, angle]);
    // From rest: α = 3 g sin φ / (4 l), the centre on a circle of radius l.
    let alpha = 3.0 * G * sin / 6.0;
    all_close(ladder.accelerations(&state).unwrap(), [1.5 * alpha * cos, -1.5 * alpha * sin, alpha], 1e-13);
    let (floor, wall) = (8.0 * (G - 1.5 * alpha * sin), 8.0 * 1.5 * alpha * cos);
    let reactions = ladder.reactions(&state).unwrap();
    all_close([reactions.floor, reactions.wall], [floor, wall], 1e-13);
    let on_ladder = ladder.reactions_on_ladder(&state).unwrap();
    all_close(on_ladder.floor, [0.0, floor], 1e-13);
    all_close(on_ladder.wall, [wall, 0.0], 1e-13);
    bound!(ladder, [true; 2]).holds([state]);
}
