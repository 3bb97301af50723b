//! A slider-crank mechanism whose slider has clearance in its guide: four corners, each with friction.
//!
//! P. Flores, R. Leine, C. Glocker, "Modeling and analysis of planar rigid multibody systems with
//! translational clearance joints based on the non-smooth dynamics approach", Multibody System Dynamics 23
//! (2010). The parameters are those of its table 1. It has figures of the motion and no digits; the digits
//! here are those that `f64` and the double-double have in common.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close};

struct Mechanism<R> {
    friction: R,
}

/// Lengths of crank and rod; halves of the slider's length and height; half the height of the guide \[m].
const CRANK: f64 = 0.153;
const ROD: f64 = 0.306;
const HALF: [f64; 2] = [0.05, 0.025];
const GUIDE: f64 = 0.026;

#[lagrangian(coordinates = [crank, rod, slider])]
impl<R: Real> Mechanism<R> {
    fn pin(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.crank.cos(), q.crank.sin()) * R::from_f64(CRANK)
    }

    fn along_rod(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.rod.cos(), q.rod.sin()) * R::from_f64(ROD)
    }

    #[body(mass = 0.038, inertia = 7.4e-5)]
    fn first(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (self.pin(q) * 0.5, q.crank)
    }

    #[body(mass = 0.038, inertia = 5.9e-4)]
    fn second(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (self.pin(q) + self.along_rod(q) * 0.5, q.rod)
    }

    #[body(mass = 0.076, inertia = 2.7e-6)]
    fn third(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (self.pin(q) + self.along_rod(q), q.slider)
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        let (pin, rod) = (self.pin(q).y, self.along_rod(q).y);
        9.81 * (0.038 * 0.5 * pin + 0.038 * (pin + 0.5 * rod) + 0.076 * (pin + rod))
    }

    /// Two at the upper side of the guide, two at the lower one.
    #[unilateral(restitution = 0.4)]
    fn corners(&self, q: &Coordinates<R>) -> [R; 4] {
        let y = self.third(q).0.y;
        let (lever, height) = (R::from_f64(HALF[0]) * q.slider.sin(), R::from_f64(HALF[1]) * q.slider.cos());
        [
            R::from_f64(GUIDE) - (y - lever + height),
            R::from_f64(GUIDE) - (y + lever + height),
            R::from_f64(GUIDE) + (y - lever - height),
            R::from_f64(GUIDE) + (y + lever - height),
        ]
    }

    #[friction(coefficient = self.friction, normal = corners)]
    fn slips(&self, q: &Coordinates<R>, v: &Velocities<R>) -> [R; 4] {
        let x = -R::from_f64(CRANK) * q.crank.sin() * v.crank - R::from_f64(ROD) * q.rod.sin() * v.rod;
        let (lever, height) = (
            R::from_f64(HALF[0]) * q.slider.sin() * v.slider,
            R::from_f64(HALF[1]) * q.slider.cos() * v.slider,
        );
        [x + lever - height, x - lever - height, x + lever + height, x - lever + height]
    }
}

fn start<R: Real>() -> State<R, 3> {
    State::new([R::zero(); 3], [150.0, -75.0, 0.0].map(R::from_f64))
}

/// A time at which the slider strikes, and the rates of crank and rod after it.
type Impact = (f64, [f64; 2]);

/// Follows the mechanism for 0.2 s. The first impacts are compared with these; returns the end.
fn follow(friction: f64, expected: &[Impact]) -> State<f64, 3> {
    let mechanism = Mechanism { friction };
    let mut motion = mechanism.simulate(start()).with_tolerance(TIGHT);
    let (mut energy, mut impacts) = (mechanism.energy(&start()), 0);
    while let Some(switch) = motion.advance_to_switch(0.2).unwrap() {
        let [before, after] = [switch.before, switch.state].map(|state| mechanism.energy(&state));
        if friction == 0.0 {
            close(before, energy, 1e-12);
        }
        assert!(before <= energy + 1e-11 && after <= before + 1e-11, "{energy} {before} {after}");
        energy = after;
        // The start is symmetric, and stays so: both corners of a side strike at once.
        let [crank, rod, _] = switch.state.q;
        let gap = GUIDE - HALF[1] - (CRANK * crank.sin() + ROD * rod.sin()).abs();
        assert!(gap > -1e-14, "{gap}");
        assert!(switch.state.q[2].abs() < 1e-14, "{:?}", switch.state);
        if motion.impulses().corners != [0.0; 4] {
            if let Some((time, [crank, rod])) = expected.get(impacts) {
                close(switch.state.t, *time, 1e-11);
                close(switch.state.v[0], *crank, 1e-10);
                close(switch.state.v[1], *rod, 1e-10);
            }
            impacts += 1;
        }
    }
    assert!(impacts > 100, "{impacts}");
    *motion.state()
}

#[test]
fn a_slider_strikes_its_guide() {
    let end = follow(
        0.0,
        &[
            (0.002692502752021212, [108.79372856053534, -52.8751878746233]),
            (0.005607797868070903, [81.52450238368843, -34.828484877715186]),
            (0.007465635169560336, [73.44688479569833, -28.190228860473343]),
            (0.00840925274906967, [70.72528355255152, -25.474714897443946]),
        ],
    );
    // After 114 impacts in doubles, or twice as many with 31 digits: each time it comes to rest there are
    // infinitely many.
    all_close(end.q, [18.176877210535389, 0.31340392662751417, 0.0], 1e-11);
    all_close(end.v, [77.740_970_002_975_89, -31.202537547846027, 0.0], 1e-9);
}

#[test]
fn friction_in_the_guide_slows_the_mechanism() {
    let end = follow(
        0.01,
        &[
            (0.002692502752021212, [108.724_580_001_767_4, -52.84229042028755]),
            (0.005612363190210418, [81.43823005661387, -34.787347262472515]),
            (0.00747505621239663, [73.35722181289598, -28.145_711_028_962_51]),
            (0.0084217679342493, [70.63513754603281, -25.428069185494684]),
        ],
    );
    // The last of infinitely many impacts are lost in the rounding errors of a gap, and so is their friction.
    all_close(end.q, [18.083_678_652_340_58, 0.352_482_196_174_327_2, 0.0], 1e-7);
}

#[cfg(feature = "double-double")]
#[test]
fn the_digits_of_the_mechanism_are_true() {
    use crate::support::digits::{agree, at_switches};

    let double = at_switches!(Mechanism { friction: 0.01 }, start(), TIGHT, 8);
    let [coarse, fine] = [1e-22, 1e-27].map(|tolerance| {
        let friction = lagrangian::DoubleDouble::from(0.01);
        at_switches!(Mechanism { friction }, start(), tolerance.into(), 8)
    });
    // Flights become shorter and shorter, and an ulp of time an ever larger part of one.
    agree(&double, [&coarse, &fine], [1e-11, 1e-20]);
}
