//! The doors of functions that are written with angular velocities: states hold rates of parameters.

use super::Emission;

/// What a state holds of the velocities.
const RATES: &str = "__rates";

/// The statement that puts angular velocities in the places of rates.
pub(super) fn entry(emission: &Emission<'_>) -> String {
    match emission.solved.turning.as_slice() {
        [] => String::new(),
        orientations => format!("let v = &lagrange::attitude::turning(q, v, {orientations:?});\n"),
    }
}

/// The same for accelerations, and what brings the result back.
pub(super) fn accelerations(emission: &Emission<'_>) -> (String, impl FnOnce(String) -> String) {
    let orientations = emission.solved.turning.clone();
    let kept = if orientations.is_empty() { String::new() } else { format!("let {RATES} = v;\n") };
    let back = move |accelerations: String| match orientations.as_slice() {
        [] => accelerations,
        all => format!("lagrange::attitude::accelerations(q, {RATES}, v, {accelerations}, {all:?})"),
    };
    (kept + &entry(emission), back)
}

/// What gives a series of angular velocities its parameters and their rates.
pub(super) fn series(emission: &Emission<'_>) -> String {
    match emission.solved.turning.as_slice() {
        [] => String::new(),
        all => format!("lagrange::attitude::complete(series, orders, h, q, v, {all:?});\n"),
    }
}

/// What that takes, for the report.
pub(super) fn described(emission: &Emission<'_>) -> &'static str {
    if emission.solved.turning.is_empty() { "" } else { ", and 16 convolutions for each orientation" }
}
