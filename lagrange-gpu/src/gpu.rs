//! [`Gpu`] and [`Kernels`]: a processor and the kernels loaded on it.

use std::fs;
use std::panic::catch_unwind;
use std::path::Path;
use std::sync::Arc;

use cudarc::driver::sys::{self, CUresult};
use cudarc::driver::{
    CudaContext, CudaFunction, CudaModule, CudaSlice, CudaStream, DriverError, LaunchConfig, PushKernelArg,
};
use cudarc::nvrtc::Ptx as Image;

use crate::error::Error;
use crate::kernel::{Kernel, MISMATCHED};
use crate::ptx::{Arithmetic, Ptx};
use crate::rows::Rows;
use crate::words::Words;

/// Threads of a block. Kernels of motions need so many registers that a multiprocessor holds a few hundred
/// threads; blocks of two warps leave the least of it empty.
const BLOCK: u32 = 64;

/// Motions of a launch: several times what any processor holds at once. The rows of a launch are copied while
/// the next one runs.
const LAUNCH: u64 = 1 << 18;

/// Launches at a time: one runs while the rows of the other are copied.
const TURNS: usize = 2;

/// A graphics processor of NVIDIA.
#[derive(Clone, Debug)]
pub struct Gpu {
    context: Arc<CudaContext>,
    number: usize,
}

impl Gpu {
    /// The processor with a number, counted from zero.
    ///
    /// # Errors
    /// [`Error::NoDriver`], [`Error::NoDevice`], [`Error::OutOfMemory`]; [`Error::WrongVersion`] and
    /// [`Error::Driver`] of a driver that does not run.
    pub fn new(number: usize) -> Result<Self, Error> {
        // SAFETY: loading the driver runs its initialisation, as any use of it does.
        #[allow(unsafe_code)]
        let installed = unsafe { sys::is_culib_present() };
        if !installed {
            return Err(Error::NoDriver);
        }
        // The library looks up all functions at first use, and panics where one is missing.
        let context = catch_unwind(|| CudaContext::new(number))
            .map_err(|_| Error::WrongVersion { needed: "a driver of CUDA 11.8 or later".to_owned() })?;
        let context = context.map_err(|error| match error.0 {
            CUresult::CUDA_ERROR_STUB_LIBRARY => Error::NoDriver,
            CUresult::CUDA_ERROR_NO_DEVICE | CUresult::CUDA_ERROR_INVALID_DEVICE => {
                Error::NoDevice { number }
            }
            _ => error.into(),
        })?;
        Ok(Self { context, number })
    }

    /// Its name.
    ///
    /// # Errors
    /// [`Error::Driver`].
    pub fn name(&self) -> Result<String, Error> {
        Ok(self.context.name()?)
    }

    /// Its number, counted from zero.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Compiles kernels for this processor. The first time this takes as long as assembling them: minutes for
    /// those of the repository. [`Gpu::load_assembled`] takes none.
    ///
    /// # Errors
    /// [`Error::Refused`], [`Error::WrongVersion`], [`Error::OutOfMemory`], [`Error::Driver`].
    pub fn load(&self, ptx: &Ptx, arithmetic: Arithmetic) -> Result<Kernels, Error> {
        let module = self.context.load_module(ptx.text(arithmetic).into());
        let needed =
            || format!("a driver for PTX {} and a processor {} or later", ptx.version(), ptx.target());
        self.kernels(module.map_err(|error| Error::of_loading(error, needed))?, arithmetic)
    }

    /// Loads kernels that `ptxas` has assembled for this kind of processor, at once. `arithmetic` is that of
    /// the text from which they were assembled: `scripts/gpu.sh assemble` leaves `kernels.cubin`, which is
    /// exact, and `fused.cubin`.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::Refused`], [`Error::WrongVersion`], [`Error::OutOfMemory`],
    /// [`Error::Driver`].
    pub fn load_assembled(&self, path: impl AsRef<Path>, arithmetic: Arithmetic) -> Result<Kernels, Error> {
        let path = path.as_ref();
        let unreadable = |source| Error::Unreadable { path: path.to_owned(), source };
        let module = self.context.load_module(Image::from_binary(fs::read(path).map_err(unreadable)?));
        let needed = || format!("the processor for which {} was assembled", path.display());
        self.kernels(module.map_err(|error| Error::of_loading(error, needed))?, arithmetic)
    }

    fn kernels(&self, module: Arc<CudaModule>, arithmetic: Arithmetic) -> Result<Kernels, Error> {
        let streams = [self.context.new_stream()?, self.context.new_stream()?];
        Ok(Kernels { module, streams, context: self.context.clone(), arithmetic })
    }
}

/// Kernels loaded on a processor.
#[derive(Clone, Debug)]
pub struct Kernels {
    context: Arc<CudaContext>,
    module: Arc<CudaModule>,
    /// Launches and copies take turns on these.
    streams: [Arc<CudaStream>; TURNS],
    arithmetic: Arithmetic,
}

/// The motions of a launch.
#[derive(Clone, Copy, Debug)]
struct Launch {
    first: u64,
    count: u64,
    /// The stream and the cells that it has.
    turn: usize,
}

impl Kernels {
    /// Computes `count` motions in launches that fit into the memory of the processor, and returns all rows.
    ///
    /// With exact arithmetic one motion of each launch is computed here as well. Its row must have the same
    /// bits, or the kernel was built from another source.
    ///
    /// # Errors
    /// [`Error::NoKernel`], [`Error::Mismatched`], [`Error::Differs`]; [`Error::OutOfMemory`],
    /// [`Error::Driver`].
    pub fn run<S: Words, R: Words, E>(
        &self,
        kernel: Kernel<S, R, E>,
        setting: S,
        count: u64,
    ) -> Result<Rows<S, R, E>, Error> {
        let name = || kernel.name().to_owned();
        let function = self.module.load_function(kernel.name()).map_err(|error| match error.0 {
            CUresult::CUDA_ERROR_NOT_FOUND => Error::NoKernel { name: name() },
            _ => error.into(),
        })?;
        // A buffer has a word at least.
        let mut words = vec![0; S::WORDS.max(1)];
        let mut places = words.iter_mut();
        setting.put(&mut |word| places.next().into_iter().for_each(|place| *place = word));
        let words = self.streams[0].clone_htod(&words)?;
        self.streams[0].synchronize()?;
        let mut rows = Rows::new(kernel, setting, count, self.batch::<R>(count)?);
        let columns = 1 + R::WORDS;
        let room = index(rows.batch) * columns;
        let mut cells = [self.streams[0].alloc_zeros(room)?, self.streams[1].alloc_zeros(room)?];
        let mut running = None;
        for (first, turn) in (0..count).step_by(index(rows.batch)).zip((0..TURNS).cycle()) {
            let launch = Launch { first, count: rows.batch.min(count - first), turn };
            self.launch(&function, &launch, kernel.shape(), &words, &mut cells[turn])?;
            if let Some(last) = running.replace(launch) {
                self.take(&mut rows, &last, &cells[last.turn])?;
            }
        }
        if let Some(last) = running {
            self.take(&mut rows, &last, &cells[last.turn])?;
        }
        Ok(rows)
    }

    /// Waits for a launch and takes its rows.
    fn take<S: Words, R: Words, E>(
        &self,
        rows: &mut Rows<S, R, E>,
        launch: &Launch,
        cells: &CudaSlice<u64>,
    ) -> Result<(), Error> {
        let stream = &self.streams[launch.turn];
        // The copy waits for the launch, and ends in its error.
        let part = stream.clone_dtoh(&cells.slice(..index(launch.count) * (1 + R::WORDS)))?;
        stream.synchronize()?;
        let name = rows.kernel().name().to_owned();
        if part.first() == Some(&MISMATCHED) {
            return Err(Error::Mismatched { name });
        }
        rows.add(part);
        let sample = launch.first + launch.count / 2;
        if self.arithmetic == Arithmetic::Exact && !rows.is_that_of_the_function(sample) {
            return Err(Error::Differs { name, index: sample });
        }
        Ok(())
    }

    /// Motions of a launch: the rows of two take a quarter of the free memory at most.
    fn batch<R: Words>(&self, count: u64) -> Result<u64, Error> {
        let (free, _) = self.context.mem_get_info()?;
        let row = 8 * (1 + R::WORDS as u64);
        let most = free as u64 / 4 / TURNS as u64 / row;
        if most == 0 { Err(Error::OutOfMemory) } else { Ok(count.min(LAUNCH).min(most).max(1)) }
    }

    /// Starts a launch.
    fn launch(
        &self,
        function: &CudaFunction,
        &Launch { first, count, turn }: &Launch,
        shape: u64,
        setting: &CudaSlice<u64>,
        cells: &mut CudaSlice<u64>,
    ) -> Result<(), DriverError> {
        let blocks = u32::try_from(count.div_ceil(u64::from(BLOCK))).unwrap_or(u32::MAX);
        let config = LaunchConfig { grid_dim: (blocks, 1, 1), block_dim: (BLOCK, 1, 1), shared_mem_bytes: 0 };
        let mut launch = self.streams[turn].launch_builder(function);
        launch.arg(&first).arg(&count).arg(&shape).arg(setting).arg(cells);
        // SAFETY: the arguments are those of the kernels that `kernels!` makes. The kernel compares `shape`
        // with its own types before it touches a word, the setting has the words of its first half, and the
        // cells one more than those of its second half for each motion.
        #[allow(unsafe_code)]
        unsafe {
            launch.launch(config)?;
        }
        Ok(())
    }
}

impl Kernels {
    /// The registers and the bytes of stack of a thread of a kernel, as it was compiled or assembled.
    ///
    /// # Errors
    /// [`Error::NoKernel`], [`Error::Driver`].
    pub fn registers_and_stack(&self, name: &str) -> Result<(u32, u32), Error> {
        let function = self.module.load_function(name).map_err(|error| match error.0 {
            CUresult::CUDA_ERROR_NOT_FOUND => Error::NoKernel { name: name.to_owned() },
            _ => error.into(),
        })?;
        let number = |count: i32| u32::try_from(count).unwrap_or(0);
        Ok((number(function.num_regs()?), number(function.local_size_bytes()?)))
    }
}

/// A number of motions of a launch, at most [`LAUNCH`].
fn index(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}
