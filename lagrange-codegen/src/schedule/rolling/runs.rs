//! Members of a class whose operands move on by equal steps.

use super::classes::{Classes, Reference};

/// The number of members behind the first one that are tried as the second. Members of several roles may take
/// turns in a class.
const AHEAD: usize = 4;

/// Members of a class whose operands move on by equal steps.
#[derive(Clone, Debug)]
pub(super) struct Run {
    /// The class.
    pub class: usize,
    /// The rank of the first member.
    pub first: i64,
    /// The difference of the ranks of successive members.
    pub stride: i64,
    /// The number of members.
    pub count: usize,
    /// The operands of the first member.
    pub operands: Vec<Reference>,
    /// The steps by which the operands move on from member to member.
    pub steps: Vec<i64>,
}

impl Run {
    /// The rank of a member.
    pub fn rank(&self, place: usize) -> i64 {
        self.first + place as i64 * self.stride
    }

    /// The instruction that a member is.
    pub fn place(&self, classes: &Classes, member: usize) -> usize {
        classes.members[self.class][self.rank(member) as usize] as usize
    }

    /// The number of the member with a rank, if there is one.
    pub fn place_of(&self, rank: i64) -> Option<usize> {
        let way = rank - self.first;
        if self.stride == 0 || way % self.stride != 0 {
            return None;
        }
        usize::try_from(way / self.stride).ok().filter(|&place| place < self.count)
    }

    /// Runs of every `ways`-th member.
    pub fn split(&self, ways: usize) -> Vec<Run> {
        let by = ways as i64;
        let each = |from: usize| Run {
            stride: by * self.stride,
            steps: self.steps.iter().map(|step| by * step).collect(),
            ..self.part(from, (self.count - from).div_ceil(ways))
        };
        (0..ways.min(self.count)).map(each).collect()
    }

    /// The run of `count` members after the first `from`.
    pub fn part(&self, from: usize, count: usize) -> Run {
        let by = from as i64;
        let operands =
            self.operands.iter().zip(&self.steps).map(|(operand, step)| moved(*operand, by * step)).collect();
        Run { first: self.rank(from), count, operands, ..self.clone() }
    }
}

/// All runs of at least `least` members.
pub(super) fn find(classes: &Classes, least: usize) -> Vec<Run> {
    let mut runs = Vec::new();
    for (class, members) in classes.members.iter().enumerate() {
        if members.len() < least {
            continue;
        }
        let references = |rank: usize| &classes.references[members[rank] as usize];
        let mut taken = vec![false; members.len()];
        for first in 0..members.len() {
            if taken[first] || members.len() - first < least {
                continue;
            }
            let mut longest: Option<Run> = None;
            for second in first + 1..members.len().min(first + 1 + AHEAD) {
                if taken[second] {
                    continue;
                }
                let Some(steps) = steps(references(first), references(second)) else { continue };
                let stride = second - first;
                let follows = |last: usize| {
                    let next = last + stride;
                    let goes_on = || {
                        let pairs = references(last).iter().zip(references(next)).zip(&steps);
                        pairs.into_iter().all(|((a, b), step)| moved(*a, *step) == *b)
                    };
                    next < members.len() && !taken[next] && goes_on()
                };
                let (mut count, mut last) = (2, second);
                while follows(last) {
                    (count, last) = (count + 1, last + stride);
                }
                if count >= least && longest.as_ref().is_none_or(|run| run.count < count) {
                    longest = Some(Run {
                        class,
                        first: first as i64,
                        stride: stride as i64,
                        count,
                        operands: references(first).clone(),
                        steps,
                    });
                }
            }
            if let Some(run) = longest {
                (0..run.count).for_each(|place| taken[run.rank(place) as usize] = true);
                runs.push(run);
            }
        }
    }
    runs
}

/// The steps from the operands of one instruction to those of another. `None` if they differ in more than
/// ranks, indices and constants.
fn steps(from: &[Reference], to: &[Reference]) -> Option<Vec<i64>> {
    from.iter()
        .zip(to)
        .map(|pair| match pair {
            (Reference::Same(a), Reference::Same(b)) => (a == b).then_some(0),
            (Reference::Number, Reference::Number) => Some(0),
            (Reference::Member(a, i), Reference::Member(b, j))
            | (Reference::Element(a, i), Reference::Element(b, j)) => (a == b).then_some(j - i),
            _ => None,
        })
        .collect()
}

fn moved(reference: Reference, by: i64) -> Reference {
    match reference {
        Reference::Member(class, rank) => Reference::Member(class, rank + by),
        Reference::Element(array, index) => Reference::Element(array, index + by),
        same @ (Reference::Same(_) | Reference::Number) => same,
    }
}
