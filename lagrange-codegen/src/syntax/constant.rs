//! Constant integers, made of literals and constants of the impl block: array lengths.

use super::body::{BinaryOperator, Constant, Expr, ExprKind, Owner};

/// The value of an integer expression, if it is constant.
pub fn integer(expr: &Expr, constants: &[Constant]) -> Option<i128> {
    fold(expr, constants, constants.len(), &mut { LONGEST })
}

/// The most steps of a calculation. Constants that each use the one before twice would double them.
const LONGEST: usize = 10_000;

/// `depth` limits how far constants refer to constants, in case they form a cycle.
fn fold(expr: &Expr, constants: &[Constant], depth: usize, steps: &mut usize) -> Option<i128> {
    *steps = steps.checked_sub(1)?;
    match &expr.kind {
        ExprKind::Integer(value, _) => Some(*value),
        ExprKind::Path(path) if matches!(path.owner, Owner::None | Owner::SelfType) => {
            let named = |constant: &&Constant| constant.name == path.last && constant.conditional.is_none();
            let constant = constants.iter().find(named)?;
            fold(&constant.value, constants, depth.checked_sub(1)?, steps)
        }
        ExprKind::Cast(inner, _) => fold(inner, constants, depth, steps),
        ExprKind::Block(block) if block.statements.is_empty() => {
            fold(block.value.as_deref()?, constants, depth, steps)
        }
        ExprKind::Binary(operator, left, right) => {
            let left = fold(left, constants, depth, steps)?;
            let right = fold(right, constants, depth, steps)?;
            arithmetic(*operator, left, right)
        }
        _ => None,
    }
}

/// Integer arithmetic. `None` on overflow, on division by zero, and for operators whose result is a truth
/// value.
pub fn arithmetic(operator: BinaryOperator, left: i128, right: i128) -> Option<i128> {
    match operator {
        BinaryOperator::Add => left.checked_add(right),
        BinaryOperator::Subtract => left.checked_sub(right),
        BinaryOperator::Multiply => left.checked_mul(right),
        BinaryOperator::Divide => left.checked_div(right),
        BinaryOperator::Remainder => left.checked_rem(right),
        BinaryOperator::And
        | BinaryOperator::Or
        | BinaryOperator::Equal
        | BinaryOperator::NotEqual
        | BinaryOperator::Less
        | BinaryOperator::LessEqual
        | BinaryOperator::Greater
        | BinaryOperator::GreaterEqual => None,
    }
}
