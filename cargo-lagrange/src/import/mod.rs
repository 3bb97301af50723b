//! Robots from files: text → a robot → a tree → a plan with Rust names → the text of a description.
//!
//! The formats know nothing of Rust; the description knows nothing of the formats.

mod describe;
mod geometry;
mod inertia;
mod links;
mod mjcf;
mod motions;
mod names;
mod plan;
mod report;
mod robot;
mod schema;
mod ties;
mod tree;
mod urdf;
mod weight;
mod xml;

pub use names::is_type_name;
pub use report::{Problem, Report};

use robot::Robot;
use xml::Reader;

/// The choices for a description.
#[derive(Clone, Debug)]
pub struct Options {
    /// The name of the struct; that of the file without one.
    pub name: Option<String>,
    /// Whether the root of a URDF moves freely.
    pub floating: bool,
    /// Whether orientations are roll, pitch and yaw.
    pub euler: bool,
    /// Which joints have inputs.
    pub inputs: Inputs,
    /// Joint limits as `#[unilateral]`.
    pub limits: bool,
    /// Dry friction as `#[friction]`.
    pub friction: bool,
    /// The treatment of joints that follow others.
    pub mimic: Following,
    /// Numbers that become fields.
    pub parameters: Parameters,
    /// Further arguments of the attribute, such as `jacobians`.
    pub with: Vec<String>,
    /// Angles this close to a right one are right, axes this close to a coordinate axis lie on it, in rad.
    pub tolerance: f64,
    /// Inertias that no body has are taken with a warning.
    pub unphysical: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            name: None,
            floating: false,
            euler: false,
            inputs: Inputs::Actuated,
            limits: false,
            friction: false,
            mimic: Following::Eliminate,
            parameters: Parameters::default(),
            with: Vec::new(),
            tolerance: 1e-9,
            unphysical: false,
        }
    }
}

/// Which joints have inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// Those with a transmission or an actuator; all, where the file has none.
    Actuated,
    /// All that turn or slide.
    All,
    /// None.
    None,
}

/// The treatment of joints that follow others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Following {
    /// They have no coordinate of their own.
    Eliminate,
    /// A `#[holonomic]` function ties them, whose reaction is the force of the gear.
    Constrain,
    /// They move by themselves.
    Ignore,
}

/// Numbers that become fields. Zeros stay what they are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Parameters {
    /// Masses.
    pub masses: bool,
    /// Centres of mass.
    pub centres: bool,
    /// Moments and products of inertia.
    pub inertias: bool,
    /// Distances between joints.
    pub lengths: bool,
}

/// The result of an import.
#[derive(Clone, Debug)]
pub struct Import {
    /// The description.
    pub text: String,
    /// Notes for the user, a line each.
    pub notes: Vec<String>,
}

/// Makes a description of a URDF or MJCF file. `file` is its name in messages.
pub fn import(file: &str, text: &str, options: &Options) -> Result<Import, Report> {
    let document = xml::parse(file, text)?;
    let mut reader = Reader { file, document: &document, sink: report::Sink::default() };
    let robot = read(&mut reader, options);
    let mut sink = reader.sink;
    let plan = match robot {
        Some(robot) if sink.problems.is_empty() => plan::plan(robot, options, file, &mut sink),
        _ => None,
    };
    match plan {
        Some(plan) if sink.problems.is_empty() => {
            let text = describe::describe(&plan, options, file);
            Ok(Import { text, notes: sink.notes })
        }
        _ => Err(Report { file: file.to_owned(), problems: sink.problems }),
    }
}

/// The robot of a file in any format that is known.
fn read<'a>(reader: &mut Reader<'a>, options: &Options) -> Option<Robot> {
    let root = reader.document.root_element();
    match root.tag_name().name() {
        "robot" => {
            schema::check(reader, root, &schema::urdf::ROBOT);
            Some(urdf::read(reader, root, options))
        }
        "mujoco" => {
            schema::check(reader, root, &schema::mjcf::MUJOCO);
            Some(mjcf::read(reader, root, options))
        }
        "sdf" => {
            reader.problem(root, "SDF is not read; write the model as URDF or MJCF");
            None
        }
        other => {
            let text =
                format!("<{other}> is no robot; a URDF file has <robot>, an MJCF file <mujoco> outside");
            reader.problem(root, text);
            None
        }
    }
}
