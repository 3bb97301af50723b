//! Which identifiers mean the same variable.
//!
//! Two variables of one name differ if one was written in a `macro_rules` macro and the other where the macro
//! is called. The compiler tells them apart by the syntax contexts of their spans, which a procedural macro
//! sees in debug output only. A variable from another context than that of the block has a mark behind its
//! name.

use proc_macro2::{Ident, Span};

use super::body::Name;
use super::translate::bare;

/// Between a name and the mark of its context.
const MARK: char = '#';

/// The syntax context of a span, where the compiler tells.
pub fn context(span: Span) -> Option<u32> {
    let text = format!("{span:?}");
    let number = text.strip_prefix(MARK)?;
    let end = number.find(|c: char| !c.is_ascii_digit()).unwrap_or(number.len());
    number[..end].parse().ok()
}

/// The name of a variable in a block that was written in the context `home`.
pub fn variable(ident: &Ident, home: Option<u32>) -> Name {
    let name = bare(ident);
    match context(ident.span()) {
        // `self` is a keyword. rustc refuses one from another context.
        Some(context) if home != Some(context) && &*name != "self" => format!("{name}{MARK}{context}").into(),
        _ => name,
    }
}

/// A name as the user wrote it.
pub fn written(name: &str) -> &str {
    name.split(MARK).next().unwrap_or(name)
}
