//! Tables are those of the motions themselves, whatever the number of threads.

use std::sync::atomic::{AtomicU64, Ordering};

use lagrange_ensemble::{Ensemble, Error, Failure, Kind, Record, Row, Study, Table};
use lagrangian::prelude::*;

/// A pendulum on a spring.
#[derive(Clone, Copy)]
struct Spring {
    stiffness: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Spring {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn energy_of_place(&self, q: &Coordinates) -> f64 {
        9.81 * q.y + 0.5 * self.stiffness * (q.x.powi(2) + q.y.powi(2))
    }
}

/// A bob on a rod, in Cartesian coordinates.
struct Rod {
    length: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Rod {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

/// A ball that falls on a floor.
struct Ball {
    restitution: f64,
}

#[lagrangian(coordinates = [y])]
impl Ball {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        10.0 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

fn springs(count: u64) -> Ensemble<impl Fn(u64) -> (Spring, State<f64, 2>) + Sync> {
    let start = |index| (Spring { stiffness: 20.0 + index as f64 }, State::at_rest([0.1, 0.2]));
    Ensemble::new(count, start).with_tolerance(1e-11)
}

fn rows<T: Record + PartialEq + std::fmt::Debug>(table: &Table<T>) -> Vec<Result<T, Failure>> {
    table.to_vec().expect("the rows are in memory")
}

#[test]
fn a_row_is_the_motion_itself_for_any_number_of_threads() {
    for threads in [1, 2, 7] {
        let table = springs(500).ends("ends", 1.5).with_threads(threads).run().expect("the study runs");
        assert_eq!(table.count(), 500);
        for (index, row) in rows(&table).into_iter().enumerate() {
            let spring = Spring { stiffness: 20.0 + index as f64 };
            let mut motion = spring.simulate(State::at_rest([0.1, 0.2])).with_tolerance(1e-11);
            assert_eq!(row, Ok(*motion.advance_to(1.5).expect("the motion goes on")), "{threads} threads");
        }
    }
}

#[test]
fn samples_are_those_of_the_motion() {
    let table = springs(70).samples::<5, _, _, _, _>("samples", 0.25).run().expect("the study runs");
    let names: Vec<_> = table.columns().iter().take(6).map(|column| column.name.as_str()).collect();
    assert_eq!(names, ["0_t", "0_q0", "0_q1", "0_v0", "0_v1", "1_t"]);
    let spring = Spring { stiffness: 89.0 };
    let mut motion = spring.simulate(State::at_rest([0.1, 0.2])).with_tolerance(1e-11);
    let expected: Vec<_> = motion.every(0.25).take(5).collect::<Result<_, _>>().expect("the motion goes on");
    assert_eq!(rows(&table)[69].clone().expect("no failure").to_vec(), expected);
}

#[test]
fn events_are_those_of_the_motion() {
    let guard = |state: &State<f64, 2>| state.q[0];
    let table =
        springs(70).event_times::<4, _, _, _, _, _>("events", guard, 1.0).run().expect("the study runs");
    for (index, row) in rows(&table).into_iter().enumerate() {
        // x = 0.1 cos(ω t).
        let quarter = std::f64::consts::FRAC_PI_2 / (20.0 + index as f64).sqrt();
        for (k, time) in row.expect("no failure").into_iter().enumerate() {
            let expected = Some(quarter * (2 * k + 1) as f64).filter(|t| *t < 1.0);
            assert_eq!(time.is_some(), expected.is_some());
            assert!((time.unwrap_or(0.0) - expected.unwrap_or(0.0)).abs() < 1e-9);
        }
    }
}

#[test]
fn constraints_and_contacts_are_motions_like_others() {
    let start = |index: u64| {
        let length = 1.0 + index as f64 / 100.0;
        let rod = Rod { length };
        let start = rod.consistent(State::new([length, 0.1], [0.0, 0.0]))?;
        Ok::<_, MotionError<f64>>((rod, start))
    };
    let table = Ensemble::new(100, start)
        .study("reactions", |motion| {
            motion.advance_to(1.0)?;
            Ok(motion.reactions().rod)
        })
        .run()
        .expect("the study runs");
    let rod = Rod { length: 1.42 };
    let mut motion = rod.simulate(rod.consistent(State::new([1.42, 0.1], [0.0, 0.0])).expect("near"));
    motion.advance_to(1.0).expect("the motion goes on");
    assert_eq!(rows(&table)[42], Ok(motion.reactions().rod));

    let start = |index| (Ball { restitution: index as f64 / 100.0 }, State::at_rest([0.2]));
    let table = Ensemble::new(100, start).ends("balls", 5.0).run().expect("the study runs");
    // From 0.2 m in 0.2 s; it rests after 0.2 s (1 + e) / (1 − e), for e = 0.9 after 3.8 s.
    assert!(rows(&table).into_iter().take(91).all(|end| end.is_ok_and(|end| end.v == [0.0])));
}

#[test]
fn a_motion_that_ends_in_an_error_is_a_row_with_its_cause() {
    let start = |index| {
        let stiffness = if index % 10 == 3 { f64::NAN } else { 20.0 };
        (Spring { stiffness }, State::at_rest([0.1, 0.0]))
    };
    let table = Ensemble::new(100, start).ends("ends", 1.0).run().expect("the study runs");
    for (index, row) in rows(&table).into_iter().enumerate() {
        match row {
            Ok(_) => assert_ne!(index % 10, 3),
            Err(failure) => {
                assert_eq!((index % 10, failure.t), (3, Some(0.0)));
                assert!(failure.to_string().contains("not a number"), "{failure}");
            }
        }
    }
    // A start that cannot be, too.
    let start = |_| Err::<(Rod, State<f64, 2>), _>(Failure::new("no such rod"));
    let table = Ensemble::new(3, start).ends("ends", 1.0).run().expect("the study runs");
    assert!(rows(&table).iter().all(|row| *row == Err(Failure::new("no such rod"))));
}

#[test]
fn a_panic_is_an_error_with_the_index() {
    let computed = AtomicU64::new(0);
    let study = Study::new("panics", 1_000_000, |index| {
        computed.fetch_add(1, Ordering::Relaxed);
        assert!(index != 77, "seventy-seven");
        Ok(index as f64)
    });
    for threads in [1, 3] {
        let error = study.clone_with(threads).run().expect_err("a motion panics");
        assert!(
            matches!(&error, Error::Panicked { index: 77, message } if message == "seventy-seven"),
            "{error}"
        );
    }
    assert!(computed.load(Ordering::Relaxed) < 100_000, "the study goes on after the panic");
}

/// A study by reference with other threads.
trait CloneWith<T> {
    fn clone_with(&self, threads: usize) -> Study<impl Row<T>, T>;
}

impl<F: Fn(u64) -> Result<T, Failure> + Sync, T: Record> CloneWith<T> for Study<F, T> {
    fn clone_with(&self, threads: usize) -> Study<impl Row<T>, T> {
        Study::new(self.name(), self.count(), |index| self.row(index)).with_threads(threads)
    }
}

#[test]
fn records_are_read_as_they_were_stored() {
    type Mixed = ((f64, f32), i64, i32, bool, [Option<f64>; 2], (u64, u32, usize));
    let value = |index: u64| {
        let x = index as f64;
        let mixed: Mixed = (
            (x, 0.5),
            -(index as i64),
            7,
            index.is_multiple_of(2),
            [None, Some(x)],
            (u64::MAX - index, u32::MAX, 3),
        );
        if index == 5 { Err(Failure::at(0.5, "five")) } else { Ok(mixed) }
    };
    let table = Study::new("mixed", 300, value).run().expect("the study runs");
    let kinds: Vec<_> = table.columns().iter().map(|column| (column.name.as_str(), column.kind)).collect();
    assert_eq!(
        kinds,
        [
            ("a_a", Kind::F64),
            ("a_b", Kind::F32),
            ("b", Kind::I64),
            ("c", Kind::I32),
            ("d", Kind::Bool),
            ("e0", Kind::F64),
            ("e1", Kind::F64),
            ("f_a", Kind::U64),
            ("f_b", Kind::U32),
            ("f_c", Kind::U64)
        ]
    );
    assert_eq!(rows(&table), (0..300).map(value).collect::<Vec<_>>());
}

#[test]
fn bad_names_and_shapes_are_errors() {
    let study = || Study::new("numbers", 6, |index| Ok((index as f64, 1.0)));
    for names in [vec!["a"], vec!["a", "a"], vec!["a", ""], vec!["a", "error"], vec!["a", "b", "c"]] {
        let error = study().with_columns(names).run().expect_err("bad names");
        assert!(matches!(error, Error::InvalidColumns { columns: 2, .. }), "{error}");
    }
    let table = study().with_columns(["a", "b"]).run().expect("the study runs");
    let error = table.shaped(&[2, 2]).expect_err("four are not six");
    assert!(matches!(error, Error::InvalidShape { count: 6, .. }), "{error}");
    let empty = Study::new("nothing", 0, |_| Ok(0.0)).run().expect("the study runs");
    assert_eq!(rows(&empty), []);
}
