//! Systems whose solutions are known.

use super::*;

#[test]
fn a_pendulum_in_cartesian_coordinates() {
    for (x, y) in [(0.6, -0.8), (1.0, 0.0), (0.0, -1.0), (0.0, 2.0)] {
        // 2 ẍ = x κ, 2 ÿ = y κ − 20, x ẍ + y ÿ = −1.
        let square = x * x + y * y;
        let tension = 2.0 * (-1.0 + 10.0 * y) / square;
        let exact = [x * tension / 2.0, y * tension / 2.0 - 10.0];
        let saddle = Saddle::factor(&[[2.0, 0.0], [0.0, 2.0]], &[[x, y]]);
        let diagonal = Diagonal::factor([0.5; 2], &[[x, y]]);
        for (v, [kappa]) in [saddle.solve(&[0.0, -20.0], &[-1.0]), diagonal.solve(&[0.0, -20.0], &[-1.0])] {
            assert!((kappa - tension).abs() < 1e-14 && (v[0] - exact[0]).abs() < 1e-14, "{v:?} {kappa}");
            assert!((v[1] - exact[1]).abs() < 1e-14);
        }
    }
}

#[test]
fn coordinates_without_mass_follow_those_they_are_tied_to() {
    // Of (x, y, z, w), z = 3 x and w = (y + z)/2 have no mass of their own.
    let mass = diagonal_matrix(&[2.0, 5.0, 0.0, 0.0]);
    let a = [[-3.0, 0.0, 1.0, 0.0], [0.0, -0.5, -0.5, 1.0]];
    for saddle in [
        Saddle::factor(&mass, &a),
        Saddle::carefully::<true>(&mass, &a),
        Saddle::factor_indefinite(&mass, &a),
    ] {
        assert_eq!((saddle.rank(), saddle.defect()), (2, None));
        let r = [1.0, 2.0, 3.0, 4.0];
        let (v, kappa) = saddle.solve(&r, &[0.0, 0.0]);
        // Forces on w and z reach x and y by the levers.
        let (x, y) = ((1.0 + 3.0 * (3.0 + 0.5 * 4.0)) / 2.0, (2.0 + 0.5 * 4.0) / 5.0);
        for (v, exact) in v.iter().zip(&[x, y, 3.0 * x, 0.5 * y + 1.5 * x]) {
            assert!((v - exact).abs() < 1e-14 * 40.0, "{v} {exact}");
        }
        assert!((kappa[1] + 4.0).abs() < 1e-14 && (kappa[0] + 5.0).abs() < 1e-14, "{kappa:?}");
    }
}

#[test]
fn a_chain_of_coordinates_without_mass_finds_its_units() {
    // q₀ has a mass; each of the others is a thousandth of the one before.
    let mass = diagonal_matrix(&[4.0, 0.0, 0.0, 0.0, 0.0]);
    let mut a = [[0.0; 5]; 4];
    for c in 0..4 {
        (a[c][c], a[c][c + 1]) = (-1e-3, 1.0);
    }
    let saddle = Saddle::factor(&mass, &a);
    assert_eq!((saddle.rank(), saddle.defect()), (4, None));
    let (v, _) = saddle.solve(&[8.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 4]);
    for (v, exact) in v.iter().zip(&[2.0, 2e-3, 2e-6, 2e-9, 2e-12]) {
        assert!((v / exact - 1.0).abs() < 1e-14, "{v} {exact}");
    }
}

#[test]
fn a_motion_without_inertia_is_named() {
    let mass = diagonal_matrix(&[1.0, 1.0, 1.0, 0.0]);
    // q₃ is massless and free.
    let saddle = Saddle::factor(&mass, &[[1.0, 1.0, 1.0, 0.0]]);
    assert_eq!(saddle.defect(), Some(Defect::Singular { coordinate: 3 }));
    assert!(saddle.solve(&[1.0; 4], &[0.0]).0.iter().all(|x: &f64| x.is_nan()));
    assert_eq!(
        Saddle::factor_indefinite(&mass, &[[1.0, 1.0, 1.0, 0.0]]).defect(),
        Some(Defect::Singular { coordinate: 3 })
    );
    // Tied, it is not; and what ties it may be small.
    assert_eq!(Saddle::factor(&mass, &[[1.0, 1.0, 1.0, 1e-9]]).defect(), None);
    // A coupling that leaves a difference of two coordinates without inertia, unless it is constrained.
    let mass = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
    for factor in [Saddle::factor, Saddle::factor_indefinite] {
        let defect = factor(&mass, &[[1.0, 0.1, 0.1]]).defect();
        assert!(matches!(defect, Some(Defect::Singular { coordinate: 1 | 2 })), "{defect:?}");
        assert_eq!(factor(&mass, &[[0.0, 1.0, 0.0]]).defect(), None);
    }
    // Negative inertia is not positive definite, but regular.
    let mass = [[1.0, 0.0], [0.0, -1.0]];
    assert_eq!(Saddle::factor(&mass, &[[1.0, 0.0]]).defect(), Some(Defect::Singular { coordinate: 1 }));
    assert_eq!(
        Saddle::factor_indefinite(&mass, &[[1.0, 0.0]]).solve(&[0.0, 3.0], &[2.0]),
        ([2.0, -3.0], [2.0])
    );
    // A light-like constraint leaves a motion without inertia to any method.
    let defect = Saddle::factor_indefinite(&mass, &[[1.0, 1.0]]).defect();
    assert!(matches!(defect, Some(Defect::Singular { .. })), "{defect:?}");
}

#[test]
fn random_singular_reduced_matrices_are_noticed() {
    let mut noise = Noise(5);
    let mut noticed = 0;
    for _ in 0..100 {
        // The null direction n of M meets the constraints.
        let b = matrix::<5, 6>(&mut noise);
        let mass =
            core::array::from_fn(|i| core::array::from_fn(|j| (0..5).map(|k| b[k][i] * b[k][j]).sum()));
        let (n, _) = Saddle::factor(&diagonal_matrix(&[1.0; 6]), &b).solve(&noise.vector(), &[0.0; 5]);
        let square: f64 = n.iter().map(|x| x * x).sum();
        let mut a = matrix::<2, 6>(&mut noise);
        for row in &mut a {
            let along = row.iter().zip(&n).map(|(a, n)| a * n).sum::<f64>() / square;
            for i in 0..6 {
                row[i] -= along * n[i];
            }
        }
        let saddle = Saddle::factor(&mass, &a);
        match saddle.defect() {
            Some(Defect::Singular { .. }) => noticed += 1,
            _ => assert!(saddle.compliance.as_flattened().iter().fold(0.0_f64, |a, x| a.max(x.abs())) > 1e9),
        }
    }
    assert!(noticed > 60, "only {noticed} of 100 singular systems are noticed");
}

#[test]
fn extreme_scales_are_not_singular() {
    for unit in [1e-100, 1e100] {
        let square = unit * unit;
        let saddle = Saddle::factor(&[[square, 0.0], [0.0, square]], &[[3.0 * unit, 4.0 * unit]]);
        assert_eq!((saddle.rank(), saddle.defect()), (1, None));
        let (v, _) = saddle.solve(&[0.0, 0.0], &[25.0]);
        assert!((v[0] * unit - 3.0).abs() < 1e-14 && (v[1] * unit - 4.0).abs() < 1e-14, "{v:?}");
    }
    let saddle = Saddle::factor(&[[1e-30_f32, 0.0], [0.0, 1e-30]], &[[3e-15, 4e-15]]);
    assert_eq!((saddle.rank(), saddle.defect()), (1, None));
}
