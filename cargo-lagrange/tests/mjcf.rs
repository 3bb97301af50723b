//! What MJCF means beside what it says: parts that are off, and sizes that do not count.

use cargo_lagrange::import::{Inputs, Options, import};

/// The description of an arm with a joint, options of the model and a geom of its own.
fn described(option: &str, joint: &str, geom: &str) -> String {
    let text = format!(
        "<mujoco><option>{option}</option><worldbody><body name=\"arm\">
         <joint name=\"turn\" axis=\"0 1 0\" {joint}/><geom {geom}/></body></worldbody></mujoco>"
    );
    let options = Options { limits: true, friction: true, inputs: Inputs::All, ..Options::default() };
    import("m.xml", &text, &options).unwrap_or_else(|report| panic!("{report}")).text
}

const BALL: &str = "type=\"sphere\" size=\".1\" pos=\".3 0 0\"";

#[test]
fn what_a_flag_switches_off_is_not_there() {
    let all = "stiffness=\"2\" damping=\"0.3\" frictionloss=\"0.1\" range=\"-90 90\"";
    let plain = described("", "", BALL);
    for (flag, rest) in [
        ("spring=\"disable\"", "damping=\"0.3\" frictionloss=\"0.1\" range=\"-90 90\""),
        ("damper=\"disable\"", "stiffness=\"2\" frictionloss=\"0.1\" range=\"-90 90\""),
        ("frictionloss=\"disable\"", "stiffness=\"2\" damping=\"0.3\" range=\"-90 90\""),
        ("limit=\"disable\"", "stiffness=\"2\" damping=\"0.3\" frictionloss=\"0.1\""),
        ("passive=\"disable\"", "frictionloss=\"0.1\" range=\"-90 90\""),
        ("constraint=\"disable\"", "stiffness=\"2\" damping=\"0.3\""),
        ("passive=\"disable\" constraint=\"disable\"", ""),
        ("passive=\"disable\" spring=\"enable\"", "stiffness=\"2\" frictionloss=\"0.1\" range=\"-90 90\""),
    ] {
        let found = described(&format!("<flag {flag}/>"), all, BALL);
        assert_eq!(found, described("", rest, BALL), "{flag}");
        assert_eq!(found == plain, rest.is_empty(), "{flag}");
    }
    assert!(plain.contains("9.81"));
    assert!(!described("<flag gravity=\"disable\"/>", "", BALL).contains("9.81"));
}

#[test]
fn a_shape_between_two_points_has_one_width() {
    for kind in ["box", "ellipsoid"] {
        let of = |size: &str| {
            described("", "", &format!("type=\"{kind}\" fromto=\"0 0 0 0 .1 .2\" size=\"{size}\""))
        };
        let one = of(".03");
        assert_eq!(of(".03 .02"), one);
        assert_eq!(of(".03 .02 .01"), one);
        assert_ne!(of(".02"), one);
    }
}

/// The description of two joints with this beside the bodies.
fn tied(beside: &str) -> String {
    let text = format!(
        "<mujoco>{beside}<worldbody><body name=\"one\"><joint name=\"a\"/><geom {BALL}/><body name=\"two\">
         <joint name=\"b\"/><geom {BALL}/></body></body></worldbody></mujoco>"
    );
    import("m.xml", &text, &Options::default()).unwrap_or_else(|report| panic!("{report}")).text
}

/// As `mj_loadXML` of MuJoCo 3 has it.
#[test]
fn defaults_are_those_of_a_family_of_elements() {
    let driven = |defaults: &str| {
        tied(&format!("<default>{defaults}</default><actuator><motor name=\"m\" joint=\"a\"/></actuator>"))
    };
    let plain = driven("");
    let twice = driven("<motor gear=\"2\"/>");
    assert_ne!(twice, plain);
    assert_eq!(driven("<general gear=\"2\"/>"), twice);
    assert_eq!(driven("<motor gear=\"3\"/><position gear=\"2\"/>"), twice);

    let equal = |defaults: &str, more: &str| {
        tied(&format!(
            "<default>{defaults}</default><equality><joint joint1=\"b\" joint2=\"a\" {more}/></equality>"
        ))
    };
    let inactive = "<equality active=\"false\"/>";
    assert_eq!(equal(inactive, ""), tied(""));
    assert_ne!(equal("", ""), tied(""));
    assert_eq!(equal(inactive, "active=\"true\""), equal("", ""));
    // What a list lacks is that of `0 1 0 0 0`.
    assert_eq!(equal("", "polycoef=\"0.3\""), equal("", "polycoef=\"0.3 1 0 0 0\""));
}

#[test]
fn a_given_inertia_counts_where_no_geom_has_a_mass() {
    let of = |compiler: &str, geoms: &str| {
        let text = format!(
            "<mujoco><compiler {compiler}/><worldbody><body name=\"arm\"><joint name=\"turn\"/>
             <inertial mass=\"2\" pos=\".2 0 0\" diaginertia=\".1 .1 .1\"/>{geoms}</body></worldbody></mujoco>"
        );
        import("m.xml", &text, &Options::default()).unwrap_or_else(|report| panic!("{report}")).text
    };
    let given = of("", "");
    let geom = format!("<geom {BALL}/>");
    assert_eq!(of("", &geom), given);
    assert_eq!(of("inertiafromgeom=\"false\"", &geom), given);
    assert_eq!(of("inertiafromgeom=\"true\"", ""), given);
    assert_eq!(of("inertiafromgeom=\"true\"", &format!("<geom mass=\"0\" {BALL}/>")), given);
    assert_ne!(of("inertiafromgeom=\"true\"", &geom), given);
}

#[test]
fn the_outermost_defaults_may_stand_in_several_parts() {
    let of = |defaults: &str, geom: &str| {
        let text = format!(
            "<mujoco>{defaults}<worldbody><body name=\"arm\"><joint name=\"turn\"/><geom pos=\".3 0 0\" {geom}/></body>
             </worldbody></mujoco>"
        );
        import("m.xml", &text, &Options::default()).unwrap_or_else(|report| panic!("{report}")).text
    };
    let damping = "<joint damping=\"0.3\" armature=\"0.2\"/>";
    let one = of(&format!("<default>{damping}<geom density=\"300\"/></default>"), "size=\".1\"");
    let apart = format!("<default>{damping}</default><default><geom density=\"300\"/></default>");
    assert_eq!(of(&apart, "size=\".1\""), one);
    assert_ne!(one, of("", "size=\".1\""));
    let again = format!("<default><joint damping=\"2\"/></default>{apart}");
    assert_eq!(of(&again, "size=\".1\""), one);

    // Sizes that a geom lacks are those of its defaults, one by one.
    let whole = of("", "type=\"box\" size=\".4 .2 .3\"");
    let inner = "<default class=\"short\"><geom size=\".4\"/></default>";
    let sizes = format!("<default><geom type=\"box\" size=\".1 .2 .3\"/>{inner}</default>");
    assert_eq!(of(&sizes, "size=\".4\""), whole);
    assert_eq!(of(&sizes, "class=\"short\""), whole);
}

/// As MuJoCo 4 has it, whatever the forms are.
#[test]
fn an_orientation_overrides_those_of_outer_classes() {
    let of = |defaults: &str, geom: &str| {
        let text = format!(
            "<mujoco><default>{defaults}</default><worldbody><body name=\"arm\"><joint name=\"turn\"/>
             <geom type=\"box\" size=\".1 .2 .3\" {geom}/></body></worldbody></mujoco>"
        );
        import("m.xml", &text, &Options::default()).unwrap_or_else(|report| panic!("{report}")).text
    };
    // About the vertical axis, by `mj_fullM`.
    let turned = of("<geom quat=\"1 2 3 4\"/>", "euler=\"30 0 10\"");
    assert!(turned.contains("1.00361844"), "{turned}");
    let forms = [
        "quat=\"1 2 3 4\"",
        "axisangle=\"1 1 0 40\"",
        "euler=\"30 0 10\"",
        "xyaxes=\"1 1 0 0 1 1\"",
        "zaxis=\"1 2 3\"",
    ];
    for outer in forms {
        for own in forms {
            let alone = of("", own);
            assert_eq!(of(&format!("<geom {outer}/>"), own), alone, "{outer} {own}");
            let inner = format!("<geom {outer}/><default class=\"inner\"><geom {own}/></default>");
            assert_eq!(of(&inner, "class=\"inner\""), alone, "{outer} {own}");
            assert_eq!(of(&format!("<geom {own}/>"), ""), alone);
            // Two points say where it points to, wherever they stand.
            let ends = "fromto=\"0 0 0 0 .3 .4\"";
            assert_eq!(of(&format!("<geom {outer}/>"), ends), of("", ends));
            assert_eq!(of(&format!("<geom {ends}/>"), own), of("", ends));
        }
    }
}
