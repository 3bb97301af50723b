use lagrangian::prelude::*;

struct System {
    mass: f64,
}

#[lagrangian(coordinates = [x])]
impl System {
    fn f0(&self, x: f64) -> f64 {
        x.sin()
    }

    fn f1(&self, x: f64) -> f64 {
        self.f0(x) + self.f0(x + 1.5)
    }

    fn f2(&self, x: f64) -> f64 {
        self.f1(x) + self.f1(x + 2.5)
    }

    fn f3(&self, x: f64) -> f64 {
        self.f2(x) + self.f2(x + 3.5)
    }

    fn f4(&self, x: f64) -> f64 {
        self.f3(x) + self.f3(x + 4.5)
    }

    fn f5(&self, x: f64) -> f64 {
        self.f4(x) + self.f4(x + 5.5)
    }

    fn f6(&self, x: f64) -> f64 {
        self.f5(x) + self.f5(x + 6.5)
    }

    fn f7(&self, x: f64) -> f64 {
        self.f6(x) + self.f6(x + 7.5)
    }

    fn f8(&self, x: f64) -> f64 {
        self.f7(x) + self.f7(x + 8.5)
    }

    fn f9(&self, x: f64) -> f64 {
        self.f8(x) + self.f8(x + 9.5)
    }

    fn f10(&self, x: f64) -> f64 {
        self.f9(x) + self.f9(x + 10.5)
    }

    fn f11(&self, x: f64) -> f64 {
        self.f10(x) + self.f10(x + 11.5)
    }

    fn f12(&self, x: f64) -> f64 {
        self.f11(x) + self.f11(x + 12.5)
    }

    fn f13(&self, x: f64) -> f64 {
        self.f12(x) + self.f12(x + 13.5)
    }

    fn f14(&self, x: f64) -> f64 {
        self.f13(x) + self.f13(x + 14.5)
    }

    fn f15(&self, x: f64) -> f64 {
        self.f14(x) + self.f14(x + 15.5)
    }

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x * v.x
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        self.f15(q.x)
    }
}

fn main() {}
