//! Potentials flatter than a parabola, whose curvature where a search ends is what is left of its way.

use lagrangian::{EquilibriumError, Stability, prelude::*};

use crate::support::sample::Samples;

/// V = (x − place)^power + stiffness y²/2.
struct Flat<const POWER: i32> {
    place: f64,
    stiffness: f64,
}

macro_rules! flat {
    ($power:literal) => {
        #[lagrangian(coordinates = [x, y], jacobians)]
        impl Flat<$power> {
            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                0.5 * (v.x.powi(2) + v.y.powi(2))
            }

            #[potential]
            fn potential(&self, q: &Coordinates) -> f64 {
                (q.x - self.place).powi($power) + 0.5 * self.stiffness * (q.y - q.x).powi(2)
            }
        }
    };
}

flat!(3);
flat!(4);

const NEUTRAL: Stability = Stability::Neutral { directions: 1 };

#[test]
fn the_energy_falls_on_beyond_a_point_of_inflection() {
    for place in [0.0, 1.0, 0.3, -7.0] {
        let flat = Flat::<3> { place, stiffness: 2.0 };
        for guess in [place + 0.1, place + 1.0, place + 5.0, place - 0.1] {
            let found = flat.equilibrium([guess, 0.0], &[]);
            assert!(matches!(found, Err(EquilibriumError::RanAway { .. })), "{place} {guess}: {found:?}");
            let balance = flat.stationary_point([guess, 0.0], &[]).unwrap();
            assert_eq!((balance.stability, balance.is_isolated), (NEUTRAL, false), "{place} {guess}");
            assert!((balance.state.q[0] - place).abs() < 1e-7 * (1.0 + place.abs()));
        }
        // The guess itself is balanced.
        let rest = flat.equilibrium([place, place], &[]).unwrap();
        assert_eq!((rest.stability, rest.is_isolated), (NEUTRAL, false));
    }
}

#[test]
fn a_minimum_flatter_than_a_parabola_is_neutral() {
    for place in [0.0, 1.0, 0.3, -7.0] {
        let flat = Flat::<4> { place, stiffness: 2.0 };
        for guess in [place + 0.1, place + 1.0, place - 5.0, place] {
            for found in [flat.equilibrium([guess, place], &[]), flat.stationary_point([guess, place], &[])] {
                let rest = found.unwrap();
                assert_eq!((rest.stability, rest.is_isolated), (NEUTRAL, false), "{place} {guess}");
                assert!((rest.state.q[0] - place).abs() < 1e-5 * (1.0 + place.abs()));
            }
        }
    }
}

/// A pendulum beside a cart that stands anywhere, and a weak spring beside a stiff one.
struct Beside;

#[lagrangian(coordinates = [phi, cart, soft, stiff], jacobians)]
impl Beside {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.phi.powi(2) + v.cart.powi(2) + v.soft.powi(2) + v.stiff.powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        -9.81 * q.phi.cos() + 0.5e-4 * (q.soft - 3.0).powi(2) + 0.5e4 * (q.stiff - q.soft).powi(2)
    }
}

#[test]
fn curvatures_of_their_own_keep_their_verdict() {
    for cart in [0.0, 1.0, 1e9, 1e17] {
        for phi in [0.1, 1.5, 1000.0] {
            let rest = Beside.equilibrium([phi, cart, 1.0, -2.0], &[]).unwrap();
            assert_eq!(rest.stability, NEUTRAL, "{cart} {phi}");
            assert_eq!(rest.state.q[1], cart);
        }
        let top = Beside.stationary_point([3.0, cart, 1.0, -2.0], &[]).unwrap();
        assert_eq!(top.stability, Stability::Unstable { directions: 1 }, "{cart}");
    }
}

/// A mass on a spring over a wavy ground, whose stiffness vanishes at points where forces do not.
struct Wavy {
    stiffness: f64,
    waves: f64,
    number: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Wavy {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x * q.x + self.waves * (self.number * q.x).sin()
    }
}

/// A mass in a plane with forces that have no potential.
struct Circulating {
    a: f64,
    b: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Circulating {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[force]
    fn push(&self, q: &Coordinates) -> [f64; 2] {
        [
            self.a * (2.0 * q.y).cos() + 2.0 * self.b * q.y - 2.0 * q.x,
            self.b * (3.0 * q.x).sin() - self.a * q.x - 2.0 * q.y,
        ]
    }
}

#[test]
fn no_search_ends_where_forces_are_least_but_not_zero() {
    let mut samples = Samples::new(71);
    let (mut found, mut refused) = (0, 0);
    for _ in 0..200 {
        let number = samples.number(1.0, 5.0);
        let wavy = Wavy { stiffness: samples.number(0.1, 1.0), waves: samples.number(0.5, 2.0), number };
        let circulating = Circulating { a: samples.number(-3.0, 3.0), b: samples.number(-3.0, 3.0) };
        let [x, y] = [(); 2].map(|()| samples.number(-3.0, 3.0));
        let left = [
            wavy.stationary_point([2.0 * x], &[])
                .map(|rest| wavy.accelerations(&rest.state).unwrap()[0].abs()),
            circulating.stationary_point([x, y], &[]).map(|rest| size(&circulating, &rest.state)),
            circulating.equilibrium([x, y], &[]).map(|rest| size(&circulating, &rest.state)),
        ];
        for left in left {
            match left {
                Ok(left) => {
                    assert!(left < 1e-7, "{left}");
                    found += 1;
                }
                Err(EquilibriumError::Unbalanced { .. } | EquilibriumError::RanAway { .. }) => refused += 1,
                Err(error) => panic!("{error}"),
            }
        }
    }
    assert!(found > 300 && refused > 50, "{found} {refused}");
}

fn size(system: &Circulating, state: &State<f64, 2>) -> f64 {
    let a = system.accelerations(state).unwrap();
    a[0].hypot(a[1])
}
