//! Narrow loads on what is held: brakes and contacts let go when they exceed what these bear, wherever steps
//! end.

use lagrangian::Contact;
use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// The number of bodies that are held.
const BODIES: usize = 6;

/// Bodies that are held under loads that rise within a width, each in another way and at another time. All
/// let go where their load is one.
struct Held {
    /// The largest load, of each shape: all but one are zero.
    most: [f64; 4],
    at: [f64; BODIES],
    width: f64,
}

/// The place before the middle at which a load of this shape is one, in widths.
fn rise(shape: usize, most: f64) -> f64 {
    match shape {
        0 => most.ln().sqrt(),
        1 => -(2.0 / most - 1.0).atanh(),
        2 => most.sqrt().acosh(),
        _ => (most.cbrt() - 1.0).sqrt(),
    }
}

#[lagrangian(coordinates = [block, pair, sheet: [2], fading, crate_at: [2], near_magnet, magnet])]
impl Held {
    fn load(&self, body: usize, place: f64) -> f64 {
        let x = (place - self.at[body]) / self.width;
        let [gaussian, stair, soliton, resonance] = self.most;
        gaussian * (-x * x).exp()
            + 0.5 * stair * (1.0 + x.tanh())
            + soliton * x.cosh().powi(-2)
            + resonance / (1.0 + x * x).powi(3)
    }

    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        let crates = v.crate_at[0].powi(2) + v.crate_at[1].powi(2);
        let sheets = v.sheet[0].powi(2) + v.sheet[1].powi(2);
        let alone = v.block.powi(2) + v.pair.powi(2) + v.fading.powi(2);
        0.5 * (crates + sheets + alone + v.near_magnet.powi(2) + v.magnet.powi(2))
    }

    #[force(on = block)]
    fn on_block(&self, t: f64) -> f64 {
        self.load(0, t)
    }

    #[friction(limit = 1.0)]
    fn brake(&self, v: &Velocities) -> f64 {
        v.block
    }

    #[force(on = pair)]
    fn on_pair(&self, t: f64) -> f64 {
        self.load(1, t)
    }

    #[friction(limit = 0.4)]
    fn left(&self, v: &Velocities) -> f64 {
        v.pair
    }

    #[friction(limit = 0.6)]
    fn right(&self, v: &Velocities) -> f64 {
        v.pair
    }

    #[force(on = sheet)]
    fn on_sheet(&self, t: f64) -> Vector2<f64> {
        self.load(2, t) * Vector2::new(0.6, 0.8)
    }

    #[friction(limit = 1.0)]
    fn drag(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.sheet[0], v.sheet[1])
    }

    #[force(on = fading)]
    fn on_fading(&self) -> f64 {
        1.0
    }

    fn hold(&self, t: f64) -> f64 {
        2.0 - self.load(3, t)
    }

    #[friction(limit = hold)]
    fn grip(&self, v: &Velocities) -> f64 {
        v.fading
    }

    #[force(on = crate_at)]
    fn on_crate(&self, t: f64) -> Vector2<f64> {
        Vector2::new(0.25, 0.5 * self.load(4, t) - 1.0)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.crate_at[1]
    }

    #[friction(coefficient = 0.5, normal = floor)]
    fn slide(&self, v: &Velocities) -> f64 {
        v.crate_at[0]
    }

    #[force(on = near_magnet)]
    fn attraction(&self, q: &Coordinates) -> f64 {
        self.load(5, q.magnet)
    }

    #[friction(limit = 1.0)]
    fn stop(&self, v: &Velocities) -> f64 {
        v.near_magnet
    }
}

#[test]
fn what_is_held_lets_go_under_narrow_loads() {
    let mut samples = Samples::new(1);
    for round in 0..12 {
        let width = 10_f64.powf(samples.number(-6.0, 0.3));
        let tolerance = 10_f64.powf(samples.number(-10.0, -5.0));
        let size = 1.0 + 10_f64.powf(samples.number(-2.0, -0.1));
        let mut most = [0.0; 4];
        most[round % 4] = size;
        let mut latest = samples.number(-20.0, 20.0) * width;
        let start = latest - 10_f64.powf(samples.number(1.0, 5.0)) * width;
        let at = [0; BODIES].map(|_| {
            latest += samples.number(0.0, 10.0) * width;
            latest
        });
        let mut scene = Held { most, at, width };
        scene.at.rotate_left(round / 4);
        let mut state = State::at_rest([0.0; 9]).at_time(start);
        (state.q[8], state.v[8]) = (start, 1.0);
        let mut motion = scene.simulate(state).with_tolerance(tolerance);
        let mut begun = [f64::NAN; BODIES];
        while let Some(switch) = motion.advance_to_switch(latest + 5.0 * width).unwrap() {
            let now = motion.contacts();
            let slip = [now.brake, now.left, now.drag[0], now.grip, now.slide, now.stop];
            for (begun, _) in begun.iter_mut().zip(slip).filter(|(_, slip)| *slip == Contact::Slips) {
                if begun.is_nan() {
                    *begun = switch.before.t;
                }
            }
        }
        for (begun, at) in begun.into_iter().zip(scene.at) {
            close_on(width, begun - at, -width * rise(round % 4, size), 1e-6);
        }
    }
}

/// A body at rest under a pulse a exp((t − c)/w) that ends at t = c, or falls again behind it.
struct Pushed<const SIDES: usize> {
    width: f64,
    at: f64,
}

#[lagrangian(coordinates = [x])]
impl Pushed<1> {
    #[point(mass = 1.0)]
    fn body(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[force(on = x)]
    fn push(&self, t: f64) -> f64 {
        if t < self.at { ((t - self.at) / self.width).exp() / self.width } else { 0.0 }
    }
}

#[lagrangian(coordinates = [x])]
impl Pushed<2> {
    #[point(mass = 1.0)]
    fn body(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[force(on = x)]
    fn push(&self, t: f64) -> f64 {
        (-((t - self.at) / self.width).abs()).exp() / self.width
    }
}

#[test]
fn a_pulse_that_ends_where_it_is_largest_is_not_hidden_by_what_would_follow() {
    let mut samples = Samples::new(5);
    for _ in 0..40 {
        let at = samples.number(1.0, 5.0);
        let width = at / 10_f64.powf(samples.number(2.7, 6.0));
        let start = State::at_rest([samples.number(-1.0, 1.0)]);
        let end = at + samples.number(0.1, 3.0);
        let one_sided = *Pushed::<1> { width, at }.simulate(start).advance_to(end).unwrap();
        close_on(1.0, one_sided.v[0], 1.0, 1e-8);
        let two_sided = *Pushed::<2> { width, at }.simulate(start).advance_to(end).unwrap();
        close_on(1.0, two_sided.v[0], 2.0, 1e-8);
    }
}
