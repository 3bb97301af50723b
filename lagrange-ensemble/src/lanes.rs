//! [`InLanes`]: several motions of an ensemble at once, one in each lane of a SIMD vector.

use std::cell::Cell;
use std::marker::PhantomData;

use lagrange_runtime::relay::{Standing, get, set};
use lagrange_runtime::{Dop853, Held, Ordered, Real, Relay, Sensitive, Simulation, Smooth, State, Vector};

use crate::ensemble::{Ensemble, Motion, Settings, Start, States, end, sampled};
use crate::failure::Failure;
use crate::record::Record;
use crate::row::Row;
use crate::study::Study;

/// An ensemble whose motions run in the lanes of a vector `V`. Made by [`Ensemble::in_lanes`].
#[derive(Clone, Copy, Debug)]
pub struct InLanes<F, V> {
    ensemble: Ensemble<F>,
    vector: PhantomData<fn() -> V>,
}

impl<F, V: Vector> InLanes<F, V> {
    pub(crate) fn new(ensemble: Ensemble<F>) -> Self {
        Self { ensemble, vector: PhantomData }
    }

    /// As [`Ensemble::ends`].
    pub fn ends<B, S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>(
        self,
        name: &str,
        t: f64,
    ) -> Study<impl Row<State<S::Scalar, N>>, State<S::Scalar, N>>
    where
        F: Fn(u64) -> B + Sync,
        B: Start<S, S::Scalar, N>,
        S: Sensitive<N, K, C, P, D>,
        S::Scalar: Ordered + Record + Into<f64>,
        V: Vector<Lane = S::Scalar>,
        S::Over<V>: Smooth<N, K>,
    {
        let time = move |_: &State<S::Scalar, N>, k| (k == 0).then(|| S::Scalar::from_f64(t));
        let record = |states: &[State<S::Scalar, N>]| states.first().copied();
        self.study(name, time, record, move |motion| end(motion, t)).also(format!("ends at {t:?}"))
    }

    /// As [`Ensemble::samples`].
    pub fn samples<
        const COUNT: usize,
        B,
        S,
        const N: usize,
        const K: usize,
        const C: usize,
        const P: usize,
        const D: usize,
    >(
        self,
        name: &str,
        dt: f64,
    ) -> Study<impl Row<States<S::Scalar, N, COUNT>>, States<S::Scalar, N, COUNT>>
    where
        F: Fn(u64) -> B + Sync,
        B: Start<S, S::Scalar, N>,
        S: Sensitive<N, K, C, P, D>,
        S::Scalar: Ordered + Record + Into<f64>,
        V: Vector<Lane = S::Scalar>,
        S::Over<V>: Smooth<N, K>,
    {
        let time = move |start: &State<S::Scalar, N>, k: usize| {
            let after = S::Scalar::from_f64(k as f64) * S::Scalar::from_f64(dt);
            (k < COUNT).then(|| start.t + after)
        };
        let record = |states: &[State<S::Scalar, N>]| States::try_from(states).ok();
        self.study(name, time, record, move |motion| sampled(motion, dt))
            .also(format!("samples every {dt:?}"))
    }

    /// A study of records of the states at times. `time` gives the `k`-th of a motion.
    fn study<B, S, T, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>(
        self,
        name: &str,
        time: impl Fn(&State<S::Scalar, N>, usize) -> Option<S::Scalar> + Sync,
        record: impl Fn(&[State<S::Scalar, N>]) -> Option<T> + Sync,
        reduce: impl Fn(&mut Motion<'_, S, N, K>) -> Result<T, Failure> + Sync,
    ) -> Study<impl Row<T>, T>
    where
        F: Fn(u64) -> B + Sync,
        B: Start<S, S::Scalar, N>,
        S: Sensitive<N, K, C, P, D>,
        S::Scalar: Ordered + Into<f64>,
        V: Vector<Lane = S::Scalar>,
        S::Over<V>: Smooth<N, K>,
        T: Record,
    {
        let Self { ensemble, .. } = self;
        let (count, settings) = (ensemble.count, ensemble.settings);
        let rows: Rows<_, _, _, _, S, V, N, K, C, P, D> =
            Rows { ensemble, time, record, reduce, kind: PhantomData };
        Study::of_rows(name, count, rows).with_settings(format!("{}, in lanes", settings.text()))
    }
}

/// The number of motions that a lane takes one after the other before it may stand idle until others end.
const MOTIONS_OF_A_LANE: u64 = 16;

/// The rows of such a study.
struct Rows<F, A, M, Q, S, V, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
{
    ensemble: Ensemble<F>,
    /// The time of the k-th state of a record.
    time: A,
    /// The record of these states.
    record: M,
    /// The record of a single motion.
    reduce: Q,
    kind: PhantomData<fn() -> (S, V)>,
}

/// A motion in a lane.
struct Job<L, const N: usize> {
    index: u64,
    /// The parameters of the system.
    parameters: Vec<L>,
    start: State<L, N>,
    end: L,
    /// The states of its record so far.
    states: Vec<State<L, N>>,
}

impl<F, A, M, Q, B, S, T, V, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    Row<T> for Rows<F, A, M, Q, S, V, N, K, C, P, D>
where
    F: Fn(u64) -> B + Sync,
    A: Fn(&State<S::Scalar, N>, usize) -> Option<S::Scalar> + Sync,
    M: Fn(&[State<S::Scalar, N>]) -> Option<T> + Sync,
    Q: Fn(&mut Motion<'_, S, N, K>) -> Result<T, Failure> + Sync,
    B: Start<S, S::Scalar, N>,
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered + Into<f64>,
    V: Vector<Lane = S::Scalar>,
    S::Over<V>: Smooth<N, K>,
{
    fn row(&self, index: u64) -> Result<T, Failure> {
        let mut row = Err(Failure::new("no row"));
        self.rows(index, 1, &Cell::new(index), &mut |_, found| row = found);
        row
    }

    fn rows(&self, first: u64, count: u64, at: &Cell<u64>, put: &mut dyn FnMut(u64, Result<T, Failure>)) {
        let mut indices = first..first + count;
        let mut lanes: Vec<Option<Job<S::Scalar, N>>> = (0..V::COUNT).map(|_| None).collect();
        let mut template = None;
        let mut relay: Option<Relay<S::Over<V>, N, K>> = None;
        loop {
            let mut begun = Vec::new();
            for (lane, job) in lanes.iter_mut().enumerate() {
                while job.is_none()
                    && let Some(index) = indices.next()
                {
                    at.set(index);
                    match self.job(index, &mut template) {
                        Ok(Some(new)) => {
                            *job = Some(new);
                            begun.push(lane);
                        }
                        Ok(None) => put(index, self.alone(index)),
                        Err(failure) => put(index, Err(failure)),
                    }
                }
            }
            let like = lanes.iter().position(Option::is_some);
            let (Some(like), Some(template)) = (like, &template) else { return };
            let job = |lane: usize| lanes.get(lane).and_then(Option::as_ref);
            // An idle lane gets the numbers of a lane that is at work.
            let of = |lane| job(lane).or_else(|| job(like));
            if relay.is_none() || !begun.is_empty() || lanes.iter().any(Option::is_none) {
                let system =
                    gathered::<S, V, N, K, C, P, D>(template, |lane| of(lane).map(|job| &job.parameters[..]));
                let relay = match &mut relay {
                    Some(relay) => {
                        relay.set_system(system);
                        relay
                    }
                    none => none.insert(self.relay(system, of(like))),
                };
                for &lane in &begun {
                    if let Some(job) = job(lane) {
                        relay.begin(lane, &job.start, job.end);
                    }
                }
                for lane in (0..V::COUNT).filter(|lane| job(*lane).is_none()) {
                    relay.rest(lane, like);
                }
            }
            let Some(relay) = &mut relay else { return };
            if !relay.step() {
                relay.stop_unsolvable(|lane| {
                    gathered::<S, V, N, K, C, P, D>(template, |_| of(lane).map(|job| &job.parameters[..]))
                });
            }
            self.sample(relay, &mut lanes, template);
            for (lane, place) in lanes.iter_mut().enumerate() {
                let Some(job) = place else { continue };
                let index = job.index;
                match relay.standing(lane) {
                    Standing::Running => continue,
                    Standing::Arrived => {
                        job.states.push(get(relay.state(), lane));
                        match (self.record)(&job.states) {
                            Some(record) => put(index, Ok(record)),
                            None => put(index, self.alone(index)),
                        }
                    }
                    Standing::Stopped | Standing::Idle => {
                        at.set(index);
                        put(index, self.alone(index));
                    }
                }
                *place = None;
            }
        }
    }

    fn at_once(&self) -> u64 {
        MOTIONS_OF_A_LANE * V::COUNT as u64
    }

    fn refusal(&self) -> Option<&'static str> {
        Relay::<S::Over<V>, N, K>::unsuited()
    }
}

impl<F, A, M, Q, B, S, T, V, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    Rows<F, A, M, Q, S, V, N, K, C, P, D>
where
    F: Fn(u64) -> B + Sync,
    A: Fn(&State<S::Scalar, N>, usize) -> Option<S::Scalar> + Sync,
    M: Fn(&[State<S::Scalar, N>]) -> Option<T> + Sync,
    Q: Fn(&mut Motion<'_, S, N, K>) -> Result<T, Failure> + Sync,
    B: Start<S, S::Scalar, N>,
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered + Into<f64>,
    V: Vector<Lane = S::Scalar>,
    S::Over<V>: Smooth<N, K>,
{
    /// The motion of an index for a lane. `None` if a single motion would not begin, or if its record has no
    /// last time or one that is not finite. The first system is kept as `template`.
    fn job(&self, index: u64, template: &mut Option<S>) -> Result<Option<Job<S::Scalar, N>>, Failure> {
        let (system, start) = (self.ensemble.start)(index).start()?;
        let end = (0..).map_while(|k| (self.time)(&start, k)).last();
        // A motion checks tolerances, masses and names of quantities where it begins. The tables of a series
        // would be filled with zeros for nothing.
        let mut motion: Simulation<'_, S, Held<S::Scalar, K>, Dop853, N, K> =
            self.ensemble.settings.motion(&system, start);
        let begun = motion.advance_to(start.t).copied();
        let (Some(end), Ok(start)) = (end.filter(|end| end.is_finite()), begun) else { return Ok(None) };
        let mut parameters = Vec::new();
        system.over(|value, _| {
            parameters.push(value);
            value
        });
        let mut job = Job { index, parameters, start, end, states: Vec::new() };
        // The first sample may be the start itself, which needs no step.
        if (self.time)(&start, 0) == Some(start.t) && end != start.t {
            job.states.push(start);
        }
        template.get_or_insert(system);
        Ok(Some(job))
    }

    /// The row of a single motion.
    fn alone(&self, index: u64) -> Result<T, Failure> {
        let (system, start) = (self.ensemble.start)(index).start()?;
        (self.reduce)(&mut self.ensemble.settings.motion(&system, start))
    }

    fn relay(&self, system: S::Over<V>, like: Option<&Job<S::Scalar, N>>) -> Relay<S::Over<V>, N, K> {
        let number = S::Scalar::from_f64;
        let mut start = State { t: V::zero(), q: [V::zero(); N], v: [V::zero(); N] };
        for lane in 0..V::COUNT {
            like.into_iter().for_each(|job| set(&mut start, lane, &job.start));
        }
        let Settings { tolerances, longest, max_steps } = self.ensemble.settings;
        let mut relay = Relay::new(system, start);
        if let Some((relative, absolute)) = tolerances {
            relay = relay.with_tolerances(number(relative), absolute.map(number));
        }
        if let Some(longest) = longest {
            relay = relay.with_step_limit(number(longest));
        }
        if let Some(steps) = max_steps {
            relay = relay.with_max_steps(steps);
        }
        relay
    }

    /// Takes the states at times that the last step of a lane has passed, except the last state, at which the
    /// lane arrives.
    fn sample(
        &self,
        relay: &mut Relay<S::Over<V>, N, K>,
        lanes: &mut [Option<Job<S::Scalar, N>>],
        template: &S,
    ) {
        loop {
            let mut times = relay.state().t;
            let mut passed = Vec::new();
            for (lane, job) in lanes.iter().enumerate() {
                let Some(job) = job else { continue };
                if !matches!(relay.standing(lane), Standing::Running | Standing::Arrived) {
                    continue;
                }
                let Some(time) = (self.time)(&job.start, job.states.len()) else { continue };
                let (now, forward) = (relay.state().t.lane(lane), job.end >= job.start.t);
                let is_last = (self.time)(&job.start, job.states.len() + 1).is_none();
                if !is_last && (if forward { time <= now } else { time >= now }) {
                    times.set_lane(lane, time);
                    passed.push(lane);
                }
            }
            if passed.is_empty() {
                return;
            }
            let states = relay.within(times, &passed, |lane| {
                let job = lanes.get(lane).and_then(Option::as_ref);
                gathered::<S, V, N, K, C, P, D>(template, |_| job.map(|job| &job.parameters[..]))
            });
            for lane in passed {
                if relay.standing(lane) != Standing::Stopped
                    && let Some(Some(job)) = lanes.get_mut(lane)
                {
                    job.states.push(get(&states, lane));
                }
            }
        }
    }
}

/// The system with the parameters of a lane in each lane.
fn gathered<'a, S, V, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>(
    template: &S,
    parameters: impl Fn(usize) -> Option<&'a [V::Lane]>,
) -> S::Over<V>
where
    S: Sensitive<N, K, C, P, D>,
    V: Vector<Lane = S::Scalar>,
{
    let mut place = 0;
    template.over(|value, _| {
        let mut vector = V::splat(value);
        for lane in 0..V::COUNT {
            if let Some(value) = parameters(lane).and_then(|parameters| parameters.get(place)) {
                vector.set_lane(lane, *value);
            }
        }
        place += 1;
        vector
    })
}
