//! Many motions of the `lagrangian` crate on a graphics processor.
//!
//! A kernel is an ordinary function of an index. It is compiled twice: for the processor, and for the machine
//! that the processor is in, where tests call it and where it runs if there is no processor. Both have the
//! same bits.
//!
//! ```
//! # /*
//! #![no_std]
//! #![cfg_attr(target_arch = "nvptx64", feature(abi_ptx))]
//! # */
//! use lagrangian::prelude::*;
//!
//! pub struct Pendulum {
//!     pub length: f64,
//! }
//!
//! #[lagrangian(coordinates = [phi])]
//! impl Pendulum {
//!     #[point(mass = 1.0)]
//!     fn bob(&self, q: &Coordinates) -> Vector2<f64> {
//!         self.length * Vector2::new(q.phi.sin(), -q.phi.cos())
//!     }
//!
//!     #[potential]
//!     fn gravity(&self, q: &Coordinates) -> f64 {
//!         9.81 * self.bob(q).y
//!     }
//! }
//!
//! /// Where the pendulum of an index is after some steps, in a study of one length and one number of steps.
//! pub fn ends(index: u64, &(h, steps): &(f64, u64)) -> Result<State<f64, 1>, MotionError<f64>> {
//!     let pendulum = Pendulum { length: 0.5 + 0.001 * index as f64 };
//!     let mut motion = pendulum.stepper::<Jet<6>>(State::at_rest([1.0]));
//!     for _ in 0..steps {
//!         motion.step(h, &[])?;
//!     }
//!     Ok(*motion.state())
//! }
//!
//! lagrange_gpu::kernels!(ends);
//!
//! # #[cfg(not(target_arch = "nvptx64"))]
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     use lagrange_gpu::{Arithmetic, Error, Gpu, Ptx, kernel};
//!     let (ends, setting, count) = (kernel!(ends), (0.01, 100), 1000);
//!     let table = match Gpu::new(0) {
//!         Ok(gpu) => {
//!             let kernels = gpu.load(&Ptx::read("kernels.ptx")?, Arithmetic::Exact)?;
//!             kernels.run(ends, setting, count)?.study().run()?
//!         }
//!         // Without a processor: the same rows, by the cores of this machine.
//!         Err(Error::NoDriver | Error::NoDevice { .. }) => ends.study(count, &setting).run()?,
//!         Err(error) => return Err(error.into()),
//!     };
//!     table.write(std::env::temp_dir().join("ends.npy"))?;
//!     Ok(())
//! }
//! ```
//!
//! The crate is `no_std` on its host, too: `x.sin()` is then the function of the crate `libm` on both sides,
//! where hosts with a standard library have their own, with other last bits.
//!
//! | name | what it is |
//! | --- | --- |
//! | [`kernels!`] | makes kernels of functions of the crate, when it is built for a processor |
//! | [`kernel!`] | such a function with its name: what a host launches, or computes itself |
//! | [`Words`] | what can be handed to a processor and back: numbers, states, arrays, tuples |
//! | `Ptx` | the text of built kernels, looked through: nothing in it is unresolved, so nothing can panic |
//! | `Gpu`, `Kernels`, `Rows` | a processor, the kernels loaded on it, and what they left |
//! | `Failure`, `Record` | why a motion has no row, and the columns of a row |
//!
//! `kernels!` takes names, so a generic function needs a function for each type. An error of your own needs
//! `impl From<MyError> for Failure` on the host.
//!
//! `scripts/gpu.sh` of the repository installs what building needs, builds, checks and measures.
#![cfg_attr(target_arch = "nvptx64", no_std, feature(stdarch_nvptx))]

mod kernel;
mod words;

#[cfg(target_arch = "nvptx64")]
#[doc(hidden)]
pub mod device;

#[cfg(not(target_arch = "nvptx64"))]
mod assembly;
#[cfg(not(target_arch = "nvptx64"))]
mod calls;
#[cfg(not(target_arch = "nvptx64"))]
mod error;
#[cfg(not(target_arch = "nvptx64"))]
mod gpu;
#[cfg(not(target_arch = "nvptx64"))]
mod ptx;
#[cfg(not(target_arch = "nvptx64"))]
mod rows;

pub use kernel::Kernel;
pub use words::Words;

#[cfg(not(target_arch = "nvptx64"))]
pub use {
    assembly::Usage,
    error::Error,
    gpu::{Gpu, Kernels},
    ptx::{Arithmetic, Ptx},
    rows::Rows,
};

/// What rows and errors need, to be tables and causes.
#[cfg(not(target_arch = "nvptx64"))]
pub use lagrange_ensemble::{Failure, Record};
