//! The model as a page of a textbook: `EQUATIONS`, in text, LaTeX and MathML, and the documentation of the
//! generated block.
//!
//! The equations stand as M a + b = Q − ∂D/∂v + Aᵀλ, a row for each coordinate. What several rows share gets
//! a name where the rows would be long otherwise, and of large systems only the first rows are written.

mod fold;
mod formula;
mod latex;
mod mathml;
mod page;
mod readable;
mod symbols;
mod unicode;
mod writer;

use crate::collections::Lookup;
use crate::emit::Emission;
use crate::expr::{Dependence, Graph, Node, NodeId, Variable};
use crate::mechanics::MassMatrix;
use crate::model::Model;
use crate::number::Number;
use formula::{Formula, Page};
pub(super) use page::page;
use writer::Writer;

/// The most nodes of all written rows together. Further rows are left out.
const MOST: usize = 260;

/// The most nodes, written out, of all rows together if shared parts get no names; from four rows on, four
/// times the average of a row. A summand with more is not taken apart.
const LONG: u64 = 160;

/// The fewest nodes of a part that gets a name.
const SHORT: u64 = 7;

/// The vectors of the equations as the methods compute them.
pub(super) struct Sides {
    /// b.
    pub bias: Vec<NodeId>,
    /// Q − ∂D/∂v.
    pub applied: Vec<NodeId>,
}

/// The equations of motion, ready to be written.
pub(super) struct Equations {
    /// By coordinate: the summands of the left-hand side, and of the right-hand side.
    rows: Vec<(Vec<NodeId>, Vec<NodeId>)>,
    /// Parts that have names, operands first.
    shared: Vec<NodeId>,
    /// The number of rows that are left out.
    omitted: usize,
}

impl Equations {
    /// Gathers the rows that are to be written.
    pub fn of(emission: &mut Emission<'_>, sides: &Sides) -> Equations {
        let equations = emission.equations;
        let count = emission.count();
        let mut rows = Vec::new();
        // Equations of entries that nothing forms are too long in any case.
        let written = if matches!(equations.mass, MassMatrix::Known { .. }) { 0 } else { count };
        for i in 0..written {
            let row = row(emission.model, equations, sides, i);
            let nodes = rows
                .iter()
                .chain([&row])
                .flat_map(|(left, right): &(Vec<NodeId>, Vec<NodeId>)| left.iter().chain(right).copied());
            if emission.model.graph.cone(nodes).len() > MOST {
                break;
            }
            rows.push(row);
        }
        let sizes: Vec<usize> = rows.iter().map(|(left, right)| left.len() + right.len()).collect();
        let nodes: Vec<NodeId> =
            rows.iter().flat_map(|(left, right)| left.iter().chain(right).copied()).collect();
        let graph = &mut emission.model.graph;
        let simpler = readable::with_angles(graph, &nodes);
        let mut simpler = readable::collected(graph, &simpler).into_iter();
        for ((left, right), size) in rows.iter_mut().zip(sizes) {
            let (of_left, of_right) = (left.len(), size - left.len());
            *left = simpler.by_ref().take(of_left).collect();
            *right = simpler.by_ref().take(of_right).collect();
            for side in [left, right] {
                // Coefficients of accelerations stay together.
                let open = |&node: &NodeId| {
                    let inertial = graph.dependence(node).meets(Dependence::ACCELERATIONS);
                    let short = graph.tree_size(node) < LONG;
                    if short && !inertial { readable::summands(graph, node) } else { vec![node] }
                };
                let opened: Vec<NodeId> = side.iter().flat_map(open).collect();
                *side = readable::collected_side(graph, &opened);
            }
        }
        let graph = &emission.model.graph;
        let nodes: Vec<NodeId> =
            rows.iter().flat_map(|(left, right)| left.iter().chain(right).copied()).collect();
        let shared = shared(graph, &nodes);
        Equations { omitted: count - rows.len(), rows, shared }
    }

    /// The constant `EQUATIONS` as text. Its documentation shows the equations if no page does.
    pub fn constant(&self, model: &Model, has_page: bool) -> String {
        let plain = self.text(model);
        let shown =
            if has_page { String::new() } else { format!("\n\n```text\n{}```", fold::folded(&plain)) };
        let doc = format!(
            "The equations of motion as derived, M a + b = Q − ∂D/∂v + Aᵀλ, a line for each coordinate.{shown}"
        );
        constant("EQUATIONS", &doc, &plain)
    }

    /// The constants `EQUATIONS_LATEX` and `EQUATIONS_MATHML`.
    pub fn formulas(&self, model: &Model) -> String {
        let page = self.page(model);
        constant("EQUATIONS_LATEX", "`EQUATIONS` in LaTeX, an `aligned` environment.", &latex::page(&page))
            + &constant("EQUATIONS_MATHML", "`EQUATIONS` in MathML, a `math` element.", &mathml::page(&page))
    }

    /// The equations as plain text.
    fn text(&self, model: &Model) -> String {
        unicode::page(&self.page(model))
    }

    fn page(&self, model: &Model) -> Page {
        let mut writer = Writer { model, names: Lookup::default() };
        let mut definitions = Vec::new();
        for (number, &node) in (1..).zip(&self.shared) {
            let name = symbols::symbol("w", &number.to_string(), 0);
            definitions.push((name.clone(), writer.definition(node)));
            writer.names.insert(node, name);
        }
        let side = |nodes: &[NodeId]| {
            let terms = nodes.iter().flat_map(|&node| writer.terms(node, false));
            Formula::sum(terms.filter(|(_, term)| !term.is_zero()).collect())
        };
        let rows = self.rows.iter().map(|(left, right)| [side(left), side(right)]).collect();
        let more = match self.omitted {
            0 => None,
            1 => Some("and one more equation".to_owned()),
            n if self.rows.is_empty() => Some(format!("{n} equations, too long to be written")),
            n => Some(format!("and {n} more equations")),
        };
        Page { rows, more, definitions }
    }
}

fn constant(name: &str, doc: &str, text: &str) -> String {
    // rustdoc shows characters beyond ASCII as escapes in a bare literal, but not in a block.
    format!("#[doc = {doc:?}]\npub const {name}: &'static str = {{ let text = {text:?}; text }};\n")
}

/// An expression in plain text.
pub(super) fn expression(model: &Model, node: NodeId) -> String {
    unicode::formula(&Writer { model, names: Lookup::default() }.expression(node))
}

/// Σ M_ij a_j + b_i and Q_i + Σ A_ci λ_c.
fn row(
    model: &mut Model,
    equations: &crate::mechanics::Equations,
    sides: &Sides,
    i: usize,
) -> (Vec<NodeId>, Vec<NodeId>) {
    let graph = &mut model.graph;
    let count = equations.momenta.len();
    let mut left: Vec<NodeId> = (0..count)
        .map(|j| {
            let a = graph.variable(Variable::Acceleration(j as u32));
            graph.mul(equations.mass.rows()[i.max(j)][i.min(j)], a)
        })
        .collect();
    left.push(sides.bias[i]);
    let mut right = vec![sides.applied[i]];
    right.extend(equations.conditions.reactions.get(i));
    left.retain(|&node| !graph.is_zero(node));
    right.retain(|&node| !graph.is_zero(node));
    (left, right)
}

/// Parts with several uses, if the whole would be long without names for them.
fn shared(graph: &Graph, roots: &[NodeId]) -> Vec<NodeId> {
    let total = roots.iter().fold(0_u64, |total, &root| total.saturating_add(graph.tree_size(root)));
    if total <= LONG * roots.len().max(1) as u64 / 4 || total <= LONG {
        return Vec::new();
    }
    let cone = graph.cone(roots.iter().copied());
    let mut uses: Lookup<NodeId, u32> = Lookup::default();
    let mut count = |node: NodeId| {
        let so_far = uses.get(&node).copied().unwrap_or(0);
        uses.insert(node, so_far + 1);
    };
    for &id in &cone {
        graph.operands(id, &mut count);
    }
    roots.iter().for_each(|&root| count(root));
    cone.into_iter()
        .filter(|node| {
            let scaled = matches!(graph.node(*node), Node::Sum { offset, terms } if terms.len() == 1 && *offset == Number::ZERO);
            uses.get(node).is_some_and(|&uses| uses > 1) && !scaled && graph.tree_size(*node) >= SHORT
        })
        .collect()
}
