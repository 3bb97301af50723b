//! A snakeboard whose wheels turn through the direction across the board, where both constraints are one.
//! They are nonholonomic: what an error of the velocities does to the coordinates on the way stays.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A board on two axles that turn by opposite angles, with a rotor.
struct Snakeboard {
    m: f64,
    board: f64,
    rotor: f64,
    axle: f64,
    l: f64,
}

#[lagrangian(coordinates = [x, y, theta, psi, phi])]
impl Snakeboard {
    #[kinetic]
    fn moving(&self, v: &Velocities) -> f64 {
        let along = self.m * (v.x.powi(2) + v.y.powi(2)) + self.board * v.theta.powi(2);
        0.5 * (along + self.rotor * (v.theta + v.psi).powi(2)) + self.axle * v.phi.powi(2)
    }

    #[nonholonomic]
    fn wheels(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        [1.0, -1.0].map(|side| {
            let heading = q.theta + side * q.phi;
            heading.cos() * v.y - heading.sin() * v.x + side * self.l * q.phi.cos() * v.theta
        })
    }
}

/// A motion whose wheels turn evenly.
struct Turning {
    board: Snakeboard,
    start: State<f64, 5>,
}

impl Turning {
    fn sample(samples: &mut Samples) -> Self {
        let board = Snakeboard {
            m: samples.number(0.5, 2.0),
            board: samples.number(0.1, 1.0),
            rotor: samples.number(0.1, 1.0),
            axle: samples.number(0.05, 0.3),
            l: samples.number(0.2, 0.8),
        };
        let [theta, phi] = [samples.number(-3.0, 3.0), samples.number(0.6, 1.2)];
        let [turn, spin, rate] = [(-1.5, 1.5), (-2.0, 2.0), (0.3, 1.0)].map(|(a, b)| samples.number(a, b));
        let speed = board.l * turn / phi.tan();
        let v = [speed * theta.cos(), speed * theta.sin(), turn, spin, rate];
        Self { board, start: State::new([0.0, 0.0, theta, 0.0, phi], v) }
    }

    /// dθ/dt and the speed of the board. No force does work, so m v² + J (dθ/dt)² is constant, and
    /// v tan φ = l dθ/dt.
    fn rates(&self, t: f64) -> [f64; 2] {
        let Self { board: Snakeboard { m, board, l, .. }, start } = self;
        let inertia = |phi: f64| m * (l / phi.tan()).powi(2) + board;
        let phi = start.q[4] + start.v[4] * t;
        let turn = start.v[2] * (inertia(start.q[4]) / inertia(phi)).sqrt();
        [turn, l * turn / phi.tan()]
    }

    /// θ, x and y by Simpson's rule.
    fn place(&self, end: f64) -> [f64; 3] {
        const STEPS: u32 = 2000;
        let h = end / f64::from(STEPS);
        let [mut x, mut y, mut theta] = [0.0, 0.0, self.start.q[2]];
        for step in 0..STEPS {
            let [first, second, third, fourth, last] =
                [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| self.rates((f64::from(step) + part) * h));
            let simpson = |h: f64, [a, b, c]: [f64; 3]| h / 6.0 * (a + 4.0 * b + c);
            let half = theta + simpson(0.5 * h, [first[0], second[0], third[0]]);
            let next = half + simpson(0.5 * h, [third[0], fourth[0], last[0]]);
            let along = [(first, theta), (third, half), (last, next)];
            x += simpson(h, along.map(|([_, speed], theta)| speed * theta.cos()));
            y += simpson(h, along.map(|([_, speed], theta)| speed * theta.sin()));
            theta = next;
        }
        [theta, x, y]
    }
}

/// The largest error of such motions.
fn largest_error(
    motion: impl Fn(&Turning, f64) -> Result<State<f64, 5>, MotionError<f64>>,
    draws: usize,
    seed: u64,
) -> f64 {
    const END: f64 = 1.9;
    let mut samples = Samples::new(seed);
    let errors = (0..draws).map(|_| {
        let turning = Turning::sample(&mut samples);
        let end = motion(&turning, END).unwrap_or_else(|error| panic!("{error}"));
        let [theta, x, y] = turning.place(END);
        [end.q[2] - theta, end.q[0] - x, end.q[1] - y, end.v[2] - turning.rates(END)[0]]
    });
    errors.flatten().map(f64::abs).fold(0.0, f64::max)
}

#[test]
fn a_motion_goes_on_as_its_integrals_say() {
    for (seed, tolerance) in [(1, 1e-6), (2, 1e-9), (3, 1e-12)] {
        let error = largest_error(
            |Turning { board, start }, end| {
                board.simulate(*start).with_tolerance(tolerance).advance_to(end).copied()
            },
            40,
            seed,
        );
        assert!(error < 100.0 * tolerance, "{tolerance:e}: {error:e}");
    }
}

#[test]
fn so_it_does_in_steps_of_dop853() {
    for (seed, tolerance) in [(4, 1e-6), (5, 1e-9), (6, 1e-12), (7, 1e-12)] {
        let error = largest_error(
            |Turning { board, start }, end| {
                board.simulate_with::<Dop853>(*start).with_tolerance(tolerance).advance_to(end).copied()
            },
            40,
            seed,
        );
        assert!(error < 100.0 * tolerance, "{tolerance:e}: {error:e}");
    }
}
