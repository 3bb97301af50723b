//! The mass matrix at the point of expansion: one factorisation a step, or a run where it is constant.

use super::saddle::{SaddlePoint, SaddleStart};
use super::solution::{self, Named};
use super::start::Start;
use super::{bare, binding};
use crate::emit::Emission;
use crate::emit::block::{self, Block, Reads};
use crate::emit::body;
use crate::emit::names::Names;
use crate::expr::NodeId;
use crate::jets::Jets;
use crate::model::Model;
use crate::number::Number;
use crate::schedule::{Instruction, Program, Slot, plan};
use crate::structure::{Method, Recursion};
use crate::syntax::Scalar;

/// How each block is solved in every order.
pub(super) struct Inertia {
    blocks: Vec<Part>,
    /// With constraints, instead of blocks.
    saddle: Option<SaddlePoint>,
    /// Entries of all blocks but the constant ones, lower triangles row by row.
    moving: Program,
    /// Entries of the constant blocks that are not numbers.
    constant: Program,
}

struct Part {
    coordinates: Vec<usize>,
    /// The type of the factorisation of more than one coordinate.
    factor: &'static str,
    entries: Entries,
}

enum Entries {
    /// One number.
    Number(Number),
    /// This many outputs of the constant program, or of the moving one.
    Outputs { constant: bool, count: usize },
    /// The factors of a matrix that is not formed, outputs of the moving program; whether its inverse solves.
    Recursion { recursion: Recursion, inverse: bool },
}

/// What the body needs of it.
pub(super) struct AtStart {
    /// Names of what is hoisted beyond the polynomials: values of the moving entries, inverses of constant
    /// ones.
    pub labels: Vec<String>,
    /// Statements that factor.
    pub statements: String,
    /// What they read.
    pub reads: Reads,
    /// Each block with what solves it.
    pub solvers: Vec<Solver>,
    /// With constraints, what solves for velocities and multipliers together.
    pub saddle: Option<SaddleStart>,
}

/// A block and what solves it.
pub(super) struct Solver {
    pub coordinates: Vec<usize>,
    pub by: By,
}

/// What solves a block.
pub(super) enum By {
    /// The entry is one.
    Nothing,
    /// Multiplication by this.
    Inverse(String),
    /// This factorisation.
    Factor(String),
    /// These steps.
    Recursion(Named),
}

impl Inertia {
    pub fn plan(emission: &mut Emission<'_>, jets: &Jets) -> Inertia {
        let saddle =
            emission.solution.saddle_of_series.map(|method| SaddlePoint::plan(emission, jets, method));
        let graph = &emission.model.graph;
        let mass = &emission.solved.mass;
        let (mut moving, mut constant): (Vec<NodeId>, Vec<NodeId>) = Default::default();
        moving.extend(saddle.iter().flat_map(SaddlePoint::nodes));
        let mut blocks = Vec::with_capacity(emission.solution.blocks.len());
        for block in &emission.solution.blocks {
            let coordinates = block.coordinates.clone();
            if let Method::Recursive { recursion, .. } = &block.method {
                moving.extend(solution::nodes(recursion));
                // Numbers that carry others with them have enough to do while one waits.
                let inverse = recursion.waits() && emission.scalar == emission.item.scalar;
                let entries = Entries::Recursion { recursion: recursion.clone(), inverse };
                blocks.push(Part { coordinates, factor: "", entries });
                continue;
            }
            let factor = match block.method {
                Method::Lu => "Lu",
                Method::WrittenOut { .. } if emission.solved.definite => "Ldlt",
                Method::WrittenOut { .. } => "Lu",
                Method::Ldlt | Method::Recursive { .. } => "Ldlt",
            };
            let lower: Vec<NodeId> = (0..coordinates.len())
                .flat_map(|row| (0..=row).map(move |column| (row, column)))
                .map(|(row, column)| mass[coordinates[row]][coordinates[column]])
                .collect();
            let entries = match (graph.as_constant(lower[0]), lower.len()) {
                (Some(number), 1) => Entries::Number(number),
                _ => Entries::Outputs { constant: block.constant, count: lower.len() },
            };
            if let Entries::Outputs { .. } = entries {
                (if block.constant { &mut constant } else { &mut moving }).extend(lower);
            }
            blocks.push(Part { coordinates, factor, entries });
        }
        Inertia { blocks, saddle, moving: plan(graph, &moving), constant: plan(graph, &constant) }
    }

    /// The number of factorisations made once per run.
    pub fn factored(&self) -> usize {
        let once =
            |part: &&Part| matches!(part.entries, Entries::Outputs { constant: true, count } if count > 1);
        self.blocks.iter().filter(once).count()
    }

    /// Type and body of the constants: an array of scalars, then the factorisations of constant blocks.
    pub fn constants(&self, model: &Model, scalar: &Scalar, fixed: &Block) -> (String, String) {
        let hoisted = self.moving.hoisted();
        let (_, beyond) = body::constants(model, scalar, &self.moving, &hoisted, &mut Names::new(model));
        let entries =
            block::write(model, scalar, &self.constant, &self.constant.outputs, &[], &mut Names::new(model));
        let braced = |block: &Block, result: String| {
            format!(
                "{{\n{}{}{result}\n}}",
                body::parameters(model, scalar, &block.reads),
                body::assemble(block)
            )
        };
        let array = |texts: &[String]| format!("[{}]", texts.join(", "));
        let mut outputs = entries.outputs.iter().cloned();
        let (mut inverses, mut types, mut factors) = (Vec::new(), Vec::new(), Vec::new());
        for part in &self.blocks {
            let Entries::Outputs { constant: true, count } = part.entries else { continue };
            let values: Vec<String> = outputs.by_ref().take(count).collect();
            if count == 1 {
                inverses.push(format!("Real::recip({})", bare(&values[0])));
                continue;
            }
            let size = part.coordinates.len();
            types.push(format!("::core::option::Option<lagrange::{}<{scalar}, {size}>>", part.factor));
            let lower = body::lower_triangle(scalar, size, &values);
            factors.push(braced(&entries, format!("{lower}lagrange::solve::factor(mass)")));
        }
        let count = fixed.outputs.len() + beyond.outputs.len() + inverses.len();
        let mut pieces = Vec::new();
        for (block, texts) in [(fixed, &fixed.outputs), (&beyond, &beyond.outputs), (&entries, &inverses)] {
            if !texts.is_empty() {
                pieces.push((texts.len(), braced(block, array(texts))));
            }
        }
        let scalars = match &pieces[..] {
            [] => "[]".to_owned(),
            [(_, piece)] => piece.clone(),
            many => {
                let mut text = String::new();
                let mut names = Vec::new();
                for (place, (length, piece)) in many.iter().enumerate() {
                    let own: Vec<String> = (0..*length).map(|i| format!("c{place}_{i}")).collect();
                    text.push_str(&format!("let [{}] = {piece};\n", own.join(", ")));
                    names.extend(own);
                }
                format!("{{\n{text}[{}]\n}}", names.join(", "))
            }
        };
        let scalars_type = format!("[{scalar}; {count}]");
        let (ty, text) = if factors.is_empty() {
            (scalars_type, scalars)
        } else {
            let ty = format!("({scalars_type}, {},)", types.join(", "));
            (ty, format!("({scalars}, {},)", factors.join(", ")))
        };
        (ty, body::imported(text))
    }

    /// The statements at the start of a step.
    pub fn at_start(
        &self,
        model: &Model,
        scalar: &Scalar,
        jets: &Jets,
        start: &Start<'_>,
        names: &mut Names,
    ) -> AtStart {
        let hoisted = self.moving.hoisted();
        let mut labels = Vec::with_capacity(hoisted.len());
        let mut given: Vec<(Slot, String)> = Vec::new();
        for &slot in &hoisted {
            let label = names.claim(crate::emit::names::describe(model, &self.moving, slot, 0));
            given.push((slot, label.clone()));
            labels.push(label);
        }
        // Functions that have a series have a value already.
        for slot in self.moving.needed(&self.moving.outputs) {
            if let (Instruction::Unary(..), Some(node)) =
                (self.moving.instruction(slot), self.moving.source(slot))
                && let Some(series) = jets.auxiliaries.iter().find(|series| series.origin == node)
                && !start.text(series.slot).is_empty()
            {
                given.push((slot, start.text(series.slot).to_owned()));
            }
        }
        let written = block::write(model, scalar, &self.moving, &self.moving.outputs, &given, names);
        let mut statements = body::assemble(&written);
        let mut outputs = written.outputs.iter().cloned();
        let saddle = self.saddle.as_ref().map(|saddle| {
            let (text, start) = saddle.at_start(model, scalar, &mut outputs, names);
            statements.push_str(&text);
            start
        });
        let mut solvers = Vec::with_capacity(self.blocks.len());
        let mut factored = 0;
        for part in &self.blocks {
            let label =
                |suffix: &str| Some(format!("{}_{suffix}", model.coordinates[part.coordinates[0]].label()));
            let by = match &part.entries {
                Entries::Recursion { recursion, inverse: true } => {
                    let name = names.claim(label("inverse"));
                    statements.push_str(&solution::inverse(scalar, recursion, &mut outputs, &name));
                    By::Factor(name)
                }
                Entries::Recursion { recursion, inverse: false } => {
                    let (text, named) = solution::named(model, scalar, recursion, &mut outputs, names);
                    statements.push_str(&text);
                    By::Recursion(named)
                }
                Entries::Number(number) if number.is_one() => By::Nothing,
                Entries::Number(number) => match number.recip() {
                    Some(inverse) => By::Inverse(super::number(scalar, inverse)),
                    None => By::Inverse(format!("Real::recip({})", super::number(scalar, *number))),
                },
                Entries::Outputs { constant: true, count: 1 } => {
                    let name = names.claim(label("inverse_mass"));
                    labels.push(name.clone());
                    By::Inverse(name)
                }
                Entries::Outputs { constant: true, .. } => {
                    factored += 1;
                    let name = names.claim(label("factors"));
                    statements.push_str(&format!(
                        "let ::core::option::Option::Some({name}) = &constants.{factored} else {{ return false; }};\n"
                    ));
                    By::Factor(name)
                }
                Entries::Outputs { constant: false, count: 1 } => {
                    let entry = outputs.next().expect("jets: as many texts as slots");
                    let name = names.claim(label("inverse_mass"));
                    statements.push_str(&binding(scalar, &name, &format!("Real::recip({})", bare(&entry))));
                    By::Inverse(name)
                }
                Entries::Outputs { constant: false, count } => {
                    let size = part.coordinates.len();
                    let entries: Vec<String> = outputs.by_ref().take(*count).collect();
                    let name = names.claim(label("factors"));
                    statements.push_str(&body::lower_triangle(scalar, size, &entries));
                    statements.push_str(&format!(
                        "let ::core::option::Option::Some({name}) = \
                         lagrange::solve::factor::<lagrange::{}<{scalar}, {size}>, _, _>(mass) else {{ return false; }};\n",
                        part.factor
                    ));
                    By::Factor(name)
                }
            };
            solvers.push(Solver { coordinates: part.coordinates.clone(), by });
        }
        AtStart { labels, statements, reads: written.reads, solvers, saddle }
    }
}
