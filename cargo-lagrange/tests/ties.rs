//! Joints that are tied to others, or to a value.

use std::fs;
use std::path::Path;
use std::process::Command;

use cargo_lagrange::import::{Following, Import, Options, Report, import};

/// Two arms in a row beside a third one, with these equalities.
fn tied(equalities: &str, mimic: Following) -> Result<Import, Report> {
    let arm = |name: &str, inside: &str| {
        format!(
            "<body name=\"arm_{name}\" pos=\"1 0 0\"><joint name=\"{name}\" axis=\"0 -1 0\"/>
             <geom size=\".1\" pos=\".5 0 0\"/>{inside}</body>"
        )
    };
    let bodies = arm("a", &arm("b", "")) + &arm("c", "");
    let text =
        format!("<mujoco><worldbody>{bodies}</worldbody>\n<equality>\n{equalities}</equality></mujoco>");
    import("m.xml", &text, &Options { mimic, ..Options::default() })
}

fn message(equalities: &str, mimic: Following) -> String {
    match tied(equalities, mimic) {
        Ok(import) => import.notes.join("\n"),
        Err(report) => report.to_string(),
    }
}

const TWICE: &str =
    "<joint joint1=\"a\" joint2=\"b\"/>\n<joint joint1=\"a\" joint2=\"c\" polycoef=\".1 2\"/>\n";

#[test]
fn a_joint_follows_one_other() {
    let found = message(TWICE, Following::Eliminate);
    assert_eq!(
        found,
        "error: m.xml:7:1: <joint joint1=\"a\">: `a` is tied already, by <joint joint1=\"a\"> at 6:1; remove one of them, let \
         the other joint follow in one, `joint1` and `joint2` exchanged, or make both constraints with --mimic constrain"
    );
    let both = "<joint joint1=\"a\" joint2=\"b\"/>\n<joint joint1=\"a\" polycoef=\".1\"/>\n";
    assert!(message(both, Following::Eliminate).contains("`a` is tied already"));
    assert!(!message(both, Following::Ignore).contains("error"));
}

/// Compiled with others in `tests/compiled/`.
#[test]
fn constraints_may_tie_a_joint_twice() {
    let text = tied(TWICE, Following::Constrain).unwrap_or_else(|report| panic!("{report}")).text;
    for (name, value) in [("a_mimic", "q.a - q.b"), ("a_mimic_2", "q.a - 2.0 * q.c - 0.1")] {
        let function = format!("pub fn {name}(&self, q: &Coordinates) -> f64 {{\n        {value}\n");
        assert!(text.contains(&function), "{text}");
    }
    let held = tied("<joint joint1=\"a\" polycoef=\".1 0\" joint2=\"c\"/>\n", Following::Constrain);
    let text = held.unwrap_or_else(|report| panic!("{report}")).text;
    assert!(text.contains("/// `a` is tied to a value.") && text.contains("        q.a - 0.1\n"), "{text}");
}

#[test]
fn circles_of_ties_are_refused() {
    let back = "<joint joint1=\"a\" joint2=\"b\"/><joint joint1=\"b\" joint2=\"a\"/>";
    let again = "<joint joint1=\"a\" joint2=\"b\"/><joint joint1=\"a\" joint2=\"b\" polycoef=\".1 2\"/>";
    for (equalities, mimic) in
        [(back, Following::Eliminate), (back, Following::Constrain), (again, Following::Constrain)]
    {
        let found = message(equalities, mimic);
        assert!(
            found.contains("is tied to `") && found.contains("untie one joint of this circle"),
            "{found}"
        );
    }
    let itself = message("<joint joint1=\"a\" joint2=\"a\"/>", Following::Constrain);
    assert!(itself.contains("it follows itself"), "{itself}");
    let values = "<joint joint1=\"a\"/><joint joint1=\"b\"/><joint joint1=\"a\" joint2=\"b\"/>";
    let found = message(values, Following::Constrain);
    assert!(found.contains("`b` is tied to a value here and by other ties of the file"), "{found}");
}

/// A factor of zero, and one joint alone, hold a joint where the file says.
#[test]
fn what_is_tied_to_a_value_stands_still() {
    let note = "note: `a` is tied to a value and stands still at 0.1";
    for hold in [
        "<joint joint1=\"a\" joint2=\"c\" polycoef=\".1 0 0 0 0\"/>",
        "<joint joint1=\"a\" polycoef=\".1\"/>",
        "<joint joint1=\"a\" polycoef=\".1 2 3\"/>",
        // By one that is held.
        "<joint joint1=\"a\" joint2=\"c\" polycoef=\"0 2\"/><joint joint1=\"c\" polycoef=\".05 0\"/>",
    ] {
        let found = tied(hold, Following::Eliminate).unwrap_or_else(|report| panic!("{report}"));
        assert!(found.notes.iter().any(|line| line.starts_with(note)), "{:?}", found.notes);
        let frame = "Translation3::new(1.0, 0.0, 0.0) * Rotation3::from_euler_angles(0.0, -0.1, 0.0)";
        assert!(found.text.contains(frame) && !found.text.contains("a_torque"), "{}", found.text);
        // The macro takes it.
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("held.rs");
        fs::write(&path, &found.text).expect("the folder can be written to");
        let mut command = Command::new(env!("CARGO_BIN_EXE_cargo-lagrange"));
        let output = command.args(["structure", "--file"]).arg(&path).output().expect("the command starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// A joint that is held is that of a body in this place.
#[test]
fn a_joint_is_held_in_its_place() {
    let of = |joint: &str, place: &str, hold: &str| {
        let text = format!(
            "<mujoco><worldbody><body name=\"one\" {place}>{joint}<geom size=\".1\" pos=\".3 0 0\"/>
             <body name=\"two\" pos=\"0 0 1\"><joint name=\"b\" axis=\"1 0 0\"/><geom size=\".1\" pos=\"0 .3 0\"/></body></body>
             </worldbody><equality>{hold}</equality></mujoco>"
        );
        import("m.xml", &text, &Options::default()).unwrap_or_else(|report| panic!("{report}")).text
    };
    for (joint, value, place) in [
        ("axis=\"0 0 1\"", ".3", "pos=\"0 1 0\" euler=\"0 0 17.188733853924695\""),
        ("axis=\"1 0 0\" type=\"slide\"", "0.5", "pos=\"0.5 1 0\""),
        ("axis=\"1 0 0\" type=\"slide\" ref=\"2\"", "0.5", "pos=\"0.5 1 0\""),
        // Half a turn about a pin beside it, which is damped.
        (
            "axis=\"0 0 -1\" pos=\"1 0 0\" damping=\"3\" armature=\"1\" stiffness=\"2\"",
            "3.141592653589793",
            "pos=\"2 1 0\" euler=\"0 0 180\"",
        ),
    ] {
        let hold = format!("<joint joint1=\"a\" polycoef=\"{value}\"/>");
        let found = of(&format!("<joint name=\"a\" {joint}/>"), "pos=\"0 1 0\"", &hold);
        assert_eq!(found, of("", place, ""), "{joint}");
    }
}

#[test]
fn a_factor_of_zero_is_one_in_urdf_too() {
    let joint = |name: &str, parent: &str, child: &str, more: &str| {
        format!(
            "<joint name=\"{name}\" type=\"continuous\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{more}</joint>"
        )
    };
    let link = |name: &str| {
        format!(
            "<link name=\"{name}\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link>"
        )
    };
    let text = format!(
        "<robot name=\"r\"><link name=\"base\"/>{}{}{}{}</robot>",
        link("x"),
        link("y"),
        joint(
            "a",
            "base",
            "x",
            "<mimic joint=\"b\" multiplier=\"0\" offset=\"0.2\"/><dynamics damping=\"1\"/>"
        ),
        joint("b", "x", "y", "")
    );
    let found = import("r.urdf", &text, &Options::default()).unwrap_or_else(|report| panic!("{report}"));
    assert!(found.text.contains("coordinates = [b], inputs = [b_torque]"), "{}", found.text);
    assert!(found.text.contains("Rotation3::from_euler_angles(0.2, 0.0, 0.0)"), "{}", found.text);
    let floating = Options { floating: true, ..Options::default() };
    let found = import("r.urdf", &text, &floating).unwrap_or_else(|report| panic!("{report}"));
    assert!(found.text.contains("coordinates = [base: Pose, b]"), "{}", found.text);
}
