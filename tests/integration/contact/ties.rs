//! Conditions on numbers that are equal to their bound for a while: depths, flags, modes, saturated commands.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A body that is pushed along y with 1 where x > 0 and with −1 elsewhere, while x grows with time.
struct Clock<const WAY: usize> {
    level: f64,
}

/// The push, each time by another condition of the same meaning.
macro_rules! ways {
    ($($way:literal: |$x:ident, $level:ident| $condition:expr;)*) => {$(
        #[lagrangian(coordinates = [x, y])]
        impl Clock<$way> {
            #[point(mass = 1.0)]
            fn body(&self, q: &Coordinates) -> Vector2<f64> {
                Vector2::new(q.x, q.y)
            }

            #[force(on = y)]
            fn push(&self, q: &Coordinates) -> f64 {
                let ($x, $level) = (q.x, self.level);
                if $condition { 1.0 } else { -1.0 }
            }
        }
    )*

        #[test]
        fn a_condition_on_a_number_that_rests_at_its_bound_means_what_it_says() {
            let mut samples = Samples::new(61);
            for _ in 0..40 {
                let (x, speed) = (samples.number(-1.0, 1.0), samples.number(-1.0, 1.0));
                let (y, up) = (samples.number(-1.0, 1.0), samples.number(-1.0, 1.0));
                let (end, level) = (samples.number(0.5, 4.0), samples.number(-3.0, 3.0));
                let before = if x > 0.0 { 1.0 } else { -1.0 };
                let passes = -x / speed;
                let crosses = passes > 0.0 && passes < end;
                // Behind the place where x passes zero the push has the other sign.
                let late = if crosses { end - passes } else { 0.0 };
                let v_y = up + before * (end - 2.0 * late);
                let height = y + up * end + before * (0.5 * end * end - late * late);
                let start = State::new([x, y], [speed, up]);
                $({
                    let clock = Clock::<$way> { level };
                    let state = *clock.simulate(start).advance_to(end).unwrap();
                    close_on(1.0, state.v[1], v_y, 1e-9);
                    close_on(1.0, state.q[1], height, 1e-9);
                    let mut motion = clock.stepper::<Jet<6>>(start);
                    for _ in 0..20 {
                        motion.step(0.05 * end, &[]).unwrap();
                    }
                    close_on(1.0, motion.state().v[1], v_y, 1e-9);
                })*
            }
        }
    };
}

ways! {
    0: |x, _level| x > 0.0;
    1: |x, _level| { let depth = x.max(0.0); depth > 0.0 };
    2: |x, _level| { let flag = if x > 0.0 { 1.0 } else { 0.0 }; flag > 0.0 };
    3: |x, _level| { let flag = if x > 0.0 { 1.0 } else { 0.0 }; flag >= 1.0 };
    4: |x, _level| { let command = (x + 1.0).clamp(-1.0, 1.0); command >= 1.0 };
    5: |x, _level| x.abs() <= x;
    6: |x, level| { let mode = if x > 0.0 { level } else { level + 1.0 }; mode <= level };
    7: |x, _level| { let depth = (-x).max(0.0); depth * depth.abs() <= 0.0 };
    8: |x, level| x.clamp(level - 8.0, level + 8.0).max(0.0) * x.max(-9.0) > 0.0;
    9: |x, _level| {
        let [a, b] = [0.5, 2.0].map(|factor| if factor * x > 0.0 { 1.0 } else { 0.0 });
        let both = a + b;
        both >= 2.0 && both > a
    };
    10: |x, _level| {
        let mut passed = 0.0;
        for k in 0..10 {
            if x > -0.1 * k as f64 {
                passed += 1.0;
            }
        }
        passed >= 10.0
    };
    11: |x, _level| {
        let mut mode = 0.0;
        for k in 0..12 {
            if x > 0.1 * (k as f64 - 11.0) {
                mode = k as f64;
            }
        }
        mode >= 11.0
    };
}

/// A body over a floor that pushes and damps while the body is in it.
struct Floor<const WAY: usize> {
    stiffness: f64,
    damping: f64,
}

macro_rules! floors {
    ($($way:literal: |$y:ident, $depth:ident| $touches:expr;)*) => {$(
        #[lagrangian(coordinates = [y])]
        impl Floor<$way> {
            #[point(mass = 1.0)]
            fn body(&self, q: &Coordinates) -> f64 {
                q.y
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                9.81 * q.y
            }

            #[force(on = y)]
            fn floor(&self, q: &Coordinates, v: &Velocities) -> f64 {
                let ($y, $depth) = (q.y, (-q.y).max(0.0));
                if $touches { self.stiffness * $depth - self.damping * v.y } else { 0.0 }
            }
        }
    )*};
}

floors! {
    0: |y, _depth| y < 0.0;
    1: |_y, depth| depth > 0.0;
    2: |_y, depth| 0.0 < depth;
}

#[test]
fn a_floor_that_asks_for_the_depth_is_one_that_asks_for_the_height() {
    let mut samples = Samples::new(67);
    for _ in 0..40 {
        let (stiffness, damping) = (samples.number(50.0, 5e3), samples.number(0.1, 10.0));
        let start = State::new([samples.number(0.1, 2.0)], [samples.number(-1.0, 1.0)]);
        let direct = *Floor::<0> { stiffness, damping }.simulate(start).advance_to(3.0).unwrap();
        for state in [
            *Floor::<1> { stiffness, damping }.simulate(start).advance_to(3.0).unwrap(),
            *Floor::<2> { stiffness, damping }.simulate(start).advance_to(3.0).unwrap(),
        ] {
            close_on(1.0, state.q[0], direct.q[0], 1e-8);
        }
    }
}
