//! Velocities and multipliers of a constrained system, from one saddle-point system an order.
//!
//! M v − Aᵀκ = r, A v = y with κ = rate · μ. Where M is diagonal the velocities are eliminated on the graph,
//! so that zeros of A cost nothing: (A M⁻¹ Aᵀ) κ = y − A M⁻¹ r. Where most of that matrix is zero the runtime
//! forms it.

use super::order::Order;
use super::terms::{Term, chain, is_literal};
use crate::expr::{NodeId, Variable};
use crate::jets::Jets;
use crate::mechanics::Equations;
use crate::model::Model;
use crate::number::Number;
use crate::schedule::{Given, Instruction, Program, Slot};
use crate::structure::{Saddle, Solution};

/// The saddle-point system of an order.
#[derive(Clone, Debug)]
pub struct SaddlePoint {
    /// How it is solved.
    pub method: Saddle,
    /// A; rows are constraints.
    pub gradients: Vec<Vec<Slot>>,
    /// 1 / M if the velocities are eliminated, else the lower triangle of M.
    pub mass: Vec<Slot>,
    /// The lower triangle of A M⁻¹ Aᵀ if the velocities are eliminated, unless the runtime forms it.
    pub schur: Vec<Slot>,
    /// Switches of rows that hold at times.
    pub switches: Vec<Slot>,
    /// The right-hand sides of an order for the velocities, if these are not eliminated.
    pub momenta: Vec<Slot>,
    /// The right-hand sides of an order for the constraints.
    pub conditions: Vec<Slot>,
}

/// The nodes that the system is made of.
pub(super) struct Nodes {
    method: Saddle,
    mass: Vec<NodeId>,
    gradients: Vec<Vec<NodeId>>,
    switches: Vec<NodeId>,
}

impl Nodes {
    pub fn of(
        model: &mut Model,
        equations: &Equations,
        jets: &Jets,
        solution: &Solution,
        method: Saddle,
    ) -> Nodes {
        let graph = &mut model.graph;
        // The constraints of a series may have other gradients than those of the equations.
        let covered = solution.sparsity.as_ref().is_some_and(|it| it.covers(graph, &jets.gradients));
        let method = if method == Saddle::Sparse && !covered { Saddle::Diagonal } else { method };
        let mass = match method {
            Saddle::Whole { .. } | Saddle::Switched { .. } => {
                let lower =
                    equations.mass.rows().iter().enumerate().flat_map(|(i, row)| row.iter().take(i + 1));
                lower.copied().collect()
            }
            Saddle::Diagonal | Saddle::Sparse => {
                let one = graph.one();
                equations.mass.rows().iter().enumerate().map(|(i, row)| graph.div(one, row[i])).collect()
            }
        };
        let switches = equations.conditions.switches();
        Nodes { method, mass, gradients: jets.gradients.clone(), switches }
    }

    /// The system at the point of expansion.
    pub fn values(
        &self,
        program: &mut Program,
        mut values: impl FnMut(&mut Program, &[NodeId]) -> Vec<Slot>,
    ) -> SaddlePoint {
        let all: Vec<NodeId> =
            self.mass.iter().chain(self.gradients.iter().flatten()).chain(&self.switches).copied().collect();
        let mut slots = values(program, &all).into_iter();
        let mut take = |count: usize| -> Vec<Slot> { slots.by_ref().take(count).collect() };
        let mass = take(self.mass.len());
        let gradients = self.gradients.iter().map(|row| take(row.len())).collect();
        let switches = take(self.switches.len());
        let (schur, momenta, conditions) = Default::default();
        SaddlePoint { method: self.method, gradients, mass, schur, switches, momenta, conditions }
    }
}

impl Order<'_> {
    /// Velocities and multipliers of an order.
    pub(super) fn solve_saddle(
        &mut self,
        saddle: &mut SaddlePoint,
        forces: &[Slot],
        relaxation: &[Slot],
        velocities: &mut [Slot],
    ) {
        let count = velocities.len();
        let mut momenta = Vec::with_capacity(count);
        for (i, &force) in forces.iter().enumerate() {
            let momentum = self.balance(None, self.jets.momenta[i], true);
            let force = self.balance(Some(force), self.jets.reactions[i], false).unwrap_or(force);
            momenta.push(self.share(force, momentum));
        }
        let held = saddle.gradients.len();
        let mut conditions = Vec::with_capacity(held);
        for c in 0..held {
            let known = self.balance(None, self.jets.conditions[c], true);
            conditions.push(match (known, relaxation.get(c)) {
                (known, Some(&relaxation)) => self.share(relaxation, known),
                (Some(known), None) => known,
                (None, None) => self.zero(),
            });
        }
        if matches!(saddle.method, Saddle::Diagonal | Saddle::Sparse) {
            self.eliminate(saddle, &momenta, conditions, velocities);
        } else {
            for (i, velocity) in velocities.iter_mut().enumerate() {
                *velocity = self.given(Given::Velocity(i as u32));
            }
            (saddle.momenta, saddle.conditions) = (momenta, conditions);
        }
        for (i, &velocity) in velocities.iter().enumerate() {
            self.set(Variable::Velocity(i as u32), velocity);
        }
        for c in 0..held as u32 {
            let multiplier = self.given(Given::Multiplier(c));
            self.set(Variable::Multiplier(c), multiplier);
        }
    }

    /// Velocities and multipliers of an order by elimination of the velocities, for a diagonal M.
    fn eliminate(
        &mut self,
        saddle: &mut SaddlePoint,
        momenta: &[Slot],
        conditions: Vec<Slot>,
        velocities: &mut [Slot],
    ) {
        let weighted: Vec<Vec<Slot>> = saddle
            .gradients
            .iter()
            .map(|row| row.iter().zip(&saddle.mass).map(|(&a, &inverse)| self.scaled(a, inverse)).collect())
            .collect();
        // The matrix is formed from the rounded gradients themselves, not from a simpler formula. Their
        // rounding errors, which for a rod are the same in every step, must not make the matrix belong to
        // other gradients.
        let formed = if saddle.method == Saddle::Diagonal { weighted.len() } else { 0 };
        for (c, row) in weighted.iter().enumerate().take(formed) {
            for other in &saddle.gradients[..=c] {
                let mut sum: Option<Slot> = None;
                for (&w, &a) in row.iter().zip(other) {
                    if !self.is_zero(w) && !self.is_zero(a) {
                        let product = self.program.push(Instruction::Mul(w, a));
                        let more = |sum| self.program.push(Instruction::Add(sum, product));
                        sum = Some(sum.map_or(product, more));
                    }
                }
                saddle.schur.push(sum.unwrap_or_else(|| self.zero()));
            }
        }
        let free: Vec<Slot> = momenta
            .iter()
            .zip(&saddle.mass)
            .map(|(&momentum, &inverse)| match is_literal(&self.program, inverse, Number::ONE) {
                true => momentum,
                false => self.program.push(Instruction::Mul(inverse, momentum)),
            })
            .collect();
        for (row, condition) in saddle.gradients.iter().zip(conditions) {
            let terms = self.products(row, &free, true);
            let right = chain(&mut self.program, Some(condition), terms);
            saddle.conditions.extend(right);
        }
        let impulses: Vec<Slot> = (0..weighted.len() as u32).map(|c| self.given(Given::Impulse(c))).collect();
        for (i, velocity) in velocities.iter_mut().enumerate() {
            let column: Vec<Slot> = weighted.iter().map(|row| row[i]).collect();
            let terms = self.products(&column, &impulses, false);
            *velocity = chain(&mut self.program, Some(free[i]), terms).unwrap_or(free[i]);
        }
    }

    /// factors\[i] · values\[i] without those that vanish.
    fn products(&self, factors: &[Slot], values: &[Slot], negative: bool) -> Vec<Term<Slot>> {
        factors
            .iter()
            .zip(values)
            .filter(|(factor, _)| !self.is_zero(**factor))
            .map(|(&factor, &value)| Term::product(negative, factor, value))
            .collect()
    }

    fn is_zero(&self, slot: Slot) -> bool {
        is_literal(&self.program, slot, Number::ZERO)
    }

    fn scaled(&mut self, a: Slot, inverse: Slot) -> Slot {
        if self.is_zero(a) || is_literal(&self.program, inverse, Number::ONE) {
            return a;
        }
        self.program.push(Instruction::Mul(a, inverse))
    }
}
