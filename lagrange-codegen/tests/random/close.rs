//! The comparison of emitted quantities with the oracle, and its tolerance.

use crate::number::Tracked;

/// The bound of the relative error of every quantity.
const TOLERANCE: f64 = 1e-11;

/// The factor of the oracle's own rounding errors, which are allowed beside the tolerance. Where terms
/// cancel, the errors of any evaluation in doubles depend on the size of the terms and not on that of their
/// sum.
const ROUNDINGS: f64 = 16.0;

/// The result of a comparison that found nothing wrong.
#[derive(Clone, Copy, Debug, Default)]
pub struct Agreement {
    /// The largest error relative to the largest component, cancelled components aside.
    pub error: f64,
    pub components: usize,
    /// Components in which the oracle has lost so many digits that a relative error says nothing. Zeros are
    /// not counted: they have no digits.
    pub cancelled: usize,
    /// Components with an error beyond what the oracle's rounding errors account for.
    pub beyond: usize,
}

impl Agreement {
    /// Adds another comparison.
    pub fn join(&mut self, other: Agreement) {
        self.error = self.error.max(other.error);
        self.components += other.components;
        self.cancelled += other.cancelled;
        self.beyond += other.beyond;
    }
}

/// Compares all components. Absolute values throughout, and written so that NaN fails.
pub fn compare(quantity: &str, emitted: &[f64], expected: &[Tracked]) -> Result<Agreement, String> {
    if emitted.len() != expected.len() {
        return Err(format!("{quantity}: {} components, not {}", emitted.len(), expected.len()));
    }
    let largest = expected.iter().map(|x| x.value.abs()).fold(0.0, f64::max);
    let mut agreement = Agreement { components: expected.len(), ..Agreement::default() };
    for (index, (&found, wanted)) in emitted.iter().zip(expected).enumerate() {
        let error = (found - wanted.value).abs();
        let rounding = ROUNDINGS * f64::EPSILON * wanted.roundings;
        let bound = TOLERANCE * largest + rounding;
        if error.is_nan() || error > bound {
            let wanted = wanted.value;
            return Err(format!(
                "{quantity}[{index}] = {found:e}, not {wanted:e}: off by {error:e}, bound {bound:e}"
            ));
        }
        agreement.beyond += usize::from(error > rounding);
        if rounding > TOLERANCE * largest {
            agreement.cancelled += usize::from(wanted.value != 0.0);
        } else if largest > 0.0 {
            agreement.error = agreement.error.max(error / largest);
        }
    }
    Ok(agreement)
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
