//! The inverse of a mass matrix that is not formed, by the recursion that solves with it.
//!
//! A recursion is a chain of operations that wait for each other. For all unit loads side by side it runs on
//! vectors. A solution is then a product, in which no operation waits for another.

use crate::number::real::Real;

/// One step of a recursion: an unknown and the others that it is made from.
#[derive(Clone, Copy, Debug)]
pub struct RecursionStep {
    /// The index of the unknown: of the velocities in their order, then of the values between them.
    pub place: usize,
    /// The indices of the others; each has a factor.
    pub others: &'static [usize],
}

/// The inverse of a symmetric positive definite matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inverse<R, const N: usize> {
    /// Rows; the matrix is symmetric.
    rows: [[R; N]; N],
}

/// `target` + `factor` · `row`.
#[inline(always)]
fn add<R: Real, const N: usize>(target: &mut [R; N], factor: R, row: &[R; N]) {
    for (target, &x) in target.iter_mut().zip(row) {
        *target = R::mul_add(factor, x, *target);
    }
}

impl<R: Real, const N: usize> Inverse<R, N> {
    /// Runs a recursion with `W` values between the velocities. The factors of a velocity are 1 / pivot and
    /// those of the others; a value between velocities has those of the others alone.
    #[inline]
    #[must_use]
    pub fn of<const W: usize>(steps: &[RecursionStep], factors: &[R]) -> Self {
        let mut rows = [[R::zero(); N]; N];
        for (i, row) in rows.iter_mut().enumerate() {
            row[i] = R::one();
        }
        let mut between = [[R::zero(); N]; W];
        let mut forward = factors.iter().copied();
        let mut next = || forward.next().unwrap_or_else(R::zero);
        for step in steps {
            let is_velocity = step.place < N;
            let own = if is_velocity { &mut rows[step.place] } else { &mut between[step.place - N] };
            let load = *own;
            if is_velocity {
                let inverse = next();
                own.iter_mut().for_each(|x| *x *= inverse);
            } else {
                // The slot is free for another value.
                *own = [R::zero(); N];
            }
            for &other in step.others {
                let target = if other < N { &mut rows[other] } else { &mut between[other - N] };
                let factor = next();
                add(target, if is_velocity { -factor } else { factor }, &load);
            }
        }
        let mut backward = factors.iter().rev().copied();
        let mut next = || backward.next().unwrap_or_else(R::zero);
        for step in steps.iter().rev() {
            let is_velocity = step.place < N;
            let mut value = if is_velocity { rows[step.place] } else { [R::zero(); N] };
            for &other in step.others.iter().rev() {
                let factor = next();
                let row = if other < N { &rows[other] } else { &between[other - N] };
                add(&mut value, if is_velocity { -factor } else { factor }, row);
            }
            if is_velocity {
                let _ = next();
                rows[step.place] = value;
            } else {
                between[step.place - N] = value;
            }
        }
        Self { rows }
    }

    /// x with M x = `right`.
    #[inline]
    #[must_use]
    pub fn solve(&self, right: [R; N]) -> [R; N] {
        let mut x = [R::zero(); N];
        for (row, right) in self.rows.iter().zip(right) {
            add(&mut x, right, row);
        }
        x
    }

    /// Whether all entries on the diagonal are finite. Where the matrix is singular, some are not.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        (0..N).all(|i| self.rows[i][i].is_finite())
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;
    use crate::linear::Ldlt;

    /// A chain of three unit links at angles 0.3, 1.0 and −0.7, from its free end.
    const STEPS: [RecursionStep; 7] = [
        RecursionStep { place: 2, others: &[3, 4] },
        RecursionStep { place: 3, others: &[1, 5] },
        RecursionStep { place: 4, others: &[1, 6] },
        RecursionStep { place: 1, others: &[5, 6] },
        RecursionStep { place: 5, others: &[0] },
        RecursionStep { place: 6, others: &[0] },
        RecursionStep { place: 0, others: &[] },
    ];

    #[test]
    fn a_recursion_on_unit_loads_is_the_inverse() {
        let (c, s) = ([0.3_f64, 1.0, -0.7].map(f64::cos), [0.3_f64, 1.0, -0.7].map(f64::sin));
        let mut factors = Vec::new();
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for i in (0..3).rev() {
            (xx, yy) = (xx + 1.0, yy + 1.0);
            let u = [xx * c[i] + xy * s[i], xy * c[i] + yy * s[i]];
            let inverse = 1.0 / (c[i] * u[0] + s[i] * u[1]);
            let l = u.map(|u| u * inverse);
            (xx, xy, yy) = (xx - u[0] * l[0], xy - u[0] * l[1], yy - u[1] * l[1]);
            factors.push(inverse);
            if i > 0 {
                factors.extend(l);
            }
            match i {
                2 => factors.extend([c[1], 1.0, s[1], 1.0]),
                1 => factors.extend([c[0], s[0]]),
                _ => {}
            }
        }
        let inverse = Inverse::<f64, 3>::of::<4>(&STEPS, &factors);
        let mass = core::array::from_fn(|i: usize| {
            core::array::from_fn(|j: usize| (3 - i.max(j)) as f64 * (c[i] * c[j] + s[i] * s[j]))
        });
        let dense = Ldlt::<f64, 3>::factor(mass).unwrap();
        for right in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, -2.0, 1.1]] {
            for (a, b) in inverse.solve(right).into_iter().zip(dense.solve(right)) {
                assert!((a - b).abs() < 1e-14, "{a} {b}");
            }
        }
        assert!(inverse.is_finite());
        factors[0] = f64::NAN;
        assert!(!Inverse::<f64, 3>::of::<4>(&STEPS, &factors).is_finite());
    }
}
