//! The scratch memory of one worker: a workspace for each type of lanes, empty until first used.

use super::pack::members::PackKey;
use super::state::{RuleScratch, StrandState};
use super::workspace::Workspace;
use crate::chain::elimination::Elimination;
use crate::math::lane::Lane;
#[allow(unused_imports, reason = "which types there are depends on the machine")]
use crate::math::lanes;

/// A workspace, and the scratch memory of its linear solve.
#[derive(Debug, Clone)]
pub struct Bench<T> {
    /// The step's workspace.
    pub workspace: Workspace<T>,
    /// The linear solve's memory.
    pub elimination: Elimination<T>,
}

impl<T: Lane> Default for Bench<T> {
    fn default() -> Self {
        Self { workspace: Workspace::default(), elimination: Elimination::default() }
    }
}

/// Scratch memory for one pack of strands at a time, of any pack key.
#[derive(Debug, Default)]
pub struct StepScratch {
    /// One strand at a time, f64.
    pub one: Bench<f64>,
    /// One strand at a time, f32.
    pub one_f32: Bench<f32>,
    /// Packs, narrow to wide.
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
    pub(crate) f64x2: Option<Box<Bench<lanes::F64x2>>>,
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
    pub(crate) f32x4: Option<Box<Bench<lanes::F32x4>>>,
    #[cfg(target_arch = "x86_64")]
    pub(crate) f64x4: Option<Box<Bench<lanes::F64x4>>>,
    #[cfg(target_arch = "x86_64")]
    pub(crate) f32x8: Option<Box<Bench<lanes::F32x8>>>,
    #[cfg(target_arch = "x86_64")]
    pub(crate) f64x8: Option<Box<Bench<lanes::F64x8>>>,
    #[cfg(target_arch = "x86_64")]
    pub(crate) f32x16: Option<Box<Bench<lanes::F32x16>>>,
    /// The strands of a task in the order in which they are packed: pack key, last number of iterations, place in the task.
    pub order: Vec<(PackKey, u32, u32)>,
    /// For changes of quadrature rule.
    pub rule: RuleScratch,
    /// The strand at the start of a step that is taken in substeps.
    pub before_step: Option<StrandState>,
}
