//! From the root file of a target to its models: modules are followed as the compiler follows them.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, ItemImpl, ItemMod, Lit, Meta, Type};

use super::Model;

/// A file that could not be read or is not Rust.
#[derive(Debug)]
pub struct Unread {
    file: PathBuf,
    /// Line and column, from 1, of what is not Rust.
    place: Option<(usize, usize)>,
    why: String,
}

impl fmt::Display for Unread {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", self.file.display())?;
        if let Some((line, column)) = self.place {
            write!(out, ":{line}:{column}")?;
        }
        write!(out, ": {}", self.why)
    }
}

/// The models in the module tree of `root`, the main file of a target. Those of a file come in the order of
/// the source, before those of the files of its modules.
///
/// # Errors
///
/// The first file that cannot be read or parsed.
pub fn models(root: &Path) -> Result<Vec<Model>, Unread> {
    let mut found = Vec::new();
    // Modules of a root file stand beside it, whatever it is called.
    let folder = root.parent().unwrap_or(Path::new("")).to_path_buf();
    read(root, &folder, &mut found)?;
    Ok(found)
}

/// Reads a file whose modules stand in `folder`.
fn read(file: &Path, folder: &Path, found: &mut Vec<Model>) -> Result<(), Unread> {
    let unread = |place, why: String| Unread { file: file.to_path_buf(), place, why };
    let text = fs::read_to_string(file).map_err(|error| unread(None, error.to_string()))?;
    let parsed = syn::parse_file(&text).map_err(|error| {
        let start = error.span().start();
        unread(Some((start.line, start.column + 1)), error.to_string())
    })?;
    let mut visitor = Visitor { file, folder: folder.to_path_buf(), found, modules: Vec::new() };
    visitor.visit_file(&parsed);
    for (file, folder) in visitor.modules {
        read(&file, &folder, found)?;
    }
    Ok(())
}

struct Visitor<'a> {
    file: &'a Path,
    /// Where the modules of the present module stand.
    folder: PathBuf,
    found: &'a mut Vec<Model>,
    /// Files of modules, with the folders of theirs.
    modules: Vec<(PathBuf, PathBuf)>,
}

impl<'ast> Visit<'ast> for Visitor<'_> {
    fn visit_item_impl(&mut self, block: &'ast ItemImpl) {
        let mut rest = block.clone();
        let Some(position) = rest.attrs.iter().position(is_lagrangian) else {
            return visit::visit_item_impl(self, block);
        };
        let attribute = rest.attrs.remove(position);
        let arguments = match &attribute.meta {
            Meta::List(list) => list.tokens.clone(),
            _ => proc_macro2::TokenStream::new(),
        };
        self.found.push(Model {
            name: type_name(&block.self_ty),
            file: self.file.to_path_buf(),
            line: attribute.span().start().line,
            arguments,
            block: rest.into_token_stream(),
        });
    }

    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        let name = module.ident.to_string();
        let name = name.strip_prefix("r#").unwrap_or(&name);
        let path = path_attribute(&module.attrs);
        if module.content.is_some() {
            let inner = self.folder.join(path.as_deref().unwrap_or(name));
            let outer = std::mem::replace(&mut self.folder, inner);
            visit::visit_item_mod(self, module);
            self.folder = outer;
        } else if let Some(path) = path {
            // The path is relative to the file that says it; modules of that file stand beside it.
            let file = self.file.parent().unwrap_or(Path::new("")).join(path);
            let folder = file.parent().unwrap_or(Path::new("")).to_path_buf();
            self.modules.push((file, folder));
        } else {
            let own = self.folder.join(name);
            let beside = self.folder.join(format!("{name}.rs"));
            let inside = own.join("mod.rs");
            // A module behind a `cfg` may have no file here; the compiler speaks of it where it matters.
            if let Some(file) = [beside, inside].into_iter().find(|file| file.is_file()) {
                self.modules.push((file, own));
            }
        }
    }
}

/// Whether the last segment of the attribute's path is the macro's name.
fn is_lagrangian(attribute: &Attribute) -> bool {
    attribute.path().segments.last().is_some_and(|segment| segment.ident == "lagrangian")
}

/// The path in `#[path = "…"]`.
fn path_attribute(attributes: &[Attribute]) -> Option<String> {
    attributes.iter().find_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("path") => match &pair.value {
            Expr::Lit(literal) => match &literal.lit {
                Lit::Str(text) => Some(text.value()),
                _ => None,
            },
            _ => None,
        },
        _ => None,
    })
}

/// The last segment of a type's path, or the type as written.
fn type_name(ty: &Type) -> String {
    match ty {
        Type::Path(path) => path.path.segments.last().map(|segment| segment.ident.to_string()),
        _ => None,
    }
    .unwrap_or_else(|| ty.to_token_stream().to_string())
}
