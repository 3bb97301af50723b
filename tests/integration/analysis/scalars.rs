//! Single precision, eliminated coordinates and Baumgarte's stabilisation.

use lagrangian::prelude::*;

use crate::support::close::close;

/// A pendulum on a rod, in any precision, stabilised instead of projected.
struct Rod<R> {
    length: R,
}

#[lagrangian(coordinates = [x, y], jacobians, baumgarte = 5.0)]
impl<R: Real> Rod<R> {
    #[point(mass = 2.0)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        20.0 * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        self.bob(q).norm() - self.length
    }
}

#[test]
fn single_precision_is_precise_to_its_digits() {
    let rod = Rod { length: 0.4_f32 };
    let rest = rod.equilibrium([0.2, -0.3], &[]).unwrap();
    assert!(rest.is_isolated && rest.are_unique);
    close(f64::from(rest.state.q[0]), 0.0, 1e-3);
    close(f64::from(rest.state.q[1]), -0.4, 1e-6);
    close(f64::from(rest.multipliers[0]), -20.0, 1e-6);
    close(rod.modes(&rest.state, &[]).unwrap()[0].frequency(), 5.0, 1e-6);
    let rod = Rod { length: 0.4_f64 };
    let rest = rod.equilibrium([0.2, -0.3], &[]).unwrap();
    close(rod.modes(&rest.state, &[]).unwrap()[0].frequency(), 5.0, 1e-14);
}

/// A pendulum on a trolley that is held in place by a constraint which eliminates it.
struct Held;

#[lagrangian(coordinates = [x, theta], jacobians)]
impl Held {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x + 0.4 * q.theta.sin(), -0.4 * q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        10.0 * self.bob(q).y
    }

    #[holonomic(eliminate)]
    fn brake(&self, q: &Coordinates) -> f64 {
        q.x - 1.0
    }
}

#[test]
fn an_eliminated_coordinate_takes_no_part() {
    let rest = Held.equilibrium([0.5], &[]).unwrap();
    close(rest.state.q[0], 0.0, 1e-15);
    close(Held.modes(&rest.state, &[]).unwrap()[0].frequency(), 5.0, 1e-14);
}
