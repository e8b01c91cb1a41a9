//! The scratch memory of a step, one a worker, kept between strands and steps so that nothing is allocated once it has grown.

use super::state::{Past, RuleScratch, StrandState};
use super::tableau::MAX_STAGES;
use crate::chain::elimination::Elimination;
use crate::chain::system::ChainSystem;
use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;

/// One stage of a Runge–Kutta step: where it starts from and what its end says. Positions relative to the root's origin at the step's
/// start, world axes.
#[derive(Debug, Clone, Default)]
pub struct Stage {
    /// r̃.
    pub start_positions: Vec<Vec3<f64>>,
    /// ṽ.
    pub start_velocities: Vec<Vec3<f64>>,
    /// q̃.
    pub start_curvatures: Vec<[f64; 3]>,
    /// V.
    pub velocities: Vec<Vec3<f64>>,
    /// A.
    pub accelerations: Vec<Vec3<f64>>,
    /// q̇.
    pub rates: Vec<[f64; 3]>,
}

/// Scratch for one strand at a time.
#[derive(Debug, Clone)]
pub struct Workspace {
    /// The accepted iterate.
    pub kinematics: Kinematics<f64>,
    /// The iterate on trial.
    pub trial: Kinematics<f64>,
    /// Stiffnesses and forces.
    pub system: ChainSystem<f64>,
    /// Scratch of the linear-time solve.
    pub elimination: Elimination<f64>,
    /// Where each quadrature point is drawn to, relative to the root's new origin, world axes.
    pub point_target: Vec<Vec3<f64>>,
    /// Where each curvature is drawn to.
    pub curvature_target: Vec<[f64; 3]>,
    /// Where each point was at the step's start, relative to the root's origin then.
    pub base: Vec<Vec3<f64>>,
    /// Where each point was at the start of the step before, relative to the root's origin now.
    pub past_base: Vec<Vec3<f64>>,
    /// What will be the past of the next step.
    pub next_past: Past,
    /// The stages of the step.
    pub stages: [Stage; MAX_STAGES],
    /// The accepted curvatures.
    pub curvatures: Vec<[f64; 3]>,
    /// The curvatures on trial.
    pub trial_curvatures: Vec<[f64; 3]>,
    /// Newton's direction.
    pub change: Vec<[f64; 3]>,
    /// Scratch of a change of rule.
    pub rule_scratch: RuleScratch,
    /// The strand as the step, or the part of it at hand, found it.
    pub rolled_back: StrandState,
    /// The strand as a step that is taken in parts found it.
    pub before_step: Option<StrandState>,
}

impl Default for Workspace {
    fn default() -> Self {
        Self {
            kinematics: Kinematics::default(),
            trial: Kinematics::default(),
            system: ChainSystem::default(),
            elimination: Elimination::default(),
            point_target: Vec::new(),
            curvature_target: Vec::new(),
            base: Vec::new(),
            past_base: Vec::new(),
            next_past: Past::default(),
            stages: std::array::from_fn(|_| Stage::default()),
            curvatures: Vec::new(),
            trial_curvatures: Vec::new(),
            change: Vec::new(),
            rule_scratch: RuleScratch::default(),
            rolled_back: StrandState::default(),
            before_step: None,
        }
    }
}
