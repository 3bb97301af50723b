//! Vector functions for any [`Real`], which nalgebra has for a closed list of scalars alone.
//!
//! Rotations follow nalgebra: active, right-handed, Euler angles as roll about x, then pitch about y, then
//! yaw about z of the fixed frame.

use nalgebra::{
    DefaultAllocator, Dim, Isometry, Matrix, Matrix2, Matrix3, OMatrix, RawStorage, Rotation2, Rotation3,
    Translation, U1, Unit, UnitComplex, UnitQuaternion, Vector3, allocator::Allocator,
};

use crate::number::real::Real;

/// Sum of squares of a column.
#[inline]
pub fn norm_squared<R: Real, D: Dim, S: RawStorage<R, D, U1>>(column: &Matrix<R, D, U1, S>) -> R {
    let mut sum = R::zero();
    for &x in column.iter() {
        sum += x * x;
    }
    sum
}

/// Euclidean length of a column. Overflows where a square does.
#[inline]
pub fn norm<R: Real, D: Dim, S: RawStorage<R, D, U1>>(column: &Matrix<R, D, U1, S>) -> R {
    norm_squared(column).sqrt()
}

/// A column divided by its length; NaN for the zero column.
#[inline]
pub fn normalize<R: Real, D: Dim, S: RawStorage<R, D, U1>>(column: &Matrix<R, D, U1, S>) -> OMatrix<R, D, U1>
where
    DefaultAllocator: Allocator<D, U1>,
{
    let scale = norm(column).recip();
    column.map(|x| x * scale)
}

/// Length of the difference of two columns.
#[inline]
pub fn distance<R: Real, D: Dim, A: RawStorage<R, D, U1>, B: RawStorage<R, D, U1>>(
    a: &Matrix<R, D, U1, A>,
    b: &Matrix<R, D, U1, B>,
) -> R {
    let mut sum = R::zero();
    for (&x, &y) in a.iter().zip(b.iter()) {
        sum += (x - y) * (x - y);
    }
    sum.sqrt()
}

/// Rotation of the plane by `angle` \[rad], counter-clockwise.
#[inline]
pub fn rotation2<R: Real>(angle: R) -> Rotation2<R> {
    let (s, c) = angle.sin_cos();
    Rotation2::from_matrix_unchecked(Matrix2::new(c, -s, s, c))
}

/// Rotation by `angle` \[rad] about a unit axis (Rodrigues' formula).
#[inline]
pub fn rotation3_axis_angle<R: Real>(axis: &Unit<Vector3<R>>, angle: R) -> Rotation3<R> {
    let (x, y, z) = (axis.as_ref().x, axis.as_ref().y, axis.as_ref().z);
    let (s, c) = angle.sin_cos();
    let k = R::one() - c;
    Rotation3::from_matrix_unchecked(Matrix3::new(
        x * x * k + c,
        x * y * k - z * s,
        x * z * k + y * s,
        x * y * k + z * s,
        y * y * k + c,
        y * z * k - x * s,
        x * z * k - y * s,
        y * z * k + x * s,
        z * z * k + c,
    ))
}

/// Rotation by Euler angles \[rad]: roll about x, then pitch about y, then yaw about z.
#[inline]
pub fn rotation3_euler_angles<R: Real>(roll: R, pitch: R, yaw: R) -> Rotation3<R> {
    let (sr, cr) = roll.sin_cos();
    let (sp, cp) = pitch.sin_cos();
    let (sy, cy) = yaw.sin_cos();
    Rotation3::from_matrix_unchecked(Matrix3::new(
        cy * cp,
        cy * sp * sr - sy * cr,
        cy * sp * cr + sy * sr,
        sy * cp,
        sy * sp * sr + cy * cr,
        sy * sp * cr - cy * sr,
        -sp,
        cp * sr,
        cp * cr,
    ))
}

/// A type with a rotation, as a matrix of nalgebra.
pub trait Turned {
    /// `Rotation2` or `Rotation3`.
    type Matrix;

    /// The rotation.
    fn rotation_matrix(&self) -> Self::Matrix;
}

impl<T: Turned + ?Sized> Turned for &T {
    type Matrix = T::Matrix;

    #[inline]
    fn rotation_matrix(&self) -> T::Matrix {
        (**self).rotation_matrix()
    }
}

impl<R: Real> Turned for Rotation2<R> {
    type Matrix = Self;

    #[inline]
    fn rotation_matrix(&self) -> Self {
        *self
    }
}

impl<R: Real> Turned for UnitComplex<R> {
    type Matrix = Rotation2<R>;

    #[inline]
    fn rotation_matrix(&self) -> Rotation2<R> {
        Rotation2::from_matrix_unchecked(Matrix2::new(self.re, -self.im, self.im, self.re))
    }
}

impl<R: Real> Turned for Rotation3<R> {
    type Matrix = Self;

    #[inline]
    fn rotation_matrix(&self) -> Self {
        *self
    }
}

impl<R: Real> Turned for UnitQuaternion<R> {
    type Matrix = Rotation3<R>;

    /// 1 + 2 w \[u\]ₓ + 2 \[u\]ₓ² of a unit quaternion w + u.
    #[inline]
    fn rotation_matrix(&self) -> Rotation3<R> {
        let [i, j, k, w]: [R; 4] = self.as_ref().coords.into();
        let (one, two) = (R::one(), R::from_f64(2.0));
        Rotation3::from_matrix_unchecked(Matrix3::new(
            one - two * (j * j + k * k),
            two * (i * j - w * k),
            two * (i * k + w * j),
            two * (i * j + w * k),
            one - two * (i * i + k * k),
            two * (j * k - w * i),
            two * (i * k - w * j),
            two * (j * k + w * i),
            one - two * (i * i + j * j),
        ))
    }
}

impl<R, T: Turned, const D: usize> Turned for Isometry<R, T, D> {
    type Matrix = T::Matrix;

    #[inline]
    fn rotation_matrix(&self) -> T::Matrix {
        self.rotation.rotation_matrix()
    }
}

/// The rotation of a rotation, a quaternion or a pose.
#[inline]
pub fn rotation_matrix<T: Turned>(turned: &T) -> T::Matrix {
    turned.rotation_matrix()
}

/// The angle \[rad] of a rotation of the plane, in \[−π, π].
#[inline]
pub fn angle<R: Real, T: Turned<Matrix = Rotation2<R>>>(turned: &T) -> R {
    let rotation = turned.rotation_matrix();
    rotation[(1, 0)].atan2(rotation[(0, 0)])
}

/// The pose of a translation and a rotation.
#[inline]
pub fn pose<R, T, const D: usize>(translation: Translation<R, D>, rotation: T) -> Isometry<R, T, D> {
    Isometry { rotation, translation }
}

/// The inertia of a spatial body about its principal axes.
#[diagnostic::on_unimplemented(
    message = "`inertia` of a spatial body takes three principal moments (`[R; 3]` or `Vector3`)",
    label = "not three principal moments",
    note = "for a full tensor give a helper function that returns `Matrix3`"
)]
pub trait PrincipalMoments<R> {
    /// Moments about the body's x, y and z axes \[kg·m²].
    fn principal_moments(&self) -> [R; 3];
}

impl<R: Copy> PrincipalMoments<R> for [R; 3] {
    #[inline]
    fn principal_moments(&self) -> [R; 3] {
        *self
    }
}

impl<R: Real> PrincipalMoments<R> for Vector3<R> {
    #[inline]
    fn principal_moments(&self) -> [R; 3] {
        [self.x, self.y, self.z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    fn near(a: Matrix3<f64>, b: Matrix3<f64>) -> bool {
        (a - b).iter().all(|x| x.abs() < 1e-15)
    }

    #[test]
    fn lengths() {
        let v = Vector2::new(3.0, 4.0);
        assert_eq!((norm(&v), norm_squared(&v), distance(&v, &Vector2::new(0.0, 8.0))), (5.0, 25.0, 5.0));
        assert_eq!(normalize(&v), Vector2::new(3.0, 4.0) * (1.0 / 5.0));
    }

    #[test]
    fn a_quarter_turn_takes_x_to_y() {
        let turned = rotation2(core::f64::consts::FRAC_PI_2) * Vector2::new(1.0, 0.0);
        assert!(distance(&turned, &Vector2::new(0.0, 1.0)) < 1e-15);
    }

    #[test]
    fn rotations_are_those_of_nalgebra() {
        let axis = Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5));
        let ours = rotation3_axis_angle(&axis, 0.7);
        assert!(near(*ours.matrix(), *Rotation3::from_axis_angle(&axis, 0.7).matrix()));
        assert!(!near(*ours.matrix(), *Rotation3::from_axis_angle(&axis, -0.7).matrix()));
        let ours = rotation3_euler_angles(0.1, 0.2, 0.3);
        assert!(near(*ours.matrix(), *Rotation3::from_euler_angles(0.1, 0.2, 0.3).matrix()));
        assert!(!near(*ours.matrix(), *Rotation3::from_euler_angles(0.3, 0.2, 0.1).matrix()));
    }

    #[test]
    fn every_kind_of_turn_is_its_matrix() {
        let quaternion = UnitQuaternion::from_euler_angles(0.3, -0.7, 1.9);
        let matrix = quaternion.to_rotation_matrix();
        let pose = pose(Translation::<f64, 3>::new(1.0, 2.0, 3.0), quaternion);
        assert!(near(*rotation_matrix(&quaternion).matrix(), *matrix.matrix()));
        assert!(near(*rotation_matrix(&&pose).matrix(), *matrix.matrix()));
        assert_eq!(rotation_matrix(&matrix), matrix);
        let (turned, expected) = (rotation_matrix(&UnitComplex::new(0.4_f64)), Rotation2::new(0.4));
        assert!((turned.matrix() - expected.matrix()).norm() < 1e-15);
        assert!((angle(&UnitComplex::new(2.5_f64)) - 2.5).abs() < 1e-15);
        assert!((angle(&Rotation2::new(-2.5_f64)) + 2.5).abs() < 1e-15);
    }

    #[test]
    fn moments_from_an_array_or_a_vector() {
        assert_eq!([1.0, 2.0, 3.0].principal_moments(), Vector3::new(1.0, 2.0, 3.0).principal_moments());
    }
}
