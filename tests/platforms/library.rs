//! The library as other platforms have it, WebAssembly under node (`check.mjs`) and Windows (`check.c`): the C interface, and the golden courses of the
//! tests, which must give the same hashes as on any other machine.
#![allow(unsafe_code, reason = "exported by name")]

extern crate superhelix as _;

use superhelix::{ContactModel, InstructionSet, SolverOptions, Workers};

#[path = "../contact/crowded_scene.rs"]
mod crowded_scene;
#[path = "../solver/lanes/golden.rs"]
mod golden;
#[allow(dead_code, reason = "the rest of it is for the tests of lanes")]
#[path = "../solver/lanes/scene.rs"]
mod scene;

/// How many courses of free strands there are.
#[unsafe(no_mangle)]
pub extern "C" fn lanes_count() -> u32 {
    golden::GOLDEN.len() as u32
}

/// The golden hash of a course.
#[unsafe(no_mangle)]
pub extern "C" fn lanes_golden(course: u32) -> u64 {
    golden::GOLDEN[course as usize].2
}

/// Its hash with the best instructions of this machine or, if `scalar` is not 0, with none.
#[unsafe(no_mangle)]
pub extern "C" fn lanes_found(course: u32, scalar: u32) -> u64 {
    let set = if scalar != 0 { InstructionSet::Scalar } else { InstructionSet::detected() };
    let (integrator, precision, _) = golden::GOLDEN[course as usize];
    let options = SolverOptions { workers: Workers::Serial, ..golden::golden_options(integrator, precision, set) };
    scene::course(options).1
}

/// How many courses with contact there are.
#[unsafe(no_mangle)]
pub extern "C" fn contact_count() -> u32 {
    crowded_scene::GOLDEN.len() as u32
}

/// The golden hash of a course with contact.
#[unsafe(no_mangle)]
pub extern "C" fn contact_golden(course: u32) -> u64 {
    crowded_scene::GOLDEN[course as usize].2
}

/// Its hash.
#[unsafe(no_mangle)]
pub extern "C" fn contact_found(course: u32) -> u64 {
    let (model, together, _): (ContactModel, bool, u64) = crowded_scene::GOLDEN[course as usize];
    crowded_scene::course(model, Workers::Serial, None, together).2
}

/// Lanes of f64 that the best instructions of this machine have: 1 says that there are none.
#[unsafe(no_mangle)]
pub extern "C" fn lanes_of_f64() -> u32 {
    superhelix::internals::step::pack::packs::width(superhelix::Precision::F64, InstructionSet::detected()) as u32
}
