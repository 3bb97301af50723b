//! Who calls what in PTX: the kernels that reach a function.

use std::collections::HashSet;

use crate::ptx::{is_of_a_name, name};

/// The kernels that call one of these functions, or call what calls it, in the order of the text.
pub fn reaching(text: &str, names: &[String]) -> Vec<String> {
    let functions = functions(text);
    let callers = callers(&functions, names);
    let kernels = functions.iter().filter(|function| function.is_kernel && function.calls(&callers));
    kernels.map(|function| function.name.to_owned()).collect()
}

/// The text without these functions, and without what calls them: for functions that no kernel reaches. The
/// compiler may find so late that a check never fails that the function which would report it stays.
pub fn without(text: &str, names: &[String]) -> String {
    let gone = callers(&functions(text), names);
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(line) = rest.split_inclusive('\n').next() {
        let head = line.strip_prefix(".extern ").unwrap_or(line).strip_prefix(".func");
        let is_gone = head.and_then(name).is_some_and(|name| gone.contains(name));
        let length = if is_gone { extent(rest) } else { line.len() };
        if !is_gone {
            kept.push_str(line);
        }
        rest = rest.get(length..).unwrap_or_default();
    }
    kept
}

/// These functions and all that call them, without kernels.
fn callers<'a>(functions: &[Function<'a>], names: &'a [String]) -> HashSet<&'a str> {
    let mut callers: HashSet<&str> = names.iter().map(String::as_str).collect();
    loop {
        let is_new = |function: &&Function<'a>| !function.is_kernel && !callers.contains(function.name);
        let new = functions.iter().filter(is_new).filter(|function| function.calls(&callers));
        let new: Vec<_> = new.map(|function| function.name).collect();
        if new.is_empty() {
            return callers;
        }
        callers.extend(new);
    }
}

/// The length of the declaration or function at the beginning of a text: a body reaches to a brace at the
/// beginning of a line.
fn extent(text: &str) -> usize {
    let last = match text.find(['{', ';']) {
        Some(open) if text[open..].starts_with('{') => text.find("\n}").map(|end| end + 1),
        declared => declared,
    };
    last.map_or(text.len(), |last| last + 1)
}

/// A function with a body.
struct Function<'a> {
    name: &'a str,
    is_kernel: bool,
    body: &'a str,
}

impl Function<'_> {
    /// Whether it calls one of these.
    fn calls(&self, names: &HashSet<&str>) -> bool {
        self.body.split(|c: char| !is_of_a_name(c)).any(|word| names.contains(word))
    }
}

/// The functions of a text that have a body.
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
            functions.push(Function {
                name,
                is_kernel: kind == ".visible .entry",
                body: rest.get(open..extent(rest)).unwrap_or_default(),
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
