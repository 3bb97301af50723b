//! The branch of the constraints that a position is on.

use num_traits::{One, Zero};

use super::statics::{Statics, dot};
use crate::analysis::Tangent;
use crate::constraints::Metric;
use crate::linear::stored::Stored;
use crate::linear::{Saddle, SaddlePoint};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};

/// The constraints at a position.
pub(super) struct Branch<R, const N: usize, const C: usize> {
    gradients: Stored<[[R; N]; C]>,
    /// The shortest displacements that change one constraint each by one; none where constraints depend on
    /// each other.
    across: Option<Stored<[[R; N]; C]>>,
    /// The sizes of the gradients.
    slopes: [R; C],
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// The branch of a position on the constraints.
    #[inline(never)]
    pub fn branch(&self, gradients: &[[S::Scalar; N]; C]) -> Branch<S::Scalar, N, C> {
        let gradients = Self::holonomic(Stored::new(*gradients));
        let saddle = Stored::new(Saddle::factor(&self.metric, &gradients));
        let slopes = Metric::of(&*saddle).slopes(&*gradients);
        let across = (saddle.rank() == C && S::HOLONOMIC.iter().all(|own| *own)).then(|| {
            let mut across = Stored::<[[S::Scalar; N]; C]>::zeros();
            for (k, across) in across.iter_mut().enumerate() {
                let one = array(|i| if i == k { S::Scalar::one() } else { S::Scalar::zero() });
                *across = saddle.solve(&[S::Scalar::zero(); N], &one).0;
            }
            across
        });
        Branch { gradients, across, slopes }
    }

    /// Whether gradients at the next position have changed by less than what they are at this one, as far as
    /// that can be told.
    #[inline(never)]
    pub fn leads_to(&self, branch: &Branch<S::Scalar, N, C>, next: &[[S::Scalar; N]; C]) -> bool {
        let Some(across) = &branch.across else { return true };
        next.iter().zip(branch.gradients.iter()).zip(branch.slopes).all(|((there, here), own)| {
            let change = array(|i| there[i] - here[i]);
            let columns = across.iter().zip(branch.slopes);
            let sum = columns.fold(S::Scalar::zero(), |sum, (across, slope)| {
                sum + (dot(&change, across) * slope / own).abs()
            });
            sum < S::Scalar::one()
        })
    }
}
