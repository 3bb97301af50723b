//! One system by one method.

use core::hint::black_box;

use lagrangian::prelude::*;
use systems::Experiment;

#[cfg(feature = "f32")]
type R = f32;
#[cfg(feature = "f64")]
type R = f64;

#[cfg(feature = "double_pendulum")]
type S = systems::DoublePendulum<R>;
#[cfg(feature = "rod")]
type S = systems::Rod<R>;
#[cfg(feature = "puck")]
type S = systems::Puck<R>;
#[cfg(feature = "cart_pole")]
type S = systems::CartPole<R>;

/// Inputs of the system.
const K: usize = if cfg!(feature = "cart_pole") { 1 } else { 0 };

#[cfg(feature = "rk4")]
type M = Rk4;
#[cfg(feature = "jet4")]
type M = Jet<4>;
#[cfg(feature = "jet6")]
type M = Jet<6>;

#[cortex_m_rt::entry]
fn main() -> ! {
    // Parameters, start and step are unknown to the compiler.
    let system = black_box(<S as Experiment<K>>::new());
    let start = black_box(<S as Experiment<K>>::start());
    let h = black_box(R::from_f64(1e-3));
    #[cfg(feature = "consistent")]
    let start = system.consistent(start).unwrap_or(start);
    #[cfg(feature = "simulate")]
    let mut motion = system.simulate(start);
    #[cfg(feature = "dop853")]
    let mut motion = system.simulate_with::<Dop853>(start);
    #[cfg(not(any(feature = "simulate", feature = "dop853")))]
    let mut motion = system.stepper::<M>(start);
    loop {
        let inputs = <S as Experiment<K>>::inputs(motion.state());
        #[cfg(any(feature = "simulate", feature = "dop853"))]
        {
            motion.set_inputs(inputs);
            let _ = black_box(motion.advance_to(motion.state().t + h));
        }
        #[cfg(not(any(feature = "simulate", feature = "dop853")))]
        let _ = black_box(motion.step(h, &inputs));
        #[cfg(feature = "energy")]
        black_box(motion.energy());
        #[cfg(feature = "reactions")]
        black_box(motion.reactions(&inputs));
        #[cfg(feature = "panic")]
        assert!(motion.state().t < h);
    }
}
