//! The motion of body axes, for deviations from a motion.

use super::axes::{angular, columns};
use crate::number::elements::{Each, array};
use crate::number::real::{Dual, Real};

type Matrix<R> = [[R; 3]; 3];

/// The terms that small deviations x = (δρ, δρ′) from a motion gain if they are written in axes that turn
/// with the body: the two blocks D and E of T⁻¹ T′ = \[D 0; E D]. Here (δφ, δω) = T x are the turn and the
/// change of the angular velocity in body axes,
///
/// δφ = J⁻¹ δρ,  δω = J⁻¹ δρ′ + B δρ,  B = ∂(J⁻¹ρ′)/∂ρ,
///
/// and T′ is its rate along the motion, which has the `rates` ρ′ and the second rates ρ″. Rows of matrices.
pub(crate) fn drift<R: Real>(rho: [R; 3], rates: [R; 3], seconds: [R; 3]) -> [Matrix<R>; 2] {
    let one = |j: usize| -> [R; 3] { array(|i| if i == j { R::one() } else { R::zero() }) };
    let along =
        |x: [R; 3], slope: [R; 3]| -> [Dual<R, 1>; 3] { array(|i| Dual { value: x[i], slopes: [slope[i]] }) };
    // Columns, one for each axis.
    let inverse_rate: Matrix<R> =
        array(|j| angular(along(rho, rates), one(j).each(Dual::constant)).each(|x| x.slopes[0]));
    let by_place: Matrix<R> =
        array(|j| angular(along(rho, one(j)), rates.each(Dual::constant)).each(|x| x.slopes[0]));
    let by_place_rate: Matrix<R> = array(|j| {
        let nested = |x: [R; 3], slope: [R; 3], along: [R; 3]| -> [Dual<Dual<R, 1>, 1>; 3] {
            array(|i| Dual {
                value: Dual { value: x[i], slopes: [slope[i]] },
                slopes: [Dual::constant(along[i])],
            })
        };
        let found = angular(nested(rho, rates, one(j)), nested(rates, seconds, [R::zero(); 3]));
        found.each(|x| x.slopes[0].slopes[0])
    });
    let jacobian = columns(rho);
    let turned: Matrix<R> = array(|j| product(&jacobian, inverse_rate[j]));
    let rest: Matrix<R> = array(|j| {
        let known = product(&by_place, turned[j]);
        product(&jacobian, array(|i| by_place_rate[j][i] - known[i]))
    });
    [turned, rest].each(|columns| array(|i| array(|j| columns[j][i])))
}

/// A matrix given by its columns times a vector.
fn product<R: Real>(columns: &Matrix<R>, [x, y, z]: [R; 3]) -> [R; 3] {
    array(|i| columns[0][i] * x + columns[1][i] * y + columns[2][i] * z)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// D = −½ ω × at the identity. Deviations at rest in space have φ′ = −ω × φ, of which D φ is half. The
    /// other half comes from δρ′.
    #[test]
    fn deviations_of_a_steady_spin_turn_backwards_in_body_axes() {
        // At the identity, ρ = 0, ρ′ = ω and ρ″ = 0 to the first order, J⁻¹ = 1 and (J⁻¹)′ x = −½ ω × x.
        let omega = [0.3, -0.7, 1.1];
        let [turned, _] = drift([0.0; 3], omega, [0.0; 3]);
        for j in 0..3 {
            let x: [f64; 3] = core::array::from_fn(|i| f64::from(u8::from(i == j)));
            let expected = super::super::cross(omega, x).map(|entry| -0.5 * entry);
            for i in 0..3 {
                assert!((turned[i][j] - expected[i]).abs() < 1e-15, "{turned:?}");
            }
        }
    }

    /// T⁻¹ T′ against differences of T.
    #[test]
    fn the_drift_is_that_of_the_change_of_axes() {
        let (rho, rates, seconds) = ([0.9, -1.6, 2.1], [-0.8, 0.5, 1.1], [0.4, 0.2, -0.3]);
        let change = |tau: f64, [place, speed]: [[f64; 3]; 2]| -> [[f64; 3]; 2] {
            let q: [f64; 3] = core::array::from_fn(|i| rho[i] + tau * (rates[i] + 0.5 * tau * seconds[i]));
            let v: [f64; 3] = core::array::from_fn(|i| rates[i] + tau * seconds[i]);
            let dual = |x: [f64; 3], slope: [f64; 3]| -> [Dual<f64, 1>; 3] {
                core::array::from_fn(|i| Dual { value: x[i], slopes: [slope[i]] })
            };
            [angular(q, place), angular(dual(q, place), dual(v, speed)).map(|x| x.slopes[0])]
        };
        let [turned, rest] = drift(rho, rates, seconds);
        let (place, speed, tau) = ([0.3, -0.2, 0.5], [0.7, 0.1, -0.4], 1e-4);
        let times = |m: &Matrix<f64>, x: [f64; 3]| m.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2]);
        let lower: [f64; 3] = core::array::from_fn(|i| times(&rest, place)[i] + times(&turned, speed)[i]);
        let found = change(0.0, [times(&turned, place), lower]);
        let (ahead, behind) = (change(tau, [place, speed]), change(-tau, [place, speed]));
        for part in 0..2 {
            for i in 0..3 {
                let slope = (ahead[part][i] - behind[part][i]) / (2.0 * tau);
                assert!((found[part][i] - slope).abs() < 1e-7, "{part} {i}: {} {slope}", found[part][i]);
            }
        }
    }
}
