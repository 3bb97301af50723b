//! The search for less potential energy, by trust regions.
//!
//! A step leads to the least value of a quadratic model in a ball ([`curvature`](super::curvature)), whose
//! radius follows from how well the model foretells the change of energy.
//!
//! The energy itself is never evaluated: a change of it is the work of the forces along the way. So nothing
//! cancels near the end, constant inputs and moving coordinates need no energy of their own, and the forces
//! along a step tell whether it crosses a hill.

use super::curvature::Model;
use super::hills::{RULE, may_rise, share};
use super::newton::Search;
use super::statics::{Rest, Statics, dot};
use crate::analysis::Tangent;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger, smaller};

/// The most steps of a search.
const STEPS: usize = 200;

/// The end of a descent.
pub(super) enum Descent<R, const N: usize, const C: usize> {
    /// Near a minimum, or as near as the search came.
    At(Rest<R, N, C>),
    /// Nowhere: the energy falls without end.
    Endless(Rest<R, N, C>),
    /// Nowhere: these forces have no potential.
    Circulatory,
}

/// The units of a step, in which it and its forces are about one. Their product is that of energy.
#[derive(Clone, Copy)]
struct Units<R> {
    length: R,
    force: R,
}

impl<R: Ordered> Units<R> {
    fn new<const N: usize, const C: usize>(rest: &Rest<R, N, C>, length: R) -> Self {
        Self { length, force: larger(rest.push, rest.unit * length) }
    }

    /// The unit of energy in other units.
    fn energy_in(&self, other: &Self) -> R {
        (self.force / other.force) * (self.length / other.length)
    }
}

/// The change of the energy along a step.
struct Fall<R> {
    /// How far it falls.
    by: R,
    /// The uncertainty of that.
    doubt: R,
    /// Whether it rises and falls again.
    crosses_a_hill: bool,
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Goes down from a position as far as the energy falls.
    pub fn descended(
        &self,
        mut rest: Rest<S::Scalar, N, C>,
        search: &mut Search<S::Scalar, N>,
    ) -> Descent<S::Scalar, N, C> {
        let number = S::Scalar::from_f64;
        let (epsilon, zero) = (S::Scalar::epsilon(), number(0.0));
        let mut radius: Option<S::Scalar> = None;
        let (mut fallen, mut last, mut steps, mut before) = (zero, zero, zero, None);
        for _ in 0..STEPS {
            let Some(curvature) = self.curvature(&rest) else { return Descent::Circulatory };
            let count = rest.motions.count;
            let reach = self.reach(&rest, search);
            let stiffest = curvature.values.iter().fold(zero, |most, x| larger(x.abs(), most));
            let mut model = Model::new(&curvature, &rest.forces, count);
            model.flatten(&curvature, epsilon.sqrt() * stiffest * (reach / rest.length));
            // Newton's method takes over once a quarter of the digits are right: it doubles them with each
            // step.
            if model.is_low() && rest.length * model.newton_square().sqrt() <= epsilon.sqrt().sqrt() * reach {
                return Descent::At(rest);
            }
            let is_usable = |x: &S::Scalar| x.is_finite() && *x > zero;
            let scale = radius.unwrap_or_else(|| {
                let own = rest.length * model.scale(curvature.rounding);
                [own, reach].into_iter().find(is_usable).unwrap_or(number(1.0))
            });
            let units = Units::new(&rest, scale);
            let share = before.map_or(zero, |before: Units<S::Scalar>| before.energy_in(&units));
            (fallen, last, before) = (share * fallen, share * last, Some(units));
            let model = model.stretched(rest.push / units.force, rest.unit * scale / units.force);
            let mut length = number(1.0);
            let (next, by, way) = loop {
                let (components, predicted, is_cut) = model.step(length, count);
                let size = dot(&components, &components).sqrt();
                if !(size * scale > epsilon * reach && predicted > zero) {
                    // Towards a singularity the energy falls and forces grow until the coordinates have no
                    // more digits.
                    let is_singular = rest.norm >= search.met && falls_on(fallen, last, steps);
                    return ended(rest, is_singular);
                }
                let turned = curvature.turned(&components, count);
                let change = rest.motions.combined(&turned);
                let moved = array(|i| rest.q[i] + scale * change[i]);
                let found =
                    self.feasible(moved).ok().and_then(|q| self.fallen(&rest, q, [predicted, size], &units));
                if let Some((next, by, way)) = found {
                    if is_cut && by > number(0.75) * predicted {
                        length = number(2.0) * length;
                    } else if by < number(0.25) * predicted {
                        length = number(0.5) * size;
                    }
                    break (next, by, way);
                }
                length = number(0.25) * smaller(size, length);
            };
            radius = Some(length * scale);
            (fallen, last, steps) = (fallen + by, by, steps + number(1.0));
            search.stepped(way, &next);
            rest = self.turned_back(next, search);
        }
        let goes_on = search.goes_on() || falls_on(fallen, last, steps);
        ended(rest, goes_on)
    }

    /// The position at the end of a step, the fall in these units and the displacement; `None` if the step is
    /// too long for the model: the energy does not surely fall by a tenth of the prediction, it crosses a
    /// hill, or the constraints lead elsewhere.
    #[allow(clippy::type_complexity)]
    fn fallen(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        q: [S::Scalar; N],
        [predicted, size]: [S::Scalar; 2],
        units: &Units<S::Scalar>,
    ) -> Option<(Rest<S::Scalar, N, C>, S::Scalar, S::Scalar)> {
        let number = S::Scalar::from_f64;
        let way: [S::Scalar; N] = array(|i| q[i] - rest.q[i]);
        let length = self.length(&way);
        let Fall { by, doubt, crosses_a_hill } = self.fall(rest, &way, units);
        let is_sure = by - doubt >= number(0.1) * predicted;
        let is_too_far = length > number(2.0) * size * units.length;
        if !is_sure || is_too_far || crosses_a_hill || self.crosses_on_constraints(rest, &way, units) {
            return None;
        }
        let next = self.rest(q);
        next.norm.is_finite().then_some((next, by, length))
    }

    /// The work of the forces along a straight line between two positions on the constraints. The multipliers
    /// do no work, since both ends are on the constraints. With them the forces are the remaining ones, which
    /// are small.
    fn fall(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        way: &[S::Scalar; N],
        units: &Units<S::Scalar>,
    ) -> Fall<S::Scalar> {
        let number = S::Scalar::from_f64;
        let along = way.each(|x| x / units.length);
        let power = |share| {
            let q = array(|i| S::Scalar::mul_add(share, way[i], rest.q[i]));
            dot(&self.imbalance(&q, &rest.multipliers).each(|f| f / units.force), &along)
        };
        let powers = RULE.each(|(point, ..)| power(share(point)));
        let (mut by, mut coarse) = (number(0.0), number(0.0));
        for (&power, (_, fine, rough)) in powers.iter().zip(RULE) {
            by += number(0.5 * fine) * power;
            coarse += number(0.5 * rough) * power;
        }
        // Where constraints bend the way, this line tells nothing of the hills on it.
        let is_narrow = || (S::STEEP || S::ROOTED) && self.meets_a_narrow_hill(&rest.q, way, &powers, power);
        let crosses_a_hill = C == 0 && (may_rise(&powers) || is_narrow());
        Fall { by, doubt: (by - coarse).abs(), crosses_a_hill }
    }

    /// Whether the energy may rise and fall again on the constraints beside a straight line, or the line lead
    /// to another branch of them. What is left of the forces there has no part across the constraints.
    ///
    /// From one place of the line to the next the constraints are one-to-one across it if their gradients
    /// change by less than what they are: the way back onto them is a contraction then (L. Kantorovich).
    #[cold]
    fn crosses_on_constraints(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        way: &[S::Scalar; N],
        units: &Units<S::Scalar>,
    ) -> bool {
        if C == 0 {
            return false;
        }
        let along = way.each(|x| x / units.length);
        let mut branch = self.branch(&rest.gradients);
        let mut power = |share| {
            let beside = array(|i| S::Scalar::mul_add(share, way[i], rest.q[i]));
            let q = self.feasible(beside).ok()?;
            let gradients = self.variation(&q, &[S::Scalar::from_f64(0.0); C]).gradients;
            let is_on = self.leads_to(&branch, &Self::holonomic(gradients.clone()));
            branch = self.branch(&gradients);
            is_on.then(|| dot(&self.left(&q).each(|f| f / units.force), &along))
        };
        let mut powers = [S::Scalar::from_f64(0.0); RULE.len()];
        for (found, (point, ..)) in powers.iter_mut().zip(RULE) {
            let Some(power) = power(share(point)) else { return true };
            *found = power;
        }
        may_rise(&powers)
    }
}

/// Whether the last fall was at least half of the average.
fn falls_on<R: Ordered>(fallen: R, last: R, steps: R) -> bool {
    steps > R::one() && (last + last) * steps >= fallen
}

fn ended<R, const N: usize, const C: usize>(rest: Rest<R, N, C>, goes_on: bool) -> Descent<R, N, C> {
    if goes_on { Descent::Endless(rest) } else { Descent::At(rest) }
}
