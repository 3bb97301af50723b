//! [`Error`]: why a study does not run on a processor.

use std::fmt;
use std::path::PathBuf;

use cudarc::driver::DriverError;
use cudarc::driver::sys::CUresult;

/// Why a study does not run on a processor. The same rows can be computed without one: [`Kernel::study`].
///
/// [`Kernel::study`]: crate::Kernel::study
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// No driver of NVIDIA is installed on this machine.
    NoDriver,
    /// The driver knows no processor with this number.
    NoDevice {
        /// The number, counted from zero.
        number: usize,
    },
    /// A file of kernels cannot be read.
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A text that is not PTX, or has no kernel.
    NotPtx,
    /// Kernels call functions that exist nowhere. So they can panic or allocate.
    Unresolved {
        /// The functions.
        names: Vec<String>,
        /// The kernels that call them, themselves or by way of others.
        kernels: Vec<String>,
    },
    /// The driver refuses the kernels.
    Refused {
        /// Its reason.
        reason: &'static str,
    },
    /// The driver or the processor is too old, or the driver is not that of the running system.
    WrongVersion {
        /// The version that is needed.
        needed: String,
    },
    /// There is no kernel of this name among those that are loaded.
    NoKernel {
        /// The name.
        name: String,
    },
    /// The kernel takes or gives other types than the function of the same name: it was built from another
    /// source.
    Mismatched {
        /// The kernel.
        name: String,
    },
    /// A row differs from the one computed here: the kernel was built from another source.
    Differs {
        /// The kernel.
        name: String,
        /// The index of the motion.
        index: u64,
    },
    /// The memory of the processor is too small.
    OutOfMemory,
    /// Something else that the driver reports.
    Driver {
        /// The error, in words.
        code: &'static str,
    },
}

impl Error {
    /// The error of loading kernels, which need `needed`.
    pub(crate) fn of_loading(error: DriverError, needed: impl FnOnce() -> String) -> Self {
        match error.0 {
            CUresult::CUDA_ERROR_INVALID_PTX => Self::Refused { reason: "the text is not valid PTX" },
            CUresult::CUDA_ERROR_INVALID_IMAGE => Self::Refused { reason: "the text is no module" },
            CUresult::CUDA_ERROR_JIT_COMPILER_NOT_FOUND => {
                Self::Refused { reason: "the driver comes without its compiler of PTX" }
            }
            CUresult::CUDA_ERROR_JIT_COMPILATION_DISABLED => {
                Self::Refused { reason: "the compiler of PTX is switched off" }
            }
            CUresult::CUDA_ERROR_UNSUPPORTED_PTX_VERSION | CUresult::CUDA_ERROR_NO_BINARY_FOR_GPU => {
                Self::WrongVersion { needed: needed() }
            }
            _ => error.into(),
        }
    }
}

impl From<DriverError> for Error {
    fn from(error: DriverError) -> Self {
        match error.0 {
            CUresult::CUDA_ERROR_OUT_OF_MEMORY => Self::OutOfMemory,
            CUresult::CUDA_ERROR_SYSTEM_DRIVER_MISMATCH => {
                Self::WrongVersion { needed: "another driver than the one of the running system".to_owned() }
            }
            code => Self::Driver { code: name(code) },
        }
    }
}

/// The name of a code; the driver itself need not be asked.
fn name(code: CUresult) -> &'static str {
    match code {
        CUresult::CUDA_ERROR_INVALID_VALUE => "an invalid value",
        CUresult::CUDA_ERROR_NOT_INITIALIZED => "it is not initialised",
        CUresult::CUDA_ERROR_DEINITIALIZED => "it is being shut down",
        CUresult::CUDA_ERROR_DEVICE_UNAVAILABLE => "another program has the processor",
        CUresult::CUDA_ERROR_LAUNCH_OUT_OF_RESOURCES => {
            "a launch needs more registers or stack than there are"
        }
        CUresult::CUDA_ERROR_LAUNCH_TIMEOUT => "a launch took longer than the system allows",
        CUresult::CUDA_ERROR_LAUNCH_FAILED => "a launch failed",
        CUresult::CUDA_ERROR_ILLEGAL_ADDRESS => "a launch used memory that is not its own",
        CUresult::CUDA_ERROR_ECC_UNCORRECTABLE => "the memory of the processor is broken",
        _ => "an error that has no words here",
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDriver => {
                out.write_str("this machine has no driver of NVIDIA: the library `cuda` is not there")
            }
            Self::NoDevice { number } => write!(out, "this machine has no processor number {number}"),
            Self::Unreadable { path, .. } => write!(out, "the kernels in {} cannot be read", path.display()),
            Self::NotPtx => {
                out.write_str("this is no PTX with kernels: build them with `scripts/gpu.sh build`")
            }
            Self::Unresolved { names, kernels } => {
                write!(
                    out,
                    "the kernels `{}` can panic or allocate: they call `{}`, which exists nowhere. Take `get` for \
                     an index that is not sure to be inside, and no `unwrap`",
                    kernels.join("`, `"),
                    names.join("`, `")
                )
            }
            Self::Refused { reason } => write!(out, "the driver refuses the kernels: {reason}"),
            Self::WrongVersion { needed } => write!(out, "this needs {needed}"),
            Self::NoKernel { name } => {
                write!(
                    out,
                    "there is no kernel `{name}`: name it in `lagrange_gpu::kernels!` and build again"
                )
            }
            Self::Mismatched { name } => {
                write!(out, "the kernel `{name}` has other types than the function: build the kernels again")
            }
            Self::Differs { name, index } => {
                write!(
                    out,
                    "row {index} of the kernel `{name}` is not that of the function: build the kernels again"
                )
            }
            Self::OutOfMemory => out.write_str("the memory of the processor is too small"),
            Self::Driver { code } => write!(out, "the driver reports an error: {code}"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Unreadable { source, .. } => Some(source),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loading(code: CUresult) -> Error {
        Error::of_loading(DriverError(code), || "sm_90".to_owned())
    }

    #[test]
    fn codes_of_the_driver_are_told_apart() {
        assert!(matches!(loading(CUresult::CUDA_ERROR_INVALID_PTX), Error::Refused { .. }));
        assert!(matches!(loading(CUresult::CUDA_ERROR_OUT_OF_MEMORY), Error::OutOfMemory));
        assert!(matches!(loading(CUresult::CUDA_ERROR_LAUNCH_FAILED), Error::Driver { .. }));
        let old = loading(CUresult::CUDA_ERROR_UNSUPPORTED_PTX_VERSION);
        assert!(matches!(&old, Error::WrongVersion { needed } if needed == "sm_90"), "{old}");
    }
}
