//! Laws of impact, and the impulses of impacts by name.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close};

/// A rod of half length and mass one whose lower end hits a rough floor, in free fall without weight.
struct Rod {
    restitution: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x, y, theta])]
impl Rod {
    #[body(mass = 1.0, inertia = 1.0 / 3.0)]
    fn rod(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.theta)
    }

    #[unilateral(restitution = self.restitution, law = poisson)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y - q.theta.sin()
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x + q.theta.sin() * v.theta
    }
}

/// At 45 degrees over the floor, with this velocity along it.
fn thrown(along: f64) -> State<f64, 3> {
    let height = core::f64::consts::FRAC_1_SQRT_2 + 0.1;
    State::new([0.0, height, core::f64::consts::FRAC_PI_4], [along, -1.0, 0.0])
}

#[test]
fn an_expansion_gives_a_part_of_the_impulse_of_the_compression() {
    let rod = Rod { restitution: 0.5, friction: 10.0 };
    let mut motion = rod.simulate(thrown(0.5)).with_tolerance(TIGHT);
    let impact = motion.advance_to_switch(1.0).unwrap().unwrap();
    close(impact.state.t, 0.1, 1e-14);
    // In the directions of the contact the inverse of the mass is (5, −3; −3, 5) / 2. The impulses (7, 1) /
    // 16 of the compression stop both velocities. The expansion adds half of the first one, and the impulse
    // that sticking takes meanwhile.
    let [normal, tangential] = [7.0 / 16.0 * 1.5, 1.0 / 16.0 + 0.6 * 7.0 / 32.0];
    let impulses = motion.impulses();
    all_close([impulses.floor, impulses.slip], [normal, tangential], 1e-12);
    let turn = 3.0 * core::f64::consts::FRAC_1_SQRT_2 * (tangential - normal);
    all_close(impact.state.v, [0.5 + tangential, normal - 1.0, turn], 1e-12);
    // By Newton's law it would leave with 0.5.
    close(impact.state.v[1] - core::f64::consts::FRAC_1_SQRT_2 * impact.state.v[2], 0.35, 1e-12);
}

#[test]
fn friction_slides_through_both_phases() {
    let rod = Rod { restitution: 0.5, friction: 0.1 };
    let mut motion = rod.simulate(thrown(5.0)).with_tolerance(TIGHT);
    motion.advance_to_switch(1.0).unwrap().unwrap();
    let impulses = motion.impulses();
    all_close([impulses.floor, impulses.slip], [1.5 / 2.65, -0.15 / 2.65], 1e-12);
}

/// A particle on a floor that is the smoother the faster it slides.
struct Skater;

#[lagrangian(coordinates = [x, y])]
impl Skater {
    #[point(mass = 2.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral(restitution = 0.5, law = poisson)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    fn roughness(&self, v: &Velocities) -> f64 {
        0.4 / (1.0 + v.x * v.x)
    }

    #[friction(coefficient = roughness, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn coefficients_in_both_phases_are_those_before_the_impact() {
    let start = State::new([0.0, 1.0], [3.0, -10.0]);
    let mut motion = Skater.simulate(start).with_tolerance(TIGHT);
    let impact = motion.advance_to_switch(1.0).unwrap().unwrap();
    all_close(impact.state.v, [3.0 - 0.04 * 15.0, 5.0], 1e-13);
    let impulses = motion.impulses();
    all_close([impulses.floor, impulses.slip], [30.0, -1.2], 1e-13);
}

/// Three balls in a row that touch; the first pair is plastic and the second elastic.
struct Balls;

#[lagrangian(coordinates = [a, b, c])]
impl Balls {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.a * v.a + v.b * v.b + v.c * v.c)
    }

    #[unilateral(restitution = 0.0, law = poisson)]
    fn left(&self, q: &Coordinates) -> f64 {
        q.b - q.a
    }

    #[unilateral(restitution = 1.0, law = poisson)]
    fn right(&self, q: &Coordinates) -> f64 {
        q.c - q.b
    }
}

#[test]
fn a_pair_that_touches_gives_back_what_it_has_taken() {
    let mut motion = Balls.simulate(State::new([-0.1, 0.0, 0.0], [1.0, 0.0, 0.0])).with_tolerance(TIGHT);
    let impact = motion.advance_to_switch(1.0).unwrap().unwrap();
    // The compression leaves 1/3 each by impulses 2/3 and 1/3. The second is given back, and presses the
    // first pair once more.
    all_close(impact.state.v, [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0], 1e-13);
    let impulses = motion.impulses();
    all_close([impulses.left, impulses.right], [5.0 / 6.0, 2.0 / 3.0], 1e-13);
}

/// A ball on a floor that takes all.
struct Clay;

#[lagrangian(coordinates = [y])]
impl Clay {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        v.y * v.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[unilateral(law = plastic)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

#[test]
fn an_impulse_is_that_of_the_last_change() {
    let mut motion = Clay.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    assert_eq!(motion.impulses().floor, 0.0);
    motion.advance_to_switch(1.0).unwrap().unwrap();
    close(motion.impulses().floor, 2.0 * (2.0_f64 * 9.81).sqrt(), 1e-13);
    assert_eq!(motion.advance_to(1.0).unwrap().v, [0.0]);
}
