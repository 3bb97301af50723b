//! Descriptions of the files in `files/`, with what is said about them: `snapshots/`.
//! `UPDATE_SNAPSHOTS=1 cargo test -p cargo-lagrange --test snapshots` writes them again; read the difference.

use std::fs;
use std::path::Path;

use cargo_lagrange::import::{Following, Inputs, Options, Parameters, import};

fn holds(file: &str, name: &str, options: &Options) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let text = fs::read_to_string(folder.join("files").join(file)).expect("the file is there");
    let import = import(file, &text, options).unwrap_or_else(|report| panic!("{report}"));
    let notes = import.notes.join("\n") + "\n";
    for (ending, found) in [("rs", import.text), ("notes", notes)] {
        let path = folder.join("snapshots").join(format!("{name}.{ending}"));
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
            fs::write(&path, &found).expect("the snapshot can be written");
        }
        let expected = fs::read_to_string(&path).unwrap_or_default();
        assert!(found == expected, "{} differs:\n{found}", path.display());
        assert!(found.lines().all(|line| !line.ends_with(' ')), "{} has spaces at line ends", path.display());
    }
}

#[test]
fn two_link() {
    holds("two_link.urdf", "two_link", &Options::default());
}

#[test]
fn two_link_with_all_that_is_optional() {
    let options =
        Options { limits: true, friction: true, name: Some("Rough".to_owned()), ..Options::default() };
    holds("two_link.urdf", "two_link_rough", &options);
}

#[test]
fn two_link_with_parameters() {
    let parameters = Parameters { masses: true, centres: true, inertias: true, lengths: true };
    let options = Options { parameters, with: vec!["jacobians".to_owned()], ..Options::default() };
    holds("two_link.urdf", "two_link_parameters", &options);
}

#[test]
fn two_link_on_a_floating_base() {
    let options = Options { floating: true, inputs: Inputs::None, ..Options::default() };
    holds("two_link.urdf", "two_link_floating", &options);
}

#[test]
fn two_link_as_mjcf() {
    holds("two_link.xml", "two_link_mjcf", &Options::default());
}

#[test]
fn everything() {
    holds("everything.urdf", "everything", &Options::default());
}

#[test]
fn everything_with_a_constraint() {
    let options = Options { mimic: Following::Constrain, inputs: Inputs::All, ..Options::default() };
    holds("everything.urdf", "everything_constrained", &options);
}

#[test]
fn everything_with_angles() {
    holds("everything.urdf", "everything_euler", &Options { euler: true, ..Options::default() });
}

#[test]
fn joints() {
    holds("joints.xml", "joints", &Options::default());
}

#[test]
fn ties_as_constraints() {
    let options = Options { mimic: Following::Constrain, inputs: Inputs::None, ..Options::default() };
    holds("tied.xml", "tied_constrained", &options);
}

#[test]
fn free_and_ball_joints() {
    holds("floating.xml", "floating", &Options::default());
}

#[test]
fn free_and_ball_joints_with_angles() {
    holds("floating.xml", "floating_euler", &Options { euler: true, ..Options::default() });
}

#[test]
fn names_with_other_meanings() {
    let parameters = Parameters { masses: true, centres: true, inertias: true, lengths: true };
    holds("hostile.urdf", "hostile", &Options { parameters, ..Options::default() });
    let options = Options { limits: true, friction: true, mimic: Following::Constrain, ..Options::default() };
    holds("hostile.urdf", "hostile_rough", &options);
}
