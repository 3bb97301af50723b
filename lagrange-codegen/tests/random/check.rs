//! One system at one state: every emitted quantity against the oracle.

use std::collections::BTreeMap;

use crate::close::{Agreement, compare};
use crate::expansion::Expansion;
use crate::expression::Instant;
use crate::interpreter::{Interpreter, Point, Stop, Value};
use crate::number::{Number, Tracked};
use crate::oracle::Quantities;
use crate::source::PARAMETERS;
use crate::surface;
use crate::system::System;

/// Enough numbers for the state, the inputs and the parameters of any system.
#[derive(Clone, Debug)]
pub struct Sample {
    pub t: f64,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub u: Vec<f64>,
    pub parameters: Vec<f64>,
}

/// Mass matrices of a larger condition are not solved: the accelerations have too few digits.
pub const CONDITION: f64 = 1e6;

/// Sizes whose products and quotients neither overflow nor underflow; NaN is not in it.
const RANGE: std::ops::Range<f64> = 1e-60..1e60;

/// Comparisons by quantity.
pub type Agreements = Vec<(&'static str, Agreement)>;

/// The result of a comparison that found nothing wrong.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// All quantities agree.
    Compared(Agreements),
    /// All but the accelerations, because the mass matrix is ill-conditioned.
    IllConditioned(Agreements),
    /// Outside the domain of the system's functions, or at a kink of one.
    OutsideDomain,
}

/// A sample for the oracle.
pub fn instant(system: &System, sample: &Sample) -> Instant<Tracked> {
    let tracked =
        |values: &[f64], count: usize| values[..count].iter().map(|&x| Tracked::constant(x)).collect();
    Instant {
        q: tracked(&sample.q, system.count()),
        v: tracked(&sample.v, system.count()),
        t: Tracked::constant(sample.t),
        u: tracked(&sample.u, system.input_count()),
        parameters: tracked(&sample.parameters, PARAMETERS.len()),
    }
}

/// A sample for emitted code.
pub fn point(system: &System, sample: &Sample) -> Point {
    let parameters: BTreeMap<String, f64> =
        PARAMETERS.iter().map(|name| (*name).to_owned()).zip(sample.parameters.iter().copied()).collect();
    Point {
        t: sample.t,
        q: sample.q[..system.count()].to_vec(),
        v: sample.v[..system.count()].to_vec(),
        u: sample.u[..system.input_count()].to_vec(),
        accelerations: Vec::new(),
        multipliers: Vec::new(),
        parameters,
    }
}

/// The expected quantities of a system at a sample.
pub fn expected(system: &System, sample: &Sample) -> Quantities {
    Quantities::of(system, &instant(system, sample))
}

/// Whether a number of the oracle can be compared with.
pub fn is_measurable(x: &Tracked) -> bool {
    x.roundings == 0.0 || RANGE.contains(&x.roundings)
}

/// Compares an expansion with what is expected.
pub fn check(
    system: &System,
    expansion: &Expansion,
    sample: &Sample,
    expected: &Quantities,
) -> Result<Outcome, String> {
    let point = point(system, sample);
    let run = Interpreter { expansion, point: &point };
    let single = |value: Tracked| vec![value];
    let held = &expected.held;
    let mut quantities: Vec<(&'static str, Vec<Tracked>)> = vec![
        ("mass_matrix", expected.mass.concat()),
        ("bias", expected.bias.clone()),
        ("applied_forces", expected.applied.clone()),
        ("momenta", expected.momenta.clone()),
        ("kinetic_energy", single(expected.kinetic)),
        ("potential_energy", single(expected.potential)),
        ("energy", single(expected.energy)),
        ("jacobi_integral", single(expected.jacobi)),
        ("power", single(expected.power)),
    ];
    let is_constrained = !held.rates.is_empty();
    if is_constrained {
        quantities.extend([
            ("constraint_residuals", held.residuals.clone()),
            ("constraint_rates", held.rates.clone()),
            ("constraint_jacobian", held.jacobian.concat()),
        ]);
    }
    if !quantities.iter().flat_map(|(_, values)| values).all(is_measurable) {
        return Ok(Outcome::OutsideDomain);
    }
    let mut agreements = Agreements::new();
    for (name, wanted) in &quantities {
        let found = match run.method(name) {
            Some(value) => flat(name, value.and_then(succeeded))?,
            // Left out: the energy is the Jacobi integral, or there is no force.
            None => match *name {
                "jacobi_integral" => flat(name, run.method("energy").unwrap_or_else(|| absent("energy")))?,
                "applied_forces" | "power" if !system.is_driven() => continue,
                _ => return Err(format!("`{name}` is not emitted")),
            },
        };
        agreements.push((*name, compare(name, &found, wanted)?));
    }
    let found = flat("energy_at", run.of_system("energy_at").unwrap_or_else(|| absent("energy_at")))?;
    agreements.push(("energy_at", compare("energy_at", &found, &single(expected.energy))?));

    if is_constrained {
        agreements.extend(surface::unsolved(&run, expected)?);
    }
    if expected.condition > CONDITION {
        return Ok(Outcome::IllConditioned(agreements));
    }
    let found = run.method("accelerations").unwrap_or_else(|| absent("accelerations"));
    let found = flat("accelerations", found.and_then(succeeded))?;
    agreements.push(("accelerations", compare("accelerations", &found, &expected.accelerations)?));
    if is_constrained {
        agreements.extend(surface::solved(&run, expected)?);
    }
    if let Some(verdict) = run.of_system("check_at") {
        verdict.and_then(succeeded).map_err(|stop| format!("check_at: {stop:?}"))?;
    }
    Ok(Outcome::Compared(agreements))
}

pub fn absent(name: &str) -> Result<Value, Stop> {
    Err(Stop::Unknown(format!("`{name}` is not emitted")))
}

/// The value of a result.
pub fn succeeded(value: Value) -> Result<Value, Stop> {
    match value {
        Value::Result(Ok(value)) => Ok(*value),
        Value::Result(Err(cause)) => Err(Stop::Failure(cause)),
        value => Ok(value),
    }
}

/// All numbers of a value in order.
pub fn flat(name: &str, value: Result<Value, Stop>) -> Result<Vec<f64>, String> {
    match value {
        Ok(Value::Number(value)) => Ok(vec![value]),
        Ok(Value::List(elements)) => {
            let parts: Result<Vec<Vec<f64>>, String> =
                elements.into_iter().map(|element| flat(name, Ok(element))).collect();
            Ok(parts?.concat())
        }
        Ok(other) => Err(format!("{name} is {other:?}")),
        Err(Stop::Failure(cause)) => Err(format!("{name} fails: {cause}")),
        Err(Stop::Return(value)) => Err(format!("{name} returns {value:?} from inside")),
        Err(Stop::Unknown(what)) => Err(format!("{name} cannot be run: {what}")),
    }
}
