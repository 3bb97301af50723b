//! The comparison of floating-point numbers that these tests share.
//!
//! A deviation is |found − expected| over the size of the expected number, where sizes below a floor count as
//! the floor: near zero the comparison is absolute. Neither NaN nor an infinity is close to anything, itself
//! included. Every deviation is printed, which `cargo test -- --nocapture` shows.

use std::panic::Location;

/// The size below which numbers are compared absolutely, unless a scale is given.
const FLOOR: f64 = 1e-3;

/// |found − expected| relative to `scale`; NaN where either is not finite.
fn deviation(found: f64, expected: f64, scale: f64) -> f64 {
    if found.is_finite() && expected.is_finite() { (found - expected).abs() / scale } else { f64::NAN }
}

#[track_caller]
fn judge(found: f64, expected: f64, tolerance: f64, scale: f64, place: &str) {
    assert!(
        tolerance > 0.0 && scale > 0.0,
        "close: a tolerance {tolerance:e} on a scale {scale:e} means nothing"
    );
    let deviation = deviation(found, expected, scale);
    let caller = Location::caller();
    println!("{}:{}: deviation {deviation:.1e} of {tolerance:.0e}", caller.file(), caller.line());
    // `<=` is false for NaN.
    assert!(
        deviation <= tolerance,
        "{place}found    {found:?}\n{place}expected {expected:?}\ndeviation {deviation:.3e} exceeds {tolerance:.0e}"
    );
}

/// Asserts that `found` is `expected` within a relative `tolerance`.
#[track_caller]
pub fn close(found: f64, expected: f64, tolerance: f64) {
    judge(found, expected, tolerance, expected.abs().max(FLOOR), "");
}

/// Asserts that `found` is `expected` within `tolerance` times `scale`, the size of what was added up.
#[track_caller]
pub fn close_on(scale: f64, found: f64, expected: f64, tolerance: f64) {
    judge(found, expected, tolerance, scale, "");
}

/// Asserts that all components are close, each relative to its own size.
#[track_caller]
pub fn all_close(found: impl AsRef<[f64]>, expected: impl AsRef<[f64]>, tolerance: f64) {
    let (found, expected) = (found.as_ref(), expected.as_ref());
    assert_eq!(found.len(), expected.len(), "close: as many numbers as expected");
    for (i, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        judge(found, expected, tolerance, expected.abs().max(FLOOR), &format!("[{i}] "));
    }
}

/// Asserts that all components are close relative to the largest of them.
#[track_caller]
pub fn all_close_on_largest(found: impl AsRef<[f64]>, expected: impl AsRef<[f64]>, tolerance: f64) {
    let (found, expected) = (found.as_ref(), expected.as_ref());
    assert_eq!(found.len(), expected.len(), "close: as many numbers as expected");
    let scale = expected.iter().fold(FLOOR, |largest, x| largest.max(x.abs()));
    for (i, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        judge(found, expected, tolerance, scale, &format!("[{i}] "));
    }
}

/// Asserts that `found` lies strictly between two bounds; both must be meant.
#[track_caller]
pub fn between(low: f64, found: f64, high: f64) {
    assert!(low < found && found < high, "{found:?} is not between {low:?} and {high:?}");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rejects(comparison: impl FnOnce() + std::panic::UnwindSafe) -> String {
        let panic = std::panic::catch_unwind(comparison).expect_err("a wrong value passed");
        *panic.downcast::<String>().expect("a message with both values")
    }

    #[test]
    fn equal_numbers_are_close() {
        close(0.1 + 0.2, 0.3, 1e-15);
        close(0.0, 0.0, 1e-300);
        all_close([1.0, -2.0], [1.0, -2.0], 1e-16);
    }

    #[test]
    fn a_planted_digit_is_rejected_from_both_sides() {
        for wrong in [1.234567891, 1.234567889, -1.23456789] {
            rejects(|| close(wrong, 1.23456789, 1e-10));
        }
        close(1.234567891, 1.23456789, 1e-9);
    }

    #[test]
    fn nan_and_infinity_are_close_to_nothing() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            rejects(move || close(bad, 1.0, 1e300));
            rejects(move || close(1.0, bad, 1e300));
            rejects(move || close(bad, bad, 1e300));
            rejects(move || between(-1e300, bad, 1e300));
        }
    }

    #[test]
    fn near_zero_the_floor_makes_the_comparison_absolute() {
        close(1e-13, 0.0, 1e-9);
        rejects(|| close(1e-11, 0.0, 1e-9));
        rejects(|| close(2e-12, -2e-12, 1e-9));
    }

    #[test]
    fn one_wrong_component_of_many_is_found_and_named() {
        let message = rejects(|| all_close([1.0, 2.0, 3.0], [1.0, 2.5, 3.0], 1e-3));
        for part in ["[1]", "2.0", "2.5"] {
            assert!(message.contains(part), "{part} is missing in {message}");
        }
        rejects(|| all_close_on_largest([1e6, 2.0], [1e6, 1.0], 1e-7));
        all_close_on_largest([1e6, 2.0], [1e6, 1.0], 1e-5);
    }

    #[test]
    fn vacuous_tolerances_and_lengths_are_rejected() {
        rejects(|| close(1.0, 1.0, f64::NAN));
        rejects(|| close(1.0, 1.0, 0.0));
        rejects(|| all_close([1.0], [1.0, 1.0], 1.0));
    }

    #[test]
    fn both_bounds_count() {
        between(0.9, 1.0, 1.1);
        rejects(|| between(1.0, 1.0, 1.1));
        rejects(|| between(0.9, 1.1, 1.1));
    }
}
