//! Runs a property on many cases, on all processors, the same ones each time.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use proptest::strategy::BoxedStrategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

/// Independent sequences of random numbers; the cases do not depend on the number of processors.
const STREAMS: usize = 16;

/// How many cases are tried in looking for the smallest one that fails.
const SHRINKING: u32 = 500;

/// How many cases to run: `PROPTEST_CASES`, or as many as make a quick look.
pub fn cases(quick: usize) -> usize {
    std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(quick)
}

/// Runs a property on as many cases of a strategy; panics with what is wrong in the smallest case found.
pub fn run<T: std::fmt::Debug>(
    cases: usize,
    strategy: impl Fn() -> BoxedStrategy<T> + Sync,
    property: impl Fn(&T) -> Result<(), String> + Sync,
) {
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let stream = next.fetch_add(1, Ordering::Relaxed);
            if stream >= STREAMS {
                return;
            }
            let share = cases / STREAMS + usize::from(stream < cases % STREAMS);
            stretch(stream, share, &strategy(), &property);
        }
    };
    let processors = thread::available_parallelism().map_or(1, usize::from);
    let failures: Vec<_> = thread::scope(|scope| {
        let workers: Vec<_> = (0..processors.min(STREAMS)).map(|_| scope.spawn(work)).collect();
        workers.into_iter().filter_map(|worker| worker.join().err()).collect()
    });
    if let Some(failure) = failures.into_iter().next() {
        std::panic::resume_unwind(failure);
    }
}

fn stretch<T: std::fmt::Debug>(
    stream: usize,
    cases: usize,
    strategy: &BoxedStrategy<T>,
    property: &impl Fn(&T) -> Result<(), String>,
) {
    if cases == 0 {
        return;
    }
    let config = Config {
        cases: u32::try_from(cases).unwrap_or(u32::MAX),
        failure_persistence: None,
        max_shrink_iters: SHRINKING,
        ..Config::default()
    };
    let seed = [u8::try_from(stream).unwrap_or(0); 32];
    let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &seed));
    match runner.run(strategy, |case| property(&case).map_err(TestCaseError::fail)) {
        Ok(()) => {}
        Err(TestError::Fail(reason, _)) => panic!("{reason}"),
        Err(TestError::Abort(reason)) => panic!("runner: {reason}"),
    }
}
