// Not compiled: a module tree in which models are found without compiling.
mod deep;
#[path = "elsewhere.rs"]
mod other;
mod absent;

mod inline {
    mod leaf;

    #[lagrangian::lagrangian(coordinates = [x])]
    impl Spring {
        #[kinetic]
        fn kinetic(&self, v: &Velocities) -> f64 {
            0.5 * self.mass * v.x.powi(2)
        }

        #[potential]
        fn elastic(&self, q: &Coordinates) -> f64 {
            0.5 * self.stiffness * q.x.powi(2)
        }
    }
}

fn main() {
    #[lagrangian(coordinates = [x])]
    impl Wrong {
        #[potential]
        fn energy(&self, q: &Coordinates) -> f64 {
            self.stiffness * q.y + q.z
        }
    }
}
