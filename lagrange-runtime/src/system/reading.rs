//! The check that a description was read as Rust runs it: the macro's reading of a function, beside the value
//! that the function returns.
//!
//! The functions of a description stay ordinary functions. In builds with `debug_assertions` the first use of
//! a system evaluates each of them, and the macro's reading of it, at its start and at a second state where
//! nothing is zero. Other builds contain none of this.

use nalgebra::{
    Isometry, OPoint, Quaternion, Rotation, SMatrix, Translation, Unit, UnitComplex, UnitQuaternion,
};

use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::magnitude;
use crate::system::error::{Cause, Function, MotionError};
use crate::system::state::State;

/// The message about a function that was misread, after its name. Generated code names it where it compares,
/// so that builds without comparisons do not carry it.
pub const MISREAD: &str = "returns something else than what the macro read of it: a type, a constant, a trait or a macro in it \
    means something else here than usual, or an axis or a quaternion is not of unit length; mend that, or say \
    `allow(misread)` in the attribute if the function loses most of its digits by rounding";

/// A value that a function with a role can return, as numbers in a fixed order.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no value that a description is made of",
    note = "positions, poses and forces are numbers, arrays, tuples and types of the nalgebra that `lagrangian::nalgebra` is"
)]
pub trait Numbers<R> {
    /// Hands all numbers over: matrices column by column, rotations in the plane as cosine and sine,
    /// rotations in space as their entries row by row.
    fn each_number(&self, take: &mut dyn FnMut(R));
}

impl<R: Real> Numbers<R> for R {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        take(*self);
    }
}

impl<R, T: Numbers<R>> Numbers<R> for [T] {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.iter().for_each(|element| element.each_number(take));
    }
}

impl<R, T: Numbers<R>, const N: usize> Numbers<R> for [T; N] {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.as_slice().each_number(take);
    }
}

impl<R, A: Numbers<R>, B: Numbers<R>> Numbers<R> for (A, B) {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.0.each_number(take);
        self.1.each_number(take);
    }
}

impl<R: Real, const D: usize, const E: usize> Numbers<R> for SMatrix<R, D, E> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.iter().for_each(|&entry| take(entry));
    }
}

impl<R: Real, const D: usize> Numbers<R> for Unit<SMatrix<R, D, 1>> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.as_ref().each_number(take);
    }
}

impl<R: Real, const D: usize> Numbers<R> for OPoint<R, nalgebra::Const<D>> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.coords.each_number(take);
    }
}

impl<R: Real, const D: usize> Numbers<R> for Translation<R, D> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.vector.each_number(take);
    }
}

impl<R: Real> Numbers<R> for UnitComplex<R> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        take(self.as_ref().re);
        take(self.as_ref().im);
    }
}

impl<R: Real> Numbers<R> for Rotation<R, 2> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        let [[cos, sin], _] = self.matrix().data.0;
        take(cos);
        take(sin);
    }
}

impl<R: Real> Numbers<R> for Rotation<R, 3> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.matrix().transpose().each_number(take);
    }
}

impl<R: Real> Numbers<R> for UnitQuaternion<R> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        let quaternion: &Quaternion<R> = Unit::as_ref(self);
        let [[i, j, k, w]] = quaternion.coords.data.0;
        let (one, two) = (R::one(), R::from_f64(2.0));
        let columns = [
            [one - two * (j * j + k * k), two * (i * j - w * k), two * (i * k + w * j)],
            [two * (i * j + w * k), one - two * (i * i + k * k), two * (j * k - w * i)],
            [two * (i * k - w * j), two * (j * k + w * i), one - two * (i * i + j * j)],
        ];
        columns.each_number(take);
    }
}

impl<R: Real, T: Numbers<R>, const D: usize> Numbers<R> for Isometry<R, T, D> {
    fn each_number(&self, take: &mut dyn FnMut(R)) {
        self.translation.each_number(take);
        self.rotation.each_number(take);
    }
}

/// Compares the numbers that a function returns, by [`Numbers::each_number`], with the macro's reading of it,
/// number by number.
///
/// Terms that cancel between the components of a vector or of a rotation leave rounding errors of the size of
/// the others, so the largest size counts for all. `sizes` bound the terms that the numbers are added up
/// from, with the conditions of the functions that they went through (N. J. Higham, Accuracy and Stability of
/// Numerical Algorithms, 2002, section 3.3). Rounding errors are far below half of the digits of that, and an
/// evaluation that has lost more than half is worth a word too. Numbers that are not finite lie outside the
/// domain of the function and are not compared.
///
/// # Errors [`Cause::Misread`] with the function.
pub fn compare<R: Real>(
    function: Function,
    found: impl FnOnce(&mut dyn FnMut(R)),
    read: &[R],
    sizes: &[R],
) -> Result<(), Cause> {
    let size = sizes.iter().copied().fold(R::zero(), R::max);
    let least = R::epsilon().powi(4);
    let mut place = 0;
    let mut verdict = Ok(());
    found(&mut |found: R| {
        if let Some(&read) = read.get(place) {
            let off = (found - read).abs();
            // Numbers that underflow have errors of the smallest one.
            let allowed = R::epsilon().sqrt() * R::from_f64(2.0) * size + least;
            if off.is_finite() && allowed.is_finite() && (off - allowed).largest() > num_traits::Zero::zero()
            {
                verdict = Err(Cause::Misread { function, by: magnitude(off.largest()) });
            }
        }
        place += 1;
    });
    verdict
}

/// A state at which nothing is zero, within the scales of another.
fn beside<R: Real, const N: usize, const K: usize>(state: &State<R, N>, u: &[R; K]) -> (State<R, N>, [R; K]) {
    let mut count = 0_u32;
    let mut moved = |x: R| {
        // Multiples of the golden ratio are evenly spread.
        count += 1;
        let share = f64::from(count) * 0.618_033_988_749_894_9;
        x + R::from_f64(share - f64::from(share as u32)) * (R::one() + x.abs())
    };
    let (q, v, u) = (state.q.each(&mut moved), state.v.each(&mut moved), u.each(&mut moved));
    (State { t: moved(state.t), q, v }, u)
}

/// Compares all functions of a description at a state and at one beside it. Nothing is left of it without
/// `debug_assertions`.
///
/// # Errors
/// [`Cause::Misread`] with the first function that returns something else than what was read of it.
#[inline(always)]
pub fn check<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<(), Cause> {
    if S::READ {
        system.check_reading_at(state, u)?;
        let (state, u) = beside(state, u);
        system.check_reading_at(&state, &u)?;
    }
    Ok(())
}

/// The same with the time of the state.
///
/// # Errors
/// As [`check`].
#[inline(always)]
pub fn checked<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<(), MotionError<S::Scalar>> {
    check(system, state, u).map_err(|cause| MotionError { cause, t: state.t })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Isometry2, Isometry3, Rotation2, Rotation3, Vector2, Vector3};

    fn numbers(value: &impl Numbers<f64>) -> [f64; 16] {
        let (mut all, mut place) = ([0.0; 16], 0);
        value.each_number(&mut |x| {
            all[place] = x;
            place += 1;
        });
        all
    }

    #[test]
    fn rotations_of_all_types_give_the_same_numbers() {
        let (axis, angle) = (Vector3::y_axis(), 0.7);
        let rotation = Rotation3::from_axis_angle(&axis, angle);
        let quaternion = UnitQuaternion::from_axis_angle(&axis, angle);
        let (a, b) = (numbers(&rotation), numbers(&quaternion));
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?} {b:?}");
        // Row by row: the sine stands at the right of the first row.
        assert!((a[2] - angle.sin()).abs() < 1e-15);
        let plane = [numbers(&Rotation2::new(angle)), numbers(&UnitComplex::new(angle))];
        assert!((plane[0][1] - angle.sin()).abs() < 1e-15 && (plane[1][1] - angle.sin()).abs() < 1e-15);
        let pose = numbers(&Isometry2::new(Vector2::new(3.0, 4.0), angle));
        assert_eq!(pose[..2], [3.0, 4.0]);
        let pose = numbers(&Isometry3::new(Vector3::new(3.0, 4.0, 5.0), axis.into_inner() * angle));
        assert!((pose[3] - angle.cos()).abs() < 1e-15 && (pose[5] - angle.sin()).abs() < 1e-15);
    }

    #[test]
    fn a_number_that_is_off_is_named() {
        const NAME: Function = Function(&["height", MISREAD]);
        assert_eq!(
            compare(NAME, |take| [1.0, 2.0].each_number(take), &[1.0, 2.0 + 1e-12], &[1.0, 2.0]),
            Ok(())
        );
        let wrong = compare(NAME, |take| [1.0, 2.0].each_number(take), &[1.0, 2.001], &[1.0, 2.0]);
        assert!(matches!(wrong, Err(Cause::Misread { function: NAME, .. })), "{wrong:?}");
        assert!(std::format!("{}", wrong.unwrap_err()).starts_with("`height` returns something else than"));
        // Terms that cancel leave rounding errors.
        assert_eq!(compare(NAME, |take| 1e-16.each_number(take), &[0.0], &[1.0]), Ok(()));
        assert!(compare(NAME, |take| 1e-7.each_number(take), &[0.0], &[1.0]).is_err());
        // Singles have half as many digits.
        assert_eq!(compare(NAME, |take| 1.0_f32.each_number(take), &[1.0 + 1e-5], &[1.0]), Ok(()));
        assert!(compare(NAME, |take| 1.0_f32.each_number(take), &[1.01], &[1.0]).is_err());
        // Outside the domain there is nothing to compare.
        assert_eq!(compare(NAME, |take| f64::NAN.each_number(take), &[1.0], &[1.0]), Ok(()));
        assert_eq!(compare(NAME, |take| 1.0.each_number(take), &[2.0], &[f64::INFINITY]), Ok(()));
    }

    #[test]
    fn nothing_is_zero_beside_a_state_at_rest() {
        let (state, u) = beside(&State::new([0.0, 1e8], [0.0; 2]), &[0.0]);
        let all = state.q.iter().chain(&state.v).chain(&u).chain([&state.t]);
        assert!(all.clone().all(|x: &f64| *x > 0.0), "{state:?} {u:?}");
        assert!(state.q[1] > 1e8 && state.q[1] < 2e8 + 2.0);
    }
}
