//! [`Progress`]: a bar on the terminal, if one is there.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar that counts motions, with the time that is left. It is drawn only if a person asked for it and a
/// terminal shows it, so that logs stay clean.
#[derive(Clone, Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar for `count` motions, of which `done` need not be computed.
    pub fn new(name: &str, count: u64, done: u64, shown: bool) -> Self {
        if !shown {
            return Self(ProgressBar::hidden());
        }
        // `stderr` draws nothing if it is no terminal.
        let bar = ProgressBar::with_draw_target(Some(count), ProgressDrawTarget::stderr_with_hz(5));
        let template = "{prefix} {wide_bar} {human_pos}/{human_len} motions, {per_sec}, {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_prefix(name.to_owned());
        bar.set_position(done);
        bar.reset_eta();
        Self(bar)
    }

    /// So many motions more are done.
    pub fn add(&self, count: u64) {
        self.0.inc(count);
    }

    /// Leaves the bar as it is: it is full, or the study has stopped.
    pub fn end(&self) {
        self.0.abandon();
    }
}
