//! Blocks, statements and patterns of `syn` into the tree of [`super::body`].

use std::rc::Rc;

use proc_macro2::TokenTree;
use quote::ToTokens;
use syn::{Pat, Stmt};

use super::body::{Arm, Block, Constant, Expr, ExprKind, Name, Path, Pattern, PatternKind, Statement, Word};
use super::item::Record;
use super::spans;
use super::translate::{Translator, bare};
use crate::diagnostics::catalogue;

impl Translator<'_> {
    /// Translates a block.
    pub fn block(&mut self, block: &syn::Block) -> Block {
        let outside = self.enter(block);
        let mut statements = Vec::with_capacity(block.stmts.len());
        let mut value = None;
        for (position, statement) in block.stmts.iter().enumerate() {
            let is_last = position + 1 == block.stmts.len();
            match statement {
                Stmt::Local(local) => statements.push(self.local(local)),
                Stmt::Item(item) => self.item(item, &mut statements),
                Stmt::Expr(expr, None) if is_last => value = Some(self.boxed(expr)),
                Stmt::Expr(expr, _) => statements.push(Statement::Expression(self.expression(expr))),
                Stmt::Macro(call) => {
                    let expr = Expr { origin: self.origin_of(&call.mac), kind: self.macro_call(&call.mac) };
                    match call.semi_token {
                        None if is_last => value = Some(Box::new(expr)),
                        _ => statements.push(Statement::Expression(expr)),
                    }
                }
            }
        }
        self.leave(outside);
        Block { statements, value }
    }

    fn local(&mut self, local: &syn::Local) -> Statement {
        let pattern = self.pattern(&local.pat);
        match &local.init {
            Some(init) if init.diverge.is_some() => {
                let names = names(&local.pat);
                let kind = PatternKind::Unsupported(catalogue::if_let(), names);
                Statement::Let(Pattern { origin: pattern.origin, kind }, None)
            }
            Some(init) => Statement::Let(pattern, Some(self.expression(&init.expr))),
            None => Statement::Let(pattern, None),
        }
    }

    fn item(&mut self, item: &syn::Item, statements: &mut Vec<Statement>) {
        match item {
            syn::Item::Const(constant) => statements.push(Statement::Constant(Constant {
                name: bare(&constant.ident),
                ty: self.ty(&constant.ty),
                value: self.expression(&constant.expr),
                conditional: None,
            })),
            syn::Item::Static(constant) if matches!(constant.mutability, syn::StaticMutability::None) => {
                statements.push(Statement::Constant(Constant {
                    name: bare(&constant.ident),
                    ty: self.ty(&constant.ty),
                    value: self.expression(&constant.expr),
                    conditional: None,
                }));
            }
            syn::Item::Use(import) => {
                let leading = import.leading_colon;
                self.imports(&import.tree, leading, &mut Vec::new(), statements);
            }
            // Other items are reported if they are used.
            _ => {}
        }
    }

    fn imports(
        &mut self,
        tree: &syn::UseTree,
        leading: Option<syn::Token![::]>,
        prefix: &mut Vec<syn::Ident>,
        statements: &mut Vec<Statement>,
    ) {
        let mut import = |translator: &mut Self, prefix: &[syn::Ident], name: &syn::Ident, local: Name| {
            let segments = prefix.iter().chain([name]).cloned().map(syn::PathSegment::from).collect();
            let path = syn::Path { leading_colon: leading, segments };
            // The path tells what the local name means. Emitted code uses the local name itself.
            let code = translator.imported(&local);
            statements.push(Statement::Use(local, Path { code, ..translator.path(None, &path) }));
        };
        match tree {
            syn::UseTree::Path(path) => {
                prefix.push(path.ident.clone());
                self.imports(&path.tree, leading, prefix, statements);
                prefix.pop();
            }
            syn::UseTree::Name(name) => import(self, prefix, &name.ident, bare(&name.ident)),
            syn::UseTree::Rename(rename) => import(self, prefix, &rename.ident, bare(&rename.rename)),
            syn::UseTree::Group(group) => {
                for tree in &group.items {
                    self.imports(tree, leading, prefix, statements);
                }
            }
            syn::UseTree::Glob(_) => statements.push(Statement::Glob),
        }
    }

    /// Translates an arm of a `match`.
    pub fn arm(&mut self, arm: &syn::Arm) -> Arm {
        let (pattern, guard) = match &arm.pat {
            Pat::Guard(guarded) => (&*guarded.pat, Some(&*guarded.guard)),
            plain => (plain, None),
        };
        Arm {
            pattern: self.pattern(pattern),
            guard: guard.map(|guard| self.expression(guard)),
            body: self.expression(&arm.body),
        }
    }

    /// Translates a pattern.
    pub fn pattern(&mut self, pattern: &Pat) -> Pattern {
        let origin = self.origin(spans::span(pattern));
        let kind = match pattern {
            Pat::Wild(_) => PatternKind::Wild,
            Pat::Rest(_) => PatternKind::Rest,
            // What is written through the name would not reach the value that it is a part of.
            Pat::Ident(ident) if ident.by_ref.is_some() && ident.mutability.is_some() => {
                PatternKind::Unsupported(catalogue::mutable_reference(), names(pattern))
            }
            Pat::Ident(ident) if ident.subpat.is_none() => PatternKind::Name(self.variable(&ident.ident)),
            Pat::Paren(paren) => return self.pattern(&paren.pat),
            Pat::Reference(reference) => return self.pattern(&reference.pat),
            Pat::Tuple(tuple) => PatternKind::Tuple(tuple.elems.iter().map(|p| self.pattern(p)).collect()),
            Pat::Slice(slice) => PatternKind::Slice(slice.elems.iter().map(|p| self.pattern(p)).collect()),
            Pat::Type(typed) => {
                let inner = self.pattern(&typed.pat);
                PatternKind::Typed(Box::new(inner), self.ty(&typed.ty))
            }
            Pat::Struct(record) => {
                let known = record.path.get_ident().is_some_and(|i| Record::named(&i.to_string()).is_some());
                if known {
                    let fields = record.fields.iter().map(|field| {
                        let word = match &field.member {
                            syn::Member::Named(name) => self.word(name),
                            syn::Member::Unnamed(index) => Word {
                                name: Rc::from(index.index.to_string()),
                                origin: self.origin(index.span),
                            },
                        };
                        (word, self.pattern(&field.pat))
                    });
                    PatternKind::Record(fields.collect())
                } else {
                    self.unsupported(pattern)
                }
            }
            Pat::Lit(literal) => PatternKind::Constant(self.expression(&syn::Expr::Lit(literal.clone()))),
            Pat::Path(path) => PatternKind::Constant(Expr { origin, kind: self.constant_path(path) }),
            Pat::Range(range) => PatternKind::Range(self.range(range)),
            Pat::Or(either) => PatternKind::Or(either.cases.iter().map(|p| self.pattern(p)).collect()),
            _ => self.unsupported(pattern),
        };
        Pattern { origin, kind }
    }

    fn unsupported(&self, pattern: &Pat) -> PatternKind {
        PatternKind::Unsupported(catalogue::unsupported_pattern(), names(pattern))
    }

    fn constant_path(&mut self, path: &syn::ExprPath) -> ExprKind {
        let path: Path = self.path(path.qself.as_ref(), &path.path);
        ExprKind::Path(path)
    }
}

/// The words in a pattern that may be names it binds.
fn names(pattern: &Pat) -> Vec<Name> {
    let mut names = Vec::new();
    let mut stack = vec![pattern.to_token_stream()];
    while let Some(stream) = stack.pop() {
        for tree in stream {
            match tree {
                TokenTree::Ident(ident) => names.push(bare(&ident)),
                TokenTree::Group(group) => stack.push(group.stream()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    names
}
