//! [`Usage`]: the registers and the memory that a kernel takes, as the assembler reports them.

/// The registers and the memory that a thread of a kernel takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Usage {
    /// The kernel.
    pub kernel: String,
    /// Registers of 32 bits; there are at most 255.
    pub registers: u32,
    /// Bytes of the stack, with those of the functions that the kernel calls: memory for numbers that have no
    /// register, and for arrays that are indexed.
    pub stack: u32,
    /// Bytes written because registers are too few, in the functions that it calls, too.
    pub spill_stores: u32,
    /// Bytes read for the same reason.
    pub spill_loads: u32,
}

impl Usage {
    /// The kernels that `ptxas --verbose` tells of.
    pub fn of(report: &str) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        // The lines of the functions that a kernel calls follow its own.
        let mut about = "";
        for line in report.lines() {
            if let Some(name) = between(line, "Compiling entry function '", "'") {
                let kernel = name.to_owned();
                all.push(Self { kernel, registers: 0, stack: 0, spill_stores: 0, spill_loads: 0 });
            }
            if let Some((_, name)) = line.split_once("Function properties for ") {
                about = name.trim();
            }
            let Some(usage) = all.last_mut() else { continue };
            let number = |after: &str, name: &str| number_before(line, after, name);
            if let Some(stack) = number("", " bytes stack frame") {
                if about == usage.kernel {
                    usage.stack = stack;
                }
                usage.spill_stores += number(", ", " bytes spill stores").unwrap_or(0);
                usage.spill_loads += number(", ", " bytes spill loads").unwrap_or(0);
            }
            if let Some(registers) = number("Used ", " registers") {
                usage.registers = registers;
                usage.stack = number(", ", " bytes cumulative stack size").unwrap_or(usage.stack);
            }
        }
        all
    }
}

fn between<'a>(line: &'a str, before: &str, after: &str) -> Option<&'a str> {
    Some(line.split_once(before)?.1.split_once(after)?.0)
}

/// The number that stands before some words.
fn number_before(line: &str, after: &str, words: &str) -> Option<u32> {
    let (before, _) = line.split_once(words)?;
    let number = if after.is_empty() { before } else { before.rsplit_once(after)?.1 };
    number.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_of_the_assembler_is_read() {
        let report = "\
ptxas info    : 0 bytes gmem, 72 bytes cmem[4]
ptxas info    : Compiling entry function 'ends' for 'sm_90'
ptxas info    : Function properties for ends
    160 bytes stack frame, 0 bytes spill stores, 4 bytes spill loads
ptxas info    : Used 182 registers, used 1 barriers, 192 bytes cumulative stack size, 568 bytes cmem[0]
ptxas info    : Compile time = 12.5 ms
ptxas info    : Function properties for helper
    32 bytes stack frame, 8 bytes spill stores, 0 bytes spill loads
ptxas info    : Compiling entry function 'plain' for 'sm_90'
ptxas info    : Function properties for plain
    0 bytes stack frame, 0 bytes spill stores, 0 bytes spill loads
ptxas info    : Used 20 registers, used 0 barriers
";
        let ends =
            Usage { kernel: "ends".into(), registers: 182, stack: 192, spill_stores: 8, spill_loads: 4 };
        let plain =
            Usage { kernel: "plain".into(), registers: 20, stack: 0, spill_stores: 0, spill_loads: 0 };
        assert_eq!(Usage::of(report), [ends, plain]);
    }
}
