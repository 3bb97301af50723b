//! The runtime's part of generated derivatives: points of evaluation, and matrices of zeros to be filled in.

use syn::Expr;

use super::screws::Forces;
use super::value::{Run, Value, unknown};
use super::{Interpreter, Point, find};

/// The runtime's structs that generated code makes field by field.
pub(super) const RECORDS: [&str; 9] = [
    "lagrange::saddle::Pattern",
    "lagrange::RecursionStep",
    "lagrange::Residuals",
    "lagrange::Equations",
    "lagrange::Balance",
    "lagrange::Imbalance",
    "lagrange::Linearization",
    "lagrange::screws::Screws",
    "lagrange::screws::Group",
];

impl Interpreter<'_> {
    /// The result of a function that only generated derivatives call; `None` for any other function.
    pub(super) fn of_derivatives(&self, function: &str, arguments: &[Value]) -> Option<Run<Value>> {
        let Point { q, u, multipliers, .. } = self.point;
        let (count, inputs, held) = (q.len(), u.len(), multipliers.len());
        Some(match (function, arguments) {
            ("lagrange::Variation::zero", []) => Ok(Value::record([
                ("mass", zeros(count, count)),
                ("by_q", zeros(count, count)),
                ("by_v", zeros(count, count)),
                ("by_t", zero(count)),
                ("by_u", zeros(count, inputs)),
                ("gradients", zeros(held, count)),
                ("rates_by_q", zeros(held, count)),
                ("conditions_by_q", zeros(held, count)),
                ("conditions_by_v", zeros(held, count)),
                ("conditions_by_t", zero(held)),
            ])),
            ("lagrange::ByParameters::zero", []) => self.parameters().map(|parameters| {
                Value::record([
                    ("forces", zeros(count, parameters)),
                    ("conditions", zeros(held, parameters)),
                    ("positions", zeros(held, parameters)),
                    ("rates", zeros(held, parameters)),
                ])
            }),
            (
                "lagrange::Linearized::residual_at"
                | "lagrange::Linearized::linearization_at"
                | "lagrange::Linearized::by_inputs_at"
                | "lagrange::screws::Carried::screws_at",
                _,
            ) => {
                let name = function.rsplit("::").next().unwrap_or_default();
                find(&self.expansion.derivatives, name).and_then(|f| self.call(f, arguments.to_vec()))
            }
            ("lagrange::screws::residual" | "lagrange::screws::linearization", [screws, groups, v, a]) => {
                Forces::of(screws, groups, v, a).map(|forces| match function.ends_with("residual") {
                    true => forces.residual(),
                    false => forces.linearization(),
                })
            }
            ("lagrange::screws::factored", [screws, groups, v, rest]) => {
                Forces::in_motion(screws, groups, v, rest).map(|forces| forces.linearization())
            }
            _ => return None,
        })
    }

    /// The `Place` that derivatives are evaluated at.
    pub(super) fn place_of_derivatives(&self) -> Value {
        let Point { t, q, v, u, accelerations, multipliers, .. } = self.point;
        Value::record([
            ("t", Value::Number(*t)),
            ("q", Value::numbers(q)),
            ("v", Value::numbers(v)),
            ("a", Value::numbers(accelerations)),
            ("multipliers", Value::numbers(multipliers)),
            ("u", Value::numbers(u)),
        ])
    }

    /// How many parameters derivatives are taken by.
    fn parameters(&self) -> Run<usize> {
        match self.expansion.constants.get("PARAMETERS") {
            Some(Expr::Array(names)) => Ok(names.elems.len()),
            _ => unknown("no list of parameters"),
        }
    }
}

fn zero(count: usize) -> Value {
    Value::numbers(&vec![0.0; count])
}

fn zeros(rows: usize, columns: usize) -> Value {
    Value::rows(&vec![vec![0.0; columns]; rows])
}
