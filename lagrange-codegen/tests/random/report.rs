//! Figures of a run: how many comparisons, how far off, how many left out.

use std::collections::BTreeMap;
use std::fmt;

use crate::check::Outcome;
use crate::close::Agreement;

/// The totals of all comparisons.
#[derive(Clone, Debug, Default)]
pub struct Report {
    systems: usize,
    states: usize,
    ill_conditioned: usize,
    outside: usize,
    quantities: BTreeMap<&'static str, Agreement>,
}

impl Report {
    /// Adds the outcomes at the states of one system.
    pub fn add(&mut self, outcomes: Vec<Outcome>) {
        self.systems += 1;
        for outcome in outcomes {
            self.states += 1;
            let agreements = match outcome {
                Outcome::Compared(agreements) => agreements,
                Outcome::IllConditioned(agreements) => {
                    self.ill_conditioned += 1;
                    agreements
                }
                Outcome::OutsideDomain => {
                    self.outside += 1;
                    continue;
                }
            };
            for (name, agreement) in agreements {
                self.quantities.entry(name).or_default().join(agreement);
            }
        }
    }

    /// Panics if so much was left out that agreement means little.
    pub fn assert_meaningful(&self) {
        self.assert_but_for(8);
    }

    /// The same with another limit, in percent, of solved quantities that may be beyond the oracle's digits:
    /// the oracle bounds the rounding errors of its own elimination, which grow with the system.
    pub fn assert_but_for(&self, solved: usize) {
        // One more is allowed, because in a short run one is much.
        let few = |part: usize, whole: usize, percent: usize| part * 100 <= whole * percent + 100;
        assert!(self.states > 0 && few(self.ill_conditioned, self.states, 5), "ill-conditioned: {self}");
        assert!(few(self.outside, self.states, 5), "outside the domain: {self}");
        for (name, Agreement { components, cancelled, beyond, .. }) in &self.quantities {
            let limit = match *name {
                // Solved quantities are differences of large terms more often, and may be zero.
                "accelerations" | "reactions" | "reaction_forces" => solved,
                // These are zero in many systems, as sums of large terms.
                "reaction_power" | "energy_rate" => 60,
                // Derivatives of solved quantities are zero where constraints leave no freedom, and where a
                // variable has no effect.
                _ if name.contains(" by ") => 25,
                _ => 5,
            };
            assert!(few(*cancelled, *components, limit), "{name} cancelled: {self}");
            assert!(few(100 * beyond, *components, 10), "{name} loses digits: {self}");
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Report { systems, states, ill_conditioned, outside, quantities } = self;
        writeln!(
            f,
            "{systems} systems, {states} states: {ill_conditioned} ill-conditioned, {outside} outside"
        )?;
        for (name, Agreement { error, components, cancelled, beyond }) in quantities {
            writeln!(
                f,
                "{name:24}{error:8.1e}  {components} components, {cancelled} cancelled, {beyond} beyond"
            )?;
        }
        Ok(())
    }
}
