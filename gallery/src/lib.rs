//! Eight systems in the browser, each a module of WebAssembly: what a page shows of a system, and the
//! systems.
//!
//! A page talks to its module by numbers alone: no memory is shared and no text crosses the border. What has
//! a name is in the catalogue (`src/main.rs`), which the build writes beside the modules.
//!
//! Without the standard library, `x.sin()` is the function that the equations have, so a module has one sine.
#![no_std]

extern crate alloc;

pub mod models;
mod page;
mod scene;

pub use page::Page;
pub use scene::Scene;

use alloc::vec::Vec;

use lagrangian::{MotionError, State, System};

/// A number that a slider sets.
#[derive(Clone, Copy, Debug)]
pub struct Slider {
    /// The name on the page, and in its address.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Smallest and largest value, and the distance between values.
    pub range: [f64; 3],
    /// Where it begins.
    pub start: f64,
}

impl Slider {
    /// One more slider.
    pub const fn new(name: &'static str, unit: &'static str, range: [f64; 3], start: f64) -> Self {
        Self { name, unit, range, start }
    }
}

/// A place in the plane of the picture \[m].
pub type Point = [f64; 2];

/// The part of a page that belongs to a system with `N` coordinates.
pub trait Model<const N: usize>: Sized + 'static {
    /// The parameters.
    const PARAMETERS: &'static [Slider];
    /// The numbers that set the state, beside dragging.
    const SETTINGS: &'static [Slider];
    /// Names and units of the reactions.
    const REACTIONS: &'static [&'static str] = &[];
    /// Left, bottom, right and top of the picture \[m].
    const VIEW: [f64; 4];
    /// Whether nothing drives or brakes the system, so that a change of its energy is an error.
    const CONSERVATIVE: bool = true;

    /// The system with these parameters, in the order of `PARAMETERS`.
    fn new(parameters: &[f64]) -> Self;

    /// The state with these settings, in the order of `SETTINGS`; `None` where the settings allow no state.
    fn placed(&self, settings: &[f64]) -> Option<State<f64, N>>;

    /// The values of the settings in a state.
    fn settings(&self, state: &State<f64, N>) -> Vec<f64>;

    /// The state at time `t`.
    ///
    /// # Errors
    /// What ended the motion before.
    fn moved(&self, state: &State<f64, N>, t: f64) -> Result<State<f64, N>, MotionError<f64>>;

    /// Kinetic and potential energy.
    fn energies(&self, state: &State<f64, N>) -> [f64; 2];

    /// The reactions.
    fn reactions(&self, _state: &State<f64, N>) -> Vec<f64> {
        Vec::new()
    }

    /// Draws the system.
    fn draw(&self, state: &State<f64, N>, scene: &mut Scene);

    /// Where the system can be taken hold of.
    fn handles(&self, state: &State<f64, N>) -> Vec<Point>;

    /// The state in which a handle has been dragged to a place; `None` if it cannot be there.
    fn dragged(&self, state: &State<f64, N>, handle: usize, to: Point) -> Option<State<f64, N>>;

    /// A state that was kept while parameters changed, as far as they still allow it.
    fn kept(&self, state: &State<f64, N>) -> Option<State<f64, N>> {
        Some(*state)
    }
}

/// The state at time `t` by the method that the system has by itself.
///
/// # Errors
/// What ended the motion before.
pub fn follow<S: System<N, Scalar = f64>, const N: usize>(
    system: &S,
    state: &State<f64, N>,
    t: f64,
) -> Result<State<f64, N>, MotionError<f64>> {
    system.simulate(*state).with_tolerance(1e-13).with_max_steps(20_000).advance_to(t).copied()
}

/// The functions that a browser calls, for a model with so many coordinates: those of [`Page`].
#[macro_export]
macro_rules! page {
    ($model:ty, $coordinates:literal) => {
        mod page {
            #![allow(unsafe_code, reason = "what a browser calls has a fixed name")]

            use core::cell::RefCell;

            thread_local! {
                static PAGE: RefCell<$crate::Page<$model, $coordinates>> = RefCell::default();
            }

            #[unsafe(no_mangle)]
            extern "C" fn set_parameter(index: u32, value: f64) -> bool {
                PAGE.with_borrow_mut(|page| page.set_parameter(index as usize, value))
            }

            #[unsafe(no_mangle)]
            extern "C" fn assume_parameter(index: u32, value: f64) {
                PAGE.with_borrow_mut(|page| page.assume_parameter(index as usize, value))
            }

            #[unsafe(no_mangle)]
            extern "C" fn set(index: u32, value: f64) -> bool {
                PAGE.with_borrow_mut(|page| page.set(index as usize, value))
            }

            #[unsafe(no_mangle)]
            extern "C" fn setting(index: u32) -> f64 {
                PAGE.with_borrow_mut(|page| page.setting(index as usize))
            }

            #[unsafe(no_mangle)]
            extern "C" fn set_number(index: u32, value: f64) {
                PAGE.with_borrow_mut(|page| page.set_number(index as usize, value))
            }

            #[unsafe(no_mangle)]
            extern "C" fn number(index: u32) -> f64 {
                PAGE.with_borrow_mut(|page| page.number(index as usize))
            }

            #[unsafe(no_mangle)]
            extern "C" fn settle() -> bool {
                PAGE.with_borrow_mut(|page| page.settle())
            }

            #[unsafe(no_mangle)]
            extern "C" fn advance(by: f64) -> bool {
                PAGE.with_borrow_mut(|page| page.advance(by))
            }

            #[unsafe(no_mangle)]
            extern "C" fn time() -> f64 {
                PAGE.with_borrow_mut(|page| page.time())
            }

            #[unsafe(no_mangle)]
            extern "C" fn part(index: u32) -> f64 {
                PAGE.with_borrow_mut(|page| page.part(index as usize))
            }

            #[unsafe(no_mangle)]
            extern "C" fn change() -> f64 {
                PAGE.with_borrow_mut(|page| page.change())
            }

            #[unsafe(no_mangle)]
            extern "C" fn reaction(index: u32) -> f64 {
                PAGE.with_borrow_mut(|page| page.reaction(index as usize))
            }

            #[unsafe(no_mangle)]
            extern "C" fn draw() -> u32 {
                PAGE.with_borrow_mut(|page| page.draw() as u32)
            }

            #[unsafe(no_mangle)]
            extern "C" fn drawn(index: u32) -> f64 {
                PAGE.with_borrow_mut(|page| page.drawn(index as usize))
            }

            #[unsafe(no_mangle)]
            extern "C" fn handles() -> u32 {
                PAGE.with_borrow_mut(|page| page.handles() as u32)
            }

            #[unsafe(no_mangle)]
            extern "C" fn handle(index: u32, axis: u32) -> f64 {
                PAGE.with_borrow_mut(|page| page.handle(index as usize, axis as usize))
            }

            #[unsafe(no_mangle)]
            extern "C" fn drag(index: u32, x: f64, y: f64) -> bool {
                PAGE.with_borrow_mut(|page| page.drag(index as usize, [x, y]))
            }
        }
    };
}
