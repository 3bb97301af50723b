//! Names for what an order computes, made from the user's names.

use crate::emit::names::{Names, describe};
use crate::jets::{Jets, Relation, Value};
use crate::model::Model;
use crate::orders::{Expansion, Keeps, Part};
use crate::schedule::{Instruction, Slot};
use crate::{emit::Emission, expr::Variable};

/// Names of variables that pass from statement to statement.
pub(super) struct Of {
    /// A label for each slot of the recurrences.
    labels: Vec<Option<String>>,
    /// The coefficient of time.
    pub time: String,
    /// The coefficients of the velocities, if the runtime solves for them.
    pub velocities: Vec<String>,
    /// The coefficients of the multipliers, each times the rate.
    pub impulses: Vec<String>,
    /// The coefficients of the multipliers.
    pub multipliers: Vec<String>,
    /// The values that an order hands to the next one.
    pub carried: Vec<String>,
}

impl Of {
    pub fn new(model: &Model, jets: &Jets, expansion: &Expansion, names: &mut Names) -> Of {
        let labels = labels(model, jets);
        let coefficient = |names: &mut Names, name: &String| names.claim(Some(format!("{name}_k")));
        let solved = |slot: Slot| matches!(expansion.program.instruction(slot), Instruction::Given(_));
        let velocities = model
            .locals
            .velocities
            .iter()
            .zip(&expansion.velocities)
            // A result of an instruction gets its name where it is computed.
            .map(|(name, &slot)| if solved(slot) { coefficient(names, name) } else { String::new() })
            .collect();
        let multipliers: Vec<String> =
            model.locals.multipliers.iter().map(|name| coefficient(names, name)).collect();
        let impulse = |name: &String| names.claim(Some(format!("{name}_impulse")));
        let impulses = model.locals.multipliers.iter().map(impulse).collect();
        let carried = expansion
            .carried
            .iter()
            .map(|carried| {
                let wish = match carried.keeps {
                    Keeps::Velocity(i) => Some(format!("{}_last", model.locals.velocities[i])),
                    Keeps::Force(i) => Some(format!("{}_force", model.locals.coordinates[i])),
                    Keeps::Relaxation(c) => Some(format!("{}_relaxation", model.constraints[c].label())),
                    Keeps::Flow(slot) => labels[slot.index()].as_ref().map(|label| format!("{label}_flow")),
                };
                names.claim(wish)
            })
            .collect();
        let time = names.claim(Some("t_k".to_owned()));
        Of { labels, time, velocities, impulses, multipliers, carried }
    }

    /// The name of a factor.
    pub fn factor(&self, operand: crate::jets::Operand) -> Option<String> {
        let label = self.labels[operand.slot.index()].as_ref()?;
        Some(if operand.ramp { format!("{label}_ramp") } else { label.clone() })
    }

    /// The name of a part of a coefficient.
    pub fn coefficient(&self, of: Slot, part: Part) -> Option<String> {
        let suffix = match part {
            Part::Known => "known",
            Part::Partial => "partial",
            Part::Whole => "k",
        };
        self.labels[of.index()].as_ref().map(|label| format!("{label}_{suffix}"))
    }

    /// The name of a value at the point of expansion.
    pub fn value(&self, of: usize) -> Option<String> {
        self.labels[of].clone()
    }
}

/// Names auxiliaries by what they are functions of.
pub(super) fn label_auxiliaries(emission: &mut Emission<'_>, jets: &Jets) {
    let index = |slot: Slot| match jets.program.instruction(slot) {
        Instruction::Variable(Variable::Auxiliary(index)) => index as usize,
        _ => 0,
    };
    let count = jets.auxiliaries.iter().map(|series| index(series.slot) + 1).max().unwrap_or(0);
    emission.model.locals.auxiliaries = (0..count).map(|index| format!("y{index}")).collect();
    for &slot in &jets.order {
        let Some(series) = jets.auxiliary(slot) else { continue };
        let of = |x: Slot| describe(emission.model, &jets.program, x, 0).unwrap_or_else(|| "x".to_owned());
        let label = match series.value {
            Value::Unary(function, x) => format!("{}_{}", function.name(), of(x)),
            Value::Binary(function, x, y) => format!("{}_{}_{}", function.name(), of(x), of(y)),
            Value::Same(x) => of(x),
            Value::Power(x, exponent) => match exponent.0 {
                1 => format!("root_{}", of(x)),
                -2 => format!("inverse_{}", of(x)),
                _ => format!("power_{}", of(x)),
            },
        };
        emission.model.locals.auxiliaries[index(slot)] = label;
    }
}

/// A label for each slot: what it is, or else what it is a part of.
fn labels(model: &Model, jets: &Jets) -> Vec<Option<String>> {
    let mut labels: Vec<Option<String>> = vec![None; jets.program.len()];
    for &slot in &jets.order {
        labels[slot.index()] = describe(model, &jets.program, slot, 0);
    }
    let parts = |roots: &[Slot], names: &[String], what: &str| -> Vec<(Slot, String)> {
        roots.iter().zip(names).map(|(&root, name)| (root, format!("{name}_{what}_part"))).collect()
    };
    let (coordinates, constraints) =
        (&model.locals.coordinates, model.constraints.iter().map(|c| c.label()).collect::<Vec<_>>());
    let mut roots = parts(&jets.momenta, coordinates, "momentum");
    roots.extend(parts(&jets.rates, coordinates, "force"));
    roots.extend(parts(&jets.reactions, coordinates, "reaction"));
    roots.extend(parts(&jets.conditions, &constraints, "rate"));
    roots.extend(parts(&jets.relaxation, &constraints, "relaxation"));
    for series in &jets.auxiliaries {
        if let (Relation::Flow(rate), Some(label)) = (&series.relation, &labels[series.slot.index()]) {
            roots.push((*rate, format!("{label}_flow_part")));
        }
    }
    let mut seen = vec![false; jets.program.len()];
    for (root, name) in roots {
        let mut stack = vec![root];
        while let Some(slot) = stack.pop() {
            if std::mem::replace(&mut seen[slot.index()], true) {
                continue;
            }
            labels[slot.index()].get_or_insert_with(|| name.clone());
            jets.series_operands(slot, |operand| stack.push(operand));
        }
    }
    labels
}
