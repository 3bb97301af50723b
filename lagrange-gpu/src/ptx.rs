//! [`Ptx`]: the text of built kernels, and the facts about it that need no processor.

use std::fs;
use std::path::Path;

use crate::calls::{reaching, without};
use crate::error::Error;

/// How sums and products are rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// Each operation rounds once: rows have the same bits as on a CPU.
    Exact,
    /// A product and the sum that it is part of round once together: mostly faster, with other last digits.
    Fused,
}

/// The text of kernels, which a driver compiles for its processor. Nothing in it is unresolved.
#[derive(Clone, Debug)]
pub struct Ptx {
    text: String,
}

impl Ptx {
    /// Kernels in a file.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::NotPtx`], and [`Error::Unresolved`] if a kernel can panic or allocate.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = fs::read_to_string(path);
        Self::new(text.map_err(|source| Error::Unreadable { path: path.to_owned(), source })?)
    }

    /// Kernels in a text, for example of `include_str!`.
    ///
    /// # Errors
    /// [`Error::NotPtx`], and [`Error::Unresolved`] if a kernel can panic or allocate.
    pub fn new(text: impl Into<String>) -> Result<Self, Error> {
        let ptx = Self { text: text.into() };
        if ptx.kernels().next().is_none() || ptx.directive(".target").is_none() || ptx.text.contains('\0') {
            return Err(Error::NotPtx);
        }
        let names: Vec<_> = declared(&ptx.text, ".extern .func").map(str::to_owned).collect();
        if names.is_empty() {
            return Ok(ptx);
        }
        let kernels = reaching(&ptx.text, &names);
        if kernels.is_empty() {
            return Ok(Self { text: without(&ptx.text, &names) });
        }
        Err(Error::Unresolved { names, kernels })
    }

    /// The names of the kernels.
    pub fn kernels(&self) -> impl Iterator<Item = &str> {
        declared(&self.text, ".visible .entry")
    }

    /// The processors that the kernels are for, and later ones, as in `sm_90`.
    pub fn target(&self) -> &str {
        self.directive(".target").unwrap_or_default()
    }

    /// The version of the language, as in `7.8`.
    pub fn version(&self) -> &str {
        self.directive(".version").unwrap_or_default()
    }

    /// The number of operations that may not round as a CPU does. They are fused, or may be fused by the
    /// driver, or are approximate or without subnormal numbers. Kernels have none as they are built.
    pub fn unlike_a_cpu(&self) -> usize {
        let instructions = self.text.lines().filter_map(|line| line.split_whitespace().next());
        let unlike = |name: &&str| {
            name.starts_with("fma.") || name.contains(".approx") || name.contains(".ftz") || contracts(name)
        };
        instructions.filter(unlike).count()
    }

    /// The text for one kind of arithmetic. An operation that names its rounding stays alone; the compiler of
    /// the driver fuses those that do not.
    pub fn text(&self, arithmetic: Arithmetic) -> String {
        if arithmetic == Arithmetic::Exact {
            return self.text.clone();
        }
        let mut fused = String::with_capacity(self.text.len());
        for line in self.text.split_inclusive('\n') {
            let name = line.split_whitespace().next().unwrap_or_default();
            match name.strip_suffix(".rn.f64").or_else(|| name.strip_suffix(".rn.f32")) {
                Some(operation @ ("add" | "sub" | "mul")) => {
                    let scalar = &name[name.len() - 4..];
                    fused.push_str(&line.replacen(name, &format!("{operation}{scalar}"), 1));
                }
                _ => fused.push_str(line),
            }
        }
        fused
    }

    /// The word after a directive.
    fn directive(&self, name: &str) -> Option<&str> {
        let line = self.text.lines().find_map(|line| line.trim_start().strip_prefix(name))?;
        line.split([',', ' ', '\t']).find(|word| !word.is_empty())
    }
}

/// Whether the compiler of the driver may fuse this operation with another: it does not name its rounding.
fn contracts(name: &str) -> bool {
    ["add", "sub", "mul"]
        .iter()
        .any(|operation| name.strip_prefix(operation).is_some_and(|kind| kind == ".f64" || kind == ".f32"))
}

/// The names that follow a declaration, behind the result in parentheses if there is one.
fn declared<'a>(text: &'a str, declaration: &'a str) -> impl Iterator<Item = &'a str> {
    text.match_indices(declaration).filter_map(move |(at, _)| name(text.get(at + declaration.len()..)?))
}

/// The name at the beginning of a text, behind the result in parentheses if there is one.
pub(crate) fn name(text: &str) -> Option<&str> {
    let mut rest = text.trim_start();
    if rest.starts_with('(') {
        rest = rest.split_once(')')?.1.trim_start();
    }
    rest.split(|c: char| !is_of_a_name(c)).next().filter(|name| !name.is_empty())
}

/// Whether a character may stand in a name.
pub(crate) fn is_of_a_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || c == '$'
}

#[cfg(test)]
mod tests {
    use super::*;

    const KERNELS: &str = "
.version 7.8
.target sm_90, debug
.visible .entry ends(
	.param .u64 ends_param_0
)
{
	mul.rn.f64 	%fd3, %fd1, %fd2;
	add.rn.f64 	%fd4, %fd3, %fd1;
	div.rn.f64 	%fd5, %fd4, %fd1;
	mul.lo.s64 	%rd1, %rd2, %rd3;
	mul.rn.f32 	%f3, %f1, %f2;
	ret;
}
";

    #[test]
    fn a_text_tells_its_kernels_and_its_target() -> Result<(), Error> {
        let ptx = Ptx::new(KERNELS)?;
        assert_eq!(ptx.kernels().collect::<Vec<_>>(), ["ends"]);
        assert_eq!((ptx.target(), ptx.version(), ptx.unlike_a_cpu()), ("sm_90", "7.8", 0));
        Ok(())
    }

    #[test]
    fn what_is_no_ptx_is_refused() {
        for text in ["", "int main() {}", ".version 7.8\n.target sm_90\n"] {
            assert!(matches!(Ptx::new(text), Err(Error::NotPtx)), "{text}");
        }
        assert!(matches!(Ptx::read("nowhere.ptx"), Err(Error::Unreadable { .. })));
    }

    #[test]
    fn kernels_that_can_panic_are_refused() {
        let text = format!(
            "{}.extern .func this_kernel_can_panic\n()\n;\n\
             .extern .func (.param .b64 result) malloc\n(\n)\n;\n",
            KERNELS.replace("\tret;", "\tcall.uni malloc, ();\n\tret;")
        );
        let names = match Ptx::new(text) {
            Err(Error::Unresolved { names, .. }) => names,
            other => panic!("{other:?}"),
        };
        assert_eq!(names, ["this_kernel_can_panic", "malloc"]);
    }

    #[test]
    fn sums_and_products_may_fuse_and_nothing_else() -> Result<(), Error> {
        let exact = Ptx::new(KERNELS)?;
        assert_eq!(exact.text(Arithmetic::Exact), KERNELS);
        let fused = exact.text(Arithmetic::Fused);
        for operation in ["mul.f64 \t%fd3", "add.f64 \t%fd4", "div.rn.f64", "mul.lo.s64", "mul.f32 \t%f3"] {
            assert!(fused.contains(operation), "{operation} is not in {fused}");
        }
        assert_eq!(Ptx::new(fused)?.unlike_a_cpu(), 3);
        Ok(())
    }
}
