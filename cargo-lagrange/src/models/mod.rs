//! The models of a package: where they stand, and what the macro makes of them.
//!
//! Nothing is compiled. The module tree of a target is read file by file (`source`), and the engine expands
//! each model as the compiler would let it (`expansion`). Models that a `macro_rules!` macro writes are not
//! seen.

mod expansion;
mod source;

use std::fmt;
use std::path::PathBuf;

use proc_macro2::{TokenStream, TokenTree};

pub use expansion::{Costs, Expansion, Structure};
pub use source::{Unread, models};

/// An `impl` block under `#[lagrangian]`.
pub struct Model {
    /// The name of the type.
    pub name: String,
    /// The file, as it was named.
    pub file: PathBuf,
    /// The line of the attribute, from 1.
    pub line: usize,
    arguments: TokenStream,
    block: TokenStream,
}

impl Model {
    /// Whether the attribute has an argument of this name.
    #[must_use]
    pub fn has_argument(&self, name: &str) -> bool {
        let named = |tree: TokenTree| matches!(tree, TokenTree::Ident(ident) if ident == name);
        self.arguments.clone().into_iter().any(named)
    }
}

impl fmt::Display for Model {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{} ({}:{})", self.name, self.file.display(), self.line)
    }
}

/// A mistake in a description.
#[derive(Debug)]
pub struct Mistake {
    /// The file.
    pub file: PathBuf,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// The message of the macro.
    pub message: String,
}

impl fmt::Display for Mistake {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}:{}:{}: error: {}", self.file.display(), self.line, self.column, self.message)
    }
}
