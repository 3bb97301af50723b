//! Integrators from crates, on the best equations known by hand: closed forms, for chains the rod tensions,
//! for systems with constraints reduced ones; diffsol also with the multipliers.

mod differential_equations;
mod diffsol;
mod ode_solvers;

use super::subject::{Function, Outcome, Subject};
use crate::problem::Problem;
use crate::systems::andrews::{AndrewsMultipliers, AndrewsReduced};
use crate::systems::car_axis::{CarAxisMultipliers, CarAxisReduced};
use crate::systems::chains as c;
use crate::systems::first_order::{Explicit, FirstOrder};
use crate::systems::hand::{self as h, ByHand};
use crate::systems::multipliers::{PendulumMultiplier, SliderCrankMultiplier};

/// A boxed subject.
fn subject(name: &'static str, run: impl Fn(f64) -> Result<Outcome, String> + 'static) -> Box<dyn Subject> {
    Box::new(Function { name, trajectories: 1, run })
}

/// All crates on equations without multipliers.
fn all<F: FirstOrder<D>, const D: usize>(_: F, problem: &Problem) -> Vec<Box<dyn Subject>> {
    let start = F::begin(&problem.start);
    let mut subjects = differential_equations::subjects::<F, D>(start, problem.t_end);
    subjects.extend(ode_solvers::subjects::<F, D>(start, problem.t_end));
    subjects.extend(diffsol::subjects::<F, D>(start, problem.t_end));
    subjects
}

/// All crates on accelerations by hand, D = 2 N.
fn explicit<H: ByHand<N>, const N: usize, const D: usize>(
    by_hand: H,
    problem: &Problem,
) -> Vec<Box<dyn Subject>> {
    all::<Explicit<H, N>, D>(Explicit(by_hand), problem)
}

/// All crates on equations without multipliers, and the crates that can keep the multipliers.
fn both<F: FirstOrder<D>, M: FirstOrder<E>, const D: usize, const E: usize>(
    reduced: F,
    _: M,
    problem: &Problem,
) -> Vec<Box<dyn Subject>> {
    let mut subjects = all(reduced, problem);
    subjects.push(diffsol::multipliers::<M, E>(M::begin(&problem.start), problem.t_end));
    subjects
}

/// All subjects from crates that can do this problem.
pub fn subjects(problem: &Problem) -> Vec<Box<dyn Subject>> {
    match problem.name {
        "dpend" => explicit::<_, 2, 4>(h::DoublePendulum, problem),
        "spring" => explicit::<_, 2, 4>(h::SpringPendulum, problem),
        "hh" => explicit::<_, 2, 4>(h::HenonHeiles, problem),
        "kepler" => explicit::<_, 2, 4>(h::Kepler, problem),
        "pleiades" => explicit::<_, 14, 28>(h::Pleiades, problem),
        "top" => explicit::<_, 3, 6>(h::Top, problem),
        "sph" => explicit::<_, 2, 4>(h::SphericalPendulum, problem),
        "cart" => explicit::<_, 2, 4>(h::CartPole, problem),
        "pendc" => both::<Explicit<_, 2>, _, 4, 5>(Explicit(h::Pendulum), PendulumMultiplier, problem),
        "slider" => both::<Explicit<_, 2>, _, 4, 5>(Explicit(h::SliderCrank), SliderCrankMultiplier, problem),
        "andrews" => both(AndrewsReduced, AndrewsMultipliers, problem),
        "caraxis" => both(CarAxisReduced, CarAxisMultipliers, problem),
        "nlink3" => explicit::<_, 3, 6>(c::Tensions, problem),
        "nlink5" => explicit::<_, 5, 10>(c::Tensions, problem),
        "nlink10" => explicit::<_, 10, 20>(c::Tensions, problem),
        "nlink20" => explicit::<_, 20, 40>(c::Tensions, problem),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use crate::problem::{CONSTRAINED, problems};

    /// Reduced equations and those with multipliers are the systems that the references belong to.
    #[test]
    fn equations_reach_the_references() {
        for name in CONSTRAINED {
            for problem in problems(Some(name)).expect("the table of references") {
                for mut subject in super::subjects(&problem) {
                    let sample = subject.sample(&problem, 1e-8, 0.0).expect("a motion");
                    assert!(sample.error < 1e-3, "{name} {}: {:e}", subject.name(), sample.error);
                }
            }
        }
    }
}
