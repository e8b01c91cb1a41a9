//! Steps of one strand at a time, for strands outside any pack.

use super::members::One;
use super::whole::Take;
use crate::math::lane::{Kernel, Lane};
use crate::step::newton;
use crate::step::scratch::Bench;
use crate::step::{Setting, StrandOutcome};

/// A number type of one lane.
pub trait Single: Lane {
    /// Takes a step in one piece; the strand stays unchanged, and the workspace holds the result.
    fn attempt(one: &One, setting: &Setting, h: f64, bench: &mut Bench<Self>) -> StrandOutcome;
}

impl Single for f64 {
    fn attempt(one: &One, setting: &Setting, h: f64, bench: &mut Bench<f64>) -> StrandOutcome {
        match newton::dense_solver(setting.options.linear_solver) {
            // (The dense solves know no contact.)
            Some(mut solver) if one.touches.is_none() => {
                Take { members: one, setting, h, workspace: &mut bench.workspace, solver: &mut solver }.run()[0]
            }
            _ => attempt(one, setting, h, bench),
        }
    }
}

impl Single for f32 {
    fn attempt(one: &One, setting: &Setting, h: f64, bench: &mut Bench<f32>) -> StrandOutcome {
        attempt(one, setting, h, bench)
    }
}

fn attempt<T: Lane>(one: &One, setting: &Setting, h: f64, bench: &mut Bench<T>) -> StrandOutcome {
    Take { members: one, setting, h, workspace: &mut bench.workspace, solver: &mut bench.elimination }.run()[0]
}
