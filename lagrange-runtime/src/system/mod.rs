//! [`System`]: the trait that generated code implements, and the two ways to run it.

pub mod attitude;
pub mod control;
#[cfg(feature = "double-double")]
pub mod digits;
pub mod error;
pub mod footing;
pub mod hidden;
pub mod limits;
pub mod linearized;
pub mod method;
pub mod metric;
pub mod name;
pub mod proved;
pub mod reading;
pub mod screws;
pub mod smooth;
pub(crate) mod solve;
pub mod state;
pub mod structure;
pub mod twist;

use crate::linear::Independence;
use crate::motion::simulation::Simulation;
use crate::motion::stepper::Stepper;
use crate::number::real::{Ordered, Real};
use crate::system::attitude::BodyAxes;
use control::Held;
use error::{Cause, MotionError};
use footing::{Apart, Footing};
use hidden::Hidden;
use method::{Adaptive, FixedStep};
use metric::Metric;
use name::Names;
use state::State;

/// A mechanical system with `N` coordinates and `K` inputs: a = M⁻¹ f(t, q, v, u).
pub trait System<const N: usize, const K: usize = 0> {
    /// The scalar of parameters, states and inputs.
    type Scalar: Real;

    /// The method of [`System::simulate`]: [`Jets`](crate::Jets) for smooth systems, else
    /// [`Dop853`](crate::Dop853); with contacts or dry friction the one that follows switches by these.
    type Method: Adaptive<Self, Held<Self::Scalar, K>, N, K>;

    /// Subexpressions of parameters alone, computed once per run.
    type Constants: Copy;

    /// Names of coordinates and constraints, for errors.
    const NAMES: Names = Names::NONE;

    /// Where the three numbers of each orientation begin among the coordinates, see
    /// [`attitude`].
    const ORIENTATIONS: &'static [usize] = &[];

    /// The body axes of a state, by which accelerations, forces, momenta and the mass matrix belong to
    /// angular velocities.
    #[inline]
    fn body_axes(&self, state: &State<Self::Scalar, N>) -> BodyAxes<Self::Scalar, N> {
        BodyAxes::new(Self::ORIENTATIONS, state)
    }

    /// Evaluates [`System::Constants`].
    fn constants(&self) -> Self::Constants;

    /// Accelerations that solve M a = f. NaN or infinite where M has no inverse.
    ///
    /// No branch leaves this function early, so that sines and cosines stay together and loops over it
    /// vectorise; [`System::check_at`] finds the cause.
    fn accelerations_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> [Self::Scalar; N];

    /// The same for a state that is known to be on the constraints. For other states, such as the stages of a
    /// method, [`System::accelerations_at`] may move them there first.
    #[inline(always)]
    fn accelerations_on_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> [Self::Scalar; N] {
        self.accelerations_at(constants, t, q, v, u)
    }

    /// Whether the mass matrix can be inverted at a state: asked where accelerations are not finite.
    ///
    /// # Errors
    /// [`Cause::SingularMassMatrix`] with the coordinate, what is wrong with the constraints there, or
    /// [`Cause::NotFinite`].
    #[inline]
    fn check_at(
        &self,
        _constants: &Self::Constants,
        _t: Self::Scalar,
        _q: &[Self::Scalar; N],
        _v: &[Self::Scalar; N],
    ) -> Result<(), Cause> {
        Ok(())
    }

    /// Whether a function in the equations can hide from a step. Exponentials, hyperbolic functions and high
    /// powers vanish beside other terms, or underflow, a few of their widths away. Steps under error control
    /// are then compared with the equations where such functions may be narrow; those of series at other
    /// places, too, and they grow with restraint.
    const STEEP: bool = false;

    /// Whether a function in the equations has a kink or a pole where another one vanishes that a motion may
    /// take to zero, as the distance of two points. A series goes on behind it on a branch of its own. Steps
    /// under error control in which such a function comes near zero are compared with the equations.
    const ROOTED: bool = false;

    /// Visits the functions that can hide ([`STEEP`](Self::STEEP), [`ROOTED`](Self::ROOTED)), those of one
    /// kind after the other: what they are functions of, at each of these states, with inputs for each.
    #[doc(hidden)]
    fn hidden_along<const PLACES: usize>(
        &self,
        _states: &[State<Self::Scalar, N>; PLACES],
        _inputs: &[[Self::Scalar; K]; PLACES],
        _visit: impl FnMut(Hidden, [Self::Scalar; PLACES]),
    ) {
    }

    /// Whether constraints restrict the states.
    const CONSTRAINED: bool = false;

    /// Whether contacts or dry friction switch the equations. A motion then needs a method that follows the
    /// switches: accelerations alone do not tell how it goes on.
    const SWITCHED: bool = false;

    /// Whether there are several constraints, which may come to depend on each other.
    const COUPLED: bool = false;

    /// Whether [`System::energy_at`] is proved to stay the same along each motion on the constraints: then it
    /// is a check of every step.
    #[doc(hidden)]
    const CONSERVES_ENERGY: bool = false;

    /// Begins a motion at a state. Refuses a state that violates constraints in its first nine digits, and
    /// removes the rounding errors of any other.
    ///
    /// # Errors
    /// [`Cause::PositionViolated`] or [`Cause::VelocityViolated`], what is wrong with the constraints
    /// themselves, and [`Cause::NotFinite`].
    #[inline(always)]
    fn begin_at(
        &self,
        _constants: &Self::Constants,
        _start: &mut State<Self::Scalar, N>,
    ) -> Result<(), Cause> {
        Ok(())
    }

    /// Moves a state that a step has left near the constraints onto them: coordinates, then velocities, each
    /// by the smallest change in the metric of the mass matrix.
    ///
    /// With `from`, the state before a step of fixed length, a change that is larger than the step itself is
    /// an error.
    ///
    /// # Errors
    /// [`Cause::PositionViolated`] or [`Cause::VelocityViolated`] where that fails, [`Cause::StepTooLong`],
    /// what is wrong with the constraints themselves, and [`Cause::NotFinite`].
    #[inline(always)]
    fn project_at(
        &self,
        _constants: &Self::Constants,
        _state: &mut State<Self::Scalar, N>,
        _from: Option<&State<Self::Scalar, N>>,
    ) -> Result<(), Cause> {
        Ok(())
    }

    /// The same for the end of a step under error control. Also returns how well the constraints determine
    /// the state and, if inputs are given, the accelerations there.
    ///
    /// # Errors
    /// As [`System::project_at`].
    #[inline(always)]
    fn land_at(
        &self,
        _constants: &Self::Constants,
        _state: &mut State<Self::Scalar, N>,
        _inputs: Option<&[Self::Scalar; K]>,
    ) -> Result<Footing<Self::Scalar, N>, Cause> {
        let [ulps_q, ulps_v, ulps_a] = [[num_traits::Zero::zero(); N]; 3];
        let independence = Independence::clear(0);
        Ok(Footing { independence, accelerations: None, ulps_q, ulps_v, ulps_a, metric: Metric::none() })
    }

    /// Whether [`System::land_apart_at`] does anything.
    #[doc(hidden)]
    const LANDS_APART: bool = false;

    /// As [`System::land_at`] with inputs, for each lane of a vector by its own numbers. `None` where lanes
    /// would have to decide together; the state is then as it was.
    #[doc(hidden)]
    #[inline(always)]
    fn land_apart_at(
        &self,
        _constants: &Self::Constants,
        _state: &mut State<Self::Scalar, N>,
        _inputs: &[Self::Scalar; K],
    ) -> Option<Apart<Self::Scalar, N>> {
        None
    }

    /// The part of a change of coordinates and velocities along the constraints at a state.
    #[inline(always)]
    fn tangential_at(
        &self,
        _state: &State<Self::Scalar, N>,
        change: &State<Self::Scalar, N>,
    ) -> State<Self::Scalar, N> {
        *change
    }

    /// Whether [`System::check_reading_at`] does anything: in builds with `debug_assertions`.
    #[doc(hidden)]
    const READ: bool = false;

    /// Whether the functions of the description return what the macro has read.
    ///
    /// # Errors [`Cause::Misread`] with the function.
    #[doc(hidden)]
    #[inline(always)]
    fn check_reading_at(
        &self,
        _state: &State<Self::Scalar, N>,
        _inputs: &[Self::Scalar; K],
    ) -> Result<(), Cause> {
        Ok(())
    }

    /// Whether an energy, a momentum or a constraint may jump at a kink, where methods that do not look for
    /// kinks have to ask [`System::passed_at`].
    #[doc(hidden)]
    const JUMPS: bool = false;

    /// Refuses a step across a kink at which something jumps that no force can make jump.
    ///
    /// # Errors
    /// [`Cause::EnergyJumps`], [`Cause::MomentumJumps`], [`Cause::GapJumps`].
    #[doc(hidden)]
    #[inline(always)]
    fn passed_at(
        &self,
        _from: &State<Self::Scalar, N>,
        _to: &State<Self::Scalar, N>,
        _inputs: &[Self::Scalar; K],
    ) -> Result<(), Cause> {
        Ok(())
    }

    /// T + V, or the energy function v·∂L/∂v − L where L is given directly.
    fn energy_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Self::Scalar;

    /// A motion from `start` under error control, with inputs at zero until they are set.
    #[inline]
    fn simulate(
        &self,
        start: State<Self::Scalar, N>,
    ) -> Simulation<'_, Self, Held<Self::Scalar, K>, Self::Method, N, K>
    where
        Self: Sized,
        Self::Scalar: Ordered,
    {
        Simulation::new(self, start)
    }

    /// The same by method `M`: `simulate_with::<Dop853>(start)`.
    #[inline]
    fn simulate_with<M>(
        &self,
        start: State<Self::Scalar, N>,
    ) -> Simulation<'_, Self, Held<Self::Scalar, K>, M, N, K>
    where
        Self: Sized,
        Self::Scalar: Ordered,
        M: Adaptive<Self, Held<Self::Scalar, K>, N, K>,
    {
        Simulation::new(self, start)
    }

    /// A motion from `start` in steps that the caller chooses, by method `M`: `stepper::<Rk4>(start)`.
    #[inline]
    fn stepper<M>(&self, start: State<Self::Scalar, N>) -> Stepper<'_, Self, M, N, K>
    where
        Self: Sized,
        M: FixedStep<Self, N, K>,
    {
        Stepper::new(self, start)
    }
}

/// Whether masses are positive where a system without constraints needs them. Accelerations of a negative
/// mass are finite; with constraints the factors of M show it.
///
/// # Errors
/// [`Cause::SingularMassMatrix`] with the coordinate.
#[inline]
pub(crate) fn check_masses<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
) -> Result<(), MotionError<S::Scalar>> {
    let State { t, q, v } = state;
    if S::CONSTRAINED {
        return Ok(());
    }
    let found = system.check_at(constants, *t, q, v);
    found.map_err(|cause| MotionError { cause: cause.named(&S::NAMES), t: *t })
}

/// Why the motion fails at a state.
#[cold]
pub(crate) fn diagnose<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
) -> Cause {
    if q.iter().chain(v).all(|x| x.is_finite()) && t.is_finite() {
        system.check_at(constants, t, q, v).err().unwrap_or(Cause::NotFinite).named(&S::NAMES)
    } else {
        Cause::NotFinite
    }
}
