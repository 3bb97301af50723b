//! `new`: a package with a model that runs.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use super::print;

/// The program of a new package; compiled and run by `tests/compiled/`.
const PROGRAM: &str = include_str!("../../template/main.rs");

/// Makes a package with a model to start from.
#[derive(Args)]
pub struct NewArguments {
    /// The folder; its last part is the name of the package.
    path: PathBuf,
    /// Depends on the `lagrangian` crate in this folder instead of a published version.
    #[arg(long, value_name = "FOLDER")]
    lagrangian: Option<PathBuf>,
}

/// Runs `new`.
pub fn run(arguments: &NewArguments) -> Result<(), String> {
    let path = &arguments.path;
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    if !is_package_name(&name) {
        return Err(format!(
            "error: `{name}` is not the name of a package: begin with a letter, go on with letters, digits, - and _, and take no keyword"
        ));
    }
    if path.exists() {
        return Err(format!("error: {} is there already", path.display()));
    }
    let dependency = match &arguments.lagrangian {
        None => format!("{:?}", env!("CARGO_PKG_VERSION")),
        Some(folder) => {
            let folder =
                fs::canonicalize(folder).map_err(|error| format!("error: {}: {error}", folder.display()))?;
            format!("{{ path = {:?} }}", folder.display().to_string())
        }
    };
    let manifest = format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[dependencies]\nlagrangian = {dependency}\n\n\
         # Motions need optimised code.\n[profile.dev]\nopt-level = 2\n"
    );
    write(path, &manifest).map_err(|error| format!("error: {}: {error}", path.display()))?;
    print(&format!(
        "{} is there. Next:\n\n  cd {0}\n  cargo run\n  cargo lagrange equations\n",
        path.display()
    ))
}

/// Whether a crate of this name can be called by a name of Rust.
fn is_package_name(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.is_ascii()
        && syn::parse_str::<syn::Ident>(&name.replace('-', "_")).is_ok()
}

fn write(path: &Path, manifest: &str) -> std::io::Result<()> {
    fs::create_dir_all(path.join("src"))?;
    fs::write(path.join("Cargo.toml"), manifest)?;
    fs::write(path.join(".gitignore"), "/target\n")?;
    fs::write(path.join("src/main.rs"), PROGRAM)
}
