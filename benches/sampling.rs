//! Reading and storing a head of hair: the speed of sampling beside a copy of as many bytes, the memory of a strand, and the cost
//! of adding and removing strands.
//!
//! Sampling: 150,000 strands of 5 elements, 16 points each, into the caller's floats through the C ABI, on one thread and on two.
//! Each round times a copy (`memcpy`) of the same bytes and every type of output once, so that other programs affect all alike.
//! The figures are the least and the median over the rounds, with the processor time (medians), which excludes other programs.
//!
//! `cargo bench --bench sampling -- [--csv FILE] [--rounds 15] [--strands 150000] [--only memory|population|sampling]`
#![allow(unsafe_code)] // calls of the C ABI, and a counting allocator

use std::alloc::{GlobalAlloc, Layout, System};
use std::fmt::Write as _;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use superhelix::internals::capi::base::errors::SHX_OK;
use superhelix::internals::capi::base::guard::shx_solver;
use superhelix::internals::capi::base::types::*;
use superhelix::internals::capi::hair::strand_def::{shx_strand_def, shx_strand_def_init};
use superhelix::internals::capi::hair::strands::{shx_solver_add_strands, shx_solver_remove_strands};
use superhelix::internals::capi::reading::sampling::{shx_sample_def, shx_sample_def_init, shx_solver_sample_strands};
use superhelix::internals::capi::simulation::solver::{shx_solver_create, shx_solver_destroy};
use superhelix::internals::capi::simulation::solver_def::{shx_solver_def, shx_solver_def_init};
use superhelix::internals::capi::simulation::step::shx_solver_step;
use superhelix::{Integrator, Solver, SolverOptions, StrandDef};

/// Bytes in use: as requested, and as rounded up by the allocator (glibc: one word more, in units of 16, at least 32).
struct Counting;
static ASKED: AtomicUsize = AtomicUsize::new(0);
static TAKEN: AtomicUsize = AtomicUsize::new(0);

fn chunk(size: usize) -> usize {
    (size + 8).next_multiple_of(16).max(32)
}

// SAFETY: hands everything on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ASKED.fetch_add(layout.size(), Ordering::Relaxed);
        TAKEN.fetch_add(chunk(layout.size()), Ordering::Relaxed);
        // SAFETY: the caller's layout.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        ASKED.fetch_sub(layout.size(), Ordering::Relaxed);
        TAKEN.fetch_sub(chunk(layout.size()), Ordering::Relaxed);
        // SAFETY: the caller's pointer and layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

const ELEMENTS: usize = 5;
const POINTS: usize = 16;

/// A head of hair behind the C ABI.
struct Head {
    solver: *mut shx_solver,
    ids: Vec<shx_strand_id>,
}

impl Head {
    fn new(strands: usize, threads: u32) -> Self {
        let mut solver = null_mut();
        let mut ids = vec![shx_strand_id { bits: 0 }; strands];
        let defs = definitions(strands);
        // SAFETY: handles, definitions and ids of the right sizes.
        unsafe {
            let mut def = std::mem::MaybeUninit::<shx_solver_def>::uninit();
            assert_eq!(shx_solver_def_init(def.as_mut_ptr(), size_of::<shx_solver_def>()), SHX_OK);
            let mut def = def.assume_init();
            def.worker_count = threads;
            assert_eq!(shx_solver_create(&raw const def, &raw mut solver), SHX_OK);
            let result = shx_solver_add_strands(solver, defs.0.as_ptr(), size_of::<shx_strand_def>(), strands, ids.as_mut_ptr());
            assert_eq!(result, SHX_OK);
            assert_eq!(shx_solver_step(solver, 1.0 / 60.0, 1, null_mut()), SHX_OK);
        }
        Self { solver, ids }
    }

    fn sample(&self, outputs: [Option<shx_output>; 3]) {
        let mut def = std::mem::MaybeUninit::<shx_sample_def>::uninit();
        // SAFETY: room for one structure, which the call fills.
        let def = unsafe {
            shx_sample_def_init(def.as_mut_ptr(), size_of::<shx_sample_def>());
            shx_sample_def { points_per_strand: POINTS as u32, ..def.assume_init() }
        };
        let pointers = outputs.each_ref().map(|output| output.as_ref().map_or(null(), std::ptr::from_ref));
        // SAFETY: this head's handle and ids; outputs over memory of the caller.
        let result = unsafe {
            shx_solver_sample_strands(
                self.solver,
                self.ids.as_ptr(),
                self.ids.len(),
                &raw const def,
                pointers[0],
                pointers[1],
                pointers[2],
            )
        };
        assert_eq!(result, SHX_OK);
    }
}

impl Drop for Head {
    fn drop(&mut self) {
        // SAFETY: this head's handle.
        unsafe { shx_solver_destroy(self.solver) };
    }
}

/// Definitions and their natural shapes: every strand has its own shape and length.
fn definitions(strands: usize) -> (Vec<shx_strand_def>, Vec<[[f64; 3]; ELEMENTS]>) {
    let shapes: Vec<[[f64; 3]; ELEMENTS]> = (0..strands)
        .map(|strand| {
            let bend = 10.0 + 20.0 * (strand % 997) as f64 / 997.0;
            std::array::from_fn(|element| [2.0, bend, element as f64])
        })
        .collect();
    let mut def = std::mem::MaybeUninit::<shx_strand_def>::uninit();
    // SAFETY: of the size that is said.
    let def = unsafe {
        assert_eq!(shx_strand_def_init(def.as_mut_ptr(), size_of::<shx_strand_def>()), SHX_OK);
        def.assume_init()
    };
    let defs = (0..strands)
        .map(|strand| {
            let mut def = def;
            def.element_count = ELEMENTS as u32;
            def.length = 0.1 + 1e-6 * (strand % 100_000) as f64;
            def.natural_curvatures = shapes[strand].as_ptr().cast();
            def.root.origin = [1e-3 * (strand % 388) as f64, 1e-3 * (strand / 388) as f64, 1.7];
            def
        })
        .collect();
    (defs, shapes)
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

fn milliseconds(work: impl FnOnce()) -> f64 {
    let started = Instant::now();
    work();
    started.elapsed().as_secs_f64() * 1e3
}

fn processor_time(work: impl FnOnce()) -> f64 {
    both_times(work).1
}

/// Milliseconds on the clock, and of processor time of all threads.
fn both_times(work: impl FnOnce()) -> (f64, f64) {
    let processor = || {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 * 1e-6
    };
    let before = processor();
    let clock = milliseconds(work);
    (clock, processor() - before)
}

/// A type of output: a name, and bytes per point of points, frames and velocities.
struct Kind {
    name: &'static str,
    formats: [Option<(u32, usize)>; 3],
}

const KINDS: [Kind; 5] = [
    Kind { name: "points f32x3", formats: [Some((SHX_FORMAT_F32X3, 12)), None, None] },
    Kind { name: "points f32x4 with radius", formats: [Some((SHX_FORMAT_F32X4, 16)), None, None] },
    Kind { name: "points f32x3, frames f32x4", formats: [Some((SHX_FORMAT_F32X3, 12)), Some((SHX_FORMAT_F32X4, 16)), None] },
    Kind { name: "points f32x3, velocities f32x3", formats: [Some((SHX_FORMAT_F32X3, 12)), None, Some((SHX_FORMAT_F32X3, 12))] },
    Kind { name: "points f64x3", formats: [Some((SHX_FORMAT_F64X3, 24)), None, None] },
];

fn sampling(strands: usize, rounds: usize, csv: &mut String) {
    let items = strands * POINTS;
    let heads = [Head::new(strands, 1), Head::new(strands, 2)];
    let mut memory: Vec<Vec<u8>> = [32, 16, 12].iter().map(|bytes| vec![1_u8; items * bytes]).collect();
    let source = vec![7_u8; items * 28];
    // [kind][0: the copy, 1, 2: threads, 3, 4: their processor time], one value per round.
    let mut times: Vec<[Vec<f64>; 5]> = KINDS.iter().map(|_| Default::default()).collect();
    for round in 0..=rounds {
        for (kind, times) in KINDS.iter().zip(&mut times) {
            let bytes: usize = kind.formats.iter().flatten().map(|(_, bytes)| items * bytes).sum();
            let copy = milliseconds(|| {
                let mut from = 0;
                for (memory, format) in memory.iter_mut().zip(&kind.formats) {
                    let bytes = format.map_or(0, |(_, bytes)| items * bytes);
                    memory[..bytes].copy_from_slice(&source[from..from + bytes]);
                    from += bytes;
                }
                assert_eq!(from, bytes);
            });
            let mut outputs = [const { None }; 3];
            for ((output, memory), format) in outputs.iter_mut().zip(&mut memory).zip(&kind.formats) {
                *output = format.map(|(format, _)| shx_output {
                    data: memory.as_mut_ptr().cast(),
                    stride: 0,
                    count: items,
                    format,
                    reserved: 0,
                });
            }
            let each = heads.each_ref().map(|head| both_times(|| head.sample(outputs)));
            // The first round touches memory for the first time.
            if round > 0 {
                times[0].push(copy);
                for (thread, (clock, processor)) in each.into_iter().enumerate() {
                    times[1 + thread].push(clock);
                    times[3 + thread].push(processor);
                }
            }
        }
    }
    println!(
        "{strands} strands of {ELEMENTS} elements, {POINTS} points each, ms: least of {rounds} rounds (median); processor time, median"
    );
    println!(
        "{:32} {:>14} {:>16} {:>16} {:>12} {:>7} {:>7}",
        "what", "copy", "1 thread", "2 threads", "processor", "ratio 1", "ratio 2"
    );
    for (kind, times) in KINDS.iter().zip(&times) {
        let middle = times.each_ref().map(|times| median(times));
        let least = times.each_ref().map(|times| times.iter().copied().fold(f64::INFINITY, f64::min));
        println!(
            "{:32} {:6.2} ({:5.2}) {:7.2} ({:6.2}) {:7.2} ({:6.2}) {:5.1} {:5.1} {:7.2} {:7.2}",
            kind.name,
            least[0],
            middle[0],
            least[1],
            middle[1],
            least[2],
            middle[2],
            middle[3],
            middle[4],
            least[1] / least[0],
            least[2] / least[0]
        );
        let name = kind.name.replace(',', " and");
        writeln!(
            csv,
            "sampling,{name},{strands},{:.4},{:.4},{:.4},{:.4},{:.4}",
            least[0], least[1], least[2], middle[3], middle[4]
        )
        .expect("a string");
    }
}

/// One pass along each strand in f64, strand after strand, into the same floats: the baseline for bulk sampling.
fn one_by_one(strands: usize, rounds: usize, csv: &mut String) {
    let mut solver = Solver::new(SolverOptions::default()).expect("a solver");
    let defs: Vec<StrandDef> = (0..strands)
        .map(|strand| {
            let mut def = StrandDef::straight(0.1 + 1e-6 * (strand % 100_000) as f64, ELEMENTS);
            let bend = 10.0 + 20.0 * (strand % 997) as f64 / 997.0;
            def.natural.iter_mut().enumerate().for_each(|(element, row)| *row = [2.0, bend, element as f64]);
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).expect("strands");
    drop(defs);
    let mut points = vec![[0.0_f32; 3]; strands * POINTS];
    let (mut clock, mut processor) = (Vec::new(), Vec::new());
    for _ in 0..rounds {
        let (a, b) = both_times(|| {
            let put = |strand: usize, point: usize, sample: &superhelix::Sample| {
                points[strand * POINTS + point] = sample.position.map(|number| number as f32).into();
            };
            solver.sample_strands(&ids, POINTS, put).expect("samples");
        });
        clock.push(a);
        processor.push(b);
    }
    let least = clock.iter().copied().fold(f64::INFINITY, f64::min);
    println!("one by one, points, frames and velocities in f64: {least:.1} ms, processor time {:.1} ms", median(&processor));
    writeln!(csv, "one by one,,{strands},{least:.4},,,{:.4},", median(&processor)).expect("a string");
}

fn population(strands: usize, csv: &mut String) {
    println!("adding and removing, ms of processor time");
    for count in [strands / 10, strands] {
        let defs = definitions(count);
        let (mut add, mut remove, mut again) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..5 {
            let mut solver = null_mut();
            let mut ids = vec![shx_strand_id { bits: 0 }; count];
            // SAFETY: handles, definitions and ids of the right sizes.
            unsafe {
                assert_eq!(shx_solver_create(null(), &raw mut solver), SHX_OK);
                let size = size_of::<shx_strand_def>();
                add.push(processor_time(|| {
                    assert_eq!(shx_solver_add_strands(solver, defs.0.as_ptr(), size, count, ids.as_mut_ptr()), SHX_OK);
                }));
                let odd: Vec<shx_strand_id> = ids.iter().skip(1).step_by(2).copied().collect();
                remove.push(processor_time(|| assert_eq!(shx_solver_remove_strands(solver, odd.as_ptr(), odd.len()), SHX_OK)));
                again.push(processor_time(|| {
                    assert_eq!(shx_solver_add_strands(solver, defs.0.as_ptr(), size, odd.len(), ids.as_mut_ptr()), SHX_OK);
                }));
                shx_solver_destroy(solver);
            }
        }
        let [add, remove, again] = [&add, &remove, &again].map(|times| median(times));
        println!("{count:9} added {add:8.2}   every other one removed {remove:8.2}   as many added again {again:8.2}");
        writeln!(csv, "population,,{count},{add:.4},{remove:.4},{again:.4},,").expect("a string");
    }
}

/// Bytes per strand: as reported by the solver, as requested from the allocator, and as taken by it.
fn memory(csv: &mut String) {
    const STRANDS: usize = 2000;
    println!("bytes per strand ({STRANDS} strands, each of a shape of its own, after four steps): reported, requested, taken");
    for integrator in [Integrator::SecondOrder, Integrator::ImplicitEuler, Integrator::LinearlyImplicit] {
        for elements in [5, 10, 50] {
            let held = |strands: usize| {
                let before = (ASKED.load(Ordering::Relaxed), TAKEN.load(Ordering::Relaxed));
                let mut options = SolverOptions::default();
                options.step.integrator = integrator;
                let mut solver = Solver::new(options).expect("a solver");
                {
                    let defs: Vec<StrandDef> = (0..strands)
                        .map(|strand| {
                            let mut def = StrandDef::straight(0.1, elements);
                            def.material.viscosity = 0.01;
                            def.material.air_drag = 5e-6;
                            let bend = 1.0 + 4.0 * strand as f64 / STRANDS as f64;
                            def.natural.iter_mut().enumerate().for_each(|(e, row)| *row = [0.1, bend, 1e-3 * e as f64]);
                            def
                        })
                        .collect();
                    solver.add_strands(&defs).expect("strands");
                }
                for _ in 0..4 {
                    solver.step(1e-3, 1).expect("a step");
                }
                let now = (ASKED.load(Ordering::Relaxed), TAKEN.load(Ordering::Relaxed));
                [solver.memory_usage() as f64, (now.0 - before.0) as f64, (now.1 - before.1) as f64]
            };
            // The difference cancels what does not depend on the number of strands, such as scratch memory.
            let (few, many) = (held(STRANDS / 2), held(STRANDS));
            let [told, asked, taken] = std::array::from_fn(|k| (many[k] - few[k]) / (STRANDS / 2) as f64);
            println!("{:20} N = {elements:3}: {told:8.0} {asked:8.0} {taken:8.0}", format!("{integrator:?}"));
            writeln!(csv, "memory,{integrator:?},{elements},{told:.1},{asked:.1},{taken:.1},,").expect("a string");
        }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| arguments.iter().position(|a| a == name).and_then(|at| arguments.get(at + 1));
    let rounds: usize = value("--rounds").map_or(15, |text| text.parse().expect("--rounds N"));
    let strands: usize = value("--strands").map_or(150_000, |text| text.parse().expect("--strands N"));
    // sampling: copy, one thread, two (ms, the least of all rounds), processor time of the latter two (medians); population:
    // adding, removing every other one, adding as many (ms of processor time); memory: bytes per strand, reported, requested and
    // taken.
    let mut csv = String::from("kind,what,count,a,b,c,d,e\n");
    let wants = |part: &str| value("--only").is_none_or(|only| only == part);
    if wants("memory") {
        memory(&mut csv);
    }
    if wants("population") {
        population(strands, &mut csv);
    }
    if wants("sampling") {
        sampling(strands, rounds, &mut csv);
        one_by_one(strands, rounds, &mut csv);
    }
    if let Some(path) = value("--csv") {
        std::fs::write(path, csv).unwrap_or_else(|error| panic!("{path}: {error}"));
        println!("written: {path}");
    }
}
