//! A groom's curves made into strands: what the flags ask for, and the strands that are left out.

use clap::ValueEnum;
use serde::Serialize;
use superhelix::hair::{DrawnCurve, GroomStrand};
use superhelix::internals::groom::curves::drawn;
use superhelix::{GroomOptions, Workers};

use crate::groom::material_arguments::MaterialArguments;
use crate::groom::stiffening_arguments::StiffeningArguments;
use crate::shell::failure::Failure;

/// What a strand's natural shape is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum NaturalShape {
    /// Such that the strand hangs under gravity as the groom has it.
    SagFree,
    /// The groom's shape itself: the strand sags from it.
    AsDrawn,
}

impl From<NaturalShape> for drawn::NaturalShape {
    fn from(shape: NaturalShape) -> Self {
        match shape {
            NaturalShape::SagFree => Self::SagFree,
            NaturalShape::AsDrawn => Self::AsDrawn,
        }
    }
}

/// A strand of the groom that is not simulated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Skipped {
    /// Its index in the file.
    pub strand: usize,
    /// Why.
    pub because: String,
}

/// Makes strands of curves. `done` is called after each, from any thread.
pub fn make(
    curves: &[DrawnCurve],
    options: &GroomOptions<'_>,
    workers: &Workers,
    done: impl Fn() + Sync,
) -> Result<(Vec<GroomStrand>, Vec<Skipped>), Failure> {
    let (mut strands, mut skipped) = (Vec::new(), Vec::new());
    for (curve, strand) in curves.iter().zip(drawn::strands_of(curves, options, workers, done)?) {
        match strand {
            Ok(strand) => strands.push(strand),
            Err(error) => skipped.push(Skipped { strand: curve.index, because: error.to_string() }),
        }
    }
    Ok((strands, skipped))
}

/// Strands whose natural shape is the drawn one hang in another, which is not known yet.
pub fn check_stiffening(
    natural: NaturalShape,
    stiffening: &StiffeningArguments,
    material: &MaterialArguments,
) -> Result<(), Failure> {
    if stiffening.stiffening().is_none() {
        return Ok(());
    }
    if natural == NaturalShape::AsDrawn {
        return Err(Failure::Other("--stiffen needs --natural sag-free: it is rest that takes stiffness".into()));
    }
    match material.reshaping() {
        Some(flag) => {
            Err(Failure::Other(format!("--stiffen with {flag}: strands would not rest in the shape that is stiffened")))
        }
        None => Ok(()),
    }
}
