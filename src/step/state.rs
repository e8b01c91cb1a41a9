//! The state of a strand: what a step changes.

use std::ops::{Deref, DerefMut};
use std::sync::LazyLock;

use nalgebra::Vector3;

use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::rod::velocity::{self, RootMotion};

/// The state of one strand at one time.
#[derive(Debug, PartialEq)]
#[repr(C)] // In this order: what sampling reads comes first.
pub struct StrandState {
    /// Pose of the root.
    pub root: Frame,
    /// κ, one row per element.
    pub curvatures: Vec<[f64; 3]>,
    /// Velocity of the material points at the quadrature nodes, world axes, m/s. A field of its own and not J q̇: over a step
    /// with a large rotation a point's chord is shorter than its arc, and taking the arc's velocity would add energy.
    pub velocities: Vec<Vec3<f64>>,
    /// The quadrature rule of the nodes.
    pub rule: usize,
    /// κ̇, one row per element.
    pub rates: Vec<[f64; 3]>,
    /// Velocity of the root's origin, m/s.
    pub root_velocity: Vector3<f64>,
    /// Angular velocity of the root, world axes, rad/s.
    pub root_angular_velocity: Vector3<f64>,
    /// Force on the follicle, N.
    pub wrench_force: Vec3<f64>,
    /// Torque on the follicle about its origin, N·m.
    pub wrench_torque: Vec3<f64>,
    /// The last step, for integrators that need its history.
    pub history: History,
    /// How often to halve the next step from its start: the halvings that the last one needed.
    pub subdivision: u32,
    /// Velocities of the air at the quadrature nodes in the coming step, where there is a field of wind.
    pub air: Option<Box<Air>>,
}

/// Velocities of the air along a strand.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Air {
    /// At the quadrature nodes, world axes, m/s.
    pub velocities: Vec<Vec3<f64>>,
}

/// The history of the two-step method: the strand at the start of the last step. A strand that never had one uses no memory for
/// it.
#[derive(Debug, Default)]
pub struct History {
    /// Seconds from then to now; 0 for no history.
    pub step: f64,
    earlier: Option<Box<Earlier>>,
}

/// A strand at the start of the last step.
#[derive(Debug, PartialEq, Default)]
pub struct Earlier {
    /// κ then.
    pub curvatures: Vec<[f64; 3]>,
    /// Velocities of the points then, at the nodes of the current rule.
    pub velocities: Vec<Vec3<f64>>,
    /// Pose of the root then.
    pub root: Frame,
}

/// Reads as the history of a strand that has none.
static NOTHING: LazyLock<Earlier> = LazyLock::new(Earlier::default);

impl Deref for History {
    type Target = Earlier;

    #[inline(always)]
    fn deref(&self) -> &Earlier {
        self.earlier.as_deref().unwrap_or_else(|| &NOTHING)
    }
}

impl DerefMut for History {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Earlier {
        self.earlier.get_or_insert_default()
    }
}

impl History {
    /// The strand `step` seconds ago.
    pub fn new(step: f64, earlier: Earlier) -> Self {
        Self { step, earlier: Some(Box::new(earlier)) }
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        self.earlier.as_ref().map_or(0, |earlier| {
            size_of::<Earlier>() + size_of::<[f64; 3]>() * (earlier.curvatures.capacity() + earlier.velocities.capacity())
        })
    }
}

impl PartialEq for History {
    fn eq(&self, other: &Self) -> bool {
        self.step == other.step && (self.step == 0.0 || **self == **other)
    }
}

// Written out, because a derived clone_from would reallocate, and the state is copied before every step.
impl Clone for History {
    fn clone(&self) -> Self {
        let mut clone = Self::default();
        clone.clone_from(self);
        clone
    }

    fn clone_from(&mut self, source: &Self) {
        self.step = source.step;
        // Without a history the contents are never read.
        if source.step > 0.0 {
            let Earlier { curvatures, velocities, root } = &**source;
            let earlier = &mut **self;
            earlier.curvatures.clone_from(curvatures);
            earlier.velocities.clone_from(velocities);
            earlier.root = *root;
        }
    }
}

/// The rotation matrix of a frame, for the kernels.
pub fn rotation_matrix(frame: &Frame) -> Mat3<f64> {
    Mat3::from(frame.rotation.to_rotation_matrix().into_inner())
}

impl Clone for StrandState {
    fn clone(&self) -> Self {
        let mut clone = Self::default();
        clone.clone_from(self);
        clone
    }

    fn clone_from(&mut self, source: &Self) {
        let Self {
            curvatures,
            rates,
            velocities,
            history,
            rule,
            root,
            root_velocity,
            root_angular_velocity,
            wrench_force,
            wrench_torque,
            subdivision,
            air,
        } = source;
        self.curvatures.clone_from(curvatures);
        self.rates.clone_from(rates);
        self.velocities.clone_from(velocities);
        self.history.clone_from(history);
        match (&mut self.air, air) {
            (Some(to), Some(from)) => to.velocities.clone_from(&from.velocities),
            (to, from) => to.clone_from(from),
        }
        (self.rule, self.root, self.subdivision) = (*rule, *root, *subdivision);
        (self.root_velocity, self.root_angular_velocity) = (*root_velocity, *root_angular_velocity);
        (self.wrench_force, self.wrench_torque) = (*wrench_force, *wrench_torque);
    }
}

impl Default for StrandState {
    fn default() -> Self {
        Self {
            curvatures: Vec::new(),
            rates: Vec::new(),
            velocities: Vec::new(),
            rule: 0,
            root: Frame::default(),
            root_velocity: Vector3::zeros(),
            root_angular_velocity: Vector3::zeros(),
            wrench_force: Vec3::zero(),
            wrench_torque: Vec3::zero(),
            history: History::default(),
            subdivision: 0,
            air: None,
        }
    }
}

impl StrandState {
    /// A strand with the given curvatures, rates and motion of the root.
    pub fn new(
        model: &StrandModel,
        rules: &Rules,
        curvatures: Vec<[f64; 3]>,
        rates: Vec<[f64; 3]>,
        root: Frame,
        root_velocity: Vector3<f64>,
        root_angular_velocity: Vector3<f64>,
    ) -> Self {
        let mut state = Self { curvatures, rates, root, root_velocity, root_angular_velocity, ..Self::default() };
        state.velocities_from_rates(model, rules);
        state
    }

    /// Sets the points' velocities to those of the root's motion and the curvatures' rates.
    pub fn velocities_from_rates(&mut self, model: &StrandModel, rules: &Rules) {
        self.rule = rules.next_for_angle(0, model.largest_angle(&self.curvatures));
        let points = model.element_count() * rules.rule(self.rule).len();
        self.velocities.clear();
        self.velocities.reserve_exact(points);
        self.velocities.resize(points, Vec3::zero());
        let root = RootMotion {
            velocity: self.root_velocity.into(),
            angular_velocity: self.root_angular_velocity.into(),
            ..RootMotion::still()
        };
        self.history.step = 0.0;
        self.subdivision = 0;
        let at_rest = self.root_velocity == Vector3::zeros()
            && self.root_angular_velocity == Vector3::zeros()
            && self.rates.iter().all(|row| *row == [0.0; 3]);
        if at_rest {
            return;
        }
        let mut kinematics = Kinematics::default();
        kinematics.update(&rotation_matrix(&self.root), &model.lengths, &self.curvatures, rules.rule(self.rule));
        let velocities = &mut self.velocities;
        velocity::for_each_point(&kinematics, &self.rates, &root, |p, v, _| velocities[p] = v);
    }

    /// Changes to the quadrature rule of the current shape and carries the velocities over: to more points by interpolation, to
    /// fewer as the polynomial nearest in the mean square. Momentum stays. Kinetic energy stays too, or falls by what fewer
    /// points cannot represent.
    pub fn adapt_rule(&mut self, model: &StrandModel, rules: &Rules, scratch: &mut RuleScratch) {
        let wanted = rules.next_for_angle(self.rule, model.largest_angle(&self.curvatures));
        if wanted == self.rule {
            return;
        }
        let (from, to) = (rules.rule(self.rule), rules.rule(wanted));
        let history = if self.history.step > 0.0 { Some(&mut self.history.velocities) } else { None };
        let air = self.air.as_deref_mut().map(|air| &mut air.velocities).filter(|air| air.len() == self.velocities.len());
        for velocities in [Some(&mut self.velocities), history, air].into_iter().flatten() {
            scratch.velocities.clear();
            scratch.velocities.resize(model.element_count() * to.len(), Vec3::zero());
            for node in 0..to.len() {
                from.transfer(to, node, &mut scratch.coefficients);
                for element in 0..model.element_count() {
                    let mut sum = Vec3::zero();
                    for (k, coefficient) in scratch.coefficients.iter().enumerate() {
                        sum += velocities[element * from.len() + k].scale(*coefficient);
                    }
                    scratch.velocities[element * to.len() + node] = sum;
                }
            }
            // Copied, not swapped: a strand must not keep the capacity of the scratch memory.
            velocities.reserve_exact(scratch.velocities.len().saturating_sub(velocities.len()));
            velocities.clone_from(&scratch.velocities);
        }
        self.rule = wanted;
    }

    /// Velocities of the air at the nodes, if a field of wind gave them for the present rule.
    #[inline(always)]
    pub fn air(&self) -> Option<&[Vec3<f64>]> {
        self.air.as_deref().map(|air| &*air.velocities).filter(|air| air.len() == self.velocities.len())
    }

    /// Moves the root at once: the shape, and the velocities in the root's axes, stay as they are.
    pub fn teleport(&mut self, root: Frame) {
        let turn = root.rotation * self.root.rotation.inverse();
        let turned = |velocity: &mut Vec3<f64>| *velocity = Vec3::from(turn * Vector3::from(*velocity));
        self.velocities.iter_mut().for_each(turned);
        if self.history.step > 0.0 {
            let history = &mut *self.history;
            history.velocities.iter_mut().for_each(turned);
            history.root = Frame {
                origin: root.origin + turn * (history.root.origin - self.root.origin),
                rotation: turn * history.root.rotation,
            };
        }
        self.root_velocity = turn * self.root_velocity;
        self.root_angular_velocity = turn * self.root_angular_velocity;
        self.root = root;
    }

    /// Frees the lists' spare capacity.
    pub fn shrink(&mut self) {
        self.curvatures.shrink_to_fit();
        self.rates.shrink_to_fit();
        self.velocities.shrink_to_fit();
        if self.history.step == 0.0 {
            self.history = History::default();
        } else {
            self.history.curvatures.shrink_to_fit();
            self.history.velocities.shrink_to_fit();
        }
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        let rows = self.curvatures.capacity() + self.rates.capacity() + self.velocities.capacity();
        let air = self.air.as_ref().map_or(0, |air| size_of::<Air>() + size_of::<[f64; 3]>() * air.velocities.capacity());
        rows * size_of::<[f64; 3]>() + self.history.heap_bytes() + air
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.curvatures.iter().flatten().chain(self.rates.iter().flatten()).all(|x| x.is_finite())
            && self.velocities.iter().all(|v| v.0.iter().all(|x| x.is_finite()))
    }
}

/// Scratch memory for [`StrandState::adapt_rule`].
#[derive(Debug, Clone, Default)]
pub struct RuleScratch {
    coefficients: Vec<f64>,
    velocities: Vec<Vec3<f64>>,
}
