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
