//! One system at one state: the emitted derivatives of its equations of motion against those of the oracle.
//!
//! They are compared first at accelerations and multipliers that have nothing to do with the state, where
//! every term counts, then at those of the motion, where the derivatives of accelerations and multipliers
//! follow.

use std::collections::BTreeMap;

use lagrange_codegen::diagnostics::Diagnostics;
use lagrange_codegen::{lower, syntax};
use quote::ToTokens;
use syn::Expr;

use crate::check::{
    Agreements, CONDITION, Outcome, Sample, absent, expected, flat, instant, is_measurable, point,
};
use crate::close::compare;
use crate::constraint::Kind;
use crate::expansion::Expansion;
use crate::interpreter::{Interpreter, Point, Stop, Value};
use crate::number::{Number, Tracked};
use crate::oracle::{Quantities, gauss};
use crate::source::{PARAMETERS, Source};
use crate::system::System;
use crate::variation::{Matrix, Motion, Variation, response};

/// A description that asks for all derivatives, and the parameters that it asks for them by.
#[derive(Clone, Debug)]
pub struct Asked {
    pub source: Source,
    pub parameters: Vec<usize>,
}

impl Asked {
    /// Asks for derivatives by all parameters that formulas use, since others are refused. The last ones come
    /// first, so that the engine's own order does not pass for the user's.
    pub fn of(system: &System) -> Result<Asked, String> {
        let mut source = Source::of(system);
        let used = used(&source).ok_or_else(|| format!("not understood:\n{source}"))?;
        let is_used = |&i: &usize| used.iter().any(|path| path == PARAMETERS[i]);
        let parameters: Vec<usize> = (0..PARAMETERS.len()).rev().filter(is_used).collect();
        let names: Vec<&str> = parameters.iter().map(|&i| PARAMETERS[i]).collect();
        source.arguments += &match names[..] {
            [] => ", jacobians".to_owned(),
            _ => format!(", sensitivities = [{}]", names.join(", ")),
        };
        Ok(Asked { source, parameters })
    }
}

/// The parameters that formulas use.
fn used(source: &Source) -> Option<Vec<String>> {
    let mut diagnostics = Diagnostics::new();
    let (arguments, item) = (source.arguments.parse().ok()?, source.item.parse().ok()?);
    let item = syntax::parse(arguments, item, "::lagrangian", &mut diagnostics)?;
    let model = lower::lower(&item, &mut diagnostics);
    let path = |path: String| path.split_whitespace().collect();
    Some(model.parameters.into_iter().map(|parameter| path(parameter.path)).collect())
}

/// The expected values at a sample.
#[derive(Clone, Debug)]
pub struct Expected {
    quantities: Quantities,
    /// The derivatives at accelerations and multipliers that do not solve the equations.
    given: Variation,
    accelerations: Vec<f64>,
    multipliers: Vec<f64>,
    /// The derivatives at those of the motion, unless they have too few digits.
    solved: Option<Variation>,
}

impl Expected {
    /// Evaluates the derivatives at a sample by their definitions.
    pub fn of(system: &System, parameters: &[usize], sample: &Sample) -> Expected {
        let (at, quantities) = (instant(system, sample), expected(system, sample));
        let accelerations: Vec<f64> = (0..system.count()).map(|i| 0.7 - 0.4 * i as f64).collect();
        let multipliers: Vec<f64> = (0..system.kinds().len()).map(|c| 0.9 - 0.5 * c as f64).collect();
        let tracked = |values: &[f64]| values.iter().map(|&value| Tracked::constant(value)).collect();
        let given = Motion {
            at: at.clone(),
            accelerations: tracked(&accelerations),
            multipliers: tracked(&multipliers),
        };
        let solved = (quantities.condition <= CONDITION).then(|| {
            let (accelerations, multipliers) =
                (quantities.accelerations.clone(), quantities.held.multipliers.clone());
            Variation::of(system, &Motion { at, accelerations, multipliers }, parameters)
        });
        let given = Variation::of(system, &given, parameters);
        Expected { quantities, given, accelerations, multipliers, solved }
    }

    /// By function and field.
    fn parts(&self) -> Vec<(&'static str, Vec<Tracked>)> {
        let Expected { quantities: Quantities { mass, held, .. }, given, .. } = self;
        let Variation { values, by_q, by_v, by_t, by_u, by_p } = given;
        let mut parts = vec![
            ("imbalance_at.forces", values.forces.clone()),
            ("imbalance_at.conditions", values.conditions.clone()),
            ("variation_at.mass", mass.concat()),
            ("variation_at.by_q", by_q.forces.concat()),
            ("variation_at.by_v", by_v.forces.concat()),
            ("variation_at.by_t", by_t.forces.concat()),
            ("variation_at.by_u", by_u.forces.concat()),
            ("variation_at.gradients", held.jacobian.concat()),
            ("variation_at.rates_by_q", by_q.rates.concat()),
            ("variation_at.conditions_by_q", by_q.conditions.concat()),
            ("variation_at.conditions_by_v", by_v.conditions.concat()),
            ("variation_at.conditions_by_t", by_t.conditions.concat()),
            ("by_parameters_at.forces", by_p.forces.concat()),
            ("by_parameters_at.conditions", by_p.conditions.concat()),
            ("by_parameters_at.positions", by_p.positions.concat()),
            ("by_parameters_at.rates", by_p.rates.concat()),
        ];
        // With constraints the runtime makes these, as derivatives of accelerations.
        if held.rates.is_empty() {
            parts.extend([
                ("residual_at", values.forces.clone()),
                ("linearization_at.mass", mass.concat()),
                ("linearization_at.by_q", by_q.forces.concat()),
                ("linearization_at.by_v", by_v.forces.concat()),
                ("by_inputs_at", by_u.forces.concat()),
            ]);
        }
        parts
    }
}

/// Compares an expansion with what is expected.
pub fn check(
    system: &System,
    Asked { parameters, .. }: &Asked,
    expansion: &Expansion,
    sample: &Sample,
    expected: &Expected,
) -> Result<Outcome, String> {
    declared(system, parameters, expansion)?;
    let parts = expected.parts();
    if !parts.iter().flat_map(|(_, values)| values).all(is_measurable) {
        return Ok(Outcome::OutsideDomain);
    }
    let Expected { accelerations, multipliers, .. } = expected.clone();
    let point = Point { accelerations, multipliers, ..point(system, sample) };
    let run = Interpreter { expansion, point: &point };
    let mut agreements = Agreements::new();
    let mut values: BTreeMap<&str, Value> = BTreeMap::new();
    for (name, wanted) in &parts {
        let (function, field) = name.split_once('.').unwrap_or((name, ""));
        if !values.contains_key(function) {
            values.insert(function, called(&run, function)?);
        }
        let value = &values[function];
        let value = if field.is_empty() { Ok(value.clone()) } else { value.field(field).cloned() };
        agreements.push((name, compare(name, &flat(name, value)?, wanted)?));
    }
    let Some(solved) = &expected.solved else { return Ok(Outcome::IllConditioned(agreements)) };
    agreements.extend(responses(&run, &expected.quantities, solved)?);
    Ok(Outcome::Compared(agreements))
}

/// The constants of the traits.
fn declared(system: &System, parameters: &[usize], expansion: &Expansion) -> Result<(), String> {
    let kinds = system.kinds().into_iter().map(|kind| (kind == Kind::Holonomic).to_string()).collect();
    let names = parameters.iter().map(|&i| format!("{:?}", PARAMETERS[i])).collect();
    for (constant, wanted) in [("HOLONOMIC", kinds), ("PARAMETERS", names)] {
        let wanted: Vec<String> = wanted;
        let found = expansion.constants.get(constant);
        let is_wanted = match found {
            Some(Expr::Array(array)) => array
                .elems
                .iter()
                .map(|element| element.to_token_stream().to_string())
                .eq(wanted.iter().cloned()),
            _ => false,
        };
        if !is_wanted {
            let found = found.map(|expr| expr.to_token_stream().to_string());
            return Err(format!("{constant} is {found:?}, not {wanted:?}"));
        }
    }
    Ok(())
}

/// The derivatives that `response` and `sensitivities` of the runtime make of the emitted ones.
fn responses(
    run: &Interpreter<'_>,
    Quantities { mass, held, .. }: &Quantities,
    solved: &Variation,
) -> Result<Agreements, String> {
    let understood = |stop: Stop| format!("derivatives of the motion: {stop:?}");
    let balance = called(run, "balanced_at")?;
    let part = |name: &str| balance.field(name).and_then(Value::to_numbers).map_err(understood);
    let (accelerations, multipliers) = (part("accelerations")?, part("multipliers")?);
    let point = Point { accelerations, multipliers, ..run.point.clone() };
    let run = Interpreter { point: &point, ..*run };
    let (variation, by_parameters) = (called(&run, "variation_at")?, called(&run, "by_parameters_at")?);
    let rows = |record: &Value, name: &str| record.field(name).and_then(Value::to_rows).map_err(understood);
    let column = |name: &str| -> Result<Vec<Vec<f64>>, String> {
        let numbers = variation.field(name).and_then(Value::to_numbers).map_err(understood)?;
        Ok(numbers.into_iter().map(|x| vec![x]).collect())
    };
    let by_u = rows(&variation, "by_u")?;
    let nothing = vec![vec![0.0; by_u.first().map_or(0, Vec::len)]; held.rates.len()];
    let found = [
        (rows(&variation, "by_q")?, rows(&variation, "conditions_by_q")?),
        (rows(&variation, "by_v")?, rows(&variation, "conditions_by_v")?),
        (column("by_t")?, column("conditions_by_t")?),
        (by_u, nothing),
        (rows(&by_parameters, "forces")?, rows(&by_parameters, "conditions")?),
    ];
    let mut agreements = Agreements::new();
    if let Some(factored) = run.of_system("factored_at") {
        let factored = factored.map_err(understood)?;
        let parts = [("by_q", "factored_at.by_q", &solved.by_q), ("by_v", "factored_at.by_v", &solved.by_v)];
        for (field, name, wanted) in parts {
            let found = rows(&factored, field)?.concat();
            agreements.push((name, compare(name, &found, &wanted.forces.concat())?));
        }
    }
    const NAMES: [[&str; 2]; 5] = [
        ["accelerations by q", "multipliers by q"],
        ["accelerations by v", "multipliers by v"],
        ["accelerations by t", "multipliers by t"],
        ["accelerations by u", "multipliers by u"],
        ["accelerations by p", "multipliers by p"],
    ];
    let matrix = saddle(rows(&variation, "mass")?, &rows(&variation, "gradients")?);
    for ((names, (forces, conditions)), by) in NAMES.into_iter().zip(found).zip(solved.parts()) {
        let width = forces.first().map_or(0, Vec::len);
        let right = |j: usize| -> Vec<f64> {
            let conditions = conditions.iter().map(|row| -row[j]);
            forces.iter().map(|row| row[j]).chain(conditions).collect()
        };
        let columns: Vec<Vec<f64>> = (0..width).map(right).collect();
        let columns = gauss(&matrix, &columns).ok_or("the emitted matrices are singular")?;
        let (accelerations, multipliers): (Matrix, Matrix) = response(mass, held, by);
        let mut start = 0;
        for (name, wanted) in names.into_iter().zip([accelerations, multipliers]) {
            let entries = (start..start + wanted.len()).flat_map(|i| columns.iter().map(move |x| x[i]));
            start += wanted.len();
            agreements.push((name, compare(name, &entries.collect::<Vec<f64>>(), &wanted.concat())?));
        }
    }
    Ok(agreements)
}

/// (M −Aᵀ; A 0).
fn saddle(mut mass: Vec<Vec<f64>>, gradients: &[Vec<f64>]) -> Vec<Vec<f64>> {
    for (i, row) in mass.iter_mut().enumerate() {
        row.extend(gradients.iter().map(|gradient| -gradient[i]));
    }
    for gradient in gradients {
        mass.push([&gradient[..], &vec![0.0; gradients.len()]].concat());
    }
    mass
}

fn called(run: &Interpreter<'_>, name: &str) -> Result<Value, String> {
    run.of_system(name).unwrap_or_else(|| absent(name)).map_err(|stop| format!("{name}: {stop:?}"))
}
