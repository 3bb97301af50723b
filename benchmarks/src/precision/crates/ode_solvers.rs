//! The crate `ode_solvers`: Dormand–Prince 8(5,3).
//!
//! Version 0.6.2 evaluates one stage at the wrong time, so its order is lost where the equations depend on time:
//! the figures for `cart` are what a user gets.

use std::marker::PhantomData;

use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};

use super::{Outcome, Subject, slope, subject};
use crate::systems::hand::ByHand;

struct Field<H, const N: usize>(PhantomData<H>);

impl<H: ByHand<N>, const N: usize, const D: usize> System<f64, SVector<f64, D>> for Field<H, N> {
    #[inline]
    fn system(&self, t: f64, y: &SVector<f64, D>, dy: &mut SVector<f64, D>) {
        slope::<H, f64, N, D>(t, &y.data.0[0], &mut dy.data.0[0]);
    }
}

/// Its only method of high order, with its own default constants for the step size and no limit on steps.
pub fn subjects<H: ByHand<N>, const N: usize, const D: usize>(
    start: [f64; D],
    t_end: f64,
) -> Vec<Box<dyn Subject>> {
    vec![subject("ode_solvers-dop853", move |tolerance| {
        let mut solver = Dop853::from_param(
            Field::<H, N>(PhantomData),
            0.0,
            t_end,
            t_end,
            SVector::from(start),
            tolerance,
            tolerance,
            0.9,
            0.0,
            0.333,
            6.0,
            t_end,
            0.0,
            u32::MAX,
            u32::MAX,
            OutputType::Sparse,
        );
        let counts = solver.integrate().map_err(|error| format!("{error:?}"))?;
        let end = solver.y_out().last().ok_or("no solution")?.as_slice().to_vec();
        Ok(Outcome { end, steps: u64::from(counts.accepted_steps) })
    })]
}
