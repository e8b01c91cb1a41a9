//! The machine's peak: multiplications and additions per second in its widest registers, and bytes copied per second.
#![allow(unsafe_code)]

use std::hint::black_box;
use std::time::Instant;

use superhelix::InstructionSet;

use crate::crowd::processor_seconds;
use crate::statistics::Summary;

/// Independent chains of multiplications, and as many of additions.
const CHAINS: usize = 10;
const REPEATS: usize = 20_000;
const SAMPLES: usize = 15;

/// A function that does `2 · CHAINS · REPEATS` operations on registers, half of them multiplications.
macro_rules! operations {
    ($name:ident, $features:literal, $scalar:ty, $set1:ident, $mul:ident, $add:ident, $lanes:literal) => {
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = $features)]
        fn $name() -> usize {
            use std::arch::x86_64::*;
            let mut products = [$set1(black_box(1.0 as $scalar)); CHAINS];
            let mut sums = [$set1(black_box(0.0 as $scalar)); CHAINS];
            let (factor, term) = ($set1(black_box(1.000_001 as $scalar)), $set1(black_box(1e-3 as $scalar)));
            for _ in 0..REPEATS {
                for chain in 0..CHAINS {
                    products[chain] = $mul(products[chain], factor);
                    sums[chain] = $add(sums[chain], term);
                }
            }
            black_box((products, sums));
            2 * CHAINS * REPEATS * $lanes
        }
    };
}
operations!(avx512_f64, "avx512f", f64, _mm512_set1_pd, _mm512_mul_pd, _mm512_add_pd, 8);
operations!(avx512_f32, "avx512f", f32, _mm512_set1_ps, _mm512_mul_ps, _mm512_add_ps, 16);
operations!(avx2_f64, "avx2", f64, _mm256_set1_pd, _mm256_mul_pd, _mm256_add_pd, 4);
operations!(avx2_f32, "avx2", f32, _mm256_set1_ps, _mm256_mul_ps, _mm256_add_ps, 8);
operations!(sse2_f64, "sse2", f64, _mm_set1_pd, _mm_mul_pd, _mm_add_pd, 2);
operations!(sse2_f32, "sse2", f32, _mm_set1_ps, _mm_mul_ps, _mm_add_ps, 4);

/// The machine's peak.
#[derive(Debug, Clone, Copy)]
pub struct Peak {
    /// Multiplications and additions per second, one core, f64; NaN if not measured.
    pub f64_operations: f64,
    /// The same, f32.
    pub f32_operations: f64,
    /// Bytes per second, counting both reads and writes, one core copying 128 MiB to 128 MiB.
    pub copy: f64,
    /// The same, two cores each copying one half.
    pub copy_on_two: f64,
    /// The fraction of wall-clock time for which one measuring thread had the processor: 1 on an otherwise idle machine.
    pub ours: f64,
}

#[cfg(target_arch = "x86_64")]
fn operations(set: InstructionSet, wide: bool) -> usize {
    // SAFETY: the set was detected on this machine; every x86-64 has SSE2.
    unsafe {
        match (set, wide) {
            (InstructionSet::Avx512, true) => avx512_f64(),
            (InstructionSet::Avx512, false) => avx512_f32(),
            (InstructionSet::Avx2, true) => avx2_f64(),
            (InstructionSet::Avx2, false) => avx2_f32(),
            (_, true) => sse2_f64(),
            (_, false) => sse2_f32(),
        }
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn operations(_set: InstructionSet, _wide: bool) -> usize {
    0
}

fn operations_a_second(set: InstructionSet, wide: bool) -> f64 {
    let rates: Vec<_> = (0..SAMPLES)
        .map(|_| {
            let started = processor_seconds();
            let done: usize = (0..20).map(|_| operations(set, wide)).sum();
            done as f64 / (processor_seconds() - started)
        })
        .collect();
    let rate = Summary::of(&rates).median;
    if rate > 0.0 { rate } else { f64::NAN }
}

fn copied_a_second(threads: usize) -> f64 {
    const BYTES: usize = 1 << 27;
    let from = vec![1_u64; BYTES / 8];
    let mut to = vec![2_u64; BYTES / 8];
    let part = from.len() / threads;
    let rates: Vec<_> = (0..SAMPLES)
        .map(|_| {
            let (wall, processor) = (Instant::now(), processor_seconds());
            if threads == 1 {
                to.copy_from_slice(black_box(&from));
            } else {
                std::thread::scope(|scope| {
                    for (to, from) in to.chunks_mut(part).zip(from.chunks(part)) {
                        scope.spawn(move || to.copy_from_slice(black_box(from)));
                    }
                });
            }
            black_box(&to);
            let seconds = if threads == 1 { processor_seconds() - processor } else { wall.elapsed().as_secs_f64() };
            2.0 * BYTES as f64 / seconds
        })
        .collect();
    Summary::of(&rates).median
}

impl Peak {
    /// Measures.
    pub fn measure() -> Self {
        let set = InstructionSet::detected();
        let (wall, processor) = (Instant::now(), processor_seconds());
        let (f64_operations, f32_operations) = (operations_a_second(set, true), operations_a_second(set, false));
        let copy = copied_a_second(1);
        let ours = (processor_seconds() - processor) / wall.elapsed().as_secs_f64();
        Self { f64_operations, f32_operations, copy, copy_on_two: copied_a_second(2), ours }
    }
}

/// The processor's name and the commit, if known.
pub fn description() -> (String, String) {
    let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
    let cpu = read("/proc/cpuinfo");
    let name =
        cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':').map(|(_, name)| name.trim().to_owned()));
    let git = std::process::Command::new("git").args(["describe", "--always", "--dirty", "--abbrev=12"]).output();
    let commit = git.ok().filter(|output| output.status.success());
    let commit = commit.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    (name.unwrap_or_else(|| std::env::consts::ARCH.into()), commit.unwrap_or_default())
}
