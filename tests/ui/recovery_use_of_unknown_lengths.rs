use lagrangian::prelude::*;

struct Pendulum {
    length: f64,
}

#[lagrangian(coordinates = [x, y], analysis)]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.why)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

fn main() -> Result<(), MotionError<f64>> {
    let pendulum = Pendulum { length: 1.0 };
    let state = State::new([0.0, -1.0], [0.2, 0.0]);
    println!("{:?}", pendulum.cyclic_momenta(&state));
    let energy = pendulum.conserved(&state)[0];
    for (name, value) in Pendulum::REGRESSOR.iter().zip(pendulum.lumped_parameters()) {
        println!("{name} {value}");
    }
    let [first, _] = pendulum.conserved(&state);
    let torques = pendulum.regressor(&state, &[0.0; 2]) * SVector::from(pendulum.lumped_parameters());
    println!("{energy} {first} {torques} {:?}", pendulum.reactions_on_bob(&state)?.rod);
    Ok(())
}
