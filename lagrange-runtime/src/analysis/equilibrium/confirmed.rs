//! Whether forces confirm a curvature.
//!
//! Where the potential is flatter than a parabola, Newton's method comes nearer to the equilibrium by a share
//! in each step, and never arrives. The curvature where it ends is what is left of that way: beside x³ it has
//! any sign. The forces tell, since they are linear beside an equilibrium with a curvature of its own, over
//! more than the distance that Newton's step still leaves. At distance x from the zero of the force of a
//! power xᵖ the step is x/(p − 1), and forces are linear over none that is as long as x.

use num_traits::Zero;

use super::curvature::Curvature;
use super::newton::Search;
use super::statics::{Rest, Statics, dot, length};
use crate::analysis::Tangent;
use crate::integrator::beside::{beside, ulps};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger};
use crate::system::state::State;

/// The points at which a distance is tried, in units of it.
const PLACES: [f64; 4] = [1.0, -1.0, 2.0, -2.0];

/// The points on one side at which forces are to grow.
const DOUBLED: [f64; 4] = [1.0, 2.0, 4.0, 8.0];

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// How many directions lead up, are flat, and lead down, where only what forces confirm leads anywhere.
    pub fn confirmed(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
        curvature: &Curvature<S::Scalar, N>,
    ) -> [usize; 3] {
        let count = rest.motions.count;
        let mut kept = [S::Scalar::zero(); N];
        for (k, kept) in kept.iter_mut().enumerate().take(count) {
            if self.is_confirmed(rest, search, curvature, k) {
                *kept = curvature.values[k];
            }
        }
        curvature.signature_of(&kept, count)
    }

    /// Whether forces are linear along one direction over some distance. Each is tried from twice Newton's
    /// step and the last digit of the coordinates on: near zero rounding errors hide forces further than any
    /// size of a coordinate tells.
    fn is_confirmed(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
        curvature: &Curvature<S::Scalar, N>,
        direction: usize,
    ) -> bool {
        let value = curvature.values[direction];
        let (number, slope) = (S::Scalar::from_f64, rest.unit * value);
        let vector = curvature.vectors[direction];
        let z = rest.motions.combined(&vector);
        if value.abs() <= curvature.rounding || slope.abs() <= self.blur(rest, &z) {
            return false;
        }
        let step = rest.length * (dot(&vector, &rest.forces) / value).abs();
        let ([place, _], here) = (self.along(rest, search, &z), dot(&z, &rest.left));
        let mut distance = larger(number(2.0) * step, S::Scalar::epsilon() * place);
        loop {
            let is_linear = PLACES.into_iter().all(|place| {
                let way = number(place) * distance;
                let bend = self.pull(rest, &z, way) - here + slope * way;
                bend.abs() <= (number(0.5) * slope * way).abs()
            });
            // Without any distance the curvature stands for itself.
            if is_linear || !(distance.is_positive() && distance.is_finite()) {
                return is_linear;
            }
            distance *= number(4.0);
        }
    }

    /// The uncertainty of the curvature along a direction by the last digits of the coordinates: a bound of
    /// 16 N times what an ulp of them changes, as for the magnitudes of its summands.
    fn blur(&self, rest: &Rest<S::Scalar, N, C>, z: &[S::Scalar; N]) -> S::Scalar {
        let here = State::at_rest(rest.q);
        let along = |q: &[S::Scalar; N]| {
            let by_q = self.variation(q, &rest.multipliers).by_q;
            dot(z, &by_q.each_ref().each(|row| -dot(row, z)))
        };
        let (share, value) = (S::Scalar::from_f64(16.0 * rest.motions.count as f64), along(&rest.q));
        let changes = beside(&here, &ulps(&here)).map(|there| (along(&there.q) - value).abs());
        share * changes.fold(S::Scalar::zero(), larger)
    }

    /// The place along a direction, and how far the search has reached in it. Other coordinates may be
    /// further from zero by any factor.
    fn along(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
        z: &[S::Scalar; N],
    ) -> [S::Scalar; 2] {
        let dual = array(|i| self.sizes[i] * z[i]);
        let [place, way] = [rest.q, self.travelled(rest, search)].map(|x| dot(&dual, &x).abs());
        [place, length(&[place, way])]
    }

    /// The force along a direction at a distance in it.
    fn pull(&self, rest: &Rest<S::Scalar, N, C>, z: &[S::Scalar; N], way: S::Scalar) -> S::Scalar {
        let q = array(|i| S::Scalar::mul_add(way, z[i], rest.q[i]));
        dot(&self.imbalance(&q, &rest.multipliers), z)
    }

    /// A position beyond a point of inflection, from which the energy falls on. Beside one that the search
    /// has come to, at distances that it does not resolve, forces lead away. They grow faster than the
    /// distance, which rounding errors do not where nothing holds the system.
    pub fn beyond(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
        curvature: &Curvature<S::Scalar, N>,
    ) -> Option<Rest<S::Scalar, N, C>> {
        for k in 0..rest.motions.count {
            if self.is_confirmed(rest, search, curvature, k) {
                continue;
            }
            let z = rest.motions.combined(&curvature.vectors[k]);
            let distance = S::Scalar::epsilon().sqrt() * self.along(rest, search, &z)[1];
            for side in [1.0, -1.0].map(S::Scalar::from_f64) {
                let ways = DOUBLED.map(|place| side * distance * S::Scalar::from_f64(place));
                let pulls = ways.map(|way| side * self.pull(rest, &z, way));
                let grow = pulls.iter().zip(&pulls[1..]).all(|(&near, &far)| far > near + near);
                if pulls[0].is_positive() && grow {
                    let q = array(|i| S::Scalar::mul_add(ways[3], z[i], rest.q[i]));
                    return self.feasible(q).ok().map(|q| self.rest(q));
                }
            }
        }
        None
    }
}
