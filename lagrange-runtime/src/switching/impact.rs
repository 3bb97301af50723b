//! Impacts: complementarity on the level of velocities.
//!
//! Bodies are rigid, so an impact takes no time and forces of a given size have no part in it: dry joints
//! with a given limit turn freely, bilateral constraints keep their velocities. Over all contacts that touch
//! at the moment Newton's law with the coefficient e of each is u⁺ + e u⁻ ≥ 0 ⟂ Λ ≥ 0, friction is Coulomb's
//! law for impulses: it sticks while |Λₜ| ≤ μ Λₙ, else |Λₜ| = μ Λₙ against the slip after the impact
//! (Pfeiffer and Glocker, *Multibody Dynamics with Unilateral Contacts*, chapter 8; Brogliato, *Nonsmooth
//! Mechanics*, 4.3).
//!
//! With Poisson's law the impulses of a plastic impact, that of the compression, are followed by those of an
//! expansion, of which each contact gives at least e times what it took; friction obeys its law in either
//! phase (Pfeiffer and Glocker, 8.3). Where one of the contacts follows it, all that touch do.
//!
//! With friction, or with several contacts of different coefficients, such laws can create energy, or have
//! no solution. Where that is so, the impulses are (1 + e) times those of a plastic impact instead, e the
//! least of the coefficients: a plastic impact takes energy away, and along the line from the velocities
//! before it to twice as far behind it the kinetic energy is a parabola with equal values at equal distances
//! from its lowest point, which is not nearer than the plastic one.

use super::scene::{Known, Scales, Scene, Status, above, most, product, rounding};
use super::trials::{Options, Part, combine, regime};
use super::turning::{TURNS, Turning, pairs};
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::state::State;

/// Velocities after an impact, and the impulses of all rows.
pub(super) type Struck<R, const N: usize, const C: usize> = ([R; N], [R; C]);

/// The demands of an impact on contacts.
#[derive(Clone, Copy)]
struct Demand<R, const C: usize> {
    /// The part of its closing velocity with which a contact must open.
    restitution: [R; C],
    /// Impulses that contacts give in any case, beside the unknown ones.
    given: [R; C],
}

impl<R: Real, const C: usize> Demand<R, C> {
    /// The demand that contacts stay closed, and no more.
    fn plastic() -> Self {
        Self { restitution: [R::zero(); C], given: [R::zero(); C] }
    }
}

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
    /// The velocities after the impact, and its impulses.
    pub(super) fn impact(&self) -> Result<Struck<S::Scalar, N, C>, Cause> {
        let restitution = &self.laws.restitution;
        let zero: S::Scalar = num_traits::Zero::zero();
        let by_law = if (0..C).any(|row| S::POISSON[row] && self.is_closed[row]) {
            self.by_poisson()
        } else {
            self.strike(&Demand { restitution: *restitution, given: [zero; C] })
        };
        let strike = if let Some(strike) = by_law.ok().filter(|strike| !self.gains(strike)) {
            strike
        } else {
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
            Impulses { changes: plastic.changes.each(more), impulses: plastic.impulses.each(more), ..plastic }
        };
        Ok((array(|i| self.state.v[i] + strike.changes[i]), strike.impulses))
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
        let known = Known { closed: self.is_closed, fired: None, settled: true, rested: [false; C] };
        let scales = Scales { speeds: self.speeds, ..Scales::new() };
        let state = State { v, ..self.state };
        let between = Scene::new(self.system, &state, self.inputs, self.kinks, &scales, &known);
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

    fn strike(&self, demand: &Demand<S::Scalar, C>) -> Result<Impulses<S::Scalar, N, C>, Cause> {
        let options: [Options; C] = array(|row| self.ways(row));
        let fine: S::Scalar = rounding();
        let mut cause = Cause::NotFinite;
        for part in [fine, fine * fine.sqrt().sqrt().recip(), fine.sqrt() * S::Scalar::from_f64(0.1)] {
            let mut found = None;
            combine(&options, |parts| {
                if let Some(strike) = self.impulses(parts, &options, demand, part) {
                    match self.agree(parts, &strike, demand, part) {
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

    /// The activities of a row in an impact.
    fn ways(&self, row: usize) -> Options {
        let is_limit = super::choice::is_limit(&S::ROWS, row);
        match (S::ROWS[row], self.status[row]) {
            (Row::Bilateral, _) if is_limit => Options::new(&[Part::On, Part::Against]),
            (Row::Bilateral | Row::Load, _) => Options::new(&[Part::On]),
            // A contact that opens may be closed by the impulses at others.
            (Row::Unilateral, Status::Apart) if self.is_closed[row] => Options::new(&[Part::Off, Part::On]),
            (Row::Unilateral, Status::Meets | Status::Touches) => Options::new(&[Part::On, Part::Off]),
            (Row::Friction { normal: None, .. }, _) => Options::new(&[Part::Off]),
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
    fn wanted(&self, row: usize, restitution: &[S::Scalar; C]) -> S::Scalar {
        let rate = self.laws.rows.rates[row];
        match S::ROWS[row] {
            Row::Bilateral | Row::Load => num_traits::Zero::zero(),
            Row::Unilateral if self.status[row] == Status::Meets => -(rate + restitution[row] * rate),
            Row::Unilateral | Row::Friction { .. } => -rate,
        }
    }

    /// The impulses of a combination; `None` where it has no solution.
    fn impulses(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        demand: &Demand<S::Scalar, C>,
        part: S::Scalar,
    ) -> Option<Impulses<S::Scalar, N, C>> {
        let driven = demand.given.each(|impulse| impulse.is_positive());
        let regime = regime(&S::ROWS, parts, options, &driven, self.kinks)?;
        let in_regime = self.system.in_regime(&regime);
        let wanted = array(|row| self.wanted(row, &demand.restitution));
        let State { t, q, v } = &self.state;
        let solve = |in_regime: &S::InRegime, v: &[S::Scalar; N]| {
            let equations = S::equations_in(in_regime, *t, q, v, self.inputs)?;
            let given = self.given(&regime, &demand.given, v);
            let (changes, impulses) = equations.saddle.solve_motion(&given, &wanted);
            let is_finite = changes.iter().chain(&impulses).all(|x| x.is_finite());
            (is_finite && equations.saddle.vanishing().is_none()).then_some((changes, impulses))
        };
        let found = |(changes, impulses): ([S::Scalar; N], _)| {
            let after = array(|i| v[i] + changes[i]);
            let impulses = self.with_friction(&regime, impulses, &demand.given, &after);
            Impulses { changes, impulses, active: regime.active }
        };
        // A slip in two directions is sought so that friction opposes the slip that follows.
        let zero: S::Scalar = num_traits::Zero::zero();
        let turns = |row: usize| regime.slip[row] != zero;
        if !pairs(&S::ROWS).any(|[row, _]| turns(row)) {
            return solve(&in_regime, v).map(found);
        }
        let smooth = self.without_friction(parts, options, demand)?;
        let rates = &self.laws.rows.rates;
        let after =
            |row: usize, changes: &[S::Scalar; N]| rates[row] + product(&self.gradients[row], changes);
        // The velocities that have these slips. Slips that depend on each other are replaced by those of some
        // motion.
        let mut changes = smooth;
        let mut turning = Turning::new();
        for _ in 0..TURNS {
            let slips: [S::Scalar; C] = array(|row| after(row, &changes));
            let strike = solve(&in_regime, &array(|i| v[i] + changes[i]))?;
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
            let share = turning.share(&slips, &lacks);
            changes = array(|i| changes[i] + share * (strike.0[i] - changes[i]));
        }
        None
    }

    /// The changes that given impulses of contacts make, with the friction that they drive where it slips.
    /// Slips in two directions have the directions of these velocities.
    fn given(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        given: &[S::Scalar; C],
        v: &[S::Scalar; N],
    ) -> [S::Scalar; N] {
        let impulses = self.with_friction(regime, *given, &[num_traits::Zero::zero(); C], v);
        let mut sums = [num_traits::Zero::zero(); N];
        for (gradient, &impulse) in self.gradients.iter().zip(&impulses) {
            for (sum, &entry) in sums.iter_mut().zip(gradient) {
                *sum += entry * impulse;
            }
        }
        sums
    }

    /// The changes of velocities by the same impact on smooth contacts, whose slip gives a first direction.
    fn without_friction(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        demand: &Demand<S::Scalar, C>,
    ) -> Option<[S::Scalar; N]> {
        let rates = &self.laws.rows.rates;
        let smooth = array(|row| match S::ROWS[row] {
            Row::Friction { .. } => Part::Off,
            _ => parts[row],
        });
        let bare = options.each(|_| Options::new(&[Part::Off]));
        let in_regime = self.system.in_regime(&regime(&S::ROWS, &smooth, &bare, &[false; C], self.kinks)?);
        let wanted = array(|row| match S::ROWS[row] {
            Row::Unilateral => -(rates[row] + demand.restitution[row] * rates[row]),
            _ => num_traits::Zero::zero(),
        });
        let State { t, q, v } = &self.state;
        let equations = S::equations_in(&in_regime, *t, q, v, self.inputs)?;
        let given = self.given(&Regime::open(&S::ROWS), &demand.given, v);
        Some(equations.saddle.solve(&given, &wanted).0)
    }

    /// The impulses of frictions that slip. They follow from the impulses of their contacts and from those
    /// that are `given`.
    fn with_friction(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        mut impulses: [S::Scalar; C],
        given: &[S::Scalar; C],
        after: &[S::Scalar; N],
    ) -> [S::Scalar; C] {
        let zero: S::Scalar = num_traits::Zero::zero();
        let rate = |row: usize| {
            let change = array(|i| after[i] - self.state.v[i]);
            self.laws.rows.rates[row] + product(&self.gradients[row], &change)
        };
        for (row, kind) in S::ROWS.iter().enumerate() {
            let Row::Friction { normal: Some(normal), pair } = kind else { continue };
            let slip = regime.slip[row];
            if slip == zero {
                continue;
            }
            let size = self.against(slip).kinetic[row] * (impulses[*normal] + given[*normal]).abs();
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

    /// Whether the demands of a combination agree with its consequences; if not, the row where they do not.
    fn agree(
        &self,
        parts: &[Part; C],
        strike: &Impulses<S::Scalar, N, C>,
        demand: &Demand<S::Scalar, C>,
        part: S::Scalar,
    ) -> Result<(), usize> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut sizes = [zero; N];
        self.load(&strike.impulses, &mut sizes);
        self.load(&demand.given, &mut sizes);
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
            // Rows that depend on each other may demand contradictory things.
            let wanted = self.wanted(row, &demand.restitution);
            let asked = strike.active[row] && *kind != Row::Bilateral;
            // What single impulses do to its rate is the measure where all rates are roundings.
            let single = self.effect(row, &sizes);
            let inexact =
                S::Scalar::epsilon().sqrt() * (wanted.abs() + change.abs() + self.speeds[row] + single);
            if asked && above((change - wanted).abs(), inexact) {
                return Err(row);
            }
            let holds = match (kind, parts[row]) {
                (Row::Bilateral, Part::Against) => !above(impulse, slack),
                (Row::Bilateral, _) if super::choice::is_limit(&S::ROWS, row) => !above(-slack, impulse),
                (Row::Unilateral, Part::On) => !above(-slack, impulse),
                (Row::Unilateral, _) if self.is_closed[row] => {
                    let meets = self.status[row] == Status::Meets;
                    let back = if meets { demand.restitution[row] * before } else { zero };
                    !above(-play, after + back)
                }
                (Row::Friction { normal: Some(normal), pair }, way) => {
                    let given = demand.given[*normal];
                    let limit =
                        self.against(-impulse).kinetic[row] * (strike.impulses[*normal] + given).abs();
                    let other = pair.map_or(zero, |other| strike.impulses[other]);
                    match way {
                        Part::On if parts[*normal] != Part::Off || given.is_positive() => {
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
