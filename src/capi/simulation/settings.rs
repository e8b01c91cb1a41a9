//! Settings by name, and by permitted error.

use std::mem::{offset_of, size_of};

use crate::analysis::presets::Preset;
use crate::analysis::settings::{HairShape, Settings};
use crate::analysis::suggestion::{Scenes, suggest_settings};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise};
use crate::error::{Error, Result};
use crate::step::options::StepOptions;

/// For interactive work: the character of the motion is right, its course is not.
pub const SHX_PRESET_PREVIEW: u32 = 1;
/// For final animation: errors should not be visible.
pub const SHX_PRESET_BALANCED: u32 = 2;
/// For measurements.
pub const SHX_PRESET_ACCURATE: u32 = 3;

/// Settings for a type of hair, with their measured error and cost. Fill it with shx_settings_init. Copy
/// integrator, max_iterations, max_subdivisions and the three tolerances to a shx_solver_def, and
/// element_count to a shx_strand_def; step each frame in substeps.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_settings {
    /// Set by shx_settings_init.
    pub struct_size: u32,
    /// SHX_INTEGRATOR_.
    pub integrator: u32,
    /// Maximum number of Newton iterations per substep.
    pub max_iterations: u32,
    /// Substeps per frame. For best accuracy, set moving roots for each substep.
    pub substeps: u32,
    /// Helical elements per strand.
    pub element_count: u32,
    /// How many times a strand's substep may be halved.
    pub max_subdivisions: u32,
    /// Tolerance of Newton's method, rad.
    pub tolerance: f64,
    /// Error that a substep may add before it is halved, as a
    /// fraction of the length of the strand; 0: not estimated.
    pub error_tolerance: f64,
    /// RMS position error as a fraction of the length of the strand, over two seconds in the worst of the
    /// measured scenes. Negative: such hair was not measured.
    pub rms_error: f64,
    /// Processor time per strand and simulated second in the most expensive of those scenes, microseconds, one
    /// thread, on the machine of docs/notebook/tradeoff.md. Negative: not measured.
    pub cost: f64,
    /// Allowed relative error of the integrals along an element.
    pub quadrature_tolerance: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_settings {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let step = StepOptions::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            integrator: step.integrator as u32,
            max_iterations: step.max_iterations,
            substeps: 1,
            element_count: 0,
            max_subdivisions: step.max_subdivisions,
            tolerance: step.tolerance,
            error_tolerance: step.error_tolerance,
            rms_error: -1.0,
            cost: -1.0,
            quadrature_tolerance: step.quadrature_tolerance,
        }
    }
}

const _: () = {
    assert!(size_of::<shx_settings>() == 64);
    assert!(offset_of!(shx_settings, element_count) == 16 && offset_of!(shx_settings, tolerance) == 24);
};

impl shx_settings {
    fn from_settings(settings: &Settings) -> Self {
        Self {
            integrator: settings.step.integrator as u32,
            max_iterations: settings.step.max_iterations,
            substeps: settings.substeps,
            element_count: settings.elements,
            max_subdivisions: settings.step.max_subdivisions,
            tolerance: settings.step.tolerance,
            error_tolerance: settings.step.error_tolerance,
            rms_error: settings.error.unwrap_or(-1.0),
            cost: settings.cost.unwrap_or(-1.0),
            quadrature_tolerance: settings.step.quadrature_tolerance,
            ..Self::defaults()
        }
    }
}

/// Fills *settings with the defaults of the solver and no elements. size is sizeof(shx_settings).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_settings_init(settings: *mut shx_settings, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that settings holds size bytes.
    unsafe { initialise("shx_settings_init", "settings", settings, size) }
}

/// Returns the settings of a preset (SHX_PRESET_) for hair of the given curvature and length (m, above zero)
/// and frames of frame_time seconds (above zero). curvature combines natural curvature and twist, sqrt(k0^2 +
/// k1^2 + k2^2), rad/m, zero or above; a curl of radius r and pitch p has 1/sqrt(r^2 + (p/(2 pi))^2).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_settings_from_preset(
    preset: u32,
    curvature: f64,
    length: f64,
    frame_time: f64,
    out_settings: *mut shx_settings,
) -> shx_result {
    call("shx_settings_from_preset", || -> Result<()> {
        // SAFETY: the caller's structure, of the size that it states.
        let output = unsafe { VersionedOutput::new("out_settings", out_settings)? };
        let preset = Preset::from_u32(preset).ok_or_else(|| Error::invalid("preset", preset, "one of SHX_PRESET_"))?;
        let settings = preset.settings(&HairShape { curvature, length }, frame_time)?;
        output.write(&shx_settings::from_settings(&settings));
        Ok(())
    })
}

/// Returns the cheapest settings whose measured error was at most target_error in all measured scenes: RMS
/// position error as a fraction of the strand's length, above zero (divide an error in metres by the
/// length). Hair and frame_time are as in shx_settings_from_preset. Four types of hair were measured;
/// docs/notebook/tradeoff.md says what the result means for others.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also a target_error
/// below that of the finest settings, which the message gives, and a curvature above all that were measured).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_settings_suggest(
    target_error: f64,
    curvature: f64,
    length: f64,
    frame_time: f64,
    out_settings: *mut shx_settings,
) -> shx_result {
    call("shx_settings_suggest", || -> Result<()> {
        // SAFETY: the caller's structure, of the size that it states.
        let output = unsafe { VersionedOutput::new("out_settings", out_settings)? };
        let settings = suggest_settings(target_error, Scenes::ALL, &HairShape { curvature, length }, frame_time)?;
        output.write(&shx_settings::from_settings(&settings));
        Ok(())
    })
}
