//! Levenberg–Marquardt steps to a position where forces vanish, whatever its stability, and the judgement of
//! such a position.
//!
//! With the multipliers of least squares the derivative of the forces along the constraints is exactly Zᵀ
//! (∂r/∂q) Z. So the steps converge quadratically, also to equilibria that are not isolated (N. Yamashita, M.
//! Fukushima, Computing Suppl. 15 (2001) 239).

use super::statics::{Rest, Statics, dot, length};
use crate::analysis::Tangent;
use crate::linear::SingularValues;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::attitude;
use crate::system::state::State;

/// The most steps of a search.
const STEPS: usize = 200;

/// The damping at the start, and the largest one, relative to the largest singular value squared.
const DAMPING: (f64, f64) = (1e-3, 1e12);

/// The ratio of successive steps of Newton's method up to which it counts as convergent. Where Kantorovich's
/// theorem just holds the ratio is a half.
const CONTRACTS: f64 = 0.25;

/// The ratio up to which two rounding errors of forces are alike.
const ALIKE: f64 = 16.0;

/// A search so far: its start, the forces on its way, and the lengths of its steps.
#[derive(Clone, Copy)]
pub(super) struct Search<R, const N: usize> {
    /// Coordinates of the start.
    pub start: [R; N],
    /// The size of the forces at the start.
    pub first: R,
    /// The largest size of the forces so far.
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

    /// Records a step of this length.
    pub fn stepped<const C: usize>(&mut self, length: R, next: &Rest<R, N, C>) {
        let [sum, _, count] = self.path;
        self.path = [sum + length, length, count + R::one()];
        self.met = larger(self.met, next.norm);
    }

    /// Whether the distance grows like a power n^p of the number n of steps. Then the last step is p/n of the
    /// distance, while that of a convergent search is far less. The force of a Gaussian bump drives Newton's
    /// method out as √n.
    pub fn goes_on(&self) -> bool {
        let [sum, last, count] = self.path;
        count > R::one() && R::from_f64(8.0) * last * count >= sum
    }
}

/// The judgement of a position.
pub(super) struct Verdict<R> {
    /// Whether the remaining forces are rounding errors.
    pub is_balanced: bool,
    /// Whether the steps of Newton's method end nearby.
    pub ends: bool,
    /// Whether the stiffness is regular.
    pub is_isolated: bool,
    /// The stiffness as a share of the largest one of the search.
    pub stiffness: R,
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Goes to a position where the forces vanish, or as near as it comes.
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
            let mut is_newton_tried = false;
            let next = loop {
                let change = self.displacement(&rest, &values, damping * largest);
                let moved = array(|i| rest.q[i] + change[i]);
                let next = self.feasible(moved).ok().map(|q| self.rest(q));
                if let Some(next) = next.filter(|next| next.norm < rest.norm) {
                    break next;
                }
                if !core::mem::replace(&mut is_newton_tried, true)
                    && let Some(next) = self.contracted(&rest, &values)
                {
                    break next;
                }
                damping = larger(damping * number(8.0), number(1e-6));
                if damping > number(DAMPING.1) {
                    return rest;
                }
            };
            let way: [S::Scalar; N] = array(|i| next.q[i] - rest.q[i]);
            search.stepped(self.length(&way), &next);
            let next = self.turned_back(next, search);
            // Quadratic convergence needs a damping that vanishes with the forces.
            let share = next.norm / search.met;
            damping = smaller(damping * number(0.1), share * share);
            rest = next;
            values = SingularValues::new(&rest.stiffness.rows);
        }
        rest
    }

    /// The step of the coordinates with a damping.
    fn displacement(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        values: &SingularValues<S::Scalar, N>,
        damping: S::Scalar,
    ) -> [S::Scalar; N] {
        let change = self.allowed(rest).combined(&values.solve(&rest.forces, damping));
        change.each(|x| rest.length * x)
    }

    /// The end of Newton's step, if the next step is much shorter. Forces need not become smaller: a step
    /// along a curved valley meets a stiff force that the next one removes.
    #[inline(never)]
    fn contracted(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        values: &SingularValues<S::Scalar, N>,
    ) -> Option<Rest<S::Scalar, N, C>> {
        let change = self.displacement(rest, values, S::Scalar::from_f64(0.0));
        let next = self.rest(self.feasible(array(|i| rest.q[i] + change[i])).ok()?);
        let values = SingularValues::new(&next.stiffness.rows);
        let again = self.displacement(&next, &values, S::Scalar::from_f64(0.0));
        let is_much_shorter = self.length(&again) <= S::Scalar::from_f64(CONTRACTS) * self.length(&change);
        is_much_shorter.then_some(next)
    }

    /// The same position by orientations of less than a whole turn. Near a whole one a small turn changes a
    /// triple by any amount, and beyond it curvatures have no digits.
    pub fn turned_back(
        &self,
        rest: Rest<S::Scalar, N, C>,
        search: &mut Search<S::Scalar, N>,
    ) -> Rest<S::Scalar, N, C> {
        let Some(State { q, .. }) = attitude::settle(S::ORIENTATIONS, &State::at_rest(rest.q)) else {
            return rest;
        };
        search.start = array(|i| search.start[i] + (q[i] - rest.q[i]));
        self.rest(q)
    }

    /// Judges the position where a search has ended.
    pub fn judged(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> Verdict<S::Scalar> {
        let number = S::Scalar::from_f64;
        let values = SingularValues::new(&rest.stiffness.rows);
        let largest = values.largest_square();
        let change = self.displacement(rest, &values, number(0.0));
        let step = self.length(&change);
        let remainder = rest.length * values.remainder(&rest.forces).sqrt();
        let (epsilon, reach) = (S::Scalar::epsilon(), self.reach(rest, search));
        // Forces that a step does not remove, because no stiffness acts against them, must be rounding errors
        // of the balanced forces.
        let is_rounding = remainder <= (epsilon * epsilon.sqrt()).sqrt() * largest.sqrt() * reach;
        // Forces that fade towards infinity become small, too, but the steps do not end there.
        let ends = step <= number(1e-3) * reach;
        // Nor are forces small compared with stiff ones on the way, if one more step removes most of them.
        let is_short = step <= epsilon.sqrt() * reach;
        let is_small =
            is_short || rest.norm <= epsilon.sqrt() * search.met && self.contracted(rest, &values).is_none();
        // Where the stiffness vanishes, Newton's step does not.
        let here = rest.unit * largest.sqrt();
        let stiffest = larger(search.stiffest, here);
        let stiffness = if stiffest > number(0.0) { here / stiffest } else { number(1.0) };
        let free = rest.motions.count.max(self.allowed(rest).count);
        // The square of the least stiffness that counts: √ε of the largest one of the search, in units of the
        // position.
        let least = epsilon * (largest / (stiffness * stiffness));
        let is_regular = values.rank(least) == free;
        if is_rounding && ends && is_small {
            let is_isolated = is_regular && is_short;
            return Verdict { is_balanced: true, ends, is_isolated, stiffness };
        }
        let are_errors = self.leaves_errors(rest, &values, &change);
        let ends = ends || are_errors;
        Verdict { is_balanced: are_errors, ends, is_isolated: are_errors && is_regular, stiffness }
    }

    /// Whether Newton's method would leave the forces of a start, which are rounding errors.
    pub fn starts_balanced(&self, rest: &Rest<S::Scalar, N, C>) -> bool {
        let values = SingularValues::new(&rest.stiffness.rows);
        let change = self.displacement(rest, &values, S::Scalar::from_f64(0.0));
        self.leaves_errors(rest, &values, &change)
    }

    /// Whether the forces that a step would remove are rounding errors, and the others no larger.
    fn leaves_errors(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        values: &SingularValues<S::Scalar, N>,
        change: &[S::Scalar; N],
    ) -> bool {
        let all = dot(&rest.forces, &rest.forces);
        let left = values.remainder(&rest.forces);
        left <= S::Scalar::from_f64(ALIKE * ALIKE) * (all - left) && self.are_errors(rest, change)
    }

    /// The size of the coordinates and of the distance so far.
    pub fn reach(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> S::Scalar {
        length(&[self.length(&rest.q), self.length(&self.travelled(rest, search))])
    }

    /// The distance from the start, as a vector.
    pub fn travelled(&self, rest: &Rest<S::Scalar, N, C>, search: &Search<S::Scalar, N>) -> [S::Scalar; N] {
        array(|i| rest.q[i] - search.start[i])
    }
}
