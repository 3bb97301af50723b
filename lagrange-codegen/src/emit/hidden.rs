//! Functions that can hide from a step: what they depend on, at states along it.

use super::{Emission, body, turning};

/// The items of `System`; none if no function can hide.
pub(super) fn hidden(emission: &Emission<'_>) -> String {
    let Some(hidden) = emission.hidden else { return String::new() };
    let steep = "const STEEP: bool = true;\n";
    let all = hidden.all();
    if all.is_empty() {
        return steep.to_owned();
    }
    let (scalar, count) = (&emission.scalar, emission.count());
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let powers: Vec<u32> = hidden.bases.iter().map(|&(_, power)| power).collect();
    let body = turning::entry(emission)
        + &body::plain(emission.model, scalar, &all, body::Source::Slices, |values| values.list());
    format!(
        "{steep}fn hidden_along<const PLACES: usize>(\n\
         &self, __states: &[lagrange::State<{scalar}, {count}>; PLACES], __inputs: &[{inputs}; PLACES], \
         __visit: impl ::core::ops::FnMut(lagrange::Hidden, [{scalar}; PLACES]),\n) {{\n\
         lagrange::hidden(__states, __inputs, &{powers:?}, |t, q: &{vector}, v: &{vector}, u: &{inputs}| {{\n\
         {body}\n}}, __visit);\n}}\n"
    )
}
