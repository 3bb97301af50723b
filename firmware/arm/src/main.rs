//! Follows the motion on a Cortex-M4F. The plant stands in for the motors.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod target;

#[cfg(not(target_arch = "arm"))]
fn main() {
    println!("cargo run --release -p arm --target thumbv7em-none-eabihf");
}
