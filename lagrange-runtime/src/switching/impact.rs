//! Impacts: complementarity on the level of velocities.
//!
//! Bodies are rigid, so an impact takes no time and forces of a given size have no part in it: dry joints with a
//! given limit turn freely, bilateral constraints keep their velocities. Over all contacts that touch at the
//! moment Newton's law with the coefficient e of each is u⁺ + e u⁻ ≥ 0 ⟂ Λ ≥ 0, friction is Coulomb's law for
//! impulses: it sticks while |Λₜ| ≤ μ Λₙ, else |Λₜ| = μ Λₙ against the slip after the impact (Pfeiffer and
//! Glocker, *Multibody Dynamics with Unilateral Contacts*, chapter 8; Brogliato, *Nonsmooth Mechanics*, 4.3).
//!
//! With friction, or with several contacts of different coefficients, Newton's law can create energy. Where it
//! does, the impulses are (1 + e) times those of a plastic impact instead, e the least of the coefficients: a
//! plastic impact takes energy away, and along the line from the velocities before it to twice as far behind it
//! the kinetic energy is a parabola with equal values at equal distances from its lowest point, which is not
//! nearer than the plastic one.

use super::Row;
use super::Switching;
use super::scene::{Scene, Status, above, most, product, rounding};
use super::trials::{Options, Part, combine, regime};
use crate::error::Cause;
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// Searches for the direction of a slip in two directions.
const TURNS: usize = 60;

/// Changes of velocities and the impulses that make them.
struct Impulses<R, const N: usize, const C: usize> {
    changes: [R; N],
    impulses: [R; C],
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The velocities after the impact.
    pub(super) fn impact(&self) -> Result<[S::Scalar; N], Cause> {
        let restitution = &self.laws.restitution;
        let zero: S::Scalar = num_traits::Zero::zero();
        let by_newton = self.strike(restitution)?;
        let mut changes = by_newton.changes;
        if self.gains(&by_newton) {
            let plastic = self.strike(&[zero; C])?;
            let least = (0..C).filter(|&row| self.status[row] == Status::Meets).fold(
                S::Scalar::from_f64(1.0),
                |least: S::Scalar, row| if above(least, restitution[row]) { restitution[row] } else { least },
            );
            changes = plastic.changes.map(|change| change + least * change);
        }
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
            (Row::Unilateral, Status::Meets | Status::Touches) => Options::new(&[Part::On, Part::Off]),
            (Row::Friction { normal: None, .. }, _) | (_, Status::Apart) => Options::new(&[Part::Off]),
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

    /// The impulses of a combination; `None` where there are none.
    fn impulses(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        restitution: &[S::Scalar; C],
        part: S::Scalar,
    ) -> Option<Impulses<S::Scalar, N, C>> {
        let regime = regime(&S::ROWS, parts, options, self.kinks)?;
        let in_regime = self.system.in_regime(&regime);
        let rates = &self.laws.rows.rates;
        let wanted = core::array::from_fn(|row| match S::ROWS[row] {
            Row::Bilateral => num_traits::Zero::zero(),
            Row::Unilateral if self.status[row] == Status::Meets => -(rates[row] + restitution[row] * rates[row]),
            Row::Unilateral | Row::Friction { .. } => -rates[row],
        });
        let none = [num_traits::Zero::zero(); N];
        // Of a slip in two directions that which follows is looked for.
        let turns = S::ROWS.iter().zip(&regime.slip).any(|(row, &slip)| {
            matches!(row, Row::Friction { pair: Some(_), .. }) && slip != num_traits::Zero::zero()
        });
        let mut velocities = self.state.v;
        if turns {
            velocities = self.without_friction(parts, options, restitution)?;
        }
        for _ in 0..TURNS {
            let equations =
                S::equations_in(&in_regime, self.state.t, &self.state.q, &velocities, self.inputs)?;
            let (changes, impulses) = equations.saddle.solve_motion(&none, &wanted);
            if !changes.iter().chain(&impulses).all(|x| x.is_finite()) || equations.saddle.vanishing().is_some()
            {
                return None;
            }
            let next: [S::Scalar; N] = core::array::from_fn(|i| self.state.v[i] + changes[i]);
            let size = next.iter().chain(&velocities).fold(num_traits::Zero::zero(), |size, &v| most(size, v.abs()));
            let is_same = (0..N).all(|i| !above((next[i] - velocities[i]).abs(), part * size));
            velocities = next;
            if !turns || is_same {
                let impulses = self.with_friction(&regime, impulses, &velocities);
                return Some(Impulses { changes, impulses });
            }
        }
        None
    }

    /// The velocities after the same impact on smooth contacts, whose slip gives a first direction.
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
        let (changes, _) = equations.saddle.solve(&[num_traits::Zero::zero(); N], &wanted);
        Some(core::array::from_fn(|i| v[i] + changes[i]))
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
            let holds = match (kind, parts[row]) {
                (Row::Bilateral, Part::Against) => !above(impulse, slack),
                (Row::Bilateral, _) if super::choice::is_limit(&S::ROWS, row) => !above(-slack, impulse),
                (Row::Unilateral, Part::On) => !above(-slack, impulse),
                (Row::Unilateral, _) if self.status[row] != Status::Apart => {
                    let back = if self.status[row] == Status::Meets { restitution[row] * before } else { zero };
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
