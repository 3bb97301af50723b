use lagrangian::prelude::*;

struct Pair;

#[lagrangian(coordinates = [x])]
impl Pair {
    #[point(mass = 1.0)]
    fn body(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let mut pair = (q.x, 2.0);
        let (ref mut first, second) = pair;
        *first += second;
        pair.0 * pair.0
    }
}

fn main() {}
