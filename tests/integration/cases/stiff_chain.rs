//! C07: the Fermi–Pasta–Ulam chain with stiff springs, which exchange their energies slowly.

use lagrangian::prelude::*;

use super::{EASY, HARD};
use crate::support::close::{all_close, between, close};
use crate::support::motion::{TIGHT, numbers};
use crate::support::reference::classical;

/// Three slow coordinates, then the three stretches of the stiff springs.
struct Chain {
    omega: f64,
}

#[lagrangian(coordinates = [x: [6]])]
impl Chain {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.iter().map(|v| v * v).sum::<f64>()
    }

    #[potential]
    fn stiff(&self, q: &Coordinates) -> f64 {
        0.5 * self.omega.powi(2) * q.x.iter().skip(3).map(|x| x.powi(2)).sum::<f64>()
    }

    #[potential]
    fn soft(&self, q: &Coordinates) -> f64 {
        let x = &q.x;
        let mut sum = (x[0] - x[3]).powi(4) + (x[2] + x[5]).powi(4);
        for i in 0..2 {
            sum += (x[i + 1] - x[i + 4] - x[i] - x[i + 3]).powi(4);
        }
        sum / 4.0
    }
}

const CHAIN: Chain = Chain { omega: 50.0 };

fn start() -> State<f64, 6> {
    State::new([1.0, 0.0, 0.0, 1.0 / CHAIN.omega, 0.0, 0.0], [1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
}

/// The energies of the stiff springs.
fn stiff_energies(state: &State<f64, 6>) -> [f64; 3] {
    std::array::from_fn(|j| (state.v[3 + j].powi(2) + (CHAIN.omega * state.q[3 + j]).powi(2)) / 2.0)
}

#[test]
fn energies_of_the_stiff_springs_and_the_last_state_agree() {
    let reference = classical("C07_fpu");
    let totals = reference.numbers::<3>("I_total");
    let mut motion = CHAIN.simulate(start()).with_tolerance(TIGHT);
    let energy = motion.energy();
    let energies = reference.timed_rows::<3>("stiff_energies_I1_I2_I3");
    for ((t, expected), total) in energies.into_iter().zip(totals) {
        motion.advance_to(t).unwrap();
        let found = stiff_energies(motion.state());
        all_close(found, expected, HARD);
        close(found.iter().sum(), total, HARD);
        close(motion.energy(), energy, EASY);
    }
    all_close(numbers(motion.state()), reference.numbers::<12>("state(200)"), HARD);
}

#[test]
fn the_total_stiff_energy_is_an_adiabatic_invariant() {
    let mut motion = CHAIN.simulate(start()).with_tolerance(1e-8);
    let totals: Vec<f64> =
        motion.every(0.05).take(1001).map(|state| stiff_energies(&state.unwrap()).iter().sum()).collect();
    let largest = totals.iter().map(|total| (total - 1.0).abs()).fold(0.0, f64::max);
    // It varies, but by no more than a few times 1/ω.
    between(0.1 / CHAIN.omega, largest, 5.0 / CHAIN.omega);
}
