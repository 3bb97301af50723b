//! MJCF, as MuJoCo's XML reference has it.

use super::Element;

/// The element around all others.
pub static MUJOCO: Element = Element {
    tag: "mujoco",
    attributes: &["model"],
    once: &[],
    many: &[&COMPILER, &OPTION, &DEFAULT, &WORLDBODY, &ACTUATOR, &EQUALITY],
    passed: &[
        "size",
        "visual",
        "statistic",
        "asset",
        "deformable",
        "contact",
        "tendon",
        "sensor",
        "keyframe",
        "custom",
        "extension",
        "include",
    ],
};

static COMPILER: Element = Element {
    tag: "compiler",
    attributes: &[
        "autolimits",
        "boundmass",
        "boundinertia",
        "settotalmass",
        "balanceinertia",
        "strippath",
        "coordinate",
        "angle",
        "fitaabb",
        "eulerseq",
        "meshdir",
        "texturedir",
        "assetdir",
        "discardvisual",
        "convexhull",
        "usethread",
        "fusestatic",
        "inertiafromgeom",
        "inertiagrouprange",
        "exactmeshinertia",
        "alignfree",
        "saveinertial",
    ],
    once: &[],
    many: &[],
    passed: &["lengthrange"],
};

static OPTION: Element = Element {
    tag: "option",
    attributes: &[
        "timestep",
        "apirate",
        "impratio",
        "tolerance",
        "ls_tolerance",
        "noslip_tolerance",
        "mpr_tolerance",
        "ccd_tolerance",
        "sleep_tolerance",
        "gravity",
        "wind",
        "magnetic",
        "density",
        "viscosity",
        "o_margin",
        "o_solref",
        "o_solimp",
        "o_friction",
        "integrator",
        "collision",
        "cone",
        "jacobian",
        "solver",
        "iterations",
        "ls_iterations",
        "noslip_iterations",
        "mpr_iterations",
        "ccd_iterations",
        "sdf_iterations",
        "sdf_initpoints",
        "actuatorgroupdisable",
    ],
    once: &[],
    many: &[&FLAG],
    passed: &[],
};

static FLAG: Element = Element::leaf(
    "flag",
    &[
        "constraint",
        "equality",
        "frictionloss",
        "limit",
        "contact",
        "passive",
        "spring",
        "damper",
        "gravity",
        "clampctrl",
        "warmstart",
        "filterparent",
        "actuation",
        "refsafe",
        "sensor",
        "midphase",
        "nativeccd",
        "eulerdamp",
        "autoreset",
        "island",
        "override",
        "energy",
        "fwdinv",
        "invdiscrete",
        "multiccd",
        "sleep",
    ],
);

static DEFAULT: Element = Element {
    tag: "default",
    attributes: &["class"],
    once: &[],
    many: &[
        &DEFAULT,
        &JOINT,
        &GEOM,
        &GENERAL,
        &MOTOR,
        &POSITION,
        &VELOCITY,
        &INTVELOCITY,
        &DAMPER,
        &CYLINDER,
        &MUSCLE,
        &ADHESION,
    ],
    passed: &[
        "mesh", "material", "site", "camera", "light", "pair", "equality", "tendon", "plugin", "flex",
        "include",
    ],
};

static WORLDBODY: Element = Element {
    tag: "worldbody",
    attributes: &["name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"],
    once: &[],
    many: &[&BODY, &GEOM],
    passed: &[
        "site",
        "camera",
        "light",
        "composite",
        "flexcomp",
        "plugin",
        "frame",
        "attach",
        "replicate",
        "include",
    ],
};

static BODY: Element = Element {
    tag: "body",
    attributes: &[
        "name",
        "childclass",
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "mocap",
        "gravcomp",
        "sleep",
        "user",
    ],
    once: &[&INERTIAL],
    many: &[&BODY, &JOINT, &FREEJOINT, &GEOM],
    passed: &[
        "site",
        "camera",
        "light",
        "composite",
        "flexcomp",
        "plugin",
        "frame",
        "attach",
        "replicate",
        "include",
    ],
};

static INERTIAL: Element = Element::leaf(
    "inertial",
    &["pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "mass", "diaginertia", "fullinertia"],
);

static FREEJOINT: Element = Element::leaf("freejoint", &["name", "group", "align"]);

static JOINT: Element = Element::leaf(
    "joint",
    &[
        "name",
        "class",
        "type",
        "group",
        "pos",
        "axis",
        "springdamper",
        "limited",
        "actuatorfrclimited",
        "solreflimit",
        "solimplimit",
        "solreffriction",
        "solimpfriction",
        "stiffness",
        "range",
        "actuatorfrcrange",
        "actuatorgravcomp",
        "margin",
        "ref",
        "springref",
        "armature",
        "damping",
        "frictionloss",
        "user",
    ],
);

static GEOM: Element = Element {
    tag: "geom",
    attributes: &[
        "name",
        "class",
        "type",
        "contype",
        "conaffinity",
        "condim",
        "group",
        "priority",
        "size",
        "material",
        "rgba",
        "friction",
        "mass",
        "density",
        "shellinertia",
        "solmix",
        "solref",
        "solimp",
        "margin",
        "gap",
        "fromto",
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "hfield",
        "mesh",
        "fitscale",
        "fluidshape",
        "fluidcoef",
        "user",
    ],
    once: &[],
    many: &[],
    passed: &["plugin"],
};

static ACTUATOR: Element = Element {
    tag: "actuator",
    attributes: &[],
    once: &[],
    many: &[&GENERAL, &MOTOR, &POSITION, &VELOCITY, &INTVELOCITY, &DAMPER, &CYLINDER, &MUSCLE, &ADHESION],
    passed: &["plugin", "include"],
};

/// Attributes of the kinds of actuators, together.
const DRIVES: &[&str] = &[
    "name",
    "class",
    "group",
    "nsample",
    "interp",
    "delay",
    "ctrllimited",
    "forcelimited",
    "actlimited",
    "ctrlrange",
    "forcerange",
    "actrange",
    "lengthrange",
    "gear",
    "cranklength",
    "joint",
    "jointinparent",
    "tendon",
    "refsite",
    "site",
    "body",
    "cranksite",
    "slidersite",
    "user",
    "actdim",
    "dyntype",
    "gaintype",
    "biastype",
    "dynprm",
    "gainprm",
    "biasprm",
    "actearly",
    "inheritrange",
    "kp",
    "kv",
    "dampratio",
    "timeconst",
    "area",
    "diameter",
    "bias",
    "tausmooth",
    "range",
    "force",
    "scale",
    "lmin",
    "lmax",
    "vmax",
    "fpmax",
    "fvmax",
    "gain",
];

static GENERAL: Element = Element::leaf("general", DRIVES);

static MOTOR: Element = Element::leaf("motor", DRIVES);

static POSITION: Element = Element::leaf("position", DRIVES);

static VELOCITY: Element = Element::leaf("velocity", DRIVES);

static INTVELOCITY: Element = Element::leaf("intvelocity", DRIVES);

static DAMPER: Element = Element::leaf("damper", DRIVES);

static CYLINDER: Element = Element::leaf("cylinder", DRIVES);

static MUSCLE: Element = Element::leaf("muscle", DRIVES);

static ADHESION: Element = Element::leaf("adhesion", DRIVES);

static EQUALITY: Element = Element {
    tag: "equality",
    attributes: &[],
    once: &[],
    many: &[&TIE],
    passed: &["connect", "weld", "tendon", "flex", "flexvert", "flexstrain", "distance", "plugin", "include"],
};

static TIE: Element =
    Element::leaf("joint", &["name", "class", "active", "solref", "solimp", "joint1", "joint2", "polycoef"]);
