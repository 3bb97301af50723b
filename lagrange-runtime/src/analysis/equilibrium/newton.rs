//! Levenberg–Marquardt steps to a place where forces vanish, whatever its stability, and the judgement of
//! such a place.
//!
//! With the multipliers of least squares the derivative of the forces along the constraints is exactly Zᵀ
//! (∂r/∂q) Z, so that the steps converge quadratically, also to equilibria that are not isolated (N.
//! Yamashita, M. Fukushima, Computing Suppl. 15 (2001) 239).

use super::statics::{Rest, Statics};
use crate::analysis::Tangent;
use crate::linear::SingularValues;
use crate::number::real::{Ordered, Real, larger, smaller};

/// Steps before the search is given up.
const STEPS: usize = 200;

/// Damping, relative to the largest singular value squared: at the start, and what is too much.
const DAMPING: (f64, f64) = (1e-3, 1e12);

/// A search so far: where it began, what it met, and whether its steps become shorter.
#[derive(Clone, Copy)]
pub(super) struct Search<R, const N: usize> {
    /// Coordinates of the start.
    pub start: [R; N],
    /// The size of the forces at the start.
    pub first: R,
    /// The largest size of forces.
    pub met: R,
    /// The largest singular value of the stiffness.
    pub stiffest: R,
    /// Lengths of the steps taken: their sum, the last one, and their number.
    path: [R; 3],
}

impl<R: Ordered, const N: usize> Search<R, N> {
    pub fn new<const C: usize>(rest: &Rest<R, N, C>) -> Self {
        let zero = R::zero();
        Self { start: rest.q, first: rest.norm, met: rest.norm, stiffest: zero, path: [zero; 3] }
    }

    /// Takes note of a step of this length.
    pub fn stepped<const C: usize>(&mut self, length: R, next: &Rest<R, N, C>) {
        let [sum, _, count] = self.path;
        self.path = [sum + length, length, count + R::one()];
        self.met = larger(self.met, next.norm);
    }

    /// Whether the way grows with the number n of steps like a power of it: as n^p, the last of them is p/n
    /// of the way, and that of a search that converges far less. The force of a Gaussian bump drives
    /// Newton's method out as √n.
    pub fn goes_on(&self) -> bool {
        let [sum, last, count] = self.path;
        count > R::one() && R::from_f64(8.0) * last * count >= sum
    }
}

/// What is known of a place.
pub(super) struct Verdict<R> {
    /// Whether what is left of the forces is rounding.
    pub is_balanced: bool,
    /// Whether the steps of Newton's method end near.
    pub ends: bool,
    /// Whether the stiffness is regular.
    pub is_isolated: bool,
    /// What is left of the stiffness as a share of the largest.
    pub stiffness: R,
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Goes to a place where the forces vanish, as near as it comes.
    pub fn balance(
        &self,
        mut rest: Rest<S::Scalar, N, C>,
        search: &mut Search<S::Scalar, N>,
    ) -> Rest<S::Scalar, N, C> {
        let number = S::Scalar::from_f64;
        let zero = number(0.0);
        let mut damping = number(DAMPING.0);
        let mut values = SingularValues::new(&rest.stiffness.rows);
        for _ in 0..STEPS {
            let largest = values.largest_square();
            search.stiffest = larger(search.stiffest, rest.unit * largest.sqrt());
            if rest.norm == zero || largest == zero {
                return rest;
            }
            loop {
                let change = self.displacement(&rest, &values, damping * largest);
                let moved = core::array::from_fn(|i| rest.q[i] + change[i]);
                let next = self.feasible(moved).ok().map(|q| self.rest(q));
                if let Some(next) = next.filter(|next| next.norm < rest.norm) {
                    let way: [S::Scalar; N] = core::array::from_fn(|i| next.q[i] - rest.q[i]);
                    search.stepped(self.size(&way).sqrt(), &next);
                    // Quadratic convergence needs a damping that vanishes with the forces.
                    let share = next.norm / search.met;
                    damping = smaller(damping * number(0.1), share * share);
                    rest = next;
                    values = SingularValues::new(&rest.stiffness.rows);
                    break;
                }
                damping = larger(damping * number(8.0), number(1e-6));
                if damping > number(DAMPING.1) {
                    return rest;
                }
            }
        }
        rest
    }

    /// The change of coordinates by a step.
    fn displacement(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        values: &SingularValues<S::Scalar, N>,
        damping: S::Scalar,
    ) -> [S::Scalar; N] {
        self.allowed(rest).combined(&values.solve(&rest.forces, damping))
    }

    /// Judges where a search has ended.
    pub fn judged(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> Verdict<S::Scalar> {
        let number = S::Scalar::from_f64;
        let values = SingularValues::new(&rest.stiffness.rows);
        let largest = values.largest_square();
        let (step, remainder) =
            (self.size(&self.displacement(rest, &values, number(0.0))), values.remainder(&rest.forces));
        let (epsilon, reach) = (S::Scalar::epsilon(), self.reach(rest, search));
        // What a step leaves of the forces, because nothing stiff is in their way, must be rounding of those
        // in balance.
        let is_rounding = remainder <= epsilon * epsilon.sqrt() * largest * reach;
        // Forces that fade on the way to infinity are small there, too, but the way does not end.
        let ends = step <= number(1e-6) * reach;
        let is_small = rest.norm <= epsilon.sqrt() * search.met || step <= epsilon * reach;
        // Where the stiffness vanishes, Newton's step does not.
        let here = rest.unit * largest.sqrt();
        let stiffest = larger(search.stiffest, here);
        let stiffness = if stiffest > number(0.0) { here / stiffest } else { number(1.0) };
        let free = rest.motions.count.max(self.allowed(rest).count);
        // In units of the place, what is no rounding of the stiffest.
        let least = epsilon * (largest / (stiffness * stiffness));
        let is_isolated = values.rank(least) == free && step <= epsilon * reach;
        Verdict { is_balanced: is_rounding && ends && is_small, ends, is_isolated, stiffness }
    }

    /// The squared size of the coordinates and of the way so far.
    pub fn reach(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> S::Scalar {
        self.size(&rest.q) + self.size(&self.travelled(rest, search))
    }

    /// The way from the start.
    pub fn travelled(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> [S::Scalar; N] {
        core::array::from_fn(|i| rest.q[i] - search.start[i])
    }
}
