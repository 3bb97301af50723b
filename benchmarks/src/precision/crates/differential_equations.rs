//! The crate `differential-equations`: its methods of orders 5, 8 and 9.

use std::marker::PhantomData;

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};

use super::{Outcome, Subject, slope, subject};
use crate::systems::hand::ByHand;

/// Steps that a run may take; the crate's own limit is too low for fine tolerances.
const STEPS: usize = 50_000_000;

struct Field<H, const N: usize>(PhantomData<H>);

impl<H: ByHand<N>, const N: usize, const D: usize> ODE<f64, [f64; D]> for Field<H, N> {
    #[inline]
    fn diff(&self, t: f64, y: &[f64; D], dydt: &mut [f64; D]) {
        slope::<H, f64, N, D>(t, y, dydt);
    }
}

/// One subject for each method.
pub fn subjects<H: ByHand<N>, const N: usize, const D: usize>(
    start: [f64; D],
    t_end: f64,
) -> Vec<Box<dyn Subject>> {
    macro_rules! method {
        ($name:literal, $method:ident) => {
            subject($name, move |tolerance| {
                let method = ExplicitRungeKutta::$method().rtol(tolerance).atol(tolerance).max_steps(STEPS);
                let field = Field::<H, N>(PhantomData);
                let solved = IVP::ode(&field, 0.0, t_end, start).method(method).solve();
                let solution = solved.map_err(|error| format!("{error:?}"))?;
                let end = solution.y.last().ok_or("no solution")?.to_vec();
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
