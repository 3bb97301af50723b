//! Systems whose equations switch: kinks, contacts, friction.
//!
//! All regimes of a system are one system with more parameters. For each row that is a constraint at times
//! there is one that tells whether it holds, for each friction the sign of its slip, for each reaction that
//! limits friction its sign, and for each kink its side. With these held constant the equations are smooth,
//! so all that serves smooth constrained systems serves them: series, retraction, checks.

mod kinks;
mod sliding;
mod switches;
mod ties;

pub use kinks::{Corner, Jump};
pub use sliding::Coefficients;
pub use ties::untie;

use crate::diagnostics::Diagnostics;
use crate::expr::{Exponent, Graph, NodeId, Variable};
use crate::jets::{self, Hidden, Jets};
use crate::mechanics::{self, Conditions, Equations, LoadRow};
use crate::model::{Constraint, ConstraintKind, Contact, Law, Model, Normal};
use crate::number::Number;
use crate::orders::Expansions;
use crate::structure::{Facts, Solution};
use switches::Switches;

/// The prefix of the names of rows that are loads.
pub const LOAD: &str = "__load_of_";

/// A system whose equations switch.
#[derive(Debug)]
pub struct Regimes {
    /// The system with all rows as constraints that always hold, from which the laws are read.
    pub rows: Model,
    /// Its equations: gaps, their rates and slip velocities.
    pub laws: Equations,
    /// Switching functions, in the graph of `rows`.
    pub kinks: Vec<NodeId>,
    /// The user's functions that contain them.
    pub kink_names: Vec<String>,
    /// The gain of the energy when each of them passes zero, in the same graph.
    pub jumps: Vec<NodeId>,
    /// Other quantities with two values at a kink, in the same graph.
    pub corners: Vec<Corner>,
    /// The gaps and holonomic constraints that jump at a kink, in the same graph.
    pub breaks: Vec<Jump>,
    /// The system of one regime, with its switches as its last parameters.
    pub model: Model,
    /// The functions that end a regime, in the graph of `model`.
    pub guards: Functions,
    /// Coefficients of friction for slips forward and backward, in the graph of `model`; `None` if they are
    /// functions of the state: without kinks, whatever the direction of a slip is.
    pub coefficients: Option<[Coefficients; 2]>,
    /// Whether a law of friction depends on the direction of a slip.
    pub is_directed: bool,
    /// The equations of `model`.
    pub equations: Equations,
    /// The equations that its series is made of, if they are others.
    pub turned: Option<Equations>,
    /// Facts about `equations`.
    pub facts: Facts,
    /// How they are solved.
    pub solution: Solution,
    /// What can hide from its steps, and in its guards, if anything can.
    pub hidden: [Option<Hidden>; 2],
    /// The recurrences of its series; `None` if even one regime is not smooth.
    pub jets: Option<Jets>,
    /// The operations of these recurrences, an order at a time.
    pub orders: Option<Expansions>,
    /// The law of each row; `None` for constraints that always hold. Loads, the last rows, have no entry.
    pub laws_of: Vec<Option<Law>>,
}

/// The functions of one regime whose zeros end it.
#[derive(Clone, Debug)]
pub struct Functions {
    /// Gaps and slip velocities; zero of rows that always hold, and of loads.
    pub rows: Vec<NodeId>,
    /// Coefficients of friction that sticks, for slips forward and backward; zero of other rows.
    pub fixed: [Vec<NodeId>; 2],
    /// Switching functions.
    pub kinks: Vec<NodeId>,
}

impl Functions {
    /// Of a model in one regime with these equations, before contacts hold at times, and the coefficients of
    /// friction for slips forward and backward.
    fn of(
        graph: &mut Graph,
        conditions: &Conditions,
        contacts: &[Contact],
        slips: &[NodeId],
        loads: usize,
        kinks: Vec<NodeId>,
    ) -> (Functions, [Coefficients; 2]) {
        let zero = graph.zero();
        let held = conditions.count() - contacts.len();
        let of_contacts = (held..).zip(contacts).map(|(row, contact)| match contact.law {
            Law::Unilateral { .. } => conditions.positions[row],
            Law::Friction { .. } => conditions.rates[row],
        });
        let nothing = |count| std::iter::repeat_n(zero, count);
        let rows = nothing(held).chain(of_contacts).chain(nothing(loads)).collect();
        let coefficients = sliding::coefficients(graph, contacts, slips)
            .map(|coefficients| coefficients.on_rows(zero, held, loads));
        let fixed = [0, 1].map(|way: usize| coefficients[way].fixed.clone());
        (Functions { rows, fixed, kinks }, coefficients)
    }

    /// All of them, in the order of the fields.
    pub fn all(&self) -> Vec<NodeId> {
        [&self.rows, &self.fixed[0], &self.fixed[1], &self.kinks].into_iter().flatten().copied().collect()
    }
}

impl Regimes {
    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.guards.rows.len()
    }

    /// Whether there are rows that hold at times.
    pub fn has_contacts(&self) -> bool {
        self.laws_of.iter().any(Option::is_some)
    }
}

/// The regimes of a system; `None` if it has a single one, if without contacts even one regime is not smooth,
/// or after a mistake is reported. `is_smooth` tells whether the system has a series as it is. `described` is
/// the model with matrices of orientations as variables, if it has orientations.
pub fn derive(
    model: &Model,
    described: Option<&Model>,
    energy: NodeId,
    is_smooth: bool,
    diagnostics: &mut Diagnostics,
) -> Option<Regimes> {
    // A step in the energy or in a constraint does not show in the equations of motion.
    let mut steps = model.constraints.iter().map(|constraint| constraint.value).chain([energy]);
    if model.contacts.is_empty() && is_smooth && !steps.any(|function| kinks::are_in(model, function)) {
        return None;
    }
    let mut rows = model.clone();
    let held = rows.constraints.len();
    let (contacts, loads) = as_rows(&mut rows);
    // The checks of the system itself are done. Rows that hold at times may outnumber the coordinates, and a
    // slip may be the rate of a function.
    let permits = |_: &str| true;
    let mut laws = mechanics::derive(&mut rows, true, &permits, diagnostics)?;
    let mut switches = Switches::of_rows(&mut rows);
    let sliding = sliding::along(&mut rows.graph, &contacts, &switches.slip[held..]);
    let kinks = kinks::of(&mut rows, &laws, &sliding);
    if contacts.is_empty() && kinks.is_empty() {
        return None;
    }
    let kink_names = kinks::names(&mut rows, &kinks, &sliding);
    let jumps = kinks::jumps(&mut rows, &laws, &kinks);
    let corners = kinks::corners(&mut rows, &laws, held, &kinks);
    let breaks = kinks::breaks(&mut rows, &laws, &kinks);
    let mut regime = rows.clone();
    switches.add_kinks(&mut regime, kinks.len());
    let (kinks_in, contacts_in) = on_sides(&mut regime, &kinks, &switches, &sliding);
    let mut equations = mechanics::derive(&mut regime, true, &permits, diagnostics)?;
    laws.conditions.add_rows(&mut rows.graph, loads.len());
    for model in [&mut rows, &mut regime] {
        name_loads(model, &loads);
    }
    let slips = &switches.slip[held..];
    let behind = loads.len();
    let (guards, coefficients) =
        Functions::of(&mut regime.graph, &equations.conditions, &contacts_in, slips, behind, kinks_in);
    equations.followed = guards.all();
    let is_directed = sliding::have_directions(&contacts, &sliding);
    let are_kinked = contacts.iter().filter_map(kinks::laws).flatten().any(|law| kinks::are_in(&rows, law));
    let coefficients = (is_directed || are_kinked).then_some(coefficients);
    if !contacts.is_empty() {
        hold(&mut regime.graph, &mut equations, &switches, held, &contacts_in, loads);
    }
    let turned = described.and_then(|described| turned(described, &mut regime, &switches, &kinks));
    let kinks = sliding::at_a_state(&mut rows.graph, &kinks, &contacts, slips);
    let equations = equations.simplified(&mut regime);
    let facts = Facts::of(&regime, &equations);
    let turned = turned.map(|turned| equations.turned(&mut regime, turned));
    let solved = turned.as_ref().unwrap_or(&equations);
    let of_solved = Facts::of(&regime, solved);
    let solution = Solution::plan(&mut regime, (&equations, &facts), (solved, &of_solved), diagnostics)?;
    let sides: Vec<jets::Switch> = switches.kinks.iter().copied().zip(guards.kinks.iter().copied()).collect();
    let in_guards = jets::hidden_beside(&mut regime.graph, &guards.all(), &sides);
    let (hidden, jets) = jets::derive(&mut regime, solved, &sides);
    let orders = jets.as_ref().map(|jets| Expansions::plan(&mut regime, solved, &solution, jets));
    if contacts.is_empty() && jets.is_none() {
        return None;
    }
    let laws_of =
        (0..held).map(|_| None).chain(contacts.into_iter().map(|contact| Some(contact.law))).collect();
    Some(Regimes {
        rows,
        laws,
        kinks,
        kink_names,
        jumps,
        corners,
        breaks,
        model: regime,
        guards,
        coefficients,
        is_directed,
        equations,
        turned,
        facts,
        solution,
        hidden: [hidden, in_guards],
        jets,
        orders,
        laws_of,
    })
}

/// Puts a model on the sides of kinks that switches give. Returns the switching functions there, and the
/// contacts, whose coefficients may have kinks, too: the coefficient of friction on a curved surface contains
/// its gradient.
fn on_sides(
    model: &mut Model,
    kinks: &[NodeId],
    switches: &Switches,
    contacts: &[Contact],
) -> (Vec<NodeId>, Vec<Contact>) {
    model.contacts = contacts.to_vec();
    let arguments = kinks::replace(model, kinks, &switches.kinks);
    (arguments, std::mem::take(&mut model.contacts))
}

/// Makes the contacts of a model constraints that always hold, with rows for its loads behind them.
fn as_rows(model: &mut Model) -> (Vec<Contact>, Vec<LoadRow>) {
    let mut contacts = std::mem::take(&mut model.contacts);
    model.at_times = contacts.iter().map(|contact| contact.law.normal()).collect();
    model.constraints.extend(contacts.iter().map(|contact| contact.constraint.clone()));
    let first = model.constraints.len();
    let (mut rows, mut indices) = (Vec::new(), Vec::new());
    for load in &model.loads {
        let mut parts = Vec::with_capacity(load.force.len());
        for terms in &load.force {
            parts.push(match terms.as_slice() {
                // The sign of a factor does not change a size.
                &[(row, factor)] if model.graph.as_constant(factor).map(Number::abs) == Some(Number::ONE) => {
                    row
                }
                terms => {
                    rows.push(LoadRow::Sum(terms.to_vec()));
                    first + rows.len() - 1
                }
            });
        }
        indices.push(first + rows.len());
        rows.push(LoadRow::Size(parts));
    }
    for contact in &mut contacts {
        if let Law::Friction { normal: Some(normal), .. } = &mut contact.law
            && let Normal::Load(load) = *normal
        {
            *normal = Normal::Row(indices[load]);
        }
    }
    (contacts, rows)
}

/// Names the rows of loads, which have no name of the user's.
fn name_loads(model: &mut Model, loads: &[LoadRow]) {
    let mut owners = model.loads.iter();
    let mut index = 0;
    for row in loads {
        let Some(load) = owners.as_slice().first() else { return };
        model.constraints.push(Constraint {
            name: format!("{LOAD}{}", load.friction),
            index: Some(index),
            value: model.graph.zero(),
            through: None,
            kind: ConstraintKind::Nonholonomic { chetaev: false },
            origin: load.origin,
        });
        index += 1;
        if matches!(row, LoadRow::Size(_)) {
            (index, _) = (0, owners.next());
        }
    }
}

/// The equations of one regime with angular velocities; `None` if a kink is not found again.
fn turned(described: &Model, regime: &mut Model, switches: &Switches, kinks: &[NodeId]) -> Option<Equations> {
    let mut model = described.clone();
    // Nodes of this graph keep their meaning in the other.
    (model.graph, model.hints) = (regime.graph.clone(), regime.hints.clone());
    model.parameters.clone_from(&regime.parameters);
    let held = model.constraints.len();
    let (contacts, loads) = as_rows(&mut model);
    let contacts = sliding::along(&mut model.graph, &contacts, &switches.slip[held..]);
    let kinks = kinks::described(&described.graph, &mut model, kinks, &contacts)?;
    let (kinks, contacts) = on_sides(&mut model, &kinks, switches, &contacts);
    let mut equations = mechanics::turning(&mut model)?;
    let slips = &switches.slip[held..];
    let (guards, _) =
        Functions::of(&mut model.graph, &equations.conditions, &contacts, slips, loads.len(), kinks);
    equations.followed = guards.all();
    if !contacts.is_empty() {
        hold(&mut model.graph, &mut equations, switches, held, &contacts, loads);
    }
    (regime.graph, regime.hints) = (model.graph, model.hints);
    Some(equations)
}

/// Makes the rows of contacts hold where they are active, and adds the friction of those that slip.
fn hold(
    graph: &mut Graph,
    equations: &mut Equations,
    switches: &Switches,
    held: usize,
    contacts: &[Contact],
    loads: Vec<LoadRow>,
) {
    let count = equations.momenta.len();
    let rows = held + contacts.len();
    let slopes = equations.conditions.jacobian.clone();
    let speeds = equations.conditions.rates.clone();
    let zero = graph.zero();
    let mut coupling = vec![vec![zero; count]; rows + loads.len()];
    let mut given = vec![zero; count];
    for (row, contact) in (held..).zip(contacts) {
        let Law::Friction { kinetic, pair, .. } = contact.law else { continue };
        // −μ times the direction of the slip, which the first of two components carries for both.
        let direction = match pair {
            None => switches.slip[row],
            Some(other) => {
                let carrier = switches.slip[row.min(other)];
                let squares = [row, other].map(|row| graph.powi(speeds[row], 2));
                // With no slip the direction may have any finite value.
                let apart = graph.sum(
                    Number::ONE,
                    &[(squares[0], Number::ONE), (squares[1], Number::ONE), (carrier, Number::MINUS_ONE)],
                );
                graph.product(&[(carrier, Exponent(2)), (speeds[row], Exponent(2)), (apart, Exponent(-1))])
            }
        };
        let mut share = graph.mul(kinetic, direction);
        let normal = contact.law.normal();
        // A load is a size and has no sign.
        if let Some(&side) = normal.and_then(|normal| switches.side.get(normal)) {
            share = graph.mul(share, side);
        }
        for (i, &slope) in slopes[row].iter().enumerate() {
            let force = graph.mul(share, slope);
            let target = match normal {
                Some(normal) => &mut coupling[normal][i],
                None => &mut given[i],
            };
            *target = graph.sub(*target, force);
        }
    }
    for (i, &force) in given.iter().enumerate() {
        for sum in [&mut equations.force, &mut equations.applied, &mut equations.momentum_rates] {
            sum[i] = graph.add(sum[i], force);
        }
    }
    let one = graph.one();
    let conditions = &mut equations.conditions;
    let mut active: Vec<NodeId> =
        (0..rows).map(|row| if row < held { one } else { switches.active[row] }).collect();
    for (row, &active) in active.iter().enumerate() {
        let lists = [
            &mut conditions.positions,
            &mut conditions.position_sizes,
            &mut conditions.rates,
            &mut conditions.rate_sizes,
            &mut conditions.gamma,
        ];
        for list in lists {
            list[row] = graph.mul(active, list[row]);
        }
        for entry in &mut conditions.jacobian[row] {
            *entry = graph.mul(active, *entry);
        }
    }
    conditions.add_rows(graph, loads.len());
    active.resize(rows + loads.len(), zero);
    conditions.reactions = (0..count)
        .map(|i| {
            let terms: Vec<(NodeId, Number)> = (0..rows + loads.len())
                .map(|row| {
                    let multiplier = graph.variable(Variable::Multiplier(row as u32));
                    let force = graph.add(conditions.jacobian[row][i], coupling[row][i]);
                    (graph.mul(force, multiplier), Number::ONE)
                })
                .collect();
            graph.sum(Number::ZERO, &terms)
        })
        .collect();
    conditions.switched = Some(mechanics::Switched { coupling, active, loads });
}
