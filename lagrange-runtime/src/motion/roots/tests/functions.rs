//! Functions that are no polynomials, other scalars, and the cases at the ends of a step.

use super::*;

fn zeros<R: Ordered>(start: Memory, g: impl FnMut(R) -> R) -> std::vec::Vec<Zero<R>> {
    Polynomial::interpolate(R::one(), g).expect("a smooth function").zeros(start, R::one()).collect()
}

/// All zeros of sin(ωθ + φ), to the last bits.
fn sines<R: Ordered>(frequency: f64, tolerance: f64, value: impl Fn(R) -> f64) {
    let mut random = Random(7);
    for _ in 0..500 {
        let phase = (random.unit() * 400.0).floor() / 64.0;
        let g = |theta: R| (R::from_f64(frequency) * theta + R::from_f64(phase)).sin();
        let pi = core::f64::consts::PI;
        let roots = (0..40).map(|k| ((f64::from(k) * pi - phase) / frequency, k % 2 == 0));
        let roots: Vec<_> = roots.filter(|(root, _)| (0.0..=1.0).contains(root)).collect();
        let found = zeros(Memory::Unknown, g);
        assert_eq!(found.len(), roots.len(), "{phase}");
        for (zero, (root, rises)) in found.iter().zip(roots) {
            assert_eq!(zero.kind, if rises { Kind::Rising } else { Kind::Falling }, "{phase}");
            assert!((value(zero.theta) - root).abs() < 30.0 * tolerance, "{phase} {zero:?} {root}");
            let polished = value(zero.polish(g));
            assert!((polished - root).abs() <= tolerance, "{phase} {polished} {root}");
        }
    }
}

#[test]
#[ignore = "seconds; `scripts/check.sh features`"]
fn oscillations_in_double_precision() {
    sines(40.0, 4e-16, |theta: f64| theta);
}

#[test]
fn oscillations_in_single_precision() {
    sines(20.0, 2e-7, |theta: f32| theta.into());
}

#[cfg(feature = "double-double")]
#[test]
fn roots_to_thirty_digits() {
    use crate::{DoubleDouble, One, Real};
    let three = DoubleDouble::from_f64(3.0);
    let g = |theta: DoubleDouble| three * theta * theta - DoubleDouble::one();
    let [zero] = zeros(Memory::Unknown, g)[..] else { panic!("one zero") };
    let error = (zero.polish(g) * three.sqrt() - DoubleDouble::one()).abs();
    assert!(error < DoubleDouble::from_f64(1e-30), "{error:?}");
    // Two roots that doubles cannot tell apart: their distance is 2e-10.
    let pair = |theta: DoubleDouble| {
        let from_third = theta - DoubleDouble::one() / three;
        from_third * from_third - DoubleDouble::from_f64(1e-20)
    };
    assert_eq!(kinds(zeros(Memory::Unknown, pair).into_iter()), [1, 1, 0]);
    assert_eq!(kinds(zeros(Memory::Unknown, |theta: f64| pair(theta.into()).high()).into_iter()), [0, 0, 1]);
}

#[test]
fn exponentials() {
    let mut random = Random(3);
    for _ in 0..1000 {
        let root = random.unit();
        for (sign, kind) in [(1.0, Kind::Rising), (-1.0, Kind::Falling)] {
            let g = |theta: f64| sign * ((3.0 * theta).exp() - (3.0 * root).exp());
            let [zero] = zeros(Memory::Unknown, g)[..] else { panic!("one zero at {root}") };
            assert_eq!(zero.kind, kind);
            assert!((zero.polish(g) - root).abs() < 1e-15, "{zero:?} {root}");
        }
    }
}

#[test]
fn roots_of_any_order() {
    for (order, kind) in (1..=9).zip([Kind::Rising, Kind::Grazing].into_iter().cycle()) {
        // At an end of the step the kind of a root of the highest orders is not known: it would show too far
        // outside.
        let roots = if order < 6 { &[0.0, 0.3, 0.5, 0.7, 1.0][..] } else { &[0.3, 0.5, 0.7][..] };
        for &root in roots {
            let found = zeros(Memory::Unknown, |theta: f64| (theta - root).powi(order));
            let [zero] = found[..] else { panic!("{order} {root} {found:?}") };
            assert_eq!(zero.kind, kind, "{order} {root}");
            // Noise to the power 1/n.
            let bound = 1.2 * 1e-14_f64.powf(1.0 / f64::from(order));
            assert!((zero.theta - root).abs() < bound, "{order} {root} {zero:?}");
        }
    }
}

#[test]
fn nothing_without_zeros() {
    assert!(zeros(Memory::Unknown, |_: f64| 0.0).is_empty());
    assert!(zeros(Memory::Unknown, |_: f64| 3.0).is_empty());
    assert!(zeros(Memory::Side(Side::Below), |theta: f64| -1e-3 - theta).is_empty());
    assert!(zeros(Memory::Unknown, |theta: f64| 1e-16 * (1e9 * theta).sin()).is_empty());
    assert!(zeros(Memory::Side(Side::Above), |theta: f64| 1e-16 * (1e9 * theta).sin()).is_empty());
    assert!(zeros(Memory::Unknown, |theta: f64| (theta - 0.3) * (theta - 0.3) + 1e-12).is_empty());
}

#[test]
fn what_no_polynomial_resolves() {
    let unresolved = |g: fn(f64) -> f64| Polynomial::interpolate(1.0, g).map(|_| ()).unwrap_err();
    assert_eq!(unresolved(|theta| (theta - 0.3).abs() - 0.1), Unresolved::Degree);
    assert_eq!(unresolved(|theta| (200.0 * theta).sin()), Unresolved::Degree);
    assert_eq!(unresolved(|theta| theta.ln()), Unresolved::NotFinite);
    assert_eq!(unresolved(|theta| (theta - 0.5).sqrt()), Unresolved::NotFinite);
}

#[test]
fn an_oscillation_through_all_nodes_is_seen() {
    // T₁₆ is 1 at the nine nodes of degree 8, T₃₂ at those of degree 16 as well.
    for (degree, half) in [(16.0, 8), (32.0, 16)] {
        let found = zeros(Memory::Unknown, |theta: f64| (degree * (2.0 * theta - 1.0).acos()).cos());
        assert_eq!(kinds(found.into_iter()), [half, half, 0]);
    }
}

#[test]
fn roundings_that_the_size_does_not_tell() {
    let mut random = Random(5);
    for _ in 0..200 {
        let root = random.unit();
        let found = zeros(Memory::Unknown, |theta: f64| theta - root + 1e-13 * (random.unit() - 0.5));
        assert_eq!(kinds(found.into_iter()), [1, 0, 0], "{root}");
    }
}

#[test]
fn the_ends_of_a_step() {
    let start = |theta: f64| theta;
    let end = |theta: f64| 1.0 - theta;
    assert_eq!(kinds(zeros(Memory::Unknown, start).into_iter()), [1, 0, 0]);
    assert_eq!(kinds(zeros(Memory::Side(Side::Below), start).into_iter()), [1, 0, 0]);
    assert_eq!(kinds(zeros(Memory::Touching(Side::Above), start).into_iter()), [0, 0, 1]);
    for counted in [Memory::Zero(None), Memory::Zero(Some(Side::Above)), Memory::Side(Side::Above)] {
        assert!(zeros(counted, start).is_empty(), "{counted:?}");
    }
    let [zero] = zeros(Memory::Unknown, end)[..] else { panic!("one zero") };
    assert_eq!((zero.theta, zero.kind, zero.side), (1.0, Kind::Falling, Side::Below));
    // A guard on the wrong side falls at once.
    let [zero] = zeros(Memory::Side(Side::Above), |theta: f64| -1.0 - theta)[..] else { panic!("one zero") };
    assert_eq!((zero.theta, zero.kind), (0.0, Kind::Falling));
}

#[test]
fn the_way_between_two_zeros_may_be_short() {
    // A bounce of a ball that lasts ever shorter parts of the step.
    let mut length = 0.9;
    while length > 1e-22 {
        let found = zeros(Memory::Zero(Some(Side::Above)), |theta: f64| theta * (length - theta));
        let [zero] = found[..] else { panic!("{length} {found:?}") };
        assert_eq!(zero.kind, Kind::Falling);
        let error = (zero.theta - length).abs();
        assert!(error <= 0.3 * length.max(1e-14), "{length} {zero:?}");
        length *= 0.5;
    }
}

#[test]
fn a_direction() {
    let polynomial = Polynomial::interpolate(1.0, |theta: f64| (20.0 * theta + 1.0).sin()).expect("smooth");
    let first = |kind| polynomial.first(kind, Memory::Unknown).expect("a zero").theta;
    let pi = core::f64::consts::PI;
    assert!((first(Kind::Falling) - (pi - 1.0) / 20.0).abs() < 1e-14);
    assert!((first(Kind::Rising) - (2.0 * pi - 1.0) / 20.0).abs() < 1e-14);
}
