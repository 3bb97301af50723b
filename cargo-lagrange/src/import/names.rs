//! Names of a file as Rust identifiers.

use std::collections::BTreeSet;

use super::report::Sink;

const KEYWORDS: [&str; 52] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "union", "unsafe", "unsized", "use",
    "virtual", "where", "while", "yield",
];

/// Types and traits that a description names.
const TYPES: [&str; 14] = [
    "Coordinates",
    "Velocities",
    "Inputs",
    "IsometryMatrix3",
    "Translation3",
    "Rotation3",
    "Vector3",
    "Matrix3",
    "Unit",
    "Self",
    "Default",
    "Clone",
    "Copy",
    "Debug",
];

/// A set of names in which each occurs once.
#[derive(Debug, Default)]
pub struct Names {
    taken: BTreeSet<String>,
}

impl Names {
    /// Whether a name is there already.
    pub fn has(&self, name: &str) -> bool {
        self.taken.contains(name)
    }

    /// An identifier for a name of the file. A name that is taken gets a number, and a note says so.
    pub fn take(&mut self, written: &str, wanted: &str, sink: &mut Sink) -> String {
        let mut name = wanted.to_owned();
        let mut count = 1;
        while !self.taken.insert(name.clone()) {
            count += 1;
            name = format!("{wanted}_{count}");
        }
        if count > 1 {
            sink.note(format!(
                "`{written}` is `{name}` in the description, since `{wanted}` is there already"
            ));
        }
        name
    }
}

/// Lower case with underscores, as Rust names fields and functions.
pub fn snake(written: &str) -> String {
    let mut name = String::new();
    let mut before = '_';
    for letter in written.chars() {
        if letter.is_ascii_uppercase() && (before.is_ascii_lowercase() || before.is_ascii_digit()) {
            name.push('_');
        }
        let plain = if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' };
        if plain != '_' || !name.ends_with('_') {
            name.push(plain);
        }
        before = letter;
    }
    let name = name.trim_matches('_');
    match name.chars().next() {
        None => "unnamed".to_owned(),
        Some(first) if first.is_ascii_digit() => format!("n{name}"),
        _ => name.to_owned(),
    }
}

/// A name of its own: words of the language get an underscore.
pub fn alone(name: String) -> String {
    if KEYWORDS.contains(&name.as_str()) { name + "_" } else { name }
}

/// Words with capitals, as Rust names types.
pub fn camel(written: &str) -> String {
    let name: String = snake(written)
        .split('_')
        .map(|word| {
            let mut letters = word.chars();
            letters
                .next()
                .map(|first| first.to_ascii_uppercase().to_string() + letters.as_str())
                .unwrap_or_default()
        })
        .collect();
    if TYPES.contains(&name.as_str()) { format!("{name}Robot") } else { name }
}

/// Whether a text can name a type of the description.
pub fn is_type_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters.next().is_some_and(|first| first.is_ascii_uppercase())
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
        && !TYPES.contains(&text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers() {
        for (written, name) in [
            ("FR_hip_joint", "fr_hip_joint"),
            ("leftHipYaw", "left_hip_yaw"),
            ("robot/base link", "robot_base_link"),
            ("2nd-axis", "n2nd_axis"),
            ("_", "unnamed"),
            ("Gelenk für Öl", "gelenk_f_r_l"),
        ] {
            assert_eq!(snake(written), name);
        }
        assert_eq!(alone(snake("type")), "type_");
        assert_eq!(camel("ur5_robot"), "Ur5Robot");
        assert_eq!(camel("vector3"), "Vector3Robot");
    }

    #[test]
    fn equal_names_are_told_apart() {
        let (mut names, mut sink) = (Names::default(), Sink::default());
        assert_eq!(names.take("a-b", "a_b", &mut sink), "a_b");
        assert_eq!(names.take("a b", "a_b", &mut sink), "a_b_2");
        assert_eq!(sink.notes, ["note: `a b` is `a_b_2` in the description, since `a_b` is there already"]);
    }
}
