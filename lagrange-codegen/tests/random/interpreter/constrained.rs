//! The runtime's part of a constrained system: the saddle-point equations, solved densely.

use super::value::{Run, Stop, Value, symmetric, unknown};
use super::{Interpreter, find};
use crate::oracle::gauss;

impl Interpreter<'_> {
    /// A function of the runtime that only systems with constraints call; `None` if it is none.
    pub(super) fn of_constraints(&self, function: &str, arguments: &[Value]) -> Option<Run<Value>> {
        Some(match (function, arguments) {
            ("lagrange::Surface::balance_at", _) => self.balance_of(arguments),
            // The interpreter does not check whether the state is on its constraints.
            ("lagrange::constraints::accelerations", [Value::Model, ..]) => {
                self.balance_of(arguments).and_then(|balance| balance.field("accelerations").cloned())
            }
            ("lagrange::saddle::SparseRows::new", [pattern, entries]) => self.rows_of(pattern, entries),
            (
                "lagrange::saddle::Diagonal::factor" | "lagrange::saddle::Sparse::factor",
                [inverses, gradients],
            ) => diagonal(inverses).map(|mass| saddle(Value::rows(&mass), gradients)),
            (
                "lagrange::saddle::Saddle::factor"
                | "lagrange::saddle::Saddle::factor_indefinite"
                | "lagrange::saddle::Saddle::factor_side_by_side",
                [mass, gradients],
            ) => mass
                .to_rows()
                .and_then(|rows| symmetric(&rows))
                .map(|mass| saddle(Value::rows(&mass), gradients)),
            ("lagrange::constraints::finite", [Value::Model, Value::State(_), balance]) => {
                solution(balance).map(|numbers| verdict(numbers.iter().all(|x| x.is_finite())))
            }
            ("lagrange::constraints::check", [Value::Model, t, q, v]) => {
                let arguments = vec![Value::Model, t.clone(), q.clone(), v.clone()];
                self.saddle_of(arguments)
                    .and_then(|(saddle, _)| equations(&saddle))
                    .map(|matrix| verdict(gauss(&matrix, &[]).is_some()))
            }
            ("lagrange::constraints::forces", [Value::Model, Value::State(parts), multipliers]) => {
                let [t, q, v] = (**parts).clone();
                self.saddle_of(vec![Value::Model, t, q, v]).and_then(|(_, gradients)| {
                    let rows = gradients.to_rows()?.into_iter().zip(multipliers.to_numbers()?);
                    let times =
                        |(row, multiplier): (Vec<f64>, f64)| row.iter().map(|a| multiplier * a).collect();
                    Ok(Value::rows(&rows.map(times).collect::<Vec<Vec<f64>>>()))
                })
            }
            ("lagrange::constraints::matrix", [rows]) => Ok(rows.clone()),
            ("lagrange::Independence::clear", [Value::Integer(rows)]) => Ok(independence(*rows)),
            ("lagrange::Reactions::new", [multipliers, unique]) => {
                Ok(Value::List(vec![multipliers.clone(), unique.clone()]))
            }
            ("ModelReactions::from" | "lagrange::nalgebra::SVector::from", [values]) => Ok(values.clone()),
            _ => return None,
        })
    }

    /// The solution of the equations at a state.
    fn balance_of(&self, arguments: &[Value]) -> Run<Value> {
        let equations = self.call(find(&self.expansion.surface, "equations_at")?, arguments.to_vec())?;
        balance(equations.field("saddle")?, equations.field("forces")?, equations.field("gamma")?)
    }

    /// Rows given by their entries that can differ from zero.
    fn rows_of(&self, pattern: &Value, entries: &Value) -> Run<Value> {
        let order = pattern.field("order")?.to_indices()?;
        let mut rows = vec![vec![0.0; self.point.q.len()]; order.len()];
        let mut entries = entries.to_numbers()?.into_iter();
        for (&constraint, coordinates) in order.iter().zip(pattern.field("coordinates")?.list()?) {
            for coordinate in coordinates.to_indices()? {
                let entry = entries.next().ok_or_else(|| Stop::Unknown("too few gradients".to_owned()))?;
                rows[constraint][coordinate] = entry;
            }
        }
        if entries.next().is_some() {
            return unknown("too many gradients");
        }
        Ok(Value::rows(&rows))
    }

    /// The factors and the gradients at a state.
    fn saddle_of(&self, arguments: Vec<Value>) -> Run<(Value, Value)> {
        match self.call(find(&self.expansion.surface, "saddle_at")?, arguments)? {
            Value::List(parts) => match <[Value; 2]>::try_from(parts) {
                Ok([saddle, gradients]) => Ok((saddle, gradients)),
                Err(parts) => unknown(format!("a saddle of {} parts", parts.len())),
            },
            other => unknown(format!("the saddle {other:?}")),
        }
    }
}

fn verdict(regular: bool) -> Value {
    let cause = || "the constrained equations are singular".to_owned();
    Value::Result(if regular { Ok(Box::new(Value::Unit)) } else { Err(cause()) })
}

fn saddle(mass: Value, gradients: &Value) -> Value {
    Value::record([("mass", mass), ("gradients", gradients.clone())])
}

fn diagonal(inverses: &Value) -> Run<Vec<Vec<f64>>> {
    let inverses = inverses.to_numbers()?;
    let row = |(i, inverse): (usize, &f64)| {
        let mut row = vec![0.0; inverses.len()];
        row[i] = 1.0 / inverse;
        row
    };
    Ok(inverses.iter().enumerate().map(row).collect())
}

/// (M −Aᵀ; A 0).
pub(super) fn equations(saddle: &Value) -> Run<Vec<Vec<f64>>> {
    let (mut matrix, gradients) = (saddle.field("mass")?.to_rows()?, saddle.field("gradients")?.to_rows()?);
    if gradients.iter().any(|gradient| gradient.len() != matrix.len()) {
        return unknown("gradients that do not fit the mass matrix");
    }
    for (i, row) in matrix.iter_mut().enumerate() {
        row.extend(gradients.iter().map(|gradient| -gradient[i]));
    }
    for gradient in &gradients {
        matrix.push([&gradient[..], &vec![0.0; gradients.len()]].concat());
    }
    Ok(matrix)
}

/// `Independence` of rows that do not depend on each other.
fn independence(rows: usize) -> Value {
    Value::record([("rank", Value::Integer(rows))])
}

/// `Balance`.
fn balance(saddle: &Value, force: &Value, gamma: &Value) -> Run<Value> {
    let (matrix, force_and_gamma) = (equations(saddle)?, [force.to_numbers()?, gamma.to_numbers()?].concat());
    if matrix.len() != force_and_gamma.len() {
        return unknown("right-hand sides that do not fit the equations");
    }
    let count = force.to_numbers()?.len();
    let solution =
        gauss(&matrix, std::slice::from_ref(&force_and_gamma)).and_then(|mut solutions| solutions.pop());
    let solution = solution.unwrap_or_else(|| vec![f64::NAN; matrix.len()]);
    Ok(Value::record([
        ("accelerations", Value::numbers(&solution[..count])),
        ("multipliers", Value::numbers(&solution[count..])),
        ("independence", independence(matrix.len() - count)),
    ]))
}

fn solution(balance: &Value) -> Run<Vec<f64>> {
    let part = |name: &str| balance.field(name).and_then(Value::to_numbers);
    Ok([part("accelerations")?, part("multipliers")?].concat())
}
