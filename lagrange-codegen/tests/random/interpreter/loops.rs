//! Loops over arrays.

use syn::{BinOp, Expr, ExprBinary, ExprForLoop, ExprIndex, ExprMethodCall, ExprRange, Pat};

use super::value::{Run, Value, unknown};
use super::{Interpreter, Locals, text};

impl Interpreter<'_> {
    /// `for i in a..b { … }`.
    pub(super) fn iterate(&self, all: &ExprForLoop, locals: &mut Locals) -> Run<Value> {
        let (Pat::Ident(index), Expr::Range(range)) = (&*all.pat, &*all.expr) else {
            return unknown(text(all));
        };
        let (first, last) = self.range(range, locals)?;
        let before = locals.clone();
        for i in first..last {
            locals.insert(index.ident.to_string(), Value::Integer(i));
            self.block(&all.body, locals)?;
        }
        // The names that the body has bound end with it.
        locals.retain(|name, _| before.contains_key(name));
        Ok(Value::Unit)
    }

    /// `a[b..c].copy_from_slice(&d[e..f])`.
    pub(super) fn copy(&self, call: &ExprMethodCall, locals: &mut Locals) -> Run<Value> {
        let (Expr::Index(to), Some(Expr::Reference(from))) = (&*call.receiver, call.args.first()) else {
            return unknown(text(call));
        };
        let Expr::Index(from) = &*from.expr else { return unknown(text(call)) };
        let ((to_first, to_last), (first, last)) = (self.bounds(to, locals)?, self.bounds(from, locals)?);
        let values = self.expression(&from.expr, locals)?.list()?[first..last].to_vec();
        if to_last - to_first != values.len() {
            return unknown(text(call));
        }
        for (i, value) in (to_first..).zip(values) {
            *self.place(&to.expr, locals)?.at(&[i])? = value;
        }
        Ok(Value::Unit)
    }

    /// `array.map(|x| …)`.
    pub(super) fn map(&self, call: &ExprMethodCall, locals: &mut Locals) -> Run<Value> {
        let Some(Expr::Closure(closure)) = call.args.first() else { return unknown(text(call)) };
        let Some(Pat::Ident(name)) = closure.inputs.first() else { return unknown(text(closure)) };
        let array = self.expression(&call.receiver, locals)?;
        let each = |value: &Value| {
            let mut locals = locals.clone();
            locals.insert(name.ident.to_string(), value.clone());
            self.expression(&closure.body, &mut locals)
        };
        Ok(Value::List(array.list()?.iter().map(each).collect::<Run<_>>()?))
    }

    fn bounds(&self, index: &ExprIndex, locals: &mut Locals) -> Run<(usize, usize)> {
        match &*index.index {
            Expr::Range(range) => self.range(range, locals),
            other => unknown(text(other)),
        }
    }

    fn range(&self, range: &ExprRange, locals: &mut Locals) -> Run<(usize, usize)> {
        let (Some(start), Some(end)) = (&range.start, &range.end) else { return unknown(text(range)) };
        match (self.expression(start, locals)?, self.expression(end, locals)?) {
            (Value::Integer(start), Value::Integer(end)) => Ok((start, end)),
            _ => unknown(text(range)),
        }
    }
}

/// Arithmetic of indices. A result below zero is no index, not even on the way to another one.
pub(super) fn index(binary: &ExprBinary, left: usize, right: usize) -> Run<Value> {
    let result = match binary.op {
        BinOp::Add(_) => left.checked_add(right),
        BinOp::Sub(_) => left.checked_sub(right),
        BinOp::Mul(_) => left.checked_mul(right),
        _ => None,
    };
    result.map_or_else(|| unknown(text(binary)), |index| Ok(Value::Integer(index)))
}
