//! `new`: a package with a model that runs.

use std::env;
use std::ffi::OsStr;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;

use super::package::metadata;
use super::print;

/// The program of a new package; compiled and run by `tests/compiled/`.
const PROGRAM: &str = include_str!("../../template/main.rs");

/// The crate that descriptions use.
const LIBRARY: &str = "lagrangian";

/// The profile of the manifest. Cargo reads it in the root of a workspace alone.
const PROFILE: &str = "\n# Motions need optimised code.\n[profile.dev]\nopt-level = 2\n";

/// Makes a package with a model to start from.
#[derive(Args)]
pub struct NewArguments {
    /// The folder; its last part is the name of the package.
    path: PathBuf,
    /// The name of the package where the folder has another one.
    #[arg(long)]
    name: Option<String>,
    /// Depends on the `lagrangian` crate in this folder instead of a published version.
    #[arg(long, value_name = "FOLDER")]
    lagrangian: Option<PathBuf>,
}

/// Runs `new`: `cargo new` with another program and a dependency, so that names, workspaces and version
/// control are treated as cargo treats them.
pub fn run(arguments: &NewArguments) -> Result<(), String> {
    let path = &arguments.path;
    let dependency = match &arguments.lagrangian {
        None => format!("{:?}", env!("CARGO_PKG_VERSION")),
        Some(folder) => format!("{{ path = {:?} }}", library(folder)?.display().to_string()),
    };
    let name = arguments.name.as_deref().map(OsStr::new).or_else(|| path.file_name());
    if name.is_some_and(|name| name == LIBRARY) {
        return Err(format!(
            "error: a package named `{LIBRARY}` cannot depend on the crate of that name; give it another one \
             with --name"
        ));
    }
    let mut new = cargo();
    new.args(["new", "--bin", "--quiet"]).arg(path);
    if let Some(name) = &arguments.name {
        new.arg("--name").arg(name);
    }
    output(&mut new).map_err(|message| in_our_words(&message))?;
    let manifest = path.join("Cargo.toml");
    let profile = if is_root(&manifest)? { PROFILE } else { "" };
    fill(path, &manifest, &format!("lagrangian = {dependency}\n{profile}"))
        .map_err(|error| format!("error: {}: {error}", path.display()))?;
    print(&format!(
        "{} is there. Next:\n\n  cd {0}\n  cargo run\n  cargo lagrange equations\n",
        path.display()
    ))
}

/// The folder of the library, as a path from anywhere.
fn library(folder: &Path) -> Result<PathBuf, String> {
    let failed = |what: &str| format!("error: --lagrangian {}: {what}", folder.display());
    let whole = fs::canonicalize(folder).map_err(|error| failed(&error.to_string()))?;
    let manifest = whole.join("Cargo.toml");
    let missing = || {
        failed(&format!(
            "the crate `{LIBRARY}` is not there; name the folder with the Cargo.toml of that crate"
        ))
    };
    if !manifest.is_file() {
        return Err(missing());
    }
    let metadata = metadata(Some(&manifest))?;
    let is_there = metadata
        .packages
        .iter()
        .any(|found| found.name.as_str() == LIBRARY && found.manifest_path == manifest);
    if is_there { Ok(whole) } else { Err(missing()) }
}

/// A message of `cargo new`. Where it is about the name of the package, its first line says what is wrong,
/// and the rest gives advice on files that a package of this command does not have.
fn in_our_words(message: &str) -> String {
    match message.lines().next() {
        Some(first) if message.contains("--name") || first.contains("package name") => {
            format!("{first}; give the package another one with --name")
        }
        _ => message.to_owned(),
    }
}

/// The cargo that runs this command, or the one of the path.
fn cargo() -> Command {
    Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// What a command prints, or its message.
fn output(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("error: cargo does not run: {error}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).trim_end().to_owned())
    }
}

/// Whether the package is the root of its workspace.
fn is_root(manifest: &Path) -> Result<bool, String> {
    let mut locate = cargo();
    locate
        .args(["locate-project", "--workspace", "--message-format", "plain", "--manifest-path"])
        .arg(manifest);
    let root = output(&mut locate)?;
    let same =
        |path: &Path| fs::canonicalize(path).map_err(|error| format!("error: {}: {error}", path.display()));
    Ok(same(manifest)? == same(Path::new(root.trim_end()))?)
}

/// Ends the manifest, whose last table is the one of dependencies, and writes the program.
fn fill(path: &Path, manifest: &Path, rest: &str) -> std::io::Result<()> {
    OpenOptions::new().append(true).open(manifest)?.write_all(rest.as_bytes())?;
    fs::write(path.join("src/main.rs"), PROGRAM)
}
