//! The combinations of activities of rows.

use super::scene::rounding;
use super::{Regime, Row};
use crate::number::elements::{Each, array};
use crate::number::real::Real;

/// Up to so many combinations are tried one by one at first: those of six contacts that are open or closed.
pub(super) const FEW: usize = 64;

/// The most combinations that are tried: twelve contacts that are open or closed.
pub(super) const COMBINATIONS: usize = 4096;

/// The activity of a row in a regime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// It does nothing.
    Off,
    /// It is a constraint.
    On,
    /// It is a constraint whose reaction is negative.
    Against,
    /// It slips in its positive direction, or in two directions.
    Forward,
    /// It slips in its negative direction.
    Backward,
}

impl Part {
    /// The activity of a row in a regime.
    pub(super) fn of<R: Real, const C: usize, const W: usize>(
        row: usize,
        kind: Row,
        regime: &Regime<R, C, W>,
    ) -> Self {
        let (slip, side) = (regime.slip[row], regime.side[row]);
        match kind {
            Row::Bilateral if (-side).is_positive() => Self::Against,
            Row::Bilateral | Row::Load => Self::On,
            _ if regime.active[row] => Self::On,
            _ if slip.is_positive() => Self::Forward,
            _ if (-slip).is_positive() => Self::Backward,
            _ => Self::Off,
        }
    }

    /// Those of all rows in a regime.
    pub(super) fn all<R: Real, const C: usize, const W: usize>(
        rows: &[Row; C],
        regime: &Regime<R, C, W>,
    ) -> [Self; C] {
        array(|row| Self::of(row, rows[row], regime))
    }
}

/// The possible activities of a row, the one to be tried first at the beginning.
#[derive(Clone, Copy, Debug)]
pub(super) struct Options {
    parts: [Part; 3],
    count: usize,
}

impl Options {
    /// These, of which there are at most three.
    pub(super) fn new(parts: &[Part]) -> Self {
        let mut options = Self { parts: [Part::Off; 3], count: 0 };
        for (to, &part) in options.parts.iter_mut().zip(parts) {
            *to = part;
            options.count += 1;
        }
        options
    }

    /// All but one, if another is left.
    pub(super) fn without(mut self, part: Part) -> Self {
        if self.count > 1 && self.has(part) {
            self = self.with(part, false);
            self.count -= 1;
        }
        self
    }

    /// The one to be tried first.
    pub(super) fn first(&self) -> Part {
        self.parts[0]
    }

    /// Whether this is one of them.
    pub(super) fn has(&self, part: Part) -> bool {
        self.parts.iter().take(self.count).any(|&own| own == part)
    }

    /// The same, this one first or last.
    pub(super) fn with(mut self, part: Part, first: bool) -> Self {
        let own = self.parts.split_at_mut(self.count.min(3)).0;
        if let Some(at) = own.iter().position(|&own| own == part) {
            if first {
                own.split_at_mut(at + 1).0.rotate_right(1);
            } else {
                own.split_at_mut(at).1.rotate_left(1);
            }
        }
        self
    }
}

/// The parts of sizes below which numbers count as zero. Larger ones decide ties only where smaller ones have
/// left no combination.
pub(super) fn thresholds<R: Real>() -> [R; 3] {
    let fine: R = rounding();
    [fine, fine * fine.sqrt().sqrt().recip(), fine.sqrt() * R::from_f64(0.1)]
}

/// The number of combinations, or that of those that are tried if it is less.
pub(super) fn combinations<const C: usize>(options: &[Options; C]) -> usize {
    let count = |options: &Options| options.count.max(1);
    options.iter().map(count).fold(1, |total: usize, count| total.saturating_mul(count).min(COMBINATIONS))
}

/// How many changes a change of each row counts as: a contact that opens or closes takes its frictions along.
pub(super) fn changes<const C: usize>(rows: &[Row; C]) -> [usize; C] {
    array(|row| {
        // A friction in two directions is one, which its first row stands for.
        let is_along = |(own, kind): &(usize, &Row)| {
            matches!(kind, Row::Friction { normal: Some(normal), pair }
                if *normal == row && pair.is_none_or(|other| *own < other))
        };
        let is_contact = rows.get(row) == Some(&Row::Unilateral);
        1 + if is_contact { rows.iter().enumerate().filter(is_along).count() } else { 0 }
    })
}

/// All combinations, those with the fewest changes first, until `visit` returns true. Of more than
/// [`COMBINATIONS`] so many are visited: in these the last rows keep their first activity.
pub(super) fn combine<const C: usize>(
    options: &[Options; C],
    weights: &[usize; C],
    mut visit: impl FnMut(&[Part; C]) -> bool,
) {
    let total = combinations(options);
    let mut visited = 0;
    let most = weights.iter().sum();
    let first: [Part; C] = options.each_ref().each(Options::first);
    for changes in 0..=most {
        // The places of the options in the present combination, which counts up from the first row on.
        let (mut digits, mut parts, mut changed) = ([0; C], first, 0);
        for _ in 0..total {
            if changed == changes {
                visited += 1;
                if visit(&parts) {
                    return;
                }
            }
            let rows = digits.iter_mut().zip(&mut parts).zip(options.iter().zip(weights));
            for ((digit, part), (options, weight)) in rows {
                changed -= if *digit > 0 { *weight } else { 0 };
                let carries = *digit + 1 >= options.count;
                *digit = if carries { 0 } else { *digit + 1 };
                *part = options.parts.get(*digit).copied().unwrap_or(Part::Off);
                if !carries {
                    changed += *weight;
                    break;
                }
            }
        }
        if visited == total {
            return;
        }
    }
}

/// The regime of a combination. `None` where it differs from another one only in a friction whose contact is
/// open and not `driven` by an impulse that is known beforehand.
pub(super) fn regime<R: Real, const C: usize, const W: usize>(
    rows: &[Row; C],
    parts: &[Part; C],
    options: &[Options; C],
    driven: &[bool; C],
    kinks: [R; W],
) -> Option<Regime<R, C, W>> {
    let mut regime = Regime { kinks, ..Regime::open(rows) };
    for (row, &kind) in rows.iter().enumerate() {
        match (kind, parts[row]) {
            (Row::Bilateral, Part::Against) => regime.side[row] = -R::one(),
            (Row::Unilateral, part) => regime.active[row] = part == Part::On,
            (Row::Friction { normal, pair }, part) => {
                if pair.is_some_and(|other| other < row) {
                    continue;
                }
                if normal.is_some_and(|normal| parts[normal] == Part::Off && !driven[normal]) {
                    if options[row].first() != part {
                        return None;
                    }
                    continue;
                }
                match part {
                    Part::On | Part::Against => {
                        regime.active[row] = true;
                        if let Some(active) = pair.and_then(|other| regime.active.get_mut(other)) {
                            *active = true;
                        }
                    }
                    Part::Forward => regime.slip[row] = R::one(),
                    Part::Backward => regime.slip[row] = -R::one(),
                    Part::Off => {}
                }
            }
            (Row::Bilateral | Row::Load, _) => {}
        }
    }
    Some(regime)
}

/// The first contact or constraint that reacts otherwise in one regime than in another.
pub(super) fn parts_at<R: Real, const C: usize, const W: usize>(
    rows: &[Row; C],
    a: &Regime<R, C, W>,
    b: &Regime<R, C, W>,
) -> Option<usize> {
    let reacts = |regime: &Regime<R, C, W>, row: usize| (regime.active[row], regime.side[row]);
    rows.iter()
        .enumerate()
        .position(|(row, kind)| !matches!(kind, Row::Friction { .. }) && reacts(a, row) != reacts(b, row))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_come_by_the_number_of_changes_and_each_once() {
        let options = [
            Options::new(&[Part::On, Part::Off]),
            Options::new(&[Part::On, Part::Forward, Part::Backward]).with(Part::On, false),
        ];
        let mut seen = [[Part::Against; 2]; 6];
        let mut count = 0;
        combine(&options, &[1; 2], |parts| {
            seen[count] = *parts;
            count += 1;
            false
        });
        assert_eq!(count, 6);
        assert_eq!(seen[0], [Part::On, Part::Forward]);
        assert_eq!(seen[1], [Part::Off, Part::Forward]);
        assert_eq!(seen[5], [Part::Off, Part::On]);
    }
}
