//! Numbers that are followed beside the tables of a series: reactions, and functions of the state.

/// The tables of a series, and the coefficients of the reactions of `C` rows and of `G` functions of the
/// state.
#[derive(Clone, Copy, Debug)]
pub struct Followed<T, R, const C: usize, const G: usize, const P: usize> {
    /// The tables.
    pub tables: T,
    /// The coefficients of the reactions, those of order zero first.
    pub reactions: Rows<R, C, P>,
    /// The coefficients of the functions, those of order one first.
    pub functions: Rows<R, G, P>,
}

/// `P` rows of coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Rows<R, const C: usize, const P: usize>([[R; C]; P]);

impl<T: Default, R: num_traits::Zero + Copy, const C: usize, const G: usize, const P: usize> Default
    for Followed<T, R, C, G, P>
{
    fn default() -> Self {
        let zero = R::zero();
        Self { tables: T::default(), reactions: Rows([[zero; C]; P]), functions: Rows([[zero; G]; P]) }
    }
}

impl<T, R, const C: usize, const G: usize, const P: usize> Followed<T, R, C, G, P> {
    /// The coefficients of the reactions and of the functions, the rows of an order side by side.
    #[inline]
    pub fn rows(&self) -> [&[R]; 2] {
        [self.reactions.rows(), self.functions.rows()]
    }
}

impl<R, const C: usize, const P: usize> Rows<R, C, P> {
    /// Sets the row of an order from 1 to `P` of the series: reactions of the order below, or functions of
    /// this one.
    #[inline(always)]
    pub fn set(&mut self, order: usize, row: [R; C]) {
        if let Some(to) = self.0.get_mut(order - 1) {
            *to = row;
        }
    }

    /// All of them, the rows of an order side by side.
    pub fn rows(&self) -> &[R] {
        self.0.as_flattened()
    }
}
