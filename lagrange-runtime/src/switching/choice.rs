//! The regime that goes on from a state: complementarity on the level of accelerations.
//!
//! Each row at its limit does one of two or three things, which must agree with the accelerations and
//! reactions that follow. A closed contact pushes, an open one opens, friction that sticks stays within its
//! limit, and friction that begins to slip acts against the slip. Combinations are tried, those first that
//! change least. With friction that reactions drive there may be none, or several (Painlevé's paradox).
//!
//! Pfeiffer and Glocker, *Multibody Dynamics with Unilateral Contacts*, chapters 5 and 7.

use super::ended::Ended;
use super::scene::{Scene, Status, Sticking, above, entry, most, put, rounding};
use super::trials::{FEW, Options, Part, changes, combinations, combine, parts_at, regime, thresholds};
use super::turning::has_pairs;
use super::{Regime, Row, Switching};
use crate::constraints::Balance;
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::state::State;

/// A regime with its accelerations and reactions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Choice<R, const N: usize, const C: usize, const W: usize> {
    pub(super) regime: Regime<R, C, W>,
    /// Velocities: those of the state, except for a slip in two directions that begins.
    pub(super) velocities: [R; N],
    /// How much later the motion has these velocities \[s]; zero where that is not known.
    pub(super) later: R,
    pub(super) accelerations: [R; N],
    pub(super) multipliers: [R; C],
    pub(super) sizes: Sizes<R, N>,
}

/// The row whose guard has fired.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fired {
    pub(super) row: usize,
    /// Whether it held before. A friction that held has reached its limit; one that slipped has come to rest.
    pub(super) held: bool,
}

impl<R: Real, const N: usize, const C: usize, const W: usize> Choice<R, N, C, W> {
    /// The accelerations without those that are rounding errors of forces. What is at rest would get a
    /// velocity from them that has no digits, and no scale to tell that.
    pub(super) fn known_accelerations(&self) -> [R; N] {
        array(|i| {
            let (own, size) = (self.accelerations[i], self.sizes.accelerations[i]);
            if above(own.abs(), rounding::<R>() * size) { own } else { own - own.part(0) }
        })
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The regime that goes on. Slips in two directions that are too slow to have a direction count as
    /// friction at rest where no other regime does.
    ///
    /// `avoid` is the row whose guard has fired. It goes on as before only if nothing else is possible:
    ///
    /// * If its reaction has fallen through zero, the polynomial has decided: the contact opens, or the
    ///   constraint presses from the other side. Accelerations and reactions tie and are not asked.
    /// * If it is a gap, it may have touched zero alone, and stay open.
    /// * If it is a friction at its limit, it may stick in another regime. In the regime that its guard has
    ///   ended it slips. There its acceleration grows from zero, hidden by rounding errors or by the slip
    ///   that it begins with.
    /// * If it is a friction whose slip has ended, it sticks if it can, whatever the others do then.
    ///
    /// # Errors
    /// [`Cause::NoReaction`] or [`Cause::SeveralReactions`] where the laws of contact have no solution or
    /// several, [`Cause::NotFinite`] where no regime has accelerations.
    pub(super) fn choose(
        &self,
        present: &Regime<S::Scalar, C, W>,
        avoid: Option<usize>,
    ) -> Result<Choice<S::Scalar, N, C, W>, Cause> {
        self.choose_here(present, avoid).or_else(|cause| match self.resting() {
            Some(resting) => resting.choose_here(present, avoid).map_err(|_| cause),
            None => Err(cause),
        })
    }

    fn choose_here(
        &self,
        present: &Regime<S::Scalar, C, W>,
        avoid: Option<usize>,
    ) -> Result<Choice<S::Scalar, N, C, W>, Cause> {
        if let Some(slips) = avoid.and_then(|row| self.slipping(present, row)) {
            return Ok(slips);
        }
        let fired = avoid.map(|row| Fired { row, held: present.active.get(row) == Some(&true) });
        let decided = avoid.filter(|&row| match S::ROWS.get(row) {
            Some(Row::Bilateral | Row::Load) => true,
            Some(Row::Unilateral) => present.active.get(row) == Some(&true),
            Some(Row::Friction { .. }) | None => false,
        });
        if decided.is_some()
            && let Ok(choice) = self.choose_among(self.options(present, avoid, decided), decided, fired)
        {
            return Ok(choice);
        }
        let choice = self.choose_among(self.options(present, avoid, None), None, fired)?;
        let Some(row) = avoid.filter(|_| choice.regime == *present) else { return Ok(choice) };
        let Some(&Row::Friction { pair, normal }) = S::ROWS.get(row) else { return Ok(choice) };
        let is_stuck = present.active.get(row) == Some(&true);
        let mut others = Options::new(&[Part::On]);
        if is_stuck {
            let is_forward = pair.is_some() || self.nearer(row, normal, &choice.multipliers).is_positive();
            others = Options::new(&[if is_forward { Part::Forward } else { Part::Backward }]);
        } else if pair.is_some() {
            return Ok(choice);
        }
        let mut options = self.options(present, None, None);
        put(&mut options, row, others);
        Ok(self.choose_among(options, if is_stuck { avoid } else { None }, fired).unwrap_or(choice))
    }

    /// The regime among these options. Nothing is asked of a row that is decided. Contacts that have opened
    /// at this time stay open where they can, and frictions that have let go slip; `search` does not know of
    /// them.
    fn choose_among(
        &self,
        options: [Options; C],
        decided: Option<usize>,
        fired: Option<Fired>,
    ) -> Result<Choice<S::Scalar, N, C, W>, Cause> {
        if self.opened.contains(&true) {
            let open = array(|row| match (self.opened[row], S::ROWS[row]) {
                (false, _) => options[row],
                (true, Row::Friction { .. }) => options[row].without(Part::On),
                (true, _) => Options::new(&[Part::Off]),
            });
            if let Ok(choice) = self.search(open, decided, fired) {
                return Ok(choice);
            }
        }
        self.search(options, decided, fired)
    }

    /// The regime among these options, one that has ended at this time only if no other is possible.
    fn search(
        &self,
        options: [Options; C],
        decided: Option<usize>,
        fired: Option<Fired>,
    ) -> Result<Choice<S::Scalar, N, C, W>, Cause> {
        if self.ended.any()
            && let Ok(choice) = self.search_without(&self.ended, options, decided, fired)
        {
            return Ok(choice);
        }
        self.search_without(&Ended::none(), options, decided, fired)
    }

    fn search_without(
        &self,
        ended: &Ended<C>,
        options: [Options; C],
        decided: Option<usize>,
        fired: Option<Fired>,
    ) -> Result<Choice<S::Scalar, N, C, W>, Cause> {
        let is_coupled = S::ROWS.iter().zip(&self.status).any(|(row, &status)| {
            matches!(row, Row::Friction { normal: Some(_), .. }) && status != Status::Apart
        });
        let held = |chosen: Choice<S::Scalar, N, C, W>, part: S::Scalar| {
            let held = self.held_if_it_can(&chosen, part, decided, fired);
            held.filter(|held| !ended.has(&S::ROWS, &held.regime)).unwrap_or(chosen)
        };
        if combinations(&options) > FEW
            && let Some((chosen, part)) = self.pivoted(&options, decided, is_coupled)
            && !ended.has(&S::ROWS, &chosen.regime)
        {
            if is_coupled && let Some(constraint) = self.another(&chosen, &options, part, decided) {
                return Err(Cause::SeveralReactions { constraint, name: S::NAMES.constraint(constraint) });
            }
            return Ok(held(chosen, part));
        }
        let mut cause = Cause::NotFinite;
        for part in thresholds() {
            let mut chosen: Option<Choice<S::Scalar, N, C, W>> = None;
            let mut other = None;
            combine(&options, &changes(&S::ROWS), |parts| {
                let Some(trial) = regime(&S::ROWS, parts, &options, &[false; C], self.kinks)
                    .filter(|trial| !ended.has(&S::ROWS, trial))
                else {
                    return false;
                };
                // Among regimes that differ in friction alone, one is taken.
                if chosen.as_ref().is_some_and(|chosen| parts_at(&S::ROWS, &chosen.regime, &trial).is_none())
                {
                    return false;
                }
                let Some(trial) = self.trial(trial) else {
                    if let (Cause::NotFinite, Some(constraint)) = (cause, jammed(&S::ROWS, &trial)) {
                        cause = Cause::NoReaction { constraint, name: S::NAMES.constraint(constraint) };
                    }
                    return false;
                };
                match self.judge(parts, &trial, part, decided) {
                    Ok(()) => match &chosen {
                        None => chosen = Some(trial),
                        Some(own) if other.is_none() => match self.differs(own, &trial) {
                            // Shares of one load from other sides: the shortest of all are taken.
                            None if Self::is_shorter(&trial, own) => chosen = Some(trial),
                            found => other = found,
                        },
                        Some(_) => {}
                    },
                    Err(constraint) => {
                        if cause == Cause::NotFinite {
                            cause = Cause::NoReaction { constraint, name: S::NAMES.constraint(constraint) };
                        }
                    }
                }
                chosen.is_some() && !is_coupled
            });
            if let Some(constraint) = other {
                return Err(Cause::SeveralReactions { constraint, name: S::NAMES.constraint(constraint) });
            }
            if let Some(chosen) = chosen {
                return Ok(held(chosen, part));
            }
        }
        Err(cause)
    }

    fn options(
        &self,
        present: &Regime<S::Scalar, C, W>,
        avoid: Option<usize>,
        decided: Option<usize>,
    ) -> [Options; C] {
        // Where a slip ends, others may end with it, of the same two bodies. What comes to rest sticks if it
        // can.
        let slip_ends = avoid.is_some_and(|row| {
            matches!(S::ROWS.get(row), Some(Row::Friction { .. })) && present.active.get(row) == Some(&false)
        });
        array(|row| {
            let kind = S::ROWS[row];
            let options = match (kind, self.status[row]) {
                (Row::Bilateral, _) if decided == Some(row) => {
                    let is_against = (-present.side[row]).is_positive();
                    Options::new(&[if is_against { Part::On } else { Part::Against }])
                }
                (Row::Unilateral, _) if decided == Some(row) => Options::new(&[Part::Off]),
                (Row::Bilateral, _) if is_limit(&S::ROWS, row) => Options::new(&[Part::On, Part::Against]),
                (Row::Bilateral | Row::Load, _) => Options::new(&[Part::On]),
                (Row::Unilateral, Status::Touches | Status::Meets) => Options::new(&[Part::On, Part::Off]),
                (Row::Friction { pair: Some(other), .. }, _) if other < row => Options::new(&[Part::Off]),
                (Row::Friction { pair: Some(_), .. }, Status::Rests) => {
                    Options::new(&[Part::On, Part::Forward])
                }
                (Row::Friction { .. }, Status::Rests) => {
                    Options::new(&[Part::On, Part::Forward, Part::Backward])
                }
                (Row::Friction { pair, .. }, Status::Slips) => {
                    let forward = pair.is_some() || self.laws.rows.rates[row].is_positive();
                    Options::new(&[if forward { Part::Forward } else { Part::Backward }])
                }
                _ => Options::new(&[Part::Off]),
            };
            let part = match kind {
                // A slip in two directions that begins has no direction of its own, so friction at rest
                // holds if it can.
                Row::Friction { pair: Some(_), .. } if avoid != Some(row) => Part::On,
                Row::Friction { pair: None, .. }
                    if slip_ends && avoid != Some(row) && self.status[row] == Status::Rests =>
                {
                    Part::On
                }
                _ => Part::of(row, kind, present),
            };
            options.with(part, avoid != Some(row))
        })
    }

    /// The consequences of a regime; `None` where it has no accelerations.
    pub(super) fn trial(&self, regime: Regime<S::Scalar, C, W>) -> Option<Choice<S::Scalar, N, C, W>> {
        let begins = self.beginning(&regime);
        let has_begun = const { has_pairs(&S::ROWS) } && begins.any();
        let drift = if has_begun { Some(self.drift(&regime, &begins)?) } else { None };
        let velocities = match &drift {
            Some(drift) => self.launched(&regime, &begins, &drift.slips)?,
            None => self.state.v,
        };
        let (mut balance, sizes) = self.balance(&regime, &velocities)?;
        if let Some(drift) = drift {
            balance = drift.balance;
        }
        // Where rows depend on each other there are other reactions as well: the shortest are taken.
        if balance.independence.rank < balance.independence.rows
            && let drags = self.drags(&regime, &velocities)
            && let Some(shortest) = self.shortest(&regime, &drags, &balance.multipliers, Sticking::ByForces)
        {
            balance.multipliers = shortest;
        }
        let zero = num_traits::Zero::zero();
        let later = if has_begun {
            self.later(&regime, &begins, &velocities, &balance, &sizes).unwrap_or(zero)
        } else {
            zero
        };
        Some(Choice {
            regime,
            velocities,
            later,
            accelerations: balance.accelerations,
            multipliers: balance.multipliers,
            sizes,
        })
    }

    /// The accelerations and multipliers of a regime, and the sizes of their terms; `None` where these are
    /// not finite.
    pub(super) fn balance(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        v: &[S::Scalar; N],
    ) -> Option<Balanced<S::Scalar, N, C>> {
        let State { t, q, .. } = &self.state;
        let in_regime = self.system.in_regime(regime);
        let equations = S::equations_in(&in_regime, *t, q, v, self.inputs)?;
        let balance = equations.balance();
        let mut numbers = balance.accelerations.iter().chain(&balance.multipliers);
        if !numbers.all(|x| x.is_finite()) {
            return None;
        }
        let mut forces = equations.forces.each(|force: S::Scalar| force.abs());
        for (row, gradient) in self.gradients.iter().enumerate() {
            // A friction that slips is among the forces, and may balance the others, in any direction.
            let given = match S::ROWS.get(row) {
                Some(&Row::Friction { normal, pair }) => {
                    let slip = entry(&regime.slip, pair.map_or(row, |other| row.min(other)));
                    let load = normal
                        .map_or(num_traits::One::one(), |normal| entry(&balance.multipliers, normal).abs());
                    entry(&self.against(slip).kinetic, row) * slip.abs() * load
                }
                _ => num_traits::Zero::zero(),
            };
            let borne = entry(&balance.multipliers, row).abs() + given;
            for (force, &entry) in forces.iter_mut().zip(gradient) {
                *force += entry.abs() * borne;
            }
        }
        let units = equations.saddle.units();
        let accelerations = array(|i| balance.accelerations[i].abs() + forces[i] * units[i] * units[i]);
        Some((balance, Sizes { forces, accelerations }))
    }

    /// The rate of the rate of a row, or of a slip: A a − γ.
    pub(super) fn rate(&self, row: usize, accelerations: &[S::Scalar; N]) -> S::Scalar {
        self.along(row, accelerations) - entry(&self.gamma, row)
    }
}

/// Accelerations and multipliers, and the sizes of their terms.
pub(super) type Balanced<R, const N: usize, const C: usize> = (Balance<R, N, C>, Sizes<R, N>);

/// The sizes of the terms of forces and accelerations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes<R, const N: usize> {
    pub(super) forces: [R; N],
    pub(super) accelerations: [R; N],
}

impl<R: Real, const N: usize> Sizes<R, N> {
    /// The sizes as if the largest force acted at each coordinate, in `units` in which no coordinate is
    /// larger than another. Accelerations that are larger stay as they are.
    pub(super) fn levelled(&self, units: &[R; N]) -> Self {
        let sizes = self.forces.iter().zip(units).map(|(&force, &unit)| force * unit);
        let largest = sizes.fold(R::zero(), most);
        Self {
            forces: array(|i| if units[i].is_positive() { largest / units[i] } else { self.forces[i] }),
            accelerations: array(|i| most(self.accelerations[i], largest * units[i])),
        }
    }
}

/// The first friction that slips and is driven by a load.
fn jammed<R: Real, const C: usize, const W: usize>(
    rows: &[Row; C],
    regime: &Regime<R, C, W>,
) -> Option<usize> {
    rows.iter().enumerate().position(|(row, kind)| {
        let slips = regime.slip[row] != R::zero();
        matches!(kind, Row::Friction { normal: Some(normal), .. } if slips && rows[*normal] == Row::Load)
    })
}

/// Whether the reaction of a row limits a friction.
pub(super) fn is_limit<const C: usize>(rows: &[Row; C], row: usize) -> bool {
    rows.iter().any(|kind| matches!(kind, Row::Friction { normal: Some(normal), .. } if *normal == row))
}
