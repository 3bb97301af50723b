//! Falls of polynomials with known roots.

use super::*;

/// The product of all (root − θ), with this rounding error.
fn with_roots(roots: &[f64], noise: f64) -> Taylor<f64> {
    let mut terms = [0.0; TERMS];
    terms[0] = 1.0;
    for (degree, root) in roots.iter().enumerate() {
        for k in (0..=degree + 1).rev() {
            let below = if k > 0 { terms[k - 1] } else { 0.0 };
            terms[k] = root * terms[k] - below;
        }
    }
    let mut guard = Taylor::of(terms.into_iter());
    guard.error = noise;
    guard
}

fn first(roots: &[f64]) -> Option<f64> {
    falls(&with_roots(roots, 1e-16), Before::Unknown).map(|fall| fall.place)
}

#[test]
fn the_first_root_of_several() {
    for roots in [&[0.3][..], &[0.3, 0.7, 0.9], &[0.3, 0.300_1, 5.0], &[2.0, 0.3, 1.1, 3.0]] {
        let zero = first(roots).unwrap();
        assert!((zero - 0.3).abs() < 1e-11, "{roots:?}: {zero}");
    }
    assert_eq!(first(&[1.3, 1.5]), None);
    assert_eq!(first(&[-0.5, -0.3]), None);
}

#[test]
fn a_root_is_found_to_the_last_bits() {
    let mut guard = Taylor::of([0.5, 1.0, -3.0].into_iter());
    guard.error = 1e-16;
    let zero = falls(&guard, Before::Unknown).unwrap().place;
    assert!((zero - (1.0 + 7.0_f64.sqrt()) / 6.0).abs() < 2e-16);
}

#[test]
fn what_touches_zero_has_not_fallen() {
    assert_eq!(first(&[0.4, 0.4]), None);
    let touched = first(&[0.4, 0.4, 0.8]).unwrap();
    assert!((touched - 0.8).abs() < 1e-13, "{touched}");
}

#[test]
fn what_starts_at_zero_rises_first() {
    // A flight, from a little below zero for rounding.
    for start in [0.0, -3e-17, 3e-17] {
        let mut guard = Taylor::of([start, 1.0, -2.0].into_iter());
        guard.error = 1e-16;
        for before in [Before::Unknown, Before::Zero] {
            let zero: f64 = falls(&guard, before).unwrap().place;
            assert!((zero - 0.5).abs() <= f64::EPSILON, "{zero}");
        }
    }
    // What falls at once, and what rounding lets fall.
    let mut guard = Taylor::of([0.0, -1.0].into_iter());
    guard.error = 1e-16;
    assert!(falls(&guard, Before::Zero).unwrap().place < 1e-14);
    let mut guard = Taylor::of([0.0, -1e-18, 1.0, -4.0].into_iter());
    guard.error = 1e-16;
    let zero: f64 = falls(&guard, Before::Zero).unwrap().place;
    assert!((zero - 0.25).abs() < 1e-15, "{zero}");
    // What was below zero at the start has fallen before.
    let mut guard = Taylor::of([-1e-3, 1.0].into_iter());
    guard.error = 1e-16;
    assert_eq!(falls(&guard, Before::Unknown), Some(Fall { place: 0.0, fallen: 0.0 }));
}

#[test]
fn a_truncated_series_reaches_as_far_as_it_converges() {
    // sin aθ to order 25.
    let sine = |a: f64| {
        let mut term = 1.0;
        let terms = (0..26).map(move |order| {
            if order > 0 {
                term *= a / f64::from(order);
            }
            [0.0, term, 0.0, -term][order as usize % 4]
        });
        Taylor::of(terms)
    };
    let reach = reach(&sine(30.0), 25, 1e-15);
    assert!(reach > 0.05 && reach < 0.6, "{reach}");
    let part = sine(27.0 * reach);
    assert_eq!(super::reach(&part, 25, 1e-15), 1.0);
    assert!((part.at(0.9) - (24.3 * reach).sin()).abs() < 1e-13);
    // One that ends before has left nothing out.
    assert_eq!(super::reach(&Taylor::of([1.0, -50.0, 30.0].into_iter()), 25, 1e-15), 1.0);
}

#[test]
fn what_stays_above_is_told_from_what_falls() {
    for roots in [&[1.3, 1.5][..], &[-0.5, -0.3], &[2.0]] {
        let guard = with_roots(roots, 1e-16);
        let is_above = guard.start() > 0.0;
        assert_eq!(stays_above(&guard), is_above, "{roots:?}");
    }
    for roots in [&[0.3][..], &[0.3, 0.7], &[0.4, 0.4], &[0.0], &[1.0]] {
        assert!(!stays_above(&with_roots(roots, 1e-16)), "{roots:?}");
    }
    // Nor does anything that roundings could let fall.
    assert!(!stays_above(&with_roots(&[1.3, 1.5], 10.0)));
}

#[test]
fn newtons_steps_end_where_roundings_decide() {
    // A polynomial of a high degree whose root lies far from one end of its bracket.
    let mut terms = [0.0; TERMS];
    let mut term = 1.0;
    for (order, to) in terms.iter_mut().enumerate().take(26) {
        if order > 0 {
            term *= 3.0 / order as f64;
        }
        *to = if order % 4 < 2 { term } else { -term };
    }
    // cos 3θ + sin 3θ falls at π/4.
    let mut guard = Taylor::of(terms.into_iter());
    guard.error = 1e-15;
    let place = falls(&guard, Before::Unknown).unwrap().place;
    assert!((place - core::f64::consts::FRAC_PI_4).abs() < 4e-15, "{place}");
}

#[test]
fn what_hovers_at_the_edge_of_its_roundings_is_decided_soon() {
    // Halves of what crosses that edge on each of its parts would be millions.
    let oscillation =
        [1.0, -128.0, 2688.0, -21504.0, 84480.0, -180224.0, 212992.0, -131072.0, 32768.0].map(|c| 1e-17 * c);
    let mut guard = Taylor::of(oscillation.into_iter());
    guard.coefficients[0] -= 1e-16;
    guard.error = 1e-16;
    assert_eq!(falls(&guard, Before::Zero), None);
    // What leaves it has fallen.
    guard.coefficients[1] -= 1e-14;
    assert!(falls(&guard, Before::Zero).is_some());
}

#[test]
fn what_is_nothing_but_roundings_is_clear_everywhere() {
    // Contacts that rest on each other have such gaps: shorter parts show nothing, and steps would be
    // millions of them.
    let mut guard = Taylor::of([0.0, 0.0, 1e-17].into_iter());
    guard.error = 1e-16;
    assert_eq!(clear(&guard, guard.error), 1.0);
    // What shows is looked at on shorter parts, until it does no more.
    guard.error = 1e-19;
    assert_eq!(clear(&guard, guard.error), 0.0625);
}

#[test]
fn what_rises_from_zero_is_told_from_what_comes_back() {
    // From zero, or a rounding beside it.
    for start in [0.0, 1e-17, -1e-17] {
        let along = |roots: &[f64], error| {
            let mut guard = with_roots(roots, 0.0).scaled(-1.0);
            (guard.coefficients[0], guard.error) = (start, error);
            guard
        };
        let begins = if start < 0.0 { Before::Zero } else { Before::Unknown };
        assert!(rises(&along(&[0.0, 1.5], 1e-3), begins));
        assert!(rises(&along(&[0.0, 1.5, 1.7], 1e-3), Before::Zero));
        assert!(!rises(&along(&[0.0, 0.9], 1e-3), begins));
        assert!(!rises(&along(&[0.0, 0.3, 0.9], 1e-3), begins));
        // It comes back to within its error.
        assert!(!rises(&along(&[0.0, 1.001], 1e-2), begins));
        assert_eq!(rises(&along(&[0.0, 1.5], 1e-3), Before::Unknown), start >= 0.0);
    }
    assert!(!rises(&Taylor::<f64>::constant(0.0), Before::Zero));
}

#[test]
fn what_is_zero_all_the_time_never_falls() {
    for noise in [0.0, 1e-16] {
        let mut guard = Taylor::of([0.0; 4].into_iter());
        guard.error = noise;
        for before in [Before::Unknown, Before::Zero] {
            assert!(falls(&guard, before).is_none(), "{noise:e}");
        }
    }
}

#[test]
fn what_has_been_above_zero_falls_where_its_polynomial_does() {
    // Less deep than the bound of its roundings.
    let mut guard = with_roots(&[0.4, 0.6], 0.1);
    guard.coefficients[0] += 0.01 - 1e-9;
    assert!(starts_above(&guard) && falls(&guard, Before::Unknown).is_none());
    let fall = falls(&guard, Before::Above).unwrap();
    assert!((fall.place - 0.5).abs() < 1e-4, "{fall:?}");
    guard.coefficients[0] += 2e-9;
    assert!(falls(&guard, Before::Above).is_none());
}

#[test]
fn what_touches_zero_within_its_error_does_so_where_it_is_least() {
    for place in [0.1, 0.35, 0.5, 0.97] {
        let guard = |above: f64| {
            let mut guard = with_roots(&[place, place], 1e-8);
            guard.coefficients[0] += above;
            guard
        };
        let found = touches(&guard(1e-9)).unwrap();
        assert!((found - place).abs() < 1e-12, "{found} instead of {place}");
        assert_eq!(touches(&guard(1e-7)), None);
    }
    // At the end it still falls: whether it touches shows later.
    assert_eq!(touches(&with_roots(&[1.0 + 1e-9], 1e-8)), None);
    assert_eq!(touches(&with_roots(&[1.0 + 1e-5, 1.0 + 1e-5], 1e-8)), None);
}
