use lagrangian::prelude::*;

struct Pendulum {
    length: f64,
}

#[lagrangian(coordinates = [theta], analysis)]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.thetta.sin(), -q.theta.cos())
    }
}

fn main() -> Result<(), MotionError<f64>> {
    let pendulum = Pendulum { length: 1.0 };
    let state = State::new([0.1], [0.2]);
    let [p] = pendulum.cyclic_momenta(&state);
    let [energy] = pendulum.conserved(&state);
    let h = pendulum.hamiltonian(0.0, &[0.1], &[p])?;
    let (rates, _) = pendulum.canonical_at(0.0, &[0.1], &[p])?;
    let regressor: SMatrix<f64, 1, 1> = pendulum.regressor(&state, &rates);
    println!("{} {:?} {energy} {h} {regressor}", Pendulum::EQUATIONS, Pendulum::CONSERVED);
    println!("{:?} {:?}", pendulum.verify(), pendulum.christoffel_second(&state)?);
    Ok(())
}
