//! `functions_in`: gaps, slip velocities and switching functions in one regime, over any numbers.
//!
//! A regime asks for few of them, and over polynomials each operation is dear. So a part that several
//! functions share is computed if one of them is asked for, and the rest of a function if that function is.

use std::collections::BTreeSet;

use quote::format_ident;

use super::super::block::Writer;
use super::super::body::{self, Source};
use super::super::names::Names;
use super::super::{Emission, scalar};
use super::NUMBER;
use crate::expr::{NodeId, Unary, Variable};
use crate::regimes::Regimes;
use crate::schedule::{Instruction, Program, Slot, plan};
use crate::syntax::Scalar;

/// A set of functions, by their indices among the roots of a program.
type Functions = BTreeSet<usize>;

/// `functions_in`, and the coordinates and velocities that the functions depend on.
pub(super) fn functions(emission: &Emission<'_>, switching: &Regimes) -> String {
    let numbers = Scalar::Generic(format_ident!("{NUMBER}"));
    let zero = scalar::zero(&numbers);
    let lists =
        [("rows", &switching.rows_in), ("fixed", &switching.fixed_in[0]), ("kinks", &switching.kinks_in)];
    let roots: Vec<NodeId> = lists.iter().flat_map(|(_, nodes)| nodes.iter().copied()).collect();
    let flags =
        lists.iter().flat_map(|(list, nodes)| (0..nodes.len()).map(move |i| format!("__wanted.{list}[{i}]")));
    let flags: Vec<String> = flags.collect();
    let (rows, kinks) = (switching.rows_in.len(), switching.kinks_in.len());
    let model = &switching.model;
    let program = plan(&model.graph, &roots);
    let users = users(&program);
    // If there is one function, a call always asks for it.
    let is_alone = rows == 0 && kinks == 1;
    let where_asked = |functions: &Functions| {
        let flags: Vec<&str> = functions.iter().map(|&function| flags[function].as_str()).collect();
        flags.join(" || ")
    };

    let mut names = Names::new(model);
    let mut writer = Writer::new(model, &numbers, &program, &program.outputs, &[]);
    let mut text = String::new();
    for functions in shared(&program, &users) {
        let own: Vec<Slot> = program.slots().filter(|slot| users[slot.index()] == functions).collect();
        let (declared, statements) = writer.assigned(&own, &mut names);
        if statements.is_empty() {
            continue;
        }
        let list = |line: &dyn Fn(&String) -> String| declared.iter().map(line).collect::<String>();
        text.push_str(&list(&|name| format!("let {name}: {NUMBER};\n")));
        text.push_str(&format!(
            "if {} {{\n{}\n}} else {{\n{}}}\n",
            where_asked(&functions),
            statements.join("\n"),
            list(&|name| format!("{name} = {zero};\n"))
        ));
    }
    let mut values = Vec::new();
    for (&slot, flag) in program.outputs.iter().zip(&flags) {
        let statements = writer.part(&[slot], &mut names);
        let value = writer.output(slot);
        values.push(if is_alone || program.instruction(slot).is_leaf() || value == zero {
            text.extend(statements.iter().map(|statement| format!("{statement}\n")));
            value
        } else {
            format!("if {flag} {{\n{}\n{value}\n}} else {{\n{zero}\n}}", statements.join("\n"))
        });
    }
    let text = body::imported(body::prologue(model, &numbers, &writer.reads, Source::Numbers) + &text);
    let (each, of_kinks) = values.split_at(2 * rows);
    let [of_rows, fixed, of_kinks] = [&each[..rows], &each[rows..], of_kinks].map(|values| values.join(", "));
    let (own, count, given) = (&emission.scalar, emission.count(), emission.model.inputs.len());
    format!(
        "{}fn functions_in<{NUMBER}: lagrange::Real>(\n__in_regime: &Self::InRegime, __number: impl ::core::ops::Fn({own}) -> {NUMBER}, \
         t: {NUMBER}, q: &[{NUMBER}; {count}], v: &[{NUMBER}; {count}], u: &[{NUMBER}; {given}], \
         __wanted: &lagrange::Wanted<{rows}, {kinks}>,\n) -> lagrange::Functions<{NUMBER}, {rows}, {kinks}> {{\n{text}\
         lagrange::Functions {{ rows: [{of_rows}], fixed: [{fixed}], kinks: [{of_kinks}] }}\n}}\n",
        guarded(switching, &roots, count)
    )
}

/// The functions that each result contributes to. A sine and a cosine that are computed together count as
/// one.
fn users(program: &Program) -> Vec<Functions> {
    let mut users = vec![Functions::new(); program.len()];
    for (function, slot) in program.outputs.iter().enumerate() {
        users[slot.index()].insert(function);
    }
    let hand_down = |users: &mut Vec<Functions>| {
        let slots: Vec<Slot> = program.slots().collect();
        for &slot in slots.iter().rev() {
            let own = users[slot.index()].clone();
            program.instruction(slot).operands(|operand| users[operand.index()].extend(&own));
        }
    };
    hand_down(&mut users);
    let angle = |slot: Slot, function: Unary| match program.instruction(slot) {
        Instruction::Unary(own, angle) if own == function => Some(angle),
        _ => None,
    };
    for sine in program.slots() {
        let Some(of) = angle(sine, Unary::Sin) else { continue };
        if let Some(cosine) = program.slots().find(|&slot| angle(slot, Unary::Cos) == Some(of)) {
            let both: Functions = users[sine.index()].union(&users[cosine.index()]).copied().collect();
            (users[sine.index()], users[cosine.index()]) = (both.clone(), both);
        }
    }
    users
}

/// The sets of functions that share parts, the largest first: an operand contributes to all functions that
/// its users contribute to.
fn shared(program: &Program, users: &[Functions]) -> Vec<Functions> {
    let mut shared: Vec<Functions> = Vec::new();
    for slot in program.slots().filter(|&slot| !program.instruction(slot).is_leaf()) {
        let own = &users[slot.index()];
        if own.len() > 1 && !shared.contains(own) {
            shared.push(own.clone());
        }
    }
    shared.sort_by_key(|functions| std::cmp::Reverse(functions.len()));
    shared
}

/// `GUARDED`.
fn guarded(switching: &Regimes, roots: &[NodeId], count: usize) -> String {
    let model = &switching.model;
    let mut roots = roots.to_vec();
    if switching.coefficients.is_some() {
        roots.extend(&switching.fixed_in[1]);
    }
    let program = plan(&model.graph, &roots);
    let mut read = [vec![false; count], vec![false; count]];
    for slot in program.needed(&program.outputs) {
        match program.instruction(slot) {
            Instruction::Variable(Variable::Coordinate(i)) => read[0][i as usize] = true,
            Instruction::Variable(Variable::Velocity(i)) => read[1][i as usize] = true,
            Instruction::Variable(Variable::Entry(entry)) => {
                let first = model.orientations[entry as usize / 9];
                read[0][first..first + 3].fill(true);
            }
            _ => {}
        }
    }
    if read.iter().flatten().all(|&read| read) {
        return String::new();
    }
    format!("const GUARDED: [[bool; {count}]; 2] = {read:?};\n")
}
