//! What a user is told about a mistake: `tests/ui/<area>_<mistake>.rs` with the compiler's output beside it.
//!
//! The mistakes that the macro reports are found in one crate. Those that the compiler finds in types, errors
//! with a code, need a crate each, since it stops at the first kind of them.
//!
//! After an intended change of a message, `UPDATE_UI=1 cargo test --test ui` writes the output anew;
//! read the difference as prose before committing it.

#[path = "ui/cases/mod.rs"]
mod cases;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use cases::compiler::{report, text};
use cases::{outputs, stems};

/// Messages that no description can produce, each with the reason.
const OUT_OF_REACH: [(&str, &str); 2] = [
    ("internal_error", "a description that shows it is a bug to be mended"),
    (
        "unread",
        "the compiler reports the form itself, and comes to this message only where it sees nothing wrong",
    ),
];

#[test]
fn the_macro_reports_mistakes_where_they_are() {
    if !cases::is_known_compiler() {
        return;
    }
    let names = cases::of_the_macro();
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ui.rs");
    let module = |name: &String| format!("#[path = \"{}/{name}.rs\"]\nmod {name};\n", cases::directory());
    fs::write(&source, names.iter().map(module).collect::<String>()).expect("the crate can be written");
    let mut found: BTreeMap<String, String> = names.into_iter().map(|name| (name, String::new())).collect();
    for (name, text) in messages_about(&source, "lib") {
        found.get_mut(&name).expect("it is a case").push_str(&text);
    }
    compare(found);
}

#[test]
fn the_compiler_reports_mistakes_where_they_are() {
    if !cases::is_known_compiler() {
        return;
    }
    let others = &(&cases::of_the_macro() & &stems("stderr")) | &cases::of_builds();
    let own = &stems("rs") - &others;
    assert!(own.len() > 30, "{own:?}");
    let about = |name: String| {
        let source = Path::new(&cases::directory()).join(format!("{name}.rs"));
        let text = messages_about(&source, "bin").into_iter().map(|(_, text)| text).collect();
        (name, text)
    };
    compare(own.into_iter().map(about).collect());
}

/// Constants in generic functions are evaluated where these are compiled. The place is in the library, so the
/// message alone is compared.
#[test]
fn a_build_reports_what_checks_do_not() {
    if !cases::is_known_compiler() {
        return;
    }
    let about = |name: String| {
        let source = Path::new(&cases::directory()).join(format!("{name}.rs"));
        let messages = report(&source, "bin", "obj");
        let errors = messages.iter().map(text).filter(|text| text.starts_with("error["));
        let first = |text: String| text.lines().next().unwrap_or_default().to_owned() + "\n\n";
        (name, errors.map(first).collect())
    };
    compare(cases::of_builds().into_iter().map(about).collect());
}

/// Compares the messages about each case with those beside it, or writes them.
fn compare(found: BTreeMap<String, String>) {
    let mut wrong = Vec::new();
    for (name, found) in &found {
        let path = format!("{}/{name}.stderr", cases::directory());
        let expected = fs::read_to_string(&path).unwrap_or_default();
        // Errors are one line apart.
        let found = format!("{}\n", found.trim_end());
        if found == expected {
            continue;
        }
        if std::env::var_os("UPDATE_UI").is_some() && found.len() > 1 {
            fs::write(&path, found).expect("the output can be written");
        } else {
            wrong.push(format!("{name}, expected:\n{expected}\nfound:\n{found}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {} cases\n{}", wrong.len(), found.len(), wrong.join("\n"));
}

/// The compiler's messages about a file, each with the name of the case that it is about.
fn messages_about(source: &Path, kind: &str) -> Vec<(String, String)> {
    let place = format!("{}/", cases::directory());
    let mut messages = Vec::new();
    for text in report(source, kind, "metadata").iter().map(text) {
        // Without a place it says how many errors there were.
        let Some((_, name)) = text.split_once(&place) else { continue };
        let (name, _) = name.split_once(".rs:").expect("a place is a line of a file");
        let text = text.replace(&place, "tests/ui/");
        messages.push((name.to_owned(), portable(text.trim_end()) + "\n\n"));
    }
    messages
}

/// A message that stays the same where other files become longer: their lines have no numbers, and the column
/// of numbers is as wide as those of the case are.
fn portable(message: &str) -> String {
    let mut is_foreign = false;
    let without_numbers = |line: &str| {
        if let Some((before, place)) = line.split_once("--> ") {
            is_foreign = !place.starts_with("tests/ui/");
            return if is_foreign { format!("{before}--> {}", file(place)) } else { line.to_owned() };
        }
        is_foreign &= line.starts_with(|c: char| c == ' ' || c == '.' || c.is_ascii_digit());
        match line.split_once(" |") {
            Some((number, rest)) if is_foreign && number.chars().all(|c| c == ' ' || c.is_ascii_digit()) => {
                format!("{:1$} |{rest}", "", number.len())
            }
            _ => line.to_owned(),
        }
    };
    let lines: Vec<String> = message.lines().map(without_numbers).collect();
    let is_indented = |line: &&String| line.starts_with(|c: char| c == ' ' || c.is_ascii_digit());
    let indentation = |line: &String| line.len() - line.trim_start().len();
    let spare = lines.iter().filter(is_indented).map(indentation).min().unwrap_or_default();
    let shortened = |line: &String| if is_indented(&line) { line[spare..].to_owned() } else { line.clone() };
    lines.iter().map(shortened).collect::<Vec<_>>().join("\n")
}

/// The file of a place, that of a dependency without its folder on this machine.
fn file(place: &str) -> String {
    let (path, _) = place.split_once(".rs:").expect("a place is a line of a file");
    let Some((_, path)) = path.split_once("/registry/src/") else { return format!("{path}.rs") };
    let mut parts = path.split('/').skip(1);
    let package = parts.next().and_then(|part| part.rsplit_once('-')).expect("a package has a version").0;
    format!("$CARGO/{package}-$VERSION/{}.rs", parts.collect::<Vec<_>>().join("/"))
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
