//! Integers known from literals and constants of the impl block alone: array lengths.

use super::body::{BinaryOperator, Constant, Expr, ExprKind, Owner};

/// The value of an integer expression, if it is constant.
pub fn integer(expr: &Expr, constants: &[Constant]) -> Option<i128> {
    fold(expr, constants, constants.len())
}

/// `depth` bounds the chain of constants that refer to constants, which might be a cycle.
fn fold(expr: &Expr, constants: &[Constant], depth: usize) -> Option<i128> {
    match &expr.kind {
        ExprKind::Integer(value, _) => Some(*value),
        ExprKind::Path(path) if matches!(path.owner, Owner::None | Owner::SelfType) => {
            let named = |constant: &&Constant| constant.name == path.last && constant.conditional.is_none();
            let constant = constants.iter().find(named)?;
            fold(&constant.value, constants, depth.checked_sub(1)?)
        }
        ExprKind::Cast(inner, _) => fold(inner, constants, depth),
        ExprKind::Block(block) if block.statements.is_empty() => {
            fold(block.value.as_deref()?, constants, depth)
        }
        ExprKind::Binary(operator, left, right) => {
            let left = fold(left, constants, depth)?;
            let right = fold(right, constants, depth)?;
            arithmetic(*operator, left, right)
        }
        _ => None,
    }
}

/// Integer arithmetic; `None` on overflow, on division by zero, and for comparisons.
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
