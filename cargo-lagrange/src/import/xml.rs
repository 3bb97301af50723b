//! Reads attributes of elements; what is wrong with one is a problem with its place.

use std::fmt::Display;

use roxmltree::{Document, Node};

use super::report::{Mark, Problem, Report, Sink};

/// Reads a file, collecting what is wrong.
pub struct Reader<'a> {
    /// The file, as it was named.
    pub file: &'a str,
    /// The document.
    pub document: &'a Document<'a>,
    /// The problems and notes so far.
    pub sink: Sink,
}

/// Parses XML.
pub fn parse<'a>(file: &str, text: &'a str) -> Result<Document<'a>, Report> {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    Document::parse_with_options(text, options).map_err(|error| {
        let position = error.pos();
        // The parser's message ends in the position, which stands in front of ours.
        let what = error.to_string();
        let what = what.strip_suffix(&format!(" at {position}")).unwrap_or(&what);
        let text = format!("{what}; mend the XML there (`xmllint --noout {file}` says what is open)");
        let problem =
            Problem { line: position.row, column: position.col, element: "this is not XML".to_owned(), text };
        Report { file: file.to_owned(), problems: vec![problem] }
    })
}

impl<'a> Reader<'a> {
    /// An element for messages: its start tag, and the nearest one with a name around it.
    pub fn mark(&self, node: Node<'_, '_>) -> Mark {
        let tag = |node: Node<'_, '_>| {
            let name = ["name", "joint", "joint1", "class"]
                .into_iter()
                .find_map(|key| Some((key, node.attribute(key)?)));
            let name = name.map(|(key, value)| format!(" {key}=\"{value}\"")).unwrap_or_default();
            format!("<{}{name}>", node.tag_name().name())
        };
        let mut element = tag(node);
        if node.attribute("name").is_none() {
            let around = node.ancestors().skip(1).find(|node| {
                node.attribute("name").is_some() && node.parent().is_some_and(|above| above.is_element())
            });
            if let Some(around) = around {
                element = format!("{element} of {}", tag(around));
            }
        }
        Mark { position: self.document.text_pos_at(node.range().start), element }
    }

    /// The place of an attribute, or of its element.
    pub fn mark_attribute(&self, node: Node<'_, '_>, attribute: &str) -> Mark {
        let mut mark = self.mark(node);
        if let Some(found) = node.attribute_node(attribute) {
            mark.position = self.document.text_pos_at(found.range().start);
        }
        mark
    }

    /// A problem of an element.
    pub fn problem(&mut self, node: Node<'_, '_>, text: impl Display) {
        let mark = self.mark(node);
        self.sink.problem(&mark, text.to_string());
    }

    /// A problem of an attribute.
    pub fn problem_of(&mut self, node: Node<'_, '_>, attribute: &str, text: impl Display) {
        let mark = self.mark_attribute(node, attribute);
        self.sink.problem(&mark, text.to_string());
    }

    /// A warning about an element.
    pub fn warning(&mut self, node: Node<'_, '_>, text: impl Display) {
        let mark = self.mark(node);
        self.sink.warning(self.file, &mark, text.to_string());
    }

    /// The text of an attribute that must be there.
    pub fn text<'n>(&mut self, node: Node<'n, '_>, attribute: &str, example: &str) -> Option<&'n str> {
        let found = node.attribute(attribute).map(str::trim).filter(|text| !text.is_empty());
        if found.is_none() {
            self.problem(node, format!("it has no `{attribute}`; write {attribute}=\"{example}\""));
        }
        found
    }

    /// A child element that must be there.
    pub fn child<'n, 'i>(&mut self, node: Node<'n, 'i>, name: &str, example: &str) -> Option<Node<'n, 'i>> {
        let found = child(node, name);
        if found.is_none() {
            self.problem(node, format!("it has no <{name}>; write {example} into it"));
        }
        found
    }

    /// All numbers of an attribute; `None` if it is not there, or wrong, which is reported.
    pub fn numbers(&mut self, node: Node<'_, '_>, attribute: &str) -> Option<Vec<f64>> {
        let text = node.attribute(attribute)?;
        let mut numbers = Vec::new();
        for word in text.split_whitespace() {
            match word.parse::<f64>() {
                Ok(number) if number.is_finite() => numbers.push(number),
                Ok(_) => {
                    let text = format!("{attribute}=\"{text}\" is not finite; write a number");
                    self.problem_of(node, attribute, text);
                    return None;
                }
                Err(_) => {
                    let hint = match word {
                        _ if word.contains("${") => {
                            ": this is a xacro file; run `xacro FILE.xacro > robot.urdf` first"
                        }
                        _ if word.contains(',') => ": write a decimal point, and spaces between numbers",
                        _ => "; write digits such as 0.25 or 1e-3",
                    };
                    self.problem_of(node, attribute, format!("`{word}` in `{attribute}` is no number{hint}"));
                    return None;
                }
            }
        }
        Some(numbers)
    }

    /// Some numbers of an attribute, all of which must be there if the attribute is.
    pub fn vector<const N: usize>(&mut self, node: Node<'_, '_>, attribute: &str) -> Option<[f64; N]> {
        let numbers = self.numbers(node, attribute)?;
        let count = numbers.len();
        let found = <[f64; N]>::try_from(numbers).ok();
        if found.is_none() {
            let what = if N == 1 { "one number".to_owned() } else { format!("{N} numbers") };
            self.problem_of(node, attribute, format!("`{attribute}` has {count} numbers; write {what}"));
        }
        found
    }

    /// One number.
    pub fn number(&mut self, node: Node<'_, '_>, attribute: &str) -> Option<f64> {
        self.vector::<1>(node, attribute).map(|[number]| number)
    }

    /// One number that must be there.
    pub fn required(&mut self, node: Node<'_, '_>, attribute: &str) -> Option<f64> {
        if node.attribute(attribute).is_none() {
            self.problem(node, format!("it has no `{attribute}`; write {attribute}=\"…\" with a number"));
        }
        self.number(node, attribute)
    }

    /// A number that must not be negative; zero if it is not there.
    pub fn size(&mut self, node: Node<'_, '_>, attribute: &str) -> f64 {
        let number = self.number(node, attribute).unwrap_or(0.0);
        if number < 0.0 {
            self.problem_of(node, attribute, format!("`{attribute}` is negative; write a number from 0 on"));
        }
        number
    }
}

/// The first child element of a name.
pub fn child<'n, 'i>(node: Node<'n, 'i>, name: &str) -> Option<Node<'n, 'i>> {
    node.children().find(|child| child.has_tag_name(name))
}

/// All child elements of a name.
pub fn children<'n, 'i: 'n>(node: Node<'n, 'i>, name: &'n str) -> impl Iterator<Item = Node<'n, 'i>> {
    node.children().filter(move |child| child.has_tag_name(name))
}
