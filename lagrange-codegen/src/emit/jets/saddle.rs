//! Velocities and multipliers of a constrained system, from one saddle-point system an order.
//!
//! M v − Aᵀκ = r, A v = y with κ = rate · μ. Where M is diagonal the velocities are eliminated on the graph,
//! so that zeros of A cost nothing: (A M⁻¹ Aᵀ) κ = y − A M⁻¹ r.

use super::bare;
use super::order::Writer;
use super::terms::{Operand, chain};
use crate::emit::Emission;
use crate::emit::names::Names;
use crate::emit::{body, constraints, scalar};
use crate::expr::NodeId;
use crate::jets::Jets;
use crate::model::Model;
use crate::structure::Saddle;
use crate::syntax::Scalar;

/// The entries that the solution is made of.
pub(super) struct SaddlePoint {
    method: Saddle,
    /// 1 / M of a diagonal mass matrix, or its lower triangle.
    mass: Vec<NodeId>,
    /// A; rows are constraints.
    gradients: Vec<Vec<NodeId>>,
    /// Of rows that hold at times.
    switches: Vec<NodeId>,
}

/// Names of what solves in every order.
pub(super) enum SaddleStart {
    /// M is diagonal.
    Diagonal {
        /// 1 / M.
        inverses: Vec<String>,
        /// A.
        gradients: Vec<Vec<String>>,
        /// A M⁻¹.
        weighted: Vec<Vec<String>>,
    },
    /// The factors of the whole.
    Whole,
}

impl SaddlePoint {
    /// Names of the factors in the generated code.
    const FACTORS: &'static str = "saddle";

    pub fn plan(emission: &mut Emission<'_>, jets: &Jets, method: Saddle) -> SaddlePoint {
        let equations = emission.solved;
        let graph = &mut emission.model.graph;
        let gradients = jets.gradients.clone();
        let mass = match method {
            Saddle::Whole { .. } | Saddle::Switched { .. } => {
                equations.mass.iter().flatten().copied().collect()
            }
            Saddle::Diagonal => {
                let one = graph.one();
                equations.mass.iter().enumerate().map(|(i, row)| graph.div(one, row[i])).collect()
            }
        };
        let switches = constraints::switches(&equations.conditions);
        SaddlePoint { method, mass, gradients, switches }
    }

    /// All entries, in a fixed order.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.mass.iter().chain(self.gradients.iter().flatten()).chain(&self.switches).copied()
    }

    /// The statements that factor at the point of expansion.
    pub fn at_start(
        &self,
        model: &Model,
        scalar: &Scalar,
        outputs: &mut impl Iterator<Item = String>,
        names: &mut Names,
    ) -> (String, SaddleStart) {
        let count = model.coordinates.len();
        let mass: Vec<String> = outputs.by_ref().take(self.mass.len()).collect();
        let gradients: Vec<Vec<String>> =
            self.gradients.iter().map(|row| outputs.by_ref().take(row.len()).collect()).collect();
        let switches: Vec<String> = outputs.by_ref().take(self.switches.len()).collect();
        let held = gradients.len();
        let factors = Self::FACTORS;
        // One row depends on no other.
        let noted = |independence: String| {
            if held > 1 { format!("series.independence = {independence};\n") } else { String::new() }
        };
        if self.method != Saddle::Diagonal {
            let text = format!(
                "{}let gradients = {};\n{}let {factors} = {};\n\
                 if lagrange::constraints::is_singular(&{factors}) {{ return false; }}\n{}",
                body::lower_triangle(scalar, count, &mass),
                matrix(&gradients),
                constraints::filled_switches(scalar, count, held, &switches),
                constraints::factored(self.method, scalar, count, held),
                noted(format!("lagrange::constraints::independence(&{factors})"))
            );
            return (text, SaddleStart::Whole);
        }
        // What is more than a name or a literal is computed once a step, not once an order.
        let mut text = String::new();
        let mut bind = |value: String, wish: String| {
            if value.chars().all(|c| c == '_' || c == '.' || c.is_alphanumeric()) {
                return value;
            }
            let name = names.claim(Some(wish));
            text.push_str(&super::binding(scalar, &name, &value));
            name
        };
        let labels: Vec<String> = model.coordinates.iter().map(|quantity| quantity.label()).collect();
        let inverses: Vec<String> = mass
            .into_iter()
            .zip(&labels)
            .map(|(value, label)| bind(value, format!("{label}_inverse_mass")))
            .collect();
        let gradients: Vec<Vec<String>> = gradients
            .into_iter()
            .zip(&model.constraints)
            .map(|(row, constraint)| {
                let wish = |label: &String| format!("{}_{label}", constraint.label());
                row.into_iter().zip(&labels).map(|(value, label)| bind(value, wish(label))).collect()
            })
            .collect();
        let (zero, one) = (scalar::zero(scalar), scalar::one(scalar));
        let mut weighted = gradients.clone();
        for (row, constraint) in weighted.iter_mut().zip(&model.constraints) {
            for ((entry, inverse), label) in row.iter_mut().zip(&inverses).zip(&labels) {
                if *entry != zero && *inverse != one {
                    let wish = format!("{}_{label}_weighted", constraint.label());
                    *entry = bind(format!("{entry} * {inverse}"), wish);
                }
            }
        }
        // Of these very numbers, not of a simpler formula: rounding errors of the gradients, which for a rod
        // are the same in every step, must not make the matrix belong to other gradients.
        let mut schur = Vec::new();
        for (c, row) in weighted.iter().enumerate() {
            for other in &gradients[..=c] {
                let products = row.iter().zip(other).filter(|(w, a)| **w != zero && **a != zero);
                let sum = products.map(|(w, a)| format!("{w} * {a}")).collect::<Vec<_>>().join(" + ");
                schur.push(if sum.is_empty() { zero.clone() } else { sum });
            }
        }
        text.push_str(&body::lower_triangle(scalar, held, &schur));
        text.push_str(&format!(
            "let {factors} = lagrange::saddle::Schur::<{scalar}, {held}>::factor::<{count}>(mass, || ([{}], {}));\n\
             if !{factors}.is_finite() || {factors}.vanishing().is_some() {{ return false; }}\n{}",
            inverses.join(", "),
            matrix(&gradients),
            noted(format!("{factors}.independence()"))
        ));
        (text, SaddleStart::Diagonal { inverses, gradients, weighted })
    }
}

/// Rows as an array of arrays.
pub(in crate::emit) fn matrix(rows: &[Vec<String>]) -> String {
    let rows: Vec<String> = rows.iter().map(|row| format!("[{}]", row.join(", "))).collect();
    format!("[{}]", rows.join(", "))
}

impl Writer<'_, '_> {
    /// Names of the multipliers' coefficients, and variables that carry the rates of relaxed constraints.
    pub(super) fn multipliers(&mut self) -> Vec<String> {
        let labels: Vec<String> =
            self.emission.model.constraints.iter().map(|constraint| constraint.label()).collect();
        for (slot, label) in self.jets.relaxation.clone().into_iter().zip(&labels) {
            let relaxation = self.carry(slot, &format!("{label}_relaxation"));
            self.forces.push(relaxation);
        }
        let multipliers = &self.emission.model.locals.multipliers;
        multipliers.iter().map(|name| self.names.claim(Some(format!("{name}_k")))).collect()
    }

    /// The solution of an order.
    pub(super) fn solve_saddle(
        &mut self,
        start: &SaddleStart,
        velocities: &[(String, String)],
        multipliers: &[String],
    ) {
        let zero = self.zero();
        let mut momenta = Vec::with_capacity(velocities.len());
        for i in 0..velocities.len() {
            let momentum = self.sorted(self.context.read(self.jets.momenta[i]));
            let reaction = self.sorted(self.context.read(self.jets.reactions[i]));
            let momentum = self.partial(momentum, true);
            let mut force = self.forces[i].clone();
            if let Some(reaction) = self.partial(reaction, false) {
                force = format!("{force} + {}", bare(&reaction));
            }
            momenta.push(match momentum {
                Some(momentum) => format!("Real::mul_add(rate, {force}, {momentum})"),
                None => format!("rate * ({force})"),
            });
        }
        let mut conditions = Vec::with_capacity(multipliers.len());
        for c in 0..multipliers.len() {
            let condition = self.sorted(self.context.read(self.jets.conditions[c]));
            let known = self.partial(condition, true);
            let relaxation = self.jets.relaxation.get(c).map(|_| self.forces[velocities.len() + c].clone());
            conditions.push(match (known, relaxation) {
                (Some(known), None) => bare(&known).to_owned(),
                (Some(known), Some(relaxation)) => format!("Real::mul_add(rate, {relaxation}, {known})"),
                (None, Some(relaxation)) => format!("rate * {relaxation}"),
                (None, None) => zero.clone(),
            });
        }
        let impulses: Vec<String> =
            multipliers.iter().map(|name| self.names.claim(Some(format!("{name}_impulse")))).collect();
        let factors = SaddlePoint::FACTORS;
        match start {
            SaddleStart::Whole => {
                let switched = self.emission.equations.conditions.switched.is_some();
                let solve = if switched { "solve_motion" } else { "solve" };
                let velocities: Vec<&str> =
                    velocities.iter().map(|(_, velocity)| velocity.as_str()).collect();
                self.body.push_str(&format!(
                    "let ([{}], [{}]) = lagrange::saddle::SaddlePoint::{solve}(&{factors}, &[{}], &[{}]);\n",
                    velocities.join(", "),
                    impulses.join(", "),
                    momenta.join(", "),
                    conditions.join(", ")
                ));
            }
            SaddleStart::Diagonal { inverses, gradients, weighted } => {
                let free: Vec<String> = velocities
                    .iter()
                    .map(|(coordinate, _)| self.names.claim(Some(format!("{coordinate}_free"))))
                    .collect();
                for ((name, momentum), inverse) in free.iter().zip(&momenta).zip(inverses) {
                    let is_one = *inverse == scalar::one(&self.emission.scalar);
                    self.bind(
                        name,
                        &if is_one { momentum.clone() } else { format!("{inverse} * ({momentum})") },
                    );
                }
                let nonzero =
                    |row: &[String]| -> Vec<usize> { (0..row.len()).filter(|&i| row[i] != zero).collect() };
                let right: Vec<String> = gradients
                    .iter()
                    .zip(conditions)
                    .map(|(row, condition)| {
                        nonzero(row).into_iter().fold(condition, |sum, i| {
                            format!("Real::mul_add(-({}), {}, {sum})", row[i], free[i])
                        })
                    })
                    .collect();
                self.body.push_str(&format!(
                    "let [{}] = {factors}.solve_order(order, &mass, [{}]);\n",
                    impulses.join(", "),
                    right.join(", ")
                ));
                for (i, (_, velocity)) in velocities.iter().enumerate() {
                    let text = weighted.iter().zip(&impulses).fold(free[i].clone(), |sum, (row, impulse)| {
                        if row[i] == zero {
                            return sum;
                        }
                        format!("Real::mul_add({}, {impulse}, {sum})", row[i])
                    });
                    self.bind(velocity, &text);
                }
            }
        }
        for (multiplier, impulse) in multipliers.iter().zip(&impulses) {
            self.bind(multiplier, &format!("lagrange::jets::multiplier({impulse}, rate)"));
        }
    }

    /// The sum of the terms with the unknowns at zero, with the sign changed for a right-hand side.
    fn partial(&self, mut terms: Vec<super::terms::Term>, negative: bool) -> Option<String> {
        if negative {
            terms.iter_mut().for_each(|term| term.negative = !term.negative);
        }
        chain(None, &terms, |operand: Operand| self.partial_text(operand))
    }
}
