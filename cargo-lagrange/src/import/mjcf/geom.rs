//! The masses of geoms.

use std::f64::consts::PI;

use super::attributes::{Attributes, Element, lifted};
use crate::import::Options;
use crate::import::geometry::{Pose, Rotation, Vector, add, norm, scaled, sub, unit};
use crate::import::inertia::Inertial;
use crate::import::xml::Reader;

/// The density of a geom that gives none [kg/m³].
const WATER: f64 = 1000.0;

/// The types whose volumes are known.
const SHAPES: [&str; 5] = ["sphere", "capsule", "cylinder", "box", "ellipsoid"];

/// The mass of a geom in the frame of its body. `None` for planes and geoms without mass, and where the file
/// is wrong, which is reported. A mass that does not count need not be known.
pub fn inertial<'a>(
    reader: &mut Reader<'a>,
    attributes: &Attributes<'a>,
    node: Element<'a>,
    counts: bool,
    options: &Options,
) -> Option<Inertial> {
    let has_mesh = attributes.find(reader, node, "mesh").is_some();
    let kind = match attributes.text(reader, node, "type") {
        Some(kind) => kind,
        None if has_mesh => "mesh",
        None => "sphere",
    };
    let mass = attributes.number(reader, node, "mass");
    let density = attributes.number(reader, node, "density").unwrap_or(WATER);
    let is_massless = mass.map_or(density == 0.0, |mass| mass == 0.0);
    // Planes are endless.
    if is_massless || kind == "plane" {
        return None;
    }
    if mass.unwrap_or(density) < 0.0 {
        let attribute = if mass.is_some() { "mass" } else { "density" };
        reader.problem_of(node, attribute, format!("`{attribute}` is negative; write a number from 0 on"));
        return None;
    }
    if attributes.text(reader, node, "shellinertia") == Some("true") {
        reader.problem(node, "inertias of shells are not read; write an <inertial> into the body");
        return None;
    }
    // MuJoCo fits a primitive shape to the mesh that it names, whatever its own size is.
    let is_fitted = has_mesh && SHAPES.contains(&kind);
    if is_fitted || !SHAPES.contains(&kind) {
        let what = if is_fitted { "fitted to a mesh".to_owned() } else { format!("of type `{kind}`") };
        let text = format!(
            "the mass of a geom {what} is not known; write an <inertial> into the body, or mass=\"0\" if it \
             is there to be seen only"
        );
        if counts {
            reader.problem(node, text);
        }
        return None;
    }
    let (frame, size) = placed(reader, attributes, node, kind, options)?;
    let (volume, moments) = solid(kind, size)?;
    let mass = mass.unwrap_or(density * volume);
    let [x, y, z] = moments.map(|moment| mass * moment);
    Some(Inertial::in_frame(&frame, mass, &[[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]))
}

/// The frame of a geom, and its sizes.
fn placed<'a>(
    reader: &mut Reader<'a>,
    attributes: &Attributes<'a>,
    node: Element<'a>,
    kind: &str,
    options: &Options,
) -> Option<(Pose, Vector)> {
    let mut size = attributes.list(reader, node, "size");
    let ends: Option<[f64; 6]> = attributes.vector(reader, node, "fromto");
    let (needed, last) = match kind {
        "sphere" => (1, None),
        "capsule" | "cylinder" => (2, Some(1)),
        // A box or an ellipsoid.
        _ => (3, Some(2)),
    };
    if ends.is_some() && attributes.find(reader, node, "pos").is_some() {
        let text = "both `fromto` and `pos` place it, of its own or of its default class; remove one of them";
        reader.problem(node, text);
    }
    if ends.is_some() && last.is_none() {
        let text =
            format!("a {kind} has no `fromto`; write `pos`, or type=\"capsule\", cylinder, box, ellipsoid");
        reader.problem(node, text);
    }
    let frame = match (ends, last) {
        (Some([a, b, c, d, e, f]), Some(last)) => {
            let along = sub([a, b, c], [d, e, f]);
            let length = norm(along);
            let Some(axis) = unit(along) else {
                reader.problem_of(node, "fromto", "the two points are one; write two that differ");
                return None;
            };
            // The first size serves both directions across, even where there are more.
            let across = size.first().copied();
            size = across.into_iter().cycle().take(last).chain([0.5 * length]).collect();
            let turn = Rotation::of_matrix(lifted(axis), options.tolerance);
            Pose { shift: scaled(0.5, add([a, b, c], [d, e, f])), turn }
        }
        _ => attributes.pose(reader, node, options),
    };
    if size.len() < needed || size.iter().take(needed).any(|size| *size <= 0.0) {
        reader.problem(node, format!("a {kind} needs {needed} positive numbers in `size`"));
        return None;
    }
    Some((frame, std::array::from_fn(|i| size.get(i).copied().unwrap_or(0.0))))
}

/// The volume of a shape, and its principal moments for a unit of mass.
fn solid(kind: &str, [a, b, c]: Vector) -> Option<(f64, Vector)> {
    let ball = 4.0 / 3.0 * PI;
    Some(match kind {
        "sphere" => (ball * a.powi(3), [0.4 * a * a; 3]),
        "ellipsoid" => {
            (ball * a * b * c, [(b * b + c * c) / 5.0, (a * a + c * c) / 5.0, (a * a + b * b) / 5.0])
        }
        "box" => (8.0 * a * b * c, [(b * b + c * c) / 3.0, (a * a + c * c) / 3.0, (a * a + b * b) / 3.0]),
        "cylinder" => {
            let across = a * a / 4.0 + b * b / 3.0;
            (2.0 * PI * a * a * b, [across, across, a * a / 2.0])
        }
        "capsule" => {
            let (cylinder, ends) = (2.0 * PI * a * a * b, ball * a.powi(3));
            let volume = cylinder + ends;
            // Half a ball has its centre of mass 3/8 of the radius off its flat side.
            let across = cylinder * (a * a / 4.0 + b * b / 3.0) + ends * (0.4 * a * a + b * b + 0.75 * a * b);
            let along = cylinder * a * a / 2.0 + ends * 0.4 * a * a;
            (volume, [across / volume, across / volume, along / volume])
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments of solids by summing small cells.
    #[test]
    fn moments_are_those_of_solids() {
        let inside = |kind: &str, [a, b, c]: Vector, [x, y, z]: Vector| match kind {
            "sphere" => norm([x, y, z]) <= a,
            "ellipsoid" => norm([x / a, y / b, z / c]) <= 1.0,
            "box" => x.abs() <= a && y.abs() <= b && z.abs() <= c,
            "cylinder" => x.hypot(y) <= a && z.abs() <= b,
            "capsule" => norm([x, y, z - z.clamp(-b, b)]) <= a,
            _ => unreachable!("the kinds below"),
        };
        for (kind, size) in [
            ("sphere", [0.7, 0.0, 0.0]),
            ("ellipsoid", [0.5, 0.9, 0.3]),
            ("box", [0.5, 0.9, 0.3]),
            ("cylinder", [0.4, 0.6, 0.0]),
            ("capsule", [0.4, 0.5, 0.0]),
        ] {
            let (volume, moments) = solid(kind, size).expect("the kind is known");
            let (count, step) = (100_i32, 0.02);
            let at = |i: i32| (f64::from(i) + 0.5) * step - 0.5 * f64::from(count) * step;
            let (mut sum, mut second) = (0.0, [0.0; 3]);
            for cell in 0..count.pow(3) {
                let [x, y, z] = [at(cell % count), at(cell / count % count), at(cell / count / count)];
                if inside(kind, size, [x, y, z]) {
                    let cell = step.powi(3);
                    sum += cell;
                    second = add(second, scaled(cell, [y * y + z * z, x * x + z * z, x * x + y * y]));
                }
            }
            assert!((sum / volume - 1.0).abs() < 0.01, "{kind}: {sum} {volume}");
            for (found, moment) in second.iter().zip(moments) {
                assert!((found / sum / moment - 1.0).abs() < 0.01, "{kind}: {} {moment}", found / sum);
            }
        }
    }
}
