//! The cases: linkages, their starts, and their true motions.

mod chain;
mod cranks;
mod four_bar;
mod peaucellier;
mod points;
mod points3;
mod ring;
mod slider;

use lagrangian::Smooth;
use lagrangian::prelude::*;

use super::runs::{Method, Run};
use super::table::Row;

/// Starts of one kind of linkage, whatever its type.
pub trait Case {
    /// All runs by a method.
    fn measure(&self, method: Method) -> Row;
}

/// Starts of one type of linkage.
pub struct Starts<S, const N: usize> {
    name: &'static str,
    runs: Vec<Run<S, N>>,
}

impl<S, const N: usize> Case for Starts<S, N>
where
    S: System<N, 0, Scalar = f64> + Smooth<N, 0>,
{
    fn measure(&self, method: Method) -> Row {
        Row { case: self.name, method, outcomes: self.runs.iter().map(|run| run.measure(method)).collect() }
    }
}

/// Makes a case with a number of starts.
type Maker = fn(usize) -> Box<dyn Case>;

/// All cases by their names.
pub const CASES: [(&str, Maker); 14] = [
    ("angles", |n| Box::new(four_bar::equal(n))),
    ("angles-unequal", |n| Box::new(four_bar::unequal(n))),
    ("points", |n| Box::new(points::plain(n))),
    ("points3", |n| Box::new(points3::starts(n))),
    ("points-unequal", |n| Box::new(points::unequal(n))),
    ("slider", |n| Box::new(slider::starts(n))),
    ("cranks2", |n| Box::new(cranks::two(n))),
    ("cranks3", |n| Box::new(cranks::three(n))),
    ("cranks8", |n| Box::new(cranks::eight(n))),
    ("row4", |n| Box::new(cranks::row(n))),
    ("chain4", |n| Box::new(chain::starts(n))),
    ("peaucellier", |n| Box::new(peaucellier::starts(n))),
    ("ring", |n| Box::new(ring::starts(n))),
    ("random", |n| Box::new(four_bar::random(n))),
];
