//! Loops made of runs, and their dependences.

use super::Surroundings;
use super::align::{Distance, aligned, distances, uneven};
use super::classes::Classes;
use super::runs::Run;
use super::units::connected;
use crate::schedule::{Program, Slot};

/// The rows of one loop.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The runs that an iteration computes one member of each.
    pub rows: Vec<Run>,
    /// Whether an iteration reads results of earlier ones.
    pub is_recurrent: bool,
}

/// The loops, and the instructions outside of loops.
pub(super) struct Parts {
    /// The loops.
    pub groups: Vec<Group>,
    /// The loop of each instruction.
    pub group: Vec<Option<u32>>,
    /// The instructions that each instruction reads.
    pub operands: Vec<Vec<usize>>,
}

impl Parts {
    /// Makes loops of runs. Runs that cannot be a loop become single instructions.
    pub fn of(program: &Program, classes: &Classes, mut runs: Vec<Run>, around: &Surroundings<'_>) -> Parts {
        let of = |&slot: &Slot| {
            let mut own = Vec::with_capacity(3);
            program.instruction(slot).operands(|operand| own.extend(classes.place(operand)));
            own
        };
        let operands: Vec<Vec<usize>> = classes.part.iter().map(of).collect();
        loop {
            let owner = owners(classes, runs.iter());
            let parts = connected(&edges(&operands, &owner, runs.len()));
            if !separate(classes, &parts, &mut runs) {
                let is_run = |unit: &u32| (*unit as usize) < runs.len();
                let groups = parts
                    .iter()
                    .filter(|part| part.iter().all(is_run))
                    .filter_map(|part| group(part, &runs, around.least))
                    .collect();
                return Parts::acyclic(classes, operands, groups);
            }
            runs.retain(|run| run.count >= around.least);
        }
    }

    /// Takes loops apart that depend on each other through single instructions.
    fn acyclic(classes: &Classes, operands: Vec<Vec<usize>>, mut groups: Vec<Group>) -> Parts {
        loop {
            let rows =
                groups.iter().enumerate().flat_map(|(g, group)| group.rows.iter().map(move |_| g as u32));
            let rows: Vec<u32> = rows.collect();
            let owner = owners(classes, groups.iter().flat_map(|group| &group.rows));
            let group: Vec<Option<u32>> =
                owner.into_iter().map(|row| row.map(|row| rows[row as usize])).collect();
            let parts = connected(&edges(&operands, &group, groups.len()));
            let waiting: Vec<u32> = parts
                .into_iter()
                .filter(|part| part.len() > 1)
                .flatten()
                .filter(|&unit| (unit as usize) < groups.len())
                .collect();
            if waiting.is_empty() {
                return Parts { groups, group, operands };
            }
            let mut place = 0..;
            groups.retain(|_| !place.next().is_some_and(|place| waiting.contains(&place)));
        }
    }

    /// The dependences of the loops, then of all instructions.
    pub fn edges(&self) -> Vec<Vec<u32>> {
        edges(&self.operands, &self.group, self.groups.len())
    }
}

/// Takes apart runs that cannot be rows of a loop as they are. Returns whether there were any.
///
/// A run that depends on itself through a single instruction is cut there into two runs. Runs whose members
/// go by in different steps are split, so that one iteration has several members of a run.
fn separate(classes: &Classes, parts: &[Vec<u32>], runs: &mut Vec<Run>) -> bool {
    let mut cuts: Vec<(usize, usize)> = Vec::new();
    let mut splits: Vec<(usize, usize)> = Vec::new();
    for part in parts.iter().filter(|part| part.len() > 1) {
        let (members, single): (Vec<usize>, Vec<usize>) =
            part.iter().map(|&unit| unit as usize).partition(|&unit| unit < runs.len());
        match single.iter().min() {
            Some(single) => cuts.extend(members.iter().map(|&run| (run, single - runs.len()))),
            None => {
                let all: Vec<&Run> = members.iter().map(|&run| &runs[run]).collect();
                splits.extend(uneven(&all).map(|(place, ways)| (members[place], ways)));
            }
        }
    }
    for &(run, place) in &cuts {
        let whole = &runs[run];
        let before = (0..whole.count).filter(|&i| whole.place(classes, i) < place).count();
        let rest = whole.part(before, whole.count - before);
        runs[run] = whole.part(0, before);
        runs.push(rest);
    }
    for &(run, ways) in &splits {
        let mut split = runs[run].split(ways);
        runs[run] = split.swap_remove(0);
        runs.extend(split);
    }
    !cuts.is_empty() || !splits.is_empty()
}

/// The loop of runs that depend on each other, or of one run.
fn group(part: &[u32], runs: &[Run], least: usize) -> Option<Group> {
    let members: Vec<&Run> = part.iter().map(|&run| &runs[run as usize]).collect();
    if let [run] = members[..]
        && distances(run, run).all(|distance| distance == Distance::Apart)
    {
        return Some(Group { rows: vec![run.clone()], is_recurrent: false });
    }
    Some(Group { rows: aligned(&members, least)?, is_recurrent: true })
}

/// The run of each instruction.
fn owners<'a>(classes: &Classes, runs: impl Iterator<Item = &'a Run>) -> Vec<Option<u32>> {
    let mut owner = vec![None; classes.part.len()];
    for (index, run) in (0_u32..).zip(runs) {
        (0..run.count).for_each(|member| owner[run.place(classes, member)] = Some(index));
    }
    owner
}

fn edges(operands: &[Vec<usize>], group: &[Option<u32>], groups: usize) -> Vec<Vec<u32>> {
    let unit = |place: usize| group[place].unwrap_or((groups + place) as u32);
    let mut edges: Vec<Vec<u32>> = vec![Vec::new(); groups + operands.len()];
    for (place, own) in operands.iter().enumerate() {
        edges[unit(place) as usize].extend(own.iter().map(|&operand| unit(operand)));
    }
    for own in &mut edges {
        own.sort_unstable();
        own.dedup();
    }
    edges
}
