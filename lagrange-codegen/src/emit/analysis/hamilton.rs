//! The Hamiltonian form: Legendre's transformation and the canonical equations.

use crate::emit::body::{self, Source};
use crate::emit::methods::method;
use crate::emit::names::Names;
use crate::emit::{Emission, block};
use crate::expr::NodeId;
use crate::number::Number;
use crate::schedule::plan;
use crate::simplify::simplify;

/// All methods. Momenta that are affine in the velocities are solved for in one step.
pub(super) fn methods(emission: &mut Emission<'_>, affine: bool) -> String {
    let scalar = emission.scalar.to_string();
    let vector = emission.vector_type();
    let place = format!("&self, t: {scalar}, q: &{vector}, p: &{vector}");
    let result = |ty: &str| format!("::core::result::Result<{ty}, lagrange::MotionError<{scalar}>>");
    let mut text = method(
        "Velocities that belong to momenta, p = ∂L/∂v(t, q, v): the inverse of `momenta`, by Newton's method where p is not affine \
         in v.\n\n# Errors\n\nA singular ∂²L/∂v∂v, or momenta that no velocities have.",
        &format!("velocities_from_momenta({place}) -> {}", result(&vector)),
        &velocities(emission, affine),
    );
    let energy = if emission.equations.jacobi_integral.is_some() { "jacobi_integral" } else { "energy" };
    text.push_str(&method(
        "Hamiltonian H(t, q, p) = p·v − L at the velocities that belong to p \\[J\\].\n\n# Errors\n\n\
         As `velocities_from_momenta`.",
        &format!("hamiltonian({place}) -> {}", result(&scalar)),
        &format!(
            "let v = self.velocities_from_momenta(t, q, p)?;\n\
             ::core::result::Result::Ok(self.{energy}(&lagrange::State {{ t, q: *q, v }}))"
        ),
    ));
    text.push_str("#[allow(unused_variables)]\n");
    text.push_str(&canonical(emission, &place, &result(&format!("({vector}, {vector})"))));
    text
}

fn velocities(emission: &mut Emission<'_>, affine: bool) -> String {
    let equations = emission.equations;
    let count = emission.count();
    let mut nodes: Vec<NodeId> = equations.mass.rows().iter().flatten().copied().collect();
    nodes.extend(&equations.momenta);
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let scalar = emission.scalar.clone();
    let body = body::plain(emission.model, &scalar, &nodes, Source::Slices, |values| {
        let (mass, momenta) = values.split_at(nodes.len() - count);
        format!("{}(mass, [{}])", body::lower_triangle(&scalar, count, mass), momenta.join(", "))
    });
    format!(
        "lagrange::analysis::velocities(|v: &{}| {{\nlet _ = v;\n{body}\n}}, t, p, {affine})\
         .map_err(|error| error.named(&<Self as lagrange::System<{count}, {}>>::NAMES))",
        emission.vector_type(),
        emission.model.inputs.len()
    )
}

/// q̇ = v, ṗ = ∂L/∂q + Q − ∂D/∂v + Aᵀλ.
fn canonical(emission: &mut Emission<'_>, place: &str, result: &str) -> String {
    let equations = emission.equations;
    let (count, held) = (emission.count(), equations.conditions.count());
    let given = emission.model.inputs.len();
    let graph = &mut emission.model.graph;
    let rates: Vec<NodeId> = (0..count)
        .map(|i| {
            let mut terms = vec![(equations.momentum_rates[i], Number::ONE)];
            terms.extend(equations.conditions.reactions.get(i).map(|&reaction| (reaction, Number::ONE)));
            graph.sum(Number::ZERO, &terms)
        })
        .collect();
    let rates = simplify(&mut emission.model.graph, &mut emission.model.hints, &rates);
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let program = plan(&model.graph, &rates);
    let written = block::write(model, scalar, &program, &program.outputs, &[], &mut Names::new(model));
    let mut text =
        "let velocities = self.velocities_from_momenta(t, q, p)?;\nlet v = &velocities;\n".to_owned();
    let (parameter, argument) =
        if given == 0 { (String::new(), "&[]") } else { (format!(", u: &{}", emission.input_type()), "u") };
    if held > 0 {
        let surface = format!("<Self as lagrange::Surface<{count}, {given}, {held}>>");
        let system = format!("<Self as lagrange::System<{count}, {given}>>");
        text.push_str(&format!(
            "let balance = {surface}::balance_at(self, &{system}::constants(self), t, q, v, {argument});\n\
             lagrange::constraints::finite::<Self, {count}, {given}, {held}>\
             (self, &lagrange::State {{ t, q: *q, v: velocities }}, &balance)?;\n\
             let [{}] = balance.multipliers;\n",
            model.locals.multipliers.join(", ")
        ));
    }
    let mut inner = body::prologue(model, scalar, &written.reads, Source::Slices);
    inner.push_str(&body::assemble(&written));
    inner.push_str(&written.outputs.list());
    text.push_str(&format!(
        "let rates: {} = {{\n{}\n}};\n::core::result::Result::Ok((velocities, rates))",
        emission.vector_type(),
        body::imported(inner)
    ));
    method(
        "Canonical equations: q̇ = ∂H/∂p and ṗ = −∂H/∂q + Q − ∂D/∂v + Aᵀλ, as (q̇, ṗ).\n\n# Errors\n\n\
         As `velocities_from_momenta`, and where constraints have no multipliers.",
        &format!("canonical_at({place}{parameter}) -> {result}"),
        &text,
    )
}
