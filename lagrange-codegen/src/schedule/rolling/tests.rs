//! Rolled programs compute the same as straight lines, and have as few loops as they should.

use std::collections::HashSet;

use super::{Place, Rolled, Source, Step, Surroundings, Walk, roll};
use crate::expr::{Unary, Variable};
use crate::number::Number;
use crate::schedule::{Instruction, Program, Slot};

fn coordinate(program: &mut Program, i: u32) -> Slot {
    program.push(Instruction::Variable(Variable::Coordinate(i)))
}

fn parameter(program: &mut Program, i: u32) -> Slot {
    program.push(Instruction::Variable(Variable::Parameter(i)))
}

fn place(program: &Program, slot: Slot) -> Option<Place> {
    match program.instruction(slot) {
        Instruction::Variable(Variable::Coordinate(index)) => Some(Place { array: 0, kind: 0, index }),
        _ => None,
    }
}

/// Rolls what the outputs need and follows every operand of the result. Returns it with the number of loops.
fn rolled(program: &Program, least: usize) -> (Rolled, usize) {
    let part: Vec<Slot> = program
        .needed(&program.outputs)
        .into_iter()
        .filter(|&slot| !program.instruction(slot).is_leaf())
        .collect();
    let around = Surroundings {
        place: &|slot| place(program, slot),
        is_kept: &|slot| program.outputs.contains(&slot),
        least,
    };
    let rolled = roll(program, &part, &around);
    let (mut known, mut stored) = (HashSet::new(), HashSet::new());
    let mut loops = 0;
    for step in &rolled.steps {
        match step {
            Step::One(slot, store) => {
                program.instruction(*slot).operands(|operand| {
                    assert!(
                        program.instruction(operand).is_leaf() || known.contains(&operand),
                        "{operand:?} is late"
                    );
                });
                if let Some((array, index)) = *store {
                    assert_eq!(rolled.arrays[array][index], *slot);
                    stored.insert((array, index as i64));
                }
                assert!(known.insert(*slot), "{slot:?} twice");
            }
            Step::Loop(of) => {
                loops += 1;
                assert!(of.count >= least);
                let mut inside = Vec::new();
                for i in 0..of.count {
                    for row in &of.rows {
                        let slot = row.slots[i];
                        let mut operands = Vec::new();
                        program.instruction(slot).operands(|operand| operands.push(operand));
                        assert_eq!(operands.len(), row.operands.len());
                        for (operand, source) in operands.into_iter().zip(&row.operands) {
                            match source {
                                Source::Same(same) => {
                                    assert_eq!(operand, *same);
                                    assert!(program.instruction(operand).is_leaf() || known.contains(same));
                                }
                                Source::Row(earlier) => assert_eq!(operand, of.rows[*earlier].slots[i]),
                                Source::Own(walk) => {
                                    assert_eq!(operand, rolled.arrays[walk.array][walk.at(i) as usize]);
                                    assert!(
                                        stored.contains(&(walk.array, walk.at(i))),
                                        "nothing is stored yet"
                                    );
                                }
                                Source::Given(walk) => {
                                    let Place { array, index, .. } = place(program, operand).unwrap();
                                    assert_eq!((walk.array, walk.at(i)), (array as usize, i64::from(index)));
                                }
                                Source::Numbers(numbers) => {
                                    assert_eq!(
                                        program.instruction(operand),
                                        Instruction::Literal(numbers[i])
                                    );
                                }
                            }
                        }
                        if let Some(walk) = row.store {
                            assert_eq!(rolled.arrays[walk.array][walk.at(i) as usize], slot);
                            stored.insert((walk.array, walk.at(i)));
                            inside.push(slot);
                        }
                    }
                }
                inside.into_iter().for_each(|slot| assert!(known.insert(slot), "{slot:?} twice"));
            }
        }
    }
    assert!(
        program.outputs.iter().all(|output| program.instruction(*output).is_leaf() || known.contains(output))
    );
    (rolled, loops)
}

/// The statements of the result: single ones, and rows of loops.
fn statements(rolled: &Rolled) -> usize {
    let of = |step: &Step| match step {
        Step::One(..) => 1,
        Step::Loop(of) => of.rows.len(),
    };
    rolled.steps.iter().map(of).sum()
}

#[test]
fn sums_along_a_chain_are_one_loop_each_way() {
    let mut program = Program::default();
    let length = parameter(&mut program, 0);
    let mut end = None;
    let mut ends = Vec::new();
    for i in 0..40 {
        let q = coordinate(&mut program, i);
        let sine = program.push(Instruction::Unary(Unary::Sin, q));
        let way = program.push(Instruction::Mul(length, sine));
        let next = end.map_or(way, |end| program.push(Instruction::Add(end, way)));
        end = Some(next);
        ends.push(next);
    }
    let mut load = ends[39];
    let mut loads = vec![load];
    for &end in ends.iter().rev().skip(1) {
        load = program.push(Instruction::Add(end, load));
        loads.push(load);
    }
    program.outputs = loads;
    let (rolled, loops) = rolled(&program, 8);
    assert_eq!(loops, 3, "{rolled:?}");
    // Besides four rows the ends of both ways: a sum of two products, and what reads that, are no sums like
    // the others.
    assert!(statements(&rolled) <= 4 + 6, "{}", statements(&rolled));
}

#[test]
fn what_alternates_is_a_loop_over_pairs() {
    let mut program = Program::default();
    let [g, h] = [0, 1].map(|i| parameter(&mut program, i));
    let mut sum = coordinate(&mut program, 0);
    let mut sums = Vec::new();
    for i in 1..61 {
        let q = coordinate(&mut program, i);
        let scaled = program.push(Instruction::Mul(sum, q));
        sum =
            program.push(if i % 2 == 0 { Instruction::Add(scaled, g) } else { Instruction::Sub(scaled, h) });
        sums.push(sum);
    }
    program.outputs = sums;
    let (rolled, loops) = rolled(&program, 8);
    assert_eq!(loops, 1, "{rolled:?}");
    assert!(statements(&rolled) < 4 + 8, "{rolled:?}");
}

#[test]
fn roles_that_take_turns_stand_in_arrays_of_their_own() {
    let mut program = Program::default();
    let mut outputs = Vec::new();
    let (mut a, mut b) = (coordinate(&mut program, 0), coordinate(&mut program, 1));
    for i in 1..30 {
        let [x, y] = [i, 30 + i].map(|i| coordinate(&mut program, i + 1));
        a = program.push(Instruction::Add(a, x));
        b = program.push(Instruction::Add(b, y));
        outputs.extend([a, b]);
    }
    program.outputs = outputs;
    let (rolled, loops) = rolled(&program, 8);
    assert_eq!((loops, rolled.arrays.len()), (1, 2), "{rolled:?}");
    let strides = rolled.steps.iter().filter_map(|step| match step {
        Step::Loop(of) => Some(of.rows.iter().filter_map(|row| row.store)),
        Step::One(..) => None,
    });
    assert!(strides.flatten().all(|Walk { stride, .. }| stride == 1), "{rolled:?}");
}

#[test]
fn an_instruction_without_a_like_parts_what_waits_for_it() {
    let mut program = Program::default();
    let mut sum = coordinate(&mut program, 0);
    let mut outputs = Vec::new();
    for i in 1..60 {
        let q = coordinate(&mut program, i);
        sum = program.push(Instruction::Add(sum, q));
        if i == 30 {
            sum = program.push(Instruction::Sqrt(sum));
        }
        outputs.push(sum);
    }
    program.outputs = outputs;
    let (_, loops) = rolled(&program, 8);
    assert_eq!(loops, 2);
}

#[test]
fn constants_that_differ_are_a_table() {
    let mut program = Program::default();
    let mass = parameter(&mut program, 0);
    for i in 1..20 {
        let number = program.push(Instruction::Literal(Number::integer(i * i)));
        let product = program.push(Instruction::Mul(number, mass));
        program.outputs.push(product);
    }
    let (rolled, loops) = rolled(&program, 8);
    assert_eq!((loops, rolled.steps.len()), (1, 1), "{rolled:?}");
}

/// Random programs with more or less in common from place to place.
#[test]
fn any_program_is_computed() {
    let mut seed = 1_u64;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    let mut loops_of_all = 0;
    for _ in 0..300 {
        let mut program = Program::default();
        let period = 1 + random(5);
        let pattern: Vec<[usize; 3]> =
            (0..period).map(|_| [random(6), 1 + random(7), 1 + random(9)]).collect();
        let mut slots: Vec<Slot> = (0..10).map(|i| coordinate(&mut program, i)).collect();
        for i in 0..90_usize {
            let [mut operation, a, b] = pattern[i % period];
            if random(40) == 0 {
                operation = random(6);
            }
            let q = coordinate(&mut program, 10 + i as u32);
            let [a, b] = [a, b].map(|back| slots[slots.len() - back]);
            slots.push(match operation {
                0 => program.push(Instruction::Add(a, b)),
                1 => program.push(Instruction::Mul(a, q)),
                2 => program.push(Instruction::Sub(q, b)),
                3 => program.push(Instruction::MulAdd(a, q, b)),
                4 => program.push(Instruction::Unary(Unary::Sin, a)),
                _ => {
                    let number = program.push(Instruction::Literal(Number::integer(i as i128)));
                    program.push(Instruction::Div(a, number))
                }
            });
        }
        program.outputs = slots.split_off(slots.len() - 1 - random(60));
        loops_of_all += rolled(&program, 2 + random(6)).1;
    }
    assert!(loops_of_all > 300, "{loops_of_all}");
}
