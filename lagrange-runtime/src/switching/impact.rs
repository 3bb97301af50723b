//! Impacts: complementarity on the level of velocities.
//!
//! Bodies are rigid, so an impact takes no time and forces of a given size have no part in it: dry joints
//! with a given limit turn freely, bilateral constraints keep their velocities. Over all contacts that touch
//! at the moment Newton's law with the coefficient e of each is u⁺ + e u⁻ ≥ 0 ⟂ Λ ≥ 0, friction is Coulomb's
//! law for impulses: it sticks while |Λₜ| ≤ μ Λₙ, else |Λₜ| = μ Λₙ against the slip after the impact
//! (Pfeiffer and Glocker, *Multibody Dynamics with Unilateral Contacts*, chapter 8; Brogliato, *Nonsmooth
//! Mechanics*, 4.3).
//!
//! With friction, or with several contacts of different coefficients, Newton's law can create energy, or have
//! no solution. Where that is so, the impulses are (1 + e) times those of a plastic impact instead, e the
//! least of the coefficients: a plastic impact takes energy away, and along the line from the velocities
//! before it to twice as far behind it the kinetic energy is a parabola with equal values at equal distances
//! from its lowest point, which is not nearer than the plastic one.

use super::Row;
use super::Switching;
use super::scene::{Scene, Status, above, most, product, rounding};
use super::trials::{Options, Part, combine, regime};
use super::turning::{TURNS, Turning, pairs};
use crate::linear::SaddlePoint;
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::state::State;

/// Changes of velocities and the impulses that make them.
struct Impulses<R, const N: usize, const C: usize> {
    changes: [R; N],
    impulses: [R; C],
    /// Rows that hold.
    active: [bool; C],
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The velocities after the impact.
    pub(super) fn impact(&self) -> Result<[S::Scalar; N], Cause> {
        let restitution = &self.laws.restitution;
        let zero: S::Scalar = num_traits::Zero::zero();
        let by_newton = self.strike(restitution).ok().filter(|strike| !self.gains(strike));
        let changes = if let Some(strike) = by_newton {
            strike.changes
        } else {
            let plastic = self.strike(&[zero; C])?;
            let mut least: S::Scalar = num_traits::One::one();
            for (row, &e) in restitution.iter().enumerate() {
                let before = self.laws.rows.rates[row];
                let slows = -product(&self.gradients[row], &plastic.changes);
                // What opens already is not driven into penetration.
                let most = match self.status[row] {
                    Status::Meets => e,
                    Status::Apart if self.is_closed[row] && slows.is_positive() => (before - slows) / slows,
                    _ => continue,
                };
                if above(least, most) {
                    least = if most.is_positive() { most } else { zero };
                }
            }
            plastic.changes.map(|change| change + least * change)
        };
        Ok(core::array::from_fn(|i| self.state.v[i] + changes[i]))
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

    fn strike(&self, restitution: &[S::Scalar; C]) -> Result<Impulses<S::Scalar, N, C>, Cause> {
        let options: [Options; C] = core::array::from_fn(|row| self.ways(row));
        let fine: S::Scalar = rounding();
        let mut cause = Cause::NotFinite;
        for part in [fine, fine * fine.sqrt().sqrt().recip(), fine.sqrt() * S::Scalar::from_f64(0.1)] {
            let mut found = None;
            combine(&options, |parts| {
                if let Some(strike) = self.impulses(parts, &options, restitution, part) {
                    match self.agree(parts, &strike, restitution, part) {
                        Ok(()) => found = Some(strike),
                        Err(constraint) if cause == Cause::NotFinite => {
                            cause = Cause::NoReaction { constraint, name: S::NAMES.constraint(constraint) };
                        }
                        Err(_) => {}
                    }
                }
                found.is_some()
            });
            if let Some(found) = found {
                return Ok(found);
            }
        }
        Err(cause)
    }

    /// What a row may do in an impact.
    fn ways(&self, row: usize) -> Options {
        let is_limit = super::choice::is_limit(&S::ROWS, row);
        match (S::ROWS[row], self.status[row]) {
            (Row::Bilateral, _) if is_limit => Options::new(&[Part::On, Part::Against]),
            (Row::Bilateral, _) => Options::new(&[Part::On]),
            // One that opens may be closed by the impulses at others.
            (Row::Unilateral, Status::Apart) if self.is_closed[row] => Options::new(&[Part::Off, Part::On]),
            (Row::Unilateral, Status::Meets | Status::Touches) => Options::new(&[Part::On, Part::Off]),
            (Row::Friction { normal: None, .. }, _) => Options::new(&[Part::Off]),
            (Row::Friction { normal: Some(normal), .. }, _)
                if S::ROWS[normal] == Row::Unilateral && !self.is_closed[normal] =>
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

    /// By how much the rate of a row changes that holds.
    fn wanted(&self, row: usize, restitution: &[S::Scalar; C]) -> S::Scalar {
        let rate = self.laws.rows.rates[row];
        match S::ROWS[row] {
            Row::Bilateral => num_traits::Zero::zero(),
            Row::Unilateral if self.status[row] == Status::Meets => -(rate + restitution[row] * rate),
            Row::Unilateral | Row::Friction { .. } => -rate,
        }
    }

    /// The impulses of a combination; `None` where it has no solution.
    fn impulses(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        restitution: &[S::Scalar; C],
        part: S::Scalar,
    ) -> Option<Impulses<S::Scalar, N, C>> {
        let regime = regime(&S::ROWS, parts, options, self.kinks)?;
        let in_regime = self.system.in_regime(&regime);
        let wanted = core::array::from_fn(|row| self.wanted(row, restitution));
        let none = [num_traits::Zero::zero(); N];
        let State { t, q, v } = &self.state;
        let solve = |in_regime: &S::InRegime, v: &[S::Scalar; N]| {
            let equations = S::equations_in(in_regime, *t, q, v, self.inputs)?;
            let (changes, impulses) = equations.saddle.solve_motion(&none, &wanted);
            let is_finite = changes.iter().chain(&impulses).all(|x| x.is_finite());
            (is_finite && equations.saddle.vanishing().is_none()).then_some((changes, impulses))
        };
        let found = |(changes, impulses): ([S::Scalar; N], _)| {
            let after = core::array::from_fn(|i| v[i] + changes[i]);
            let impulses = self.with_friction(&regime, impulses, &after);
            Impulses { changes, impulses, active: regime.active }
        };
        // Of a slip in two directions that which follows is looked for.
        let zero: S::Scalar = num_traits::Zero::zero();
        let turns = |row: usize| regime.slip[row] != zero;
        if !pairs(&S::ROWS).any(|[row, _]| turns(row)) {
            return solve(&in_regime, v).map(found);
        }
        let mut stuck = regime;
        for [row, other] in pairs(&S::ROWS).filter(|[row, _]| turns(*row)) {
            stuck.slip[row] = zero;
            (stuck.active[row], stuck.active[other]) = (true, true);
        }
        let held = S::equations_in(&self.system.in_regime(&stuck), *t, q, v, self.inputs)?;
        let smooth = self.without_friction(parts, options, restitution)?;
        let rates = &self.laws.rows.rates;
        let after =
            |row: usize, changes: &[S::Scalar; N]| rates[row] + product(&self.gradients[row], changes);
        let mut slips: [S::Scalar; C] = core::array::from_fn(|row| after(row, &smooth));
        let mut turning = Turning::new();
        for _ in 0..TURNS {
            let mut apart = [zero; C];
            for [row, other] in pairs(&S::ROWS).filter(|[row, _]| turns(*row)) {
                for row in [row, other] {
                    apart[row] = slips[row] - rates[row];
                }
            }
            let (change, _) = held.saddle.solve(&none, &apart);
            let strike = solve(&in_regime, &core::array::from_fn(|i| v[i] + change[i]))?;
            let (mut lacks, mut is_done) = ([zero; C], true);
            for [row, other] in pairs(&S::ROWS).filter(|[row, _]| turns(*row)) {
                for row in [row, other] {
                    lacks[row] = after(row, &strike.0) - slips[row];
                }
                let size = most(self.speeds[row], self.speeds[other]) + slips[row].hypot(slips[other]);
                is_done = is_done && !above(lacks[row].hypot(lacks[other]), part * size);
            }
            if is_done {
                return Some(found(strike));
            }
            slips = turning.next(&slips, &lacks);
        }
        None
    }

    /// The changes of velocities by the same impact on smooth contacts, whose slip gives a first direction.
    fn without_friction(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        restitution: &[S::Scalar; C],
    ) -> Option<[S::Scalar; N]> {
        let rates = &self.laws.rows.rates;
        let smooth = core::array::from_fn(|row| match S::ROWS[row] {
            Row::Friction { .. } => Part::Off,
            _ => parts[row],
        });
        let bare = options.map(|_| Options::new(&[Part::Off]));
        let in_regime = self.system.in_regime(&regime(&S::ROWS, &smooth, &bare, self.kinks)?);
        let wanted = core::array::from_fn(|row| match S::ROWS[row] {
            Row::Unilateral => -(rates[row] + restitution[row] * rates[row]),
            _ => num_traits::Zero::zero(),
        });
        let State { t, q, v } = &self.state;
        let equations = S::equations_in(&in_regime, *t, q, v, self.inputs)?;
        Some(equations.saddle.solve(&[num_traits::Zero::zero(); N], &wanted).0)
    }

    /// The impulses of frictions that slip, which follow from those of their contacts.
    fn with_friction(
        &self,
        regime: &super::Regime<S::Scalar, C, W>,
        mut impulses: [S::Scalar; C],
        after: &[S::Scalar; N],
    ) -> [S::Scalar; C] {
        let zero: S::Scalar = num_traits::Zero::zero();
        let rate = |row: usize| {
            let change = core::array::from_fn(|i| after[i] - self.state.v[i]);
            self.laws.rows.rates[row] + product(&self.gradients[row], &change)
        };
        for (row, kind) in S::ROWS.iter().enumerate() {
            let Row::Friction { normal: Some(normal), pair } = kind else { continue };
            let slip = regime.slip[row];
            if slip == zero {
                continue;
            }
            let size = self.laws.kinetic[row] * impulses[*normal].abs();
            match pair {
                None => impulses[row] = -slip * size,
                Some(other) => {
                    let (x, y) = (rate(row), rate(*other));
                    let length = x.hypot(y);
                    if length.is_positive() {
                        (impulses[row], impulses[*other]) = (-size * x / length, -size * y / length);
                    }
                }
            }
        }
        impulses
    }

    /// Whether what a combination demands agrees with what follows; if not, the row where it does not.
    fn agree(
        &self,
        parts: &[Part; C],
        strike: &Impulses<S::Scalar, N, C>,
        restitution: &[S::Scalar; C],
        part: S::Scalar,
    ) -> Result<(), usize> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut sizes = [zero; N];
        for (gradient, &impulse) in self.gradients.iter().zip(&strike.impulses) {
            for (size, &entry) in sizes.iter_mut().zip(gradient) {
                *size += (entry * impulse).abs();
            }
        }
        for (row, kind) in S::ROWS.iter().enumerate() {
            let gradient = &self.gradients[row];
            let before = self.laws.rows.rates[row];
            let change = product(gradient, &strike.changes);
            let after = before + change;
            let play = part * (most(self.speeds[row], before.abs()) + change.abs());
            let squares = product(gradient, gradient);
            let scale = super::scene::extent(gradient, &sizes);
            let slack = if squares.is_positive() { part * scale / squares } else { zero };
            let impulse = strike.impulses[row];
            // Rows that depend on each other may ask for what contradicts.
            let wanted = self.wanted(row, restitution);
            let asked = strike.active[row] && *kind != Row::Bilateral;
            let inexact = S::Scalar::epsilon().sqrt() * (wanted.abs() + change.abs() + self.speeds[row]);
            if asked && above((change - wanted).abs(), inexact) {
                return Err(row);
            }
            let holds = match (kind, parts[row]) {
                (Row::Bilateral, Part::Against) => !above(impulse, slack),
                (Row::Bilateral, _) if super::choice::is_limit(&S::ROWS, row) => !above(-slack, impulse),
                (Row::Unilateral, Part::On) => !above(-slack, impulse),
                (Row::Unilateral, _) if self.is_closed[row] => {
                    let back =
                        if self.status[row] == Status::Meets { restitution[row] * before } else { zero };
                    !above(-play, after + back)
                }
                (Row::Friction { normal: Some(normal), pair }, way) => {
                    let limit = self.laws.kinetic[row] * strike.impulses[*normal].abs();
                    let other = pair.map_or(zero, |other| strike.impulses[other]);
                    match way {
                        Part::On if parts[*normal] != Part::Off => {
                            !above(impulse.hypot(other), limit + part * limit + slack)
                        }
                        Part::Forward if pair.is_none() => !above(-play, after),
                        Part::Backward => !above(-play, -after),
                        _ => true,
                    }
                }
                _ => true,
            };
            if !holds {
                return Err(row);
            }
        }
        Ok(())
    }
}
