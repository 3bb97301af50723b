//! Closures in variables: the names that they see, and the variables that they change.

use lagrangian::prelude::*;

use crate::support::close::close;

struct Closures {
    length: f64,
}

#[lagrangian(coordinates = [a, b])]
impl Closures {
    #[point(mass = 2.0)]
    fn end(&self, q: &Coordinates) -> Vector2<f64> {
        let rod = |angle: f64| self.length * Vector2::new(angle.sin(), -angle.cos());
        rod(q.a) + rod(q.b)
    }

    /// Names that shadow others, closures that call closures, and one that counts.
    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let k = 3.0;
        let spring = |x: f64| 0.5 * k * x * x;
        let k = 100.0;
        let twice = |x: f64| {
            let k = 2.0;
            k * spring(x)
        };
        let mut sum = 0.0;
        let mut add = |x: f64| sum += twice(x);
        add(q.a);
        {
            let k = 7.0;
            add(q.b + 0.0 * k);
        }
        let each = [q.a, q.b].map(spring);
        let along = |[x, y]: [f64; 2]| x * y;
        sum + each.iter().sum::<f64>() + along([q.a, k * q.b]) + self.length * self.twisted(q)
    }

    fn twisted(&self, q: &Coordinates) -> f64 {
        let spring = |x: f64| (x - 0.3).sin();
        (0..3).map(|i| spring(q.a + i as f64)).sum()
    }
}

#[test]
fn closures_see_what_rust_lets_them_see() {
    let system = Closures { length: 0.8 };
    let state = State::new([0.4, -0.7], [0.2, 0.9]);
    let [a, b] = state.q;
    let spring = |x: f64| 1.5 * x * x;
    let twisted: f64 = (0..3).map(|i| (a + f64::from(i) - 0.3).sin()).sum();
    let by_hand = 3.0 * (spring(a) + spring(b)) + 100.0 * a * b + 0.8 * twisted;
    close(system.potential_energy(&state), by_hand, 1e-14);
    close(system.springs(&state.q.into()), by_hand, 1e-14);
    let (u, w) = (0.8 * state.v[0], 0.8 * state.v[1]);
    close(system.kinetic_energy(&state), u * u + w * w + 2.0 * u * w * (a - b).cos(), 1e-14);
}
