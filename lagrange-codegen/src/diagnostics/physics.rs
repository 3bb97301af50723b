//! The texts of messages about the physics: what is wrong, then how to mend it.

/// A dissipation function that is linear in the velocities.
pub fn linear_dissipation(function: &str) -> String {
    format!(
        "the dissipation function `{function}` is linear in the velocities, so its force −∂D/∂v does not depend on them; that of \
         a damper with the force −c v is ½ c v², and a force is a `#[force]` function"
    )
}

/// A kinetic energy that is not a polynomial of at most degree two in the velocities.
pub fn kinetic_not_quadratic(function: &str) -> String {
    format!(
        "the kinetic energy `{function}` is not at most quadratic in the velocities here; \
         if that is meant (relativity, for instance), give the whole Lagrangian by a `#[lagrangian]` function"
    )
}

/// An argument that contacts and dry friction exclude: `analysis`, `verify` or `baumgarte`.
pub fn beside_contacts(argument: &str) -> String {
    format!(
        "`{argument}` needs equations without contacts and dry friction; leave it out here, and analyse a \
         second type that has no `unilateral` or `friction` functions"
    )
}

/// Which coordinates are meant where some are eliminated.
fn left(eliminated: bool) -> &'static str {
    if eliminated { " that is not eliminated" } else { "" }
}

/// A role function without influence on the motion.
pub fn no_effect(role: &str, function: &str, eliminated: bool) -> String {
    let left = left(eliminated);
    let reason = match role {
        "potential" => format!("it does not depend on any coordinate{left}"),
        "dissipation function" => format!("it does not depend on any velocity{left}"),
        "force" => format!("it is zero, or what it acts on does not move with any coordinate{left}"),
        _ => format!("it depends on no coordinate and no velocity{left}"),
    };
    format!(
        "the {role} `{function}` has no effect on the motion: {reason}; \
         mend or remove it, or say `allow(no_effect)` in the attribute"
    )
}

/// An event function that stays the same.
pub fn no_event(function: &str) -> String {
    format!(
        "the event `{function}` never happens: its value is the same all through a motion; let it depend on coordinates, \
         velocities or time, remove it, or say `allow(no_effect)` in the attribute"
    )
}

/// A particle or body that no coordinate moves.
pub fn fixed_in_space(kind: &str, function: &str, eliminated: bool) -> String {
    let left = left(eliminated);
    format!(
        "the {kind} `{function}` depends on no coordinate{left}, so it is fixed in space (or moves as prescribed) and its \
         inertia has no effect; remove its role (a helper function needs none), or say `allow(no_effect)` in the attribute"
    )
}

/// A particle of mass zero, or a body without mass and inertia.
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
         give it a mass (`#[point(mass = …)]`, `#[body(…)]`, `#[kinetic]`) or a constraint that ties it to the others, or \
         remove the coordinate"
    )
}

/// A mass matrix whose pattern of zeros makes it singular.
pub fn structurally_singular(coordinate: &str) -> String {
    format!(
        "the mass matrix is singular whatever the parameters: the inertia of the coordinate `{coordinate}` is not \
         independent of that of the others; give it a mass of its own or remove a coordinate"
    )
}

/// A kinetic energy with products of a velocity, but not with its square.
pub fn indefinite(coordinate: &str) -> String {
    format!(
        "the kinetic energy is not positive: the velocity of `{coordinate}` stands in products with others, but not \
         squared; give a Lagrangian of any sign by `#[lagrangian]`"
    )
}

/// A constraint in which the coordinate to be eliminated is not linear with a constant coefficient.
pub fn not_solvable(constraint: &str, coordinate: &str) -> String {
    format!(
        "`{constraint}` cannot be solved for `{coordinate}`, whose coefficient is not the same all through a run; \
         eliminate a coordinate that stands here alone or times a constant, or keep the constraint by `#[holonomic]`"
    )
}

/// A coordinate to be eliminated by a constraint that does not contain it.
pub fn absent_coordinate(coordinate: &str, constraint: &str, others: &str) -> String {
    format!(
        "the coordinate `{coordinate}` does not occur in `{constraint}` or cancels out; what can be eliminated here \
         is `{others}`"
    )
}

/// A constraint to eliminate by in which no coordinate is left.
pub fn nothing_to_eliminate(constraint: &str) -> String {
    format!(
        "`{constraint}` determines no coordinate: none occurs in it but those that other constraints eliminate; \
         mend or remove it"
    )
}

/// A coordinate that two constraints are to be solved for.
pub fn eliminated_twice(coordinate: &str) -> String {
    format!(
        "the coordinate `{coordinate}` is eliminated by another constraint already; eliminate another one here, or \
         remove one of the two constraints"
    )
}

/// Constraints that leave no coordinate.
pub fn all_eliminated() -> &'static str {
    "all coordinates are eliminated, so that nothing is left to move: the motion is known beforehand; keep at least \
     one coordinate free"
}

/// A constraint without a gradient.
pub fn restrains_nothing(constraint: &str, eliminated: bool) -> String {
    let left = left(eliminated);
    format!(
        "`{constraint}` restrains nothing: its value changes with no coordinate and no velocity{left}; mend or \
         remove it"
    )
}

/// A nonholonomic constraint that depends on coordinates alone.
pub fn without_velocity(constraint: &str) -> String {
    format!("`{constraint}` depends on no velocity, so it is holonomic; write `#[holonomic]`")
}

/// A nonholonomic constraint that is not affine in the velocities.
pub fn not_affine_in_velocities(constraint: &str) -> String {
    format!(
        "the constraint `{constraint}` is not affine in the velocities here; if that is meant, write \
         `#[nonholonomic(chetaev)]`, which takes its forces along ∂g/∂v"
    )
}

/// A friction whose slip depends on no velocity.
pub fn slip_without_velocity(friction: &str) -> String {
    format!(
        "the slip of the friction `{friction}` depends on no velocity; return the velocity at which the surfaces rub, such as \
         `v.x`, or a component of `…_velocity(q, v)`"
    )
}

/// A friction whose slip is not affine in the velocities.
pub fn slip_not_affine(friction: &str) -> String {
    format!(
        "the slip of the friction `{friction}` is not affine in the velocities here; return the velocity at which the surfaces \
         rub, such as `v.x`, with its sign: friction acts against it"
    )
}

/// A friction that rubs in the direction of the reaction that limits it.
pub fn slip_along_normal(friction: &str, normal: &str) -> String {
    format!(
        "the slip of the friction `{friction}` is the rate of `{normal}`, whose reaction limits it, so nothing rubs where that \
         holds; return a velocity along the surface, such as `v.x` on a floor that `q.y` is above"
    )
}

/// A constraint whose gradient vanishes, or has no value, on the constraint itself.
pub fn vanishing_gradient(constraint: &str, advice: &str) -> String {
    format!(
        "wherever `{constraint}` is zero its gradient is zero too, or has no value, so no force can hold the system \
         there; {advice}"
    )
}

/// An affine constraint on velocities that follows from one on coordinates.
pub fn integrable(constraint: &str) -> String {
    format!(
        "`{constraint}` is the time derivative of a function of coordinates and time; write that function as a \
         `#[holonomic]` constraint, which keeps the coordinates from drifting as well, or say `allow(integrable)` in the \
         attribute"
    )
}

/// A constraint whose gradient is parallel to that of an earlier one.
pub fn repetition(constraint: &str, other: &str) -> String {
    format!(
        "`{constraint}` restrains the same motion as `{other}`, so that their reactions are not determined; remove one \
         of the two, or say `allow(redundant)` in the attribute"
    )
}

/// Constraints that cannot hold at once.
pub fn contradiction(constraint: &str, other: &str) -> String {
    format!(
        "`{constraint}` contradicts `{other}`: it is a multiple of it plus a constant, so that the two are never zero at \
         once; mend or remove one of the two"
    )
}

/// More constraints than coordinates that they contain.
pub fn overdetermined(constraint: &str) -> String {
    format!(
        "`{constraint}` is one constraint too many: with those before it there are more equations than coordinates in \
         them; remove one of them, or say `allow(redundant)` in the attribute"
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

/// A negative moment of inertia.
pub fn negative_inertia(function: &str) -> String {
    format!("a moment of inertia of `{function}` is negative; moments of inertia are positive")
}

/// A restitution beyond its bounds.
pub fn restitution(function: &str) -> String {
    format!("the restitution of `{function}` is not between 0 and 1; 0 is a plastic impact, 1 an elastic one")
}

/// Friction that drives.
pub fn negative_friction(function: &str) -> String {
    format!("a coefficient or limit of `{function}` is negative; friction takes energy")
}

/// A coefficient of friction that an input gives.
pub fn input_in_coefficient(function: &str) -> String {
    format!(
        "the coefficient of `{function}` depends on an input, but only a `limit` and a restitution may; read it from `self`, and \
         where it changes begin a new motion at the state, with the new value"
    )
}

/// Static friction below the kinetic one.
pub fn static_below_kinetic(function: &str) -> String {
    format!(
        "the static friction of `{function}` is less than the kinetic one; what begins to slip is held by at least as much"
    )
}

/// A constant part of an expression without a finite value.
pub fn not_a_number() -> &'static str {
    "this constant is not a finite number (the root or logarithm of a negative one, a quotient by zero, an overflow); \
     mend the expression"
}
