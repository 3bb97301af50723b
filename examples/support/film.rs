//! Moving pictures of the examples: SVG files that play by themselves wherever an image is shown, without a script.
//!
//! Included by path, `#[path = "support/film.rs"] mod film;`, as `plot.rs` is.
#![allow(dead_code)]

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

/// Height of a picture, and the space around what moves \[px].
const HEIGHT: f64 = 320.0;
const MARGIN: f64 = 16.0;
/// Radius of a joint that moves, and of one at rest \[px].
const JOINT: f64 = 7.0;
const PIVOT: f64 = 3.0;
/// A motion that does not close fades out and begins again: the share of the time that this takes.
const FADE: f64 = 0.04;
/// Colours of Okabe and Ito, which remain distinct to colour-blind readers.
const COLOURS: [&str; 4] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];

/// A point in the plane, in the units of the motion.
pub type Point = [f64; 2];

/// What moves, frame by frame, at equal times. The frames between are interpolated by whoever shows it.
#[derive(Clone, Debug)]
pub struct Film {
    /// Seconds from the first frame to the last.
    duration: f64,
    linkages: Vec<Vec<Vec<Point>>>,
    trails: Vec<Vec<Point>>,
}

impl Film {
    /// An empty film of this many seconds.
    pub fn new(duration: f64) -> Self {
        Self { duration, linkages: Vec::new(), trails: Vec::new() }
    }

    /// Rods from joint to joint; each frame is the list of joints, always as many.
    pub fn linkage(mut self, frames: impl IntoIterator<Item = Vec<Point>>) -> Self {
        self.linkages.push(frames.into_iter().collect());
        self
    }

    /// The path of a point, which grows as the point moves.
    pub fn trail(mut self, points: impl IntoIterator<Item = Point>) -> Self {
        self.trails.push(points.into_iter().collect());
        self
    }

    /// Lower left and upper right corner of everything.
    fn bounds(&self) -> [Point; 2] {
        let points = self.linkages.iter().flatten().flatten().chain(self.trails.iter().flatten());
        points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], point| {
            [[0, 1].map(|i| low[i].min(point[i])), [0, 1].map(|i| high[i].max(point[i]))]
        })
    }

    /// The whole file.
    fn svg(&self) -> Result<String, Box<dyn Error>> {
        let [low, high] = self.bounds();
        let scale = (HEIGHT - 2.0 * MARGIN) / (high[1] - low[1]);
        let width = (high[0] - low[0]) * scale + 2.0 * MARGIN;
        let at = |[x, y]: Point| [MARGIN + (x - low[0]) * scale, HEIGHT - MARGIN - (y - low[1]) * scale];
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {HEIGHT}\" width=\"{width:.0}\" \
             height=\"{HEIGHT}\" fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<g>\n"
        );
        let animate = |attribute: &str, values: &str| {
            let duration = self.duration;
            format!(
                "<animate attributeName=\"{attribute}\" dur=\"{duration}s\" repeatCount=\"indefinite\" values=\"{values}\"/>"
            )
        };
        for (trail, colour) in self.trails.iter().zip(COLOURS.iter().cycle()) {
            let trail: Vec<Point> = trail.iter().map(|&point| at(point)).collect();
            // How long the path is in each frame; a dash as long as the whole is drawn in up to there.
            let mut length = 0.0;
            let lengths: Vec<f64> = std::iter::once(0.0)
                .chain(trail.windows(2).map(|pair| {
                    length += (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
                    length
                }))
                .collect();
            let offsets = lengths.iter().map(|drawn| format!("{:.0}", length - drawn)).collect::<Vec<_>>();
            writeln!(
                svg,
                "<polyline points=\"{}\" stroke=\"{colour}\" stroke-opacity=\"0.45\" stroke-width=\"1.5\" \
                 stroke-dasharray=\"{length:.0}\">{}</polyline>",
                joined(&trail, " "),
                animate("stroke-dashoffset", &offsets.join(";"))
            )?;
        }
        for frames in &self.linkages {
            let frames: Vec<Vec<Point>> =
                frames.iter().map(|joints| joints.iter().map(|&joint| at(joint)).collect()).collect();
            let first = frames.first().ok_or("a film has frames")?;
            let shapes: Vec<String> = frames.iter().map(|joints| joined(joints, " ")).collect();
            writeln!(
                svg,
                "<polyline points=\"{}\" stroke=\"#5a5a5a\" stroke-width=\"3\">{}</polyline>",
                joined(first, " "),
                animate("points", &shapes.join(";"))
            )?;
            for (joint, [x, y]) in first.iter().enumerate() {
                let path = |axis: usize| {
                    let values: Vec<String> =
                        frames.iter().map(|joints| format!("{:.1}", joints[joint][axis])).collect();
                    values.join(";")
                };
                let moves = frames.iter().any(|joints| joints[joint] != [*x, *y]);
                let (colour, radius) =
                    if moves { (COLOURS[joint % COLOURS.len()], JOINT) } else { ("#5a5a5a", PIVOT) };
                write!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\">")?;
                if moves {
                    write!(svg, "{}{}", animate("cx", &path(0)), animate("cy", &path(1)))?;
                }
                writeln!(svg, "</circle>")?;
            }
        }
        let (begun, ending) = (FADE / 2.0, 1.0 - FADE);
        writeln!(
            svg,
            "<animate attributeName=\"opacity\" dur=\"{}s\" repeatCount=\"indefinite\" values=\"0;1;1;0\" \
             keyTimes=\"0;{begun};{ending};1\"/>\n</g>\n</svg>",
            self.duration
        )?;
        Ok(svg)
    }
}

/// Points as the attribute of a polyline.
fn joined(points: &[Point], separator: &str) -> String {
    points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(separator)
}

/// Writes a film to `target/{name}.svg` and tells where.
///
/// # Errors
/// What stands in the way of writing the file.
pub fn save(name: &str, film: &Film) -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("target");
    let file = folder.join(name).with_extension("svg");
    fs::create_dir_all(&folder)?;
    fs::write(&file, film.svg()?)?;
    println!("Drawn: {}", file.display());
    Ok(())
}
