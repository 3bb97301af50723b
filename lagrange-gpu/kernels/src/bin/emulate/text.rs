//! PTX as data: functions, their instructions with numbered registers and places, and constants in memory.

use std::collections::HashMap;

/// An operand of an instruction.
#[derive(Clone, Debug)]
pub enum Operand {
    /// A register, by number.
    Register(usize),
    /// The bits of a constant.
    Constant(u64),
    /// A name: of a label, a function, a variable or a special register.
    Name(String),
    /// Memory: at a register or a variable, and how far behind it.
    Memory(Box<Operand>, u64),
    /// Several values.
    Vector(Vec<Operand>),
}

/// An instruction.
#[derive(Clone, Debug)]
pub struct Instruction {
    /// The predicate that must hold, by the number of its register, or must not.
    pub guard: Option<(usize, bool)>,
    /// The parts of the name, as in `add`, `rn`, `f64`.
    pub parts: Vec<String>,
    /// The operands, in order.
    pub operands: Vec<Operand>,
}

/// A kernel or a function.
#[derive(Clone, Debug, Default)]
pub struct Function {
    /// The names of the results.
    pub results: Vec<String>,
    /// The names of the parameters.
    pub parameters: Vec<String>,
    /// Variables of its own, with their sizes: the stack and the parameters of its calls.
    pub variables: HashMap<String, usize>,
    /// The instructions.
    pub code: Vec<Instruction>,
    /// Indices of the instructions that labels mark.
    pub labels: HashMap<String, usize>,
    /// Labels that a branch by index chooses from.
    pub tables: HashMap<String, Vec<String>>,
    /// How many registers it has.
    pub registers: usize,
}

/// A module of PTX, the contents of one file.
#[derive(Debug, Default)]
pub struct Module {
    /// Functions with a body.
    pub functions: HashMap<String, Function>,
    /// Constants.
    pub constants: Vec<Constant>,
}

/// A constant in memory.
#[derive(Debug, Default)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Where the addresses of other constants stand in it, and their names.
    pub addresses: Vec<(usize, String)>,
}

/// Bytes of a value of a type, as in `f64`.
pub fn size_of(kind: &str) -> Result<usize, String> {
    match kind.trim_start_matches(|c: char| c.is_ascii_alphabetic()) {
        "8" => Ok(1),
        "16" => Ok(2),
        "32" => Ok(4),
        "64" => Ok(8),
        _ => Err(format!("no type: {kind}")),
    }
}

/// Reads a module.
pub fn module(text: &str) -> Result<Module, String> {
    let text: String =
        text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n");
    let mut module = Module::default();
    let mut rest = text.as_str();
    while let Some(at) = rest.find([';', '{']) {
        let (head, tail) = rest.split_at(at);
        let of_function = head.contains(".entry") || head.contains(".func");
        if !of_function && (head.contains(".global") || head.contains(".const")) {
            let end = rest.find(';').ok_or("a constant without end")?;
            module.constants.push(constant(&rest[..end])?);
            rest = &rest[end + 1..];
        } else if of_function && tail.starts_with('{') {
            let end = tail.find("\n}").ok_or("a function without end")?;
            let (name, function) = function(head, &tail[1..end])?;
            module.functions.insert(name, function);
            rest = &tail[end + 2..];
        } else {
            rest = &tail[1..];
        }
    }
    Ok(module)
}

/// The name before a bracket or the end, as in `.b8 name[16]`, and what stands in the bracket.
fn named(text: &str) -> (String, &str) {
    let last = text.split_whitespace().last().unwrap_or_default();
    match last.split_once('[') {
        Some((name, length)) => (name.to_owned(), length.trim_end_matches(']')),
        None => (last.to_owned(), "1"),
    }
}

/// Bytes of the elements of a declaration.
fn element(text: &str) -> Result<usize, String> {
    let kinds = text.split_whitespace().filter_map(|word| word.strip_prefix('.'));
    kinds.filter_map(|kind| size_of(kind).ok()).next_back().ok_or(format!("no type: {text}"))
}

fn constant(text: &str) -> Result<Constant, String> {
    let (head, values) = text.split_once('=').unwrap_or((text, ""));
    let ((name, length), size) = (named(head), element(head)?);
    let mut constant = Constant { name, ..Constant::default() };
    for value in values.split([',', '{', '}']).map(str::trim).filter(|value| !value.is_empty()) {
        let address = value.strip_prefix("generic(").and_then(|name| name.strip_suffix(')'));
        let word: u64 = match address.filter(|_| size == 8) {
            Some(name) => {
                constant.addresses.push((constant.bytes.len(), name.to_owned()));
                0
            }
            None => value.parse().map_err(|_| format!("no number in a constant: {value}"))?,
        };
        constant.bytes.extend_from_slice(&word.to_le_bytes()[..size]);
    }
    let length: usize = length.parse().map_err(|_| format!("no length: {head}"))?;
    constant.bytes.resize(length * size, 0);
    Ok(constant)
}

/// The text in parentheses, and the rest.
fn parentheses(text: &str) -> Option<(&str, &str)> {
    text.trim_start().strip_prefix('(')?.split_once(')')
}

/// The text behind the braces of calls, which mean nothing here.
fn beyond_braces(text: &str) -> &str {
    text.trim_start_matches(|c: char| c.is_whitespace() || c == '{' || c == '}')
}

fn function(head: &str, body: &str) -> Result<(String, Function), String> {
    let parameters =
        |list: &str| list.split(',').filter(|one| !one.trim().is_empty()).map(|one| named(one).0).collect();
    let mut function = Function::default();
    let mut rest = head.split_once(".entry").or_else(|| head.split_once(".func")).ok_or("no function")?.1;
    if let Some((results, after)) = parentheses(rest) {
        (function.results, rest) = (parameters(results), after);
    }
    let (name, rest) = rest.split_once('(').ok_or("a function without parameters")?;
    function.parameters = parameters(rest.split_once(')').ok_or("parameters without end")?.0);
    let mut numbers = HashMap::new();
    for statement in body.split(';') {
        let mut statement = beyond_braces(statement);
        while let Some((label, after)) = statement.split_once(':').filter(|(label, _)| label.starts_with('$'))
        {
            function.labels.insert(label.to_owned(), function.code.len());
            statement = beyond_braces(after);
            if let Some(targets) = statement.strip_prefix(".branchtargets") {
                let targets = targets.split(',').map(|label| label.trim().to_owned()).collect();
                function.tables.insert(label.to_owned(), targets);
            }
        }
        let statement = statement.trim();
        if statement.starts_with(".local") || statement.starts_with(".param") {
            let ((name, length), size) = (named(statement), element(statement)?);
            let length: usize = length.parse().map_err(|_| format!("no length: {statement}"))?;
            // Calls declare their parameters under the same names again and again.
            let variable = function.variables.entry(name).or_default();
            *variable = length.max(1).saturating_mul(size).max(*variable);
        } else if !statement.is_empty() && !statement.starts_with('.') {
            function.code.push(instruction(statement, &mut numbers)?);
        }
    }
    function.registers = numbers.len();
    Ok((name.trim().to_owned(), function))
}

fn instruction(text: &str, numbers: &mut HashMap<String, usize>) -> Result<Instruction, String> {
    let mut guard = None;
    let mut rest = text;
    if let Some(guarded) = text.strip_prefix('@') {
        let (register, after) =
            guarded.split_once(char::is_whitespace).ok_or("a guard without instruction")?;
        let holds = !register.starts_with('!');
        guard = Some((number(register.trim_start_matches('!'), numbers), holds));
        rest = after.trim_start();
    }
    let (name, operands) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    let parts = name.split('.').map(str::to_owned).collect();
    let operands = split(operands).into_iter().map(|one| operand(one, numbers)).collect::<Result<_, _>>()?;
    Ok(Instruction { guard, parts, operands })
}

/// The parts between commas that stand in no bracket.
fn split(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '(' | '{' | '[' => depth += 1,
            ')' | '}' | ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(text[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(text[start..].trim());
    parts.retain(|part| !part.is_empty());
    parts
}

fn number(register: &str, numbers: &mut HashMap<String, usize>) -> usize {
    let next = numbers.len();
    *numbers.entry(register.to_owned()).or_insert(next)
}

fn operand(text: &str, numbers: &mut HashMap<String, usize>) -> Result<Operand, String> {
    let inner = |text: &str| text[1..text.len() - 1].trim().to_owned();
    if text.starts_with(['{', '(']) {
        let parts = inner(text);
        return Ok(Operand::Vector(
            split(&parts).into_iter().map(|one| operand(one, numbers)).collect::<Result<_, _>>()?,
        ));
    }
    if text.starts_with('[') {
        let place = inner(text);
        let (base, offset) = place.split_once('+').unwrap_or((&place, "0"));
        let offset: i64 = offset.parse().map_err(|_| format!("no offset: {text}"))?;
        return Ok(Operand::Memory(Box::new(operand(base, numbers)?), offset.cast_unsigned()));
    }
    let hexadecimal =
        |digits: &str| u64::from_str_radix(digits, 16).map_err(|_| format!("no number: {text}"));
    if let Some(digits) =
        text.strip_prefix("0d").or_else(|| text.strip_prefix("0f")).or_else(|| text.strip_prefix("0x"))
    {
        // Some end in `U`, since they are unsigned.
        return Ok(Operand::Constant(hexadecimal(digits.trim_end_matches('U'))?));
    }
    if text.contains(['|', '!']) {
        return Err(format!("an operand that is not known here: {text}"));
    }
    let specials = ["%tid", "%ntid", "%ctaid"];
    if text.starts_with('%') && !specials.iter().any(|special| text.starts_with(&format!("{special}."))) {
        return Ok(Operand::Register(number(text, numbers)));
    }
    if let Ok(number) = text.parse::<i64>() {
        return Ok(Operand::Constant(number.cast_unsigned()));
    }
    Ok(text.parse().map_or_else(|_| Operand::Name(text.to_owned()), Operand::Constant))
}
