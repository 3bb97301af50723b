//! The checks of built kernels for `scripts/gpu.sh`: `lagrange-gpu check FILE`, `fuse FILE TO`, `table EXACT
//! FUSED`.

use std::env;
use std::error::Error;
use std::fs;
use std::process::ExitCode;

use lagrange_gpu::{Arithmetic, Ptx, Usage};

/// Lists the kernels in a file. Refuses kernels that can panic or whose operations are not those of a CPU.
fn check(path: &str) -> Result<(), Box<dyn Error>> {
    let ptx = Ptx::read(path)?;
    let unlike = ptx.unlike_a_cpu();
    if unlike > 0 {
        return Err(format!("{unlike} operations in {path} round otherwise than on a CPU").into());
    }
    let kernels: Vec<_> = ptx.kernels().collect();
    println!(
        "{path}: PTX {} for {} with {} kernels: {}",
        ptx.version(),
        ptx.target(),
        kernels.len(),
        kernels.join(", ")
    );
    println!("no panic, no allocation, nothing unresolved, nothing fused");
    Ok(())
}

/// A table of the assembler's figures for the kernels in both kinds of arithmetic.
fn table(exact: &str, fused: &str) -> Result<(), Box<dyn Error>> {
    let [mut exact, fused] =
        [fs::read_to_string(exact)?, fs::read_to_string(fused)?].map(|report| Usage::of(&report));
    exact.sort_by(|a, b| a.kernel.cmp(&b.kernel));
    println!(
        "| kernel | registers | stack \\[B] | spilled: written \\[B] | read \\[B] | fused: registers | stack | written | read |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for usage in &exact {
        let other = fused.iter().find(|other| other.kernel == usage.kernel);
        let other = other.ok_or("a kernel is missing in fused arithmetic")?;
        let cells = |of: &Usage| {
            format!("{} | {} | {} | {}", of.registers, of.stack, of.spill_stores, of.spill_loads)
        };
        println!("| `{}` | {} | {} |", usage.kernel, cells(usage), cells(other));
    }
    if exact.is_empty() { Err("the assembler tells of no kernel".into()) } else { Ok(()) }
}

fn run() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["check", path] => check(path),
        ["fuse", path, to] => Ok(fs::write(to, Ptx::read(path)?.text(Arithmetic::Fused))?),
        ["table", exact, fused] => table(exact, fused),
        _ => Err("usage: lagrange-gpu check FILE | fuse FILE TO | table EXACT FUSED".into()),
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("gpu: {error}");
            ExitCode::FAILURE
        }
    }
}
