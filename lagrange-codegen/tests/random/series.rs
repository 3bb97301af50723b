//! The Taylor coefficients of emitted code, order by order, against the equations of motion in truncated
//! series.
//!
//! The emitted coefficients of coordinates and velocities are put into the definitions. The accelerations
//! that follow, as series in time, are what the next coefficients of the velocities have to be. So an error
//! of one order does not hide behind those of others.

use crate::check::{CONDITION, Sample, instant, is_measurable, point};
use crate::close::{Agreement, compare};
use crate::constrained::gradients;
use crate::expansion::Expansion;
use crate::expression::Instant;
use crate::interpreter::{Interpreter, Point, Stop};
use crate::number::{Number, Tracked};
use crate::oracle::{Quantities, balance, gauss};
use crate::source::PARAMETERS;
use crate::system::System;
use crate::taylor::{TERMS, Taylor};

/// The unit of time: a power of two, so that nothing is rounded where it comes in.
const UNIT: f64 = 0.5;

/// The result of a comparison that found nothing wrong.
#[derive(Clone, Copy, Debug)]
pub enum Outcome {
    /// All coefficients agree.
    Compared(Agreement),
    /// There is no series: a function has a kink or a jump.
    NotSmooth,
    /// Outside the domain, too ill-conditioned, or no state on the constraints.
    LeftOut,
}

/// Compares the coefficients of all orders at a sample.
pub fn check(system: &System, expansion: &Expansion, sample: &Sample) -> Result<Outcome, String> {
    if !expansion.smooth.contains_key("jet_at") {
        return Ok(Outcome::NotSmooth);
    }
    let Some(sample) = on_constraints(system, sample) else { return Ok(Outcome::LeftOut) };
    let expected = Quantities::of(system, &instant(system, &sample));
    let measurable = expected.mass.iter().flatten().chain(&expected.bias).chain(&expected.applied);
    if expected.condition > CONDITION || !measurable.clone().all(is_measurable) {
        return Ok(Outcome::LeftOut);
    }
    let point = point(system, &sample);
    let series = Interpreter { expansion, point: &point }.series(UNIT, TERMS - 1);
    let rows = series.and_then(|series| match series {
        Some(series) => Ok((series.field("q")?.to_rows()?, series.field("v")?.to_rows()?)),
        None => Err(Stop::Failure("no solution".to_owned())),
    });
    let (q, v) = rows.map_err(|stop| format!("jet_at: {stop:?}"))?;
    let Some(rates) = rates(system, &point, &q, &v) else { return Ok(Outcome::LeftOut) };
    if rates.iter().flat_map(|rate| rate.coefficients).any(|x| !is_measurable(&x)) {
        return Ok(Outcome::LeftOut);
    }
    let mut agreement = Agreement::default();
    let mut last: Vec<f64> = point.v.clone();
    for order in 1..TERMS {
        let share = |rate: Tracked| rate * Tracked::constant(UNIT) / Tracked::constant(order as f64);
        let exact: Vec<Tracked> = last.iter().map(|&v| share(Tracked::constant(v))).collect();
        agreement.join(compare(&format!("q of order {order}"), &q[order - 1], &exact)?);
        let wanted: Vec<Tracked> = rates.iter().map(|rate| share(rate.coefficients[order - 1])).collect();
        agreement.join(compare(&format!("v of order {order}"), &v[order - 1], &wanted)?);
        last.clone_from(&v[order - 1]);
    }
    Ok(Outcome::Compared(agreement))
}

/// The sample with velocities that the constraints allow. A series need not be right for others.
fn on_constraints(system: &System, sample: &Sample) -> Option<Sample> {
    let mut sample = sample.clone();
    for _ in 0..4 {
        let held = Quantities::of(system, &instant(system, &sample)).held;
        if held.rates.is_empty() {
            return Some(sample);
        }
        let gradient: Vec<Vec<f64>> =
            held.jacobian.iter().map(|row| row.iter().map(|x| x.value).collect()).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let square: Vec<Vec<f64>> =
            gradient.iter().map(|a| gradient.iter().map(|b| dot(a, b)).collect()).collect();
        let rates: Vec<f64> = held.rates.iter().map(|rate| rate.value).collect();
        let share = gauss(&square, &[rates])?.pop()?;
        for (row, share) in gradient.iter().zip(share) {
            sample.v.iter_mut().zip(row).for_each(|(v, slope)| *v -= share * slope);
        }
    }
    let held = Quantities::of(system, &instant(system, &sample)).held;
    let kept = |rate: &Tracked| rate.value.abs() <= 64.0 * f64::EPSILON * rate.roundings;
    held.rates.iter().all(kept).then_some(sample)
}

/// The accelerations along the series, from the definitions.
fn rates(system: &System, point: &Point, q: &[Vec<f64>], v: &[Vec<f64>]) -> Option<Vec<Taylor<Tracked>>> {
    let along = |start: &[f64], rows: &[Vec<f64>]| -> Vec<Taylor<Tracked>> {
        let of = |i: usize| {
            Taylor::new(std::array::from_fn(|k| {
                Tracked::constant(if k == 0 { start[i] } else { rows[k - 1][i] })
            }))
        };
        (0..start.len()).map(of).collect()
    };
    let constant = |values: &[f64]| values.iter().map(|&x| Taylor::constant(x)).collect();
    let mut time = [Tracked::constant(0.0); TERMS];
    (time[0], time[1]) = (Tracked::constant(point.t), Tracked::constant(UNIT));
    let parameters: Vec<f64> = PARAMETERS.iter().map(|name| point.parameters[*name]).collect();
    let at = Instant {
        q: along(&point.q, q),
        v: along(&point.v, v),
        t: Taylor::new(time),
        u: constant(&point.u),
        parameters: constant(&parameters),
    };
    let balance = balance(system, &at);
    let (jacobian, gamma) = gradients(system, &at);
    let (count, zero) = (system.count(), Taylor::constant(0.0));
    let mut matrix = balance.mass;
    for (i, row) in matrix.iter_mut().enumerate() {
        row.extend(jacobian.iter().map(|gradient| -gradient[i]));
    }
    matrix.extend(jacobian.iter().map(|row| [&row[..], &vec![zero; jacobian.len()]].concat()));
    let force = balance.applied.iter().zip(&balance.bias).map(|(&applied, &bias)| applied - bias);
    let mut right: Vec<Taylor<Tracked>> = force.chain(gamma).collect();
    let equations = (matrix.clone(), right.clone());
    eliminate(&mut matrix, &mut right)?;
    add_errors_of_multipliers(&equations, count, &mut right);
    right.truncate(count);
    Some(right)
}

/// Adds the rounding errors of the way that the engine goes where M is diagonal: w = M⁻¹ f,
/// (A M⁻¹ Aᵀ) λ = γ − A w and a = w + M⁻¹ Aᵀ λ. Forces are rounded there before the multipliers cancel them,
/// even in a coordinate that its constraints determine. The elimination below may find such a coordinate
/// without these forces.
fn add_errors_of_multipliers(
    (matrix, right): &(Vec<Vec<Taylor<Tracked>>>, Vec<Taylor<Tracked>>),
    count: usize,
    solution: &mut [Taylor<Tracked>],
) {
    let start = |i: usize, j: usize| matrix[i][j].coefficients[0];
    let vanishes = |x: Tracked| x.value.abs() <= 64.0 * f64::EPSILON * x.roundings;
    let is_diagonal = (0..count).all(|i| (0..count).all(|j| vanishes(start(i, j)) != (i == j)));
    let (all, held) = (right.len(), right.len() - count);
    let mass: Vec<f64> = (0..count).map(|i| start(i, i).value).collect();
    let gradient: Vec<Vec<f64>> =
        (count..all).map(|c| (0..count).map(|i| start(c, i).value).collect()).collect();
    let schur = |a: &[f64], b: &[f64]| (0..count).map(|i| a[i] * b[i] / mass[i]).sum::<f64>();
    let square: Vec<Vec<f64>> =
        gradient.iter().map(|a| gradient.iter().map(|b| schur(a, b)).collect()).collect();
    let unit = |c: usize| (0..held).map(|d| f64::from(u8::from(c == d))).collect::<Vec<f64>>();
    let units: Vec<Vec<f64>> = (0..held).map(unit).collect();
    let Some(inverse) = gauss(&square, &units).filter(|_| is_diagonal && held > 0) else { return };
    // The solution with errors of that way alone: an order is solved for with the errors of those before.
    let mut known: Vec<Taylor<Tracked>> = vec![Taylor::constant(0.0); all];
    for k in 0..TERMS {
        for (known, exact) in known.iter_mut().zip(&*solution) {
            known.coefficients[k] = Tracked::constant(exact.coefficients[k].value);
        }
        // The sizes of the terms of an equation.
        let size = |i: usize| {
            let rest = matrix[i].iter().zip(&known).fold(right[i], |rest, (&a, &x)| rest - a * x);
            rest.coefficients[k].roundings
        };
        let free: Vec<f64> = (0..count).map(|i| size(i) / mass[i].abs()).collect();
        let carried = |c: usize| gradient[c].iter().zip(&free).map(|(a, w)| a.abs() * w).sum::<f64>();
        let wrong: Vec<f64> = (0..held).map(|c| size(count + c) + carried(c)).collect();
        let multiplier = |c: usize| (0..held).map(|d| inverse[d][c].abs() * wrong[d]).sum::<f64>();
        let multipliers: Vec<f64> = (0..held).map(multiplier).collect();
        let acceleration = |i: usize| {
            let forces = gradient.iter().zip(&multipliers).map(|(row, error)| row[i].abs() * error);
            free[i] + forces.sum::<f64>() / mass[i].abs()
        };
        let errors = (0..count).map(acceleration).chain(multipliers.iter().copied());
        for (j, error) in errors.collect::<Vec<f64>>().into_iter().enumerate() {
            known[j].coefficients[k].roundings += error;
            solution[j].coefficients[k].roundings += error;
        }
    }
}

/// Gaussian elimination with partial pivoting by the values at the start.
fn eliminate(matrix: &mut [Vec<Taylor<Tracked>>], right: &mut [Taylor<Tracked>]) -> Option<()> {
    let size = |x: &Taylor<Tracked>| x.coefficients[0].value.abs();
    for k in 0..right.len() {
        let pivot = (k..right.len()).max_by(|&i, &j| size(&matrix[i][k]).total_cmp(&size(&matrix[j][k])))?;
        if size(&matrix[pivot][k]) == 0.0 {
            return None;
        }
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let own = matrix[k].clone();
        for i in 0..right.len() {
            if i != k {
                let factor = matrix[i][k] / own[k];
                for j in k..right.len() {
                    matrix[i][j] = matrix[i][j] - factor * own[j];
                }
                right[i] = right[i] - factor * right[k];
            }
        }
    }
    for (k, row) in matrix.iter().enumerate() {
        right[k] = right[k] / row[k];
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of two coordinates the first is held by 3 x = const; no force acts on the second.
    #[test]
    fn forces_that_a_multiplier_cancels_are_rounded() {
        let (mass, force) = (1.7, -4.7);
        let series = |row: [f64; 3]| row.map(Taylor::constant).to_vec();
        let matrix = vec![series([mass, 0.0, -3.0]), series([0.0, 2.5, 0.0]), series([3.0, 0.0, 0.0])];
        let right = series([force, 0.0, 0.0]);
        let mut solution = right.clone();
        assert!(eliminate(&mut matrix.clone(), &mut solution).is_some());
        let first = |solution: &[Taylor<Tracked>], i: usize| solution[i].coefficients[0];
        assert_eq!((first(&solution, 0).value, first(&solution, 0).roundings), (0.0, 0.0));
        add_errors_of_multipliers(&(matrix, right), 2, &mut solution);
        let free = (force / mass).abs();
        let roundings = first(&solution, 0).roundings;
        assert!((free..8.0 * free).contains(&roundings), "{roundings}");
        assert_eq!(first(&solution, 1).roundings, 0.0);
        assert!(solution[0].coefficients[1..].iter().all(|x| x.roundings == 0.0));
    }
}
