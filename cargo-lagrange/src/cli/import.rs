//! `cargo lagrange import`: arguments, files, standard output and error.

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

use cargo_lagrange::import::{Following, Inputs, Options, Parameters, import};
use clap::{Args, ValueEnum};

use super::print;

/// The program in the help is compiled and run by `tests/compiled/`.
const AFTER_HELP: &str = concat!(
    "Example:
  cargo lagrange import robot.urdf --name Arm --output src/arm.rs

and in src/main.rs, with `lagrangian` among the dependencies:

mod arm;
use arm::Arm;
use lagrangian::prelude::*;

",
    include_str!("../../tests/files/usage.rs"),
    "
A description is ordinary Rust: change it, add constraints, contacts and forces to it."
);

/// Writes a description of the robot in a URDF or MJCF file.
///
/// The description goes to standard output, notes on what was decided and left out go to standard error.
#[derive(Args)]
#[command(after_help = AFTER_HELP)]
pub struct ImportArguments {
    /// The URDF or MJCF file.
    file: PathBuf,
    /// The name of the struct, such as `Ur5`; by default that of the robot.
    #[arg(long)]
    name: Option<String>,
    /// Writes into this file instead of standard output.
    #[arg(long, short)]
    output: Option<PathBuf>,
    /// Replaces the file of --output if it is there already.
    #[arg(long, requires = "output")]
    force: bool,
    /// Lets the root of a URDF move freely: the coordinate `base: Pose`.
    #[arg(long)]
    floating: bool,
    /// Writes orientations as roll, pitch and yaw, singular at a pitch of ±90°, instead of `Pose` and
    /// `Rotation`.
    #[arg(long)]
    euler: bool,
    /// Makes joint limits stops (#[unilateral]); without it motions are smooth and know no limits.
    #[arg(long)]
    limits: bool,
    /// Makes dry friction of the joints part of the model (#[friction]); such motions go by `simulate` and by
    /// the stepper of `Jet`.
    #[arg(long)]
    friction: bool,
    /// Which joints have inputs.
    #[arg(long, value_enum, default_value = "actuated")]
    inputs: InputsArgument,
    /// What to do with joints that follow others.
    #[arg(long, value_enum, default_value = "eliminate")]
    mimic: MimicArgument,
    /// Makes these numbers fields of the struct instead of literals (which are faster); all kinds if none is
    /// named.
    #[arg(long, value_enum, value_delimiter = ',', num_args = 0.., require_equals = true)]
    parameters: Option<Vec<ParametersArgument>>,
    /// Further arguments of the attribute, such as jacobians,analysis.
    #[arg(long, value_delimiter = ',')]
    with: Vec<String>,
    /// How close to a right angle an angle is one [rad].
    #[arg(long, value_name = "TOLERANCE", default_value_t = 1e-9)]
    right_angles: f64,
    /// Takes inertias that are not positive definite, with a warning.
    #[arg(long)]
    unphysical: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum InputsArgument {
    /// Those with a transmission or an actuator; all, where the file has none.
    Actuated,
    /// All that turn or slide.
    All,
    /// None.
    None,
}

#[derive(Clone, Copy, ValueEnum)]
enum MimicArgument {
    /// They have no coordinate of their own.
    Eliminate,
    /// A constraint ties them, whose reaction is the force of the gear.
    Constrain,
    /// They move by themselves.
    Ignore,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum ParametersArgument {
    /// Masses.
    Masses,
    /// Centres of mass.
    Centres,
    /// Moments and products of inertia.
    Inertias,
    /// Distances between joints.
    Lengths,
}

/// Runs the command.
pub fn run(arguments: &ImportArguments) -> Result<(), String> {
    let file = arguments.file.display().to_string();
    let text = fs::read_to_string(&arguments.file).map_err(|error| format!("error: {file}: {error}"))?;
    let options = options(arguments)?;
    let import = import(&file, &text, &options).map_err(|report| report.to_string())?;
    for note in &import.notes {
        eprintln!("{note}");
    }
    let Some(output) = &arguments.output else {
        return print(&import.text);
    };
    let opened = fs::OpenOptions::new()
        .write(true)
        .create(true)
        .truncate(true)
        .create_new(!arguments.force)
        .open(output);
    let written = opened.and_then(|mut file| file.write_all(import.text.as_bytes()));
    written.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => {
            format!(
                "error: {} is there already; replace it with --force, or name another file",
                output.display()
            )
        }
        _ => format!("error: {}: {error}", output.display()),
    })
}

fn options(arguments: &ImportArguments) -> Result<Options, String> {
    if let Some(name) = &arguments.name
        && !cargo_lagrange::import::is_type_name(name)
    {
        return Err(format!(
            "error: --name {name}: write a name of a type, such as `Ur5`, that the prelude does not have"
        ));
    }
    if !(0.0..0.1).contains(&arguments.right_angles) {
        return Err("error: --right-angles: write an angle from 0 to 0.1 rad".to_owned());
    }
    let parameters = arguments.parameters.as_ref().map_or(Parameters::default(), |kinds| {
        let has = |kind| kinds.is_empty() || kinds.contains(&kind);
        Parameters {
            masses: has(ParametersArgument::Masses),
            centres: has(ParametersArgument::Centres),
            inertias: has(ParametersArgument::Inertias),
            lengths: has(ParametersArgument::Lengths),
        }
    });
    Ok(Options {
        name: arguments.name.clone(),
        floating: arguments.floating,
        euler: arguments.euler,
        inputs: match arguments.inputs {
            InputsArgument::Actuated => Inputs::Actuated,
            InputsArgument::All => Inputs::All,
            InputsArgument::None => Inputs::None,
        },
        limits: arguments.limits,
        friction: arguments.friction,
        mimic: match arguments.mimic {
            MimicArgument::Eliminate => Following::Eliminate,
            MimicArgument::Constrain => Following::Constrain,
            MimicArgument::Ignore => Following::Ignore,
        },
        parameters,
        with: arguments.with.clone(),
        tolerance: arguments.right_angles,
        unphysical: arguments.unphysical,
    })
}
