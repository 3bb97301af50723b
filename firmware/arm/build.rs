//! Designs the regulator on the machine that builds the firmware, and writes its gains as a table.

use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

#[path = "../../examples/support/arm.rs"]
#[allow(dead_code, reason = "the design needs the equations alone")]
mod arm;
#[path = "../../examples/support/regulator.rs"]
#[allow(dead_code, reason = "the desk compares costs, too")]
mod regulator;

/// The samples for which the gains stay the same: they change more slowly than the state.
const HELD: usize = 20;

fn main() -> Result<(), Box<dyn Error>> {
    for file in ["arm", "regulator"] {
        println!("cargo::rerun-if-changed=../../examples/support/{file}.rs");
    }
    let regulator = regulator::design(&arm::Arm { payload: 0.0 })?;
    // The gains in the middle of each group of samples.
    let kept: Vec<_> = regulator.gains.chunks(HELD).map(|group| group[group.len() / 2]).collect();
    let mut text = format!("/// Samples for which the gains stay.\npub const HELD: u32 = {HELD};\n\n");
    writeln!(
        text,
        "/// How often the torques are set \\[Hz].\npub const RATE: u16 = {};\n",
        regulator::RATE
    )?;
    writeln!(text, "/// Gains, column by column.\npub static GAINS: [[[f32; 6]; 12]; {}] = [", kept.len())?;
    for gains in kept {
        let columns: Vec<[f32; 6]> =
            gains.column_iter().map(|column| std::array::from_fn(|i| column[i] as f32)).collect();
        writeln!(text, "    {columns:?},")?;
    }
    text.push_str("];\n");
    fs::write(PathBuf::from(env::var("OUT_DIR")?).join("gains.rs"), text)?;
    Ok(())
}
