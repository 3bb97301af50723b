//! The crate `diffsol` on its nalgebra back end: Tsitouras 5(4) and BDF.

use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, VectorCommon};

use super::{Outcome, Subject, slope, subject};
use crate::systems::dual::Dual;
use crate::systems::hand::ByHand;

/// BDF does not converge below.
const FINEST_BDF: f64 = 1e-13;

/// dy/dt.
#[inline]
fn field<H: ByHand<N>, const N: usize, const D: usize>(y: &[f64], _: &[f64], t: f64, dy: &mut [f64]) {
    if let (Ok(y), Ok(dy)) = (y.try_into(), dy.try_into()) {
        slope::<H, f64, N, D>(t, y, dy);
    }
}

/// The derivative of dy/dt in a direction.
#[inline]
fn directional<H: ByHand<N>, const N: usize, const D: usize>(
    y: &[f64],
    _: &[f64],
    t: f64,
    direction: &[f64],
    out: &mut [f64],
) {
    let y: [Dual; D] = std::array::from_fn(|i| Dual { value: y[i], slope: direction[i] });
    let mut dy = [Dual::default(); D];
    slope::<H, Dual, N, D>(t, &y, &mut dy);
    for (out, dy) in out.iter_mut().zip(dy) {
        *out = dy.slope;
    }
}

/// Both methods.
pub fn subjects<H: ByHand<N>, const N: usize, const D: usize>(
    start: [f64; D],
    t_end: f64,
) -> Vec<Box<dyn Subject>> {
    macro_rules! method {
        ($name:literal, $method:ident $(::<$solver:ty>)?, $finest:expr) => {
            subject($name, move |tolerance| {
                if tolerance < $finest {
                    return Err(format!("not below {:e}", $finest));
                }
                let text = |error| format!("{error:?}");
                let problem = OdeBuilder::<NalgebraMat<f64>>::new()
                    .rtol(tolerance)
                    .atol([tolerance])
                    .p([0.0])
                    .rhs_implicit(field::<H, N, D>, directional::<H, N, D>)
                    .init(move |_: &[f64], _, y: &mut [f64]| y.copy_from_slice(&start), D)
                    .build()
                    .map_err(text)?;
                let mut solver = problem.$method$(::<$solver>)?().map_err(text)?;
                solver.set_stop_time(t_end).map_err(text)?;
                let mut steps = 1;
                while !matches!(solver.step().map_err(text)?, OdeSolverStopReason::TstopReached) {
                    steps += 1;
                }
                Ok(Outcome { end: solver.state().y.inner().as_slice().to_vec(), steps })
            })
        };
    }
    vec![method!("diffsol-tsit45", tsit45, 0.0), method!("diffsol-bdf", bdf::<NalgebraLU<f64>>, FINEST_BDF)]
}
