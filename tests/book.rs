//! The README and the book: every link leads somewhere, every program runs as a test, every cause of an error
//! is explained.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Pages beside the book whose links are checked. Programs that know the names of headings write `RESULTS.md`
/// and `STABILITY.md`.
const DOCUMENTS: &[&str] = &[
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "benchmarks/README.md",
    "benchmarks/RESULTS.md",
    "benchmarks/STABILITY.md",
    "firmware/README.md",
    "tests/README.md",
];

/// The most bytes of a README that is one screen of pitch, and of a picture that is small enough to be
/// committed.
const README: usize = 7 * 1024;
const PICTURE: u64 = 64 * 1024;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The chapters in `book/src`, without the table of contents.
fn chapters() -> Vec<PathBuf> {
    let folder = fs::read_dir(root().join("book/src")).expect("the book is there");
    let paths = folder.map(|entry| entry.expect("an entry of the folder").path());
    let is_chapter =
        |path: &PathBuf| path.extension().is_some_and(|e| e == "md") && !path.ends_with("SUMMARY.md");
    let mut chapters: Vec<PathBuf> = paths.filter(is_chapter).collect();
    chapters.sort();
    assert!(chapters.len() > 10, "{chapters:?}");
    chapters
}

/// A page without its code: lines outside fences, with code spans blanked.
fn prose(page: &str) -> String {
    let mut in_code = false;
    let mut text = String::new();
    for line in page.lines() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        } else if !in_code {
            let parts = line.split('`').enumerate();
            text.extend(parts.map(|(place, part)| if place % 2 == 0 { part } else { "`" }));
            text.push('\n');
        }
    }
    assert!(!in_code, "a block of code does not end");
    text
}

/// The names that a link may have after `#`: headings in lower case, blanks as hyphens, letters and digits
/// kept.
fn anchors(page: &str) -> BTreeSet<String> {
    let mut in_code = false;
    let mut found = BTreeSet::new();
    for line in page.lines() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }
        let heading = line.trim_start_matches('#');
        if in_code || heading.len() == line.len() || !heading.starts_with(' ') {
            continue;
        }
        let kept = |c: char| match c {
            ' ' => Some('-'),
            '-' | '_' => Some(c),
            _ if c.is_alphanumeric() => Some(c),
            _ => None,
        };
        found.insert(heading.trim().to_lowercase().chars().filter_map(kept).collect());
    }
    found
}

/// Targets of the links and pictures of a page.
fn targets(page: &str) -> Vec<String> {
    let text = prose(page);
    let ends = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    ends.map(|(target, _)| target.to_owned()).collect()
}

/// The broken links of a page.
fn broken(path: &Path, page: &str) -> Vec<String> {
    let mut broken = Vec::new();
    for target in targets(page) {
        if target.starts_with("https://") {
            continue;
        }
        let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
        let place = if file.is_empty() { path.to_owned() } else { path.with_file_name(file) };
        let exists = place.exists();
        if !exists || !anchor.is_empty() && !anchors(&read(&place)).contains(anchor) {
            broken.push(format!("{}: {target}", path.display()));
        }
    }
    broken
}

#[test]
fn every_link_leads_somewhere() {
    let documents = DOCUMENTS.iter().map(|name| root().join(name));
    let contents = root().join("book/src/SUMMARY.md");
    let pages = documents.chain(chapters()).chain([contents]);
    let broken: Vec<String> = pages.flat_map(|path| broken(&path, &read(&path))).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn a_broken_link_is_noticed() {
    let path = root().join("README.md");
    let page =
        "# Here\n[a](#here) [b](#there) [c](nowhere.md) `[d](code)` [e](Cargo.toml)\n```\n[f](code)\n```\n";
    // The anchors are those of the file on disk.
    let found = broken(&path, page);
    let names: Vec<&str> = found.iter().filter_map(|text| text.rsplit(' ').next()).collect();
    assert_eq!(names, ["#here", "#there", "nowhere.md"]);
    assert_eq!(anchors(page).into_iter().collect::<Vec<_>>(), ["here"]);
}

#[test]
fn every_chapter_is_tested_and_in_the_contents() {
    let (facade, contents) = (read("src/lib.rs"), read("book/src/SUMMARY.md"));
    for chapter in chapters() {
        let name = chapter.file_name().expect("a file").to_string_lossy().into_owned();
        assert!(facade.contains(&format!("\"../book/src/{name}\"")), "{name} is not tested by src/lib.rs");
        assert!(contents.contains(&format!("]({name})")), "{name} is not in SUMMARY.md");
    }
}

/// A block of code names its language, and one in Rust cannot avoid the compiler.
#[test]
fn every_program_is_compiled_and_run() {
    let mut programs = 0;
    for path in chapters().into_iter().chain([root().join("README.md")]) {
        let page = read(&path);
        let fences = page.lines().filter_map(|line| line.trim_start().strip_prefix("```"));
        for language in fences.step_by(2) {
            assert!(matches!(language, "rust" | "sh" | "text" | "toml"), "{}: ```{language}", path.display());
            programs += usize::from(language == "rust");
        }
    }
    assert!(programs > 20, "{programs} programs");
}

/// The variants of the enumeration of causes, as they stand in its source.
fn causes() -> Vec<String> {
    let source = read("lagrange-runtime/src/system/error.rs");
    let (_, body) = source.split_once("pub enum Cause {").expect("the causes are there");
    let (body, _) = body.split_once("\n}").expect("they end");
    let variants = body.lines().filter_map(|line| line.strip_prefix("    "));
    let variants = variants.filter(|line| line.starts_with(|c: char| c.is_ascii_uppercase()));
    variants.map(|line| line.trim_end_matches([' ', '{', ',']).to_owned()).collect()
}

#[test]
fn every_cause_is_explained() {
    let explained = anchors(&read("book/src/errors.md"));
    let causes = causes();
    assert!(causes.len() > 25, "{causes:?}");
    for cause in causes {
        assert!(explained.contains(&cause.to_lowercase()), "{cause} is not explained in book/src/errors.md");
    }
}

/// The message of each cause as it stands in the source, by the name of the cause.
fn message(of: &str, source: &str) -> String {
    let name = |arm: &str| arm.split(|c: char| !c.is_ascii_alphanumeric()).next().map(str::to_owned);
    let arms = source.split("\n            Self::").skip(1);
    arms.filter(|arm| name(arm).as_deref() == Some(of)).map(joined).collect()
}

/// Source text with the line breaks inside of strings taken out.
fn joined(source: &str) -> String {
    source.split("\\\n").enumerate().map(|(i, line)| if i == 0 { line } else { line.trim_start() }).collect()
}

#[test]
fn every_message_leads_to_its_cause() {
    let page = read("book/src/errors.md");
    let (_, table) = page.split_once("## From a message to its cause").expect("the table is there");
    let (table, _) = table.split_once("\n## ").expect("it ends");
    let messages = read("lagrange-runtime/src/system/error/display.rs");
    // The message of `Misread` comes with the name of the function, for the sake of size.
    let misread = joined(&read("lagrange-runtime/src/system/reading.rs"));
    let mut missing: BTreeSet<String> = causes().into_iter().collect();
    for row in table.lines().filter(|line| line.contains("](#")) {
        let (words, cause) = row.trim_matches([' ', '|']).split_once(" | [`").expect("two columns");
        let (cause, anchor) = cause.split_once("`](#").expect("a link to a heading");
        assert_eq!(anchor, format!("{})", cause.to_lowercase()), "{row}");
        let message = if cause == "Misread" { misread.clone() } else { message(cause, &messages) };
        for words in
            words.split('…').map(|words| words.trim_matches([' ', ','])).filter(|words| words.len() > 3)
        {
            assert!(message.contains(words), "`{words}` is not in the message of {cause}: {message}");
        }
        missing.remove(cause);
    }
    assert!(missing.is_empty(), "no row leads to {missing:?}");
}

#[test]
fn the_readme_is_short_and_pictures_are_small() {
    let bytes = read("README.md").len();
    assert!(bytes <= README, "README.md has {bytes} bytes; what is not for everybody belongs into the book");
    for entry in fs::read_dir(root().join("book/src/pictures")).expect("pictures are there") {
        let entry = entry.expect("an entry of the folder");
        let bytes = entry.metadata().expect("its size").len();
        assert!(bytes <= PICTURE, "{}: {bytes} bytes", entry.path().display());
    }
}
