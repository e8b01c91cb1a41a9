//! How fine `superhelix simulate` is: time step, substeps, elements.

use superhelix::StepOptions;
use superhelix::io::Curves;
use superhelix::settings::HairShape;

use super::arguments::SimulateArguments;
use crate::groom::statistics::GroomStatistics;
use crate::shell::failure::Failure;

/// How fine: what the flags say, else the preset, else this command's own defaults.
pub struct Fineness {
    pub step: StepOptions,
    pub substeps: u32,
    pub elements: u32,
}

impl Fineness {
    pub fn choose(arguments: &SimulateArguments, curves: &Curves) -> Result<Self, Failure> {
        let (mut step, mut substeps, mut elements) = (StepOptions { tolerance: 1e-4, ..StepOptions::default() }, 2, 10);
        if let Some(preset) = arguments.preset {
            // The turns of a strand do not depend on the unit of its file.
            let turning = GroomStatistics::of(curves).turning_degrees.map_or(0.0, |turning| turning.p90.to_radians());
            let settings = preset.settings(&HairShape { curvature: turning, length: 1.0 }, 1.0 / arguments.fps)?;
            (step, substeps, elements) = (settings.step, settings.substeps, settings.elements);
        }
        step.integrator = arguments.integrator.unwrap_or(step.integrator);
        step.precision = arguments.precision.unwrap_or(step.precision);
        step.tolerance = arguments.tolerance.unwrap_or(step.tolerance);
        step.max_subdivisions = arguments.max_subdivisions.unwrap_or(step.max_subdivisions);
        step.error_tolerance = arguments.error_tolerance.unwrap_or(step.error_tolerance);
        step.reference_tolerance = arguments.reference_tolerance.unwrap_or(step.reference_tolerance);
        step.quadrature_tolerance = arguments.quadrature_tolerance.unwrap_or(step.quadrature_tolerance);
        step.max_iterations = arguments.max_iterations.unwrap_or(step.max_iterations);
        Ok(Self { step, substeps: arguments.substeps.unwrap_or(substeps), elements: arguments.elements.unwrap_or(elements) })
    }
}
