//! Runs every example: `cargo test` alone only builds them. They are not built again here.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;
use std::{env, fs, thread};

/// Runs where its feature is on, as `scripts/check.sh digits` has it.
const WITH_FEATURE: (&str, bool) = ("true_digits", cfg!(feature = "double-double"));

/// Where they are built.
fn folder() -> PathBuf {
    let test = env::current_exe().expect("the test is a file");
    test.parent().and_then(Path::parent).expect("it stands in target/…/deps").join("examples")
}

fn examples() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let files = fs::read_dir(folder).expect("the examples are there");
    let paths = files.map(|file| file.expect("the folder can be read").path());
    let is_program = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "rs");
    let name = |path: PathBuf| path.file_stem().expect("a file has a name").to_string_lossy().into_owned();
    paths.filter(is_program).map(name).collect()
}

fn changed(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).and_then(|data| data.modified()).ok()
}

/// Whether an example was built after all its sources were changed, those of the library included.
fn is_built(name: &str) -> bool {
    let built = changed(&folder().join(name).with_extension(env::consts::EXE_EXTENSION));
    let sources = fs::read_to_string(folder().join(name).with_extension("d")).unwrap_or_default();
    let sources = sources.split_once(": ").map_or("", |(_, sources)| sources);
    // A space in a path is written with a backslash before it.
    let sources = sources.trim().replace("\\ ", "\0");
    let is_older = |source: &str| changed(Path::new(&source.replace('\0', " "))) <= built;
    built.is_some() && !sources.is_empty() && sources.split(' ').all(is_older)
}

/// What an example says of itself if it fails.
fn failure(name: &str) -> Option<String> {
    if !is_built(name) {
        return Some(format!(
            "{name} is not built; `cargo test` builds it, and so does `cargo build --examples`"
        ));
    }
    let output = Command::new(folder().join(name)).output().expect("the example starts");
    let said =
        || [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned()).concat();
    (!output.status.success()).then(|| format!("{name}: {}\n{}", output.status, said()))
}

#[test]
fn every_example_runs() {
    let mut examples = examples();
    examples.retain(|name| name != WITH_FEATURE.0 || WITH_FEATURE.1);
    assert!(examples.len() >= 18, "{examples:?}");
    let lanes = thread::available_parallelism().map_or(1, Into::into);
    let failures: Vec<String> = thread::scope(|scope| {
        let run = |lane| examples.iter().skip(lane).step_by(lanes).filter_map(|name| failure(name)).collect();
        let lanes: Vec<_> =
            (0..lanes).map(|lane| scope.spawn(move || -> Vec<String> { run(lane) })).collect();
        lanes.into_iter().flat_map(|lane| lane.join().expect("a lane ends")).collect()
    });
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
