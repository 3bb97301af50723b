//! Jacobi's elliptic functions.

/// sn, cn and dn of `u` for the parameter m = k², 0 ≤ m < 1, by descending Landen transformations.
/// (Abramowitz and Stegun, *Handbook of Mathematical Functions*, section 16.4.)
pub fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let (mut a, mut b, mut c) = (1.0, (1.0 - m).sqrt(), m.sqrt());
    let mut ratios = Vec::new();
    while c.abs() > f64::EPSILON * a {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        ratios.push(c / a);
    }
    let mut phi = f64::from(1 << ratios.len()) * a * u;
    for ratio in ratios.iter().rev() {
        phi = 0.5 * (phi + (ratio * phi.sin()).asin());
    }
    let (sn, cn) = phi.sin_cos();
    [sn, cn, (1.0 - m * sn * sn).sqrt()]
}

#[test]
fn elliptic_functions_are_those_of_the_tables() {
    // Abramowitz and Stegun, table 17.1 and 16.5: sn(K) = 1 with K(1/2) = 1.854074677301372.
    let [sn, cn, dn] = jacobi(1.854_074_677_301_372, 0.5);
    assert!((sn - 1.0).abs() < 1e-15 && cn.abs() < 1e-15 && (dn - 0.5_f64.sqrt()).abs() < 1e-15);
    // Without a modulus they are sine and cosine.
    let [sn, cn, dn] = jacobi(0.7, 0.0);
    assert!((sn - 0.7_f64.sin()).abs() < 1e-16 && (cn - 0.7_f64.cos()).abs() < 2e-16 && dn == 1.0);
    // dsn/du = cn dn.
    let slope = (jacobi(1.3 + 1e-5, 0.9)[0] - jacobi(1.3 - 1e-5, 0.9)[0]) / 2e-5;
    let [_, cn, dn] = jacobi(1.3, 0.9);
    assert!((slope - cn * dn).abs() < 1e-9);
}
