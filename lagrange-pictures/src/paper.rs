//! Films as text: the view of space, its scale, and the elements of SVG that move.

use crate::colours::{COLOURS, hex};
use crate::error::PictureError;
use crate::place::Spot;

/// The largest width and height of the moving part, the smallest of the room that it gets, and the space
/// around that room \[px].
const LARGEST: [f64; 2] = [640.0, 288.0];
const SMALLEST: f64 = 64.0;
const MARGIN: f64 = 16.0;
/// Radius of a joint that moves, and of one at rest \[px].
const JOINT: f64 = 7.0;
const PIVOT: f64 = 3.0;
/// The length of the longest arrow and of its head \[px].
const ARROW: f64 = 60.0;
const HEAD: f64 = 8.0;
/// Frames a second. The viewer interpolates between them.
const RATE: f64 = 25.0;
/// The share of the time in which a film fades out at its end. It fades in at its beginning in half of that.
const FADE: f64 = 0.04;
/// The colour of rods, outlines and everything that stands still.
const DARK: &str = "#5a5a5a";

/// The kind of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Point,
    Rods,
    Body,
    Trail,
    Force,
    Ground,
}

/// A shape by its spots in each state; a force by where it acts and by its vector.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) kind: Kind,
    pub(crate) frames: Vec<Vec<Spot>>,
}

/// The direction from which space is seen \[rad].
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) azimuth: f64,
    pub(crate) elevation: f64,
}

impl Default for View {
    fn default() -> Self {
        Self { azimuth: -60_f64.to_radians(), elevation: 20_f64.to_radians() }
    }
}

/// A point of the picture: in the units of the system, to the right and up; or in pixels, to the right and
/// down from the upper left corner.
type Point = [f64; 2];

impl View {
    fn seen(self, spot: Spot) -> Point {
        match spot {
            Spot::Plane(point) => point,
            Spot::Space([x, y, z]) => {
                let ((sin_a, cos_a), (sin_e, cos_e)) = (self.azimuth.sin_cos(), self.elevation.sin_cos());
                [cos_a * y - sin_a * x, cos_e * z - sin_e * (cos_a * x + sin_a * y)]
            }
        }
    }
}

/// The states that are shown: every n-th of the record, and the time that they take together.
struct Reel {
    stride: usize,
    last: usize,
    /// Seconds on the screen.
    duration: f64,
}

impl Reel {
    fn new(times: &[f64], slower: f64) -> Result<Self, PictureError> {
        let [first, .., end] = times else { return Err(PictureError::Empty) };
        let intervals = times.len() - 1;
        let interval = (end - first) / intervals as f64;
        for (count, &at) in times.iter().enumerate() {
            // An eye sees no thousandth of an interval.
            let expected = first + count as f64 * interval;
            if (at - expected).abs() > 1e-3 * interval.abs() || interval == 0.0 || !interval.is_finite() {
                return Err(PictureError::UnequalTimes { at });
            }
        }
        let shown = interval.abs() * slower;
        if !(shown > 0.0 && shown.is_finite()) {
            return Err(PictureError::NotFinite { what: "the speed of the film", at: *first });
        }
        let stride = ((1.0 / (RATE * shown)) as usize).clamp(1, intervals);
        let last = intervals / stride * stride;
        Ok(Self { stride, last, duration: shown * last as f64 })
    }

    /// The frames of a shape.
    fn frames<'s, T>(&self, states: &'s [T]) -> impl Iterator<Item = &'s T> + Clone {
        states.iter().take(self.last + 1).step_by(self.stride)
    }
}

/// A shape as it is seen, state by state.
struct Seen {
    kind: Kind,
    frames: Vec<Vec<Point>>,
}

/// Projects all shapes, and refuses numbers that cannot be drawn.
fn seen(times: &[f64], view: View, shapes: &[Shape]) -> Result<Vec<Seen>, PictureError> {
    let mut all = Vec::new();
    for Shape { kind, frames } in shapes {
        let frames: Vec<Vec<Point>> =
            frames.iter().map(|spots| spots.iter().map(|&spot| view.seen(spot)).collect()).collect();
        let points = frames.first().map_or(0, Vec::len);
        for (&at, frame) in times.iter().zip(&frames) {
            if !frame.iter().flatten().all(|x| x.is_finite()) {
                return Err(PictureError::NotFinite { what: "a shape of a film", at });
            }
            if frame.len() != points {
                return Err(PictureError::ChangingShape { at });
            }
        }
        if points > 0 {
            all.push(Seen { kind: *kind, frames });
        }
    }
    if all.is_empty() { Err(PictureError::Empty) } else { Ok(all) }
}

/// Where everything is on the paper.
struct Paper {
    low: Point,
    scale: f64,
    size: Point,
}

impl Paper {
    fn new(shapes: &[Seen]) -> Self {
        let places = shapes.iter().flat_map(|shape| {
            let count = if shape.kind == Kind::Force { 1 } else { usize::MAX };
            shape.frames.iter().flat_map(move |frame| frame.iter().take(count))
        });
        let empty = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let [low, high] = places.fold(empty, |[low, high], point| {
            [[0, 1].map(|i| low[i].min(point[i])), [0, 1].map(|i| high[i].max(point[i]))]
        });
        let extent = [0, 1].map(|i| high[i] - low[i]);
        let scale = [0, 1].map(|i| LARGEST[i] / extent[i]).into_iter().fold(f64::INFINITY, f64::min);
        // Everything is in one place, so any scale will do.
        let scale = if scale.is_finite() { scale } else { 1.0 };
        // Arrows reach beyond the shapes that move.
        let arrows = shapes.iter().any(|shape| shape.kind == Kind::Force);
        let around = MARGIN + if arrows { ARROW } else { 0.0 };
        let size = extent.map(|extent| (extent * scale).max(SMALLEST) + 2.0 * around);
        let low = [0, 1].map(|i| low[i] - (size[i] / scale - extent[i]) / 2.0);
        Self { low, scale, size }
    }

    fn at(&self, [x, y]: Point) -> Point {
        [(x - self.low[0]) * self.scale, self.size[1] - (y - self.low[1]) * self.scale]
    }
}

/// The whole file.
pub(crate) fn drawn(
    times: &[f64],
    slower: f64,
    view: View,
    shapes: &[Shape],
) -> Result<String, PictureError> {
    let reel = Reel::new(times, slower)?;
    let shapes = seen(times, view, shapes)?;
    let paper = Paper::new(&shapes);
    let forces = shapes.iter().filter(|shape| shape.kind == Kind::Force);
    // Without any force every scale makes all arrows zero.
    let longest = forces
        .flat_map(|shape| &shape.frames)
        .fold(0.0, |longest: f64, frame| frame.get(1).map_or(longest, |[x, y]| longest.max(x.hypot(*y))));
    let scale = if longest > 0.0 { ARROW / longest } else { 1.0 };
    let [width, height] = paper.size;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<g>\n"
    );
    let mut colours = COLOURS.iter().map(|&colour| hex(colour)).cycle();
    for shape in &shapes {
        let mut colour = || colours.next().unwrap_or_else(|| DARK.to_owned());
        let pixels = |frame: &Vec<Point>| frame.iter().map(|&point| paper.at(point)).collect::<Vec<_>>();
        let frames: Vec<Vec<Point>> = reel.frames(&shape.frames).map(pixels).collect();
        svg += &match shape.kind {
            Kind::Ground => {
                let line = joined(&frames[0]);
                format!("<polyline points=\"{line}\" stroke=\"{DARK}\" stroke-width=\"1.5\"/>\n")
            }
            Kind::Trail => {
                // Trails are up to twice as fine as the frames.
                let fine = Reel { stride: reel.stride.div_ceil(2), ..reel };
                let path: Vec<Point> = fine.frames(&shape.frames).flat_map(pixels).collect();
                trail(&path, &colour(), reel.duration)
            }
            Kind::Point => joint(&frames, 0, &colour(), reel.duration),
            Kind::Rods => {
                let outline = moving("polyline", &frames, "stroke-width=\"3\"", reel.duration);
                let joints: Vec<String> = (0..frames[0].len())
                    .map(|index| joint(&frames, index, &colour(), reel.duration))
                    .collect();
                outline + &joints.concat()
            }
            Kind::Body => {
                let paint = format!("stroke-width=\"2\" fill=\"{}\" fill-opacity=\"0.25\"", colour());
                moving("polygon", &frames, &paint, reel.duration)
            }
            Kind::Force => {
                let arrows: Vec<Vec<Point>> = reel
                    .frames(&shape.frames)
                    .map(|frame| arrow(paper.at(frame[0]), frame[1], scale))
                    .collect();
                let paint =
                    format!("stroke-width=\"2.5\" style=\"stroke:{}\" stroke-linecap=\"butt\"", colour());
                moving("polyline", &arrows, &paint, reel.duration)
            }
        };
    }
    let (begun, ending, duration) = (FADE / 2.0, 1.0 - FADE, seconds(reel.duration));
    svg += &format!(
        "<animate attributeName=\"opacity\" dur=\"{duration}\" repeatCount=\"indefinite\" values=\"0;1;1;0\" \
         keyTimes=\"0;{begun};{ending};1\"/>\n</g>\n</svg>"
    );
    Ok(svg)
}

/// A duration as SVG has it, in whole milliseconds, so that a rounding error does not change the file.
fn seconds(duration: f64) -> String {
    format!("{:.0}ms", 1e3 * duration)
}

fn animate(attribute: &str, values: &str, duration: f64) -> String {
    let duration = seconds(duration);
    format!(
        "<animate attributeName=\"{attribute}\" dur=\"{duration}\" repeatCount=\"indefinite\" values=\"{values}\"/>"
    )
}

/// Points as an attribute.
fn joined(points: &[Point]) -> String {
    points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}

/// An element with points that move.
fn moving(element: &str, frames: &[Vec<Point>], paint: &str, duration: f64) -> String {
    let shapes: Vec<String> = frames.iter().map(|frame| joined(frame)).collect();
    let points = &shapes[0];
    let motion = if shapes.iter().all(|shape| shape == points) {
        String::new()
    } else {
        animate("points", &shapes.join(";"), duration)
    };
    format!("<{element} points=\"{points}\" stroke=\"{DARK}\" {paint}>{motion}</{element}>\n")
}

/// One point of each frame as a disc, small and dark if it stands still.
fn joint(frames: &[Vec<Point>], index: usize, colour: &str, duration: f64) -> String {
    let path = |axis: usize| -> Vec<String> {
        frames.iter().map(|frame| format!("{:.1}", frame[index][axis])).collect()
    };
    let [x, y] = [path(0), path(1)];
    let moves = x.iter().any(|at| *at != x[0]) || y.iter().any(|at| *at != y[0]);
    let (colour, radius) = if moves { (colour, JOINT) } else { (DARK, PIVOT) };
    let mut disc = format!("<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\" fill=\"{colour}\">", x[0], y[0]);
    if moves {
        disc += &animate("cx", &x.join(";"), duration);
        disc += &animate("cy", &y.join(";"), duration);
    }
    disc + "</circle>\n"
}

/// A path that is drawn up to its point: a dash as long as the whole, pushed back.
fn trail(path: &[Point], colour: &str, duration: f64) -> String {
    let mut length = 0.0;
    let mut lengths = vec![0.0];
    for pair in path.windows(2) {
        length += (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
        lengths.push(length);
    }
    let offsets: Vec<String> = lengths.iter().map(|drawn| format!("{:.0}", length - drawn)).collect();
    format!(
        "<polyline points=\"{}\" stroke=\"{colour}\" stroke-opacity=\"0.45\" stroke-width=\"1.5\" \
         stroke-dasharray=\"{length:.0}\">{}</polyline>\n",
        joined(path),
        animate("stroke-dashoffset", &offsets.join(";"), duration)
    )
}

/// The shaft and the head of an arrow; all points are its tail if there is no force.
fn arrow(tail: Point, [x, y]: Point, scale: f64) -> Vec<Point> {
    let length = x.hypot(y) * scale;
    if length == 0.0 {
        return vec![tail; 5];
    }
    // Paper has its second axis downwards.
    let along = [x * scale / length, -y * scale / length];
    let head = HEAD.min(length / 2.0);
    let on = |forward: f64, aside: f64| {
        [tail[0] + forward * along[0] - aside * along[1], tail[1] + forward * along[1] + aside * along[0]]
    };
    let tip = on(length, 0.0);
    vec![tail, tip, on(length - head, head / 2.0), tip, on(length - head, -head / 2.0)]
}
