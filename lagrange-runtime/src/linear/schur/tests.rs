//! Random matrices, clearly regular and singular, in any units.

use super::*;
use crate::linear::samples::{Noise, residual};

/// A Aᵀ of random rows of length C + 2.
fn regular<const C: usize>(noise: &mut Noise) -> [[f64; C]; C] {
    let (b, extra): ([[f64; C]; C], [[f64; C]; 2]) = (noise.matrix(), [noise.vector(), noise.vector()]);
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let product: f64 = b[i].iter().zip(&b[j]).map(|(x, y)| x * y).sum::<f64>();
            let more: f64 = extra.iter().map(|x| x[i] * x[j]).sum();
            product + more + if i == j { 0.1 } else { 0.0 }
        })
    })
}

fn check<const C: usize>() {
    let mut noise = Noise(C as u64 + 17);
    for _ in 0..100 {
        let s = regular::<C>(&mut noise);
        let y = noise.vector();
        let mut rows = [[0.0; C]; C];
        rows[0] = y;
        for (way, schur) in [Schur::factor(s), Schur::carefully(&s, &mut rows)].iter().enumerate() {
            assert_eq!((schur.rank(), schur.is_finite(), schur.vanishing()), (C, true, None));
            assert!((0..C).all(|c| !schur.is_dropped(c)));
            let error = residual(&s, &schur.solve(y), &y);
            // An inverse has the condition in its residual where the factors have not.
            let bound = if C > SMALL && way == 0 { 4.0 } else { 400.0 };
            assert!(error < bound * C as f64 * f64::EPSILON, "size {C}, way {way}: {error:e}");
        }
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn regular_matrices_are_solved() {
    check::<1>();
    check::<2>();
    check::<3>();
    check::<6>();
    check::<7>();
    check::<12>();
    assert_eq!(Schur::factor([[4.0]]).solve([8.0]), [2.0]);
    let none: Schur<f64, 0> = Schur::factor([]);
    assert_eq!((none.rank(), none.is_finite(), none.solve([])), (0, true, []));
}

#[test]
fn the_upper_triangle_is_not_read() {
    for bad in [1e9, f64::NAN] {
        assert_eq!(Schur::factor([[4.0, bad], [2.0, 3.0]]).solve([8.0, 8.0]), [1.0, 2.0]);
        assert_eq!(Schur::factor([[4.0, bad], [2.0, 1.0]]).rank(), 1);
    }
}

#[test]
fn a_singular_matrix_has_its_shortest_solution() {
    // Rows a, b, a + b, 0 with a ⊥ b of squares 1 and 4.
    let s = [[1.0, 0.0, 1.0, 0.0], [0.0, 4.0, 4.0, 0.0], [1.0, 4.0, 5.0, 0.0], [0.0; 4]];
    let schur = Schur::factor(s);
    assert_eq!((schur.rank(), schur.vanishing(), schur.is_finite()), (2, Some(3), true));
    assert_eq!((0..9).filter(|&c| schur.is_dropped(c)).count(), 2);
    // The forces 2 a + 6 b: (2, 6, 0) less (2, 6, 0)·(1, 1, −1)/3 · (1, 1, −1).
    let kappa = schur.solve([2.0, 24.0, 26.0, 7.0]);
    for (kappa, exact) in kappa.iter().zip(&[2.0 - 8.0 / 3.0, 6.0 - 8.0 / 3.0, 8.0 / 3.0, 0.0]) {
        assert!((kappa - exact).abs() < 1e-14, "{kappa} {exact}");
    }
    let nothing = Schur::factor([[0.0; 2]; 2]);
    assert_eq!((nothing.rank(), nothing.vanishing()), (0, Some(0)));
    assert_eq!(nothing.solve([1.0, 2.0]), [0.0, 0.0]);
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn ranks_are_found_in_any_units() {
    fn check<const C: usize>(rank: usize) {
        let mut noise = Noise(3 * C as u64);
        for _ in 0..200 {
            let mut a: [[f64; C]; C] = noise.matrix();
            for c in rank..C {
                a[c] = core::array::from_fn(|i| a[c - rank][i] - a[c - 1][i]);
            }
            for row in &mut a {
                let unit = 1e6_f64.powf(noise.number());
                *row = row.map(|x| x * unit);
            }
            let product = |i: usize, j: usize| a[i].iter().zip(&a[j]).map(|(x, y)| x * y).sum::<f64>();
            let s: [[f64; C]; C] = core::array::from_fn(|i| core::array::from_fn(|j| product(i, j)));
            assert_eq!(Schur::factor(s).rank(), rank, "{s:?}");
        }
    }
    check::<2>(1);
    check::<5>(3);
    check::<8>(3);
    check::<12>(6);
}

#[test]
fn what_is_not_a_number_stays_so() {
    assert!(!Schur::factor([[1.0, 0.0], [0.0, -1.0]]).is_finite());
    for s in
        [[[f64::NAN, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, f64::NAN]], [[1.0, 0.0], [f64::INFINITY, 1.0]]]
    {
        let schur = Schur::factor(s);
        assert!(!schur.is_finite() && schur.solve([1.0, 1.0]).iter().any(|x| !x.is_finite()), "{s:?}");
    }
    let mut large = [[0.0; 8]; 8];
    for (i, row) in large.iter_mut().enumerate() {
        row[i] = if i == 5 { f64::NAN } else { 1.0 };
    }
    assert!(!Schur::factor(large).is_finite());
}
