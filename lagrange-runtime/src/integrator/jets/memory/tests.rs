//! States inside a step, and lengths and weights that follow from the terms of a series.

use super::*;

/// A series to order 20.
fn memory() -> JetsMemory<(), (), f64, 1> {
    let start = State::new([0.0], [0.0]);
    JetsMemory { orders: 20, ..JetsMemory::new((), start, &[]) }
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

/// 2 + 3 θ − θ² in units of −0.5 s from t = 1, up to t = 0.25.
fn backward() -> JetsMemory<(), (), f64, 1> {
    let mut memory = memory();
    (memory.start, memory.unit) = (State::new([2.0], [-6.0]).at_time(1.0), -0.5);
    (memory.series.q[0], memory.series.q[1]) = ([3.0], [-1.0]);
    // By time, the derivative is −2 (3 − 2 θ).
    memory.series.v[0] = [4.0];
    memory.reach(1.5);
    memory
}

#[test]
fn every_way_into_a_step_leads_to_the_same_states() {
    let memory = backward();
    let expected = |theta: f64| State::new([2.0 + 3.0 * theta - theta * theta], [-6.0 + 4.0 * theta]);
    assert_eq!(memory.end, expected(1.5).at_time(0.25));
    for part in [0.0, 0.25, 0.5, 1.0] {
        let (theta, t) = (1.5 * part, 1.0 - 0.75 * part);
        assert_eq!(memory.at_part(part), expected(theta).at_time(t), "{part}");
        assert_eq!(memory.at(t), expected(theta).at_time(t), "{part}");
        assert_eq!(memory.state_at(theta), expected(theta).at_time(t), "{part}");
    }
    let terms = memory.terms(|_| [&[][..]; 2]);
    assert_eq!((terms.length, terms.unit, terms.q.len(), terms.v.len()), (1.5, -0.5, 20, 20));
}

#[test]
fn a_step_that_is_turned_about_leads_to_the_same_states() {
    let (mut turned, memory) = (backward(), backward());
    turned.turn();
    for theta in [-1.0, 0.5, 1.5] {
        assert_eq!(turned.state_at(theta), memory.state_at(-theta), "{theta}");
    }
}

#[test]
fn times_are_told_apart_in_the_direction_of_the_step() {
    let memory = backward();
    for (t, covers, ahead) in
        [(1.1, false, false), (1.0, true, false), (0.5, true, false), (0.25, true, true), (0.2, false, true)]
    {
        assert_eq!((memory.covers(t), memory.ahead(t)), (covers, ahead), "{t}");
    }
    let mut forward = backward();
    (forward.start.t, forward.end.t) = (0.25, 1.0);
    for (t, ahead) in [(0.2, false), (0.5, false), (1.0, true), (1.1, true)] {
        assert_eq!(forward.ahead(t), ahead, "{t}");
    }
    // A step of no length has all times ahead.
    forward.end.t = 0.25;
    assert!(forward.ahead(0.2) && forward.ahead(0.3));
}

#[test]
fn a_time_inside_is_counted_from_the_exact_start() {
    let mut memory = backward();
    // What rounding took from the time of the start belongs to it.
    memory.residue.t = -0.125;
    assert_eq!(memory.at(0.5).q, [2.0 + 3.0 * 0.75 - 0.75 * 0.75]);
    assert_eq!(memory.terms(|_| [&[][..]; 2]).residue, -0.125);
}

#[test]
fn the_last_terms_at_a_scaled_time_are_powers_of_it() {
    let mut memory = memory();
    (memory.series.q[19], memory.series.q[18], memory.series.v[19]) = ([3.0], [5.0], [7.0]);
    let [last, before] = memory.last_terms(2.0);
    assert_eq!((last.q, last.v), ([3.0 * 2.0_f64.powi(20)], [7.0 * 2.0_f64.powi(20)]));
    // That before the last stands for one as large as it lets the last one be.
    assert_eq!(before.q, [5.0 * super::super::DECAY * 2.0_f64.powi(19)]);
}

#[test]
fn the_tolerance_of_a_number_is_relative_to_its_motion() {
    let mut memory = memory();
    let limits = Limits { relative: 1e-10, ..Limits::new() };
    let tolerated =
        |memory: &JetsMemory<(), (), f64, 1>, limits| memory.weights(&limits, 0.5, 0)[0][0].recip();
    let relative = 0.2e-10;
    let is_close =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-14, "{found:e} {expected:e}");
    // The coordinate, the way of the first term over a span of half a unit, that of the second one.
    for (q, first, second) in [(3.0, 0.0, 0.0), (0.0, -6.0, 0.0), (0.0, 0.0, 12.0)] {
        (memory.start.q, memory.series.q[0], memory.series.q[1]) = ([q], [first], [second]);
        is_close(tolerated(&memory, limits), relative * 3.0);
    }
    // An absolute tolerance is added, with the same margin.
    is_close(tolerated(&memory, Limits { absolute: Some(1e-9), ..limits }), relative * 3.0 + 0.2e-9);
    // Nothing is asked for below what is known through the constraints: an ulp, and less where the tolerance
    // is finer.
    memory.ulps = [[1e-9], [0.0]];
    is_close(tolerated(&memory, limits), 1e-9);
    is_close(tolerated(&memory, Limits { relative: 0.0, ..limits }), 1e-9 * 1e-3);
}

#[test]
fn the_order_follows_the_tolerance_from_the_first_step_on() {
    let mut memory = JetsMemory::<(), (), f64, 1>::new((), State::new([0.0], [0.0]), &[]);
    for relative in [1.0, 1e-10, 1e-6] {
        memory.prepare(&Limits { relative, ..Limits::new() });
        assert_eq!(memory.orders, orders(relative, ORDERS_PER_DIGIT), "{relative:e}");
    }
}

#[test]
fn numbers_that_a_retraction_leaves_keep_what_rounding_took() {
    let mut memory = JetsMemory::<(), (), f64, 2>::new((), State::new([1.0, 2.0], [3.0, 4.0]), &[]);
    memory.end_residue = State::new([1e-17, 2e-17], [3e-17, 4e-17]);
    memory.correct(State::new([1.0, 2.5], [3.5, 4.0]));
    assert_eq!(memory.end, State::new([1.0, 2.5], [3.5, 4.0]));
    assert_eq!(memory.end_residue, State::new([1e-17, 0.0], [0.0, 4e-17]));
}

#[test]
fn terms_that_are_errors_across_the_constraints_let_a_step_be_longer() {
    let mut memory = memory();
    let limits = Limits { relative: 1e-10, ..Limits::new() };
    memory.start.q = [1.0];
    memory.independence = Some(Independence { least: 1e-2, ..Independence::clear(2) });
    memory.ulps = [[f64::EPSILON], [f64::EPSILON]];
    // Roundings that grow threefold from order to order. They reach the tolerance, 2e-11, at a third of a
    // unit.
    let first = 2e-11;
    memory.series.q[19] = [first * 3.0_f64.powi(20)];
    let theta = 1.0 / 3.0;
    // Errors across may be √(2e-11 · 1e-2).
    let expected = theta * ((2e-13_f64).sqrt() / first).powf(0.05);
    let found = memory.reach_across(&limits, theta).expect("a longer step");
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    // Terms of the motion itself have not decayed halfway.
    memory.series.q[9] = [1e-3 * 3.0_f64.powi(10)];
    assert_eq!(memory.reach_across(&limits, theta), None);
    // Without constraints there is nothing across.
    (memory.series.q[9], memory.independence) = ([0.0], None);
    assert_eq!(memory.reach_across(&limits, theta), None);
}
