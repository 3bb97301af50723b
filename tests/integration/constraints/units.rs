//! Independence of the units of mass, length and time, also of projections and of the checks of starts.

use lagrangian::prelude::*;

use crate::support::close::close;

/// A pendulum whose pivot runs on a rail and whose rod turns a wheel by a gear: lengths and angles together,
/// a constraint that is one coordinate alone, and one on velocities.
#[derive(Clone, Copy)]
struct Rig {
    mass: f64,
    inertia: f64,
    length: f64,
    radius: f64,
    g: f64,
}

#[lagrangian(coordinates = [rail: [2], bob: [2], tilt, wheel], allow(integrable))]
impl Rig {
    #[point(mass = self.mass)]
    fn masses(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::from(q.rail), Vector2::from(q.bob)]
    }

    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        self.inertia * (v.tilt.powi(2) + v.wheel.powi(2) + v.tilt * v.wheel) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * (q.rail[1] + q.bob[1]) + self.mass * self.g * self.length * q.wheel.powi(2)
    }

    #[holonomic]
    fn level(&self, q: &Coordinates) -> f64 {
        q.rail[1]
    }

    #[holonomic]
    fn upright(&self, q: &Coordinates) -> f64 {
        q.tilt
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        let [rail, bob] = self.masses(q);
        (bob - rail).norm() - self.length
    }

    #[nonholonomic]
    fn gear(&self, v: &Velocities) -> f64 {
        v.rail[0] - self.radius * v.wheel
    }
}

/// The same in units of `mass` \[kg], `length` \[m], `time` \[s].
fn rig(mass: f64, length: f64, time: f64) -> Rig {
    Rig {
        mass: 1.5 / mass,
        inertia: 0.25 / (mass * length * length),
        length: 1.25 / length,
        radius: 0.5 / length,
        g: 9.75 / (length / time / time),
    }
}

/// Numbers in metres, radians and seconds, in other units.
fn units(length: f64) -> [f64; 6] {
    [length, length, length, length, 1.0, 1.0]
}

fn start(length: f64, time: f64, spoil: [f64; 6]) -> State<f64, 6> {
    let (q, v) = ([0.25, 0.0, 1.0, -1.0, 0.0, 0.125], [0.5, 0.0, 1.5, 0.75, 0.0, 1.0]);
    State::new(
        std::array::from_fn(|i| (q[i] + spoil[i]) / units(length)[i]),
        std::array::from_fn(|i| v[i] / units(length)[i] * time),
    )
}

/// The end in metres and seconds, the reactions in newtons and newton metres, and the number of steps.
fn run(mass: f64, length: f64, time: f64) -> ([f64; 12], [f64; 4], u64) {
    let rig = rig(mass, length, time);
    let mut motion = rig.simulate(start(length, time, [0.0; 6])).with_tolerance(1e-14);
    assert!(motion.every(0.25 / time).take(5).all(|sample| sample.is_ok()));
    let state = *motion.advance_to(4.0 / time).unwrap();
    let numbers = std::array::from_fn(|i| match i {
        0..6 => state.q[i] * units(length)[i],
        _ => state.v[i - 6] * units(length)[i - 6] / time,
    });
    let force = mass * length / time / time;
    let reactions = motion.reactions();
    let reactions = [
        reactions.level * force,
        reactions.upright * force * length,
        reactions.rod * force,
        reactions.gear * force,
    ];
    (numbers, reactions, motion.steps().accepted)
}

/// Units by powers of ten, one at a time and all at once.
fn choices() -> Vec<(f64, f64, f64)> {
    let mut choices = Vec::new();
    for exponent in [-12, -5, 7, 12] {
        let unit = 10.0_f64.powi(exponent);
        choices.extend([(unit, 1.0, 1.0), (1.0, unit, 1.0), (1.0, 1.0, unit), (unit, unit, unit)]);
    }
    choices
}

#[test]
fn the_motion_is_the_same_in_all_units() {
    let (numbers, reactions, steps) = run(1.0, 1.0, 1.0);
    for (mass, length, time) in choices() {
        let (found, forces, count) = run(mass, length, time);
        for (found, expected) in found.into_iter().zip(numbers) {
            close(found, expected, 1e-11);
        }
        for (found, expected) in forces.into_iter().zip(reactions) {
            close(found, expected, 1e-11);
        }
        assert!(count.abs_diff(steps) <= 1, "{count} and {steps} steps");
    }
}

#[test]
fn starts_are_judged_alike_in_all_units() {
    // The cart is off the rail, tilted, and its rod too long, by a thousandth and by a thousandth of a
    // billionth.
    for (mass, length, time) in choices() {
        let rig = rig(mass, length, time);
        for (place, constraint) in [(1, 0), (4, 1), (2, 2)] {
            let mut spoil = [0.0; 6];
            spoil[place] = 1e-3;
            let cause = rig.simulate(start(length, time, spoil)).advance_to(1.0 / time).unwrap_err().cause;
            let Cause::PositionViolated { constraint: found, .. } = cause else { panic!("{cause:?}") };
            assert_eq!(found, constraint, "units {mass:e}, {length:e}, {time:e}");
            let mended = rig.consistent(start(length, time, spoil)).unwrap();
            assert!(rig.simulate(mended).advance_to(0.1 / time).is_ok());
            spoil[place] = 1e-12;
            let mut motion = rig.simulate(start(length, time, spoil));
            assert!(motion.advance_to(0.1 / time).is_ok(), "units {mass:e}, {length:e}, {time:e}");
        }
    }
}
