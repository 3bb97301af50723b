//! Names: what the user may call things without meeting generated code.

mod names;
mod scalars;
mod scopes;
mod types;
