//! The runtime's part of a Taylor expansion: convolutions by their definition, and the loop over the orders.

use std::collections::BTreeMap;

use syn::{Expr, ExprCall, ExprIf, ExprMethodCall, ImplItem, ImplItemFn, Item, Pat, Stmt};

use super::value::{Run, Stop, Value, solved, symmetric, unknown};
use super::{Interpreter, Locals, find, path_of, patterns, text};
use crate::oracle::gauss;

/// The variable that holds the tables: a row for each order so far, and the products.
const TABLES: &str = "tables";

/// Where the length of their rows is kept; not a name of emitted code.
const COLUMNS: &str = "columns of the tables";

/// What emitted code calls the row that it fills.
const ROW: &str = "row";

impl Interpreter<'_> {
    /// The coefficients of the orders 1 to `orders`; `None` where the equations have no solution.
    pub fn series(&self, h: f64, orders: usize) -> Run<Option<Value>> {
        let function = find(&self.expansion.smooth, "jet_at")?;
        let constants = self.call(find(&self.expansion.smooth, "jet_constants")?, vec![Value::Model])?;
        let empty = || Value::List(Vec::new());
        let series = Value::record([("q", empty()), ("v", empty()), ("independence", Value::Unit)]);
        let mut locals = Locals::new();
        for name in patterns::parameters(function)? {
            let value = match name.trim_start_matches('_') {
                "self" => Value::Model,
                "constants" => constants.clone(),
                "t" => Value::Number(self.point.t),
                "q" => Value::numbers(&self.point.q),
                "v" => Value::numbers(&self.point.v),
                "u" => Value::numbers(&self.point.u),
                "h" => Value::Number(h),
                "orders" => Value::Integer(orders),
                TABLES => Value::record([("rows", empty()), ("products", empty())]),
                "series" => series.clone(),
                other => return unknown(format!("the parameter `{other}`")),
            };
            locals.insert(name, value);
        }
        let signature = numbers_in(&text(&function.sig));
        locals.insert(COLUMNS.to_owned(), Value::Integer(signature.iter().copied().max().unwrap_or(0)));
        let items: Vec<&Item> = function
            .block
            .stmts
            .iter()
            .filter_map(|statement| if let Stmt::Item(item) = statement { Some(item) } else { None })
            .collect();
        if let Some(products) = implementations(&items, "Products").next() {
            let patterns = implementations(&items, "Pattern").collect::<Vec<_>>();
            let lanes = tiles(products.1, &patterns)?;
            let lanes = lanes.into_iter().map(|[a, b, to]| {
                Value::List(vec![Value::Integer(a), Value::Integer(b), Value::Integer(to)])
            });
            if let Some(tables) = locals.get_mut(TABLES) {
                *tables.field_mut("products")? = Value::List(lanes.collect());
            }
        }
        if let Some(pairs) = pairs(&items) {
            let pairs = self.expression(pairs, &mut locals)?;
            if let Some(tables) = locals.get_mut(TABLES) {
                *tables.field_mut("products")? = pairs;
            }
        }
        match self.block(&function.block, &mut locals) {
            Ok(Value::Truth(true)) => Ok(locals.remove("series")),
            Ok(Value::Truth(false)) | Err(Stop::Return(Value::Truth(false))) => Ok(None),
            Ok(other) => unknown(format!("`jet_at` returns {other:?}")),
            Err(stop) => Err(stop),
        }
    }

    /// The value of a function of the runtime that only expansions call; `None` for any other function.
    pub(super) fn of_series(&self, function: &str, arguments: &[Value]) -> Option<Run<Value>> {
        let number = |value: f64| Ok(Value::Number(value));
        Some(match (function, arguments) {
            ("lagrange::jets::rate", [Value::Number(h), Value::Integer(order)]) => number(h / *order as f64),
            ("lagrange::jets::index", [Value::Integer(order)]) => number(*order as f64),
            ("lagrange::jets::time", [Value::Number(h), Value::Integer(order)]) => {
                number(if *order == 1 { *h } else { 0.0 })
            }
            ("lagrange::jets::multiplier", [Value::Number(impulse), Value::Number(rate)]) => {
                number(impulse / rate)
            }
            ("lagrange::jets::Convolutions::new", [tables, Value::Unit]) => Ok(tables.clone()),
            ("lagrange::solve::are_finite", [numbers]) => {
                numbers.to_numbers().map(|numbers| Value::Truth(numbers.iter().all(|x| x.is_finite())))
            }
            ("lagrange::constraints::is_singular", [_]) => Ok(Value::Truth(false)),
            ("lagrange::constraints::independence", [_]) => Ok(Value::Unit),
            ("lagrange::saddle::SaddlePoint::solve", [saddle, momenta, conditions]) => {
                impulses(saddle, momenta, conditions)
            }
            ("lagrange::Inverse::of", [steps, factors]) => {
                Ok(Value::record([("steps", steps.clone()), ("factors", factors.clone())]))
            }
            _ => return None,
        })
    }

    /// Calls with closures: the loop over the orders, and values that are computed when they are needed.
    pub(super) fn with_closure(&self, call: &ExprCall, locals: &mut Locals) -> Option<Run<Value>> {
        let Some(Expr::Closure(closure)) = call.args.last() else { return None };
        let path = path_of(&call.func);
        Some(match path.as_str() {
            "lagrange::jets::in_line" | "lagrange::jets::in_turn" => {
                let orders = match self.expression(&call.args[0], locals) {
                    Ok(Value::Integer(orders)) => orders,
                    other => return Some(unknown(format!("{other:?} orders"))),
                };
                // The body changes what it captures.
                let (Some(Pat::Ident(name)), Expr::Block(body)) = (closure.inputs.first(), &*closure.body)
                else {
                    return Some(unknown(text(closure)));
                };
                for order in 1..=orders {
                    locals.insert(name.ident.to_string(), Value::Integer(order));
                    match self.block(&body.block, locals) {
                        Ok(Value::Truth(true)) => {}
                        Err(Stop::Return(Value::Truth(false))) => break,
                        Err(stop) => return Some(Err(stop)),
                        Ok(other) => return Some(unknown(format!("an order returns {other:?}"))),
                    }
                }
                Ok(Value::Unit)
            }
            "lagrange::saddle::Schur::factor" => self
                .expression(&call.args[0], locals)
                .and_then(|lower| Ok(Value::Factored(symmetric(&lower.to_rows()?)?))),
            _ => return None,
        })
    }

    /// Methods of the runtime's structs; `None` for others.
    pub(super) fn of_struct(&self, call: &ExprMethodCall, locals: &mut Locals) -> Option<Run<Value>> {
        let method = call.method.to_string();
        let known = ["sums", "add", "set", "interior", "solve", "solve_order", "is_finite", "independence"];
        known.contains(&method.as_str()).then(|| {
            let arguments = self.expressions(&call.args, locals)?;
            if method == "interior" {
                return self.interior(call, locals);
            }
            let receiver = self.place(&call.receiver, locals)?;
            match (method.as_str(), receiver, arguments.as_slice()) {
                ("set", series, [Value::Integer(_), q, v]) => {
                    series.field_mut("q")?.push(q.clone())?;
                    series.field_mut("v")?.push(v.clone())?;
                    Ok(Value::Unit)
                }
                ("sums", convolutions, [Value::Integer(order)]) => {
                    let rows = convolutions.field("rows")?.to_rows()?;
                    let sum = |pair: &Value| -> Run<f64> {
                        let pair = pair.to_indices()?;
                        Ok((1..*order).map(|j| rows[j - 1][pair[0]] * rows[order - j - 1][pair[1]]).sum())
                    };
                    let products = convolutions.field("products")?.list()?;
                    Ok(Value::numbers(&products.iter().map(sum).collect::<Run<Vec<f64>>>()?))
                }
                ("add", convolutions, [Value::Integer(_), factors]) => {
                    convolutions.field_mut("rows")?.push(factors.clone())?;
                    Ok(Value::Unit)
                }
                ("solve", Value::Factored(matrix), [right])
                | ("solve_order", Value::Factored(matrix), [_, _, right]) => {
                    solved(matrix, &right.to_numbers()?)
                }
                ("solve_order", saddle @ Value::Record(_), [_, right]) => {
                    let none = Value::numbers(&vec![0.0; self.point.q.len()]);
                    impulses(saddle, &none, right)?
                        .list()?
                        .last()
                        .cloned()
                        .map_or_else(|| unknown(text(call)), Ok)
                }
                ("solve", inverse @ Value::Record(_), [right]) => recur(inverse, &right.to_numbers()?),
                ("is_finite", _, []) => Ok(Value::Truth(true)),
                ("independence", _, []) => Ok(Value::Unit),
                _ => unknown(text(call)),
            }
        })
    }

    /// `tables.interior::<Products, _>(order, &mut inner)`.
    fn interior(&self, call: &ExprMethodCall, locals: &mut Locals) -> Run<Value> {
        let (Value::Integer(order), Some(Expr::Reference(sums))) =
            (self.expression(&call.args[0], locals)?, call.args.last())
        else {
            return unknown(text(call));
        };
        let tables = self.expression(&call.receiver, locals)?;
        let rows = tables.field("rows")?.list()?;
        let entry = |order: usize, column: usize| match rows.get(order - 1) {
            Some(row) => row.list()?.get(column).map_or(Ok(f64::NAN), Value::number),
            None => unknown(format!("the row of order {order}")),
        };
        for product in tables.field("products")?.list()? {
            let place = product.to_indices()?;
            let mut sum = 0.0;
            for j in 1..order {
                sum += entry(j, place[0])? * entry(order - j, place[1])?;
            }
            *self.place(&sums.expr, locals)?.at(&[place[2]])? = Value::Number(sum);
        }
        Ok(Value::Unit)
    }

    /// `if condition { … }`, and a row of the tables that is filled.
    pub(super) fn conditional(&self, branch: &ExprIf, locals: &mut Locals) -> Run<Value> {
        if let Expr::Let(_) = &*branch.cond {
            let Some(Value::Integer(columns)) = locals.get(COLUMNS) else { return unknown("no columns") };
            locals.insert(ROW.to_owned(), Value::numbers(&vec![f64::NAN; *columns]));
            self.block(&branch.then_branch, locals)?;
            let (Some(row), Some(tables)) = (locals.remove(ROW), locals.get_mut(TABLES)) else {
                return unknown("no tables");
            };
            tables.field_mut("rows")?.push(row)?;
            return Ok(Value::Unit);
        }
        match self.expression(&branch.cond, locals)? {
            Value::Truth(true) => self.block(&branch.then_branch, locals),
            Value::Truth(false) if branch.else_branch.is_none() => Ok(Value::Unit),
            other => unknown(format!("`if` on {other:?}")),
        }
    }
}

/// Implementations of a trait among items, with the name of the type.
fn implementations<'i>(
    items: &'i [&'i Item],
    name: &'i str,
) -> impl Iterator<Item = (String, &'i ImplItemFn)> + 'i {
    items.iter().filter_map(move |item| {
        let Item::Impl(block) = item else { return None };
        let (path, _) = block.trait_.as_ref()?;
        let ImplItem::Fn(function) = block.items.first()? else { return None };
        (path.segments.last()?.ident == name).then(|| (text(&block.self_ty), function))
    })
}

/// The indices of the factors of each product, for a system with few products.
fn pairs<'i>(items: &'i [&'i Item]) -> Option<&'i Expr> {
    items.iter().find_map(|item| {
        let Item::Impl(block) = item else { return None };
        match block.items.first()? {
            ImplItem::Const(factors) => Some(&factors.expr),
            _ => None,
        }
    })
}

/// All products of the tiles: the columns of both factors, and the index of the sum.
fn tiles(sum: &ImplItemFn, patterns: &[(String, &ImplItemFn)]) -> Run<Vec<[usize; 3]>> {
    let mut lanes = Vec::new();
    for statement in &sum.block.stmts {
        // lagrange::jets::tile::<Pattern, _, _, _, W, M>(rows, sums, [base, packed, first, used, stride]);
        let Stmt::Expr(Expr::Call(call), _) = statement else { return unknown(text(statement)) };
        let Some(Expr::Array(place)) = call.args.last() else { return unknown(text(call)) };
        let [base, _, first, used, stride] = numbers_in(&text(place))[..] else {
            return unknown(text(place));
        };
        let Some((_, pattern)) = patterns.iter().find(|(name, _)| text(call).contains(&format!("<{name},")))
        else {
            return unknown(text(call));
        };
        let mut columns: BTreeMap<String, usize> = BTreeMap::new();
        let mut product = 0;
        for statement in &pattern.block.stmts {
            match statement {
                Stmt::Local(local) => {
                    let numbers = local.init.as_ref().map(|init| numbers_in(&text(&init.expr)));
                    let Some(&column) = numbers.as_ref().and_then(|numbers| numbers.last()) else {
                        return unknown(text(local));
                    };
                    columns.insert(text(&local.pat), column * stride);
                }
                Stmt::Expr(Expr::Call(call), _) => {
                    let names: Vec<String> = call.args.iter().skip(1).map(text).collect();
                    let at = |name: Option<&String>| {
                        let column = name.and_then(|name| columns.get(name));
                        column.copied().ok_or_else(|| Stop::Unknown(text(call)))
                    };
                    let (a, b) = (at(names.first())?, at(names.last())?);
                    for i in 0..used {
                        lanes.push([base + a + i, base + b + i, first + product * stride + i]);
                    }
                    product += 1;
                }
                other => return unknown(text(other)),
            }
        }
    }
    Ok(lanes)
}

/// The whole numbers that stand by themselves in a text.
fn numbers_in(text: &str) -> Vec<usize> {
    text.split(|c: char| c != '_' && !c.is_alphanumeric()).filter_map(|word| word.parse().ok()).collect()
}

/// Velocities and impulses of M v − Aᵀκ = r, A v = y.
fn impulses(saddle: &Value, momenta: &Value, conditions: &Value) -> Run<Value> {
    let matrix = super::constrained::equations(saddle)?;
    let (momenta, conditions) = (momenta.to_numbers()?, conditions.to_numbers()?);
    let right = [&momenta[..], &conditions].concat();
    let Some(solution) = gauss(&matrix, &[right]).and_then(|mut all| all.pop()) else {
        return Err(Stop::Return(Value::Truth(false)));
    };
    let (velocities, impulses) = solution.split_at(momenta.len());
    Ok(Value::List(vec![Value::numbers(velocities), Value::numbers(impulses)]))
}

/// The recursion that the runtime makes the inverse with, run for one right-hand side.
fn recur(inverse: &Value, right: &[f64]) -> Run<Value> {
    let factors = inverse.field("factors")?.to_numbers()?;
    let mut steps = Vec::new();
    let mut used = 0;
    for step in inverse.field("steps")?.list()? {
        let Value::Integer(place) = *step.field("place")? else { return unknown(format!("{step:?}")) };
        let others = step.field("others")?.to_indices()?;
        let own = usize::from(place < right.len());
        let count = own + others.len();
        let Some(factors) = factors.get(used..used + count) else {
            return unknown("factors that are missing");
        };
        used += count;
        steps.push((place, others, factors));
    }
    let size = steps.iter().flat_map(|(place, others, _)| others.iter().chain([place])).max();
    let mut values = right.to_vec();
    values.resize(size.map_or(0, |size| size + 1).max(right.len()), 0.0);
    for (place, others, factors) in &steps {
        let load = values[*place];
        let (own, factors) = factors.split_at(factors.len() - others.len());
        values[*place] = own.first().map_or(0.0, |inverse| inverse * load);
        let sign = if own.is_empty() { 1.0 } else { -1.0 };
        for (&other, factor) in others.iter().zip(factors) {
            values[other] += sign * factor * load;
        }
    }
    for (place, others, factors) in steps.iter().rev() {
        let (own, factors) = factors.split_at(factors.len() - others.len());
        let sum: f64 = others.iter().zip(factors).map(|(&other, factor)| factor * values[other]).sum();
        values[*place] = if own.is_empty() { sum } else { values[*place] - sum };
    }
    values.truncate(right.len());
    Ok(Value::numbers(&values))
}
