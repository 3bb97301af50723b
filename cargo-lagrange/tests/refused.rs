//! MJCF that MuJoCo refuses, or that says what a description cannot have: neither becomes another robot.

use cargo_lagrange::import::{Options, import};

/// All that is said about a file.
fn said(inside: &str) -> String {
    match import("m.xml", &format!("<mujoco>\n{inside}</mujoco>\n"), &Options::default()) {
        Ok(import) => import.notes.join("\n"),
        Err(report) => report.to_string(),
    }
}

/// A body that turns, with this in it and this beside it.
fn arm(joint: &str, inside: &str, beside: &str) -> String {
    format!(
        "{beside}<worldbody><body name=\"b\">\n<joint name=\"j\"{joint}/>\n<geom size=\".1\" pos=\"1 0 0\"/>\n{inside}</body></worldbody>"
    )
}

fn expect(file: &str, expected: &str) {
    let found = said(file);
    assert!(found.contains(expected), "\n{file}\nfound    {found}\nexpected {expected}");
}

#[test]
fn default_classes_have_names_of_their_own() {
    let repeated = "another default class has this name; rename one, and the elements that mean it";
    for (defaults, expected) in [
        ("<default><default class=\"a\"><default class=\"a\"/></default></default>", repeated),
        ("<default class=\"main\"><default class=\"main\"/></default>", repeated),
        ("<default><default class=\"main\"/></default>", repeated),
        (
            "<default><default class=\"a\"/><default class=\"a\"/></default>",
            "error: m.xml:2:39: <default class=\"a\">: another default class has this name; rename one",
        ),
        ("<default><default class=\"a\"/></default><default><default class=\"a\"/></default>", repeated),
        (
            "<default><default class=\"a\"><default class=\"b\"><default class=\"a\"/></default></default></default>",
            repeated,
        ),
        ("<default><default class=\"\"/></default>", "a class inside another one needs a name"),
        (
            "<default class=\"a\"/>",
            "error: m.xml:2:10: <default class=\"a\">: the outermost class is `main`; leave out its name, or write",
        ),
        ("<default><geom/><geom/></default>", "<default> has another <geom> already; remove one of them"),
    ] {
        expect(&arm("", "", defaults), expected);
        expect(&arm(" class=\"a\"", "", defaults), expected);
    }
    assert!(!said(&arm("", "", "<default class=\"main\"/><default class=\"\"/>")).contains("error"));
}

/// The masses of shapes that are not read.
#[test]
fn masses_that_are_not_known_are_told() {
    let still = |geom: &str| arm("", "", &format!("<worldbody><body>{geom}</body></worldbody>"));
    let total = "<compiler settotalmass=\"3\"/>";
    for (geom, expected) in [
        (
            "<geom type=\"hfield\" hfield=\"h\"/>",
            "error: m.xml:5:1: <geom> of <body name=\"b\">: the mass of a geom of type `hfield` is not known; write an \
             <inertial> into the body, or mass=\"0\"",
        ),
        (
            "<geom type=\"hfield\" hfield=\"h\" mass=\"2\"/>",
            "the mass of a geom of type `hfield` is not known",
        ),
        (
            "<geom type=\"box\" mesh=\"m\"/>",
            "the mass of a geom fitted to a mesh is not known; write an <inertial> into the body, or mass=\"0\"",
        ),
        (
            "<geom type=\"box\" size=\"1 1 1\" mesh=\"m\"/>",
            "the mass of a geom fitted to a mesh is not known",
        ),
        ("<geom type=\"mesh\" mesh=\"m\"/>", "the mass of a geom of type `mesh` is not known"),
    ] {
        expect(&arm("", geom, ""), expected);
        expect(&arm("", &format!("<body>{geom}</body>"), ""), "is not known");
        let massless = geom.replace("/>", " density=\"0\"/>").replace(" mass=\"2\"", "");
        assert!(!said(&arm("", &massless, "")).contains("not known"), "{massless}");
        // What stands still has no say, but in the sum of all masses.
        assert!(!said(&still(geom)).contains("error"), "{geom}");
        expect(&(still(geom) + total), "is not known");
    }
}

#[test]
fn attributes_that_exclude_each_other_are_told() {
    let inertial = |more: &str| {
        arm("", &format!("<inertial mass=\"1\" pos=\"0 0 0\" fullinertia=\"1 1 1 0 0 0\" {more}/>"), "")
    };
    let turned = "error: m.xml:5:58: <inertial> of <body name=\"b\">: `fullinertia`, in the axes of the body, excludes";
    expect(&inertial("euler=\"1 2 3\""), &format!("{turned} `euler`; remove one of them"));
    expect(&inertial("diaginertia=\"1 1 1\""), &format!("{turned} `diaginertia`; remove one of them"));
    assert!(!said(&inertial("")).contains("error"));

    let ends = "fromto=\"0 0 0 0 0 1\"";
    let capsule = "<geom type=\"capsule\" size=\".1\"";
    let both = "of <body name=\"b\">: both `fromto` and `pos` place it";
    expect(&arm("", &format!("{capsule} {ends} pos=\"1 0 0\"/>"), ""), both);
    let of_class =
        |attributes: &str| format!("<default><default class=\"c\"><geom {attributes}/></default></default>");
    expect(&arm("", &format!("{capsule} class=\"c\" pos=\"1 0 0\"/>"), &of_class(ends)), both);
    expect(&arm("", &format!("{capsule} class=\"c\" {ends}/>"), &of_class("pos=\"1 0 0\"")), both);
    expect(
        &arm("", &format!("<geom size=\".1\" {ends}/>"), ""),
        "a sphere has no `fromto`; write `pos`, or type=",
    );
}

#[test]
fn stops_are_those_that_a_joint_asks_for() {
    let off = "<compiler autolimits=\"false\"/>";
    let unclear =
        "<joint name=\"j\">: `range` makes no stops under autolimits=\"false\"; write limited=\"true\", or";
    expect(&arm(" range=\"-30 45\"", "", off), unclear);
    expect(&arm(" limited=\"auto\" range=\"-30 45\"", "", off), unclear);
    expect(&arm("", "", &format!("{off}<default><joint range=\"-30 45\"/></default>")), unclear);
    let none = "<joint name=\"j\">: limited=\"true\" asks for stops, and `range` gives none; write range=";
    expect(&arm(" limited=\"true\"", "", ""), none);
    expect(&arm(" limited=\"true\" range=\"1 1\"", "", ""), none);
    for (joint, beside, stops) in [
        (" range=\"-30 45\" limited=\"true\"", off, true),
        (" range=\"-30 45\" limited=\"false\"", off, false),
        (" range=\"0 0\"", off, false),
        (" range=\"-30 45\"", "<compiler autolimits=\"false\"/><compiler autolimits=\"true\"/>", true),
        (" range=\"45 -30\" limited=\"false\"", "", false),
    ] {
        let found = said(&arm(joint, "", beside));
        assert_eq!(found.contains("stops of j"), stops, "{joint}: {found}");
        assert!(!found.contains("error"), "{joint}: {found}");
    }
}

#[test]
fn a_body_moves_in_six_ways_at_most() {
    let moved =
        |joints: &str| format!("<worldbody><body name=\"b\">{joints}<geom size=\".1\"/></body></worldbody>");
    let six = "<body name=\"b\">: its joints have 7 degrees of freedom, and a body 6; remove some";
    expect(&moved("<freejoint/><joint/>"), six);
    expect(&moved(&"<joint/>".repeat(7)), six);
    let ball = "<body name=\"b\">: a ball joint turns it in all directions; remove what turns it after that";
    expect(&moved("<joint type=\"ball\"/><joint/>"), ball);
    expect(&moved("<joint type=\"ball\"/><joint type=\"slide\"/><joint type=\"ball\"/>"), six);
    expect(&moved("<joint type=\"ball\"/><joint type=\"ball\"/>"), ball);
    for joints in ["<joint/><joint type=\"ball\"/>", "<joint type=\"ball\"/><joint type=\"slide\"/>"] {
        assert!(!said(&moved(joints)).contains("error"), "{joints}");
    }
}

#[test]
fn what_has_no_effect_or_is_left_out_is_said() {
    let motor = |gear: &str| {
        arm("", "", "") + &format!("<actuator><motor name=\"m\" joint=\"j\" gear=\"{gear}\"/></actuator>")
    };
    for gear in ["0", "0 1 2"] {
        expect(&motor(gear), "<motor name=\"m\">: its `gear` is zero: it drives nothing, and is left out");
        expect(&motor(gear), "no transmission or actuator drives j: no inputs for them");
    }
    expect(
        &arm("", "<plugin plugin=\"p\"/>", ""),
        "warning: m.xml:5:1: <plugin> of <body name=\"b\">: a plugin is left",
    );
    expect(
        "<worldbody><body><geom size=\".1\"/></body></worldbody>",
        "error: m.xml:1:1: <mujoco>: no joint moves; add a joint that is not fixed, or let the robot move freely: a URDF with \
         --floating, a body of MJCF by <freejoint/>",
    );
}
