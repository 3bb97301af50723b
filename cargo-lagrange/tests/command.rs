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

/// What `new` says, and whether it left a folder.
fn new(arguments: &[&str]) -> (bool, String) {
    let folder = tempfile::tempdir().expect("the machine has room");
    let lagrangian = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut command = Command::new(env!("CARGO_BIN_EXE_cargo-lagrange"));
    command.current_dir(folder.path()).arg("new").args(arguments);
    if !arguments.contains(&"--lagrangian") {
        command.arg("--lagrangian").arg(lagrangian);
    }
    let output = command.output().expect("the command starts");
    let is_empty = fs::read_dir(folder.path()).expect("the folder is there").next().is_none();
    assert_eq!(output.status.success(), !is_empty, "{}", text(&output.stderr));
    (!is_empty, text(&output.stderr))
}

#[test]
fn new_refuses_what_would_not_build() {
    let here = env!("CARGO_MANIFEST_DIR");
    let missing = "the crate `lagrangian` is not there; name the folder with the Cargo.toml of that crate";
    let files = format!("{here}/tests");
    let other = "; give the package another one with --name\n";
    let own = "error: a package named `lagrangian` cannot depend on the crate of that name";
    for (arguments, messages) in [
        (&["swing", "--lagrangian", here][..], &["error: --lagrangian ", missing][..]),
        (&["swing", "--lagrangian", &files], &["error: --lagrangian ", missing]),
        (&["swing", "--lagrangian", "nowhere"], &["error: --lagrangian nowhere: No such file"]),
        (&["lagrangian"], &[own, "; give it another one with --name\n"]),
        (&["swing", "--name", "lagrangian"], &[own]),
        (&["loop"], &["error: ", "`loop`", other]),
        (&["3d"], &["error: ", "`3d`", other]),
        (&["a b"], &["error: ", "`a b`", other]),
        (&["swing", "--name", "test"], &["error: ", "`test`", other]),
    ] {
        let (is_there, said) = new(arguments);
        assert!(!is_there && said.lines().count() == 1, "{arguments:?} {said}");
        assert!(messages.iter().all(|message| said.contains(message)), "{arguments:?} {said}");
    }
    assert!(new(&["lagrangian", "--name", "swing"]).0);
    assert!(new(&["swing"]).0);
}
