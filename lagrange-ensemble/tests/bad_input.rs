//! Impossible input is reported, and finished parts stay.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use lagrange_ensemble::{Cells, Chance, Column, Ensemble, Error, Failure, Grid, Record, Study};
use lagrangian::prelude::*;

#[test]
fn numbers_that_are_none_are_results() {
    let folder = tempfile::tempdir().expect("a folder");
    let number = |index: u64| match index % 3 {
        0 => Ok([f64::NAN, 1.0]),
        1 => Ok([f64::INFINITY, -f64::NAN]),
        _ => Ok([0.0, -0.0]),
    };
    let study = || Study::new("numbers", 30, number).with_part_size(4).in_folder(folder.path());
    study().run().expect("the study runs");
    // A row that is NaN counts as the same when it is computed again.
    let table = study().run().expect("the study runs").expect("the study is complete");
    for (index, row) in table.to_vec().expect("rows").into_iter().enumerate() {
        let bits = |row: [f64; 2]| row.map(f64::to_bits);
        assert_eq!(row.map(bits), number(index as u64).map(bits), "{index}");
    }
    let (array, text) = (folder.path().join("x.npy"), folder.path().join("x.csv"));
    table.write(&array).expect("the table is written");
    table.write(&text).expect("the table is written");
    assert!(!folder.path().join("x.failures.csv").exists(), "no motion failed");
    let text = fs::read_to_string(text).expect("the table");
    assert_eq!(text.lines().skip(1).take(3).collect::<Vec<_>>(), ["0,,1.0,,", "1,inf,,,", "2,0.0,-0.0,,"]);
}

/// A record that forgets one of its values.
#[derive(Debug, PartialEq)]
struct Forgetful;

impl Record for Forgetful {
    fn columns() -> Vec<Column> {
        [f64::named("a"), f64::named("b")].concat()
    }

    fn store(&self, row: &mut Vec<u8>) {
        1.0.store(row);
    }

    fn load(_: &mut Cells<'_>) -> Self {
        Self
    }
}

#[test]
fn a_record_that_does_not_fill_its_columns_is_a_failure() {
    let table = Study::new("forgetful", 3, |_| Ok(Forgetful)).run().expect("the study runs");
    let expected = Failure::new("`Record::store` wrote 8 bytes, but `Record::columns` take 16");
    assert!(table.to_vec().expect("rows").iter().all(|row| row.as_ref() == Err(&expected)));
}

#[test]
#[cfg(target_os = "linux")]
fn a_folder_without_permission_is_an_error() {
    // Nobody may make folders there, not even the superuser.
    let folder = Path::new("/sys/kernel/lagrange");
    let study = Study::new("numbers", 10, |_| Ok(0.0)).in_folder(folder);
    let error = study.run().map(|_| ()).expect_err("nobody writes there");
    assert!(matches!(&error, Error::Io { doing: "make", path, .. } if path.starts_with(folder)), "{error}");
}

/// The process that the test below starts. By itself it does nothing.
#[test]
fn as_a_process_of_its_own() {
    let Ok(folder) = std::env::var("LAGRANGE_TABLE_FOLDER") else { return };
    let study = Study::new("numbers", 1000, |index| Ok(index as f64)).with_part_size(20);
    let table = study.in_folder(&folder).run().expect("the parts are small").expect("the study is complete");
    if let Err(error) = table.write(Path::new(&folder).join("numbers.csv")) {
        eprintln!("{error}");
        std::process::exit(3);
    }
}

#[test]
#[cfg(unix)]
fn a_disk_that_is_full_leaves_the_old_table_and_the_parts() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("numbers.csv");
    fs::write(&table, "old").expect("written");
    // Parts fit into 8 blocks of 512 bytes, or 1024 in some shells; the table does not.
    let full = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$0\" --exact as_a_process_of_its_own --nocapture"])
        .arg(std::env::current_exe().expect("this program"))
        .env("LAGRANGE_TABLE_FOLDER", folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .output()
        .expect("a process");
    let said = String::from_utf8_lossy(&full.stderr);
    assert_eq!(full.status.code(), Some(3), "{said}");
    assert!(said.contains("cannot write") && said.contains("numbers.csv"), "{said}");
    assert_eq!(fs::read_to_string(&table).expect("the old table"), "old");
    let entries = fs::read_dir(folder.path()).expect("a folder").flatten();
    let left = entries.filter(|entry| entry.path().extension().is_some_and(|end| end == "tmp"));
    assert_eq!(left.count(), 0, "an unfinished file is left");
    let study = Study::new("numbers", 1000, |index| Ok(index as f64)).with_part_size(20);
    assert!(study.in_folder(folder.path()).open().expect("the folder opens").missing().is_empty());
}

/// A block that slides until friction has stopped it.
struct Block {
    limit: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[friction(limit = self.limit)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn dry_friction_stops_each_block_where_it_must() {
    let start = |index| (Block { limit: 0.1 + index as f64 / 50.0 }, State::new([0.0], [1.0]));
    let table = |threads| {
        let study = Ensemble::new(100, start).ends("blocks", 20.0).with_threads(threads);
        study.run().expect("the study runs").to_vec().expect("rows")
    };
    let rows = table(1);
    assert_eq!(rows, table(3));
    for (index, row) in rows.into_iter().enumerate() {
        let end = row.expect("the block comes to rest");
        let way = 0.5 / (0.1 + index as f64 / 50.0);
        assert!(end.v == [0.0] && (end.q[0] - way).abs() < 1e-9 * way, "{index}: {end:?}, {way}");
    }
}

#[test]
fn a_grid_without_numbers_or_cells_is_an_error() {
    let most = u64::MAX;
    for (sides, at, what) in [
        ([(f64::NAN, 1.0, 2), (0.0, 1.0, 2)], 0, "finite"),
        ([(0.0, 1.0, 2), (0.0, f64::INFINITY, 2)], 1, "finite"),
        ([(0.0, 1.0, 2), (f64::NEG_INFINITY, 0.0, 2)], 1, "finite"),
        ([(0.0, 1.0, 0), (0.0, 1.0, 2)], 0, "no cells"),
        ([(0.0, 1.0, most), (0.0, 1.0, 2)], 1, "more cells"),
    ] {
        match Grid::new(sides) {
            Err(error @ Error::InvalidGrid { dimension, .. }) => {
                assert_eq!(dimension, at, "{error}");
                assert!(error.to_string().contains(what), "{error}");
            }
            found => panic!("{sides:?}: {found:?}"),
        }
    }
    // The largest grid has borders in descending order, and their difference overflows.
    let grid = Grid::new([(f64::MAX, -f64::MAX, most)]).expect("a grid");
    assert_eq!((grid.count(), grid.middle(most - 1)), (most, [-f64::MAX]));
    assert_eq!(Grid::new([(2.0, 2.0, 1)]).expect("a grid").middle(0), [2.0]);
    let nothing = Grid::new([]).expect("a grid");
    assert_eq!((nothing.count(), nothing.middle(0)), (1, []));
}

/// A mass on a spring.
struct Oscillator {
    stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Oscillator {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x.powi(2)
    }
}

#[test]
fn chance_without_numbers_makes_failures_and_no_results() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for [mean, deviation, from, to] in
            [[bad, 0.1, 1.0, 1.0], [1.0, bad, 1.0, 1.0], [1.0, 0.0, bad, 1.0], [1.0, 0.0, 1.0, bad]]
        {
            // Stiffness, coordinate or speed.
            for which in 0..3 {
                let start = |index| {
                    let mut chance = Chance::new(7, index);
                    let drawn = chance.normal(mean, deviation) + chance.between(from, to);
                    assert!(!drawn.is_finite(), "{drawn}");
                    let [stiffness, x, speed] = std::array::from_fn(|i| if i == which { drawn } else { 1.0 });
                    (Oscillator { stiffness }, State::new([x], [speed]))
                };
                let table = Ensemble::new(8, start).ends("ends", 1.0).run().expect("the study runs");
                for row in table.to_vec().expect("rows") {
                    assert!(row.is_err(), "{which} of {bad}: {row:?}");
                }
            }
        }
    }
}

#[test]
fn a_study_of_no_motions_has_no_rows() {
    let start = |_| (Oscillator { stiffness: 1.0 }, State::at_rest([1.0]));
    let table = Ensemble::new(0, start).ends("none", 1.0).run().expect("the study runs");
    assert_eq!((table.count(), table.to_vec().expect("rows").len()), (0, 0));
}
