//! The items of an expansion that a program may use.

use std::collections::BTreeSet;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Attribute, Expr, ImplItem, Item, ItemImpl, Path, Stmt, Type, Visibility};

use crate::mutation::is_accepted;

/// Types, methods, constants and implemented traits by name.
pub struct Items {
    names: BTreeSet<String>,
    /// Whether the description was accepted.
    pub is_accepted: bool,
}

impl Items {
    /// The items of an expansion.
    pub fn of(expansion: TokenStream) -> Items {
        let is_accepted = is_accepted(&expansion.to_string());
        let mut items = Items { names: BTreeSet::new(), is_accepted };
        let mut piece = TokenStream::new();
        for tree in expansion {
            let ends = match &tree {
                TokenTree::Group(group) => group.delimiter() == Delimiter::Brace && !is_constant(&piece),
                TokenTree::Punct(punct) => punct.as_char() == ';',
                TokenTree::Ident(_) | TokenTree::Literal(_) => false,
            };
            piece.extend([tree]);
            if ends {
                // Tokens that do not parse are the user's own block.
                let whole = syn::parse2(std::mem::take(&mut piece));
                whole.into_iter().for_each(|item| items.add(item));
            }
        }
        items
    }

    /// The items that another expansion lacks.
    pub fn missing_in<'a>(&'a self, other: &'a Items) -> Vec<&'a str> {
        self.names.difference(&other.names).map(String::as_str).collect()
    }

    fn add(&mut self, item: Item) {
        match item {
            Item::Struct(item) => self.name(&item.attrs, item.ident.to_string()),
            Item::Enum(item) => self.name(&item.attrs, item.ident.to_string()),
            Item::Impl(block) => self.block(block),
            // Generated items stand in a constant without a name.
            Item::Const(item) => {
                if let Expr::Block(block) = *item.expr {
                    for statement in block.block.stmts {
                        if let Stmt::Item(item) = statement {
                            self.add(item);
                        }
                    }
                }
            }
            _ => {}
        }
    }

    fn block(&mut self, block: ItemImpl) {
        if let Some((path, ..)) = &block.trait_ {
            // The arguments of these types are numbers of declared things, which may be one less.
            let name = |path: &Path| path.segments.last().map(|segment| segment.ident.to_string());
            if let (Some(implemented), Type::Path(of)) = (name(path), &*block.self_ty) {
                self.name(&block.attrs, format!("{implemented} for {}", name(&of.path).unwrap_or_default()));
            }
            return;
        }
        for item in block.items {
            match item {
                ImplItem::Fn(item) if matches!(item.vis, Visibility::Public(_)) => {
                    self.name(&item.attrs, item.sig.ident.to_string());
                }
                ImplItem::Const(item) if matches!(item.vis, Visibility::Public(_)) => {
                    self.name(&item.attrs, item.ident.to_string())
                }
                _ => {}
            }
        }
    }

    fn name(&mut self, attributes: &[Attribute], name: String) {
        let is_hidden = attributes
            .iter()
            .any(|attribute| attribute.to_token_stream().to_string().contains("doc (hidden)"));
        // Only generated code speaks of surfaces.
        if !is_hidden && !name.contains("__") && !name.starts_with("Surface") {
            self.names.insert(name);
        }
    }
}

/// Whether an item ends with a semicolon, though there is a block in it.
fn is_constant(piece: &TokenStream) -> bool {
    matches!(piece.clone().into_iter().next(), Some(TokenTree::Ident(word)) if word == "const")
}
