//! The cases as descriptions.

use lagrangian::prelude::*;

/// A ball that bounces.
pub struct Ball;

#[lagrangian(coordinates = [y])]
impl Ball {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = 0.8)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

/// A pendulum that hits a wall at the bottom.
pub struct Wall;

#[lagrangian(coordinates = [phi])]
impl Wall {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        0.8 * Vector2::new(q.phi.sin(), -q.phi.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }

    #[unilateral(restitution = 0.9)]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.phi
    }
}

/// A block on a spring and a rough floor.
pub struct Coulomb;

#[lagrangian(coordinates = [x])]
impl Coulomb {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        25.0 * q.x * q.x
    }

    #[friction(limit = 0.25 * 2.0 * 9.81)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// A block on a spring and a moving belt.
pub struct Belt {
    /// The speed of the belt.
    pub speed: f64,
}

#[lagrangian(coordinates = [x])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.5 * q.x * q.x
    }

    #[friction(limit = 2.4, static_limit = 4.0)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - self.speed
    }
}

/// A block that rocks from corner to corner.
pub struct Block;

#[lagrangian(coordinates = [x, y, theta])]
impl Block {
    #[body(mass = 1.0, inertia = (0.2 * 0.2 + 0.5 * 0.5) / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.theta)
    }

    fn corner(&self, q: &Coordinates, side: f64) -> Vector2<f64> {
        Vector2::new(q.x, q.y) + Rotation2::new(q.theta) * Vector2::new(side * 0.2, -0.5)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn corners(&self, q: &Coordinates) -> [f64; 2] {
        [self.corner(q, -1.0).y, self.corner(q, 1.0).y]
    }

    #[friction(coefficient = 10.0, normal = corners)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        [-1.0, 1.0].map(|side| v.x - (q.theta.sin() * side * 0.2 - q.theta.cos() * 0.5) * v.theta)
    }
}

impl Block {
    /// Tilted about its right corner.
    pub fn tilted(angle: f64) -> State<f64, 3> {
        let (sin, cos) = angle.sin_cos();
        State::at_rest([-(cos * 0.2 - sin * 0.5), sin * 0.2 + cos * 0.5, -angle])
    }
}

/// The same by hand, in the one coordinate that an expert takes: the tilt, whichever corner is below. At an
/// impact the other corner takes over, and angular momentum about it is kept.
pub struct BlockByHand;

#[lagrangian(coordinates = [tilt])]
impl BlockByHand {
    /// The angle from the diagonal to the upright side.
    fn slenderness(&self) -> f64 {
        0.2_f64.atan2(0.5)
    }

    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        0.5 * v.tilt * v.tilt
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        3.0 * 9.81 / (4.0 * 0.2_f64.hypot(0.5)) * (self.slenderness() - q.tilt).cos()
    }

    #[unilateral(restitution = 1.0 - 1.5 * self.slenderness().sin().powi(2))]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.tilt
    }
}

/// A bead on a rough hoop.
pub struct Hoop;

#[lagrangian(coordinates = [x, y])]
impl Hoop {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        q.x.hypot(q.y) - 0.5
    }

    #[friction(coefficient = 0.2, normal = bead)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (q.x * v.y - q.y * v.x) / q.x.hypot(q.y)
    }
}

/// The same by hand: the angle, and friction of the normal force that a motion on the hoop needs.
pub struct HoopByHand;

#[lagrangian(coordinates = [phi])]
impl HoopByHand {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.125 * v.phi * v.phi
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -9.81 * 0.5 * q.phi.cos()
    }

    /// The torque of friction that slips.
    fn resistance(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.2 * 0.5 * (0.5 * v.phi * v.phi + 9.81 * q.phi.cos())
    }

    #[friction(limit = resistance)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.phi
    }
}

/// A spring that is stiffer on one side.
pub struct Bilinear;

#[lagrangian(coordinates = [x])]
impl Bilinear {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let stiffness = if q.x > 0.0 { 4.0 } else { 9.0 };
        0.5 * stiffness * q.x * q.x
    }
}

/// V = |x|.
pub struct Valley;

#[lagrangian(coordinates = [x])]
impl Valley {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn depth(&self, q: &Coordinates) -> f64 {
        q.x.abs()
    }
}

/// A particle that is pushed across a rough slope: x downhill.
pub struct Slope;

#[lagrangian(coordinates = [x, y])]
impl Slope {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -9.81 * 0.3_f64.sin() * q.x
    }

    #[friction(limit = 0.45 * 9.81 * 0.3_f64.cos())]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y)
    }
}
