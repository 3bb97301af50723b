//! The kinetic energy as a quadratic form of velocities that are linear in others.
//!
//! T₂ = ½ Σ Q\[a, b] x\[a] x\[b] over the velocities v and over sums of them that stand in the graph as the
//! user nested them, each with its definition w = Σ c x. Substituting all definitions gives ½ v·M v; kept as
//! unknowns they keep Q sparse. Griewank and Walther, *Evaluating Derivatives*, 2nd ed., chapters 9 and 10,
//! call this the extended system.

use std::collections::BTreeMap;

use crate::expr::{Dependence, Exponent, Graph, Node, NodeId, Variable};
use crate::number::Number;

/// A velocity, or behind all velocities a definition in terms of unknowns before it.
pub(crate) type Unknown = usize;

/// A linear combination.
pub(crate) type Linear = Vec<(Unknown, NodeId)>;

/// A quadratic form with definitions.
#[derive(Clone, Debug)]
pub(crate) struct Quadratic {
    /// The number of velocities.
    pub velocities: usize,
    /// The definitions of the other unknowns.
    pub definitions: Vec<Linear>,
    /// The symmetric matrix Q, by row and column; the lower triangle with its diagonal.
    pub entries: BTreeMap<(Unknown, Unknown), NodeId>,
}

/// A node as a polynomial of the velocities.
#[derive(Clone, Copy, Debug)]
enum Part {
    /// Independent of them.
    Fixed,
    /// An expression of first degree: its linear part, `None` for zero.
    First(Option<(Unknown, NodeId)>),
    Second,
}

impl Quadratic {
    /// The part of second degree of a polynomial of the velocities of some coordinates, with the others at
    /// rest; `None` if it is no such polynomial.
    pub fn of(graph: &mut Graph, energy: NodeId, coordinates: &[usize]) -> Option<Quadratic> {
        let cone = graph.cone([energy]);
        let mut reading = Reading {
            form: Quadratic {
                velocities: coordinates.len(),
                definitions: Vec::new(),
                entries: BTreeMap::new(),
            },
            parts: vec![Part::Fixed; graph.len()],
        };
        for &id in &cone {
            let part = reading.part(graph, id, coordinates)?;
            reading.parts[id.index()] = part;
        }
        reading.squares(graph, energy, &cone);
        Some(reading.form.without_unused())
    }

    /// M, lower triangle, row by row, with all definitions substituted. For bodies carried by others its
    /// entries are those of composite inertias (Featherstone, *Rigid Body Dynamics Algorithms*, chapter 6).
    pub fn formed(self, graph: &mut Graph) -> Vec<Vec<NodeId>> {
        let mut matrix = Symmetric::of(&self);
        let Quadratic { velocities, definitions, .. } = self;
        for (place, definition) in definitions.iter().enumerate().rev() {
            matrix.substitute(graph, velocities + place, definition);
        }
        let zero = graph.zero();
        let entry = |row: Unknown, column: Unknown| matrix.rows[row].get(&column).copied().unwrap_or(zero);
        (0..velocities).map(|row| (0..=row).map(|column| entry(row, column)).collect()).collect()
    }

    /// All coefficients.
    pub fn coefficients(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.entries.values().copied().chain(self.definitions.iter().flatten().map(|&(_, c)| c))
    }

    /// The blocks of velocities that M couples, each in ascending order.
    pub fn blocks(&self) -> Vec<Vec<usize>> {
        let mut parts = Parts { above: (0..self.velocities + self.definitions.len()).collect() };
        for (index, definition) in self.definitions.iter().enumerate() {
            definition.iter().for_each(|&(x, _)| parts.join(self.velocities + index, x));
        }
        self.entries.keys().for_each(|&(a, b)| parts.join(a, b));
        let mut blocks: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        (0..self.velocities).for_each(|v| blocks.entry(parts.first(v)).or_default().push(v));
        blocks.into_values().collect()
    }

    /// The form without unused definitions.
    fn without_unused(self) -> Quadratic {
        let Quadratic { velocities, definitions, entries } = self;
        let mut used = vec![false; velocities + definitions.len()];
        used[..velocities].fill(true);
        for &(a, b) in entries.keys() {
            (used[a], used[b]) = (true, true);
        }
        for (place, definition) in definitions.iter().enumerate().rev() {
            if used[velocities + place] {
                definition.iter().for_each(|&(x, _)| used[x] = true);
            }
        }
        let mut renamed = vec![0; used.len()];
        let mut next = 0;
        for (new, used) in renamed.iter_mut().zip(&used) {
            *new = next;
            next += usize::from(*used);
        }
        let is_used = |place: usize| used[velocities + place];
        Quadratic {
            velocities,
            definitions: definitions
                .into_iter()
                .enumerate()
                .filter(|&(place, _)| is_used(place))
                .map(|(_, terms)| terms.into_iter().map(|(x, c)| (renamed[x], c)).collect())
                .collect(),
            entries: entries.into_iter().map(|((a, b), q)| ((renamed[a], renamed[b]), q)).collect(),
        }
    }
}

/// The connected parts of the unknowns. Each unknown names an earlier one of its part; the first names
/// itself.
struct Parts {
    above: Vec<Unknown>,
}

impl Parts {
    fn first(&mut self, unknown: Unknown) -> Unknown {
        let mut first = unknown;
        while self.above[first] != first {
            first = self.above[first];
        }
        self.above[unknown] = first;
        first
    }

    fn join(&mut self, a: Unknown, b: Unknown) {
        let (a, b) = (self.first(a), self.first(b));
        self.above[a.max(b)] = a.min(b);
    }
}

/// The symmetric matrix Q, while unknowns are eliminated from it.
#[derive(Debug)]
pub(crate) struct Symmetric {
    /// The rows, both triangles.
    pub rows: Vec<BTreeMap<Unknown, NodeId>>,
}

impl Symmetric {
    /// The matrix of a form.
    pub fn of(form: &Quadratic) -> Self {
        let mut rows = vec![BTreeMap::new(); form.velocities + form.definitions.len()];
        for (&(a, b), &entry) in &form.entries {
            rows[a].insert(b, entry);
            rows[b].insert(a, entry);
        }
        Symmetric { rows }
    }

    /// Substitutes w = Σ c x into the form.
    pub fn substitute(&mut self, graph: &mut Graph, unknown: Unknown, terms: &Linear) {
        let row = std::mem::take(&mut self.rows[unknown]);
        for (&other, &entry) in &row {
            if other == unknown {
                continue;
            }
            self.rows[other].remove(&unknown);
            for &(x, c) in terms {
                let share = graph.mul(entry, c);
                if x == other {
                    // Q w x with w = c x + … contributes c Q x², and the diagonal holds twice the coefficient
                    // of a square.
                    let share = graph.scale(share, Number::integer(2));
                    self.add(graph, x, x, share);
                } else {
                    self.add(graph, x, other, share);
                }
            }
        }
        if let Some(&own) = row.get(&unknown) {
            for (place, &(x, c)) in terms.iter().enumerate() {
                let scaled = graph.mul(own, c);
                for &(y, d) in &terms[..=place] {
                    let share = graph.mul(scaled, d);
                    self.add(graph, x, y, share);
                }
            }
        }
    }

    /// Adds to an entry and its mirror image.
    pub fn add(&mut self, graph: &mut Graph, a: Unknown, b: Unknown, share: NodeId) {
        let entry = match self.rows[a].get(&b) {
            Some(&entry) => graph.add(entry, share),
            None => share,
        };
        for (row, column) in [(a, b), (b, a)] {
            if graph.is_zero(entry) {
                self.rows[row].remove(&column);
            } else {
                self.rows[row].insert(column, entry);
            }
        }
    }
}

struct Reading {
    form: Quadratic,
    parts: Vec<Part>,
}

impl Reading {
    fn part(&mut self, graph: &mut Graph, id: NodeId, coordinates: &[usize]) -> Option<Part> {
        if !graph.dependence(id).meets(Dependence::VELOCITIES) {
            return Some(Part::Fixed);
        }
        match graph.node(id).clone() {
            Node::Variable(Variable::Velocity(i)) => {
                let place = coordinates.iter().position(|&coordinate| coordinate == i as usize);
                let one = graph.one();
                Some(Part::First(place.map(|place| (place, one))))
            }
            Node::Sum { terms, .. } => {
                if terms.iter().any(|(term, _)| matches!(self.parts[term.index()], Part::Second)) {
                    return Some(Part::Second);
                }
                Some(Part::First(self.sum(graph, &terms)))
            }
            Node::Product(factors) => self.product(graph, &factors),
            Node::Constant(_) | Node::Variable(_) | Node::Unary(..) | Node::Binary(..) => None,
        }
    }

    /// The linear part of a sum, as a definition if it has several terms.
    fn sum(&mut self, graph: &mut Graph, terms: &[(NodeId, Number)]) -> Option<(Unknown, NodeId)> {
        let mut merged: BTreeMap<Unknown, Vec<(NodeId, Number)>> = BTreeMap::new();
        for &(term, number) in terms {
            if let Part::First(Some((unknown, coefficient))) = self.parts[term.index()] {
                merged.entry(unknown).or_default().push((coefficient, number));
            }
        }
        let mut linear: Linear = Vec::with_capacity(merged.len());
        for (unknown, coefficients) in merged {
            let coefficient = graph.sum(Number::ZERO, &coefficients);
            if !graph.is_zero(coefficient) {
                linear.push((unknown, coefficient));
            }
        }
        if linear.len() < 2 {
            return linear.pop();
        }
        self.form.definitions.push(linear);
        Some((self.form.velocities + self.form.definitions.len() - 1, graph.one()))
    }

    fn product(&self, graph: &mut Graph, factors: &[(NodeId, Exponent)]) -> Option<Part> {
        let moving = |&&(factor, _): &&(NodeId, Exponent)| !matches!(self.parts[factor.index()], Part::Fixed);
        let moving: Vec<(NodeId, Exponent)> = factors.iter().filter(moving).copied().collect();
        match moving[..] {
            [(factor, Exponent(2))] => match self.parts[factor.index()] {
                Part::Fixed => Some(Part::Fixed),
                Part::First(None) => Some(Part::First(None)),
                Part::First(Some((unknown, coefficient))) => {
                    let mut rest = without(factors, &moving);
                    rest.push((coefficient, Exponent(2)));
                    Some(Part::First(Some((unknown, graph.product(&rest)))))
                }
                Part::Second => Some(Part::Second),
            },
            [(factor, Exponent(4))] => self.is_first(factor).then_some(Part::Second),
            [(a, Exponent(2)), (b, Exponent(2))] => {
                (self.is_first(a) && self.is_first(b)).then_some(Part::Second)
            }
            _ => None,
        }
    }

    fn is_first(&self, node: NodeId) -> bool {
        matches!(self.parts[node.index()], Part::First(_))
    }

    /// One reverse sweep from the energy to the products of its linear parts.
    fn squares(&mut self, graph: &mut Graph, energy: NodeId, cone: &[NodeId]) {
        let mut shares: BTreeMap<NodeId, Vec<(NodeId, Number)>> = BTreeMap::new();
        let mut entries: BTreeMap<(Unknown, Unknown), Vec<(NodeId, Number)>> = BTreeMap::new();
        shares.insert(energy, vec![(graph.one(), Number::ONE)]);
        for &id in cone.iter().rev() {
            if !matches!(self.parts[id.index()], Part::Second) {
                continue;
            }
            let Some(terms) = shares.remove(&id) else { continue };
            let share = graph.sum(Number::ZERO, &terms);
            match graph.node(id).clone() {
                Node::Sum { terms, .. } => {
                    for (term, number) in terms {
                        if matches!(self.parts[term.index()], Part::Second) {
                            shares.entry(term).or_default().push((share, number));
                        }
                    }
                }
                Node::Product(factors) => {
                    let moving: Vec<(NodeId, Exponent)> = factors
                        .iter()
                        .filter(|(factor, _)| !matches!(self.parts[factor.index()], Part::Fixed))
                        .copied()
                        .collect();
                    let mut rest = without(&factors, &moving);
                    rest.push((share, Exponent(2)));
                    let linear = |node: NodeId| match self.parts[node.index()] {
                        Part::First(linear) => linear,
                        Part::Fixed | Part::Second => None,
                    };
                    let (first, second) = match moving[..] {
                        [(factor, Exponent(2))] => {
                            let share = graph.product(&rest);
                            shares.entry(factor).or_default().push((share, Number::ONE));
                            continue;
                        }
                        [(factor, _)] => (linear(factor), linear(factor)),
                        [(a, _), (b, _)] => (linear(a), linear(b)),
                        _ => (None, None),
                    };
                    let (Some((a, by_a)), Some((b, by_b))) = (first, second) else { continue };
                    rest.extend([(by_a, Exponent(2)), (by_b, Exponent(2))]);
                    let product = graph.product(&rest);
                    // ½ Q x² appears once. Q x y appears as two halves.
                    let twice = if a == b { Number::integer(2) } else { Number::ONE };
                    entries.entry((a.max(b), a.min(b))).or_default().push((product, twice));
                }
                Node::Constant(_) | Node::Variable(_) | Node::Unary(..) | Node::Binary(..) => {}
            }
        }
        for (place, terms) in entries {
            let entry = graph.sum(Number::ZERO, &terms);
            if !graph.is_zero(entry) {
                self.form.entries.insert(place, entry);
            }
        }
    }
}

fn without(factors: &[(NodeId, Exponent)], some: &[(NodeId, Exponent)]) -> Vec<(NodeId, Exponent)> {
    factors.iter().filter(|factor| !some.contains(factor)).copied().collect()
}
