//! [`Grid`]: the cells of a grid by their index.

/// A grid of cells in `D` dimensions, numbered with the last dimension fastest, as NumPy has it. A motion
/// belongs to the middle of its cell: motions on borders are often special.
///
/// ```
/// use lagrange_ensemble::Grid;
///
/// // Three cells from 0 to 3 for rows, two from 0 to 1 for columns.
/// let grid = Grid::new([(0.0, 3.0, 3), (0.0, 1.0, 2)]);
/// assert_eq!((grid.count(), grid.shape()), (6, [3, 2]));
/// assert_eq!(grid.middle(3), [1.5, 0.75]);
/// assert!(grid.middle(6)[0].is_nan());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<const D: usize> {
    sides: [(f64, f64, u64); D],
}

impl<const D: usize> Grid<D> {
    /// From, to and number of cells of each dimension, slowest first.
    pub fn new(sides: [(f64, f64, u64); D]) -> Self {
        Self { sides }
    }

    /// The number of cells; the largest of all numbers if there are more.
    pub fn count(&self) -> u64 {
        self.sides.iter().fold(1, |count: u64, side| count.saturating_mul(side.2))
    }

    /// The numbers of cells in each dimension: the shape of the table's array.
    pub fn shape(&self) -> [u64; D] {
        self.sides.map(|side| side.2)
    }

    /// The middle of a cell; not a number beyond the last one.
    pub fn middle(&self, index: u64) -> [f64; D] {
        let (mut middle, mut rest) = ([0.0; D], index);
        for (at, (from, to, cells)) in middle.iter_mut().zip(self.sides).rev() {
            let cells = cells.max(1);
            let share = ((rest % cells) as f64 + 0.5) / cells as f64;
            *at = from * (1.0 - share) + to * share;
            rest /= cells;
        }
        if rest > 0 { [f64::NAN; D] } else { middle }
    }
}
