//! Round rooms: the distance from a centre has a series that reaches no further than the centre.

use lagrangian::prelude::*;

use crate::support::close::all_close_on_largest;
use crate::support::sample::Samples;

/// A ball in a round room of radius one.
struct Room;

#[lagrangian(coordinates = [x, y])]
impl Room {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral(restitution = 1.0)]
    fn wall(&self, q: &Coordinates) -> f64 {
        1.0 - self.ball(q).norm()
    }
}

/// The way of a ball of speed one: a flight to the wall, and chords, each the one before turned about the
/// centre.
struct Chords {
    start: [Vector2<f64>; 2],
    first: f64,
    /// Where the first chord begins, and its direction.
    chord: [Vector2<f64>; 2],
    length: f64,
}

impl Chords {
    fn new(place: Vector2<f64>, direction: Vector2<f64>) -> Self {
        let along = place.dot(&direction);
        let first = (along * along + 1.0 - place.norm_squared()).sqrt() - along;
        let wall = place + direction * first;
        let towards = direction.dot(&wall);
        let chord = [wall, direction - wall * (2.0 * towards)];
        Self { start: [place, direction], first, chord, length: 2.0 * towards }
    }

    fn at(&self, t: f64) -> [f64; 2] {
        let [place, direction] = self.start;
        if t < self.first {
            return (place + direction * t).into();
        }
        let number = ((t - self.first) / self.length).floor();
        let [wall, chord] = self.chord;
        let next = wall + chord * self.length;
        let turn = wall.perp(&next).atan2(wall.dot(&next)) * number;
        let turned = |a: Vector2<f64>| {
            Vector2::new(turn.cos() * a.x - turn.sin() * a.y, turn.sin() * a.x + turn.cos() * a.y)
        };
        (turned(wall) + turned(chord) * (t - self.first - number * self.length)).into()
    }
}

/// Steps whose lengths are such parts of a chord.
fn stepped<const ORDER: usize>(chords: &[f64]) {
    for &part in chords {
        let mut samples = Samples::new(ORDER as u64);
        for _ in 0..100 {
            let (far, [at, towards]) =
                (samples.number(0.05, 0.9), [(); 2].map(|()| samples.number(-3.1, 3.1)));
            let unit = |angle: f64| Vector2::new(angle.cos(), angle.sin());
            let [place, direction] = [unit(at) * far, unit(towards)];
            let exact = Chords::new(place, direction);
            let h = part * exact.length;
            let mut motion = Room.stepper::<Jet<ORDER>>(State::new(place, direction));
            for step in 1..=100 {
                let found = motion.step(h, &[]).unwrap().q;
                all_close_on_largest(found, exact.at(f64::from(step) * h), 1e-9);
            }
        }
    }
}

#[test]
fn steps_of_any_length_stay_in_a_round_room() {
    stepped::<2>(&[0.3, 2.7]);
    stepped::<4>(&[0.83, 7.3]);
    stepped::<6>(&[0.83, 2.7]);
    stepped::<12>(&[0.83, 7.3]);
}
