//! N06: Housner's rocking block, which switches from corner to corner, and a box that rocks on a plank.

use std::marker::PhantomData;

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close_on;
use crate::support::sample::Samples;

struct Block<R>(PhantomData<R>);

#[lagrangian(coordinates = [x, y, theta])]
impl<R: Real> Block<R> {
    #[body(mass = 1.0, inertia = (0.2 * 0.2 + 0.5 * 0.5) / 3.0)]
    fn block(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Vector2::new(q.x, q.y), q.theta)
    }

    fn corner(&self, q: &Coordinates<R>, side: R) -> Vector2<R> {
        let (sin, cos) = (q.theta.sin(), q.theta.cos());
        Vector2::new(q.x + cos * side * 0.2 + sin * 0.5, q.y + sin * side * 0.2 - cos * 0.5)
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        9.81 * q.y
    }

    #[unilateral]
    fn corners(&self, q: &Coordinates<R>) -> [R; 2] {
        [self.corner(q, -1.0).y, self.corner(q, 1.0).y]
    }

    #[friction(coefficient = 10.0, normal = corners)]
    fn slips(&self, q: &Coordinates<R>, v: &Velocities<R>) -> [R; 2] {
        [-1.0, 1.0].map(|side| v.x - (q.theta.sin() * side * 0.2 - q.theta.cos() * 0.5) * v.theta)
    }
}

/// Tilted about its right corner.
fn tilted<R: Real>(angle: R) -> State<R, 3> {
    // Decimals of a description have all digits of its scalar, and so have quotients of whole numbers.
    let ((sin, cos), [width, height]) =
        (angle.sin_cos(), [2.0, 5.0].map(|half| R::from_f64(half) / R::from_f64(10.0)));
    State::new([-(cos * width - sin * height), sin * width + cos * height, -angle], [R::zero(); 3])
}

/// Six tenths of the angle at which it falls over \[rad].
const ANGLE: f64 = 0.22830382626741894;

#[test]
fn a_block_rocks_from_corner_to_corner_and_stands() {
    let mut motion = Block(PhantomData).simulate(tilted(ANGLE)).with_tolerance(TIGHT);
    let impacts = [
        (0.42525069704209145, 1.0151999386126647),
        (0.9290969992161432, 0.8051585720031478),
        (1.2892595908674072, 0.6385740398645655),
    ];
    for (time, rate) in impacts {
        let impact = motion.advance_to_switch(10.0).unwrap().unwrap();
        close_on(1.0, impact.state.t, time, 1e-12);
        close_on(1.0, impact.state.v[2].abs(), rate, 1e-10);
        assert_eq!(
            motion.contacts().corners.map(|corner| corner == Contact::Closed).iter().filter(|x| **x).count(),
            1
        );
    }
    let state = *motion.advance_to(20.0).unwrap();
    assert_eq!(state.v, [0.0; 3]);
    assert_eq!(motion.contacts().corners, [Contact::Closed; 2]);
    close_on(1.0, state.q[2], 0.0, 1e-12);
    close_on(1.0, state.q[1], 0.5, 1e-12);
}

#[cfg(feature = "double-double")]
#[test]
fn the_digits_of_a_rocking_block_are_true() {
    use crate::support::digits::{agree, at_switches};

    let double = at_switches!(Block(PhantomData), tilted(ANGLE), TIGHT, 12);
    let [coarse, fine] = [1e-22, 1e-27].map(|tolerance| {
        at_switches!(Block(PhantomData), tilted(lagrangian::DoubleDouble::from(ANGLE)), tolerance.into(), 12)
    });
    agree(&double, [&coarse, &fine], [TIGHT, 1e-22]);
}

/// A plank on a pivot, which a torque holds against a stop, and a box that is set down on it tilted.
struct Plank {
    mass: f64,
    load: f64,
    half: f64,
    friction: f64,
    stop: f64,
}

/// The torque that holds the plank \[N m].
const HOLD: f64 = 9.0;

#[lagrangian(coordinates = [p, x, y, a])]
impl Plank {
    #[kinetic]
    fn plank(&self, v: &Velocities) -> f64 {
        self.mass / 6.0 * v.p.powi(2)
    }

    #[force(on = p)]
    fn hold(&self) -> f64 {
        9.0
    }

    #[body(mass = self.load, inertia = self.load * self.half.powi(2) * 2.0 / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.a)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.load * q.y
    }

    fn feet(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        let block = self.block(q);
        [-1.0, 1.0].map(|side| (block * Point2::new(side * self.half, -self.half)).coords)
    }

    #[unilateral]
    fn ground(&self, q: &Coordinates) -> [f64; 2] {
        let normal = Vector2::new(-q.p.sin(), q.p.cos());
        self.feet(q).map(|foot| foot.dot(&normal))
    }

    #[friction(coefficient = self.friction, normal = ground)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let along = Vector2::new(q.p.cos(), q.p.sin());
        let (feet, velocities) = (self.feet(q), self.feet_velocity(q, v));
        [0, 1].map(|foot| {
            let below = v.p * Vector2::new(-feet[foot].y, feet[foot].x);
            (velocities[foot] - below).dot(&along)
        })
    }

    #[unilateral]
    fn end(&self, q: &Coordinates) -> f64 {
        self.stop - q.p.sin()
    }
}

/// The box pushes the plank off its stop, and the stop throws the box up, for shorter and shorter times.
#[test]
fn a_box_comes_to_rest_on_a_plank_that_rests_on_a_stop() {
    let (mut samples, mut rest) = (Samples::new(5), 0);
    for _ in 0..100 {
        let plank = Plank {
            mass: samples.number(0.5, 3.0),
            load: samples.number(0.5, 2.0),
            half: samples.number(0.03, 0.08),
            friction: samples.number(0.3, 0.9),
            stop: samples.number(0.1, 0.2),
        };
        let (p, arm): (f64, f64) = (plank.stop.asin(), samples.number(0.2, 0.6));
        let height = plank.half + samples.number(0.0, 0.05);
        let place = [arm * p.cos() - height * p.sin(), arm * p.sin() + height * p.cos()];
        let tilt = p + samples.number(0.0, 0.01);
        let start =
            State::new([p, place[0], place[1] + 0.001, tilt], [0.0, 0.0, 0.0, samples.number(-1.0, 1.0)]);
        let energy = |state: &State<f64, 4>| plank.energy(state) - HOLD * state.q[0];
        let mut motion = plank.simulate(start);
        let (mut last, mut switches) = (energy(&start), 0);
        while let Some(switch) = motion.advance_to_switch(1.5).unwrap() {
            let now = energy(&switch.state);
            assert!(now < last + 1e-9, "{switches}: {now} after {last}");
            (last, switches) = (now, switches + 1);
            assert!(switches < 1000, "{start:?}");
        }
        rest += usize::from(motion.state().v == [0.0; 4]);
    }
    assert!(rest > 30, "{rest}");
}
