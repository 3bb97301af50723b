//! Zeros of functions along motions of generated systems, against closed forms.

mod orbit;
mod swings;
