//! Chains, rings and nets of rods by sparse patterns, against the dense way and against twice as many digits.

use std::boxed::Box;
use std::vec::Vec;

use super::*;
use crate::linear::gradients::{Gradients, Pattern, SparseRows};
use crate::linear::saddle::sparse::Sparse;
use crate::linear::schur::REFINED;
use crate::number::real::DoubleDouble;

/// Rods between points, of which `None` is held.
type Rods = Vec<[Option<usize>; 2]>;

fn leaked(lists: Vec<Vec<usize>>) -> &'static [&'static [usize]] {
    let lists: Vec<&'static [usize]> =
        lists.into_iter().map(|list| &*Box::leak(list.into_boxed_slice())).collect();
    Box::leak(lists.into_boxed_slice())
}

/// The pattern of rods in a space of `axes` dimensions, where they are eliminated in the order of their
/// numbers turned by `turn`.
fn pattern(rods: &Rods, axes: usize, turn: usize) -> &'static Pattern {
    let count = rods.len();
    let order: Vec<usize> = (0..count).map(|k| (k + turn) % count).collect();
    let points = |c: usize| rods[c].into_iter().flatten();
    let coordinates = |&c: &usize| {
        let mut list: Vec<usize> =
            points(c).flat_map(|p| (0..axes).map(move |axis| axes * p + axis)).collect();
        list.sort_unstable();
        list
    };
    let mut linked: Vec<Vec<bool>> = (0..count)
        .map(|k| (0..count).map(|j| points(order[k]).any(|p| points(order[j]).any(|r| p == r))).collect())
        .collect();
    let earlier_of =
        |linked: &[Vec<bool>]| (0..count).map(|k| (0..k).filter(|&j| linked[k][j]).collect()).collect();
    let coupled = earlier_of(&linked);
    for k in 0..count {
        let later: Vec<usize> = (k + 1..count).filter(|&j| linked[j][k]).collect();
        for &i in &later {
            for &j in &later {
                linked[i][j] = true;
            }
        }
    }
    let later = (0..count).map(|k| (k + 1..count).filter(|&j| linked[j][k]).collect()).collect();
    Box::leak(Box::new(Pattern {
        coordinates: leaked(order.iter().map(coordinates).collect()),
        order: Box::leak(order.into_boxed_slice()),
        coupled: leaked(coupled),
        earlier: leaked(earlier_of(&linked)),
        later: leaked(later),
    }))
}

/// Gradients of ½ (d² − 1) of each rod where the points are, a row each.
fn gradients<const N: usize, const C: usize>(rods: &Rods, axes: usize, at: &[f64; N]) -> [[f64; N]; C] {
    let mut a = [[0.0; N]; C];
    for (row, &[first, second]) in a.iter_mut().zip(rods) {
        for axis in 0..axes {
            let place = |point: Option<usize>| point.map_or(0.0, |p| at[axes * p + axis]);
            let along = place(second) - place(first);
            for (point, sign) in [(first, -1.0), (second, 1.0)] {
                if let Some(p) = point {
                    row[axes * p + axis] = sign * along;
                }
            }
        }
    }
    a
}

fn sparse<R: Real, const N: usize, const C: usize, const A: usize, const L: usize>(
    pattern: &'static Pattern,
    inverse_masses: [R; N],
    a: &[[R; N]; C],
) -> Sparse<R, N, C, A, L> {
    let entries: Vec<R> = pattern
        .order
        .iter()
        .zip(pattern.coordinates)
        .flat_map(|(&c, coordinates)| coordinates.iter().map(move |&i| a[c][i]))
        .collect();
    assert_eq!((entries.len(), pattern.later.iter().map(|later| later.len()).sum::<usize>()), (A, L));
    Sparse::factor(inverse_masses, SparseRows::new(pattern, core::array::from_fn(|k| entries[k])))
}

fn chain(links: usize) -> Rods {
    (0..links).map(|i| [i.checked_sub(1), Some(i)]).collect()
}

/// A chain between two places that are held.
fn held(links: usize) -> Rods {
    (0..links).map(|i| [i.checked_sub(1), (i + 1 < links).then_some(i)]).collect()
}

fn ring(links: usize) -> Rods {
    (0..links).map(|i| [Some(i), Some((i + 1) % links)]).collect()
}

/// 3 × 3 points.
fn net() -> Rods {
    let across = (0..9).filter(|i| i % 3 < 2).map(|i| [Some(i), Some(i + 1)]);
    across.chain((0..6).map(|i| [Some(i), Some(i + 3)])).collect()
}

fn distance<const K: usize>(found: &[f64; K], exact: &[DoubleDouble; K]) -> f64 {
    let size = exact.iter().fold(0.0_f64, |most, x| most.max(x.high().abs()));
    found.iter().zip(exact).fold(0.0_f64, |most, (&x, &y)| most.max((DoubleDouble::from(x) - y).high().abs()))
        / size
}

fn check<const N: usize, const C: usize, const A: usize, const L: usize>(
    rods: &Rods,
    axes: usize,
    turn: usize,
) {
    let mut noise = Noise((N * C + turn) as u64);
    let pattern = pattern(rods, axes, turn);
    let mut settled = 0;
    for _ in 0..50 {
        let masses: [f64; N] = core::array::from_fn(|_| 1.5 + noise.number());
        let a: [[f64; N]; C] = gradients(rods, axes, &noise.vector());
        let (r, y) = (noise.vector(), noise.vector());
        let dense = Diagonal::factor(masses, &a);
        let ours: Sparse<f64, N, C, A, L> = sparse(pattern, masses, &a);
        let wide = |x: f64| DoubleDouble::from(x);
        let (exact_v, exact_kappa) =
            Diagonal::factor(masses.map(wide), &a.map(|row| row.map(wide))).solve(&r.map(wide), &y.map(wide));
        assert_eq!((ours.rank(), ours.defect(), ours.vanishing()), (dense.rank(), None, None));
        let ((v, kappa), (w, lambda)) = (ours.solve(&r, &y), dense.solve(&r, &y));
        let (of_ours, of_dense) = (distance(&kappa, &exact_kappa), distance(&lambda, &exact_kappa));
        // S squares the condition of the rows, whatever the order: pivots bound what that costs.
        let least = ours.independence().least.min(dense.independence().least);
        let bound = of_dense + 8.0 * C as f64 * f64::EPSILON / (least * least);
        assert!(of_ours < bound, "({N}, {C}): {of_ours:e}, dense {of_dense:e}, {least}");
        assert!(distance(&v, &exact_v) < distance(&w, &exact_v) + bound);
        if ours.careful.is_none() {
            settled += 1;
            // One refinement leaves little more than the rounding errors of S itself.
            let refined = ours.solve_order(1, y);
            let plain = ours.solve_order(REFINED + 1, y);
            let exact: [DoubleDouble; C] =
                sparse::<_, N, C, A, L>(pattern, masses.map(wide), &a.map(|row| row.map(wide)))
                    .solve_order(1, y.map(wide));
            assert!(distance(&refined, &exact) < distance(&plain, &exact) + bound);
        }
        let rows: [[f64; N]; C] = ours.gradients().rows();
        assert_eq!(rows, a);
        let (rates, same): ([f64; C], [f64; C]) = (ours.gradients().rates(&r), a.rates(&r));
        assert!(rates.iter().zip(&same).all(|(x, y)| (x - y).abs() < 1e-14));
        let (slopes, same): ([f64; C], [f64; C]) = (ours.gradients().slopes(&masses), a.slopes(&masses));
        assert!(slopes.iter().zip(&same).all(|(x, y)| (x - y).abs() < 1e-14));
    }
    assert!(settled > 25, "{settled} of 50 without pivoting");
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn rods_are_solved_as_by_the_dense_way() {
    check::<24, 12, 46, 11>(&chain(12), 2, 0);
    check::<24, 12, 46, 17>(&chain(12), 2, 5);
    check::<36, 12, 69, 11>(&chain(12), 3, 0);
    check::<36, 12, 72, 21>(&ring(12), 3, 0);
    check::<36, 12, 72, 21>(&ring(12), 3, 7);
    check::<27, 12, 72, 38>(&net(), 3, 0);
}

/// Both ways decide alike about rows that depend on each other, for the same rows.
fn singular<const N: usize, const C: usize, const A: usize, const L: usize>(
    rods: &Rods,
    axes: usize,
    at: &[f64; N],
    rank: usize,
) {
    let a: [[f64; N]; C] = gradients(rods, axes, at);
    let masses: [f64; N] = core::array::from_fn(|i| 1.0 + 0.1 * (i % 7) as f64);
    let ours: Sparse<f64, N, C, A, L> = sparse(pattern(rods, axes, 0), masses, &a);
    let dense = Diagonal::factor(masses, &a);
    assert_eq!((ours.rank(), ours.defect(), ours.vanishing()), (rank, dense.defect(), dense.vanishing()));
    assert_eq!(ours.independence(), dense.independence());
    let (mut noise, v) = (Noise(4), core::array::from_fn::<f64, N, _>(|i| (i as f64).sin()));
    let (r, y) = (noise.vector(), product(&a, &v));
    let ((v, kappa), (w, lambda)) = (ours.solve(&r, &y), dense.solve(&r, &y));
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11);
    assert!(close(&v, &w) && close(&kappa, &lambda), "{kappa:?} {lambda:?}");
}

#[test]
fn rows_that_depend_on_each_other_are_left_to_pivoting() {
    // A chain between two places that are one, folded: all gradients along one line.
    let flat = |i: usize| if i.is_multiple_of(2) { (6 - (i / 2 + 1).abs_diff(6)) as f64 } else { 0.0 };
    singular::<22, 12, 44, 11>(&held(12), 2, &core::array::from_fn(flat), 11);
    // A ring, likewise.
    let folded = |i: usize| if i % 3 == 1 { 6.0 - (i / 3).abs_diff(6) as f64 } else { 0.0 };
    singular::<36, 12, 72, 21>(&ring(12), 3, &core::array::from_fn(folded), 11);
    // A loose chain is regular: no pivot is small in the order from what is held.
    let loose: [f64; 24] =
        core::array::from_fn(|i| if i.is_multiple_of(2) { (i / 2 + 1) as f64 } else { 0.0 });
    let a = gradients(&chain(12), 2, &loose);
    let ours: Sparse<f64, 24, 12, 46, 11> = sparse(pattern(&chain(12), 2, 0), [1.0; 24], &a);
    assert!(ours.careful.is_none() && ours.independence().least > 0.7, "{:?}", ours.independence());
}

#[test]
fn what_is_not_a_number_is_said_to_be_so() {
    let rods = chain(12);
    let a: [[f64; 24]; 12] = gradients(&rods, 2, &core::array::from_fn(|i| i as f64 + 1.0));
    let pattern = pattern(&rods, 2, 0);
    // The reciprocal of no mass.
    let massless = Defect::Singular { coordinate: 7 };
    let negative = Defect::Singular { coordinate: 0 };
    for (i, bad, defect) in
        [(3, f64::NAN, Defect::NotFinite), (7, f64::INFINITY, massless), (0, -1e3, negative)]
    {
        let mut masses = [1.0; 24];
        masses[i] = bad;
        let ours: Sparse<f64, 24, 12, 46, 11> = sparse(pattern, masses, &a);
        assert_eq!(ours.defect(), Some(defect), "{bad}");
        assert!(ours.solve(&[1.0; 24], &[1.0; 12]).0.iter().any(|x| !x.is_finite()));
    }
    let mut vanishing = a;
    vanishing[4] = [0.0; 24];
    let ours: Sparse<f64, 24, 12, 46, 11> = sparse(pattern, [1.0; 24], &vanishing);
    assert_eq!((ours.vanishing(), ours.rank(), ours.defect()), (Some(4), 11, None));
}
