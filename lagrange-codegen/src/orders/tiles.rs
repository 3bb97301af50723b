//! The tables of systems with many products: columns of factors, and the sweep over them, tile by tile.
//!
//! A tile has room for more instances than there are, so that they fill vectors. Numbers that are vectors
//! themselves need no such room, and it would leave a part of the cache unused: they are packed. The runtime
//! knows which numbers these are.

use crate::jets::{Bundle, Convolution, Operand, bundles};

/// The most numbers that a tile sums at a time: as many as the registers of common vector units hold.
const TOGETHER: usize = 64;

/// The most instances side by side in a tile.
const WIDEST: usize = 32;

/// The fewest: one vector.
const VECTOR: usize = 4;

/// The most products that a tile sums at a time.
const PRODUCTS: usize = 8;

/// The layout of the tables.
#[derive(Clone, Debug, Default)]
pub struct Tiles {
    /// The length of a row.
    pub columns: usize,
    /// The length of a row of packed factors.
    packed: usize,
    /// The number of sums, unused ones included.
    pub sums: usize,
    /// The index of the sum of each convolution.
    pub convolutions: Vec<usize>,
    /// For each convolution the number of the product of a pattern that it is an instance of, counted over
    /// all bundles.
    pub roles: Vec<u32>,
    /// The columns that hold factors, each with the index of its factor.
    pub factors: Vec<(usize, usize)>,
    /// The room of each set of columns: how many there are, their distance, and the number of instances.
    pub rooms: Vec<[usize; 3]>,
    /// All tiles.
    pub tiles: Vec<Tile>,
    /// The patterns of the tiles.
    pub patterns: Vec<Pattern>,
}

/// Instances of a pattern side by side.
#[derive(Clone, Copy, Debug)]
pub struct Tile {
    /// The index of the pattern.
    pub pattern: usize,
    /// The number of instances that are summed at a time.
    pub width: usize,
    /// The number of instances.
    pub used: usize,
    /// The number of instances that there is room for: the distance of columns, and of the sums of products.
    pub stride: usize,
    /// The first of its columns.
    pub base: usize,
    /// The first of them in a packed row.
    pub packed: usize,
    /// The first of its sums.
    pub first: usize,
}

/// Products of columns.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// The columns of a tile that it reads.
    pub columns: Vec<usize>,
    /// The index of a factor in each column of the first tile.
    pub factors: Vec<usize>,
    /// Products, by positions in `columns`.
    pub products: Vec<[usize; 2]>,
}

impl Tiles {
    /// Lays out all convolutions.
    pub(super) fn of(convolutions: &[Convolution], index: &impl Fn(Operand) -> usize) -> Tiles {
        let (sums, roles) = (vec![0; convolutions.len()], vec![0; convolutions.len()]);
        let mut tiles = Tiles { convolutions: sums, roles, ..Tiles::default() };
        let mut role = 0;
        for bundle in bundles(convolutions) {
            for instances in &bundle.convolutions {
                instances.iter().for_each(|&instance| tiles.roles[instance] = role);
                role += 1;
            }
            tiles.bundle(&bundle, index);
        }
        // Rows that begin on lines of the cache.
        tiles.columns = tiles.columns.next_multiple_of(8);
        tiles
    }

    fn bundle(&mut self, bundle: &Bundle, index_of: &impl Fn(Operand) -> usize) {
        let instances = bundle.instances();
        let products = bundle.products.len().min(PRODUCTS);
        let mut first = 0;
        while first < instances {
            let left = instances - first;
            let mut width = WIDEST;
            while width > VECTOR && (width * products > TOGETHER || width / 2 >= left) {
                width /= 2;
            }
            // A tile wider than eight that would not be full is made narrower, and the next tile takes the
            // rest.
            while width > 8 && width > left {
                width /= 2;
            }
            // Many instances stand one after the other, so that a loop runs over all of them.
            let stride = if left > WIDEST { left.next_multiple_of(width) } else { width };
            let used = stride.min(left);
            let (base, packed) = (self.columns, self.packed);
            self.rooms.push([bundle.columns.len(), stride, used]);
            for (k, column) in bundle.columns.iter().enumerate() {
                for (i, &factor) in column.iter().skip(first).take(used).enumerate() {
                    self.factors.push((base + k * stride + i, index_of(factor)));
                }
            }
            self.columns += bundle.columns.len() * stride;
            self.packed += bundle.columns.len() * used;
            for (products, convolutions) in
                bundle.products.chunks(PRODUCTS).zip(bundle.convolutions.chunks(PRODUCTS))
            {
                for (k, convolutions) in convolutions.iter().enumerate() {
                    for (i, &of) in convolutions.iter().skip(first).take(used).enumerate() {
                        self.convolutions[of] = self.sums + k * stride + i;
                    }
                }
                let pattern = self.pattern(bundle, products, first, index_of);
                self.tiles.push(Tile { pattern, width, used, stride, base, packed, first: self.sums });
                self.sums += products.len() * stride;
            }
            first += used;
        }
    }

    /// The index of the pattern of some products of a tile.
    fn pattern(
        &mut self,
        bundle: &Bundle,
        products: &[(usize, usize)],
        first: usize,
        index_of: &impl Fn(Operand) -> usize,
    ) -> usize {
        let is_used = |&column: &usize| products.iter().any(|&(a, b)| a == column || b == column);
        let used: Vec<usize> = (0..bundle.columns.len()).filter(is_used).collect();
        let within = |column: usize| used.iter().position(|&known| known == column).unwrap_or_default();
        let products: Vec<[usize; 2]> = products.iter().map(|&(a, b)| [within(a), within(b)]).collect();
        let known = |known: &Pattern| known.columns == used && known.products == products;
        self.patterns.iter().position(known).unwrap_or_else(|| {
            let factors = used.iter().map(|&column| index_of(bundle.columns[column][first])).collect();
            self.patterns.push(Pattern { columns: used, factors, products });
            self.patterns.len() - 1
        })
    }
}
