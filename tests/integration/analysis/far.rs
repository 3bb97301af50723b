//! Equilibria far from zero, where the last digits of a coordinate stand for long distances.

use lagrangian::{EquilibriumError, Name, prelude::*};

/// A pendulum, a weight on a spring whose force vanishes at `place`, and a free cart.
struct Apart {
    stiffness: f64,
    place: f64,
}

#[lagrangian(coordinates = [phi, x, free], jacobians)]
impl Apart {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.phi.sin(), -q.phi.cos())
    }

    #[kinetic]
    fn others(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.free.powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (q.x - self.place).powi(2)
    }
}

#[test]
fn an_angle_without_digits_after_the_point_is_no_equilibrium() {
    let unresolved = EquilibriumError::Unresolved { coordinate: 0, name: Name::new(&"phi") };
    // Forces on the other coordinates, however stiff, are no measure for this one.
    for stiffness in [1e-6, 1.0, 1e9] {
        for phi in [1e16, 1e17, -2e17, 3e17, 5e17, 1e20, -1e100, 1e300] {
            let system = Apart { stiffness, place: 0.0 };
            let guess = State::at_rest([phi, 0.0, 0.0]);
            assert_eq!(system.equilibrium(guess, &[]).unwrap_err(), unresolved, "{stiffness} {phi}");
            assert_eq!(system.stationary_point(guess, &[]).unwrap_err(), unresolved, "{stiffness} {phi}");
        }
    }
}

#[test]
fn a_coordinate_that_has_its_digits_may_be_far_from_zero() {
    for phi in [1e3, 1e9, 1e12] {
        let rest = Apart { stiffness: 1.0, place: 0.0 }.equilibrium([phi, 0.1, 3.0], &[]).unwrap();
        let off = rest.state.q[0].sin().abs();
        assert!(off <= f64::EPSILON * phi && (rest.state.q[0] - phi).abs() < 4.0, "{phi}: {off}");
    }
    // A spring is linear over any change.
    for (place, guess) in [(1e17, 1e17 + 64.0), (-1e100, -0.5e100), (1e17, 0.0)] {
        let rest = Apart { stiffness: 1.0, place }.equilibrium([0.0, guess, 0.0], &[]).unwrap();
        assert!((rest.state.q[1] - place).abs() <= f64::EPSILON * place.abs(), "{:?}", rest.state);
    }
    // The cart may stand anywhere.
    let rest = Apart { stiffness: 1.0, place: 0.0 }.equilibrium([0.0, 0.0, 1e17], &[]).unwrap();
    assert_eq!(rest.state.q, [0.0, 0.0, 1e17]);
}
