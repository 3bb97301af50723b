//! S06: a mass on springs in a rotating frame: gyroscopic terms, damping, and the stable range of rates.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY};
use crate::support::close::{all_close, all_close_on_largest, between, close, close_on};
use crate::support::difference::{STEP, eigenvalues, frequencies, state_matrix};
use crate::support::motion::{TIGHT, drift, follows};
use crate::support::reference::seed;

#[derive(Clone, Copy)]
struct RotatingFrame {
    m: f64,
    k: [f64; 2],
    c: f64,
    /// Moment of inertia of the frame, which turns at a given rate.
    inertia: f64,
    rate: f64,
}

#[lagrangian(coordinates = [x, y])]
impl RotatingFrame {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let (vx, vy) = (v.x - self.rate * q.y, v.y + self.rate * q.x);
        self.m * (vx.powi(2) + vy.powi(2)) / 2.0 + self.inertia * self.rate.powi(2) / 2.0
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        (self.k[0] * q.x.powi(2) + self.k[1] * q.y.powi(2)) / 2.0
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        self.c * v.x.powi(2) / 2.0
    }
}

const FRAME: RotatingFrame = RotatingFrame { m: 1.0, k: [20.0, 30.0], c: 0.4, inertia: 0.2, rate: 2.0 };

fn start() -> State<f64, 2> {
    State::new([0.1, -0.05], [0.0, 0.3])
}

fn matrix(frame: RotatingFrame) -> nalgebra::DMatrix<f64> {
    state_matrix(STEP, &State::at_rest([0.0, 0.0]), |s| frame.accelerations(s).unwrap())
}

#[test]
fn the_matrices_are_those_of_the_text() {
    let RotatingFrame { m, k, c, rate, .. } = FRAME;
    assert_eq!(FRAME.mass_matrix(&start()), Matrix2::new(m, 0.0, 0.0, m));
    let column = |index: usize| {
        let mut numbers = [0.0; 4];
        numbers[index] = 1.0;
        let [x, y, vx, vy] = numbers;
        State::new([x, y], [vx, vy])
    };
    // Columns of K − W² M, then of G; columns of −C.
    let zero = 0.0;
    for (index, bias, applied) in [
        (0, [k[0] - rate * rate * m, zero], [zero, zero]),
        (1, [zero, k[1] - rate * rate * m], [zero, zero]),
        (2, [zero, 2.0 * m * rate], [-c, zero]),
        (3, [-2.0 * m * rate, zero], [zero, zero]),
    ] {
        all_close(FRAME.bias(&column(index)), bias, CLOSED_FORM);
        all_close(FRAME.applied_forces(&column(index)), applied, CLOSED_FORM);
    }
}

#[test]
fn the_eigenvalues_agree() {
    let mut expected = seed("S06").rows::<2>("eigenvalues");
    expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
    for (found, [re, im]) in eigenvalues(&matrix(FRAME)).iter().zip(expected) {
        // The parts come from one matrix, whose entries are of the size of |λ|².
        all_close_on_largest([found.re, found.im], [re, im], CLOSED_FORM);
    }
    let undamped = RotatingFrame { c: 0.0, ..FRAME };
    all_close(frequencies(&matrix(undamped)), seed("S06").numbers::<2>("undamped_frequencies"), CLOSED_FORM);
}

#[test]
fn the_states_agree() {
    let reference = [1, 5].map(|t| (f64::from(t), seed("S06").numbers::<4>(&format!("state({t})"))));
    follows(&FRAME, start(), reference, EASY);
}

#[test]
fn stability_is_lost_and_regained_at_the_critical_rates() {
    let growth = |rate: f64| {
        let found = eigenvalues(&matrix(RotatingFrame { c: 0.0, rate, ..FRAME }));
        found.iter().map(|value| value.re).fold(f64::MIN, f64::max)
    };
    let [lost, regained] = seed("S06").numbers("critical_Omega_undamped");
    for (rate, inside) in [(lost, 1.0), (regained, -1.0)] {
        close_on(1.0, growth(rate - inside * 1e-3), 0.0, 1e-9);
        between(1e-3, growth(rate + inside * 1e-3), 1.0);
    }
    // The stiffness less the centrifugal part vanishes exactly there.
    for (axis, rate) in [lost, regained].into_iter().enumerate() {
        let mut q = [0.0; 2];
        q[axis] = 1.0;
        let critical = RotatingFrame { rate, ..FRAME };
        close_on(FRAME.k[axis], critical.bias(&State::at_rest(q))[axis], 0.0, 1e-15);
    }
}

#[test]
fn the_jacobi_integral_is_conserved_and_the_energy_is_not() {
    let undamped = RotatingFrame { c: 0.0, ..FRAME };
    let run = |quantity: &dyn Fn(&State<f64, 2>) -> f64| {
        let mut motion = undamped.simulate(start()).with_tolerance(TIGHT);
        drift(&mut motion, 0.1, 100, quantity)
    };
    between(-1.0, run(&|s| undamped.jacobi_integral(s)), 1e-13);
    between(0.01, run(&|s| undamped.energy(s)), 1.0);
    let State { q: [x, y], v: [vx, vy], .. } = start();
    let RotatingFrame { m, k, inertia, rate, .. } = undamped;
    let of_velocities = m * (vx * vx + vy * vy) / 2.0;
    let of_places = m * rate * rate * (x * x + y * y) / 2.0 + inertia * rate * rate / 2.0;
    let potential = (k[0] * x * x + k[1] * y * y) / 2.0;
    close(undamped.jacobi_integral(&start()), of_velocities - of_places + potential, CLOSED_FORM);
}
