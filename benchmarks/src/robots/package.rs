//! [`Packages`]: a workspace in the target folder with a package for each robot.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use serde::Deserialize;

use super::{Base, Robot};
use crate::native::root;

/// The program of every robot.
const SERVE: &str = include_str!("../../robots/serve.rs");

/// The workspace.
pub struct Packages {
    folder: PathBuf,
    build: PathBuf,
}

/// A package that was built.
pub struct Built {
    /// The program.
    pub program: PathBuf,
    /// The time of building it, unless it was built already [s].
    pub seconds: Option<f64>,
}

/// Cargo's report of an artifact.
#[derive(Deserialize)]
struct Artifact {
    reason: String,
    #[serde(default)]
    fresh: bool,
    #[serde(default)]
    executable: Option<PathBuf>,
}

impl Packages {
    /// The workspace, with what all packages depend on compiled.
    pub fn new(folder: &Path) -> Result<Self, Box<dyn Error>> {
        let packages = Self { folder: folder.join("packages"), build: folder.join("build") };
        // The profile is that of all subjects.
        let manifest = "[workspace]\nresolver = \"3\"\nmembers = [\"*\"]\nexclude = [\"Cargo.*\"]\n\n\
                        [profile.release]\nlto = \"fat\"\ncodegen-units = 1\npanic = \"abort\"\n";
        packages.write("Cargo.toml", manifest)?;
        packages.write("serve/Cargo.toml", &manifest_of("serve", &["lagrangian"]))?;
        packages.write("serve/src/lib.rs", SERVE)?;
        if !packages.folder.join("Cargo.lock").exists() {
            std::fs::copy(root().join("Cargo.lock"), packages.folder.join("Cargo.lock"))?;
        }
        packages.cargo("serve")?;
        Ok(packages)
    }

    /// Describes a robot, and builds the program that serves something.
    pub fn build(&self, robot: &Robot, what: &str) -> Result<Built, Box<dyn Error>> {
        let name = format!("{}-{what}", robot.name);
        self.write(&format!("{name}/Cargo.toml"), &manifest_of(&name, &["lagrangian", "serve"]))?;
        self.write(&format!("{name}/src/robot.rs"), &describe(robot, what == "derivatives")?)?;
        let main = format!(
            "//! {name}.\n\nmod robot;\n\nuse robot::Robot;\n\n\
             fn main() {{\n    serve::{what}(&Robot::default(), &Robot::COORDINATES);\n}}\n"
        );
        self.write(&format!("{name}/src/main.rs"), &main)?;
        eprintln!("robots: building {name}");
        let start = Instant::now();
        let built = self.cargo(&name)?;
        let seconds = start.elapsed().as_secs_f64();
        let artifact =
            built.into_iter().find(|artifact| artifact.executable.is_some()).ok_or("no program")?;
        let program = artifact.executable.ok_or("no program")?;
        Ok(Built { program, seconds: (!artifact.fresh).then_some(seconds) })
    }

    /// Builds a package. Returns cargo's reports of its artifacts.
    fn cargo(&self, package: &str) -> Result<Vec<Artifact>, Box<dyn Error>> {
        let mut flags = std::env::var("RUSTFLAGS").unwrap_or_default();
        flags += " -C target-cpu=native";
        let output = cargo()
            .args(["build", "--release", "--quiet", "--message-format", "json-render-diagnostics"])
            .args(["--package", package, "--manifest-path"])
            .arg(self.folder.join("Cargo.toml"))
            .arg("--target-dir")
            .arg(&self.build)
            .env("RUSTFLAGS", flags.trim())
            .stderr(Stdio::inherit())
            .output()?;
        if !output.status.success() {
            return Err(format!("{package} does not compile").into());
        }
        let text = String::from_utf8(output.stdout)?;
        let messages: Result<Vec<Artifact>, _> = text.lines().map(serde_json::from_str).collect();
        Ok(messages?.into_iter().filter(|message| message.reason == "compiler-artifact").collect())
    }

    /// Writes a file, unless it says the same already, so that what cargo has built stays.
    fn write(&self, name: &str, text: &str) -> Result<(), Box<dyn Error>> {
        let path = self.folder.join(name);
        if std::fs::read_to_string(&path).is_ok_and(|before| before == text) {
            return Ok(());
        }
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        Ok(std::fs::write(path, text)?)
    }
}

/// A description by the importer, with torques at all joints and fingers that move by themselves, as in
/// Pinocchio.
fn describe(robot: &Robot, derivatives: bool) -> Result<String, Box<dyn Error>> {
    let mut command = cargo();
    command
        .args(["run", "--quiet", "--package", "cargo-lagrange", "--manifest-path"])
        .arg(root().join("Cargo.toml"))
        .args(["--", "import", "--name", "Robot", "--inputs", "all", "--mimic", "ignore"]);
    if robot.base.is_some() {
        command.arg("--floating");
    }
    if robot.base == Some(Base::Angles) {
        command.arg("--euler");
    }
    if derivatives {
        command.args(["--with", "jacobians"]);
    }
    // Its notes are about what Pinocchio leaves out too.
    let output = command.arg(&robot.urdf).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    Ok(String::from_utf8(output.stdout)?)
}

fn manifest_of(name: &str, dependencies: &[&str]) -> String {
    let mut text =
        format!("[package]\nname = \"{name}\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[dependencies]\n");
    for dependency in dependencies {
        let (path, features) = match *dependency {
            "lagrangian" => (root(), ", features = [\"double-double\"]"),
            other => (Path::new("..").join(other), ""),
        };
        text += &format!("{dependency} = {{ path = {:?}{features} }}\n", path.display().to_string());
    }
    text
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}
