//! Tracks: members of a class that stand in one array.
//!
//! A class may have members of several roles in turns. The members that a run fills, or that an operand walks
//! over, share an array. Sets without a common member have different arrays.

use super::Walk;
use super::classes::Reference;
use super::runs::Run;

/// Members of a class at equal distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Track {
    start: i64,
    step: i64,
    count: i64,
}

impl Track {
    fn of(start: i64, step: i64, count: usize) -> Track {
        let count = count as i64;
        match step {
            0 => Track { start, step: 1, count: 1 },
            1.. => Track { start, step, count },
            ..0 => Track { start: start + step * (count - 1), step: -step, count },
        }
    }

    fn end(self) -> i64 {
        self.start + self.step * (self.count - 1)
    }

    fn place_of(self, rank: i64) -> Option<i64> {
        let way = rank - self.start;
        (way >= 0 && rank <= self.end() && way % self.step == 0).then_some(way / self.step)
    }

    /// The track of both, if they have a common member.
    fn joined(self, other: Track) -> Option<Track> {
        let (short, long) = if self.count < other.count { (self, other) } else { (other, self) };
        let meet = (0..short.count).any(|i| long.place_of(short.start + i * short.step).is_some());
        if !meet {
            return None;
        }
        let start = self.start.min(other.start);
        let step = gcd(gcd(self.step, other.step), (self.start - other.start).abs());
        Some(Track { start, step, count: (self.end().max(other.end()) - start) / step + 1 })
    }
}

/// The tracks of all classes.
pub(super) struct Tracks {
    /// The tracks, by class.
    tracks: Vec<Vec<Track>>,
    /// The number of tracks of earlier classes, by class.
    before: Vec<usize>,
}

impl Tracks {
    /// Finds the tracks of the members that runs fill and read.
    pub fn of<'a>(classes: usize, runs: impl Iterator<Item = &'a Run>) -> Tracks {
        let mut tracks: Vec<Vec<Track>> = vec![Vec::new(); classes];
        let mut add = |class: usize, mut track: Track| {
            let tracks = &mut tracks[class];
            while let Some((place, joined)) =
                tracks.iter().enumerate().find_map(|(place, known)| Some((place, known.joined(track)?)))
            {
                tracks.swap_remove(place);
                track = joined;
            }
            tracks.push(track);
        };
        for run in runs {
            add(run.class, Track::of(run.first, run.stride, run.count));
            for (operand, &step) in run.operands.iter().zip(&run.steps) {
                if let Reference::Member(class, rank) = *operand {
                    add(class as usize, Track::of(rank, step, run.count));
                }
            }
        }
        let mut total = 0;
        let before = tracks.iter_mut().map(|tracks| {
            tracks.sort_unstable_by_key(|track| (track.start, track.step));
            total += tracks.len();
            total - tracks.len()
        });
        Tracks { before: before.collect(), tracks }
    }

    /// The number of tracks.
    pub fn count(&self) -> usize {
        self.before.last().zip(self.tracks.last()).map_or(0, |(before, tracks)| before + tracks.len())
    }

    /// The track of a member and its index there.
    pub fn place(&self, class: usize, rank: i64) -> Option<(usize, i64)> {
        let place =
            |(place, track): (usize, &Track)| Some((self.before[class] + place, track.place_of(rank)?));
        self.tracks[class].iter().enumerate().find_map(place)
    }

    /// The walk over members at equal distances.
    pub fn walk(&self, class: usize, rank: i64, step: i64) -> Option<Walk> {
        let (array, start) = self.place(class, rank)?;
        let track = self.tracks[class][array - self.before[class]];
        Some(Walk { array, start, stride: step / track.step })
    }

    /// The tracks of a class, each with the ranks of its members.
    pub fn ranks(&self, class: usize) -> impl Iterator<Item = (usize, impl Iterator<Item = i64>)> {
        let ranks = |track: &Track| {
            let Track { start, step, count } = *track;
            (0..count).map(move |i| start + i * step)
        };
        self.tracks[class]
            .iter()
            .enumerate()
            .map(move |(place, track)| (self.before[class] + place, ranks(track)))
    }
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_taken_apart_and_what_meets_is_joined() {
        let even = Track::of(0, 2, 10);
        assert_eq!(even.joined(Track::of(1, 2, 10)), None);
        assert_eq!(even.joined(Track::of(18, 2, 3)), Some(Track::of(0, 2, 12)));
        assert_eq!(even.joined(Track::of(9, -1, 4)), Some(Track::of(0, 1, 19)));
    }
}
