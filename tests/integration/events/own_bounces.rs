//! Bounces that a user makes at events, in free fall: no error bounds a step of `Dop853` there.

use lagrangian::Dop853;
use lagrangian::prelude::*;

struct Ball;

#[lagrangian(coordinates = [x])]
impl Ball {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.x
    }
}

#[test]
fn every_bounce_of_a_falling_ball_is_met() {
    for (tolerance, restitution) in [(1e-6, 1.0), (1e-10, 1.0), (1e-10, 0.99), (1e-13, 1.0)] {
        for step in 0..20 {
            let (height, until): (f64, f64) = (0.1 + 0.05 * f64::from(step), 15.0);
            let mut motion = Ball.simulate_with::<Dop853>(State::at_rest([height])).with_tolerance(tolerance);
            let mut impact = (2.0 * 9.81 * height).sqrt();
            let mut time = impact / 9.81;
            while let Some(event) =
                motion.advance_to_event(|state: &State<f64, 1>| state.q[0], until).expect("it falls freely")
            {
                let State { t, v: [v], .. } = event.state;
                assert!(
                    (t - time).abs() < 1e-8 && (v + impact).abs() < 1e-8,
                    "{height}, {tolerance:e}: {t} {v}"
                );
                motion.set_state(State { v: [-restitution * v], ..event.state });
                impact *= restitution;
                time += 2.0 * impact / 9.81;
            }
            assert!(time > until - 1e-9, "{height}, {tolerance:e}: {time}");
        }
    }
}
