//! Several systems in the lanes of a vector.

use super::*;
use crate::number::real::Lanes;
use wide::f64x4;

type R = Lanes<f64x4>;

fn join<const I: usize, const J: usize>(lanes: &[[[f64; J]; I]; 4]) -> [[R; J]; I] {
    core::array::from_fn(|i| core::array::from_fn(|j| lanes.map(|lane| lane[i][j]).into()))
}

fn lane<const I: usize>(x: &[R; I], lane: usize) -> [f64; I] {
    x.map(|x| <[f64; 4]>::from(x)[lane])
}

/// Solutions of each lane against those of one system.
fn check<const N: usize, const C: usize>(
    masses: &[[[f64; N]; N]; 4],
    rows: &[[[f64; N]; C]; 4],
    right: &[usize],
) {
    let mut noise = Noise(1);
    let (r, y): ([f64; N], [f64; C]) = (noise.vector(), noise.vector());
    let saddle = Saddle::factor(&join(masses), &join(rows));
    let (v, kappa) = saddle.solve(&r.map(R::splat), &y.map(R::splat));
    for i in 0..4 {
        let (w, lambda) = Saddle::factor(&masses[i], &rows[i]).solve(&r, &y);
        let size = lambda.iter().fold(1.0_f64, |a, x| a.max(x.abs()));
        let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12 * size);
        let (v, kappa) = (lane(&v, i), lane(&kappa, i));
        if right.contains(&i) {
            assert!(same(&v, &w) && same(&kappa, &lambda), "lane {i}: {v:?} {w:?} {kappa:?} {lambda:?}");
        } else {
            assert!(v.iter().chain(&kappa).any(|x| x.is_nan()), "lane {i}: {v:?}");
        }
    }
}

#[test]
fn lanes_are_solved_side_by_side() {
    let mut noise = Noise(4);
    for _ in 0..50 {
        let masses = core::array::from_fn(|_| positive_definite::<7>(&mut noise));
        check(&masses, &core::array::from_fn(|_| matrix::<4, 7>(&mut noise)), &[0, 1, 2, 3]);
    }
}

#[test]
fn lanes_that_agree_on_no_coordinate_are_solved() {
    let unit = [[1.0, 0.0], [0.0, 2.0]];
    check(&[unit; 4], &[[[1.0, 0.0]], [[0.0, 1.0]], [[0.6, 0.8]], [[-1.0, 1e-20]]], &[0, 1, 2, 3]);
}

#[test]
fn a_lane_with_a_smaller_rank_than_others_is_nan_and_others_are_right() {
    let unit = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    let regular = [[1.0, 2.0, 0.5], [0.0, 1.0, 3.0]];
    let dependent = [[1.0, 2.0, 0.5], [2.0, 4.0, 1.0]];
    let vanishing = [[0.0; 3], [0.0, 1.0, 3.0]];
    check(&[unit; 4], &[regular, dependent, regular, vanishing], &[0, 2]);
    let nan = [[1.0, 2.0, 0.5], [f64::NAN, 1.0, 3.0]];
    check(&[unit; 4], &[regular, nan, regular, nan], &[0, 2]);
    check(&[unit; 4], &[dependent, nan, dependent, dependent], &[0, 2, 3]);
    // Where all have the same dependent rows, all are right.
    check(&[unit; 4], &[dependent; 4], &[0, 1, 2, 3]);
}

#[test]
fn a_lane_without_inertia_is_nan_and_others_are_right() {
    let regular = [[1.0, 0.0], [0.0, 2.0]];
    let massless = [[1.0, 0.0], [0.0, 0.0]];
    let rows = [[[1.0, 0.0]]; 4];
    check(&[regular, massless, regular, [[1.0, 0.0], [0.0, f64::NAN]]], &rows, &[0, 2]);
    let saddle = Saddle::factor(&join(&[massless; 4]), &join(&rows));
    assert_eq!(saddle.defect(), Some(Defect::Singular { coordinate: 1 }));
}

/// The property that ensembles in lanes rely on.
#[test]
fn lanes_that_are_clearly_independent_decide_nothing_together() {
    let mut noise = Noise(9);
    let (r, y): ([f64; 5], [f64; 2]) = (noise.vector(), noise.vector());
    for _ in 0..50 {
        let masses: [_; 4] = core::array::from_fn(|_| positive_definite::<5>(&mut noise));
        let rows: [_; 4] = core::array::from_fn(|_| matrix::<2, 5>(&mut noise));
        let saddle = Saddle::factor_side_by_side(&join(&masses), &join(&rows));
        let apart = saddle.apart().map(<[f64; 4]>::from);
        let solution = saddle.solve(&r.map(R::splat), &y.map(R::splat));
        for i in 0..4 {
            let saddle = Saddle::factor_side_by_side(&join(&[masses[i]; 4]), &join(&[rows[i]; 4]));
            let alone = saddle.apart().map(<[f64; 4]>::from);
            let (v, kappa) = saddle.solve(&r.map(R::splat), &y.map(R::splat));
            if let Some(apart) = apart {
                assert_eq!(alone.map(|alone| alone[0]), Some(apart[i]));
                assert!(apart[i] >= 1.0);
                assert_eq!((lane(&solution.0, i), lane(&solution.1, i)), (lane(&v, 0), lane(&kappa, 0)));
            }
        }
        // If all are apart alone, they are so together.
        let is_apart = |i: usize| {
            Saddle::factor_side_by_side(&join(&[masses[i]; 4]), &join(&[rows[i]; 4])).apart().is_some()
        };
        assert_eq!(apart.is_some(), (0..4).all(is_apart));
    }
    let unit = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    let (regular, close) = ([[1.0, 2.0, 0.5], [0.0, 1.0, 3.0]], [[1.0, 2.0, 0.5], [2.0, 4.0, 1.01]]);
    assert!(Saddle::factor_side_by_side(&join(&[unit; 4]), &join(&[regular; 4])).apart().is_some());
    assert!(
        Saddle::factor_side_by_side(&join(&[unit; 4]), &join(&[regular, close, regular, regular]))
            .apart()
            .is_none()
    );
    let massless = [[0.0; 3], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    let masses = [unit, unit, massless, unit];
    assert!(Saddle::factor_side_by_side(&join(&masses), &join(&[regular; 4])).apart().is_none());
    assert!(Saddle::factor(&join(&[unit; 4]), &join(&[regular; 4])).apart().is_none());
}
