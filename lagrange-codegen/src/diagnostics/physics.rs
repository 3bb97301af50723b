//! The texts of messages about the physics: what is wrong, then how to mend it.

/// A kinetic energy that is not a polynomial of degree two in the velocities.
pub fn kinetic_not_quadratic(function: &str) -> String {
    format!(
        "the kinetic energy `{function}` is not at most quadratic in the velocities here; \
         if that is meant (relativity, for instance), give the whole Lagrangian by a `#[lagrangian]` function"
    )
}

/// A role function without influence on the motion.
pub fn no_effect(role: &str, function: &str) -> String {
    let reason = match role {
        "potential" => "it does not depend on any coordinate",
        "dissipation function" => "it does not depend on any velocity",
        "force" => "it is zero, or what it acts on does not move with any coordinate",
        _ => "it depends on no coordinate and no velocity",
    };
    format!(
        "the {role} `{function}` has no effect on the motion: {reason}; \
         mend or remove it, or say `allow(no_effect)` in the attribute"
    )
}

/// A particle or body that no coordinate moves.
pub fn fixed_in_space(kind: &str, function: &str) -> String {
    format!(
        "the {kind} `{function}` depends on no coordinate, so it is fixed in space (or moves as prescribed) and its \
         inertia has no effect; remove its role (a helper function needs none), or say `allow(no_effect)` in the attribute"
    )
}

/// A particle of mass zero.
pub fn zero_mass(function: &str) -> String {
    format!(
        "the mass of `{function}` is zero; remove its role if it only names a place (a helper function needs none)"
    )
}

/// A coordinate with an empty row of the mass matrix.
pub fn no_inertia(coordinate: &str, linear: bool) -> String {
    let reason = if linear {
        "the Lagrangian is only linear in its velocity"
    } else {
        "no kinetic energy depends on its velocity"
    };
    format!(
        "the coordinate `{coordinate}` has no inertia: {reason}, so its acceleration is not determined; \
         give it a mass (`#[point(mass = …)]`, `#[body(…)]`, `#[kinetic]`) or remove the coordinate"
    )
}

/// A mass matrix whose pattern of zeros makes it singular.
pub fn structurally_singular(coordinate: &str) -> String {
    format!(
        "the mass matrix is singular whatever the parameters: the inertia of the coordinate `{coordinate}` is not \
         independent of that of the others; give it a mass of its own or remove a coordinate"
    )
}

/// An input that no equation contains.
pub fn unused_input(input: &str) -> String {
    format!(
        "the input `{input}` has no effect on the motion; use it in a `#[force]` function, \
         remove it, or say `allow(unused_input)` in the attribute"
    )
}

/// A panic of the macro.
pub fn internal_error() -> &'static str {
    "`#[lagrangian]` failed on this description without knowing why, which is a bug of the `lagrangian` crate; \
     please report it with the description"
}

/// A function named like a generated method.
pub fn name_of_generated(name: &str) -> String {
    format!("`{name}` is the name of a method that the macro generates; give this function another name")
}

/// A negative mass.
pub fn negative_mass(function: &str) -> String {
    format!("the mass of `{function}` is negative; a mass is positive")
}

/// A constant part of an expression without a finite value.
pub fn not_a_number() -> &'static str {
    "this constant is not a finite number (the root or logarithm of a negative one, a quotient by zero, an overflow); \
     mend the expression"
}
