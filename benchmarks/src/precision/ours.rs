//! The library itself: `jets` is what `simulate` does without further words, `dop853` the method of that name.

use lagrangian::prelude::*;

use super::subject::{Function, Outcome, Subject};
use crate::problem::Problem;
use crate::systems::described as d;

/// The subjects of one described system. A macro, because it calls what a user calls, whatever its bounds.
///
/// A batch in the lanes of one scalar, `jets-batch4` or `jets-batch8`, would be one more entry with as many
/// trajectories.
macro_rules! ours {
    ($system:expr, $problem:expr) => {{
        let (q, v) = $problem.start();
        let (start, t_end) = (State::new(q, v), $problem.t_end);
        macro_rules! motion {
            ($name:literal, |$described:ident, $tolerance:ident| $begin:expr) => {{
                let run = move |$tolerance| {
                    let $described = $system;
                    let mut motion = $begin;
                    motion.advance_to(t_end).map_err(|error| error.to_string())?;
                    Ok(Outcome { end: motion.state().iter().collect(), steps: motion.steps().accepted })
                };
                Box::new(Function { name: $name, trajectories: 1, run }) as Box<dyn Subject>
            }};
        }
        vec![
            motion!("jets", |system, tol| system.simulate(start).with_tolerance(tol)),
            motion!("dop853", |system, tol| system.simulate_with::<Dop853>(start).with_tolerance(tol)),
        ]
    }};
}

/// Everything of ours that can do this problem.
pub fn subjects(problem: &Problem) -> Vec<Box<dyn Subject>> {
    match problem.name {
        "dpend" => ours!(d::DoublePendulum, problem),
        "spring" => ours!(d::SpringPendulum, problem),
        "hh" => ours!(d::HenonHeiles, problem),
        "kepler" => ours!(d::Kepler, problem),
        "pleiades" => ours!(d::Pleiades, problem),
        "top" => ours!(d::Top, problem),
        "sph" => ours!(d::SphericalPendulum, problem),
        "cart" => ours!(d::CartPole, problem),
        "nlink3" => ours!(d::Chain3, problem),
        "nlink5" => ours!(d::Chain5, problem),
        "nlink10" => ours!(d::Chain10, problem),
        "nlink20" => ours!(d::Chain20, problem),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use crate::problem::problems;

    /// The descriptions are the systems that the references belong to.
    #[test]
    fn descriptions_reach_the_references() {
        for problem in problems(None).expect("the table of references") {
            for mut subject in super::subjects(&problem) {
                let sample = subject.sample(&problem, 1e-13, 0.0).expect("a motion");
                assert!(sample.error < 1e-6, "{} {}: {:e}", problem.name, subject.name(), sample.error);
            }
        }
    }
}
