//! What a step changes about a strand.

use nalgebra::Vector3;

use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::rod::velocity::{self, RootMotion};

/// The state of one strand at one time.
#[derive(Debug, PartialEq)]
pub struct StrandState {
    /// κ, a row an element.
    pub curvatures: Vec<[f64; 3]>,
    /// κ̇, a row an element.
    pub rates: Vec<[f64; 3]>,
    /// Velocity of the material points at the quadrature nodes, world axes, m/s. A field of its own and not J q̇: over a step with a
    /// large rotation the chord that a point moved along is shorter than its arc, and taking the arc's velocity would add energy.
    pub velocities: Vec<Vec3<f64>>,
    /// Which quadrature rule the nodes are of.
    pub rule: usize,
    /// Pose of the root.
    pub root: Frame,
    /// Velocity of the root's origin, m/s.
    pub root_velocity: Vector3<f64>,
    /// Angular velocity of the root, world axes, rad/s.
    pub root_angular_velocity: Vector3<f64>,
    /// Force on the follicle, N.
    pub wrench_force: Vec3<f64>,
    /// Torque on the follicle about its origin, N·m.
    pub wrench_torque: Vec3<f64>,
    /// The step before, for integrators that look back.
    pub past: Past,
    /// How often the next step is halved from its start: what the last one came to need.
    pub subdivision: u32,
}

/// What the two-step method remembers of the step before: the strand at its start.
#[derive(Debug, PartialEq)]
pub struct Past {
    /// κ then.
    pub curvatures: Vec<[f64; 3]>,
    /// Velocities of the points then, at the nodes of the present rule.
    pub velocities: Vec<Vec3<f64>>,
    /// Pose of the root then.
    pub root: Frame,
    /// Seconds from then to now; 0: there is no past.
    pub step: f64,
}

// Written out, because a derived clone_from allocates anew: the state is copied before every step.
impl Clone for Past {
    fn clone(&self) -> Self {
        let Self { curvatures, velocities, root, step } = self;
        Self { curvatures: curvatures.clone(), velocities: velocities.clone(), root: *root, step: *step }
    }

    fn clone_from(&mut self, source: &Self) {
        let Self { curvatures, velocities, root, step } = source;
        self.curvatures.clone_from(curvatures);
        self.velocities.clone_from(velocities);
        (self.root, self.step) = (*root, *step);
    }
}

impl Default for Past {
    fn default() -> Self {
        Self { curvatures: Vec::new(), velocities: Vec::new(), root: Frame::default(), step: 0.0 }
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
            past,
            rule,
            root,
            root_velocity,
            root_angular_velocity,
            wrench_force,
            wrench_torque,
            subdivision,
        } = source;
        self.curvatures.clone_from(curvatures);
        self.rates.clone_from(rates);
        self.velocities.clone_from(velocities);
        self.past.clone_from(past);
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
            past: Past::default(),
            subdivision: 0,
        }
    }
}

impl StrandState {
    /// A strand of given curvatures and rates whose root moves as told.
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
        let mut kinematics = Kinematics::default();
        kinematics.update(&rotation_matrix(&self.root), &model.lengths, &self.curvatures, rules.rule(self.rule));
        self.velocities.clear();
        self.velocities.resize(kinematics.points.len(), Vec3::zero());
        let root = RootMotion {
            velocity: self.root_velocity.into(),
            angular_velocity: self.root_angular_velocity.into(),
            ..RootMotion::still()
        };
        self.past.step = 0.0;
        self.subdivision = 0;
        let velocities = &mut self.velocities;
        velocity::for_each_point(&kinematics, &self.rates, &root, |p, v, _| velocities[p] = v);
    }

    /// Goes to the quadrature rule that the present shape needs, taking the velocities along: to more points by interpolation, to
    /// fewer as the polynomial that is nearest in the mean square. Kinetic energy stays or, by what fewer points cannot hold, falls;
    /// momentum stays.
    pub fn adapt_rule(&mut self, model: &StrandModel, rules: &Rules, scratch: &mut RuleScratch) {
        let wanted = rules.next_for_angle(self.rule, model.largest_angle(&self.curvatures));
        if wanted == self.rule {
            return;
        }
        let (from, to) = (rules.rule(self.rule), rules.rule(wanted));
        let past = if self.past.step > 0.0 { Some(&mut self.past.velocities) } else { None };
        for velocities in [Some(&mut self.velocities), past].into_iter().flatten() {
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
            std::mem::swap(velocities, &mut scratch.velocities);
        }
        self.rule = wanted;
    }

    /// Puts the root elsewhere at once: the shape and the velocities in the root's axes stay as they are.
    pub fn teleport(&mut self, root: Frame) {
        let turn = root.rotation * self.root.rotation.inverse();
        for velocity in self.velocities.iter_mut().chain(&mut self.past.velocities) {
            *velocity = Vec3::from(turn * Vector3::from(*velocity));
        }
        self.past.root = Frame {
            origin: root.origin + turn * (self.past.root.origin - self.root.origin),
            rotation: turn * self.past.root.rotation,
        };
        self.root_velocity = turn * self.root_velocity;
        self.root_angular_velocity = turn * self.root_angular_velocity;
        self.root = root;
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.curvatures.iter().flatten().chain(self.rates.iter().flatten()).all(|x| x.is_finite())
            && self.velocities.iter().all(|v| v.0.iter().all(|x| x.is_finite()))
    }
}

/// Room for [`StrandState::adapt_rule`].
#[derive(Debug, Clone, Default)]
pub struct RuleScratch {
    coefficients: Vec<f64>,
    velocities: Vec<Vec3<f64>>,
}
