//! Generated systems on a target without operating system and allocator.
//!
//! A static library is linked completely: an allocation or a call of the standard library would
//! not build. `cargo build --release -p bare-metal --target thumbv7em-none-eabihf`.
#![no_std]

use lagrangian::prelude::*;

/// Two point masses on massless rods.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum<R> {
    /// Masses \[kg\].
    pub m: [R; 2],
    /// Rod lengths \[m\].
    pub l: [R; 2],
    /// Gravitational acceleration \[m/s²\].
    pub g: R,
}

#[lagrangian(coordinates = [theta: [2]], inputs = [motor])]
impl<R: Real> DoublePendulum<R> {
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) * self.l[0]
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos()) * self.l[1]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }

    #[dissipation]
    fn bearings(&self, v: &Velocities<R>) -> R {
        0.005 * (v.theta[0].powi(2) + v.theta[1].powi(2))
    }

    #[force(on = theta)]
    fn shoulder(&self, u: &Inputs<R>) -> [R; 2] {
        [u.motor, R::zero()]
    }
}

/// One step of a plant model at 1 kHz in single precision; returns 0 on success.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the entry point needs a fixed symbol so that the linker keeps it")]
pub extern "C" fn step(angle: &mut f32, rate: &mut f32, torque: f32) -> i32 {
    let pendulum = DoublePendulum { m: [0.5, 0.25], l: [0.5, 0.25], g: 9.81 };
    let mut plant = pendulum.stepper::<Rk4>(State::new([*angle, 0.0], [*rate, 0.0]));
    match plant.step(1e-3, &[torque]) {
        Ok(state) => {
            *angle = state.q[0];
            *rate = state.v[0];
            0
        }
        Err(_) => 1,
    }
}

/// The same step by a Taylor series.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the entry point needs a fixed symbol so that the linker keeps it")]
pub extern "C" fn jet_step(angle: &mut f32, rate: &mut f32, torque: f32) -> i32 {
    let pendulum = DoublePendulum { m: [0.5, 0.25], l: [0.5, 0.25], g: 9.81 };
    let mut plant = pendulum.stepper::<Jet<6>>(State::new([*angle, 0.0], [*rate, 0.0]));
    match plant.step(1e-3, &[torque]) {
        Ok(state) => {
            *angle = state.q[0];
            *rate = state.v[0];
            0
        }
        Err(_) => 1,
    }
}

/// A run under error control in double precision; returns the energy at the end.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the entry point needs a fixed symbol so that the linker keeps it")]
pub extern "C" fn energy_after(seconds: f64) -> f64 {
    let pendulum = DoublePendulum { m: [1.0, 1.0], l: [1.0, 1.0], g: 9.81 };
    let mut motion = pendulum.simulate(State::at_rest([2.0, 2.0]));
    match motion.advance_to(seconds) {
        Ok(_) => motion.energy(),
        Err(_) => f64::NAN,
    }
}

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
