//! Order conditions, computed from the tables; each is also shown to notice a planted fault.

use super::{dop853, rk4};

const TOLERANCE: f64 = 2e-13;

/// Largest |Σⱼ aᵢⱼ − cᵢ|.
fn row_sums<const S: usize>(c: &[f64; S], a: &[[f64; S]; S]) -> f64 {
    c.iter().zip(a).map(|(c, row)| (row.iter().sum::<f64>() - c).abs()).fold(0.0, f64::max)
}

/// Largest |Σ bᵢ cᵢᵏ − 1/(k+1)| for k below `order`.
fn quadrature(b: &[f64], c: &[f64], order: i32) -> f64 {
    (0..order).map(|k| (moment(b, c, k) - 1.0 / f64::from(k + 1)).abs()).fold(0.0, f64::max)
}

/// Σ wᵢ cᵢᵏ.
fn moment(w: &[f64], c: &[f64], k: i32) -> f64 {
    w.iter().zip(c).map(|(w, c)| w * c.powi(k)).sum()
}

/// Largest defect of Σ bᵢ cᵢᵐ Σ aᵢⱼ cⱼᵏ = 1/((k+1)(m+k+2)) up to `order`: the bushy trees with one branch.
fn branches<const S: usize>(b: &[f64; S], c: &[f64; S], a: &[[f64; S]; S], order: i32) -> f64 {
    let mut worst = 0.0_f64;
    for m in 0..order {
        for k in 0..order - m - 1 {
            let sum: f64 = (0..S).map(|i| b[i] * c[i].powi(m) * moment(&a[i], c, k)).sum();
            worst = worst.max((sum - 1.0 / f64::from((k + 1) * (m + k + 2))).abs());
        }
    }
    worst
}

#[test]
fn rk4_integrates_cubics_and_no_more() {
    assert!(quadrature(&rk4::B, &rk4::C, 4) < TOLERANCE);
    assert!(quadrature(&rk4::B, &rk4::C, 5) > 1e-3);
}

#[test]
fn dop853_nodes_are_the_row_sums() {
    assert!(row_sums(&dop853::C, &dop853::A) < TOLERANCE);
    let mut fault = dop853::C;
    fault[11] = 0.0;
    assert!(row_sums(&fault, &dop853::A) > 0.9);
}

#[test]
fn dop853_weights_have_order_eight_and_no_more() {
    assert!(quadrature(&dop853::B, &dop853::C, 8) < TOLERANCE);
    assert!(quadrature(&dop853::B, &dop853::C, 9) > 1e-6);
    assert!(branches(&dop853::B, &dop853::C, &dop853::A, 8) < TOLERANCE);
    assert!(branches(&dop853::B, &dop853::C, &dop853::A, 9) > 1e-7);
}

#[test]
fn a_wrong_digit_in_any_stage_is_noticed() {
    for i in 1..dop853::STAGES {
        for j in (0..i).filter(|&j| dop853::A[i][j] != 0.0) {
            let mut a = dop853::A;
            a[i][j] *= 1.0 + 1e-9;
            let defect = row_sums(&dop853::C, &a);
            assert!(defect > 10.0 * TOLERANCE, "a[{i}][{j}]: {defect:e}");
        }
    }
}

#[test]
fn dop853_estimates_have_orders_five_and_three() {
    // An estimate vanishes on polynomials below its order and on no more.
    let estimate = |k| moment(&dop853::E5, &dop853::C, k).abs();
    assert!((0..5).all(|k| estimate(k) < TOLERANCE));
    assert!(estimate(5) > 1e-5);
    assert!(quadrature(&dop853::B3, &dop853::C, 3) < TOLERANCE);
    assert!(quadrature(&dop853::B3, &dop853::C, 4) > 1e-4);
}

/// Weights of the dense output at θ, from the nested form in which it is evaluated.
fn dense(theta: f64, d: &[[f64; 16]; 4]) -> [f64; 16] {
    let rest = 1.0 - theta;
    core::array::from_fn(|i| {
        let b = dop853::B[i];
        let curve = f64::from(i == 0) - b;
        let hermite = b - f64::from(i == 12) - curve;
        let tail = d[0][i] + theta * (d[1][i] + rest * (d[2][i] + theta * d[3][i]));
        theta * (b + rest * (curve + theta * (hermite + rest * tail)))
    })
}

/// Largest defect of Σ bᵢ(θ) cᵢᵏ = θᵏ⁺¹/(k+1) for k below `order`.
fn dense_quadrature(d: &[[f64; 16]; 4], order: i32) -> f64 {
    let mut worst = 0.0_f64;
    for theta in [0.1, 0.35, 0.5, 0.8] {
        let b = dense(theta, d);
        for k in 0..order {
            worst = worst.max((moment(&b, &dop853::C, k) - theta.powi(k + 1) / f64::from(k + 1)).abs());
        }
    }
    worst
}

#[test]
fn dop853_dense_output_has_order_seven_and_no_more() {
    assert!(dense_quadrature(&dop853::D, 7) < TOLERANCE);
    assert!(dense_quadrature(&dop853::D, 8) > 1e-7);
    for row in 0..4 {
        for i in (0..16).filter(|&i| dop853::D[row][i] != 0.0) {
            let mut fault = dop853::D;
            fault[row][i] *= 1.0 + 1e-8;
            assert!(dense_quadrature(&fault, 7) > TOLERANCE, "d[{row}][{i}]");
        }
    }
}
