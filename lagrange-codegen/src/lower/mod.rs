//! Item to [`Model`]: names resolved, shapes checked, loops unrolled, helpers inlined.
//!
//! An abstract interpreter runs every role function once on symbolic coordinates. Integers,
//! truth values and shapes are concrete, numbers are nodes of the graph. An `if` on a comparison
//! of numbers, such as `q.x < 0.0`, becomes a switch between its sides. What else depends on more
//! than is concrete (a `match` on `q`, a loop over a field of unknown length) is refused with a
//! message on the expression. A refused expression becomes an unknown value, which is silent.

mod access;
mod advice;
mod call;
mod choice;
mod compare;
mod constraint;
mod construct;
mod contact;
mod control;
mod coordinates;
mod exits;
mod force;
mod guarded;
mod hint;
mod interpreter;
mod iterate;
mod jumps;
mod lengths;
mod method;
mod methods;
mod normal;
mod operator;
mod parameter;
mod path;
mod pattern;
mod places;
mod quaternion;
mod readings;
mod roles;
mod rotation;
mod rounded;
mod scalar;
mod scope;
mod sensitivity;
mod shape;
mod statement;
#[cfg(test)]
pub(crate) mod tests;
mod value;
mod vector;
mod velocity;
mod whole;

use crate::calculus::substitute;
use crate::diagnostics::Diagnostics;
use crate::model::{Model, orientation};
use crate::syntax::Item;
use interpreter::Interpreter;

/// Lowers a description. After an error the model lacks what the error concerns.
pub fn lower(item: &Item, diagnostics: &mut Diagnostics) -> Model {
    let mut interpreter = Interpreter::new(item, diagnostics);
    interpreter.roles();
    let mut model = interpreter.model;
    // These are functions of all declared coordinates, which nothing changes any more.
    let known = orientation::of_parameters(&mut model.graph, &model.turning);
    for velocity in &mut model.velocities {
        let nodes = substitute(&mut model.graph, &velocity.rates.nodes(), &known);
        velocity.rates.set(&nodes);
    }
    model
}
