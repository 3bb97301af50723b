//! One thread of a processor, instruction by instruction.

use std::collections::HashMap;

use crate::text::{Function, Instruction, Module, Operand, size_of};
use crate::value::{masked, operation};

/// A limit above the instructions of any motion here.
const MOST: u64 = 1 << 32;

/// Where memory begins: no address is zero.
const BASE: usize = 1 << 16;

/// A module with its memory.
#[derive(Debug)]
pub struct Machine {
    module: Module,
    memory: Vec<u8>,
    names: HashMap<String, u64>,
    /// Instructions since the beginning.
    pub count: u64,
}

/// The state of a function that is running.
struct Frame<'a> {
    function: &'a Function,
    registers: Vec<u64>,
    variables: HashMap<&'a str, u64>,
    thread: u64,
}

impl Machine {
    /// A machine with the constants of a module.
    ///
    /// # Errors
    /// If a constant holds the address of a name that is no constant.
    pub fn new(module: Module) -> Result<Self, String> {
        let mut machine =
            Self { module: Module::default(), memory: vec![0; BASE], names: HashMap::new(), count: 0 };
        for constant in &module.constants {
            let at = machine.allocate(constant.bytes.len());
            machine.memory[at as usize..][..constant.bytes.len()].copy_from_slice(&constant.bytes);
            machine.names.insert(constant.name.clone(), at);
        }
        for constant in &module.constants {
            for (place, name) in &constant.addresses {
                let address = *machine.names.get(name).ok_or_else(|| format!("no constant {name}"))?;
                machine.write(machine.names[&constant.name] + *place as u64, address, 8)?;
            }
        }
        machine.module = module;
        Ok(machine)
    }

    /// Runs the kernel of a name in one thread of the first block, which has 64. Arguments are words.
    pub fn run(&mut self, kernel: &str, thread: u64, arguments: &[u64]) -> Result<(), String> {
        let places: Vec<u64> = arguments
            .iter()
            .map(|argument| {
                let at = self.allocate(8);
                self.write(at, *argument, 8).map(|()| at)
            })
            .collect::<Result<_, _>>()?;
        let bottom = self.memory.len();
        // The functions do not change while they run.
        let module = std::mem::take(&mut self.module);
        let result = self.call(&module, kernel, &places, &[], thread);
        self.module = module;
        self.memory.truncate(bottom);
        result
    }

    /// Room in memory.
    pub fn allocate(&mut self, size: usize) -> u64 {
        let at = self.memory.len().next_multiple_of(64);
        self.memory.resize(at + size, 0);
        at as u64
    }

    /// A number in memory.
    pub fn read(&self, at: u64, size: usize) -> Result<u64, String> {
        let place =
            usize::try_from(at).ok().filter(|at| *at >= BASE).and_then(|at| self.memory.get(at..at + size));
        let place = place.ok_or_else(|| format!("memory at {at:#x} is read"))?;
        let mut bytes = [0; 8];
        bytes[..size].copy_from_slice(place);
        Ok(u64::from_le_bytes(bytes))
    }

    /// Writes a number.
    pub fn write(&mut self, at: u64, word: u64, size: usize) -> Result<(), String> {
        let place = usize::try_from(at)
            .ok()
            .filter(|at| *at >= BASE)
            .and_then(|at| self.memory.get_mut(at..at + size));
        place
            .ok_or_else(|| format!("memory at {at:#x} is written"))?
            .copy_from_slice(&word.to_le_bytes()[..size]);
        Ok(())
    }

    fn call(
        &mut self,
        module: &Module,
        name: &str,
        arguments: &[u64],
        results: &[u64],
        thread: u64,
    ) -> Result<(), String> {
        let function = module.functions.get(name).ok_or_else(|| format!("no function {name}"))?;
        let bottom = self.memory.len();
        let mut frame =
            Frame { function, registers: vec![0; function.registers], variables: HashMap::new(), thread };
        frame.variables.extend(function.parameters.iter().map(String::as_str).zip(arguments.iter().copied()));
        frame.variables.extend(function.results.iter().map(String::as_str).zip(results.iter().copied()));
        for (name, size) in &function.variables {
            frame.variables.insert(name, self.allocate(*size));
        }
        let mut at = 0;
        while let Some(instruction) = function.code.get(at) {
            self.count += 1;
            if self.count > MOST {
                return Err("it does not end".to_owned());
            }
            at += 1;
            if instruction.guard.is_some_and(|(register, holds)| (frame.registers[register] != 0) != holds) {
                continue;
            }
            match self
                .step(module, &mut frame, instruction)
                .map_err(|error| format!("{error} in {instruction:?}"))?
            {
                Next::Following => {}
                Next::Place(place) => at = place,
                Next::End => break,
            }
        }
        self.memory.truncate(bottom);
        Ok(())
    }

    fn step(
        &mut self,
        module: &Module,
        frame: &mut Frame<'_>,
        instruction: &Instruction,
    ) -> Result<Next, String> {
        let parts: Vec<&str> = instruction.parts.iter().map(String::as_str).collect();
        let kind = *parts.last().ok_or("no name")?;
        match (parts[0], instruction.operands.as_slice()) {
            ("ret" | "exit", []) => return Ok(Next::End),
            ("trap", _) => return Err("a trap".to_owned()),
            ("bra", [Operand::Name(label)]) => return frame.place(label).map(Next::Place),
            ("brx", [index, Operand::Name(table)]) => {
                let index = self.value(frame, index)? as usize;
                let table = frame.function.tables.get(table).ok_or("no table")?;
                return frame.place(table.get(index).ok_or("beyond a table")?).map(Next::Place);
            }
            ("call", operands) => {
                let (results, name, arguments) = match operands {
                    [Operand::Vector(results), Operand::Name(name), Operand::Vector(arguments)] => {
                        (&results[..], name, &arguments[..])
                    }
                    [Operand::Name(name), Operand::Vector(arguments)] => (&[][..], name, &arguments[..]),
                    [Operand::Name(name)] => (&[][..], name, &[][..]),
                    _ => return Err("a call by address".to_owned()),
                };
                let places = |list: &[Operand]| {
                    list.iter().map(|one| self.value(frame, one)).collect::<Result<Vec<_>, _>>()
                };
                let (results, arguments) = (places(results)?, places(arguments)?);
                self.call(module, name, &arguments, &results, frame.thread)?;
            }
            ("ld", [to, Operand::Memory(base, offset)]) => {
                let at = self.value(frame, base)?.wrapping_add(*offset);
                let size = size_of(kind)?;
                for (place, register) in registers(to)?.into_iter().enumerate() {
                    let word = self.read(at + (place * size) as u64, size)?;
                    // A signed number fills its register.
                    let signed = kind.starts_with('s') && size < 8;
                    let unused = 64 - 8 * size as u32;
                    frame.registers[register] = if signed {
                        ((word << unused).cast_signed() >> unused).cast_unsigned()
                    } else {
                        word
                    };
                }
            }
            ("st", [Operand::Memory(base, offset), from]) => {
                let at = self.value(frame, base)?.wrapping_add(*offset);
                let size = size_of(kind)?;
                let values = if let Operand::Vector(values) = from {
                    values.as_slice()
                } else {
                    std::slice::from_ref(from)
                };
                for (place, value) in values.iter().enumerate() {
                    let word = self.value(frame, value)?;
                    self.write(at + (place * size) as u64, word, size)?;
                }
            }
            // Into two halves, and out of them.
            ("mov", [Operand::Vector(halves), from]) => {
                let word = self.value(frame, from)?;
                let size = 8 * size_of(kind)? / halves.len();
                for (place, half) in halves.iter().enumerate() {
                    // The register of a half that nobody reads is missing.
                    if let Some(&register) = registers(half)?.first() {
                        frame.registers[register] = word >> (place * size) & (u64::MAX >> (64 - size));
                    }
                }
            }
            ("mov", [Operand::Register(to), Operand::Vector(halves)]) => {
                let size = 8 * size_of(kind)? / halves.len();
                let mut word = 0;
                for (place, half) in halves.iter().enumerate() {
                    word |= (self.value(frame, half)? & (u64::MAX >> (64 - size))) << (place * size);
                }
                frame.registers[*to] = word;
            }
            (_, [Operand::Register(to), from @ ..]) => {
                let values = from.iter().map(|one| self.value(frame, one)).collect::<Result<Vec<_>, _>>()?;
                let result = operation(&parts, &values)?;
                // The last part of these names is the type of what they take, not that of the result.
                let plain = parts[0] != "setp"
                    && !matches!(parts.get(1), Some(&"wide"))
                    && parts[0] != "cvt"
                    && parts[0] != "cvta";
                frame.registers[*to] = if plain && parts[0] != "clz" && parts[0] != "popc" {
                    masked(result, kind)?
                } else {
                    result
                };
            }
            _ => return Err("no such instruction".to_owned()),
        }
        Ok(Next::Following)
    }

    fn value(&self, frame: &Frame<'_>, operand: &Operand) -> Result<u64, String> {
        match operand {
            Operand::Register(register) => Ok(frame.registers[*register]),
            Operand::Constant(bits) => Ok(*bits),
            Operand::Name(name) => match name.as_str() {
                "%tid.x" => Ok(frame.thread),
                "%ntid.x" => Ok(64),
                "%ctaid.x" => Ok(0),
                name => frame
                    .variables
                    .get(name)
                    .or_else(|| self.names.get(name))
                    .copied()
                    .ok_or_else(|| format!("no name {name}")),
            },
            Operand::Memory(..) | Operand::Vector(_) => Err("no value".to_owned()),
        }
    }
}

/// How a thread goes on.
enum Next {
    Following,
    Place(usize),
    End,
}

impl Frame<'_> {
    fn place(&self, label: &str) -> Result<usize, String> {
        self.function.labels.get(label).copied().ok_or_else(|| format!("no label {label}"))
    }
}

/// The registers of an operand that is written.
fn registers(operand: &Operand) -> Result<Vec<usize>, String> {
    match operand {
        Operand::Register(register) => Ok(vec![*register]),
        Operand::Name(name) if name == "_" => Ok(Vec::new()),
        Operand::Vector(several) => {
            several.iter().map(registers).collect::<Result<Vec<_>, _>>().map(|all| all.concat())
        }
        _ => Err("no register".to_owned()),
    }
}
