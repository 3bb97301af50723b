//! Names of a file may have any characters: none of them becomes code, in whatever place the name is quoted.

use cargo_lagrange::import::{Following, Import, Options, Parameters, import};

/// What ends a line, a comment or a quotation, in Rust or in documentation, and what rustc refuses in
/// comments. The marked text is Rust if it stands outside of one.
const HOSTILE: &str = "`&#10;pub fn injected() {}&#13;pub fn injected() {}&#13;&#10;pub fn injected() {}\
    &#x85;*/&#x2028;pub&#x2029;fn&#x202e;injected&#x2066;&quot;\\";

fn options() -> Options {
    let parameters = Parameters { masses: true, centres: true, inertias: true, lengths: true };
    let mimic = Following::Constrain;
    Options { limits: true, friction: true, mimic, parameters, ..Options::default() }
}

/// Every line is code that the import writes, and comments have only letters that rustc takes.
fn check(found: &Import) {
    let Import { text, notes } = found;
    syn::parse_file(text).expect("a description is Rust");
    for (index, line) in text.lines().enumerate() {
        let is_comment = line.trim_start().starts_with("//");
        assert!(is_comment || !line.contains("pub fn injected"), "line {}: {line}", index + 1);
        let is_quoted = !line.trim_start().starts_with("///") || line.matches('`').count() % 2 == 0;
        assert!(is_quoted, "line {}: {line}", index + 1);
    }
    let breaks = |letter: char| {
        letter.is_control() || "\u{2028}\u{2029}".contains(letter) || "\u{202e}\u{2066}".contains(letter)
    };
    assert!(!text.lines().any(|line| line.contains(breaks)), "{text}");
    assert!(!notes.iter().any(|note| note.contains(breaks)), "{notes:?}");
}

const INERTIAL: &str = "<inertial><origin xyz=\"0.1 0.2 0.3\"/><mass value=\"1\"/>\
    <inertia ixx=\"0.1\" ixy=\"0.01\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/></inertial>";

/// A robot whose names are these: of the robot, of links, of joints.
fn urdf([robot, first, second, third, slider]: [&str; 5]) -> String {
    let link = |name: &str| format!("<link name=\"{name}\">{INERTIAL}</link>\n");
    let joint = |name: &str, kind: &str, [parent, child]: [&str; 2], rest: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <origin xyz=\"0 0 1\"/><dynamics damping=\"1\" friction=\"1\"/>{rest}</joint>\n"
        )
    };
    let limit = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
    let turn = joint(first, "revolute", ["world", "upper"], limit);
    let mimic = format!("{limit}<mimic joint=\"{first}\"/>");
    let slide = joint(slider, "prismatic", ["upper", second], &mimic);
    let fixed = joint("weld", "fixed", [second, third], "");
    let links = ["world", "upper", second, third].map(link).concat();
    format!("<robot name=\"{robot}\">\n{links}{turn}{slide}{fixed}</robot>")
}

#[test]
fn names_of_urdf_stay_in_their_comments() {
    let plain = ["r", "turn", "lower", "tool", "slide"];
    for place in 0..plain.len() {
        let mut names = plain;
        names[place] = HOSTILE;
        for options in [options(), Options::default()] {
            check(&import("r.urdf", &urdf(names), &options).expect("it is a robot"));
        }
    }
}

#[test]
fn names_of_mjcf_stay_in_their_comments() {
    let plain = ["m", "arm", "hand", "turn", "ball", "motor"];
    for place in 0..plain.len() {
        let mut names = plain;
        names[place] = HOSTILE;
        let [model, arm, hand, turn, ball, motor] = names;
        let geom = "<geom size=\".1\" pos=\".3 0 0\"/>";
        let text = format!(
            "<mujoco model=\"{model}\"><worldbody><body name=\"{arm}\"><joint name=\"{turn}\" damping=\"1\" \
             frictionloss=\"1\" limited=\"true\" range=\"-1 1\"/>{geom}<body name=\"{hand}\" pos=\"0 0 1\">\
             <joint name=\"{ball}\" type=\"ball\" damping=\"1\"/>{geom}</body></body></worldbody>\
             <actuator><motor name=\"{motor}\" joint=\"{turn}\"/></actuator></mujoco>"
        );
        check(&import("m.xml", &text, &options()).expect("it is a robot"));
    }
}

/// The robot without a name of its own has that of the file.
#[test]
fn the_name_of_the_file_stays_in_its_comments() {
    let text = urdf(["r", "turn", "lower", "tool", "slide"]).replacen(" name=\"r\"", "", 1);
    let file = "a`\npub fn injected() {}\r\u{2028}\u{202e}b.urdf";
    check(&import(file, &text, &options()).expect("it is a robot"));
}
