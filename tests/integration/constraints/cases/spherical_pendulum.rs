//! C05: a spherical pendulum in Cartesian coordinates.

use lagrangian::prelude::*;

use crate::cases::EASY;
use crate::support::close::{between, close};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, drift, state_at};
use crate::support::reference::classical;

struct Pendulum;

#[lagrangian(coordinates = [q: [3]])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, at: &Coordinates) -> Vector3<f64> {
        Vector3::from(at.q)
    }

    #[potential]
    fn gravity(&self, at: &Coordinates) -> f64 {
        at.q[2]
    }

    #[holonomic]
    fn sphere(&self, at: &Coordinates) -> f64 {
        (self.bob(at).norm_squared() - 1.0) / 2.0
    }
}

fn start() -> State<f64, 3> {
    let [a, b, c, d, e, f] = classical("C05_spherical_pendulum").numbers("start");
    State::new([a, b, c], [d, e, f])
}

#[test]
fn the_states_agree() {
    let reference = classical("C05_spherical_pendulum");
    let rows = [10, 100].map(|t| (f64::from(t), reference.numbers::<6>(&format!("state({t})"))));
    both_follow(&Pendulum, start(), rows, EASY);
}

#[test]
fn the_reaction_agrees() {
    let expected = classical("C05_spherical_pendulum").number("multiplier(10)");
    let mut motion = Pendulum.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(10.0).unwrap();
    close(motion.reactions().sphere, expected, EASY);
    // λ = z − |v|² for unit mass, weight and length.
    let state = motion.state();
    let speed: f64 = state.v.iter().map(|v| v * v).sum();
    close(motion.reactions().sphere, state.q[2] - speed, 1e-12);
}

#[test]
fn energy_and_angular_momentum_stay() {
    let about_z = |s: &State<f64, 3>| s.q[0] * s.v[1] - s.q[1] * s.v[0];
    let mut motion = Pendulum.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.5, 200, |s| Pendulum.energy(s)), 1e-13);
    let mut motion = Pendulum.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.5, 200, about_z), 1e-13);
}

#[test]
fn the_identities_hold() {
    bound!(Pendulum, [true]).holds([0.0, 0.7].map(|t| state_at(&Pendulum, start(), t)));
}
