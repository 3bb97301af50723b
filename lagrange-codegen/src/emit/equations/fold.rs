//! Formulas in lines that fit on paper.

/// Characters of a line of formulas.
const WIDTH: usize = 70;

/// Breaks lines that are too long to print. A line is broken before one of its outermost signs, and what
/// follows is indented.
pub(super) fn folded(text: &str) -> String {
    text.lines().flat_map(fold).map(|line| line + "\n").collect()
}

fn fold(line: &str) -> Vec<String> {
    const INDENT: &str = "      ";
    let mut lines = Vec::new();
    let mut rest: Vec<char> = line.chars().collect();
    while rest.len() > WIDTH {
        // The last of the outermost signs within the width, or else the first one beyond it.
        let (mut depth, mut best) = (0, None);
        for (index, window) in rest.windows(3).enumerate() {
            if index > WIDTH && best.is_some() {
                break;
            }
            match window {
                ['(', ..] => depth += 1,
                [')', ..] => depth -= 1,
                [' ', '+' | '−' | '=', ' ']
                    if index > WIDTH / 4 && best.is_none_or(|(least, _)| depth <= least) =>
                {
                    best = Some((depth, index));
                }
                _ => {}
            }
        }
        let Some((_, index)) = best else { break };
        let after: Vec<char> = INDENT.chars().chain(rest.drain(index..).skip(1)).collect();
        lines.push(std::mem::replace(&mut rest, after).into_iter().collect());
    }
    lines.push(rest.into_iter().collect());
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_go_on_from_an_outer_sign() {
        let late = format!("{} + y", "x·".repeat(40));
        assert_eq!(fold(&late)[1], "      + y");
        let short = "a·x″ + b·x = 0";
        assert_eq!(fold(short), [short]);
        let group = format!("({} + y)", "x·".repeat(24));
        let long = format!("z·{group} + c·{group} = {group}");
        let lines = fold(&long);
        assert!(lines.len() == 3 && lines.iter().all(|line| line.chars().count() <= WIDTH), "{lines:#?}");
        assert!(lines[1].starts_with("      + c·(") && lines[2].starts_with("      = ("), "{lines:#?}");
        let whole: String = lines.iter().map(|line| line.trim_start().to_owned() + " ").collect();
        assert_eq!(whole.trim_end(), long);
        // Nothing to break at.
        assert_eq!(fold(&"x".repeat(200)).len(), 1);
    }
}
