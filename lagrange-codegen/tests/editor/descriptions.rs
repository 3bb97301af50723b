//! Descriptions beside those that the fuzzer changes.

/// The struct, the arguments of the attribute, and the impl block: contacts, friction and events; then an
/// eliminated coordinate, a velocity and an array of constraints.
pub const MORE: [(&str, &str, &str); 2] = [
    (
        "pub struct Hopper { pub m: f64, pub g: f64, pub mu: f64 }",
        "coordinates = [x, y]",
        "impl Hopper {
            #[point(mass = self.m)] fn foot(&self, q: &Coordinates) -> Vector2<f64> { Vector2::new(q.x, q.y) }
            #[potential] fn weight(&self, q: &Coordinates) -> f64 { self.m * self.g * q.y }
            #[unilateral(restitution = 0.5)] fn gap(&self, q: &Coordinates) -> f64 { q.y }
            #[friction(coefficient = self.mu, normal = gap)] fn slip(&self, v: &Velocities) -> f64 { v.x }
            #[event] fn highest_point(&self, v: &Velocities) -> f64 { v.y }
        }",
    ),
    (
        "pub struct Slider { pub m: f64, pub l: f64, pub k: f64 }",
        "coordinates = [phi, x, y, z: [2]], inputs = [drive: [2]]",
        "impl Slider {
            #[holonomic(eliminate = x)] fn crank(&self, q: &Coordinates) -> f64 { q.x - self.l * q.phi.cos() }
            #[holonomic] fn rods(&self, q: &Coordinates) -> [f64; 2] { [q.y - q.z[0], q.z[0] - q.z[1] - 0.1 * q.phi] }
            #[point(mass = self.m)] fn pins(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
                [Vector2::new(q.x, q.z[0]), Vector2::new(q.phi.sin(), q.z[1])] }
            fn place(&self, q: &Coordinates) -> Vector2<f64> { Vector2::new(q.x, q.y) }
            #[kinetic] fn motion(&self, q: &Coordinates, v: &Velocities) -> f64 {
                let rate = self.place_velocity(q, v); 0.5 * self.m * (rate.norm_squared() + v.phi * v.phi) }
            #[potential] fn spring(&self, q: &Coordinates) -> f64 { 0.5 * self.k * q.phi * q.phi }
            #[force] fn drive(&self, u: &Inputs, t: f64) -> [f64; 5] { [u.drive[0] * t.cos(), 0.0, 0.0, 0.0, u.drive[1]] }
        }",
    ),
];
