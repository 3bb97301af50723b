//! Systems with constraints.
