//! [`Peer`]: heyoka on the same studies, a child process that answers one request a line.

use std::collections::BTreeMap;
use std::error::Error;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde::{Deserialize, Serialize};

use super::Ends;

/// heyoka in Python.
pub struct Peer {
    child: Child,
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
    pub versions: Vec<String>,
}

#[derive(Deserialize)]
struct Greeting {
    versions: BTreeMap<String, String>,
}

#[derive(Serialize)]
struct Request<'a> {
    system: &'a str,
    source: &'a str,
    lanes: u32,
    tolerance: f64,
    starts: &'a Ends,
    t_end: f64,
}

#[derive(Deserialize)]
struct Answer {
    seconds: f64,
    ends: Ends,
}

/// Source of the equations and number of lanes of a subject, if it is one of heyoka's.
pub fn asked(subject: &str) -> Option<(&str, u32)> {
    let rest = subject.strip_prefix("heyoka-")?;
    match rest.split_once("-batch") {
        Some((source, lanes)) => Some((source, lanes.parse().ok()?)),
        None => Some((rest, 1)),
    }
}

impl Peer {
    /// Starts it; installs what is missing.
    pub fn start() -> Result<Self, Box<dyn Error>> {
        let mut child = Command::new("python3")
            .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/peers.py"))
            .arg("many")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let requests = child.stdin.take();
        let mut answers = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        let mut line = String::new();
        answers.read_line(&mut line)?;
        let greeting: Greeting = serde_json::from_str(&line)?;
        let versions = greeting.versions.iter().map(|(name, version)| format!("{name} {version}")).collect();
        Ok(Self { child, requests, answers, versions })
    }

    /// Its subjects for a system: its `lagrangian()` knows no constraints.
    pub fn subjects(&self, system: &str) -> Vec<String> {
        let sources = if system == "slider" { &["expert"][..] } else { &["lagrangian", "expert"] };
        let of = |source: &&str| ["", "-batch4", "-batch8"].map(|lanes| format!("heyoka-{source}{lanes}"));
        sources.iter().flat_map(of).collect()
    }

    /// Runs a study: processor time [s] and ends.
    pub fn ask(
        &mut self,
        system: &str,
        (source, lanes): (&str, u32),
        tolerance: f64,
        starts: &Ends,
        t_end: f64,
    ) -> Result<(f64, Ends), String> {
        let request = Request { system, source, lanes, tolerance, starts, t_end };
        let mut exchange = || -> Result<Answer, Box<dyn Error>> {
            let requests = self.requests.as_mut().ok_or("closed")?;
            writeln!(requests, "{}", serde_json::to_string(&request)?)?;
            requests.flush()?;
            let mut line = String::new();
            self.answers.read_line(&mut line)?;
            Ok(serde_json::from_str(&line)?)
        };
        let Answer { seconds, ends } = exchange().map_err(|error| error.to_string())?;
        Ok((seconds, ends))
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // The child ends with its input.
        drop(self.requests.take());
        let _ = self.child.wait();
    }
}
