//! [`Grid`]: the cells of a grid by their index.

use crate::Error;

/// A grid of cells in `D` dimensions, numbered with the last dimension fastest, as NumPy has it. A motion
/// belongs to the middle of its cell: motions on borders are often special.
///
/// ```
/// use lagrange_ensemble::Grid;
///
/// // Three cells from 0 to 3 for rows, two from 0 to 1 for columns.
/// let grid = Grid::new([(0.0, 3.0, 3), (0.0, 1.0, 2)])?;
/// assert_eq!((grid.count(), grid.shape()), (6, [3, 2]));
/// assert_eq!(grid.middle(3), [1.5, 0.75]);
/// assert!(grid.middle(6)[0].is_nan());
/// # Ok::<_, lagrange_ensemble::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<const D: usize> {
    sides: [(f64, f64, u64); D],
}

impl<const D: usize> Grid<D> {
    /// From, to and number of cells of each dimension, slowest first.
    ///
    /// # Errors
    /// [`Error::InvalidGrid`] if a border is not a finite number, a dimension has no cells, or the cells are
    /// more than indices.
    pub fn new(sides: [(f64, f64, u64); D]) -> Result<Self, Error> {
        let mut count = 1_u64;
        for (dimension, (from, to, cells)) in sides.into_iter().enumerate() {
            let invalid = |why| Error::InvalidGrid { dimension, why };
            if !(from.is_finite() && to.is_finite()) {
                return Err(invalid("a border is not a finite number"));
            }
            if cells == 0 {
                return Err(invalid("it has no cells"));
            }
            count = count
                .checked_mul(cells)
                .ok_or_else(|| invalid("with it, there are more cells than indices"))?;
        }
        Ok(Self { sides })
    }

    /// The number of cells.
    pub fn count(&self) -> u64 {
        self.sides.iter().map(|side| side.2).product()
    }

    /// The numbers of cells in each dimension: the shape of the table's array.
    pub fn shape(&self) -> [u64; D] {
        self.sides.map(|side| side.2)
    }

    /// The middle of a cell; not a number beyond the last one.
    pub fn middle(&self, index: u64) -> [f64; D] {
        let (mut middle, mut rest) = ([0.0; D], index);
        for (at, (from, to, cells)) in middle.iter_mut().zip(self.sides).rev() {
            let share = ((rest % cells) as f64 + 0.5) / cells as f64;
            *at = from * (1.0 - share) + to * share;
            rest /= cells;
        }
        if rest > 0 { [f64::NAN; D] } else { middle }
    }
}
