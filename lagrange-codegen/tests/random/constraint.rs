//! Constraints of a random system, in any number.

use crate::expression::{Body, Expr, Instant, Scope, Vector};
use crate::number::Number;
use crate::system::{Place, Role, System};

/// The variables of a constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// f(q, t).
    Holonomic,
    /// g(q, v, t), affine in v.
    Affine,
    /// g(q, v, t) of any form.
    Chetaev,
}

/// The value that a constraint function returns.
#[derive(Clone, Debug)]
pub enum Rows {
    Scalar(Expr),
    Array(Vec<Expr>),
    Vector(usize, Vector),
}

impl Rows {
    /// How many constraints these are.
    pub fn count(&self) -> usize {
        match self {
            Rows::Scalar(_) => 1,
            Rows::Array(rows) => rows.len(),
            Rows::Vector(dimension, _) => *dimension,
        }
    }
}

/// Names that a user may give to a constraint; some are also those of generated variables.
const NAMES: [&str; 8] = ["held", "x", "theta", "mass", "gradients", "balance", "state", "saddle"];

impl System {
    /// The functions of constraints: role, kind and body.
    fn constraint_functions(&self) -> impl Iterator<Item = (usize, Kind, &Body<Rows>)> {
        self.roles.iter().enumerate().filter_map(|(index, role)| match role {
            Role::Constraint(kind, _, body) => Some((index, *kind, body)),
            _ => None,
        })
    }

    /// The name of a constraint function.
    pub fn constraint_name(&self, role: usize) -> String {
        let first = self.constraint_functions().next().map(|(first, ..)| first);
        match &self.roles[role] {
            Role::Constraint(_, which, _) if first == Some(role) => NAMES[which % NAMES.len()].to_owned(),
            _ => format!("held_{role}"),
        }
    }

    /// The kind of every scalar constraint.
    pub fn kinds(&self) -> Vec<Kind> {
        self.constraint_functions()
            .flat_map(|(_, kind, body)| std::iter::repeat_n(kind, body.result.count()))
            .collect()
    }

    /// f or g of all constraints. `shift` moves one place for the constraints that use its position.
    pub fn constraints<T: Number>(&self, at: &Instant<T>, shift: Option<&(Place, Vec<T>)>) -> Vec<T> {
        self.constraint_functions()
            .flat_map(|(index, _, body)| {
                let scope = Scope { shift, ..Scope::new(self, at, index) };
                scope.run(body, |scope, rows| match rows {
                    Rows::Scalar(row) => vec![scope.scalar(row)],
                    Rows::Array(rows) => rows.iter().map(|row| scope.scalar(row)).collect(),
                    Rows::Vector(dimension, rows) => scope.vector(rows, *dimension),
                })
            })
            .collect()
    }
}
