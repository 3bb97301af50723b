//! The common size of several reactions, which drives friction.
//!
//! A load N = |F| is an unknown like the reactions κ that its force F is a sum of. Friction changes the
//! reactions in proportion to N, so that F = a + X N. Here a is the force without friction and X the response
//! to a load of one. Each load gives one scalar equation |a + X N| = N, which is convex. Newton's method from
//! N = 0 finds its solution, which exists and is unique where |X| < 1. Otherwise the equation may have none
//! or two, and friction jams. Several loads have one solution where the matrix of all |X| is a contraction,
//! which the pivots of 1 − |X| tell.
//!
//! Along a motion N² = F · F holds for the series as well. Its order zero is the equation above. Each order
//! k > 0 gives N\[k] = n · F\[k] plus terms of lower orders, with the direction n = F\[0] / N\[0]: a linear
//! equation. Where a force begins to grow from zero, its first order that is not zero takes the place of
//! order zero. A force of nothing but rounding errors has no direction, and counts as zero: a series with the
//! direction of rounding errors would converge for no longer than they last.

use super::vectors::{pick, put};
use crate::linear::Lu;
use crate::number::elements::array;
use crate::number::real::Real;

/// The most steps of Newton's method. It converges by squares, and from N = 0 without turning back.
const ITERATIONS: usize = 64;

/// The rounding errors of a force: Newton's method has converged where its load changes by no more than so
/// many, and a force that is no larger has no direction.
const ULPS: f64 = 16.0;

/// A row that is no constraint: its multiplier follows from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    /// A sum of other multipliers with given factors: a component of a force, or loads of several places.
    Sum {
        /// Its row.
        row: usize,
    },
    /// The size of a force.
    Size {
        /// Its row.
        row: usize,
        /// The rows of the components.
        parts: &'static [usize],
    },
}

impl Load {
    /// Its row.
    pub(super) fn row(&self) -> usize {
        let (Self::Sum { row } | Self::Size { row, .. }) = self;
        *row
    }
}

/// Loads whose friction changes the forces that make them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Loads<R, const C: usize> {
    table: &'static [Load],
    /// The factors of the sums.
    shares: [[R; C]; C],
    /// The response of all multipliers to a unit load, at the index of its row.
    response: [[R; C]; C],
}

/// The tangent of the size of a force: N = n · F + rest.
struct Tangent<R, const C: usize> {
    /// The direction n by row; zero of rows that are no components.
    direction: [R; C],
    rest: R,
}

impl<R: Real, const C: usize> Loads<R, C> {
    /// `linear` has multipliers as they follow from given loads; `None` where friction jams.
    pub(super) fn new(table: &'static [Load], shares: &[[R; C]; C], linear: &Lu<R, C>) -> Option<Self> {
        let mut response = [[R::zero(); C]; C];
        for (row, _) in sizes(table) {
            let unit = array(|index| if index == row { R::one() } else { R::zero() });
            *response.get_mut(row)? = linear.solve(unit);
        }
        let this = Self { table, shares: *shares, response };
        this.is_contraction().then_some(this)
    }

    /// The rows of sums.
    pub(super) fn sums(&self) -> impl Iterator<Item = usize> {
        self.table.iter().filter(|load| matches!(load, Load::Sum { .. })).map(Load::row)
    }

    /// The rows of constraints whose multipliers make the loads.
    pub(super) fn terms(&self) -> impl Iterator<Item = usize> {
        (0..C).filter(|&row| {
            let is_part = sizes(self.table).any(|(_, parts)| parts.contains(&row));
            let has_share = |sum: usize| self.shares.get(sum).is_some_and(|own| pick(own, row) != R::zero());
            self.sums().all(|sum| sum != row) && (is_part || self.sums().any(has_share))
        })
    }

    /// Bounds the errors of loads by those of their terms.
    pub(super) fn bound(&self, bounds: &mut [R; C]) {
        for load in self.table {
            let bound = match *load {
                Load::Sum { row } => {
                    let shares = self.shares.get(row).into_iter().flatten().zip(&*bounds);
                    shares.fold(R::zero(), |sum, (&share, &bound)| sum + share.abs() * bound)
                }
                Load::Size { parts, .. } => {
                    parts.iter().fold(R::zero(), |sum, &part| sum + pick(bounds, part))
                }
            };
            put(bounds, load.row(), bound);
        }
    }

    /// Whether loads and the forces that they cause converge: the pivots of 1 − |X| are positive.
    fn is_contraction(&self) -> bool {
        let mut matrix = [[R::zero(); C]; C];
        for (row, parts) in sizes(self.table) {
            let Some(entries) = matrix.get_mut(row) else { continue };
            for (other, _) in sizes(self.table) {
                let Some(response) = self.response.get(other) else { continue };
                let size = norm(response, parts);
                put(entries, other, if row == other { R::one() - size } else { -size });
            }
        }
        for (pivot, _) in sizes(self.table) {
            let Some(leading) = matrix.get(pivot).copied() else { continue };
            if !pick(&leading, pivot).is_positive() {
                return false;
            }
            for (row, _) in sizes(self.table).filter(|(row, _)| *row > pivot) {
                let Some(entries) = matrix.get_mut(row) else { continue };
                let factor = pick(entries, pivot) / pick(&leading, pivot);
                for (entry, &above) in entries.iter_mut().zip(&leading) {
                    *entry -= factor * above;
                }
            }
        }
        true
    }

    /// All multipliers, from those without loads. `bounds` tells the sizes of what loads are made of.
    /// NaN where Newton's method fails.
    pub(super) fn solve(&self, free: &[R; C], bounds: impl Fn() -> [R; C]) -> [R; C] {
        self.settled(free, bounds, |_, _| None)
    }

    /// The same for an order of a series, times `rate`, as `free` is. `known` has the multipliers of the
    /// lower orders, a row each.
    pub(super) fn solve_order(
        &self,
        free: &[R; C],
        bounds: impl Fn() -> [R; C],
        rate: R,
        known: &[[R; C]],
    ) -> [R; C] {
        self.settled(free, bounds, |row, parts| {
            let first = known.iter().position(|known| pick(known, row) != R::zero())?;
            let (start, later) = known.get(first..)?.split_first()?;
            let mut square = R::zero();
            for (one, other) in later.iter().zip(later.iter().rev()) {
                let force = parts
                    .iter()
                    .fold(R::zero(), |sum, &part| pick(one, part).mul_add(pick(other, part), sum));
                square += force - pick(one, row) * pick(other, row);
            }
            let (mut direction, size) = ([R::zero(); C], pick(start, row));
            for &part in parts {
                put(&mut direction, part, pick(start, part) / size);
            }
            Some(Tangent { direction, rest: rate * square / (size + size) })
        })
    }

    /// Newton's method for the sizes whose tangents are not `given`.
    fn settled(
        &self,
        free: &[R; C],
        bounds: impl Fn() -> [R; C],
        given: impl Fn(usize, &[usize]) -> Option<Tangent<R, C>>,
    ) -> [R; C] {
        let mut multipliers = *free;
        let mut has_converged = false;
        for _ in 0..ITERATIONS {
            let mut matrix: [[R; C]; C] =
                array(|row| array(|column| if row == column { R::one() } else { R::zero() }));
            let mut right = [R::zero(); C];
            let mut is_linear = true;
            for (row, parts) in sizes(self.table) {
                let Tangent { direction, rest } = given(row, parts).unwrap_or_else(|| {
                    is_linear = false;
                    tangent(&multipliers, parts)
                });
                let along = |x: &[R; C]| {
                    parts
                        .iter()
                        .fold(R::zero(), |sum, &part| pick(&direction, part).mul_add(pick(x, part), sum))
                };
                put(&mut right, row, along(free) + rest);
                let Some(entries) = matrix.get_mut(row) else { continue };
                for (other, _) in sizes(self.table) {
                    let Some(response) = self.response.get(other) else { continue };
                    let entry = pick(entries, other) - along(response);
                    put(entries, other, entry);
                }
            }
            let Ok(matrix) = Lu::factor(matrix) else { break };
            let loads = matrix.solve(right);
            let mut next = *free;
            for (row, _) in sizes(self.table) {
                let responses = self.response.get(row).into_iter().flatten();
                for (next, &response) in next.iter_mut().zip(responses) {
                    *next = response.mul_add(pick(&loads, row), *next);
                }
            }
            let agrees = sizes(self.table).all(|(row, parts)| {
                let value = pick(&next, row);
                let size = parts.iter().fold(value.abs(), |sum, &part| sum + pick(free, part).abs());
                let change = (value - pick(&multipliers, row)).abs();
                !(change - R::from_f64(ULPS) * R::epsilon() * size).is_positive()
            });
            multipliers = next;
            // One more step after convergence, for the derivatives that numbers carry.
            if is_linear {
                return multipliers;
            }
            if has_converged {
                self.round(&mut multipliers, &bounds(), |row, parts| given(row, parts).is_none());
                return multipliers;
            }
            has_converged = agrees;
        }
        [R::from_f64(f64::NAN); C]
    }

    /// Sets loads to zero that are rounding errors of forces, if they `begin`.
    fn round(&self, multipliers: &mut [R; C], bounds: &[R; C], begins: impl Fn(usize, &[usize]) -> bool) {
        for (row, parts) in sizes(self.table) {
            let size = pick(multipliers, row);
            let least = R::from_f64(ULPS) * R::epsilon() * pick(bounds, row);
            if (least - size).is_positive() && begins(row, parts) {
                let response = self.response.get(row).into_iter().flatten();
                for (multiplier, &response) in multipliers.iter_mut().zip(response) {
                    *multiplier -= response * size;
                }
                put(multipliers, row, R::zero());
            }
        }
    }
}

/// The size of a force. A component of zero has no part in it: alone it would have no derivative.
fn norm<R: Real, const C: usize>(multipliers: &[R; C], parts: &[usize]) -> R {
    parts.iter().fold(R::zero(), |sum, &part| {
        let own = pick(multipliers, part);
        if own.part(0) == R::zero() { sum } else { sum.hypot(own) }
    })
}

/// The tangent of the size of a force at its present value. The direction of a force of zero is zero.
fn tangent<R: Real, const C: usize>(multipliers: &[R; C], parts: &[usize]) -> Tangent<R, C> {
    let size = norm(multipliers, parts);
    let mut direction = [R::zero(); C];
    if size.is_positive() {
        for &part in parts {
            put(&mut direction, part, pick(multipliers, part) / size);
        }
    }
    Tangent { direction, rest: R::zero() }
}

/// The rows of sizes, and those of their components.
fn sizes(table: &'static [Load]) -> impl Iterator<Item = (usize, &'static [usize])> {
    table.iter().filter_map(|load| match *load {
        Load::Size { row, parts } => Some((row, parts)),
        Load::Sum { .. } => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two components and their size.
    const TABLE: &[Load] = &[Load::Size { row: 2, parts: &[0, 1] }];

    fn loads(response: [f64; 2]) -> Option<Loads<f64, 3>> {
        let [x, y] = response;
        let linear = Lu::factor([[1.0, 0.0, -x], [0.0, 1.0, -y], [0.0, 0.0, 1.0]]).unwrap();
        Loads::new(TABLE, &[[0.0; 3]; 3], &linear)
    }

    #[test]
    fn a_load_is_the_size_of_the_force_that_it_changes() {
        let ([x, y], [a, b]) = ([0.6, -0.7], [-3.0, 0.5]);
        let [p, q, load] = loads([x, y]).unwrap().solve(&[a, b, 0.0], || [0.0; 3]);
        // (1 − X²) N² − 2 a X N − a² = 0.
        let (square, along, rest) = (1.0 - x * x - y * y, a * x + b * y, a * a + b * b);
        let expected = (along + (along * along + square * rest).sqrt()) / square;
        assert!((load - expected).abs() < 1e-14 * expected, "{load} {expected}");
        assert!((p - a - x * load).abs() < 1e-15 && (q - b - y * load).abs() < 1e-15);
    }

    #[test]
    fn a_load_along_one_component_has_derivatives() {
        use crate::number::real::Dual;
        let number = |value: f64| Dual::<f64, 1> { value, slopes: [1.0] };
        for parts in [[0.0, 2.0], [2.0, 0.0]] {
            let size = norm(&[number(parts[0]), number(parts[1]), number(0.0)], &[0, 1]);
            assert_eq!((size.value, size.slopes), (2.0, [1.0]));
        }
        let nan = norm(&[number(f64::NAN), number(2.0), number(0.0)], &[0, 1]);
        assert!(nan.value.is_nan());
    }

    #[test]
    fn a_load_that_exceeds_itself_jams() {
        assert!(loads([0.6, 0.79]).is_some() && loads([0.6, 0.81]).is_none());
    }

    #[test]
    fn without_a_force_there_is_no_load() {
        assert_eq!(loads([0.3, 0.0]).unwrap().solve(&[0.0; 3], || [0.0; 3]), [0.0; 3]);
    }

    /// The force grows like (1, 0.5) from rounding errors in another direction.
    #[test]
    fn a_load_of_rounding_errors_has_the_direction_in_which_it_grows() {
        let loads = loads([0.2, 0.3]).unwrap();
        let noise = [-3e-15, 8e-15, 0.0];
        for (bound, is_noise) in [(10.0, true), (0.1, false)] {
            let start = loads.solve(&noise, || [bound; 3]);
            assert_eq!(start[2] == 0.0, is_noise, "{start:?}");
            let first = loads.solve_order(&[1.0, 0.5, 0.0], || [bound; 3], 1.0, &[start]);
            let second = loads.solve_order(&[0.0; 3], || [bound; 3], 1.0, &[start, first]);
            assert_eq!(second[2].abs() < 1.0, is_noise, "{second:?}");
        }
    }

    /// N² = F · F for the series, also where the first order vanishes.
    #[test]
    fn orders_of_a_load_follow_from_those_of_its_force() {
        for first in [[1.5, -0.25], [0.0, 0.0]] {
            let loads = loads([0.2, 0.3]).unwrap();
            let free = [first, [0.7, 0.4], [-0.3, 1.0], [0.9, -0.6], [0.1, 0.2], [0.5, 0.0]];
            let mut known = [[0.0; 3]; 6];
            for order in 0..6 {
                let [x, y] = free[order];
                let (before, _) = known.split_at(order);
                known[order] =
                    loads.solve_order(&[2.0 * x, 2.0 * y, 0.0], || [0.0; 3], 2.0, before).map(|x| 0.5 * x);
            }
            for order in 0..6 {
                let product =
                    |row: usize| -> f64 { (0..=order).map(|k| known[k][row] * known[order - k][row]).sum() };
                let lack = product(0) + product(1) - product(2);
                assert!(lack.abs() < 1e-14, "{order}: {lack}");
            }
        }
    }
}
