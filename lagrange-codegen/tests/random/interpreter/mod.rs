//! Runs emitted code in doubles: a small interpreter of the Rust that the engine writes.
//!
//! It knows the forms that the emitter uses and nothing else; whatever it does not know ends the
//! run as [`Stop::Unknown`], which is a failure of the test and never skipped. Factorisations of the
//! runtime are replaced by an elimination of its own.

mod patterns;
mod value;

use std::collections::{BTreeMap, HashMap};

use quote::ToTokens;
use syn::{BinOp, Block, Expr, ImplItemFn, Lit, Member, Stmt, UnOp};

use crate::expansion::{Expansion, Functions};
pub use value::{Run, Stop, Value};
use value::{factored, pivot, real, solved, unknown};

/// The point where a system is evaluated.
#[derive(Clone, Debug)]
pub struct Point {
    pub t: f64,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub u: Vec<f64>,
    /// Values of the user's expressions for parameters, by their text without blanks.
    pub parameters: BTreeMap<String, f64>,
}

/// Runs the functions of one expansion at one point.
#[derive(Clone, Copy)]
pub struct Interpreter<'a> {
    pub expansion: &'a Expansion,
    pub point: &'a Point,
}

type Locals = HashMap<String, Value>;

impl Interpreter<'_> {
    /// An inherent method of the state and, where it asks for them, the inputs. `None` where no
    /// such method was emitted.
    pub fn method(&self, name: &str) -> Option<Run<Value>> {
        let function = self.expansion.methods.get(name)?;
        let Point { t, q, v, u, .. } = self.point;
        let state = Value::State(Box::new([Value::Number(*t), Value::numbers(q), Value::numbers(v)]));
        let mut arguments = vec![Value::Model, state];
        if function.sig.inputs.len() == 3 {
            arguments.push(Value::numbers(u));
        }
        Some(self.call(function, arguments))
    }

    /// `energy_at` of the `System` implementation.
    pub fn energy_at(&self) -> Run<Value> {
        let Point { t, q, v, .. } = self.point;
        let constants = self.constants()?;
        let arguments =
            vec![Value::Model, constants, Value::Number(*t), Value::numbers(q), Value::numbers(v)];
        self.call(find(&self.expansion.system, "energy_at")?, arguments)
    }

    fn constants(&self) -> Run<Value> {
        self.call(find(&self.expansion.system, "constants")?, vec![Value::Model])
    }

    fn call(&self, function: &ImplItemFn, arguments: Vec<Value>) -> Run<Value> {
        let names = patterns::parameters(function)?;
        if names.len() != arguments.len() {
            return unknown(format!("`{}` takes {} arguments", function.sig.ident, names.len()));
        }
        let mut locals: Locals = names.into_iter().zip(arguments).collect();
        match self.block(&function.block, &mut locals) {
            // `?` in a function that returns a `Result`.
            Err(Stop::Failure(cause)) => Ok(Value::Result(Err(cause))),
            other => other,
        }
    }

    fn block(&self, block: &Block, locals: &mut Locals) -> Run<Value> {
        let mut last = Value::Unit;
        for statement in &block.stmts {
            last = match statement {
                Stmt::Local(local) => {
                    let Some(init) = &local.init else { return unknown("a `let` without a value") };
                    let value = self.expression(&init.expr, locals)?;
                    patterns::bind(&local.pat, value, locals)?;
                    Value::Unit
                }
                Stmt::Item(syn::Item::Use(_)) => Value::Unit,
                Stmt::Expr(expr, semicolon) => {
                    let value = self.expression(expr, locals)?;
                    if semicolon.is_some() { Value::Unit } else { value }
                }
                Stmt::Item(_) | Stmt::Macro(_) => return unknown(statement.to_token_stream().to_string()),
            };
        }
        Ok(last)
    }

    fn number(&self, expr: &Expr, locals: &mut Locals) -> Run<f64> {
        self.expression(expr, locals)?.number()
    }

    fn expressions<'e>(&self, list: impl IntoIterator<Item = &'e Expr>, locals: &mut Locals) -> Run<Vec<Value>> {
        list.into_iter().map(|expr| self.expression(expr, locals)).collect()
    }

    fn expression(&self, expr: &Expr, locals: &mut Locals) -> Run<Value> {
        if rooted_in_self(expr) {
            return self.parameter(expr);
        }
        match expr {
            Expr::Lit(literal) => literal_value(&literal.lit),
            Expr::Paren(inner) => self.expression(&inner.expr, locals),
            Expr::Reference(inner) => self.expression(&inner.expr, locals),
            Expr::Path(path) => {
                if let Some(name) = path.path.get_ident()
                    && let Some(value) = locals.get(&name.to_string())
                {
                    return Ok(value.clone());
                }
                match text(path).as_str() {
                    "f64::INFINITY" | "f32::INFINITY" => Ok(Value::Number(f64::INFINITY)),
                    _ => self.parameter(expr),
                }
            }
            Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) => Ok(Value::Number(-self.number(&unary.expr, locals)?)),
                UnOp::Deref(_) => self.expression(&unary.expr, locals),
                _ => unknown(text(unary)),
            },
            Expr::Binary(binary) => {
                let (left, right) = (self.number(&binary.left, locals)?, self.number(&binary.right, locals)?);
                match binary.op {
                    BinOp::Add(_) => Ok(Value::Number(left + right)),
                    BinOp::Sub(_) => Ok(Value::Number(left - right)),
                    BinOp::Mul(_) => Ok(Value::Number(left * right)),
                    BinOp::Div(_) => Ok(Value::Number(left / right)),
                    _ => unknown(text(binary)),
                }
            }
            Expr::Array(array) => Ok(Value::List(self.expressions(&array.elems, locals)?)),
            Expr::Tuple(tuple) => Ok(Value::List(self.expressions(&tuple.elems, locals)?)),
            Expr::Repeat(repeat) => {
                let value = self.expression(&repeat.expr, locals)?;
                match self.expression(&repeat.len, locals)? {
                    Value::Integer(count) => Ok(Value::List(vec![value; count])),
                    other => unknown(format!("{other:?} times")),
                }
            }
            Expr::Field(field) => match (self.expression(&field.base, locals)?, &field.member) {
                (Value::State(parts), Member::Named(name)) => {
                    let [t, q, v] = *parts;
                    match name.to_string().as_str() {
                        "t" => Ok(t),
                        "q" => Ok(q),
                        "v" => Ok(v),
                        _ => unknown(text(field)),
                    }
                }
                (mut list @ Value::List(_), Member::Unnamed(index)) => {
                    list.at(&[index.index as usize]).cloned()
                }
                _ => unknown(text(field)),
            },
            Expr::Index(index) => {
                let indices = self.indices(&index.index, locals)?;
                self.expression(&index.expr, locals)?.at(&indices).cloned()
            }
            Expr::Assign(assign) => {
                let value = self.expression(&assign.right, locals)?;
                *self.place(&assign.left, locals)? = value;
                Ok(Value::Unit)
            }
            Expr::Block(block) => self.block(&block.block, &mut locals.clone()),
            Expr::Try(inner) => match self.expression(&inner.expr, locals)? {
                Value::Result(Ok(value)) => Ok(*value),
                Value::Result(Err(cause)) => Err(Stop::Failure(cause)),
                other => unknown(format!("`?` on {other:?}")),
            },
            Expr::Call(call) => {
                let arguments = self.expressions(&call.args, locals)?;
                self.call_path(&text(&call.func), arguments)
            }
            Expr::MethodCall(call) => {
                let receiver = self.expression(&call.receiver, locals)?;
                match (call.method.to_string().as_str(), receiver, call.args.first()) {
                    ("into", receiver, None) => Ok(receiver),
                    // The error is given a time; the cause stays.
                    ("map_err", receiver @ Value::Result(_), Some(Expr::Closure(_))) => Ok(receiver),
                    ("solve", Value::Factored(matrix), Some(right)) => {
                        let right = self.expression(right, locals)?;
                        solved(&matrix, &right)
                    }
                    _ => unknown(text(call)),
                }
            }
            _ => unknown(text(expr)),
        }
    }

    /// A call of a function by its path.
    fn call_path(&self, path: &str, mut arguments: Vec<Value>) -> Run<Value> {
        let numbers = |arguments: &[Value]| arguments.iter().map(Value::number).collect::<Run<Vec<f64>>>();
        match path {
            "lagrange::solve::pivot" => match arguments.as_slice() {
                [value, scale, Value::Integer(_)] => Ok(pivot(value.number()?, scale.number()?)),
                _ => unknown("the arguments of `pivot`"),
            },
            "lagrange::solve::ldlt" | "lagrange::solve::lu" => match arguments.as_slice() {
                [matrix, coordinates] => factored(&matrix.to_rows()?, coordinates.list()?.len()),
                _ => unknown(format!("the arguments of `{path}`")),
            },
            "::core::result::Result::Ok" if arguments.len() == 1 => {
                Ok(Value::Result(Ok(Box::new(arguments.swap_remove(0)))))
            }
            "lagrange::System::constants" => self.constants(),
            "lagrange::System::accelerations_at" => {
                self.call(find(&self.expansion.system, "accelerations_at")?, arguments)
            }
            "lagrange::nalgebra::SMatrix::repeat" if arguments.len() == 1 => {
                let count = self.point.q.len();
                Ok(Value::List(vec![Value::List(vec![arguments.swap_remove(0); count]); count]))
            }
            "R::zero" => Ok(Value::Number(0.0)),
            "R::one" => Ok(Value::Number(1.0)),
            "R::from_f64" => Ok(Value::Number(numbers(&arguments)?.iter().sum())),
            _ => match path.strip_prefix("Real::") {
                Some(name) => real(name, &numbers(&arguments)?),
                None => unknown(format!("`{path}(…)`")),
            },
        }
    }

    /// The user's own expression for a parameter.
    fn parameter(&self, expr: &Expr) -> Run<Value> {
        let name = text(expr);
        if name == "self" {
            return Ok(Value::Model);
        }
        match self.point.parameters.get(&name) {
            Some(value) => Ok(Value::Number(*value)),
            None => unknown(format!("`{name}` is no variable and no parameter")),
        }
    }

    fn indices(&self, index: &Expr, locals: &mut Locals) -> Run<Vec<usize>> {
        match self.expression(index, locals)? {
            Value::Integer(index) => Ok(vec![index]),
            Value::List(pair) => pair
                .iter()
                .map(|index| match index {
                    Value::Integer(index) => Ok(*index),
                    other => unknown(format!("the index {other:?}")),
                })
                .collect(),
            other => unknown(format!("the index {other:?}")),
        }
    }

    /// What an assignment changes.
    fn place<'l>(&self, expr: &Expr, locals: &'l mut Locals) -> Run<&'l mut Value> {
        match expr {
            Expr::Path(path) => {
                let name = text(path);
                locals.get_mut(&name).ok_or_else(|| Stop::Unknown(format!("the place `{name}`")))
            }
            Expr::Index(index) => {
                let indices = self.indices(&index.index, locals)?;
                self.place(&index.expr, locals)?.at(&indices)
            }
            _ => unknown(text(expr)),
        }
    }
}

fn find<'f>(functions: &'f Functions, name: &str) -> Run<&'f ImplItemFn> {
    functions.get(name).ok_or_else(|| Stop::Unknown(format!("no function `{name}`")))
}

/// `self`, or a field or an element of it.
fn rooted_in_self(expr: &Expr) -> bool {
    match expr {
        Expr::Path(path) => path.path.is_ident("self"),
        Expr::Field(field) => rooted_in_self(&field.base),
        Expr::Index(index) => rooted_in_self(&index.expr),
        _ => false,
    }
}

fn literal_value(literal: &Lit) -> Run<Value> {
    match literal {
        // Zero, one and powers of ten can lack the decimal point of a float, not its suffix.
        Lit::Float(float) => match float.base10_parse() {
            Ok(value) => Ok(Value::Number(value)),
            Err(error) => unknown(error.to_string()),
        },
        Lit::Int(integer) => match integer.base10_parse() {
            Ok(value) => Ok(Value::Integer(value)),
            Err(error) => unknown(error.to_string()),
        },
        _ => unknown(text(literal)),
    }
}

/// Tokens without blanks.
fn text(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string().split_whitespace().collect()
}
