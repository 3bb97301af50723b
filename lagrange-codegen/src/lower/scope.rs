//! Local variables: a stack of names, of which the current function sees its own part.

use super::value::Value;
use crate::syntax::body::Name;
use crate::syntax::hygiene::written;

/// The variables in sight.
#[derive(Debug, Default)]
pub struct Scope {
    variables: Vec<Entry>,
    base: usize,
    /// Ranges of the stack that are out of sight while a closure from further out runs.
    hidden: Vec<(usize, usize)>,
    /// The number of variables made so far.
    made: u64,
}

/// The variables that a closure sees.
#[derive(Clone, Debug)]
pub struct View {
    length: usize,
    base: usize,
    hidden: Vec<(usize, usize)>,
    /// The number of the innermost variable.
    innermost: Option<u64>,
}

#[derive(Debug)]
struct Entry {
    name: Name,
    value: Value,
    kind: Kind,
    /// The number of the variable, in the order of making.
    number: u64,
}

/// The meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A variable.
    Variable,
    /// A constant declared in a function body: the same name in any syntax context.
    Item,
    /// `use a::*;`: inside its block, constants may have other meanings.
    Glob,
}

/// A position on the stack to return to.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    length: usize,
    base: usize,
}

impl Scope {
    /// The present height of the stack.
    pub fn mark(&self) -> Mark {
        Mark { length: self.variables.len(), base: self.base }
    }

    /// The number of variables on the stack.
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

    /// The present view.
    pub fn view(&self) -> View {
        let (length, base, hidden) = (self.variables.len(), self.base, self.hidden.clone());
        View { length, base, hidden, innermost: self.variables.last().map(|entry| entry.number) }
    }

    /// Goes to another view and returns the present one; `None` if variables of the other view are gone.
    pub fn look(&mut self, view: &View) -> Option<View> {
        let last = view.length.checked_sub(1).and_then(|last| self.variables.get(last));
        if view.innermost.is_some() && last.map(|entry| entry.number) != view.innermost {
            return None;
        }
        let here = self.view();
        self.base = view.base;
        self.hidden.clone_from(&view.hidden);
        self.hidden.push((view.length, self.variables.len()));
        Some(here)
    }

    /// Goes back to the view that [`Scope::look`] gave.
    pub fn look_back(&mut self, view: View) {
        self.base = view.base;
        self.hidden = view.hidden;
    }

    /// The variables in sight with their positions, the innermost last.
    fn own(&self) -> impl DoubleEndedIterator<Item = (usize, &Entry)> {
        let in_sight =
            |&(slot, _): &(usize, &Entry)| self.hidden.iter().all(|&(from, to)| slot < from || slot >= to);
        self.variables.iter().enumerate().skip(self.base).filter(in_sight)
    }

    fn push(&mut self, name: Name, value: Value, kind: Kind) {
        self.made += 1;
        self.variables.push(Entry { name, value, kind, number: self.made });
    }

    /// Makes a variable.
    pub fn bind(&mut self, name: Name, value: Value) {
        self.push(name, value, Kind::Variable);
    }

    /// Makes a constant of a function body.
    pub fn bind_item(&mut self, name: Name, value: Value) {
        self.push(name, value, Kind::Item);
    }

    /// Notes a glob import.
    pub fn bind_glob(&mut self) {
        self.push("".into(), Value::Unknown, Kind::Glob);
    }

    /// Whether a glob import above a position may hide what is declared below it.
    pub fn is_globbed(&self, slot: usize) -> bool {
        self.own().any(|(own, entry)| own >= slot && entry.kind == Kind::Glob)
    }

    /// Whether a variable in sight has this name in another syntax context.
    pub fn other_context(&self, name: &str) -> bool {
        self.own().any(|(_, entry)| {
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
        let fits = |entry: &Entry| match entry.kind {
            Kind::Variable => *entry.name == *name,
            Kind::Item => *entry.name == *written(name),
            Kind::Glob => false,
        };
        self.own().rev().find(|(_, entry)| fits(entry)).map(|(slot, _)| slot)
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
        self.own().map(|(_, entry)| entry.name.clone()).collect()
    }
}
