//! Rows that depend on each other, and rows of zeros.

use super::*;

/// A of independent rows extended by combinations of them, in random order; the combinations that vanish; y.
struct Redundant<const N: usize, const C: usize> {
    a: [[f64; N]; C],
    /// Combinations of rows that are zero, by the last rows.
    null: [[f64; C]; C],
    y: [f64; C],
}

/// `rank` rows are independent, the others are multiples of one, differences of two or sums of all.
fn redundant<const N: usize, const C: usize>(noise: &mut Noise, rank: usize, scale: f64) -> Redundant<N, C> {
    let v: [f64; N] = noise.vector();
    let mut a = matrix::<C, N>(noise);
    // The condition of the independent rows is not what is tested here.
    for (c, row) in a.iter_mut().enumerate().take(rank) {
        row[c] += 2.0;
    }
    let mut null = [[0.0; C]; C];
    for c in rank..C {
        let weights = &mut null[c];
        for (k, weight) in weights.iter_mut().enumerate().take(rank) {
            *weight = match c % 3 {
                0 if k == c % rank => 3.0 * scale,
                1 if k == c % rank => 1.0,
                1 if k == (c + 1) % rank => -1.0,
                2 => noise.number() * scale,
                _ => 0.0,
            };
        }
        a[c] = core::array::from_fn(|i| (0..rank).map(|k| weights[k] * a[k][i]).sum());
        weights[c] = -1.0;
    }
    for c in (1..C).rev() {
        let other = (noise.number().abs() * (c + 1) as f64) as usize;
        a.swap(c, other);
        for row in &mut null {
            row.swap(c, other);
        }
    }
    Redundant { a, null, y: product(&a, &v) }
}

/// The largest component of κ along a combination of rows that vanishes, relative to both.
fn along_null<const C: usize>(null: &[[f64; C]; C], kappa: &[f64; C]) -> f64 {
    let norm = |x: &[f64; C]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let along = |row: &[f64; C]| row.iter().zip(kappa).map(|(n, k)| n * k).sum::<f64>().abs();
    null.iter()
        .filter(|row| norm(row) > 0.0)
        .map(|row| along(row) / norm(row) / norm(kappa))
        .fold(0.0, f64::max)
}

fn check<const N: usize, const C: usize>(rank: usize, scale: f64) {
    let mut noise = Noise((N * 31 + C) as u64);
    for _ in 0..100 {
        let Redundant { a, null, y } = redundant::<N, C>(&mut noise, rank, scale);
        let (mass, r) = (positive_definite::<N>(&mut noise), noise.vector());
        let saddle = Saddle::factor(&mass, &a);
        assert_eq!((saddle.rank(), saddle.defect(), saddle.vanishing()), (rank, None, None), "({N}, {C})");
        let (v, kappa) = saddle.solve(&r, &y);
        let (motion, constraint) = residuals((&mass, &a), &(v, kappa), (&r, &y), EPS);
        assert!(motion < 200.0 && constraint < 200.0, "({N}, {C}): {motion} {constraint}");
        assert!(along_null(&null, &kappa) < 1e-13, "({N}, {C}): {:e}", along_null(&null, &kappa));
        // A right-hand side that contradicts itself: the rows that are kept are met, and κ stays the
        // shortest.
        let y = noise.vector();
        let (v, kappa) = saddle.solve(&r, &y);
        let left = product(&a, &v);
        let missed = (0..C).filter(|&c| (left[c] - y[c]).abs() > 1e-9).count();
        assert_eq!(missed, C - rank);
        assert!(along_null(&null, &kappa) < 1e-13);
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn dependent_rows_are_dropped_and_multipliers_are_the_shortest() {
    check::<2, 2>(1, 1.0);
    check::<4, 3>(2, 1.0);
    check::<7, 6>(4, 1.0);
    check::<12, 10>(7, 1.0);
    check::<5, 9>(5, 1.0);
    check::<3, 7>(2, 1.0);
    check::<1, 3>(1, 1.0);
    check::<7, 6>(4, 1e3);
    check::<7, 6>(4, 1e-3);
}

#[test]
fn two_equal_rows_share_the_force() {
    let (one, two) = ([[3.0, 4.0]], [[3.0, 4.0], [3.0, 4.0]]);
    let mass = [[2.0, 0.0], [1.0, 2.0]];
    let (v, [kappa]) = Saddle::factor(&mass, &one).solve(&[1.0, -2.0], &[0.5]);
    let (w, [a, b]) = Saddle::factor(&mass, &two).solve(&[1.0, -2.0], &[0.5, 0.5]);
    for (x, y) in [(v[0], w[0]), (v[1], w[1]), (kappa, 2.0 * a), (kappa, 2.0 * b)] {
        assert!((x - y).abs() < 1e-14, "{x} {y}");
    }
    // The longer of two parallel rows has more of the force, in proportion to its length.
    let (_, [a, b]) = Saddle::factor(&mass, &[[3.0, 4.0], [30.0, 40.0]]).solve(&[1.0, -2.0], &[0.5, 5.0]);
    assert!((a - kappa / 101.0).abs() < 1e-14 && (b - kappa / 10.1).abs() < 1e-14);
}

#[test]
fn rows_of_zeros_are_named_and_dropped() {
    let mass = [[2.0, 0.0], [1.0, 2.0]];
    let saddle = Saddle::factor(&mass, &[[3.0, 4.0], [0.0, 0.0], [0.0, 0.0]]);
    assert_eq!((saddle.rank(), saddle.defect(), saddle.vanishing()), (1, None, Some(1)));
    let (v, kappa) = saddle.solve(&[1.0, -2.0], &[0.5, 1.0, 2.0]);
    let (w, lambda) = Saddle::factor(&mass, &[[3.0, 4.0]]).solve(&[1.0, -2.0], &[0.5]);
    assert!(v.iter().zip(&w).all(|(v, w)| (v - w).abs() < 1e-15) && (kappa[0] - lambda[0]).abs() < 1e-14);
    assert_eq!(kappa[1..], [0.0, 0.0]);
    // Nothing but zeros is no constraint.
    let saddle = Saddle::factor(&mass, &[[0.0; 2]; 2]);
    assert_eq!((saddle.rank(), saddle.defect(), saddle.vanishing()), (0, None, Some(0)));
    let (v, kappa) = saddle.solve(&[4.0, 5.0], &[1.0, 1.0]);
    assert!((v[0] - 1.0).abs() < 1e-15 && (v[1] - 2.0).abs() < 1e-15 && kappa == [0.0, 0.0]);
    let diagonal = Diagonal::factor([0.5, 0.25], &[[0.0; 2], [3.0, 4.0]]);
    assert_eq!((diagonal.rank(), diagonal.defect(), diagonal.vanishing()), (1, None, Some(0)));
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn redundant_rows_of_a_diagonal_system_have_the_same_solution() {
    fn check<const N: usize, const C: usize>(rank: usize) {
        let mut noise = Noise(C as u64);
        for _ in 0..100 {
            let Redundant { a, null, y } = redundant::<N, C>(&mut noise, rank, 1.0);
            let masses = core::array::from_fn(|_| 1.0 + noise.number().abs());
            let (mass, r) = (diagonal_matrix(&masses), noise.vector());
            let diagonal = Diagonal::factor(masses.map(f64::recip), &a);
            assert_eq!((diagonal.rank(), diagonal.defect()), (rank, None));
            let ((v, kappa), (w, lambda)) = (diagonal.solve(&r, &y), Saddle::factor(&mass, &a).solve(&r, &y));
            let size = kappa.iter().fold(1.0_f64, |a, x| a.max(x.abs()));
            let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11 * size);
            assert!(same(&v, &w) && same(&kappa, &lambda), "{kappa:?} {lambda:?}");
            assert!(along_null(&null, &kappa) < 1e-12);
        }
    }
    check::<3, 2>(1);
    check::<8, 6>(4);
    check::<9, 8>(5);
    check::<4, 7>(3);
}

#[test]
fn rows_that_are_close_are_told_apart() {
    let mut noise = Noise(41);
    for distance in [1e-2, 1e-4, 1e-6] {
        for _ in 0..50 {
            let (mass, mut a) = (positive_definite::<6>(&mut noise), matrix::<3, 6>(&mut noise));
            a[2] = core::array::from_fn(|i| a[0][i] - 2.0 * a[1][i] + distance * a[2][i]);
            let saddle = Saddle::factor(&mass, &a);
            assert_eq!((saddle.rank(), saddle.defect()), (3, None), "{distance}");
            // Errors grow with the condition number of the rows, and not with its square.
            let v = noise.vector();
            let y = product(&a, &v);
            let left = product(&a, &saddle.solve(&noise.vector(), &y).0);
            assert!(left.iter().zip(&y).all(|(a, b)| (a - b).abs() < 1e-14 / distance), "{distance}");
        }
    }
}

#[test]
fn both_ways_measure_the_same_distance_between_rows() {
    let mass = diagonal_matrix(&[1.0, 4.0, 0.25]);
    for k in 0..60 {
        let distance = 0.5 * 0.8_f64.powi(k);
        // Orthogonal in the metric of the masses.
        let a = [[1.0, 0.0, 0.0], [1.0, 2.0 * distance, 0.0]];
        let ways = [
            Saddle::factor(&mass, &a).independence(),
            Saddle::<f64, 3, 2>::carefully::<true>(&mass, &a).independence(),
            Diagonal::factor([1.0, 0.25, 4.0], &a).independence(),
        ];
        for found in ways {
            assert_eq!((found.rank, found.weakest), (2, 1));
            assert!((0.5..=2.0).contains(&(found.least / distance)), "{found:?} for {distance:e}");
        }
    }
}

#[test]
fn a_row_alone_is_as_independent_as_can_be() {
    let mass = diagonal_matrix(&[1.0, 4.0]);
    for a in [[[1e-9, 3.0]], [[2.0, 2.0]]] {
        let ways = [
            Saddle::factor(&mass, &a).independence(),
            Saddle::<f64, 2, 1>::carefully::<true>(&mass, &a).independence(),
            Diagonal::factor([1.0, 0.25], &a).independence(),
        ];
        assert!(ways.iter().all(|found| found.least == 1.0 && found.are_far_apart()), "{ways:?}");
    }
}

#[test]
fn rows_are_taken_in_order_only_where_they_are_clearly_independent() {
    let mass = diagonal_matrix(&[1.0, 1.0, 1.0]);
    for (distance, is_clear) in [(1.0, true), (1.0 / 250.0, true), (1.0 / 260.0, false), (0.0, false)] {
        let scaled = scaled::Scaled::new(&mass, &[[1.0, 0.0, 0.0], [1.0, distance, 0.0]]);
        assert_eq!(range::Range::in_order(&scaled).is_some(), is_clear, "{distance}");
    }
}
