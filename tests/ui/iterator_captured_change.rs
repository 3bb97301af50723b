use lagrangian::prelude::*;

struct System {
    mass: f64,
}

#[lagrangian(coordinates = [x])]
impl System {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x * v.x
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        let mut count = 0.0;
        let turns = (0..3).map(|i| {
            count += 1.0;
            count * i as f64
        });
        turns.take(2).sum::<f64>() * q.x + count
    }
}

fn main() {}
