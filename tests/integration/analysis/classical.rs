//! Classical problems.
