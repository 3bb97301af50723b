//! The circumstances of a measurement: machine, versions and date.

use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::native;
use crate::precision::server::Server;

/// The peers whose versions Cargo.lock knows.
const CRATES: [&str; 3] = ["differential-equations", "diffsol", "ode_solvers"];

/// The head of the report.
pub fn describe(server: &Server) -> Result<String, Box<dyn Error>> {
    let lock = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.lock"))?;
    let mut versions: Vec<String> = server.versions().iter().map(|(name, v)| format!("{name} {v}")).collect();
    versions.extend(CRATES.iter().filter_map(|name| Some(format!("{name} {}", locked(&lock, name)?))));
    Ok(format!(
        "# Results\n\n\
         Written by `cargo run --release -p benchmarks -- report`; [README.md](README.md) says how, and what is fair \
         about it.\n\n{}",
        circumstances(&versions)
    ))
}

/// The processor, the compiler, the versions of the peers, and the date.
pub fn circumstances(versions: &[String]) -> String {
    format!(
        "* Machine: one core of {}\n* Built by {} for {}\n* Peers: {}\n* Date: {}\n",
        processor(),
        compiler(),
        if native::portable() { "any processor of this architecture" } else { "the present processor" },
        versions.join(", "),
        date()
    )
}

/// The version of a package in the lock file.
fn locked(lock: &str, name: &str) -> Option<String> {
    let (_, entry) = lock.split_once(&format!("name = \"{name}\"\nversion = \""))?;
    Some(entry.split_once('"')?.0.to_owned())
}

/// The processor's own name, where the system tells.
pub fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let names: Vec<&str> = text.lines().filter(|line| line.starts_with("model name")).collect();
    match names.first().and_then(|line| line.split_once(':')) {
        Some((_, name)) => format!("{} ({} cores, {})", name.trim(), names.len(), std::env::consts::ARCH),
        None => std::env::consts::ARCH.to_owned(),
    }
}

/// Name and version of the compiler.
pub fn compiler() -> String {
    let output = Command::new("rustc").arg("--version").output();
    let text = output.ok().and_then(|output| String::from_utf8(output.stdout).ok());
    text.map_or_else(|| "rustc".to_owned(), |text| text.trim().to_owned())
}

/// Today, UTC.
pub fn date() -> String {
    calendar(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()) / 86_400)
}

/// A day since 1970-01-01 in the Gregorian calendar.
fn calendar(day: u64) -> String {
    // Years begin in March, so that the leap day is the last one: see Hinnant, "chrono-compatible date
    // algorithms".
    let days = day + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", era * 400 + year + next)
}

#[cfg(test)]
mod tests {
    use super::calendar;

    #[test]
    fn days_have_their_dates() {
        let days =
            [(0, "1970-01-01"), (11_016, "2000-02-29"), (20_148, "2025-03-01"), (20_453, "2025-12-31")];
        for (day, date) in days {
            assert_eq!(calendar(day), date);
        }
    }
}
