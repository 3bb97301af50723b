//! `functions_in`: gaps, slip velocities and switching functions in one regime, over any numbers, and how
//! they are known along a series.
//!
//! A regime asks for few of them, and over numbers with bounds of their errors each operation is dear. So a
//! part that several functions share is computed if one of them is asked for, and the rest of a function if
//! that function is.

use std::collections::BTreeSet;

use quote::format_ident;

use super::super::block::Writer;
use super::super::body::{self, Source};
use super::super::names::Names;
use super::super::{Emission, scalar};
use super::NUMBER;
use crate::expr::{NodeId, Unary};
use crate::jets::Along;
use crate::regimes::Regimes;
use crate::schedule::{Instruction, Program, Slot, plan};
use crate::syntax::Scalar;

/// A set of functions, by their indices among the roots of a program.
type Functions = BTreeSet<usize>;

/// `functions_in`, and how the functions are known along a series.
pub(super) fn functions(emission: &Emission<'_>, switching: &Regimes) -> String {
    let numbers = Scalar::Generic(format_ident!("{NUMBER}"));
    let zero = scalar::zero(&numbers);
    let lists = [
        ("rows", &switching.guards.rows),
        ("fixed", &switching.guards.fixed[0]),
        ("kinks", &switching.guards.kinks),
    ];
    let roots: Vec<NodeId> = lists.iter().flat_map(|(_, nodes)| nodes.iter().copied()).collect();
    let flags =
        lists.iter().flat_map(|(list, nodes)| (0..nodes.len()).map(move |i| format!("__wanted.{list}[{i}]")));
    let flags: Vec<String> = flags.collect();
    let (rows, kinks) = (switching.rows(), switching.guards.kinks.len());
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
        "fn functions_in<{NUMBER}: lagrange::Real>(\n__in_regime: &Self::InRegime, \
         __number: impl ::core::ops::Fn({own}) -> {NUMBER}, \
         t: {NUMBER}, q: &[{NUMBER}; {count}], v: &[{NUMBER}; {count}], u: &[{NUMBER}; {given}], \
         __wanted: &lagrange::Wanted<{rows}, {kinks}>,\n) \
         -> lagrange::Functions<{NUMBER}, {rows}, {kinks}> {{\n{text}\
         lagrange::Functions {{ rows: [{of_rows}], fixed: [{fixed}], kinks: [{of_kinks}] }}\n}}\n{}",
        along(switching)
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

/// How the functions are known along a series; empty for systems without series.
fn along(switching: &Regimes) -> String {
    let Some(jets) = &switching.jets else { return String::new() };
    let (rows, kinks) = (switching.rows(), switching.guards.kinks.len());
    let mut along = jets.along.iter().map(|along| match along {
        Along::Constant => "lagrange::Along::Constant".to_owned(),
        Along::Series(index) => format!("lagrange::Along::Series({index})"),
        Along::Unknown => "lagrange::Along::Unknown".to_owned(),
    });
    let mut list = |count: usize| along.by_ref().take(count).collect::<Vec<_>>().join(", ");
    let [of_rows, forward, backward, of_kinks] = [rows, rows, rows, kinks].map(&mut list);
    let backward = if switching.is_directed {
        format!("const BACKWARD: [lagrange::Along; {rows}] = [{backward}];\n")
    } else {
        String::new()
    };
    format!(
        "const FOLLOWED: usize = {};\n\
         const ALONG: lagrange::Functions<lagrange::Along, {rows}, {kinks}> = \
         lagrange::Functions {{ rows: [{of_rows}], fixed: [{forward}], kinks: [{of_kinks}] }};\n{backward}",
        jets.followed.len()
    )
}
