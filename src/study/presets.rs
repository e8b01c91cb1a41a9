//! Named settings: what to choose without reading `docs/tradeoff.md`, where they are measured.

use std::f64::consts::PI;

use crate::error::{Error, Result, check_positive};
use crate::solver::SHORTEST_STEP;
use crate::step::options::{Integrator, StepOptions};

/// Settings by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Preset {
    /// To look at while working.
    Preview = 1,
    /// For a film's hair.
    Balanced = 2,
    /// To measure by.
    Accurate = 3,
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

    /// What it stands for.
    pub fn settings(self) -> Settings {
        let (rate, tolerance, max_iterations, fewest_elements, elements_per_turn) = match self {
            Preset::Preview => (30.0, 1e-2, 8, 3, 2.0),
            Preset::Balanced => (120.0, 1e-3, 50, 8, 4.0),
            Preset::Accurate => (480.0, 1e-4, 50, 20, 8.0),
        };
        let step = StepOptions { integrator: Integrator::SecondOrder, tolerance, max_iterations, ..StepOptions::default() };
        Settings { step, longest_step: 1.0 / rate, fewest_elements, elements_per_turn }
    }
}

/// What a preset stands for: how to step, how long a step may be, how many elements a strand needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// For [`SolverOptions::step`](crate::solver::definition::SolverOptions::step).
    pub step: StepOptions,
    /// The longest step, s.
    pub longest_step: f64,
    /// Elements of a straight strand.
    pub fewest_elements: u32,
    /// Elements a turn of a curl, when that makes more.
    pub elements_per_turn: f64,
}

impl Settings {
    /// Substeps of a frame.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`].
    pub fn substeps(&self, frame_time: f64) -> Result<u32> {
        check_positive(|| "frame_time".into(), frame_time)?;
        let substeps = (frame_time / self.longest_step * (1.0 - 1e-9)).ceil().max(1.0);
        if frame_time / substeps < SHORTEST_STEP || substeps > f64::from(u32::MAX) {
            return Err(Error::invalid("frame_time", frame_time, "a time that can be stepped through"));
        }
        Ok(substeps as u32)
    }

    /// Elements of a strand.
    pub fn elements(&self, natural: [f64; 3], length: f64) -> u32 {
        let [twist, one, two] = natural;
        let turns = twist.hypot(one).hypot(two) * length / (2.0 * PI);
        self.fewest_elements.max((turns * self.elements_per_turn).ceil() as u32)
    }
}
