//! Calls of functions by their paths.

use super::value::{carries, real, solved, symmetric, unknown};
use super::{Interpreter, Run, Value, find};
use crate::oracle::gauss;

impl Interpreter<'_> {
    /// A call of a function by its path.
    pub(super) fn call_path(&self, path: &str, arguments: Vec<Value>) -> Run<Value> {
        let numbers = |arguments: &[Value]| arguments.iter().map(Value::number).collect::<Run<Vec<f64>>>();
        let of_runtime = self
            .of_constraints(path, &arguments)
            .or_else(|| self.of_derivatives(path, &arguments))
            .or_else(|| self.of_series(path, &arguments));
        if let Some(value) = of_runtime {
            return value;
        }
        match (path, arguments.as_slice()) {
            ("lagrange::solve::pivot", [value, scale]) => {
                let (value, scale) = (value.number()?, scale.number()?);
                Ok(Value::Number(if carries(value, scale) { value } else { f64::NAN }))
            }
            ("lagrange::solve::check", [value, scale, Value::Integer(_)]) => {
                Ok(Value::verdict(carries(value.number()?, scale.number()?)))
            }
            ("lagrange::solve::check_all", [values, scales, _]) => {
                let pairs = values.to_numbers()?.into_iter().zip(scales.to_numbers()?);
                Ok(Value::verdict(pairs.into_iter().all(|(value, scale)| carries(value, scale))))
            }
            ("lagrange::solve::factor", [lower]) => Ok(Value::Factored(symmetric(&lower.to_rows()?)?)),
            ("lagrange::solve::symmetric", [lower]) => Ok(Value::rows(&symmetric(&lower.to_rows()?)?)),
            ("lagrange::solve::solve", [Value::Factored(matrix), right]) => {
                solved(matrix, &right.to_numbers()?)
            }
            ("lagrange::solve::check_block", [mass, coordinates]) => {
                let (rows, coordinates) = (mass.to_rows()?, coordinates.to_indices()?);
                if coordinates.iter().any(|&i| i >= rows.len()) {
                    return unknown(format!("a block of the coordinates {coordinates:?}"));
                }
                let row = |&i: &usize| coordinates.iter().map(|&j| rows[i][j]).collect();
                let block: Vec<Vec<f64>> = coordinates.iter().map(row).collect();
                Ok(Value::verdict(gauss(&block, &[]).is_some()))
            }
            ("lagrange::solve::finite", [Value::Model, _, Value::State(_), accelerations]) => {
                let finite = accelerations.to_numbers()?.iter().all(|x| x.is_finite());
                let accelerations = Box::new(accelerations.clone());
                Ok(Value::Result(if finite { Ok(accelerations) } else { Err("not finite".to_owned()) }))
            }
            // Tests that can call the user's functions compare them with the readings.
            ("lagrange::reading::checked" | "lagrange::constraints::sound", _) => Ok(Value::verdict(true)),
            ("core::result::Result::Ok", [value]) => Ok(Value::Result(Ok(Box::new(value.clone())))),
            ("lagrange::System::constants", [Value::Model]) => self.constants(),
            ("lagrange::System::accelerations_at", _) => {
                self.call(find(&self.expansion.system, "accelerations_at")?, arguments)
            }
            ("lagrange::Zero::zero", []) => Ok(Value::Number(0.0)),
            ("lagrange::One::one", []) => Ok(Value::Number(1.0)),
            ("lagrange::Real::from_f64", [value]) => value.number().map(Value::Number),
            ("lagrange::Real::from_parts", [value, _]) => value.number().map(Value::Number),
            _ => match path.strip_prefix("Real::") {
                Some(name) => real(name, &numbers(&arguments)?),
                None => unknown(format!("`{path}(…)`")),
            },
        }
    }
}
