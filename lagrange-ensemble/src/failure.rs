//! [`Failure`]: why a motion of a study has no result.

use std::fmt;

use lagrange_runtime::MotionError;
use serde::{Deserialize, Serialize};

/// Why a motion has no result, and when it ended. The other motions of a study go on.
///
/// What ends a motion becomes one by `?`: errors of the library with their time, own causes by
/// [`Failure::new`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// Time of the last good state \[s], if the cause has one.
    pub t: Option<f64>,
    /// The cause, in words.
    pub cause: String,
}

impl Failure {
    /// A cause without a time.
    pub fn new(cause: impl fmt::Display) -> Self {
        Self { t: None, cause: cause.to_string() }
    }

    /// A cause at time `t` \[s].
    pub fn at(t: f64, cause: impl fmt::Display) -> Self {
        // JSON has no infinities. A time that is infinite or NaN is left out.
        Self { t: Some(t).filter(|t| t.is_finite()), cause: cause.to_string() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.t {
            Some(t) => write!(out, "at t = {t:?}: {}", self.cause),
            None => out.write_str(&self.cause),
        }
    }
}

impl std::error::Error for Failure {}

impl<R: Into<f64>> From<MotionError<R>> for Failure {
    fn from(error: MotionError<R>) -> Self {
        Self::at(error.t.into(), error.cause)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_that_is_read_back_has_the_time_that_was_written() {
        for k in 1..10_000 {
            let failure = Failure::at(f64::from(k).sqrt() * 1e-3, "a cause");
            let text = serde_json::to_string(&failure).expect("text");
            assert_eq!(serde_json::from_str::<Failure>(&text).expect("the failure"), failure);
        }
    }
}
