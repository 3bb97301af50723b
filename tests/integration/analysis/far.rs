//! Equilibria far from zero, where the last digits of a coordinate stand for long distances.

use lagrangian::{EquilibriumError, Name, Stability, prelude::*};

use crate::support::sample::Samples;

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

/// Two atoms on a spring, free in the plane.
struct Molecule;

#[lagrangian(coordinates = [a: [2], b: [2]], jacobians)]
impl Molecule {
    #[point(mass = 1.0)]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a[0], q.a[1])
    }

    #[point(mass = 1.0)]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.b[0], q.b[1])
    }

    #[potential]
    fn bond(&self, q: &Coordinates) -> f64 {
        0.5 * ((self.first(q) - self.second(q)).norm() - 1.0).powi(2)
    }
}

#[test]
fn a_free_molecule_is_neutral_wherever_it_is() {
    let mut samples = Samples::new(17);
    for far in [1.0, 100.0, 1e3, 1e4, 1e5] {
        for _ in 0..60 {
            let [x, y] = [0; 2].map(|_| far * samples.number(0.5, 1.5));
            let [along, across] = [0; 2].map(|_| samples.number(-0.05, 0.05));
            let rest = Molecule.equilibrium([x, y, x + 1.0 + along, y + across], &[]).unwrap();
            // It may move in two directions and turn. What is left of the spring's force does not turn it.
            assert_eq!(rest.stability, Stability::Neutral { directions: 3 }, "{:?}", rest.state);
            let eigenvalues =
                Molecule.modes(&rest.state, &[]).unwrap().into_iter().map(|mode| mode.eigenvalue);
            let free = eigenvalues.clone().filter(|value| value.re == 0.0 && value.im == 0.0).count();
            assert_eq!(free, 3, "{:?}", eigenvalues.collect::<Vec<_>>());
        }
    }
}

/// A plate on a spring at each of three corners, of which one pushes or pulls.
struct Plate {
    at: [f64; 2],
    third: f64,
}

#[lagrangian(coordinates = [x, y, phi], jacobians)]
impl Plate {
    #[body(mass = 2.0, inertia = 0.2)]
    fn plate(&self, q: &Coordinates) -> (Vector2<f64>, Rotation2<f64>) {
        (Vector2::new(q.x, q.y), Rotation2::new(q.phi))
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let corner = |x: f64, y: f64| {
            Vector2::new(q.x - self.at[0], q.y - self.at[1]) + Rotation2::new(q.phi) * Vector2::new(x, y)
        };
        let spring = |place: Vector2<f64>, x: f64, y: f64| (place - Vector2::new(x, y)).norm_squared();
        20.0 * (spring(corner(1.0, 0.0), 1.0, 0.0) + spring(corner(-0.5, 0.8), -0.5, 0.8))
            + self.third * spring(corner(-0.5, -0.8), -0.5, -0.8)
    }
}

#[test]
fn what_drives_or_holds_a_body_does_so_far_away() {
    for far in [0.0, 1e3, 1e6] {
        // With Σ k = −20 both displacements are driven. The turn is held: Σ k a² − |Σ k a|² / Σ k > 0.
        for (third, expected) in [(20.0, Stability::Stable), (-60.0, Stability::Unstable { directions: 2 })] {
            let at = [far, -0.7 * far];
            let found = Plate { at, third }.stationary_point([at[0], at[1], 0.0], &[]).unwrap().stability;
            assert_eq!(found, expected, "{far}");
        }
    }
}
