//! The settings to measure.

use superhelix::settings::{HairShape, Preset};
use superhelix::{Freedoms, Integrator, StepOptions};

/// Steps per second. A sixth of a second is a whole number of steps at each rate, so that wind may change there; 960 represents a
/// thousand.
pub const RATES: [u32; 7] = [24, 30, 60, 120, 240, 480, 960];
/// Elements per strand.
pub const ELEMENTS: [u32; 9] = [1, 2, 3, 5, 8, 12, 20, 32, 50];

/// Newton's default tolerance, rad.
pub const TOLERANCE: f64 = 1e-3;

/// One setting of all options.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    /// Its preset, if any.
    pub preset: Option<Preset>,
    /// Which integrator.
    pub integrator: Integrator,
    /// Steps per second.
    pub rate: u32,
    /// Elements per strand.
    pub elements: u32,
    /// Largest number of Newton iterations per step.
    pub cap: u32,
    /// Newton's tolerance, rad.
    pub tolerance: f64,
    /// How often a step that does not converge, or errs by more than `error_tolerance`, is halved.
    pub subdivisions: u32,
    /// The permitted error of a step, in lengths; 0 for unchecked.
    pub error_tolerance: f64,
    /// Tolerance of integrals along an element.
    pub quadrature_tolerance: f64,
    /// Curvatures that may change.
    pub freedoms: Freedoms,
}

/// A name of an integrator in tables.
pub fn integrator_name(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::LinearlyImplicit => "linearly_implicit",
        Integrator::ImplicitEuler => "implicit_euler",
        Integrator::SecondOrder => "second_order",
        Integrator::Reference => "reference",
    }
}

impl Setting {
    fn plain(integrator: Integrator, rate: u32, elements: u32) -> Self {
        let StepOptions { max_iterations, max_subdivisions, quadrature_tolerance, .. } = StepOptions::default();
        Self {
            preset: None,
            integrator,
            rate,
            elements,
            cap: max_iterations,
            tolerance: TOLERANCE,
            subdivisions: max_subdivisions,
            error_tolerance: 0.0,
            quadrature_tolerance,
            freedoms: Freedoms::ALL,
        }
    }

    /// Every setting to measure on a type of hair: the whole product of integrator, steps and elements; caps, tolerances,
    /// freedoms and adaptive steps on slices of it, in second order; the presets.
    pub fn all(hair: &HairShape) -> Vec<Self> {
        let mut settings = Vec::new();
        for integrator in [Integrator::LinearlyImplicit, Integrator::ImplicitEuler, Integrator::SecondOrder] {
            for rate in RATES {
                settings.extend(ELEMENTS.map(|elements| Self::plain(integrator, rate, elements)));
            }
        }
        for rate in [24, 30, 60, 240] {
            for elements in [3, 5, 8, 12, 20] {
                let plain = Self::plain(Integrator::SecondOrder, rate, elements);
                // A cap that saves work: unfinished steps stay unfinished, without subdivision.
                settings.extend([1, 2, 4, 8].map(|cap| Self { cap, subdivisions: 0, ..plain }));
                let bending = Freedoms::BEND1.union(Freedoms::BEND2);
                settings.extend([Freedoms::BEND1, bending].map(|freedoms| Self { freedoms, ..plain }));
            }
            for elements in [8, 20] {
                let plain = Self::plain(Integrator::SecondOrder, rate, elements);
                settings.extend([1e-1, 1e-2, 1e-4, 1e-6].map(|tolerance| Self { tolerance, ..plain }));
            }
        }
        for rate in [24, 30, 60] {
            for elements in [8, 20] {
                let plain = Self::plain(Integrator::SecondOrder, rate, elements);
                settings.extend([1e-2, 3e-3, 1e-3, 3e-4].map(|error_tolerance| Self {
                    error_tolerance,
                    subdivisions: 5,
                    ..plain
                }));
            }
        }
        for preset in Preset::ALL {
            let recipe = preset.recipe();
            settings.push(Self {
                preset: Some(preset),
                integrator: recipe.step.integrator,
                rate: (1.0 / recipe.longest_step).round() as u32,
                elements: recipe.elements(hair).expect("a number of elements"),
                cap: recipe.step.max_iterations,
                tolerance: recipe.step.tolerance,
                subdivisions: recipe.step.max_subdivisions,
                error_tolerance: recipe.step.error_tolerance,
                quadrature_tolerance: recipe.step.quadrature_tolerance,
                freedoms: Freedoms::ALL,
            });
        }
        settings
    }

    /// The elements' kinds of freedom by name.
    pub fn freedoms_name(&self) -> &'static str {
        match self.freedoms.bits() {
            7 => "all",
            6 => "bend",
            2 => "bend1",
            _ => "other",
        }
    }
}
