//! `verify`: the certificate of a model, computed by a program that is written, run and kept out of the
//! package.

use std::fs;
use std::path::Path;
use std::process::Command;

use cargo_lagrange::models::Model;
use cargo_metadata::{Metadata, Package, TargetKind};
use clap::Args;

use super::package::{all_models, metadata, package};

/// Checks identities of mechanics: positive mass matrix, power balance, conserved quantities, gradients of
/// constraints, and that generated code and your own functions agree.
///
/// Without a system, runs the tests that `verify = …` in the attributes of the package makes. With one, which
/// must be of the package's library and have `analysis` in its attribute, prints the certificate.
#[derive(Args)]
pub struct VerifyArguments {
    /// An expression that makes the system, with its path: 'my_crate::Pendulum { length: 1.0 }'.
    system: Option<String>,
    /// The package, as in `cargo build --package`; by default that of the current folder.
    #[arg(long, short)]
    package: Option<String>,
    /// The Cargo.toml to begin with, instead of the one that cargo finds from here.
    #[arg(long, value_name = "PATH")]
    manifest_path: Option<std::path::PathBuf>,
}

/// Runs `verify`.
pub fn run(arguments: &VerifyArguments) -> Result<(), String> {
    let metadata = metadata(arguments.manifest_path.as_deref())?;
    let package = package(&metadata, arguments.package.as_deref())?;
    match &arguments.system {
        Some(system) => certificate(&metadata, package, system),
        None => tests(package),
    }
}

/// Runs the tests that the attributes ask for.
fn tests(package: &Package) -> Result<(), String> {
    let found = all_models(package)?;
    let asking: Vec<&Model> = found.iter().filter(|model| model.has_argument("verify")).collect();
    if asking.is_empty() {
        return Err(format!(
            "error: no attribute in the package `{}` says `verify = …`; write it there, or name a system, as in \
             `cargo lagrange verify 'my_crate::Pendulum {{ length: 1.0 }}'`",
            package.name
        ));
    }
    for model in &asking {
        eprintln!("{model}");
    }
    // The tests of examples are built only if asked for.
    let status = cargo()
        .args(["test", "--quiet", "--all-targets", "--manifest-path"])
        .arg(package.manifest_path.as_std_path())
        .arg("satisfies_its_identities")
        .status()
        .map_err(|error| format!("error: cargo: {error}"))?;
    if status.success() { Ok(()) } else { Err("error: not verified".to_owned()) }
}

/// Prints the certificate of one system.
fn certificate(metadata: &Metadata, package: &Package, text: &str) -> Result<(), String> {
    let system: syn::Expr =
        syn::parse_str(text).map_err(|error| format!("error: `{text}` is not an expression: {error}"))?;
    if !package.targets.iter().any(|target| target.kind.contains(&TargetKind::Lib)) {
        return Err(format!(
            "error: the package `{}` has no library; write `verify = …` into the attribute of the model and run `cargo test`",
            package.name
        ));
    }
    let folder = metadata.target_directory.as_std_path().join("lagrange-verify").join(package.name.as_str());
    write(&folder, metadata, package, &system)
        .map_err(|error| format!("error: {}: {error}", folder.display()))?;
    let status = cargo()
        .args(["run", "--quiet", "--manifest-path"])
        .arg(folder.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(metadata.target_directory.as_std_path())
        .status()
        .map_err(|error| format!("error: cargo: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("error: `{text}` is not verified")) }
}

/// The cargo that called this command, or the one on the path.
fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// A package with one program, which depends on the user's.
fn write(folder: &Path, metadata: &Metadata, package: &Package, system: &syn::Expr) -> std::io::Result<()> {
    let source = package.manifest_path.parent().map_or("", |path| path.as_str());
    let name = &package.name;
    let manifest = format!(
        "[package]\nname = \"lagrange-verify\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\n{name} = {{ path = {source:?} }}\n"
    );
    let program = syn::parse_quote! {
        fn main() -> ::std::process::ExitCode {
            match (#system).verify() {
                Ok(certificate) => {
                    println!("{certificate}");
                    ::std::process::ExitCode::SUCCESS
                }
                Err(violation) => {
                    eprintln!("{violation}");
                    ::std::process::ExitCode::FAILURE
                }
            }
        }
    };
    fs::create_dir_all(folder.join("src"))?;
    fs::write(folder.join("Cargo.toml"), manifest)?;
    fs::write(folder.join("src/main.rs"), prettyplease::unparse(&program))?;
    // The versions that the user's package is built with.
    let lock = metadata.workspace_root.as_std_path().join("Cargo.lock");
    if lock.is_file() {
        fs::copy(lock, folder.join("Cargo.lock"))?;
    }
    Ok(())
}
