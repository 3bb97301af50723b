//! The systems of the studies, as a user describes them, each with the starts of its motions.

use lagrangian::prelude::*;

/// Gravitational acceleration [m/s²].
const G: f64 = 9.81;

/// Unit masses on unit rods, absolute angles.
macro_rules! chain {
    ($name:ident, $links:literal) => {
        pub struct $name;

        #[lagrangian(coordinates = [theta: [$links]], jacobians)]
        impl $name {
            #[point(mass = 1.0)]
            fn joints(&self, q: &Coordinates) -> [Vector2<f64>; $links] {
                let mut end = Vector2::zeros();
                q.theta.map(|theta| {
                    end += Vector2::new(theta.sin(), -theta.cos());
                    end
                })
            }

            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 {
                self.joints(q).iter().map(|joint| G * joint.y).sum()
            }
        }
    };
}

chain!(Double, 2);
chain!(Five, 5);

/// Cart and pole with damping and a periodic force; θ from upright.
pub struct CartPole;

#[lagrangian(coordinates = [x, theta], jacobians)]
impl CartPole {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = 0.2)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * 0.5
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.2 * G * self.tip(q).y
    }

    #[dissipation]
    fn bearings(&self, v: &Velocities) -> f64 {
        0.5 * (0.1 * v.x.powi(2) + 0.02 * v.theta.powi(2))
    }

    #[force(at = cart)]
    fn motor(&self, t: f64) -> Vector2<f64> {
        Vector2::new(2.0 * (1.5 * t).cos(), 0.0)
    }
}

/// Kepler's problem, μ = 1.
pub struct Kepler;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Kepler {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -1.0 / self.planet(q).norm()
    }
}

/// Crank of ½ and rod of 1, uniform, and a piston, unit masses; a constraint.
pub struct Slider;

#[lagrangian(coordinates = [theta: [2]], jacobians)]
impl Slider {
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[body(mass = 1.0, inertia = 0.25 / 12.0)]
    fn crank(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::along(q.theta[0]) * 0.25, q.theta[0])
    }

    #[body(mass = 1.0, inertia = 1.0 / 12.0)]
    fn rod(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::along(q.theta[0]) * 0.5 + Self::along(q.theta[1]) * 0.5, q.theta[1])
    }

    #[point(mass = 1.0)]
    fn piston(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(0.5 * q.theta[0].cos() + q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.crank(q).0.y + self.rod(q).0.y)
    }

    #[holonomic]
    fn guide(&self, q: &Coordinates) -> f64 {
        0.5 * q.theta[0].sin() + q.theta[1].sin()
    }
}

/// Numbers between 0 and 1 that spread evenly, whatever their number.
pub fn spread(index: u64) -> f64 {
    (index as f64 * 0.618_033_988_749_894_9).fract()
}

pub fn double(index: u64) -> (Double, State<f64, 2>) {
    (Double, State::at_rest([0.5 + spread(index), 1.0]))
}

pub fn five(index: u64) -> (Five, State<f64, 5>) {
    (Five, State::at_rest([0.2 + 0.5 * spread(index); 5]))
}

pub fn cart(index: u64) -> (CartPole, State<f64, 2>) {
    (CartPole, State::at_rest([0.0, 1.0 + 1.5 * spread(index)]))
}

/// Eccentricities from 0 to 0.6.
pub fn kepler(index: u64) -> (Kepler, State<f64, 2>) {
    (Kepler, State::new([1.0, 0.0], [0.0, (1.0 - 0.6 * spread(index)).sqrt()]))
}

pub fn slider(index: u64) -> (Slider, State<f64, 2>) {
    (Slider, crank(index))
}

/// A start on the constraint, as exact as the scalar is.
pub fn crank<R: Real>(index: u64) -> State<R, 2> {
    let (crank, rate) = (R::from_f64(0.8), R::from_f64(3.0 + 3.0 * spread(index)));
    let half = R::from_f64(0.5);
    let rod = -(half * crank.sin()).asin();
    State::new([crank, rod], [rate, -(half * crank.cos() * rate / rod.cos())])
}
