//! Settings by name, for those who do not want to choose: `docs/notebook/tradeoff.md` says what they were distilled from.

use crate::analysis::measured;
use crate::analysis::settings::{self, HairShape, Settings};
use crate::error::Result;
use crate::step::options::{Integrator, StepOptions};

/// Settings by name. All are of second order in the step, and solve each step: none blows up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Preset {
    /// To see what happens while working: the motion's kind is right, its course is not.
    Preview = 1,
    /// Where the eye should not find the difference.
    Balanced = 2,
    /// Where numbers are to be read off.
    Accurate = 3,
}

/// What a preset is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recipe {
    /// How a step is taken.
    pub step: StepOptions,
    /// The longest step, s.
    pub longest_step: f64,
    /// Elements of a strand at least.
    pub fewest_elements: u32,
    /// Elements for each turn of a curl, where that makes more.
    pub elements_per_turn: f64,
}

impl Preset {
    /// All, from the cheapest.
    pub const ALL: [Preset; 3] = [Preset::Preview, Preset::Balanced, Preset::Accurate];

    /// The preset of that number, as the C ABI has it.
    pub fn from_u32(value: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| *preset as u32 == value)
    }

    /// Its name on the command line and in tables.
    pub fn name(self) -> &'static str {
        match self {
            Preset::Preview => "preview",
            Preset::Balanced => "balanced",
            Preset::Accurate => "accurate",
        }
    }

    /// What it is made of.
    pub fn recipe(self) -> Recipe {
        let (rate, tolerance, max_iterations, fewest_elements, elements_per_turn, quadrature_tolerance) = match self {
            Preset::Preview => (30.0, 1e-2, 8, 4, 3.0, 1e-2),
            Preset::Balanced => (120.0, 1e-3, 50, 8, 4.0, 1e-4),
            Preset::Accurate => (480.0, 1e-4, 50, 20, 8.0, 1e-6),
        };
        let integrator = Integrator::SecondOrder;
        let step = StepOptions { integrator, tolerance, max_iterations, quadrature_tolerance, ..StepOptions::default() };
        Recipe { step, longest_step: 1.0 / rate, fewest_elements, elements_per_turn }
    }

    /// Its settings for hair of that shape and frames of `frame_time` seconds. The error and the cost are those of the measured type of
    /// hair that is as curled or the next more curled, at its own length (20 cm; 10 cm for the most curled) and the preset's longest step;
    /// the cost goes with the substeps and elements.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) naming `curvature`, `length` or `frame_time`.
    pub fn settings(self, hair: &HairShape, frame_time: f64) -> Result<Settings> {
        hair.check()?;
        let recipe = self.recipe();
        let substeps = settings::substeps(frame_time, recipe.longest_step)?;
        let elements = recipe.elements(hair)?;
        let kind = hair.measured_type();
        let measured = kind.map(|kind| &measured::PRESETS[self as usize - 1][kind]);
        let worst = |of: fn(&measured::Price) -> f32| measured.map(|scenes| f64::from(scenes.iter().map(of).fold(0.0, f32::max)));
        let finer = f64::from(substeps) * recipe.longest_step / frame_time;
        let longer = kind.map_or(1.0, |kind| {
            let measured = HairShape { curvature: measured::CURVATURES[kind], length: measured::LENGTHS[kind] };
            f64::from(elements) / recipe.elements(&measured).map_or(f64::NAN, f64::from)
        });
        Ok(Settings {
            step: recipe.step,
            substeps,
            elements,
            error: worst(|price| price.0),
            cost: worst(|price| price.1).map(|cost| cost * finer * longer),
        })
    }
}

impl Recipe {
    /// Elements of a strand of that shape.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) naming `curvature` or `length`; `length` also for a curl of more
    /// turns than a strand can have elements for.
    pub fn elements(&self, hair: &HairShape) -> Result<u32> {
        hair.check()?;
        settings::elements(hair, f64::from(self.fewest_elements).max((hair.turns() * self.elements_per_turn).ceil()))
    }
}
