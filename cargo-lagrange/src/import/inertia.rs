//! Masses and inertias: what a body can have, and bodies that are fixed to each other.

use super::geometry::{Matrix, Pose, Vector, add, dot, norm, scaled, sub};

/// A mass with its inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// The mass [kg].
    pub mass: f64,
    /// The centre of mass in the frame of the link [m].
    pub centre: Vector,
    /// The inertia about the centre of mass in the axes of the link [kg·m²].
    pub tensor: Matrix,
}

impl Inertial {
    /// A mass given in a frame of its own.
    pub fn in_frame(frame: &Pose, mass: f64, tensor: &Matrix) -> Self {
        Inertial { mass, centre: frame.shift, tensor: frame.turn.turn_tensor(tensor) }
    }

    /// The same mass seen from a frame in which its link has a pose.
    pub fn seen_from(&self, pose: &Pose) -> Self {
        let centre = add(pose.shift, pose.turn.turn(self.centre));
        Inertial { mass: self.mass, centre, tensor: pose.turn.turn_tensor(&self.tensor) }
    }

    /// Several masses as one: of one alone the very numbers, of several the common centre and the parallel
    /// axes.
    pub fn together(parts: &[Inertial]) -> Option<Self> {
        let parts: Vec<&Inertial> = parts.iter().filter(|part| !part.is_nothing()).collect();
        if let [only] = parts.as_slice() {
            return Some(**only);
        }
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        if parts.is_empty() {
            return None;
        }
        let moment = parts.iter().fold([0.0; 3], |sum, part| add(sum, scaled(part.mass, part.centre)));
        let centre = if mass > 0.0 { moment.map(|entry| entry / mass) } else { [0.0; 3] };
        let mut tensor = [[0.0; 3]; 3];
        for part in parts {
            let arm = sub(part.centre, centre);
            let square = dot(arm, arm);
            for (i, row) in tensor.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    let parallel = if i == j { square - arm[i] * arm[j] } else { -arm[i] * arm[j] };
                    *entry += part.tensor[i][j] + part.mass * parallel;
                }
            }
        }
        Some(Inertial { mass, centre, tensor })
    }

    /// Looks for what no body can have. Roundings of the moments about the origin of the frame are allowed
    /// for.
    pub fn flaw(&self) -> Option<Flaw> {
        let [least, middle, largest] = principal_moments(&self.tensor);
        let about_origin = self.mass * dot(self.centre, self.centre);
        let rounding = 16.0 * f64::EPSILON * (largest.abs().max(least.abs()) + about_origin);
        if least < -rounding {
            return Some(Flaw::Negative(least));
        }
        let excess = largest - least - middle;
        (excess > rounding).then(|| Flaw::Triangle(excess / largest))
    }

    /// Whether there is neither mass nor inertia.
    pub fn is_nothing(&self) -> bool {
        self.mass == 0.0 && self.tensor == [[0.0; 3]; 3]
    }
}

/// A flaw of a tensor of inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flaw {
    /// A principal moment is negative: this one.
    Negative(f64),
    /// The largest principal moment exceeds the sum of the others by this share of it, which no body's can.
    Triangle(f64),
}

/// The eigenvalues of a symmetric matrix in ascending order, by Jacobi's rotations.
pub fn principal_moments(tensor: &Matrix) -> [f64; 3] {
    let mut a = *tensor;
    // Converges quadratically; the bound is never reached.
    for _ in 0..30 {
        let off = norm([a[0][1], a[0][2], a[1][2]]);
        if off <= f64::EPSILON * f64::EPSILON * norm([a[0][0], a[1][1], a[2][2]]) {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = 1.0_f64.copysign(theta) / (theta.abs() + theta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (first, second) = (a[p], a[q]);
            for (j, (&x, &y)) in first.iter().zip(&second).enumerate() {
                a[p][j] = c * x - s * y;
                a[q][j] = s * x + c * y;
            }
        }
    }
    let mut moments = [a[0][0], a[1][1], a[2][2]];
    moments.sort_by(f64::total_cmp);
    moments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::geometry::{Angle, IDENTITY, Rotation};

    #[test]
    fn principal_moments_are_found() {
        let turn = Rotation::of_angles([0.3, -0.7, 1.9].map(Angle::Radians));
        let tensor = turn.turn_tensor(&[[3.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 2.75]]);
        for (found, expected) in principal_moments(&tensor).into_iter().zip([0.5, 2.75, 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
    }

    #[test]
    fn impossible_inertias_are_seen() {
        let diagonal = |a, b, c| [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]];
        let flaw = |tensor: &Matrix| Inertial { mass: 1.0, centre: [0.0; 3], tensor: *tensor }.flaw();
        assert_eq!(flaw(&IDENTITY), None);
        assert_eq!(flaw(&diagonal(0.0, 1.0, 1.0)), None, "a thin rod");
        let noise = Inertial { mass: 1.0, centre: [0.1, 0.0, 0.0], tensor: diagonal(-1e-20, 0.0, 0.0) };
        assert_eq!(noise.flaw(), None, "a point mass, but for roundings");
        assert_eq!(flaw(&diagonal(0.1, 0.2, 0.30000000000000004)), None, "a thin plate");
        assert_eq!(flaw(&diagonal(-1.0, 2.0, 2.0)), Some(Flaw::Negative(-1.0)));
        assert_eq!(flaw(&diagonal(1.0, 1.0, 4.0)), Some(Flaw::Triangle(0.5)));
        let mixed = [[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!(matches!(flaw(&mixed), Some(Flaw::Negative(x)) if (x + 1.0).abs() < 1e-14));
    }

    /// Two halves of a cube, put together, are the cube.
    #[test]
    fn halves_make_a_whole() {
        let box_tensor = |mass: f64, [x, y, z]: Vector| {
            let moment = |a: f64, b: f64| mass / 12.0 * (a * a + b * b);
            [[moment(y, z), 0.0, 0.0], [0.0, moment(x, z), 0.0], [0.0, 0.0, moment(x, y)]]
        };
        let half =
            |x| Inertial { mass: 1.5, centre: [x, 0.0, 2.0], tensor: box_tensor(1.5, [1.0, 2.0, 2.0]) };
        let whole = Inertial::together(&[half(-0.5), half(0.5)]).expect("there is mass");
        assert_eq!((whole.mass, whole.centre), (3.0, [0.0, 0.0, 2.0]));
        let expected = box_tensor(3.0, [2.0, 2.0, 2.0]);
        for (a, b) in whole.tensor.as_flattened().iter().zip(expected.as_flattened()) {
            assert!((a - b).abs() < 1e-15);
        }
    }
}
