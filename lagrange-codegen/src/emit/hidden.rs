//! Functions that can hide from a step: what they depend on, at states along it.

use super::body::Source;
use super::{Emission, body, scalar, turning};
use crate::jets::Hidden;
use crate::model::Model;
use crate::regimes::Regimes;

/// The items of `System`; none if no function in the equations can hide.
pub(super) fn hidden(emission: &Emission<'_>) -> String {
    let Some(hidden) = emission.hidden else { return String::new() };
    let flag = |name: &str, is_set: bool| {
        if is_set { format!("const {name}: bool = true;\n") } else { String::new() }
    };
    let flags = flag("STEEP", hidden.is_steep) + &flag("ROOTED", !hidden.roots.is_empty());
    if hidden.all().is_empty() {
        return flags;
    }
    let visiting = visiting(emission, emission.model, hidden, (Source::Slices, turning::entry(emission)));
    flags + &method(emission, "hidden_along", ["&self, ", &given(emission)], &visiting)
}

/// The items of `Switching`; none if no function in the guards can hide.
pub(super) fn in_guards(emission: &Emission<'_>, switching: &Regimes) -> String {
    let Some(hidden) = known(switching.hidden[1].as_ref()) else { return String::new() };
    let number = format!("let __number = ::core::convert::identity::<{}>;\n", emission.scalar);
    let visiting = visiting(emission, &switching.model, hidden, (Source::Numbers, number));
    let arguments = ["__in_regime: &Self::InRegime, ", &given(emission)];
    "const NARROW: bool = true;\n".to_owned() + &method(emission, "hidden_in", arguments, &visiting)
}

/// The inherent method of an event; `None` if no function in it can hide.
pub(super) fn in_event(emission: &Emission<'_>, hidden: Option<&Hidden>, name: &str) -> Option<String> {
    let visiting = visiting(emission, emission.model, known(hidden)?, (Source::Slices, String::new()));
    // An event does not depend on inputs.
    let none = format!("[[{}; {}]; PLACES]", scalar::zero(&emission.scalar), emission.model.inputs.len());
    let body = format!("let __inputs = &{none};\n{visiting}");
    Some("#[doc(hidden)]\npub ".to_owned() + &method(emission, name, ["&self, ", ""], &body))
}

/// Functions that can hide, if it is known what some of them depend on.
fn known(hidden: Option<&Hidden>) -> Option<&Hidden> {
    hidden.filter(|hidden| !hidden.all().is_empty())
}

/// The argument for inputs.
fn given(emission: &Emission<'_>) -> String {
    format!("__inputs: &[{}; PLACES], ", emission.input_type())
}

/// A method that visits functions at states, with these arguments before the states and after them.
fn method(emission: &Emission<'_>, name: &str, [of, given]: [&str; 2], body: &str) -> String {
    let (state, scalar) = (emission.state_type(), &emission.scalar);
    format!(
        "fn {name}<const PLACES: usize>(\n{of}__states: &[{state}; PLACES], {given}\
         __visit: impl ::core::ops::FnMut(lagrange::Hidden, [{scalar}; PLACES]),\n) {{\n{body}\n}}\n"
    )
}

/// The call that visits functions. The statements in `entry` come before what is read of a state.
fn visiting(
    emission: &Emission<'_>,
    model: &Model,
    hidden: &Hidden,
    (source, entry): (Source, String),
) -> String {
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let powers: Vec<u32> = hidden.bases.iter().map(|&(_, power)| power).collect();
    let body = body::plain(model, &emission.scalar, &hidden.all(), source, |values| values.list());
    format!(
        "lagrange::hidden(__states, __inputs, (&{powers:?}, {}, {}), \
         |t, q: &{vector}, v: &{vector}, u: &{inputs}| {{\n\
         {entry}{body}\n}}, __visit);",
        hidden.roots.len(),
        hidden.angles.len()
    )
}
