//! Forms that are read rightly: the generated potential is that of the user's own function.

use lagrangian::prelude::*;

use crate::support::close::close;

const G: f64 = 1.0;

mod moon {
    pub const G: f64 = 1.62;
}

struct Mixed {
    mass: f64,
    count: f64,
}

trait Other {
    const G: f64;
}

impl Other for Mixed {
    const G: f64 = 5.0;
}

#[lagrangian(coordinates = [x])]
impl Mixed {
    const G: f64 = 9.0;
    const BYTE: u8 = 300_i32 as u8;

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x * v.x
    }

    #[potential]
    fn imported(&self, q: &Coordinates) -> f64 {
        use moon::*;
        G * q.x
    }

    #[potential]
    fn outside(&self, q: &Coordinates) -> f64 {
        G * q.x * 10.0
    }

    #[potential]
    fn by_trait(&self, q: &Coordinates) -> f64 {
        <Self as Other>::G * q.x + Self::G * q.x
    }

    #[potential]
    fn casts(&self, q: &Coordinates) -> f64 {
        let whole = self.count as i32 as f64;
        (Self::BYTE as f64 + (2.6 as i32) as f64 + (true as u8) as f64 + (-1_i8 as u8) as f64 + whole) * q.x
    }

    #[potential]
    fn whole(&self, q: &Coordinates) -> f64 {
        (2.7_f64.floor() + (-2.7_f64).ceil() * 10.0 + (5.0 / 2.0_f64).round() * 100.0 + (-3.99_f64).trunc())
            * q.x
    }

    #[potential]
    fn rounded(&self, q: &Coordinates) -> f64 {
        if 0.1 + 0.2 == 0.3 { 1000.0 * q.x } else { 7.0 * q.x }
    }

    #[potential]
    fn standard(&self, q: &Coordinates) -> f64 {
        use std::f64::consts;
        use std::f64::consts::*;
        (consts::PI + SQRT_2) * q.x
    }

    #[potential]
    fn sequence(&self, q: &Coordinates) -> f64 {
        let mut count = 0.0;
        let steps = [1.0, 2.0, 3.0].map(|step| {
            count += step;
            count
        });
        steps[2] * q.x + count * q.x
    }

    #[potential]
    fn extremes(&self, q: &Coordinates) -> f64 {
        let places = [q.x, -2.0 * q.x, 0.3];
        let largest = places.iter().fold(f64::NEG_INFINITY, |largest, place| largest.max(*place));
        largest - places.into_iter().fold(f64::INFINITY, f64::min)
            + q.x.clamp(f64::NEG_INFINITY, f64::INFINITY)
    }
}

macro_rules! scaled {
    ($name:ident, $inner:expr) => {
        struct $name;

        #[lagrangian(coordinates = [x])]
        impl $name {
            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                0.5 * v.x * v.x
            }

            #[potential]
            fn height(&self, q: &Coordinates) -> f64 {
                let scale = 2.0;
                scale * $inner * q.x
            }
        }
    };
}

scaled!(Hygienic, {
    let scale = 7.0;
    scale + 1.0
});

#[test]
fn names_mean_what_rust_means() {
    let system = Mixed { mass: 1.0, count: 2.7 };
    let q = MixedCoordinates::from([0.7]);
    let all = [
        system.imported(&q),
        system.outside(&q),
        system.by_trait(&q),
        system.casts(&q),
        system.whole(&q),
        system.rounded(&q),
        system.standard(&q),
        system.sequence(&q),
        system.extremes(&q),
    ];
    let state = State::new([0.7], [0.0]);
    close(system.potential_energy(&state), all.iter().sum(), 1e-14);
    assert!(system.accelerations(&state).is_ok());
}

#[test]
fn variables_of_a_macro_are_not_those_of_its_call() {
    let state = State::new([0.5], [0.0]);
    close(Hygienic.potential_energy(&state), 8.0, 1e-14);
    assert!(Hygienic.accelerations(&state).is_ok());
}
