//! Laws of friction with a kink or a jump: by the direction of the slip, by its speed, by the place.

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close;

/// A disc that is driven to and fro, with a pawl that lets it turn one way.
struct Clutch {
    ratio: f64,
}

#[lagrangian(coordinates = [phi])]
impl Clutch {
    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        0.5 * v.phi * v.phi
    }

    #[force(on = phi)]
    fn drive(&self, t: f64) -> f64 {
        2.0 * (3.0 * t).cos()
    }

    fn pawl(&self, v: &Velocities) -> f64 {
        if v.phi < 0.0 { 50.0 } else { 0.1 / self.ratio.abs() }
    }

    #[friction(limit = pawl)]
    fn slip(&self, v: &Velocities) -> f64 {
        self.ratio * v.phi
    }
}

#[test]
fn a_pawl_holds_one_way() {
    // The disc turns by 2/3 (sin 3t − sin 3t₀) − (t − t₀) / 10 while that is positive. It stands while the
    // drive is less than a tenth.
    let stops = {
        let mut t: f64 = 1.0;
        (0..9).for_each(|_| t -= ((3.0 * t).sin() / 1.5 - 0.1 * t) / (2.0 * (3.0 * t).cos() - 0.1));
        t
    };
    let begins = (2.0 * core::f64::consts::PI - 0.05_f64.acos()) / 3.0;
    // The slip may be measured the other way round, and in other units.
    for ratio in [1.0, 0.5, -2.0] {
        let clutch = Clutch { ratio };
        let mut motion = clutch.simulate(State::at_rest([0.0])).with_tolerance(TIGHT);
        let stop = motion.advance_to_switch(9.0).unwrap().expect("it stops");
        close(stop.state.t, stops, 1e-14);
        assert_eq!(motion.contacts().slip, Contact::Sticks);
        let angle = stop.state.q[0];
        close(angle, 2.0 / 9.0 * (1.0 - (3.0 * stops).cos()) - 0.05 * stops * stops, 1e-13);
        let held = *motion.advance_to(1.3).unwrap();
        assert_eq!((held.q, held.v), ([angle], [0.0]));
        close(motion.reactions().slip * ratio, -2.0 * (3.9_f64).cos(), 1e-14);
        let slip = motion.advance_to_switch(9.0).unwrap().expect("it begins to turn");
        close(slip.state.t, begins, 1e-14);
        let end = *motion.advance_to(2.5).unwrap();
        close(end.v[0], ((7.5_f64).sin() - (3.0 * begins).sin()) / 1.5 - 0.1 * (2.5 - begins), 1e-13);
        assert!(motion.steps().accepted < 60, "{:?}", motion.steps());
    }
}

#[test]
fn a_pawl_holds_a_disc_that_would_turn_back() {
    let clutch = Clutch { ratio: 1.0 };
    let start = State { t: 1.0, ..State::at_rest([0.0]) };
    let mut motion = clutch.simulate(start).with_tolerance(TIGHT);
    assert_eq!(motion.advance_to(1.5).unwrap().q, [0.0]);
    // It turns on at once where the drive is strong enough forward.
    let mut motion = clutch.simulate(State { t: 1.9, ..start }).with_tolerance(TIGHT);
    let end = *motion.advance_to(2.0).unwrap();
    close(end.v[0], ((6.0_f64).sin() - (5.7_f64).sin()) / 1.5 - 0.01, 1e-13);
}

#[test]
fn fixed_steps_know_the_direction() {
    let clutch = Clutch { ratio: -0.5 };
    let mut simulated = clutch.simulate(State::at_rest([0.0])).with_tolerance(TIGHT);
    let mut stepped = clutch.stepper::<Jet<12>>(State::at_rest([0.0]));
    (0..125).for_each(|_| stepped.step(0.02, &[]).map(|_| ()).unwrap());
    let end = *simulated.advance_to(2.5).unwrap();
    close(stepped.state().q[0], end.q[0], 1e-12);
    close(stepped.state().v[0], end.v[0], 1e-12);
}

/// A puck on a floor that is ice beyond one metre.
struct Puck {
    dry: f64,
    ice: f64,
    pull: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.ice])]
impl Puck {
    #[point(mass = 2.0)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        20.0 * q.y - self.pull * q.x
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    fn roughness(&self, q: &Coordinates) -> f64 {
        if q.x < 1.0 { self.dry } else { self.ice }
    }

    #[friction(coefficient = roughness, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_floor_has_an_edge_of_ice() {
    let puck = Puck { dry: 0.5, ice: 0.0625, pull: 0.0 };
    let start = State::new([0.0, 0.0], [5.0, 0.0]);
    // 25 − 2 · 5 = 15 at the edge; from there it slides 15 / (2 · 0.625) = 12 m.
    let edge = 15.0_f64.sqrt();
    for tolerance in [1e-6, TIGHT] {
        let mut motion = puck.simulate(start).with_tolerance(tolerance);
        let there = motion.advance_to_switch(9.0).unwrap().expect("it comes to the edge");
        close(there.state.t, (5.0 - edge) / 5.0, 1e-14);
        let stop = motion.advance_to_switch(9.0).unwrap().expect("it stops");
        close(stop.state.t, (5.0 - edge) / 5.0 + edge / 0.625, 1e-14);
        close(motion.advance_to(99.0).unwrap().q[0], 13.0, 1e-14);
        assert!(motion.steps().accepted < 12, "{:?}", motion.steps());
    }
    let varied = puck.variational();
    let end = varied.motion(start).unwrap().with_tolerance(TIGHT).advance_to(2.0).unwrap();
    let slid = 2.0 - (5.0 - edge) / 5.0;
    close(end.state.q[0], 1.0 + edge * slid - 0.3125 * slid * slid, 1e-13);
    close(end.q_by_p[0], -5.0 * slid * slid, 1e-12);
    // Later there by −(5 − √15)/(5 √15) a unit of speed, and 5/√15 as much faster.
    let (time, speed) = (1.0 / 5.0 - 1.0 / edge, 5.0 / edge);
    close(end.q_by_v[0], -time * (edge - 0.625 * slid) + speed * slid, 1e-12);
}

#[test]
fn friction_at_rest_is_that_of_its_side() {
    let puck = Puck { dry: 0.5, ice: 0.0625, pull: 0.0 };
    for (x, coefficient) in [(0.25, 0.5), (1.75, 0.0625)] {
        for (pull, holds) in [(0.99, true), (1.01, false)] {
            let puck = Puck { pull: pull * coefficient * 20.0, ..puck };
            let end = *puck.simulate(State::at_rest([x, 0.0])).advance_to(0.5).unwrap();
            assert_eq!(end.q[0] == x, holds);
        }
    }
}

/// A shaft in a bearing whose torque grows with the speed, up to the limit of a spring.
struct Shaft;

#[lagrangian(coordinates = [phi], inputs = [drive, most])]
impl Shaft {
    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        0.5 * v.phi * v.phi
    }

    #[force(on = phi)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.drive
    }

    fn torque(&self, v: &Velocities, u: &Inputs) -> f64 {
        (1.0 + 0.5 * v.phi.abs()).min(u.most)
    }

    #[friction(limit = torque)]
    fn bearing(&self, v: &Velocities) -> f64 {
        v.phi
    }
}

#[test]
fn a_limit_of_the_speed_is_the_same_both_ways() {
    for way in [1.0, -1.0] {
        let motion = |inputs| {
            let start = State::new([0.0], [4.0 * way]);
            Shaft.simulate(start).with_tolerance(TIGHT).with_inputs(inputs)
        };
        // v' = −(1 + v/2).
        let mut free = motion([0.0, 9.0]);
        close(free.advance_to(1.0).unwrap().v[0], way * (6.0 * (-0.5_f64).exp() - 2.0), 1e-13);
        let stop = free.advance_to_switch(9.0).unwrap().expect("it stops").state;
        close(stop.t, 2.0 * 3.0_f64.ln(), 1e-13);
        // A torque of one holds it, whichever way it is driven.
        for drive in [0.99, -0.99] {
            free.set_inputs([drive, 9.0]);
            free.advance_to(free.state().t + 1.0).unwrap();
            assert_eq!(free.state().v, [0.0]);
        }
        for drive in [3.0, -3.0] {
            free.set_inputs([drive, 9.0]);
            let end = *free.advance_to(free.state().t + 1.0).unwrap();
            // v' = 2 − v/2 from rest.
            close(end.v[0], drive.signum() * 4.0 * (1.0 - (-0.5_f64).exp()), 1e-13);
            free.set_state(State { v: [0.0], ..end });
        }
        // Not more than two: v' = −2 as long as v > 2, for one second.
        let mut clamped = motion([0.0, 2.0]);
        let knee = clamped.advance_to_switch(9.0).unwrap().expect("the torque falls").state;
        close(knee.t, 1.0, 1e-14);
        close(knee.v[0], 2.0 * way, 1e-13);
        let stop = clamped.advance_to_switch(9.0).unwrap().expect("it stops").state;
        close(stop.t, 1.0 + 2.0 * 2.0_f64.ln(), 1e-13);
    }
}

/// A block on a floor with scales: smoother one way than the other, and thrown onto it.
struct Scales;

#[lagrangian(coordinates = [x, y])]
impl Scales {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        10.0 * q.y - 3.0 * q.x
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    fn grain(&self, v: &Velocities) -> f64 {
        if v.x > 0.0 { 0.2 } else { 0.5 }
    }

    fn hold(&self, v: &Velocities) -> f64 {
        if v.x > 0.0 { 0.25 } else { 0.75 }
    }

    #[friction(coefficient = grain, static_coefficient = hold, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn scales_take_other_impulses_one_way_than_the_other() {
    // It falls for one second at −10 / 2 and lands with 10.
    for (along, after, impulse) in [(7.0, 8.0, -2.0), (-13.0, -5.0, 5.0), (-4.0, 0.0, 1.0)] {
        let mut motion = Scales.simulate(State::new([0.0, 5.0], [along, 0.0])).with_tolerance(TIGHT);
        let impact = motion.advance_to_switch(9.0).unwrap().expect("it lands").state;
        close(impact.v[0], after, 1e-13);
        close(motion.impulses().slip, impulse, 1e-13);
        // 3 − 2 forward, 3 + 5 backward.
        let late = *motion.advance_to(1.5).unwrap();
        close(late.v[0], if after < 0.0 { -1.0 } else { after + 0.5 }, 1e-13);
    }
    // The weight pulls with 3, more than 2.5 and less than 7.5.
    let mut motion = Scales.simulate(State::at_rest([0.0, 0.0])).with_tolerance(TIGHT);
    close(motion.advance_to(2.0).unwrap().v[0], 2.0, 1e-13);
}

/// A clutch that runs freely in one direction: no force there, 50 N in the other one.
struct OneWay {
    free: f64,
    push: f64,
    rate: f64,
    load: f64,
}

#[lagrangian(coordinates = [x])]
impl OneWay {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn push(&self, t: f64) -> f64 {
        self.push * (self.rate * t).sin() + self.load
    }

    #[friction(limit = grip)]
    fn clutch(&self, v: &Velocities) -> f64 {
        v.x
    }

    fn grip(&self, v: &Velocities) -> f64 {
        if v.x < 0.0 { 50.0 } else { self.free }
    }
}

/// A load that passes zero does not show yet which way the clutch goes. A limit of zero is reached at once.
#[test]
fn a_clutch_without_drag_runs_as_one_with_hardly_any() {
    for number in 0..40 {
        let part = f64::from(number) / 40.0;
        let load = if number % 3 == 0 { 0.0 } else { part - 0.5 };
        let ends = [0.0, 1e-12].map(|free| {
            let clutch = OneWay { free, push: 0.3 + part, rate: 0.5 + 2.0 * (7.0 * part).fract(), load };
            clutch.simulate(State::at_rest([0.0])).advance_to(6.0).unwrap().q[0]
        });
        close(ends[0], ends[1], 1e-9);
    }
    let clutch = OneWay { free: 0.0, push: 1.0, rate: 3.0, load: 0.0 };
    let end = clutch.simulate(State::at_rest([0.0])).advance_to(6.0).unwrap().q[0];
    // It stands while the velocity would turn: each period adds ∫ (1 − cos 3t) / 3 dt.
    close(end, 2.0 - 18.0_f64.sin() / 9.0, 1e-9);
}
