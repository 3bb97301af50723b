//! Infinitely many impacts in finite time.
//!
//! The impacts of a ball that bounces come ever faster, and so do those of a block that rocks from corner to
//! corner. Their times are geometric: the lower the bounces, the shorter is the rest of them. A contact may
//! open so slowly that the tolerance cannot tell, while forces close it again. Then all impacts that would
//! follow are taken together with this one, and the contact stays closed and at rest.

use super::choice::{Choice, Sizes};
use super::impact::Struck;
use super::known::Known;
use super::scales::Scales;
use super::scene::{Scene, Status, above, entry, extent, most, put, rounding};
use super::sided::laws_on;
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::state::State;

/// The shortest flight that counts, in rounding errors of gaps and of times.
pub(super) const RESOLVED: f64 = 64.0;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Removes the closing velocities of contacts that touch and stay open in a regime, and the velocities
    /// against the slips that begin in it, in the metric of the kinetic energy. They are rounding errors, but
    /// the smallest of them would close the contacts, or end the slips, again at once.
    pub(super) fn part(&self, regime: &Regime<S::Scalar, C, W>, state: &mut State<S::Scalar, N>) {
        let zero: S::Scalar = num_traits::Zero::zero();
        // The direction that is excluded.
        let against = |row: usize| match (S::ROWS.get(row), self.status.get(row)) {
            (Some(Row::Unilateral), Some(Status::Touches)) if regime.active.get(row) == Some(&false) => {
                -<S::Scalar as num_traits::One>::one()
            }
            (Some(Row::Friction { pair: None, .. }), Some(Status::Rests)) => -entry(&regime.slip, row),
            _ => zero,
        };
        if (0..C).all(|row| against(row) == zero) {
            return;
        }
        let rates = laws_on(self.system, state, self.inputs, &self.kinks).rows.rates;
        let State { t, q, v } = state;
        let (mut closed, mut wanted) = (*regime, [zero; C]);
        let is_against = |row: &usize| (against(*row) * entry(&rates, *row)).is_positive();
        if !(0..C).any(|row| is_against(&row)) {
            return;
        }
        let Some((_, sizes)) = self.balance(regime, v) else { return };
        // Not by index: the compiler for graphics processors does not rule out its panic here.
        for row in (0..C).filter(is_against) {
            let rate = entry(&rates, row);
            if self.is_noise(row, rate, &sizes, v) {
                put(&mut closed.active, row, true);
                put(&mut closed.slip, row, zero);
                put(&mut wanted, row, -rate.part(0));
            }
        }
        if closed.active == regime.active {
            return;
        }
        let Some(equations) = S::equations_in(&self.system.in_regime(&closed), *t, q, v, self.inputs) else {
            return;
        };
        let (changes, _) = equations.saddle.solve(&[zero; N], &wanted);
        for (v, change) in v.iter_mut().zip(changes).filter(|(_, change)| change.is_finite()) {
            *v += change.part(0);
        }
    }

    /// Whether the motion does not notice that velocities lose what they contribute to the rate of a row. The
    /// loss is measured by its part of γ, the acceleration of the row that velocities make. Where the
    /// gradient nearly vanishes, as that of the place of a slider in a dead centre, all of the velocity
    /// contributes nearly nothing to the rate, and all of γ.
    fn is_noise(&self, row: usize, rate: S::Scalar, sizes: &Sizes<S::Scalar, N>, v: &[S::Scalar; N]) -> bool {
        let zero: S::Scalar = num_traits::Zero::zero();
        let Some(gradient) = self.gradients.get(row) else { return false };
        let (mut square, mut fastest) = (zero, zero);
        for ((&entry, &v), &unit) in gradient.iter().zip(v).zip(&self.units) {
            if unit.is_positive() {
                square += (entry * unit) * (entry * unit);
                fastest = most(fastest, v.abs() / unit);
            }
        }
        let lost = rate.abs() * entry(&self.gamma, row).abs();
        let own = S::Scalar::epsilon().sqrt() * self.extent_of(row, &sizes.accelerations);
        !above(lost, own * square.sqrt() * fastest)
    }

    /// The cause of the end of a motion with derivatives where impacts are taken together.
    #[cold]
    pub(super) fn accumulation(&self) -> Cause {
        let opens = |row: &usize| self.is_closed[*row] && self.status[*row] == Status::Apart;
        let constraint = (0..C).find(opens).unwrap_or(0);
        Cause::ImpactsAccumulate { constraint, name: S::NAMES.constraint(constraint) }
    }

    /// What forces or impulses of these sizes, each by itself, do to the rate of a row.
    pub(super) fn effect(&self, row: usize, sizes: &[S::Scalar; N]) -> S::Scalar {
        let Some(gradient) = self.gradients.get(row) else { return num_traits::Zero::zero() };
        let by_size: [S::Scalar; N] = array(|i| self.units[i] * self.units[i] * sizes[i]);
        extent(gradient, &by_size)
    }

    /// Adds the sizes of the forces or impulses of rows to those of coordinates.
    pub(super) fn load(&self, multipliers: &[S::Scalar; C], sizes: &mut [S::Scalar; N]) {
        for (gradient, &multiplier) in self.gradients.iter().zip(multipliers) {
            for (size, &entry) in sizes.iter_mut().zip(gradient) {
                *size += (entry * multiplier).abs();
            }
        }
    }

    /// The slips that an impact has left with nothing but rounding errors of its impulses.
    pub(super) fn stopped(&self, v: &[S::Scalar; N], impulses: &[S::Scalar; C]) -> [bool; C] {
        let mut sizes = [num_traits::Zero::zero(); N];
        self.load(impulses, &mut sizes);
        array(|row| {
            let Some(Row::Friction { pair, .. }) = S::ROWS.get(row) else { return false };
            let of = |row: usize| self.rate_at(row, v);
            let other = pair.map_or(num_traits::Zero::zero(), of);
            let effect = self.effect(row, &sizes);
            let effect = pair.map_or(effect, |other| most(effect, self.effect(other, &sizes)));
            !above(of(row).hypot(other), rounding::<S::Scalar>() * effect)
        })
    }

    /// A regime with the contacts that touch closed, and friction at rest sticking.
    pub(super) fn touching(&self, present: &Regime<S::Scalar, C, W>) -> Regime<S::Scalar, C, W> {
        let mut regime = *present;
        for (row, (kind, status)) in S::ROWS.iter().zip(&self.status).enumerate() {
            match (kind, status) {
                (Row::Unilateral, Status::Touches) => put(&mut regime.active, row, true),
                (Row::Friction { .. }, Status::Rests) => {
                    put(&mut regime.active, row, true);
                    put(&mut regime.slip, row, num_traits::Zero::zero());
                }
                _ => {}
            }
        }
        regime
    }

    /// The velocities with those contacts closed that would open for a negligible time only, and the impulses
    /// that close them. `None` where no contact is of this kind, or these impulses are not found. The scene
    /// is one without an impact; the motion goes on with these accelerations.
    ///
    /// Where an impact opens them, its scene before it and its impulses are `struck`. Then the impact leaves
    /// them closed instead. Until a body that bounces comes to rest, its contact gives the impulse of that
    /// impact and of the forces in this time, and with it the friction of both. Where no impact opens them,
    /// they close with the velocities at which they would come back.
    pub(super) fn gathered(
        &self,
        accelerations: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        tolerance: S::Scalar,
        struck: Option<(&Self, &[S::Scalar; C])>,
    ) -> Option<Struck<S::Scalar, N, C>> {
        let tolerance = most(tolerance, S::Scalar::from_f64(16.0) * S::Scalar::epsilon());
        let mut slow = self.slow(accelerations, scales, tolerance)?;
        let zero: S::Scalar = num_traits::Zero::zero();
        let before = struck.map_or([zero; C], |(_, impulses)| *impulses);
        let both = |(v, impulses): Struck<S::Scalar, N, C>| (v, array(|row| before[row] + impulses[row]));
        if let Some(rest) = self.at_rest(scales, tolerance, None) {
            return Some(both(rest));
        }
        let landed = struck.and_then(|(before, _)| before.landing(&slow));
        let mut found = match landed {
            Some(landed) => landed,
            None => both(self.closed_together(&slow, scales)?),
        };
        // A contact that closes may open another one as slowly, and that one the first one again, as a box
        // does on a plank that rests on a stop. They close together.
        for _ in 0..C {
            let Some(more) = self.slow_after(&found.0, scales, tolerance) else { break };
            let last = slow;
            slow = array(|row| last[row] || more[row]);
            if slow == last {
                break;
            }
            let Some(together) = self.closed_together(&slow, scales) else { break };
            found = both(together);
        }
        // Two feet that strike in turn, of which one sticks and the other slides, leave no motion after an
        // impact of both.
        let settled = Known { settled: true, only: true, ..Known::struck(self.is_closed) };
        if self.after(&found.0, scales, &settled).1.is_none()
            && let Some(rest) = self.at_rest(scales, tolerance, Some(accelerations))
        {
            return Some(both(rest));
        }
        Some(found)
    }

    /// The scene with other velocities and the choice of the regime that follows; `None` where none does.
    #[cold]
    fn after(
        &self,
        v: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        known: &Known<C>,
    ) -> (Self, Option<Choice<S::Scalar, N, C, W>>) {
        let state = State { v: *v, ..self.state };
        let scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, known);
        let open = Regime { kinks: self.kinks, ..Regime::open(&S::ROWS) };
        let choice = scene.choose(&scene.touching(&open), None).ok();
        (scene, choice)
    }

    /// Which closed contacts open for a negligible time; `None` if no contact does.
    fn slow(
        &self,
        accelerations: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        tolerance: S::Scalar,
    ) -> Option<[bool; C]> {
        let slow: [bool; C] = array(|row| {
            let (rate, pull) = (self.laws.rows.rates[row], -self.rate(row, accelerations));
            self.is_closed[row]
                && self.status[row] == Status::Apart
                && pull.is_positive()
                && !above(rate, self.unseen(row, pull, scales, tolerance))
        });
        slow.contains(&true).then_some(slow)
    }

    /// The rate up to which a contact opens for a negligible time, if forces close it with this `pull`.
    fn unseen(
        &self,
        row: usize,
        pull: S::Scalar,
        scales: &Scales<S::Scalar, C>,
        tolerance: S::Scalar,
    ) -> S::Scalar {
        let resolved = S::Scalar::from_f64(RESOLVED) * S::Scalar::epsilon();
        let pull = most(num_traits::Zero::zero(), pull);
        let struck = entry(&scales.impacts, row);
        let speed = if struck.is_positive() { struck } else { entry(&scales.speeds, row) };
        // A sine near π is zero, but has the rounding errors of π.
        let size = most(entry(&self.laws.rows.position_sizes, row), self.extent_of(row, &self.state.q));
        let by_gap = ((pull + pull) * resolved * size).sqrt();
        most(tolerance * speed, most(by_gap, pull * resolved * self.state.t.abs()))
    }

    /// The slow contacts after other velocities; `None` also where no motion follows from them.
    #[cold]
    fn slow_after(
        &self,
        v: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        tolerance: S::Scalar,
    ) -> Option<[bool; C]> {
        let (scene, choice) = self.after(v, scales, &Known::struck(self.is_closed));
        scene.slow(&choice?.accelerations, scales, tolerance)
    }

    /// The velocities with these contacts closed, and the impulses that close them.
    fn closed_together(
        &self,
        slow: &[bool; C],
        scales: &Scales<S::Scalar, C>,
    ) -> Option<Struck<S::Scalar, N, C>> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let rates = &self.laws.rows.rates;
        let mut closed = Regime { kinks: self.kinks, ..Regime::open(&S::ROWS) };
        let mut wanted = [zero; C];
        for (row, kind) in S::ROWS.iter().enumerate() {
            let holds = match kind {
                Row::Bilateral | Row::Load => false,
                Row::Unilateral => slow[row] || self.status[row] == Status::Touches,
                // Friction at rest in a contact that touches goes on to stick. That of the slow ones acts in
                // the impact below.
                Row::Friction { normal: Some(_), .. } => self.status[row] == Status::Rests,
                Row::Friction { normal: None, .. } => false,
            };
            if holds {
                closed.active[row] = true;
                wanted[row] = -rates[row];
            }
        }
        // Forces turn the velocity of a short flight round.
        let State { t, q, v } = &self.state;
        let turned = array(|row| if slow[row] { wanted[row] + wanted[row] } else { wanted[row] });
        let equations = S::equations_in(&self.system.in_regime(&closed), *t, q, v, self.inputs)?;
        let (change, _) = equations.saddle.solve(&[zero; N], &turned);
        let back = State { v: array(|i| v[i] + change[i]), ..self.state };
        let known = Known::new(*slow);
        let landing = Scene::new(self.system, &back, self.inputs, self.kinks, scales, &known);
        let (mut v, mut impulses) = landing.plastic().ok()?;
        // In a corner, each contact opens another one: passages follow each other as bounces do. What they
        // leave at last is the part of the velocity that opens or closes none of them.
        let share = S::Scalar::epsilon().sqrt();
        let goes_on = |row: usize| above(landing.rate_at(row, &v), share * entry(rates, row));
        if slow.iter().enumerate().any(|(row, &slow)| slow && goes_on(row)) {
            let (change, all) = equations.saddle.solve(&[zero; N], &wanted);
            v = array(|i| self.state.v[i] + change[i]);
            impulses = pushing(&S::ROWS, &all);
        }
        Some((v, impulses))
    }

    /// The velocities with all closed contacts and their frictions at rest, and the impulses that bring them
    /// there. `None` where the tolerance can tell that one of them moves, or where they would not stay at
    /// rest. With the accelerations of flights it may tell that frictions move. Those that are no faster than
    /// flights that count as none come to rest, and others go on to slide.
    ///
    /// Parts that rattle on each other, as a tower that has rocked, may never open one contact for longer
    /// than others. They come to rest together.
    #[cold]
    fn at_rest(
        &self,
        scales: &Scales<S::Scalar, C>,
        tolerance: S::Scalar,
        flights: Option<&[S::Scalar; N]>,
    ) -> Option<Struck<S::Scalar, N, C>> {
        let rates = &self.laws.rows.rates;
        let is_closed = |row: usize| self.is_closed.get(row) == Some(&true);
        let moves = |row: usize| {
            let unseen = match (flights, S::ROWS.get(row)) {
                (None, _) => tolerance * most(entry(&scales.impacts, row), entry(&scales.speeds, row)),
                (Some(flights), Some(&Row::Friction { normal: Some(contact), .. })) => {
                    self.unseen(contact, -self.rate(contact, flights), scales, tolerance)
                }
                (Some(flights), _) => self.unseen(row, -self.rate(row, flights), scales, tolerance),
            };
            above(entry(rates, row).abs(), unseen)
        };
        let holds: [bool; C] = array(|row| match S::ROWS.get(row) {
            Some(&Row::Friction { normal: Some(normal), pair }) => {
                let slides = || flights.is_some() && (moves(row) || pair.is_some_and(moves));
                is_closed(normal) && !self.is_frictionless(row) && !slides()
            }
            _ => is_closed(row),
        });
        let (zero, mut wanted) = (num_traits::Zero::zero(), [num_traits::Zero::zero(); C]);
        let mut closed = Regime { kinks: self.kinks, ..Regime::open(&S::ROWS) };
        for (row, _) in holds.iter().enumerate().filter(|(_, holds)| **holds) {
            if moves(row) {
                return None;
            }
            put(&mut closed.active, row, true);
            put(&mut wanted, row, -entry(rates, row));
        }
        let State { t, q, v } = &self.state;
        let equations = S::equations_in(&self.system.in_regime(&closed), *t, q, v, self.inputs)?;
        let (change, impulses) = equations.saddle.solve(&[zero; N], &wanted);
        let v = array(|i| v[i] + change[i]);
        let known = Known { rested: holds, ..Known::struck(self.is_closed) };
        let state = State { v, ..self.state };
        let scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, &known);
        let choice = scene.choose(&closed, None).ok()?;
        let stays = choice.regime.active.iter().zip(&holds).all(|(active, holds)| *active || !holds);
        stays.then(|| (v, pushing(&S::ROWS, &impulses)))
    }
}

/// Impulses without those of contacts that pull: they are rounding errors.
fn pushing<R: Real, const C: usize>(rows: &[Row; C], impulses: &[R; C]) -> [R; C] {
    let mut pushing = *impulses;
    for (impulse, _) in pushing.iter_mut().zip(rows).filter(|(_, kind)| **kind == Row::Unilateral) {
        *impulse = most(*impulse, R::zero());
    }
    pushing
}
