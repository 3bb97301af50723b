//! Which divisors become reciprocals: those with several divisions.

use crate::collections::Lookup;
use crate::expr::{Exponent, NodeId};

/// A divisor: factors with their negative exponents, ascending.
pub(super) type Divisor = Vec<(NodeId, Exponent)>;

/// The numbers of uses of divisors and of the bases in them.
#[derive(Default)]
pub(super) struct Divisors {
    whole: Lookup<Divisor, u32>,
    bases: Lookup<NodeId, Base>,
}

#[derive(Clone, Copy)]
struct Base {
    uses: u32,
    /// The greatest common divisor of the exponents, in halves.
    unit: u32,
}

/// How to divide by a divisor.
pub(super) enum Division {
    /// Multiply by the shared reciprocal of the whole.
    Reciprocal,
    /// Multiply by powers of reciprocals of bases (the unit power with its count), divide by
    /// the rest.
    Split {
        /// Base, power of the base whose reciprocal is shared (in halves), and the power of that reciprocal.
        reciprocals: Vec<(NodeId, u32, u32)>,
        /// The rest of the divisor.
        rest: Divisor,
    },
}

impl Divisors {
    /// Counts one product's divisor.
    pub fn count(&mut self, divisor: &Divisor) {
        if divisor.is_empty() {
            return;
        }
        match self.whole.get_mut(divisor) {
            Some(uses) => *uses += 1,
            None => {
                self.whole.insert(divisor.clone(), 1);
            }
        }
        for &(base, exponent) in divisor {
            let halves = exponent.0.unsigned_abs();
            match self.bases.get_mut(&base) {
                Some(known) => {
                    known.uses += 1;
                    known.unit = gcd(known.unit, halves);
                }
                None => {
                    self.bases.insert(base, Base { uses: 1, unit: halves });
                }
            }
        }
    }

    /// The division that shares most.
    pub fn division(&self, divisor: &Divisor) -> Division {
        if self.whole.get(divisor).is_some_and(|&uses| uses >= 2) {
            return Division::Reciprocal;
        }
        let (mut reciprocals, mut rest) = (Vec::new(), Vec::new());
        for &(base, exponent) in divisor {
            match self.bases.get(&base) {
                Some(known) if known.uses >= 2 => {
                    reciprocals.push((base, known.unit, exponent.0.unsigned_abs() / known.unit));
                }
                _ => rest.push((base, exponent)),
            }
        }
        Division::Split { reciprocals, rest }
    }
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
