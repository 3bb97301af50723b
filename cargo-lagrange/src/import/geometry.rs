//! Vectors, rotations and poses in doubles. Right angles are exact.

use std::f64::consts::FRAC_PI_2;

/// A vector in space.
pub type Vector = [f64; 3];

/// A matrix by rows.
pub type Matrix = [[f64; 3]; 3];

/// The identity.
pub const IDENTITY: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// An angle as a description writes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Angle {
    /// A multiple of a right angle: 0, 1, 2 or −1.
    Quarters(i8),
    /// Anything else [rad].
    Radians(f64),
}

impl Angle {
    /// No turn.
    pub const ZERO: Angle = Angle::Quarters(0);

    /// An angle, a right one if it is within a tolerance of it.
    pub fn new(radians: f64, tolerance: f64) -> Self {
        let quarters = (radians / FRAC_PI_2).round();
        match (radians - quarters * FRAC_PI_2).abs() <= tolerance {
            true => Angle::Quarters(wrapped(quarters)),
            false => Angle::Radians(radians),
        }
    }

    /// The angle the other way round.
    fn opposite(self) -> Self {
        match self {
            Angle::Quarters(2) => self,
            Angle::Quarters(quarters) => Angle::Quarters(-quarters),
            Angle::Radians(radians) => Angle::Radians(-radians),
        }
    }

    /// Sine and cosine.
    pub fn sin_cos(self) -> (f64, f64) {
        match self {
            Angle::Quarters(0) => (0.0, 1.0),
            Angle::Quarters(1) => (1.0, 0.0),
            Angle::Quarters(-1) => (-1.0, 0.0),
            Angle::Quarters(_) => (0.0, -1.0),
            Angle::Radians(angle) => angle.sin_cos(),
        }
    }
}

/// A count of right angles from −1 to 2.
fn wrapped(quarters: f64) -> i8 {
    match quarters.rem_euclid(4.0) {
        q if q < 0.5 => 0,
        q if q < 1.5 => 1,
        q if q < 2.5 => 2,
        _ => -1,
    }
}

/// A rotation: its matrix, and roll, pitch and yaw where they are known exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// The entries.
    pub matrix: Matrix,
    /// Roll, pitch, yaw about fixed axes.
    pub angles: Option<[Angle; 3]>,
}

impl Rotation {
    /// The rotation that does nothing.
    pub const IDENTITY: Rotation = Rotation { matrix: IDENTITY, angles: Some([Angle::ZERO; 3]) };

    /// About x, then y, then z, all fixed axes.
    pub fn of_angles(angles: [Angle; 3]) -> Self {
        let [(sr, cr), (sp, cp), (sy, cy)] = angles.map(Angle::sin_cos);
        let matrix = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ];
        // Right angles leave negative zeros, and adding zero takes their sign away.
        Rotation { matrix: matrix.map(|row| row.map(|entry| entry + 0.0)), angles: Some(angles) }
    }

    /// A rotation by its entries, by right angles if each entry is within a tolerance of an integer.
    pub fn of_matrix(matrix: Matrix, tolerance: f64) -> Self {
        let rounded = matrix.map(|row| row.map(|entry| entry.round() + 0.0));
        let near = matrix.as_flattened().iter().zip(rounded.as_flattened());
        if near.into_iter().all(|(entry, integer)| (entry - integer).abs() <= tolerance) {
            let quarters = [0, 1, 2, -1].map(Angle::Quarters);
            for index in 0..64 {
                let angles = [quarters[index % 4], quarters[index / 4 % 4], quarters[index / 16]];
                let turn = Rotation::of_angles(angles);
                if turn.matrix == rounded {
                    return turn;
                }
            }
        }
        Rotation { matrix, angles: None }
    }

    /// About a unit axis, by an angle. Right angles about coordinate axes and their opposites stay exact.
    pub fn about(axis: Vector, angle: Angle) -> Self {
        if axis.contains(&-1.0) {
            return Rotation::about(axis.map(f64::abs), angle.opposite());
        }
        let (sine, cosine) = angle.sin_cos();
        let [x, y, z] = axis;
        let v = 1.0 - cosine;
        let matrix = [
            [cosine + x * x * v, x * y * v - z * sine, x * z * v + y * sine],
            [y * x * v + z * sine, cosine + y * y * v, y * z * v - x * sine],
            [z * x * v - y * sine, z * y * v + x * sine, cosine + z * z * v],
        ];
        let angles = match axis {
            [1.0, 0.0, 0.0] => Some([angle, Angle::ZERO, Angle::ZERO]),
            [0.0, 1.0, 0.0] => Some([Angle::ZERO, angle, Angle::ZERO]),
            [0.0, 0.0, 1.0] => Some([Angle::ZERO, Angle::ZERO, angle]),
            _ => None,
        };
        angles.map_or(Rotation { matrix, angles: None }, Rotation::of_angles)
    }

    /// Whether it does nothing.
    pub fn is_identity(&self) -> bool {
        self.matrix == IDENTITY
    }

    /// A turned vector.
    pub fn turn(&self, vector: Vector) -> Vector {
        self.matrix.map(|row| dot(row, vector))
    }

    /// This rotation after another one. Products of right angles stay exact.
    pub fn after(&self, first: &Rotation) -> Rotation {
        if self.is_identity() {
            return *first;
        }
        if first.is_identity() {
            return *self;
        }
        Rotation::of_matrix(product(&self.matrix, &first.matrix), 0.0)
    }

    /// A tensor given in turned axes.
    pub fn turn_tensor(&self, tensor: &Matrix) -> Matrix {
        product(&product(&self.matrix, tensor), &transposed(&self.matrix))
    }
}

/// A place and an orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The origin [m].
    pub shift: Vector,
    /// The axes.
    pub turn: Rotation,
}

impl Pose {
    /// The pose of the reference itself.
    pub const IDENTITY: Pose = Pose { shift: [0.0; 3], turn: Rotation::IDENTITY };

    /// Whether it is that of the reference itself.
    pub fn is_identity(&self) -> bool {
        self.shift == [0.0; 3] && self.turn.is_identity()
    }

    /// A pose given in this one, in the reference of this one.
    pub fn compose(&self, inner: &Pose) -> Pose {
        Pose { shift: add(self.shift, self.turn.turn(inner.shift)), turn: self.turn.after(&inner.turn) }
    }
}

/// Σ aᵢ bᵢ.
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The sum.
pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The difference.
pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// A multiple.
pub fn scaled(factor: f64, a: Vector) -> Vector {
    a.map(|entry| factor * entry)
}

/// The vector product.
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The length.
pub fn norm(a: Vector) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

/// The direction of `a` in numbers whose squares have all their digits. Beside the ends of the range of
/// doubles squares and lengths overflow or lose digits. A power of two leads away from there without
/// rounding.
pub fn moderate<const N: usize>(a: [f64; N]) -> [f64; N] {
    let factor = match a.into_iter().fold(0.0, |largest, entry| entry.abs().max(largest)) {
        largest if largest < 1e-100 => 2_f64.powi(600),
        largest if largest > 1e100 => 2_f64.powi(-600),
        _ => 1.0,
    };
    a.map(|entry| factor * entry)
}

/// A unit vector along `a`; `None` for zero.
pub fn unit(a: Vector) -> Option<Vector> {
    let a = moderate(a);
    let length = norm(a);
    (length != 0.0).then(|| a.map(|entry| entry / length))
}

/// A unit vector along `a`, along an axis if it is within a tolerance of it; `None` for zero.
pub fn direction(a: Vector, tolerance: f64) -> Option<Vector> {
    let unit = unit(a)?;
    let main = (0..3).find(|&i| (0..3).all(|j| i == j || unit[j].abs() <= tolerance));
    Some(main.map_or(unit, |i| std::array::from_fn(|j| if i == j { unit[i].signum() } else { 0.0 })))
}

/// The matrix product.
pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transposed(b);
    a.map(|row| columns.map(|column| dot(row, column)))
}

/// Rows and columns exchanged.
pub fn transposed(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As files write them.
    #[test]
    #[allow(clippy::approx_constant)]
    fn right_angles_are_exact() {
        for (written, quarters) in [(1.57079632679, 1), (-3.14159265359, 2), (4.71238898038, -1), (0.0, 0)] {
            assert_eq!(Angle::new(written, 1e-9), Angle::Quarters(quarters));
        }
        assert_eq!(Angle::new(1.57, 1e-9), Angle::Radians(1.57));
        let turn = Rotation::of_angles([Angle::Quarters(1), Angle::Quarters(-1), Angle::Quarters(2)]);
        assert!(turn.matrix.as_flattened().iter().all(|entry| [-1.0, 0.0, 1.0].contains(entry)));
    }

    /// Lengths among the denormals have few digits, and those of the largest numbers overflow.
    #[test]
    fn directions_do_not_depend_on_the_length() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        for size in [f64::from_bits(1), 1e-320, 1e-310, 1e-200, 1e200, 1.7e308] {
            let [x, y, z] = direction([size, 0.0, -size], 0.0).expect("the vector is not zero");
            assert!((x - half).abs() < 1e-15 && y == 0.0 && z == -x, "{size:e} {x:?} {z:?}");
        }
        assert_eq!(direction([0.0; 3], 0.0), None);
    }

    #[test]
    fn products_of_right_angles_have_right_angles() {
        let x = Rotation::of_angles([Angle::Quarters(1), Angle::ZERO, Angle::ZERO]);
        let z = Rotation::of_angles([Angle::ZERO, Angle::ZERO, Angle::Quarters(-1)]);
        let both = x.after(&z);
        let angles = both.angles.expect("a product of right angles has right angles");
        assert_eq!(Rotation::of_angles(angles).matrix, product(&x.matrix, &z.matrix));
    }

    /// Roll, pitch and yaw are turns about fixed axes, x first.
    #[test]
    fn angles_are_those_of_urdf() {
        let [roll, pitch, yaw] = [0.3, -0.4, 1.1].map(Angle::Radians);
        let turn = |axis, angle| Rotation::about(axis, angle).matrix;
        let zy = product(&turn([0.0, 0.0, 1.0], yaw), &turn([0.0, 1.0, 0.0], pitch));
        let expected = product(&zy, &turn([1.0, 0.0, 0.0], roll));
        let found = Rotation::of_angles([roll, pitch, yaw]).matrix;
        for (a, b) in expected.as_flattened().iter().zip(found.as_flattened()) {
            assert!((a - b).abs() < 1e-15, "{expected:?} {found:?}");
        }
    }
}
