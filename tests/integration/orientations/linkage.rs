//! Bennett's loop: four bars in space, each a pose, with four hinges whose axes are neither parallel nor
//! meet.

use lagrangian::prelude::*;

use crate::support::close::{between, close_on};

/// The lengths of opposite bars are equal, and so are their twists, with sin α / a = sin β / b.
struct Bennett {
    lengths: [f64; 2],
    twists: [f64; 2],
}

#[lagrangian(coordinates = [bars: [Pose; 3]], allow(redundant))]
impl Bennett {
    /// From the hinge where a bar starts to the one where it ends: along x, turned about x.
    fn along(&self, bar: usize) -> Isometry3<f64> {
        Isometry3::from_parts(
            Translation3::new(self.lengths[bar % 2], 0.0, 0.0),
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), self.twists[bar % 2]),
        )
    }

    #[body(mass = 1.0, inertia = [0.02, 0.3, 0.3])]
    fn centres(&self, q: &Coordinates) -> [Isometry3<f64>; 3] {
        core::array::from_fn(|bar| q.bars[bar] * Translation3::new(0.5 * self.lengths[bar % 2], 0.0, 0.0))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.centres(q).iter().map(|bar| 9.81 * bar.translation.z).sum()
    }

    /// The frame is the fourth bar, which ends where the first starts.
    fn frame(&self) -> Isometry3<f64> {
        self.along(3).inverse()
    }

    /// Where one bar ends the next starts, about the same axis.
    fn hinge(&self, end: Isometry3<f64>, start: Isometry3<f64>) -> [f64; 5] {
        let gap = end.translation.vector - start.translation.vector;
        let axis = end.rotation * Vector3::z();
        let across = [start.rotation * Vector3::x(), start.rotation * Vector3::y()];
        [gap.x, gap.y, gap.z, axis.dot(&across[0]), axis.dot(&across[1])]
    }

    #[holonomic]
    fn first(&self, q: &Coordinates) -> [f64; 5] {
        self.hinge(Isometry3::identity(), q.bars[0])
    }

    #[holonomic]
    fn second(&self, q: &Coordinates) -> [f64; 5] {
        self.hinge(q.bars[0] * self.along(0), q.bars[1])
    }

    #[holonomic]
    fn third(&self, q: &Coordinates) -> [f64; 5] {
        self.hinge(q.bars[1] * self.along(1), q.bars[2])
    }

    #[holonomic]
    fn fourth(&self, q: &Coordinates) -> [f64; 5] {
        self.hinge(q.bars[2] * self.along(2), self.frame())
    }
}

fn about_z(angle: f64) -> Isometry3<f64> {
    Isometry3::from_parts(
        Translation3::identity(),
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle),
    )
}

/// The angle of the second hinge over that of the first: tan(θ₁/2) tan(θ₂/2) = sin((β + α)/2) / sin((β −
/// α)/2). (Bennett, *The skew isogram mechanism*, Proc. London Math. Soc. 13, 1914.)
fn second_angle(loop_: &Bennett, first: f64) -> f64 {
    let [alpha, beta] = loop_.twists;
    2.0 * ((0.5 * (beta + alpha)).sin() / ((0.5 * (beta - alpha)).sin() * (0.5 * first).tan())).atan()
}

/// All bars where the first hinge has an angle.
fn closed(loop_: &Bennett, first: f64) -> BennettCoordinates {
    let second = second_angle(loop_, first);
    let a = about_z(first);
    let b = a * loop_.along(0) * about_z(second);
    let c = b * loop_.along(1) * about_z(-first);
    BennettCoordinates { bars: [a, b, c] }
}

#[test]
fn bennetts_loop_turns_with_one_degree_of_freedom() {
    let (alpha, beta) = (0.6_f64, 1.1_f64);
    let loop_ = Bennett { lengths: [1.0, beta.sin() / alpha.sin()], twists: [alpha, beta] };
    // Twenty constraints on eighteen coordinates leave one motion.
    let resting = State::at_rest(closed(&loop_, 1.0));
    for residual in loop_.constraint_residuals(&resting) {
        close_on(1.0, residual, 0.0, 1e-14);
    }
    let mut motion = loop_.simulate(resting).with_tolerance(1e-12);
    let energy = motion.energy();
    let mut turned = 0.0_f64;
    for i in 1..=20 {
        let state = *motion.advance_to(0.1 * f64::from(i)).unwrap();
        let bars = BennettCoordinates::from(state.q).bars;
        let first = bars[0].rotation.scaled_axis().z;
        for (found, expected) in bars.iter().zip(closed(&loop_, first).bars) {
            close_on(1.0, found.rotation.angle_to(&expected.rotation), 0.0, 1e-9);
            close_on(1.0, (found.translation.vector - expected.translation.vector).norm(), 0.0, 1e-9);
        }
        close_on(20.0, motion.energy(), energy, 1e-11);
        turned = turned.max((first - 1.0).abs());
    }
    between(0.1, turned, 10.0);
}
