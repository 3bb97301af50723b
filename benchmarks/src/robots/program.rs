//! [`Program`]: a child process that answers one request a line.

use std::error::Error;
use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A program with its pipes.
pub struct Program {
    child: Child,
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Program {
    /// Starts it.
    pub fn start<A: AsRef<OsStr>>(path: &Path, arguments: &[A]) -> Result<Self, Box<dyn Error>> {
        let mut child = Command::new(path)
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{} does not start: {error}", path.display()))?;
        let requests = child.stdin.take();
        let answers = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        Ok(Self { child, requests, answers })
    }

    fn ask(&mut self, request: &str) -> Result<String, Box<dyn Error>> {
        let requests = self.requests.as_mut().ok_or("closed")?;
        writeln!(requests, "{request}")?;
        requests.flush()?;
        let mut line = String::new();
        if self.answers.read_line(&mut line)? == 0 {
            return Err(format!("no answer to `{request}`").into());
        }
        Ok(line)
    }

    /// An answer of words.
    pub fn words(mut self, request: &str) -> Result<Vec<String>, Box<dyn Error>> {
        Ok(self.ask(request)?.split_whitespace().map(str::to_owned).collect())
    }

    /// An answer of numbers.
    pub fn numbers(&mut self, request: &str) -> Result<Vec<f64>, Box<dyn Error>> {
        let numbers: Result<_, _> = self.ask(request)?.split_whitespace().map(str::parse).collect();
        Ok(numbers?)
    }

    /// The time of an evaluation [ns].
    pub fn time(&mut self, subject: &str, seconds: f64) -> Result<f64, Box<dyn Error>> {
        match self.numbers(&format!("time {subject} {seconds}"))?[..] {
            [time] => Ok(time),
            _ => Err("no time".into()),
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // The child ends with its input.
        drop(self.requests.take());
        let _ = self.child.wait();
    }
}
