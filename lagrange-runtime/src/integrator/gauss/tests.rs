//! Orders, long runs, stiffness and failure, on systems with derivatives by hand.

use super::*;
use crate::integrator::samples::{Kepler, distance, pericentre};
use crate::linearized::Linearization;
use crate::system::System;

impl Linearized<2> for Kepler {
    fn residual_at(
        &self,
        (): &(),
        t: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        a: &[f64; 2],
        u: &[f64; 0],
    ) -> [f64; 2] {
        let f = self.accelerations_at(&(), t, q, v, u);
        [f[0] - a[0], f[1] - a[1]]
    }

    fn linearization_at(
        &self,
        (): &(),
        _: f64,
        &[x, y]: &[f64; 2],
        _: &[f64; 2],
        _: &[f64; 2],
        _: &[f64; 0],
    ) -> Linearization<f64, 2> {
        let r = x.hypot(y);
        let (third, fifth) = (r.powi(-3), 3.0 * r.powi(-5));
        let off = fifth * x * y;
        Linearization {
            mass: [[1.0, 0.0], [0.0, 1.0]],
            by_q: [[fifth * x * x - third, off], [off, fifth * y * y - third]],
            by_v: [[0.0; 2]; 2],
        }
    }

    fn by_inputs_at(&self, (): &(), _: f64, _: &[f64; 2], _: &[f64; 2], _: &[f64; 0]) -> [[f64; 0]; 2] {
        [[]; 2]
    }
}

fn period<const STAGES: usize>(steps: u32) -> f64
where
    Gauss<STAGES>: FixedStep<Kepler, 2, 0>,
{
    let start = pericentre(0.4);
    let mut motion = Kepler.stepper::<Gauss<STAGES>>(start);
    for _ in 0..steps {
        motion.step(core::f64::consts::TAU / f64::from(steps), &[]).unwrap();
    }
    distance(motion.state(), &start)
}

#[test]
fn zz() {
    extern crate std;
    use std::println;
    for n in [10, 20, 40, 80, 160, 320] {
        println!("{n} {:e} {:e} {:e}", period::<2>(n), period::<3>(n), period::<4>(n));
    }
    let mut motion = Kepler.stepper::<Gauss8>(pericentre(0.4));
    let e0 = motion.energy();
    for k in 0..20 {
        let mut worst = 0.0_f64;
        for _ in 0..100 * 60 {
            motion.step(core::f64::consts::TAU / 60.0, &[]).unwrap();
        }
        for _ in 0..60 {
            motion.step(core::f64::consts::TAU / 60.0, &[]).unwrap();
            worst = worst.max((motion.energy() / e0 - 1.0).abs());
        }
        println!("{k} {:e} {worst:e}", motion.energy() / e0 - 1.0);
    }
}
