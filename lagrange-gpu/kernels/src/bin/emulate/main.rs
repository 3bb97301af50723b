//! Kernels without a processor: interprets the PTX itself, thread by thread, and compares the memory that it
//! leaves with that of the functions on this machine: `emulate FILE.ptx`. Every bit must be the same.

mod machine;
mod text;
mod value;

use std::env;
use std::error::Error;

use kernels::*;
use lagrange_gpu::{Kernel, Ptx, Words, kernel};
use lagrangian::MotionError;
use machine::Machine;

const STEPS: Steps = (1.0 / 64.0, 32);
const UNTIL: Until = (0.5, 1e-9);

/// A step of infinite length: each motion ends in an error.
const BAD: Steps = (f64::INFINITY, 1);

/// Motions of a launch, and its first one.
const COUNT: u64 = 4;
const FIRST: u64 = 1000;

/// A word that nothing writes.
const UNTOUCHED: u64 = 0x5555_5555_5555_5555;

/// Runs a kernel in all threads of a launch, one more, and one with another idea of the types.
fn compare<S: Words + Copy, R: Words>(
    machine: &mut Machine,
    kernel: Kernel<S, R, MotionError<f64>>,
    setting: S,
) -> Result<u64, Box<dyn Error>> {
    let columns = 1 + R::WORDS as u64;
    let words = machine.allocate(8 * S::WORDS.max(1));
    let mut values = Vec::new();
    setting.put(&mut |word| values.push(word));
    for (place, word) in (0..).zip(values) {
        machine.write(words + 8 * place, word, 8)?;
    }
    let cells = machine.allocate(8 * (columns * COUNT + 1) as usize);
    for place in 0..=columns * COUNT {
        machine.write(cells + 8 * place, UNTOUCHED, 8)?;
    }
    let before = machine.count;
    for thread in 0..=COUNT {
        machine.run(kernel.name(), thread, &[FIRST, COUNT, kernel.shape(), words, cells])?;
    }
    let instructions = (machine.count - before) / COUNT;
    for place in 0..COUNT {
        for (column, expected) in (0..).zip(kernel.cells(FIRST + place, &setting)) {
            let found = machine.read(cells + 8 * (column * COUNT + place), 8)?;
            // A motion without a row leaves the rest of its cells alone.
            let expected =
                if column > 0 && machine.read(cells + 8 * place, 8)? != 1 { UNTOUCHED } else { expected };
            if found != expected {
                return Err(format!(
                    "{}, motion {place}, word {column}: {found:#018x} and not {expected:#018x}",
                    kernel.name()
                )
                .into());
            }
        }
    }
    if machine.read(cells + 8 * columns * COUNT, 8)? != UNTOUCHED {
        return Err(format!("{} writes behind its cells", kernel.name()).into());
    }
    machine.run(kernel.name(), 0, &[FIRST, COUNT, kernel.shape() + 1, words, cells])?;
    if machine.read(cells, 8)? != 3 {
        return Err(format!("{} does not see that types differ", kernel.name()).into());
    }
    Ok(instructions)
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = env::args().nth(1).ok_or("usage: emulate FILE.ptx")?;
    Ptx::read(&path)?;
    let mut machine = Machine::new(text::module(&std::fs::read_to_string(path)?)?)?;
    let machine = &mut machine;
    compare(machine, kernel!(double_pendulum_jet6), BAD)?;
    compare(machine, kernel!(four_bar_jet6), BAD)?;
    let all = [
        ("double_pendulum_rk4", compare(machine, kernel!(double_pendulum_rk4), STEPS)?),
        ("double_pendulum_jet6", compare(machine, kernel!(double_pendulum_jet6), STEPS)?),
        ("double_pendulum_adaptive", compare(machine, kernel!(double_pendulum_adaptive), UNTIL)?),
        ("double_pendulum_dop853", compare(machine, kernel!(double_pendulum_dop853), UNTIL)?),
        ("cart_pole_jet6", compare(machine, kernel!(cart_pole_jet6), STEPS)?),
        ("cart_pole_adaptive", compare(machine, kernel!(cart_pole_adaptive), UNTIL)?),
        ("cart_pole_dop853", compare(machine, kernel!(cart_pole_dop853), UNTIL)?),
        ("kepler_jet6", compare(machine, kernel!(kepler_jet6), STEPS)?),
        ("kepler_adaptive", compare(machine, kernel!(kepler_adaptive), UNTIL)?),
        ("kepler_dop853", compare(machine, kernel!(kepler_dop853), UNTIL)?),
        ("links_jet6", compare(machine, kernel!(links_jet6), STEPS)?),
        ("links_adaptive", compare(machine, kernel!(links_adaptive), UNTIL)?),
        ("links_dop853", compare(machine, kernel!(links_dop853), UNTIL)?),
        ("four_bar_jet6", compare(machine, kernel!(four_bar_jet6), STEPS)?),
        ("four_bar_adaptive", compare(machine, kernel!(four_bar_adaptive), UNTIL)?),
        ("four_bar_dop853", compare(machine, kernel!(four_bar_dop853), UNTIL)?),
    ];
    #[cfg(feature = "contacts")]
    let all = all.into_iter().chain([
        ("puck", compare(machine, kernel!(puck), UNTIL)?),
        ("puck_apex", compare(machine, kernel!(puck_apex), UNTIL)?),
        ("puck_steps", compare(machine, kernel!(puck_steps), UNTIL)?),
        ("belt", compare(machine, kernel!(belt), UNTIL)?),
        ("stone", compare(machine, kernel!(stone), UNTIL)?),
        ("bearing", compare(machine, kernel!(bearing), UNTIL)?),
    ]);
    for (name, instructions) in all {
        println!("{name}: the same bits in {COUNT} motions, {instructions} instructions of PTX each");
    }
    Ok(())
}
