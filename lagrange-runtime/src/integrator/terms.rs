//! The polynomial of a step, for what looks at functions along it.

use crate::real::Real;
use crate::state::State;

/// The polynomial of a step.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'a, R, const N: usize> {
    /// Terms of the coordinates, from the first order on, in a unit of time of the method.
    pub q: &'a [[R; N]],
    /// Those of the velocities.
    pub v: &'a [[R; N]],
    /// The length of the step in that unit.
    pub length: R,
    /// The unit \[s].
    pub unit: R,
    /// What rounding took from the time of the start \[s].
    pub residue: R,
}

impl<R: Real, const N: usize> Terms<'_, R, N> {
    /// Σ |summands| of the state after a part of the step, which bound its roundings.
    pub(crate) fn sizes(&self, start: &State<R, N>, part: R) -> State<R, N> {
        let theta = (part * self.length).abs();
        let sums = |numbers: &[R; N], rows: &[[R; N]]| {
            let gains = rows.iter().rev().fold([R::zero(); N], |sums, row| {
                core::array::from_fn(|i| R::mul_add(sums[i], theta, row[i].abs()))
            });
            core::array::from_fn(|i| R::mul_add(gains[i], theta, numbers[i].abs()))
        };
        let t = start.t.abs() + (theta * self.unit).abs();
        State { t, q: sums(&start.q, self.q), v: sums(&start.v, self.v) }
    }
}
