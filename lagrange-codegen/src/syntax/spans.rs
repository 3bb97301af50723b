//! Spans: that of all tokens, if the compiler can join spans.
//!
//! A stable compiler cannot. Then the span of one telling token serves: the operator, the method, the field,
//! or else the first one. The walks along the edges spare printing every subexpression into tokens.

use proc_macro2::{Span, TokenStream};
use quote::ToTokens;
use syn::Expr;

/// The span of some tokens: of all if the compiler can join spans, else of the first.
pub fn span(tokens: &dyn ToTokens) -> Span {
    let mut stream = TokenStream::new();
    tokens.to_tokens(&mut stream);
    let mut trees = stream.into_iter();
    let Some(first) = trees.next() else { return Span::call_site() };
    let last = trees.last().map_or(first.span(), |tree| tree.span());
    first.span().join(last).unwrap_or(first.span())
}

/// The span of an expression.
pub fn expression(expr: &Expr) -> Span {
    first(expr).join(last(expr)).unwrap_or_else(|| telling(expr))
}

fn telling(expr: &Expr) -> Span {
    match expr {
        Expr::Binary(binary) => span(&binary.op),
        Expr::Assign(assign) => assign.eq_token.span,
        Expr::MethodCall(call) => call.method.span(),
        Expr::Cast(cast) => cast.as_token.span,
        Expr::Field(_) => last(expr),
        Expr::Index(index) => first(&index.index),
        other => first(other),
    }
}

fn first(expr: &Expr) -> Span {
    match expr {
        Expr::Binary(binary) => first(&binary.left),
        Expr::Assign(assign) => first(&assign.left),
        Expr::Call(call) => first(&call.func),
        Expr::Cast(cast) => first(&cast.expr),
        Expr::Field(field) => first(&field.base),
        Expr::Index(index) => first(&index.expr),
        Expr::MethodCall(call) => first(&call.receiver),
        Expr::Paren(paren) => paren.paren_token.span.open(),
        Expr::Group(group) => first(&group.expr),
        Expr::Array(array) => array.bracket_token.span.open(),
        Expr::Repeat(repeat) => repeat.bracket_token.span.open(),
        Expr::Tuple(tuple) => tuple.paren_token.span.open(),
        Expr::Reference(reference) => reference.and_token.span,
        Expr::Closure(closure) => closure.inputs_begin.span,
        Expr::ForLoop(each) => each.for_token.span,
        Expr::While(each) => each.while_token.span,
        Expr::If(branch) => branch.if_token.span,
        Expr::Match(matching) => matching.match_token.span,
        Expr::Block(block) => block.block.brace_token.span.open(),
        Expr::Lit(literal) => literal.lit.span(),
        other => {
            let mut tokens = other.to_token_stream().into_iter();
            tokens.next().map_or_else(Span::call_site, |tree| tree.span())
        }
    }
}

fn last(expr: &Expr) -> Span {
    match expr {
        Expr::Binary(binary) => last(&binary.right),
        Expr::Assign(assign) => last(&assign.right),
        Expr::Call(call) => call.paren_token.span.close(),
        Expr::Field(field) => match &field.member {
            syn::Member::Named(name) => name.span(),
            syn::Member::Unnamed(index) => index.span,
        },
        Expr::Index(index) => index.bracket_token.span.close(),
        Expr::MethodCall(call) => call.paren_token.span.close(),
        Expr::Paren(paren) => paren.paren_token.span.close(),
        Expr::Group(group) => last(&group.expr),
        Expr::Array(array) => array.bracket_token.span.close(),
        Expr::Repeat(repeat) => repeat.bracket_token.span.close(),
        Expr::Tuple(tuple) => tuple.paren_token.span.close(),
        Expr::Reference(reference) => last(&reference.expr),
        Expr::Unary(unary) => last(&unary.expr),
        Expr::Closure(closure) => last(&closure.body),
        Expr::ForLoop(each) => each.body.brace_token.span.close(),
        Expr::While(each) => each.body.brace_token.span.close(),
        Expr::If(branch) => match &branch.else_branch {
            Some((_, otherwise)) => last(otherwise),
            None => branch.then_branch.brace_token.span.close(),
        },
        Expr::Match(matching) => matching.brace_token.span.close(),
        Expr::Block(block) => block.block.brace_token.span.close(),
        Expr::Lit(literal) => literal.lit.span(),
        other => other.to_token_stream().into_iter().last().map_or_else(Span::call_site, |tree| tree.span()),
    }
}
