//! Symplectic splitting methods for separable systems: the motion as a palindrome of drifts and kicks.
//!
//! A drift moves q by the velocity, and time with it. A kick changes v by the accelerations at that q and t.
//! Each is the exact motion of a Hamiltonian, so a step is symplectic and reversible: over long runs the
//! energy error stays bounded at the size of one step's. Forces may depend on time and on inputs that are
//! held.
//!
//! Where the last stage is a kick, its accelerations serve the first kick of the next step, if that starts at
//! the state where this one ended, with the same inputs. The sums of all methods but the leapfrog are
//! compensated, so that rounding errors do not add up over long runs.

use num_traits::Zero;

use super::FixedStep;
use super::tableau::splitting as tableau;
use crate::number::compensated::add;
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::proved::Separable;
use crate::system::state::State;

/// The last step, as far as the next one needs it.
#[derive(Clone, Copy, Debug)]
pub struct LastSplit<R, const N: usize, const K: usize> {
    /// The end of the step, with its residue of compensated summation.
    end: State<R, N>,
    lost_q: [R; N],
    lost_v: [R; N],
    /// The inputs and the accelerations of a kick at its end.
    kick: Option<([R; K], [R; N])>,
}

impl<R: Real, const N: usize, const K: usize> LastSplit<R, N, K> {
    /// The accelerations at `from` with the inputs `u`, if they are known. The time that a stepper sums with
    /// compensation may differ by a few ulps from the time at which the step ended.
    #[inline]
    fn accelerations(&self, from: &State<R, N>, u: &[R; K]) -> Option<[R; N]> {
        let apart = (self.end.t - from.t).abs();
        let rounding = R::from_f64(4.0) * R::epsilon() * from.t.abs();
        let now = apart == R::zero() || (rounding - apart).is_positive();
        self.kick.filter(|(inputs, _)| now && inputs == u).map(|(_, a)| a)
    }
}

/// Störmer–Verlet in its velocity form: symplectic, order 2, one evaluation a step.
///
/// Stable below h·ω = 2 for the fastest frequency ω. It is the usual method of molecular dynamics, where a
/// step may cost one evaluation only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Leapfrog;

/// Compositions of leapfrogs, of order 4, 6 and 8: [`Yoshida4`], [`Yoshida6`] and [`Yoshida8`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Yoshida<const ORDER: usize>;

/// Yoshida's composition of three leapfrogs: symplectic, order 4, three evaluations a step.
///
/// The best known of them. [`BlanesMoan4`] is a thousand times more accurate for the same cost.
pub type Yoshida4 = Yoshida<4>;

/// Yoshida's composition of seven leapfrogs: symplectic, order 6, seven evaluations a step.
pub type Yoshida6 = Yoshida<6>;

/// Suzuki and Umeno's composition of fifteen leapfrogs in Yoshida's manner: symplectic, order 8, fifteen
/// evaluations a step.
pub type Yoshida8 = Yoshida<8>;

/// Runge–Kutta–Nyström splittings by Blanes and Moan, of order 4 and 6: [`BlanesMoan4`] and [`BlanesMoan6`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BlanesMoan<const ORDER: usize>;

/// Blanes and Moan's SRKN6b: symplectic, order 4, six evaluations a step.
///
/// The symplectic method of choice at moderate accuracy.
pub type BlanesMoan4 = BlanesMoan<4>;

/// Blanes and Moan's SRKN14a: symplectic, order 6, fourteen evaluations a step.
///
/// The symplectic method of choice at high accuracy.
pub type BlanesMoan6 = BlanesMoan<6>;

/// The fractions of a step that a splitting method is.
#[diagnostic::on_unimplemented(
    message = "there is no method `{Self}`",
    note = "there are `Leapfrog`, `Yoshida<4>`, `Yoshida<6>`, `Yoshida<8>`, `BlanesMoan<4>` and `BlanesMoan<6>`"
)]
trait Splitting {
    /// Kicks, before each drift and after the last. One of zero is left out.
    const KICKS: &'static [f64];
    /// Drifts.
    const DRIFTS: &'static [f64];
    /// Whether sums are compensated. That is of no use where the error of the method exceeds rounding errors
    /// at every sensible step.
    const COMPENSATED: bool;
}

macro_rules! tabulated {
    ($($method:ty = $table:ident;)*) => {$(
        impl Splitting for $method {
            const KICKS: &'static [f64] = &tableau::$table.kicks;
            const DRIFTS: &'static [f64] = &tableau::$table.drifts;
            const COMPENSATED: bool = Self::KICKS.len() > 2;
        }
    )*};
}

tabulated! {
    Leapfrog = LEAPFROG;
    Yoshida4 = YOSHIDA4;
    Yoshida6 = YOSHIDA6;
    Yoshida8 = YOSHIDA8;
    BlanesMoan4 = BLANES_MOAN4;
    BlanesMoan6 = BLANES_MOAN6;
}

// The three implementations are written out. With one for every `Splitting` the compiler could not give the
// message about other methods, and a macro would stand in the middle of its messages about these.

impl<S: Separable<N, K>, const N: usize, const K: usize> FixedStep<S, N, K> for Leapfrog {
    type Memory = Option<LastSplit<S::Scalar, N, K>>;

    #[inline]
    fn begin(_: &S) -> Self::Memory {
        None
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        Ok(step::<Self, S, N, K>(memory, system, constants, from, h, u))
    }
}

impl<S: Separable<N, K>, const ORDER: usize, const N: usize, const K: usize> FixedStep<S, N, K>
    for Yoshida<ORDER>
where
    Self: Splitting,
{
    type Memory = Option<LastSplit<S::Scalar, N, K>>;

    #[inline]
    fn begin(_: &S) -> Self::Memory {
        None
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        Ok(step::<Self, S, N, K>(memory, system, constants, from, h, u))
    }
}

impl<S: Separable<N, K>, const ORDER: usize, const N: usize, const K: usize> FixedStep<S, N, K>
    for BlanesMoan<ORDER>
where
    Self: Splitting,
{
    type Memory = Option<LastSplit<S::Scalar, N, K>>;

    #[inline]
    fn begin(_: &S) -> Self::Memory {
        None
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        Ok(step::<Self, S, N, K>(memory, system, constants, from, h, u))
    }
}

/// A step of `h`.
#[inline(always)]
fn step<M: Splitting, S: Separable<N, K>, const N: usize, const K: usize>(
    memory: &mut Option<LastSplit<S::Scalar, N, K>>,
    system: &S,
    constants: &S::Constants,
    from: &State<S::Scalar, N>,
    h: S::Scalar,
    u: &[S::Scalar; K],
) -> State<S::Scalar, N> {
    let last = memory.take().filter(|last| last.end.q == from.q && last.end.v == from.v);
    let mut known = last.and_then(|last| last.accelerations(from, u));
    let nothing = [S::Scalar::zero(); N];
    let (lost_q, lost_v) = last.map_or((nothing, nothing), |last| (last.lost_q, last.lost_v));
    let mut at = LastSplit { end: *from, lost_q, lost_v, kick: None };
    let mut elapsed = 0.0;
    for (i, &kick) in M::KICKS.iter().enumerate() {
        if kick != 0.0 {
            let a = match known.take() {
                Some(a) => a,
                None => system.accelerations_at(constants, at.end.t, &at.end.q, &at.end.v, u),
            };
            let reach = S::Scalar::from_f64(kick) * h;
            grow::<M, _, N>(&mut at.end.v, &mut at.lost_v, reach, &a);
            if i == M::DRIFTS.len() {
                at.kick = Some((*u, a));
            }
        }
        if let Some(&drift) = M::DRIFTS.get(i) {
            let reach = S::Scalar::from_f64(drift) * h;
            grow::<M, _, N>(&mut at.end.q, &mut at.lost_q, reach, &at.end.v);
            elapsed = if i + 1 == M::DRIFTS.len() { 1.0 } else { elapsed + drift };
            at.end.t = from.t + S::Scalar::from_f64(elapsed) * h;
        }
    }
    *memory = Some(at);
    at.end
}

/// x + h ẋ, and its rounding error.
#[inline(always)]
fn grow<M: Splitting, R: Real, const N: usize>(x: &mut [R; N], lost: &mut [R; N], h: R, rates: &[R; N]) {
    for n in 0..N {
        if M::COMPENSATED {
            (x[n], lost[n]) = add(x[n], lost[n], h * rates[n]);
        } else {
            x[n] += h * rates[n];
        }
    }
}

#[cfg(test)]
mod tests;
