//! Kernels on the first graphics processor, beside the cores of this machine: `run FILE.ptx [KERNEL …]`, or
//! `run EXACT.cubin FUSED.cubin [KERNEL …]` if they are assembled; without names all of them. It prints the
//! last section of `benchmarks/GPU.md`. Motions whose bits are not those of this machine are an error.

use std::env;
use std::error::Error;
use std::thread;
use std::time::Instant;

use kernels::*;
use lagrange_gpu::{Arithmetic, Error as GpuError, Gpu, Kernel, Kernels, Ptx, Rows, Words, kernel};
use lagrangian::MotionError;

/// Motions on the processor: many, or a processor would not be full to the end.
const MOTIONS: u64 = 1 << 19;

/// Motions on the cores: fewer, so that it does not take hours; all of them are compared.
const HERE: u64 = 1 << 14;

/// Steps of 1/128 s.
const STEPS: Steps = (1.0 / 128.0, 256);

/// Ten seconds.
const UNTIL: Until = (10.0, 1e-9);

/// Two seconds with contacts.
#[cfg(feature = "contacts")]
const SOON: Until = (2.0, 1e-9);

/// Rows, and the time that they took \[s].
type Timed<S, R> = Result<(Rows<S, R, MotionError<f64>>, f64), GpuError>;

/// Kernels in both kinds of arithmetic, and what was found.
struct Comparison {
    exact: Kernels,
    fused: Kernels,
    cores: usize,
    different: u64,
    /// The kernels that are asked for; all if none is.
    names: Vec<String>,
}

impl Comparison {
    /// The time of a launch and of its copies \[s].
    fn time<S, R>(&self, kernels: &Kernels, kernel: Kernel<S, R, MotionError<f64>>, setting: S) -> Timed<S, R>
    where
        S: Words + Copy,
        R: Words,
    {
        // The first launch makes room for the stacks.
        kernels.run(kernel, setting, 64)?;
        let start = Instant::now();
        let rows = kernels.run(kernel, setting, MOTIONS)?;
        Ok((rows, start.elapsed().as_secs_f64()))
    }

    /// A row of the table: rates, registers and equality of bits.
    fn row<S, R>(&mut self, kernel: Kernel<S, R, MotionError<f64>>, setting: S) -> Result<(), Box<dyn Error>>
    where
        S: Words + Copy + Sync,
        R: Words,
    {
        if !self.names.is_empty() && !self.names.iter().any(|name| name == kernel.name()) {
            return Ok(());
        }
        let (rows, seconds) = self.time(&self.exact, kernel, setting)?;
        let exact = MOTIONS as f64 / seconds;
        let fused = MOTIONS as f64 / self.time(&self.fused, kernel, setting)?.1;
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
    let (paths, names): (Vec<_>, Vec<_>) =
        env::args().skip(1).partition(|word| word.ends_with(".ptx") || word.ends_with(".cubin"));
    let gpu = match Gpu::new(0) {
        Err(error @ (GpuError::NoDriver | GpuError::NoDevice { .. })) => {
            println!("nothing is run: {error}");
            return Ok(());
        }
        gpu => gpu?,
    };
    let cores = thread::available_parallelism()?.get();
    println!(
        "## On a processor\n\n{MOTIONS} motions a kernel on {}, with the copies of their rows; {HERE} of them on {cores} cores of its host as",
        gpu.name()?
    );
    println!(
        "well, by the same function built for all x86-64. Steps: {} of {} s; under error control: {} s with tolerance {:e}.",
        STEPS.1, STEPS.0, UNTIL.0, UNTIL.1
    );
    println!("\n| kernel | motions/s | fused | on the cores | ratio | same bits | registers | stack \\[B] |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    let start = Instant::now();
    let [exact, fused] = match paths.as_slice() {
        [ptx] => {
            let ptx = Ptx::read(ptx)?;
            [Arithmetic::Exact, Arithmetic::Fused].map(|arithmetic| gpu.load(&ptx, arithmetic))
        }
        [exact, fused] => {
            [gpu.load_assembled(exact, Arithmetic::Exact), gpu.load_assembled(fused, Arithmetic::Fused)]
        }
        _ => return Err("usage: run FILE.ptx | run EXACT.cubin FUSED.cubin".into()),
    };
    eprintln!("the kernels are loaded after {:.3} s", start.elapsed().as_secs_f64());
    let mut all = Comparison { exact: exact?, fused: fused?, cores, different: 0, names };
    all.row(kernel!(double_pendulum_rk4), STEPS)?;
    all.row(kernel!(double_pendulum_jet6), STEPS)?;
    all.row(kernel!(double_pendulum_adaptive), UNTIL)?;
    all.row(kernel!(double_pendulum_dop853), UNTIL)?;
    all.row(kernel!(cart_pole_jet6), STEPS)?;
    all.row(kernel!(cart_pole_adaptive), UNTIL)?;
    all.row(kernel!(cart_pole_dop853), UNTIL)?;
    all.row(kernel!(kepler_jet6), STEPS)?;
    all.row(kernel!(kepler_adaptive), UNTIL)?;
    all.row(kernel!(kepler_dop853), UNTIL)?;
    all.row(kernel!(links_jet6), STEPS)?;
    all.row(kernel!(links_adaptive), UNTIL)?;
    all.row(kernel!(links_dop853), UNTIL)?;
    all.row(kernel!(four_bar_jet6), STEPS)?;
    all.row(kernel!(four_bar_adaptive), UNTIL)?;
    all.row(kernel!(four_bar_dop853), UNTIL)?;
    #[cfg(feature = "contacts")]
    {
        all.row(kernel!(puck), SOON)?;
        all.row(kernel!(puck_apex), SOON)?;
        all.row(kernel!(puck_steps), SOON)?;
        all.row(kernel!(belt), SOON)?;
        all.row(kernel!(stone), SOON)?;
        all.row(kernel!(bearing), SOON)?;
    }
    if all.different > 0 { Err(format!("{} rows have other bits", all.different).into()) } else { Ok(()) }
}
