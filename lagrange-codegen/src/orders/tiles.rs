//! The tables of systems with many products: columns of factors, and the sweep over them, tile by tile.

use super::Numbers;
use crate::jets::{Bundle, Lane, Operand, bundles};

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
pub struct Tiles {
    /// The length of a row.
    pub columns: usize,
    /// The number of sums, with those of no use.
    pub sums: usize,
    /// The place of the sum of each lane.
    pub lanes: Vec<usize>,
    /// Places in a row with the factors that stand there, by their places among all.
    pub factors: Vec<(usize, usize)>,
    /// All tiles.
    pub tiles: Vec<Tile>,
    /// What they are made of.
    pub patterns: Vec<Pattern>,
}

/// Instances of a pattern side by side.
#[derive(Clone, Copy, Debug)]
pub struct Tile {
    /// Which pattern.
    pub pattern: usize,
    /// How many instances there are room for.
    pub width: usize,
    /// How many there are.
    pub used: usize,
    /// The first of its columns.
    pub base: usize,
    /// The first of its sums.
    pub first: usize,
}

/// Products of columns.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Offsets of the columns in a tile.
    pub columns: Vec<usize>,
    /// A factor in each column of the first tile, by its place among all.
    pub factors: Vec<usize>,
    /// Products, by places in the list of columns.
    pub products: Vec<[usize; 2]>,
}

impl Tiles {
    /// Lays out all lanes.
    pub(super) fn of(lanes: &[Lane], numbers: Numbers, place: &impl Fn(Operand) -> usize) -> Tiles {
        let mut tiles = Tiles { lanes: vec![0; lanes.len()], ..Tiles::default() };
        for bundle in bundles(lanes) {
            tiles.bundle(&bundle, numbers, place);
        }
        // Rows of whole lines of a cache.
        if numbers == Numbers::Plain {
            tiles.columns = tiles.columns.next_multiple_of(8);
        }
        tiles
    }

    fn bundle(&mut self, bundle: &Bundle, numbers: Numbers, place_of: &impl Fn(Operand) -> usize) {
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
            // Room that is not used fills up vectors. What is a vector itself has no use for it.
            if numbers == Numbers::Carrying {
                width = width.min(left);
            }
            let base = self.columns;
            for (place, column) in bundle.columns.iter().enumerate() {
                for (i, &factor) in column.iter().skip(first).take(width).enumerate() {
                    self.factors.push((base + place * width + i, place_of(factor)));
                }
            }
            self.columns += bundle.columns.len() * width;
            for (products, lanes) in bundle.products.chunks(PRODUCTS).zip(bundle.lanes.chunks(PRODUCTS)) {
                for (place, lanes) in lanes.iter().enumerate() {
                    for (i, &lane) in lanes.iter().skip(first).take(width).enumerate() {
                        self.lanes[lane] = self.sums + place * width + i;
                    }
                }
                let pattern = self.pattern(bundle, products, (first, width), place_of);
                let used = width.min(left);
                self.tiles.push(Tile { pattern, width, used, base, first: self.sums });
                self.sums += products.len() * width;
            }
            first += width;
        }
    }

    /// The place in the list of patterns of some products of a tile.
    fn pattern(
        &mut self,
        bundle: &Bundle,
        products: &[(usize, usize)],
        (first, width): (usize, usize),
        place_of: &impl Fn(Operand) -> usize,
    ) -> usize {
        let is_used = |&column: &usize| products.iter().any(|&(a, b)| a == column || b == column);
        let used: Vec<usize> = (0..bundle.columns.len()).filter(is_used).collect();
        let place = |column: usize| used.iter().position(|&known| known == column).unwrap_or_default();
        let products: Vec<[usize; 2]> = products.iter().map(|&(a, b)| [place(a), place(b)]).collect();
        let columns: Vec<usize> = used.iter().map(|column| column * width).collect();
        let known = |known: &Pattern| known.columns == columns && known.products == products;
        self.patterns.iter().position(known).unwrap_or_else(|| {
            let factors = used.iter().map(|&column| place_of(bundle.columns[column][first])).collect();
            self.patterns.push(Pattern { columns, factors, products });
            self.patterns.len() - 1
        })
    }
}
