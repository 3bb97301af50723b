//! Which places of a step are visited.

use super::*;
use std::vec::Vec;

/// The places that are visited on a step of length one.
fn visited(kind: Hidden, argument: impl Fn(f64) -> f64) -> Vec<f64> {
    let values = array(|index| argument(sample(index) / PLACES as f64));
    let mut visited = Vec::new();
    Argument { kind, value_at: &argument }.places(values, 1.0, &mut |theta| visited.push(theta));
    visited
}

#[test]
fn narrow_functions_are_met_on_both_sides_of_their_middle() {
    for width in [1e-2, 1e-5, 1e-9] {
        for middle in [0.003, 0.1, 0.5, 0.77, 0.995] {
            // A bend of the argument between the places.
            let bent = |t: f64| t + 0.3 * t * t;
            let along = |t: f64| (bent(t) - bent(middle)) / width;
            let found = visited(Hidden::Argument, along);
            let signs = [-1.0, 1.0].into_iter().filter(|&sign| along(0.0) < sign && sign < along(1.0));
            assert_eq!(found.len(), signs.clone().count(), "{width} {middle}");
            for (theta, sign) in found.iter().zip(signs) {
                assert!((along(*theta) - sign).abs() < 0.3, "{width} {middle}: {}", along(*theta));
            }
            // The first or last place sees one that is so near.
            if along(0.0).abs().min(along(1.0).abs()) < 1.0 {
                continue;
            }
            let found = visited(Hidden::Argument, |t| -along(t).powi(2));
            assert!(!found.is_empty() && found.len() % 3 == 0, "{width} {middle}");
            for (theta, expected) in found.iter().zip([0.0, 1.0, 1.0].into_iter().cycle()) {
                assert!(
                    (along(*theta).abs() - expected).abs() < 0.3,
                    "{width} {middle} {found:?} {}",
                    along(*theta)
                );
            }
            let found = visited(Hidden::Base(1), |t| 1e-6 + 1e-6 * along(t).powi(2));
            assert!(found.iter().any(|&theta| along(theta).abs() < 0.3), "{width} {middle} {found:?}");
        }
    }
}

#[test]
fn a_step_to_or_from_the_middle_meets_the_side_that_it_passes() {
    for (middle, side) in [(1.0, -1.0), (1.0 + 1e-14, -1.0), (0.0, 1.0), (-1e-14, 1.0), (3.0 / 7.0, -1.0)] {
        let along = |t: f64| (t - middle) / 1e-6;
        let found = visited(Hidden::Argument, along);
        assert!(found.iter().any(|&theta| (along(theta) - side).abs() < 0.3), "{middle} {found:?}");
    }
}

#[test]
fn wide_functions_are_left_to_the_places_of_the_step() {
    assert!(visited(Hidden::Argument, |t| 5.0 * (t - 0.4)).is_empty());
    assert!(visited(Hidden::Argument, |t| -(5.0 * (t - 0.4)).powi(2)).is_empty());
    assert!(visited(Hidden::Base(1), |t| 1.0 + (5.0 * (t - 0.4)).powi(2)).is_empty());
}

#[test]
fn all_passages_of_an_argument_that_varies_fast_are_met() {
    let along = |t: f64| (20.0 * t + 0.1).sin() / 1e-6;
    let zeros = 1..=6;
    let found = visited(Hidden::Argument, along);
    for zero in zeros.clone() {
        let place = (f64::from(zero) * core::f64::consts::PI - 0.1) / 20.0;
        assert!(found.iter().filter(|&&theta| (theta - place).abs() < 1e-6).count() >= 2, "{zero} {found:?}");
    }
    let found = visited(Hidden::Argument, |t| -along(t).powi(2));
    for zero in zeros {
        let place = (f64::from(zero) * core::f64::consts::PI - 0.1) / 20.0;
        assert!(found.iter().filter(|&&theta| (theta - place).abs() < 1e-6).count() >= 3, "{zero} {found:?}");
    }
}

#[test]
fn an_argument_that_comes_back_between_two_places_is_met_where_it_passes_zero() {
    let along = |t: f64| 1e9 * ((t - 0.52).powi(2) - 1e-4);
    let found = visited(Hidden::Argument, along);
    let near = |place: f64| found.iter().filter(|&&theta| (theta - place).abs() < 1e-4).count();
    assert!([0.51, 0.52, 0.53].into_iter().all(|place| near(place) >= 2), "{found:?}");
}

#[test]
fn the_zero_of_a_root_is_met_on_both_sides() {
    for place in [0.05, 0.31, 0.5, 0.93] {
        for value in [|t: f64| t, |t: f64| t.powi(3), |t: f64| t.exp_m1(), |t: f64| -t * (3.0 + t)] {
            let along = |t: f64| value(t - place);
            let found = visited(Hidden::Root, along);
            // Beside each other, up to what time resolves.
            let are_beside = |pair: &[f64]| {
                (pair[0] - pair[1]).abs() <= 2.0 * f64::EPSILON && along(pair[0]) * along(pair[1]) <= 0.0
            };
            assert!(
                found.windows(2).any(are_beside),
                "{place}: {found:?} {:?}",
                found.iter().map(|&t| along(t)).collect::<Vec<_>>()
            );
        }
    }
}
