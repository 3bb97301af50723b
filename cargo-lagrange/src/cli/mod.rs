//! The command line: arguments, files, standard output and error. A file a subcommand.

mod import;
mod new;
mod package;
mod show;
mod verify;

use std::ffi::OsString;
use std::io::{ErrorKind, Write};

use clap::{Parser, Subcommand};

/// Mechanical models for the `lagrangian` crate.
#[derive(Parser)]
#[command(name = "cargo-lagrange", bin_name = "cargo lagrange", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Equations(show::EquationsArguments),
    /// Prints what was proved of models and what their code leaves out.
    Structure(show::ModelArguments),
    /// Prints the operations of one evaluation of the accelerations.
    Cost(show::ModelArguments),
    Expand(show::ExpandArguments),
    Verify(verify::VerifyArguments),
    New(new::NewArguments),
    Import(import::ImportArguments),
}

/// Runs a command line, called as `cargo-lagrange …` or, by cargo, as `cargo-lagrange lagrange …`.
pub fn run(arguments: impl Iterator<Item = OsString>) -> Result<(), String> {
    let mut arguments: Vec<OsString> = arguments.collect();
    if arguments.get(1).is_some_and(|first| first == "lagrange") {
        arguments.remove(1);
    }
    match Cli::parse_from(arguments).command {
        Command::Equations(arguments) => show::equations(&arguments),
        Command::Structure(arguments) => show::structure(&arguments),
        Command::Cost(arguments) => show::cost(&arguments),
        Command::Expand(arguments) => show::expand(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::New(arguments) => new::run(&arguments),
        Command::Import(arguments) => import::run(&arguments),
    }
}

/// Writes to standard output. A reader that has read enough is no error.
fn print(text: &str) -> Result<(), String> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(|error| format!("error: standard output: {error}")),
    }
}
