//! Colours of all pictures.

pub(crate) use plotters::style::RGBColor as Colour;

/// Six colours of Okabe and Ito, which remain distinct to colour-blind readers, and a dark grey.
pub(crate) const COLOURS: [Colour; 7] = [
    Colour(0, 114, 178),
    Colour(213, 94, 0),
    Colour(0, 158, 115),
    Colour(204, 121, 167),
    Colour(86, 180, 233),
    Colour(230, 159, 0),
    Colour(90, 90, 90),
];
/// Guides: thin lines of a chart that are no curves.
pub(crate) const GREY: Colour = Colour(170, 170, 170);
/// Lines of the grid.
pub(crate) const GRID: Colour = Colour(236, 236, 236);

/// A colour as attributes of SVG name it.
pub(crate) fn hex(Colour(red, green, blue): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}
