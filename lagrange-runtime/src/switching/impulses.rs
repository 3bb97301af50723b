//! The impulses of one combination of activities in an impact.

use super::impact::{Demand, Impulses};
use super::scene::{Scene, Sticking, above, entry, most, put};
use super::trials::{Options, Part, regime};
use super::turning::{TURNS, Turning, has_pairs, newton, pairs};
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::state::State;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The impulses of a combination; `None` where it has no solution or repeats another combination. Slips
    /// in two directions count as found where they lack less than `part` of their sizes.
    pub(super) fn impulses(
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
            let is_one = equations.saddle.is_independent() || driven.contains(&true);
            (is_finite && equations.saddle.vanishing().is_none()).then_some((changes, impulses, is_one))
        };
        // Friction has the directions that it had in the equations, at the velocities `v`. Those after the
        // impact agree with them only as far as the search has come.
        let found = |(changes, mut impulses, is_one): ([S::Scalar; N], _, bool), v: &[S::Scalar; N]| {
            if !is_one && let Some(possible) = self.possible(&regime, v, &impulses) {
                impulses = possible;
            }
            let impulses = self.with_friction(&regime, impulses, &demand.given, v);
            Impulses { changes, impulses, active: regime.active }
        };
        // A slip in two directions is sought so that friction opposes the slip that follows.
        let zero: S::Scalar = num_traits::Zero::zero();
        let turns = |row: usize| entry(&regime.slip, row) != zero;
        if const { !has_pairs(&S::ROWS) } || !pairs(&S::ROWS).any(|[row, _]| turns(row)) {
            return solve(&in_regime, v).map(|strike| found(strike, v));
        }
        let smooth = self.without_friction(parts, options, demand)?;
        let rates = &self.laws.rows.rates;
        let after = |row: usize, changes: &[S::Scalar; N]| entry(rates, row) + self.along(row, changes);
        // The strike where friction opposes the slips that these changes of velocities leave; these slips;
        // what they lack of those after the strike; and whether that is nothing.
        let seek = |changes: &[S::Scalar; N]| {
            let slips: [S::Scalar; C] = array(|row| after(row, changes));
            let strike = solve(&in_regime, &array(|i| v[i] + changes[i]))?;
            let (mut lacks, mut is_done) = ([zero; C], true);
            for [row, other] in pairs(&S::ROWS).filter(|[row, _]| turns(*row)) {
                let [x, y] = [row, other].each(|row| entry(&slips, row));
                let [lack_x, lack_y] = [after(row, &strike.0) - x, after(other, &strike.0) - y];
                put(&mut lacks, row, lack_x);
                put(&mut lacks, other, lack_y);
                let size = most(entry(&self.speeds, row), entry(&self.speeds, other)) + x.hypot(y);
                is_done = is_done && !above(lack_x.hypot(lack_y), part * size);
            }
            Some((strike, slips, lacks, is_done))
        };
        // Slips may depend on each other. So changes of velocities are sought, which have slips of some
        // motion. Newton's method gives the digits that steps leave, or finds what they do not.
        let mut changes = smooth;
        // Friction that is strong, or a slip that is slow, makes longer steps overshoot.
        let mut turning = Turning::new([0.25, 1.0]);
        let (mut near, mut is_near) = (smooth, false);
        for _ in 0..TURNS {
            let (strike, slips, lacks, is_done) = seek(&changes)?;
            if is_done {
                (near, is_near) = (changes, true);
                break;
            }
            let share = turning.share(&slips, &lacks);
            changes = array(|i| changes[i] + share * (strike.0[i] - changes[i]));
        }
        let image =
            |changes: &[S::Scalar; N]| seek(changes).map(|(strike, _, _, is_done)| (strike.0, is_done));
        let changes = newton(near, &self.units, image).or(is_near.then_some(near))?;
        seek(&changes).map(|(strike, ..)| found(strike, &array(|i| v[i] + changes[i])))
    }

    /// Impulses that contacts and frictions can give and that make the same changes of velocities as these,
    /// which are those of rows that depend on each other. `after` are the velocities after the impact. `None`
    /// where none are found.
    #[cold]
    fn possible(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        after: &[S::Scalar; N],
        impulses: &[S::Scalar; C],
    ) -> Option<[S::Scalar; C]> {
        let (zero, one) = (num_traits::Zero::zero(), num_traits::One::one());
        let is_friction = |row: usize| matches!(S::ROWS[row], Row::Friction { .. });
        let units = array(|row| if is_friction(row) { zero } else { one });
        let by_unit = self.with_friction(regime, units, &[zero; C], after);
        let drags = array(|row| if is_friction(row) { by_unit[row] } else { zero });
        self.shortest(regime, &drags, impulses, Sticking::ByImpulses)
    }

    /// The generalized impulses of given impulses of contacts, with the friction that they drive where it
    /// slips. Slips in two directions have their directions at the velocities `v`.
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
    /// `None` for a system without contacts.
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

    /// The impulses with those of frictions that slip, which follow from the impulses of their contacts and
    /// from those that are `given`. Slips in two directions have their directions at the velocities `after`.
    fn with_friction(
        &self,
        regime: &Regime<S::Scalar, C, W>,
        mut impulses: [S::Scalar; C],
        given: &[S::Scalar; C],
        after: &[S::Scalar; N],
    ) -> [S::Scalar; C] {
        let zero: S::Scalar = num_traits::Zero::zero();
        for (row, kind) in S::ROWS.iter().enumerate() {
            let Row::Friction { normal: Some(normal), pair } = kind else { continue };
            let slip = entry(&regime.slip, row);
            if slip == zero {
                continue;
            }
            let pressing = entry(&impulses, *normal) + entry(given, *normal);
            let size = entry(&self.against(slip).kinetic, row) * pressing.abs();
            match pair {
                None => put(&mut impulses, row, -slip * size),
                Some(other) => {
                    let (x, y) = (self.rate_at(row, after), self.rate_at(*other, after));
                    let length = x.hypot(y);
                    if length.is_positive() {
                        put(&mut impulses, row, -size * x / length);
                        put(&mut impulses, *other, -size * y / length);
                    }
                }
            }
        }
        impulses
    }
}
