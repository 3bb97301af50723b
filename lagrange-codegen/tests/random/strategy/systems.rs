//! Random systems and states.

use proptest::prelude::*;

use super::constraints::{Carrier, Restraint, links, restraints};
use super::expressions::{Reach, body, fixed, index, scalar};
use super::roles::{Base, base, chain, role};
use crate::check::Sample;
use crate::source::PARAMETERS;
use crate::system::{Group, Role, Scalar, System};

/// Names that a user may give; some are also those of generated variables.
const COORDINATES: [&str; 16] = [
    "x", "theta", "r", "phi", "s", "y", "q", "v", "t", "u", "x_dot", "x_0", "state", "w1", "r#type",
    "lagrange",
];
const INPUTS: [&str; 4] = ["force", "motor", "inputs", "theta_dot"];

/// The number of coordinates of a system of middle size, and the length of the group that makes one large.
const MOST: usize = 7;
const LARGE: usize = 33;

/// A system with everything on it.
pub fn system() -> BoxedStrategy<System> {
    prop_oneof![5 => of_inertia(true), 2 => of_inertia(false)].boxed()
}

/// One or two chains of particles that hang at a fixed place, at times with one more coordinate, and few
/// other parts. A recursion solves most of these systems and does not form their mass matrices.
pub fn chained() -> BoxedStrategy<System> {
    let scalar_type = prop_oneof![3 => Just(Scalar::F64), 1 => Just(Scalar::Generic)];
    let helpers = prop::collection::vec(body(Reach::Helper, scalar(Reach::Helper)), 1);
    let arrays = prop_oneof![
        2 => (10_usize..=14).prop_map(|links| vec![Some(links)]),
        1 => (10_usize..=12).prop_map(|links| vec![None, Some(links)]),
        1 => (9_usize..=11, 9_usize..=11).prop_map(|(first, second)| vec![Some(first), Some(second)]),
    ];
    let chains = (chain(), chain());
    (scalar_type, arrays, inputs(), helpers, chains, role(true), base(true), any::<bool>())
        .prop_map(|(scalar, lengths, inputs, helpers, (first, second), extra, base, has_more)| {
            let coordinates = named(&lengths, &COORDINATES, 0);
            let mut system =
                System { scalar, coordinates, inputs, helpers, roles: Vec::new(), baumgarte: None };
            if lengths[0].is_none() {
                system.roles.push(base.role(0));
            }
            let arrays = lengths.iter().filter(|length| length.is_some()).count();
            for (array, mut role) in [first, second].into_iter().take(arrays).enumerate() {
                if let Role::Chain { which, .. } = &mut role {
                    *which = array;
                }
                system.roles.push(role);
            }
            let fits = !matches!(extra, Role::Wrench(..) | Role::Spatial { .. } | Role::Planar { .. });
            if has_more && fits {
                system.roles.push(extra);
            }
            system
        })
        .boxed()
}

/// Many constraints that have few coordinates in common. The mass matrix is diagonal, unless a particle moves
/// with several coordinates.
pub fn linked() -> BoxedStrategy<System> {
    let scalar_type = prop_oneof![3 => Just(Scalar::F64), 1 => Just(Scalar::Generic)];
    let helpers = prop::collection::vec(body(Reach::Helper, scalar(Reach::Helper)), 1);
    let held = (9_usize..=12).prop_flat_map(|count| (Just(count), links(count - 2)));
    (scalar_type, held, inputs(), helpers, prop::collection::vec(base(true), 12))
        .prop_map(|(scalar, (count, links), inputs, helpers, bases)| {
            let coordinates = named(&[Some(count)], &COORDINATES, 0);
            let mut roles: Vec<Role> =
                bases.into_iter().take(count).enumerate().map(|(i, base)| base.role(i)).collect();
            roles.push(links);
            System { scalar, coordinates, inputs, helpers, roles, baumgarte: None }
        })
        .boxed()
}

fn of_inertia(quadratic: bool) -> BoxedStrategy<System> {
    let scalar_type = prop_oneof![6 => Just(Scalar::F64), 1 => Just(Scalar::F32), 2 => Just(Scalar::Generic)];
    let helpers = prop::collection::vec(body(Reach::Helper, scalar(Reach::Helper)), 1..=2);
    let bases = prop::collection::vec(base(quadratic), MOST);
    let roles = prop::collection::vec(role(quadratic), 0..=4);
    let held = (restraints(), index(), prop::bool::weighted(0.2), prop::option::weighted(0.15, fixed()));
    (scalar_type, coordinates(), inputs(), helpers, bases, roles, 0_usize..12, held)
        .prop_map(|(scalar, coordinates, inputs, helpers, bases, roles, one_base, held)| {
            let (restraints, first, massless, baumgarte) = held;
            let mut system = System { scalar, coordinates, inputs, helpers, roles: Vec::new(), baumgarte };
            let count = system.count();
            let bases: Vec<Base> =
                bases.into_iter().cycle().take(if one_base == 0 { 1 } else { count }).collect();
            let first = first % count;
            // A constraint may stand in for the inertia of its coordinate.
            let massless = massless && count > 1 && !restraints.is_empty();
            let mut based = vec![None; count];
            for (i, base) in bases.into_iter().cycle().take(count).enumerate() {
                if !(massless && i == first) {
                    based[i] = Some(system.roles.len());
                    system.roles.push(base.role(i));
                }
            }
            system.roles.extend(roles);
            restrain(&mut system, restraints, first, &based);
            let (has_places, has_bodies) = (system.any_place(0).is_some(), system.any_body(0).is_some());
            system.roles.retain(|role| match role {
                Role::ForceAt(..) => has_places,
                Role::Wrench(..) => has_bodies,
                _ => true,
            });
            system
        })
        .boxed()
}

/// Adds constraints as long as there are coordinates for them, from a first one on. `based` has the roles
/// that give coordinates their inertia.
fn restrain(system: &mut System, restraints: Vec<Restraint>, first: usize, based: &[Option<usize>]) {
    let (count, mut held, mut functions) = (system.count(), 0, [0; 2]);
    for restraint in restraints {
        let of_kind = &mut functions[usize::from(restraint.is_holonomic())];
        if held + restraint.count() > count || *of_kind == 2 {
            continue;
        }
        *of_kind += 1;
        let start = first + held;
        held += restraint.count();
        let role = restraint.role(start, |i| carrier(system, based[i % count]?));
        system.roles.push(role);
    }
}

/// A particle as a constraint names it.
fn carrier(system: &System, role: usize) -> Option<Carrier> {
    let Role::Point { dimension, .. } = system.roles[role] else { return None };
    let visible = system.roles.len();
    let names =
        |which: &usize| system.place(*which, dimension, visible).is_some_and(|place| place.role == role);
    (0..120).find(names).map(|which| (which, dimension))
}

fn lengths() -> BoxedStrategy<Vec<Option<usize>>> {
    let length = prop_oneof![3 => Just(None), 1 => (1_usize..=3).prop_map(Some)];
    prop_oneof![
        200 => prop::collection::vec(length, 1..=3),
        6 => Just(vec![None; MOST - 1]),
        8 => Just(vec![Some(MOST - 1), None]),
        2 => Just(vec![Some(17)]),
        1 => Just(vec![Some(LARGE)]),
    ]
    .boxed()
}

fn coordinates() -> BoxedStrategy<Vec<Group>> {
    (lengths(), prop_oneof![5 => Just(false), 1 => Just(true)], index())
        .prop_map(|(lengths, any_name, start)| {
            let pool = if any_name { &COORDINATES[..] } else { &COORDINATES[..MOST - 1] };
            named(&lengths, pool, if any_name { start } else { 0 })
        })
        .boxed()
}

fn inputs() -> BoxedStrategy<Vec<Group>> {
    let length = prop_oneof![3 => Just(None), 1 => (1_usize..=2).prop_map(Some)];
    (prop::collection::vec(length, 0..=2), 0..INPUTS.len())
        .prop_map(|(lengths, start)| named(&lengths, &INPUTS, start))
        .boxed()
}

fn named(lengths: &[Option<usize>], pool: &[&'static str], start: usize) -> Vec<Group> {
    let name = |i: usize| pool[(start % pool.len() + i) % pool.len()];
    lengths.iter().enumerate().map(|(i, &length)| Group { name: name(i), length }).collect()
}

/// Values for a state, inputs and parameters.
pub fn sample() -> BoxedStrategy<Sample> {
    let value = |bound: f64| prop_oneof![12 => -bound..bound, 1 => Just(0.0), 1 => -8.0 * bound..8.0 * bound];
    let within = |bound: f64, count: usize| prop::collection::vec(value(bound), count);
    let parameters = prop::collection::vec(0.4..1.6_f64, PARAMETERS.len());
    (0.0..2.0_f64, within(1.4, LARGE), within(1.4, LARGE), within(2.0, 4), parameters)
        .prop_map(|(t, q, v, u, parameters)| Sample { t, q, v, u, parameters })
        .no_shrink()
        .boxed()
}
