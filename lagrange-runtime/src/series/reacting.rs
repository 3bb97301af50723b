//! Reactions beside the tables of a series.

/// The tables of a series, and the coefficients of the reactions of `C` rows.
#[derive(Clone, Copy, Debug)]
pub struct Reacting<T, R, const C: usize, const P: usize> {
    /// The tables.
    pub tables: T,
    /// The coefficients, those of order zero first.
    pub reactions: Reactions<R, C, P>,
}

/// Coefficients of the reactions of `C` rows, to order `P` − 1.
#[derive(Clone, Copy, Debug)]
pub struct Reactions<R, const C: usize, const P: usize>([[R; C]; P]);

impl<T: Default, R: num_traits::Zero + Copy, const C: usize, const P: usize> Default
    for Reacting<T, R, C, P>
{
    fn default() -> Self {
        Self { tables: T::default(), reactions: Reactions([[R::zero(); C]; P]) }
    }
}

impl<R, const C: usize, const P: usize> Reactions<R, C, P> {
    /// Sets what an order from 1 to `P` of the series gives: the reactions of the order below.
    #[inline(always)]
    pub fn set(&mut self, order: usize, reactions: [R; C]) {
        if let Some(row) = self.0.get_mut(order - 1) {
            *row = reactions;
        }
    }

    /// All of them, the rows of an order side by side.
    pub fn rows(&self) -> &[R] {
        self.0.as_flattened()
    }
}
