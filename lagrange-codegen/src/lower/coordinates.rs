//! Declared coordinates, velocities and inputs as values: numbers, orientations, poses, and arrays of them.

use std::rc::Rc;

use super::value::{Turn, Value};
use crate::expr::{Graph, NodeId, Variable};
use crate::model::{Quantity, Rotation, RotationForm, orientation};
use crate::syntax::item::Kind;
use crate::syntax::{Group, Record};

/// The scalar quantities of some declarations, in order.
pub fn quantities(groups: &[Group]) -> Vec<Quantity> {
    let mut quantities = Vec::new();
    for group in groups {
        let name = group.name().to_string();
        let is_single = group.length.is_none() && group.kind == Kind::Scalar;
        quantities.extend((0..group.size()).map(|index| Quantity {
            name: name.clone(),
            index: (!is_single).then_some(index),
            origin: group.origin,
        }));
    }
    quantities
}

/// Where the three numbers of each orientation begin.
pub fn orientations(groups: &[Group]) -> Vec<usize> {
    let mut next = 0;
    let mut orientations = Vec::new();
    for group in groups {
        for _ in 0..group.length.unwrap_or(1) {
            next += group.kind.width();
            orientations.extend((group.kind != Kind::Scalar).then(|| next - 3));
        }
    }
    orientations
}

/// The fields of a record.
pub fn fields(graph: &mut Graph, groups: &[Group], record: Record) -> Vec<Value> {
    let (mut next, mut turned) = (0, 0);
    groups
        .iter()
        .map(|group| {
            let mut element = || {
                let first = next;
                next += group.kind.width() as u32;
                let place = turned;
                turned += usize::from(group.kind != Kind::Scalar);
                element(graph, group.kind, record, first, place)
            };
            match group.length {
                None => element(),
                Some(length) => Value::array((0..length).map(|_| element()).collect()),
            }
        })
        .collect()
}

/// One element, whose numbers begin at `first`. `place` is the position of its orientation among all.
fn element(graph: &mut Graph, kind: Kind, record: Record, first: u32, place: usize) -> Value {
    let variable =
        |graph: &mut Graph, of: fn(u32) -> Variable, offset: u32| graph.variable(of(first + offset));
    let three = |graph: &mut Graph, of: fn(u32) -> Variable, from: u32| -> [NodeId; 3] {
        [0, 1, 2].map(|i| variable(graph, of, from + i))
    };
    let of: fn(u32) -> Variable = match record {
        Record::Coordinates => Variable::Coordinate,
        Record::Velocities => Variable::Velocity,
        Record::Inputs => Variable::Input,
    };
    let turned = kind.width() as u32 - 3 * u32::from(kind != Kind::Scalar);
    match (kind, record) {
        (Kind::Scalar, _) => Value::scalar(variable(graph, of, 0)),
        (Kind::Rotation | Kind::Pose, Record::Velocities) => {
            let angular: Rc<[NodeId]> = Rc::from(orientation::spin(graph, (first + turned) as usize));
            match kind {
                Kind::Pose => Value::PoseVelocity(Rc::from(three(graph, of, 0)), angular),
                Kind::Scalar | Kind::Rotation => Value::Vector(angular),
            }
        }
        (Kind::Rotation | Kind::Pose, Record::Coordinates | Record::Inputs) => {
            let matrix = orientation::entries(graph, place);
            let form = RotationForm::Turning(orientation::spin(graph, (first + turned) as usize));
            let turn = Turn::Space(Rc::new(Rotation { matrix, form }));
            match kind {
                Kind::Pose => Value::Isometry(Rc::from(three(graph, of, 0)), turn),
                Kind::Scalar | Kind::Rotation => Value::Rotation(turn),
            }
        }
    }
}
