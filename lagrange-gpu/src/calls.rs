//! Who calls what in PTX: the kernels that reach a function.

use std::collections::{HashMap, HashSet};

use crate::ptx::{is_of_a_name, name};

/// The kernels that call one of these functions, or call what calls it, in the order of the text.
pub fn reaching(text: &str, names: &[String]) -> Vec<String> {
    let functions = functions(text);
    let known: HashSet<&str> = functions.iter().map(|function| function.name).collect();
    let calls: HashMap<&str, HashSet<&str>> = functions
        .iter()
        .map(|function| {
            let words = function.body.split(|c: char| !is_of_a_name(c));
            let called = words.filter(|word| known.contains(word) || names.iter().any(|name| name == word));
            (function.name, called.collect())
        })
        .collect();
    let reaches = |kernel: &str| {
        let (mut seen, mut next) = (HashSet::from([kernel]), vec![kernel]);
        while let Some(function) = next.pop() {
            if names.iter().any(|name| name == function) {
                return true;
            }
            let called = calls.get(function).into_iter().flatten();
            next.extend(called.filter(|called| seen.insert(called)));
        }
        false
    };
    let kernels = functions.iter().filter(|function| function.is_kernel && reaches(function.name));
    kernels.map(|function| function.name.to_owned()).collect()
}

/// The text without these functions, and without what calls them: for functions that no kernel reaches. The
/// compiler may find so late that a check never fails that the function which would report it stays.
pub fn without(text: &str, names: &[String]) -> String {
    let functions = functions(text);
    let mut gone: HashSet<&str> = names.iter().map(String::as_str).collect();
    loop {
        let calls = |function: &&Function<'_>| {
            let mut words = function.body.split(|c: char| !is_of_a_name(c));
            !function.is_kernel && !gone.contains(function.name) && words.any(|word| gone.contains(word))
        };
        let more: Vec<_> = functions.iter().filter(calls).map(|function| function.name).collect();
        if more.is_empty() {
            break;
        }
        gone.extend(more);
    }
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while !rest.is_empty() {
        let line = rest.split_inclusive('\n').next().unwrap_or(rest);
        let declared = [".extern .func", ".func"].into_iter().find_map(|kind| line.strip_prefix(kind));
        let is_gone = declared.is_some_and(|_| {
            let start = rest.find(".func").map_or(rest, |at| &rest[at + ".func".len()..]);
            name(start).is_some_and(|name| gone.contains(name))
        });
        let length = if !is_gone {
            line.len()
        } else if let Some(open) = rest.find(['{', ';']) {
            let last =
                if rest[open..].starts_with('{') { rest.find("\n}").map(|at| at + 1) } else { Some(open) };
            last.map_or(rest.len(), |last| last + 1)
        } else {
            rest.len()
        };
        if !is_gone {
            kept.push_str(line);
        }
        rest = &rest[length..];
    }
    kept
}

/// A function with a body.
struct Function<'a> {
    name: &'a str,
    is_kernel: bool,
    body: &'a str,
}

/// The functions of a text: each one's body reaches to a brace at the beginning of a line.
fn functions(text: &str) -> Vec<Function<'_>> {
    let mut functions = Vec::new();
    let mut at = 0;
    while let Some(line) = text[at..].lines().next() {
        let rest = &text[at..];
        at += line.len() + 1;
        // A declaration ends before a body begins.
        let kinds = [".visible .entry", ".func"];
        if let Some(kind) = kinds.into_iter().find(|kind| line.starts_with(kind))
            && let Some(open) = rest.find(['{', ';'])
            && rest[open..].starts_with('{')
            && let Some(name) = name(&rest[kind.len()..open])
        {
            let end = rest.find("\n}").unwrap_or(rest.len());
            functions.push(Function {
                name,
                is_kernel: kind == ".visible .entry",
                body: rest.get(open..end).unwrap_or_default(),
            });
        }
        if at >= text.len() {
            break;
        }
    }
    functions
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "
.extern .func panics
(
)
;
.func inner(
	.param .b64 a
)
;
.visible .entry good(
	.param .u64 a
)
{
	ret;
}
.visible .entry bad(
	.param .u64 a
)
{
	call.uni (retval0), outer, (param0);
}
.func  (.param .b64 r) outer(
	.param .b64 a
)
{
	call.uni inner, (param0);
}
.func inner(
	.param .b64 a
)
{
	call.uni outer, (param0);
	call.uni panics, ();
}
.visible .entry worse()
{
	{ // callseq 1
	call.uni panics, ();
	} // callseq 1
}
";

    #[test]
    fn kernels_are_named_that_reach_a_function() {
        assert_eq!(reaching(TEXT, &["panics".to_owned()]), ["bad", "worse"]);
        assert!(reaching(TEXT, &["malloc".to_owned()]).is_empty());
    }

    #[test]
    fn functions_that_no_kernel_calls_are_left_out() {
        let idle = TEXT.split(".visible .entry bad").next().unwrap();
        let text =
            format!("{idle}.func handler()\n{{\n\tcall.uni panics, ();\n}}\n.func kept()\n{{\n\tret;\n}}\n");
        let names = ["panics".to_owned()];
        assert!(reaching(&text, &names).is_empty());
        let kept = without(&text, &names);
        assert!(!kept.contains("panics") && !kept.contains("handler"), "{kept}");
        for function in [".func inner(", ".visible .entry good(", ".func kept()"] {
            assert!(kept.contains(function), "{kept}");
        }
        assert_eq!(kept.matches('{').count(), 2);
    }
}
