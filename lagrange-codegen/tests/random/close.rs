//! The comparison of an emitted quantity with the oracle: the only place with a tolerance.

use crate::number::Tracked;

/// Error of a quantity, relative to its largest component.
pub const TOLERANCE: f64 = 1e-11;

/// How many times the rounding errors that the oracle itself has gathered an error may be. Where
/// terms cancel, the size of the terms and not that of their sum sets the errors of any evaluation
/// in doubles, and a relative error says nothing.
const ROUNDINGS: f64 = 32.0;

/// Compares all components. Gives the error relative to the largest component, or what is wrong.
///
/// Absolute values throughout, and written so that NaN fails.
pub fn compare(quantity: &str, emitted: &[f64], expected: &[Tracked]) -> Result<f64, String> {
    if emitted.len() != expected.len() {
        return Err(format!("{quantity}: {} components, not {}", emitted.len(), expected.len()));
    }
    let largest = expected.iter().map(|x| x.value.abs()).fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for (index, (&found, wanted)) in emitted.iter().zip(expected).enumerate() {
        let error = (found - wanted.value).abs();
        let bound = TOLERANCE * largest + ROUNDINGS * f64::EPSILON * wanted.roundings;
        if !(error <= bound) {
            let wanted = wanted.value;
            return Err(format!("{quantity}[{index}] = {found:e}, not {wanted:e}: off by {error:e}, bound {bound:e}"));
        }
        if largest > 0.0 {
            worst = worst.max(error / largest);
        }
    }
    Ok(worst)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(values: &[f64]) -> Vec<Tracked> {
        values.iter().map(|&value| Tracked { value, roundings: value.abs() }).collect()
    }

    #[test]
    fn what_is_wrong_is_rejected() {
        let expected = exact(&[1.0, -2.0]);
        assert!(compare("same", &[1.0, -2.0], &expected).is_ok());
        for wrong in [
            &[1.0, 2.0][..],
            &[1.0, -2.0 - 1e-9],
            &[1.0, -2.0 + 1e-10],
            &[-2.0, 1.0],
            &[1.0],
            &[f64::NAN, -2.0],
            &[1.0, f64::NEG_INFINITY],
        ] {
            assert!(compare("wrong", wrong, &expected).is_err(), "{wrong:?}");
        }
        assert!(compare("nan", &[1.0], &exact(&[f64::NAN])).is_err());
    }
}
