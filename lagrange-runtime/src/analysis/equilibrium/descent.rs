//! The search for less potential energy, by trust regions.
//!
//! On the constraints the energy is, to second order in the components y of a motion, V − g·y + ½ yᵀ H y.
//! Here g are the forces that are left beside the multipliers of least squares. H = −Zᵀ (∂r/∂q) Z contains
//! the curvature of the constraints with their multipliers. The eigenvalues of H give the least value of this
//! model in a ball, also where H is not positive (J. Nocedal, S. Wright, *Numerical Optimization*, 2nd ed., §
//! 4.3): forces and negative curvature lead down alike. The radius of the ball follows from how well the
//! model foretells the change of energy.
//!
//! The energy itself is never evaluated: a change of it is the work of the forces along the way. So nothing
//! cancels near the end, constant inputs and moving coordinates need no energy of their own, and the forces
//! along a step tell whether it crosses a hill.

use super::newton::Search;
use super::statics::{Rest, Statics, dot};
use crate::analysis::Tangent;
use crate::linear::diagonalise;
use crate::linear::stored::Stored;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger, smaller};

/// The most steps of a search.
const STEPS: usize = 200;

/// Halvings of the interval of the trust region's multiplier. The radius is arbitrary, so a few digits of it
/// suffice.
const HALVINGS: usize = 40;

/// The rule of Kronrod with seven points on [−1, 1]: points, weights, and the weights of the rule of Gauss
/// with three of the points (R. Piessens et al., *QUADPACK*, 1983).
const RULE: [(f64, f64, f64); 7] = [
    (-0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
    (-0.774_596_669_241_483_4, 0.268_488_089_868_333_44, 5.0 / 9.0),
    (-0.434_243_749_346_802_55, 0.401_397_414_775_962_2, 0.0),
    (0.0, 0.450_916_538_658_474_14, 8.0 / 9.0),
    (0.434_243_749_346_802_55, 0.401_397_414_775_962_2, 0.0),
    (0.774_596_669_241_483_4, 0.268_488_089_868_333_44, 5.0 / 9.0),
    (0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
];

/// The end of a descent.
pub(super) enum Descent<R, const N: usize, const C: usize> {
    /// Near a minimum, or as near as the search came.
    At(Rest<R, N, C>),
    /// Nowhere: the energy falls without end.
    Endless(Rest<R, N, C>),
    /// Nowhere: these forces have no potential.
    Circulatory,
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

/// The second derivatives of the energy, by eigenvalues and eigenvectors.
pub(super) struct Curvature<R, const N: usize> {
    pub values: [R; N],
    vectors: Stored<[[R; N]; N]>,
    /// Eigenvalues up to this size are rounding errors.
    pub rounding: R,
}

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// The curvature of the energy; `None` if forces have no potential.
    ///
    /// An entry errs by 16 N ε times the magnitudes of its summands at most, as in the modes.
    pub fn curvature(&self, rest: &Rest<S::Scalar, N, C>) -> Option<Curvature<S::Scalar, N>> {
        let count = rest.motions.count;
        let mut stiffness = rest.stiffness.clone();
        let share = S::Scalar::from_f64(16.0 * count as f64) * S::Scalar::epsilon();
        let rounding = share * stiffness.size;
        let rows = &mut stiffness.rows;
        for (k, l) in (0..count).flat_map(|k| (0..k).map(move |l| (k, l))) {
            let (above, below) = (rows[l][k], rows[k][l]);
            if (above - below).abs() > rounding {
                return None;
            }
            let mean = S::Scalar::from_f64(0.5) * (above + below);
            (rows[l][k], rows[k][l]) = (mean, mean);
        }
        let mut vectors = Stored::zeros();
        diagonalise(rows, &mut vectors, count);
        Some(Curvature { values: array(|k| rows[k][k]), vectors, rounding })
    }

    /// Goes down from a position as far as the energy falls.
    pub fn descended(
        &self,
        mut rest: Rest<S::Scalar, N, C>,
        search: &mut Search<S::Scalar, N>,
    ) -> Descent<S::Scalar, N, C> {
        let number = S::Scalar::from_f64;
        let (epsilon, zero) = (S::Scalar::epsilon(), number(0.0));
        let mut radius: Option<S::Scalar> = None;
        let (mut fallen, mut last, mut steps) = (zero, zero, zero);
        for _ in 0..STEPS {
            let Some(curvature) = self.curvature(&rest) else { return Descent::Circulatory };
            let count = rest.motions.count;
            let reach = self.reach(&rest, search);
            let stiffest = curvature.values.iter().fold(zero, |most, x| larger(x.abs(), most));
            let mut model = Model::new(&curvature, &rest.forces, count);
            model.flatten(&curvature, epsilon * stiffest * stiffest * reach);
            // Newton's method takes over once a quarter of the digits are right: it doubles them with each
            // step.
            if model.is_low() && model.newton_square() <= epsilon.sqrt() * reach {
                return Descent::At(rest);
            }
            let mut length = radius.unwrap_or_else(|| {
                let own = model.scale(curvature.rounding);
                [own, reach.sqrt()].into_iter().find(|x| x.is_finite() && *x > zero).unwrap_or(number(1.0))
            });
            let (next, by, way) = loop {
                let (components, predicted, is_cut) = model.step(length, count);
                let size = dot(&components, &components).sqrt();
                if !(size * size > epsilon * epsilon * reach && predicted > zero) {
                    // Towards a singularity the energy falls and forces grow until the coordinates have no
                    // more digits.
                    let is_singular = rest.norm >= search.met && falls_on(fallen, last, steps);
                    return ended(rest, is_singular);
                }
                let turned = curvature.turned(&components, count);
                let change = rest.motions.combined(&turned);
                let moved = array(|i| rest.q[i] + change[i]);
                let found = self.feasible(moved).ok().and_then(|q| self.fallen(&rest, q, predicted, size));
                if let Some((next, by, way)) = found {
                    let foretold = rest.unit * predicted;
                    if is_cut && by > number(0.75) * foretold {
                        length = number(2.0) * length;
                    } else if by < number(0.25) * foretold {
                        length = number(0.5) * size;
                    }
                    break (next, by, way);
                }
                length = number(0.25) * smaller(size, length);
            };
            radius = Some(length);
            (fallen, last, steps) = (fallen + by, by, steps + number(1.0));
            search.stepped(way, &next);
            rest = next;
        }
        let goes_on = search.goes_on() || falls_on(fallen, last, steps);
        ended(rest, goes_on)
    }

    /// The position at the end of a step, the fall and the displacement; `None` if the step is too long for
    /// the model: the energy does not surely fall by a tenth of the prediction, it crosses a hill, or the
    /// constraints lead elsewhere.
    #[allow(clippy::type_complexity)]
    fn fallen(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        q: [S::Scalar; N],
        predicted: S::Scalar,
        size: S::Scalar,
    ) -> Option<(Rest<S::Scalar, N, C>, S::Scalar, S::Scalar)> {
        let number = S::Scalar::from_f64;
        let way: [S::Scalar; N] = array(|i| q[i] - rest.q[i]);
        let length = self.size(&way).sqrt();
        let Fall { by, doubt, crosses_a_hill } = self.fall(rest, &way);
        let predicted = rest.unit * predicted;
        let is_sure = by - doubt >= number(0.1) * predicted;
        if !is_sure || crosses_a_hill || length > number(2.0) * size {
            return None;
        }
        let next = self.rest(q);
        next.norm.is_finite().then_some((next, by, length))
    }

    /// The work of the forces along a straight line between two positions on the constraints. The multipliers
    /// do no work, since both ends are on the constraints. With them the forces are the remaining ones, which
    /// are small.
    fn fall(&self, rest: &Rest<S::Scalar, N, C>, way: &[S::Scalar; N]) -> Fall<S::Scalar> {
        let number = S::Scalar::from_f64;
        let mut powers = [number(0.0); RULE.len()];
        let (mut by, mut coarse) = (number(0.0), number(0.0));
        for (power, (point, fine, rough)) in powers.iter_mut().zip(RULE) {
            let share = number(0.5 * (1.0 + point));
            let q = array(|i| S::Scalar::mul_add(share, way[i], rest.q[i]));
            *power = self.power(&q, &rest.multipliers, way);
            by += number(0.5 * fine) * *power;
            coarse += number(0.5 * rough) * *power;
        }
        // A rise within half of the digits of the forces is no hill.
        let most = powers.iter().fold(number(0.0), |most, x| larger(x.abs(), most));
        let noise = S::Scalar::epsilon().sqrt() * most;
        let (mut has_risen, mut crosses_a_hill) = (false, false);
        for power in powers {
            has_risen |= power < -noise;
            crosses_a_hill |= has_risen && power > noise;
        }
        Fall { by, doubt: (by - coarse).abs(), crosses_a_hill }
    }
}

/// Whether the last fall was at least half of the average.
fn falls_on<R: Ordered>(fallen: R, last: R, steps: R) -> bool {
    steps > R::one() && (last + last) * steps >= fallen
}

fn ended<R, const N: usize, const C: usize>(rest: Rest<R, N, C>, goes_on: bool) -> Descent<R, N, C> {
    if goes_on { Descent::Endless(rest) } else { Descent::At(rest) }
}

impl<R: Ordered, const N: usize> Curvature<R, N> {
    /// How many directions lead up, are flat, and lead down.
    pub fn signature(&self, count: usize) -> [usize; 3] {
        let mut signature = [0; 3];
        for &value in self.values.iter().take(count) {
            let which = if value > self.rounding {
                0
            } else if value < -self.rounding {
                2
            } else {
                1
            };
            signature[which] += 1;
        }
        signature
    }

    /// A vector along the motions, from its components along eigenvectors.
    fn turned(&self, components: &[R; N], count: usize) -> [R; N] {
        let mut sum = [R::zero(); N];
        for (vector, &y) in self.vectors.iter().zip(components).take(count) {
            for (sum, &z) in sum.iter_mut().zip(vector) {
                *sum = R::mul_add(y, z, *sum);
            }
        }
        sum
    }
}

/// −g·y + ½ Σ λ y², by components along eigenvectors.
struct Model<R, const N: usize> {
    forces: [R; N],
    values: [R; N],
    least: R,
}

impl<R: Ordered, const N: usize> Model<R, N> {
    fn new(curvature: &Curvature<R, N>, forces: &[R; N], count: usize) -> Self {
        let mut along = [R::zero(); N];
        for (along, vector) in along.iter_mut().zip(curvature.vectors.iter()).take(count) {
            *along = dot(vector, forces);
        }
        Self { forces: along, values: curvature.values, least: R::zero() }
    }

    /// Sets curvatures that are rounding errors to zero, and with them forces whose square is below a bound.
    /// Along such directions, as along a symmetry, nothing holds the system and nothing drives it.
    fn flatten(&mut self, curvature: &Curvature<R, N>, bound: R) {
        for (value, force) in self.values.iter_mut().zip(&mut self.forces) {
            if value.abs() <= curvature.rounding {
                *value = R::zero();
                if *force * *force <= bound {
                    *force = R::zero();
                }
            }
            self.least = smaller(*value, self.least);
        }
    }

    /// Whether only forces in stiff directions lead down.
    fn is_low(&self) -> bool {
        let held = |(&value, &force): (&R, &R)| value > R::zero() || value == R::zero() && force == R::zero();
        self.values.iter().zip(&self.forces).all(held)
    }

    /// The squared length of Newton's step.
    fn newton_square(&self) -> R {
        self.square(R::zero())
    }

    /// A first radius: the length of Newton's step with the magnitudes of all curvatures that exceed rounding
    /// errors.
    fn scale(&self, rounding: R) -> R {
        let components = self.values.iter().zip(&self.forces);
        let stiff = components.filter(|(value, _)| value.abs() > rounding);
        stiff.fold(R::zero(), |sum, (&value, &force)| sum + (force / value) * (force / value)).sqrt()
    }

    /// |y|² where y = (H + μ)⁻¹ g.
    fn square(&self, shift: R) -> R {
        let mut sum = R::zero();
        for (&value, &force) in self.values.iter().zip(&self.forces) {
            if force != R::zero() {
                let y = force / (value + shift);
                sum = R::mul_add(y, y, sum);
            }
        }
        sum
    }

    /// The minimum of the model within a radius, the fall to it, and whether the radius limits it.
    fn step(&self, radius: R, count: usize) -> ([R; N], R, bool) {
        let most = radius * radius;
        let is_cut = !(self.is_low() && self.square(R::zero()) <= most);
        let mut shift = R::zero();
        if is_cut {
            // |y| falls as μ grows: from its value at the pole, which may be infinite, to less than the
            // radius.
            let force = dot(&self.forces, &self.forces).sqrt();
            let (mut low, mut high) = (-self.least, -self.least + force / radius);
            for _ in 0..HALVINGS {
                let middle = R::from_f64(0.5) * (low + high);
                if self.square(middle) <= most { high = middle } else { low = middle }
            }
            shift = high;
        }
        let mut y = [R::zero(); N];
        for (y, (&value, &force)) in y.iter_mut().zip(self.values.iter().zip(&self.forces)) {
            if force != R::zero() {
                *y = force / (value + shift);
            }
        }
        // The hard case: there is no force along the most negative curvature, so both of its directions lead
        // down.
        let rest = most - dot(&y, &y);
        let is_hard = is_cut && self.least < R::zero() && rest > R::from_f64(0.5) * most;
        if let Some(k) = (0..count).find(|&k| is_hard && self.values[k] == self.least) {
            let sign = if self.forces[k] < R::zero() { -R::one() } else { R::one() };
            y[k] = sign * (rest + y[k] * y[k]).sqrt();
        }
        let half = R::from_f64(0.5);
        let terms = y.iter().zip(self.values.iter().zip(&self.forces));
        let predicted =
            terms.fold(R::zero(), |sum, (&y, (&value, &force))| sum + y * (force - half * value * y));
        (y, predicted, is_cut)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_of_kronrod_has_its_degree() {
        for degree in 0..12 {
            let sum = |weight: fn(&(f64, f64, f64)) -> f64| -> f64 {
                RULE.iter().map(|rule| weight(rule) * rule.0.powi(degree)).sum()
            };
            let exact = if degree % 2 == 0 { 2.0 / f64::from(degree + 1) } else { 0.0 };
            assert!((sum(|rule| rule.1) - exact).abs() < 1e-15, "{degree}");
            assert_eq!((sum(|rule| rule.2) - exact).abs() < 1e-15, degree < 6 || degree % 2 == 1, "{degree}");
        }
    }

    fn model(values: [f64; 3], forces: [f64; 3]) -> Model<f64, 3> {
        let least = values.into_iter().fold(0.0, f64::min);
        Model { forces, values, least }
    }

    #[test]
    fn steps_are_the_least_of_their_ball() {
        for (values, forces, radius) in [
            ([1.0, 2.0, 4.0], [1.0, 1.0, 1.0], 10.0),
            ([1.0, 2.0, 4.0], [1.0, 1.0, 1.0], 0.1),
            ([-1.0, 2.0, 4.0], [1e-3, 1.0, -1.0], 0.7),
            ([-1.0, 2.0, 4.0], [0.0, 1.0, -1.0], 5.0),
            ([0.0, 2.0, 0.0], [0.3, 1.0, 0.0], 2.0),
        ] {
            let model = model(values, forces);
            let (y, predicted, is_cut) = model.step(radius, 3);
            let size = dot(&y, &y).sqrt();
            assert!(size <= radius * (1.0 + 1e-12));
            assert_eq!(is_cut, size > 0.99 * radius, "{y:?}");
            let value =
                |y: [f64; 3]| -> f64 { (0..3).map(|k| y[k] * (0.5 * values[k] * y[k] - forces[k])).sum() };
            assert!((value(y) + predicted).abs() < 1e-12);
            // No other point of the ball is lower.
            for i in 0..4000 {
                let (a, b) = (f64::from(i) * 2.399_963, 1.0 - f64::from(i) / 2000.0);
                let flat = (1.0 - b * b).max(0.0).sqrt();
                for share in [0.3, 0.7, 1.0] {
                    let r = share * radius;
                    let other = [r * flat * a.cos(), r * flat * a.sin(), r * b];
                    assert!(value(other) >= -predicted * (1.0 + 1e-5) - 1e-12, "{values:?}: {other:?} {y:?}");
                }
            }
        }
    }
}
