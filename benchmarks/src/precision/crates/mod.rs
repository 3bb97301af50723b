//! Integrators from crates, on the best accelerations known by hand: closed forms, for chains the rod tensions.

mod differential_equations;
mod diffsol;
mod ode_solvers;

use super::subject::{Function, Outcome, Subject};
use crate::problem::Problem;
use crate::systems::hand::{self as h, ByHand};
use crate::systems::number::Number;

/// A boxed subject.
fn subject(name: &'static str, run: impl Fn(f64) -> Result<Outcome, String> + 'static) -> Box<dyn Subject> {
    Box::new(Function { name, trajectories: 1, run })
}

/// dy/dt of y = (q, v), with D = 2 N.
#[inline(always)]
fn slope<H: ByHand<N>, R: Number, const N: usize, const D: usize>(t: f64, y: &[R; D], slope: &mut [R; D]) {
    const { assert!(D == 2 * N) };
    let (q, v) = (y.first_chunk::<N>(), y.last_chunk::<N>());
    let (Some(q), Some(v)) = (q, v) else { return };
    if let Some(first) = slope.first_chunk_mut::<N>() {
        *first = *v;
    }
    if let Some(last) = slope.last_chunk_mut::<N>() {
        H::accelerations(t, q, v, last);
    }
}

/// All crates on one system.
fn all<H: ByHand<N>, const N: usize, const D: usize>(
    _by_hand: H,
    problem: &Problem,
) -> Vec<Box<dyn Subject>> {
    let start: [f64; D] = problem.start.as_slice().try_into().expect("2 N numbers");
    let mut subjects = differential_equations::subjects::<H, N, D>(start, problem.t_end);
    subjects.extend(ode_solvers::subjects::<H, N, D>(start, problem.t_end));
    subjects.extend(diffsol::subjects::<H, N, D>(start, problem.t_end));
    subjects
}

/// Everything of the crates that can do this problem.
pub fn subjects(problem: &Problem) -> Vec<Box<dyn Subject>> {
    match problem.name {
        "dpend" => all::<_, 2, 4>(h::DoublePendulum, problem),
        "spring" => all::<_, 2, 4>(h::SpringPendulum, problem),
        "hh" => all::<_, 2, 4>(h::HenonHeiles, problem),
        "kepler" => all::<_, 2, 4>(h::Kepler, problem),
        "pleiades" => all::<_, 14, 28>(h::Pleiades, problem),
        "top" => all::<_, 3, 6>(h::Top, problem),
        "sph" => all::<_, 2, 4>(h::SphericalPendulum, problem),
        "cart" => all::<_, 2, 4>(h::CartPole, problem),
        "pendc" => all::<_, 2, 4>(h::Pendulum, problem),
        "slider" => all::<_, 2, 4>(h::SliderCrank, problem),
        "nlink3" => all::<_, 3, 6>(h::Linear, problem),
        "nlink5" => all::<_, 5, 10>(h::Linear, problem),
        "nlink10" => all::<_, 10, 20>(h::Linear, problem),
        "nlink20" => all::<_, 20, 40>(h::Linear, problem),
        _ => Vec::new(),
    }
}
