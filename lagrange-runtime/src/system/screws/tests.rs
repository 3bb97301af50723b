//! How many operations the loops take. The engine weighs them against sweeps for each variable: its numbers
//! (`mechanics/screws/operations.rs`) are these.

use super::pairs::LANES;
use super::*;
use crate::number::real::tests::{Minimal, operations};

/// Operations of `linearization`, of which `C` coordinates have rates that are given, with `P` changes.
fn counted<const N: usize, const G: usize, const C: usize, const P: usize>(groups: [Group; G]) -> usize {
    let one = Minimal::from_f64(1.0);
    let screws = Screws::<Minimal, N, G, C, P> {
        points: [[one; 3]; G],
        screws: [[one; 6]; N],
        rates: [[[one; 6]; 2]; C],
        changes: [[one; 6]; P],
        inertias: [[one; 10]; G],
        gravity: [one; 3],
    };
    operations(|| linearization(&screws, &groups, &[one; N], &[one; N]))
}

const BODIES: usize = 266;
const CARRIED: usize = 194;
const GIVEN: usize = 72;
const RATES: usize = 132;
const COORDINATE: usize = 318;
const WITHIN: usize = 33;
const ABOVE: usize = 48;
const BLOCK: usize = 73;
const CHANGE: usize = 24;

#[test]
fn operations_are_those_that_the_engine_takes_them_for() {
    let link = |parent, coordinates| Group { parent, coordinates, given: 0 };
    // The scalar of this test has no vectors: each of their numbers counts.
    let block = LANES * BLOCK;
    let alone = BODIES + RATES + COORDINATE + WITHIN;
    let carried = alone + CARRIED + ABOVE + block;
    assert_eq!(counted::<1, 1, 0, 0>([link(1, &[0])]), alone);
    assert_eq!(counted::<2, 2, 0, 0>([link(2, &[0]), link(0, &[1])]), alone + carried);
    assert_eq!(counted::<2, 1, 0, 0>([link(1, &[0, 1])]), 2 * (alone + WITHIN) - BODIES);
    let within = 2 * (alone + WITHIN) - BODIES;
    let both = within + CARRIED + 2 * (ABOVE + block);
    assert_eq!(counted::<3, 2, 0, 0>([link(2, &[0]), link(0, &[1, 2])]), alone + both);
    // The tenth link has nine coordinates on its way, which are two vectors.
    let chain = core::array::from_fn(|place| {
        link(
            place.checked_sub(1).unwrap_or(10),
            [&[0], &[1], &[2], &[3], &[4], &[5], &[6], &[7], &[8], &[9]][place],
        )
    });
    assert_eq!(counted::<10, 10, 0, 0>(chain), alone + 9 * carried + block);
    let base = [Group { parent: 1, coordinates: &[0, 1, 2, 3, 4, 5], given: 0 }];
    assert_eq!(counted::<6, 1, 6, 36>(base), BODIES + 6 * (GIVEN + COORDINATE) + 36 * (WITHIN + CHANGE));
}
