//! Patterns: binding names, and choosing the arm of a `match`.

use super::advice::counted;
use super::interpreter::Interpreter;
use super::path::is_constant_name;
use super::value::Value;
use crate::diagnostics::{Origin, catalogue};
use crate::syntax::body::{Expr, Name, Pattern, PatternKind};
use crate::syntax::hygiene::written;
use crate::syntax::suggest::nearest;

impl<'a> Interpreter<'a> {
    /// Binds the names of a pattern that always matches.
    pub fn bind(&mut self, pattern: &'a Pattern, value: Value) {
        match &pattern.kind {
            PatternKind::Wild | PatternKind::Rest => {}
            PatternKind::Name(name) => self.scope.bind(name.clone(), value),
            PatternKind::Typed(inner, ty) => {
                let shape = self.shape(ty);
                let value = self.coerce(value, &shape, pattern.origin);
                if let PatternKind::Name(name) = &inner.kind {
                    self.hint(&value, name);
                }
                self.bind(inner, value);
            }
            PatternKind::Tuple(patterns) => {
                let elements = match value {
                    Value::Tuple(elements) => Some(elements.to_vec()),
                    Value::Parameter(id) => Some(
                        (0..patterns.len())
                            .map(|index| {
                                Value::Parameter(self.parameter_field(id, &index.to_string(), pattern.origin))
                            })
                            .collect(),
                    ),
                    other => self.not_destructible(other, pattern),
                };
                self.bind_list(patterns, elements, pattern);
            }
            PatternKind::Slice(patterns) => {
                let rest = patterns.iter().any(|pattern| matches!(pattern.kind, PatternKind::Rest));
                let elements = match value {
                    Value::Array(elements) => Some(elements.to_vec()),
                    Value::Parameter(id) if !rest => Some(
                        (0..patterns.len())
                            .map(|index| Value::Parameter(self.parameter_index(id, index, pattern.origin)))
                            .collect(),
                    ),
                    other => self.not_destructible(other, pattern),
                };
                self.bind_list(patterns, elements, pattern);
            }
            PatternKind::Record(fields) => {
                for (word, inner) in fields {
                    let field = self.field(value.clone(), word, word.origin);
                    self.bind(inner, field);
                }
            }
            PatternKind::Constant(_) | PatternKind::Range(_) | PatternKind::Or(_) => {
                self.report(pattern.origin, catalogue::refutable_pattern());
            }
            PatternKind::Unsupported(message, names) => {
                self.report(pattern.origin, message.clone());
                names.iter().for_each(|name| self.scope.bind(name.clone(), Value::Unknown));
            }
        }
    }

    fn not_destructible(&mut self, value: Value, pattern: &'a Pattern) -> Option<Vec<Value>> {
        if !value.is_unknown() {
            self.report(pattern.origin, catalogue::pattern_mismatch(value.describe()));
        }
        None
    }

    /// Assigns the elements of a value to as many places, from left to right.
    pub fn assign_parts(&mut self, places: &'a [Expr], value: Value, origin: Origin) {
        let parts = match value {
            Value::Tuple(parts) | Value::Array(parts) if parts.len() == places.len() => parts,
            Value::Tuple(parts) | Value::Array(parts) => {
                let (given, taken) = (counted(places.len(), "name"), counted(parts.len(), "element"));
                return self.report(origin, catalogue::pattern_length(given, taken));
            }
            Value::Unknown => return,
            other => return self.report(origin, catalogue::pattern_mismatch(other.describe())),
        };
        for (place, part) in places.iter().zip(parts.iter()) {
            self.assign_value(place, part.clone(), origin);
        }
    }

    fn bind_list(&mut self, patterns: &'a [Pattern], elements: Option<Vec<Value>>, whole: &'a Pattern) {
        let rest = patterns.iter().position(|pattern| matches!(pattern.kind, PatternKind::Rest));
        let named = patterns.len() - usize::from(rest.is_some());
        let elements = match elements {
            Some(elements) if elements.len() == named || (rest.is_some() && elements.len() > named) => {
                elements
            }
            Some(elements) => {
                self.report(
                    whole.origin,
                    catalogue::pattern_length(counted(named, "name"), counted(elements.len(), "element")),
                );
                vec![Value::Unknown; named]
            }
            None => vec![Value::Unknown; named],
        };
        let skipped = elements.len() - named;
        for (position, pattern) in patterns.iter().enumerate() {
            let index = match rest {
                Some(rest) if position == rest => continue,
                Some(rest) if position > rest => position - 1 + skipped,
                _ => position,
            };
            if let (PatternKind::Name(name), value) = (&pattern.kind, &elements[index]) {
                self.hint(value, name);
            }
            self.bind(pattern, elements[index].clone());
        }
    }

    /// Whether a constant matches a pattern; binds its names if so. `None` where that is not known, which is
    /// reported.
    pub fn matches(&mut self, pattern: &'a Pattern, value: &Value) -> Option<bool> {
        match &pattern.kind {
            PatternKind::Wild | PatternKind::Rest => Some(true),
            PatternKind::Name(name) => match self.scope.item(name) {
                Some(constant) => self.equal(&constant, value, pattern),
                None if is_constant_name(name) => {
                    self.report(pattern.origin, catalogue::constant_in_pattern(written(name)));
                    None
                }
                None => {
                    // A constant outside the macro's sight may have small letters too.
                    self.meaning(format!("let {} @ _ = ();", written(name)), pattern.origin);
                    self.scope.bind(name.clone(), value.clone());
                    Some(true)
                }
            },
            PatternKind::Constant(expr) => {
                let constant = self.expression(expr);
                self.equal(&constant, value, pattern)
            }
            PatternKind::Range(range) => match (self.range(range), value) {
                (Value::Range(start, end, _), Value::Integer(value, ..)) => {
                    Some(start.is_none_or(|start| start <= *value) && end.is_none_or(|end| *value < end))
                }
                (Value::Unknown, _) | (_, Value::Unknown) => None,
                (_, other) => {
                    self.report(pattern.origin, catalogue::pattern_mismatch(other.describe()));
                    None
                }
            },
            PatternKind::Or(cases) => {
                for case in cases {
                    match self.matches(case, value) {
                        Some(false) => {}
                        decided => return decided,
                    }
                }
                Some(false)
            }
            PatternKind::Tuple(patterns) => match value {
                Value::Tuple(elements) if elements.len() == patterns.len() => {
                    for (pattern, element) in patterns.iter().zip(elements.iter()) {
                        match self.matches(pattern, element) {
                            Some(true) => {}
                            decided => return decided,
                        }
                    }
                    Some(true)
                }
                other => {
                    self.report(pattern.origin, catalogue::pattern_mismatch(other.describe()));
                    None
                }
            },
            PatternKind::Slice(_) | PatternKind::Record(_) | PatternKind::Typed(..) => {
                self.bind(pattern, value.clone());
                Some(true)
            }
            PatternKind::Unsupported(message, _) => {
                self.report(pattern.origin, message.clone());
                None
            }
        }
    }

    fn equal(&mut self, constant: &Value, value: &Value, pattern: &'a Pattern) -> Option<bool> {
        match (constant, value) {
            (Value::Integer(a, ..), Value::Integer(b, ..)) => Some(a == b),
            (Value::Boolean(a), Value::Boolean(b)) => Some(a == b),
            (Value::Unknown, _) | (_, Value::Unknown) => None,
            (_, other) => {
                self.report(pattern.origin, catalogue::pattern_mismatch(other.describe()));
                None
            }
        }
    }

    /// The closest of some names, for a message.
    pub fn near(&self, word: &str, names: &[Name]) -> Option<String> {
        nearest(word, names.iter().map(|name| &**name)).map(String::from)
    }
}
