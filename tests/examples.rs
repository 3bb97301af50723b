//! Runs every example: `scripts/check.sh examples`.
// Two examples include the same study.
#![allow(clippy::duplicate_mod)]

use std::collections::BTreeSet;
use std::error::Error;
use std::fs;
use std::path::Path;

macro_rules! run {
    ($($example:ident),* $(,)?) => {
        const EXAMPLES: &[&str] = &[$(stringify!($example)),*];

        $(#[test]
        fn $example() -> Result<(), Box<dyn Error>> {
            $example::main()
        })*
    };
}

run! {
    arm_control,
    cart_pole,
    cartesian_pendulum,
    chain_modes,
    charge_in_magnetic_field,
    double_pendulum,
    flip_times,
    heavy_top,
    magnetic_basins,
    own_math,
    pleiades,
    rocking_block,
    rolling_disc,
    rotating_frame,
    spring_pendulum,
    squeezer,
    stick_slip,
    ten_link_chain,
    whirling_hoop,
}

#[path = "../examples/arm_control.rs"]
mod arm_control;
#[path = "../examples/cart_pole.rs"]
mod cart_pole;
#[path = "../examples/cartesian_pendulum.rs"]
mod cartesian_pendulum;
#[path = "../examples/chain_modes.rs"]
mod chain_modes;
#[path = "../examples/charge_in_magnetic_field.rs"]
mod charge_in_magnetic_field;
#[path = "../examples/double_pendulum.rs"]
mod double_pendulum;
#[path = "../examples/flip_times.rs"]
mod flip_times;
#[path = "../examples/heavy_top.rs"]
mod heavy_top;
#[path = "../examples/magnetic_basins.rs"]
mod magnetic_basins;
#[path = "../examples/own_math.rs"]
mod own_math;
#[path = "../examples/pleiades.rs"]
mod pleiades;
#[path = "../examples/rocking_block.rs"]
mod rocking_block;
#[path = "../examples/rolling_disc.rs"]
mod rolling_disc;
#[path = "../examples/rotating_frame.rs"]
mod rotating_frame;
#[path = "../examples/spring_pendulum.rs"]
mod spring_pendulum;
#[path = "../examples/squeezer.rs"]
mod squeezer;
#[path = "../examples/stick_slip.rs"]
mod stick_slip;
#[path = "../examples/ten_link_chain.rs"]
mod ten_link_chain;
#[path = "../examples/whirling_hoop.rs"]
mod whirling_hoop;

/// Runs where its feature is on, as `scripts/check.sh digits` has it.
const WITH_FEATURE: &str = "true_digits";

#[cfg(feature = "double-double")]
#[path = "../examples/true_digits.rs"]
mod true_digits;

#[cfg(feature = "double-double")]
#[test]
fn true_digits() -> Result<(), Box<dyn Error>> {
    true_digits::main()
}

#[test]
fn no_example_is_forgotten() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            found.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
        }
    }
    let run: BTreeSet<String> = EXAMPLES.iter().chain([&WITH_FEATURE]).map(ToString::to_string).collect();
    assert_eq!(found, run);
    Ok(())
}
