//! N02, N03, N04, N12: friction of given size, on a moving surface, in two directions.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// N02: an oscillator on a rough floor.
struct Oscillator {
    mass: f64,
    stiffness: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x])]
impl Oscillator {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x * q.x
    }

    #[friction(limit = self.friction * self.mass * 9.81)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

const OSCILLATOR: Oscillator = Oscillator { mass: 2.0, stiffness: 50.0, friction: 0.25 };

#[test]
fn an_oscillator_turns_and_sticks() {
    let mut motion = OSCILLATOR.simulate(State::at_rest([0.7])).with_tolerance(TIGHT);
    let energy = motion.energy();
    close(motion.advance_to(0.4).unwrap().q[0], -0.152378780917725, 1e-11);
    let half = core::f64::consts::PI / 5.0;
    for (k, turning) in [-0.5038, 0.3076, -0.1114, -0.0848].into_iter().enumerate() {
        let state = motion.advance_to((k + 1) as f64 * half).unwrap();
        close_on(1.0, state.q[0], turning, 1e-12);
    }
    close(energy - motion.advance_to(3.0).unwrap().q[0].powi(2) * 25.0, 12.070224, 1e-12);
    assert_eq!(motion.state().v[0], 0.0);
    close(motion.reactions().slip, 50.0 * -0.0848, 1e-11);
    let before = motion.steps().accepted;
    let stuck = motion.state().q[0];
    assert_eq!(motion.advance_to(1e6).unwrap().q[0], stuck);
    assert!(motion.steps().accepted <= before + 16);
}

/// N03: a block on a belt.
struct Belt {
    stiffness: f64,
    fixed: f64,
    kinetic: f64,
    speed: f64,
}

#[lagrangian(coordinates = [x])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x * q.x
    }

    #[friction(limit = 8.0 * self.kinetic, static_limit = 8.0 * self.fixed)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - self.speed
    }
}

#[test]
fn a_block_on_a_belt_sticks_and_slips() {
    let belt = Belt { stiffness: 9.0, fixed: 0.5, kinetic: 0.3, speed: 0.2 };
    let mut motion = belt.simulate(State::new([0.0], [0.2])).with_tolerance(TIGHT);
    let state = motion.advance_to(2.0).unwrap();
    close(state.q[0], 0.4, 1e-13);
    close(motion.advance_to(3.0).unwrap().q[0], 0.19207094504924363, 1e-11);
    let period = 3.0641557758214235;
    for periods in [1, 10, 100] {
        let state = motion.advance_to(3.0 + periods as f64 * period).unwrap();
        close_on(0.1, state.q[0], 0.19207094504924363, 1e-10);
    }
}

#[test]
fn a_block_on_a_belt_keeps_time_over_a_hundred_periods() {
    // An ulp of the time at the end moves the block by 3.1e-14 m. Roundings of the times of two hundred
    // switches would add up to 1.3e-13 m if they were not made up for.
    let belt = Belt { stiffness: 9.0, fixed: 0.5, kinetic: 0.3, speed: 0.2 };
    let mut motion = belt.simulate(State::new([0.0], [0.2])).with_tolerance(1e-15);
    let state = motion.advance_to(300.0).unwrap();
    all_close([state.q[0], state.v[0]], [0.316497945417455, -0.5496326385568778], 3.1e-14);
}

/// N12: a particle on a rough incline, pushed across the slope.
struct Incline {
    angle: f64,
    friction: f64,
}

#[lagrangian(coordinates = [down, across])]
impl Incline {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.down * v.down + v.across * v.across)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -9.81 * self.angle.sin() * q.down
    }

    #[friction(limit = self.friction * 9.81 * self.angle.cos())]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.down, v.across)
    }
}

#[test]
fn a_particle_turns_downhill_and_stops() {
    let incline = Incline { angle: 0.3, friction: 0.45 };
    let mut motion = incline.simulate(State::new([0.0, 0.0], [0.0, 2.0])).with_tolerance(TIGHT);
    let time = 0.8990851212853052;
    assert!(motion.advance_to(time - 1e-6).unwrap().v[0] > 0.0);
    let state = *motion.advance_to(1.0).unwrap();
    assert_eq!(state.v, [0.0; 2]);
    all_close(state.q, [0.30902179944245506, 0.5377615388130569], 1e-11);
    assert_eq!(motion.advance_to(1e6).unwrap().q, state.q);
}

/// N04: a sphere that slips, then rolls; its spin by components.
struct Sphere;

#[lagrangian(coordinates = [x, y, a, b])]
impl Sphere {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.75 * (v.x * v.x + v.y * v.y) + 0.2 * 1.5 * 0.08 * 0.08 * (v.a * v.a + v.b * v.b)
    }

    #[friction(limit = 0.3 * 1.5 * 9.81)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x - 0.08 * v.b, v.y + 0.08 * v.a)
    }
}

#[test]
fn a_sphere_slips_then_rolls() {
    let mut motion = Sphere.simulate(State::new([0.0; 4], [2.0, -1.0, -10.0, 10.0])).with_tolerance(TIGHT);
    let energy = motion.energy();
    let time = 0.21002191789509184;
    let state = *motion.advance_to(time + 0.01).unwrap();
    let rolling = [1.6571428571428573, -0.4857142857142857];
    all_close(state.v, [rolling[0], rolling[1], 6.071428571428571, 20.714285714285715], 1e-11);
    all_close(&motion.advance_to(1.0).unwrap().q[..2], [1.6931466144963014, -0.5397199217444522], 1e-11);
    close(energy - motion.energy(), 1.002857142857143, 1e-11);
}
