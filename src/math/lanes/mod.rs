//! Packed numbers: one register of the machine's vector unit. The available instructions are detected once, at run time: see
//! [`InstructionSet`].
//!
//! A value of these types may only exist on a machine that has its instructions. Hence the types do not leave the crate, and
//! users go by [`InstructionSet::detected`].
//!
//! Files:
//!
//! - `neon.rs`: Packed numbers by NEON, which every AArch64 has. `register` says why the unsafe blocks here are safe.
//! - `register.rs`: What all packed types share, whatever their instructions.
//! - `simd128.rs`: Packed numbers by WebAssembly's 128-bit vectors.
//! - `x86.rs`: Packed numbers by SSE2, AVX2 and AVX-512. `register` says why the unsafe blocks here are safe.

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
#[macro_use]
mod register;

#[cfg(target_arch = "aarch64")]
mod neon;
#[cfg(target_arch = "wasm32")]
mod simd128;
#[cfg(target_arch = "x86_64")]
mod x86;

#[cfg(target_arch = "aarch64")]
pub(crate) use neon::{F32x4, F64x2};
#[cfg(target_arch = "wasm32")]
pub(crate) use simd128::{F32x4, F64x2};
#[cfg(target_arch = "x86_64")]
pub(crate) use x86::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};

use super::lane::{Kernel, Lane};

/// Runs a kernel for one strand, or for several in contact, as a function of its own: inlined at every call it would be compiled
/// many times over. It is compiled twice, since AVX2 encodes the same operations in fewer instructions and packs two or three
/// numbers treated alike. (Both give the same bits.)
#[inline(always)]
pub(super) fn call_scalar<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if x86::has_avx2() {
        return x86::call_scalar(kernel);
    }
    #[inline(never)]
    fn with<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
    with(kernel)
}

/// A piece of work on four numbers of double precision at a time, in as few registers as the machine has for them. Every number of
/// registers gives the same bits. See [`Kernel`] for what must be inlined.
pub(crate) trait KernelOfFour {
    /// Its result.
    type Output;
    /// Does the work, four numbers in `REGISTERS` of type `T`.
    fn run<T: Lane, const REGISTERS: usize>(self) -> Self::Output;
}

/// Runs a kernel of four, as a function of its own.
#[inline(always)]
pub(crate) fn call_of_four<K: KernelOfFour>(kernel: K) -> K::Output {
    struct Run<T, K, const REGISTERS: usize>(K, std::marker::PhantomData<T>);
    impl<T: Lane, K: KernelOfFour, const REGISTERS: usize> Kernel for Run<T, K, REGISTERS> {
        type Output = K::Output;
        #[inline(always)]
        fn run(self) -> Self::Output {
            self.0.run::<T, REGISTERS>()
        }
    }
    #[inline(always)]
    fn call<T: Lane, K: KernelOfFour, const REGISTERS: usize>(kernel: K) -> K::Output {
        T::call(Run::<T, K, REGISTERS>(kernel, std::marker::PhantomData))
    }
    #[cfg(target_arch = "x86_64")]
    if x86::has_avx2() {
        return call::<F64x4, K, 1>(kernel);
    }
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
    return call::<F64x2, K, 2>(kernel);
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32")))]
    return call::<f64, K, 4>(kernel);
}

/// The vector instructions that kernels are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum InstructionSet {
    /// None: strands go one by one.
    Scalar = 1,
    /// What every machine of the architecture has: SSE2 on x86-64, NEON on AArch64, SIMD128 on WebAssembly; 2 lanes of f64, 4 of
    /// f32. Elsewhere the same as `Scalar`.
    Baseline = 2,
    /// AVX2: 4 lanes of f64, 8 of f32.
    Avx2 = 3,
    /// AVX-512 (F, BW, DQ, VL): 8 lanes of f64, 16 of f32.
    Avx512 = 4,
}

impl InstructionSet {
    /// The best set of this machine.
    pub fn detected() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if x86::has_avx512() {
                return Self::Avx512;
            }
            if x86::has_avx2() {
                return Self::Avx2;
            }
        }
        if cfg!(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32")) {
            Self::Baseline
        } else {
            Self::Scalar
        }
    }

    /// The set of a number of the C ABI.
    pub fn from_u32(value: u32) -> Option<Self> {
        [Self::Scalar, Self::Baseline, Self::Avx2, Self::Avx512].into_iter().find(|candidate| *candidate as u32 == value)
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}
