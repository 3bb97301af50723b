//! Masses on a line, each a system of one expression for its potential and one for its force.

/// A mass on a line under a potential, a force, or both.
macro_rules! line {
    (
        $name:ident { $($field:ident),* },
        |$self:ident, $q:ident, $v:ident, $t:ident| $potential:expr, $force:expr
    ) => {
        struct $name {
            $($field: f64),*
        }

        #[lagrangian(coordinates = [x], allow(no_effect))]
        impl $name {
            #[point(mass = 1.0)]
            fn mass(&self, q: &Coordinates) -> Vector1<f64> {
                Vector1::new(q.x)
            }

            #[potential]
            fn potential(&$self, $q: &Coordinates) -> f64 {
                $potential
            }

            #[force(on = x)]
            fn force(&$self, $v: &Velocities, $t: f64) -> f64 {
                $force
            }
        }
    };
}

pub(super) use line;
