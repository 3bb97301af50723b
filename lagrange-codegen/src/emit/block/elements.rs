//! Lists of values. Values that stand in an array one after the other are copied by loops.

use std::ops::{Deref, Range};

use crate::emit::names::{Names, without_number};
use crate::emit::scalar;
use crate::model::Model;
use crate::schedule::Slot;
use crate::syntax::Scalar;

/// The arrays that bodies have references to.
const BORROWED: [&str; 5] = ["q", "v", "u", "accelerations", "constants"];

/// An element of an array.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::emit) struct Element {
    /// The array.
    pub array: String,
    /// Its length.
    pub length: usize,
    /// The index.
    pub index: i64,
}

/// A slot whose value is computed elsewhere.
#[derive(Clone, Debug)]
pub(in crate::emit) struct Known {
    /// The slot.
    pub slot: Slot,
    /// Its expression.
    pub text: String,
    /// The element that it is, if it stands in an array, and its kind there.
    pub place: Option<(Element, u32)>,
}

impl Known {
    /// A value with a name of its own.
    pub fn named(slot: Slot, text: String) -> Known {
        Known { slot, text, place: None }
    }

    /// A value that is an element of an array.
    pub fn element(slot: Slot, element: Element, kind: u32) -> Known {
        Known { slot, text: format!("{}[{}]", element.array, element.index), place: Some((element, kind)) }
    }
}

/// Values: their expressions and places.
#[derive(Clone, Debug)]
pub(in crate::emit) struct Values {
    /// The expressions.
    pub texts: Vec<String>,
    /// The element that each value is, if it stands in an array.
    pub elements: Vec<Option<Element>>,
    layout: Layout,
}

/// The settings for arrays.
#[derive(Clone, Debug)]
struct Layout {
    scalar: String,
    zero: String,
    /// The fewest alike values that a loop copies.
    least: usize,
}

impl Deref for Values {
    type Target = [String];

    fn deref(&self) -> &[String] {
        &self.texts
    }
}

/// Values that stand in an array at equal distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stretch {
    from: usize,
    count: usize,
    stride: i64,
}

impl Values {
    /// No values.
    pub fn none(model: &Model, scalar: &Scalar) -> Values {
        let (zero, least) = (scalar::zero(scalar), model.locals.least);
        let layout = Layout { scalar: scalar.to_string(), zero, least };
        Values { texts: Vec::new(), elements: Vec::new(), layout }
    }

    /// The elements of an array that a statement binds, after the pattern of that statement: a name for each
    /// of few elements, one name for the array of many.
    pub fn bound(mut self, names: &mut Names, wishes: Vec<Option<String>>) -> (String, Values) {
        let values = &mut self;
        let length = wishes.len();
        if length < values.layout.least {
            values.texts = wishes.into_iter().map(|wish| names.claim(wish)).collect();
            values.elements = vec![None; length];
            return (format!("[{}]", values.texts.join(", ")), self);
        }
        let array =
            names.claim(wishes.into_iter().nth(length / 2).flatten().map(|wish| without_number(&wish)));
        values.texts = (0..length).map(|i| format!("{array}[{i}]")).collect();
        let element = |index| Some(Element { array: array.clone(), length, index });
        values.elements = (0..length as i64).map(element).collect();
        (array, self)
    }

    /// The values of a range.
    pub fn part(&self, range: Range<usize>) -> Values {
        let (texts, elements) = (self.texts[range.clone()].to_vec(), self.elements[range].to_vec());
        Values { texts, elements, layout: self.layout.clone() }
    }

    /// Takes out the first `count` values.
    pub fn take(&mut self, count: usize) -> Values {
        let (texts, elements) = (self.texts.drain(..count).collect(), self.elements.drain(..count).collect());
        Values { texts, elements, layout: self.layout.clone() }
    }

    /// Adds others at the end.
    pub fn append(&mut self, others: Values) {
        self.texts.extend(others.texts);
        self.elements.extend(others.elements);
    }

    /// The values in another order: `places` has the new index of each.
    pub fn placed(&self, places: &[usize]) -> Values {
        let mut sorted: Vec<usize> = (0..places.len()).collect();
        sorted.sort_unstable_by_key(|&i| places[i]);
        Values {
            texts: sorted.iter().map(|&i| self.texts[i].clone()).collect(),
            elements: sorted.iter().map(|&i| self.elements[i].clone()).collect(),
            layout: self.layout.clone(),
        }
    }

    /// An array of all values.
    pub fn list(&self) -> String {
        let (count, Layout { scalar, zero, least }) = (self.texts.len(), &self.layout);
        let stretches = self.stretches(|_| true);
        if let [Stretch { count: all, stride: 1, .. }] = stretches[..]
            && all == count
            && let Some(Element { array, length, index: 0 }) = &self.elements[0]
            && *length == count
        {
            return if BORROWED.contains(&array.as_str()) { format!("*{array}") } else { array.clone() };
        }
        if stretches.iter().all(|stretch| stretch.count < *least) {
            return format!("[{}]", self.texts.join(", "));
        }
        let targets: Vec<usize> = (0..count).collect();
        format!(
            "{{\nlet mut list: [{scalar}; {count}] = [{zero}; {count}];\n{}list\n}}",
            self.fill("list", &targets)
        )
    }

    /// Statements that assign the values to the elements `places` of `target`.
    pub fn fill(&self, target: &str, places: &[usize]) -> String {
        let mut text = String::new();
        for Stretch { from, count, stride } in self.stretches(|i| places[i] + 1 == places[i + 1]) {
            let first = places[from];
            match &self.elements[from] {
                Some(Element { array, index, .. }) if count >= self.layout.least => text.push_str(&if stride
                    == 1
                {
                    format!(
                        "{target}[{first}..{}].copy_from_slice(&{array}[{index}..{}]);\n",
                        first + count,
                        index + count as i64
                    )
                } else {
                    let element = super::rolled::place(*index, stride, first as i64);
                    format!("for i in {first}..{} {{ {target}[i] = {array}[{element}]; }}\n", first + count)
                }),
                _ => {
                    for (place, value) in places[from..from + count].iter().zip(&self.texts[from..]) {
                        text.push_str(&format!("{target}[{place}] = {value};\n"));
                    }
                }
            }
        }
        text
    }

    /// The stretches of the values. `goes_on` tells whether a value and the next one may be in one stretch.
    fn stretches(&self, goes_on: impl Fn(usize) -> bool) -> Vec<Stretch> {
        let mut stretches: Vec<Stretch> = Vec::new();
        for (i, element) in self.elements.iter().enumerate() {
            if let Some(Stretch { from, count, stride }) = stretches.last_mut()
                && let (Some(first), Some(element)) = (&self.elements[*from], element)
                && first.array == element.array
                && goes_on(i - 1)
            {
                if *count == 1 && element.index != first.index {
                    (*count, *stride) = (2, element.index - first.index);
                    continue;
                }
                if *count > 1 && element.index == first.index + *count as i64 * *stride {
                    *count += 1;
                    continue;
                }
            }
            stretches.push(Stretch { from: i, count: 1, stride: 0 });
        }
        stretches
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(elements: &[(&str, i64)]) -> Values {
        let element = |&(array, index): &(&str, i64)| {
            (array != "-").then(|| Element { array: array.to_owned(), length: 40, index })
        };
        let text = |&(array, index): &(&str, i64)| match array {
            "-" => format!("x{index}"),
            _ => format!("{array}[{index}]"),
        };
        Values {
            texts: elements.iter().map(text).collect(),
            elements: elements.iter().map(element).collect(),
            layout: Layout { scalar: "f64".to_owned(), zero: "0.0".to_owned(), least: 24 },
        }
    }

    #[test]
    fn a_whole_array_is_its_own_list() {
        let all: Vec<(&str, i64)> = (0..40).map(|i| ("a", i)).collect();
        assert_eq!(values(&all).list(), "a");
        assert_eq!(values(&all).part(0..3).list(), "[a[0], a[1], a[2]]");
    }

    #[test]
    fn stretches_are_copied_and_the_rest_is_written_out() {
        let mut all = vec![("-", 7)];
        all.extend((3..33).map(|i| ("a", i)));
        all.extend((0..30).map(|i| ("b", 39 - i)));
        let list = values(&all).list();
        assert!(list.contains("list[0] = x7;\nlist[1..31].copy_from_slice(&a[3..33]);\n"), "{list}");
        assert!(list.contains("for i in 31..61 { list[i] = b[70 - i]; }\n"), "{list}");
    }

    #[test]
    fn targets_need_not_be_neighbours() {
        let all: Vec<(&str, i64)> = (0..30).map(|i| ("a", i)).collect();
        let places: Vec<usize> = (0..30).map(|i| if i < 25 { i + 8 } else { i + 10 }).collect();
        let text = values(&all).fill("row", &places);
        assert!(text.starts_with("row[8..33].copy_from_slice(&a[0..25]);\nrow[35] = a[25];\n"), "{text}");
    }
}
