//! Potentials flatter than a parabola, whose curvature where a search ends is what is left of its way.

use lagrangian::{EquilibriumError, Stability, prelude::*};

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
