//! The sweep against the plain sum, for every way to group products.

use super::*;
use crate::number::real::Dual;

/// A whole number that depends on everything, so that sums are exact.
fn entry(order: usize, product: usize, side: usize) -> f64 {
    ((order * 7 + product * 13 + side * 5) % 23) as f64 - 11.0
}

fn filled<const L: usize, const P: usize>() -> Tables<f64, L, P> {
    let mut tables = Tables::default();
    for order in 1..=P {
        let (left, right) = tables.row(order).unwrap();
        for product in 0..L {
            (left[product], right[product]) = (entry(order, product, 0), entry(order, product, 1));
        }
    }
    tables
}

fn sweeps<const L: usize, const P: usize>() {
    let tables = filled::<L, P>();
    for order in 1..=P + 1 {
        let found = tables.interior(order);
        for (product, found) in found.iter().enumerate() {
            let inner = 2..order.saturating_sub(1);
            let expected: f64 = inner.map(|j| entry(j, product, 0) * entry(order - j, product, 1)).sum();
            assert_eq!(*found, expected, "{L} products, order {order}, product {product}");
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

/// Products, squares among them.
struct Products;

impl Pairs<5> for Products {
    const FACTORS: &'static [[usize; 2]; 5] = &[[0, 1], [1, 1], [2, 0], [3, 5], [4, 4]];
}

/// `of` gives numbers by two entries each, `L` is the length of a row.
fn completes<R: Real, const L: usize, const P: usize>(of: impl Fn(f64, f64) -> R) {
    let mut tables = Tables::<R, L, P>::default();
    let number = |order, factor| of(entry(order, factor, 0), entry(order, factor, 1));
    let mut convolutions = Convolutions::<_, R, 6, 5, L, P>::new(&mut tables, Products);
    for order in 1..=P {
        let found = convolutions.sums(order);
        for (&[a, b], found) in Products::FACTORS.iter().zip(found) {
            let whole: R = (1..order).map(|j| number(j, a) * number(order - j, b)).sum();
            assert_eq!(found, whole, "{P}, order {order}, factors {a} and {b}");
        }
        convolutions.add(order, [0, 1, 2, 3, 4, 5].map(|factor| number(order, factor)));
    }
}

#[test]
fn the_outermost_terms_complete_the_sum() {
    completes::<f64, 8, 14>(|x, _| x);
    completes::<f64, 8, LOW>(|x, _| x);
    completes::<f64, 8, 5>(|x, _| x);
}

/// Rows of five have five factors on the left and one on the right.
#[test]
fn numbers_of_several_parts_store_each_factor_once() {
    let number = |x, slope| Dual { value: x, slopes: [slope] };
    assert!(is_wide::<Dual<f64, 1>>());
    completes::<Dual<f64, 1>, 5, 14>(number);
    completes::<Dual<f64, 1>, 8, LOW>(number);
    completes::<Dual<f64, 1>, 8, 5>(number);
    // Sums that take more than one sweep over the rows.
    assert!(together::<Dual<f64, 7>>() < 5);
    completes::<Dual<f64, 7>, 5, 14>(|x, slope| Dual { value: x, slopes: [slope; 7] });
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
    assert_eq!((index::<f64>(8), time(0.3, 1), time(0.3, 2)), (8.0, 0.3, 0.0));
}
