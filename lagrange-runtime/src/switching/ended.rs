//! Regimes that have ended without any time between.
//!
//! Where a regime begins at its limit, accelerations and reactions tie, and several regimes pass for
//! possible. Higher derivatives tell which of them goes on, and the polynomials of a step know these: a
//! regime that ends where it begins does not. It is chosen again only where no other one is possible.

use super::trials::Part;
use super::{Regime, Row};
use crate::number::real::Real;

/// How many are kept. With more, the oldest is forgotten.
const KEPT: usize = 8;

/// The last regimes that have ended so.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ended<const C: usize> {
    parts: [[Part; C]; KEPT],
    count: usize,
}

impl<const C: usize> Ended<C> {
    /// None.
    pub(super) fn none() -> Self {
        Self { parts: [[Part::Off; C]; KEPT], count: 0 }
    }

    /// Notes one.
    pub(super) fn note<R: Real, const W: usize>(&mut self, rows: &[Row; C], regime: &Regime<R, C, W>) {
        if let Some(parts) = self.parts.get_mut(self.count % KEPT) {
            *parts = Part::all(rows, regime);
            self.count += 1;
        }
    }

    /// Whether there are any.
    pub(super) fn any(&self) -> bool {
        self.count > 0
    }

    /// Whether this is one of them.
    pub(super) fn has<R: Real, const W: usize>(&self, rows: &[Row; C], regime: &Regime<R, C, W>) -> bool {
        self.any() && self.parts.iter().take(self.count).any(|own| *own == Part::all(rows, regime))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_ones_are_kept() {
        let rows = [Row::Friction { normal: None, pair: None }; 2];
        let open = Regime::<f64, 2, 0>::open(&rows);
        let slips = |row: usize, slip: f64| {
            let mut regime = open;
            regime.slip[row] = slip;
            regime
        };
        let mut ended = Ended::none();
        assert!(!ended.any() && !ended.has(&rows, &open));
        ended.note(&rows, &slips(0, 1.0));
        assert!(ended.has(&rows, &slips(0, 1.0)) && !ended.has(&rows, &slips(0, -1.0)));
        for _ in 0..KEPT {
            ended.note(&rows, &slips(1, -1.0));
        }
        assert!(!ended.has(&rows, &slips(0, 1.0)) && ended.has(&rows, &slips(1, -1.0)));
    }
}
