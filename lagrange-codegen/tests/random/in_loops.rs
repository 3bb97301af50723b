//! Random systems with loops for two and more alike parts.

use proptest::strategy::{BoxedStrategy, Strategy};
use quote::ToTokens;
use std::sync::Mutex;

use crate::check::Sample;
use crate::expansion::Expansion;
use crate::report::Report;
use crate::source::Source;
use crate::system::System;
use crate::{QUICK, agrees_as, cases, compare_series, runner, strategy};

fn chained() -> BoxedStrategy<(System, [Sample; 2])> {
    (strategy::chained(), [strategy::sample(), strategy::sample()]).boxed()
}

fn linked() -> BoxedStrategy<(System, [Sample; 2])> {
    (strategy::linked(), [strategy::sample(), strategy::sample()]).boxed()
}

/// Whether the accelerations of an expansion, or the equations that determine them, have a loop.
fn loops(expansion: &Expansion) -> bool {
    let functions = [expansion.system.get("accelerations_at"), expansion.surface.get("equations_at")];
    functions.into_iter().flatten().any(|of| of.to_token_stream().to_string().contains("for i in"))
}

/// Checks all quantities of some systems. Returns the number of those that have loops.
fn check(strategy: impl Fn() -> BoxedStrategy<(System, [Sample; 2])> + Sync, cases: usize) -> usize {
    let report = Mutex::new((Report::default(), 0));
    runner::run(cases, strategy, |(system, samples)| {
        let outcomes = agrees_as(system, samples, Expansion::in_loops)?;
        let has_loops = loops(&Expansion::in_loops(&Source::of(system))?);
        let mut report = report.lock().map_err(|error| error.to_string())?;
        report.0.add(outcomes);
        report.1 += usize::from(has_loops);
        Ok(())
    });
    let (report, looping) = report.into_inner().expect("a worker has failed");
    println!("{looping} of {cases} have loops\n{report}");
    looping
}

#[test]
fn loops_agree_with_dual_numbers() {
    let part = |share: usize| runner::cases(QUICK) / share;
    assert!(8 * check(cases, part(8)) > part(8));
    assert_eq!(check(chained, part(32)), part(32));
    assert!(check(linked, part(64)) > 0);
}

#[test]
fn series_in_loops_agree_with_truncated_series() {
    for (strategy, part) in [(cases as fn() -> _, 16), (chained, 64), (linked, 128)] {
        let [compared, kinked, left_out] =
            compare_series(strategy, runner::cases(QUICK) / part, Expansion::in_loops);
        assert!(2 * compared > kinked + left_out);
    }
}
