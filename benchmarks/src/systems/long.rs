//! Long chains as a user describes them, for `f64`: with a type parameter for the scalar, a hundred rods do
//! not compile in nine gigabytes.

use lagrangian::prelude::*;

/// Gravitational acceleration [m/s²].
const G: f64 = 9.81;

/// A planar chain of unit links with unit masses at the joints, in absolute angles.
macro_rules! chain {
    ($name:ident, $count:literal) => {
        /// Planar chain.
        pub struct $name;

        #[lagrangian(coordinates = [theta: [$count]])]
        impl $name {
            #[point(mass = 1.0)]
            fn joints(&self, q: &Coordinates) -> [Vector2<f64>; $count] {
                let mut joints = [Vector2::zeros(); $count];
                let mut end = Vector2::zeros();
                for i in 0..$count {
                    end += Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
                    joints[i] = end;
                }
                joints
            }

            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 {
                self.joints(q).iter().map(|joint| G * joint.y).sum()
            }
        }
    };
}

/// A planar chain of unit rods with unit masses at their ends, in Cartesian coordinates with multipliers.
macro_rules! rods {
    ($name:ident, $count:literal) => {
        /// Chain of rods.
        pub struct $name;

        #[lagrangian(coordinates = [x: [$count], y: [$count]])]
        impl $name {
            #[point(mass = 1.0)]
            fn joints(&self, q: &Coordinates) -> [Vector2<f64>; $count] {
                core::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
            }

            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 {
                self.joints(q).iter().map(|joint| G * joint.y).sum()
            }

            #[holonomic]
            fn rods(&self, q: &Coordinates) -> [f64; $count] {
                let joints = self.joints(q);
                let mut above = Vector2::zeros();
                let mut rods = [0.0; $count];
                for i in 0..$count {
                    rods[i] = 0.5 * ((joints[i] - above).norm_squared() - 1.0);
                    above = joints[i];
                }
                rods
            }
        }
    };
}

chain!(Chain50, 50);
chain!(Chain100, 100);
rods!(Rods20, 20);
rods!(Rods100, 100);
