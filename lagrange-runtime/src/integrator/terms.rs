//! The polynomial of a step, for what looks at functions along it.

/// The polynomial of a step.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'a, R, const N: usize> {
    /// Terms of the coordinates, from the first order on, in a unit of time of the method.
    pub q: &'a [[R; N]],
    /// Those of the velocities.
    pub v: &'a [[R; N]],
    /// The length of the step in that unit.
    pub length: R,
    /// The unit \[s].
    pub unit: R,
    /// What rounding took from the time of the start \[s].
    pub residue: R,
}
