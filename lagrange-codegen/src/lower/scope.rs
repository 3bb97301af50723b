//! Local variables: a stack of names, of which the current function sees its own part.

use super::value::Value;
use crate::syntax::body::Name;
use crate::syntax::hygiene::written;

/// The variables in sight.
#[derive(Debug, Default)]
pub struct Scope {
    variables: Vec<Entry>,
    base: usize,
}

#[derive(Debug)]
struct Entry {
    name: Name,
    value: Value,
    kind: Kind,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A variable.
    Variable,
    /// A constant declared in a function body: the same name in any syntax context.
    Item,
    /// `use a::*;`: from here inwards constants may have other meanings.
    Glob,
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

    /// How many variables there are.
    pub fn length(&self) -> usize {
        self.variables.len()
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
        self.variables.push(Entry { name, value, kind: Kind::Variable });
    }

    /// Makes a constant of a function body.
    pub fn bind_item(&mut self, name: Name, value: Value) {
        self.variables.push(Entry { name, value, kind: Kind::Item });
    }

    /// Notes an import of everything.
    pub fn bind_glob(&mut self) {
        self.variables.push(Entry { name: "".into(), value: Value::Unknown, kind: Kind::Glob });
    }

    /// Whether an import of everything may hide what is declared further out than a position.
    pub fn is_globbed(&self, slot: usize) -> bool {
        self.variables[slot.max(self.base)..].iter().any(|entry| entry.kind == Kind::Glob)
    }

    /// Whether the innermost variable of a name comes from another syntax context.
    pub fn other_context(&self, name: &str) -> bool {
        let own = &self.variables[self.base..];
        own.iter().any(|entry| {
            entry.kind == Kind::Variable && *entry.name != *name && written(&entry.name) == written(name)
        })
    }

    /// The constant of a function body that a name in a pattern refers to.
    pub fn item(&self, name: &str) -> Option<Value> {
        let slot = self.find(name)?;
        let entry = &self.variables[slot];
        (entry.kind == Kind::Item).then(|| entry.value.clone())
    }

    /// The position of a variable, the innermost of its name.
    pub fn find(&self, name: &str) -> Option<usize> {
        let own = &self.variables[self.base..];
        let fits = |entry: &Entry| match entry.kind {
            Kind::Variable => *entry.name == *name,
            Kind::Item => *entry.name == *written(name),
            Kind::Glob => false,
        };
        own.iter().rposition(fits).map(|position| self.base + position)
    }

    /// The value of a variable.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.find(name).map(|slot| &self.variables[slot].value)
    }

    /// The value at a position.
    pub fn slot(&mut self, slot: usize) -> &mut Value {
        &mut self.variables[slot].value
    }

    /// The values of all variables.
    pub fn values(&self) -> Vec<Value> {
        self.variables.iter().map(|entry| entry.value.clone()).collect()
    }

    /// Gives all variables other values.
    pub fn restore(&mut self, values: Vec<Value>) {
        for (entry, value) in self.variables.iter_mut().zip(values) {
            entry.value = value;
        }
    }

    /// The names in sight.
    pub fn names(&self) -> Vec<Name> {
        self.variables[self.base..].iter().map(|entry| entry.name.clone()).collect()
    }
}
