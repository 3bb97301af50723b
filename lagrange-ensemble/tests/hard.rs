//! Linkages, impacts and dry friction are motions like others: ends, samples, events and reductions of
//! studies are those of the motions themselves.

use std::fmt::Debug;

use lagrange_ensemble::{Ensemble, Failure, Record, Row, Study};
use lagrangian::prelude::*;

/// A crank, a coupler and a rocker between two bearings: two constraints close the loop.
#[derive(Clone, Copy)]
struct FourBar;

#[lagrangian(coordinates = [crank, coupler, rocker])]
impl FourBar {
    fn along(length: f64, angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin()) * length
    }

    /// Where the crank bears the coupler.
    #[point(mass = 1.0)]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        Self::along(1.0, q.crank)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn bar(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (self.pin(q) + Self::along(1.25, q.coupler), q.coupler)
    }

    #[point(mass = 1.0)]
    fn end(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(3.0, 0.0) + Self::along(2.0, q.rocker)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.pin(q).y + 2.0 * self.bar(q).0.y + self.end(q).y)
    }

    #[holonomic]
    fn loop_closure(&self, q: &Coordinates) -> Vector2<f64> {
        self.pin(q) + Self::along(2.5, q.coupler) - self.end(q)
    }
}

/// A ball that falls on a floor. Dry friction stops its horizontal motion, in the air too.
#[derive(Clone, Copy)]
struct Ball {
    restitution: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Ball {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        10.0 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(limit = 0.5)]
    fn air(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// From the middle of the crank's range, with rates of the crank from −6 to 5.5 rad/s.
fn linkage(index: u64) -> Result<(FourBar, State<f64, 3>), MotionError<f64>> {
    let near = State::new([1.2, 0.35, 1.9], [0.5 * index as f64 - 6.0, 0.0, 0.0]);
    Ok((FourBar, FourBar.consistent(near)?))
}

fn ball(index: u64) -> (Ball, State<f64, 2>) {
    (Ball { restitution: 0.9 * index as f64 / 40.0 }, State::new([0.0, 0.2], [0.025 * index as f64, 0.0]))
}

/// The rows of a study, which one thread and three leave alike.
fn rows<F: Row<T>, T: Record + PartialEq + Debug>(
    study: impl Fn() -> Study<F, T>,
) -> Vec<Result<T, Failure>> {
    let with = |threads| {
        let table = study().with_threads(threads).run().expect("the study runs");
        table.to_vec().expect("the rows are in memory")
    };
    let rows = with(1);
    assert_eq!(rows, with(3));
    rows
}

#[test]
fn linkages_are_motions_like_others() {
    let linkages = || Ensemble::new(24, linkage).with_tolerance(1e-10);
    let ends = rows(|| linkages().ends("ends", 2.0));
    let samples = rows(|| linkages().samples::<5, _, _, _, _>("samples", 0.5));
    let level = |state: &State<f64, 3>| state.q[0].sin();
    let events = rows(|| linkages().event_times::<2, _, _, _, _, _>("events", level, 2.0));
    let energies = rows(|| {
        linkages().study("energies", |motion| {
            let before = motion.energy();
            motion.advance_to(2.0)?;
            let [x, y] = motion.reactions().loop_closure;
            Ok((before, motion.energy(), x.hypot(y)))
        })
    });
    let mut turned = 0;
    for (index, end) in ends.into_iter().enumerate() {
        let (system, start) = linkage(index as u64).expect("near the loop");
        let motion = || system.simulate(start).with_tolerance(1e-10);
        let end = end.expect("the linkage moves on");
        assert_eq!(end, *motion().advance_to(2.0).expect("the linkage moves on"), "{index}");
        let gap =
            FourBar::along(1.0, end.q[0]) + FourBar::along(2.5, end.q[1]) - FourBar::along(2.0, end.q[2]);
        assert!((gap - Vector2::new(3.0, 0.0)).norm() < 1e-14, "{index}: {gap:?}");
        let states: Vec<_> = motion().every(0.5).take(5).collect::<Result<_, _>>().expect("states");
        assert_eq!(samples[index].clone().map(Vec::from), Ok(states), "{index}");
        let times: Vec<_> =
            motion().events(level, 2.0).take(2).map(|event| event.expect("found").state.t).collect();
        let found = events[index].clone().expect("events are looked for");
        assert_eq!(found.into_iter().flatten().collect::<Vec<_>>(), times, "{index}");
        turned += times.len();
        let (before, after, reaction) = energies[index].clone().expect("the linkage moves on");
        // Forty steps, each with an error of 1e-10 relative to 160 J: weights lifted by metres, and ½ m v² at
        // 6 m/s.
        assert!(
            (after - before).abs() < 40.0 * 1e-10 * 160.0 && reaction > 0.0,
            "{index}: {before}, {after}"
        );
    }
    assert!(turned > 24, "the cranks pass the level only {turned} times");
}

#[test]
fn impacts_and_friction_are_motions_like_others() {
    let balls = || Ensemble::new(40, ball);
    let ends = rows(|| balls().ends("ends", 6.0));
    let samples = rows(|| balls().samples::<4, _, _, _, _>("samples", 0.1));
    let hops = |state: &State<f64, 2>| state.v[1];
    let events = rows(|| balls().event_times::<3, _, _, _, _, _>("events", hops, 0.3));
    let ways = rows(|| {
        balls().study("ways", |motion| {
            motion.advance_to(6.0)?;
            Ok(motion.state().q[0])
        })
    });
    for index in 0..40 {
        let (system, start) = ball(index as u64);
        let motion = || system.simulate(start);
        let end = ends[index].clone().expect("the ball comes to rest");
        assert_eq!(end, *motion().advance_to(6.0).expect("the ball comes to rest"), "{index}");
        // The ball falls 0.2 m in 0.2 s, so it rests after 0.2 s (1 + e) / (1 − e). Friction stops it after
        // v²/2a.
        let rate = 0.025 * index as f64;
        assert!(end.v == [0.0; 2] && end.q[1].abs() < 1e-9, "{index}: {end:?}");
        assert!((end.q[0] - rate * rate).abs() < 1e-9, "{index}: {end:?}");
        assert_eq!(ways[index], Ok(end.q[0]), "{index}");
        let states: Vec<_> = motion().every(0.1).take(4).collect::<Result<_, _>>().expect("states");
        assert_eq!(samples[index].clone().map(Vec::from), Ok(states), "{index}");
        let times: Vec<_> =
            motion().events(hops, 0.3).take(3).map(|event| event.expect("found").state.t).collect();
        let found = events[index].clone().expect("events are looked for");
        assert_eq!(found.into_iter().flatten().collect::<Vec<_>>(), times, "{index}");
    }
}
