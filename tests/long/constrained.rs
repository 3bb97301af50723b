//! Long runs of constrained motions: no drift off the constraints, and an error of the energy that is that of
//! rounding. Slow: `scripts/check.sh drift`.

use lagrangian::Smooth;
use lagrangian::prelude::*;

use crate::close::between;

/// A pendulum on a rod, in Cartesian coordinates; energy zero at the bottom.
struct Rod {
    length: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Rod {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (q.y + self.length)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

/// The same with the square of the length.
struct Squared {
    length: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Squared {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (q.y + self.length)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        (self.bob(q).norm_squared() - self.length.powi(2)) / 2.0
    }
}

/// A four-bar linkage by the angles of its links; the crank can go round.
struct Angles;

#[lagrangian(coordinates = [crank, coupler, rocker])]
impl Angles {
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[point(mass = 1.5)]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        0.4 * Self::along(q.crank)
    }

    #[point(mass = 2.0)]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        self.first(q) + 1.1 * Self::along(q.coupler)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (1.5 * self.first(q).y + 2.0 * self.second(q).y)
    }

    #[holonomic]
    fn closure(&self, q: &Coordinates) -> Vector2<f64> {
        self.second(q) - 0.9 * Self::along(q.rocker) - Vector2::new(1.0, 0.0)
    }
}

/// The same linkage by the places of its joints.
struct Joints;

#[lagrangian(coordinates = [first: [2], second: [2]])]
impl Joints {
    #[point(mass = [1.5, 2.0])]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::from(q.first), Vector2::from(q.second)]
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (1.5 * q.first[1] + 2.0 * q.second[1])
    }

    #[holonomic]
    fn links(&self, q: &Coordinates) -> [f64; 3] {
        let [first, second] = self.joints(q);
        [first.norm() - 0.4, (second - first).norm() - 1.1, (second - Vector2::new(1.0, 0.0)).norm() - 0.9]
    }
}

/// The figures of a run: relative errors of the energy, root of the mean square block by block, and the
/// largest of all |f| and |w| relative to lengths and speeds.
struct Figures {
    energies: Vec<f64>,
    position: f64,
    velocity: f64,
}

/// Runs over `blocks` blocks of which each is twice as long as the one before and the first has `first`
/// samples of `dt`. The violations are those of a state, |f| per unit of length and |w| per unit of speed.
fn run<S, const N: usize>(
    name: &str,
    system: &S,
    start: State<f64, N>,
    (dt, first, blocks): (f64, u32, u32),
    violations: impl Fn(&State<f64, N>) -> [f64; 2],
) -> Figures
where
    S: System<N, 0, Scalar = f64, Method = Jets> + Smooth<N>,
{
    let mut motion = system.simulate(start).with_tolerance(0.0);
    let energy = motion.energy();
    let mut figures = Figures { energies: Vec::new(), position: 0.0, velocity: 0.0 };
    let mut time = 0_u32;
    for block in 0..blocks {
        let count = first << block;
        let mut squares = 0.0;
        for _ in 0..count {
            time += 1;
            motion.advance_to(dt * f64::from(time)).unwrap();
            squares += (motion.energy() / energy - 1.0).powi(2);
            let [position, velocity] = violations(motion.state());
            // A NaN stays.
            figures.position = if position < figures.position { figures.position } else { position };
            figures.velocity = if velocity < figures.velocity { figures.velocity } else { velocity };
        }
        let error = (squares / f64::from(count)).sqrt();
        figures.energies.push(error);
        println!(
            "{name}: t = {:.0}, {} steps, energy {error:.1e}, |f| {:.1e}, |w| {:.1e}",
            motion.t(),
            motion.steps().accepted,
            figures.position,
            figures.velocity,
        );
    }
    let ratio = figures.energies[figures.energies.len() - 1] / figures.energies[0];
    println!("{name}: exponent {:.2}", ratio.log2() / f64::from(blocks - 1));
    between(9e5, motion.steps().accepted as f64, 2e7);
    figures
}

#[track_caller]
fn keeps(figures: &Figures, energy: f64) {
    between(-1.0, figures.position, 1e-14);
    between(-1.0, figures.velocity, 1e-14);
    between(0.0, figures.energies[figures.energies.len() - 1], energy);
}

fn speed<const N: usize>(state: &State<f64, N>) -> f64 {
    state.v.iter().fold(1.0, |speed, v| v.abs().max(speed))
}

fn largest<const C: usize>(values: [f64; C]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

macro_rules! violations {
    ($system:expr) => {
        |s| [largest($system.constraint_residuals(s)), largest($system.constraint_rates(s)) / speed(s)]
    };
}

/// A large swing of a pendulum, or one that turns over.
fn pendulum(length: f64, speed: f64) -> State<f64, 2> {
    State::new([0.6 * length, -0.8 * length], [0.8 * speed, 0.6 * speed])
}

#[test]
fn a_rod_keeps_length_and_energy() {
    for length in [1.3, 0.7] {
        let rod = Rod { length };
        let name = format!("rod of {length}, swinging");
        keeps(&run(&name, &rod, pendulum(length, 0.0), (0.4, 1000, 10), violations!(rod)), 1e-11);
        let name = format!("rod of {length}, turning");
        keeps(&run(&name, &rod, pendulum(length, 8.0), (0.25, 1000, 10), violations!(rod)), 1e-11);
    }
}

#[test]
fn a_squared_length_keeps_length_and_energy() {
    for length in [1.3, 0.7] {
        let rod = Squared { length };
        let name = format!("square of {length}, swinging");
        keeps(&run(&name, &rod, pendulum(length, 0.0), (0.4, 1000, 10), violations!(rod)), 1e-11);
        let name = format!("square of {length}, turning");
        keeps(&run(&name, &rod, pendulum(length, 8.0), (0.25, 1000, 10), violations!(rod)), 1e-11);
    }
}

/// On the unit circle x² + y² lies where the spacing of numbers doubles, so that its rounding has a mean: the
/// energy grows with the number of steps, not with its root.
#[test]
fn a_length_of_one_keeps_length_and_energy() {
    let (rod, square) = (Rod { length: 1.0 }, Squared { length: 1.0 });
    keeps(&run("rod of 1, swinging", &rod, pendulum(1.0, 0.0), (0.4, 500, 10), violations!(rod)), 1e-11);
    keeps(&run("rod of 1, turning", &rod, pendulum(1.0, 8.0), (0.22, 500, 10), violations!(rod)), 1e-11);
    keeps(
        &run("square of 1, swinging", &square, pendulum(1.0, 0.0), (0.4, 500, 10), violations!(square)),
        1e-11,
    );
    keeps(
        &run("square of 1, turning", &square, pendulum(1.0, 8.0), (0.22, 500, 10), violations!(square)),
        1e-11,
    );
}

/// The linkage at an angle of its crank, which turns at a rate.
fn angles(crank: f64, rate: f64) -> State<f64, 3> {
    let rough = State::new([crank, 0.9, 1.6], [rate, 0.0, 0.0]);
    Angles.consistent(rough).expect("a linkage that closes")
}

/// The same by its joints.
fn joints(crank: f64, rate: f64) -> State<f64, 4> {
    let ([crank, _, rocker], [turn, _, swing]) = (angles(crank, rate).q, angles(crank, rate).v);
    let (first, second) = ([0.4 * crank.cos(), 0.4 * crank.sin()], [0.9 * rocker.cos(), 0.9 * rocker.sin()]);
    let rough = State::new(
        [first[0], first[1], 1.0 + second[0], second[1]],
        [-turn * first[1], turn * first[0], -swing * second[1], swing * second[0]],
    );
    Joints.consistent(rough).expect("a linkage that closes")
}

#[test]
fn a_linkage_that_swings_keeps_closure_and_energy() {
    // To and fro, because an angle that grows without end loses its digits.
    let swinging = angles(1.5, 0.5);
    keeps(&run("linkage, angles", &Angles, swinging, (0.05, 1000, 10), violations!(Angles)), 1e-11);
}

#[test]
fn a_linkage_whose_crank_goes_round_keeps_lengths_and_energy() {
    let turning = joints(1.5, 9.0);
    keeps(&run("linkage, joints", &Joints, turning, (0.05, 500, 10), violations!(Joints)), 1e-11);
}
