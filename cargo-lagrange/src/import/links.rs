//! Reading that both formats share: angles, masses, names that are nearly right.

use roxmltree::Node;

use super::Options;
use super::geometry::Angle;
use super::inertia::{Flaw, Inertial};
use super::robot::Doubtful;
use super::xml::Reader;

/// How far angles of few digits, such as 1.57 or 3.14, are from the right angle that they mean.
const FEW_DIGITS: f64 = 2e-3;

/// Angles [rad] of an element, right ones within the tolerance of the options.
pub fn angles<const N: usize>(
    reader: &mut Reader<'_>,
    node: Node<'_, '_>,
    radians: [f64; N],
    options: &Options,
) -> [Angle; N] {
    let mut rough: Vec<String> = Vec::new();
    let angles = radians.map(|radians| {
        let angle = Angle::new(radians, options.tolerance);
        let is_turned = radians.abs() > FEW_DIGITS;
        let is_rough =
            is_turned && angle == Angle::Radians(radians) && Angle::new(radians, FEW_DIGITS) != angle;
        let written = radians.to_string();
        if is_rough && !rough.contains(&written) {
            rough.push(written);
        }
        angle
    });
    let what = match rough.as_slice() {
        [] => return angles,
        [one] => format!("{one} is a right angle of few digits, and is taken as written"),
        all => format!("{} are right angles of few digits, and are taken as written", all.join(" and ")),
    };
    let them = if rough.len() == 1 { "it" } else { "them" };
    reader.warning(node, format!("{what}; --right-angles {FEW_DIGITS} makes {them} exact"));
    angles
}

/// Reports what no body can have. A link that is fixed to others may have any inertia, if all together have a
/// good one; its doubtful inertia is returned.
pub fn check_inertia(
    reader: &mut Reader<'_>,
    (mass, attribute): (Node<'_, '_>, &str),
    node: Node<'_, '_>,
    inertial: &Inertial,
) -> Option<Doubtful> {
    if inertial.mass < 0.0 {
        let text = format!("the mass {} is negative; write one from 0 on", inertial.mass);
        reader.problem_of(mass, attribute, text);
    }
    match inertial.flaw()? {
        Flaw::Negative(moment) => Some(Doubtful { mark: reader.mark(node), moment }),
        Flaw::Triangle(excess) => {
            let text = format!(
                "the largest principal moment of inertia exceeds the sum of the two others by {:.2} %, \
                 which no body's does; it is taken as it is",
                100.0 * excess
            );
            reader.warning(node, text);
            None
        }
    }
}

/// A hint at a name that is nearly the one that was written.
pub fn near<'n>(written: &str, names: impl Iterator<Item = &'n str>) -> String {
    let nearest = names.map(|name| (distance(written, name), name)).min();
    let bound = 1 + written.chars().count() / 4;
    nearest
        .filter(|(distance, _)| *distance <= bound)
        .map(|(_, name)| format!(", or did you mean `{name}`?"))
        .unwrap_or_default()
}

/// The number of characters to change, insert, remove, and of neighbours to exchange (the optimal string
/// alignment distance).
fn distance(a: &str, b: &str) -> usize {
    let [a, b]: [Vec<char>; 2] = [a, b].map(|text| text.chars().collect());
    let mut rows = vec![(0..=b.len()).collect::<Vec<usize>>()];
    for (i, &x) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, &y) in b.iter().enumerate() {
            let changed = rows[i][j] + usize::from(x != y);
            let mut least = changed.min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && x == b[j - 1] && a[i - 1] == y {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}
