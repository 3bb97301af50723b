//! The build that is measured: optimised across crates, for the present processor, with the peers.
//!
//! heyoka compiles for the processor it runs on, so ours must be too before times are compared. What
//! `cargo run` builds is compiled for any processor and without the peers; [`enter`] builds the program once
//! more and runs that instead.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, exit};

/// What the second build is for; it is set while that build compiles.
const BUILT_FOR: Option<&str> = option_env!("BENCHMARKS_BUILT_FOR");

/// Returns in the right build. From what `cargo run` builds, it builds and runs the right one and does not
/// return. In a second build for the other target it is an error. `peers` says whether the right build holds
/// the integrators of other crates.
pub fn enter(portable: bool, peers: bool) -> Result<(), Box<dyn Error>> {
    let wanted = if portable { "portable" } else { "native" };
    match BUILT_FOR {
        Some(target) if target == wanted => return Ok(()),
        Some(target) => return Err(format!("this program is built for {target}").into()),
        None => {}
    }
    let root = root();
    let target = target();
    let mut flags = std::env::var("RUSTFLAGS").unwrap_or_default();
    if !portable {
        flags += " -C target-cpu=native";
    }
    let with = if peers { " with the peers in Rust" } else { "" };
    eprintln!("benchmarks: building for the {wanted} target{with}, then running that build");
    let status = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["run", "--quiet", "--profile", "measured", "-p", "benchmarks"])
        .args(if peers { &["--features", "peers"][..] } else { &[] })
        .arg("--manifest-path")
        .arg(root.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(target.join(wanted))
        .arg("--")
        .args(std::env::args_os().skip(1))
        .env("RUSTFLAGS", flags.trim())
        .env("BENCHMARKS_BUILT_FOR", wanted)
        .status()?;
    exit(status.code().unwrap_or(1))
}

/// The folder of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The folder of everything that is built.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// Whether this build would run on other processors.
pub fn portable() -> bool {
    BUILT_FOR != Some("native")
}

/// Keeps this thread, and the processes it starts, on the last core there is.
pub fn pin() {
    match core_affinity::get_core_ids().and_then(|cores| cores.last().copied()) {
        Some(core) if core_affinity::set_for_current(core) => {}
        _ => eprintln!("benchmarks: this system does not pin threads; times will scatter"),
    }
}
