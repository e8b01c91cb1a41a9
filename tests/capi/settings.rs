//! Presets and suggestions of the C ABI are those of the library, and a solver takes them.
#![allow(unsafe_code)] // C calls

use std::mem::{MaybeUninit, size_of};
use std::ptr::null_mut;

use superhelix::internals::capi::base::errors::SHX_OK;
use superhelix::internals::capi::base::types::shx_strand_id;
use superhelix::internals::capi::hair::strand_def::{shx_strand_def, shx_strand_def_init};
use superhelix::internals::capi::hair::strands::shx_solver_add_strands;
use superhelix::internals::capi::simulation::settings::*;
use superhelix::internals::capi::simulation::solver::{shx_solver_create, shx_solver_destroy};
use superhelix::internals::capi::simulation::solver_def::{shx_solver_def, shx_solver_def_init};
use superhelix::internals::capi::simulation::step::shx_solver_step;
use superhelix::settings::{HairShape, Preset, Scenes, Settings, suggest_settings};

fn new_settings() -> shx_settings {
    let mut settings = MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_settings_init(settings.as_mut_ptr(), size_of::<shx_settings>()), SHX_OK);
        settings.assume_init()
    }
}

fn assert_same(c: &shx_settings, rust: &Settings) {
    assert_eq!(c.struct_size as usize, size_of::<shx_settings>());
    assert_eq!((c.integrator, c.max_iterations), (rust.step.integrator as u32, rust.step.max_iterations));
    assert_eq!((c.max_subdivisions, c.substeps, c.element_count), (rust.step.max_subdivisions, rust.substeps, rust.elements));
    assert_eq!((c.tolerance, c.error_tolerance), (rust.step.tolerance, rust.step.error_tolerance));
    assert_eq!(c.quadrature_tolerance, rust.step.quadrature_tolerance);
    assert_eq!((c.rms_error, c.cost), (rust.error.unwrap_or(-1.0), rust.cost.unwrap_or(-1.0)));
}

#[test]
fn a_host_gets_the_librarys_results() {
    let presets = [SHX_PRESET_PREVIEW, SHX_PRESET_BALANCED, SHX_PRESET_ACCURATE];
    for (number, preset) in presets.into_iter().zip(Preset::ALL) {
        // The last curl is tighter than all that were measured.
        for hair in [(0.0, 0.3), (100.0, 0.2), (2000.0, 0.1)] {
            let hair = HairShape { curvature: hair.0, length: hair.1 };
            let mut settings = new_settings();
            // SAFETY: a structure of the size that it states.
            let result = unsafe { shx_settings_from_preset(number, hair.curvature, hair.length, 1.0 / 24.0, &raw mut settings) };
            assert_eq!(result, SHX_OK);
            assert_same(&settings, &preset.settings(&hair, 1.0 / 24.0).unwrap());
        }
    }
    let mut settings = new_settings();
    // SAFETY: a structure of the size that it states.
    assert_eq!(unsafe { shx_settings_suggest(0.1, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) }, SHX_OK);
    let hair = HairShape { curvature: 100.0, length: 0.2 };
    assert_same(&settings, &suggest_settings(0.1, Scenes::ALL, &hair, 1.0 / 30.0).unwrap());
}

#[test]
fn a_solver_takes_them() {
    let mut settings = new_settings();
    let (mut solver_def, mut strand_def) = (MaybeUninit::<shx_solver_def>::uninit(), MaybeUninit::<shx_strand_def>::uninit());
    let (mut solver, mut id) = (null_mut(), shx_strand_id { bits: 0 });
    // SAFETY: all pointers refer to memory of the right size.
    unsafe {
        assert_eq!(shx_settings_from_preset(SHX_PRESET_PREVIEW, 0.0, 0.2, 1.0 / 30.0, &raw mut settings), SHX_OK);
        assert_eq!(shx_solver_def_init(solver_def.as_mut_ptr(), size_of::<shx_solver_def>()), SHX_OK);
        assert_eq!(shx_strand_def_init(strand_def.as_mut_ptr(), size_of::<shx_strand_def>()), SHX_OK);
        let (mut solver_def, mut strand_def) = (solver_def.assume_init(), strand_def.assume_init());
        solver_def.integrator = settings.integrator;
        solver_def.max_iterations = settings.max_iterations;
        solver_def.max_subdivisions = settings.max_subdivisions;
        solver_def.tolerance = settings.tolerance;
        solver_def.error_tolerance = settings.error_tolerance;
        solver_def.quadrature_tolerance = settings.quadrature_tolerance;
        strand_def.length = 0.2;
        strand_def.element_count = settings.element_count;
        assert_eq!(shx_solver_create(&raw const solver_def, &raw mut solver), SHX_OK);
        let size = size_of::<shx_strand_def>();
        assert_eq!(shx_solver_add_strands(solver, &raw const strand_def, size, 1, &raw mut id), SHX_OK);
        assert_eq!(shx_solver_step(solver, 1.0 / 30.0, settings.substeps, null_mut()), SHX_OK);
        shx_solver_destroy(solver);
    }
}
