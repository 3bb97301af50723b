//! Five mechanical systems as kernels of a graphics processor. Each system has a kernel of fixed steps by
//! series and two under error control, by series and by Dormand and Prince's method; the double pendulum has
//! one by Runge and Kutta's method as well. A motion is a function of its index; [`spread`] scatters the
//! starts.
//!
//! The crate has no standard library on hosts, either. So `x.sin()` is the function of the crate `libm` on
//! both sides, and not the host's own with other last bits.
#![no_std]
#![cfg_attr(target_arch = "nvptx64", feature(abi_ptx))]

#[cfg(feature = "contacts")]
mod contacts;
mod systems;

use lagrangian::prelude::*;
use lagrangian::{Adaptive, Control, FixedStep, Simulation};

#[cfg(feature = "contacts")]
pub use contacts::{Bearing, Belt, Puck, Stone, bearing, belt, puck, puck_apex, puck_steps, stone};
pub use systems::{CartPole, DoublePendulum, FourBar, Kepler, Links};

/// Gravitational acceleration \[m/s²].
const G: f64 = 9.81;

/// The setting of motions in fixed steps: length \[s] and number of the steps.
pub type Steps = (f64, u64);

/// The setting of motions under error control: the time of their end \[s] and the tolerance.
pub type Until = (f64, f64);

/// The state where a motion ends, or the error that ends it.
pub type End<const N: usize> = Result<State<f64, N>, MotionError<f64>>;

/// Numbers between −1 and 1 that fill the square evenly, without rounding.
pub fn spread(index: u64) -> [f64; 2] {
    // 1/p and 1/p² of the plastic number p, as fractions of 2⁶⁴ (Roberts 2018).
    [0xC13F_A9A9_02A6_328F_u64, 0x91E1_0DA5_C79E_7B1D].map(|step| {
        let place = index.wrapping_add(1).wrapping_mul(step) >> 11;
        place as f64 * (1.0 / (1_u64 << 52) as f64) - 1.0
    })
}

/// The end of a motion of fixed steps; `inputs` hold during a step.
fn fixed<M, S, const N: usize, const K: usize>(
    system: &S,
    start: State<f64, N>,
    &(h, steps): &Steps,
    inputs: impl Fn(&State<f64, N>) -> [f64; K],
) -> End<N>
where
    S: System<N, K, Scalar = f64>,
    M: FixedStep<S, N, K>,
{
    let mut motion = system.stepper::<M>(start);
    for _ in 0..steps {
        let inputs = inputs(motion.state());
        motion.step(h, &inputs)?;
    }
    Ok(*motion.state())
}

/// The end of a motion under error control, by the method that it has.
fn end<S, C, M, const N: usize, const K: usize>(
    motion: Simulation<'_, S, C, M, N, K>,
    &(time, tolerance): &Until,
) -> End<N>
where
    S: System<N, K, Scalar = f64>,
    C: Control<f64, N, K>,
    M: Adaptive<S, C, N, K>,
{
    motion.with_tolerance(tolerance).advance_to(time).copied()
}

/// The double pendulum of an index, and its start: at rest, at any angles.
pub fn a_double_pendulum(index: u64) -> (DoublePendulum, State<f64, 2>) {
    let angles = spread(index).map(|part| core::f64::consts::PI * part);
    (DoublePendulum { m: [1.0, 1.0], l: [1.0, 1.0], g: G }, State::at_rest(angles))
}

/// The cart of an index, with its pole nearly upright, at rest.
pub fn a_cart_pole(index: u64) -> (CartPole, State<f64, 2>) {
    let [x, theta] = spread(index).map(|part| 0.2 * part);
    (
        CartPole { cart_mass: 0.5, pole_mass: 0.2, length: 0.4, damping: 0.002, g: G },
        State::at_rest([x, theta]),
    )
}

/// The planet of an index, on an ellipse.
pub fn a_planet(index: u64) -> (Kepler, State<f64, 2>) {
    let [slant, speed] = spread(index).map(|part| 0.1 * part);
    (Kepler { mu: 1.0 }, State::new([1.0, 0.0], [slant, 1.05 + speed]))
}

/// The chain of an index, at rest, hanging to both sides.
pub fn a_chain(index: u64) -> (Links, State<f64, { Links::LINKS }>) {
    let [first, last] = spread(index);
    let angles = [first, 0.75 * first, 0.5 * (first + last), 0.75 * last, last];
    (Links { mass: 1.0, length: 1.0, g: G }, State::at_rest(angles))
}

/// The crank stands upright or up to half a radian beside it, and turns; the other bars follow.
///
/// # Errors
/// If the loop is not closed.
pub fn a_four_bar(index: u64) -> Result<(FourBar, State<f64, 3>), MotionError<f64>> {
    let [lean, rate] = spread(index);
    let four_bar = FourBar { l: [1.0, 3.5, 3.0], m: [0.5, 1.0, 1.0], ground: 4.0, g: G };
    let near = State::new([core::f64::consts::FRAC_PI_2 + 0.5 * lean, 0.55, 1.92], [3.0 + rate, 0.0, 0.0]);
    Ok((four_bar, four_bar.consistent(near)?))
}

/// A double pendulum by Runge and Kutta's method.
pub fn double_pendulum_rk4(index: u64, steps: &Steps) -> End<2> {
    let (system, start) = a_double_pendulum(index);
    fixed::<Rk4, _, 2, 0>(&system, start, steps, |_| [])
}

/// A double pendulum by series of order 6.
pub fn double_pendulum_jet6(index: u64, steps: &Steps) -> End<2> {
    let (system, start) = a_double_pendulum(index);
    fixed::<Jet<6>, _, 2, 0>(&system, start, steps, |_| [])
}

/// A double pendulum under error control.
pub fn double_pendulum_adaptive(index: u64, until: &Until) -> End<2> {
    let (system, start) = a_double_pendulum(index);
    end(system.simulate(start), until)
}

/// A double pendulum under error control, by Dormand and Prince's method. It needs little memory, and so less
/// time on a processor whose threads share a small cache.
pub fn double_pendulum_dop853(index: u64, until: &Until) -> End<2> {
    let (system, start) = a_double_pendulum(index);
    end(system.simulate_with::<Dop853>(start), until)
}

/// A pole that a feedback holds up, by series of order 6.
pub fn cart_pole_jet6(index: u64, steps: &Steps) -> End<2> {
    let (system, start) = a_cart_pole(index);
    fixed::<Jet<6>, _, 2, 1>(&system, start, steps, CartPole::feedback)
}

/// A pole that falls, under error control.
pub fn cart_pole_adaptive(index: u64, until: &Until) -> End<2> {
    let (system, start) = a_cart_pole(index);
    end(system.simulate(start), until)
}

/// A pole that falls under error control, by Dormand and Prince's method.
pub fn cart_pole_dop853(index: u64, until: &Until) -> End<2> {
    let (system, start) = a_cart_pole(index);
    end(system.simulate_with::<Dop853>(start), until)
}

/// A planet by series of order 6.
pub fn kepler_jet6(index: u64, steps: &Steps) -> End<2> {
    let (system, start) = a_planet(index);
    fixed::<Jet<6>, _, 2, 0>(&system, start, steps, |_| [])
}

/// A planet under error control.
pub fn kepler_adaptive(index: u64, until: &Until) -> End<2> {
    let (system, start) = a_planet(index);
    end(system.simulate(start), until)
}

/// A planet under error control, by Dormand and Prince's method.
pub fn kepler_dop853(index: u64, until: &Until) -> End<2> {
    let (system, start) = a_planet(index);
    end(system.simulate_with::<Dop853>(start), until)
}

/// Five links by series of order 6.
pub fn links_jet6(index: u64, steps: &Steps) -> End<{ Links::LINKS }> {
    let (system, start) = a_chain(index);
    fixed::<Jet<6>, _, _, 0>(&system, start, steps, |_| [])
}

/// Five links under error control.
pub fn links_adaptive(index: u64, until: &Until) -> End<{ Links::LINKS }> {
    let (system, start) = a_chain(index);
    end(system.simulate(start), until)
}

/// Five links under error control, by Dormand and Prince's method.
pub fn links_dop853(index: u64, until: &Until) -> End<{ Links::LINKS }> {
    let (system, start) = a_chain(index);
    end(system.simulate_with::<Dop853>(start), until)
}

/// A linkage with its constraints by series of order 6.
pub fn four_bar_jet6(index: u64, steps: &Steps) -> End<3> {
    let (system, start) = a_four_bar(index)?;
    fixed::<Jet<6>, _, 3, 0>(&system, start, steps, |_| [])
}

/// A linkage with its constraints under error control.
pub fn four_bar_adaptive(index: u64, until: &Until) -> End<3> {
    let (system, start) = a_four_bar(index)?;
    end(system.simulate(start), until)
}

/// A linkage with its constraints under error control, by Dormand and Prince's method.
pub fn four_bar_dop853(index: u64, until: &Until) -> End<3> {
    let (system, start) = a_four_bar(index)?;
    end(system.simulate_with::<Dop853>(start), until)
}

lagrange_gpu::kernels!(
    double_pendulum_rk4,
    double_pendulum_jet6,
    double_pendulum_adaptive,
    double_pendulum_dop853,
    cart_pole_jet6,
    cart_pole_adaptive,
    cart_pole_dop853,
    kepler_jet6,
    kepler_adaptive,
    kepler_dop853,
    links_jet6,
    links_adaptive,
    links_dop853,
    four_bar_jet6,
    four_bar_adaptive,
    four_bar_dop853,
);
