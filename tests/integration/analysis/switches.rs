//! Derivatives of motions through impacts, dry friction and kinks: closed forms over dual numbers, differences, and
//! where there are none.

use lagrangian::prelude::*;
use lagrangian::{Contact, Dual};

use crate::support::close::{all_close_on_largest, close, close_on};
use crate::support::difference::{derivative, moved};

const TIGHT: f64 = 1e-13;

/// A ball over a floor, and under a ceiling that is far away unless a test says otherwise.
struct Ball {
    gravity: f64,
    restitution: f64,
    ceiling: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.restitution, self.gravity])]
impl Ball {
    #[point(mass = 0.3)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        0.3 * self.gravity * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[unilateral(restitution = 0.5)]
    fn ceiling(&self, q: &Coordinates) -> f64 {
        self.ceiling - q.y
    }
}

const BALL: Ball = Ball { gravity: 9.81, restitution: 0.8, ceiling: 100.0 };

/// Height and speed of a ball at a time.
fn bounced<R: Ordered>(y: R, v: R, e: R, g: R, t: R) -> [R; 2] {
    let [half, two] = [0.5, 2.0].map(R::from_f64);
    let mut speed = (v * v + two * g * y).sqrt();
    let mut hit = (v + speed) / g;
    if t < hit {
        return [y + t * (v - half * g * t), v - g * t];
    }
    loop {
        speed = e * speed;
        let flight = two * speed / g;
        if t < hit + flight {
            let s = t - hit;
            return [s * (speed - half * g * s), speed - g * s];
        }
        hit += flight;
    }
}

#[test]
fn a_bouncing_ball_has_the_derivatives_of_its_closed_form() {
    let varied = BALL.variational();
    let mut motion = varied.motion(State::new([0.0, 1.0], [0.7, 0.3])).unwrap().with_tolerance(TIGHT);
    let number = |value, direction| Dual::<f64, 4>::variable(value, direction);
    for tenth in 1..=30 {
        let t = 0.1 * f64::from(tenth);
        let found = motion.advance_to(t).unwrap();
        let [y, v] =
            bounced(number(1.0, 0), number(0.3, 1), number(0.8, 2), number(9.81, 3), Dual::constant(t));
        close_on(1.0, found.state.q[1], y.value, 1e-13);
        for (rows, exact) in
            [((found.q_by_q, found.q_by_v, found.q_by_p), y), ((found.v_by_q, found.v_by_v, found.v_by_p), v)]
        {
            let (by_q, by_v, by_p) = rows;
            let row = [by_q[(1, 1)], by_v[(1, 1)], by_p[(1, 0)], by_p[(1, 1)]];
            all_close_on_largest(row, exact.slopes, 1e-12);
            // What goes along the floor goes on.
            close_on(1.0, by_q[(1, 0)], 0.0, 1e-15);
        }
        close(found.q_by_v[(0, 0)], t, 1e-14);
    }
}

#[test]
fn impacts_without_end_have_no_derivatives() {
    let varied = BALL.variational();
    let mut motion = varied.motion(State::new([0.0, 1.0], [0.7, 0.0])).unwrap();
    let error = motion.advance_to(10.0).unwrap_err();
    assert!(
        matches!(error.cause, Cause::ImpactsAccumulate { name, .. } if name.as_str() == "floor"),
        "{error}"
    );
    // 4.0637127687715781 s is when the impacts accumulate; flights below the rounding of heights are not followed.
    close_on(1.0, error.t, 4.063_712_768_771_578, 1e-6);
    assert_eq!(motion.transition().state.t, 0.0);
    // On the floor it has derivatives again, along the floor.
    let rest = varied.motion(State::new([1.0, 0.0], [0.7, 0.0])).unwrap().advance_to(1.0).unwrap();
    close(rest.q_by_v[(0, 0)], 1.0, 1e-14);
    assert_eq!(
        [rest.q_by_q[(1, 1)], rest.q_by_v[(1, 1)], rest.v_by_v[(1, 1)], rest.v_by_p[(1, 1)]],
        [0.0; 4]
    );
}

#[test]
fn a_ball_that_grazes_has_no_derivatives() {
    let speed = 6.0_f64;
    let top = speed * speed / (2.0 * 9.81);
    for (ceiling, grazes) in [(top * (1.0 - 1e-14), true), (top * (1.0 - 1e-4), false)] {
        let ball = Ball { ceiling, ..BALL };
        let mut motion = ball.simulate(State::new([0.0, 0.0], [0.0, speed])).with_tolerance(1e-12);
        let hits = motion.advance_to_switch(1.0).unwrap().is_some();
        let varied = ball.variational();
        let mut motion = varied.motion(State::new([0.0, 0.0], [0.0, speed])).unwrap().with_tolerance(1e-12);
        let found = motion.advance_to(1.0);
        match found {
            Err(error) => {
                assert!(grazes, "{error}");
                assert!(
                    matches!(error.cause, Cause::Grazes { name, .. } if name.as_str() == "ceiling"),
                    "{error}"
                );
                assert!(error.to_string().contains("grazes `ceiling`"), "{error}");
            }
            Ok(_) => assert!(!grazes || !hits),
        }
    }
}

#[test]
fn a_start_in_an_impact_has_no_derivatives() {
    let varied = BALL.variational();
    let error = varied.motion(State::new([0.0, 0.0], [0.0, -1.0])).err().unwrap();
    assert!(error.to_string().contains("begins in an impact at `floor`"), "{error}");
    // One that begins right after an impact has.
    let mut motion = varied.motion(State::new([0.0, 0.0], [0.0, 1.0])).unwrap();
    close(motion.advance_to(0.1).unwrap().q_by_v[(1, 1)], 0.1, 1e-13);
}

/// Two balls over the same floor.
struct Balls;

#[lagrangian(coordinates = [left, right], jacobians)]
impl Balls {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.left * v.left + v.right * v.right)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (q.left + q.right)
    }

    #[unilateral(restitution = 0.9)]
    fn floors(&self, q: &Coordinates) -> [f64; 2] {
        [q.left, q.right]
    }
}

#[test]
fn switches_that_coincide_are_named() {
    let varied = Balls.variational();
    let mut motion = varied.motion(State::at_rest([1.0, 1.0])).unwrap();
    let error = motion.advance_to(1.0).unwrap_err();
    assert!(error.to_string().contains("`floors[0]` and `floors[1]` switch at once"), "{error}");
    let mut motion = varied.motion(State::at_rest([1.0, 1.0 + 1e-6])).unwrap();
    assert!(motion.advance_to(1.0).is_ok());
}

/// N03: a block on a belt, held by a spring.
struct Belt {
    stiffness: f64,
    speed: f64,
    normal: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.stiffness, self.speed, self.normal])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x * q.x
    }

    #[friction(limit = 0.3 * self.normal, static_limit = 0.5 * self.normal)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - self.speed
    }
}

/// Place and speed of a block that begins sticking.
fn carried<R: Ordered>(start: R, k: R, belt: R, normal: R, t: R) -> [R; 2] {
    let rate = k.sqrt();
    let centre = R::from_f64(0.3) * normal / k;
    let farthest = R::from_f64(0.5) * normal / k;
    let away = farthest - centre;
    let slip = R::from_f64(2.0) * (R::pi() - (away * rate / belt).atan()) / rate;
    let (mut x, mut begun) = (start, R::zero());
    loop {
        let slips = begun + (farthest - x) / belt;
        if t < slips {
            return [x + belt * (t - begun), belt];
        }
        if t < slips + slip {
            let (sin, cos) = (rate * (t - slips)).sin_cos();
            return [centre + away * cos + belt / rate * sin, belt * cos - away * rate * sin];
        }
        (x, begun) = (centre - away, slips + slip);
    }
}

#[test]
fn stick_and_slip_on_a_belt_have_the_derivatives_of_the_closed_form() {
    let belt = Belt { stiffness: 9.0, speed: 0.2, normal: 8.0 };
    let varied = belt.variational();
    let mut motion = varied.motion(State::new([0.0], [0.2])).unwrap().with_tolerance(TIGHT);
    let number = |value, direction| Dual::<f64, 4>::variable(value, direction);
    for t in [1.0, 2.5, 3.0, 4.0, 7.0, 12.0, 31.0] {
        let found = motion.advance_to(t).unwrap();
        let exact =
            carried(number(0.0, 0), number(9.0, 1), number(0.2, 2), number(8.0, 3), Dual::constant(t));
        let rows = [(found.q_by_q[0], found.q_by_p), (found.v_by_q[0], found.v_by_p)];
        for ((by_start, by_p), exact) in rows.into_iter().zip(exact) {
            // After the n-th stick phase the phase has shifted n times by a parameter: so grows what is added up.
            all_close_on_largest([by_start, by_p[0], by_p[1], by_p[2]], exact.slopes, 1e-12 * (1.0 + t));
        }
        // Sticking, it has the speed of the belt, whatever it had at the start.
        assert_eq!(found.q_by_v[0], 0.0);
    }
}

/// A ball on a table that moves up and down.
struct Table {
    amplitude: f64,
    restitution: f64,
}

const RATE: f64 = 12.0;

#[lagrangian(coordinates = [y], sensitivities = [self.amplitude])]
impl Table {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(0.0, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn table(&self, q: &Coordinates, t: f64) -> f64 {
        q.y - self.amplitude * (RATE * t).sin()
    }
}

#[test]
fn the_multipliers_of_a_ball_on_a_vibrating_table_are_those_of_its_impact() {
    // Period one: thrown upwards with g T / 2 it comes back after T with the same speed downwards. The impact is
    // v⁺ = −e v⁻ + (1 + e) ẇ, so the table has the speed ẇ = g T (1 − e) / (2 (1 + e)).
    let (e, g) = (0.6, 9.81);
    let period = std::f64::consts::TAU / RATE;
    let rise = g * period * (1.0 - e) / (2.0 * (1.0 + e));
    for amplitude in [0.06, 0.08, 0.1] {
        let phase = (rise / (amplitude * RATE)).acos();
        let impact = phase / RATE;
        let height = amplitude * phase.sin();
        let (half, speed) = (0.5 * period, 0.5 * g * period);
        // At the highest point.
        let top = height + speed * half - 0.5 * g * half * half;
        let table = Table { amplitude, restitution: e };
        let start = State { t: impact + half, q: [top], v: [0.0] };
        let found = table.variational().monodromy(start, period).unwrap();
        close_on(top, found.transition.state.q[0], top, 1e-12);
        // M = Φ(T/2) S Φ(T/2), Φ = [1 t; 0 1], S = [−e 0; s −e], s = −(1 + e)(g + ẅ) / (v⁻ − ẇ).
        let bends = -amplitude * RATE * RATE * phase.sin();
        let s = (1.0 + e) * (g + bends) / (speed + rise);
        let (trace, determinant) = (period * s - 2.0 * e, e * e);
        let (sum, product) = match found.multipliers[..] {
            [a, b] => ((a + b).re, (a * b).re),
            _ => panic!("two multipliers"),
        };
        close_on(1.0, sum, trace, 1e-11);
        close(product, determinant, 1e-11);
    }
}

#[test]
fn a_body_leaves_a_table_with_the_derivatives_of_its_flight() {
    let (amplitude, g) = (0.1, 9.81);
    let table = Table { amplitude, restitution: 0.0 };
    let varied = table.variational();
    let mut motion = varied.motion(State::new([0.0], [amplitude * RATE])).unwrap().with_tolerance(TIGHT);
    let t = 0.2;
    let found = motion.advance_to(t).unwrap();
    let amplitude = Dual::<f64, 1>::variable(amplitude, 0);
    let rate = Dual::constant(RATE);
    // It leaves where the table falls as fast as it does.
    let leaves = (Dual::constant(g) / (amplitude * rate * rate)).asin() / rate;
    let (sin, cos) = (rate * leaves).sin_cos();
    let s = Dual::constant(t) - leaves;
    let y = amplitude * sin + amplitude * rate * cos * s - Dual::constant(0.5 * g) * s * s;
    close(found.state.q[0], y.value, 1e-13);
    close(found.q_by_p[0], y.slopes[0], 1e-12);
    // On the table it moves as the table does, whatever the start.
    assert_eq!([found.q_by_q[0], found.q_by_v[0]], [0.0; 2]);
}

/// N14: springs that differ on both sides, and a force that jumps.
struct Kinks {
    right: f64,
    left: f64,
    jump: f64,
}

#[lagrangian(coordinates = [spring, force], sensitivities = [self.right, self.left, self.jump])]
impl Kinks {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.spring * v.spring + v.force * v.force)
    }

    #[potential]
    fn stored(&self, q: &Coordinates) -> f64 {
        let stiffness = if q.spring > 0.0 { self.right } else { self.left };
        0.5 * stiffness * q.spring * q.spring + self.jump * q.force.abs()
    }
}

/// A bilinear oscillator from rest at x > 0.
fn swung<R: Ordered>(x: R, right: R, left: R, t: R) -> [R; 2] {
    let half = R::from_f64(0.5);
    let (mut place, mut from, mut sign, mut stiffness) = (x, R::zero(), R::one(), [right, left]);
    loop {
        let rate = stiffness[0].sqrt();
        let quarter = half * R::pi() / rate;
        if t < from + quarter || t == from + quarter {
            let (sin, cos) = (rate * (t - from)).sin_cos();
            return [sign * place * cos, -(sign * place * rate * sin)];
        }
        // Through zero to the other side, and to the next turning point.
        let speed = place * rate;
        stiffness.reverse();
        let rate = stiffness[0].sqrt();
        let crossed = from + quarter;
        from = crossed + half * R::pi() / rate;
        place = speed / rate;
        sign = -sign;
        if t < from {
            let (sin, cos) = (rate * (t - crossed)).sin_cos();
            return [sign * place * sin, sign * speed * cos];
        }
    }
}

/// ẍ = −c sign x from rest at x > 0.
fn pushed<R: Ordered>(x: R, c: R, t: R) -> [R; 2] {
    let [half, two] = [0.5, 2.0].map(R::from_f64);
    let quarter = (two * x / c).sqrt();
    let (mut from, mut sign) = (R::zero(), R::one());
    while from + quarter < t {
        (from, sign) = (from + two * quarter, -sign);
    }
    let s = t - from;
    [sign * (x - half * c * s * s), -(sign * c * s)]
}

#[test]
fn kinks_have_the_derivatives_of_closed_forms() {
    let kinks = Kinks { right: 4.0, left: 9.0, jump: 1.3 };
    let varied = kinks.variational();
    let mut motion = varied.motion(State::at_rest([1.0, 0.8])).unwrap().with_tolerance(TIGHT);
    for t in [0.3, 1.0, 2.0, 5.0, 9.0, 20.0] {
        let found = motion.advance_to(t).unwrap();
        let number = |value, direction| Dual::<f64, 3>::variable(value, direction);
        let time = Dual::constant(t);
        let exact = swung(number(1.0, 0), number(4.0, 1), number(9.0, 2), time);
        let rows = [(found.q_by_q, found.q_by_p), (found.v_by_q, found.v_by_p)];
        for ((by_q, by_p), exact) in rows.iter().zip(exact) {
            all_close_on_largest([by_q[(0, 0)], by_p[(0, 0)], by_p[(0, 1)]], exact.slopes, 1e-11);
        }
        let number = |value, direction| Dual::<f64, 2>::variable(value, direction);
        let exact = pushed(number(0.8, 0), number(1.3, 1), Dual::constant(t));
        for ((by_q, by_p), exact) in rows.iter().zip(exact) {
            all_close_on_largest([by_q[(1, 1)], by_p[(1, 2)]], exact.slopes, 1e-11);
        }
    }
}

#[test]
fn kinks_have_the_derivatives_of_differences_by_velocities() {
    let kinks = Kinks { right: 4.0, left: 9.0, jump: 1.3 };
    let start = State::new([1.0, 0.8], [0.4, -0.3]);
    let found = kinks.variational().motion(start).unwrap().with_tolerance(TIGHT).advance_to(7.0).unwrap();
    for column in 0..4 {
        let by = derivative(1e-3, |by| {
            let end =
                *kinks.simulate(moved(&start, column, by)).with_tolerance(TIGHT).advance_to(7.0).unwrap();
            [end.q[0], end.q[1], end.v[0], end.v[1]]
        });
        let column: [f64; 4] = std::array::from_fn(|row| found.entry(row, column));
        all_close_on_largest(column, by, 1e-9);
    }
}

/// A homogeneous ball on a rough floor: N04.
struct Bowl {
    mu: f64,
}

#[lagrangian(coordinates = [x, y, a, b], sensitivities = [self.mu])]
impl Bowl {
    /// Mass 1.5 kg; a and b are the turns about the axes of x and y, by the law of small turns, which a homogeneous ball
    /// obeys for all.
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.75 * (v.x * v.x + v.y * v.y) + 0.2 * 1.5 * 0.08 * 0.08 * (v.a * v.a + v.b * v.b)
    }

    #[friction(limit = self.mu * 1.5 * 9.81)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x - 0.08 * v.b, v.y + 0.08 * v.a)
    }
}

#[test]
fn a_ball_that_slips_and_then_rolls_forgets_its_friction() {
    let bowl = Bowl { mu: 0.3 };
    let start = State::new([0.0; 4], [2.0, -1.0, -10.0, 10.0]);
    let varied = bowl.variational();
    let mut motion = varied.motion(start).unwrap().with_tolerance(1e-12);
    // It rolls from t = 2 |u| / (7 μ g) on, with (5 v + 2 R ω × e) / 7.
    let found = motion.advance_to(1.0).unwrap();
    let roll = [5.0 / 7.0, 0.16 / 7.0];
    let by = [[roll[0], 0.0], [0.0, roll[0]], [0.0, -roll[1]], [roll[1], 0.0]];
    for (column, exact) in by.iter().enumerate() {
        let found = [found.v_by_v[(0, column)], found.v_by_v[(1, column)]];
        all_close_on_largest(found, exact, 1e-10);
    }
    close_on(1.0, found.v_by_p[(0, 0)], 0.0, 1e-10);
    // While it slips it loses (2/7) u |u| / (7 μ g) of its way against rolling from the start on: x = v_r t + u t_r/7.
    let u: [f64; 2] = [2.0 - 0.8, -1.0 - 0.8];
    let rolls = 2.0 * u[0].hypot(u[1]) / (7.0 * 0.3 * 9.81);
    for (axis, u) in u.iter().enumerate() {
        close_on(1.0, found.q_by_p[(axis, 0)], -u * rolls / 7.0 / 0.3, 1e-10);
    }
}

/// A bead on a rough hoop: N11.
struct Bead {
    mu: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.mu])]
impl Bead {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn hoop(&self, q: &Coordinates) -> f64 {
        q.x * q.x + q.y * q.y - 0.25
    }

    #[friction(coefficient = self.mu, normal = hoop)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        2.0 * (v.y * q.x - v.x * q.y)
    }
}

#[test]
fn a_bead_stops_where_its_friction_lets_it() {
    let at = |angle: f64| State::at_rest([0.5 * angle.sin(), -0.5 * angle.cos()]);
    let (angle, mu) = (1.2, 0.2);
    let stops = |angle: f64, mu: f64| {
        let bead = Bead { mu };
        let mut motion = bead.simulate(at(angle)).with_tolerance(TIGHT);
        let end = *motion.advance_to(4.0).unwrap();
        assert_eq!(motion.contacts().slip, Contact::Sticks);
        end.q
    };
    let bead = Bead { mu };
    let found = bead.variational().motion(at(angle)).unwrap().with_tolerance(TIGHT).advance_to(4.0).unwrap();
    let by_angle = derivative(1e-3, |by| stops(angle + by, mu));
    let by_mu = derivative(1e-3, |by| stops(angle, mu + by));
    let turned = [0.5 * angle.cos(), 0.5 * angle.sin()];
    for row in 0..2 {
        let along = found.q_by_q[(row, 0)] * turned[0] + found.q_by_q[(row, 1)] * turned[1];
        close_on(1.0, along, by_angle[row], 1e-8);
        close_on(1.0, found.q_by_p[(row, 0)], by_mu[row], 1e-8);
        close_on(1.0, found.v_by_p[(row, 0)], 0.0, 1e-12);
    }
}

/// A block that rocks on its corners: N06.
struct Block {
    half_width: f64,
}

#[lagrangian(coordinates = [x, y, theta], sensitivities = [self.half_width])]
impl Block {
    #[body(mass = 1.0, inertia = (self.half_width.powi(2) + 0.25) / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.theta)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn corners(&self, q: &Coordinates) -> [f64; 2] {
        [-1.0, 1.0].map(|side| q.y + side * self.half_width * q.theta.sin() - 0.5 * q.theta.cos())
    }

    #[friction(coefficient = 10.0, normal = corners)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        [-1.0, 1.0].map(|side| v.x - (q.theta.sin() * side * self.half_width - q.theta.cos() * 0.5) * v.theta)
    }
}

/// A block tilted about its right corner.
fn tilted(angle: f64, half_width: f64) -> State<f64, 3> {
    let (sin, cos) = angle.sin_cos();
    State::at_rest([-(cos * half_width - sin * 0.5), sin * half_width + cos * 0.5, -angle])
}

#[test]
fn a_rocking_block_has_the_derivatives_of_differences() {
    let (angle, half_width) = (0.23, 0.2);
    // Before, between and after the impacts.
    for t in [0.3, 0.6, 1.1, 1.4] {
        let run = |angle: f64, half_width: f64| {
            let block = Block { half_width };
            let mut motion = block.simulate(tilted(angle, half_width)).with_tolerance(TIGHT);
            let end = *motion.advance_to(t).unwrap();
            [end.q, end.v].concat().try_into().unwrap()
        };
        let block = Block { half_width };
        let varied = block.variational();
        let mut motion = varied.motion(tilted(angle, half_width)).unwrap().with_tolerance(TIGHT);
        let found = motion.advance_to(t).unwrap();
        // How the start moves with the angle and with the width, along which it stays in contact.
        let start = |f: &dyn Fn(f64) -> State<f64, 3>| derivative(1e-3, |by| f(by).q);
        let by_angle = start(&|by| tilted(angle + by, half_width));
        let by_width = start(&|by| tilted(angle, half_width + by));
        let along =
            |start: &[f64; 3], row: usize| (0..3).map(|i| found.entry(row, i) * start[i]).sum::<f64>();
        let differences: [f64; 6] = derivative(1e-3, |by| run(angle + by, half_width));
        let columns: [f64; 6] = std::array::from_fn(|row| along(&by_angle, row));
        all_close_on_largest(columns, differences, 1e-8);
        let differences: [f64; 6] = derivative(5e-4, |by| run(angle, half_width + by));
        let by_p = |row: usize| if row < 3 { found.q_by_p[(row, 0)] } else { found.v_by_p[(row - 3, 0)] };
        let columns: [f64; 6] = std::array::from_fn(|row| along(&by_width, row) + by_p(row));
        all_close_on_largest(columns, differences, 1e-8);
    }
}
