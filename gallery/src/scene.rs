//! [`Scene`]: a drawing as numbers.

use alloc::vec::Vec;

use crate::Point;

/// Lines, discs, bodies, arrows and points of a path, each as its kind, its colour, how many numbers follow,
/// and these. Lengths are those of the system \[m], except the radius of a disc.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    numbers: Vec<f64>,
}

impl Scene {
    fn shape(&mut self, kind: u8, colour: u8, numbers: impl IntoIterator<Item = f64>) {
        let start = self.numbers.len();
        self.numbers.extend([f64::from(kind), f64::from(colour), 0.0]);
        self.numbers.extend(numbers);
        let count = self.numbers.len() - start - 3;
        if let Some(place) = self.numbers.get_mut(start + 2) {
            *place = count as f64;
        }
    }

    /// A line from point to point.
    pub fn line(&mut self, colour: u8, points: impl IntoIterator<Item = Point>) {
        self.shape(0, colour, points.into_iter().flatten());
    }

    /// A disc, its radius in hundredths of the picture's height.
    pub fn disc(&mut self, colour: u8, [x, y]: Point, radius: f64) {
        self.shape(1, colour, [x, y, radius]);
    }

    /// A closed outline, filled.
    pub fn body(&mut self, colour: u8, corners: impl IntoIterator<Item = Point>) {
        self.shape(2, colour, corners.into_iter().flatten());
    }

    /// An arrow from a place.
    pub fn arrow(&mut self, colour: u8, [x, y]: Point, [along, up]: Point) {
        self.shape(3, colour, [x, y, along, up]);
    }

    /// The next point of the path that the page draws behind everything.
    pub fn trail(&mut self, colour: u8, [x, y]: Point) {
        self.shape(4, colour, [x, y]);
    }

    /// The drawing so far.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    pub(crate) fn clear(&mut self) {
        self.numbers.clear();
    }
}
