//! Conversions at the entrance of functions written with angular velocities: states hold rates of parameters
//! instead.

use super::Emission;

/// The name of the rates in a state.
const RATES: &str = "__rates";

/// The statement that replaces rates by angular velocities.
pub(super) fn entry(emission: &Emission<'_>) -> String {
    match emission.solved.turning.as_slice() {
        [] => String::new(),
        orientations => format!("let v = &lagrange::attitude::turning(q, v, {orientations:?});\n"),
    }
}

/// The same for accelerations, and the conversion of the result.
pub(super) fn accelerations(emission: &Emission<'_>) -> (String, impl FnOnce(String) -> String) {
    let orientations = emission.solved.turning.clone();
    let kept = if orientations.is_empty() { String::new() } else { format!("let {RATES} = v;\n") };
    let back = move |accelerations: String| match orientations.as_slice() {
        [] => accelerations,
        all => format!("lagrange::attitude::accelerations(q, {RATES}, v, {accelerations}, {all:?})"),
    };
    (kept + &entry(emission), back)
}

/// The text that adds parameters and their rates to a series of angular velocities.
pub(super) fn series(emission: &Emission<'_>) -> String {
    match emission.solved.turning.as_slice() {
        [] => String::new(),
        all => format!("lagrange::attitude::complete(series, orders, h, q, v, {all:?});\n"),
    }
}

/// The words about orientations in the line about series in `STRUCTURE`.
pub(super) fn described(emission: &Emission<'_>) -> &'static str {
    if emission.solved.turning.is_empty() { "" } else { ", and 16 convolutions for each orientation" }
}
