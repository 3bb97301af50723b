//! Kinks that are crossed at the same time, and bodies that rest at one.

use lagrangian::prelude::*;

/// A mass on a bilinear spring, and another coordinate at rest, whose drag has a kink there.
struct Beside {
    gap: f64,
}

#[lagrangian(coordinates = [x, z])]
impl Beside {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        v.x * v.x + v.z * v.z
    }

    #[force(on = z)]
    fn drag(&self, v: &Velocities) -> f64 {
        -v.z.abs() * v.z
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let stiffness = if q.x > self.gap { 20.0 } else { 3.0 };
        stiffness * (q.x - self.gap).powi(2)
    }
}

#[test]
fn what_rests_at_a_kink_stays_there() {
    for i in 0..60 {
        let beside = Beside { gap: 0.2 + 0.013 * f64::from(i) };
        let start = State::new([0.0, 0.0], [2.0, 0.0]);
        let energy = beside.energy(&start);
        let mut motion = beside.simulate(start).with_tolerance(1e-12);
        let end = *motion.advance_to(5.0).unwrap_or_else(|error| panic!("{i}: {error}"));
        assert_eq!((end.q[1], end.v[1]), (0.0, 0.0), "{i}");
        assert!((beside.energy(&end) / energy - 1.0).abs() < 1e-11, "{i}");
        // All switches are those of the spring.
        let mut motion = beside.simulate(start);
        for _ in 0..3 {
            let at = motion.advance_to_switch(5.0).unwrap().unwrap().state.q[0];
            assert!((at - beside.gap).abs() < 1e-9, "{i}: {at}");
        }
    }
}

/// Two masses on a rope that is just taut, over a soft floor.
struct Taut;

#[lagrangian(coordinates = [x: [2], y: [2]])]
impl Taut {
    #[point(mass = 1.0)]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x[0], q.y[0])
    }

    #[point(mass = 2.0)]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x[1], q.y[1])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (q.y[0] + 2.0 * q.y[1])
    }

    #[potential]
    fn rope(&self, q: &Coordinates) -> f64 {
        let square = (self.first(q) - self.second(q)).norm_squared();
        if square > 1.0 { 200.0 * (square.sqrt() - 1.0).powi(2) } else { 0.0 }
    }

    #[potential]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y.iter().map(|&y| if y < 0.0 { 500.0 * y * y } else { 0.0 }).sum()
    }
}

#[test]
fn masses_that_land_together_on_a_rope_that_is_just_taut() {
    for i in 0..20 {
        let height = 0.5 + 0.02 * f64::from(i);
        let start = State::at_rest([0.0, 1.0, height, height]);
        let energy = Taut.energy(&start);
        let mut motion = Taut.simulate(start).with_tolerance(1e-12).with_max_steps(2000);
        // They fall as one, the light one turns back first, and the rope pulls both together.
        let lands = (2.0 * height / 9.81_f64).sqrt();
        let landed = *motion.advance_to(lands).unwrap();
        assert!(landed.q[2].abs() < 1e-13 && landed.q[2] == landed.q[3], "{i}: {landed:?}");
        let end = *motion.advance_to(1.0).unwrap_or_else(|error| panic!("{i}: {error}"));
        assert!((Taut.energy(&end) / energy - 1.0).abs() < 1e-10, "{i}");
        assert!(((end.v[0] + 2.0 * end.v[1]) / end.v[0]).abs() < 1e-9, "{i}: {end:?}");
    }
}

/// A mass that falls through air.
struct Fall {
    drag: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Fall {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        10.0 * q.y
    }

    #[force(at = mass)]
    fn air(&self, v: &Velocities) -> Vector2<f64> {
        let velocity = Vector2::new(v.x, v.y);
        let square = velocity.norm_squared();
        if square > 0.0 { velocity / square.sqrt() * (-self.drag * square) } else { Vector2::zeros() }
    }
}

#[test]
fn a_direction_that_does_not_exist_at_rest() {
    let fall = Fall { drag: 0.4 };
    let at = |v| fall.accelerations(&State::new([0.0, 0.0], v)).unwrap();
    assert_eq!((at([0.0, 0.0]), at([-0.0, 2.0])), ([0.0, -10.0], [0.0, -11.6]));
    let mut motion = fall.simulate(State::at_rest([0.0, 0.0])).with_tolerance(1e-12);
    for t in [0.1, 1.0, 3.0] {
        let [_, v] = motion.advance_to(t).unwrap().v;
        let exact = -5.0 * (2.0 * t).tanh();
        assert!((v - exact).abs() < 1e-10, "{t}: {v}");
    }
}

/// A force that jumps at the start.
struct Jump;

#[lagrangian(coordinates = [x])]
impl Jump {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force]
    fn push(&self, t: f64) -> f64 {
        if t > 0.0 && t < 1.0 { 1.0 } else { 2.0 }
    }
}

#[test]
fn a_motion_that_starts_at_a_jump() {
    let mut motion = Jump.simulate(State::at_rest([0.0]));
    assert_eq!(motion.advance_to(0.5).unwrap().v, [0.5]);
    assert!((motion.advance_to(2.0).unwrap().v[0] - 3.0).abs() < 1e-14);
    assert!((Jump.simulate(State::at_rest([0.0])).advance_to(-0.5).unwrap().v[0] + 1.0).abs() < 1e-14);
}
