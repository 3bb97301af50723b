//! The sweep against the sum as it is written, in every way in which lanes are grouped.

use super::*;

/// A whole number that depends on everything, so that sums are exact.
fn entry(order: usize, lane: usize, side: usize) -> f64 {
    ((order * 7 + lane * 13 + side * 5) % 23) as f64 - 11.0
}

fn filled<const L: usize, const P: usize>() -> Tables<f64, L, P> {
    let mut tables = Tables::default();
    for order in 1..=P {
        let (left, right) = tables.row(order).unwrap();
        for lane in 0..L {
            (left[lane], right[lane]) = (entry(order, lane, 0), entry(order, lane, 1));
        }
    }
    tables
}

fn sweeps<const L: usize, const P: usize>() {
    let tables = filled::<L, P>();
    for order in 1..=P + 1 {
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
    sweeps::<4, 9>();
    sweeps::<12, 9>();
    sweeps::<16, 9>();
    sweeps::<4, LOW>();
    sweeps::<16, 3>();
}

fn completes<const P: usize>() {
    let tables = filled::<4, P>();
    let (mut firsts, mut lasts) = ([[0.0; 2]; 4], [[0.0; 2]; 4]);
    for order in 1..=P {
        let inner = tables.interior(order);
        for lane in 0..4 {
            let [left, right] = [0, 1].map(|side| [firsts[lane][side], lasts[lane][side]]);
            let whole: f64 = (1..order).map(|j| entry(j, lane, 0) * entry(order - j, lane, 1)).sum();
            assert_eq!(convolution::<P, _>(order, left, right, inner[lane]), whole, "{P}, order {order}");
            let inner = (2..order.saturating_sub(1)).map(|j| entry(j, lane, 0) * entry(order - j, lane, 0));
            let whole: f64 = (1..order).map(|j| entry(j, lane, 0) * entry(order - j, lane, 0)).sum();
            assert_eq!(squared::<P, _>(order, left, inner.sum()), whole, "{P}, order {order}");
            for side in 0..2 {
                let coefficient = entry(order, lane, side);
                (firsts[lane][side], lasts[lane][side]) =
                    (first::<P, _>(order, firsts[lane][side], coefficient), coefficient);
            }
        }
    }
}

#[test]
fn the_outermost_terms_complete_the_sum() {
    completes::<9>();
    completes::<LOW>();
    completes::<5>();
}

#[test]
fn there_is_no_row_beyond_the_last() {
    assert!(filled::<4, 9>().row(10).is_none());
}

#[test]
fn rates_are_rounded_once() {
    for order in 1..=40 {
        assert_eq!(rate(0.3, order), 0.3 / order as f64);
    }
    assert_eq!((ramp(3, 0.5), index::<f64>(8)), (1.5, 8.0));
}
