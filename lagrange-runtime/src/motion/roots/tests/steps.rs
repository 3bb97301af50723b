//! A function cut into steps, walked over as a simulation does: each zero counts once.

use super::*;

/// The zeros in [0, 1] of `g`, in steps that end at `cuts` and at each zero.
fn walk(size: f64, cuts: &[f64], mut g: impl FnMut(f64) -> f64) -> Vec<(f64, Kind)> {
    let (mut now, mut memory, mut found) = (0.0, Memory::Unknown, Vec::new());
    let mut ends = cuts.to_vec();
    ends.extend([0.0, 1.0]);
    ends.sort_by(f64::total_cmp);
    ends.reverse();
    while let Some(&end) = ends.last() {
        if end <= now {
            ends.pop();
            continue;
        }
        let length = end - now;
        let mut here = |theta: f64| g(now + length * theta);
        let polynomial = match Polynomial::interpolate(size, &mut here) {
            Ok(polynomial) => polynomial,
            Err(Unresolved::Degree) => {
                assert!(length > 1e-9, "{now}");
                ends.push(now + 0.5 * length);
                continue;
            }
            Err(error) => panic!("{error:?} at {now}"),
        };
        let mut zeros = polynomial.zeros(memory, 1.0);
        match zeros.next() {
            Some(zero) => {
                let theta = zero.polish(&mut here);
                found.push((now + length * theta, zero.kind));
                memory = zero.memory();
                now = if theta == 1.0 { end } else { now + length * theta };
            }
            None => {
                memory = zeros.memory();
                now = end;
            }
        }
        assert!(found.len() < 200, "zeros without end at {now}");
    }
    found
}

/// Cuts anywhere, at some roots, and beside some of them by anything from 1e-17 to 1e-2.
fn cuts(random: &mut Random, roots: &[f64]) -> Vec<f64> {
    let mut cuts: Vec<f64> = (0..random.below(8)).map(|_| random.unit()).collect();
    for &root in roots {
        for _ in 0..random.below(3) {
            let beside = 10_f64.powf(-2.0 - 15.0 * random.unit());
            cuts.push(root + [0.0, beside, -beside][random.below(3)]);
        }
    }
    cuts.retain(|cut| (0.0..=1.0).contains(cut));
    cuts
}

/// Roots far enough from each other that the noise does not decide, each with its order.
fn separated(random: &mut Random, count: usize) -> Vec<(f64, usize)> {
    let gap = 1.0 / (count + 1) as f64;
    let place = |i: usize, part: f64| (i as f64 + 0.75 + 0.5 * part) * gap;
    (0..count).map(|i| (place(i, random.unit()), 1 + random.below(8) / 5 * (1 + random.below(2)))).collect()
}

fn check_walks(count: usize, noise: f64) {
    let mut random = Random(0x0123_4567_89ab_cdef);
    for _ in 0..count {
        let roots = {
            let count = 1 + random.below(5);
            separated(&mut random, count)
        };
        let places: Vec<f64> = roots.iter().map(|root| root.0).collect();
        let product = Product {
            scale: 1.0,
            roots: roots.iter().flat_map(|&(root, order)| std::iter::repeat_n(root, order)).collect(),
            pairs: Vec::new(),
        };
        let largest = (0..=100).map(|i| product.value(f64::from(i) / 100.0).abs()).fold(0.0, f64::max);
        let g = |theta: f64| product.value(theta) / largest;
        let slope = |root: f64| product.leading_at(root) / largest;
        let cuts = cuts(&mut random, &places);
        let mut roundings = Random(random.bits() | 1);
        let found = walk(40.0, &cuts, |theta| g(theta) + noise * (roundings.unit() - 0.5));
        let mut side = g(0.0).signum();
        let expected = roots.iter().map(|&(_, order)| {
            side = if order % 2 == 1 { -side } else { side };
            match (order % 2, side > 0.0) {
                (0, _) => Kind::Grazing,
                (_, true) => Kind::Rising,
                (_, false) => Kind::Falling,
            }
        });
        let kinds: Vec<_> = found.iter().map(|zero| zero.1).collect();
        assert_eq!(kinds, expected.collect::<Vec<_>>(), "{roots:?}\n{cuts:?}\n{found:?}");
        for ((time, _), (root, order)) in found.iter().zip(&roots) {
            let bound = (1.5e-13 / slope(*root)).powf(1.0 / *order as f64);
            assert!((time - root).abs() < bound, "{roots:?}\n{cuts:?}\n{found:?}");
        }
    }
}

#[test]
fn steps_cut_anywhere_and_at_roots() {
    check_walks(3000, 0.0);
}

#[test]
fn steps_cut_anywhere_with_roundings_of_their_own() {
    check_walks(3000, 4e-15);
}

#[test]
#[ignore = "minutes; for releases"]
fn many_steps_cut_anywhere() {
    check_walks(300_000, 4e-15);
}

#[test]
fn what_no_single_polynomial_resolves_is_halved() {
    let mut random = Random(11);
    for _ in 0..300 {
        let height = 0.05 + 0.94 * random.unit();
        let g = |theta: f64| 1.0 / (1.0 + 25.0 * (2.0 * theta - 1.0) * (2.0 * theta - 1.0)) - height;
        let half = 0.5 * (((1.0 / height) - 1.0) / 25.0).sqrt();
        let cuts = cuts(&mut random, &[0.5 - half, 0.5 + half, 0.5]);
        let found = walk(2.0, &cuts, g);
        let [(first, Kind::Rising), (second, Kind::Falling)] = found[..] else {
            panic!("{height} {found:?}")
        };
        assert!((first - (0.5 - half)).abs() < 1e-14 && (second - (0.5 + half)).abs() < 1e-14);
    }
    let top = |height: f64| {
        move |theta: f64| 1.0 / (1.0 + 25.0 * (2.0 * theta - 1.0) * (2.0 * theta - 1.0)) - height
    };
    for cuts in [&[][..], &[0.5], &[0.499_999_999], &[0.25, 0.500_000_001, 0.75]] {
        assert_eq!(walk(2.0, cuts, top(1.0)).iter().map(|zero| zero.1).collect::<Vec<_>>(), [Kind::Grazing]);
        let two = walk(2.0, cuts, top(1.0 - 1e-13));
        assert_eq!(two.iter().map(|zero| zero.1).collect::<Vec<_>>(), [Kind::Rising, Kind::Falling]);
        assert!(walk(2.0, cuts, top(1.0 + 1e-13)).is_empty());
    }
}

#[test]
#[ignore = "seconds; `scripts/check.sh features`"]
fn a_step_that_ends_before_its_polynomial() {
    let mut random = Random(17);
    let pi = core::f64::consts::PI;
    for _ in 0..2000 {
        let phase = 0.1 + 0.8 * random.unit();
        let beside = 10_f64.powf(-2.0 - 14.0 * random.unit());
        let nearest = (f64::from(1 + random.below(9) as u32) * pi - phase) / 30.0;
        let cut = nearest + [0.0, beside, -beside][random.below(3)];
        let g = |time: f64| (30.0 * time + phase).sin();
        let whole = Polynomial::interpolate(30.0, g).expect("smooth");
        let mut first = whole.zeros(Memory::Unknown, cut);
        let before = kinds(first.by_ref());
        let rest = Polynomial::interpolate(30.0, |theta| g(cut + (1.0 - cut) * theta)).expect("smooth");
        let after = kinds(rest.zeros(first.memory(), 1.0));
        let all = kinds(whole.zeros(Memory::Unknown, 1.0));
        assert_eq!([before[0] + after[0], before[1] + after[1], before[2] + after[2]], all, "{phase} {cut}");
        assert_eq!(all[2], 0);
    }
}

#[test]
fn a_long_oscillation() {
    let mut random = Random(13);
    let pi = core::f64::consts::PI;
    for _ in 0..50 {
        let phase = random.unit();
        let roots: Vec<f64> = (1..96).map(|k| (f64::from(k) * pi - phase) / 300.0).collect();
        let roots: Vec<f64> = roots.into_iter().filter(|root| *root < 1.0).collect();
        let cuts = cuts(&mut random, &roots);
        let found = walk(300.0, &cuts, |theta| (300.0 * theta + phase).sin());
        assert_eq!(found.len(), roots.len(), "{phase} {cuts:?}");
        for ((time, _), root) in found.iter().zip(&roots) {
            assert!((time - root).abs() < 4e-15, "{time} {root}");
        }
    }
}
