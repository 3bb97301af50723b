//! The compiler's messages about a file that uses the library of this test.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// The messages about a crate of this `kind` (`lib`, `bin`), of which rustc makes `metadata` or `obj`.
pub fn report(source: &Path, kind: &str, made: &str) -> Vec<Value> {
    let deps = std::env::current_exe().expect("the test is a file");
    let deps = deps.parent().expect("it stands in a folder");
    let mut compiler = Command::new(super::rustc());
    compiler.args(["--edition=2024", "--error-format=json", "--verbose", "-Adead_code"]);
    compiler.arg(format!("--emit={made}"));
    compiler.arg(format!("--crate-type={kind}")).arg("--out-dir").arg(env!("CARGO_TARGET_TMPDIR"));
    compiler.arg("-L").arg(format!("dependency={}", deps.display()));
    compiler.arg("--extern").arg(format!("lagrangian={}", newest(deps, "liblagrangian-").display()));
    // Messages are those under cargo.
    let output = compiler.env("CARGO_CRATE_NAME", "case").arg(source).output().expect("rustc runs");
    let output = String::from_utf8(output.stderr).expect("rustc writes text");
    output.lines().map(|line| serde_json::from_str(line).expect("rustc writes JSON")).collect()
}

/// The text of a message, as a user reads it.
pub fn text(message: &Value) -> String {
    message["rendered"].as_str().expect("a message has a text").to_owned()
}

/// The library that was built last, which is that of this test. Libraries of other features stand beside it.
fn newest(folder: &Path, start: &str) -> PathBuf {
    let files = fs::read_dir(folder).expect("the folder of the test can be read");
    let files = files.map(|file| file.expect("it can be read to its end").path()).filter(|path| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with(start) && name.ends_with(".rlib")
    });
    let age =
        |path: &PathBuf| fs::metadata(path).and_then(|data| data.modified()).expect("a file has a time");
    files.max_by_key(age).unwrap_or_else(|| panic!("no {start}*.rlib in {}", folder.display()))
}
