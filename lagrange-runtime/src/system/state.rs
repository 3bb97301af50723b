//! [`State`]: a time, the coordinates and their velocities.

use nalgebra::SVector;

use crate::number::elements::array;
use crate::number::real::Real;

/// Where a system of `N` coordinates is, and how fast it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<R, const N: usize> {
    /// Time \[s].
    pub t: R,
    /// Generalized coordinates, each in its own unit.
    pub q: [R; N],
    /// Generalized velocities, dq/dt, in the units of `q` per second.
    pub v: [R; N],
}

/// Anything that converts into the numbers of a state.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not convert into the numbers of a state",
    label = "not the numbers of a state",
    note = "use an array, a vector, or the coordinates or velocities by name",
    note = "where a coordinate is an orientation or a pose, a state holds other numbers than velocities by name: write \
            `system.state(coordinates, velocities)`"
)]
pub trait StateNumbers<R, const N: usize> {
    /// The numbers.
    fn numbers(self) -> [R; N];
}

#[diagnostic::do_not_recommend]
impl<R, T: Into<[R; N]>, const N: usize> StateNumbers<R, N> for T {
    #[inline]
    fn numbers(self) -> [R; N] {
        self.into()
    }
}

impl<R: Real, const N: usize> State<R, N> {
    /// Coordinates and velocities at time zero: arrays, vectors or the named coordinates of a system.
    #[inline]
    #[must_use]
    pub fn new(q: impl StateNumbers<R, N>, v: impl StateNumbers<R, N>) -> Self {
        Self { t: R::zero(), q: q.numbers(), v: v.numbers() }
    }

    /// Coordinates without any velocity, at time zero.
    #[inline]
    #[must_use]
    pub fn at_rest(q: impl StateNumbers<R, N>) -> Self {
        Self::new(q, [R::zero(); N])
    }

    /// The same coordinates and velocities at time `t`.
    #[inline]
    #[must_use]
    pub fn at_time(self, t: R) -> Self {
        Self { t, ..self }
    }

    /// The coordinates as a column.
    #[inline]
    #[must_use]
    pub fn coordinates(&self) -> SVector<R, N> {
        self.q.into()
    }

    /// The velocities as a column.
    #[inline]
    #[must_use]
    pub fn velocities(&self) -> SVector<R, N> {
        self.v.into()
    }

    /// The 2`N` numbers (q, v), coordinates first.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = R> + '_ {
        self.q.iter().chain(&self.v).copied()
    }

    /// Whether time, coordinates and velocities are all finite.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.t.is_finite() && self.iter().all(R::is_finite)
    }
}

impl<R: Real, const N: usize> From<[R; N]> for State<R, N> {
    /// At rest, at time zero.
    #[inline]
    fn from(q: [R; N]) -> Self {
        Self::at_rest(q)
    }
}

/// a − b, of coordinates or of velocities.
pub(crate) fn difference<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> [R; N] {
    array(|i| a[i] - b[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_take_the_scalar_of_the_state() {
        let state: State<f32, 2> = State::at_rest([1.0, 2.0]).at_time(3.0);
        assert_eq!(state, State { t: 3.0, q: [1.0, 2.0], v: [0.0, 0.0] });
    }

    #[test]
    fn coordinates_come_before_velocities() {
        let state = State::<f64, 2>::new(SVector::from([1.0, 2.0]), [3.0, 4.0]);
        assert!(state.iter().eq([1.0, 2.0, 3.0, 4.0]));
        assert_eq!(state.velocities(), SVector::from([3.0, 4.0]));
    }

    #[test]
    fn one_bad_number_makes_a_state_not_finite() {
        let good = State::<f64, 1>::new([1.0], [2.0]);
        assert!(good.is_finite());
        assert!(!good.at_time(f64::NAN).is_finite());
        assert!(!State { v: [f64::INFINITY], ..good }.is_finite());
    }
}
