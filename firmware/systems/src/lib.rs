//! The mechanical systems that run on every target, and how they run.
//!
//! One description serves `f32` and `f64`, the host, Cortex-M, RISC-V and WebAssembly: what differs between
//! targets is how a line of text leaves the machine, and nothing else. All parameters are numbers that `f32`
//! holds exactly, so that the motions of both scalars are of the same system.
#![no_std]

pub mod bits;
mod cart_pole;
mod double_pendulum;
mod functions;
mod puck;
mod rod;
mod spring;

pub use bits::Bits;
pub use cart_pole::CartPole;
pub use double_pendulum::DoublePendulum;
pub use puck::Puck;
pub use rod::Rod;
pub use spring::Spring;

use lagrangian::prelude::*;
use lagrangian::{FixedStep, Smooth};

/// Gravitational acceleration \[m/s²].
const G: f64 = 9.8125;

/// A system with its parameters, where it starts and what drives it.
pub trait Experiment<const K: usize>: System<2, K> {
    /// Its name in the results.
    const NAME: &'static str;

    /// The system with its parameters.
    fn new() -> Self;

    /// Where the motion starts.
    fn start() -> State<Self::Scalar, 2>;

    /// The inputs at a state.
    fn inputs(state: &State<Self::Scalar, 2>) -> [Self::Scalar; K];
}

/// An action on the systems of [`each`], by every fixed-step method that control loops use.
pub trait Visitor<R: Bits> {
    /// The error that stops it.
    type Error;

    /// Does it with one of them.
    ///
    /// # Errors
    /// What stops it.
    fn visit<S, M, const K: usize>(&mut self, method: &'static str) -> Result<(), Self::Error>
    where
        S: Experiment<K, Scalar = R>,
        M: FixedStep<S, 2, K>;
}

/// Shows the double pendulum, the rod and the cart with a pole to a visitor, with each method.
///
/// # Errors
/// What stops the visitor.
pub fn each<R: Bits, V: Visitor<R>>(visitor: &mut V) -> Result<(), V::Error> {
    methods::<DoublePendulum<R>, R, V, 0>(visitor)?;
    methods::<Rod<R>, R, V, 0>(visitor)?;
    // The puck is not among them: its contacts fill the memory of a small board. `footprint` links it alone.
    methods::<CartPole<R>, R, V, 1>(visitor)
}

fn methods<S, R, V, const K: usize>(visitor: &mut V) -> Result<(), V::Error>
where
    R: Bits,
    V: Visitor<R>,
    S: Experiment<K, Scalar = R> + Smooth<2, K>,
{
    visitor.visit::<S, Rk4, K>("rk4")?;
    visitor.visit::<S, Jet<4>, K>("jet4")?;
    visitor.visit::<S, Jet<6>, K>("jet6")
}

/// Takes `steps` steps of `h` \[s] by the method `M` and shows every state.
///
/// # Errors
/// Why the motion could not go on.
#[inline]
pub fn run<S, M, const K: usize>(
    h: S::Scalar,
    steps: u32,
    mut show: impl FnMut(&State<S::Scalar, 2>),
) -> Result<(), MotionError<S::Scalar>>
where
    S: Experiment<K>,
    M: FixedStep<S, 2, K>,
{
    let system = S::new();
    let mut motion = system.stepper::<M>(S::start());
    for _ in 0..steps {
        let inputs = S::inputs(motion.state());
        show(motion.step(h, &inputs)?);
    }
    Ok(())
}
