//! The tables of systems with many products: columns of factors, and the sweep over them, tile by tile.

use super::start::Start;
use crate::emit::names::Names;
use crate::jets::{Bundle, Jets, Operand, bundles};
use crate::model::Model;

/// A tile sums at most so many numbers: as many as the registers of common vector units hold.
const TOGETHER: usize = 64;

/// At most so many instances are side by side in a tile.
const WIDEST: usize = 32;

/// At least so many: one vector.
const VECTOR: usize = 4;

/// A tile of more products than this is summed in turns.
const PRODUCTS: usize = 8;

/// Where everything stands.
#[derive(Clone, Debug, Default)]
pub(super) struct Wide {
    /// The length of a row.
    pub columns: usize,
    /// The number of sums, with those of no use.
    pub sums: usize,
    /// The place of the sum of each lane.
    pub lanes: Vec<usize>,
    /// The factors by their places in a row.
    pub factors: Vec<(usize, Operand)>,
    /// The calls that sum all tiles.
    calls: String,
    /// What the tiles are made of: products and width, by the body of the function that adds their terms.
    patterns: Vec<(usize, String)>,
}

impl Wide {
    /// Lays out all lanes.
    pub fn of(model: &Model, jets: &Jets, start: &Start<'_>) -> Wide {
        let mut wide = Wide { lanes: vec![0; jets.lanes.len()], ..Wide::default() };
        for bundle in bundles(&jets.lanes) {
            wide.bundle(model, start, &bundle);
        }
        // Rows of whole lines of a cache.
        wide.columns = wide.columns.next_multiple_of(8);
        wide
    }

    fn bundle(&mut self, model: &Model, start: &Start<'_>, bundle: &Bundle) {
        let instances = bundle.instances();
        let products = bundle.products.len().min(PRODUCTS);
        let mut first = 0;
        while first < instances {
            let left = instances - first;
            let mut width = WIDEST;
            while width > VECTOR && (width * products > TOGETHER || width / 2 >= left) {
                width /= 2;
            }
            // Fewer than a half of a wide tile stand better in a smaller one.
            while width > 8 && width > left {
                width /= 2;
            }
            let base = self.columns;
            for (place, column) in bundle.columns.iter().enumerate() {
                for (i, &factor) in column.iter().skip(first).take(width).enumerate() {
                    self.factors.push((base + place * width + i, factor));
                }
            }
            self.columns += bundle.columns.len() * width;
            for (products, lanes) in bundle.products.chunks(PRODUCTS).zip(bundle.lanes.chunks(PRODUCTS)) {
                for (place, lanes) in lanes.iter().enumerate() {
                    for (i, &lane) in lanes.iter().skip(first).take(width).enumerate() {
                        self.lanes[lane] = self.sums + place * width + i;
                    }
                }
                let pattern = self.pattern(model, start, bundle, products, (first, width));
                let used = width.min(left);
                self.calls.push_str(&format!(
                    "lagrange::jets::tile::<Pattern{pattern}, _, _, _, {width}, {}>(rows, sums, ({base}, {}, {used}));\n",
                    products.len(),
                    self.sums
                ));
                self.sums += products.len() * width;
            }
            first += width;
        }
    }

    /// The place in the list of patterns of some products of a tile.
    fn pattern(
        &mut self,
        model: &Model,
        start: &Start<'_>,
        bundle: &Bundle,
        products: &[(usize, usize)],
        (first, width): (usize, usize),
    ) -> usize {
        let mut names = Names::new(model);
        for name in ["low", "high", "place", "sum"] {
            names.claim(Some(name.to_owned()));
        }
        let mut columns = vec![String::new(); bundle.columns.len()];
        let mut text = String::new();
        for (place, name) in columns.iter_mut().enumerate() {
            if !products.iter().any(|&(a, b)| a == place || b == place) {
                continue;
            }
            let factor = bundle.columns[place][first];
            let label = &start.labels[factor.slot.index()];
            let ramp = if factor.ramp { "_ramp" } else { "" };
            *name = names.claim(Some(format!("{label}{ramp}")).filter(|_| !label.is_empty()));
            text.push_str(&format!(
                "let {name} = lagrange::jets::column::<_, _, W>(low, high, place + {});\n",
                place * width
            ));
        }
        for (place, &(a, b)) in products.iter().enumerate() {
            let (a, b) = (&columns[a], &columns[b]);
            text.push_str(&if a == b {
                format!("lagrange::jets::square(&mut sum[{place}], {a});\n")
            } else {
                format!("lagrange::jets::product(&mut sum[{place}], {a}, {b});\n")
            });
        }
        let pattern = (products.len(), text);
        self.patterns.iter().position(|known| *known == pattern).unwrap_or_else(|| {
            self.patterns.push(pattern);
            self.patterns.len() - 1
        })
    }

    /// The items that tell the runtime what to sum.
    pub fn items(&self) -> String {
        let Wide { columns, sums, calls, patterns, .. } = self;
        let mut text = format!(
            "struct Products;\n\
             impl lagrange::jets::Products<{columns}, {sums}> for Products {{\n\
             #[inline(always)]\n\
             fn sum<R: lagrange::Real>(rows: &[[R; {columns}]], sums: &mut [R; {sums}]) {{\n{calls}}}\n}}\n"
        );
        for (place, (products, body)) in patterns.iter().enumerate() {
            text.push_str(&format!(
                "struct Pattern{place};\n\
                 impl lagrange::jets::Pattern<{columns}, {products}> for Pattern{place} {{\n\
                 #[inline(always)]\n\
                 fn add<R: lagrange::Real, const W: usize>(low: &[R; {columns}], high: &[R; {columns}], \
                 place: usize, sum: &mut [[R; W]; {products}]) {{\n{body}}}\n}}\n"
            ));
        }
        text
    }
}
