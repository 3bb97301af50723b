//! Expressions of `syn` into the tree of [`super::body`].

use std::rc::Rc;

use proc_macro2::Span;
use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{BinOp, Lit, Member, Token, UnOp};

use super::body::{
    BinaryOperator, Closure, Expr, ExprKind, For, If, MethodCall, Name, RangeExpr, UnaryOperator, Word,
};
use super::integers::Integers;
use super::item::Scalar;
use super::{conditional, hygiene, spans};
use crate::diagnostics::{Diagnostics, Origin, catalogue};
use crate::number::Number;

/// Translates the parts of one impl block.
pub struct Translator<'d> {
    /// The sink of messages, which also keeps the spans of origins.
    pub diagnostics: &'d mut Diagnostics,
    /// The scalar of the description.
    pub scalar: Scalar,
    /// The name of the type.
    pub self_name: String,
    /// Names of items declared inside the function, and of its own generic parameters.
    pub hidden: Vec<Name>,
    /// The imports in force, as one text for each block.
    pub imports: Vec<String>,
    /// The syntax context of the impl block.
    home: Option<u32>,
    /// Whether the roles mix precisions. The mistake is reported.
    pub mixed: bool,
}

/// The text of an identifier without the raw prefix.
pub fn bare(ident: &syn::Ident) -> Name {
    let text = ident.to_string();
    Rc::from(text.strip_prefix("r#").unwrap_or(&text))
}

impl<'d> Translator<'d> {
    /// A translator for a block whose `impl` has the given span.
    pub fn new(
        diagnostics: &'d mut Diagnostics,
        scalar: Scalar,
        self_name: String,
        home: Span,
    ) -> Translator<'d> {
        let home = hygiene::context(home);
        Translator {
            diagnostics,
            scalar,
            self_name,
            hidden: Vec::new(),
            imports: Vec::new(),
            home,
            mixed: false,
        }
    }
}

impl Translator<'_> {
    /// The name of a local variable.
    pub fn variable(&self, ident: &syn::Ident) -> Name {
        hygiene::variable(ident, self.home)
    }

    /// The origin of a `cfg` in some tokens.
    pub fn conditional(&mut self, tokens: &dyn ToTokens) -> Option<Origin> {
        let span = conditional::find(tokens.to_token_stream())?;
        Some(self.origin(span))
    }

    /// The origin of some tokens.
    pub fn origin_of(&mut self, tokens: &dyn ToTokens) -> Origin {
        let span = spans::span(tokens);
        self.origin(span)
    }

    /// The origin of a span.
    pub fn origin(&mut self, span: Span) -> Origin {
        self.diagnostics.origin(span)
    }

    /// Tokens as Rust text without superfluous spaces.
    pub fn text(&self, tokens: &dyn ToTokens) -> Name {
        let mut stream = proc_macro2::TokenStream::new();
        tokens.to_tokens(&mut stream);
        let spaced = stream.to_string();
        // Only words need a space between them, as in `dyn Trait` and `as f64`.
        let word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
        let mut text = String::with_capacity(spaced.len());
        let mut characters = spaced.chars().peekable();
        while let Some(c) = characters.next() {
            if c != ' ' || (word(text.chars().last()) && word(characters.peek().copied())) {
                text.push(c);
            }
        }
        Rc::from(text)
    }

    /// Whether a word is the type parameter of the scalar.
    pub fn is_scalar(&self, name: &str) -> bool {
        match &self.scalar {
            Scalar::F64 | Scalar::F32 => false,
            Scalar::Generic(ident) => ident == name,
        }
    }

    /// An identifier with its origin.
    pub fn word(&mut self, ident: &syn::Ident) -> Word {
        Word { name: bare(ident), origin: self.origin(ident.span()) }
    }

    /// Translates an expression.
    pub fn expression(&mut self, expr: &syn::Expr) -> Expr {
        let inner = match expr {
            syn::Expr::Paren(paren) => Some(&paren.expr),
            syn::Expr::Group(group) => Some(&group.expr),
            syn::Expr::Reference(reference) if reference.mutability.is_none() => Some(&reference.expr),
            // A pointer among the parameters is one parameter, and what it points to another.
            syn::Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => match is_field(&unary.expr) {
                true => {
                    let origin = self.origin(spans::expression(expr));
                    return Expr { origin, kind: ExprKind::Pointee(self.boxed(&unary.expr)) };
                }
                false => Some(&unary.expr),
            },
            _ => None,
        };
        let origin = self.origin(spans::expression(expr));
        match inner {
            Some(inner) => Expr { origin, kind: self.expression(inner).kind },
            None => Expr { origin, kind: self.kind(expr) },
        }
    }

    fn kind(&mut self, expr: &syn::Expr) -> ExprKind {
        match expr {
            syn::Expr::Array(array) => ExprKind::Array(self.expressions(&array.elems)),
            syn::Expr::Assign(assign) => {
                ExprKind::Assign(self.boxed(&assign.left), self.boxed(&assign.right))
            }
            syn::Expr::Binary(binary) => self.binary(binary),
            syn::Expr::Block(block) if block.label.is_some() => {
                ExprKind::Unsupported(catalogue::unsupported_syntax("a block with a label"))
            }
            syn::Expr::Block(block) => ExprKind::Block(self.block(&block.block)),
            syn::Expr::Break(exit) if exit.expr.is_none() => ExprKind::Break(label(exit.label.as_ref())),
            syn::Expr::Break(_) => ExprKind::Unsupported(catalogue::break_with_value()),
            syn::Expr::Call(call) => self.call(call),
            syn::Expr::Cast(cast) => {
                let value = self.boxed(&cast.expr);
                ExprKind::Cast(value, self.ty(&cast.ty))
            }
            syn::Expr::Closure(closure) => {
                let parameters = closure.inputs.iter().map(|pattern| self.pattern(pattern)).collect();
                let body = self.expression(&closure.body);
                ExprKind::Closure(Box::new(Closure { parameters, body, is_move: closure.capture.is_some() }))
            }
            syn::Expr::Continue(next) => ExprKind::Continue(label(next.label.as_ref())),
            syn::Expr::Field(field) => {
                let base = self.boxed(&field.base);
                let word = match &field.member {
                    Member::Named(name) => self.word(name),
                    Member::Unnamed(index) => {
                        Word { name: Rc::from(index.index.to_string()), origin: self.origin(index.span) }
                    }
                };
                ExprKind::Field(base, word)
            }
            syn::Expr::ForLoop(each) => {
                let pattern = self.pattern(&each.pat);
                let over = self.expression(&each.expr);
                let label = each.label.as_ref().map(|label| bare(&label.name.ident));
                ExprKind::For(Box::new(For { label, pattern, over, body: self.block(&each.body) }))
            }
            syn::Expr::If(branch) => {
                let condition = self.expression(&branch.cond);
                let then = self.block(&branch.then_branch);
                let otherwise = branch.else_branch.as_ref().map(|(_, expr)| self.expression(expr));
                ExprKind::If(Box::new(If { condition, then, otherwise }))
            }
            syn::Expr::Index(index) => ExprKind::Index(self.boxed(&index.expr), self.boxed(&index.index)),
            syn::Expr::Lit(literal) => self.literal(&literal.lit),
            syn::Expr::Macro(call) => self.macro_call(&call.mac),
            syn::Expr::Match(matching) => {
                let value = self.boxed(&matching.expr);
                ExprKind::Match(value, matching.arms.iter().map(|arm| self.arm(arm)).collect())
            }
            syn::Expr::MethodCall(call) => self.method_call(call),
            syn::Expr::Path(path) => ExprKind::Path(self.path(path.qself.as_ref(), &path.path)),
            syn::Expr::Range(range) => ExprKind::Range(self.range(range)),
            syn::Expr::Repeat(repeat) => ExprKind::Repeat(self.boxed(&repeat.expr), self.boxed(&repeat.len)),
            syn::Expr::Return(exit) => ExprKind::Return(exit.expr.as_ref().map(|value| self.boxed(value))),
            syn::Expr::Tuple(tuple) => ExprKind::Tuple(self.expressions(&tuple.elems)),
            syn::Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) => ExprKind::Unary(UnaryOperator::Negate, self.boxed(&unary.expr)),
                UnOp::Not(_) => ExprKind::Unary(UnaryOperator::Not, self.boxed(&unary.expr)),
                _ => ExprKind::Unsupported(catalogue::unsupported_syntax("this operator")),
            },
            syn::Expr::Reference(_) => ExprKind::Unsupported(catalogue::mutable_reference()),
            syn::Expr::While(_) | syn::Expr::Loop(_) => ExprKind::Unsupported(catalogue::unbounded_loop()),
            syn::Expr::Infer(_) => ExprKind::Wild,
            syn::Expr::Let(_) => ExprKind::Unsupported(catalogue::if_let()),
            syn::Expr::Try(_) => ExprKind::Unsupported(catalogue::question_mark()),
            syn::Expr::Struct(_) => ExprKind::Unsupported(catalogue::struct_literal()),
            syn::Expr::Unsafe(_) => ExprKind::Unsupported(catalogue::unsupported_syntax("an `unsafe` block")),
            syn::Expr::Async(_) | syn::Expr::Await(_) => {
                ExprKind::Unsupported(catalogue::unsupported_syntax("asynchronous code"))
            }
            _ => ExprKind::Unsupported(catalogue::unsupported_syntax("this expression")),
        }
    }

    /// A boxed expression.
    pub fn boxed(&mut self, expr: &syn::Expr) -> Box<Expr> {
        Box::new(self.expression(expr))
    }

    fn expressions(&mut self, list: &Punctuated<syn::Expr, Token![,]>) -> Vec<Expr> {
        list.iter().map(|expr| self.expression(expr)).collect()
    }

    /// Translates a range.
    pub fn range(&mut self, range: &syn::ExprRange) -> RangeExpr {
        RangeExpr {
            start: range.start.as_ref().map(|expr| self.boxed(expr)),
            end: range.end.as_ref().map(|expr| self.boxed(expr)),
            inclusive: matches!(range.limits, syn::RangeLimits::Closed(_)),
        }
    }

    fn binary(&mut self, binary: &syn::ExprBinary) -> ExprKind {
        let (left, right) = (self.boxed(&binary.left), self.boxed(&binary.right));
        let update = match binary.op {
            BinOp::AddAssign(_) => Some(BinaryOperator::Add),
            BinOp::SubAssign(_) => Some(BinaryOperator::Subtract),
            BinOp::MulAssign(_) => Some(BinaryOperator::Multiply),
            BinOp::DivAssign(_) => Some(BinaryOperator::Divide),
            BinOp::RemAssign(_) => Some(BinaryOperator::Remainder),
            _ => None,
        };
        if let Some(operator) = update {
            return ExprKind::Update(operator, left, right);
        }
        let operator = match binary.op {
            BinOp::Add(_) => BinaryOperator::Add,
            BinOp::Sub(_) => BinaryOperator::Subtract,
            BinOp::Mul(_) => BinaryOperator::Multiply,
            BinOp::Div(_) => BinaryOperator::Divide,
            BinOp::Rem(_) => BinaryOperator::Remainder,
            BinOp::And(_) => BinaryOperator::And,
            BinOp::Or(_) => BinaryOperator::Or,
            BinOp::Eq(_) => BinaryOperator::Equal,
            BinOp::Ne(_) => BinaryOperator::NotEqual,
            BinOp::Lt(_) => BinaryOperator::Less,
            BinOp::Le(_) => BinaryOperator::LessEqual,
            BinOp::Gt(_) => BinaryOperator::Greater,
            BinOp::Ge(_) => BinaryOperator::GreaterEqual,
            BinOp::BitXor(_) | BinOp::BitXorAssign(_) => {
                let power = match &right.kind {
                    ExprKind::Integer(power, _) => format!("powi({power})"),
                    _ => "powf(…)".to_string(),
                };
                return ExprKind::Unsupported(catalogue::caret(power));
            }
            _ => return ExprKind::Unsupported(catalogue::unsupported_syntax("a bit operation")),
        };
        ExprKind::Binary(operator, left, right)
    }

    fn call(&mut self, call: &syn::ExprCall) -> ExprKind {
        match call.func.as_ref() {
            syn::Expr::Path(path) => {
                let callee = self.path(path.qself.as_ref(), &path.path);
                ExprKind::Call(callee, self.expressions(&call.args))
            }
            _ => ExprKind::Unsupported(catalogue::call_of_value()),
        }
    }

    fn method_call(&mut self, call: &syn::ExprMethodCall) -> ExprKind {
        let generic = call.turbofish.as_ref().and_then(|list| match list.args.first() {
            Some(syn::GenericArgument::Type(ty)) => Some(self.ty(ty)),
            _ => None,
        });
        ExprKind::Method(Box::new(MethodCall {
            receiver: self.expression(&call.receiver),
            method: self.word(&call.method),
            generic,
            arguments: self.expressions(&call.args),
        }))
    }

    fn literal(&mut self, literal: &Lit) -> ExprKind {
        match literal {
            Lit::Float(float) => self.float(float.base10_digits(), float.suffix()),
            Lit::Int(int) if matches!(int.suffix(), "f32" | "f64") => {
                self.float(int.base10_digits(), int.suffix())
            }
            Lit::Int(int) => match int.base10_parse::<i128>() {
                Ok(value) => ExprKind::Integer(value, Integers::named(int.suffix()).unwrap_or(Integers::ANY)),
                Err(_) => ExprKind::Unsupported(catalogue::integer_overflow()),
            },
            Lit::Bool(boolean) => ExprKind::Boolean(boolean.value),
            _ => ExprKind::Unsupported(catalogue::unsupported_literal()),
        }
    }

    fn float(&self, digits: &str, suffix: &str) -> ExprKind {
        let foreign = match (&self.scalar, suffix) {
            (Scalar::F64, "f32") | (Scalar::F32, "f64") | (Scalar::Generic(_), "f32") => true,
            (Scalar::F64 | Scalar::F32 | Scalar::Generic(_), _) => false,
        };
        match Number::parse(digits) {
            Some(_) if foreign => {
                ExprKind::Unsupported(catalogue::wrong_suffix(suffix, digits, &self.scalar))
            }
            Some(number) => ExprKind::Float(number),
            None => ExprKind::Unsupported(catalogue::unsupported_literal()),
        }
    }

    /// Translates `vector!`, `matrix!` and `point!`; refuses the others.
    pub fn macro_call(&mut self, call: &syn::Macro) -> ExprKind {
        let name = call.path.segments.last().map_or_else(String::new, |segment| segment.ident.to_string());
        if self.is_local(&call.path) {
            return ExprKind::Unsupported(catalogue::local_item(name));
        }
        let list =
            |input: syn::parse::ParseStream| Punctuated::<syn::Expr, Token![,]>::parse_terminated(input);
        match name.as_str() {
            "vector" | "point" => match call.parse_body_with(list) {
                Ok(list) if name == "vector" => ExprKind::Vector(self.expressions(&list)),
                Ok(list) => ExprKind::Point(self.expressions(&list)),
                Err(error) => ExprKind::Unsupported(error.to_string()),
            },
            "matrix" => {
                let rows = |input: syn::parse::ParseStream| {
                    let mut rows: Vec<Vec<syn::Expr>> = vec![Vec::new()];
                    while !input.is_empty() {
                        if let Some(row) = rows.last_mut() {
                            row.push(input.parse()?);
                        }
                        if input.parse::<Option<Token![;]>>()?.is_some() {
                            rows.push(Vec::new());
                        } else if !input.is_empty() {
                            input.parse::<Token![,]>()?;
                        }
                    }
                    rows.retain(|row| !row.is_empty());
                    Ok(rows)
                };
                match call.parse_body_with(rows) {
                    Ok(rows) => {
                        let rows = rows.iter().map(|row| row.iter().map(|e| self.expression(e)).collect());
                        ExprKind::Matrix(rows.collect())
                    }
                    Err(error) => ExprKind::Unsupported(error.to_string()),
                }
            }
            "print" | "println" | "eprint" | "eprintln" | "dbg" | "assert" | "assert_eq" | "assert_ne"
            | "debug_assert" | "debug_assert_eq" | "debug_assert_ne" => {
                ExprKind::Unsupported(catalogue::idle_macro(&name))
            }
            _ => ExprKind::Unsupported(catalogue::unsupported_macro(&name)),
        }
    }
}

fn label(label: Option<&syn::Lifetime>) -> Option<Name> {
    label.map(|label| bare(&label.ident))
}

/// Whether an expression is a field of `self`, or an element or a field of one.
fn is_field(expr: &syn::Expr) -> bool {
    match expr {
        syn::Expr::Paren(paren) => is_field(&paren.expr),
        syn::Expr::Group(group) => is_field(&group.expr),
        syn::Expr::Index(index) => is_field(&index.expr),
        syn::Expr::Field(field) => {
            is_field(&field.base)
                || matches!(&*field.base, syn::Expr::Path(path) if path.path.is_ident("self"))
        }
        syn::Expr::Unary(unary) => matches!(unary.op, UnOp::Deref(_)) && is_field(&unary.expr),
        _ => false,
    }
}
