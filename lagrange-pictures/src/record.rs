//! [`Record`]: the states of a motion, and the curves that can be plotted of them.

use lagrange_runtime::{
    Adaptive, Constrained, Control, MotionError, Ordered, Real, Simulation, State, System,
};

use crate::chart::Chart;
use crate::error::PictureError;
use crate::film::Film;

/// States of a motion, with the inputs there.
#[derive(Clone, Debug)]
pub struct Record<'a, S: System<N, K>, const N: usize, const K: usize = 0> {
    system: &'a S,
    states: Vec<State<S::Scalar, N>>,
    inputs: Vec<[S::Scalar; K]>,
}

impl<'a, S, const N: usize, const K: usize> Record<'a, S, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered + Into<f64>,
{
    /// Moves on by `duration` \[s], backward if it is negative. Keeps the present state and the states at the
    /// ends of so many equal intervals.
    ///
    /// # Errors
    /// [`PictureError::Motion`] where the motion ends before, and if there is no interval or no duration.
    pub fn of<C, M>(
        motion: &mut Simulation<'a, S, C, M, N, K>,
        duration: f64,
        intervals: usize,
    ) -> Result<Self, PictureError>
    where
        C: Control<S::Scalar, N, K>,
        M: Adaptive<S, C, N, K>,
    {
        let interval = S::Scalar::from_f64(duration / intervals as f64);
        let states = motion.every(interval).take(intervals.saturating_add(1)).collect::<Result<Vec<_>, _>>();
        let states = states
            .map_err(|MotionError { cause, t }| PictureError::Motion(MotionError { cause, t: t.into() }))?;
        let inputs = states.iter().map(|state| motion.control().inputs(state)).collect();
        Ok(Self { system: motion.system(), states, inputs })
    }

    /// Takes given states, such as those of a motion in fixed steps, with all inputs at zero.
    pub fn new(system: &'a S, states: impl IntoIterator<Item = State<S::Scalar, N>>) -> Self {
        let states: Vec<_> = states.into_iter().collect();
        let inputs = vec![[lagrange_runtime::Zero::zero(); K]; states.len()];
        Self { system, states, inputs }
    }

    /// The system.
    #[must_use]
    pub fn system(&self) -> &'a S {
        self.system
    }

    /// The states, in the order of the motion.
    #[must_use]
    pub fn states(&self) -> &[State<S::Scalar, N>] {
        &self.states
    }

    /// The states with the inputs there.
    pub(crate) fn with_inputs(&self) -> impl Iterator<Item = (&State<S::Scalar, N>, &[S::Scalar; K])> {
        self.states.iter().zip(&self.inputs)
    }

    /// A quantity over time, as points of a curve: `record.over_time(Pendulum::energy)`.
    pub fn over_time<T: Into<f64>>(
        &self,
        quantity: impl Fn(&S, &State<S::Scalar, N>) -> T,
    ) -> Vec<(f64, f64)> {
        self.states.iter().map(|state| (state.t.into(), quantity(self.system, state).into())).collect()
    }

    /// The path of a place in the plane, as points of a curve: `record.path(Pendulum::bob)`.
    pub fn path<Q, P, T>(&self, place: impl Fn(&S, &Q) -> P) -> Vec<(f64, f64)>
    where
        Q: From<[S::Scalar; N]>,
        P: Into<[T; 2]>,
        T: Into<f64>,
    {
        let at = |state: &State<S::Scalar, N>| place(self.system, &Q::from(state.q)).into().map(Into::into);
        self.states.iter().map(|state| at(state).into()).collect()
    }

    /// Coordinate and velocity, by the name that `COORDINATES` of the system has for it: `"theta[0]"`.
    ///
    /// # Errors
    /// [`PictureError::NoSuchCoordinate`].
    pub fn phase_portrait(&self, coordinate: &str) -> Result<Chart, PictureError> {
        let known = S::NAMES.coordinates;
        let found = known.iter().position(|name| *name == coordinate);
        let index =
            found.ok_or_else(|| PictureError::NoSuchCoordinate { name: coordinate.to_owned(), known })?;
        let points = self.states.iter().map(|state| (state.q[index].into(), state.v[index].into()));
        Ok(Chart::new("Phase portrait", coordinate, &format!("{coordinate}′")).line("", points))
    }

    /// Kinetic, potential and total energy over time:
    /// `record.energies(Pendulum::kinetic_energy, Pendulum::potential_energy)`.
    pub fn energies<T: Into<f64>, V: Into<f64>>(
        &self,
        kinetic: impl Fn(&S, &State<S::Scalar, N>) -> T,
        potential: impl Fn(&S, &State<S::Scalar, N>) -> V,
    ) -> Chart {
        let (kinetic, potential) = (self.over_time(kinetic), self.over_time(potential));
        let total: Vec<_> = kinetic.iter().zip(&potential).map(|(&(t, a), &(_, b))| (t, a + b)).collect();
        Chart::new("Energies", "time [s]", "energy [J]")
            .line("kinetic", kinetic)
            .line("potential", potential)
            .line("total", total)
    }

    /// By how much the energy has changed since the first state, on a logarithmic axis. For a conservative
    /// system that is the error of its energy.
    #[must_use]
    pub fn energy_change(&self) -> Chart {
        let constants = self.system.constants();
        let energy = |state: &State<S::Scalar, N>| -> f64 {
            self.system.energy_at(&constants, state.t, &state.q, &state.v).into()
        };
        let first = self.states.first().map_or(0.0, energy);
        Chart::new("Change of the energy", "time [s]", "|E − E₀| [J]")
            .logarithmic()
            .line("", self.over_time(|_, state| energy(state) - first))
    }

    /// The multiplier of each constraint, contact and friction over time, by the names in `CONSTRAINTS` of
    /// the system. Impulses are not shown: at an impact reactions jump.
    #[must_use]
    pub fn reactions<const C: usize>(&self) -> Chart
    where
        S: Constrained<N, K>,
        S::Reactions: Into<[S::Scalar; C]>,
    {
        let constants = self.system.constants();
        let at = |(State { t, q, v }, inputs): (&State<S::Scalar, N>, &[S::Scalar; K])| {
            let multipliers = *self.system.reactions_at(&constants, *t, q, v, inputs);
            (Into::<f64>::into(*t), multipliers.into())
        };
        let all: Vec<(f64, [S::Scalar; C])> = self.with_inputs().map(at).collect();
        let chart = Chart::new("Reactions", "time [s]", "multiplier");
        (0..C).fold(chart, |chart, row| {
            let label = S::NAMES.constraints.get(row).map_or_else(|| row.to_string(), ToString::to_string);
            chart.line(&label, all.iter().map(|(t, multipliers)| (*t, multipliers[row].into())))
        })
    }

    /// A drawing that moves, empty so far.
    #[must_use]
    pub fn film(&self) -> Film<'_, S, N, K> {
        Film::new(self)
    }
}
