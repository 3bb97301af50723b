//! The texts of messages about descriptions: what is wrong, then how to mend it. [`physics`](super::physics)
//! has those about the physics.
//!
//! Each entry is a function that fills its names in. What stands after `;` among its arguments is a name
//! that the user may have meant, or nothing.

use std::fmt::Display;

macro_rules! messages {
    ($($name:ident ($($argument:ident),* $(; $near:ident)?) = $text:literal;)*) => {
        $(
            #[doc = concat!("«", $text, "»")]
            pub fn $name($($argument: impl Display,)* $($near: Option<String>)?) -> String {
                $(let $near = suggestion($near);)?
                sentences(format!($text))
            }
        )*
    };
}

fn suggestion(near: Option<String>) -> String {
    near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"))
}

/// Makes what follows a question a sentence of its own.
fn sentences(message: String) -> String {
    let Some((question, rest)) = message.split_once("`?; ") else { return message };
    let mut letters = rest.chars();
    let first = letters.next().map_or_else(String::new, |letter| letter.to_uppercase().to_string());
    format!("{question}`? {first}{}", letters.as_str())
}

// The attribute and the impl block.
messages! {
    not_an_impl() = "`#[lagrangian]` belongs on an `impl` block; declare the struct as usual and put the \
        attribute on `impl MySystem {{ … }}`";
    not_inherent() = "`#[lagrangian]` belongs on an inherent `impl` block of a named type, such as \
        `impl MySystem {{ … }}`; move the roles out of this block";
    unread(reason) = "`#[lagrangian]` cannot read this `impl` block: {reason}";
    bad_attribute(error) = "cannot read these arguments ({error}); write \
        `#[lagrangian(coordinates = [x, theta: [3]], inputs = [motor])]`";
    unknown_attribute_argument(name; near) = "unknown argument `{name}`{near}; known are `coordinates`, \
        `inputs`, `jacobians`, `sensitivities`, `analysis`, `verify`, `baumgarte`, `crate` and `allow`";
    argument_with_value(name) = "`{name}` takes no value; write `{name}` alone, or leave it out";
    duplicate_argument(name) = "`{name}` is given twice; keep one of the two";
    unknown_lint(name, known; near) = "there is no lint `{name}`{near}; known are `{known}`";
    missing_coordinates() = "no coordinates are declared; add `coordinates = [x, theta: [3]]` to the \
        attribute";
    empty_coordinates() = "the list of coordinates is empty; name at least one coordinate";
    keyword_name(name) = "`{name}` is a keyword; choose another name or write `r#{name}`";
    reserved_name(name) = "`{name}` has a meaning of its own in Rust; choose another name";
    declared_twice(kind, name) = "the {kind} `{name}` is declared twice; give each its own name";
    coordinate_and_input(name) = "`{name}` is declared as a coordinate and as an input; rename one of them";
    empty_array(name) = "the array `{name}` has no elements; give it a length of at least 1";
    array_too_long(name, most) = "the array `{name}` is longer than {most}; a system of this size cannot be \
        expanded into source code";
    unknown_coordinate_kind(name) = "`{name}` is no kind of coordinate; leave it out for a number, write `Rotation` for an \
        orientation in space, `Pose` for a position and an orientation, or a length in brackets for an array of numbers: `theta: [3]`";
    input_not_scalar(name) = "the input `{name}` is a number or an array of numbers; leave the kind out, or write \
        `{name}: [3]`";
    no_array_of_orientations(record) = "`{record}` with orientations are no array of numbers; use their fields by name";
    eliminated_orientation(name) = "`{name}` is an orientation or a pose and cannot be eliminated; leave \
        `eliminate` out: the constraint then has a multiplier";
    force_on_all_with_orientations(name) = "`{name}` gives a force for each coordinate, but some coordinates are \
        orientations; write `#[force(on = …)]` for a coordinate or `#[force(at = …)]` for a place";
    force_on_pose(name) = "`{name}` is a pose; a force on it acts at a place: write `#[force(at = …)]` with the name of \
        a function that returns it";
    length_not_constant(name) = "the length of `{name}` is not known to the macro; write a literal or a \
        `const` of this impl block";
    no_roles(name) = "`{name}` has no function with a role; mark at least one with `#[point(mass = …)]`, \
        `#[body(…)]`, `#[kinetic]` or `#[lagrangian]`";
    missing_bound(parameter) = "`{parameter}` is the scalar of this description; add the bound \
        `{parameter}: Real`";
    mixed_precision() = "the roles mix `f32` and `f64`; use one of them throughout, or a type parameter with \
        the bound `Real`";
}

// Roles and their signatures.
messages! {
    unknown_role(name, near) = "there is no role `{name}`; did you mean `{near}`?";
    mixed_friction() = "a friction is limited by a reaction or by a given force; write `#[friction(coefficient = …, \
        normal = …)]` with `static_coefficient` where it differs, or `#[friction(limit = …)]` with `static_limit`";
    friction_without_limit() = "nothing limits this friction; write `#[friction(coefficient = self.mu, normal = floor)]` for a \
        share of the reaction of `floor`, or `#[friction(limit = self.force)]` for a force that is given";
    friction_without_normal() = "a coefficient of friction needs the constraint whose reaction it multiplies; add \
        `normal = floor`, or give the force itself: `#[friction(limit = …)]`";
    friction_on_unknown(name; near) = "`{name}` is no constraint with a reaction{near}; name a function with the role \
        `unilateral` or `holonomic`";
    friction_on_free_place(name) = "no holonomic constraint acts on `{name}`; name the constraint whose reaction limits \
        friction, or give the force itself as a function: `#[friction(limit = force)]`";
    friction_beside(other, place) = "`{other}` acts on `{place}` as well; name the constraints whose forces limit \
        friction: `normal = floor` one, `normal = [across, along]` several";
    friction_with_gap(name) = "`{name}` is a gap, and a common size is that of the forces of `holonomic` constraints; \
        write a friction of its own for `{name}`";
    friction_named_twice(name) = "`{name}` stands twice in this list; name each constraint once";
    friction_apart() = "there is no point or body on which all of these act with forces that follow from their form; \
        name constraints at one place, and write a friction for each place";
    friction_by_form(constraint, place) = "`{constraint}` names coordinates that move `{place}`, so that its force there \
        does not follow from its form; write it as a function of `self.{place}(q)`, or give the normal force itself as a \
        function: `#[friction(limit = force)]`";
    friction_vectors(name, count) = "`{name}` returns an array of vectors, but each friction in two directions is a \
        function of its own; write {count} that return a `Vector2`, each with its `#[friction(…)]`";
    friction_count(name, have, want) = "`{name}` has {have}, and its normal has {want}; name one of these, or return as \
        many slip velocities";
    unknown_law(name) = "there is no law of impact `{name}`; known are `newton`, `poisson` and `plastic`";
    plastic_with_restitution() = "a plastic impact has no restitution; leave out `restitution` or `law = plastic`";
    velocity_in_gap() = "a gap is a function of coordinates and time; its velocity follows from it and is not needed \
        here";
    two_roles(first, second) = "this function has the role `{first}` already; write a function of its own \
        for `{second}`";
    missing_role_argument(role, argument) = "`#[{role}]` needs `{argument}`; write \
        `#[{role}({argument} = self.{argument})]`, or the like";
    bad_role_arguments(role, error) = "cannot read the arguments of `{role}` ({error}); write \
        `name = expression`, separated by commas";
    misspelt_role_argument(role, name, near) = "`{role}` has no argument `{name}`; did you mean `{near}`?";
    unknown_role_argument(role, name, known) = "`{role}` has no argument `{name}`; known are `{known}`";
    role_without_arguments(role) = "`{role}` takes no arguments; write `#[{role}]`";
    role_form(role, form) = "`{role}` takes no value; write `{form}`";
    role_on_item(role) = "the role `{role}` belongs on a function; remove it here or write a function";
    force_at_and_on() = "a force acts either `at` a point or `on` a coordinate; split it into two functions";
    bad_target(key) = "`{key}` takes a name; write `{key} = name` or `{key} = name[index]`";
    missing_return_type(name, expected) = "`{name}` returns nothing; let it return {expected}";
    wrong_return(name, expected, found) = "`{name}` must return {expected}, not {found}";
    missing_receiver(name) = "`{name}` has a role but no `&self`; add `&self` as the first parameter";
    wrong_receiver(name) = "`{name}` has a role and must take `&self`; a role only reads the parameters";
    generic_role(name) = "`{name}` has a role and cannot be generic; move the type parameter to the impl \
        block, or the generic part into a helper";
    asynchronous_role(name) = "`{name}` has a role and cannot be `async`; remove `async`";
    conditional_role(name) = "`{name}` has a role and cannot depend on `cfg`; put `cfg` on the impl block, and \
        write one block for each case";
    conditional_attribute() = "whether this attribute is there is decided after the macro has run; put `cfg` on the impl \
        block, and write one block for each case";
    no_inputs() = "no inputs are declared; add `inputs = [motor]` to the attribute";
    unnamed_time(name) = "a role takes no number but the time; rename `{name}` to `t` if it is the time, or \
        read it from `self`";
    unknown_parameter() = "a role takes `q: &Coordinates`, `v: &Velocities`, `t` and `u: &Inputs` only; \
        read everything else from `self`";
    misspelt_record(name, near) = "a role takes no `{name}`; did you mean `{near}`?";
    parameter_twice() = "this parameter is there already; remove one of the two";
    velocity_in_potential() = "a potential is a function of position and time; put terms that depend on \
        velocity into a `#[lagrangian]` function, or a `#[dissipation]` or `#[force]` if they dissipate";
    velocity_in_position() = "a position is a function of coordinates and time; its velocity follows from \
        it and is not needed here";
    velocity_in_holonomic() = "a holonomic constraint is a function of coordinates and time; write \
        `#[nonholonomic]` for one on the velocities";
    input_outside_force() = "an input acts through a force; take `&Inputs` in a `#[force]` function";
}

// Syntax that the language does not have.
messages! {
    unsupported_syntax(what) = "{what} cannot be turned into an equation; use arithmetic, `let`, `for` over \
        constant ranges and functions of this impl block";
    unsupported_literal() = "this literal is no number; only numbers and `true` or `false` can be used";
    unsupported_macro(name) = "`{name}!` cannot be turned into an equation; `vector!`, `matrix!` and \
        `point!` can";
    idle_macro(name) = "`{name}!` has no part in an equation; remove it";
    caret(power) = "`^` is no power in Rust, and has no part in an equation; for a power write `.{power}`";
    unsupported_pattern() = "this pattern is not supported; use names, `_`, tuples and arrays";
    refutable_pattern() = "this pattern does not match every value; use names, `_`, tuples and arrays";
    struct_literal() = "a struct cannot be built here; use a tuple or an array";
    break_with_value() = "a loop has no value here; assign to a variable before the loop ends";
    call_of_value() = "only functions can be called; name the function directly";
    moving_closure() = "a closure in a variable reads what is in sight where it stands; leave out `move`, or make it a \
        function of this impl block";
    escaped_closure() = "this closure has left the block that it stands in; call it there, or make it a function of this \
        impl block";
    closure_argument(name) = "`{name}` is inlined for values and takes no closure; call the closure here, or make it a \
        function of this impl block";
    closure_expected() = "a closure is expected here; write `|x| …` or the path of a function";
    closure_arguments(given, taken) = "this closure is called with {given} but takes {taken}";
    trailing_semicolon(name) = "the `;` throws away what `{name}` should return; remove the `;`";
    mutable_reference() = "`&mut` cannot be followed here; return the new value instead";
    unbounded_loop() = "the macro cannot tell when this loop ends; use `for` over a constant range";
    if_let() = "`if let` and `let … else` decide at run time; use plain `let`";
    question_mark() = "`?` cannot leave a role early; its result has a value everywhere";
    conditional_code() = "whether this is there is decided after the macro has run; put `cfg` on the impl block, and write \
        one block for each case";
    unknown_length(length, function) = "`{length}` of `{function}` does not follow from these arguments; pass an array, \
        vector or matrix whose size is written in the description";
    local_item(name) = "`{name}` is declared inside this function, where the macro does not look into it; use functions and \
        constants of this impl block";
    captured_change(name) = "when this closure runs is up to the iterator, so the macro cannot tell what becomes of \
        `{name}`; use a `for` loop";
    wrong_suffix(suffix, digits, scalar) = "the suffix `{suffix}` does not fit the scalar `{scalar}`; write \
        `{digits}`";
    too_deep(levels) = "expressions are nested more than {levels} deep here, which would take more stack than the compiler has; \
        name parts of it by `let`, or add up long sums in a loop";
    too_large(nodes) = "this description has more than {nodes} different subexpressions, more than can be differentiated in \
        reasonable time; describe a smaller system";
    runaway(steps) = "this description takes more than {steps} steps to unroll; shorten its loops";
}

// Names.
messages! {
    unknown_variable(name; near) = "there is no variable `{name}` here{near}; fields of the struct are \
        written `self.name`";
    bare_quantity(kind, name, path) = "`{name}` is {kind}; write `{path}`";
    quantity_without_parameter(kind, name, parameter, path) = "`{name}` is {kind}; add \
        `{parameter}` to the parameters and write `{path}`";
    missing_parameter(name, ty) = "there is no variable `{name}` here; add `{name}: {ty}` to the parameters";
    hidden_by_import(name) = "an import of everything (`use …::*`) may bring another `{name}` into this function; import it \
        by its name";
    later_constant(name) = "`{name}` is declared further down; declare a constant before those that use it";
    constant_in_pattern(name) = "`{name}` may be a constant outside the macro's sight or a new name; write a literal or \
        `Self::{name}`, or the new name in small letters";
    other_context(name) = "this `{name}` is not the variable `{name}` of the macro around it; pass it to the macro, or give \
        it another name";
    unknown_path(path; near) = "`{path}` is neither a constant nor a function that the macro knows{near}; \
        constants are written in capitals";
    unknown_quantity(kind, name, declared; near) = "there is no {kind} `{name}`{near}; declared are \
        `{declared}`";
    velocity_of_coordinate(name, coordinate) = "there is no coordinate `{name}`; the velocity of `{coordinate}` is \
        `v.{coordinate}`, with `v: &Velocities` among the parameters";
    unknown_field(value, name) = "{value} has no field `{name}`; use a component or a method it has";
    unknown_method(value, name; near) = "{value} has no method `{name}` that the macro knows{near}; write \
        it out, or put it into a function of this impl block";
    rotation_as_matrix(rotation, what) = "{rotation} counts as no matrix, also after `into_inner`; name its matrix, as in \
        `rotation.matrix().{what}`";
    rotation_among_matrices(rotation) = "{rotation} counts as no matrix, also after `into_inner`; name its matrix, as in \
        `*rotation.matrix()`";
    array_as_vector(array, name) = "{array} has no method `{name}`; make a vector of it, as by `Vector2::from(…)`";
    field_called(name) = "`{name}` is a field, not a method; remove the parentheses";
    unknown_function(name; near) = "there is no function `{name}` that the macro knows{near}; only functions \
        of this impl block and of nalgebra's small types can be used";
    unknown_helper(name; near) = "there is no function `{name}` in this impl block{near}; only functions of \
        this impl block can be inlined";
    free_function(name) = "only functions of this impl block can be inlined; move `{name}` in as an \
        associated function and call it by `Self::`, or make its value a field";
    unknown_type(path) = "the macro does not know the type in `{path}`; give a type of nalgebra its own name, as in \
        `Vector3::new(…)`, or move a function of your own in as an associated function and call it by `Self::`";
    function_elsewhere(name, call) = "there is no function `{name}` in this impl block; did you mean `{call}`? Move a \
        function of your own in as an associated function and call it by `Self::{name}(…)`";
    foreign_value(name) = "`{name}(…)` makes a value that has no part in an equation; write the number, the vector or \
        the pose itself";
    velocity_of_more(name) = "`{name}` is a function of more than coordinates and time, so its velocity is not known; \
        let it take `q: &Coordinates` and `t` only, and read all else from `self`";
    no_velocity(name, value) = "`{name}` returns {value}, which has no velocity; let it return numbers, vectors, poses or \
        arrays of them";
    function_as_method(name, call) = "`{name}` is a method of numbers; write `{call}`";
    helper_without_self(name) = "`{name}` is a function of this impl block; call it as `self.{name}(…)` or \
        `Self::{name}(…)`";
    foreign_method(path, name; near) = "`{path}.{name}(…)` cannot be seen by the macro{near}; only functions \
        of this impl block can be inlined";
    not_a_method(name) = "`{name}` does not take `self`; call it as `Self::{name}(…)`";
    needs_self(name) = "`{name}` takes `self`; call it as `self.{name}(…)`";
    argument_count(name, expected, given) = "`{name}` takes {expected}, {given} given";
    bad_arguments(name) = "`{name}` cannot be called with these arguments; it needs constant counts";
    logarithm_without_base() = "`log` takes its base; the natural logarithm is `ln()`, and there are `log2()` and `log10()`";
    recursion(cycle) = "these functions call each other: `{cycle}`; a helper is inlined and must not reach itself, \
        even where the calls would end; use a loop with a constant count";
    assignment_to_unknown(name) = "there is no variable `{name}` to assign to; declare it with `let mut`";
    assignment_to_self() = "parameters cannot be changed; copy the field into a `let mut` variable";
    assignment_to_record(name) = "a description computes, it does not change `{name}`; copy the value into a \
        `let mut` variable";
    bad_place() = "cannot assign here; assign to a variable, an element or a component of one";
}

// Shapes.
messages! {
    wrong_shape(expected, found) = "{expected} is expected here, not {found}; convert it or change the type";
    taken_for_scalar(path, other) = "`{path}` was taken for a scalar, and here it meets {other}; name it with its type first, \
        as in `let value: Vector2<f64> = {path};`";
    method_of_scalar(path, name) = "`{path}` was taken for a scalar, which has no method `{name}`; name it with its type \
        first, as in `let value: Vector2<f64> = {path};`";
    cannot_add(right, left) = "{right} cannot be added to {left}; bring both to the same shape";
    cannot_subtract(right, left) = "{right} cannot be subtracted from {left}; bring both to the same shape";
    cannot_multiply(left, right) = "{left} cannot be multiplied by {right}; for vectors use `.dot(…)`, \
        `.cross(…)` or `.component_mul(…)`";
    cannot_divide(left, right) = "{left} cannot be divided by {right}; divide by a scalar";
    cannot_compare(left, right) = "{left} cannot be compared with {right}; compare constants of one type";
    conditions_compared(operator, joined) = "conditions known at run time cannot be compared; for `a {operator} b` write \
        `{joined}`";
    cannot_index(value) = "{value} cannot be indexed like this; use an element of an array or a component \
        of a vector";
    bad_operand(operator, value) = "`{operator}` cannot be applied to {value}; apply it to numbers";
    lengths_differ(method, left, right) = "`{method}` needs equal lengths, but is called on {left} with \
        {right}";
    wrong_dimension(method, value) = "`{method}` does not exist for {value}; write its components out";
    bad_constructor_arguments(name, given) = "`{name}` cannot be called with these arguments ({given}); \
        check their number and shapes";
    ragged_matrix() = "the rows of this matrix differ in length; give all rows the same number of entries";
    unknown_shape(path) = "the shape of `{path}` is not known to the macro; name it first, as in \
        `let value: Vector3<f64> = {path};`";
    record_as_value(holder, kind, field) = "`{holder}` holds all {kind}; write the one that is meant, as in \
        `{field}`";
    self_as_value() = "`self` is no quantity; use one of its fields";
    axis_not_fixed() = "the axis of this rotation vector moves, and a Taylor series of its rotation is not known near zero; make the \
        orientation a coordinate (`attitude: Rotation`), give the axis by itself, `Rotation3::from_axis_angle(&axis, angle)`, or \
        compose rotations about fixed axes";
    component_of_rotation(name) = "an orientation has two quaternions of opposite signs, so `{name}` is no function of it; compare \
        directions, `rotation * Vector3::z()`, or use an entry, `rotation.to_rotation_matrix()[(2, 2)]`";
    unchecked_quaternion() = "whether this quaternion has length one is not known here; write \
        `UnitQuaternion::from_quaternion(…)`, which divides by its length";
    pattern_mismatch(value) = "this pattern does not fit {value}; name the value as a whole";
    pattern_length(expected, found) = "this pattern has {expected} for {found}; name each, or \
        skip some with `..`";
    from_fn_length() = "the length of this array is not known to the macro; name it first, as in \
        `let values: [f64; 3] = array::from_fn(…);`";
    other_precision(scalar) = "this is not the precision of the description, so it rounds; use `{scalar}` throughout";
    other_constant(path) = "`{path}` is not the number of this name in the standard library; give the constant another name";
    rounding_decides() = "how rounding decides this comparison is not known to the macro; compare literals, sums and products \
        of them, or integers";
    width_decides() = "the width of the target decides what becomes of this integer; use a type of fixed width";
    bad_cast(value) = "{value} cannot be cast like this; cast integers with `as f64`";
    condition_as_number(holds, fails) = "a condition known at run time does not convert to a number; write \
        `if condition {{ {holds} }} else {{ {fails} }}`";
    conversion_of_variable(function) = "`{function}` converts constants only; this depends on the state";
    conversion_of_formula(function) = "`{function}` converts one constant or field; convert each by itself \
        and compute with the results";
}

// Constants, branches and loops.
messages! {
    integer_for_scalar(value) = "this is an integer where a number of the scalar type is needed; write \
        `{value}.0` or convert it with `as f64`";
    integer_variable(name, float) = "`{name}` is an integer where a number of the scalar type is needed; \
        write `{name} as {float}`";
    integer_quotient(left, right) = "this divides integers, which drops the fraction; write \
        `{left} / {right}`";
    integer_in_quotient(value, quotient, float) = "this is an integer where a number of the scalar type is needed; write \
        `{value}.0`, or convert the quotient of integers, which drops the fraction: `{quotient} as {float}`";
    not_an_integer(value) = "a constant integer is needed here, not {value}";
    parameter_as_integer(path) = "the value of `{path}` is not known to the macro; use a literal or a \
        `const` of this impl block, written `Self::NAME`";
    integer_division_by_zero() = "this divides an integer by zero; check the bounds of the loop";
    integer_overflow() = "this integer is out of range; use smaller constants";
    division_by_zero() = "this divides by zero; the equation would have no value";
    clamp_reversed() = "`clamp` panics where its first bound is larger than its second; swap them";
    remainder() = "`%` jumps, so it has no derivative; use a trigonometric function for what repeats itself, or for \
        parameters a field with the remainder";
    not_smooth(name, alternative) = "`{name}` has no derivative everywhere; {alternative}";
    rounding_jumps(name) = "`{name}` of this constant is not known to the macro, since it jumps where rounding decides; write its \
        value as a number";
    bad_power(most) = "`powi` needs a constant integer between -{most} and {most}; use `powf` for other powers";
    branch_on_variable(on, what) = "the branch depends on {on}: {what} is one expression, or several joined by `if` with \
        `<`, `<=`, `>` or `>=` between numbers, also under `&&`, `||` and `!`; decide on constants only, compare in that \
        way, or use smooth functions such as `tanh`";
    branch_on_count(path) = "the branch depends on the whole number `{path}`: the macro does not know its value or type; \
        compare it as a number, as in `if ({path} as f64) > 2.0`";
    branch_on_parameter(path) = "the branch depends on the parameter `{path}`: the macro does not know its value; let it \
        be a number and compare it, as in `if {path} > 0.5`";
    unmixed_choice(then, otherwise) = "the sides of this branch on the state are {then} and {otherwise}; let both be \
        numbers, vectors or arrays of one size";
    no_arm() = "no arm matches this constant; add an arm with `_`";
    bound_not_constant(value) = "the bound of this range is {value}, not a constant integer; use a literal or \
        a `const` of this impl block, and for a condition two comparisons, as in `0.0 < x && x < 1.0`";
    parameter_bound(path) = "the bound `{path}` is not known to the macro; use a literal or a `const` of \
        this impl block, written `Self::NAME`";
    open_range() = "this range has no end; write both bounds";
    loop_over_parameter(path, label, scalar) = "the length of `{path}` is not known to the macro; write \
        `let {label}: [{scalar}; 3] = {path};` with its length first, or loop over a constant range";
    not_iterable(value) = "cannot loop over {value}; loop over a constant range or an array";
    index_out_of_range(index, valid) = "the index {index} is out of range; {valid}";
    negative_index(index) = "the index {index} is negative; check the bounds of the loop";
    slice_out_of_range(length) = "this range does not lie within the array; it has {length}";
}

// The meaning of roles.
messages! {
    attribute_depends_on(name) = "`{name}` is not in sight here: what stands in an attribute is the same all \
        through a run; use fields of `self`, or where a mass varies write the energy as a `#[kinetic]` function";
    wrong_number_of(what, expected, found) = "`{what}` has {found} for {expected}; give one for each, or one \
        scalar for all";
    array_for_single(what) = "several values of {what} are given for one element; index the one that is meant";
    moments_in_the_plane() = "a body in the plane has one moment of inertia, about its centre of mass; give a number";
    asymmetric_inertia() = "this matrix of inertia is not symmetric; entries on both sides of the diagonal are the same \
        product of inertia";
    wrong_inertia(found) = "the inertia of a body in space is three principal moments or a `Matrix3`, not \
        {found}";
    unknown_force_target(name; near) = "there is no function `{name}` for the force to act at{near}; name one that \
        returns a position or a pose, such as a `#[point]` or `#[body]`";
    not_a_place(name) = "`{name}` is no place; a force acts at a function of `&Coordinates` that returns a \
        position or a pose";
    eliminated_count(name, constraints, coordinates) = "`{name}` is {constraints} and cannot eliminate \
        {coordinates}; name one coordinate for each, or write functions of their own";
    idle_baumgarte() = "there is no constraint to stabilise; remove `baumgarte`, or say `allow(no_effect)`";
    bad_baumgarte() = "the rate of Baumgarte's stabilisation must be positive; write how fast an error shall decay \
        [1/s]";
    not_a_parameter() = "derivatives are taken by single parameters: name a field as the formulas do, such as `self.mass`";
    several_parameters(path) = "`{path}` is several parameters; name one, such as `{path}[0]`";
    idle_sensitivity(path) = "no formula uses `{path}`, so nothing depends on it; remove it here";
    repeated_sensitivity(path) = "`{path}` is listed twice; its derivatives are one column, so name it once";
    index_into_single(name) = "`{name}` is no array; remove the index";
}
