//! The scratch memory of a step, one per worker, kept between strands and steps so that nothing is allocated once it has grown.

use nalgebra::Vector3;

use super::at_points::surfaces::PointContact;
use super::integrator::tableau::MAX_STAGES;
use super::newton::iterate::Iterate;
use super::pack::loaded::Loaded;
use crate::math::frame::Frame;
use crate::math::lane::{Lane, MAX_LANES};
use crate::math::vector::Vec3;

/// One stage of a Runge–Kutta step: its start and its results. World axes.
#[derive(Debug, Clone)]
pub struct Stage<T> {
    /// r̃ from the points' positions at the start of the step (`Iterate::point_base`).
    pub start_displacements: Vec<Vec3<T>>,
    /// ṽ.
    pub start_velocities: Vec<Vec3<T>>,
    /// q̃ from the curvatures at the start of the step.
    pub start_changes: Vec<[T; 3]>,
    /// V.
    pub velocities: Vec<Vec3<T>>,
    /// A.
    pub accelerations: Vec<Vec3<T>>,
    /// q̇.
    pub rates: Vec<[T; 3]>,
}

impl<T> Default for Stage<T> {
    fn default() -> Self {
        Self {
            start_displacements: Vec::new(),
            start_velocities: Vec::new(),
            start_changes: Vec::new(),
            velocities: Vec::new(),
            accelerations: Vec::new(),
            rates: Vec::new(),
        }
    }
}

impl<T: Lane> Stage<T> {
    /// Resizes everything.
    #[inline(always)]
    pub fn resize(&mut self, elements: usize, points: usize) {
        self.start_displacements.resize(points, Vec3::zero());
        self.start_velocities.resize(points, Vec3::zero());
        self.start_changes.resize(elements, [T::zero(); 3]);
        self.velocities.resize(points, Vec3::zero());
        self.accelerations.resize(points, Vec3::zero());
        self.rates.resize(elements, [T::zero(); 3]);
    }
}

/// Scratch memory for one pack of strands at a time.
#[derive(Debug, Clone)]
pub struct Workspace<T> {
    /// The strands as the step found them.
    pub loaded: Loaded<T>,
    /// Newton's iteration.
    pub iterate: Iterate<T>,
    /// Position of each point at the start of the last step, relative to the root's origin then.
    pub past_base: Vec<Vec3<T>>,
    /// Displacement of each point at the start of the step by the rounding errors of the curvatures (f32 only).
    pub base_compensation: Vec<Vec3<T>>,
    /// The same at the start of the last step.
    pub past_compensation: Vec<Vec3<T>>,
    /// The stages of the step.
    pub stages: [Stage<T>; MAX_STAGES],
    /// The stage that ends the step; its curvatures are those of `iterate`.
    pub last_stage: usize,
    /// Poses of the roots at the end of the last stage.
    pub roots: [Frame; MAX_LANES],
    /// The roots' mean velocities over the step, m/s and rad/s, world axes.
    pub root_velocities: [(Vector3<f64>, Vector3<f64>); MAX_LANES],
    /// Contacts at the end of the step, with their lanes.
    pub point_contacts: Vec<(usize, PointContact)>,
    /// Force on the follicles.
    pub wrench_force: Vec3<T>,
    /// Torque on the follicles about their origins.
    pub wrench_torque: Vec3<T>,
}

impl<T: Lane> Default for Workspace<T> {
    fn default() -> Self {
        Self {
            loaded: Loaded::default(),
            iterate: Iterate::default(),
            past_base: Vec::new(),
            base_compensation: Vec::new(),
            past_compensation: Vec::new(),
            stages: std::array::from_fn(|_| Stage::default()),
            last_stage: 0,
            roots: [Frame::default(); MAX_LANES],
            root_velocities: [(Vector3::zeros(), Vector3::zeros()); MAX_LANES],
            point_contacts: Vec::new(),
            wrench_force: Vec3::zero(),
            wrench_torque: Vec3::zero(),
        }
    }
}
