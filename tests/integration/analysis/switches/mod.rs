//! Derivatives of motions through impacts, dry friction and kinks: closed forms over dual numbers,
//! differences, and where there are none.

mod friction;
mod impacts;
mod jumps;
mod kinks;
mod planks;
mod tables;
mod together;

const TIGHT: f64 = 1e-13;
