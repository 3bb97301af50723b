//! A box that slides flat on four feet, one of which may be relieved: loads are those of equal stiff springs
//! under the feet, nᵢ = max(0, a + b xᵢ + c yᵢ), and do not depend on the order of the feet.

use lagrangian::prelude::*;
use nalgebra::Matrix3;

use crate::support::close::close_on;
use crate::support::sample::Samples;

struct Crate {
    half: [f64; 3],
    roughness: f64,
}

#[lagrangian(coordinates = [hull: Pose])]
impl Crate {
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        q.hull.translation.vector.z
    }

    fn feet(&self, q: &Coordinates) -> [Vector3<f64>; 4] {
        let [a, b, c] = self.half;
        [(-a, -b), (a, -b), (-a, b), (a, b)]
            .map(|(x, y)| q.hull.translation.vector + q.hull.rotation * Vector3::new(x, y, -c))
    }

    #[unilateral]
    fn gaps(&self, q: &Coordinates) -> [f64; 4] {
        self.feet(q).map(|foot| foot.z)
    }

    #[friction(coefficient = self.roughness, normal = gaps[0])]
    fn first(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[0].xy()
    }

    #[friction(coefficient = self.roughness, normal = gaps[1])]
    fn second(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[1].xy()
    }

    #[friction(coefficient = self.roughness, normal = gaps[2])]
    fn third(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[2].xy()
    }

    #[friction(coefficient = self.roughness, normal = gaps[3])]
    fn fourth(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[3].xy()
    }
}

/// The loads of springs under feet at `places` whose friction points along `ways`: forces and moments
/// balance.
fn springs(height: f64, places: [[f64; 2]; 4], ways: [[f64; 2]; 4]) -> [f64; 4] {
    let plane = |set: usize| {
        let mut matrix = Matrix3::zeros();
        for foot in (0..4).filter(|foot| set >> foot & 1 == 1) {
            let ([x, y], [along, across]) = (places[foot], ways[foot]);
            let lever = Vector3::new(1.0, y + height * across, -height * along - x);
            matrix += lever * Vector3::new(1.0, x, y).transpose();
        }
        let plane = matrix.lu().solve(&Vector3::new(1.0, 0.0, 0.0))?;
        let raw = places.map(|[x, y]| plane[0] + plane[1] * x + plane[2] * y);
        (0..4).all(|foot| (set >> foot & 1 == 1) == (raw[foot] > 0.0)).then(|| raw.map(|load| load.max(0.0)))
    };
    let mut all = (1..16_usize).filter(|set| set.count_ones() > 2).filter_map(plane);
    let found = all.next().expect("springs bear the box");
    assert!(all.next().is_none(), "springs bear it in one way");
    found
}

#[test]
fn loads_of_sliding_feet_are_those_of_springs() {
    let mut samples = Samples::new(77);
    let mut relieved = 0;
    for _ in 0..400 {
        let half = [0.1, samples.number(0.08, 0.12), samples.number(0.05, 0.11)];
        let roughness = samples.number(0.4, 0.9);
        let [fast, aside] = [(); 2].map(|()| samples.number(-3.0, 3.0));
        let spin = samples.number(-10.0, 10.0);
        let sliding = Crate { half, roughness };
        let [a, b, height] = half;
        let places = [[-a, -b], [a, -b], [-a, b], [a, b]];
        let ways = places.map(|[x, y]| {
            let slip = [fast - spin * y, aside + spin * x];
            slip.map(|part| -roughness * part / slip[0].hypot(slip[1]))
        });
        let expected = springs(height, places, ways);
        relieved += usize::from(expected.contains(&0.0));
        for mirror in [1.0, -1.0] {
            let place = Isometry3::translation(0.0, 0.0, height);
            let twist = PoseVelocity {
                linear: Vector3::new(fast, mirror * aside, 0.0),
                angular: Vector3::new(0.0, 0.0, mirror * spin),
            };
            let start = sliding.state(CrateCoordinates { hull: place }, CrateVelocities { hull: twist });
            let mut motion = sliding.simulate(start);
            motion.advance_to(1e-9).unwrap();
            let found = motion.reactions().gaps;
            let found = if mirror > 0.0 { found } else { [found[2], found[3], found[0], found[1]] };
            for (found, expected) in found.into_iter().zip(expected) {
                close_on(1.0, found, expected, 1e-6);
            }
        }
    }
    assert!(relieved > 10, "{relieved}");
}
