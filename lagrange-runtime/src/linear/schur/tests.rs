//! Random rows, clearly independent and dependent, in any units.

use super::*;
use crate::linear::samples::{Noise, residual};

/// A M⁻¹ Aᵀ.
fn square<const C: usize, const N: usize>(inverse_masses: &[f64; N], a: &[[f64; N]; C]) -> [[f64; C]; C] {
    let product = |c: usize, d: usize| (0..N).map(|i| a[c][i] * inverse_masses[i] * a[d][i]).sum();
    core::array::from_fn(|c| core::array::from_fn(|d| product(c, d)))
}

fn factor<const C: usize, const N: usize>(inverse_masses: [f64; N], a: [[f64; N]; C]) -> Schur<f64, C> {
    Schur::factor(square(&inverse_masses, &a), || (inverse_masses, a))
}

/// A matrix of size one by itself.
fn single(square: f64) -> Schur<f64, 1> {
    Schur::factor([[square]], || ([1.0], [[square.sqrt()]]))
}

fn check<const C: usize, const N: usize>() {
    let mut noise = Noise(C as u64 + 17);
    for _ in 0..100 {
        let a: [[f64; N]; C] = core::array::from_fn(|c| {
            let mut row: [f64; N] = noise.vector();
            row[c] += 2.0;
            row
        });
        let masses: [f64; N] = core::array::from_fn(|_| 1.5 + noise.number());
        let s = square(&masses, &a);
        let y = noise.vector();
        for (way, schur) in [factor(masses, a), Schur::carefully(&(masses, a))].iter().enumerate() {
            assert_eq!((schur.independence().rank, schur.is_finite(), schur.vanishing()), (C, true, None));
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
    check::<1, 3>();
    check::<2, 4>();
    check::<3, 5>();
    check::<6, 8>();
    check::<7, 9>();
    check::<12, 14>();
    assert_eq!(single(4.0).solve([8.0]), [2.0]);
    let none: Schur<f64, 0> = Schur::factor([], || ([1.0], []));
    assert_eq!((none.independence().rank, none.is_finite(), none.solve([])), (0, true, []));
}

#[test]
fn the_upper_triangle_is_not_read() {
    let rows = || ([1.0, 1.0], [[2.0, 0.0], [1.0, 2.0_f64.sqrt()]]);
    for bad in [1e9, f64::NAN] {
        let [x, y] = Schur::factor([[4.0, bad], [2.0, 3.0]], rows).solve([8.0, 8.0]);
        assert!((x - 1.0).abs() < 1e-15 && (y - 2.0).abs() < 1e-15);
    }
}

#[test]
fn a_singular_matrix_has_its_shortest_solution() {
    // Rows a, b, a + b, 0 with a ⊥ b of squares 1 and 4.
    let a = [[1.0, 0.0], [0.0, 2.0], [1.0, 2.0], [0.0; 2]];
    let schur = factor([1.0, 1.0], a);
    assert_eq!((schur.independence().rank, schur.vanishing(), schur.is_finite()), (2, Some(3), true));
    // The forces 2 a + 6 b: (2, 6, 0) less (2, 6, 0)·(1, 1, −1)/3 · (1, 1, −1).
    let kappa = schur.solve([2.0, 24.0, 26.0, 7.0]);
    for (kappa, exact) in kappa.iter().zip(&[2.0 - 8.0 / 3.0, 6.0 - 8.0 / 3.0, 8.0 / 3.0, 0.0]) {
        assert!((kappa - exact).abs() < 1e-14, "{kappa} {exact}");
    }
    let nothing = factor([1.0], [[0.0]; 2]);
    assert_eq!((nothing.independence().rank, nothing.vanishing()), (0, Some(0)));
    assert_eq!(nothing.solve([1.0, 2.0]), [0.0, 0.0]);
    let nothing = single(0.0);
    assert_eq!((nothing.independence().rank, nothing.vanishing(), nothing.solve([1.0])), (0, Some(0), [0.0]));
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
            assert_eq!(factor([1.0; C], a).independence().rank, rank, "{a:?}");
        }
    }
    check::<2>(1);
    check::<5>(3);
    check::<8>(3);
    check::<12>(6);
}

#[test]
fn rows_are_not_told_apart_by_their_squares() {
    // The square of a sine of 1e-7 is some 50 ε, so it has two digits; the sine has nine.
    for distance in [1e-3, 1e-5, 1e-7] {
        let schur = factor([1.0; 3], [[1.0, 0.0, 0.0], [1.0, distance, 0.0]]);
        assert_eq!(schur.independence().rank, 2);
        let found = schur.independence().least;
        assert!((found / distance - 1.0).abs() < 1e-3, "{found:e} for {distance:e}");
        // κ of the force (0, 1, 0), which takes 1/distance of each.
        let [a, b] = schur.solve([0.0, distance]);
        assert!((a * distance + 1.0).abs() < 1e-6 && (b * distance - 1.0).abs() < 1e-6, "{a} {b}");
    }
    assert_eq!(factor([1.0; 2], [[1.0, 0.0], [1.0, 1e-9]]).independence().rank, 1);
}

#[test]
fn what_is_not_a_number_stays_so() {
    assert!(!factor([1.0, -1.0], [[1.0, 0.0], [0.0, 1.0]]).is_finite());
    assert!(!single(-1.0).is_finite() && !single(f64::NAN).is_finite());
    for a in
        [[[f64::NAN, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, f64::NAN]], [[1.0, 0.0], [f64::INFINITY, 1.0]]]
    {
        let schur = factor([1.0, 1.0], a);
        assert!(!schur.is_finite() && schur.solve([1.0, 1.0]).iter().any(|x| !x.is_finite()), "{a:?}");
    }
    let mut large = [[0.0; 8]; 8];
    for (i, row) in large.iter_mut().enumerate() {
        row[i] = if i == 5 { f64::NAN } else { 1.0 };
    }
    assert!(!factor([1.0; 8], large).is_finite());
}
