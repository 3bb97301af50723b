//! The sweep against the sum as it is written, in every way in which lanes are grouped.

use super::*;

/// A whole number that depends on everything, so that sums are exact.
fn entry(order: usize, lane: usize, side: usize) -> f64 {
    ((order * 7 + lane * 13 + side * 5) % 23) as f64 - 11.0
}

fn filled<const L: usize>() -> Tables<f64, L, 9> {
    let mut tables = Tables::default();
    for order in 1..=9 {
        let (left, right) = tables.row(order).unwrap();
        for lane in 0..L {
            (left[lane], right[lane]) = (entry(order, lane, 0), entry(order, lane, 1));
        }
    }
    tables
}

fn sweeps<const L: usize>() {
    let tables = filled::<L>();
    for order in 1..=10 {
        let found = tables.interior(order);
        for (lane, found) in found.iter().enumerate() {
            let inner = 2..order.saturating_sub(1);
            let expected: f64 = inner.map(|j| entry(j, lane, 0) * entry(order - j, lane, 1)).sum();
            assert_eq!(*found, expected, "{L} lanes, order {order}, lane {lane}");
        }
    }
}

#[test]
fn the_sweep_is_the_convolution() {
    sweeps::<4>();
    sweeps::<12>();
    sweeps::<16>();
}

#[test]
fn the_outermost_terms_complete_the_sum() {
    let tables = filled::<4>();
    let (mut firsts, mut lasts) = ([[0.0; 2]; 4], [[0.0; 2]; 4]);
    for order in 1..=9 {
        let inner = tables.interior(order);
        for lane in 0..4 {
            let [first, last] = [firsts[lane], lasts[lane]];
            let whole: f64 = (1..order).map(|j| entry(j, lane, 0) * entry(order - j, lane, 1)).sum();
            assert_eq!(first[0] * last[1] + first[1] * last[0] + inner[lane], whole, "order {order}");
            for side in 0..2 {
                let coefficient = entry(order, lane, side);
                (firsts[lane][side], lasts[lane][side]) =
                    (super::first(order, first[side], coefficient), coefficient);
            }
        }
    }
}

#[test]
fn there_is_no_row_beyond_the_last() {
    assert!(filled::<4>().row(10).is_none());
}

#[test]
fn rates_are_rounded_once() {
    for order in 1..=40 {
        assert_eq!(rate(0.3, order), 0.3 / order as f64);
    }
    assert_eq!((ramp(3, 0.5), index::<f64>(8)), (1.5, 8.0));
}
