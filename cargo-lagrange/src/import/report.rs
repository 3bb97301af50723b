//! The messages of an import: mistakes in the file, each with its place, and notes on the description.

use std::fmt;

use roxmltree::TextPos;

/// Something in the file that cannot be taken as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
    /// The element, as a start tag with its name.
    pub element: String,
    /// The mistake, and how to mend it.
    pub text: String,
}

/// All problems of a file. Never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The file, as it was named.
    pub file: String,
    /// The problems in the order in which they were found.
    pub problems: Vec<Problem>,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, problem) in self.problems.iter().enumerate() {
            let Problem { line, column, element, text } = problem;
            let end = if index + 1 == self.problems.len() { "" } else { "\n" };
            write!(f, "error: {}:{line}:{column}: {element}: {text}{end}", self.file)?;
        }
        Ok(())
    }
}

impl std::error::Error for Report {}

/// A text that stays on its line, be it a comment of Rust or a message. Names of a file may have any
/// characters. Those that end a line become spaces, and so do those that turn the direction of what follows:
/// rustc refuses these in comments, since a reader sees other code than there is.
pub fn one_line(text: &str) -> String {
    let breaks = |letter: char| {
        letter.is_control()
            || matches!(letter, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    text.chars().map(|letter| if breaks(letter) { ' ' } else { letter }).collect()
}

/// Collects problems and notes.
#[derive(Debug, Default)]
pub struct Sink {
    /// Problems that forbid a description.
    pub problems: Vec<Problem>,
    /// Notes for the user of the description.
    pub notes: Vec<String>,
}

impl Sink {
    /// A mistake of the file.
    pub fn problem(&mut self, at: &Mark, text: impl Into<String>) {
        let TextPos { row, col } = at.position;
        let [element, text] = [&at.element, &text.into()].map(|text| one_line(text));
        let problem = Problem { line: row, column: col, element, text };
        // A mistake in defaults is found in all that takes them; once is enough.
        if !self.problems.contains(&problem) {
            self.problems.push(problem);
        }
    }

    /// Something that may be a mistake.
    pub fn warning(&mut self, file: &str, at: &Mark, text: impl AsRef<str>) {
        let TextPos { row, col } = at.position;
        self.say(format!("warning: {file}:{row}:{col}: {}: {}", at.element, text.as_ref()));
    }

    /// The same of the whole, which has no place in the file.
    pub fn caution(&mut self, text: impl AsRef<str>) {
        self.say(format!("warning: {}", text.as_ref()));
    }

    /// Something that was decided.
    pub fn note(&mut self, text: impl AsRef<str>) {
        self.say(format!("note: {}", text.as_ref()));
    }

    fn say(&mut self, text: String) {
        self.notes.push(one_line(&text));
    }
}

/// An element of the file, for messages.
#[derive(Clone, Debug)]
pub struct Mark {
    /// Where it starts.
    pub position: TextPos,
    /// Its start tag, without attributes but its name.
    pub element: String,
}
