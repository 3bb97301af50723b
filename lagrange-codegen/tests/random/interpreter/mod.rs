//! Runs emitted code in doubles: a small interpreter of the Rust that the engine writes.
//!
//! It knows the forms that the emitter uses and nothing else. Any other form ends the run as
//! [`Stop::Unknown`], which fails the test and is never skipped. Factorisations of the runtime are replaced
//! by an elimination of its own.

mod calls;
mod constrained;
mod derivatives;
mod loops;
mod patterns;
mod screws;
mod series;
mod tokens;
mod value;

use std::collections::{BTreeMap, HashMap};

use quote::ToTokens;
use syn::{BinOp, Block, Expr, ImplItemFn, Member, Stmt, UnOp};

use crate::expansion::{Expansion, Functions};
use tokens::{literal_value, path_of, rooted_in_self, text};
use value::unknown;
pub use value::{Run, Stop, Value};

/// The point where a system is evaluated.
#[derive(Clone, Debug)]
pub struct Point {
    pub t: f64,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub u: Vec<f64>,
    /// The accelerations at which derivatives of the equations are evaluated.
    pub accelerations: Vec<f64>,
    /// The multipliers at which they are evaluated.
    pub multipliers: Vec<f64>,
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

    /// A function of the `System` or `Surface` implementation or of the derivatives, which takes constants,
    /// state, accelerations, multipliers and inputs as it asks for them.
    pub fn of_system(&self, name: &str) -> Option<Run<Value>> {
        let Expansion { system, surface, derivatives, .. } = self.expansion;
        let function = system.get(name).or_else(|| surface.get(name)).or_else(|| derivatives.get(name))?;
        let names = match patterns::parameters(function) {
            Ok(names) => names,
            Err(stop) => return Some(Err(stop)),
        };
        let Point { t, q, v, u, accelerations, .. } = self.point;
        let argument = |name: &String| match name.as_str() {
            "self" => Ok(Value::Model),
            "constants" | "_constants" => self.constants(),
            "t" | "_t" => Ok(Value::Number(*t)),
            "q" | "_q" => Ok(Value::numbers(q)),
            "v" | "_v" => Ok(Value::numbers(v)),
            "u" | "_u" => Ok(Value::numbers(u)),
            "accelerations" => Ok(Value::numbers(accelerations)),
            "place" => Ok(self.place_of_derivatives()),
            "matrices" => Ok(Value::Unit),
            other => unknown(format!("the parameter `{other}`")),
        };
        Some(
            names
                .iter()
                .map(argument)
                .collect::<Run<_>>()
                .and_then(|arguments| self.call(function, arguments)),
        )
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
        let result = self.block(&function.block, &mut locals);
        match result {
            // The function fills the matrices in.
            Ok(Value::Unit) => Ok(locals.remove("matrices").unwrap_or(Value::Unit)),
            // `?` in a function that returns a result.
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
                // The interpreter reads the products and sums off these items when they are used.
                Stmt::Item(syn::Item::Use(_) | syn::Item::Struct(_) | syn::Item::Impl(_)) => Value::Unit,
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

    fn expressions<'e>(
        &self,
        list: impl IntoIterator<Item = &'e Expr>,
        locals: &mut Locals,
    ) -> Run<Vec<Value>> {
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
                    "Products" => Ok(Value::Unit),
                    // Patterns of gradients that can differ from zero, and the groups of screws.
                    path if path.ends_with(">::PATTERN") || path.ends_with(">::GROUPS") => {
                        match self.expansion.constants.get(path.rsplit("::").next().unwrap_or_default()) {
                            Some(constant) => self.expression(constant, locals),
                            None => unknown(path),
                        }
                    }
                    _ => self.parameter(expr),
                }
            }
            Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) => Ok(Value::Number(-self.number(&unary.expr, locals)?)),
                UnOp::Deref(_) => self.expression(&unary.expr, locals),
                UnOp::Not(_) => match self.expression(&unary.expr, locals)? {
                    Value::Truth(truth) => Ok(Value::Truth(!truth)),
                    other => unknown(format!("not {other:?}")),
                },
                _ => unknown(text(unary)),
            },
            Expr::If(branch) => self.conditional(branch, locals),
            Expr::Return(result) => match &result.expr {
                Some(result) => Err(Stop::Return(self.expression(result, locals)?)),
                None => unknown("a `return` of nothing"),
            },
            Expr::Binary(binary) if matches!(binary.op, BinOp::Eq(_)) => {
                match (self.expression(&binary.left, locals)?, self.expression(&binary.right, locals)?) {
                    (Value::Integer(left), Value::Integer(right)) => Ok(Value::Truth(left == right)),
                    _ => unknown(text(binary)),
                }
            }
            Expr::Binary(binary) if matches!(binary.op, BinOp::Or(_)) => {
                match (self.expression(&binary.left, locals)?, self.expression(&binary.right, locals)?) {
                    (Value::Truth(left), Value::Truth(right)) => Ok(Value::Truth(left || right)),
                    _ => unknown(text(binary)),
                }
            }
            Expr::Binary(binary) => {
                let (left, right) =
                    (self.expression(&binary.left, locals)?, self.expression(&binary.right, locals)?);
                if let (Value::Integer(left), Value::Integer(right)) = (&left, &right) {
                    return loops::index(binary, *left, *right);
                }
                let (left, right) = (left.number()?, right.number()?);
                match binary.op {
                    BinOp::Add(_) => Ok(Value::Number(left + right)),
                    BinOp::Sub(_) => Ok(Value::Number(left - right)),
                    BinOp::Mul(_) => Ok(Value::Number(left * right)),
                    BinOp::Div(_) => Ok(Value::Number(left / right)),
                    _ => unknown(text(binary)),
                }
            }
            Expr::ForLoop(all) => self.iterate(all, locals),
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
                (record @ Value::Record(_), Member::Named(name)) => record.field(&name.to_string()).cloned(),
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
                let places = match &*assign.left {
                    Expr::Array(places) => Some(&places.elems),
                    Expr::Tuple(places) => Some(&places.elems),
                    _ => None,
                };
                if let (Some(places), Value::List(values)) = (places, &value) {
                    if places.len() != values.len() {
                        return unknown(text(assign));
                    }
                    for (place, value) in places.iter().zip(values) {
                        *self.place(place, locals)? = value.clone();
                    }
                    return Ok(Value::Unit);
                }
                *self.place(&assign.left, locals)? = value;
                Ok(Value::Unit)
            }
            Expr::Struct(state) => {
                let mut fields = BTreeMap::new();
                for field in &state.fields {
                    fields.insert(text(&field.member), self.expression(&field.expr, locals)?);
                }
                if derivatives::RECORDS.contains(&text(&state.path).as_str()) {
                    return Ok(Value::Record(fields));
                }
                match (fields.remove("t"), fields.remove("q"), fields.remove("v")) {
                    (Some(t), Some(q), Some(v)) => Ok(Value::State(Box::new([t, q, v]))),
                    _ => unknown(text(state)),
                }
            }
            Expr::Block(block) => self.block(&block.block, &mut locals.clone()),
            Expr::Try(inner) => match self.expression(&inner.expr, locals)? {
                Value::Result(Ok(value)) => Ok(*value),
                Value::Result(Err(cause)) => Err(Stop::Failure(cause)),
                other => unknown(format!("`?` on {other:?}")),
            },
            Expr::Call(call) if text(&call.func) == "lagrange::solve::outlined" => match call.args.first() {
                // The closure is called at once; it moves copies of what it captures.
                Some(Expr::Closure(closure)) if closure.inputs.is_empty() => {
                    self.expression(&closure.body, &mut locals.clone())
                }
                _ => unknown(text(call)),
            },
            Expr::Call(call) if text(&call.func) == "lagrange::screws::factored" => {
                let mut arguments = self.expressions(&call.args, locals)?;
                arguments.pop();
                let matrices = self.call_path(&path_of(&call.func), arguments)?;
                match call.args.last() {
                    Some(place) => *self.place(place, locals)? = matrices,
                    None => return unknown(text(call)),
                }
                Ok(Value::Unit)
            }
            Expr::Call(call) if matches!(call.args.last(), Some(Expr::Closure(_))) => {
                self.with_closure(call, locals).unwrap_or_else(|| unknown(text(call)))
            }
            Expr::Call(call) => {
                let arguments = self.expressions(&call.args, locals)?;
                self.call_path(&path_of(&call.func), arguments)
            }
            Expr::MethodCall(call) if call.method == "is_some" => Ok(Value::Truth(false)),
            Expr::MethodCall(call) if call.method == "copy_from_slice" => self.copy(call, locals),
            Expr::MethodCall(call) if call.method == "map" => self.map(call, locals),
            Expr::MethodCall(call) => {
                if let Some(value) = self.of_struct(call, locals) {
                    return value;
                }
                let receiver = self.expression(&call.receiver, locals)?;
                match (call.method.to_string().as_str(), receiver) {
                    ("into", receiver) if call.args.is_empty() => Ok(receiver),
                    (name, Value::Model) => {
                        let mut arguments = vec![Value::Model];
                        arguments.extend(self.expressions(&call.args, locals)?);
                        self.call(find(&self.expansion.methods, name)?, arguments)
                    }
                    _ => unknown(text(call)),
                }
            }
            _ => unknown(text(expr)),
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
            pair => pair.to_indices(),
        }
    }

    /// The value that an assignment changes.
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
            Expr::Field(field) => self.place(&field.base, locals)?.field_mut(&text(&field.member)),
            Expr::Paren(inner) => self.place(&inner.expr, locals),
            // A box is transparent here.
            Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => self.place(&unary.expr, locals),
            _ => unknown(text(expr)),
        }
    }
}

fn find<'f>(functions: &'f Functions, name: &str) -> Run<&'f ImplItemFn> {
    functions.get(name).ok_or_else(|| Stop::Unknown(format!("no function `{name}`")))
}
