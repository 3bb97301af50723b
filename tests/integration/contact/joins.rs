//! Smooth joins of constraints: where the gradients agree, a motion goes on as if nothing were there.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// A bead on a straight rail that goes over into an arc or a parabola. The straight rail has a slope.
struct Rail {
    join: f64,
    slope: f64,
    curvature: f64,
    /// One for an arc, zero for a parabola.
    round: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Rail {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn rail(&self, q: &Coordinates) -> f64 {
        let beyond = q.x - self.join;
        let rise = if beyond > 0.0 {
            if self.round > 0.5 {
                (1.0 - (1.0 - (self.curvature * beyond).powi(2)).sqrt()) / self.curvature
            } else {
                0.5 * self.curvature * beyond * beyond
            }
        } else {
            0.0
        };
        q.y - self.slope * q.x - rise
    }
}

#[test]
fn a_bead_goes_over_from_rail_to_rail() {
    let mut samples = Samples::new(97);
    for trial in 0..200 {
        let (is_level, round) = (trial % 2 == 0, f64::from(trial / 2 % 2));
        let join = samples.number(-2.0, 2.0);
        let slope = if is_level { 0.0 } else { samples.number(-0.5, 0.5) };
        let rail = Rail { join, slope, curvature: samples.number(0.1, 1.0), round };
        // From next to the join or from far away.
        let way = 10.0_f64.powf(samples.number(-9.0, 0.5));
        // Along the slope α the acceleration is −g sin α, with the part cos α of it in x.
        let a = -9.81 * slope / (1.0 + slope * slope);
        let root = samples.number(1.0, 3.0);
        let speed = (root * root + 2.0 * a.abs() * way).sqrt();
        let start = State::new([join - way, slope * (join - way)], [speed, slope * speed]);
        let mut motion = rail.simulate(start).with_tolerance(TIGHT);
        let energy = motion.energy();
        let joined = motion.advance_to_switch(9.0).unwrap().expect("it comes to the join");
        let root = (speed * speed + 2.0 * a * way).sqrt();
        close_on(1.0, joined.state.t, 2.0 * way / (speed + root), 1e-13);
        motion.advance_to(motion.t() + 0.3).unwrap();
        close(motion.energy(), energy, 1e-12);
        assert!(motion.state().q[0] > join);
    }
}

/// A flywheel whose cam lifts a follower against a spring, and lets it rest for half of each turn.
struct Cam {
    inertia: f64,
    lift: f64,
    stiffness: f64,
}

#[lagrangian(coordinates = [angle, height])]
impl Cam {
    #[kinetic]
    fn wheel(&self, _q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * self.inertia * v.angle * v.angle
    }

    #[point(mass = 0.3)]
    fn follower(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(0.0, q.height)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.height * q.height
    }

    #[holonomic]
    fn profile(&self, q: &Coordinates) -> f64 {
        let s = q.angle.sin();
        q.height - self.lift * if s > 0.0 { s * s } else { 0.0 }
    }
}

#[test]
fn a_cam_lifts_and_lets_rest() {
    let mut samples = Samples::new(101);
    for _ in 0..40 {
        let inertia = samples.number(0.5, 2.0);
        let cam = Cam { inertia, lift: samples.number(0.05, 0.5), stiffness: samples.number(0.0, 4.0) };
        let speed = samples.number(2.0, 9.0);
        let mut motion = cam.simulate(State::new([-1.0, 0.0], [speed, 0.0])).with_tolerance(TIGHT);
        let joined = motion.advance_to_switch(99.0).unwrap().expect("the cam reaches the follower");
        close(joined.state.t, 1.0 / speed, 1e-13);
        let rests = motion.advance_to_switch(99.0).unwrap().expect("the cam lets it rest");
        close(rests.state.q[0], std::f64::consts::PI, 1e-13);
        // All energy is back in the wheel.
        close(rests.state.v[0], speed, 1e-12);
        let next = motion.advance_to_switch(99.0).unwrap().expect("one turn is over");
        close(next.state.t - rests.state.t, std::f64::consts::PI / speed, 1e-11);
        motion.advance_to(next.state.t + 20.0).unwrap();
        close(motion.energy(), 0.5 * inertia * speed * speed, 1e-11);
    }
}
