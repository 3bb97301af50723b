//! Alignment of runs that depend on each other, as the rows of one loop.

use super::classes::Reference;
use super::runs::Run;

/// The distance of the members that an operand reads from their readers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Distance {
    /// The operand reads none of them.
    Apart,
    /// Member `i` of the reader reads member `i + c`.
    Constant(i64),
    /// The distance changes from member to member.
    Varying,
}

/// The distance for one operand of a run and another run, or the run itself.
pub(super) fn distance(reader: &Run, operand: usize, read: &Run) -> Distance {
    let Reference::Member(class, rank) = reader.operands[operand] else { return Distance::Apart };
    if class as usize != read.class {
        return Distance::Apart;
    }
    let step = reader.steps[operand];
    if step != read.stride {
        let hits = (0..reader.count as i64).any(|i| read.place_of(rank + i * step).is_some());
        return if hits { Distance::Varying } else { Distance::Apart };
    }
    let way = rank - read.first;
    let distance = way / step;
    let overlap = distance < read.count as i64 && distance + reader.count as i64 > 0;
    if way % step == 0 && overlap { Distance::Constant(distance) } else { Distance::Apart }
}

/// The first run that must be split so that runs whose members go by in different steps fit into one loop,
/// and the number of runs that it is split into.
pub(super) fn uneven(runs: &[&Run]) -> Option<(usize, usize)> {
    for (user, reader) in runs.iter().enumerate() {
        for (place, read) in runs.iter().enumerate() {
            for (operand, step) in reader.steps.iter().map(|step| step.unsigned_abs() as usize).enumerate() {
                if distance(reader, operand, read) != Distance::Varying || step == 0 {
                    continue;
                }
                let stride = read.stride.unsigned_abs() as usize;
                match (stride % step, step % stride) {
                    (0, _) if stride > step => return Some((user, stride / step)),
                    (_, 0) if step > stride => return Some((place, step / stride)),
                    _ => {}
                }
            }
        }
    }
    None
}

/// The distances for all operands of one run and another run.
pub(super) fn distances<'a>(reader: &'a Run, read: &'a Run) -> impl Iterator<Item = Distance> + 'a {
    (0..reader.operands.len()).map(move |operand| distance(reader, operand, read))
}

/// The parts of runs that are rows of one loop: member `i` of each belongs to iteration `i`. `None` if no
/// alignment exists or fewer than `least` iterations have a member of each.
///
/// A member must not belong to an earlier iteration than its operands. These conditions are a system of
/// difference constraints; longest paths give the least solution (Bellman and Ford; Cormen et al.,
/// "Introduction to Algorithms", 4th ed., ch. 22).
pub(super) fn aligned(runs: &[&Run], least: usize) -> Option<Vec<Run>> {
    let mut constraints = Vec::new();
    for (user, reader) in runs.iter().enumerate() {
        for (place, read) in runs.iter().enumerate() {
            for distance in distances(reader, read) {
                match distance {
                    Distance::Apart => {}
                    Distance::Constant(distance) => constraints.push((user, place, distance)),
                    Distance::Varying => return None,
                }
            }
        }
    }
    let mut delay = vec![0_i64; runs.len()];
    let mut passes = 0;
    while {
        let mut moved = false;
        for &(user, place, distance) in &constraints {
            let earliest = delay[place] + distance;
            if delay[user] < earliest {
                delay[user] = earliest;
                moved = true;
            }
        }
        moved
    } {
        passes += 1;
        if passes > runs.len() {
            return None;
        }
    }
    let start = delay.iter().copied().max()?;
    let end = runs.iter().zip(&delay).map(|(run, delay)| delay + run.count as i64).min()?;
    let count = usize::try_from(end - start).ok().filter(|&count| count >= least)?;
    Some(runs.iter().zip(delay).map(|(run, delay)| run.part((start - delay) as usize, count)).collect())
}
