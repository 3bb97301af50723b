//! The cases of `tests/ui` and who reports their mistakes.

pub mod compiler;

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::process::Command;

/// rustc's part of the output (how a place is drawn, its own errors about types) differs between versions.
const RUSTC: &str = "rustc 1.95.";

fn rustc() -> OsString {
    std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

/// Whether the outputs are those of this compiler. Says so where they are not.
pub fn is_known_compiler() -> bool {
    let version = Command::new(rustc()).arg("--version").output().expect("rustc runs");
    let version = String::from_utf8_lossy(&version.stdout);
    let is_known = version.starts_with(RUSTC);
    if !is_known {
        // Past the capture of the test harness: nobody should believe that the messages were checked.
        let reason = format!("tests/ui SKIPPED: written for {RUSTC}x, but this is {}", version.trim());
        writeln!(std::io::stderr(), "{reason}").expect("stderr can be written");
    }
    is_known
}

/// The cases that the macro reports: without an error that has a code, which is one of the compiler.
pub fn of_the_macro() -> BTreeSet<String> {
    let reported = |(name, output): (String, String)| output.contains("error[").then_some(name);
    let of_the_compiler: BTreeSet<String> = outputs().into_iter().filter_map(reported).collect();
    &(&stems("rs") - &of_the_compiler) - &of_builds()
}

/// The cases that no check finds, but a build.
pub fn of_builds() -> BTreeSet<String> {
    stems("rs").into_iter().filter(|name| name.starts_with("built_")).collect()
}

/// The outputs by the name of their case.
pub fn outputs() -> Vec<(String, String)> {
    let read = |name: String| {
        let output = fs::read_to_string(format!("{}/{name}.stderr", directory())).expect("outputs are text");
        (name, output)
    };
    stems("stderr").into_iter().map(read).collect()
}

pub fn directory() -> String {
    format!("{}/tests/ui", env!("CARGO_MANIFEST_DIR"))
}

/// The names of the files with an extension.
pub fn stems(extension: &str) -> BTreeSet<String> {
    let files = fs::read_dir(directory()).expect("tests/ui is there");
    files
        .map(|file| file.expect("tests/ui can be read").path())
        .filter(|path| path.extension().is_some_and(|found| found == extension))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect()
}
