//! What a user is told about a mistake: `tests/ui/<area>_<mistake>.rs` with the compiler's output beside it.
//!
//! After an intended change of a message, `TRYBUILD=overwrite cargo test --test ui` writes the output anew;
//! read the difference as prose before committing it.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;

/// rustc's part of the output (how a place is drawn, its own errors about types) differs between versions.
const RUSTC: &str = "rustc 1.95.";

/// Messages that no description can produce, each with the reason.
const OUT_OF_REACH: [(&str, &str); 1] =
    [("internal_error", "a description that shows it is a bug to be mended")];

#[test]
fn every_mistake_is_reported_where_it_is() {
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(&compiler).arg("--version").output().expect("rustc runs");
    let version = String::from_utf8_lossy(&version.stdout);
    if !version.starts_with(RUSTC) {
        // Past the capture of the test harness: nobody should believe that the messages were checked.
        let reason = format!("tests/ui SKIPPED: written for {RUSTC}x, but this is {}", version.trim());
        writeln!(std::io::stderr(), "{reason}").expect("stderr can be written");
        return;
    }
    trybuild::TestCases::new().compile_fail("tests/ui/*.rs");
}

#[test]
fn one_mistake_gives_one_error() {
    for (name, output) in outputs() {
        let count = |kind: &str| output.lines().filter(|line| line.starts_with(kind)).count();
        assert_eq!(count("warning"), 0, "{name}: noise");
        match name.starts_with("several_") {
            true => assert!(count("error") > 1 || name == "several_uses_of_a_helper", "{name}"),
            false => assert_eq!(count("error"), 1, "{name}"),
        }
    }
}

#[test]
fn cases_and_outputs_belong_together() {
    let [cases, outputs] = ["rs", "stderr"].map(stems);
    assert!(cases.len() >= 60, "{} cases", cases.len());
    assert_eq!(cases, outputs);
}

#[test]
fn every_message_is_shown_by_a_case() {
    let shown: Vec<String> = outputs()
        .iter()
        .flat_map(|(_, output)| output.lines().filter_map(message).map(String::from))
        .collect();
    let messages = messages("catalogue.rs").into_iter().chain(messages("physics.rs"));
    let missing: Vec<String> = messages
        .filter(|(name, _)| !OUT_OF_REACH.iter().any(|(known, _)| known == name))
        .filter(|(_, texts)| !texts.iter().all(|text| shown.iter().any(|line| fits(line, text))))
        .map(|(name, texts)| format!("{name}: {texts:?}"))
        .collect();
    assert!(missing.is_empty(), "no case in tests/ui shows\n{}", missing.join("\n"));
}

/// The text of an error, also of one that the compiler found for us in a constant.
fn message(line: &str) -> Option<&str> {
    line.strip_prefix("error: ").or_else(|| line.strip_prefix("error[E0080]: evaluation panicked: "))
}

/// The outputs by the name of their case.
fn outputs() -> Vec<(String, String)> {
    let read = |name: String| {
        let output = fs::read_to_string(format!("{}/{name}.stderr", directory())).expect("outputs are text");
        (name, output)
    };
    stems("stderr").into_iter().map(read).collect()
}

fn directory() -> String {
    format!("{}/tests/ui", env!("CARGO_MANIFEST_DIR"))
}

/// The names of the files with an extension.
fn stems(extension: &str) -> BTreeSet<String> {
    let files = fs::read_dir(directory()).expect("tests/ui is there");
    files
        .map(|file| file.expect("tests/ui can be read").path())
        .filter(|path| path.extension().is_some_and(|found| found == extension))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect()
}

/// The messages in a source file of the engine: name and texts. A message is an entry of `messages!`, which
/// starts with `name(` and ends with `;`, or a `pub fn`, which ends with a brace in the first column. Its
/// texts are its string literals of more than one word.
fn messages(file: &str) -> Vec<(String, Vec<String>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("lagrange-codegen/src/diagnostics").join(file);
    let source = fs::read_to_string(path).expect("the texts are there");
    let mut messages: Vec<(String, Vec<String>)> = Vec::new();
    let mut in_entries = false;
    let mut rest = source.as_str();
    while !rest.is_empty() {
        let (line, after) = rest.split_once('\n').unwrap_or((rest, ""));
        in_entries = line == "messages! {" || (in_entries && line != "}");
        let declared = line.strip_prefix("pub fn ").or(line.strip_prefix("    ").filter(|_| in_entries));
        let name = declared.and_then(|line| line.split_once('(')).map(|(name, _)| name);
        if let Some(name) = name.filter(|name| name.chars().all(|c| c.is_ascii_lowercase() || c == '_')) {
            messages.push((name.to_owned(), Vec::new()));
        }
        // Comments hold no texts; a literal may run over several lines.
        match line.find('"').filter(|_| !line.trim_start().starts_with("//")) {
            Some(start) if !messages.is_empty() => {
                let (literal, after) = literal(&rest[start + 1..]);
                if literal.contains(' ') {
                    messages.last_mut().expect("a message was found").1.push(literal);
                }
                rest = after;
            }
            _ => rest = after,
        }
    }
    assert!(messages.len() > 5, "the layout of {file} has changed");
    messages.retain(|(_, texts)| !texts.is_empty());
    messages
}

/// The string literal that starts here, without escapes and continuations, and what follows it.
fn literal(source: &str) -> (String, &str) {
    let mut text = String::new();
    let mut characters = source.char_indices();
    while let Some((position, c)) = characters.next() {
        match c {
            '"' => return (text, &source[position + 1..]),
            '\\' => match characters.next() {
                Some((_, '\n')) => {
                    let continued = characters.as_str().trim_start();
                    characters = source[source.len() - continued.len()..].char_indices();
                    let (after, rest) = literal(characters.as_str());
                    return (text + &after, rest);
                }
                Some((_, escaped)) => text.push(escaped),
                None => break,
            },
            _ => text.push(c),
        }
    }
    panic!("a literal does not end");
}

/// Whether a line holds a text whose names in braces stand for anything.
fn fits(line: &str, text: &str) -> bool {
    let text = text.replace("{{", "\u{1}").replace("}}", "\u{2}");
    let mut rest = line;
    text.split(['{', '}']).step_by(2).all(|part| {
        let part = part.replace('\u{1}', "{").replace('\u{2}', "}");
        match rest.find(&part) {
            Some(start) => {
                rest = &rest[start + part.len()..];
                true
            }
            None => false,
        }
    })
}
