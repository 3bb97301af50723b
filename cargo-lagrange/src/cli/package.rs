//! From the arguments to a package and the models in it.

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};

use cargo_lagrange::models::{Model, models};
use cargo_metadata::{Metadata, MetadataCommand, Package, TargetKind};
use clap::Args;

/// Which package, and which of its models.
#[derive(Args)]
pub struct Selection {
    /// The name of the type; without it all models of the package.
    model: Option<String>,
    /// The package, as in `cargo build --package`; by default that of the current folder.
    #[arg(long, short)]
    package: Option<String>,
    /// The Cargo.toml to begin with, instead of the one that cargo finds from here.
    #[arg(long, value_name = "PATH")]
    manifest_path: Option<PathBuf>,
    /// Reads this file and its modules instead of the targets of a package.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["package", "manifest_path"])]
    file: Option<PathBuf>,
}

/// The most models that an error names.
const MOST: usize = 10;

impl Selection {
    /// The selected models; at least one.
    pub fn models(&self) -> Result<Vec<Model>, String> {
        let (mut found, place) = match &self.file {
            Some(file) => (read(file)?, file.display().to_string()),
            None => {
                let metadata = metadata(self.manifest_path.as_deref())?;
                let package = package(&metadata, self.package.as_deref())?;
                (all_models(package)?, format!("the package `{}`", package.name))
            }
        };
        let mut names = found.iter().take(MOST).map(Model::to_string).collect::<Vec<_>>().join(", ");
        if found.len() > MOST {
            names += &format!(" and {} more", found.len() - MOST);
        }
        if let Some(name) = &self.model {
            found.retain(|model| model.name == *name);
        }
        match (&self.model, found.is_empty(), names.is_empty()) {
            (_, false, _) => Ok(found),
            (Some(name), true, false) => {
                Err(format!("error: no model `{name}` in {place}; there are {names}"))
            }
            _ => Err(format!(
                "error: no `#[lagrangian] impl` in {place}; name another package with --package, or a file with --file"
            )),
        }
    }
}

/// The models of all targets of a package.
pub fn all_models(package: &Package) -> Result<Vec<Model>, String> {
    // A module may belong to several targets, by paths that are written in different ways.
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for root in roots(package) {
        let more = read(&root)?.into_iter();
        found.extend(more.filter(|model| seen.insert((model.file.canonicalize().ok(), model.line))));
    }
    Ok(found)
}

fn read(root: &Path) -> Result<Vec<Model>, String> {
    models(root).map_err(|unread| format!("error: {unread}"))
}

/// Cargo's description of a workspace.
pub fn metadata(manifest: Option<&Path>) -> Result<Metadata, String> {
    let mut command = MetadataCommand::new();
    if let Some(path) = manifest {
        command.manifest_path(path);
    }
    command.no_deps().exec().map_err(|error| format!("error: {}", error.to_string().trim()))
}

/// The package of this name. Without a name, the one whose folder the current folder is in, or else the only
/// one of the workspace.
pub fn package<'a>(metadata: &'a Metadata, name: Option<&str>) -> Result<&'a Package, String> {
    let members = metadata.workspace_packages();
    if let Some(name) = name {
        return members
            .iter()
            .find(|package| package.name.as_str() == name)
            .copied()
            .ok_or_else(|| format!("error: no package `{name}`; there are {}", names(&members)));
    }
    let here = env::current_dir().unwrap_or_default();
    let folder =
        |package: &Package| package.manifest_path.parent().map(|path| path.as_std_path().to_path_buf());
    members
        .iter()
        .filter(|package| folder(package).is_some_and(|folder| here.starts_with(folder)))
        .max_by_key(|package| package.manifest_path.as_str().len())
        .or(if let [one] = &members[..] { Some(one) } else { None })
        .copied()
        .ok_or_else(|| format!("error: name one of the packages with --package: {}", names(&members)))
}

fn names(packages: &[&Package]) -> String {
    packages.iter().map(|package| package.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// The main files of the targets; build scripts have no models.
fn roots(package: &Package) -> Vec<PathBuf> {
    let targets = package.targets.iter().filter(|target| !target.kind.contains(&TargetKind::CustomBuild));
    let here = env::current_dir().unwrap_or_default();
    targets
        .map(|target| {
            let path = target.src_path.as_std_path();
            // Shorter to read where the file is below the current folder.
            path.strip_prefix(&here).unwrap_or(path).to_path_buf()
        })
        .collect()
}
