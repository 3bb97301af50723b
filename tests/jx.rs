//! scratch
use lagrangian::Dop853;
use lagrangian::prelude::*;

struct H {
    k: f64,
    m: f64,
}
#[lagrangian(coordinates = [h, rate, order, inner, orders, series, tables, fraction], inputs=[left])]
impl H {
    #[kinetic]
    fn k(&self, v: &Velocities) -> f64 {
        0.5 * self.m
            * (v.h * v.h
                + v.rate * v.rate
                + v.order * v.order
                + v.inner * v.inner
                + v.orders * v.orders
                + v.series * v.series
                + v.tables * v.tables
                + v.fraction * v.fraction)
    }
    #[potential]
    fn p(&self, q: &Coordinates) -> f64 {
        self.k
            * (q.h * q.rate).cos()
            * (1.0 + q.order * q.inner).sqrt()
            * (q.orders + q.series + q.tables + q.fraction).exp()
    }
    #[force(on = h)]
    fn f(&self, u: &Inputs) -> f64 {
        u.left
    }
}
#[test]
fn names() {
    let s = H { k: 1.3, m: 1.1 };
    let st = State::new([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8], [0.3; 8]);
    let a = *s.simulate(st).with_inputs([0.4]).advance_to(0.3).unwrap();
    let b = *s.simulate_with::<Dop853>(st).with_inputs([0.4]).with_tolerance(1e-14).advance_to(0.3).unwrap();
    println!("{:?}\n{:?}", a, b);
}
struct Duffing;
#[lagrangian(coordinates = [x])]
impl Duffing {
    #[kinetic]
    fn k(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }
    #[potential]
    fn p(&self, q: &Coordinates) -> f64 {
        0.25 * q.x.powi(4)
    }
}
struct Quick;
#[lagrangian(coordinates = [x])]
impl Quick {
    #[kinetic]
    fn k(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }
    #[potential]
    fn p(&self, q: &Coordinates, t: f64) -> f64 {
        0.5 * q.x.powi(2) * t * t
    }
}
struct Late;
#[lagrangian(coordinates = [x])]
impl Late {
    #[kinetic]
    fn k(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }
    #[force(on = x)]
    fn p(&self, t: f64) -> f64 {
        t.powi(30)
    }
}
struct Free;
#[lagrangian(coordinates = [x])]
impl Free {
    #[kinetic]
    fn k(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }
}
#[test]
fn sparse() {
    for tol in [1e-6, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16] {
        for x0 in [0.0, 1e-12, 1e-6] {
            let st = State::new([x0], [1.0]);
            let mut m = Duffing.simulate(st).with_tolerance(tol);
            let r = m.advance_to(10.0).map(|s| s.q[0]);
            let b = Duffing.simulate_with::<Dop853>(st).with_tolerance(1e-15).advance_to(10.0).unwrap().q[0];
            let st = State::new([1.0], [x0]);
            let mut n = Quick.simulate(st).with_tolerance(tol);
            let rr = n.advance_to(5.0).map(|s| s.q[0]);
            let bb = Quick.simulate_with::<Dop853>(st).with_tolerance(1e-15).advance_to(5.0).unwrap().q[0];
            println!("{tol:e} {x0:e} duffing {:?} {:e} steps {:?}", r, r.unwrap_or(f64::NAN) - b, m.steps());
            println!("{tol:e} {x0:e} quick {:?} {:e} steps {:?}", rr, rr.unwrap_or(f64::NAN) - bb, n.steps());
        }
    }
    let mut m = Late.simulate(State::new([0.0], [0.0]));
    println!("late {:?} {}", m.advance_to(1.0).map(|s| *s), 1.0 / 31.0 / 32.0);
    let mut m = Late.simulate(State::new([1.0], [0.0]));
    println!("late {:?} {}", m.advance_to(1.0).map(|s| *s), 1.0 + 1.0 / 31.0 / 32.0);
}
struct Pend;
#[lagrangian(coordinates = [x])]
impl Pend {
    #[kinetic]
    fn k(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }
    #[potential]
    fn p(&self, q: &Coordinates) -> f64 {
        -9.81 * q.x.cos()
    }
}
#[test]
fn tiny() {
    let st = State::new([1.0], [0.3]);
    let b = *Pend.simulate_with::<Dop853>(st).with_tolerance(1e-15).advance_to(3.0).unwrap();
    for t in [1e-3, 1e-9, 1e-12, 1e-18, 1e-22, 1e-30, 1e-40, 1e-50] {
        let mut m = Pend.simulate(st);
        m.advance_to(t).unwrap();
        let e = m.advance_to(3.0).map(|s| (s.q[0] - b.q[0], s.v[0] - b.v[0]));
        println!("{t:e} {e:?} {:?}", m.steps());
    }
    for v in [1e200, 1e10, 1e300] {
        let mut m = Free.simulate(State::new([1.0], [v]));
        println!("free {v:e} {:?} {:?}", m.advance_to(1e200).map(|s| *s), m.state());
        println!("free {v:e} {:?} {:?}", m.advance_to(3.0).map(|s| *s), m.state());
    }
    let mut m = Pend.simulate(st).with_max_steps(100);
    println!("pend far {:?} {:?}", m.advance_to(1e200).map(|s| *s), m.steps());
    let mut m = Pend.simulate(st).with_step_limit(1e-6).with_max_steps(1000);
    println!("pend lim {:?} {:?}", m.advance_to(1e-4).map(|s| *s), m.steps());
    let mut m = Pend.simulate(State::at_rest([0.0]));
    println!("rest {:?} {:?}", m.advance_to(1e9).map(|s| *s), m.steps());
}
struct Kep;
#[lagrangian(coordinates = [x, y])]
impl Kep {
    #[kinetic]
    fn k(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }
    #[potential]
    fn p(&self, q: &Coordinates) -> f64 {
        -1.0 / (q.x * q.x + q.y * q.y).sqrt()
    }
}
struct Dbl;
#[lagrangian(coordinates = [a, b])]
impl Dbl {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a.sin(), -q.a.cos())
    }
    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + Vector2::new(q.b.sin(), -q.b.cos())
    }
    #[potential]
    fn p(&self, q: &Coordinates) -> f64 {
        9.81 * (self.upper(q).y + self.lower(q).y)
    }
}
#[test]
fn counts() {
    for tol in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16] {
        let mut m = Kep.simulate(State::new([0.4, 0.0], [0.0, 2.0])).with_tolerance(tol);
        m.advance_to(100.0).unwrap();
        let mut n = Dbl.simulate(State::at_rest([1.0, 1.5])).with_tolerance(tol);
        n.advance_to(20.0).unwrap();
        let mut o = Pend.simulate(State::at_rest([0.1])).with_tolerance(tol);
        o.advance_to(100.0).unwrap();
        let mut o2 = Pend.simulate(State::at_rest([3.0])).with_tolerance(tol);
        o2.advance_to(100.0).unwrap();
        println!(
            "{tol:e} kepler {} double {} pendulum {} {}",
            m.steps().evaluations,
            n.steps().evaluations,
            o.steps().evaluations,
            o2.steps().evaluations
        );
    }
}
