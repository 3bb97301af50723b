//! Contacts and impacts.

use super::*;
use crate::switching::known::Known;
use crate::switching::scales::Scales;
use crate::switching::scene::Scene;

const G: f64 = 9.81;

#[derive(Clone, Copy, Debug)]
struct Ball {
    e: f64,
}

impl Toy<1, 1, 0> for Ball {
    const ROWS: [Row; 1] = [Row::Unilateral];

    fn mass(&self) -> [f64; 1] {
        [2.0]
    }

    fn forces(&self, _: f64, _: &[f64; 1], _: &[f64; 1], _: &[f64; 0]) -> [f64; 1] {
        [-2.0 * G]
    }

    fn gradients(&self) -> [[f64; 1]; 1] {
        [[1.0]]
    }

    fn restitution(&self) -> [f64; 1] {
        [self.e]
    }
}

#[test]
fn a_ball_bounces_until_it_rests() {
    let ball = Model(Ball { e: 0.8 });
    let mut motion = ball.start([1.0], [0.0]);
    let state = *motion.advance_to(3.0).unwrap();
    assert!((state.q[0] - 0.06870746096576572).abs() < 1e-12, "{state:?}");
    assert!((state.v[0] + 0.01535413338474476).abs() < 1e-11, "{state:?}");
    // It bounces until 4.063712768871578.
    let state = *motion.advance_to(4.063712768870).unwrap();
    assert!(state.v[0] != 0.0, "{state:?}");
    let state = *motion.advance_to(4.063712768873).unwrap();
    assert_eq!((state.q[0], state.v[0]), (0.0, 0.0));
    let steps = motion.steps().accepted;
    let state = *motion.advance_to(10.0).unwrap();
    assert_eq!((state.q[0], state.v[0]), (0.0, 0.0));
    assert!(motion.steps().accepted < steps + 30);
}

#[test]
fn impact_times_are_exact() {
    let ball = Model(Ball { e: 0.8 });
    for (time, sign) in [
        0.4515236409857309,
        1.1739614665629004,
        1.751911727024636,
        2.214271935394024,
        2.584160102089535,
        2.880070635445944,
        3.1167990621310706,
        3.306181803479172,
    ]
    .into_iter()
    .zip(1..)
    {
        let mut motion = ball.start([1.0], [0.0]);
        let before = motion.advance_to(time - 1e-12).unwrap().v[0];
        let after = motion.advance_to(time + 1e-12).unwrap().v[0];
        assert!(
            before < 0.0 && after > 0.0 && (after + 0.8 * before).abs() < 1e-9,
            "{sign}: {before} {after}"
        );
    }
}

#[test]
fn bad_starts_are_refused() {
    let ball = Model(Ball { e: 0.8 });
    let error = ball.start([-1e-3], [0.0]).advance_to(1.0).unwrap_err();
    assert!(matches!(error.cause, Cause::Penetrates { constraint: 0, .. }), "{error:?}");
    for e in [-0.1, 1.1, f64::NAN] {
        let error = *Model(Ball { e }).start([1.0], [0.0]).advance_to(1.0).as_ref().unwrap_err();
        assert!(matches!(error.cause, Cause::InvalidContact { constraint: 0, .. }), "{error:?}");
    }
    let error = ball.start([1.0], [0.0]).advance_to(-1.0).unwrap_err();
    assert!(matches!(error.cause, Cause::Irreversible), "{error:?}");
    // On the floor and downward: an impact at once.
    let mut motion = ball.start([0.0], [-1.0]);
    assert!((motion.advance_to(0.01).unwrap().v[0] - (0.8 - 0.01 * G)).abs() < 1e-14);
}

#[derive(Clone, Copy, Debug)]
struct Row3 {
    e: f64,
}

impl Toy<3, 2, 0> for Row3 {
    const ROWS: [Row; 2] = [Row::Unilateral; 2];

    fn mass(&self) -> [f64; 3] {
        [1.0; 3]
    }

    fn forces(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 0]) -> [f64; 3] {
        [0.0; 3]
    }

    fn gradients(&self) -> [[f64; 3]; 2] {
        [[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]]
    }

    fn offsets(&self) -> [f64; 2] {
        [-1.0; 2]
    }

    fn restitution(&self) -> [f64; 2] {
        [self.e; 2]
    }
}

#[test]
fn three_balls_obey_newtons_law() {
    for (e, gap, want) in [
        (1.0, 0.0, [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]),
        (0.5, 0.0, [0.0, 0.5, 0.5]),
        (1.0, 0.01, [0.0, 0.0, 1.0]),
    ] {
        let balls = Model(Row3 { e });
        let mut motion = balls.start([0.0, 1.5, 2.5 + gap], [1.0, 0.0, 0.0]);
        let v = motion.advance_to(2.0).unwrap().v;
        assert!(v.iter().zip(want).all(|(v, want)| (v - want).abs() < 1e-13), "{v:?} {want:?}");
    }
}

#[derive(Clone, Copy, Debug)]
struct Disc {
    mu: f64,
}

impl Toy<3, 2, 0> for Disc {
    const ROWS: [Row; 2] = [Row::Unilateral, Row::Friction { normal: Some(0), pair: None }];

    fn mass(&self) -> [f64; 3] {
        [0.4, 0.4, 0.5 * 0.4 * 0.01]
    }

    fn forces(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 0]) -> [f64; 3] {
        [0.0, -0.4 * G, 0.0]
    }

    fn gradients(&self) -> [[f64; 3]; 2] {
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.1]]
    }

    fn offsets(&self) -> [f64; 2] {
        [-0.1, 0.0]
    }

    fn restitution(&self) -> [f64; 2] {
        [0.7, 0.0]
    }

    fn kinetic(&self) -> [f64; 2] {
        [0.0, self.mu]
    }
}

#[test]
fn a_disc_bounces_obliquely() {
    for (mu, [x, y, spin]) in [
        (0.1, [2.2469940239280968, 3.100612842649014, -20.060119521438068]),
        (0.6, [2.1666666666666665, 3.100612842649014, -21.666666666666668]),
    ] {
        let disc = Model(Disc { mu });
        let mut motion = disc.start([0.0, 1.1, 0.0], [3.0, 0.0, -5.0]);
        let state = *motion.advance_to(0.4515236409857309 + 1e-3).unwrap();
        let v = [state.v[0], state.v[1] + 1e-3 * G, state.v[2]];
        assert!([x, y, spin].iter().zip(v).all(|(want, v)| (v - want).abs() < 1e-11), "{v:?}");
        // It comes to roll, and rolls on.
        let state = *motion.advance_to(20.0).unwrap();
        assert!((state.v[0] + 0.1 * state.v[2]).abs() < 1e-13 && state.q[1] == 0.1, "{state:?}");
    }
}

/// Two rough contacts of three coordinates, with any directions and coefficients.
#[derive(Clone, Copy, Debug)]
struct Any {
    mass: [f64; 3],
    gradients: [[f64; 3]; 4],
    coefficients: [f64; 4],
}

impl Toy<3, 4, 0> for Any {
    const ROWS: [Row; 4] = [
        Row::Unilateral,
        Row::Unilateral,
        Row::Friction { normal: Some(0), pair: None },
        Row::Friction { normal: Some(1), pair: None },
    ];

    fn mass(&self) -> [f64; 3] {
        self.mass
    }

    fn forces(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 0]) -> [f64; 3] {
        [0.0; 3]
    }

    fn gradients(&self) -> [[f64; 3]; 4] {
        self.gradients
    }

    fn restitution(&self) -> [f64; 4] {
        self.coefficients
    }

    fn kinetic(&self) -> [f64; 4] {
        self.coefficients
    }
}

#[test]
fn no_impact_makes_energy_or_penetrates() {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut unsolved, mut energies) = (0, 0);
    for _ in 0..2000 {
        let any = Model(Any {
            mass: core::array::from_fn(|_| 0.1 + random()),
            gradients: core::array::from_fn(|_| core::array::from_fn(|_| 2.0 * random() - 1.0)),
            coefficients: core::array::from_fn(|_| random()),
        });
        let state = State::new([0.0; 3], core::array::from_fn(|_| 2.0 * random() - 1.0));
        let known = Known::new([true; 4]);
        let scene = Scene::new(&any, &state, &[], [], &Scales::new(), &known);
        if !scene.has_impact() {
            continue;
        }
        let Ok((v, _)) = scene.impact() else {
            unsolved += 1;
            continue;
        };
        let energy = |v: &[f64; 3]| any.energy_at(&(), 0.0, &[0.0; 3], v);
        assert!(energy(&v) <= energy(&state.v) * (1.0 + 1e-12), "{any:?} {state:?} {v:?}");
        let rates = any.residuals(&[0.0; 3], &v).rates;
        assert!(rates[0] > -1e-12 && rates[1] > -1e-12, "{any:?} {state:?} {v:?} {rates:?}");
        energies += 1;
    }
    assert!(energies > 1000 && unsolved == 0, "{energies} {unsolved}");
}
