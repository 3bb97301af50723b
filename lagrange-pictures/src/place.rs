//! [`Place`] and [`Pose`]: where something is, in the plane or in space, in any of the types that
//! descriptions use.

use lagrange_runtime::nalgebra::{
    AbstractRotation, Isometry, Point2, Point3, RealField, Rotation2, Rotation3, UnitComplex, UnitQuaternion,
    Vector2, Vector3, convert,
};

/// A place in the units of the system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// In the plane of the picture: to the right, upwards.
    Plane([f64; 2]),
    /// In space, z upwards.
    Space([f64; 3]),
}

/// A type that says where a point is: pairs, arrays of two or three numbers, vectors and points.
pub trait Place {
    /// Where it is.
    fn spot(self) -> Spot;
}

/// A type that carries a body: isometries in the plane and in space, and rotations about the origin.
pub trait Pose {
    /// A point in the axes of the body: two numbers in the plane, three in space.
    type Corner: Copy;

    /// Where a point of the body is.
    fn carry(&self, corner: Self::Corner) -> Spot;
}

impl Place for Spot {
    fn spot(self) -> Spot {
        self
    }
}

impl<T: Into<f64>> Place for (T, T) {
    fn spot(self) -> Spot {
        Spot::Plane([self.0.into(), self.1.into()])
    }
}

impl<T: Into<f64>> Place for [T; 2] {
    fn spot(self) -> Spot {
        Spot::Plane(self.map(Into::into))
    }
}

impl<T: Into<f64>> Place for [T; 3] {
    fn spot(self) -> Spot {
        Spot::Space(self.map(Into::into))
    }
}

impl<T: Copy + Into<f64>> Place for Vector2<T> {
    fn spot(self) -> Spot {
        let [[x, y]] = self.data.0;
        [x, y].spot()
    }
}

impl<T: Copy + Into<f64>> Place for Vector3<T> {
    fn spot(self) -> Spot {
        let [place] = self.data.0;
        place.spot()
    }
}

impl<T: RealField + Copy + Into<f64>> Place for Point2<T> {
    fn spot(self) -> Spot {
        self.coords.spot()
    }
}

impl<T: RealField + Copy + Into<f64>> Place for Point3<T> {
    fn spot(self) -> Spot {
        self.coords.spot()
    }
}

impl<T: RealField + Copy + Into<f64>, R: AbstractRotation<T, 2>> Pose for Isometry<T, R, 2> {
    type Corner = [f64; 2];

    fn carry(&self, corner: [f64; 2]) -> Spot {
        (self * Point2::from(corner.map(convert))).spot()
    }
}

impl<T: RealField + Copy + Into<f64>, R: AbstractRotation<T, 3>> Pose for Isometry<T, R, 3> {
    type Corner = [f64; 3];

    fn carry(&self, corner: [f64; 3]) -> Spot {
        (self * Point3::from(corner.map(convert))).spot()
    }
}

macro_rules! rotations {
    ($($rotation:ident, $vector:ident, $length:literal;)*) => {$(
        impl<T: RealField + Copy + Into<f64>> Pose for $rotation<T> {
            type Corner = [f64; $length];

            fn carry(&self, corner: Self::Corner) -> Spot {
                (self * $vector::from(corner.map(convert))).spot()
            }
        }
    )*};
}

rotations! {
    Rotation2, Vector2, 2;
    UnitComplex, Vector2, 2;
    Rotation3, Vector3, 3;
    UnitQuaternion, Vector3, 3;
}
