//! The implementation of the runtime's `Smooth`: Taylor coefficients of the motion.
//!
//! | function | what it computes |
//! | --- | --- |
//! | `jet_constants` | parameters alone, once per run: hoisted values, inverses and factorisations of constant blocks |
//! | `jet_at` | values and the factorisation at the point of expansion, then one pass of a loop for each order |
//! | `followed` | the coefficients of reactions and of followed functions, if there are any |

mod constants;
mod names;
mod solvers;
mod tiles;

use super::block::{Known, Writer};
use super::gather::gather;
use super::names::{Names, describe};
use super::{Emission, body, scalar, turning};
use crate::jets::Jets;
use crate::orders::{Expansion, Expansions, Numbers, Sums, Tiles};
use crate::schedule::{Given, Instruction, Phase, Slot};
use crate::structure::Method;
use names::{Of, label_auxiliaries};

/// Rows of the tables of few products are padded to a multiple of this many columns.
const WIDTH: usize = 4;

/// The items of the trait, as text.
pub(super) fn jets(emission: &mut Emission<'_>, jets: &Jets, expansions: &Expansions) -> String {
    let is_own = emission.scalar == emission.item.scalar;
    let expansion = expansions.of(if is_own { Numbers::Plain } else { Numbers::Carrying });
    label_auxiliaries(emission, jets);
    let emission = &*emission;
    let (model, scalar, count) = (&*emission.model, &emission.scalar, emission.count());
    let mut names = Names::new(model);
    let of = Of::new(emission, jets, expansion, &mut names);
    let outputs = Outputs::of(expansion);
    let all = outputs.all();
    let hoisted = expansion.program.settled(Phase::Run, &all);
    let (constants_type, constants_body) = constants::constants(emission, expansion, &hoisted);
    let factored = constants_type.starts_with('(');
    let (labels, mut known) = body::labels(model, &expansion.program, &hoisted, factored, &mut names);
    known.extend(given(expansion, &of));
    let mut writer = Writer::new(model, scalar, &expansion.program, &all, &known);
    wishes(model, expansion, &of, &mut writer);
    let pass = Pass { emission, expansion, outputs: &outputs, of: &of };
    let statements = pass.write(&mut writer, &mut names);

    let reads = &writer.reads;
    let mut text = turning::entry(emission) + &body::prologue(model, scalar, reads, body::Source::Slices);
    text.push_str(&labels);
    text.push_str(&statements);
    let (tables, items) = match &expansion.sums {
        Sums::Many(tiles) => (
            format!("Columns<{scalar}, {}, ORDERS>", tiles.columns),
            tiles::items(model, tiles, &expansion.factors, &of),
        ),
        Sums::Few(products) => (format!("Tables<{scalar}, {}, ORDERS>", padded(products)), String::new()),
    };
    // Guards are functions of the state and of reactions.
    let (held, followed) = (reacting(expansion), expansion.followed.len());
    let (tables, opened, along) = if held == 0 && followed == 0 {
        (tables, String::new(), String::new())
    } else {
        let tables = format!("jets::Followed<lagrange::{tables}, {scalar}, {held}, {followed}, ORDERS>");
        let along = format!(
            "#[inline]\nfn followed<const ORDERS: usize>(tables: &lagrange::{tables}) \
             -> [&[{scalar}]; 2] {{\ntables.rows()\n}}\n"
        );
        let read = |is_read: bool, name: &str| if is_read { name.to_owned() } else { format!("{name}: _") };
        let opened = format!(
            "let lagrange::jets::Followed {{ {}, {}, {} }} = tables;\n",
            read(!expansion.factors.is_empty(), "tables"),
            read(held > 0, "reactions"),
            read(followed > 0, "functions")
        );
        (tables, opened, along)
    };
    let text = opened + &text;
    let (vector, inputs) = (emission.vector_type(), emission.input_type());
    let named = |is_read: bool, name: &str| if is_read { name.to_owned() } else { format!("_{name}") };
    let shares_pivots = emission.solution.blocks.iter().any(|block| matches!(block.method, Method::Lu));
    // Types are spelled out: if the trait is not found, `Self::Tables` would be a second error.
    format!(
        "{}type JetConstants = {constants_type};\n\
         type Tables<const ORDERS: usize> = lagrange::{tables};\n\
         #[inline]\nfn jet_constants(&self) -> {constants_type} {{\n{constants_body}\n}}\n\
         #[inline]\nfn jet_at<const ORDERS: usize>(\n&self, {}: &{constants_type}, {}: {scalar}, \
         {}: &{vector}, v: &{vector}, \
         {}: &{inputs}, h: {scalar}, orders: usize, {}: &mut lagrange::{tables}, \
         series: &mut lagrange::Series<{scalar}, {count}, ORDERS>,\n) -> bool {{\n{items}{}\n}}\n{along}",
        if shares_pivots { "const SHARES_PIVOTS: bool = true;\n" } else { "" },
        named(factored || !hoisted.is_empty(), "constants"),
        named(reads.time, "t"),
        named(reads.coordinates.contains(&true) || !emission.solved.turning.is_empty(), "q"),
        named(reads.inputs.contains(&true), "u"),
        named(!expansion.factors.is_empty() || held + followed > 0, "tables"),
        body::imported(gather(&text)),
    )
}

/// The number of rows of a system in which some rows hold at times; else zero.
fn reacting(expansion: &Expansion) -> usize {
    let rows = expansion.saddle.as_ref().filter(|saddle| !saddle.switches.is_empty());
    rows.map_or(0, |saddle| saddle.gradients.len())
}

/// The number of columns in the tables of some products.
fn padded(products: &[[usize; 2]]) -> usize {
    products.len().next_multiple_of(WIDTH)
}

/// The outputs of each part of the body.
struct Outputs {
    start: Vec<Slot>,
    order: Vec<Slot>,
    solution: Vec<Slot>,
    end: Vec<Slot>,
}

impl Outputs {
    fn of(expansion: &Expansion) -> Outputs {
        let mut start: Vec<Slot> = expansion.carried.iter().map(|carried| carried.start).collect();
        start.extend(solvers::at_start(expansion));
        let mut end: Vec<Slot> = expansion.factors.iter().map(|factor| factor.coefficient).collect();
        end.extend(expansion.carried.iter().map(|carried| carried.next));
        let series = expansion.coordinates.iter().chain(&expansion.velocities);
        let solution = series.chain(&expansion.followed).copied().collect();
        Outputs { start, order: solvers::in_order(expansion), solution, end }
    }

    /// The outputs of the loop over the orders.
    fn in_loop(&self) -> Vec<Slot> {
        [&self.order[..], &self.solution, &self.end].concat()
    }

    fn all(&self) -> Vec<Slot> {
        [&self.start[..], &self.order, &self.solution, &self.end].concat()
    }
}

/// The texts of the slots that an order is given, with their places and kinds.
fn given(expansion: &Expansion, of: &Of) -> Vec<Known> {
    let text = |slot: Slot| match expansion.program.instruction(slot) {
        Instruction::Given(given) => {
            let (text, element, kind) = of.given(expansion, given);
            Some(Known { slot, text, place: element.map(|element| (element, kind)) })
        }
        _ => None,
    };
    expansion.program.slots().filter_map(text).collect()
}

/// Names for coefficients, and for values without a name of their own.
fn wishes(model: &crate::model::Model, expansion: &Expansion, of: &Of, writer: &mut Writer<'_>) {
    for (slot, name) in expansion.coordinates.iter().zip(&model.locals.coordinates) {
        writer.wish(*slot, || format!("{name}_k"));
    }
    for (slot, name) in expansion.velocities.iter().zip(&model.locals.velocities) {
        writer.wish(*slot, || format!("{name}_k"));
    }
    for coefficient in &expansion.coefficients {
        if let Some(name) = of.coefficient(coefficient.of, coefficient.part) {
            writer.wish(coefficient.slot, || name);
        }
    }
    for (of_slot, &slot) in expansion.values.iter().enumerate() {
        if describe(model, &expansion.program, slot, 0).is_none()
            && let Some(name) = of.value(of_slot)
        {
            writer.wish(slot, || name);
        }
    }
}

/// The statements of the body.
struct Pass<'a> {
    emission: &'a Emission<'a>,
    expansion: &'a Expansion,
    outputs: &'a Outputs,
    of: &'a Of,
}

impl Pass<'_> {
    fn write(&self, writer: &mut Writer<'_>, names: &mut Names) -> String {
        let Pass { emission, expansion, outputs, of, .. } = *self;
        let settled = expansion.program.settled(Phase::State, &outputs.in_loop());
        writer.bind_always(&settled);
        let mut text = lines(writer.part(&[&settled[..], &outputs.start].concat(), names));
        let (start, solvers) = solvers::start(emission, expansion, writer, names);
        text.push_str(&start);
        let scalar = &emission.scalar;
        let starts =
            |places: &[usize]| places.iter().map(|&place| expansion.carried[place].start).collect::<Vec<_>>();
        for &place in &of.carried.single {
            let (name, value) = (&of.carried.values[place], writer.output(expansion.carried[place].start));
            text.push_str(&format!("let mut {name}: {scalar} = {value};\n"));
        }
        for (name, places) in &of.carried.arrays {
            let values = writer.list(&starts(places));
            text.push_str(&format!("let mut {name}: [{scalar}; {}] = {values};\n", places.len()));
        }
        let (before, sums) = self.sums(scalar);
        text.push_str(&before);
        let walk = match &expansion.sums {
            Sums::Few(_) => "in_line::<ORDERS>",
            Sums::Many(_) => "in_turn",
        };
        text.push_str(&format!(
            "lagrange::jets::{walk}(orders, #[inline(always)] |order| {{\n\
             let rate: {scalar} = lagrange::jets::rate(h, order);\n"
        ));
        let reads = |given: Given| {
            let is = |slot: &Slot| expansion.program.instruction(*slot) == Instruction::Given(given);
            expansion.program.slots().find(is).is_some_and(|slot| writer.needs(slot))
        };
        if reads(Given::Index) {
            text.push_str(&format!("let index: {scalar} = lagrange::jets::index(order);\n"));
        }
        if reads(Given::Time) {
            text.push_str(&format!("let {}: {scalar} = lagrange::jets::time(h, order);\n", of.time));
        }
        text.push_str(&sums);
        // Statements that do not depend on the solution come before it, to be computed meanwhile. In systems
        // with many products their values would not fit into the registers.
        let early = match &expansion.sums {
            Sums::Few(_) => {
                expansion.program.settled(Phase::Order, &[&outputs.solution[..], &outputs.end].concat())
            }
            Sums::Many(_) => Vec::new(),
        };
        writer.bind_always(&early);
        text.push_str(&lines(writer.part(&[&early[..], &outputs.order].concat(), names)));
        text.push_str(&solvers::order(emission, expansion, &solvers, writer, of));
        text.push_str(&lines(writer.part(&outputs.solution, names)));
        if reacting(expansion) > 0 {
            text.push_str(&format!("reactions.set(order, {});\n", of.multipliers.1.list()));
        }
        if !expansion.followed.is_empty() {
            text.push_str(&format!("functions.set(order, {});\n", writer.list(&expansion.followed)));
        }
        text.push_str(&format!(
            "series.set(order, {}, {});\nif order == orders {{\nreturn false;\n}}\n",
            writer.list(&expansion.coordinates),
            writer.list(&expansion.velocities)
        ));
        text.push_str(&lines(writer.part(&outputs.end, names)));
        text.push_str(&self.store(writer));
        text + "true\n});\n" + &turning::series(emission) + "true"
    }

    /// The statements that sum the convolutions, before the loop and in it.
    fn sums(&self, scalar: &crate::syntax::Scalar) -> (String, String) {
        if self.expansion.factors.is_empty() {
            return Default::default();
        }
        match &self.expansion.sums {
            Sums::Few(products) => (
                format!(
                    "struct Products;\n\
                     impl lagrange::jets::Pairs<{0}> for Products {{\n\
                     const FACTORS: &'static [[usize; 2]; {0}] = &{products:?};\n}}\n\
                     let mut products = lagrange::jets::Convolutions::new(tables, Products);\n",
                    products.len()
                ),
                "let inner = products.sums(order);\n".to_owned(),
            ),
            Sums::Many(Tiles { sums, .. }) => {
                let zero = scalar::zero(scalar);
                (
                    format!("let mut inner: [{scalar}; {sums}] = [{zero}; {sums}];\n"),
                    "tables.interior::<Products, _>(order, &mut inner);\n".to_owned(),
                )
            }
        }
    }

    /// The statements at the end of an order.
    fn store(&self, writer: &Writer<'_>) -> String {
        let expansion = self.expansion;
        let mut text = String::new();
        match &expansion.sums {
            _ if expansion.factors.is_empty() => {}
            Sums::Few(_) => {
                let values: Vec<String> =
                    expansion.factors.iter().map(|factor| writer.output(factor.coefficient)).collect();
                text.push_str(&format!("products.add(order, [{}]);\n", values.join(", ")));
            }
            Sums::Many(tiles) => {
                text.push_str(
                    "if let ::core::option::Option::Some(mut row) = tables.row::<Products, _>(order) {\n",
                );
                let (places, factors): (Vec<usize>, Vec<Slot>) = tiles
                    .factors
                    .iter()
                    .map(|&(place, factor)| (place, expansion.factors[factor].coefficient))
                    .unzip();
                text.push_str(&writer.values(&factors).fill("row", &places));
                text.push_str("}\n");
            }
        }
        // All are assigned at once, since one may be made from the previous value of another.
        let kept = &self.of.carried;
        let next =
            |places: &[usize]| places.iter().map(|&place| expansion.carried[place].next).collect::<Vec<_>>();
        let mut names: Vec<&str> = kept.arrays.iter().map(|(name, _)| name.as_str()).collect();
        let mut values: Vec<String> =
            kept.arrays.iter().map(|(_, places)| writer.list(&next(places))).collect();
        names.extend(kept.single.iter().map(|&place| kept.values[place].as_str()));
        values.extend(writer.outputs(&next(&kept.single)));
        let (open, close) = if kept.arrays.is_empty() { ("[", "]") } else { ("(", ")") };
        text.push_str(&format!("{open}{}{close} = {open}{}{close};\n", names.join(", "), values.join(", ")));
        text
    }
}

/// Statements, a line each.
fn lines(statements: Vec<String>) -> String {
    statements.into_iter().map(|statement| statement + "\n").collect()
}
