//! Lengths that follow from the terms of a series.

use super::*;

/// A series to order 20 whose terms are to fall by half from each to the next.
fn memory() -> JetsMemory<(), (), f64, 1> {
    let start = State::new([0.0], [0.0]);
    JetsMemory { orders: 20, steepest: 0.5, ..JetsMemory::new((), start, &[]) }
}

#[test]
fn a_term_of_the_upper_half_that_is_too_large_shortens_the_step_to_where_it_is_not() {
    let memory = memory();
    for (large, length) in [(18, 0.25_f64.powf(1.0 / 18.0)), (12, 0.5_f64.powf(8.0 / 12.0)), (10, 0.5)] {
        let found = memory.bounded(1.0, |order| if order == large { 1.0 } else { 0.0 });
        assert!((found - length).abs() < 1e-14, "{large}: {found}");
    }
}

#[test]
fn terms_that_fall_as_fast_as_they_are_to_leave_the_length() {
    let memory = memory();
    // A little below the limit, because powers are rounded.
    assert_eq!(memory.bounded(1.0, |order| 0.999 * 0.5_f64.powi(20 - order as i32)), 1.0);
    // The lower half is the motion itself.
    assert_eq!(memory.bounded(1.0, |order| if order < 10 { 1e3 } else { 0.0 }), 1.0);
}

#[test]
fn states_inside_a_step_begin_with_what_rounding_took() {
    let mut memory = memory();
    (memory.start, memory.unit) = (State::new([1.0], [0.0]), 1.0);
    memory.end = memory.start.at_time(1.0);
    memory.series.q[0] = [0.9 * f64::EPSILON];
    // Each addition is less than half an ulp. With the residue they count.
    assert_eq!(memory.at_part(0.5).q, [1.0]);
    memory.residue.q = [0.1 * f64::EPSILON];
    assert_eq!(memory.at_part(0.5).q, [1.0 + f64::EPSILON]);
}
