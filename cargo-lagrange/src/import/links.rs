//! What both formats read alike: angles, masses, names that are nearly right.

use roxmltree::Node;

use super::Options;
use super::geometry::{Angle, Matrix};
use super::inertia::{Flaw, flaw};
use super::xml::Reader;

/// An angle that nearly is a right one, but not to the tolerance, is worth a word.
const SUSPICIOUS: f64 = 1e-3;

/// An angle [rad], a right one within the tolerance of the options.
pub fn angle(reader: &mut Reader<'_>, node: Node<'_, '_>, radians: f64, options: &Options) -> Angle {
    let angle = Angle::new(radians, options.tolerance);
    if matches!(angle, Angle::Radians(_)) && matches!(Angle::new(radians, SUSPICIOUS), Angle::Quarters(_)) {
        let text = format!("{radians} is nearly a right angle and is taken as written; --right-angles 1e-3 makes it one");
        reader.warning(node, text);
    }
    angle
}

/// Reports what no body can have.
pub fn check_inertia(
    reader: &mut Reader<'_>,
    mass_node: Node<'_, '_>,
    mass_attribute: &str,
    inertia: Node<'_, '_>,
    mass: f64,
    tensor: &Matrix,
    options: &Options,
) {
    if mass < 0.0 {
        reader.problem_of(mass_node, mass_attribute, format!("the mass {mass} is negative; write one from 0 on"));
    }
    match flaw(tensor) {
        Some(Flaw::Negative(moment)) => {
            let text = format!(
                "the inertia is not positive definite, a principal moment is {moment:.3e}, which no body's is; write \
                 moments about the centre of mass, and products of inertia with their signs"
            );
            match options.unphysical {
                true => reader.warning(inertia, text),
                false => reader.problem(inertia, text + ", or take it as it is with --unphysical"),
            }
        }
        Some(Flaw::Triangle(excess)) => {
            let text = format!(
                "the largest principal moment of inertia exceeds the sum of the two others by {:.2} %, which no body's \
                 does; it is taken as it is",
                100.0 * excess
            );
            reader.warning(inertia, text);
        }
        None => {}
    }
}

/// A hint at a name that is nearly the one that was written.
pub fn near<'n>(written: &str, names: impl Iterator<Item = &'n str>) -> String {
    let nearest = names.map(|name| (distance(written, name), name)).min();
    let bound = 1 + written.chars().count() / 4;
    nearest.filter(|(distance, _)| *distance <= bound).map(|(_, name)| format!(", or did you mean `{name}`?")).unwrap_or_default()
}

/// The number of characters to change, insert and remove.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = i;
        row[0] = i + 1;
        for (j, &y) in b.iter().enumerate() {
            let changed = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
