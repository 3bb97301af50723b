//! Paths, and the items and imports inside a function.

use std::rc::Rc;

use syn::spanned::Spanned;

use super::body::{Name, Owner, Path};
use super::translate::{Translator, bare};
use super::types::{Type, TypeKind};

/// Traits whose functions are those of the scalar itself.
const SCALAR_TRAITS: [&str; 9] = [
    "Real",
    "Float",
    "RealField",
    "ComplexField",
    "SimdRealField",
    "SimdComplexField",
    "Zero",
    "One",
    "From",
];

impl Translator<'_> {
    /// Enters a block, in all of which its items are in sight. [`Translator::leave`] takes the result.
    pub fn enter(&mut self, block: &syn::Block) -> (usize, usize) {
        let outside = (self.hidden.len(), self.imports.len());
        let mut imports = String::new();
        for statement in &block.stmts {
            let syn::Stmt::Item(item) = statement else { continue };
            let ident = match item {
                syn::Item::Use(_) => {
                    imports.push_str(&format!("#[allow(unused_imports)] {} ", self.text(item)));
                    None
                }
                syn::Item::Static(item) => Some(&item.ident),
                syn::Item::Fn(item) => Some(&item.sig.ident),
                syn::Item::Struct(item) => Some(&item.ident),
                syn::Item::Enum(item) => Some(&item.ident),
                syn::Item::Union(item) => Some(&item.ident),
                syn::Item::Type(item) => Some(&item.ident),
                syn::Item::Mod(item) => Some(&item.ident),
                syn::Item::Trait(item) => Some(&item.ident),
                syn::Item::Macro(item) => item.ident.as_ref(),
                syn::Item::ExternCrate(item) => {
                    Some(item.rename.as_ref().map_or(&item.ident, |(_, name)| name))
                }
                _ => None,
            };
            self.hidden.extend(ident.map(bare));
        }
        if !imports.is_empty() {
            self.imports.push(imports);
        }
        outside
    }

    /// Forgets the items of a block.
    pub fn leave(&mut self, (hidden, imports): (usize, usize)) {
        self.hidden.truncate(hidden);
        self.imports.truncate(imports);
    }

    /// Rust text with the imports in force.
    pub fn imported(&self, text: &str) -> Name {
        self.imports
            .iter()
            .rev()
            .fold(Rc::from(text), |inner, imports| Rc::from(format!("{{ {imports}{inner} }}")))
    }

    /// Whether a path starts with something declared inside the function.
    pub fn is_local(&self, path: &syn::Path) -> bool {
        let first = path.segments.first().filter(|_| path.leading_colon.is_none());
        first.is_some_and(|first| self.hidden.contains(&bare(&first.ident)))
    }

    /// Translates a path.
    pub fn path(&mut self, qself: Option<&syn::QSelf>, path: &syn::Path) -> Path {
        let origin = self.origin(path.span());
        let whole = syn::ExprPath { attrs: Vec::new(), qself: qself.cloned(), path: path.clone() };
        let text = self.text(&whole);
        // Imports do not change paths from `$crate`, `crate` and the like.
        let rooted = path.leading_colon.is_some()
            || path
                .segments
                .first()
                .is_some_and(|first| matches!(&*bare(&first.ident), "Self" | "crate" | "super"));
        let code = if rooted { text.clone() } else { self.imported(&text) };
        let last = match (path.segments.last(), path.segments.len()) {
            (Some(segment), 1) if qself.is_none() => self.variable(&segment.ident),
            (Some(segment), _) => bare(&segment.ident),
            (None, _) => Rc::from(""),
        };
        let owner = match (qself, path.segments.len()) {
            (Some(qself), _) => self.qualified(qself, path),
            (None, _) if self.is_local(path) => Owner::Local(bare(&path.segments[0].ident)),
            (None, 0 | 1) => Owner::None,
            (None, count) => {
                let before = &path.segments[count - 2];
                let name = before.ident.to_string();
                if count == 2 && before.arguments.is_none() && (name == "Self" || name == self.self_name) {
                    Owner::SelfType
                } else {
                    let owners = path.segments.iter().take(count - 1);
                    match self.path_type(owners, path) {
                        Type { kind: TypeKind::Other(_), .. } => Owner::Other(bare(&before.ident)),
                        known => Owner::Type(known),
                    }
                }
            }
        };
        Path { origin, text, code, last, owner }
    }

    /// The owner in `<Type>::name` and `<Type as Trait>::name`. The trait's `name` may be another one than
    /// the type's own.
    fn qualified(&mut self, qself: &syn::QSelf, path: &syn::Path) -> Owner {
        let Some(position) = qself.position.checked_sub(1) else { return self.owner_type(&qself.ty) };
        let by = path.segments.get(position).map_or_else(|| Rc::from(""), |segment| bare(&segment.ident));
        match self.ty(&qself.ty) {
            scalar @ Type { kind: TypeKind::Scalar, .. } if SCALAR_TRAITS.contains(&&*by) => {
                Owner::Type(scalar)
            }
            _ => Owner::Other(by),
        }
    }

    fn owner_type(&mut self, ty: &syn::Type) -> Owner {
        match self.ty(ty) {
            Type { kind: TypeKind::Other(name), .. } if &*name == "Self" || *name == *self.self_name => {
                Owner::SelfType
            }
            Type { kind: TypeKind::Other(name), .. } => Owner::Other(name),
            known => Owner::Type(known),
        }
    }
}
