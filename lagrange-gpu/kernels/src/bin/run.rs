//! All kernels on the first graphics processor, beside the cores of this machine: `run FILE.ptx`. It prints
//! the last section of `benchmarks/GPU.md`. Motions whose bits are not those of this machine are an error.

use std::env;
use std::error::Error;
use std::thread;
use std::time::Instant;

use kernels::{
    Steps, Until, cart_pole_adaptive, cart_pole_jet6, double_pendulum_adaptive, double_pendulum_jet6,
    double_pendulum_rk4, four_bar_adaptive, four_bar_jet6, kepler_adaptive, kepler_jet6, links_adaptive,
    links_jet6,
};
use lagrange_gpu::{Arithmetic, Error as GpuError, Gpu, Kernel, Kernels, Ptx, Words, kernel};
use lagrangian::MotionError;

/// Motions on the processor.
const MOTIONS: u64 = 1 << 20;

/// Motions on the cores: fewer, so that it does not take hours; all of them are compared.
const HERE: u64 = 1 << 14;

/// Steps of 1/128 s.
const STEPS: Steps = (1.0 / 128.0, 256);

/// Ten seconds.
const UNTIL: Until = (10.0, 1e-9);

/// Kernels in both kinds of arithmetic, and what was found.
struct Comparison {
    exact: Kernels,
    fused: Kernels,
    cores: usize,
    different: u64,
}

impl Comparison {
    /// A row of the table: rates, registers and equality of bits.
    fn row<S, R>(&mut self, kernel: Kernel<S, R, MotionError<f64>>, setting: S) -> Result<(), Box<dyn Error>>
    where
        S: Words + Copy + Sync,
        R: Words,
    {
        // The first launch makes room for the stacks.
        self.exact.run(kernel, setting, 64)?;
        let start = Instant::now();
        let rows = self.exact.run(kernel, setting, MOTIONS)?;
        let exact = MOTIONS as f64 / start.elapsed().as_secs_f64();
        self.fused.run(kernel, setting, 64)?;
        let start = Instant::now();
        self.fused.run(kernel, setting, MOTIONS)?;
        let fused = MOTIONS as f64 / start.elapsed().as_secs_f64();
        // The indices are spread over all motions; each core takes every n-th.
        let start = Instant::now();
        let equal: u64 = thread::scope(|scope| {
            let cores: Vec<_> = (0..self.cores as u64)
                .map(|core| {
                    let rows = &rows;
                    let mine = (core..HERE).step_by(self.cores).map(|index| index * (MOTIONS / HERE));
                    scope.spawn(move || rows.equal_here(mine))
                })
                .collect();
            cores.into_iter().map(|core| core.join().unwrap_or(0)).sum()
        });
        let here = HERE as f64 / start.elapsed().as_secs_f64();
        self.different += HERE - equal;
        let (registers, stack) = self.exact.registers_and_stack(kernel.name())?;
        println!(
            "| `{}` | {exact:.3e} | {fused:.3e} | {here:.3e} | {:.0} | {equal} of {HERE} | {registers} | {stack} |",
            kernel.name(),
            exact / here,
        );
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = env::args().nth(1).ok_or("usage: run FILE.ptx")?;
    let ptx = Ptx::read(path)?;
    let gpu = match Gpu::new(0) {
        Err(error @ (GpuError::NoDriver | GpuError::NoDevice { .. })) => {
            println!("nothing is run: {error}");
            return Ok(());
        }
        gpu => gpu?,
    };
    let cores = thread::available_parallelism()?.get();
    println!(
        "## On a processor\n\n{MOTIONS} motions a kernel on {}, {HERE} of them on {cores} cores of its host as well, by the same",
        gpu.name()?
    );
    println!(
        "function. Steps: {} of {} s; under error control: {} s with tolerance {:e}.",
        STEPS.1, STEPS.0, UNTIL.0, UNTIL.1
    );
    println!("\n| kernel | motions/s | fused | on the cores | ratio | same bits | registers | stack \\[B] |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    let [exact, fused] = [Arithmetic::Exact, Arithmetic::Fused].map(|arithmetic| gpu.load(&ptx, arithmetic));
    let mut all = Comparison { exact: exact?, fused: fused?, cores, different: 0 };
    all.row(kernel!(double_pendulum_rk4), STEPS)?;
    all.row(kernel!(double_pendulum_jet6), STEPS)?;
    all.row(kernel!(double_pendulum_adaptive), UNTIL)?;
    all.row(kernel!(cart_pole_jet6), STEPS)?;
    all.row(kernel!(cart_pole_adaptive), UNTIL)?;
    all.row(kernel!(kepler_jet6), STEPS)?;
    all.row(kernel!(kepler_adaptive), UNTIL)?;
    all.row(kernel!(links_jet6), STEPS)?;
    all.row(kernel!(links_adaptive), UNTIL)?;
    all.row(kernel!(four_bar_jet6), STEPS)?;
    all.row(kernel!(four_bar_adaptive), UNTIL)?;
    if all.different > 0 { Err(format!("{} rows have other bits", all.different).into()) } else { Ok(()) }
}
