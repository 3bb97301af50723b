//! [`Ensemble`]: many motions of one description.

use lagrange_runtime::{Adaptive, Guard, Held, Ordered, Real, Simulation, State, System, Vector};

use crate::failure::Failure;
use crate::lanes::InLanes;
use crate::record::Record;
use crate::row::Row;
use crate::study::Study;

/// A motion of a system by its own method.
pub type Motion<'a, S, const N: usize, const K: usize> =
    Simulation<'a, S, Held<<S as System<N, K>>::Scalar, K>, <S as System<N, K>>::Method, N, K>;

/// `COUNT` states of a motion.
pub type States<R, const N: usize, const COUNT: usize> = [State<R, N>; COUNT];

/// Where a motion starts: a system with its parameters and a state, or why there is none.
pub trait Start<S, R, const N: usize> {
    /// The system and the state.
    ///
    /// # Errors
    /// Why there is none: the row of the motion has that cause.
    fn start(self) -> Result<(S, State<R, N>), Failure>;
}

impl<S, R, const N: usize> Start<S, R, N> for (S, State<R, N>) {
    fn start(self) -> Result<Self, Failure> {
        Ok(self)
    }
}

impl<S, R, const N: usize, E: Into<Failure>> Start<S, R, N> for Result<(S, State<R, N>), E> {
    fn start(self) -> Result<(S, State<R, N>), Failure> {
        self.map_err(Into::into)
    }
}

/// How motions are integrated.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Settings {
    pub(crate) tolerances: Option<(f64, Option<f64>)>,
    pub(crate) longest: Option<f64>,
    pub(crate) max_steps: Option<u64>,
}

impl Settings {
    /// The settings as text for the manifest.
    pub(crate) fn text(&self) -> String {
        let Self { tolerances, longest, max_steps } = self;
        format!("tolerances {tolerances:?}, longest step {longest:?}, most steps {max_steps:?}")
    }

    /// The motion from a start, by a method.
    pub(crate) fn motion<'a, S, M, const N: usize, const K: usize>(
        &self,
        system: &'a S,
        start: State<S::Scalar, N>,
    ) -> Simulation<'a, S, Held<S::Scalar, K>, M, N, K>
    where
        S: System<N, K>,
        S::Scalar: Ordered,
        M: Adaptive<S, Held<S::Scalar, K>, N, K>,
    {
        let number = S::Scalar::from_f64;
        let mut motion = Simulation::new(system, start);
        motion = match self.tolerances {
            Some((relative, None)) => motion.with_tolerance(number(relative)),
            Some((relative, Some(absolute))) => motion.with_tolerances(number(relative), number(absolute)),
            None => motion,
        };
        if let Some(longest) = self.longest {
            motion = motion.with_step_limit(number(longest));
        }
        if let Some(steps) = self.max_steps {
            motion = motion.with_max_steps(steps);
        }
        motion
    }
}

/// Many motions: how each starts, as a function of its index, and how it is integrated.
#[derive(Clone, Copy, Debug)]
pub struct Ensemble<F> {
    pub(crate) count: u64,
    pub(crate) start: F,
    pub(crate) settings: Settings,
}

impl<F> Ensemble<F> {
    /// `count` motions. `start` must be a function of the index and of nothing else.
    pub fn new<B>(count: u64, start: F) -> Self
    where
        F: Fn(u64) -> B + Sync,
    {
        Self { count, start, settings: Settings::default() }
    }

    /// As [`Simulation::with_tolerance`].
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.settings.tolerances = Some((tolerance, None));
        self
    }

    /// As [`Simulation::with_tolerances`].
    #[must_use]
    pub fn with_tolerances(mut self, relative: f64, absolute: f64) -> Self {
        self.settings.tolerances = Some((relative, Some(absolute)));
        self
    }

    /// As [`Simulation::with_step_limit`].
    #[must_use]
    pub fn with_step_limit(mut self, longest: f64) -> Self {
        self.settings.longest = Some(longest);
        self
    }

    /// As [`Simulation::with_max_steps`].
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.settings.max_steps = Some(steps);
        self
    }

    /// A table of what `reduce` makes of each motion: it advances the motion as far as it wants to, by all
    /// means that a motion has, and returns a record. The name is that of the files.
    pub fn study<B, S, T, const N: usize, const K: usize>(
        self,
        name: &str,
        reduce: impl Fn(&mut Motion<'_, S, N, K>) -> Result<T, Failure> + Sync,
    ) -> Study<impl Row<T>, T>
    where
        F: Fn(u64) -> B + Sync,
        B: Start<S, S::Scalar, N>,
        S: System<N, K>,
        S::Scalar: Ordered,
        T: Record,
    {
        let Self { count, start, settings } = self;
        let row = move |index| {
            let (system, start) = start(index).start()?;
            reduce(&mut settings.motion(&system, start))
        };
        Study::new(name, count, row).with_settings(settings.text())
    }

    /// The same motions several at once, one in each lane of a SIMD vector such as `Lanes<f64x4>`, for
    /// `ends` and `samples`: about twice as many motions a second. The attribute of the system needs
    /// `jacobians`, which generates its equations over any scalar.
    ///
    /// The choice has a name because bits differ from those of single motions, in which the functions of the
    /// standard library stand and expansions have other orders. The errors are those that the tolerance
    /// allows in either. In lanes, too, the bits of a row depend on its index and nothing else: not on what
    /// runs in other lanes, on threads, parts or ranks. A motion that cannot go on in its lane is computed
    /// alone, from its start, and has the row of that.
    ///
    /// Systems with functions that hide from Taylor series (such as exponentials and r⁻⁴), with an
    /// indefinite mass matrix, or with many constraints that are solved by lists of places, cannot be kept
    /// apart in lanes: [`Error::NotInLanes`](crate::Error::NotInLanes). Those with contacts or friction have
    /// no series.
    pub fn in_lanes<V: Vector>(self) -> InLanes<F, V> {
        InLanes::new(self)
    }

    /// A table of the states at time `t` \[s].
    pub fn ends<B, S, const N: usize, const K: usize>(
        self,
        name: &str,
        t: f64,
    ) -> Study<impl Row<State<S::Scalar, N>>, State<S::Scalar, N>>
    where
        F: Fn(u64) -> B + Sync,
        B: Start<S, S::Scalar, N>,
        S: System<N, K>,
        S::Scalar: Ordered + Record + Into<f64>,
    {
        self.study(name, move |motion: &mut Motion<'_, S, N, K>| end(motion, t))
            .also(format!("ends at {t:?}"))
    }

    /// A table of `COUNT` states of each motion, `dt` \[s] apart, from its start on.
    pub fn samples<const COUNT: usize, B, S, const N: usize, const K: usize>(
        self,
        name: &str,
        dt: f64,
    ) -> Study<impl Row<States<S::Scalar, N, COUNT>>, States<S::Scalar, N, COUNT>>
    where
        F: Fn(u64) -> B + Sync,
        B: Start<S, S::Scalar, N>,
        S: System<N, K>,
        S::Scalar: Ordered + Record + Into<f64>,
    {
        self.study(name, move |motion: &mut Motion<'_, S, N, K>| sampled(motion, dt))
            .also(format!("samples every {dt:?}"))
    }

    /// A table of the times \[s] of the first `COUNT` zeros of `guard` up to time `until` \[s]; `None` where
    /// there are fewer.
    pub fn event_times<const COUNT: usize, B, S, G, const N: usize, const K: usize>(
        self,
        name: &str,
        guard: G,
        until: f64,
    ) -> Study<impl Row<[Option<f64>; COUNT]>, [Option<f64>; COUNT]>
    where
        F: Fn(u64) -> B + Sync,
        B: Start<S, S::Scalar, N>,
        S: System<N, K>,
        S::Scalar: Ordered + Into<f64>,
        G: Guard<S, S::Scalar, N> + Clone + Sync,
    {
        let reduce = move |motion: &mut Motion<'_, S, N, K>| {
            let mut times = [None; COUNT];
            for (place, event) in
                times.iter_mut().zip(motion.events(guard.clone(), S::Scalar::from_f64(until)))
            {
                *place = Some(event?.state.t.into());
            }
            Ok(times)
        };
        self.study(name, reduce).also(format!("events until {until:?}"))
    }
}

/// The state at time `t` \[s].
pub(crate) fn end<S, const N: usize, const K: usize>(
    motion: &mut Motion<'_, S, N, K>,
    t: f64,
) -> Result<State<S::Scalar, N>, Failure>
where
    S: System<N, K>,
    S::Scalar: Ordered + Into<f64>,
{
    Ok(*motion.advance_to(S::Scalar::from_f64(t))?)
}

/// States `dt` \[s] apart.
pub(crate) fn sampled<S, const N: usize, const K: usize, const COUNT: usize>(
    motion: &mut Motion<'_, S, N, K>,
    dt: f64,
) -> Result<States<S::Scalar, N, COUNT>, Failure>
where
    S: System<N, K>,
    S::Scalar: Ordered + Into<f64>,
{
    let mut states = [*motion.state(); COUNT];
    for (place, state) in states.iter_mut().zip(motion.every(S::Scalar::from_f64(dt))) {
        *place = state?;
    }
    Ok(states)
}
