//! Any number of ranks leaves the same bytes, also after one of them is killed. Needs `mpirun`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// The example beside this test, which cargo builds with it.
fn program() -> PathBuf {
    let test = std::env::current_exe().expect("this program");
    let profile = test.ancestors().nth(2).expect("the folder of the profile");
    profile.join("examples/pendulums")
}

fn ranks(number: usize, folder: &Path) -> Child {
    Command::new("mpirun")
        .args(["--oversubscribe", "-n", &number.to_string()])
        .arg(program())
        .arg(folder)
        .args(["2500", "3"])
        // Tests often run as root, in a container.
        .envs([("OMPI_ALLOW_RUN_AS_ROOT", "1"), ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("mpirun: scripts/mpi.sh installs it")
}

fn table(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("pendulums.npy")).expect("the table")
}

fn parts(folder: &Path) -> usize {
    let names = fs::read_dir(folder.join("pendulums.parts")).into_iter().flatten().flatten();
    names.filter(|name| name.path().extension().is_some_and(|end| end == "npy")).count()
}

/// The processes of a program with this folder among their words.
fn processes(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir("/proc").expect("processes").flatten() {
        let words = fs::read(entry.path().join("cmdline")).unwrap_or_default();
        let words: Vec<_> = words.split(|byte| *byte == 0).map(String::from_utf8_lossy).collect();
        let is_rank = words.first().is_some_and(|word| word.ends_with("examples/pendulums"));
        if is_rank && words.iter().any(|word| Path::new(word.as_ref()) == folder) {
            found.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    found
}

#[test]
fn any_number_of_ranks_and_a_kill_leave_the_same_bytes() {
    let one = tempfile::tempdir().expect("a folder");
    assert!(ranks(1, one.path()).wait().expect("mpirun").success());
    let expected = table(one.path());
    for number in [2, 4] {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(ranks(number, folder.path()).wait().expect("mpirun").success(), "{number} ranks");
        assert!(table(folder.path()) == expected, "{number} ranks");
    }

    let folder = tempfile::tempdir().expect("a folder");
    let mut job = ranks(4, folder.path());
    while parts(folder.path()) < 5 {
        assert!(job.try_wait().expect("mpirun").is_none(), "it ends before a rank is killed");
        sleep(Duration::from_millis(1));
    }
    let victim = processes(folder.path()).pop().expect("ranks at work");
    assert!(Command::new("kill").args(["-9", &victim]).status().expect("kill").success());
    assert!(!job.wait().expect("mpirun").success());
    let kept = parts(folder.path());
    assert!((5..40).contains(&kept), "{kept} parts");
    assert!(ranks(3, folder.path()).wait().expect("mpirun").success());
    assert!(table(folder.path()) == expected, "after a kill");
}
