//! The crate `differential-equations`: its methods of orders 5, 8 and 9.

use std::marker::PhantomData;

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};

use super::{Outcome, Subject, subject};
use crate::systems::first_order::FirstOrder;

/// Steps that a run may take; the crate's own limit is too low for fine tolerances.
const STEPS: usize = 50_000_000;

struct Field<F>(PhantomData<F>);

impl<F: FirstOrder<D>, const D: usize> ODE<f64, [f64; D]> for Field<F> {
    #[inline]
    fn diff(&self, t: f64, y: &[f64; D], dydt: &mut [f64; D]) {
        F::slope(t, y, dydt);
    }
}

/// One subject for each method.
pub fn subjects<F: FirstOrder<D>, const D: usize>(start: [f64; D], t_end: f64) -> Vec<Box<dyn Subject>> {
    macro_rules! method {
        ($name:literal, $method:ident) => {
            subject($name, move |tolerance| {
                let method = ExplicitRungeKutta::$method().rtol(tolerance).atol(tolerance).max_steps(STEPS);
                let field = Field::<F>(PhantomData);
                let solved = IVP::ode(&field, 0.0, t_end, start).method(method).solve();
                let solution = solved.map_err(|error| format!("{error:?}"))?;
                let end = F::motion(t_end, solution.y.last().ok_or("no solution")?);
                Ok(Outcome { end, steps: solution.steps.accepted as u64 })
            })
        };
    }
    vec![
        method!("diffeq-dopri5", dopri5),
        method!("diffeq-dop853", dop853),
        method!("diffeq-rkv988e", rkv988e),
        method!("diffeq-rkv989e", rkv989e),
    ]
}
