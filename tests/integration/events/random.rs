//! Random guards on random motions: none of their zeros is missed, none is found twice. The zeros are those of
//! simple guards along the same motion with 31 digits.

use lagrangian::DoubleDouble;
use lagrangian::prelude::*;

use crate::support::motion::TIGHT;
use crate::support::sample::Samples;

/// Two oscillators that bend each other.
struct Coupled<R> {
    stiffness: [R; 2],
    bend: R,
}

#[lagrangian(coordinates = [x, y])]
impl<R: Real> Coupled<R> {
    #[lagrangian]
    fn motion(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        0.5 * (v.x.powi(2) + v.y.powi(2))
            - 0.5 * (self.stiffness[0] * q.x.powi(2) + self.stiffness[1] * q.y.powi(2))
            - self.bend * q.x.powi(2) * q.y
    }
}

/// A sum of coordinates and velocities with these weights.
fn sum<R: Real>(weights: [R; 4], state: &State<R, 2>) -> R {
    let [x, y, v, w] = weights;
    x * state.q[0] + y * state.q[1] + v * state.v[0] + w * state.v[1]
}

/// A zero: its time, whether the sum rises there, and how fast it changes.
type Zero = (f64, bool, f64);

/// What is random about a motion and its guards.
struct Draw {
    stiffness: [f64; 2],
    bend: f64,
    start: [[f64; 2]; 2],
    weights: [f64; 4],
    level: f64,
    gap: f64,
}

const UNTIL: f64 = 20.0;

impl Draw {
    fn new(samples: &mut Samples, number: u32) -> Self {
        let mut four = || [(); 4].map(|()| samples.number(-0.7, 0.7));
        let ([x, y, v, w], weights) = (four(), four());
        Self {
            stiffness: [samples.number(0.5, 9.0), samples.number(0.5, 9.0)],
            bend: samples.number(0.0, 0.1),
            start: [[x, y], [v, w]],
            weights,
            level: samples.number(-0.5, 0.5),
            gap: [0.1, 1e-3, 1e-5][number as usize % 3],
        }
    }

    /// The zeros of the sum less its level, and less one that is a gap higher, with 31 digits.
    fn expected(&self) -> [Vec<Zero>; 2] {
        let number = DoubleDouble::from;
        let system = Coupled { stiffness: self.stiffness.map(number), bend: number(self.bend) };
        let start = State::new(self.start[0].map(number), self.start[1].map(number));
        let mut motion = system.simulate(start).with_tolerance(number(1e-22));
        let weights = self.weights.map(number);
        let above = |level: DoubleDouble| move |state: &State<DoubleDouble, 2>| sum(weights, state) - level;
        let low = number(self.level);
        let mut zeros = [vec![], vec![]];
        for event in motion.events_of([above(low), above(low + number(self.gap))], number(UNTIL)) {
            let event = event.unwrap();
            let State { t, v, .. } = event.state;
            let a = system.accelerations(&event.state).unwrap();
            let rate = sum(weights, &State { t, q: v, v: a }).high();
            zeros[event.index].push((t.high(), event.crossing == Crossing::Rising, rate.abs()));
        }
        zeros
    }

    /// The zeros in doubles of a function of the sum's distances from both levels.
    fn found(&self, guard: impl Fn([f64; 2]) -> f64) -> Vec<(f64, Crossing)> {
        let system = Coupled { stiffness: self.stiffness, bend: self.bend };
        let mut motion = system.simulate(State::new(self.start[0], self.start[1])).with_tolerance(TIGHT);
        let of = |state: &State<f64, 2>| {
            let above = sum(self.weights, state) - self.level;
            guard([above, above - self.gap])
        };
        let events = motion.events(of, UNTIL).map(|event| event.unwrap());
        events.map(|event| (event.state.t, event.crossing)).collect()
    }
}

/// Compares zeros, each within `error` of the sum.
fn compare(number: u32, found: &[(f64, Crossing)], expected: &[(f64, Crossing, f64)], error: f64) {
    assert_eq!(found.len(), expected.len(), "{number}: {found:?} for {expected:?}");
    for ((t, crossing), (time, kind, rate)) in found.iter().zip(expected) {
        assert_eq!(crossing, kind, "{number}: at {t}");
        assert!((t - time).abs() * rate < error, "{number}: {t} for {time}, rate {rate}");
    }
}

fn follow(count: u32) {
    let mut samples = Samples::new(17);
    let mut zeros = 0;
    for number in 0..count {
        let draw = Draw::new(&mut samples, number);
        let [low, high] = draw.expected();
        let direction = |rises| if rises { Crossing::Rising } else { Crossing::Falling };
        let of = |zeros: &[Zero], kind: &dyn Fn(bool) -> Crossing| -> Vec<_> {
            zeros.iter().map(|&(time, rises, rate)| (time, kind(rises), rate)).collect()
        };
        let simple = of(&low, &direction);
        compare(number, &draw.found(|[above, _]| above), &simple, 1e-12);
        // Where the sum all but touches its level, doubles do not tell two zeros of a square from one.
        if low.iter().all(|&(_, _, rate)| rate > 0.1) {
            let touching = of(&low, &|_| Crossing::Touching);
            compare(number, &draw.found(|[above, _]| above.powi(2)), &touching, 1e-7);
            zeros += low.len();
        }
        // The product falls through the lower level on the way up, and rises through it on the way down.
        let mut both = of(&low, &|rises| direction(!rises));
        both.extend(of(&high, &direction));
        both.sort_by(|a, b| a.0.total_cmp(&b.0));
        compare(number, &draw.found(|[low, high]| low * high), &both, 1e-12 / draw.gap);
        zeros += low.len() + both.len();
    }
    println!("{zeros} zeros");
    assert!(zeros > 20 * count as usize, "{zeros}");
}

#[test]
fn zeros_of_random_guards_are_met_once() {
    follow(20);
}

#[test]
#[ignore = "ten thousand motions: scripts/check.sh runs them"]
fn zeros_of_ten_thousand_random_guards_are_met_once() {
    follow(10_000);
}
