//! A walker with knees on rough feet that strike in turn, ever faster, until both stand: one of them sticks and
//! the other slides.

use lagrangian::Contact;
use lagrangian::prelude::*;

struct Walker {
    hip: f64,
    thigh: f64,
    shin: f64,
    slope: f64,
}

/// Lengths of thighs and shins \[m].
const LENGTH: f64 = 0.4;

#[lagrangian(coordinates = [x, y, thigh: [2], knee: [2]])]
impl Walker {
    #[point(mass = self.hip)]
    fn hips(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    fn down(&self, angle: f64) -> Vector2<f64> {
        Vector2::new(angle.sin(), -angle.cos())
    }

    fn on_shin(&self, q: &Coordinates, leg: usize, part: f64) -> Vector2<f64> {
        let knee = self.hips(q) + LENGTH * self.down(q.thigh[leg]);
        knee + part * LENGTH * self.down(q.thigh[leg] - q.knee[leg])
    }

    #[point(mass = self.thigh)]
    fn thighs(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        q.thigh.map(|angle| self.hips(q) + 0.5 * LENGTH * self.down(angle))
    }

    #[point(mass = self.shin)]
    fn shins(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [0, 1].map(|leg| self.on_shin(q, leg, 0.4))
    }

    #[point(mass = 0.1)]
    fn feet(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [0, 1].map(|leg| self.on_shin(q, leg, 1.0))
    }

    /// Height above the slope, on which x leads downhill.
    fn height(&self, place: Vector2<f64>) -> f64 {
        place.y * self.slope.cos() - place.x * self.slope.sin()
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let [thighs, shins, feet] =
            [self.thighs(q), self.shins(q), self.feet(q)].map(|[a, b]| self.height(a) + self.height(b));
        9.81 * (self.hip * self.height(self.hips(q)) + self.thigh * thighs + self.shin * shins + 0.1 * feet)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        self.feet(q).map(|foot| foot.y)
    }

    #[unilateral]
    fn knees(&self, q: &Coordinates) -> [f64; 2] {
        q.knee
    }

    #[friction(coefficient = 1.0, normal = floor)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        self.feet_velocity(q, v).map(|foot| foot.x)
    }
}

/// After the last strike before a time one foot sticks and the other slides.
fn stands(walker: &Walker, start: State<f64, 6>, t: f64) {
    let energy = walker.energy(&start);
    for tolerance in [1e-8, 1e-10, 1e-12] {
        let mut motion = walker.simulate(start).with_tolerance(tolerance);
        let mut last = motion.contacts();
        while motion.advance_to_switch(t).unwrap().is_some() {
            last = motion.contacts();
        }
        assert_eq!(last.floor, [Contact::Closed; 2], "{tolerance:e}");
        assert_eq!(last.slips, [Contact::Sticks, Contact::Slips], "{tolerance:e}");
        let [stuck, slid] = walker.slips_rates(motion.state());
        assert!(stuck.abs() < 1e-13 && slid < -0.05, "{stuck} {slid}");
        assert!(walker.energy(motion.state()) < energy, "{tolerance:e}");
    }
}

impl Walker {
    /// The velocities of the feet along the slope, from those of the angles.
    fn slips_rates(&self, State { q, v, .. }: &State<f64, 6>) -> [f64; 2] {
        [2, 3].map(|leg| {
            let shin = q[leg] - q[leg + 2];
            v[0] + LENGTH * (v[leg] * q[leg].cos() + (v[leg] - v[leg + 2]) * shin.cos())
        })
    }
}

#[test]
fn feet_that_strike_in_turn_come_to_stand() {
    let walker = Walker {
        hip: 4.954_290_448_755_359,
        thigh: 0.627_342_158_248_202,
        shin: 0.354_822_065_172_411_5,
        slope: 0.032_080_048_603_822_08,
    };
    let start = State::new(
        [
            0.0,
            0.795_218_812_861_096_4,
            -0.162_593_785_288_440_46,
            -0.005_722_416_860_533_93,
            0.336_365_109_013_336_16,
            0.150_555_718_539_477_52,
        ],
        [
            0.317_474_022_187_006_16,
            0.0,
            -0.958_869_915_864_631_8,
            -1.200_361_840_545_152_6,
            -0.800_199_979_361_005,
            1.370_072_341_333_711_7,
        ],
    );
    // The last strikes are at 0.44578 s.
    stands(&walker, start, 0.4459);
    let walker = Walker {
        hip: 3.450_279_385_699_508,
        thigh: 1.443_868_065_867_832,
        shin: 0.409_620_874_651_500_7,
        slope: 0.0,
    };
    let start = State::new(
        [
            0.0,
            0.799_537_199_715_545_9,
            -0.294_954_147_205_366_1,
            -0.015_547_940_444_294_361,
            0.009_256_242_095_187_94,
            0.100_057_254_282_775_62,
        ],
        [
            0.949_060_877_294_299_4,
            0.0,
            0.484_313_238_204_428_5,
            0.282_202_537_848_211_6,
            0.443_873_006_246_573_44,
            -0.942_652_916_618_274_7,
        ],
    );
    // At 0.42601 s.
    stands(&walker, start, 0.4262);
}
