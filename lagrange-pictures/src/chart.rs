//! [`Chart`]: one plot with its curves.

use std::path::{Path, PathBuf};

use crate::colours::{COLOURS, Colour, GREY};
use crate::error::PictureError;
use crate::figure::Figure;

/// One plot with its curves.
#[derive(Clone, Debug)]
pub struct Chart {
    pub(crate) title: String,
    pub(crate) x: String,
    pub(crate) y: String,
    pub(crate) curves: Vec<Curve>,
    pub(crate) equal: bool,
    pub(crate) logarithmic: bool,
}

/// One curve.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) label: String,
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) colour: Colour,
    pub(crate) stroke: Stroke,
}

/// How it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stroke {
    Line,
    /// A line with a dot at each point but the first.
    Linkage,
    Dots,
    /// A thin grey line, not in the legend.
    Guide,
}

impl Chart {
    /// A chart without curves. The axis titles name quantity and unit, `"time [s]"`; without both there are
    /// no axes.
    #[must_use]
    pub fn new(title: &str, x: &str, y: &str) -> Self {
        let (title, x, y) = (title.into(), x.into(), y.into());
        Self { title, x, y, curves: Vec::new(), equal: false, logarithmic: false }
    }

    /// Another title and other axis titles.
    #[must_use]
    pub fn titled(mut self, title: &str, x: &str, y: &str) -> Self {
        (self.title, self.x, self.y) = (title.into(), x.into(), y.into());
        self
    }

    /// One unit is equally long on both axes: for paths in space.
    #[must_use]
    pub fn equal_scales(mut self) -> Self {
        self.equal = true;
        self
    }

    /// |y| on a logarithmic axis; zeros are left out.
    #[must_use]
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }

    /// A curve in the next colour; an empty label keeps it out of the legend.
    #[must_use]
    pub fn line(self, label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let colour = self.next_colour();
        self.curve(label, points, colour, Stroke::Line)
    }

    /// Dots in the colour of the curve before them.
    #[must_use]
    pub fn dots(self, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let colour = self.curves.last().map_or(COLOURS[0], |curve| curve.colour);
        self.curve("", points, colour, Stroke::Dots)
    }

    /// Links between joints, at an age from 0 (first picture, pale) to 1 (last, dark).
    #[must_use]
    pub fn linkage(self, label: &str, age: f64, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let blend = |pale: u8, dark: u8| (f64::from(pale) + age * (f64::from(dark) - f64::from(pale))) as u8;
        let colour = Colour(blend(245, 0), blend(200, 60), blend(120, 130));
        self.curve(label, points, colour, Stroke::Linkage)
    }

    /// A thin grey line, such as the outline of a sphere. Curves that are added after it lie over it.
    #[must_use]
    pub fn guide(self, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.curve("", points, GREY, Stroke::Guide)
    }

    fn next_colour(&self) -> Colour {
        let lines = self.curves.iter().filter(|curve| curve.stroke == Stroke::Line).count();
        COLOURS[lines % COLOURS.len()]
    }

    fn curve(
        mut self,
        label: &str,
        points: impl IntoIterator<Item = (f64, f64)>,
        colour: Colour,
        stroke: Stroke,
    ) -> Self {
        let points = points.into_iter().collect();
        self.curves.push(Curve { label: label.into(), points, colour, stroke });
        self
    }

    /// The picture as the text of an SVG file.
    ///
    /// # Errors
    /// [`PictureError::Empty`] without a point, [`PictureError::NotFinite`], [`PictureError::Plot`].
    pub fn svg(&self) -> Result<String, PictureError> {
        Figure::new([self.clone()]).svg()
    }

    /// Writes the picture as an SVG file and returns where it is. Folders on the way are made.
    ///
    /// # Errors
    /// As [`Chart::svg`], and [`PictureError::Io`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<PathBuf, PictureError> {
        Figure::new([self.clone()]).save(path)
    }
}
