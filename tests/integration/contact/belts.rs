//! Pucks on springs and rough belts: slips in two directions begin, turn and end at any tolerance.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A puck in double precision and one in single precision.
macro_rules! puck {
    ($name:ident, $number:ty) => {
        #[derive(Clone, Copy, Debug)]
        struct $name {
            stiffness: [$number; 2],
            limit: $number,
            belt: $number,
        }

        #[lagrangian(coordinates = [x, y])]
        impl $name {
            #[point(mass = 1.0)]
            fn puck(&self, q: &Coordinates) -> Vector2<$number> {
                Vector2::new(q.x, q.y)
            }

            #[potential]
            fn springs(&self, q: &Coordinates) -> $number {
                0.5 * (self.stiffness[0] * q.x * q.x + self.stiffness[1] * q.y * q.y)
            }

            #[friction(limit = self.limit)]
            fn slip(&self, v: &Velocities) -> Vector2<$number> {
                Vector2::new(v.x - self.belt, v.y)
            }
        }
    };
}

puck!(Puck, f64);
puck!(Single, f32);

/// Pucks whose numbers single precision has, and their starts. Every other belt stands still.
fn pucks(count: u32) -> impl Iterator<Item = (Puck, State<f64, 2>)> {
    let mut random = Samples::new(7);
    let mut pick = move |low: f64, high: f64| f64::from(random.number(low, high) as f32);
    (0..count).map(move |index| {
        let belt = pick(-1.0, 1.0);
        let puck = Puck {
            stiffness: [pick(1.0, 21.0), pick(1.0, 21.0)],
            limit: pick(0.2, 3.2),
            belt: if index % 2 == 0 { 0.0 } else { belt },
        };
        (puck, State::new([pick(-1.0, 1.0), pick(-1.0, 1.0)], [pick(-1.0, 1.0), pick(-1.0, 1.0)]))
    })
}

/// The largest error at the end in tolerances. Friction damps errors, so that those of the last steps remain.
const TOLERANCES: f64 = 5.0;

fn pucks_are_as_accurate_as_they_are_asked_for(count: u32) {
    for (puck, start) in pucks(count) {
        let end = *puck.simulate(start).with_tolerance(1e-13).advance_to(5.0).unwrap();
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let found = *puck.simulate(start).with_tolerance(tolerance).advance_to(5.0).unwrap();
            for i in 0..2 {
                close_on(1.0, found.q[i], end.q[i], TOLERANCES * tolerance);
            }
        }
    }
}

#[test]
fn a_puck_on_a_belt_is_as_accurate_as_it_is_asked_for() {
    pucks_are_as_accurate_as_they_are_asked_for(60);
}

#[test]
#[ignore = "thousands of motions: scripts/check.sh runs them"]
fn thousands_of_pucks_are_as_accurate_as_they_are_asked_for() {
    pucks_are_as_accurate_as_they_are_asked_for(4000);
}

#[test]
fn a_puck_slips_on_a_belt_in_single_precision() {
    for (puck, start) in pucks(60) {
        let number = |x: f64| x as f32;
        let single = Single {
            stiffness: puck.stiffness.map(number),
            limit: number(puck.limit),
            belt: number(puck.belt),
        };
        let begins = State::new(start.q.map(number), start.v.map(number));
        let found = *single.simulate(begins).with_tolerance(1e-5).advance_to(5.0).unwrap();
        let end = *puck.simulate(start).with_tolerance(1e-13).advance_to(5.0).unwrap();
        for i in 0..2 {
            close_on(1.0, f64::from(found.q[i]), end.q[i], TOLERANCES * 1e-5);
        }
    }
}

/// Two balls on an inclined plane: one slips, the other one begins to.
struct Balls {
    roughness: f64,
    slope: f64,
}

/// Mass 1 kg, radius, and moment of inertia.
const RADIUS: f64 = 0.022;
const INERTIA: f64 = 0.53 * RADIUS * RADIUS;

#[lagrangian(coordinates = [x, y, roll, pitch, other_x, other_y, other_roll, other_pitch])]
impl Balls {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        let slide = v.x.powi(2) + v.y.powi(2) + v.other_x.powi(2) + v.other_y.powi(2);
        let turn = v.roll.powi(2) + v.pitch.powi(2) + v.other_roll.powi(2) + v.other_pitch.powi(2);
        0.5 * (slide + INERTIA * turn)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -self.slope * (q.x + q.other_x)
    }

    #[friction(limit = self.roughness)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x - RADIUS * v.pitch, v.y + RADIUS * v.roll)
    }

    #[friction(limit = self.roughness)]
    fn other_slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.other_x - RADIUS * v.other_pitch, v.other_y + RADIUS * v.other_roll)
    }
}

#[test]
fn a_slip_begins_while_another_one_is_fast() {
    for (slope, roughness) in [(0.637, 0.01), (0.637, 0.02), (0.05, 0.01), (0.637, 1.0), (0.05, 1.0)] {
        for first in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]] {
            let [x, y] = first;
            let start = State::new([0.0; 8], [x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let balls = Balls { roughness, slope };
            let end = *balls.simulate(start).advance_to(1.0).unwrap();
            // The other one rolls, or slips against all the friction that there is.
            let accelerated = (slope / 1.53).max(slope - roughness);
            close_on(1.0, end.q[4], 0.5 * accelerated, 1e-11);
        }
    }
}
