//! [`Server`]: the peers in Python as a child process that answers one request a line.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::error::Error;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::rc::Rc;

use serde::{Deserialize, Serialize};

use super::subject::{Sample, Subject};
use crate::problem::Problem;

/// The first line of the child.
#[derive(Deserialize)]
struct Greeting {
    versions: BTreeMap<String, String>,
    subjects: Vec<Offer>,
}

/// A subject, and the systems that it can do.
#[derive(Deserialize)]
struct Offer {
    name: String,
    systems: Vec<String>,
}

#[derive(Serialize)]
struct Request<'a> {
    /// The name, and behind a slash the place of a start that is not the first one.
    system: &'a str,
    subject: &'a str,
    tolerance: f64,
    seconds: f64,
}

/// An answer. The other fields of a record are known already.
#[derive(Deserialize)]
#[serde(untagged)]
enum Answer {
    Sample { us: f64, error: f64, steps: u64 },
    Failure { failure: String },
}

/// The pipes of the child.
struct Line {
    child: Child,
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Line {
    fn read<T: for<'a> Deserialize<'a>>(&mut self) -> Result<T, Box<dyn Error>> {
        let mut line = String::new();
        if self.answers.read_line(&mut line)? == 0 {
            return Err("the peers in Python have stopped".into());
        }
        Ok(serde_json::from_str(&line)?)
    }

    fn ask(&mut self, request: &Request) -> Result<Sample, Box<dyn Error>> {
        let requests = self.requests.as_mut().ok_or("closed")?;
        writeln!(requests, "{}", serde_json::to_string(request)?)?;
        requests.flush()?;
        match self.read()? {
            Answer::Sample { us, error, steps } => Ok(Sample { us, error, steps }),
            Answer::Failure { failure } => Err(failure.into()),
        }
    }
}

impl Drop for Line {
    fn drop(&mut self) {
        // The child ends with its input.
        drop(self.requests.take());
        let _ = self.child.wait();
    }
}

/// The peers in Python.
pub struct Server {
    line: Rc<RefCell<Line>>,
    greeting: Greeting,
}

impl Server {
    /// Starts the peers from PyPI; installs what is missing.
    pub fn start() -> Result<Self, Box<dyn Error>> {
        Self::of("python3", "peers/peers.py", "serve")
    }

    /// Starts a script of this folder as the child, which stays on the core of this thread.
    pub fn of(python: &str, script: &str, command: &str) -> Result<Self, Box<dyn Error>> {
        let mut child = Command::new(python)
            .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join(script))
            .arg(command)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{python} does not start: {error}"))?;
        let requests = child.stdin.take();
        let answers = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        let mut line = Line { child, requests, answers };
        let greeting = line.read()?;
        Ok(Self { line: Rc::new(RefCell::new(line)), greeting })
    }

    /// The versions of its libraries.
    pub fn versions(&self) -> &BTreeMap<String, String> {
        &self.greeting.versions
    }

    /// Its subjects for one system.
    pub fn subjects(&self, system: &str) -> Vec<Box<dyn Subject>> {
        let able = self.greeting.subjects.iter().filter(|offer| offer.systems.iter().any(|s| s == system));
        able.map(|offer| {
            Box::new(Remote { name: offer.name.clone(), line: self.line.clone() }) as Box<dyn Subject>
        })
        .collect()
    }
}

/// A subject that answers through the pipe.
struct Remote {
    name: String,
    line: Rc<RefCell<Line>>,
}

impl Subject for Remote {
    fn name(&self) -> &str {
        &self.name
    }

    fn sample(&mut self, problem: &Problem, tolerance: f64, seconds: f64) -> Result<Sample, String> {
        let system = match problem.place {
            0 => problem.name.to_owned(),
            place => format!("{}/{place}", problem.name),
        };
        let request = Request { system: &system, subject: &self.name, tolerance, seconds };
        self.line.borrow_mut().ask(&request).map_err(|error| error.to_string())
    }
}
