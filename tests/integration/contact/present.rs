//! Contacts and impulses of the state that a motion is at, wherever the steps of the integrator end.

use lagrangian::Contact;
use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A ball that is thrown across a rough floor.
struct Ball {
    restitution: f64,
}

#[lagrangian(coordinates = [x, y, turn])]
impl Ball {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2) + 0.4 * v.turn.powi(2))
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = 0.2, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x + v.turn
    }
}

/// A block on a spring and a moving belt.
struct Belt;

#[lagrangian(coordinates = [x])]
impl Belt {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.5 * q.x.powi(2)
    }

    #[friction(limit = 2.4, static_limit = 4.0)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - 0.2
    }
}

/// The end of the motions \[s].
const END: f64 = 4.0;

/// Moves from switch to switch and notes what holds from each of them on, then asks another motion at random
/// times. Gives the number of switches.
macro_rules! holds_between_switches {
    ($start:expr, $random:expr, |$motion:ident| $now:expr) => {{
        let mut $motion = $start;
        // What holds is known from the first step on.
        $motion.advance_to(1e-9).unwrap();
        let mut log = vec![(0.0, $now)];
        while $motion.advance_to_switch(END).unwrap().is_some() {
            log.push(($motion.t(), $now));
        }
        let mut $motion = $start;
        let mut t = 1e-9;
        while t < END {
            $motion.advance_to(t).unwrap();
            let (_, expected) = log.iter().rev().find(|(since, _)| *since <= t).unwrap();
            assert_eq!(&$now, expected, "t = {t}");
            t += $random.number(0.0, 0.2);
        }
        log.len() - 1
    }};
}

#[test]
fn contacts_and_impulses_are_those_of_the_state() {
    let mut random = Samples::new(3);
    let mut switches = 0;
    for _ in 0..40 {
        let ball = Ball { restitution: random.number(0.0, 0.6) };
        let height = random.number(0.2, 1.0);
        let [speed, spin] = [random.number(-2.0, 2.0), random.number(-2.0, 2.0)];
        let start = State::new([0.0, height, 0.0], [speed, 0.0, spin]);
        switches += holds_between_switches!(ball.simulate(start), random, |motion| {
            let (contacts, impulses) = (motion.contacts(), motion.impulses());
            // The last digits of an impulse depend on the steps before it.
            let digits = |impulse: f64| (impulse * 1e9).round();
            (contacts.floor, contacts.slip, digits(impulses.floor), digits(impulses.slip))
        });
        let start = State::new([random.number(-0.3, 0.4)], [random.number(-0.5, 0.5)]);
        switches += holds_between_switches!(Belt.simulate(start), random, |motion| motion.contacts().slip);
    }
    assert!(switches > 200, "{switches}");
}

#[test]
fn a_ball_in_the_air_touches_nothing() {
    let ball = Ball { restitution: 0.0 };
    let mut motion = ball.simulate(State::new([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]));
    motion.advance_to(0.1).unwrap();
    assert_eq!((motion.contacts().floor, motion.impulses().floor), (Contact::Open, 0.0));
    motion.advance_to(1.0).unwrap();
    assert_eq!(motion.contacts().floor, Contact::Closed);
    // The impulse that took the fall, though nothing else happens until then.
    assert!((motion.impulses().floor - (2.0_f64 * 9.81).sqrt()).abs() < 1e-12);
    motion.set_state(State::new([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]));
    assert_eq!((motion.contacts().floor, motion.impulses().floor), (Contact::Open, 0.0));
}

/// At the time of an impact, and an ulp beside it, contacts close and open again within rounding.
#[test]
fn samples_beside_an_impact_do_not_lose_its_impulse() {
    let mut random = Samples::new(11);
    for _ in 0..60 {
        let ball = Ball { restitution: random.number(0.3, 0.95) };
        let start = State::new([0.0, random.number(0.1, 2.0), 0.0], [0.0, random.number(-2.0, 3.0), 0.0]);
        let mut motion = ball.simulate(start);
        let impacts: Vec<(f64, f64)> = (0..5)
            .map(|_| {
                motion.advance_to_switch(1e3).unwrap().expect("an impact");
                (motion.t(), motion.impulses().floor)
            })
            .collect();
        for beside in [&[0][..], &[-1, 0, 1], &[-2, 2], &[1]] {
            let mut motion = ball.simulate(start);
            for (t, impulse) in &impacts {
                for ulps in beside {
                    motion.advance_to(f64::from_bits(t.to_bits().wrapping_add_signed(*ulps))).unwrap();
                }
                motion.advance_to(t + 0.05 * impulse / 9.81).unwrap();
                let found = motion.impulses().floor;
                assert!((found / impulse - 1.0).abs() < 1e-9, "{beside:?} at {t}: {found} {impulse}");
            }
        }
    }
}
