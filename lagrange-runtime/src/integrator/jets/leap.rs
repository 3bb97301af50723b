//! The leap over a kink of the forces that no series crosses.
//!
//! Where two points meet, the direction of the force between them turns about. A series that begins beside
//! that place reaches as far as the place, and no further. So steps become ever shorter before it, down to
//! the resolution of time, and grow again behind it. A few resolutions of time are crossed with constant
//! accelerations instead: whatever the forces are there, they change velocities by less than the tolerance.

use super::super::hidden::{InEquations, Passage};
use super::{Jets, JetsMemory};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, any, larger, smaller};
use crate::system::control::Held;
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// The length of the leap, as a multiple of the resolution of time.
const ACROSS: f64 = 4.0;

/// The ratio of a leap to the one right before it. Where rounding keeps coordinates at the kink, or where no
/// series exists at all, there is another one behind each.
const LONGER: f64 = 16.0;

/// Leaps towards `target`, from the end of the last leap if it `has_leapt`. False where forces are too strong
/// for it, as beside a pole. Derivatives of the motion would jump at the kink, so a motion with derivatives
/// does not leap either.
#[cold]
#[inline(never)]
pub(super) fn leap<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    target: S::Scalar,
    has_leapt: bool,
) -> bool
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    if S::CONSTRAINED || S::Scalar::PARTS > 1 {
        return false;
    }
    let start = memory.start;
    let number = S::Scalar::from_f64;
    let across = number(ACROSS) * memory.resolution();
    let length = if has_leapt { larger(across, number(LONGER) * memory.last) } else { across };
    let left = target - start.t;
    let h = smaller(length, left.abs()) * left.signum();
    let accelerations =
        |State { t, q, v }: &State<S::Scalar, N>| system.accelerations_at(constants, *t, q, v, &control.0);
    let mut a = accelerations(&start);
    // A step may end at the kink itself, where zero over zero is no force. Those right behind it count.
    if memory.last.is_positive() && !a.iter().all(|a| a.is_finite()) {
        let behind = array(|i| start.q[i] + h * start.v[i]);
        a = accelerations(&State { t: start.t + h, q: behind, v: start.v });
    }
    let half = S::Scalar::from_f64(0.5);
    let state_at = |theta: S::Scalar| {
        let h = theta * h;
        let q = array(|i| start.q[i] + h * (start.v[i] + half * h * a[i]));
        State { t: start.t + h, q, v: array(|i| start.v[i] + h * a[i]) }
    };
    let absolute = limits.absolute.unwrap_or_else(num_traits::Zero::zero);
    let speed = start.v.iter().fold(absolute, |most, v| most.max(limits.relative * v.abs()));
    // Zero over zero is the middle of the kink. A pole is infinite.
    let is_weak = |a: &[S::Scalar; N]| !a.iter().any(|a| any((*a * h).abs() - speed));
    let end = accelerations(&state_at(num_traits::One::one()));
    if !(a.iter().chain(&end).all(|a| a.is_finite()) && is_weak(&a) && is_weak(&end)) {
        return false;
    }
    let hiding = InEquations { system, control, roots: true };
    let passage = Passage { hiding: &hiding, state_at: &state_at, theta: num_traits::One::one() };
    let mut are_weak = true;
    passage.search(|theta| {
        are_weak &= is_weak(&accelerations(&state_at(theta)));
        num_traits::Zero::zero()
    });
    if are_weak {
        take(memory, h, &a);
    }
    are_weak
}

/// Makes the step with constant accelerations of the memory.
fn take<C, T, R, const N: usize>(memory: &mut JetsMemory<C, T, R, N>, h: R, a: &[R; N])
where
    C: Copy,
    T: Copy + Default,
    R: Ordered,
{
    let none = [R::zero(); N];
    memory.series = Series::default();
    memory.series.set(1, memory.start.v.map(|v| h * v), a.map(|a| h * a));
    memory.series.set(2, a.map(|a| R::from_f64(0.5) * h * h * a), none);
    (memory.unit, memory.next, memory.is_as_expanded) = (h, R::zero(), false);
    memory.reach(R::one());
    memory.last = h.abs();
    memory.counts.accepted += 1;
}
