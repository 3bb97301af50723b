//! `System` of a constrained model, and the runtime's `Surface` and `Constrained`.

use super::super::block::{Evaluation, Values};
use super::{
    factored, filled_switches, gradients, gradients_type, kinds, pattern, record_ident, saddle_type,
};
use crate::emit::block;
use crate::emit::body::{self, Source};
use crate::emit::hidden::hidden;
use crate::emit::names::Names;
use crate::emit::{Emission, names_of_parts as names};
use crate::expr::NodeId;
use crate::schedule::plan;
use crate::simplify::simplify;
use crate::structure::Saddle;

/// A system with constraints as text.
pub(in crate::emit) struct Implementations {
    /// The items of `System`.
    pub system: String,
    /// The statements that define the constants of a run.
    pub constants: String,
    /// The items of `Surface`.
    pub surface: String,
    /// The inherent function that they call, for a system with rows that can be switched off.
    pub parts: String,
    /// One evaluation of the accelerations.
    pub evaluation: Evaluation,
}

/// The implementations of `System` and `Surface`, with the constants of a run.
pub(in crate::emit) fn system(emission: &mut Emission<'_>, method: Saddle) -> Implementations {
    let (equations, constants_type, constants, evaluation) = equations(emission, method);
    let constants = format!(
        "type Constants = {constants_type};\n#[inline]\nfn constants(&self) -> Self::Constants {{\n{constants}\n}}\n"
    );
    let residuals = residuals(emission);
    let saddle = saddle(emission, method);
    let scalar = emission.scalar.to_string();
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let (count, given, held) =
        (emission.count(), emission.model.inputs.len(), emission.equations.conditions.count());
    let integrator = emission.method();
    let place = format!("t: {scalar}, q: &{vector}, v: &{vector}");
    let surface = format!("lagrange::Surface<{count}, {given}, {held}>");
    let on = format!("<Self as {surface}>::balance_at(self, constants, t, q, v, u).accelerations");
    let function = |name: &str, body: &str| {
        format!(
            "#[inline]\nfn {name}(&self, constants: &Self::Constants, {place}, u: &{inputs}) -> {vector} {{\n{body}\n}}\n"
        )
    };
    // A single row cannot depend on others. By Baumgarte's method a motion is beside the constraints on
    // purpose.
    let accelerations = if held > 1 && emission.model.baumgarte.is_none() {
        let beside = format!(
            "lagrange::constraints::accelerations::<Self, {count}, {given}, {held}>(self, constants, t, q, v, u)"
        );
        function("accelerations_at", &beside) + &function("accelerations_on_at", &on)
    } else {
        function("accelerations_at", &on)
    };
    // By Baumgarte's method a motion may begin beside the constraints, so its start is not corrected.
    let begin = if emission.model.baumgarte.is_some() { "let start = &mut start.clone();\n" } else { "" };
    let names = names(emission.model);
    let coupled = if held > 1 { "const COUPLED: bool = true;\n" } else { "" };
    let conserves = if conserves_energy(emission) { "const CONSERVES_ENERGY: bool = true;\n" } else { "" };
    let system = format!(
        "type Scalar = {scalar};\ntype Method = {integrator};\n{constants}\
         {names}\
         const CONSTRAINED: bool = true;\n{coupled}{conserves}\
         {accelerations}\
         fn check_at(&self, _constants: &Self::Constants, {place}) -> ::core::result::Result<(), lagrange::Cause> \
         {{\nlagrange::constraints::check::<Self, {count}, {given}, {held}>(self, t, q, v)\n}}\n\
         fn begin_at(&self, _constants: &Self::Constants, start: &mut lagrange::State<{scalar}, {count}>) \
         -> ::core::result::Result<(), lagrange::Cause> \
         {{\n{begin}lagrange::constraints::begin::<Self, {count}, {given}, {held}>(self, start)\n}}\n"
    );
    let project = if emission.model.baumgarte.is_some() {
        String::new()
    } else {
        format!(
            "#[inline]\nfn project_at(&self, _constants: &Self::Constants, state: &mut lagrange::State<{scalar}, {count}>, \
             from: ::core::option::Option<&lagrange::State<{scalar}, {count}>>) \
             -> ::core::result::Result<(), lagrange::Cause> \
             {{\nlagrange::constraints::project::<Self, {count}, {given}, {held}>(self, state, from)\n}}\n\
             #[inline]\nfn land_at(&self, constants: &Self::Constants, state: &mut lagrange::State<{scalar}, {count}>, \
             inputs: ::core::option::Option<&{inputs}>) \
             -> ::core::result::Result<lagrange::Footing<{scalar}, {count}>, lagrange::Cause> \
             {{\nlagrange::constraints::land::<Self, {count}, {given}, {held}>(self, constants, state, inputs)\n}}\n\
             fn tangential_at(&self, state: &lagrange::State<{scalar}, {count}>, \
             change: &lagrange::State<{scalar}, {count}>) -> lagrange::State<{scalar}, {count}> \
             {{\nlagrange::constraints::tangential::<Self, {count}, {given}, {held}>(self, state, change)\n}}\n"
        )
    };
    let lands = if emission.is_over
        && emission.model.baumgarte.is_none()
        && [Some(method), emission.solution.saddle_of_series].into_iter().all(decides_apart)
    {
        format!(
            "const LANDS_APART: bool = true;\n\
             #[inline]\nfn land_apart_at(&self, constants: &Self::Constants, state: &mut lagrange::State<{scalar}, {count}>, \
             inputs: &{inputs}) -> ::core::option::Option<lagrange::Apart<{scalar}, {count}>> \
             {{\nlagrange::constraints::land_apart::<Self, {count}, {given}, {held}>(self, constants, state, inputs)\n}}\n"
        )
    } else {
        String::new()
    };
    let energy = format!(
        "#[inline]\nfn energy_at(&self, _constants: &Self::Constants, {place}) -> {scalar} \
         {{\nself.energy(&lagrange::State {{ t, q: *q, v: *v }})\n}}\n"
    );
    let (equations, parts) = match method {
        Saddle::Switched { .. } => apart(emission, method, &equations),
        Saddle::Diagonal | Saddle::Sparse | Saddle::Whole { .. } => (equations, String::new()),
    };
    let surface = format!(
        "type Saddle = {};\n{}{}\
         #[inline]\nfn equations_at(&self, constants: &Self::Constants, {place}, u: &{inputs}) \
         -> lagrange::Equations<Self::Saddle, {scalar}, {count}, {held}> {{\n{equations}\n}}\n\
         #[inline]\nfn residuals_at(&self, {place}) -> lagrange::Residuals<{scalar}, {held}> {{\n{residuals}\n}}\n\
         #[inline]\nfn saddle_at(&self, {place}) -> (Self::Saddle, {}) {{\n{saddle}\n}}\n",
        saddle_type(emission, method),
        pattern(emission, method),
        holonomic(emission),
        gradients_type(emission, method)
    );
    Implementations {
        system: system + &project + &lands + &hidden(emission) + &energy,
        constants,
        surface,
        parts,
        evaluation,
    }
}

/// Which constraints are holonomic, if some are not. That matters to `Dop853` above all, which takes no
/// systems with rows that contacts and frictions switch: their rows all count as holonomic.
fn holonomic(emission: &Emission<'_>) -> String {
    let kinds = kinds(emission.model);
    if emission.equations.conditions.switched.is_some() || !kinds.contains(&false) {
        return String::new();
    }
    format!("const HOLONOMIC: [bool; {}] = {kinds:?};\n", kinds.len())
}

/// The body of `equations_at`, and the inherent function with `body`, which evaluates without factoring.
fn apart(emission: &Emission<'_>, method: Saddle, body: &str) -> (String, String) {
    let scalar = &emission.scalar;
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let (count, given, held) =
        (emission.count(), emission.model.inputs.len(), emission.equations.conditions.count());
    let (shares, named) = if emission.equations.conditions.has_loads() {
        (format!("[[{scalar}; {held}]; {held}]"), "shares")
    } else {
        ("()".to_owned(), "shares: ()")
    };
    let equations = format!(
        "let lagrange::saddle::Parts {{ mass, gradients, coupling, active, {named}, forces, gamma }} = \
         self.parts_at(constants, t, q, v, u);\n\
         lagrange::Equations {{ saddle: {}, gradients, forces, gamma }}",
        factored(emission, method)
    );
    let parts = format!(
        "#[inline]\nfn parts_at(&self, constants: &<Self as lagrange::System<{count}, {given}>>::Constants, \
         t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}) \
         -> lagrange::saddle::Parts<{scalar}, {count}, {held}, {shares}> {{\n{body}\n}}\n"
    );
    (equations, parts)
}

/// Whether each lane can be factored without regard to the others, if its constraints are clearly
/// independent.
fn decides_apart(method: Option<Saddle>) -> bool {
    matches!(method, Some(Saddle::Diagonal | Saddle::Whole { definite: true }))
}

/// Whether `energy_at` is proved to be constant along motions on the constraints. Motions by Baumgarte's
/// method leave them, and rows that contacts and frictions switch do work.
fn conserves_energy(emission: &Emission<'_>) -> bool {
    let facts = emission.facts;
    facts.conserves()
        && !facts.has_jacobi_integral
        && emission.model.baumgarte.is_none()
        && emission.equations.conditions.switches().is_empty()
}

/// The implementation of `Constrained` as text.
pub(in crate::emit) fn implementations(emission: &Emission<'_>) -> String {
    let scalar = &emission.scalar;
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let (count, given, held) =
        (emission.count(), emission.model.inputs.len(), emission.equations.conditions.count());
    let record = record_ident(emission.item);
    format!(
        "type Reactions = {record}<{scalar}>;\n\
         #[inline]\nfn reactions_at(&self, constants: &Self::Constants, t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}) \
         -> lagrange::Reactions<{record}<{scalar}>> {{\n\
         let balance = <Self as lagrange::Surface<{count}, {given}, {held}>>::balance_at(self, constants, t, q, v, u);\n\
         lagrange::Reactions::new(balance.multipliers.into(), balance.independence.rank == {held})\n}}\n"
    )
}

/// M, A, the forces and γ: the body of `equations_at`, type and body of the constants, and the
/// evaluation.
fn equations(emission: &mut Emission<'_>, method: Saddle) -> (String, String, String, Evaluation) {
    let equations = emission.equations;
    let (count, held) = (emission.count(), equations.conditions.count());
    let mass = masses(emission, method);
    let mut roots = mass.clone();
    roots.extend(equations.conditions.roots());
    roots.extend(&equations.force);
    let extra = equations.conditions.switches();
    roots.extend(&extra);
    let roots = simplify(&mut emission.model.graph, &mut emission.model.hints, &roots);
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let program = plan(&model.graph, &roots);
    let mut names = Names::new(model);
    let hoisted = program.hoisted();
    let fixed = body::constants(model, scalar, &program, &hoisted);
    let (labels, given) = body::labels(model, &program, &hoisted, false, &mut names);
    let written = block::write(model, scalar, &program, &program.outputs, &given, &mut names);

    let mut text = body::prologue(model, scalar, &written.reads, Source::Slices);
    text.push_str(&labels);
    text.push_str(&body::assemble(&written));
    let mut outputs = written.outputs;
    let (mass, gradients) = (outputs.take(mass.len()), outputs.take(count * held));
    text.push_str(&mass_and_gradients(emission, method, &mass, &gradients));
    let (gamma, forces) = (outputs.take(held).list(), outputs.take(count).list());
    text.push_str(&filled_switches(emission, &outputs.take(extra.len())));
    text.push_str(&match method {
        Saddle::Switched { .. } => {
            let shares = if emission.equations.conditions.has_loads() { "shares" } else { "shares: ()" };
            format!(
                "lagrange::saddle::Parts {{ mass, gradients, coupling, active, {shares}, forces: {forces}, gamma: {gamma} }}"
            )
        }
        Saddle::Diagonal | Saddle::Sparse | Saddle::Whole { .. } => format!(
            "lagrange::Equations {{ saddle: {}, gradients, forces: {forces}, gamma: {gamma} }}",
            factored(emission, method)
        ),
    });
    let parameters = body::parameters(model, scalar, &fixed.reads);
    let constants = format!("{parameters}{}{}", body::assemble(&fixed), fixed.outputs.list());
    let constants_type = format!("[{scalar}; {}]", hoisted.len());
    let evaluation = Evaluation { operations: program.operations(false), loops: written.loops };
    (body::imported(text), constants_type, body::imported(constants), evaluation)
}

/// 1 / M of a diagonal mass matrix, or its lower triangle.
fn masses(emission: &mut Emission<'_>, method: Saddle) -> Vec<NodeId> {
    let rows = emission.equations.mass.rows();
    match method {
        Saddle::Whole { .. } | Saddle::Switched { .. } => rows.iter().flatten().copied().collect(),
        Saddle::Diagonal | Saddle::Sparse => {
            let graph = &mut emission.model.graph;
            let one = graph.one();
            rows.iter().enumerate().map(|(i, row)| graph.div(one, row[i])).collect()
        }
    }
}

/// Statements that fill `mass` and `gradients`.
fn mass_and_gradients(emission: &Emission<'_>, method: Saddle, mass: &Values, gradient: &[String]) -> String {
    let (scalar, count) = (&emission.scalar, emission.count());
    let mass = match method {
        Saddle::Diagonal | Saddle::Sparse => format!("let mass = {};\n", mass.list()),
        Saddle::Whole { .. } | Saddle::Switched { .. } => body::lower_triangle(scalar, count, mass),
    };
    let rows: Vec<Vec<String>> = gradient.chunks(count).map(<[String]>::to_vec).collect();
    mass + &gradients(emission, method, &rows)
}

fn residuals(emission: &mut Emission<'_>) -> String {
    let conditions = &emission.equations.conditions;
    let held = conditions.count();
    let mut roots = conditions.positions.clone();
    roots.extend(&conditions.position_sizes);
    roots.extend(&conditions.rates);
    roots.extend(&conditions.rate_sizes);
    // The residuals are those of the user's own formulas, not of simplified ones.
    body::plain(emission.model, &emission.scalar, &roots, Source::Slices, |values| {
        let fields = ["positions", "position_sizes", "rates", "rate_sizes"];
        let fields: Vec<String> = fields
            .into_iter()
            .zip((0..).step_by(held))
            .map(|(name, first)| format!("{name}: {}", values.part(first..first + held).list()))
            .collect();
        format!("lagrange::Residuals {{ {} }}", fields.join(", "))
    })
}

fn saddle(emission: &mut Emission<'_>, method: Saddle) -> String {
    let (count, held) = (emission.count(), emission.equations.conditions.count());
    let mut roots = masses(emission, method);
    let split = roots.len();
    roots.extend(emission.equations.conditions.jacobian.iter().flatten());
    roots.extend(emission.equations.conditions.switches());
    let roots = simplify(&mut emission.model.graph, &mut emission.model.hints, &roots);
    let emission = &*emission;
    body::plain(emission.model, &emission.scalar, &roots, Source::Slices, |values| {
        let (gradient, extra) = values[split..].split_at(count * held);
        let filled = mass_and_gradients(emission, method, &values.part(0..split), gradient)
            + &filled_switches(emission, extra);
        format!("{filled}({}, gradients)", factored(emission, method))
    })
}
