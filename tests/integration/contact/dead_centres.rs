//! Switches in the first step of a motion that begins where constraints depend on each other. That step is
//! expanded about its end and has no series of functions and reactions.

use core::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};

/// Inertia of the rod \[kg m²].
const ROD: f64 = 0.1;

/// A slider-crank with equal links of one metre in a horizontal plane, whose slider meets a stop, and a rough
/// disc with a torque that grows.
struct Crank {
    /// Place of the stop \[m].
    stop: f64,
    /// How fast the torque grows \[N m/s].
    growth: f64,
}

#[lagrangian(coordinates = [crank, rod, slider, disc])]
impl Crank {
    #[point(mass = 1.0)]
    fn knee(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.crank.cos(), q.crank.sin())
    }

    #[point(mass = 1.0)]
    fn piston(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.slider, 0.0)
    }

    #[kinetic]
    fn inertia(&self, v: &Velocities) -> f64 {
        0.5 * ROD * v.rod * v.rod + 0.5 * v.disc * v.disc
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        self.knee(q) + Vector2::new(q.rod.cos(), q.rod.sin()) - self.piston(q)
    }

    #[unilateral(restitution = 1.0)]
    fn gap(&self, q: &Coordinates) -> f64 {
        q.slider + self.stop
    }

    #[friction(limit = 1.0)]
    fn bearing(&self, v: &Velocities) -> f64 {
        v.disc
    }

    #[force]
    fn torque(&self, t: f64) -> [f64; 4] {
        [0.0, 0.0, 0.0, self.growth * t]
    }
}

/// The time in which a crank that turns at 1 rad/s in the dead centre turns from there by an angle: energy is
/// (1 + ROD + 4 sin² a) ȧ²/2, and Simpson's rule with so many parts has an error of rounding.
fn time(angle: f64) -> f64 {
    let slowness = |turned: f64| {
        let sine = (FRAC_PI_2 + turned).sin();
        ((1.0 + ROD + 4.0 * sine * sine) / (5.0 + ROD)).sqrt()
    };
    let parts = 2000;
    let width = angle / f64::from(parts);
    let sum = |part: i32| {
        let at = |place: f64| slowness(width * (f64::from(part) + place));
        at(0.0) + 4.0 * at(0.5) + at(1.0)
    };
    (0..parts).map(sum).sum::<f64>() * width / 6.0
}

#[test]
fn a_stop_beside_the_dead_centre_is_met() {
    let start = State::new([FRAC_PI_2, -FRAC_PI_2, 0.0, 0.0], [1.0, -1.0, -2.0, 0.0]);
    for stop in [1e-6, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0] {
        let crank = Crank { stop, growth: 0.0 };
        let mut motion = crank.simulate(start).with_tolerance(TIGHT);
        let switch = motion.advance_to_switch(5.0).unwrap().unwrap();
        close_on(1.0, switch.state.t, time((0.5 * stop).asin()), 1e-12);
        close_on(1.0, switch.before.q[2], -stop, 1e-13);
        close(switch.state.v[2], -switch.before.v[2], 1e-12);
    }
}

#[test]
fn friction_gives_way_beside_the_dead_centre() {
    let start = State::new([FRAC_PI_2, -FRAC_PI_2, 0.0, 0.0], [1.0, -1.0, -2.0, 0.0]);
    for first in [1e-4, 1e-3, 0.01, 0.05, 0.2, 0.5] {
        let crank = Crank { stop: 1.9, growth: 1.0 / first };
        let mut motion = crank.simulate(start).with_tolerance(TIGHT);
        let switch = motion.advance_to_switch(5.0).unwrap().unwrap();
        close(switch.state.t, first, 1e-12);
        let end = *motion.advance_to(0.6).unwrap();
        close(end.v[3], (0.6 - first).powi(2) / (2.0 * first), 1e-11);
    }
}
