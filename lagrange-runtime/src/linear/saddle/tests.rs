//! Tests of all ways to factor: random systems, small ones by hand, and singular ones.

use super::*;
use crate::linear::samples::Noise;

mod exact;
#[cfg(feature = "wide")]
mod lanes;
mod redundancy;
#[cfg(all(feature = "std", feature = "double-double"))]
mod sparse;

const EPS: f64 = f64::EPSILON;

pub(super) fn matrix<const I: usize, const J: usize>(noise: &mut Noise) -> [[f64; J]; I] {
    core::array::from_fn(|_| noise.vector())
}

/// B Bᵀ + 1/2 with a random B: lower triangle; above it what must not be read.
pub(super) fn positive_definite<const N: usize>(noise: &mut Noise) -> [[f64; N]; N] {
    let b: [[f64; N]; N] = noise.matrix();
    let product = |i: usize, j: usize| b[i].iter().zip(&b[j]).map(|(x, y)| x * y).sum::<f64>();
    core::array::from_fn(|i| {
        core::array::from_fn(|j| match j {
            j if j > i => f64::NAN,
            j if j == i => product(i, i) + 0.5,
            _ => product(i, j),
        })
    })
}

pub(super) fn diagonal_matrix<const N: usize>(entries: &[f64; N]) -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| if i == j { entries[i] } else { 0.0 }))
}

pub(super) fn product<const I: usize, const J: usize>(m: &[[f64; J]; I], x: &[f64; J]) -> [f64; I] {
    m.map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum())
}

/// The largest residuals of M v − Aᵀ κ = r and of A v = y, each relative to the magnitudes that are added up
/// for it, in units of `epsilon`.
pub(super) fn residuals<const N: usize, const C: usize>(
    (mass, a): (&[[f64; N]; N], &[[f64; N]; C]),
    (v, kappa): &([f64; N], [f64; C]),
    (r, y): (&[f64; N], &[f64; C]),
    epsilon: f64,
) -> (f64, f64) {
    let relative = |terms: &mut dyn Iterator<Item = f64>| {
        let (sum, size) = terms.fold((0.0, f64::MIN_POSITIVE), |(sum, size), x| (sum + x, size + x.abs()));
        (sum / size / epsilon).abs()
    };
    let (mut motion, mut constraint) = (0.0_f64, 0.0_f64);
    for i in 0..N {
        let inertia = (0..N).map(|j| mass[i.max(j)][i.min(j)] * v[j]);
        let forces = (0..C).map(|c| -a[c][i] * kappa[c]);
        motion = motion.max(relative(&mut inertia.chain(forces).chain([-r[i]])));
    }
    for c in 0..C {
        constraint = constraint.max(relative(&mut (0..N).map(|j| a[c][j] * v[j]).chain([-y[c]])));
    }
    (motion, constraint)
}

/// Solutions of random systems by both ways to the null space and with both kinds of reduced matrix.
fn check<const N: usize, const C: usize>() {
    let mut noise = Noise((N * 100 + C) as u64);
    for _ in 0..100 {
        let (mass, a) = (positive_definite::<N>(&mut noise), matrix::<C, N>(&mut noise));
        let (r, y) = (noise.vector(), noise.vector());
        let ways = [
            Saddle::factor(&mass, &a),
            Saddle::factor_indefinite(&mass, &a),
            Saddle::carefully::<true>(&mass, &a),
            Saddle::carefully::<false>(&mass, &a),
        ];
        for (way, saddle) in ways.iter().enumerate() {
            assert_eq!((saddle.rank(), saddle.defect(), saddle.vanishing()), (C, None, None));
            let solution = saddle.solve(&r, &y);
            let (motion, constraint) = residuals((&mass, &a), &solution, (&r, &y), EPS);
            let bound = 4.0 * (N as f64).max(2.0);
            assert!(
                motion < bound && constraint < bound,
                "({N}, {C}), way {way}: {motion:.1} {constraint:.1} ε"
            );
            if N > C && C > 0 {
                let mut wrong = solution;
                wrong.0[N - 1] += 1e-10;
                let (motion, constraint) = residuals((&mass, &a), &wrong, (&r, &y), EPS);
                assert!(motion > bound && constraint > bound);
            }
        }
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn random_systems_are_solved_to_a_few_roundings() {
    check::<1, 0>();
    check::<2, 1>();
    check::<3, 1>();
    check::<4, 2>();
    check::<5, 0>();
    check::<7, 4>();
    check::<8, 6>();
    check::<12, 8>();
    check::<20, 10>();
}

#[test]
fn as_many_constraints_as_coordinates_leave_nothing_to_the_masses() {
    let mut noise = Noise(8);
    for _ in 0..100 {
        // A diagonal that keeps the rows apart: the residual of κ is relative to the condition of A.
        let mut a = matrix::<6, 6>(&mut noise);
        for (i, row) in a.iter_mut().enumerate() {
            row[i] += 3.0;
        }
        let (mass, r, y) = (positive_definite::<6>(&mut noise), noise.vector(), noise.vector());
        for saddle in [Saddle::factor(&mass, &a), Saddle::carefully::<true>(&mass, &a)] {
            assert_eq!((saddle.rank(), saddle.defect()), (6, None));
            let (motion, constraint) = residuals((&mass, &a), &saddle.solve(&r, &y), (&r, &y), EPS);
            assert!(motion < 24.0 && constraint < 24.0, "{motion} {constraint}");
            // No mass is asked for.
            let massless = Saddle::factor(&[[0.0; 6]; 6], &a);
            assert_eq!((massless.rank(), massless.defect()), (6, None));
            let (v, other) = (saddle.solve(&r, &y).0, massless.solve(&r, &y).0);
            assert!(v.iter().zip(&other).all(|(v, w)| (v - w).abs() < 1e-14));
        }
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn single_precision_is_used_to_the_end() {
    let mut noise = Noise(32);
    for _ in 0..200 {
        let (mass, a) = (positive_definite::<8>(&mut noise), matrix::<5, 8>(&mut noise));
        let (mass, a) = (mass.map(|row| row.map(|x| x as f32)), a.map(|row| row.map(|x| x as f32)));
        let (r, y) = (noise.vector::<8>().map(|x| x as f32), noise.vector::<5>().map(|x| x as f32));
        let wide = |x: f32| f64::from(x);
        let (wide_mass, wide_a) = (mass.map(|row| row.map(wide)), a.map(|row| row.map(wide)));
        for saddle in [Saddle::factor(&mass, &a), Saddle::carefully::<true>(&mass, &a)] {
            assert_eq!(saddle.defect(), None);
            let (v, kappa) = saddle.solve(&r, &y);
            let (motion, constraint) = residuals(
                (&wide_mass, &wide_a),
                &(v.map(wide), kappa.map(wide)),
                (&r.map(wide), &y.map(wide)),
                f32::EPSILON.into(),
            );
            assert!(motion < 32.0 && constraint < 32.0, "{motion} {constraint}");
        }
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn units_of_coordinates_and_constraints_change_nothing_but_units() {
    let mut noise = Noise(77);
    for _ in 0..200 {
        let (mut mass, mut a) = (positive_definite::<7>(&mut noise), matrix::<4, 7>(&mut noise));
        let (mut r, mut y): ([f64; 7], [f64; 4]) = (noise.vector(), noise.vector());
        let (v, kappa) = Saddle::factor(&mass, &a).solve(&r, &y);
        let coordinates: [f64; 7] = core::array::from_fn(|_| 1e6_f64.powf(noise.number()));
        let constraints: [f64; 4] = core::array::from_fn(|_| 1e6_f64.powf(noise.number()));
        for i in 0..7 {
            r[i] *= coordinates[i];
            for j in 0..=i {
                mass[i][j] *= coordinates[i] * coordinates[j];
            }
            for c in 0..4 {
                a[c][i] *= coordinates[i] * constraints[c];
            }
        }
        for c in 0..4 {
            y[c] *= constraints[c];
        }
        for saddle in [Saddle::factor(&mass, &a), Saddle::carefully::<true>(&mass, &a)] {
            assert_eq!((saddle.rank(), saddle.defect()), (4, None));
            let (w, lambda) = saddle.solve(&r, &y);
            let size = |x: &[f64]| x.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            for i in 0..7 {
                assert!((w[i] * coordinates[i] - v[i]).abs() < 1e-12 * size(&v));
            }
            for c in 0..4 {
                assert!((lambda[c] * constraints[c] - kappa[c]).abs() < 1e-12 * size(&kappa));
            }
        }
    }
}

#[test]
fn light_and_heavy_coordinates_are_solved_in_one_system() {
    let mut noise = Noise(12);
    for _ in 0..200 {
        let a = matrix::<3, 6>(&mut noise);
        let inertia: [f64; 6] = core::array::from_fn(|_| 1e6_f64.powf(noise.number()));
        let mass = diagonal_matrix(&inertia);
        let (r, y) = (core::array::from_fn(|i| noise.number() * inertia[i]), noise.vector());
        for saddle in [Saddle::factor(&mass, &a), Saddle::carefully::<true>(&mass, &a)] {
            let solution = saddle.solve(&r, &y);
            let (motion, constraint) = residuals((&mass, &a), &solution, (&r, &y), EPS);
            assert!(motion < 64.0 && constraint < 64.0, "{motion} {constraint}");
        }
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn a_symmetric_matrix_of_any_signature_is_solved_where_asked() {
    let mut noise = Noise(3);
    for _ in 0..200 {
        let mut mass = matrix::<7, 7>(&mut noise);
        // Coordinates that have no diagonal entry at all.
        (mass[2][2], mass[5][5]) = (0.0, 0.0);
        let a = matrix::<3, 7>(&mut noise);
        let (r, y) = (noise.vector(), noise.vector());
        for saddle in [Saddle::factor_indefinite(&mass, &a), Saddle::carefully::<false>(&mass, &a)] {
            assert_eq!(saddle.defect(), None);
            let (v, kappa) = saddle.solve(&r, &y);
            let (motion, constraint) = residuals((&mass, &a), &(v, kappa), (&r, &y), EPS);
            // A random reduced matrix may be nearly singular, which shows in the size of the solution.
            let size = v.iter().chain(&kappa).fold(1.0_f64, |a, x| a.max(x.abs()));
            assert!(motion.max(constraint) < 100.0 * size, "{motion} {constraint} {size}");
        }
        assert!(matches!(Saddle::factor(&mass, &a).defect(), Some(Defect::Singular { .. })));
    }
}

#[test]
fn a_pivot_of_either_sign_is_found_where_the_first_is_none() {
    for coupling in [1.0, -1.0] {
        let mass = [[1.0, 0.0, 0.0], [0.0, 0.0, coupling], [0.0, coupling, 0.5]];
        let saddle = Saddle::factor_indefinite(&mass, &[[1.0, 0.0, 0.0]]);
        assert_eq!(saddle.defect(), None);
        let (v, _) = saddle.solve(&[0.0, 2.0 * coupling, 4.0], &[3.0]);
        for (found, expected) in v.into_iter().zip([3.0, 3.0 * coupling, 2.0]) {
            assert!((found - expected).abs() < 1e-14, "{v:?}");
        }
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn a_diagonal_mass_matrix_has_the_same_solution_both_ways() {
    fn check<const N: usize, const C: usize>() {
        let mut noise = Noise((N + C) as u64);
        for _ in 0..100 {
            let a = matrix::<C, N>(&mut noise);
            let inverse = core::array::from_fn(|_| 1.1 + noise.number());
            let mass = diagonal_matrix(&inverse.map(f64::recip));
            let (r, y) = (noise.vector(), noise.vector());
            let diagonal = Diagonal::factor(inverse, &a);
            assert_eq!((diagonal.rank(), diagonal.defect(), diagonal.vanishing()), (C, None, None));
            let ((v, kappa), (w, lambda)) = (diagonal.solve(&r, &y), Saddle::factor(&mass, &a).solve(&r, &y));
            let size = kappa.iter().fold(1.0_f64, |a, x| a.max(x.abs()));
            let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12 * size);
            assert!(same(&v, &w) && same(&kappa, &lambda), "({N}, {C})");
        }
    }
    check::<2, 1>();
    check::<4, 2>();
    check::<9, 6>();
    check::<12, 8>();
    check::<5, 0>();
}

#[test]
fn what_is_not_a_number_is_said_to_be_so() {
    let mass = [[1.0, 0.0], [0.0, 1.0]];
    for bad in [f64::NAN, f64::INFINITY] {
        for (mass, a) in [
            ([[bad, 0.0], [0.0, 1.0]], [[1.0, 2.0]]),
            ([[1.0, 0.0], [bad, 1.0]], [[1.0, 2.0]]),
            (mass, [[bad, 2.0]]),
            (mass, [[0.0, bad]]),
        ] {
            let saddle = Saddle::factor(&mass, &a);
            assert_eq!(saddle.defect(), Some(Defect::NotFinite), "{mass:?} {a:?}");
            assert!(saddle.solve(&[1.0, 1.0], &[1.0]).0.iter().any(|x| !x.is_finite()));
            assert_eq!(Saddle::factor_indefinite(&mass, &a).defect(), Some(Defect::NotFinite));
        }
        assert_eq!(Diagonal::factor([1.0, 1.0], &[[1.0, bad]]).defect(), Some(Defect::NotFinite));
    }
    // The inverse of a mass of zero is infinite.
    let inverse = |x| Diagonal::factor([1.0, x], &[[1.0, 2.0]]).defect();
    assert_eq!(inverse(f64::NAN), Some(Defect::NotFinite));
    assert_eq!(inverse(f64::INFINITY), Some(Defect::Singular { coordinate: 1 }));
}
