//! Shapes taken as natural or rest shapes, on the command line.

use std::path::Path;

use clap::{Args, ValueEnum};

use crate::groom::stiffening_arguments::StiffeningArguments;
use crate::scene;
use crate::scene::Scene;
use crate::scene::posing::{Action, Operation};
use crate::shell::failure::Failure;

/// Flags for it.
#[derive(Debug, Args)]
#[command(next_help_heading = "Rest shapes")]
pub struct RestArguments {
    /// What the strands' initial shapes become: their natural shapes, or those in which they rest under the scene's gravity.
    #[arg(long, value_enum, value_name = "SHAPE")]
    take: Option<Taken>,
    #[command(flatten)]
    stiffening: StiffeningArguments,
}

/// What initial shapes become.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Taken {
    /// Natural: without weight the strands would rest in them; with it they sag.
    Natural,
    /// Shapes of rest: the strands hang in them, sag-free. With --stiffen stably.
    Rest,
}

impl RestArguments {
    /// Does what they say to a scene's strands.
    pub fn apply(&self, scene: &mut Scene, path: &Path) -> Result<(), Failure> {
        let stiffening = self.stiffening.stiffening();
        let action = match (self.take, stiffening) {
            (None, None) => return Ok(()),
            (Some(Taken::Natural), None) => Action::TakeNatural,
            (Some(Taken::Rest), stiffening) => Action::TakeRest(stiffening),
            (_, Some(_)) => return Err(Failure::Other("--stiffen needs --take rest: it is rest that takes stiffness".into())),
        };
        let operation = Operation { key: "--take".into(), strands: None, action };
        scene::do_posing(scene, &[operation]).map_err(|complaint| Failure::scene(path, &complaint))
    }
}
