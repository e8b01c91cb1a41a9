//! Settings by name and by error: what to choose without reading the price list.

use std::mem::{offset_of, size_of};

use super::errors::shx_result;
use super::guard::call;
use super::versioned::{Versioned, VersionedOutput, initialise};
use crate::error::{Error, Result};
use crate::step::options::StepOptions;
use crate::study::presets::Preset;
use crate::study::settings::{HairShape, Settings};
use crate::study::suggestion::{Scenes, suggest_settings};

/// To see what happens while working: the motion's kind is right, its course is not.
pub const SHX_PRESET_PREVIEW: u32 = 1;
/// Where the eye should not find the difference.
pub const SHX_PRESET_BALANCED: u32 = 2;
/// Where numbers are to be read off.
pub const SHX_PRESET_ACCURATE: u32 = 3;

/// Settings that were chosen for a kind of hair, and what they were measured to err and to cost. Prepare with shx_settings_init. Put
/// integrator, max_iterations, max_subdivisions and the three tolerances into a shx_solver_def, element_count into a
/// shx_strand_def, and step each frame in substeps.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_settings {
    /// Set by shx_settings_init.
    pub struct_size: u32,
    /// SHX_INTEGRATOR_.
    pub integrator: u32,
    /// Newton's iterations a substep at most.
    pub max_iterations: u32,
    /// Substeps of a frame. Roots that move are best given substep by substep.
    pub substeps: u32,
    /// Helical elements of a strand.
    pub element_count: u32,
    /// How often a strand's substep may be halved.
    pub max_subdivisions: u32,
    /// Newton's tolerance, rad.
    pub tolerance: f64,
    /// The error that a substep may add before it is halved, in units of the strand's length; 0: not looked at.
    pub error_tolerance: f64,
    /// Root mean square distance of the strand's points from where they should be, in units of its length, over two seconds in the
    /// worst of the measured scenes. Negative: hair of that kind was not measured.
    pub rms_error: f64,
    /// Processor time a strand and simulated second in the dearest of them, microseconds, one thread, on the machine of
    /// docs/tradeoff.md. Negative: not measured.
    pub cost: f64,
    /// What integrals along an element may err by.
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

/// Fills settings with the solver's defaults and no elements. size is sizeof(shx_settings).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_settings_init(settings: *mut shx_settings, size: usize) -> shx_result {
    // SAFETY: the caller says that settings holds size bytes.
    unsafe { initialise("shx_settings_init", "settings", settings, size) }
}

/// The settings of a preset (SHX_PRESET_) for hair of that curvature (natural curvature and twist together, sqrt(k0^2 + k1^2 + k2^2),
/// rad/m; zero or above; a curl of radius r and step d has 1/sqrt(r^2 + (d/(2 pi))^2)) and length (m, above zero), and frames of
/// frame_time seconds (above zero).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT. Any thread.
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

/// The cheapest settings that were measured to err by no more than target_error (root mean square distance of the strand's points
/// from where they should be, in units of its length; above zero; an error in metres is to be divided by the length) in every one of
/// scenes (SHX_SCENE_ bits, at least one: what the hair is to go through), for hair of that curvature and length and frames of
/// frame_time seconds, all as for shx_settings_from_preset. Measured was hair of the four types of docs/tradeoff.md, which says what
/// the answer is worth for other hair.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also a target_error below what the finest
/// settings reached, which the error's text says, and a curvature above all that were measured). Any thread.
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
