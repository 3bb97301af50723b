//! S01, A01, S09, S17: constrained problems in coordinates that satisfy their constraints, with the
//! reactions from the generated accelerations.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close};
use crate::support::difference::{STEP, rate};
use crate::support::motion::{follows, root, state_at};
use crate::support::reference::seed;

/// S01 and A01; the angle is measured from straight down.
struct Pendulum {
    m: f64,
    l: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.m)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * self.l
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * self.bob(q).y
    }
}

impl Pendulum {
    fn tension(&self, state: &State<f64, 1>) -> f64 {
        self.m * (G * state.q[0].cos() + self.l * state.v[0].powi(2))
    }

    fn period(&self, start: State<f64, 1>, guess: f64) -> f64 {
        root(self, start, guess, |s| (s.v[0], self.accelerations(s).unwrap()[0]))
    }
}

#[test]
fn a_pendulum_swings_as_elliptic_functions_say() {
    let pendulum = Pendulum { m: 1.3, l: 0.7 };
    let start = State::at_rest([1.0]);
    let reference = seed("S01");
    follows(&pendulum, start, [(1.0, [reference.number("theta(1)"), reference.number("theta_d(1)")])], EASY);
    let period = reference.number("period");
    close(pendulum.period(start, 1.01 * period), period, EASY);
    let state = state_at(&pendulum, start, 1.0);
    close(pendulum.tension(&state), reference.number("tension(1)"), EASY);
    let place = pendulum.bob(&state.q.into());
    all_close([-place.y, place.x], [reference.number("x(1)"), reference.number("y(1)")], EASY);
    let bottom = state_at(&pendulum, start, period / 4.0);
    close(pendulum.tension(&bottom), reference.number("tension_bottom"), EASY);
}

#[test]
fn the_benchmark_pendulum_agrees_for_ten_seconds() {
    let pendulum = Pendulum { m: 1.0, l: 1.0 };
    let start = State::at_rest([-std::f64::consts::FRAC_PI_2]);
    let reference = seed("A01");
    for sample in reference.part("samples").elements() {
        let state = state_at(&pendulum, start, sample.number("t"));
        // The reference counts the angle clockwise.
        close(-state.q[0], sample.number("angle_from_down"), EASY);
        close(-state.v[0], sample.number("rate"), EASY);
        let place = pendulum.bob(&state.q.into());
        all_close([place.x, place.y], [sample.number("x"), sample.number("y")], EASY);
    }
    let period = reference.number("period");
    close(pendulum.period(start, 0.99 * period), period, EASY);
    let bottom = state_at(&pendulum, start, period / 4.0);
    close(pendulum.tension(&bottom), reference.number("max_tension_N"), EASY);
}

/// S09: a bead on a smooth helix z = α R θ.
struct Helix {
    m: f64,
    radius: f64,
    alpha: f64,
}

#[lagrangian(coordinates = [theta])]
impl Helix {
    #[point(mass = self.m)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.theta.cos(), q.theta.sin(), self.alpha * q.theta) * self.radius
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * self.bead(q).z
    }
}

#[test]
fn a_bead_on_a_helix_decelerates_uniformly() {
    let helix = Helix { m: 2.0, radius: 0.8, alpha: 0.3 };
    let start = State::new([0.1], [3.0]);
    let reference = seed("S09");
    follows(&helix, start, [(2.0, [reference.number("theta(2)"), reference.number("theta_d(2)")])], EASY);
    let state = state_at(&helix, start, 2.0);
    let ([theta], [rate], [a]) = (state.q, state.v, helix.accelerations(&state).unwrap());
    let Helix { m, radius, alpha } = helix;
    close(a, -G * alpha / (radius * (1.0 + alpha * alpha)), CLOSED_FORM);
    // The reactions of r = R and η = 0 carry the weight along their directions.
    let weight = m * G;
    let across = m * radius * (alpha * alpha * theta * a - rate * rate) + weight * alpha * theta;
    close(across, reference.number("lambda1(2)"), EASY);
    close(m * alpha * radius * a + weight, reference.number("lambda2(2)"), EASY);
}

/// S17: a particle on an incline that moves up and down.
struct MovingIncline {
    m: f64,
}

#[lagrangian(coordinates = [x])]
impl MovingIncline {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        Vector2::new(q.x, q.x / 2.0 + (3.0 * t).sin() / 10.0)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        self.m * G * self.particle(q, t).y
    }
}

#[test]
fn a_moving_incline_does_work() {
    let incline = MovingIncline { m: 2.0 };
    let state = state_at(&incline, State::at_rest([0.0]), 2.0);
    let reference = seed("S17");
    let place = incline.particle(&state.q.into(), 2.0);
    all_close([place.x, place.y], [reference.number("x(2)"), reference.number("y(2)")], EASY);
    let a = incline.accelerations(&state).unwrap();
    let lift = a[0] / 2.0 - 0.9 * 6.0_f64.sin();
    close(incline.m * (lift + G), reference.number("lambda(2)_m=2"), EASY);
    close(rate(STEP, &state, &a, |s| incline.energy(s)), reference.number("dE/dt(2)"), EASY);
}
