//! Broken files: each mistake is said with its place and how to mend it.

use cargo_lagrange::import::{Options, import};

/// A robot with one thing changed.
fn broken(from: &str, to: &str) -> String {
    let robot = "\
<robot name=\"r\">
  <link name=\"base\"/>
  <link name=\"arm\">
    <inertial>
      <mass value=\"1\"/>
      <inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>
    </inertial>
  </link>
  <joint name=\"turn\" type=\"revolute\">
    <parent link=\"base\"/>
    <child link=\"arm\"/>
    <axis xyz=\"1 0 0\"/>
  </joint>
</robot>
";
    assert!(robot.contains(from), "{from}");
    robot.replacen(from, to, 1)
}

fn message(text: &str) -> String {
    match import("r.urdf", text, &Options::default()) {
        Ok(import) => import.notes.join("\n"),
        Err(report) => report.to_string(),
    }
}

#[test]
fn every_mistake_of_urdf_has_its_place() {
    for (from, to, expected) in [
        (
            "</robot>",
            "<transmission name=\"t\"><joint name=\"turn\"/><mechanicalReduction>50</mechanicalReduction></transmission></robot>",
            "warning: r.urdf:14:44: <mechanicalReduction> of <transmission name=\"t\">: the reduction is left out: inputs are \
             torques and forces at the joints",
        ),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<axis/>",
            "error: r.urdf:12:5: <axis> of <joint name=\"turn\">: it has no `xyz`; write xyz=\"0 0 1\"",
        ),
        (
            "axis xyz=",
            "axis xzy=",
            "error: r.urdf:12:11: <axis> of <joint name=\"turn\">: `xzy` is no attribute of <axis>, or did you mean `xyz`?",
        ),
        (
            "<robot name=\"r\">",
            "<robot name=\"r\" xmlns:xacro=\"http://wiki.ros.org/xacro\"><xacro:include filename=\"arm.xacro\"/>",
            "this is a file for xacro; expand it first: `xacro robot.xacro > robot.urdf`",
        ),
        (
            "<axis xyz",
            "<dynamics dampng=\"3\"/><axis xyz",
            "<dynamics> of <joint name=\"turn\">: `dampng` is no attribute of <dynamics>, or did you mean `damping`?",
        ),
        (
            "<axis xyz",
            "<dynamics stiffness=\"3\"/><axis xyz",
            "warning: r.urdf:12:5: <dynamics> of <joint name=\"turn\">: `stiffness` is no attribute of <dynamics>; it is \
             passed over",
        ),
        (
            "<mass value=\"1\"/>",
            "<mass value=\"1\"/><orgin xyz=\"1 0 0\"/>",
            "<orgin> of <link name=\"arm\">: there is no <orgin> in <inertial>, or did you mean `origin`?",
        ),
        (
            "<mass value=\"1\"/>",
            "<mass value=\"1\"/><mass value=\"2\"/>",
            "error: r.urdf:5:24: <mass> of <link name=\"arm\">: <inertial> has another <mass> already; remove one of them",
        ),
        (
            "<axis xyz",
            "<spring/><axis xyz",
            "warning: r.urdf:12:5: <spring> of <joint name=\"turn\">: there is no <spring> in <joint>; it is passed over",
        ),
        (
            "</robot>",
            "",
            "error: r.urdf:1:1: this is not XML: the root node was opened but never closed; mend the XML there",
        ),
        ("</inertial>", "</inertia>", "error: r.urdf:7:5: this is not XML: "),
        (
            "parent link=\"base\"",
            "parent link=\"bose\"",
            "error: r.urdf:10:13: <parent> of <joint name=\"turn\">: the parent `bose` is no link of the file; write \
             <link name=\"bose\"/>, or did you mean `base`?",
        ),
        (
            "    <parent link=\"base\"/>\n",
            "",
            "error: r.urdf:9:3: <joint name=\"turn\">: it has no <parent>; write",
        ),
        (
            "  <link name=\"base\"/>\n",
            "  <link name=\"base\"/>\n  <link name=\"other\"/>\n",
            "error: r.urdf:3:3: <link name=\"other\">: nothing moves this link, nor `base`: the robot would have two roots",
        ),
        (
            "<parent link=\"base\"/>",
            "<parent link=\"arm\"/>",
            "error: r.urdf:9:3: <joint name=\"turn\">: the joints `turn` close a loop, which hangs on nothing",
        ),
        (
            "</robot>",
            "<joint name=\"again\" type=\"fixed\"><parent link=\"base\"/><child link=\"arm\"/></joint></robot>",
            "error: r.urdf:14:1: <joint name=\"again\">: the link `arm` is moved by the joint `turn` already",
        ),
        (
            "<link name=\"base\"/>",
            "<link name=\"arm\"/>",
            "error: r.urdf:3:3: <link name=\"arm\">: another link has this name; rename one",
        ),
        (
            "</robot>",
            "<joint name=\"turn\" type=\"fixed\"><parent link=\"base\"/><child link=\"arm\"/></joint></robot>",
            "error: r.urdf:14:1: <joint name=\"turn\">: another joint has this name; rename one of them",
        ),
        (
            "mass value=\"1\"",
            "mass value=\"NaN\"",
            "error: r.urdf:5:13: <mass> of <link name=\"arm\">: value=\"NaN\" is not finite; write a number",
        ),
        (
            "mass value=\"1\"",
            "mass value=\"-1\"",
            "error: r.urdf:5:13: <mass> of <link name=\"arm\">: the mass -1 is negative",
        ),
        (
            "ixy=\"0\"",
            "ixy=\"2\"",
            "error: r.urdf:6:7: <inertia> of <link name=\"arm\">: the inertia is not positive definite, a principal moment \
             is -1.000e0, which no body's is; write moments about the centre of mass",
        ),
        (
            "izz=\"1\"",
            "izz=\"4\"",
            "warning: r.urdf:6:7: <inertia> of <link name=\"arm\">: the largest principal moment of inertia exceeds the sum \
             of the two others by 50.00 %",
        ),
        (
            " izz=\"1\"",
            "",
            "error: r.urdf:6:7: <inertia> of <link name=\"arm\">: it has no `izz`; write izz=",
        ),
        (
            "type=\"revolute\"",
            "type=\"revolut\"",
            "error: r.urdf:9:22: <joint name=\"turn\">: `revolut` is no type of joint, or did you mean `revolute`?; there are",
        ),
        (
            "xyz=\"1 0 0\"",
            "xyz=\"0 0 0\"",
            "error: r.urdf:12:11: <axis> of <joint name=\"turn\">: the axis is zero; write a direction such as xyz=\"0 0 1\"",
        ),
        (
            "xyz=\"1 0 0\"",
            "xyz=\"1 0\"",
            "error: r.urdf:12:11: <axis> of <joint name=\"turn\">: `xyz` has 2 numbers; write 3 numbers",
        ),
        (
            "xyz=\"1 0 0\"",
            "xyz=\"1,0 0 0\"",
            "error: r.urdf:12:11: <axis> of <joint name=\"turn\">: `1,0` in `xyz` is no number: write a decimal point",
        ),
        ("xyz=\"1 0 0\"", "xyz=\"${a}\"", "`${a}` in `xyz` is no number: this is a xacro file; run `xacro"),
        (
            "name=\"turn\" type=\"revolute\"",
            "name=\"turn\" type=\"fixed\"",
            "<link name=\"base\">: no joint moves",
        ),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<axis xyz=\"1 0 0\"/><mimic joint=\"turn\"/>",
            "error: r.urdf:9:3: <joint name=\"turn\">: it follows itself; untie one joint",
        ),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<axis xyz=\"1 0 0\"/><mimic joint=\"torn\"/>",
            "error: r.urdf:12:31: <mimic joint=\"torn\"> of <joint name=\"turn\">: `torn` is no joint of the file, or did you \
             mean `turn`?",
        ),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<dynamics damping=\"-1\"/>",
            "error: r.urdf:12:15: <dynamics> of <joint name=\"turn\">: `damping` is negative; write a number from 0 on",
        ),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<limit lower=\"2\" upper=\"1\"/>",
            "error: r.urdf:12:12: <limit> of <joint name=\"turn\">: 2 is above upper=\"1\"; exchange the two",
        ),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<origin rpy=\"0 1.57 0\"/>",
            "warning: r.urdf:12:5: <origin> of <joint name=\"turn\">: 1.57 is a right angle of few digits, and is taken as",
        ),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<origin rpy=\"3.14 1.57 3.14\"/>",
            "warning: r.urdf:12:5: <origin> of <joint name=\"turn\">: 3.14 and 1.57 are right angles of few digits, and are \
             taken as written; --right-angles 0.002 makes them exact",
        ),
        ("<inertial>", "<inertial><mass value=\"0\"/></inertial><inertial>", "it has no <inertia>; write"),
    ] {
        let found = message(&broken(from, to));
        assert_eq!(
            found.matches(expected).count(),
            1,
            "\n{from} -> {to}\nfound    {found}\nexpected {expected}"
        );
    }
    assert!(message("<sdf/>").starts_with("error: r.urdf:1:1: <sdf>: SDF is not read"));
    assert!(message("<car/>").starts_with("error: r.urdf:1:1: <car>: <car> is no robot"));
    assert!(message("<robot/>").contains("the robot has no links"));
}

#[test]
fn joints_without_limits_have_no_stops() {
    let options = Options { limits: true, ..Options::default() };
    let warnings = |kind: &str| {
        let robot = broken("type=\"revolute\"", &format!("type=\"{kind}\""));
        let found = import("r.urdf", &robot, &options).unwrap_or_else(|report| panic!("{report}"));
        assert!(!found.text.contains("#[unilateral]"));
        found.notes.into_iter().filter(|note| note.starts_with("warning")).collect::<Vec<_>>()
    };
    for kind in ["revolute", "prismatic"] {
        assert_eq!(
            warnings(kind),
            ["warning: r.urdf:9:3: <joint name=\"turn\">: no stops: the format asks for <limit lower=\"…\" \
              upper=\"…\"/> here; write one, or another type, such as continuous"]
        );
    }
    assert_eq!(warnings("continuous"), [""; 0]);
}

/// All mistakes come at once.
#[test]
fn mistakes_are_told_together() {
    let text = broken("mass value=\"1\"", "mass value=\"x\"").replace("xyz=\"1 0 0\"", "xyz=\"0 0 0\"");
    assert_eq!(message(&text).lines().count(), 2, "{}", message(&text));
}

#[test]
fn impossible_inertias_are_taken_when_asked_for() {
    let options = Options { unphysical: true, ..Options::default() };
    let import = import("r.urdf", &broken("ixy=\"0\"", "ixy=\"2\""), &options).expect("it is allowed");
    assert!(import.notes[0].starts_with("warning: r.urdf:6:7: <inertia> of"), "{:?}", import.notes);
}

/// Programs that write URDF give all joints the same elements.
#[test]
fn nothing_resists_in_a_fixed_joint() {
    let with = |inside: &str| {
        broken(
            "</robot>",
            &format!(
                "<link name=\"tool\"/><joint name=\"f\" type=\"fixed\"><parent link=\"arm\"/><child link=\"tool\"/>{inside}</joint>
                 </robot>"
            ),
        )
    };
    let text = |file: &str| {
        let options = Options { friction: true, limits: true, ..Options::default() };
        import("r.urdf", file, &options).unwrap_or_else(|report| panic!("{report}")).text
    };
    assert_eq!(text(&with("<dynamics damping=\"0.1\" friction=\"0.2\"/>")), text(&with("")));
    assert!(message(&with("<dynamics damping=\"-1\"/>")).contains("`damping` is negative"));
}

fn mjcf(inside: &str) -> String {
    let text = format!("<mujoco>\n{inside}\n</mujoco>\n");
    match import("m.xml", &text, &Options::default()) {
        Ok(import) => import.notes.join("\n"),
        Err(report) => report.to_string(),
    }
}

#[test]
fn every_mistake_of_mjcf_has_its_place() {
    let body = |inside: &str| format!("<worldbody><body name=\"b\">\n{inside}</body></worldbody>");
    for (text, expected) in [
        (
            body("<joint type=\"hing\"/>"),
            "error: m.xml:3:8: <joint> of <body name=\"b\">: `hing` is no type of joint, or did",
        ),
        (body("<joint axis=\"0 0 0\"/>"), "error: m.xml:3:8: <joint> of <body name=\"b\">: the axis is zero"),
        (
            body("<joint damping=\"-1\"/>"),
            "error: m.xml:3:8: <joint> of <body name=\"b\">: `damping` is negative",
        ),
        (
            body("<joint/>") + "<option><flag actuation=\"disable\"/></option>",
            "`actuation` is left out: actuators are inputs of the description",
        ),
        (
            body("<joint name=\"j\" actuatorfrcrange=\"-1 1\"/>")
                + "<actuator><motor joint=\"j\" ctrlrange=\"-1 1\"/></actuator>",
            "left out: ctrlrange, actuatorfrcrange: inputs have no limits; clamp what you give",
        ),
        (
            body("<joint name=\"j\"/>") + "<actuator><motor joint=\"j\" armature=\"0.1\"/></actuator>",
            "`armature` of an actuator is left out; give it to the joint",
        ),
        (
            body("<joint name=\"j\"/>")
                + "<actuator><motor joint=\"j\" delay=\"0.1\" nsample=\"3\"/></actuator>",
            "`delay` is left out: an input acts at once",
        ),
        (
            body("<joint/>") + "<option actuatorgroupdisable=\"1\"/>",
            "`actuatorgroupdisable` is left out: give the inputs of these groups zeros",
        ),
        (
            body("<joint name=\"j\"/>")
                + "<default><general armature=\"0.1\"/></default><actuator><motor joint=\"j\"/></actuator>",
            "`armature` of an actuator is left out; give it to the joint",
        ),
        (
            body("<freejoint name=\"f\"/>") + "<actuator><motor joint=\"f\"/></actuator>",
            "`f` moves freely; name a joint of one coordinate",
        ),
        (
            body("<freejoint align=\"true\"/>"),
            "align=\"true\" moves the frame of the body, and is not read; MuJoCo writes",
        ),
        (body("<joint name=\"j\"/>"), "warning: nothing with a mass hangs on j: the mass matrix is singular"),
        (body("<joint pso=\"0 0 1\"/>"), "`pso` is no attribute of <joint>, or did you mean `pos`?"),
        (
            body("<jiont/>"),
            "error: m.xml:3:1: <jiont> of <body name=\"b\">: there is no <jiont> in <body>, or did you",
        ),
        (
            body("<joint/>") + "<optoin timestep=\"1\"/>",
            "there is no <optoin> in <mujoco>, or did you mean `option`?",
        ),
        (
            body("<joint range=\"10 -10\"/>"),
            "error: m.xml:3:8: <joint> of <body name=\"b\">: 10 is above -10; exchange the two",
        ),
        (
            body("<joint/><body name=\"c\" quat=\"1 0 0 0\" euler=\"0 0 1\"/>"),
            "<body name=\"c\">: it has an orientation by `quat` already; remove one of them",
        ),
        (body("<joint class=\"c\"/>"), "there is no <default class=\"c\">"),
        (
            body("<joint/><geom type=\"mesh\"/>"),
            "the mass of a geom of type `mesh` is not known; write an <inertial>",
        ),
        (body("<joint/><geom type=\"box\" size=\"1 1\"/>"), "a box needs 3 positive numbers in `size`"),
        (body("<joint/><inertial mass=\"1\"/>"), "it has no inertia; write diaginertia"),
        (
            body("<joint/><inertial mass=\"1\" diaginertia=\"1 1 -1\"/>"),
            "the inertia is not positive definite",
        ),
        (
            body("<joint/><inertial mass=\"1\" diaginertia=\"1 1 3\"/>"),
            "warning: m.xml:3:9: <inertial> of <body name=\"b\">: the largest",
        ),
        (body("<joint/><body name=\"b\"/>"), "another body has this name"),
        (body("<joint name=\"j\"/><body><joint name=\"j\"/></body>"), "another joint has this name"),
        (body("<joint/><body><freejoint/></body>"), "only bodies of the world move freely"),
        (
            body("<include file=\"x.xml\"/>"),
            "error: m.xml:3:1: <include> of <body name=\"b\">: <include> is not read; MuJoCo writes",
        ),
        (body("<joint/>") + "<actuator><motor joint=\"x\"/></actuator>", "`x` is no joint of the file"),
        (
            body("<joint/>") + "<actuator><position joint=\"b\"/></actuator>",
            "<position> is taken as a motor: its input is a force, and its gains are left out",
        ),
        (
            body("<joint/>") + "<equality><connect body1=\"b\"/></equality>",
            "<connect> is left out; write a #[holonomic]",
        ),
        (
            body("<joint springdamper=\"1 1\"/>"),
            "`springdamper` is not read; write `stiffness` and `damping`",
        ),
        (
            body("<joint/>") + "<compiler inertiagrouprange=\"0 2\"/>",
            "error: m.xml:3:38: <compiler>: `inertiagrouprange` is not read; MuJoCo writes the whole model",
        ),
        (body("<body gravcomp=\"1\"/><joint/>"), "`gravcomp` is left out: the body has its weight"),
        ("<worldbody/>".to_owned(), "the model has no bodies"),
        ("<compiler angle=\"turn\"/>".to_owned(), "write angle=\"degree\" or angle=\"radian\""),
    ] {
        let found = mjcf(&text);
        assert!(found.contains(expected), "\n{text}\nfound    {found}\nexpected {expected}");
    }
}
