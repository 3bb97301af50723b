//! The items of a system whose equations switch: the runtime's `Switching`, and the system of one regime as a
//! struct of numbers.

mod directed;
mod functions;
mod jumps;

use proc_macro2::TokenStream;

use super::body::{self, Source};
use super::constraints::record_ident;
use super::tokens::placeholder;
use super::{Emission, companion, hidden, names, names_of_parts};
use crate::calculus::sizes;
use crate::expr::{Dependence, NodeId};
use crate::model::{Law, Normal};
use crate::regimes::Regimes;
use crate::syntax::Scalar;
pub(super) use jumps::passed;

/// The name of the struct of one regime, which no user writes.
const NAME: &str = "__InRegime";

/// The type parameter of `functions_in` and `backward_in`, a name that no user's generics have.
const NUMBER: &str = "__Number";

/// The emitted items.
pub(super) struct Items {
    /// The system of one regime.
    pub companion: TokenStream,
    /// The items of `Switching`, as text.
    pub switching: String,
    /// The items of `Constrained` of a system with contacts, as text.
    pub constrained: Option<String>,
    /// The number of rows.
    pub rows: usize,
    /// The number of kinks.
    pub kinks: usize,
}

/// The integrator of a system whose equations switch.
pub(super) fn method(switching: &Regimes) -> String {
    let inner = if switching.jets.is_some() { "Jets" } else { "Dop853" };
    format!("lagrange::Hybrid<lagrange::{inner}, {}, {}>", switching.rows(), switching.kinks.len())
}

/// Lines for `STRUCTURE`.
pub(super) fn facts(switching: &Regimes) -> Vec<String> {
    let mut facts = Vec::new();
    let contacts = switching.rows.constraints.iter().zip(&switching.laws_of);
    let named = |wanted: fn(&Law) -> bool| -> Vec<String> {
        let own = contacts.clone().filter(|(_, law)| law.as_ref().is_some_and(wanted));
        own.map(|(row, _)| format!("`{}`", row.written())).collect()
    };
    let gaps = named(|law| matches!(law, Law::Unilateral { .. }));
    if !gaps.is_empty() {
        facts.push(format!("unilateral contacts: {}", gaps.join(", ")));
    }
    let frictions = named(|law| matches!(law, Law::Friction { .. }));
    if !frictions.is_empty() {
        facts.push(format!("dry friction: {}", frictions.join(", ")));
    }
    if !switching.kinks.is_empty() {
        facts.push(format!(
            "functions with a kink or a jump, switched at its zeros: {}",
            switching.kinks.len()
        ));
    }
    match &switching.jets {
        Some(jets) => facts.push(format!("between switches {}", jets.describe())),
        None => facts.push("not smooth between switches, so there is no Taylor series".to_owned()),
    }
    facts
}

/// All items. `emission` is that of the system itself.
pub(super) fn regimes(emission: &Emission<'_>, switching: &mut Regimes) -> Items {
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let items = self::switching(emission, switching);
    let constrained = switching.has_contacts().then(|| constrained(emission, rows, kinks));
    let mut companion = Emission {
        item: emission.item,
        scalar: companion_scalar(emission),
        is_over: emission.is_over,
        model: &mut switching.model,
        equations: &switching.equations,
        solved: switching.turned.as_ref().unwrap_or(&switching.equations),
        facts: &switching.facts,
        solution: &switching.solution,
        hidden: switching.hidden[0].as_ref(),
        in_events: emission.in_events,
        jets: switching.jets.as_ref(),
        orders: switching.orders.as_ref(),
        method: None,
    };
    let companion = companion::companion(&mut companion, NAME, None, |_| String::new());
    Items { companion, switching: items, constrained, rows, kinks }
}

/// The items of `Switching` over the scalar of `emission`.
pub(super) fn switching(emission: &Emission<'_>, switching: &mut Regimes) -> String {
    switching.model.locals = names::locals(&switching.model, emission.item.least_loop);
    let items = [
        regime(emission, switching),
        laws(emission, switching),
        jumps::jumps(emission, switching),
        jumps::corners(emission, switching),
        jumps::breaks(emission, switching),
        functions::functions(emission, switching),
        directed::coefficients(emission, switching),
        directed::backward(emission, switching),
        hidden::in_guards(emission, switching),
        if switching.has_contacts() { equations(emission, switching.rows()) } else { String::new() },
    ];
    items.concat()
}

/// The scalar of the system of one regime: any scalar if motions have derivatives.
fn companion_scalar(emission: &Emission<'_>) -> Scalar {
    if emission.item.jacobians { companion::any(&emission.scalar) } else { emission.scalar.clone() }
}

/// The items of `System` of a system with contacts. Its accelerations are those of its regime.
pub(super) fn system(emission: &Emission<'_>, switching: &Regimes, constants: &str) -> String {
    let scalar = &emission.scalar;
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let place = format!("t: {scalar}, q: &{vector}, v: &{vector}");
    format!(
        "type Scalar = {scalar};\ntype Method = {};\n{constants}{}\
         const SWITCHED: bool = true;\n\
         fn accelerations_at(&self, _constants: &Self::Constants, {place}, u: &{inputs}) -> {vector} {{\n\
         lagrange::switching::accelerations::<Self, {count}, {given}, {rows}, {kinks}>(self, t, q, v, u)\n}}\n\
         fn energy_at(&self, _constants: &Self::Constants, {place}) -> {scalar} \
         {{\nself.energy(&lagrange::State {{ t, q: *q, v: *v }})\n}}\n",
        emission.method(),
        names_of_parts(&switching.rows),
    )
}

/// `InRegime`, `ROWS` and `in_regime`, and where they differ from their defaults `POISSON`, `KINKS` and
/// `AUTONOMOUS`.
fn regime(emission: &Emission<'_>, switching: &Regimes) -> String {
    let scalar = &emission.scalar;
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let row = |law: &Option<Law>| match law {
        None => "lagrange::Row::Bilateral".to_owned(),
        Some(Law::Unilateral { .. }) => "lagrange::Row::Unilateral".to_owned(),
        Some(Law::Friction { normal, pair, .. }) => {
            let option = |index: Option<usize>| match index {
                Some(index) => format!("::core::option::Option::Some({index})"),
                None => "::core::option::Option::None".to_owned(),
            };
            let normal = normal.map(|(Normal::Row(row) | Normal::Load(row))| row);
            format!("lagrange::Row::Friction {{ normal: {}, pair: {} }}", option(normal), option(*pair))
        }
    };
    let laws = switching.laws_of.len();
    let others = std::iter::repeat_n("lagrange::Row::Load".to_owned(), rows - laws);
    let kinds: Vec<String> = switching.laws_of.iter().map(row).chain(others).collect();
    let mut values = String::new();
    let mut numbers = Vec::new();
    for (index, name) in (0_u32..).zip(&emission.model.locals.parameters) {
        values.push_str(&format!("let {name}: {scalar} = {};\n", placeholder(index)));
        numbers.push(name.clone());
    }
    numbers.extend((0..laws).map(|row| format!("__regime.activity({row})")));
    for list in ["slip", "side"] {
        numbers.extend((0..laws).map(|row| format!("__regime.{list}[{row}]")));
    }
    numbers.extend((0..kinks).map(|kink| format!("__regime.kinks[{kink}]")));
    let names: Vec<String> =
        switching.kink_names.iter().map(|name| format!("lagrange::Name::new(&{name:?})")).collect();
    let named = match kinks {
        0 => String::new(),
        _ => format!("const KINKS: [lagrange::Name; {kinks}] = [{}];\n", names.join(", ")),
    };
    let by_poisson = |law: &Option<Law>| matches!(law, Some(Law::Unilateral { poisson: true, .. }));
    let others = std::iter::repeat_n("false".to_owned(), rows - laws);
    let poisson = switching.laws_of.iter().map(|law| by_poisson(law).to_string());
    let poisson: Vec<String> = poisson.chain(others).collect();
    let poisson = if switching.laws_of.iter().any(by_poisson) {
        format!("const POISSON: [bool; {rows}] = [{}];\n", poisson.join(", "))
    } else {
        String::new()
    };
    let timeless = if is_autonomous(switching) { "const AUTONOMOUS: bool = true;\n" } else { "" };
    let varying = if has_varying_friction(switching) { "const VARYING: bool = true;\n" } else { "" };
    let generic = match companion_scalar(emission) {
        Scalar::Generic(_) => format!("<{scalar}>"),
        Scalar::F64 | Scalar::F32 => String::new(),
    };
    format!(
        "type InRegime = {NAME}{generic};\n\
         const ROWS: [lagrange::Row; {rows}] = [{}];\n{poisson}{named}{timeless}{varying}\
         fn in_regime(&self, __regime: &lagrange::Regime<{scalar}, {rows}, {kinks}>) -> {NAME}{generic} {{\n\
         {values}{NAME} {{ parameters: [{}] }}\n}}\n",
        kinds.join(", "),
        numbers.join(", ")
    )
}

/// Whether any coefficient of friction changes with the state or with time. Inputs are held, and restitution
/// counts in impacts alone.
fn has_varying_friction(switching: &Regimes) -> bool {
    let changes = Dependence::COORDINATES.union(Dependence::VELOCITIES).union(Dependence::TIME);
    let varies = |node: &NodeId| switching.rows.graph.dependence(*node).meets(changes);
    switching.laws_of.iter().flatten().any(|law| match law {
        Law::Unilateral { .. } => false,
        Law::Friction { kinetic, fixed, .. } => varies(kinetic) || varies(fixed),
    })
}

/// Whether no equation and no law depends on time.
fn is_autonomous(switching: &Regimes) -> bool {
    let conditions = &switching.laws.conditions;
    let coefficients = switching.laws_of.iter().flatten().flat_map(|law| match law {
        Law::Unilateral { restitution, .. } => [*restitution; 2],
        Law::Friction { kinetic, fixed, .. } => [*kinetic, *fixed],
    });
    let rows = conditions.positions.iter().chain(&conditions.rates).chain(&switching.kinks);
    let factors =
        switching.rows.loads.iter().flat_map(|load| &load.force).flatten().map(|&(_, factor)| factor);
    let mut laws = rows.copied().chain(coefficients).chain(factors);
    switching.facts.autonomous
        && !laws.any(|node| switching.rows.graph.dependence(node).meets(Dependence::TIME))
}

/// `laws_at`.
fn laws(emission: &Emission<'_>, switching: &mut Regimes) -> String {
    let (scalar, vector, inputs) = (&emission.scalar, emission.vector_type(), emission.input_type());
    let (rows, kinks) = (switching.rows(), switching.kinks.len());
    let conditions = &switching.laws.conditions;
    let zero = switching.rows.graph.zero();
    let of = |number: fn(&Law) -> Option<NodeId>| -> Vec<NodeId> {
        let known = switching.laws_of.iter().map(|law| law.as_ref().and_then(number).unwrap_or(zero));
        known.chain(std::iter::repeat_n(zero, rows - switching.laws_of.len())).collect()
    };
    let restitution = of(|law| match law {
        Law::Unilateral { restitution, .. } => Some(*restitution),
        Law::Friction { .. } => None,
    });
    let friction: [fn(&Law) -> Option<NodeId>; 2] = match &switching.coefficients {
        // `coefficients_in` gives them.
        Some(_) => [|_| None; 2],
        None => [
            |law| if let Law::Friction { kinetic, .. } = law { Some(*kinetic) } else { None },
            |law| if let Law::Friction { fixed, .. } = law { Some(*fixed) } else { None },
        ],
    };
    let lists = [
        ("positions", conditions.positions.clone()),
        ("position_sizes", conditions.position_sizes.clone()),
        ("rates", conditions.rates.clone()),
        ("rate_sizes", conditions.rate_sizes.clone()),
        ("restitution", restitution),
        ("kinetic", of(friction[0])),
        ("fixed", of(friction[1])),
        ("kinks", switching.kinks.clone()),
        ("kink_sizes", sizes(&mut switching.rows.graph, &switching.kinks)),
    ];
    let roots: Vec<NodeId> = lists.iter().flat_map(|(_, nodes)| nodes.iter().copied()).collect();
    switching.rows.locals = names::locals(&switching.rows, emission.item.least_loop);
    let body = body::plain(&switching.rows, scalar, &roots, Source::Slices, |values| {
        let mut values = values.iter().cloned();
        let fields: Vec<String> = lists
            .iter()
            .map(|(name, nodes)| {
                let values: Vec<String> = values.by_ref().take(nodes.len()).collect();
                format!("{name}: [{}]", values.join(", "))
            })
            .collect();
        let (residuals, laws) = fields.split_at(4);
        format!(
            "lagrange::Laws {{ rows: lagrange::Residuals {{ {} }}, {} }}",
            residuals.join(", "),
            laws.join(", ")
        )
    });
    format!(
        "fn laws_at(&self, t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}) -> lagrange::Laws<{scalar}, {rows}, {kinks}> {{\n{body}\n}}\n"
    )
}

/// `equations_in` and `rows_in` of a system with contacts.
fn equations(emission: &Emission<'_>, rows: usize) -> String {
    let (scalar, vector, inputs) = (&emission.scalar, emission.vector_type(), emission.input_type());
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let place =
        format!("__in_regime: &Self::InRegime, t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}");
    let constants = format!("let constants = lagrange::System::<{count}, {given}>::constants(__in_regime);");
    format!(
        "fn equations_in({place}) \
         -> ::core::option::Option<lagrange::Equations<lagrange::saddle::Switched<{scalar}, {count}, {rows}>, {scalar}, {count}, {rows}>> {{\n\
         {constants}\n\
         ::core::option::Option::Some(lagrange::Surface::<{count}, {given}, {rows}>::equations_at(__in_regime, &constants, t, q, v, u))\n}}\n\
         fn rows_in({place}) -> ::core::option::Option<lagrange::saddle::SwitchedRows<{scalar}, {count}, {rows}>> {{\n\
         {constants}\n\
         ::core::option::Option::Some(__in_regime.parts_at(&constants, t, q, v, u).rows())\n}}\n"
    )
}

/// The items of `Constrained`: the reactions of the regime.
fn constrained(emission: &Emission<'_>, rows: usize, kinks: usize) -> String {
    let scalar = &emission.scalar;
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let (count, given) = (emission.count(), emission.model.inputs.len());
    let record = record_ident(emission.item);
    format!(
        "type Reactions = {record}<{scalar}>;\n\
         fn reactions_at(&self, _constants: &Self::Constants, t: {scalar}, q: &{vector}, v: &{vector}, u: &{inputs}) \
         -> lagrange::Reactions<{record}<{scalar}>> {{\n\
         let (multipliers, unique) = lagrange::switching::multipliers::<Self, {count}, {given}, {rows}, {kinks}>(self, t, q, v, u);\n\
         lagrange::Reactions::new(multipliers.into(), unique)\n}}\n"
    )
}
