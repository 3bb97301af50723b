//! The elements and attributes that the formats have. What is misspelled would be passed over otherwise, as
//! if it were not there.

pub mod mjcf;
pub mod urdf;

use std::collections::BTreeSet;

use roxmltree::Node;

use super::links;
use super::xml::Reader;

/// The attributes and elements that an element of a format may hold.
pub struct Element {
    /// The names of elements that hold this.
    tags: &'static [&'static str],
    /// Attributes, whether they are read or not.
    attributes: &'static [&'static str],
    /// Elements that stand in it once at most.
    once: &'static [&'static Element],
    /// Elements that stand in it any number of times.
    many: &'static [&'static Element],
    /// Elements that are not looked into.
    passed: &'static [&'static str],
}

impl Element {
    /// One that holds attributes alone.
    const fn leaf(tags: &'static [&'static str], attributes: &'static [&'static str]) -> Self {
        Element { tags, attributes, once: &[], many: &[], passed: &[] }
    }

    fn described(&self) -> impl Iterator<Item = &'static Element> {
        self.once.iter().chain(self.many).copied()
    }

    fn children(&self) -> impl Iterator<Item = &'static str> {
        self.described().flat_map(|element| element.tags).chain(self.passed).copied()
    }
}

/// Reports elements and attributes that the format does not have: a problem if the name is nearly one of the
/// format, a warning if it may be an extension. Names of other namespaces are extensions.
pub fn check(reader: &mut Reader<'_>, node: Node<'_, '_>, element: &Element) {
    let tag = node.tag_name().name().to_owned();
    for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
        let name = attribute.name();
        if !element.attributes.contains(&name) {
            let what = format!("`{name}` is no attribute of <{tag}>");
            unknown(reader, node, Some(name), what, links::near(name, element.attributes.iter().copied()));
        }
    }
    if let Some(macro_call) = node.children().find(|child| is_xacro(*child)) {
        let text = "this is a file for xacro; expand it first: `xacro robot.xacro > robot.urdf`";
        reader.problem(macro_call, text);
    }
    let mut seen = BTreeSet::new();
    for child in node.children().filter(|child| child.is_element() && child.tag_name().namespace().is_none())
    {
        let name = child.tag_name().name();
        let is_first = seen.insert(name);
        if let Some(described) = element.described().find(|described| described.tags.contains(&name)) {
            if !is_first && element.once.iter().any(|once| once.tags.contains(&name)) {
                reader.problem(child, format!("<{tag}> has another <{name}> already; remove one of them"));
            }
            check(reader, child, described);
        } else if is_first && !element.passed.contains(&name) {
            let what = format!("there is no <{name}> in <{tag}>");
            unknown(reader, child, None, what, links::near(name, element.children()));
        }
    }
}

/// Whether an element is a macro of ROS, which makes URDF of it.
fn is_xacro(node: Node<'_, '_>) -> bool {
    let prefix = node.tag_name().namespace().and_then(|namespace| node.lookup_prefix(namespace));
    node.is_element() && prefix == Some("xacro")
}

fn unknown(reader: &mut Reader<'_>, node: Node<'_, '_>, attribute: Option<&str>, what: String, near: String) {
    if near.is_empty() {
        reader.warning(node, format!("{what}; it is passed over"));
        return;
    }
    match attribute {
        Some(attribute) => reader.problem_of(node, attribute, what + &near),
        None => reader.problem(node, what + &near),
    }
}
