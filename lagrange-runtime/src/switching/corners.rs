//! The way through a kink, and corners of the functions that contain it.

use super::run::{CHANGES, Run};
use super::scene::{above, entry, most, put, rounding};
use super::sided::along;
use super::way::shift;
use super::{Regime, Row, Switching, Wanted};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, any};
use crate::number::rounded::Rounded;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::Adaptive;
use crate::system::name::Name;
use crate::system::state::State;

/// The rounding errors of time by which a state beside a kink may lie on its other side.
const HIDDEN: f64 = 16.0;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// Takes a regime to the other side of a kink. That is an error where the motion is held at the kink, or
    /// where something jumps that must not.
    pub(super) fn cross(
        &mut self,
        kink: usize,
        present: &mut Regime<S::Scalar, C, W>,
        state: &State<S::Scalar, N>,
    ) -> Result<(), Cause> {
        let name = S::KINKS.get(kink).copied().unwrap_or(Name::NONE);
        let flips = self.memory.flips.get_mut(kink);
        let (Some(side), Some(flips)) = (present.kinks.get_mut(kink), flips) else { return Ok(()) };
        *side = -*side;
        let side = *side;
        *flips += 1;
        if *flips > CHANGES {
            return Err(Cause::HeldAtKink { kink, name });
        }
        self.passable(kink, state)?;
        let lost = self.leap(kink, side, state)?;
        for (row, own) in S::ROWS.iter().enumerate() {
            let is_lost = |row: usize| lost.get(row) == Some(&true);
            let of_lost = matches!(own, Row::Friction { normal: Some(normal), .. } if is_lost(*normal));
            if is_lost(row) || of_lost {
                put(&mut present.active, row, false);
            }
        }
        Ok(())
    }

    /// Refuses a kink at which an energy or a momentum jumps.
    fn passable(&mut self, kink: usize, state: &State<S::Scalar, N>) -> Result<(), Cause> {
        let name = S::KINKS.get(kink).copied().unwrap_or(Name::NONE);
        // An energy that jumps would act by a force at one point, which no equation contains.
        let energy_at = |State { t, q, v }: &State<S::Scalar, N>| {
            self.system.jumps_at(*t, q, v, &self.control.0).each(|numbers| entry(&numbers, kink))
        };
        if jumps(state, &self.memory.start, &energy_at) {
            return Err(Cause::EnergyJumps { kink, name });
        }
        if self.has_corner(kink, state) {
            return Err(Cause::MomentumJumps { kink, name });
        }
        Ok(())
    }

    /// The closed contacts that lose what they lay on: their gaps jump up, as at the edge of a table.
    ///
    /// # Errors
    /// [`Cause::GapJumps`] where a constraint jumps, or a gap is below zero behind the kink: no velocity
    /// leads there.
    fn leap(&self, kink: usize, side: S::Scalar, state: &State<S::Scalar, N>) -> Result<[bool; C], Cause> {
        let State { t, q, v } = state;
        let inputs = &self.control.0;
        // The gaps as they were before the kink.
        let wanted = Wanted { rows: [true; C], fixed: [false; C], kinks: [false; W] };
        let gaps = S::functions_in(&self.memory.in_regime, |x| x, *t, q, v, inputs, &wanted).rows;
        let before = self.system.laws_at(*t, q, v, inputs).rows.position_sizes;
        // What is zero before the kink may be the difference of large numbers behind it.
        let behind = self.sizes_behind(kink, state);
        let sizes: [S::Scalar; C] = array(|row| most(before[row], behind[row]));
        let (mut found, mut lost) = (Ok(()), [false; C]);
        let gain_at = |row: usize, at: &State<S::Scalar, N>| break_at(self.system, [kink, row], at, inputs);
        self.system.breaks_at(*t, q, v, inputs, |own, row, gain| {
            let seen = most(entry(&sizes, row), entry(&self.memory.scales.gaps, row));
            let size = S::Scalar::epsilon().sqrt() * seen;
            let is_known = || above(gain.abs(), roundings(state, &self.memory.start, &|at| gain_at(row, at)));
            if own != kink || !above(gain.abs(), size) || !is_known() {
                return;
            }
            let is_closed = self.memory.regime.active.get(row) == Some(&true);
            let is_held = is_closed && S::ROWS.get(row) != Some(&Row::Unilateral);
            if is_held || above(-size, entry(&gaps, row) + side * gain) {
                found = Err(Cause::GapJumps { constraint: row, name: S::NAMES.constraint(row) });
            }
            put(&mut lost, row, is_closed);
        });
        found.map(|()| lost)
    }

    /// Σ |summands| of gaps behind a kink.
    fn sizes_behind(&self, kink: usize, state: &State<S::Scalar, N>) -> [S::Scalar; C] {
        let mut kinks = self.memory.regime.kinks;
        if let Some(side) = kinks.get_mut(kink) {
            *side = -*side;
        }
        let in_regime = self.system.in_regime(&Regime { kinks, ..Regime::open(&S::ROWS) });
        let ulp = S::Scalar::epsilon();
        let rounded = |value: S::Scalar| Rounded { value, error: ulp * value.abs() };
        let [q, v] = [&state.q, &state.v].map(|numbers| numbers.each(rounded));
        let inputs = self.control.0.each(Rounded::exact);
        let wanted = Wanted { rows: [true; C], fixed: [false; C], kinks: [false; W] };
        let gaps =
            S::functions_in(&in_regime, Rounded::exact, rounded(state.t), &q, &v, &inputs, &wanted).rows;
        gaps.each(|gap| gap.error / ulp)
    }

    /// Whether a momentum or the rate of a constraint jumps at a kink, so that velocities do not go through
    /// it as they are. At the kink itself a function may be nothing but rounding errors, and so may its gain,
    /// as at the smooth join of two rails. So the gain has to count beside the function and the gain in the
    /// middle of the piece as well, and has to be more than the rounding errors of the state make of it.
    fn has_corner(&mut self, kink: usize, state: &State<S::Scalar, N>) -> bool {
        let part = S::Scalar::epsilon().sqrt();
        let mut middle = None;
        let mut place = 0;
        let mut found = false;
        let system = self.system;
        let memory = &mut *self.memory;
        let (inner, in_regime, constants) = (&mut memory.inner, &memory.in_regime, &memory.constants);
        let (control, limits, start) = (self.control, self.limits, memory.start);
        let visited = |number: usize, at: &State<S::Scalar, N>| corner_at(system, number, at, &control.0);
        system.corners_at(state.t, &state.q, &state.v, &control.0, |own, gain, size| {
            place += 1;
            if found || own != kink || !above(gain.abs(), part * size) {
                return;
            }
            let half = S::Scalar::from_f64(0.5) * (start.t + state.t);
            let middle = *middle.get_or_insert_with(|| {
                M::sample(inner, in_regime, constants, control, limits, half, &mut 0).unwrap_or(start)
            });
            let counts = |size: S::Scalar| !size.is_finite() || above(gain.abs(), part * size);
            let gain_at = |state: &State<S::Scalar, N>| visited(place, state)[0];
            found = visited(place, &middle).into_iter().all(|size| counts(size.abs()))
                && !above(roundings(state, &middle, &gain_at), gain.abs());
        });
        found
    }

    /// The time after a kink from which on the gradients of the gaps that are closed are known \[s]: zero if
    /// they are known at the kink itself. The distance from the edge of a table, for example, has no gradient
    /// on the edge, but it grows where the motion goes: there the contact opens, and needs none.
    ///
    /// # Errors
    /// [`Cause::VanishingGradient`] if rounding errors decide about a gradient, and the gap does not open.
    pub(super) fn beyond_corner(
        &self,
        place: &State<S::Scalar, N>,
        kinks: &[S::Scalar; W],
    ) -> Result<S::Scalar, Cause> {
        let none: S::Scalar = num_traits::Zero::zero();
        let is_closed = |row: usize| {
            S::ROWS.get(row) == Some(&Row::Unilateral) && self.memory.regime.active.get(row) == Some(&true)
        };
        if !(0..C).any(is_closed) {
            return Ok(none);
        }
        let passed = most(place.t.abs(), (place.t - self.memory.start.t).abs()).part(0);
        let hidden = S::Scalar::from_f64(HIDDEN) * S::Scalar::epsilon() * passed;
        let beside = |steps: f64| {
            let mut state = *place;
            shift(&mut state, &[none; N], S::Scalar::from_f64(steps) * hidden);
            state.at_time(place.t + S::Scalar::from_f64(steps) * hidden)
        };
        let in_regime = self.system.in_regime(&Regime { kinks: *kinks, ..self.memory.regime });
        let gradients = [-1.0, 0.0, 1.0].map(|steps| {
            let State { t, q, v } = beside(steps);
            S::rows_in(&in_regime, t, &q, &v, &self.control.0)
        });
        let [Some(before), Some(there), Some(after)] = gradients else { return Ok(none) };
        // A gradient that changes by half of its digits within a time that rounding hides is not known.
        let is_known = |row: usize| {
            let (mut change, mut size) = (none, none);
            for (i, &unit) in before.units.iter().enumerate() {
                let [one, two, three] = [&before, &there, &after].map(|rows| entry(&rows.gradients[row], i));
                change += ((one - two).abs() + (two - three).abs()) * unit;
                size += (one.abs() + two.abs() + three.abs()) * unit;
            }
            let is_finite = size.is_finite() && entry(&there.gamma, row).is_finite();
            is_finite && !above(change, S::Scalar::epsilon().sqrt() * size)
        };
        let unknown: [bool; C] = array(|row| is_closed(row) && !is_known(row));
        if !unknown.contains(&true) {
            return Ok(none);
        }
        let wanted = Wanted { rows: unknown, fixed: [false; C], kinks: [false; W] };
        let [near, far] = [1.0, 2.0].map(|steps| {
            along(self.system, &beside(steps), &[none; N], &self.control.0, kinks, &wanted).rows
        });
        // Rates that are positive and nearly the same tell that a gap opens.
        let opens = |row: usize| {
            let [near, far] = [near[row].slopes[0], far[row].slopes[0]];
            above(near, S::Scalar::from_f64(2.0) * (far - near).abs())
        };
        match (0..C).find(|&row| unknown[row] && !opens(row)) {
            None => Ok(hidden),
            Some(row) => Err(Cause::VanishingGradient { constraint: row, name: S::NAMES.constraint(row) }),
        }
    }
}

/// The gain of a momentum or rate at a state, and Σ |summands|, by its number among those that the system
/// visits, from one on.
pub(super) fn corner_at<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    number: usize,
    State { t, q, v }: &State<S::Scalar, N>,
    inputs: &[S::Scalar; K],
) -> [S::Scalar; 2]
where
    S: Switching<N, K, C, W>,
{
    let (mut visited, mut found) = (0, [num_traits::Zero::zero(); 2]);
    system.corners_at(*t, q, v, inputs, |_, gain, size| {
        visited += 1;
        if visited == number {
            found = [gain, size];
        }
    });
    found
}

/// The gain of a gap or constraint at a state where a kink is; zero if it has none there.
pub(super) fn break_at<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    [kink, row]: [usize; 2],
    State { t, q, v }: &State<S::Scalar, N>,
    inputs: &[S::Scalar; K],
) -> S::Scalar
where
    S: Switching<N, K, C, W>,
{
    let mut found = num_traits::Zero::zero();
    system.breaks_at(*t, q, v, inputs, |own, other, gain| {
        if own == kink && other == row {
            found = gain;
        }
    });
    found
}

/// Whether a quantity jumps at a state: its gain counts beside Σ |summands|, and rounding errors of the state
/// do not explain it. `quantity` gives the gain and Σ |summands|.
pub(super) fn jumps<R: Real, const N: usize>(
    here: &State<R, N>,
    elsewhere: &State<R, N>,
    quantity: &impl Fn(&State<R, N>) -> [R; 2],
) -> bool {
    let [gain, size] = quantity(here);
    let counts = gain.abs() - R::epsilon().sqrt() * size;
    any(counts) && any(counts.min(gain.abs() - roundings(here, elsewhere, &|at| quantity(at)[0])))
}

/// What the rounding errors of a state make of a function. Those of a coordinate belong to its largest value,
/// here or elsewhere.
fn roundings<R: Real, const N: usize>(
    here: &State<R, N>,
    elsewhere: &State<R, N>,
    function: &impl Fn(&State<R, N>) -> R,
) -> R {
    let value = function(here);
    let error = |a: R, b: R| rounding::<R>() * most(a.abs(), b.abs());
    let change = |state: &State<R, N>| (function(state) - value).abs();
    let by_time = change(&here.at_time(here.t + error(here.t, elsewhere.t)));
    (0..N).fold(by_time, |sum, i| {
        let [mut at_q, mut at_v] = [*here; 2];
        at_q.q[i] += error(here.q[i], elsewhere.q[i]);
        at_v.v[i] += error(here.v[i], elsewhere.v[i]);
        sum + change(&at_q) + change(&at_v)
    })
}
