//! Errors of fixed steps, against motions under tight error control.

use std::error::Error;

use lagrangian::prelude::*;
use lagrangian::{Adaptive, FixedStep, Held};
use systems::{Bits, CartPole, DoublePendulum, Experiment, Rod, Visitor, each, run};

/// The error of a method after one second: the largest of those of coordinates and velocities, in m, rad, m/s
/// and rad/s.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    pub system: &'static str,
    pub method: &'static str,
    pub scalar: &'static str,
    pub error: f64,
}

/// All errors after one second in so many steps.
pub fn after_a_second(steps: u32) -> Result<Vec<Record>, Box<dyn Error>> {
    let references = [
        (DoublePendulum::<f64>::NAME, reference::<DoublePendulum<f64>, 0>(steps)?),
        (Rod::<f64>::NAME, reference::<Rod<f64>, 0>(steps)?),
        (CartPole::<f64>::NAME, reference::<CartPole<f64>, 1>(steps)?),
    ];
    let mut runs = Runs { steps, references: &references, records: Vec::new() };
    each::<f32, _>(&mut runs)?;
    each::<f64, _>(&mut runs)?;
    Ok(runs.records)
}

/// The state after one second, with inputs that are held as the fixed steps hold them.
fn reference<S, const K: usize>(steps: u32) -> Result<State<f64, 2>, MotionError<f64>>
where
    S: Experiment<K, Scalar = f64>,
    S::Method: Adaptive<S, Held<f64, K>, 2, K>,
{
    let system = S::new();
    let mut motion = system.simulate(S::start()).with_tolerance(1e-15);
    for step in 1..=steps {
        motion.set_inputs(S::inputs(motion.state()));
        motion.advance_to(f64::from(step) / f64::from(steps))?;
    }
    Ok(*motion.state())
}

struct Runs<'a> {
    steps: u32,
    references: &'a [(&'static str, State<f64, 2>)],
    records: Vec<Record>,
}

impl<R: Bits> Visitor<R> for Runs<'_> {
    type Error = Box<dyn Error>;

    fn visit<S, M, const K: usize>(&mut self, method: &'static str) -> Result<(), Self::Error>
    where
        S: Experiment<K, Scalar = R>,
        M: FixedStep<S, 2, K>,
    {
        let reference = self.references.iter().find(|(name, _)| *name == S::NAME).ok_or("no reference")?.1;
        let mut end = S::start();
        let h = R::from_f64(1.0 / f64::from(self.steps));
        run::<S, M, K>(h, self.steps, |state| end = *state).map_err(|error| format!("{error}"))?;
        let differences =
            end.iter().zip(reference.iter()).map(|(found, exact)| (found.value() - exact).abs());
        let error = differences.fold(0.0, f64::max);
        self.records.push(Record { system: S::NAME, method, scalar: R::NAME, error });
        Ok(())
    }
}
