//! Sums that keep what rounding would lose (W. Kahan, "Further remarks on reducing truncation errors", Comm.
//! ACM 8, 1965).

use super::real::Real;

/// x + d, and the residue that the next sum takes up; `residue` is that of the last one.
#[inline(always)]
pub(crate) fn add<R: Real>(x: R, residue: R, d: R) -> (R, R) {
    let d = d + residue;
    let sum = x + d;
    (sum, d - (sum - x))
}

/// x + a b, and the residue that the next sum takes up; `residue` is that of the last one. The sum takes up
/// what rounding takes from the product, too, where the target rounds `Real::mul_add` once. (T. J. Dekker, "A
/// floating-point technique for extending the available precision", Numer. Math. 18, 1971; D. E. Knuth, "The
/// Art of Computer Programming", vol. 2, § 4.2.2, theorem B.)
#[inline(always)]
pub(crate) fn add_product<R: Real>(x: R, residue: R, a: R, b: R) -> (R, R) {
    let d = a * b;
    let rest = R::mul_add(a, b, -d);
    let sum = x + d;
    let of_d = sum - x;
    let lost = (x - (sum - of_d)) + (d - of_d);
    let low = lost + (residue + rest);
    let whole = sum + low;
    (whole, low - (whole - sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x is a thousand, and the products are multiples of 2⁻⁶⁰ that no sum of doubles could hold.
    #[test]
    fn a_sum_of_products_loses_nothing_that_residues_hold() {
        let (a, b) = (1.0 + f64::EPSILON, 0.625);
        let (mut x, mut residue) = (1000.0, 0.0);
        for _ in 0..1000 {
            (x, residue) = add_product(x, residue, a, b);
        }
        for _ in 0..1000 {
            (x, residue) = add_product(x, residue, 1.0, -b);
        }
        let whole = if f64::mul_add(a, b, -(a * b)) == Real::mul_add(a, b, -(a * b)) { 625.0 } else { 500.0 };
        let gained = (x - 1000.0) + residue;
        assert!((gained - whole * f64::EPSILON).abs() <= 1e-3 * whole * f64::EPSILON, "{gained:e}");
    }

    #[test]
    fn what_a_sum_loses_is_its_residue() {
        let (sum, residue) = add_product(1.0, 0.0, 2.0_f64.powi(-54), 3.0);
        assert_eq!((sum, residue), (1.0 + f64::EPSILON, -2.0_f64.powi(-54)));
        assert_eq!(add_product(sum, residue, 1.0, -1.0), (3.0 * 2.0_f64.powi(-54), 0.0));
        assert_eq!(add(1.0, 0.0, 2.0_f64.powi(-54)), (1.0, 2.0_f64.powi(-54)));
    }
}
