//! The emitted quantities of a system with constraints against the oracle.

use crate::check::{Agreements, absent, flat, succeeded};
use crate::close::compare;
use crate::interpreter::{Interpreter, Run, Value};
use crate::number::Tracked;
use crate::oracle::Quantities;

/// The quantities before the equations are solved, which exist whether they can be solved or not:
/// `equations_at`, `saddle_at`, `residuals_at`.
pub fn unsolved(run: &Interpreter<'_>, expected: &Quantities) -> Result<Agreements, String> {
    let held = &expected.held;
    let force: Vec<Tracked> =
        expected.applied.iter().zip(&expected.bias).map(|(&applied, &bias)| applied - bias).collect();
    let mut agreements = Agreements::new();
    let equations = of_system(run, "equations_at")?;
    let factors = equations.field("saddle").map_err(|stop| format!("equations_at: {stop:?}"))?;
    for (name, record, part, wanted) in [
        ("mass of equations", factors, "mass", expected.mass.concat()),
        ("gradients of their factors", factors, "gradients", held.jacobian.concat()),
        ("gradients of equations", &equations, "gradients", held.jacobian.concat()),
        ("forces of equations", &equations, "forces", force),
        ("gamma of equations", &equations, "gamma", held.gamma.clone()),
    ] {
        agreements.push((name, compare(name, &field(record, part)?, &wanted)?));
    }
    let saddle = of_system(run, "saddle_at")?;
    let [factors, gradients] = saddle.list().map_err(|stop| format!("saddle_at: {stop:?}"))? else {
        return Err(format!("saddle_at: {saddle:?}"));
    };
    for (name, found, wanted) in [
        ("mass of saddle", field(factors, "mass")?, expected.mass.concat()),
        ("gradients of saddle", field(factors, "gradients")?, held.jacobian.concat()),
        ("gradients beside saddle", flat("saddle_at", Ok(gradients.clone()))?, held.jacobian.concat()),
    ] {
        agreements.push((name, compare(name, &found, &wanted)?));
    }
    let residuals = of_system(run, "residuals_at")?;
    for (name, part, sizes, wanted) in [
        ("positions", "positions", "position_sizes", &held.positions),
        ("rates", "rates", "rate_sizes", &held.rates),
    ] {
        let (found, sizes) = (field(&residuals, part)?, field(&residuals, sizes)?);
        agreements.push((name, compare(name, &found, wanted)?));
        // No value is larger than the size of all its summands together.
        let bounds = found.iter().zip(&sizes).all(|(value, size)| value.abs() <= size * (1.0 + 1e-9));
        if sizes.len() != found.len() || !bounds {
            return Err(format!("{name}: {found:?} beside sizes {sizes:?}"));
        }
    }
    Ok(agreements)
}

/// The quantities that follow from the solution.
pub fn solved(run: &Interpreter<'_>, expected: &Quantities) -> Result<Agreements, String> {
    let held = &expected.held;
    let mut agreements = Agreements::new();
    let reactions = match method(run, "reactions")? {
        Value::List(parts) => match <[Value; 2]>::try_from(parts) {
            Ok([multipliers, Value::Truth(true)]) => flat("reactions", Ok(multipliers))?,
            other => return Err(format!("reactions: {other:?}")),
        },
        other => return Err(format!("reactions: {other:?}")),
    };
    let numbers = |name: &'static str| flat(name, method_value(run, name));
    for (name, found, wanted) in [
        ("reactions", reactions, held.multipliers.clone()),
        ("reaction_forces", numbers("reaction_forces")?, held.forces.concat()),
        ("reaction_power", numbers("reaction_power")?, vec![held.power]),
        ("energy_rate", numbers("energy_rate")?, vec![held.energy_rate]),
    ] {
        agreements.push((name, compare(name, &found, &wanted)?));
    }
    for (role, wanted) in &held.on_places {
        let name = format!("reactions_on_place_{role}");
        // A place that no constraint uses has no method.
        let found = match run.method(&name) {
            Some(value) => flat(&name, value.and_then(succeeded))?,
            None => vec![0.0; wanted.len()],
        };
        agreements.push(("reactions_on", compare(&name, &found, wanted)?));
    }
    Ok(agreements)
}

fn method_value(run: &Interpreter<'_>, name: &str) -> Run<Value> {
    run.method(name).unwrap_or_else(|| absent(name)).and_then(succeeded)
}

fn method(run: &Interpreter<'_>, name: &str) -> Result<Value, String> {
    method_value(run, name).map_err(|stop| format!("{name}: {stop:?}"))
}

fn of_system(run: &Interpreter<'_>, name: &str) -> Result<Value, String> {
    run.of_system(name).unwrap_or_else(|| absent(name)).map_err(|stop| format!("{name}: {stop:?}"))
}

/// The numbers of a field of a record.
fn field(record: &Value, name: &str) -> Result<Vec<f64>, String> {
    flat(name, record.field(name).cloned())
}
