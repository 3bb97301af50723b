//! A folder keeps what is finished, whatever happens, and its table has the same bytes however it came about.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use lagrange_ensemble::{Error, Failure, Row, StoredStudy, Study};
use lagrangian::prelude::*;

/// A pendulum.
struct Pendulum {
    rate: f64,
}

#[lagrangian(coordinates = [phi])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.phi.sin(), -q.phi.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.rate.powi(2) * self.bob(q).y
    }
}

const COUNT: u64 = 400;

/// A motion that may take its time; some have no result.
fn row(index: u64, pause: Duration) -> Result<(f64, bool), Failure> {
    sleep(pause);
    if index % 97 == 5 {
        return Err(Failure::at(0.5, format!("motion {index}, \"as agreed\"")));
    }
    let pendulum = Pendulum { rate: 1.0 + index as f64 / 100.0 };
    let mut motion = pendulum.simulate(State::at_rest([2.0]));
    Ok((motion.advance_to(1.0)?.q[0], index.is_multiple_of(2)))
}

fn study(folder: &Path, pause: u64) -> StoredStudy<impl Row<(f64, bool)>, (f64, bool)> {
    let pause = Duration::from_micros(pause);
    Study::new("pendulums", COUNT, move |index| row(index, pause))
        .with_columns(["angle", "even"])
        .with_part_size(11)
        .with_threads(2)
        .in_folder(folder)
}

/// The bytes of the table, as `.npy`, its failures, and CSV.
fn bytes(folder: &Path) -> [Vec<u8>; 3] {
    let table = study(folder, 0).run().expect("the study runs").expect("the study is complete");
    let files = ["x.npy", "x.failures.csv", "y.csv"].map(|name| folder.join(name));
    table.write(&files[0]).expect("the table is written");
    table.write(&files[2]).expect("the table is written");
    files.map(|file| fs::read(file).expect("the file is there"))
}

/// The same from memory, in one thread.
fn expected() -> [Vec<u8>; 3] {
    let folder = tempfile::tempdir().expect("a folder");
    let study = Study::new("pendulums", COUNT, |index| row(index, Duration::ZERO));
    let table = study.with_columns(["angle", "even"]).with_threads(1).run().expect("the study runs");
    let files = ["x.npy", "x.failures.csv", "y.csv"].map(|name| folder.path().join(name));
    table.write(&files[0]).expect("the table is written");
    table.write(&files[2]).expect("the table is written");
    files.map(|file| fs::read(file).expect("the file is there"))
}

fn parts(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.join("pendulums.parts")).into_iter().flatten();
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut parts: Vec<_> = paths.filter(|path| path.extension().is_some_and(|end| end == "npy")).collect();
    parts.sort();
    parts
}

/// The process that the tests below start and kill. By itself it does nothing.
#[test]
fn as_a_process_of_its_own() {
    let Ok(folder) = std::env::var("LAGRANGE_ENSEMBLE_FOLDER") else { return };
    match study(Path::new(&folder), 2000).run() {
        Ok(_) => {}
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(3);
        }
    }
}

/// Runs the process above by a shell, in which `$RUN` starts it.
fn process(folder: &Path, script: &str) -> Child {
    let run = "\"$0\" --exact as_a_process_of_its_own --nocapture";
    Command::new("sh")
        .args(["-c", &script.replace("$RUN", run)])
        .arg(std::env::current_exe().expect("this program"))
        .env("LAGRANGE_ENSEMBLE_FOLDER", folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("a process")
}

#[test]
#[cfg(unix)]
fn a_study_that_is_killed_goes_on_where_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    for kill in 1..=4_u64 {
        let before = parts(folder.path()).len();
        let mut child = process(folder.path(), "exec $RUN");
        // At different moments of writing.
        while parts(folder.path()).len() < before + 3 {
            assert!(child.try_wait().expect("a process").is_none(), "it ends before it is killed");
            sleep(Duration::from_micros(300 * kill));
        }
        child.kill().expect("kill -9");
        child.wait().expect("it is dead");
    }
    let kept = parts(folder.path());
    assert!(kept.len() >= 12 && kept.len() < 37, "{} parts", kept.len());
    let written = |path: &PathBuf| fs::metadata(path).and_then(|file| file.modified()).expect("a time");
    let times: Vec<_> = kept.iter().map(written).collect();
    assert!(bytes(folder.path()) == expected());
    assert_eq!(kept.iter().map(written).collect::<Vec<_>>(), times, "a finished part was computed again");
    let names = fs::read_dir(folder.path().join("pendulums.parts")).expect("the parts");
    let left = names.filter(|name| {
        name.as_ref().is_ok_and(|name| name.path().extension().is_some_and(|end| end == "tmp"))
    });
    assert_eq!(left.count(), 0, "unfinished files are left");
}

#[test]
fn shares_in_any_order_give_the_same_bytes() {
    let expected = expected();
    for (n, order) in [(1, vec![1]), (3, vec![2, 3, 1]), (5, vec![5, 1, 4, 2, 3])] {
        let folder = tempfile::tempdir().expect("a folder");
        for (place, k) in order.iter().enumerate() {
            let share = study(folder.path(), 0).part(*k, n).expect("a share");
            let table = share.run().expect("the share runs");
            assert_eq!(table.is_some(), place + 1 == order.len(), "share {k} of {n}");
        }
        assert!(bytes(folder.path()) == expected, "{n} shares");
    }
    // More jobs than parts: some have nothing to do.
    let folder = tempfile::tempdir().expect("a folder");
    let last = (1..=50)
        .rev()
        .filter_map(|k| study(folder.path(), 0).part(k, 50).expect("a share").run().expect("runs"));
    // Share 1 runs last and completes the study. Shares 38 to 50 have no part.
    assert_eq!(last.count(), 1);
    for (k, n) in [(0, 3), (4, 3), (1, 0)] {
        let error = study(folder.path(), 0).part(k, n).err().expect("no such share");
        assert!(matches!(error, Error::InvalidPart { part, of } if (part, of) == (k, n)), "{error}");
    }
}

#[test]
fn damaged_parts_are_computed_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let numbers = || {
        let number = |index| if index == 7 { Err(Failure::new("seven")) } else { Ok(index as f64) };
        Study::new("pendulums", 12, number).with_part_size(3).with_threads(1).in_folder(folder.path())
    };
    numbers().run().expect("the study runs");
    let paths = parts(folder.path());
    let content = fs::read(&paths[2]).expect("a part");
    // Cut off at a length, or one byte changed at a place, over the whole file.
    for place in (0..content.len()).step_by(7).chain(content.len() - 20..content.len()) {
        let mut changed = content.clone();
        changed[place] ^= 0x10;
        for spoiled in [&content[..place], &changed] {
            fs::write(&paths[2], spoiled).expect("written");
            let missing = numbers().open().expect("the folder opens").missing().to_vec();
            assert_eq!(missing, [2], "{} bytes, {place}", spoiled.len());
        }
    }
    fs::copy(&paths[1], &paths[2]).expect("copied");
    assert_eq!(numbers().open().expect("the folder opens").missing(), [2], "another part in its place");
    assert!(numbers().run().expect("the study runs").is_some());
    assert!(fs::read(&paths[2]).expect("a part") == content);

    let folder = tempfile::tempdir().expect("a folder");
    bytes(folder.path());
    let (parts, content) = (parts(folder.path()), &content);
    // Damage between the last run and the table.
    let table = study(folder.path(), 0).run().expect("the study runs").expect("the study is complete");
    fs::write(&parts[7], &content[..100]).expect("written");
    let before = fs::read(folder.path().join("x.npy")).expect("the table");
    let error = table.write(folder.path().join("x.npy")).expect_err("a part is cut off");
    assert!(matches!(&error, Error::Damaged { path, .. } if *path == parts[7]), "{error}");
    assert!(fs::read(folder.path().join("x.npy")).expect("the table") == before, "the old table is lost");
}

#[test]
fn another_study_in_the_folder_is_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let numbers =
        |count| Study::new("numbers", count, |index| Ok(index as f64)).with_part_size(10).with_key("a");
    let differs = |error: Error, expected: &str| {
        assert!(matches!(&error, Error::AnotherStudy { what, .. } if *what == expected), "{error}");
    };
    assert!(numbers(100).in_folder(folder.path()).run().expect("the study runs").is_some());
    let run = |error: Result<Option<_>, Error>| error.map(|_| ()).expect_err("another study");
    differs(run(numbers(101).in_folder(folder.path()).run()), "number of motions");
    differs(
        run(numbers(100).with_part_size(9).in_folder(folder.path()).run()),
        "number of motions in a part",
    );
    differs(run(numbers(100).with_key("b").in_folder(folder.path()).run()), "key");
    differs(run(numbers(100).with_columns(["x"]).in_folder(folder.path()).run()), "list of columns");
    // The same manifest, parts of another study.
    let other = tempfile::tempdir().expect("a folder");
    numbers(100).with_key("b").in_folder(other.path()).run().expect("the study runs");
    let part = "numbers.parts/0000000004.npy";
    fs::copy(other.path().join(part), folder.path().join(part)).expect("copied");
    differs(run(numbers(100).in_folder(folder.path()).run()), "key");
    fs::remove_file(folder.path().join(part)).expect("removed");
    // The same words, but another function.
    let changed = Study::new("numbers", 100, |index| Ok(2.0 + index as f64)).with_part_size(10).with_key("a");
    let error = run(changed.in_folder(folder.path()).run());
    assert!(matches!(error, Error::NotTheSame { .. }), "{error}");
    // A manifest of another version, and one that is none.
    let manifest = folder.path().join("numbers.json");
    let text = fs::read_to_string(&manifest).expect("the manifest");
    for newer in [text.replace("\"format\": 1", "\"format\": 2, \"more\": 0"), text.replace("0.1.0", "0.2.0")]
    {
        fs::write(&manifest, newer).expect("written");
        let error = run(numbers(100).in_folder(folder.path()).run());
        assert!(matches!(error, Error::AnotherVersion { .. }), "{error}");
    }
    fs::write(&manifest, "{").expect("written");
    let error = run(numbers(100).in_folder(folder.path()).run());
    assert!(matches!(&error, Error::Damaged { path, .. } if *path == manifest), "{error}");
    assert!(error.to_string().ends_with("delete it and run the study again, which goes on from its parts"));
    fs::remove_file(&manifest).expect("deleted");
    numbers(100).in_folder(folder.path()).run().expect("the study again");
    for name in ["", "a/b", "../a", ".a", "a b"] {
        let error = Study::new(name, 1, |_| Ok(0.0)).in_folder(folder.path()).run().expect_err("no name");
        assert!(matches!(error, Error::InvalidName { .. }), "{error}");
    }
}

#[test]
#[cfg(unix)]
fn a_disk_that_is_full_loses_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    // The limit of the size of files is reached by the first part: 1 block of 512 bytes.
    let full =
        process(folder.path(), "trap '' XFSZ; ulimit -f 1; exec $RUN").wait_with_output().expect("a process");
    let said = String::from_utf8_lossy(&full.stderr);
    assert_eq!(full.status.code(), Some(3), "{said}");
    assert!(said.contains("cannot write") && said.contains(".npy"), "{said}");
    assert!(bytes(folder.path()) == expected());
}

/// A file system in memory that is too small for the parts, and then grows. Where nobody may mount one, the
/// shell says so and the test above has to do.
#[test]
#[cfg(target_os = "linux")]
fn a_file_system_that_is_full_loses_nothing() {
    const NOT_HERE: i32 = 77;
    let folder = tempfile::tempdir().expect("a folder");
    let script = "mount -t tmpfs -o size=64k tmpfs \"$LAGRANGE_ENSEMBLE_FOLDER\" || exit 77
        cd \"$LAGRANGE_ENSEMBLE_FOLDER\"
        $RUN; test $? = 3 || exit 78
        find . -name '*.tmp' | grep -q . && exit 79
        find pendulums.parts -name '*.npy' -exec sha256sum {} + >\"$KEPT\"
        mount -o remount,size=4m . || exit 77
        $RUN || exit 80
        sha256sum --quiet -c \"$KEPT\" && cp -r pendulums.* \"$OUT\"";
    let out = tempfile::tempdir().expect("a folder");
    let kept = out.path().join("kept");
    let full = Command::new("unshare")
        .args(["--mount", "--map-root-user", "sh", "-c"])
        .arg(script.replace("$RUN", "\"$0\" --exact as_a_process_of_its_own --nocapture"))
        .arg(std::env::current_exe().expect("this program"))
        .envs([("LAGRANGE_ENSEMBLE_FOLDER", folder.path()), ("OUT", out.path()), ("KEPT", kept.as_path())])
        .stdout(Stdio::null())
        .output();
    let full = match full {
        Ok(full) if full.status.code() != Some(NOT_HERE) => full,
        other => return println!("no file system may be mounted here: {other:?}"),
    };
    let said = String::from_utf8_lossy(&full.stderr);
    assert!(full.status.success(), "{:?}: {said}", full.status);
    assert!(said.contains("cannot write") && said.contains("No space left"), "{said}");
    let kept = fs::read_to_string(kept).expect("what was kept").lines().count();
    assert!((1..37).contains(&kept), "{kept} parts were kept");
    assert!(bytes(out.path()) == expected());
}

#[test]
#[cfg(unix)]
fn a_folder_without_permission_to_write_keeps_what_is_there() {
    use std::os::unix::fs::PermissionsExt;

    let folder = tempfile::tempdir().expect("a folder");
    study(folder.path(), 0).part(1, 3).expect("a share").run().expect("the share runs");
    let before: Vec<_> = parts(folder.path()).iter().map(|part| fs::read(part).expect("a part")).collect();
    let allow = |mode| {
        for place in [folder.path().to_owned(), folder.path().join("pendulums.parts")] {
            fs::set_permissions(place, fs::Permissions::from_mode(mode)).expect("our folder");
        }
    };
    allow(0o555);
    // The superuser may write anywhere, so somebody else runs the program then.
    let script = "if [ -w \"$LAGRANGE_ENSEMBLE_FOLDER\" ]
        then exec setpriv --reuid=65534 --regid=65534 --clear-groups $RUN; else exec $RUN; fi";
    let denied = process(folder.path(), script).wait_with_output().expect("a process");
    allow(0o755);
    let said = String::from_utf8_lossy(&denied.stderr);
    assert_eq!(denied.status.code(), Some(3), "{said}");
    assert!(said.contains("cannot write") && said.contains("ermission denied"), "{said}");
    let after: Vec<_> = parts(folder.path()).iter().map(|part| fs::read(part).expect("a part")).collect();
    assert!(before == after);
    assert!(bytes(folder.path()) == expected());
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    fs::write(&file, "").expect("written");
    let error = study(&file.join("below"), 0).run().map(|_| ()).expect_err("a file is no folder");
    assert!(matches!(&error, Error::Io { doing: "make", .. }), "{error}");
    let table = Study::new("one", 1, |_| Ok(0.0)).run().expect("the study runs");
    let error = table.write(folder.path().join("none/x.npy")).expect_err("no such folder");
    assert!(matches!(&error, Error::Io { doing: "write", .. }), "{error}");
    let error = table.write(folder.path().join("x.txt")).expect_err("no such format");
    assert!(matches!(&error, Error::UnknownFormat { .. }), "{error}");
}

#[test]
fn a_panic_leaves_the_parts_that_are_finished() {
    let folder = tempfile::tempdir().expect("a folder");
    let number = |index: u64, limit: u64| {
        assert!(index < limit, "too large");
        Ok(index as f64)
    };
    let study = |limit| {
        let study = Study::new("numbers", 100, move |index| number(index, limit)).with_part_size(10);
        study.with_threads(1).in_folder(folder.path())
    };
    let error = study(55).run().map(|_| ()).expect_err("it panics");
    assert!(matches!(error, Error::Panicked { index: 55, .. }), "{error}");
    assert_eq!(study(100).open().expect("the folder opens").missing(), [5, 6, 7, 8, 9]);
    assert!(study(100).run().expect("the study runs").is_some());
}
