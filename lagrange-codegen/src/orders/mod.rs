//! One order of a Taylor series as a program.
//!
//! The recurrences of [`Jets`] say which coefficients follow from which. Here they become instructions:
//! values at the point of expansion, convolutions with what they lack, sums in the order in which their
//! operands are known, the solution for the new velocities, and what goes on to the next order. Emission
//! prints them.
//!
//! | file | what it plans |
//! | --- | --- |
//! | `values` | values at the point of expansion |
//! | `order` | the coefficients of an order |
//! | `recurrence` | each of them as a sum of products with known factors |
//! | `terms` | sums of products as chains of multiply–adds |
//! | `solution`, `saddle` | what solves for velocities and multipliers |
//! | `tiles` | the tables of systems with many products |

mod order;
mod recurrence;
mod saddle;
mod solution;
mod terms;
mod tiles;
mod values;

use crate::collections::Lookup;
use crate::jets::{FEW, Jets, Operand};
use crate::mechanics::Equations;
use crate::model::Model;
use crate::schedule::{Given, Instruction, Program, Slot};
use crate::structure::Solution;
use order::Order;
pub use saddle::SaddlePoint;
pub use solution::{By, Solver};
use solution::{Start, inverses, valued};
pub use tiles::{Pattern, Tile, Tiles};

/// The kind of numbers that an expansion is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// The user's scalar.
    Plain,
    /// Numbers that carry others with them, such as derivatives.
    Carrying,
}

/// The expansion of a motion at a state, order by order.
#[derive(Clone, Debug)]
pub struct Expansion {
    /// All operations.
    pub program: Program,
    /// The coefficients of the coordinates.
    pub coordinates: Vec<Slot>,
    /// The coefficients of the velocities.
    pub velocities: Vec<Slot>,
    /// The coefficients of the functions that are followed.
    pub followed: Vec<Slot>,
    /// The numbers that pass from one order to the next.
    pub carried: Vec<Carried>,
    /// The factors of the convolutions.
    pub factors: Vec<Factor>,
    /// How the convolutions are summed.
    pub sums: Sums,
    /// The blocks that the runtime solves for velocities.
    pub solvers: Vec<Solver>,
    /// Reciprocals of pivots. They are finite if there is a solution.
    pub pivots: Vec<Slot>,
    /// The system that the runtime solves in an order with constraints.
    pub saddle: Option<SaddlePoint>,
    /// The slots that hold coefficients, for names.
    pub coefficients: Vec<Coefficient>,
    /// Values at the point of expansion, by slot of the recurrences.
    pub values: Vec<Slot>,
}

/// A number that one order leaves to the next.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// The coefficient that is kept.
    pub keeps: Keeps,
    /// Its value at order zero.
    pub start: Slot,
    /// Its value at each later order.
    pub next: Slot,
}

/// The coefficients that go on to the next order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keeps {
    /// The coefficient of a velocity.
    Velocity(usize),
    /// The coefficient of a momentum's rate.
    Force(usize),
    /// The coefficient of a constraint's rate.
    Relaxation(usize),
    /// The coefficient of the rate of an auxiliary, by its slot in the recurrences.
    Flow(Slot),
}

/// A factor of convolutions.
#[derive(Clone, Copy, Debug)]
pub struct Factor {
    /// The operand of the convolutions.
    pub operand: Operand,
    /// Its coefficient.
    pub coefficient: Slot,
}

/// How convolutions are summed.
#[derive(Clone, Debug)]
pub enum Sums {
    /// Each by itself: the indices of their factors.
    Few(Vec<[usize; 2]>),
    /// In tiles.
    Many(Tiles),
}

impl Sums {
    fn of(jets: &Jets, factors: &[Factor]) -> Sums {
        let mut indices: Lookup<Operand, usize> = Lookup::default();
        for (index, factor) in factors.iter().enumerate() {
            indices.insert(factor.operand, index);
        }
        let index = |operand: Operand| indices.get(&operand).copied().unwrap_or_default();
        if jets.convolutions.len() > FEW {
            Sums::Many(Tiles::of(&jets.convolutions, &index))
        } else {
            Sums::Few(
                jets.convolutions.iter().map(|product| [index(product.left), index(product.right)]).collect(),
            )
        }
    }
}

/// A slot that holds the coefficient of a slot of the recurrences.
#[derive(Clone, Copy, Debug)]
pub struct Coefficient {
    /// Where it is.
    pub slot: Slot,
    /// The part of that coefficient.
    pub part: Part,
    /// Whose it is.
    pub of: Slot,
}

/// A part of a coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The part from lower orders.
    Known,
    /// The coefficient with the unknowns at zero.
    Partial,
    /// All.
    Whole,
}

/// The expansion of a smooth motion, for each kind of numbers.
#[derive(Clone, Debug)]
pub struct Expansions {
    plain: Expansion,
    /// The expansion for numbers that carry others, if it differs from `plain`.
    carrying: Option<Expansion>,
}

impl Expansions {
    /// Plans the expansions of both kinds.
    pub fn plan(model: &mut Model, equations: &Equations, solution: &Solution, jets: &Jets) -> Expansions {
        let plain = plan(model, equations, solution, jets, Numbers::Plain);
        let carrying = if plain.solvers.iter().any(|solver| matches!(solver.by, By::Inverse { .. })) {
            Some(plan(model, equations, solution, jets, Numbers::Carrying))
        } else {
            None
        };
        Expansions { plain, carrying }
    }

    /// The expansion for a kind of numbers.
    pub fn of(&self, numbers: Numbers) -> &Expansion {
        match (numbers, &self.carrying) {
            (Numbers::Carrying, Some(carrying)) => carrying,
            _ => &self.plain,
        }
    }
}

/// The expansion of a smooth motion.
fn plan(
    model: &mut Model,
    equations: &Equations,
    solution: &Solution,
    jets: &Jets,
    numbers: Numbers,
) -> Expansion {
    let nodes =
        solution.saddle_of_series.map(|method| saddle::Nodes::of(model, equations, jets, solution, method));
    let graph = &model.graph;
    let count = model.coordinates.len();
    let mut program = Program::default();
    let values = values::values(jets, &mut program);
    let mut pivots = Vec::new();
    let mut valued = valued(graph, jets, &values);
    let mut saddle = nodes.map(|nodes| nodes.values(&mut program, &mut valued));
    let mut starts = Vec::with_capacity(solution.blocks.len());
    for block in &solution.blocks {
        let start = Start::of(block, equations, numbers, &mut program, &mut valued);
        if let Start::Recursion(recursion, factors) = &start {
            pivots.extend(inverses(recursion, factors));
        }
        starts.push((&block.coordinates, start));
    }
    drop(valued);

    let mut order = Order::new(jets, program, values);
    let mut coordinates = Vec::with_capacity(count);
    let mut forces = Vec::with_capacity(count);
    for i in 0..count {
        coordinates.push(order.coordinate(i));
        forces.push(order.carry(Keeps::Force(i), jets.rates[i]));
    }
    let relaxation: Vec<Slot> = jets
        .relaxation
        .iter()
        .enumerate()
        .map(|(c, &slot)| order.carry(Keeps::Relaxation(c), slot))
        .collect();
    order.early();
    order.partially();
    let nothing = order.zero();
    let mut velocities = vec![nothing; count];
    let solvers = match &mut saddle {
        Some(saddle) => {
            order.solve_saddle(saddle, &forces, &relaxation, &mut velocities);
            Vec::new()
        }
        None => starts
            .into_iter()
            .filter_map(|(coordinates, start)| order.solve(coordinates, start, &forces, &mut velocities))
            .collect(),
    };
    order.complete();
    let factors = order.factors();
    let followed = jets.followed.iter().map(|&slot| order.coefficient(slot)).collect();
    let carried = order.carried(&velocities);
    let sums = Sums::of(jets, &factors);
    let Order { program, found, values, .. } = order;
    Expansion {
        program,
        coordinates,
        velocities,
        followed,
        carried,
        factors,
        sums,
        solvers,
        pivots,
        saddle,
        coefficients: found,
        values,
    }
}

impl Order<'_> {
    /// The factors of all convolutions.
    fn factors(&mut self) -> Vec<Factor> {
        let mut factors: Vec<Factor> = Vec::new();
        let mut known: Lookup<Operand, ()> = Default::default();
        for operand in self.jets.convolutions.iter().flat_map(|product| [product.left, product.right]) {
            if known.insert(operand, ()).is_some() {
                continue;
            }
            let mut coefficient = self.coefficient(operand.slot);
            if operand.ramp {
                let index = self.given(Given::Index);
                coefficient = self.program.push(Instruction::Mul(index, coefficient));
            }
            factors.push(Factor { operand, coefficient });
        }
        factors
    }
}
