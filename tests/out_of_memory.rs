//! Where memory runs out: calls of the C API whose memory grows with the host's numbers report it, change nothing and leak nothing. Two allocators: one that
//! has a fixed number of bytes, like `ulimit -v`, and one that refuses the n-th large block. Neither counts what the test harness's thread does meanwhile.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::c_void;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicI64, AtomicIsize, AtomicUsize, Ordering};

use superhelix::internals::capi::base::errors::{SHX_ERROR_OUT_OF_MEMORY, SHX_OK, shx_result};
use superhelix::internals::capi::base::guard::shx_solver;
use superhelix::internals::capi::base::types::*;
use superhelix::internals::capi::hair::roots::shx_solver_get_root_frames;
use superhelix::internals::capi::hair::strand_def::{shx_strand_def, shx_strand_def_init};
use superhelix::internals::capi::hair::strands::{shx_solver_add_strands, shx_solver_strand_count, shx_solver_strand_lengths};
use superhelix::internals::capi::reading::sampling::shx_solver_sample_at;
use superhelix::internals::capi::scene::bodies::{shx_solver_add_bodies, shx_solver_body_count};
use superhelix::internals::capi::scene::body_def::{SHX_SHAPE_MESH, shx_body_def, shx_body_def_init};
use superhelix::internals::capi::scene::constraints::{shx_constraint_def, shx_constraint_def_init, shx_solver_add_constraints};
use superhelix::internals::capi::scene::contact_events::shx_solver_keep_contact_events;
use superhelix::internals::capi::simulation::solver::{shx_solver_create, shx_solver_destroy};
use superhelix::internals::capi::simulation::state::{shx_solver_restore, shx_solver_snapshot, shx_solver_state_hash};

/// The contract's limit: smaller blocks cannot fail softly.
const LARGE: usize = 1 << 16;
/// What there is beyond the budget for small things: names, texts of errors, a worker's scratch memory.
const SLACK: usize = 1 << 20;

struct Scarce;

/// Bytes allocated less bytes freed, but for the harness's thread.
static HELD: AtomicIsize = AtomicIsize::new(0);
static BUDGET: AtomicUsize = AtomicUsize::new(usize::MAX);
/// Large blocks until one is refused; negative: none is.
static UNTIL: AtomicI64 = AtomicI64::new(-1);

thread_local! {
    /// Its address tells threads apart.
    static MARK: u8 = const { 0 };
}
/// Where the first thread of the process to allocate, which is the harness's, has its mark.
static HARNESS: AtomicUsize = AtomicUsize::new(0);

/// Whether this thread's allocations count. The harness's own thread also allocates while the test runs.
fn counts() -> bool {
    MARK.with(|mark| {
        let here = std::ptr::from_ref(mark).addr();
        match HARNESS.compare_exchange(0, here, Ordering::Relaxed, Ordering::Relaxed) {
            Ok(_) => false,
            Err(harness) => harness != here,
        }
    })
}

/// Bytes that are held now.
fn held() -> usize {
    usize::try_from(HELD.load(Ordering::Relaxed)).unwrap_or(0)
}

fn refuses(size: usize) -> bool {
    if size >= LARGE && UNTIL.load(Ordering::Relaxed) >= 0 && UNTIL.fetch_sub(1, Ordering::Relaxed) == 0 {
        return true;
    }
    let slack = if size >= LARGE { 0 } else { SLACK };
    held().saturating_add(size) > BUDGET.load(Ordering::Relaxed).saturating_add(slack)
}

// SAFETY: hands everything on to the system's allocator, or refuses it as an allocator may.
unsafe impl GlobalAlloc for Scarce {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if counts() {
            if refuses(layout.size()) {
                return null_mut();
            }
            HELD.fetch_add(layout.size().cast_signed(), Ordering::Relaxed);
        }
        // SAFETY: the caller's layout.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        if counts() {
            HELD.fetch_sub(layout.size().cast_signed(), Ordering::Relaxed);
        }
        // SAFETY: the caller's pointer and layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static SCARCE: Scarce = Scarce;

fn filled<T>(init: unsafe extern "C" fn(*mut T, usize) -> i32) -> T {
    let mut made = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(init(made.as_mut_ptr(), size_of::<T>()), SHX_OK);
        made.assume_init()
    }
}

fn new_solver() -> *mut shx_solver {
    let mut solver = null_mut();
    // SAFETY: room for a handle.
    unsafe { assert_eq!(shx_solver_create(null(), &raw mut solver), SHX_OK) };
    solver
}

fn strands(count: usize) -> Vec<shx_strand_def> {
    let mut def = filled(shx_strand_def_init);
    (def.length, def.element_count) = (0.1, 8);
    vec![def; count]
}

fn add(solver: *mut shx_solver, defs: &[shx_strand_def], ids: &mut [shx_strand_id]) -> shx_result {
    // SAFETY: a living handle, definitions and room for as many ids.
    unsafe { shx_solver_add_strands(solver, defs.as_ptr(), size_of::<shx_strand_def>(), defs.len(), ids.as_mut_ptr()) }
}

/// The state that a call must preserve.
fn state(solver: *mut shx_solver) -> (u64, usize, usize) {
    let (mut hash, mut strands, mut bodies) = (0, 0, 0);
    // SAFETY: a living handle and room for numbers.
    unsafe {
        assert_eq!(shx_solver_state_hash(solver, &raw mut hash), SHX_OK);
        assert_eq!(shx_solver_strand_count(solver, &raw mut strands), SHX_OK);
        assert_eq!(shx_solver_body_count(solver, &raw mut bodies), SHX_OK);
    }
    (hash, strands, bodies)
}

/// Calls with ever more memory until there is enough: each time too little is an error that changes nothing and keeps next to nothing. `undo`
/// makes the solver for the next try.
fn starve(what: &str, mut make: impl FnMut() -> *mut shx_solver, mut call: impl FnMut(*mut shx_solver) -> shx_result) {
    let mut refused = 0;
    // So many bytes and no more, in steps that grow.
    let mut budget = 0_usize;
    loop {
        let solver = make();
        let before = state(solver);
        let before_call = held();
        BUDGET.store(before_call + budget, Ordering::Relaxed);
        let result = call(solver);
        BUDGET.store(usize::MAX, Ordering::Relaxed);
        if result == SHX_OK {
            // SAFETY: this loop's handle.
            unsafe { shx_solver_destroy(solver) };
            break;
        }
        assert_eq!(result, SHX_ERROR_OUT_OF_MEMORY, "{what}, {budget} bytes");
        assert_eq!(state(solver), before, "{what}, {budget} bytes");
        refused += 1;
        // Lists that grew keep their room; nothing else may stay.
        let left = held().saturating_sub(before_call);
        assert!(left <= budget, "{what}: {left} bytes stay of {budget}");
        // And with memory it works on the same solver.
        assert_eq!(call(solver), SHX_OK, "{what}, afterwards");
        // SAFETY: the same.
        unsafe { shx_solver_destroy(solver) };
        budget += (budget / 4).max(LARGE);
        assert!(budget < 1 << 30, "{what} never has enough");
    }
    assert!(refused > 0, "{what} was never short of memory");
    // The n-th large block is refused, for every n.
    let mut blocks = 0;
    loop {
        let solver = make();
        let before = state(solver);
        UNTIL.store(blocks, Ordering::Relaxed);
        let result = call(solver);
        let was_refused = UNTIL.swap(-1, Ordering::Relaxed) < 0;
        if result != SHX_OK {
            assert_eq!(result, SHX_ERROR_OUT_OF_MEMORY, "{what}, block {blocks}");
            assert_eq!(state(solver), before, "{what}, block {blocks}");
        }
        // SAFETY: the same.
        unsafe { shx_solver_destroy(solver) };
        if !was_refused {
            break;
        }
        assert_eq!(result, SHX_ERROR_OUT_OF_MEMORY, "{what}, block {blocks} was refused");
        blocks += 1;
        assert!(blocks < 10_000);
    }
    println!("{what}: refused with {refused} budgets and at each of {blocks} large blocks");
    assert!(blocks > 0, "{what} takes no large block");
}

// One test: the allocator is the process's.
#[test]
fn calls_that_find_no_memory_say_so_and_change_nothing() {
    // On a thread of its own, since the harness may run a lone test on its main thread.
    std::thread::spawn(every_call).join().expect("every call passes");
}

fn every_call() {
    const COUNT: usize = 12_000;
    let defs = strands(COUNT);
    let mut ids = vec![shx_strand_id { bits: 0 }; COUNT];
    starve("shx_solver_add_strands", new_solver, |solver| add(solver, &defs, &mut ids));

    // Long strands, with rows of their own.
    let rows = vec![[0.0, 3.0, 0.0]; 4000];
    let mut long = filled(shx_strand_def_init);
    (long.length, long.element_count, long.natural_curvatures) = (2.0, 4000, rows.as_ptr().cast());
    let long = vec![long; 3];
    budgets_only("shx_solver_add_strands, long ones", new_solver, |solver| add(solver, &long, &mut ids[..3]));

    // A wavy sheet.
    const SIDE: u32 = 60;
    let vertices: Vec<[f64; 3]> =
        (0..SIDE * SIDE).map(|k| [f64::from(k % SIDE) * 0.01, f64::from(k / SIDE) * 0.01, 0.002 * f64::from(k % 7)]).collect();
    let corner = |x: u32, y: u32| y * SIDE + x;
    let triangles: Vec<[u32; 3]> = (0..SIDE - 1)
        .flat_map(|y| (0..SIDE - 1).map(move |x| (x, y)))
        .flat_map(|(x, y)| {
            [[corner(x, y), corner(x + 1, y), corner(x, y + 1)], [corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)]]
        })
        .collect();
    let mut sheet: shx_body_def = filled(shx_body_def_init);
    (sheet.shape, sheet.sides) = (SHX_SHAPE_MESH, superhelix::internals::capi::scene::body_def::SHX_SIDES_BOTH);
    sheet.vertices =
        shx_input { data: vertices.as_ptr().cast(), stride: 0, count: vertices.len(), format: SHX_FORMAT_F64X3, reserved: 0 };
    (sheet.triangles, sheet.triangle_count) = (triangles.as_ptr().cast(), triangles.len());
    let mut body = shx_body_id { bits: 0 };
    // SAFETY: a living handle, a definition with its arrays, room for an id.
    let add_sheet =
        |solver| unsafe { shx_solver_add_bodies(solver, &raw const sheet, size_of::<shx_body_def>(), 1, &raw mut body) };
    budgets_only("shx_solver_add_bodies", new_solver, add_sheet);

    let with_strands = || {
        let solver = new_solver();
        let mut ids = vec![shx_strand_id { bits: 0 }; COUNT];
        assert_eq!(add(solver, &defs, &mut ids), SHX_OK);
        solver
    };
    let ids_of = |solver: *mut shx_solver| {
        let mut ids = vec![shx_strand_id { bits: 0 }; COUNT];
        // SAFETY: a living handle and room for the ids.
        unsafe {
            assert_eq!(superhelix::internals::capi::hair::strands::shx_solver_strand_ids(solver, ids.as_mut_ptr(), COUNT), SHX_OK)
        };
        ids
    };
    let mut pins = vec![filled(shx_constraint_def_init); COUNT];
    let mut pin_ids = vec![shx_constraint_id { bits: 0 }; COUNT];
    let prepared = std::cell::RefCell::new(Vec::new());
    let with_pins = || {
        let solver = with_strands();
        *prepared.borrow_mut() = ids_of(solver);
        solver
    };
    starve("shx_solver_add_constraints", with_pins, |solver| {
        for (pin, id) in pins.iter_mut().zip(prepared.borrow().iter()) {
            pin.strand = *id;
        }
        // SAFETY: a living handle, definitions and room for as many ids.
        unsafe { shx_solver_add_constraints(solver, pins.as_ptr(), size_of::<shx_constraint_def>(), COUNT, pin_ids.as_mut_ptr()) }
    });

    // Readers.
    let mut lengths = vec![0.0; COUNT];
    starve("shx_solver_strand_lengths", with_pins, |solver| {
        // SAFETY: a living handle, ids and room for as many numbers.
        unsafe { shx_solver_strand_lengths(solver, prepared.borrow().as_ptr(), COUNT, lengths.as_mut_ptr()) }
    });
    let mut frames = vec![[0.0_f64; 7]; COUNT];
    starve("shx_solver_get_root_frames", with_pins, |solver| {
        let out = shx_output { data: frames.as_mut_ptr().cast(), stride: 0, count: COUNT, format: SHX_FORMAT_FRAME, reserved: 0 };
        // SAFETY: a living handle, ids and room for as many frames.
        unsafe { shx_solver_get_root_frames(solver, prepared.borrow().as_ptr(), COUNT, &raw const out) }
    });
    let along = vec![0.05; COUNT];
    let mut points = vec![[0.0_f64; 3]; COUNT];
    starve("shx_solver_sample_at", with_pins, |solver| {
        let out = shx_output { data: points.as_mut_ptr().cast(), stride: 0, count: COUNT, format: SHX_FORMAT_F64X3, reserved: 0 };
        let id = prepared.borrow()[0];
        // SAFETY: a living handle, arclengths and room for as many points.
        unsafe { shx_solver_sample_at(solver, id, along.as_ptr(), COUNT, null(), &raw const out, null(), null()) }
    });
    starve("shx_solver_keep_contact_events", new_solver, |solver| {
        // SAFETY: a living handle.
        unsafe { shx_solver_keep_contact_events(solver, 100_000) }
    });

    // Snapshots, out and in.
    let mut size = 0;
    let source = with_strands();
    // SAFETY: living handles and room of the size that is stated.
    unsafe {
        assert_eq!(shx_solver_snapshot(source, null_mut(), 0, &raw mut size), SHX_OK);
        let mut image = vec![0_u8; size];
        starve("shx_solver_snapshot", with_strands, |solver| {
            shx_solver_snapshot(solver, image.as_mut_ptr().cast::<c_void>(), image.len(), &raw mut size)
        });
        assert_eq!(shx_solver_snapshot(source, image.as_mut_ptr().cast(), image.len(), &raw mut size), SHX_OK);
        budgets_only("shx_solver_restore", new_solver, |solver| shx_solver_restore(solver, image.as_ptr().cast(), image.len()));
        shx_solver_destroy(source);
    }
}

/// [`starve`] by budgets alone: what they allocate is asked for at once beforehand, and not block by block.
fn budgets_only(what: &str, make: impl Fn() -> *mut shx_solver, mut call: impl FnMut(*mut shx_solver) -> shx_result) {
    let (mut budget, mut refused) = (0, 0);
    loop {
        let solver = make();
        let before = state(solver);
        BUDGET.store(held() + budget, Ordering::Relaxed);
        let result = call(solver);
        BUDGET.store(usize::MAX, Ordering::Relaxed);
        if result != SHX_OK {
            assert_eq!(result, SHX_ERROR_OUT_OF_MEMORY, "{what}, {budget} bytes");
            assert_eq!(state(solver), before, "{what}, {budget} bytes");
            refused += 1;
        }
        // SAFETY: this loop's handle.
        unsafe { shx_solver_destroy(solver) };
        if result == SHX_OK {
            break;
        }
        budget += (budget / 4).max(LARGE);
        assert!(budget < 1 << 30, "{what} never has enough");
    }
    println!("{what}: refused with {refused} budgets");
    assert!(refused > 0, "{what} was never short of memory");
}
