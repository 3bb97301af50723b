//! Random mechanical systems through the whole engine, from source text to emitted tokens.
//!
//! A system is generated as a tree ([`system`], [`expression`]) that can print itself as a user's
//! description ([`source`]) and evaluate itself in any number ([`motion`]). The engine expands the
//! description, [`interpreter`] runs the emitted code, and [`check`] compares every quantity with
//! [`oracle`], which knows definitions and dual numbers only. [`derivatives`] does so with the derivatives of
//! the equations of motion and [`variation`].
//!
//! `PROPTEST_CASES=10000 cargo test --release -p lagrange-codegen --test random` runs that many
//! systems; without, it is a quick look. The cases are the same ones each time.

mod analysis;
mod check;
mod claims;
mod close;
mod constrained;
mod constraint;
mod derivatives;
mod expansion;
mod expression;
mod faults;
mod function;
mod in_loops;
mod interpreter;
mod motion;
mod number;
mod oracle;
mod report;
mod runner;
mod series;
mod source;
mod strategy;
mod surface;
mod system;
mod taylor;
mod variation;
mod writer;

use std::collections::BTreeMap;
use std::sync::Mutex;

use proptest::strategy::{BoxedStrategy, Strategy};

use check::{Outcome, Sample, check, expected};
use derivatives::{Asked, Expected};
use expansion::{Expansion, tokens};
use faults::{Fault, Part, planted, sites};
use report::Report;
use source::Source;
use system::System;

/// Systems in a run without `PROPTEST_CASES`.
const QUICK: usize = 256;

/// Systems whose derivatives are compared in such a run. They take several times as long to expand.
const DERIVED: usize = 12;

/// How a description is expanded.
type Expand = fn(&Source) -> Result<Expansion, String>;

fn cases() -> BoxedStrategy<(System, [Sample; 2])> {
    (strategy::system(), [strategy::sample(), strategy::sample()]).boxed()
}

/// The outcomes at all samples, or what is wrong and where.
fn agrees(system: &System, samples: &[Sample]) -> Result<Vec<Outcome>, String> {
    agrees_as(system, samples, Expansion::of)
}

/// The same of another expansion.
fn agrees_as(system: &System, samples: &[Sample], expand: Expand) -> Result<Vec<Outcome>, String> {
    let source = Source::of(system);
    let expansion = expand(&source).map_err(|error| format!("{error}\n{source}"))?;
    let at_sample = |sample: &Sample| {
        check(system, &expansion, sample, &expected(system, sample))
            .map_err(|error| format!("{error}\n{source}at {sample:?}"))
    };
    samples.iter().map(at_sample).collect()
}

#[test]
fn every_emitted_quantity_agrees_with_dual_numbers() {
    let report = Mutex::new(Report::default());
    runner::run(runner::cases(QUICK), cases, |(system, samples)| {
        let outcomes = agrees(system, samples)?;
        report.lock().map_err(|error| error.to_string())?.add(outcomes);
        Ok(())
    });
    let report = report.into_inner().expect("a worker has failed");
    println!("{report}");
    report.assert_meaningful();
}

#[test]
fn systems_that_recur_agree_with_dual_numbers() {
    let report = Mutex::new((Report::default(), [0_usize; 2]));
    let cases = || (strategy::chained(), [strategy::sample(), strategy::sample()]).boxed();
    runner::run(runner::cases(QUICK) / 8, cases, |(system, samples)| {
        let outcomes = agrees(system, samples)?;
        let recurs = tokens(&Source::of(system))?.to_string().contains("a recursion that does not form it");
        let mut report = report.lock().map_err(|error| error.to_string())?;
        report.0.add(outcomes);
        report.1[usize::from(recurs)] += 1;
        Ok(())
    });
    let (report, [formed, recurring]) = report.into_inner().expect("a worker has failed");
    println!("{recurring} of {} recur\n{report}", formed + recurring);
    report.assert_but_for(60);
    assert!(recurring > formed, "{recurring} of {} recur", formed + recurring);
}

#[test]
fn systems_of_many_links_agree_with_dual_numbers() {
    let report = Mutex::new((Report::default(), [0_usize; 2]));
    let cases = || (strategy::linked(), [strategy::sample(), strategy::sample()]).boxed();
    runner::run(runner::cases(QUICK) / 16, cases, |(system, samples)| {
        let outcomes = agrees(system, samples)?;
        let is_sparse = tokens(&Source::of(system))?.to_string().contains("saddle :: Sparse");
        let mut report = report.lock().map_err(|error| error.to_string())?;
        report.0.add(outcomes);
        report.1[usize::from(is_sparse)] += 1;
        Ok(())
    });
    let (report, [dense, sparse]) = report.into_inner().expect("a worker has failed");
    println!("{sparse} sparse systems of {}\n{report}", dense + sparse);
    assert!(3 * sparse > dense, "{sparse} of {} are sparse", dense + sparse);
}

#[test]
fn series_of_systems_of_many_links_agree_with_truncated_series() {
    let cases = || (strategy::linked(), [strategy::sample(), strategy::sample()]).boxed();
    let [compared, kinked, left_out] = compare_series(cases, runner::cases(QUICK) / 32, Expansion::of);
    assert!(2 * compared > kinked + left_out);
}

/// Compares the series of all samples, and counts: compared, not smooth, left out.
fn compare_series(
    strategy: impl Fn() -> BoxedStrategy<(System, [Sample; 2])> + Sync,
    cases: usize,
    expand: Expand,
) -> [usize; 3] {
    let total: Mutex<([usize; 3], close::Agreement)> = Mutex::default();
    runner::run(cases, strategy, |(system, samples)| {
        let source = Source::of(system);
        let expansion = expand(&source).map_err(|error| format!("{error}\n{source}"))?;
        for sample in samples {
            let outcome = series::check(system, &expansion, sample)
                .map_err(|error| format!("{error}\n{source}at {sample:?}"))?;
            let mut total = total.lock().map_err(|error| error.to_string())?;
            match outcome {
                series::Outcome::Compared(agreement) => {
                    total.0[0] += 1;
                    total.1.join(agreement);
                }
                series::Outcome::NotSmooth => total.0[1] += 1,
                series::Outcome::LeftOut => total.0[2] += 1,
            }
        }
        Ok(())
    });
    let (counts, agreement) = total.into_inner().expect("a worker has failed");
    println!("compared, not smooth, left out: {counts:?}; {agreement:?}");
    counts
}

#[test]
fn every_order_of_emitted_series_agrees_with_truncated_series() {
    let [compared, kinked, left_out] = compare_series(cases, runner::cases(QUICK) / 8, Expansion::of);
    assert!(2 * compared > kinked + left_out && 4 * compared > left_out);
}

#[test]
fn series_of_systems_that_recur_agree_with_truncated_series() {
    let cases = || (strategy::chained(), [strategy::sample(), strategy::sample()]).boxed();
    let [compared, kinked, left_out] = compare_series(cases, runner::cases(QUICK) / 32, Expansion::of);
    assert!(2 * compared > kinked + left_out);
}

#[test]
fn what_analysis_derives_obeys_identities() {
    let total: Mutex<analysis::Counts> = Mutex::default();
    runner::run(runner::cases(QUICK) / 8, cases, |(system, samples)| {
        let source = Source::of(system);
        for sample in samples {
            let counts = analysis::check(&source, sample)
                .map_err(|error| format!("{error}\n{source}at {sample:?}"))?;
            let mut total = total.lock().map_err(|error| error.to_string())?;
            total.covariant += counts.covariant;
            total.regressors += counts.regressors;
        }
        Ok(())
    });
    let total = total.into_inner().expect("a worker has failed");
    println!("{total:?}");
    assert!(total.covariant > QUICK && total.regressors > QUICK / 16, "{total:?}");
}

#[test]
fn what_is_claimed_of_whole_lagrangians_holds() {
    let total: Mutex<claims::Counts> = Mutex::default();
    runner::run(2 * runner::cases(QUICK), claims::strategy, |whole| {
        let counts = claims::check(whole)?;
        let mut total = total.lock().map_err(|error| error.to_string())?;
        total.energies += counts.energies;
        total.others += counts.others;
        Ok(())
    });
    let total = total.into_inner().expect("a worker has failed");
    println!("{total:?}");
    assert!(total.energies > QUICK / 8 && total.others > QUICK / 16, "{total:?}");
}

#[test]
fn the_same_description_gives_the_same_tokens() {
    runner::run(runner::cases(QUICK) / 8, strategy::system, |system| {
        let source = Source::of(system);
        let expand = || tokens(&source).map(|tokens| tokens.to_string());
        if expand()? == expand()? { Ok(()) } else { Err(format!("two expansions of\n{source}")) }
    });
}

#[test]
fn planted_faults_in_random_systems_are_caught() {
    let caught = Caught::default();
    runner::run(runner::cases(QUICK) / 8, cases, |(system, samples)| {
        let expansion = Expansion::of(&Source::of(system))?;
        let wanted: Vec<_> = samples.iter().map(|sample| expected(system, sample)).collect();
        caught.plant(&expansion, Part::Quantities, |faulty| {
            let mut pairs = samples.iter().zip(&wanted);
            pairs.any(|(sample, wanted)| check(system, faulty, sample, wanted).is_err())
        })
    });
    caught.assert_most();
}

#[test]
fn every_emitted_derivative_agrees_with_dual_numbers() {
    let report = Mutex::new(Report::default());
    runner::run(runner::cases(DERIVED), cases, |(system, samples)| {
        let asked = Asked::of(system)?;
        let source = &asked.source;
        let expansion = Expansion::of(source).map_err(|error| format!("{error}\n{source}"))?;
        let at_sample = |sample: &Sample| {
            let wanted = Expected::of(system, &asked.parameters, sample);
            derivatives::check(system, &asked, &expansion, sample, &wanted)
                .map_err(|error| format!("{error}\n{source}at {sample:?}"))
        };
        let outcomes = samples.iter().map(at_sample).collect::<Result<Vec<_>, String>>()?;
        report.lock().map_err(|error| error.to_string())?.add(outcomes);
        Ok(())
    });
    let report = report.into_inner().expect("a worker has failed");
    println!("{report}");
    report.assert_meaningful();
}

#[test]
fn planted_faults_in_derivatives_are_caught() {
    let caught = Caught::default();
    runner::run(runner::cases(QUICK / 4) / 8, cases, |(system, samples)| {
        let asked = Asked::of(system)?;
        let expansion = Expansion::of(&asked.source)?;
        let expected = |sample: &Sample| Expected::of(system, &asked.parameters, sample);
        let wanted: Vec<_> = samples.iter().map(expected).collect();
        caught.plant(&expansion, Part::Derivatives, |faulty| {
            let mut pairs = samples.iter().zip(&wanted);
            pairs.any(|(sample, wanted)| derivatives::check(system, &asked, faulty, sample, wanted).is_err())
        })
    });
    caught.assert_most();
}

/// The numbers of planted faults that were noticed, and of all.
#[derive(Default)]
struct Caught(Mutex<BTreeMap<Fault, (usize, usize)>>);

impl Caught {
    /// Plants some faults of every kind, one at a time.
    fn plant(
        &self,
        expansion: &Expansion,
        part: Part,
        notices: impl Fn(&Expansion) -> bool,
    ) -> Result<(), String> {
        for fault in Fault::ALL {
            let count = sites(expansion, part, fault);
            for site in (0..count).step_by(count / 4 + 1) {
                let Some(faulty) = planted(expansion, part, fault, site) else { continue };
                let noticed = notices(&faulty);
                let mut caught = self.0.lock().map_err(|error| error.to_string())?;
                let (noticed_ones, all) = caught.entry(fault).or_default();
                *noticed_ones += usize::from(noticed);
                *all += 1;
            }
        }
        Ok(())
    }

    /// Some planted faults have no effect: a term that is zero, a digit of a number that is added to a far
    /// larger one.
    fn assert_most(self) {
        for (fault, (noticed, all)) in self.0.into_inner().expect("a worker has failed") {
            println!("{fault:?}: {noticed} of {all} are noticed");
            let least = if matches!(fault, Fault::Digit) { 5 } else { 8 };
            assert!(10 * noticed >= least * all, "{fault:?}: only {noticed} of {all} are noticed");
        }
    }
}
