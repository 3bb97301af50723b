//! The crate `ode_solvers`: Dormand–Prince 8(5,3).
//!
//! Version 0.6.2 evaluates one stage at the wrong time, so its order is lost where the equations depend on
//! time: the figures for `cart` and `caraxis` are what a user gets.

use std::marker::PhantomData;

use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};

use super::{Outcome, Subject, subject};
use crate::systems::first_order::FirstOrder;

struct Field<F>(PhantomData<F>);

impl<F: FirstOrder<D>, const D: usize> System<f64, SVector<f64, D>> for Field<F> {
    #[inline]
    fn system(&self, t: f64, y: &SVector<f64, D>, dy: &mut SVector<f64, D>) {
        F::slope(t, &y.data.0[0], &mut dy.data.0[0]);
    }
}

/// Its only method of high order, with its own default constants for the step size and no limit on steps.
pub fn subjects<F: FirstOrder<D>, const D: usize>(start: [f64; D], t_end: f64) -> Vec<Box<dyn Subject>> {
    vec![subject("ode_solvers-dop853", move |tolerance| {
        let mut solver = Dop853::from_param(
            Field::<F>(PhantomData),
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
        let end = F::motion(t_end, &solver.y_out().last().ok_or("no solution")?.data.0[0]);
        Ok(Outcome { end, steps: u64::from(counts.accepted_steps) })
    })]
}
