//! What a step is held against where constraints come close to depending on each other.

use super::*;
use crate::constraints::samples::Fold;

#[test]
fn what_has_been_determined_stays_so() {
    let of = |rank, least| Independence { rank, least, ..Independence::<f64>::clear(3) };
    // Two of three rows depend on each other at the start, and no longer later on.
    let mut determined = Determined::at_start(&of(2, 1.0));
    assert!(determined.accepts(&of(2, 0.1)) && !determined.accepts(&of(1, 1.0)));
    determined.learn(&of(3, 1.0));
    assert!(determined.accepts(&of(3, 0.1)) && !determined.accepts(&of(2, 1.0)));
    // Rows that were nearly dependent from the beginning may come a little closer, until they have been
    // far apart.
    let mut determined = Determined::at_start(&of(3, 1e-6));
    assert!(determined.accepts(&of(3, 3e-7)) && !determined.accepts(&of(3, 1e-7)));
    determined.learn(&of(3, 8e-7));
    assert!(determined.accepts(&of(3, 3e-7)) && !determined.accepts(&of(3, 2.2e-7)));
    determined.learn(&of(3, 0.5));
    assert!(!determined.accepts(&of(3, 1e-5)));
}

#[test]
fn a_step_leaves_a_fold_in_the_direction_of_its_time() {
    // The rows depend on each other at x = 0. Time runs either way.
    for (x, speed, step, leaves) in [
        (0.1, 1.0, 0.01, true),
        (0.1, -1.0, 0.01, false),
        (0.1, 1.0, -0.01, false),
        (-0.1, 1.0, -0.01, true),
        (-0.1, 1.0, 0.01, false),
    ] {
        let end = State::new([x, 0.0, 0.0], [speed, 0.0, 0.0]).at_time(5.0);
        let from = end.at_time(5.0 - step);
        let (limits, inputs) = (Limits::new(), []);
        let check = Check { system: &Fold, constants: &(), inputs: &inputs, limits: &limits, from: &from };
        let landing = check.land(&end, None).unwrap();
        assert!(landing.footing.independence.least < 0.2);
        assert_eq!(check.leaves(&landing), leaves, "{x} {speed} {step}");
    }
}

#[test]
fn corrections_are_small_in_tolerances_of_the_step() {
    let from = State::new([2.0, 0.0, 0.0], [3.0, 0.0, 0.0]);
    let limits = Limits { relative: 1e-6, ..Limits::new() };
    let check = Check { system: &Fold, constants: &(), inputs: &[], limits: &limits, from: &from };
    let footing = check.land(&from, None).unwrap().footing;
    let change = |q: f64, v: f64| State { t: 0.0, q: [0.0, q, 0.0], v: [0.0, v, 0.0] };
    for (q, v, span, is_small) in [
        (0.99 * 16.0 * 2e-6, 0.0, 0.1, true),
        (1.01 * 16.0 * 2e-6, 0.0, 0.1, false),
        // The way of the step counts where it is longer than the coordinates.
        (0.99 * 16.0 * 30e-6, 0.0, -10.0, true),
        (1.01 * 16.0 * 30e-6, 0.0, 10.0, false),
        (0.0, 0.99 * 16.0 * 3e-6, 0.1, true),
        (0.0, 1.01 * 16.0 * 3e-6, 0.1, false),
    ] {
        assert_eq!(check.is_small(&change(q, v), span, &footing), is_small, "{q:e} {v:e} {span}");
    }
    let half = f64::EPSILON.sqrt();
    assert!(check.is_half(&change(1.99 * half, 2.99 * half), 0.1, &footing));
    assert!(!check.is_half(&change(2.01 * half, 0.0), 0.1, &footing));
    assert!(!check.is_half(&change(0.0, 3.01 * half), 0.1, &footing));
}
