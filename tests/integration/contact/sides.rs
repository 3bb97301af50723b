//! Each side of an `if` has to be a number only where it is taken.

use lagrangian::prelude::*;

/// Particles of unit mass, each in a potential of its own, of which one side is no number, infinite, or has
/// no derivative where the other is taken.
struct Sides;

#[lagrangian(coordinates = [root, quotient, log, arcsine, area, hyperbolic, power, soft, nested, both, either, late, plane: [2]])]
impl Sides {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let line = v.root.powi(2)
            + v.quotient.powi(2)
            + v.log.powi(2)
            + v.arcsine.powi(2)
            + v.area.powi(2)
            + v.hyperbolic.powi(2)
            + v.power.powi(2)
            + v.soft.powi(2)
            + v.nested.powi(2)
            + v.both.powi(2)
            + v.either.powi(2)
            + v.late.powi(2);
        0.5 * (line + v.plane[0].powi(2) + v.plane[1].powi(2))
    }

    fn of_root(x: f64) -> f64 {
        if x < 1.0 { -(2.0 - x).sqrt() } else { 0.5 * x - 1.5 }
    }

    fn of_quotient(x: f64) -> f64 {
        if x > 1.0 { 1.0 / x } else { 2.0 - x }
    }

    fn of_log(x: f64) -> f64 {
        if x > 1.0 { x.ln() } else { x - 1.0 }
    }

    fn of_arcsine(x: f64) -> f64 {
        if x < 0.0 { 0.5 * (x.asin() - x.acos() + 0.5 * std::f64::consts::PI) } else { x }
    }

    fn of_area(x: f64) -> f64 {
        if x > 0.0 { x } else { x.atanh() }
    }

    fn of_hyperbolic(x: f64) -> f64 {
        if x > 2.0 { x.acosh() } else { 2.0_f64.acosh() }
    }

    fn of_power(x: f64) -> f64 {
        if x > 0.5 { x.powf(1.3) } else { 0.5_f64.powf(1.3) }
    }

    fn of_soft(x: f64) -> f64 {
        if x > 0.0 { (-1000.0 * x).exp() } else { 1.0 }
    }

    fn of_nested(x: f64) -> f64 {
        if x > 0.25 {
            let root = x.sqrt();
            if root > 1.5 { root } else { 1.5 }
        } else {
            1.5
        }
    }

    fn of_both(x: f64) -> f64 {
        if x > 0.25 && x.ln() > 0.25 { x.ln() } else { 0.25 }
    }

    fn of_either(x: f64) -> f64 {
        if x <= 0.25 || 1.5 >= x.sqrt() { 1.5 } else { x.sqrt() }
    }

    fn of_late(x: f64) -> f64 {
        let mut energy = 1.0;
        if x > 1.0 {
            energy += x.ln();
        }
        energy + if x > 1.0 { x.ln() } else { 0.0 }
    }

    fn of_plane(p: Vector2<f64>) -> f64 {
        if p.norm_squared() > 1.0 { p.norm() + p.y.atan2(p.x) } else { 1.0 }
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        Self::of_root(q.root)
            + Self::of_quotient(q.quotient)
            + Self::of_log(q.log)
            + Self::of_arcsine(q.arcsine)
            + Self::of_area(q.area)
            + Self::of_hyperbolic(q.hyperbolic)
            + Self::of_power(q.power)
            + Self::of_soft(q.soft)
            + Self::of_nested(q.nested)
            + Self::of_both(q.both)
            + Self::of_either(q.either)
            + Self::of_late(q.late)
            + Self::of_plane(Vector2::new(q.plane[0], q.plane[1]))
    }
}

/// From where another side is taken, on the way to the side of the function. The last goes along the axis,
/// where its angle is zero.
const START: [f64; 14] = [3.0, -1.0, -1.0, 2.0, 2.0, 0.0, -2.0, -2.0, -1.0, -1.0, -1.0, -1.0, 0.0, 0.0];
const SPEED: [f64; 14] = [-3.0, 3.0, 3.0, -1.0, -1.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 1.0, 0.0];

/// The energies of all particles.
fn energies(state: &State<f64, 14>) -> [f64; 13] {
    let potentials = [
        Sides::of_root,
        Sides::of_quotient,
        Sides::of_log,
        Sides::of_arcsine,
        Sides::of_area,
        Sides::of_hyperbolic,
        Sides::of_power,
        Sides::of_soft,
        Sides::of_nested,
        Sides::of_both,
        Sides::of_either,
        Sides::of_late,
    ];
    let (q, v) = (state.q, state.v);
    std::array::from_fn(|i| match potentials.get(i) {
        Some(potential) => 0.5 * v[i].powi(2) + potential(q[i]),
        None => 0.5 * (v[12].powi(2) + v[13].powi(2)) + Sides::of_plane(Vector2::new(q[12], q[13])),
    })
}

#[test]
fn the_side_that_is_not_taken_need_not_be_a_number() {
    let begun = energies(&State::new(START, SPEED));
    let mut motion = Sides.simulate(State::new(START, SPEED)).with_tolerance(1e-12);
    for part in 1..=30 {
        let t = 0.05 * f64::from(part);
        let now = energies(motion.advance_to(t).unwrap());
        for (i, (now, begun)) in now.into_iter().zip(begun).enumerate() {
            // The particle in the plane has a force across the axis beyond its kink.
            assert!(i == 12 && t > 0.99 || (now - begun).abs() < 1e-11, "{i} at {t}: {now} for {begun}");
        }
    }
    // All have come to the other side.
    let end = motion.state();
    assert!(end.q[0] < 1.0 && end.q[3] < 0.0 && end.q[4] < 0.0 && end.q[1] > 1.0 && end.q[12] > 1.0);
    assert!(end.q[5] > 2.0 && end.q[7] > 0.0 && end.q[8] > 2.25 && end.q[9] > 1.3 && end.q[10] > 2.25);
}

/// A jumper on a rope that is slack up to its length.
struct Jumper {
    length: f64,
    stiffness: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Jumper {
    #[point(mass = 1.0)]
    fn jumper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        10.0 * q.y
    }

    #[potential]
    fn rope(&self, q: &Coordinates) -> f64 {
        let square = self.jumper(q).norm_squared();
        if square <= self.length * self.length {
            return 0.0;
        }
        0.5 * self.stiffness * (square.sqrt() - self.length).powi(2)
    }
}

#[test]
fn functions_that_return_early_are_those_of_rust() {
    let jumper = Jumper { length: 2.0, stiffness: 30.0 };
    // From the pivot, where the length of the rope has no derivative.
    let start = State::new([0.0, 0.0], [1.0, 0.0]);
    let mut motion = jumper.simulate(start).with_tolerance(1e-12);
    let falls = *motion.advance_to(0.5).unwrap();
    for (value, exact) in falls.q.into_iter().chain(falls.v).zip([0.5, -1.25, 1.0, -5.0]) {
        assert!((value - exact).abs() < 1e-11, "{falls:?}");
    }
    for i in 1..=40 {
        let state = *motion.advance_to(0.5 + 0.25 * f64::from(i)).unwrap();
        assert!((jumper.energy(&state) - 0.5).abs() < 1e-10, "{state:?}");
    }
}

/// Particles of which each pair repels while it is close.
struct Soft;

#[lagrangian(coordinates = [x: [4], y: [4]])]
impl Soft {
    #[point(mass = 1.0)]
    fn particles(&self, q: &Coordinates) -> [Vector2<f64>; 4] {
        std::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn pairs(&self, q: &Coordinates) -> f64 {
        let places = self.particles(q);
        let mut energy = 0.0;
        for i in 0..4 {
            for j in 0..i {
                let square = (places[i] - places[j]).norm_squared();
                if square > 1.0 {
                    continue;
                }
                energy += 20.0 * (1.0 - square.sqrt()).powi(2);
            }
        }
        energy
    }
}

#[test]
fn loops_that_go_on_early_are_those_of_rust() {
    let by_hand = |state: &State<f64, 8>| {
        let (x, y) = (&state.q[..4], &state.q[4..]);
        let mut energy = 0.5 * state.v.iter().map(|v| v * v).sum::<f64>();
        for i in 0..4 {
            for j in 0..i {
                energy += 20.0 * (1.0 - (x[i] - x[j]).hypot(y[i] - y[j])).max(0.0).powi(2);
            }
        }
        energy
    };
    let start =
        State::new([0.0, 3.0, 0.2, 1.4, 0.0, 0.1, 2.0, 2.5], [1.0, -1.0, 0.1, 0.0, 0.0, 0.2, -1.0, -0.9]);
    let energy = by_hand(&start);
    let mut motion = Soft.simulate(start).with_tolerance(1e-12);
    for i in 1..=40 {
        let now = by_hand(motion.advance_to(0.25 * f64::from(i)).unwrap());
        assert!((now - energy).abs() < 1e-11 * energy, "{i}: {now}");
    }
}
