//! The command as a user and as cargo call it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn lagrange(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cargo-lagrange"));
    command.current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files"));
    command.args(arguments).output().expect("the command starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn snapshot(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots").join(name);
    fs::read_to_string(path).expect("the snapshot is there")
}

/// A path in the folder that cargo has for tests.
fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

#[test]
fn a_description_goes_to_standard_output_and_notes_to_standard_error() {
    for arguments in [&["import", "two_link.urdf"][..], &["lagrange", "import", "two_link.urdf"]] {
        let output = lagrange(arguments);
        assert!(output.status.success());
        assert_eq!(text(&output.stdout), snapshot("two_link.rs"));
        assert_eq!(text(&output.stderr), snapshot("two_link.notes"));
    }
}

#[test]
fn options_are_those_of_the_library() {
    let output = lagrange(&["import", "two_link.urdf", "--parameters", "--with", "jacobians"]);
    assert_eq!(text(&output.stdout), snapshot("two_link_parameters.rs"), "{}", text(&output.stderr));
    let output = lagrange(&["import", "two_link.urdf", "--limits", "--friction", "--name", "Rough"]);
    assert_eq!(text(&output.stdout), snapshot("two_link_rough.rs"), "{}", text(&output.stderr));
    let arguments = ["import", "everything.urdf", "--mimic", "constrain", "--inputs", "all"];
    assert_eq!(text(&lagrange(&arguments).stdout), snapshot("everything_constrained.rs"));
    let arguments = ["import", "two_link.urdf", "--floating", "--inputs", "none"];
    assert_eq!(text(&lagrange(&arguments).stdout), snapshot("two_link_floating.rs"));
    let output = lagrange(&["import", "everything.urdf", "--euler"]);
    assert_eq!(text(&output.stdout), snapshot("everything_euler.rs"));
    let output = lagrange(&["import", "two_link.urdf", "--parameters=masses"]);
    let masses = text(&output.stdout);
    assert!(masses.contains("pub upper_mass: f64") && !masses.contains("upper_centre_z"), "{masses}");
}

#[test]
fn a_file_is_replaced_only_by_force() {
    let path = scratch("replaced.rs");
    fs::write(&path, "mine").expect("the folder can be written to");
    let name = path.to_string_lossy();
    let output = lagrange(&["import", "two_link.urdf", "--output", &name]);
    assert!(!output.status.success());
    assert!(text(&output.stderr).contains("is there already; replace it with --force"));
    assert_eq!(fs::read_to_string(&path).ok().as_deref(), Some("mine"));
    let output = lagrange(&["import", "two_link.urdf", "--output", &name, "--force"]);
    assert!(output.status.success() && output.stdout.is_empty());
    assert_eq!(fs::read_to_string(&path).ok(), Some(snapshot("two_link.rs")));
}

#[test]
fn mistakes_are_errors() {
    for (arguments, message) in [
        (&["import", "missing.urdf"][..], "error: missing.urdf: "),
        (
            &["import", "two_link.urdf", "--name", "two link"],
            "error: --name two link: write a name of a type",
        ),
        (
            &["import", "two_link.urdf", "--right-angles", "2"],
            "error: --right-angles: write an angle from 0 to 0.1",
        ),
        (
            &["import", "two_link.xml", "--floating"],
            "error: two_link.xml:1:1: <mujoco>: --floating is for URDF",
        ),
    ] {
        let output = lagrange(arguments);
        assert!(!output.status.success() && output.stdout.is_empty());
        assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
    }
}
