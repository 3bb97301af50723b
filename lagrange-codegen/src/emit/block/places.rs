//! The places of values in arrays, for the loops that read them.

use super::{Element, Reads, are_named};
use crate::expr::Variable;
use crate::model::{Model, Quantity};
use crate::schedule::{Instruction, Place, Program, Slot};

/// The arrays of a body, and the values that are elements of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    /// The name and the length of each array.
    arrays: Vec<(String, usize)>,
    /// The place of each slot.
    places: Vec<Option<Place>>,
    /// The declared array of each coordinate and of each input. `None` if these are taken apart into named
    /// variables.
    coordinates: Option<Vec<u32>>,
    inputs: Option<Vec<u32>>,
}

const Q: u32 = 0;
const V: u32 = 1;
const A: u32 = 2;
const U: u32 = 3;

impl Places {
    /// The places in a body of a program with so many slots.
    pub fn of(model: &Model, slots: usize) -> Places {
        let (count, inputs) = (model.coordinates.len(), model.inputs.len());
        let lengths = [count, count, count, inputs];
        let names = ["q", "v", "accelerations", "u"].map(str::to_owned);
        Places {
            arrays: names.into_iter().zip(lengths).collect(),
            places: vec![None; slots],
            coordinates: (!are_named(model, count)).then(|| kinds(&model.coordinates)),
            inputs: (!are_named(model, inputs)).then(|| kinds(&model.inputs)),
        }
    }

    /// The place of a value.
    pub fn place(&self, program: &Program, slot: Slot) -> Option<Place> {
        match program.instruction(slot) {
            Instruction::Variable(variable) => self.of_variable(variable),
            _ => self.places[slot.index()],
        }
    }

    /// The place of a value, with the name of the array.
    pub fn element(&self, program: &Program, slot: Slot) -> Option<Element> {
        let Place { array, index, .. } = self.place(program, slot)?;
        let (array, length) = self.arrays[array as usize].clone();
        Some(Element { array, length, index: i64::from(index) })
    }

    /// The name of an array.
    pub fn name(&self, array: usize) -> &str {
        &self.arrays[array].0
    }

    /// Adds an array and the slots of its elements.
    pub fn add(&mut self, name: String, members: &[Slot]) {
        let array = self.arrays.len() as u32;
        for (index, slot) in (0..).zip(members) {
            self.places[slot.index()] = Some(Place { array, kind: 0, index });
        }
        self.arrays.push((name, members.len()));
    }

    /// Notes that a value is an element of an array, of some kind.
    pub fn set(&mut self, slot: Slot, Element { array, length, index }: &Element, kind: u32) {
        let known = self.arrays.iter().position(|(name, _)| name == array);
        let array = known.unwrap_or_else(|| {
            self.arrays.push((array.clone(), *length));
            self.arrays.len() - 1
        });
        self.places[slot.index()] = Some(Place { array: array as u32, kind, index: *index as u32 });
    }

    fn of_variable(&self, variable: Variable) -> Option<Place> {
        let of = |array: u32, index: u32, kinds: &Option<Vec<u32>>| {
            kinds.as_ref().map(|kinds| Place { array, kind: kinds[index as usize], index })
        };
        match variable {
            Variable::Coordinate(i) => of(Q, i, &self.coordinates),
            Variable::Velocity(i) => of(V, i, &self.coordinates),
            Variable::Acceleration(i) => of(A, i, &self.coordinates),
            Variable::Input(i) => of(U, i, &self.inputs),
            _ => None,
        }
    }

    /// Notes that a loop reads elements of an array.
    pub fn note(&self, array: usize, indices: impl Iterator<Item = i64>, reads: &mut Reads) {
        let read = match array as u32 {
            Q => &mut reads.coordinates,
            V => &mut reads.velocities,
            A => &mut reads.accelerations,
            U => &mut reads.inputs,
            _ => return,
        };
        indices.for_each(|index| read[index as usize] = true);
    }
}

/// The number of the declared array of each quantity.
fn kinds(quantities: &[Quantity]) -> Vec<u32> {
    let mut kinds: Vec<u32> = Vec::with_capacity(quantities.len());
    for (i, quantity) in quantities.iter().enumerate() {
        let kind = match i.checked_sub(1) {
            Some(last) if quantities[last].name == quantity.name => kinds[last],
            Some(last) => kinds[last] + 1,
            None => 0,
        };
        kinds.push(kind);
    }
    kinds
}
