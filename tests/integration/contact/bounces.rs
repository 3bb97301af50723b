//! A ball that bounces to rest while it slides.

use lagrangian::prelude::*;

use crate::support::close::close_on;

struct Sliding {
    restitution: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Sliding {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// Once it rests on the floor, the floor has given the impulse t − v(0) by all impacts and reactions
/// together, and friction µ times as much.
#[test]
fn friction_of_infinitely_many_bounces_is_that_of_their_impulses() {
    for number in 0..48 {
        let part = f64::from(number) / 48.0;
        let sliding = Sliding { restitution: 0.1 + 0.7 * part, friction: 0.05 + 0.4 * (5.0 * part).fract() };
        let (height, rise) = (0.2 + (7.0 * part).fract(), (3.0 * part).fract() - 0.5);
        let start = State::new([0.0, height], [9.0, rise]);
        let strikes = (rise * rise + 2.0 * height).sqrt();
        let e = sliding.restitution;
        let rests = rise + strikes * (1.0 + 2.0 * e / (1.0 - e));
        let end = 1.1 * rests;
        let mut motion = sliding.simulate(start).with_tolerance(1e-13);
        let state = *motion.advance_to(end).unwrap();
        assert_eq!(state.v[1], 0.0, "{state:?}");
        close_on(9.0, state.v[0], 9.0 - sliding.friction * (end - rise), 1e-13);
    }
}

#[test]
fn a_velocity_crosses_zero_at_each_impact_and_at_the_top_of_each_flight() {
    let elastic = Sliding { restitution: 1.0, friction: 0.0 };
    for shift in [0.0, 0.25] {
        let mut motion = elastic.simulate(State::at_rest([0.0, 0.5])).with_tolerance(1e-13);
        let events = motion.events(|state: &State<f64, 2>| state.v[1] + shift, 9.5);
        let events: Vec<_> = events.map(Result::unwrap).collect();
        // Impacts at odd seconds, tops at even ones; the guard falls a little later than at the top.
        let wanted = (if shift == 0.0 { 1 } else { 0 }..10).map(|number| match number % 2 {
            1 => (f64::from(number), Crossing::Rising),
            _ => (f64::from(number) + shift, Crossing::Falling),
        });
        assert_eq!(events.len(), wanted.len(), "{events:?}");
        for (event, (t, crossing)) in events.iter().zip(wanted) {
            close_on(1.0, event.state.t, t, 1e-14);
            assert_eq!(event.crossing, crossing, "{event:?}");
        }
    }
}
