//! Names: what the user may call things without meeting generated code.

mod names;
mod scopes;
mod types;
