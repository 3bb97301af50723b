//! Near misses: the known name that the user probably meant.

/// The candidate closest to a word, if it is close enough for a misspelling.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let tolerance = match word.chars().count() {
        0..=1 => 0,
        2..=4 => 1,
        _ => 2,
    };
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let distance = distance(word, candidate);
        if candidate != word && distance <= tolerance && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Functions of other languages with the methods that do the same in Rust. By its letters alone `sgn` would
/// be `sin`, and `cot` would be `cos`.
const ELSEWHERE: [(&str, &[&str]); 34] = [
    ("sgn", &["signum"]),
    ("sign", &["signum"]),
    ("fabs", &["abs"]),
    ("pow", &["powi", "powf"]),
    ("power", &["powi", "powf"]),
    ("sqr", &["powi(2)"]),
    ("cube", &["powi(3)"]),
    ("lg", &["log10"]),
    ("ld", &["log2"]),
    ("log1p", &["ln_1p"]),
    ("expm1", &["exp_m1"]),
    ("tg", &["tan"]),
    ("ctg", &["tan().recip()"]),
    ("cot", &["tan().recip()"]),
    ("sec", &["cos().recip()"]),
    ("csc", &["sin().recip()"]),
    ("coth", &["tanh().recip()"]),
    ("sech", &["cosh().recip()"]),
    ("csch", &["sinh().recip()"]),
    ("arcsin", &["asin"]),
    ("arccos", &["acos"]),
    ("arctan", &["atan"]),
    ("arctg", &["atan"]),
    ("arctan2", &["atan2"]),
    ("arcsinh", &["asinh"]),
    ("arccosh", &["acosh"]),
    ("arctanh", &["atanh"]),
    ("arsinh", &["asinh"]),
    ("arcosh", &["acosh"]),
    ("artanh", &["atanh"]),
    ("radians", &["to_radians"]),
    ("degrees", &["to_degrees"]),
    ("deg2rad", &["to_radians"]),
    ("rad2deg", &["to_degrees"]),
];

/// What a function of another language is called in Rust, if it is among the known methods.
pub fn in_rust(word: &str, known: &[&str]) -> Option<&'static [&'static str]> {
    let (_, methods) = ELSEWHERE.into_iter().find(|(name, _)| *name == word)?;
    let is_known = |method: &&str| known.contains(&method.split('(').next().unwrap_or_default());
    methods.iter().all(is_known).then_some(methods)
}

/// Insertions, deletions, substitutions and swaps of neighbours between two words.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let substitution = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = substitution.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_strangers_are_not() {
        assert_eq!(nearest("potental", ["kinetic", "potential"]), Some("potential"));
        assert_eq!(nearest("thet", ["x", "theta"]), Some("theta"));
        assert_eq!(nearest("nrom", ["dot", "norm"]), Some("norm"));
        assert_eq!(nearest("inline", ["point", "body"]), None);
        assert_eq!(nearest("y", ["x"]), None);
    }

    #[test]
    fn functions_of_other_languages_have_the_name_that_they_have_here() {
        let known = ["sin", "signum", "powi", "powf", "tan"];
        assert_eq!(in_rust("sgn", &known), Some(["signum"].as_slice()));
        assert_eq!(in_rust("pow", &known), Some(["powi", "powf"].as_slice()));
        assert_eq!(in_rust("cot", &known), Some(["tan().recip()"].as_slice()));
        // Vectors have no such method.
        assert_eq!(in_rust("sgn", &["norm"]), None);
        assert_eq!(in_rust("sin", &known), None);
    }
}
