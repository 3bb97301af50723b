//! The items that tell the runtime what to sum, for systems with many products.

use super::names::Of;
use crate::emit::names::Names;
use crate::model::Model;
use crate::orders::{Factor, Pattern, Tile, Tiles};

/// The items.
pub(super) fn items(model: &Model, tiles: &Tiles, factors: &[Factor], of: &Of) -> String {
    let Tiles { columns, sums, patterns, rooms, .. } = tiles;
    let mut text = format!(
        "struct Products;\n\
         impl lagrange::jets::Products<{columns}, {sums}> for Products {{\n\
         #[inline(always)]\n\
         fn sum<R: lagrange::Real>(rows: &[[R; {columns}]], sums: &mut [R; {sums}]) {{\n"
    );
    for &Tile { pattern, width, used, stride, base, packed, first } in &tiles.tiles {
        text.push_str(&format!(
            "lagrange::jets::tile::<Pattern{pattern}, _, _, _, {width}, {}>(\
             rows, sums, [{base}, {packed}, {first}, {used}, {stride}]);\n",
            patterns[pattern].products.len()
        ));
    }
    text.push_str(&format!(
        "}}\nconst PACKED: &'static [usize; {columns}] = &lagrange::jets::packed(&{rooms:?});\n}}\n"
    ));
    for (index, pattern) in patterns.iter().enumerate() {
        let products = pattern.products.len();
        text.push_str(&format!(
            "struct Pattern{index};\n\
             impl lagrange::jets::Pattern<{columns}, {products}> for Pattern{index} {{\n\
             #[inline(always)]\n\
             fn add<R: lagrange::Real, const __WIDTH: usize>(low: &[R; {columns}], high: &[R; {columns}], \
             place: [usize; 2], sum: &mut [[R; __WIDTH]; {products}]) {{\n{}}}\n}}\n",
            body(model, pattern, factors, of)
        ));
    }
    text
}

fn body(model: &Model, pattern: &Pattern, factors: &[Factor], of: &Of) -> String {
    let mut names = Names::new(model);
    for name in ["low", "high", "sum"] {
        names.claim(Some(name.to_owned()));
    }
    let mut text = String::new();
    let mut columns = Vec::with_capacity(pattern.columns.len());
    for (column, &factor) in pattern.columns.iter().zip(&pattern.factors) {
        let name = names.claim(of.factor(factors[factor].operand));
        text.push_str(&format!(
            "let {name} = lagrange::jets::column::<_, _, __WIDTH>(low, high, place, {column});\n"
        ));
        columns.push(name);
    }
    for (index, &[a, b]) in pattern.products.iter().enumerate() {
        let (a, b) = (&columns[a], &columns[b]);
        text.push_str(&if a == b {
            format!("lagrange::jets::square(&mut sum[{index}], {a});\n")
        } else {
            format!("lagrange::jets::product(&mut sum[{index}], {a}, {b});\n")
        });
    }
    text
}
