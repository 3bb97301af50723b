//! Constraints beside the rest of the language: names, scalars, helpers, coordinates without mass,
//! elimination, Baumgarte.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;

const G: f64 = 9.81;

/// Constraints and coordinates with the names of one another and of what generated code is made of.
struct Names {
    mass: f64,
}

#[lagrangian(coordinates = [x, balance, saddle, gradients], baumgarte = self.mass)]
impl Names {
    #[point(mass = self.mass)]
    fn accelerations_of(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.balance, q.saddle)
    }

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        v.gradients.powi(2)
    }

    #[force(on = gradients)]
    fn state(&self, q: &Coordinates) -> f64 {
        q.balance
    }

    #[holonomic]
    fn x(&self, q: &Coordinates) -> f64 {
        q.x + q.gradients.powi(2)
    }

    #[holonomic]
    fn r#type(&self, q: &Coordinates, t: f64) -> f64 {
        let x_multiplier = q.balance * t;
        x_multiplier.sin() + q.balance - t
    }

    #[nonholonomic]
    fn gradients(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.saddle - q.saddle * v.x
    }
}

#[test]
fn any_name_will_do() {
    let names = Names { mass: 2.0 };
    let t = 0.8_f64;
    // Where the constraints hold or not: dw/dt = −2 r w − r² f, dg/dt = −r g.
    let state = State::new([0.3, 0.5, -0.4, 0.7], [0.2, 0.6, 0.1, -0.3]).at_time(t);
    let a = names.accelerations(&state).unwrap();
    let f = [0.3 + 0.49, (0.5 * t).sin() + 0.5 - t];
    let w = [0.2 - 0.42, (0.5 * t).cos() * (0.6 * t + 0.5) + 0.6 - 1.0];
    let g = 0.1 + 0.4 * 0.2;
    all_close(names.constraint_residuals(&state), [f[0], f[1], g], 1e-15);
    all_close(names.constraint_rates(&state), [w[0], w[1], g], 1e-15);
    let swing = (0.5 * t).cos() * (a[1] * t + 1.2) - (0.5 * t).sin() * (0.6 * t + 0.5_f64).powi(2);
    close(a[0] + 2.0 * 0.09 + 1.4 * a[3], -4.0 * w[0] - 4.0 * f[0], 1e-13);
    close(swing + a[1], -4.0 * w[1] - 4.0 * f[1], 1e-13);
    close(a[2] - 0.1 * 0.2 + 0.4 * a[0], -2.0 * g, 1e-13);
    let reactions = names.reactions(&state).unwrap();
    close(2.0 * a[0], reactions.x + 0.4 * reactions.gradients, 1e-13);
    close(2.0 * a[1], reactions.r#type * (1.0 + t * (0.5 * t).cos()), 1e-13);
    close(2.0 * a[2], reactions.gradients, 1e-13);
    close(2.0 * a[3], 0.5 + 1.4 * reactions.x, 1e-13);
    assert_eq!(Names::CONSTRAINTS, ["x", "type", "gradients"]);
    assert!(format!("{:?}", *reactions).contains("type: "));
}

/// A pendulum of any scalar, with a helper and constants.
struct Pendulum<R> {
    mass: R,
}

#[lagrangian(coordinates = [place: [2]])]
impl<R: Real> Pendulum<R> {
    const HALVES: usize = 2;
    const LENGTH: f64 = 0.75;

    fn distance(&self, q: &Coordinates<R>, from: Vector2<R>) -> R {
        (self.bob(q) - from).norm()
    }

    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.place[0], q.place[1])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.mass * 9.81 * q.place[1]
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        let mut rest = self.distance(q, Vector2::zeros());
        for _ in 0..Self::HALVES {
            rest -= R::from_f64(Self::LENGTH);
        }
        rest
    }
}

#[test]
fn scalars_may_be_generic() {
    // |r| = 1.5: at 3 : 4 from the vertical, and 5 rad/s.
    let (sin, cos) = (0.6, 0.8);
    let tension = 2.0 * (G * cos + 1.5 * 25.0);
    let state = State::new([1.5 * sin, -1.5 * cos], [7.5 * cos, 7.5 * sin]);
    let double = Pendulum { mass: 2.0 };
    close(double.reactions(&state).unwrap().rod, -tension, 1e-14);
    all_close(double.reactions_on_bob(&state).unwrap().rod, [-tension * sin, tension * cos], 1e-14);
    bound!(double, [true]).holds([state]);
    let single = Pendulum { mass: 2.0_f32 };
    let state = State::new(state.q.map(|x| x as f32), state.v.map(|x| x as f32));
    close(f64::from(single.reactions(&state).unwrap().rod), -tension, 1e-6);
    let mut motion = single.simulate(state);
    motion.advance_to(0.1).unwrap();
    close_on(1.5, f64::from(single.constraint_residuals(motion.state())[0]), 0.0, 1e-6);
}

/// Two loads on a rope over a pulley without mass.
struct Pulley {
    left: f64,
    right: f64,
    radius: f64,
}

#[lagrangian(coordinates = [left, right, turn])]
impl Pulley {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (self.left * v.left.powi(2) + self.right * v.right.powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.left * q.left + self.right * q.right)
    }

    #[holonomic]
    fn rope(&self, q: &Coordinates) -> [f64; 2] {
        [q.left - self.radius * q.turn, q.right + self.radius * q.turn]
    }
}

#[test]
fn a_pulley_needs_no_mass() {
    let pulley = Pulley { left: 3.0, right: 5.0, radius: 0.4 };
    let state = State::new([0.2, -0.2, 0.5], [0.8, -0.8, 2.0]);
    let (a, tension) = (G * 2.0 / 8.0, 2.0 * 15.0 * G / 8.0);
    all_close(pulley.accelerations(&state).unwrap(), [a, -a, a / 0.4], 1e-14);
    all_close(pulley.reactions(&state).unwrap().rope, [tension; 2], 1e-14);
    let mut motion = pulley.simulate(state);
    let end = *motion.advance_to(0.5).unwrap();
    close(end.q[2], 0.5 + 2.0 * 0.5 + a / 0.8 * 0.25, 1e-12);
    bound!(pulley, [true; 2]).holds([state]);
}

/// A pendulum whose pivot a motor lifts: the pivot is eliminated, the rod is kept.
struct Hoist {
    mass: f64,
    length: f64,
    pull: f64,
}

#[lagrangian(coordinates = [pivot, x, y])]
impl Hoist {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * q.y
    }

    #[holonomic(eliminate)]
    fn motor(&self, q: &Coordinates, t: f64) -> f64 {
        q.pivot - 0.5 * self.pull * t.powi(2)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        (self.bob(q) - Vector2::new(0.0, q.pivot)).norm() - self.length
    }
}

#[test]
fn a_rod_hangs_on_a_pivot_that_is_eliminated() {
    let hoist = Hoist { mass: 1.5, length: 0.8, pull: 2.0 };
    let t = 0.6;
    let (height, rate) = (t * t, 2.0 * t);
    // As a pendulum that weighs m (g + a), at 3 : 4 and 4 rad/s.
    let (sin, cos, turn) = (0.6, 0.8, 0.8 * 4.0);
    let state = State::new([0.8 * sin, height - 0.8 * cos], [turn * cos, rate + turn * sin]).at_time(t);
    let tension = 1.5 * ((G + 2.0) * cos + 0.8 * 16.0);
    close(hoist.reactions(&state).unwrap().rod, -tension, 1e-13);
    all_close(hoist.reactions_on_bob(&state).unwrap().rod, [-tension * sin, tension * cos], 1e-13);
    all_close(hoist.accelerations(&state).unwrap(), [-tension * sin / 1.5, tension * cos / 1.5 - G], 1e-13);
    // The pivot moves against the tension.
    close(hoist.reaction_power(&state).unwrap(), tension * cos * rate, 1e-13);
    assert_eq!((Hoist::COORDINATES, Hoist::CONSTRAINTS), (["x", "y"], ["rod"]));
    bound!(hoist, [true]).holds([state]);
}

/// A bead on a wire that a crank moves, and a fin across it, both stabilised.
struct Stabilised {
    rate: f64,
}

#[lagrangian(coordinates = [x, y], baumgarte = self.rate)]
impl Stabilised {
    #[point(mass = 2.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates, t: f64) -> f64 {
        q.y - t.sin()
    }

    #[nonholonomic]
    fn fin(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x - 2.0 * v.y + q.x * q.y * v.y
    }
}

#[test]
fn baumgarte_brings_residuals_back() {
    let (system, t) = (Stabilised { rate: 3.0 }, 0.5_f64);
    let state = State::new([0.4, t.sin() + 0.1], [1.0, t.cos() - 0.2]).at_time(t);
    // f̈ = −6 ḟ − 9 f, ġ = −3 g.
    let up = -t.sin() + 6.0 * 0.2 - 9.0 * 0.1;
    let ([x, y], [vx, vy]) = (state.q, state.v);
    let along = (2.0 - x * y) * up - (vx * y + x * vy) * vy - 3.0 * (vx - 2.0 * vy + x * y * vy);
    all_close(system.accelerations(&state).unwrap(), [along, up], 1e-14);
    let reactions = system.reactions(&state).unwrap();
    close(reactions.fin, 2.0 * along, 1e-14);
    close(reactions.wire, 2.0 * up + (2.0 - x * y) * 2.0 * along, 1e-14);
    // Nothing is projected: what a start is off by goes down with the rate.
    let start = State::new([0.0, t.sin() + 1e-10], [2.0 * t.cos(), t.cos()]).at_time(t);
    let mut motion = system.stepper::<Jet<8>>(start);
    motion.step(0.1, &[]).unwrap();
    let left = 1e-10 * (1.0 + 3.0 * 0.1) * (-0.3_f64).exp();
    close(system.constraint_residuals(motion.state())[0] / left, 1.0, 1e-4);
}
