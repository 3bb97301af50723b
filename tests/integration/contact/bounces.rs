//! A ball that bounces to rest while it slides.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

struct Sliding {
    restitution: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Sliding {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// Once it rests on the floor, the floor has given the impulse t − v(0) by all impacts and reactions
/// together, and friction µ times as much.
#[test]
fn friction_of_infinitely_many_bounces_is_that_of_their_impulses() {
    for number in 0..48 {
        let part = f64::from(number) / 48.0;
        let sliding = Sliding { restitution: 0.1 + 0.7 * part, friction: 0.05 + 0.4 * (5.0 * part).fract() };
        let (height, rise) = (0.2 + (7.0 * part).fract(), (3.0 * part).fract() - 0.5);
        let start = State::new([0.0, height], [9.0, rise]);
        let strikes = (rise * rise + 2.0 * height).sqrt();
        let e = sliding.restitution;
        let rests = rise + strikes * (1.0 + 2.0 * e / (1.0 - e));
        let end = 1.1 * rests;
        let mut motion = sliding.simulate(start).with_tolerance(1e-13);
        let state = *motion.advance_to(end).unwrap();
        assert_eq!(state.v[1], 0.0, "{state:?}");
        close_on(9.0, state.v[0], 9.0 - sliding.friction * (end - rise), 1e-13);
    }
}

#[test]
fn a_velocity_crosses_zero_at_each_impact_and_at_the_top_of_each_flight() {
    let elastic = Sliding { restitution: 1.0, friction: 0.0 };
    for shift in [0.0, 0.25] {
        let mut motion = elastic.simulate(State::at_rest([0.0, 0.5])).with_tolerance(1e-13);
        let events = motion.events(|state: &State<f64, 2>| state.v[1] + shift, 9.5);
        let events: Vec<_> = events.map(Result::unwrap).collect();
        // Impacts at odd seconds, tops at even ones; the guard falls a little later than at the top.
        let wanted = (if shift == 0.0 { 1 } else { 0 }..10).map(|number| match number % 2 {
            1 => (f64::from(number), Crossing::Rising),
            _ => (f64::from(number) + shift, Crossing::Falling),
        });
        assert_eq!(events.len(), wanted.len(), "{events:?}");
        for (event, (t, crossing)) in events.iter().zip(wanted) {
            close_on(1.0, event.state.t, t, 1e-14);
            assert_eq!(event.crossing, crossing, "{event:?}");
        }
    }
}

/// A small ball between a wall and a large one.
struct Pinched {
    masses: [f64; 2],
    restitution: f64,
    gravity: f64,
}

#[lagrangian(coordinates = [a, b])]
impl Pinched {
    #[point(mass = self.masses[..])]
    fn balls(&self, q: &Coordinates) -> [f64; 2] {
        [q.a, q.b]
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity * (self.masses[0] * q.a + self.masses[1] * q.b)
    }

    #[unilateral(restitution = self.restitution)]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.a
    }

    #[unilateral(restitution = self.restitution)]
    fn gap(&self, q: &Coordinates) -> f64 {
        q.b - q.a
    }
}

impl Pinched {
    /// When the balls rest at the wall, without gravity: gaps are followed apart from each other, impact by
    /// impact, for far longer than positions have digits. `None` if the large ball escapes.
    fn collapses(&self, q: [f64; 2], v: [f64; 2]) -> Option<f64> {
        let [m, n] = self.masses;
        let (mut wall, mut gap, [mut u, mut w], mut t) = (q[0], q[1] - q[0], v, 0.0);
        for _ in 0..400 {
            let until =
                |distance: f64, speed: f64| if speed < 0.0 { distance / -speed } else { f64::INFINITY };
            let [first, second] = [until(wall, u), until(gap, w - u)];
            let step = first.min(second);
            if !step.is_finite() {
                return None;
            }
            (wall, gap, t) = (wall + step * u, gap + step * (w - u), t + step);
            if first <= second {
                (wall, u) = (0.0, -self.restitution * u);
            } else {
                let impulse = (1.0 + self.restitution) * (u - w) * m * n / (m + n);
                (gap, u, w) = (0.0, u - impulse / m, w + impulse / n);
            }
        }
        Some(t)
    }
}

/// Its bounces between both become shorter than rounding can tell before the velocities are small. The large
/// ball comes to rest then; it was thrown back by the last bounce that had been seen.
#[test]
fn a_ball_that_is_pinched_against_a_wall_does_not_throw_the_other_back() {
    let mut collapsed = 0;
    for (number, &restitution) in [0.0, 0.05, 0.1, 0.15, 0.2, 0.3].iter().enumerate() {
        for masses in [[1.0, 1.0], [0.5, 1.0], [0.2, 2.0], [0.1, 3.0], [1.0, 3.0]] {
            let pinched = Pinched { masses, restitution, gravity: 0.0 };
            let (q, v) = ([0.5, 0.8], [-1.0 + 0.05 * number as f64, -0.7]);
            let Some(end) = pinched.collapses(q, v) else { continue };
            for tolerance in [1e-6, 1e-10, 1e-13] {
                let mut motion = pinched.simulate(State::new(q, v)).with_tolerance(tolerance);
                let state = motion.advance_to(end + 10.0).unwrap();
                // Velocities below the tolerance are those of bounces that it hides.
                let slow = state.v.iter().all(|v| v.abs() <= tolerance.max(1e-12));
                let near = state.q.iter().all(|q| q.abs() <= 20.0 * tolerance.max(1e-12));
                assert!(slow && near, "{restitution} {masses:?} {tolerance}: {state:?}");
            }
            collapsed += 1;
        }
    }
    assert!(collapsed > 12, "{collapsed}");
}

/// The same under gravity, far from rest: the impacts until then in 120 digits end at this time.
#[test]
fn a_ball_that_is_pinched_against_the_floor_stays_there() {
    let pinched = Pinched {
        masses: [0.105_761_254_447_899_86, 2.951_760_060_005_08],
        restitution: 0.322_458_667_014_862,
        gravity: 9.81,
    };
    let start = State::at_rest([0.194_252_441_397_537_92, 0.667_974_521_511_17]);
    let mut motion = pinched.simulate(start);
    let state = motion.advance_to(0.369_029_240_322).unwrap();
    assert_eq!((state.q, state.v), ([0.0; 2], [0.0; 2]));
    assert_eq!(motion.advance_to(2.0).unwrap().v, [0.0; 2]);
}

/// A bar that falls flat on its tips.
struct Bar {
    half: f64,
    friction: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Bar {
    #[body(mass = 1.0, inertia = self.half * self.half / 3.0)]
    fn bar(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    fn tips(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [-1.0, 1.0].map(|side| (self.bar(q) * Point2::new(side * self.half, 0.0)).coords)
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        self.tips(q).map(|tip| tip.y)
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        self.tips_velocity(q, v).map(|velocity| velocity.x)
    }
}

/// Near π the sine of an angle is zero, with the rounding errors of π: the last bounces are lower than these.
/// Near zero it has nothing to be small beside, and a motion begins again from its end.
#[test]
fn a_bar_comes_to_rest_whichever_way_round_it_lies() {
    let mut samples = Samples::new(31);
    for turns in [0.0, 1.0, 2.0, 100.0] {
        for _ in 0..30 {
            let bar = Bar {
                half: samples.number(0.2, 1.0),
                friction: samples.number(0.2, 1.2),
                restitution: samples.number(0.1, 0.6),
            };
            let phi = turns * std::f64::consts::PI + samples.number(-0.5, 0.5);
            let y = bar.half * phi.sin().abs() + samples.number(0.0, 0.1);
            for tolerance in [1e-6, 1e-10, 1e-13] {
                let start = State::at_rest([0.0, y, phi]);
                let mut motion = bar.simulate(start).with_tolerance(tolerance).with_max_steps(20_000);
                let end =
                    *motion.advance_to(10.0).unwrap_or_else(|error| panic!("{phi} {tolerance}: {error}"));
                assert_eq!(end.v, [0.0; 3], "{phi} {tolerance}");
                bar.simulate(end).advance_to(11.0).unwrap_or_else(|error| panic!("{end:?}: {error}"));
            }
        }
    }
}
