//! Long runs of `let` statements, gathered into few.
//!
//! To the compiler every `let` opens a scope that holds the rest of the function. Thousands of nested scopes
//! overflow its stack when it writes debug information. A group is one `let` of a tuple.

/// Statements in a group. Shorter runs stay as they are.
const GROUP: usize = 64;

/// The statements, a line each, with long runs of `let name: type = value;` in groups.
pub(super) fn gather(text: &str) -> String {
    let mut gathered = String::with_capacity(text.len());
    let mut row: Vec<(&str, &str)> = Vec::new();
    for line in text.split_inclusive('\n') {
        match binding(line) {
            Some(name) => row.push((name, line)),
            None => {
                flush(&mut row, &mut gathered);
                gathered.push_str(line);
            }
        }
    }
    flush(&mut row, &mut gathered);
    gathered
}

/// The name that a line binds, with its `mut`; `None` for any other line.
fn binding(line: &str) -> Option<&str> {
    let (name, rest) = line.strip_prefix("let ")?.split_once(": ")?;
    let bare = name.strip_prefix("mut ").unwrap_or(name);
    let is_name = bare.chars().all(|c| c == '_' || c.is_alphanumeric());
    (is_name && rest.ends_with(";\n")).then_some(name)
}

fn flush(row: &mut Vec<(&str, &str)>, gathered: &mut String) {
    if row.len() <= GROUP {
        row.drain(..).for_each(|(_, line)| gathered.push_str(line));
        return;
    }
    for group in row.chunks(GROUP) {
        if let [(_, line)] = group {
            gathered.push_str(line);
            continue;
        }
        let names: Vec<&str> = group.iter().map(|(name, _)| *name).collect();
        let values: Vec<&str> = names.iter().map(|name| name.strip_prefix("mut ").unwrap_or(name)).collect();
        gathered.push_str(&format!("let ({}) = {{\n", names.join(", ")));
        // Inside a group nothing is assigned to, so `mut` goes.
        group.iter().for_each(|(_, line)| gathered.push_str(&line.replacen("let mut ", "let ", 1)));
        gathered.push_str(&format!("({})\n}};\n", values.join(", ")));
    }
    row.clear();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_rows_stay_as_they_are() {
        let text = "let a: f64 = 1.0;\nlet [b, c] = q;\nlet mut d: f64 = a;\n";
        assert_eq!(gather(text), text);
    }

    #[test]
    fn long_rows_become_groups() {
        let line = |i: usize| format!("let {}x{i}: f64 = {i}.0;\n", if i == 3 { "mut " } else { "" });
        let text: String = (0..GROUP + 1).map(line).collect::<String>() + "x3 += x1;\n";
        let gathered = gather(&text);
        assert!(gathered.starts_with("let (x0, x1, x2, mut x3, x4"));
        assert!(gathered.contains("\nlet x3: f64 = 3.0;\n"));
        assert!(gathered.ends_with("x63)\n};\nlet x64: f64 = 64.0;\nx3 += x1;\n"));
    }
}
