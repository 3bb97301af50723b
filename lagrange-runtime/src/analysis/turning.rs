//! Constraints whose gradients turn with time.
//!
//! Beside a state at rest the motions A(t) δq = 0 are those of one space only as long as that space stands
//! still. Where it turns, small deviations are carried along: they get the velocities E ξ with E = −A⁺
//! (∂A/∂t) Z, and centrifugal forces Eᵀ M E ξ that are in no stiffness. Linear equations of this moment have
//! other coefficients in the next one, and their eigenvalues tell nothing.
//!
//! A change of A that lies in the rows of A themselves, as that of g(t) f(q), turns nothing.

use num_traits::Zero;

use super::response::Factored;
use super::{Place, Tangent, Variation};
use crate::constraints::Metric;
use crate::linear::stored::Stored;
use crate::linear::{Saddle, SaddlePoint, TangentSpace};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger};
use crate::system::error::{Cause, MotionError};
use crate::system::name::Name;
use crate::system::state::State;

/// What a turn is measured by.
pub(super) struct Frame<'a, R, const N: usize, const C: usize> {
    /// The factors of a metric and of all gradients.
    pub saddle: &'a Saddle<R, N, C>,
    /// Squares of the sizes of the coordinates.
    pub sizes: &'a [R; N],
    /// Displacements that the holonomic constraints allow, of unit size.
    pub displacements: &'a [[R; N]],
    /// Velocities that all constraints allow, of unit size.
    pub velocities: &'a [[R; N]],
    /// The square of a rate \[1/s²] that is lost in the rounding errors of the stiffness.
    pub least: R,
}

/// The constraint whose gradient turns fastest at a position, by its explicit dependence on time.
///
/// There A a − γ of a constraint on coordinates is vᵀ(∂²f/∂q²)v + 2 (∂A/∂t) v + ∂²f/∂t² beside A a, and of
/// one on velocities (∂B/∂t) v + (∂g/∂q) v + ∂b/∂t with g = B v + b. So its derivatives at rest without
/// accelerations are what is asked for, and also tell whether a gradient that stands still at this moment
/// begins to turn.
pub(super) fn turning<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    (t, q, u): (S::Scalar, &[S::Scalar; N], &[S::Scalar; K]),
    frame: &Frame<'_, S::Scalar, N, C>,
) -> Option<usize>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let (still, none) = ([S::Scalar::zero(); N], [S::Scalar::zero(); C]);
    let place = Place { t, q, v: &still, a: &still, multipliers: &none, u };
    let variation = system.variation_at(constants, &place);
    let Variation { gradients, rates_by_q, conditions_by_q, conditions_by_v, .. } = &variation;
    let slopes = Metric::of(frame.saddle).slopes(&**gradients);
    let share = S::Scalar::from_f64(16.0 * N as f64) * S::Scalar::epsilon();
    // The rates of constraints along a vector; zero where they are rounding errors of their summands.
    let along = |vector: &[S::Scalar; N], entries: &dyn Fn(usize, usize) -> [S::Scalar; 2]| {
        array::<_, C>(|c| {
            if !S::TURNS.get(c).is_some_and(|&turns| turns) {
                return S::Scalar::zero();
            }
            let (mut sum, mut size) = (S::Scalar::zero(), S::Scalar::zero());
            for (j, &x) in vector.iter().enumerate() {
                let [plus, minus] = entries(c, j);
                sum += (plus - minus) * x;
                size += (plus.abs() + minus.abs()) * x.abs();
            }
            if sum.abs() <= share * size { S::Scalar::zero() } else { sum }
        })
    };
    let rate = |x: &[S::Scalar; C]| {
        let (entrained, _) = frame.saddle.solve(&still, x);
        entrained.iter().zip(frame.sizes).fold(S::Scalar::zero(), |sum, (&x, &size)| sum + size * x * x)
    };
    let mut found = None;
    let mut most = S::Scalar::zero();
    let mut compare = |rates: [S::Scalar; C], square: S::Scalar| {
        if square > frame.least && square > most {
            most = square;
            found = worst(&rates, &slopes);
        }
    };
    let nothing = [S::Scalar::zero(); 2];
    let is_holonomic = |c: usize| S::HOLONOMIC.get(c).is_some_and(|&is| is);
    for (vectors, kind) in [(frame.displacements, true), (frame.velocities, false)] {
        for vector in vectors {
            let change = |c: usize, j: usize| [conditions_by_v[c][j], rates_by_q[c][j]];
            let rates = along(vector, &|c, j| if is_holonomic(c) == kind { change(c, j) } else { nothing });
            compare(rates, rate(&rates));
        }
    }
    for vector in frame.displacements {
        let rates = along(vector, &|c, j| [conditions_by_q[c][j], S::Scalar::zero()]);
        compare(rates, rate(&rates).sqrt());
    }
    found
}

/// The constraint with the largest of some rates in units of the slopes; `None` if all are zero.
pub(super) fn worst<R: Ordered, const C: usize>(rates: &[R; C], slopes: &[R; C]) -> Option<usize> {
    let shares = rates.iter().zip(slopes).map(|(rate, &slope)| rate.abs() / slope).enumerate();
    let positive = shares.filter(|(_, share)| share.is_positive());
    positive
        .fold(None, |best: Option<(usize, R)>, (c, share)| match best {
            Some((_, most)) if most >= share => best,
            _ => Some((c, share)),
        })
        .map(|(c, _)| c)
}

/// Refuses linear equations about a state where the gradient of a constraint turns.
#[inline(never)]
pub(super) fn refuse<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
    Factored { variation, saddle, .. }: &Factored<S::Scalar, N, K, C>,
) -> Result<(), MotionError<S::Scalar>>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let Variation { mass, by_q, gradients, .. } = variation;
    let mut holonomic = gradients.clone();
    for (row, is_holonomic) in holonomic.iter_mut().zip(S::HOLONOMIC) {
        if !is_holonomic {
            *row = [S::Scalar::zero(); N];
        }
    }
    let displacements = Stored::new(TangentSpace::new(mass, &holonomic));
    let velocities = Stored::new(TangentSpace::new(mass, gradients));
    let frame = Frame {
        saddle,
        sizes: &velocities.metric,
        displacements: vectors(&displacements),
        velocities: vectors(&velocities),
        least: lost(by_q, vectors(&displacements)),
    };
    match turning(system, constants, (state.t, &state.q, u), &frame) {
        Some(constraint) => {
            let cause = Cause::TurningConstraint { constraint, name: Name::NONE }.named(&S::NAMES);
            Err(MotionError { cause, t: state.t })
        }
        None => Ok(()),
    }
}

/// The square of the rate that is lost in the rounding errors of a stiffness on some displacements of unit
/// size.
fn lost<R: Ordered, const N: usize>(by_q: &[[R; N]; N], vectors: &[[R; N]]) -> R {
    let size = |vector: &[R; N]| {
        vector.iter().zip(by_q).fold(R::zero(), |sum, (&x, row)| {
            sum + row.iter().zip(vector).fold(R::zero(), |sum, (&k, &y)| sum + (x * k * y).abs())
        })
    };
    let most = vectors.iter().fold(R::zero(), |most, vector| larger(size(vector), most));
    R::from_f64(16.0 * N as f64) * R::epsilon() * most
}

/// The vectors of a space.
fn vectors<R, const N: usize>(space: &TangentSpace<R, N>) -> &[[R; N]] {
    space.vectors.get(..space.count).unwrap_or(&space.vectors)
}
