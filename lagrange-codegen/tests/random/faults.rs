//! Planted faults: emitted code made wrong in one place, to show that the comparison notices.

use syn::punctuated::Punctuated;
use syn::visit_mut::{self, VisitMut};
use syn::{BinOp, Expr, ImplItemFn, Lit, LitFloat, Pat, Token, UnOp};

use crate::expansion::Expansion;

/// A kind of mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    /// A sum for a difference, or a sign that is lost.
    Sign,
    /// A sum without its last term.
    Term,
    /// A constant that is wrong by 1e−9.
    Digit,
    /// Two neighbours of a list that are exchanged.
    Order,
}

impl Fault {
    /// All kinds.
    pub const ALL: [Fault; 4] = [Fault::Sign, Fault::Term, Fault::Digit, Fault::Order];
}

/// A part of an expansion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The quantities that every system has.
    Quantities,
    /// The derivatives of its equations.
    Derivatives,
}

/// The expansion with a fault planted at its `site`-th place for one; `None` beyond the last place.
pub fn planted(expansion: &Expansion, part: Part, fault: Fault, site: usize) -> Option<Expansion> {
    let mut faulty = expansion.clone();
    let mut planter = Planter { fault, left: Some(site) };
    planter.visit(&mut faulty, part);
    planter.left.is_none().then_some(faulty)
}

/// The number of places for a fault.
pub fn sites(expansion: &Expansion, part: Part, fault: Fault) -> usize {
    let mut planter = Planter { fault, left: Some(usize::MAX) };
    planter.visit(&mut expansion.clone(), part);
    usize::MAX - planter.left.unwrap_or(usize::MAX)
}

/// Whether all numbers of a function are compared. Exceptions are the cause of accelerations that are not
/// finite, the sizes that residuals are measured against, and the comparison with the user's own functions.
fn is_compared(function: &str) -> bool {
    !matches!(function, "check_at" | "residuals_at" | "check_reading_at")
}

/// Counts places down and plants the fault where it arrives at zero.
struct Planter {
    fault: Fault,
    left: Option<usize>,
}

impl Planter {
    fn visit(&mut self, expansion: &mut Expansion, part: Part) {
        let Expansion { methods, system, surface, derivatives, .. } = expansion;
        let functions: Vec<_> = match part {
            Part::Quantities => methods.iter_mut().chain(system).chain(surface).collect(),
            Part::Derivatives => derivatives.iter_mut().collect(),
        };
        for (name, function) in functions {
            if is_compared(name) {
                self.visit_impl_item_fn_mut(function);
            }
        }
    }

    /// Whether this place is the one.
    fn arrives(&mut self) -> bool {
        match self.left {
            Some(0) => {
                self.left = None;
                true
            }
            Some(left) => {
                self.left = Some(left - 1);
                false
            }
            None => false,
        }
    }

    /// Exchanges neighbours that differ.
    fn reorder<T: quote::ToTokens>(&mut self, list: &mut Punctuated<T, Token![,]>) {
        let text = |item: &T| item.to_token_stream().to_string();
        for place in 1..list.len() {
            if text(&list[place - 1]) != text(&list[place]) && self.arrives() {
                let mut items: Vec<T> = std::mem::take(list).into_iter().collect();
                items.swap(place - 1, place);
                list.extend(items);
                return;
            }
        }
    }
}

impl VisitMut for Planter {
    fn visit_impl_item_fn_mut(&mut self, function: &mut ImplItemFn) {
        self.visit_block_mut(&mut function.block);
    }

    fn visit_expr_mut(&mut self, expr: &mut Expr) {
        match (self.fault, &mut *expr) {
            // The second argument is only the scale that the first is compared with.
            (_, Expr::Call(call)) if call.args.len() == 2 && is_pivot(&call.func) => {
                self.visit_expr_mut(&mut call.args[0]);
                return;
            }
            (Fault::Sign, Expr::Binary(binary)) => match binary.op {
                BinOp::Add(_) if self.arrives() => binary.op = BinOp::Sub(Token![-](span())),
                BinOp::Sub(_) if self.arrives() => binary.op = BinOp::Add(Token![+](span())),
                _ => {}
            },
            (Fault::Sign, Expr::Unary(unary)) if matches!(unary.op, UnOp::Neg(_)) && self.arrives() => {
                *expr = (*unary.expr).clone();
            }
            (Fault::Term, Expr::Binary(binary))
                if matches!(binary.op, BinOp::Add(_) | BinOp::Sub(_)) && self.arrives() =>
            {
                *expr = (*binary.left).clone();
            }
            (Fault::Digit, Expr::Lit(literal)) => {
                if let Lit::Float(float) = &literal.lit
                    && let Ok(value) = float.base10_parse::<f64>()
                    && value != 0.0
                    && self.arrives()
                {
                    let wrong = format!("{:?}{}", value * (1.0 + 1e-9), float.suffix());
                    literal.lit = Lit::Float(LitFloat::new(&wrong, span()));
                }
            }
            (Fault::Order, Expr::Array(array)) => self.reorder(&mut array.elems),
            (Fault::Order, Expr::Assign(assign)) => {
                if let Expr::Index(outer) = &mut *assign.left
                    && let Expr::Index(inner) = &mut *outer.expr
                    && inner.index != outer.index
                    && self.arrives()
                {
                    std::mem::swap(&mut inner.index, &mut outer.index);
                }
            }
            _ => {}
        }
        visit_mut::visit_expr_mut(self, expr);
    }

    fn visit_pat_mut(&mut self, pattern: &mut Pat) {
        match (self.fault, &mut *pattern) {
            (Fault::Order, Pat::Slice(slice)) => self.reorder(&mut slice.elems),
            (Fault::Order, Pat::Tuple(tuple)) => self.reorder(&mut tuple.elems),
            _ => {}
        }
        visit_mut::visit_pat_mut(self, pattern);
    }
}

fn is_pivot(function: &Expr) -> bool {
    match function {
        Expr::Path(path) => path.path.segments.last().is_some_and(|last| last.ident == "pivot"),
        _ => false,
    }
}

fn span() -> proc_macro2::Span {
    proc_macro2::Span::call_site()
}
