//! [`PictureError`]: why there is no picture.

use std::fmt;
use std::io;
use std::path::PathBuf;

use lagrange_runtime::MotionError;

/// Why a motion was not recorded or a picture not drawn.
#[derive(Debug)]
#[non_exhaustive]
pub enum PictureError {
    /// The motion ended early.
    Motion(MotionError<f64>),
    /// There is nothing to draw: no state, no curve, no frame.
    Empty,
    /// A number to be drawn is NaN or infinite.
    NotFinite {
        /// The thing that the number belongs to.
        what: &'static str,
        /// When, or for which value on the horizontal axis.
        at: f64,
    },
    /// A film was asked of states whose times are not equally far apart.
    UnequalTimes {
        /// The first time that is off the equal spacing between the first and the last \[s].
        at: f64,
    },
    /// The system has no coordinate of this name.
    NoSuchCoordinate {
        /// The name.
        name: String,
        /// The names that there are.
        known: &'static [&'static str],
    },
    /// A shape of the film has more points or fewer than in its first frame.
    ChangingShape {
        /// When \[s].
        at: f64,
    },
    /// The file could not be written.
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The plotting library refused.
    Plot(String),
}

impl fmt::Display for PictureError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motion(error) => write!(out, "the motion ended before the picture: {error}"),
            Self::Empty => out.write_str("there is nothing to draw"),
            Self::NotFinite { what, at } => write!(out, "{what} is not finite at {at}"),
            Self::UnequalTimes { at } => write!(
                out,
                "a film needs states at equal times, and that at t = {at} s is out of step; `Record::of` takes them so"
            ),
            Self::NoSuchCoordinate { name, known } => {
                write!(out, "there is no coordinate `{name}`; there are {}", known.join(", "))
            }
            Self::ChangingShape { at } => {
                write!(out, "a shape has another number of points at t = {at} s than before")
            }
            Self::Io { path, source } => write!(out, "cannot write {}: {source}", path.display()),
            Self::Plot(what) => write!(out, "the picture cannot be drawn: {what}"),
        }
    }
}

impl std::error::Error for PictureError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Motion(error) => Some(error),
            Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}
