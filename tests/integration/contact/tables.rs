//! A table that moves: bodies leave it and land on it, whenever somebody looks.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};

/// A ball over a table that swings.
#[derive(Clone, Copy)]
struct Ball {
    amplitude: f64,
    rate: f64,
}

#[lagrangian(coordinates = [y])]
impl Ball {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(0.0, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn table(&self, q: &Coordinates, t: f64) -> f64 {
        q.y - self.amplitude * (self.rate * t).sin()
    }
}

/// A stool on two rough feet, pushed sideways.
#[derive(Clone, Copy)]
struct Stool {
    table: Ball,
    push: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Stool {
    #[body(mass = 1.0, inertia = 0.05)]
    fn body(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y - self.push * q.x
    }

    fn feet(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [-0.3, 0.3].map(|side| (self.body(q) * Point2::new(side, -0.2)).coords)
    }

    #[unilateral]
    fn table(&self, q: &Coordinates, t: f64) -> [f64; 2] {
        self.feet(q).map(|foot| foot.y - self.table.amplitude * (self.table.rate * t).sin())
    }

    #[friction(coefficient = 0.3, normal = table)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        self.feet_velocity(q, v).map(|foot| foot.x)
    }
}

/// Tables that throw off what lies on them, by more and more of their acceleration.
fn tables() -> impl Iterator<Item = Ball> {
    (5..=20).flat_map(|rate| {
        let rate = f64::from(rate);
        [1.05, 1.2, 1.5, 1.75, 2.0].map(|share| Ball { amplitude: share * 9.81 / (rate * rate), rate })
    })
}

/// At rest on the table at the time zero.
fn on(table: Ball) -> State<f64, 3> {
    State::new([0.0, 0.2, 0.0], [0.0, table.amplitude * table.rate, 0.0])
}

#[test]
fn a_stool_leaves_its_table_with_both_feet() {
    for table in tables() {
        // The feet share a load that is about to vanish, and the friction of nothing.
        let leaves = (9.81 / (table.amplitude * table.rate.powi(2))).asin() / table.rate;
        for before in [1e-15, 1e-12, 1e-10, 1e-9, 1e-6] {
            let t = leaves - before;
            let (sin, cos) = (table.rate * t).sin_cos();
            // What a motion before has left: slips and tilts of which rounding alone knows the size.
            for residue in [0.0, 1e-17, -1e-17, 3e-15] {
                for signs in [[1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 0.3, -1.0]] {
                    let [tilt, slip, turn] = signs.map(|sign| sign * residue);
                    let start = State::new(
                        [0.0, 0.2 + table.amplitude * sin, tilt],
                        [slip, table.amplitude * table.rate * cos, turn],
                    );
                    let stool = Stool { table, push: 0.0 };
                    let end = *stool.simulate(start.at_time(t)).advance_to(leaves + 0.01).unwrap();
                    let (sin, cos) = (table.rate * leaves).sin_cos();
                    let (height, speed) = (0.2 + table.amplitude * sin, table.amplitude * table.rate * cos);
                    all_close(end.q, [0.0, height + 0.01 * (speed - 0.5 * 9.81 * 0.01), 0.0], 1e-11);
                }
            }
        }
    }
}

/// At the time when both feet leave, all regimes agree with their consequences up to rounding. Two of them
/// must not follow each other without end.
#[test]
fn a_stool_that_is_thrown_again_and_again_comes_down_flat() {
    for (rate, share) in [(7.0, 2.04), (17.0, 1.320_628_672_067_914_6), (17.0, 1.3), (6.0, 1.2)] {
        let table = Ball { amplitude: share * 9.81 / (rate * rate), rate };
        let stool = *Stool { table, push: 0.0 }.simulate(on(table)).advance_to(5.0).unwrap();
        // A ball is thrown and falls in the same way.
        let start = State::new([0.0], [table.amplitude * rate]);
        let ball = *table.simulate(start).advance_to(5.0).unwrap();
        all_close(stool.q, [0.0, 0.2 + ball.q[0], 0.0], 1e-9);
    }
}

/// A step may end a moment before a landing, and the polynomial of a gap has a truncation error.
#[test]
fn a_look_before_a_landing_changes_nothing() {
    for table in tables() {
        let stool = Stool { table, push: 1.0 };
        let mut motion = stool.simulate(on(table));
        let mut landings = [0.0; 4];
        let mut count = 0;
        while let Some(switch) = motion.advance_to_switch(2.0).unwrap() {
            if switch.before.v[1] != switch.state.v[1] && count < landings.len() {
                landings[count] = switch.state.t;
                count += 1;
            }
        }
        let end = *motion.state();
        assert!(count > 0);
        for before in [1e-8, 1e-9, 1e-10, 1e-12] {
            let mut motion = stool.simulate(on(table));
            for landing in &landings[..count] {
                motion.advance_to(landing - before).unwrap();
            }
            let looked = *motion.advance_to(2.0).unwrap();
            all_close(looked.q, end.q, 1e-8);
        }
    }
}

#[test]
fn any_time_beside_a_switch_may_be_asked_for() {
    for table in tables() {
        let start = State::new([0.0], [table.amplitude * table.rate]);
        let mut motion = table.simulate(start);
        let mut switches = [0.0; 16];
        for (seen, switch) in switches.iter_mut().enumerate() {
            *switch = match motion.advance_to_switch(3.0).unwrap() {
                Some(found) => found.state.t,
                None => 3.0 + seen as f64,
            };
        }
        let mut motion = table.simulate(start);
        for switch in switches {
            let mut t = switch.next_down();
            for _ in 0..6 {
                if t >= motion.t() {
                    motion.advance_to(t).unwrap();
                    assert_eq!(motion.t(), t);
                }
                t = t.next_up();
            }
        }
    }
}

#[test]
fn the_gap_of_a_contact_that_is_closed_has_no_events_of_its_own() {
    for table in tables() {
        let table = Ball { amplitude: 0.6 * table.amplitude / 1.05, ..table };
        let start = State::at_rest([0.2]);
        let mut motion = table.simulate(start);
        let mut switches = 0;
        while motion.advance_to_switch(2.0).unwrap().is_some() {
            switches += 1;
        }
        let mut motion = table.simulate(start);
        let gap = |state: &State<f64, 1>| state.q[0] - table.amplitude * (table.rate * state.t).sin();
        let events = motion.events(gap, 2.0).map(Result::unwrap).count();
        // One where it lands, at most one where it leaves, and one where the search ends at zero.
        assert!((1..=switches + 1).contains(&events), "{events} events, {switches} switches");
    }
}

/// A pendulum that comes to rest at a stop where nothing presses on it.
struct Pendulum;

#[lagrangian(coordinates = [phi])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.phi.sin(), -q.phi.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }

    #[unilateral]
    fn stop(&self, q: &Coordinates) -> f64 {
        q.phi
    }
}

#[test]
fn a_motion_begins_where_another_one_has_come_to_rest() {
    for step in 1..100 {
        let mut motion = Pendulum.simulate(State::at_rest([0.01 * f64::from(step)]));
        motion.advance_to_switch(10.0).unwrap().unwrap();
        let rest = *motion.state();
        assert_eq!((rest.q, rest.v), ([0.0], [0.0]));
        let end = *Pendulum.simulate(rest).advance_to(rest.t + 1.0).unwrap();
        assert_eq!((end.q, end.v), ([0.0], [0.0]));
    }
}

/// A bead between two walls that meet.
struct Groove {
    angles: [f64; 2],
    restitution: [f64; 2],
}

#[lagrangian(coordinates = [x, y])]
impl Groove {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution[0])]
    fn left(&self, q: &Coordinates) -> f64 {
        q.x * self.angles[0].sin() + q.y * self.angles[0].cos()
    }

    #[unilateral(restitution = self.restitution[1])]
    fn right(&self, q: &Coordinates) -> f64 {
        q.y * self.angles[1].cos() - q.x * self.angles[1].sin()
    }
}

/// Each passage of the bottom is a series of bounces without end, and there are infinitely many passages.
#[test]
fn a_bead_comes_to_rest_at_the_bottom_of_its_groove() {
    for step in 1..=40 {
        let part = |k: f64| (k * f64::from(step) * 0.618).fract();
        let groove = Groove {
            angles: [0.1 + 0.3 * part(1.0), 0.1 + 0.3 * part(2.0)],
            restitution: [0.6 * part(3.0), 0.6 * part(5.0)],
        };
        let start = State::new([0.0, 0.1 + 0.2 * part(6.0)], [part(7.0) - 0.5, 0.0]);
        let mut motion = groove.simulate(start).with_max_steps(50_000);
        let end = *motion.advance_to(200.0).unwrap();
        assert_eq!(end.v, [0.0; 2]);
        close(1.0 + end.q[0].hypot(end.q[1]), 1.0, 1e-9);
    }
}

/// A sheet in single precision under a force that grows beyond its friction.
struct Sheet<R> {
    limit: R,
}

#[lagrangian(coordinates = [x, y], inputs = [across, growing])]
impl<R: Real> Sheet<R> {
    #[point(mass = 1.0)]
    fn sheet(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[force(at = sheet)]
    fn push(&self, u: &Inputs<R>, t: R) -> Vector2<R> {
        Vector2::new(u.growing * t, u.across)
    }

    #[friction(limit = self.limit)]
    fn slip(&self, v: &Velocities<R>) -> Vector2<R> {
        Vector2::new(v.x, v.y)
    }
}

#[test]
fn a_sheet_slips_in_single_precision() {
    let sheet = Sheet { limit: 1.0_f32 };
    // Along a line: it begins to slip at 1 s.
    let mut motion = sheet.simulate(State::at_rest([0.0; 2])).with_inputs([0.0, 1.0]);
    let end = *motion.advance_to(2.0).unwrap();
    close(f64::from(end.q[0]), 1.0 / 6.0, 1e-5);
    for across in [0.1_f32, 0.3, 0.6, 0.9] {
        let found =
            *sheet.simulate(State::at_rest([0.0; 2])).with_inputs([across, 1.0]).advance_to(2.0).unwrap();
        let exact = *Sheet { limit: 1.0 }
            .simulate(State::at_rest([0.0; 2]))
            .with_inputs([f64::from(across), 1.0])
            .advance_to(2.0)
            .unwrap();
        // Some twenty steps, each with a tolerance of 1.2e-5.
        all_close(found.q.map(f64::from), exact.q, 2.5e-4);
    }
}
