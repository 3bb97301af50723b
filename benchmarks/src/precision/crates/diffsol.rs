//! The crate `diffsol` on its nalgebra back end: Tsitouras 5(4) and BDF, the latter with multipliers as well.

use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, VectorCommon};

use super::{Outcome, Subject, subject};
use crate::systems::dual::Dual;
use crate::systems::first_order::FirstOrder;

/// The finest tolerance at which BDF without multipliers converges.
const FINEST_BDF: f64 = 1e-13;

/// dy/dt.
#[inline]
fn field<F: FirstOrder<D>, const D: usize>(y: &[f64], _: &[f64], t: f64, dy: &mut [f64]) {
    if let (Ok(y), Ok(dy)) = (y.try_into(), dy.try_into()) {
        F::slope::<f64>(t, y, dy);
    }
}

/// The derivative of dy/dt in a direction.
#[inline]
fn directional<F: FirstOrder<D>, const D: usize>(
    y: &[f64],
    _: &[f64],
    t: f64,
    direction: &[f64],
    out: &mut [f64],
) {
    let y: [Dual; D] = std::array::from_fn(|i| Dual { value: y[i], slope: direction[i] });
    let mut dy = [Dual::default(); D];
    F::slope(t, &y, &mut dy);
    for (out, dy) in out.iter_mut().zip(dy) {
        *out = dy.slope;
    }
}

/// Whether a number has a derivative; multipliers have none.
const fn differential<F: FirstOrder<D>, const D: usize>(i: usize) -> bool {
    i < D - F::ALGEBRAIC
}

/// The mass matrix: one where there is a derivative, zero at multipliers.
#[inline]
fn mass<F: FirstOrder<D>, const D: usize>(x: &[f64], _: &[f64], _: f64, beta: f64, y: &mut [f64]) {
    for (i, (x, y)) in x.iter().zip(y).enumerate() {
        *y = beta * *y + if differential::<F, D>(i) { *x } else { 0.0 };
    }
}

/// How much more loosely multipliers are held, and after how many steps the Jacobian is renewed: in trials
/// the cheapest choice for all errors. With its own fifty steps the crate's BDF gives up on `andrews` at
/// loose tolerances.
const LOOSER: f64 = 30.0;
const RENEWED: usize = 10;
/// The number of failures of Newton's iteration that a run survives.
const FAILURES: usize = 100_000;

/// A subject: its name, its method, its finest tolerance, and a mass matrix where there are multipliers.
macro_rules! method {
    ($start:ident, $t_end:ident, $name:literal, $method:ident $(::<$solver:ty>)?, $finest:expr $(, $mass:expr)?) => {
        subject($name, move |tolerance| {
            if tolerance < $finest {
                return Err(format!("not below {:e}", $finest));
            }
            let text = |error| format!("{error:?}");
            let mut problem = OdeBuilder::<NalgebraMat<f64>>::new()
                .rtol(tolerance)
                .atol((0..D).map(|i| if differential::<F, D>(i) { tolerance } else { LOOSER * tolerance }))
                .p([0.0])
                .rhs_implicit(field::<F, D>, directional::<F, D>)
                $(.mass($mass))?
                .init(move |_: &[f64], _, y: &mut [f64]| y.copy_from_slice(&$start), D)
                .build()
                .map_err(text)?;
            if F::ALGEBRAIC > 0 {
                problem.ode_options.update_rhs_jacobian_after_steps = RENEWED;
                problem.ode_options.max_nonlinear_solver_failures = FAILURES;
            }
            let mut solver = problem.$method$(::<$solver>)?().map_err(text)?;
            solver.set_stop_time($t_end).map_err(text)?;
            let mut steps = 1;
            while !matches!(solver.step().map_err(text)?, OdeSolverStopReason::TstopReached) {
                steps += 1;
            }
            let y = solver.state().y.inner().as_slice().try_into().expect("as many as at the start");
            Ok(Outcome { end: F::motion($t_end, y), steps })
        })
    };
}

/// Both methods on equations without multipliers.
pub fn subjects<F: FirstOrder<D>, const D: usize>(start: [f64; D], t_end: f64) -> Vec<Box<dyn Subject>> {
    vec![
        method!(start, t_end, "diffsol-tsit45", tsit45, 0.0),
        method!(start, t_end, "diffsol-bdf", bdf::<NalgebraLU<f64>>, FINEST_BDF),
    ]
}

/// BDF on equations with multipliers. It finds their values at the start itself.
pub fn multipliers<F: FirstOrder<D>, const D: usize>(start: [f64; D], t_end: f64) -> Box<dyn Subject> {
    method!(start, t_end, "diffsol-bdf-dae", bdf::<NalgebraLU<f64>>, 0.0, mass::<F, D>)
}
