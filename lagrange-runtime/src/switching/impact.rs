//! Impacts: complementarity on the level of velocities.
//!
//! Bodies are rigid, so an impact takes no time and forces of a given size have no part in it: dry joints
//! with a given limit turn freely, bilateral constraints keep their velocities. Newton's law holds for all
//! contacts that touch at the moment: u⁺ + e u⁻ ≥ 0 ⟂ Λ ≥ 0 with the coefficient e of each, or zero for one
//! that opens already. Friction obeys Coulomb's law for impulses: it sticks while |Λₜ| ≤ μ Λₙ, else
//! |Λₜ| = μ Λₙ against the slip after the impact (Pfeiffer and Glocker, *Multibody Dynamics with Unilateral
//! Contacts*, chapter 8; Brogliato, *Nonsmooth Mechanics*, 4.3).
//!
//! With Poisson's law the impulses of a plastic impact, that of the compression, are followed by those of an
//! expansion, of which each contact gives at least e times what it took; friction obeys its law in either
//! phase (Pfeiffer and Glocker, 8.3). Where one of the contacts follows it, all that touch do.
//!
//! With friction, or with several contacts of different coefficients, such laws can create energy, or have
//! no solution. Then the impulses are 1 + e times those of a plastic impact instead. Here e is the least
//! coefficient of the contacts that strike, or less where another contact would be penetrated. Such impulses
//! add no energy. Along the line from the velocities before the plastic impact through those after it the
//! kinetic energy is a parabola. Its lowest point lies at the plastic impact or beyond, so up to twice that
//! distance the energy is no larger than before.

use super::known::Known;
use super::pivoting::{entry_of, marked};
use super::scales::Scales;
use super::scene::{Scene, Status, above, entry, most, product, rounding};
use super::trials::{FEW, Options, Part, changes, combinations, combine, thresholds};
use super::{Laws, Row, Switching};
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::state::State;

/// Velocities after an impact, and the impulses of all rows.
pub(super) type Struck<R, const N: usize, const C: usize> = ([R; N], [R; C]);

/// The demands of an impact on contacts.
#[derive(Clone, Copy)]
pub(super) struct Demand<R, const C: usize> {
    /// The part of its closing velocity with which a contact must open.
    pub(super) restitution: [R; C],
    /// Impulses that contacts give in any case, beside the unknown ones.
    pub(super) given: [R; C],
}

impl<R: Real, const C: usize> Demand<R, C> {
    /// The demand that contacts stay closed, and no more.
    fn plastic() -> Self {
        Self { restitution: [R::zero(); C], given: [R::zero(); C] }
    }
}

/// Changes of velocities and the impulses that make them.
pub(super) struct Impulses<R, const N: usize, const C: usize> {
    pub(super) changes: [R; N],
    pub(super) impulses: [R; C],
    /// Rows that hold.
    pub(super) active: [bool; C],
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The velocities after the impact, and its impulses. Fails as `strike` does where even a plastic impact
    /// has no solution.
    pub(super) fn impact(&self) -> Result<Struck<S::Scalar, N, C>, Cause> {
        let restitution = &self.laws.restitution;
        let zero: S::Scalar = num_traits::Zero::zero();
        let by_law = if (0..C).any(|row| S::POISSON[row] && self.is_closed[row]) {
            self.by_poisson()
        } else {
            self.strike(&Demand { restitution: *restitution, given: [zero; C] })
        };
        if let Some(strike) = by_law.ok().filter(|strike| !self.gains(strike)) {
            return Ok((self.left_by(&strike), strike.impulses));
        }
        let plastic = self.strike(&Demand::plastic())?;
        let mut least: S::Scalar = num_traits::One::one();
        let rows = self.status.iter().zip(&self.is_closed).zip(&self.laws.rows.rates);
        for (((status, &is_closed), &before), (&e, gradient)) in
            rows.zip(restitution.iter().zip(&self.gradients))
        {
            let slows = -product(gradient, &plastic.changes);
            // A contact that opens already is not driven into penetration.
            let most = match status {
                Status::Meets => e,
                Status::Apart if is_closed && slows.is_positive() => (before - slows) / slows,
                _ => continue,
            };
            if above(least, most) {
                least = if most.is_positive() { most } else { zero };
            }
        }
        let more = |x: S::Scalar| x + least * x;
        let changes = plastic.changes.each(more);
        Ok((array(|i| self.state.v[i] + changes[i]), plastic.impulses.each(more)))
    }

    /// The velocities after the impulses of the laws. Where a single contact holds, all changes are in
    /// proportion to its impulse. A change is larger than the velocity that it leaves, and so are its
    /// roundings. They are made up for by what the rate of the contact lacks of Newton's law, if that is no
    /// more: with Poisson's law and friction it may be.
    fn left_by(&self, strike: &Impulses<S::Scalar, N, C>) -> [S::Scalar; N] {
        let (v, changes) = (&self.state.v, &strike.changes);
        let after = array(|i| v[i] + changes[i]);
        let mut active = (0..C).filter(|&row| strike.active[row]);
        let (Some(row), None) = (active.next(), active.next()) else { return after };
        if self.status[row] != Status::Meets {
            return after;
        }
        let (gradient, before) = (&self.gradients[row], self.laws.rows.rates[row]);
        let driven = before - product(gradient, v);
        let lack = -(self.laws.restitution[row] * before) - (product(gradient, &after) + driven);
        let share = lack / product(gradient, changes);
        if !share.is_finite() || above(share.abs(), rounding()) {
            return after;
        }
        array(|i| Real::mul_add(share, changes[i], after[i]))
    }

    /// The velocities after an impact that leaves contacts closed, and its impulses.
    pub(super) fn plastic(&self) -> Result<Struck<S::Scalar, N, C>, Cause> {
        let strike = self.strike(&Demand::plastic())?;
        Ok((array(|i| self.state.v[i] + strike.changes[i]), strike.impulses))
    }

    /// The same where some contacts stay closed and the others obey Newton's law. `None` where it has no
    /// solution or adds energy, for other laws, and where the impulses at others open one of them.
    #[cold]
    pub(super) fn landing(&self, rests: &[bool; C]) -> Option<Struck<S::Scalar, N, C>> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut rows = S::POISSON.iter().zip(&self.is_closed).zip(rests);
        let has_other = rows.any(|((is_poisson, is_closed), rests)| *is_poisson && *is_closed && !*rests);
        if has_other {
            return None;
        }
        let mut restitution = self.laws.restitution;
        for (restitution, _) in restitution.iter_mut().zip(rests).filter(|(_, rests)| **rests) {
            *restitution = zero;
        }
        let strike = self.strike(&Demand { restitution, given: [zero; C] }).ok()?;
        let opens = rests.iter().zip(&strike.active).any(|(rests, is_active)| *rests && !is_active);
        if opens || self.gains(&strike) {
            return None;
        }
        Some((array(|i| self.state.v[i] + strike.changes[i]), strike.impulses))
    }

    /// The compression and the expansion of Poisson's law together.
    fn by_poisson(&self) -> Result<Impulses<S::Scalar, N, C>, Cause> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let compression = self.strike(&Demand::plastic())?;
        let given = array(|row| match S::ROWS[row] {
            Row::Unilateral if self.is_closed[row] => self.laws.restitution[row] * compression.impulses[row],
            _ => zero,
        });
        let v = array(|i| self.state.v[i] + compression.changes[i]);
        let known = Known::struck(self.is_closed);
        let scales = Scales { speeds: self.speeds, ..Scales::new() };
        let state = State { v, ..self.state };
        let between = Scene::new(self.system, &state, self.inputs, self.kinks, &scales, &known);
        // Coefficients are those of the velocities before the impact, in both phases.
        let laws = Laws { rows: between.laws.rows, ..self.laws };
        let between = Scene { laws, coefficients: self.coefficients, ..between };
        let expansion = between.strike(&Demand { given, ..Demand::plastic() })?;
        Ok(Impulses {
            changes: array(|i| compression.changes[i] + expansion.changes[i]),
            impulses: array(|row| compression.impulses[row] + given[row] + expansion.impulses[row]),
            active: expansion.active,
        })
    }

    /// Whether impulses add kinetic energy: Λᵀ (u⁺ + u⁻) / 2, beyond rounding.
    fn gains(&self, strike: &Impulses<S::Scalar, N, C>) -> bool {
        let zero: S::Scalar = num_traits::Zero::zero();
        let (mut gained, mut size) = (zero, zero);
        for (row, &impulse) in strike.impulses.iter().enumerate() {
            let before = self.laws.rows.rates[row];
            let after = before + product(&self.gradients[row], &strike.changes);
            gained += impulse * (before + after);
            size += impulse.abs() * (before.abs() + after.abs());
        }
        above(gained, rounding::<S::Scalar>() * size)
    }

    /// The impulses of the first combination that agrees with the laws of impact and this demand. Several
    /// frictions can wedge a body between contacts, by impulses that bear each other and that nothing
    /// limits. So of the combinations of several frictions the one with the [shortest](Self::length)
    /// impulses is taken. Fails with `NoReaction` where none agrees, with `NotFinite` where none has a
    /// solution.
    fn strike(&self, demand: &Demand<S::Scalar, C>) -> Result<Impulses<S::Scalar, N, C>, Cause> {
        let options: [Options; C] = array(|row| self.ways(row));
        let by_sweeps = || {
            let parts = self.swept_by_impulses(&options, demand)?;
            thresholds().into_iter().find_map(|part| {
                self.turn_over(&parts, &options, FEW, |parts| {
                    let strike = self.impulses(parts, &options, demand, part)?;
                    let faults = marked(self.faults_of(parts, &strike, demand, part));
                    let impulses = strike.impulses;
                    Some((strike, faults, impulses))
                })
            })
        };
        // Of many combinations few agree, and sweeps find one sooner.
        let are_many = combinations(&options) > FEW;
        if are_many && let Some(found) = by_sweeps() {
            return Ok(found);
        }
        let several = options.iter().zip(&S::ROWS).filter(|(options, row)| {
            matches!(row, Row::Friction { .. }) && options.has(Part::On) && options.has(Part::Forward)
        });
        let may_wedge = !are_many && several.count() > 1;
        let mut cause = Cause::NotFinite;
        for part in thresholds() {
            let mut found: Option<Impulses<S::Scalar, N, C>> = None;
            combine(&options, &changes(&S::ROWS), |parts| {
                match self.agreed(parts, &options, demand, part) {
                    Some(Ok(strike)) => {
                        let is_shorter = |other: &Impulses<S::Scalar, N, C>| {
                            let (own, other) = (self.length(&strike.impulses), self.length(&other.impulses));
                            above(other, own + part * own)
                        };
                        if found.as_ref().is_none_or(is_shorter) {
                            found = Some(strike);
                        }
                    }
                    Some(Err(constraint)) if cause == Cause::NotFinite => {
                        cause = Cause::NoReaction { constraint, name: S::NAMES.constraint(constraint) };
                    }
                    Some(Err(_)) | None => {}
                }
                found.is_some() && !may_wedge
            });
            if let Some(found) = found {
                return Ok(found);
            }
        }
        if are_many { Err(cause) } else { by_sweeps().ok_or(cause) }
    }

    /// The sum of the speeds, in the metric of the kinetic energy, that each impulse gives by itself.
    fn length(&self, impulses: &[S::Scalar; C]) -> S::Scalar {
        let mut sum = num_traits::Zero::zero();
        for (gradient, impulse) in self.gradients.iter().zip(impulses) {
            let by_unit: [S::Scalar; N] = array(|i| entry(gradient, i) * entry(&self.units, i));
            sum += impulse.abs() * product(&by_unit, &by_unit).sqrt();
        }
        sum
    }

    /// The impulses of a combination if they agree with its demands; if not, the row where they do not.
    /// `None` for a combination without a solution.
    fn agreed(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        demand: &Demand<S::Scalar, C>,
        part: S::Scalar,
    ) -> Option<Result<Impulses<S::Scalar, N, C>, usize>> {
        let strike = self.impulses(parts, options, demand, part)?;
        let fault = self.faults_of(parts, &strike, demand, part).next();
        Some(fault.map_or(Ok(strike), Err))
    }

    /// The possible activities of a row in an impact, the one to be tried first at the beginning.
    fn ways(&self, row: usize) -> Options {
        let is_limit = super::choice::is_limit(&S::ROWS, row);
        match (S::ROWS[row], self.status[row]) {
            (Row::Bilateral, _) if is_limit => Options::new(&[Part::On, Part::Against]),
            (Row::Bilateral | Row::Load, _) => Options::new(&[Part::On]),
            // A contact that opens may be closed by the impulses at others.
            (Row::Unilateral, Status::Apart) if self.is_closed[row] => Options::new(&[Part::Off, Part::On]),
            (Row::Unilateral, Status::Meets | Status::Touches) => Options::new(&[Part::On, Part::Off]),
            (Row::Friction { normal: None, .. }, _) => Options::new(&[Part::Off]),
            (Row::Friction { .. }, _) if self.is_frictionless(row) => Options::new(&[Part::Off]),
            (Row::Friction { normal: Some(normal), .. }, _)
                if S::ROWS.get(normal) == Some(&Row::Unilateral)
                    && self.is_closed.get(normal) == Some(&false) =>
            {
                Options::new(&[Part::Off])
            }
            (Row::Friction { pair: Some(other), .. }, _) if other < row => Options::new(&[Part::Off]),
            (Row::Friction { pair: Some(_), .. }, _) => Options::new(&[Part::On, Part::Forward]),
            (Row::Friction { .. }, _) => {
                let backward = (-self.laws.rows.rates[row]).is_positive();
                Options::new(&[Part::On, Part::Forward, Part::Backward])
                    .with(if backward { Part::Backward } else { Part::Forward }, true)
                    .with(Part::On, true)
            }
            _ => Options::new(&[Part::Off]),
        }
    }

    /// The demanded change of the rate of a row that holds.
    pub(super) fn wanted(&self, row: usize, restitution: &[S::Scalar; C]) -> S::Scalar {
        let rate = entry(&self.laws.rows.rates, row);
        match S::ROWS.get(row) {
            Some(Row::Bilateral | Row::Load) | None => num_traits::Zero::zero(),
            Some(Row::Unilateral) if self.status.get(row) == Some(&Status::Meets) => {
                -(rate + entry(restitution, row) * rate)
            }
            Some(Row::Unilateral | Row::Friction { .. }) => -rate,
        }
    }

    /// Whether a slip in two directions goes on after these changes of velocities. A slip that is a rounding
    /// error has no direction, and so its friction has none.
    fn slips_on(&self, rows: [usize; 2], changes: &[S::Scalar; N]) -> bool {
        let [(x, size_x), (y, size_y)] = rows.each(|row| {
            let (before, change) = (entry(&self.laws.rows.rates, row), self.along(row, changes));
            (before + change, entry(&self.speeds, row) + before.abs() + change.abs())
        });
        above(x.hypot(y), rounding::<S::Scalar>() * most(size_x, size_y))
    }

    /// The rows where the demands of a combination do not agree with its consequences.
    fn faults_of<'a>(
        &'a self,
        parts: &'a [Part; C],
        strike: &'a Impulses<S::Scalar, N, C>,
        demand: &'a Demand<S::Scalar, C>,
        part: S::Scalar,
    ) -> impl Iterator<Item = usize> + 'a {
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut sizes = [zero; N];
        self.load(&strike.impulses, &mut sizes);
        self.load(&demand.given, &mut sizes);
        // A rule for what the laws of impact leave open, where it can be met.
        let slips = |row: usize| matches!(entry_of(parts, row), Part::Forward | Part::Backward);
        let slides = !above(part, rounding()) && Self::slides(slips);
        (0..C).filter(move |&row| {
            let scale = |row: usize| self.borne(row, &sizes);
            let before = entry(&self.laws.rows.rates, row);
            let change = self.along(row, &strike.changes);
            let after = before + change;
            let speed = entry(&self.speeds, row);
            // What single impulses do to its rate is the measure where all rates are roundings.
            let single = self.effect(row, &sizes);
            let play = part * (most(speed, before.abs()) + change.abs() + single);
            let slack = part * scale(row);
            let impulse = entry(&strike.impulses, row);
            // Rows that depend on each other may demand contradictory things.
            let wanted = self.wanted(row, &demand.restitution);
            let inexact = S::Scalar::epsilon().sqrt() * (wanted.abs() + change.abs() + speed + single);
            if strike.active.get(row) == Some(&true) && above((change - wanted).abs(), inexact) {
                return true;
            }
            let Some(&kind) = S::ROWS.get(row) else { return false };
            let agrees = match (kind, entry_of(parts, row)) {
                (Row::Bilateral, Part::Against) => !above(impulse, slack),
                (Row::Bilateral, _) if super::choice::is_limit(&S::ROWS, row) => !above(-slack, impulse),
                (Row::Unilateral, Part::On) => !above(-slack, impulse),
                (Row::Unilateral, _) if self.is_closed.get(row) == Some(&true) => {
                    let meets = self.status.get(row) == Some(&Status::Meets);
                    let back = if meets { entry(&demand.restitution, row) * before } else { zero };
                    let is_relieved = || {
                        slides
                            && !above(after + back, play)
                            && self.would_bear(row, &strike.active, &strike.impulses)
                    };
                    !above(-play, after + back) && !is_relieved()
                }
                (Row::Friction { normal: Some(normal), pair }, way) => {
                    let given = entry(&demand.given, normal);
                    let pressing = entry(&strike.impulses, normal) + given;
                    let limit = entry(&self.against(-impulse).kinetic, row) * pressing.abs();
                    let (other, slack) = match pair {
                        Some(other) => (entry(&strike.impulses, other), most(slack, part * scale(other))),
                        None => (zero, slack),
                    };
                    match way {
                        Part::On if parts.get(normal) != Some(&Part::Off) || given.is_positive() => {
                            !above(impulse.hypot(other), limit + part * limit + slack)
                        }
                        // Friction that has stopped a slip may be less than its limit.
                        Part::Forward => match pair {
                            None => !above(-play, after),
                            Some(other) => self.slips_on([row, other], &strike.changes),
                        },
                        Part::Backward => !above(-play, -after),
                        _ => true,
                    }
                }
                _ => true,
            };
            !agrees
        })
    }
}
