//! The variables that a body reads. The others get no names there.

use crate::model::Model;

/// The variables that a body reads.
#[derive(Clone, Debug, Default)]
pub(in crate::emit) struct Reads {
    /// By coordinate.
    pub coordinates: Vec<bool>,
    /// By coordinate.
    pub velocities: Vec<bool>,
    /// By coordinate.
    pub accelerations: Vec<bool>,
    /// By input.
    pub inputs: Vec<bool>,
    /// By orientation and entry of its matrix.
    pub entries: Vec<bool>,
    /// By parameter.
    pub parameters: Vec<bool>,
    /// Time.
    pub time: bool,
}

impl Reads {
    /// Nothing is read.
    pub fn none(model: &Model) -> Reads {
        Reads {
            coordinates: vec![false; model.coordinates.len()],
            velocities: vec![false; model.coordinates.len()],
            accelerations: vec![false; model.coordinates.len()],
            inputs: vec![false; model.inputs.len()],
            entries: vec![false; 9 * model.orientations.len()],
            parameters: vec![false; model.parameters.len()],
            time: false,
        }
    }
}
