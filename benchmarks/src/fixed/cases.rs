//! The motions in fixed steps, and the methods that take them.

use std::error::Error;
use std::hint::black_box;
use std::marker::PhantomData;

use lagrangian::prelude::*;
use lagrangian::{FixedStep, Smooth, Stepper};

use crate::problem::{Problem, problems};
use crate::systems::described as d;

/// Steps from one instant of control to the next.
pub const SUBSTEPS: [usize; 10] = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512];
/// The tolerance of references that the table of problems lacks.
const FINEST: f64 = 1e-16;

/// A motion with its methods.
pub trait Case {
    /// Its name in all reports.
    fn name(&self) -> &'static str;
    /// Time from one instant of control to the next [s].
    fn hold(&self) -> f64;
    /// The number of holds of the inputs.
    fn holds(&self) -> usize;
    /// The names of the methods.
    fn methods(&self) -> Vec<&'static str>;
    /// The end of the motion by one method.
    fn run(&self, method: usize, substeps: usize) -> Result<Vec<f64>, String>;
    /// As in `precision`.
    fn error(&self, end: &[f64]) -> f64;
}

/// A system whose inputs are functions of the number of the hold.
struct Held<S, F, const N: usize, const K: usize> {
    system: S,
    inputs: F,
    hold: f64,
    holds: usize,
    problem: Problem,
}

impl<S, F, const N: usize, const K: usize> Held<S, F, N, K>
where
    S: System<N, K, Scalar = f64>,
    F: Fn(usize) -> [f64; K],
{
    fn start(&self) -> State<f64, N> {
        let (q, v) = self.problem.start();
        State::new(q, v)
    }

    /// The whole motion by method `M`.
    fn steps<M: FixedStep<S, N, K>>(&self, substeps: usize) -> Result<Vec<f64>, String> {
        let mut motion = Stepper::<S, M, N, K>::new(&self.system, black_box(self.start()));
        let h = black_box(self.hold / substeps as f64);
        for hold in 0..self.holds {
            let inputs = (self.inputs)(hold);
            for _ in 0..substeps {
                motion.step(h, &inputs).map_err(|error| error.to_string())?;
            }
        }
        Ok(motion.state().iter().collect())
    }
}

/// The methods by their names. A macro, because each is a type.
macro_rules! methods {
    ($($name:literal $method:ty,)*) => {
        impl<S, F, const N: usize, const K: usize> Case for Held<S, F, N, K>
        where
            S: Smooth<N, K> + System<N, K, Scalar = f64>,
            F: Fn(usize) -> [f64; K],
        {
            fn name(&self) -> &'static str {
                self.problem.name
            }

            fn hold(&self) -> f64 {
                self.hold
            }

            fn holds(&self) -> usize {
                self.holds
            }

            fn methods(&self) -> Vec<&'static str> {
                vec![$($name),*]
            }

            fn run(&self, method: usize, substeps: usize) -> Result<Vec<f64>, String> {
                let runs = [$(Self::steps::<$method>),*];
                runs[method](self, substeps)
            }

            fn error(&self, end: &[f64]) -> f64 {
                self.problem.error(end)
            }
        }
    };
}

methods! {
    "rk4" Rk4,
    "jet2" Jet<2>,
    "jet4" Jet<4>,
    "jet6" Jet<6>,
    "jet8" Jet<8>,
    "jet12" Jet<12>,
}

/// All cases.
pub fn all() -> Result<Vec<Box<dyn Case>>, Box<dyn Error>> {
    let pendulum = Held::<_, _, 2, 0> {
        system: d::DoublePendulum(PhantomData::<f64>),
        inputs: |_| [],
        hold: 0.1,
        holds: 100,
        problem: problem("dpend", "dpend")?,
    };
    let mut cart = Held::<_, _, 2, 1> {
        system: d::DrivenCartPole(PhantomData::<f64>),
        inputs: |hold| [2.0 * (1.5 * 0.05 * hold as f64).cos()],
        hold: 0.05,
        holds: 400,
        problem: problem("cart", "cart-held")?,
    };
    cart.problem.end = {
        let (system, start) = (&cart.system, cart.start());
        let mut motion = system.simulate(start).with_tolerance(FINEST);
        for hold in 0..cart.holds {
            motion.set_inputs((cart.inputs)(hold));
            motion.advance_to(cart.hold * (hold + 1) as f64).map_err(|error| error.to_string())?;
        }
        motion.state().iter().collect()
    };
    Ok(vec![Box::new(pendulum), Box::new(cart)])
}

/// The problem of a system, under a name of its own.
fn problem(system: &str, name: &'static str) -> Result<Problem, Box<dyn Error>> {
    let problem = problems(Some(system))?.pop().ok_or("no such system")?;
    Ok(Problem { name, ..problem })
}

#[cfg(test)]
mod tests {
    /// The reference of the held inputs does not come from the methods that are measured against it.
    #[test]
    fn methods_reach_the_references() {
        for case in super::all().expect("the references") {
            for (method, name) in case.methods().into_iter().enumerate().filter(|(_, name)| *name != "jet2") {
                let error = case.error(&case.run(method, 128).expect("a motion"));
                assert!(error < 1e-6, "{} {name}: {error:e}", case.name());
            }
        }
    }
}
