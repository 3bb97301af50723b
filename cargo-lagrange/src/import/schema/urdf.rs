//! URDF, as its parsers and `urdf.xsd` have it.

use super::Element;

/// The element around all others.
pub static ROBOT: Element = Element {
    tags: &["robot"],
    attributes: &["name", "version"],
    once: &[],
    many: &[&LINK, &JOINT],
    passed: &["material", "transmission", "gazebo", "sensor"],
};

static LINK: Element = Element {
    tags: &["link"],
    attributes: &["name", "type"],
    once: &[&INERTIAL],
    many: &[],
    passed: &["visual", "collision", "sensor", "contact"],
};

static INERTIAL: Element = Element {
    tags: &["inertial"],
    attributes: &[],
    once: &[&ORIGIN, &MASS, &INERTIA],
    many: &[],
    passed: &[],
};

static ORIGIN: Element = Element::leaf(&["origin"], &["xyz", "rpy"]);

static MASS: Element = Element::leaf(&["mass"], &["value"]);

static INERTIA: Element = Element::leaf(&["inertia"], &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]);

static JOINT: Element = Element {
    tags: &["joint"],
    attributes: &["name", "type"],
    once: &[&PARENT, &CHILD, &ORIGIN, &AXIS, &DYNAMICS, &LIMIT, &MIMIC],
    many: &[],
    passed: &["calibration", "safety_controller"],
};

static PARENT: Element = Element::leaf(&["parent"], &["link"]);

static CHILD: Element = Element::leaf(&["child"], &["link"]);

static AXIS: Element = Element::leaf(&["axis"], &["xyz"]);

static DYNAMICS: Element = Element::leaf(&["dynamics"], &["damping", "friction"]);

static LIMIT: Element = Element::leaf(
    &["limit"],
    &["lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"],
);

static MIMIC: Element = Element::leaf(&["mimic"], &["joint", "multiplier", "offset"]);
