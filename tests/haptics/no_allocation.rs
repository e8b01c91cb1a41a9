//! The device's update allocates nothing, whatever it is handed over. (Of this thread alone: other tests run beside.)
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use superhelix::haptic::{HapticOptions, Mode, haptic};

use super::scene::{Rate, Simulation, TICK, combed_hair, motion, stroke};

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// Counts what each thread asks for.
struct Counting;

fn count() {
    // (Not while a thread ends.)
    let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
}

// SAFETY: hands everything on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's layout.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's pointer and layout.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller's pointer and layout.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn allocations_so_far() -> u64 {
    ALLOCATIONS.with(Cell::get)
}

#[test]
fn an_update_allocates_nothing() {
    // Fewer touches than there are, too: some are left out.
    for max_contacts in [256, 8] {
        let options = HapticOptions { max_contacts, ..HapticOptions::default() };
        let (mut simulation, mut device) = Simulation::new(combed_hair(40, 15.0), Rate::new(120.0, 0.0), &options);
        let before = allocations_so_far();
        let (mut most, mut pressing, mut models) = (0, 0, 0);
        for tick in 0..800 {
            let t = f64::from(tick) * TICK;
            let (pose, velocity, spin) = motion(stroke, t);
            let before = allocations_so_far();
            let (_, state) = device.update(&pose, velocity, spin, TICK).unwrap();
            most = most.max(allocations_so_far() - before);
            (pressing, models) = (pressing.max(state.pressing), state.models);
            simulation.until(t);
        }
        assert!(allocations_so_far() > before, "the count does not tell");
        assert_eq!(most, 0);
        assert!(pressing > 4 && models > 90, "{pressing} {models}");
    }
}

#[test]
fn a_hand_over_uses_its_memory_again() {
    let (mut solver, teeth) = combed_hair(40, 15.0);
    let (mut tool, mut device) = haptic(&solver, &teeth, &HapticOptions::default()).unwrap();
    let step = 1.0 / 120.0;
    // The first strokes find out how many strands are touched at once, and in how many places.
    let mut most = [0; 4];
    for most in &mut most {
        for frame in 0..168 {
            let (pose, velocity, spin) = motion(stroke, f64::from(frame) * step);
            device.update(&pose, velocity, spin, step).unwrap();
            tool.before_step(&mut solver, step).unwrap();
            solver.step(step, 1).unwrap();
            let before = allocations_so_far();
            tool.after_step(&mut solver).unwrap();
            // (Going back the comb sweeps through all of the hair.)
            if frame > 2 {
                *most = (*most).max(allocations_so_far() - before);
            }
        }
    }
    println!("{most:?} allocations at most");
    // Two for lists of the bodies; where more strands are near than ever before, a few more.
    assert!(most[3] <= 6 && most[0] > 10 * most[3], "{most:?}");
}

#[test]
fn most_direct_ticks_allocate_nothing() {
    let (mut solver, teeth) = combed_hair(40, 15.0);
    let options = HapticOptions { mode: Mode::Direct, ..HapticOptions::default() };
    let (mut tool, mut device) = haptic(&solver, &teeth, &options).unwrap();
    let mut counted = [0_u32; 4];
    let mut pressed = 0;
    for counted in &mut counted {
        for tick in 0..1400 {
            let (pose, velocity, spin) = motion(stroke, f64::from(tick) * TICK);
            let before = allocations_so_far();
            device.update(&pose, velocity, spin, TICK).unwrap();
            tool.before_step(&mut solver, TICK).unwrap();
            let report = solver.step(TICK, 1).unwrap();
            tool.after_step(&mut solver).unwrap();
            pressed = pressed.max(report.contact.contacts);
            // (Going back the comb sweeps through all of the hair.)
            if tick > 2 {
                *counted += u32::from(allocations_so_far() > before);
            }
        }
    }
    println!("of 1400 ticks each {counted:?} allocate, {pressed} contacts under pressure at once at most");
    // Those do in which a pack or a list meets more strands, or strands that are bent more, than ever before.
    assert!(pressed > 4 && counted[0] > 10 && counted[1..].iter().all(|ticks| *ticks < 140), "{pressed} {counted:?}");
}
