//! The reference digits of `tests/data`, read as the nearest `f64`.
//!
//! The files hold the numbers of an independent multi-precision generator as decimal strings, by case and
//! key.

use serde_json::Value;

const SEEDS: &str = include_str!("../../data/seeds.json");
const PUBLISHED: &str = include_str!("../../data/published.json");
const CLASSICAL: &str = include_str!("../../data/classical.json");

/// The numbers of one case, or a part of them.
pub struct Reference(Value);

/// A case of the seed documents.
pub fn seed(case: &str) -> Reference {
    read(SEEDS).part(case)
}

/// A case of a published benchmark set.
pub fn published(case: &str) -> Reference {
    read(PUBLISHED).part(case)
}

/// A classical problem.
pub fn classical(case: &str) -> Reference {
    read(CLASSICAL).part(case)
}

fn read(text: &str) -> Reference {
    Reference(serde_json::from_str(text).expect("reference: JSON"))
}

impl Reference {
    /// The part under a key.
    pub fn part(&self, key: &str) -> Reference {
        let value = self.0.get(key).unwrap_or_else(|| panic!("reference: no `{key}`"));
        Reference(value.clone())
    }

    /// The elements of a list.
    pub fn elements(&self) -> Vec<Reference> {
        let list = self.0.as_array().expect("reference: a list");
        list.iter().cloned().map(Reference).collect()
    }

    /// A number.
    pub fn number(&self, key: &str) -> f64 {
        number(&self.part(key).0)
    }

    /// A list of numbers.
    pub fn numbers<const N: usize>(&self, key: &str) -> [f64; N] {
        row(&self.part(key).0)
    }

    /// A list of lists of numbers.
    pub fn rows<const N: usize>(&self, key: &str) -> Vec<[f64; N]> {
        let part = self.part(key);
        part.0.as_array().expect("reference: a list of rows").iter().map(row).collect()
    }

    /// The rows under `key` with the times under `t`.
    pub fn timed_rows<const N: usize>(&self, key: &str) -> Vec<(f64, [f64; N])> {
        let rows = self.rows(key);
        let times = self.part("t");
        let times = times.0.as_array().expect("reference: a list of times");
        assert_eq!(times.len(), rows.len(), "reference: a row for every time");
        times.iter().map(number).zip(rows).collect()
    }
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(digits) => {
            digits.parse().unwrap_or_else(|_| panic!("reference: {digits} is no number"))
        }
        other => other.as_f64().unwrap_or_else(|| panic!("reference: {other} is no number")),
    }
}

fn row<const N: usize>(value: &Value) -> [f64; N] {
    let list = value.as_array().expect("reference: a list of numbers");
    assert_eq!(list.len(), N, "reference: {N} numbers");
    std::array::from_fn(|i| number(&list[i]))
}
