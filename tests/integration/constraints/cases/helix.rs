//! S09: a particle on a smooth helix in three curvilinear coordinates.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, state_at};
use crate::support::reference::seed;

/// The height is η + α r θ.
#[derive(Clone, Copy)]
struct Helix {
    m: f64,
    radius: f64,
    alpha: f64,
}

#[lagrangian(coordinates = [theta, r, eta])]
impl Helix {
    #[point(mass = self.m)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.r * q.theta.cos(), q.r * q.theta.sin(), q.eta + self.alpha * q.r * q.theta)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * self.bead(q).z
    }

    #[holonomic]
    fn cylinder(&self, q: &Coordinates) -> f64 {
        q.r - self.radius
    }

    #[holonomic]
    fn thread(&self, q: &Coordinates) -> f64 {
        q.eta
    }
}

/// The same with both constraints solved.
struct Solved(Helix);

#[lagrangian(coordinates = [theta, r, eta])]
impl Solved {
    #[point(mass = self.0.m)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.r * q.theta.cos(), q.r * q.theta.sin(), q.eta + self.0.alpha * q.r * q.theta)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.m * G * self.bead(q).z
    }

    #[holonomic(eliminate)]
    fn cylinder(&self, q: &Coordinates) -> f64 {
        q.r - self.0.radius
    }

    #[holonomic(eliminate)]
    fn thread(&self, q: &Coordinates) -> f64 {
        q.eta
    }
}

const HELIX: Helix = Helix { m: 2.0, radius: 0.8, alpha: 0.3 };

fn start() -> State<f64, 3> {
    State::new([0.1, 0.8, 0.0], [3.0, 0.0, 0.0])
}

#[test]
fn the_bead_decelerates_uniformly() {
    let reference = seed("S09");
    let row = [reference.number("theta(2)"), 0.8, 0.0, reference.number("theta_d(2)"), 0.0, 0.0];
    both_follow(&HELIX, start(), [(2.0, row)], EASY);
    both_follow(&Solved(HELIX), State::new([0.1], [3.0]), [(2.0, [row[0], row[3]])], EASY);
    let deceleration = G * 0.3 / (0.8 * 1.09);
    for t in [0.5, 1.0, 3.0, 7.0] {
        let state = state_at(&HELIX, start(), t);
        close(state.q[0], 0.1 + 3.0 * t - deceleration * t * t / 2.0, EASY);
        close(HELIX.accelerations(&state).unwrap()[0], -deceleration, CLOSED_FORM);
    }
}

#[test]
fn the_reactions_agree() {
    let reference = seed("S09");
    let mut motion = HELIX.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(2.0).unwrap();
    close(motion.reactions().cylinder, reference.number("lambda1(2)"), EASY);
    close(motion.reactions().thread, reference.number("lambda2(2)"), EASY);
    let Helix { m, radius, alpha } = HELIX;
    for state in motion.every(0.1).take(10) {
        let state = state.unwrap();
        let ([theta, ..], [rate, ..]) = (state.q, state.v);
        let [a, ..] = HELIX.accelerations(&state).unwrap();
        let across =
            m * alpha * alpha * radius * theta * a - m * radius * rate * rate + m * G * alpha * theta;
        let reactions = HELIX.reactions(&state).unwrap();
        close(reactions.cylinder, across, CLOSED_FORM);
        close(reactions.thread, m * alpha * radius * a + m * G, CLOSED_FORM);
    }
}

#[test]
fn the_identities_hold() {
    bound!(HELIX, [true; 2]).holds([0.0, 0.4].map(|t| state_at(&HELIX, start(), t)));
    all_close(HELIX.constraint_residuals(&start()), [0.0, 0.0], CLOSED_FORM);
}
