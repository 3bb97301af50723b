//! Names for what an order computes, made from the user's names.

use crate::emit::Emission;
use crate::emit::block::{Element, Values};
use crate::emit::names::{Names, describe, without_number};
use crate::expr::Variable;
use crate::jets::{Jets, Relation, Value};
use crate::model::Model;
use crate::orders::{Carried, Expansion, Keeps, Part, Sums};
use crate::schedule::{Given, Instruction, Slot};

/// Names of variables that pass from statement to statement.
pub(super) struct Of {
    /// A label for each slot of the recurrences.
    labels: Vec<Option<String>>,
    /// The coefficient of time.
    pub time: String,
    /// The coefficients of the velocities of each block that the runtime solves for, after the pattern that
    /// binds them. With constraints, all velocities are one block.
    pub velocities: Vec<(String, Values)>,
    /// The coefficients of the multipliers, each times the rate.
    pub impulses: (String, Values),
    /// The coefficients of the multipliers.
    pub multipliers: (String, Values),
    /// The values that an order hands to the next one.
    pub carried: Kept,
}

/// Names of the values that an order hands to the next one. Alike values share an array.
pub(super) struct Kept {
    /// The text and the place of each value.
    pub values: Values,
    /// The values with a name of their own.
    pub single: Vec<usize>,
    /// The arrays, each with the values in it.
    pub arrays: Vec<(String, Vec<usize>)>,
}

impl Kept {
    fn new(emission: &Emission<'_>, wishes: Vec<Option<String>>, names: &mut Names) -> Kept {
        let none = Values::none(emission.model, &emission.scalar);
        let kind = |wish: &Option<String>| wish.as_ref().map(|wish| without_number(wish));
        let mut kinds: Vec<(String, Vec<usize>)> = Vec::new();
        for (place, wish) in wishes.iter().enumerate() {
            let Some(kind) = kind(wish) else { continue };
            match kinds.iter_mut().find(|(known, _)| *known == kind) {
                Some((_, members)) => members.push(place),
                None => kinds.push((kind, vec![place])),
            }
        }
        let mut kept = Kept { values: none.clone(), single: Vec::new(), arrays: Vec::new() };
        kept.values.texts = vec![String::new(); wishes.len()];
        kept.values.elements = vec![None; wishes.len()];
        for (kind, members) in
            kinds.into_iter().filter(|(_, members)| members.len() >= emission.model.locals.least)
        {
            let (name, values) = none.clone().bound(names, vec![Some(kind); members.len()]);
            for (&place, (text, element)) in members.iter().zip(values.texts.into_iter().zip(values.elements))
            {
                (kept.values.texts[place], kept.values.elements[place]) = (text, element);
            }
            kept.arrays.push((name, members));
        }
        for (place, wish) in wishes.into_iter().enumerate() {
            if kept.values.elements[place].is_none() {
                kept.values.texts[place] = names.claim(wish);
                kept.single.push(place);
            }
        }
        kept
    }
}

impl Of {
    pub fn new(emission: &Emission<'_>, jets: &Jets, expansion: &Expansion, names: &mut Names) -> Of {
        let model = &*emission.model;
        let none = || Values::none(model, &emission.scalar);
        let labels = labels(model, jets);
        let coefficient = |name: &String| Some(format!("{name}_k"));
        let every: Vec<usize> = (0..model.coordinates.len()).collect();
        let solved = |velocity: &usize| {
            matches!(expansion.program.instruction(expansion.velocities[*velocity]), Instruction::Given(_))
        };
        let blocks = match &expansion.saddle {
            // A result of an instruction gets its name where it is computed.
            Some(_) if every.iter().all(solved) => vec![&every],
            Some(_) => Vec::new(),
            None => expansion.solvers.iter().map(|solver| &solver.coordinates).collect(),
        };
        let of_block = |block: &Vec<usize>| {
            let wishes = block.iter().map(|&i| coefficient(&model.locals.velocities[i])).collect();
            none().bound(names, wishes)
        };
        let velocities = blocks.into_iter().map(of_block).collect();
        let of_constraints = &model.locals.multipliers;
        let multipliers = none().bound(names, of_constraints.iter().map(coefficient).collect());
        let impulse = |name: &String| Some(format!("{name}_impulse"));
        let impulses = none().bound(names, of_constraints.iter().map(impulse).collect());
        let wish = |carried: &Carried| match carried.keeps {
            Keeps::Velocity(i) => Some(format!("{}_last", model.locals.velocities[i])),
            Keeps::Force(i) => Some(format!("{}_force", model.locals.coordinates[i])),
            Keeps::Relaxation(c) => Some(format!("{}_relaxation", model.constraints[c].label())),
            Keeps::Flow(slot) => labels[slot.index()].as_ref().map(|label| format!("{label}_flow")),
        };
        let carried = Kept::new(emission, expansion.carried.iter().map(wish).collect(), names);
        let time = names.claim(Some("t_k".to_owned()));
        Of { labels, time, velocities, impulses, multipliers, carried }
    }

    /// The text of a value that an order is given, with the element that it is and its kind there.
    pub fn given(&self, expansion: &Expansion, given: Given) -> (String, Option<Element>, u32) {
        let of =
            |values: &Values, place: usize| (values.texts[place].clone(), values.elements[place].clone(), 0);
        let named = |name: &str| (name.to_owned(), None, 0);
        match given {
            Given::Rate => named("rate"),
            Given::Index => named("index"),
            Given::Time => named(&self.time),
            Given::Convolution(convolution) => match &expansion.sums {
                Sums::Few(_) => named(&format!("inner[{convolution}]")),
                Sums::Many(tiles) => {
                    let index = tiles.convolutions[convolution as usize];
                    let array = "inner".to_owned();
                    let element = Element { array, length: tiles.sums, index: index as i64 };
                    (format!("inner[{index}]"), Some(element), tiles.roles[convolution as usize])
                }
            },
            Given::Carried(place) => of(&self.carried.values, place as usize),
            Given::Velocity(i) => {
                let i = i as usize;
                let place_in = |block: &Vec<usize>| block.iter().position(|&own| own == i);
                let mut places = expansion
                    .solvers
                    .iter()
                    .map(|solver| place_in(&solver.coordinates))
                    .zip(&self.velocities);
                match places.find_map(|(place, (_, values))| Some(of(values, place?))) {
                    Some(found) => found,
                    None => of(&self.velocities[0].1, i),
                }
            }
            Given::Impulse(c) => of(&self.impulses.1, c as usize),
            Given::Multiplier(c) => of(&self.multipliers.1, c as usize),
        }
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
