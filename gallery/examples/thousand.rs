//! A thousand double pendulums as a module of WebAssembly: they start a little apart.
#![allow(unsafe_code, reason = "what a browser calls has a fixed name")]

use core::cell::RefCell;

use gallery::models::double_pendulum::DoublePendulum;
use lagrangian::prelude::*;

const PENDULUM: DoublePendulum = DoublePendulum { m: [1.0, 1.0], l: [1.0, 1.0], g: 9.81 };
/// The longest step \[s].
const LONGEST: f64 = 1.0 / 240.0;

thread_local! {
    static STATES: RefCell<Vec<State<f64, 2>>> = const { RefCell::new(Vec::new()) };
}

/// Begins anew with so many pendulums. The upper rod of each is turned by `spread` \[rad] against that of the
/// one before.
#[unsafe(no_mangle)]
extern "C" fn begin(count: u32, angle: f64, spread: f64) {
    let state = |k: u32| State::at_rest([angle + spread * f64::from(k), angle]);
    STATES.with_borrow_mut(|states| *states = (0..count).map(state).collect());
}

/// Moves all on; returns how many could not.
#[unsafe(no_mangle)]
extern "C" fn advance(by: f64) -> u32 {
    STATES.with_borrow_mut(|states| states.iter_mut().map(|state| u32::from(!moved(state, by))).sum())
}

fn moved(state: &mut State<f64, 2>, by: f64) -> bool {
    let mut motion = PENDULUM.stepper::<Jet<8>>(*state);
    let steps = (by / LONGEST).ceil();
    let moved = (0..steps as u32).all(|_| motion.step(by / steps, &[]).is_ok());
    *state = *motion.state();
    moved
}

/// An angle \[rad] of a pendulum.
#[unsafe(no_mangle)]
extern "C" fn angle(pendulum: u32, rod: u32) -> f64 {
    let found = |states: &mut Vec<State<f64, 2>>| states.get(pendulum as usize)?.q.get(rod as usize).copied();
    STATES.with_borrow_mut(found).unwrap_or(f64::NAN)
}

/// The largest change of energy since the start, as a part of what a fall from the top to the bottom sets
/// free.
#[unsafe(no_mangle)]
extern "C" fn worst(angle: f64, spread: f64) -> f64 {
    STATES.with_borrow(|states| {
        let change = |(k, state): (u32, &State<f64, 2>)| {
            let start = State::at_rest([angle + spread * f64::from(k), angle]);
            (PENDULUM.energy(state) - PENDULUM.energy(&start)).abs() / (6.0 * PENDULUM.g)
        };
        (0..).zip(states).map(change).fold(0.0, f64::max)
    })
}
