//! Whether a regime agrees with its consequences.

use super::choice::{Choice, is_limit};
use super::scene::{Scene, Status, above, entry, most, rounding};
use super::trials::Part;
use super::turning::has_pairs;
use super::{Row, Switching};
use crate::number::elements::Each;
use crate::number::real::Real;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Whether the demands of a combination agree with its consequences, up to a `part` of the sizes of
    /// numbers; if not, the first row where they do not.
    pub(super) fn judge(
        &self,
        parts: &[Part; C],
        trial: &Choice<S::Scalar, N, C, W>,
        part: S::Scalar,
        decided: Option<usize>,
    ) -> Result<(), usize> {
        self.faults(parts, trial, part, decided).next().map_or(Ok(()), Err)
    }

    /// The rows where the demands of a combination do not agree with its consequences, up to a `part` of the
    /// sizes of numbers.
    pub(super) fn faults<'a>(
        &'a self,
        parts: &'a [Part; C],
        trial: &'a Choice<S::Scalar, N, C, W>,
        part: S::Scalar,
        decided: Option<usize>,
    ) -> impl Iterator<Item = usize> + 'a {
        let zero: S::Scalar = num_traits::Zero::zero();
        // Beyond the first threshold, errors are those of the largest force, wherever it acts.
        let is_whole = above(part, rounding());
        // A rule for what the laws of contact leave open, where it can be met.
        let slides = !is_whole && Self::slides(|row| entry(&trial.regime.slip, row) != zero);
        let levelled = trial.sizes.levelled(&self.units);
        let sizes = if is_whole { levelled } else { trial.sizes };
        let scale = move |row: usize| self.borne(row, &sizes.forces);
        let agrees = move |row: usize, kind: Row| {
            let is_active = trial.regime.active.get(row) == Some(&true);
            let status = self.status.get(row).copied().unwrap_or(Status::Holds);
            let reaction = entry(&trial.multipliers, row);
            let slack = part * scale(row);
            let rate = self.rate(row, &trial.accelerations);
            let own = self.extent_of(row, &sizes.accelerations);
            let play = part * (own + entry(&self.gamma, row).abs());
            // Rows that depend on each other may demand contradictory things. Where nothing pulls,
            // accelerations are rounding errors; those that friction could prevent are the measure of them.
            let prevented = match (kind, self.gradients.get(row)) {
                (Row::Friction { normal, .. }, Some(own)) if is_active => {
                    self.limit(row, normal, &trial.multipliers).abs() * self.effect(row, own)
                }
                _ => zero,
            };
            // Reactions have the rounding errors of the forces that they balance, and act on all that they
            // couple. Errors of a state that is not quite on its constraints count only where no regime is
            // free of contradictions beyond that.
            let known = if is_whole { most(part, S::Scalar::epsilon().sqrt()) } else { part };
            let inexact = known * (play / part + prevented)
                + rounding::<S::Scalar>() * self.extent_of(row, &levelled.accelerations);
            if is_active && above(rate.abs(), inexact) {
                return false;
            }
            match (kind, parts.get(row).copied().unwrap_or(Part::Off)) {
                (Row::Bilateral, part) if is_limit(&S::ROWS, row) => {
                    let side = if part == Part::Against { -reaction } else { reaction };
                    !above(-slack, side)
                }
                (Row::Unilateral, Part::On) => {
                    // Slips in two directions may turn, so that the load of a spring that would pull counts.
                    let is_lifted = || {
                        slides
                            && const { has_pairs(&S::ROWS) }
                            && !above(reaction, slack)
                            && self.is_lifted(row, &trial.regime.active, &trial.multipliers)
                    };
                    !above(-slack, reaction) && !is_lifted()
                }
                (Row::Unilateral, _) if status != Status::Apart => {
                    let is_relieved = || {
                        slides
                            && !above(rate, play)
                            && self.would_bear(row, &trial.regime.active, &trial.multipliers)
                    };
                    !above(-play, rate) && !is_relieved()
                }
                (Row::Friction { normal, pair }, _) if is_active => {
                    let limit = self.limit(row, normal, &trial.multipliers);
                    let (other, slack) = match pair {
                        Some(other) => (entry(&trial.multipliers, other), most(slack, part * scale(other))),
                        None => (zero, slack),
                    };
                    !above(reaction.hypot(other), limit * (S::Scalar::from_f64(1.0) + part) + slack)
                }
                (Row::Friction { pair, .. }, _) => {
                    let slip = entry(&trial.regime.slip, row);
                    match pair {
                        _ if slip == zero || status != Status::Rests => true,
                        None => !above(-play, slip * rate),
                        Some(other) => {
                            let [x, y] = [row, other].each(|row| self.rate_at(row, &trial.velocities));
                            let turn = self.rate(other, &trial.accelerations);
                            !above(-play * x.hypot(y), x * rate + y * turn)
                        }
                    }
                }
                _ => true,
            }
        };
        S::ROWS
            .iter()
            .enumerate()
            .filter(move |&(row, &kind)| decided != Some(row) && !agrees(row, kind))
            .map(|(row, _)| row)
    }
}
