//! Dry friction.

use super::*;

/// A mass on a spring and a dry support, which moves as a belt does at the speed `belt`.
#[derive(Clone, Copy, Debug)]
struct Slider {
    m: f64,
    k: f64,
    fixed: f64,
    kinetic: f64,
    belt: f64,
}

impl Toy<1, 1, 0> for Slider {
    const ROWS: [Row; 1] = [Row::Friction { normal: None, pair: None }];

    fn mass(&self) -> [f64; 1] {
        [self.m]
    }

    fn forces(&self, _: f64, q: &[f64; 1], _: &[f64; 1], _: &[f64; 0]) -> [f64; 1] {
        [-self.k * q[0]]
    }

    fn gradients(&self) -> [[f64; 1]; 1] {
        [[1.0]]
    }

    fn drift(&self) -> [f64; 1] {
        [-self.belt]
    }

    fn kinetic(&self) -> [f64; 1] {
        [self.kinetic]
    }

    fn fixed(&self) -> [f64; 1] {
        [self.fixed]
    }
}

#[test]
fn an_oscillator_comes_to_rest() {
    let force = 0.25 * 2.0 * 9.81;
    let slider = Model(Slider { m: 2.0, k: 50.0, fixed: force, kinetic: force, belt: 0.0 });
    let mut motion = slider.start([0.7], [0.0]);
    let state = *motion.advance_to(0.4).unwrap();
    assert!((state.q[0] + 0.152378780917725).abs() < 1e-12, "{state:?}");
    let half = core::f64::consts::PI / 5.0;
    for (n, turning) in [0.7, -0.5038, 0.3076, -0.1114, -0.0848].into_iter().enumerate().skip(1) {
        let state = *motion.advance_to(half * n as f64).unwrap();
        assert!((state.q[0] - turning).abs() < 1e-12 && state.v[0].abs() < 1e-11, "{n}: {state:?}");
    }
    let state = *motion.advance_to(2.6).unwrap();
    assert_eq!(state.v[0], 0.0);
    let steps = motion.steps().accepted;
    assert_eq!(motion.advance_to(1e3).unwrap().q, state.q);
    assert!(motion.steps().accepted < steps + 30);
    let (forces, unique) = crate::switching::multipliers(&slider, 1e3, &state.q, &state.v, &[]);
    assert!((forces[0] + 4.24).abs() < 1e-11 && unique, "{forces:?}");
}

#[test]
fn a_mass_on_a_belt_sticks_and_slips() {
    let slider = Model(Slider { m: 1.0, k: 9.0, fixed: 4.0, kinetic: 2.4, belt: 0.2 });
    let mut motion = slider.start([0.0], [0.2]);
    let state = *motion.advance_to(3.0).unwrap();
    assert!((state.q[0] - 0.19207094504924363).abs() < 1e-12, "{state:?}");
    let (first, period) = (2.2222222222222223, 3.0641557758214235);
    let state = *motion.advance_to(first + 100.0 * period).unwrap();
    assert!((state.q[0] - 4.0 / 9.0).abs() < 1e-10 && (state.v[0] - 0.2).abs() < 1e-9, "{state:?}");
}

/// A particle on an incline that is rough in both directions. Its coordinates are across, downhill and above.
#[derive(Clone, Copy, Debug)]
struct Incline {
    slope: f64,
    mu: f64,
    g: f64,
}

impl Toy<3, 3, 0> for Incline {
    const ROWS: [Row; 3] = [
        Row::Unilateral,
        Row::Friction { normal: Some(0), pair: Some(2) },
        Row::Friction { normal: Some(0), pair: Some(1) },
    ];

    fn mass(&self) -> [f64; 3] {
        [1.3; 3]
    }

    fn forces(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 0]) -> [f64; 3] {
        [0.0, 1.3 * self.g * self.slope.sin(), -1.3 * self.g * self.slope.cos()]
    }

    fn gradients(&self) -> [[f64; 3]; 3] {
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    }

    fn kinetic(&self) -> [f64; 3] {
        [0.0, self.mu, self.mu]
    }
}

#[test]
fn a_particle_pushed_across_a_slope_stops() {
    let incline = Model(Incline { slope: 0.3, mu: 0.45, g: 9.81 });
    let mut motion = incline.start([0.0; 3], [2.0, 0.0, 0.0]);
    let state = *motion.advance_to(0.899).unwrap();
    assert!(state.v[1] > 0.0);
    let state = *motion.advance_to(0.8990851212853052 + 1e-11).unwrap();
    assert_eq!(state.v, [0.0; 3]);
    let state = *motion.advance_to(100.0).unwrap();
    assert!((state.q[0] - 0.5377615388130569).abs() < 1e-11, "{state:?}");
    assert!((state.q[1] - 0.30902179944245506).abs() < 1e-11, "{state:?}");
}

#[test]
fn a_particle_on_a_steep_slope_starts_to_slip() {
    let incline = Model(Incline { slope: 0.5, mu: 0.45, g: 9.81 });
    let mut motion = incline.start([0.0; 3], [0.0; 3]);
    let state = *motion.advance_to(2.0).unwrap();
    let a = 9.81 * (0.5_f64.sin() - 0.45 * 0.5_f64.cos());
    assert!((state.q[1] - 2.0 * a).abs() < 1e-11 && state.q[0].abs() < 1e-13, "{state:?} {a}");
    // And dropped onto it, with an impact in which it slips and after which it slips on downhill.
    let mut motion = incline.start([0.0, 0.0, 0.1], [0.2, 0.0, 0.0]);
    let state = *motion.advance_to(3.0).unwrap();
    assert!(state.q[2] == 0.0 && state.v[1] > 0.0, "{state:?}");
}

/// A plate that spins about a vertical axis and stands on a foot beside it.
#[derive(Clone, Copy, Debug)]
struct Plate {
    mu: f64,
}

impl Toy<4, 3, 0> for Plate {
    const ROWS: [Row; 3] = [
        Row::Unilateral,
        Row::Friction { normal: Some(0), pair: Some(2) },
        Row::Friction { normal: Some(0), pair: Some(1) },
    ];

    fn mass(&self) -> [f64; 4] {
        [1.0, 1.0, 1.0, 0.1]
    }

    fn forces(&self, _: f64, _: &[f64; 4], _: &[f64; 4], _: &[f64; 0]) -> [f64; 4] {
        [0.0, 0.0, -9.81, 0.0]
    }

    fn gradients(&self) -> [[f64; 4]; 3] {
        [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, -0.2], [0.0, 1.0, 0.0, 0.1]]
    }

    fn kinetic(&self) -> [f64; 3] {
        [0.0, self.mu, self.mu]
    }
}

#[test]
fn a_plate_falls_on_its_foot_slips_and_sticks() {
    let plate = Model(Plate { mu: 0.3 });
    let start = [1.0, 0.5, 0.0, 4.0];
    let mut motion = plate.start([0.0, 0.0, 0.2, 0.0], start);
    let fall = (2.0_f64 * 0.2 / 9.81).sqrt();
    let after = *motion.advance_to(fall + 1e-12).unwrap();
    // The impulse of friction is as large as the coefficient times that of the floor, and is against the slip
    // after the impact.
    let (x, y) = (after.v[0] - start[0], after.v[1] - start[1]);
    assert!((x.hypot(y) - 0.3 * 9.81 * fall).abs() < 1e-10, "{after:?}");
    let slip = [after.v[0] - 0.2 * after.v[3], after.v[1] + 0.1 * after.v[3]];
    assert!((x * slip[1] - y * slip[0]).abs() < 1e-10 && x * slip[0] + y * slip[1] < 0.0, "{after:?}");
    assert!((0.1 * (after.v[3] - start[3]) - (0.1 * y - 0.2 * x)).abs() < 1e-12, "{after:?}");
    let end = *motion.advance_to(10.0).unwrap();
    assert!(
        (end.v[0] - 0.2 * end.v[3]).abs() < 1e-14 && (end.v[1] + 0.1 * end.v[3]).abs() < 1e-14,
        "{end:?}"
    );
}
