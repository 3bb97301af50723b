//! The solution of an order, block by block: by factorisations, or by the factors of a mass matrix that is
//! not formed.

use super::Numbers;
use super::order::Order;
use super::terms::{Term, chain, is_literal, literal};
use crate::expr::{Graph, NodeId, Variable};
use crate::jets::Jets;
use crate::mechanics::Equations;
use crate::number::Number;
use crate::schedule::{Given, Instruction, Program, Slot};
use crate::structure::{Block, Method, Recursion, Step};

/// A block that the runtime solves.
#[derive(Clone, Debug)]
pub struct Solver {
    /// Its coordinates.
    pub coordinates: Vec<usize>,
    /// How it is solved.
    pub by: By,
    /// The right-hand sides of an order.
    pub right: Vec<Slot>,
}

/// How the runtime solves a block.
#[derive(Clone, Debug)]
pub enum By {
    /// By a factorisation of its matrix, made once a step, or once per run if the matrix is constant.
    Factors {
        /// LU instead of LDLᵀ.
        indefinite: bool,
        /// Whether the matrix is constant all through a run.
        constant: bool,
        /// The lower triangle, row by row.
        entries: Vec<Slot>,
    },
    /// By the inverse of the matrix, made by a recursion.
    Inverse {
        /// The indices of each step: its own unknown's, and those of others.
        steps: Vec<(usize, Vec<usize>)>,
        /// The number of indices beyond those of the velocities.
        between: usize,
        /// All factors.
        factors: Vec<Slot>,
    },
}

/// The start of an order from the values at the point of expansion.
pub(super) enum Start {
    /// Nothing: the entry is one.
    Nothing,
    /// The reciprocal of the only entry.
    Inverse(Slot),
    /// The factors of the runtime.
    Runtime(By),
    /// The steps of a recursion, with their factors.
    Recursion(Recursion, Vec<Slot>),
}

impl Start {
    /// The start of a block, from values of nodes.
    pub fn of(
        block: &Block,
        equations: &Equations,
        numbers: Numbers,
        program: &mut Program,
        values: &mut impl FnMut(&mut Program, &[NodeId]) -> Vec<Slot>,
    ) -> Start {
        if let Method::Recursive { recursion, .. } = &block.method {
            let factors = values(program, &nodes(recursion));
            // Numbers that carry others with them leave enough to do while an operation waits for another.
            if !recursion.waits() || numbers == Numbers::Carrying {
                return Start::Recursion(recursion.clone(), factors);
            }
            let (indices, count) = recursion.indices();
            let of = |step: &Step| {
                (indices[step.unknown()], step.terms().iter().map(|&(x, _)| indices[x]).collect())
            };
            let steps = recursion.steps.iter().map(of).collect();
            return Start::Runtime(By::Inverse { steps, between: count - recursion.velocities, factors });
        }
        let indefinite = match block.method {
            Method::Lu => true,
            Method::WrittenOut { .. } => !equations.definite,
            Method::Ldlt | Method::Recursive { .. } => false,
        };
        let (own, mass) = (&block.coordinates, equations.mass.rows());
        let lower: Vec<NodeId> = (0..own.len())
            .flat_map(|row| (0..=row).map(move |column| (row, column)))
            .map(|(row, column)| mass[own[row]][own[column]])
            .collect();
        let entries = values(program, &lower);
        match entries[..] {
            [entry] if is_literal(program, entry, Number::ONE) => Start::Nothing,
            [entry] => Start::Inverse(reciprocal(program, entry)),
            _ => Start::Runtime(By::Factors { indefinite, constant: block.constant, entries }),
        }
    }
}

/// 1 / a, as a literal if a is one.
fn reciprocal(program: &mut Program, a: Slot) -> Slot {
    let number = match program.instruction(a) {
        Instruction::Literal(number) => number.recip(),
        Instruction::Neg(b) => match program.instruction(b) {
            Instruction::Literal(number) => number.recip().map(|inverse| -inverse),
            _ => None,
        },
        _ => None,
    };
    match number {
        Some(inverse) => literal(program, inverse),
        None => program.push(Instruction::Recip(a)),
    }
}

/// All factors, step by step. In a step that eliminates a velocity, 1 / pivot comes first.
fn nodes(recursion: &Recursion) -> Vec<NodeId> {
    let mut nodes = Vec::new();
    for step in &recursion.steps {
        if let Step::Eliminate { inverse, .. } = step {
            nodes.push(*inverse);
        }
        nodes.extend(step.terms().iter().map(|&(_, factor)| factor));
    }
    nodes
}

/// The values of nodes for [`Start::of`].
pub(super) fn valued<'a>(
    graph: &'a Graph,
    jets: &'a Jets,
    values: &'a [Slot],
) -> impl FnMut(&mut Program, &[NodeId]) -> Vec<Slot> + 'a {
    move |program, nodes| super::values::nodes(graph, nodes, jets, values, program)
}

impl Order<'_> {
    /// The velocities of an order: their coefficients, or right-hand sides for the runtime.
    pub(super) fn solve(
        &mut self,
        coordinates: &[usize],
        start: Start,
        forces: &[Slot],
        velocities: &mut [Slot],
    ) -> Option<Solver> {
        let right: Vec<Slot> = coordinates.iter().map(|&i| self.load(i, forces[i])).collect();
        let found = match start {
            Start::Nothing => right,
            Start::Inverse(inverse) => vec![self.program.push(Instruction::Mul(right[0], inverse))],
            Start::Recursion(recursion, factors) => self.recur(&recursion, factors, &right),
            Start::Runtime(by) => {
                for &i in coordinates {
                    velocities[i] = self.given(Given::Velocity(i as u32));
                    self.set(Variable::Velocity(i as u32), velocities[i]);
                }
                return Some(Solver { coordinates: coordinates.to_vec(), by, right });
            }
        };
        for (&i, found) in coordinates.iter().zip(found) {
            velocities[i] = found;
            self.set(Variable::Velocity(i as u32), found);
        }
        None
    }

    /// The right-hand side of a coordinate's momentum.
    fn load(&mut self, i: usize, force: Slot) -> Slot {
        let known = self.balance(None, self.jets.momenta[i], true);
        self.share(force, known)
    }

    /// `rate` · a + b.
    pub(super) fn share(&mut self, a: Slot, b: Option<Slot>) -> Slot {
        let rate = self.given(Given::Rate);
        self.program.push(match b {
            Some(b) => Instruction::MulAdd(rate, a, b),
            None => Instruction::Mul(rate, a),
        })
    }

    /// Takes loads through the steps of a recursion, and the solution back.
    fn recur(&mut self, recursion: &Recursion, factors: Vec<Slot>, right: &[Slot]) -> Vec<Slot> {
        let mut factors = factors.into_iter();
        let mut next = || factors.next().expect("orders: as many values as factors");
        struct Named {
            unknown: usize,
            inverse: Option<Slot>,
            terms: Vec<(usize, Slot)>,
        }
        let steps: Vec<Named> = recursion
            .steps
            .iter()
            .map(|step| Named {
                unknown: step.unknown(),
                inverse: matches!(step, Step::Eliminate { .. }).then(&mut next),
                terms: step.terms().iter().map(|&(x, _)| (x, next())).collect(),
            })
            .collect();
        let term = |program: &Program, negative: bool, factor: Slot, value: Slot| match () {
            () if is_literal(program, factor, Number::ONE) => Term::plain(negative, value),
            () => Term::product(negative, factor, value),
        };
        let mut loads: Vec<Vec<Term<Slot>>> = (0..recursion.unknowns).map(|_| Vec::new()).collect();
        let mut own: Vec<Option<Slot>> = vec![None; recursion.unknowns];
        for step in &steps {
            let terms = std::mem::take(&mut loads[step.unknown]);
            let start = right.get(step.unknown).copied();
            let Some(load) = chain(&mut self.program, start, terms) else { continue };
            for &(x, factor) in &step.terms {
                let share = term(&self.program, step.inverse.is_some(), factor, load);
                loads[x].push(share);
            }
            own[step.unknown] = Some(load);
        }
        let mut values: Vec<Option<Slot>> = vec![None; recursion.unknowns];
        for step in steps.iter().rev() {
            let start = match (step.inverse, own[step.unknown]) {
                (Some(inverse), Some(load)) => Some(self.program.push(Instruction::Mul(inverse, load))),
                _ => None,
            };
            let terms: Vec<Term<Slot>> = step
                .terms
                .iter()
                .filter_map(|&(x, factor)| {
                    Some(term(&self.program, step.inverse.is_some(), factor, values[x]?))
                })
                .collect();
            let value = chain(&mut self.program, start, terms);
            values[step.unknown] = Some(value.unwrap_or_else(|| self.zero()));
        }
        values.truncate(recursion.velocities);
        values.into_iter().flatten().collect()
    }
}

/// The inverse pivots of a recursion. They are finite if there is a solution.
pub(super) fn inverses(recursion: &Recursion, factors: &[Slot]) -> Vec<Slot> {
    let mut index = 0;
    let mut inverses = Vec::new();
    for step in &recursion.steps {
        if let Step::Eliminate { .. } = step {
            inverses.push(factors[index]);
            index += 1;
        }
        index += step.terms().len();
    }
    inverses
}
