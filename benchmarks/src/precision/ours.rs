//! The library itself. `jets` is the method of `simulate`, `dop853` the method of that name, `jets-batch4`
//! and `jets-batch8` the same motion in all lanes of a SIMD vector.

use std::marker::PhantomData;

use lagrangian::prelude::*;
use lagrangian::{Batch, Lanes};
use wide::{f64x4, f64x8};

use super::subject::{Function, Outcome, Subject};
use crate::problem::Problem;
use crate::systems::{constrained as c, described as d};

/// The subjects of one described system. A macro, because it calls what a user calls, whatever its bounds.
macro_rules! ours {
    ($system:path, $problem:expr) => {{
        let (q, v) = $problem.start();
        let t_end = $problem.t_end;
        macro_rules! motion {
            ($name:literal, |$described:ident, $start:ident, $tolerance:ident| $begin:expr) => {{
                let run = move |$tolerance| {
                    let ($described, $start) = ($system(PhantomData::<f64>), State::new(q, v));
                    let mut motion = $begin;
                    motion.advance_to(t_end).map_err(|error| error.to_string())?;
                    Ok(Outcome { end: motion.state().iter().collect(), steps: motion.steps().accepted })
                };
                Box::new(Function { name: $name, trajectories: 1, run }) as Box<dyn Subject>
            }};
        }
        macro_rules! batch {
            ($name:literal, $vector:ty, $lanes:literal) => {{
                let run = move |tolerance| {
                    let described = $system(PhantomData::<Lanes<$vector>>);
                    let start = State::new(q.map(Lanes::splat), v.map(Lanes::splat));
                    let mut batch = Batch::new(&described, start).with_tolerance(tolerance);
                    batch.advance_to(t_end).map_err(|error| error.to_string())?;
                    let end = trajectories::<$lanes>(batch.state().iter().map(Into::into));
                    Ok(Outcome { end, steps: batch.expansions() })
                };
                Box::new(Function { name: $name, trajectories: $lanes, run }) as Box<dyn Subject>
            }};
        }
        vec![
            motion!("jets", |system, start, tol| system.simulate(start).with_tolerance(tol)),
            motion!("dop853", |system, start, tol| system.simulate_with::<Dop853>(start).with_tolerance(tol)),
            batch!("jets-batch4", f64x4, 4),
            batch!("jets-batch8", f64x8, 8),
        ]
    }};
}

/// The states of all lanes, one after the other.
fn trajectories<const LANES: usize>(state: impl Iterator<Item = [f64; LANES]>) -> Vec<f64> {
    let state: Vec<[f64; LANES]> = state.collect();
    (0..LANES).flat_map(|lane| state.iter().map(move |lanes| lanes[lane])).collect()
}

/// All our subjects that can do this problem.
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
        "pendc" => ours!(c::CartesianPendulum, problem),
        "slider" => ours!(c::SliderCrank, problem),
        "andrews" => ours!(c::Andrews, problem),
        "caraxis" => ours!(c::CarAxis, problem),
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
