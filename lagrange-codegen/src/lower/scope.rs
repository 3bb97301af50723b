//! Local variables: a stack of names, of which the current function sees its own part.

use super::value::Value;
use crate::syntax::body::Name;

/// The variables in sight.
#[derive(Debug, Default)]
pub struct Scope {
    variables: Vec<(Name, Value)>,
    base: usize,
}

/// A position on the stack to return to.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    length: usize,
    base: usize,
}

impl Scope {
    /// Where the stack stands.
    pub fn mark(&self) -> Mark {
        Mark { length: self.variables.len(), base: self.base }
    }

    /// Hides the variables of the caller.
    pub fn enter(&mut self) -> Mark {
        let mark = self.mark();
        self.base = self.variables.len();
        mark
    }

    /// Drops the variables made since a mark.
    pub fn leave(&mut self, mark: Mark) {
        self.variables.truncate(mark.length);
        self.base = mark.base;
    }

    /// Makes a variable.
    pub fn bind(&mut self, name: Name, value: Value) {
        self.variables.push((name, value));
    }

    /// The position of a variable, the innermost of its name.
    pub fn find(&self, name: &str) -> Option<usize> {
        let own = &self.variables[self.base..];
        own.iter().rposition(|(other, _)| **other == *name).map(|position| self.base + position)
    }

    /// The value of a variable.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.find(name).map(|slot| &self.variables[slot].1)
    }

    /// The value at a position.
    pub fn slot(&mut self, slot: usize) -> &mut Value {
        &mut self.variables[slot].1
    }

    /// The names in sight.
    pub fn names(&self) -> Vec<Name> {
        self.variables[self.base..].iter().map(|(name, _)| name.clone()).collect()
    }
}
