//! A rope over rough drums in a row: each bears a part of the load, and the motion does not determine which.
//!
//! A drum with a coefficient c bears up to c times the tension on its low side. With T₀ on the low end of the
//! rope it rests until its high end is pulled by T₀ ∏ (1 + cᵢ), and all drums slip at once then.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A weight, two drums, and a pull that grows.
struct Two {
    weight: f64,
    drums: [f64; 2],
    rough: [f64; 2],
    growth: f64,
}

#[lagrangian(coordinates = [x, s: [2]], sensitivities = [self.growth])]
impl Two {
    #[kinetic]
    fn moving(&self, v: &Velocities) -> f64 {
        let drums = self.drums[0] * v.s[0].powi(2) + self.drums[1] * v.s[1].powi(2);
        0.5 * (self.weight * v.x.powi(2) + drums)
    }

    #[potential]
    fn lifted(&self, q: &Coordinates) -> f64 {
        9.81 * self.weight * q.x
    }

    #[force(on = s)]
    fn pull(&self, t: f64) -> [f64; 2] {
        [0.0, 9.81 * self.weight + self.growth * t]
    }

    #[holonomic]
    fn low(&self, q: &Coordinates) -> f64 {
        q.s[0] - q.x
    }

    #[holonomic]
    fn high(&self, q: &Coordinates) -> f64 {
        q.s[1] - q.s[0]
    }

    #[friction(coefficient = self.rough[0], normal = low)]
    fn first(&self, v: &Velocities) -> f64 {
        v.s[0]
    }

    #[friction(coefficient = self.rough[1], normal = high)]
    fn second(&self, v: &Velocities) -> f64 {
        v.s[1]
    }
}

/// The same with three drums.
struct Three {
    weight: f64,
    drums: [f64; 3],
    rough: [f64; 3],
    growth: f64,
}

#[lagrangian(coordinates = [x, s: [3]])]
impl Three {
    #[kinetic]
    fn moving(&self, v: &Velocities) -> f64 {
        let drums: f64 = (0..3).map(|i| self.drums[i] * v.s[i].powi(2)).sum();
        0.5 * (self.weight * v.x.powi(2) + drums)
    }

    #[potential]
    fn lifted(&self, q: &Coordinates) -> f64 {
        9.81 * self.weight * q.x
    }

    #[force(on = s)]
    fn pull(&self, t: f64) -> [f64; 3] {
        [0.0, 0.0, 9.81 * self.weight + self.growth * t]
    }

    #[holonomic]
    fn low(&self, q: &Coordinates) -> f64 {
        q.s[0] - q.x
    }

    #[holonomic]
    fn middle(&self, q: &Coordinates) -> f64 {
        q.s[1] - q.s[0]
    }

    #[holonomic]
    fn high(&self, q: &Coordinates) -> f64 {
        q.s[2] - q.s[1]
    }

    #[friction(coefficient = self.rough[0], normal = low)]
    fn first(&self, v: &Velocities) -> f64 {
        v.s[0]
    }

    #[friction(coefficient = self.rough[1], normal = middle)]
    fn second(&self, v: &Velocities) -> f64 {
        v.s[1]
    }

    #[friction(coefficient = self.rough[2], normal = high)]
    fn third(&self, v: &Velocities) -> f64 {
        v.s[2]
    }
}

/// What the pull has to exceed the weight by to move a rope, and the mass that it moves then: each drum
/// multiplies what the rope needs below it.
fn moved(weight: f64, drums: &[f64], rough: &[f64]) -> [f64; 2] {
    let (mut factor, mut mass) = (1.0, weight);
    for (drum, rough) in drums.iter().zip(rough) {
        factor *= 1.0 + rough;
        mass = (1.0 + rough) * mass + drum;
    }
    [9.81 * weight * (factor - 1.0), mass]
}

#[test]
fn a_rope_over_two_drums_rests_until_both_bear_what_they_can() {
    let mut samples = Samples::new(41);
    for _ in 0..60 {
        let [weight, growth] = [samples.number(0.1, 10.0), samples.number(1.0, 300.0)];
        let drums = [0; 2].map(|_| samples.number(0.01, 1.0));
        let rough = [0; 2].map(|_| samples.number(0.05, 3.0));
        let rope = Two { weight, drums, rough, growth };
        let ([load, mass], start) = (moved(weight, &drums, &rough), State::at_rest([0.0; 3]));
        let time = load / growth;
        let mut motion = rope.simulate(start);
        let switch = motion.advance_to_switch(1.5 * time).unwrap().expect("the rope slips");
        close_on(time, switch.state.t, time, 1e-12);
        // x = f (t − T)³ / 6m with T = load / f.
        let way = growth * time.powi(3) / 6.0 / mass;
        close_on(way, motion.advance_to(2.0 * time).unwrap().q[0], way, 1e-10);
        let by_growth = way / growth + way * 3.0 / growth;
        let varied = rope.variational();
        let found = varied.motion(start).unwrap().advance_to(2.0 * time).unwrap().q_by_p[0];
        close_on(by_growth, found, by_growth, 1e-8);
    }
}

#[test]
fn a_rope_over_three_drums_rests_as_long_as_any_shares_are_possible() {
    let mut samples = Samples::new(43);
    for _ in 0..60 {
        let [weight, growth] = [samples.number(0.1, 10.0), samples.number(1.0, 300.0)];
        let drums = [0; 3].map(|_| samples.number(0.01, 1.0));
        let rough = [0; 3].map(|_| samples.number(0.05, 3.0));
        let rope = Three { weight, drums, rough, growth };
        let [load, mass] = moved(weight, &drums, &rough);
        let time = load / growth;
        let mut motion = rope.simulate(State::at_rest([0.0; 4]));
        let switch = motion.advance_to_switch(1.5 * time).unwrap().expect("the rope slips");
        close_on(time, switch.state.t, time, 1e-12);
        let way = growth * time.powi(3) / 6.0 / mass;
        close_on(way, motion.advance_to(2.0 * time).unwrap().q[0], way, 1e-10);
        // In many calls, each of which begins anew.
        let mut motion = rope.simulate(State::at_rest([0.0; 4]));
        for part in 1..40 {
            let state = motion.advance_to(time * f64::from(part) / 40.0).unwrap();
            assert!(state.q.iter().chain(&state.v).all(|x| x.abs() < 1e-14), "{state:?}");
        }
    }
}
