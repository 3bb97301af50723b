//! P02: the car axis of the Test Set for IVP Solvers: two stiff springs, a rod, and a bumpy road.

use lagrangian::prelude::*;

use crate::cases::MEDIUM;
use crate::support::close::{close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, state_at};
use crate::support::reference::published;

struct CarAxis {
    /// The mass of each wheel.
    mass: f64,
    length: f64,
    spring: f64,
}

#[lagrangian(coordinates = [xl, yl, xr, yr])]
impl CarAxis {
    /// The right wheel follows the road.
    fn road(&self, t: f64) -> Vector2<f64> {
        let y = 0.1 * (10.0 * t).sin();
        Vector2::new((self.length.powi(2) - y * y).sqrt(), y)
    }

    #[point(mass = self.mass)]
    fn left(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.xl, q.yl)
    }

    #[point(mass = self.mass)]
    fn right(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.xr, q.yr)
    }

    #[potential]
    fn springs(&self, q: &Coordinates, t: f64) -> f64 {
        let (left, right) = (self.left(q).norm(), (self.right(q) - self.road(t)).norm());
        ((left - self.spring).powi(2) + (right - self.spring).powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * (q.yl + q.yr)
    }

    /// The left spring stays at a right angle to the road.
    #[holonomic]
    fn upright(&self, q: &Coordinates, t: f64) -> f64 {
        self.road(t).dot(&self.left(q))
    }

    #[holonomic]
    fn axis(&self, q: &Coordinates) -> f64 {
        (self.left(q) - self.right(q)).norm_squared() - self.length.powi(2)
    }
}

/// μ = M ε²/2 with M = 10, ε = 1/100.
const AXIS: CarAxis = CarAxis { mass: 5e-4, length: 1.0, spring: 0.5 };

fn start() -> State<f64, 4> {
    State::new([0.0, 0.5, 1.0, 0.5], [-0.5, 0.0, -0.5, 0.0])
}

#[test]
fn the_states_agree() {
    both_follow(&AXIS, start(), published("car_axis").timed_rows::<8>("states"), MEDIUM);
}

#[test]
fn the_reactions_agree() {
    let [upright, axis] = published("car_axis").numbers("lam_3");
    let mut motion = AXIS.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(3.0).unwrap();
    close(motion.reactions().upright, upright, MEDIUM);
    close(motion.reactions().axis, axis, MEDIUM);
    let (residuals, rates) =
        (AXIS.constraint_residuals(motion.state()), AXIS.constraint_rates(motion.state()));
    for residual in residuals.into_iter().chain(rates) {
        close_on(1.0, residual, 0.0, 1e-14);
    }
}

#[test]
fn the_identities_hold() {
    bound!(AXIS, [true; 2]).holds([0.0, 0.4, 1.3].map(|t| state_at(&AXIS, start(), t)));
}
