//! Balances the pole on a Cortex-M4F. SysTick sets the pace; the plant stands in for the motor.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod target;

#[cfg(not(target_arch = "arm"))]
fn main() {
    println!("cargo run --release -p cart_pole --target thumbv7em-none-eabihf");
}
