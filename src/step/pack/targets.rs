//! The targets of a pack's strands in lanes: what draws each quadrature point at the end of a stage.

use super::loaded::{Units, put};
use super::members::Pack;
use crate::math::lane::{Lane, MAX_LANES};
use crate::math::quadrature::Rule;
use crate::math::vector::Vec3;

/// Pulls of targets at the quadrature points.
#[derive(Debug, Clone)]
pub struct TargetLanes<T> {
    /// Whether a target draws any of the strands. If not, the lists have no meaning.
    pub are_present: bool,
    /// Inverse time constants; 0 for no pull.
    pub rates: Vec<T>,
    /// Where the points belong, relative to the roots' origins at the start of the step, world axes.
    pub positions: Vec<Vec3<T>>,
    /// How fast those places move.
    pub velocities: Vec<Vec3<T>>,
}

impl<T> Default for TargetLanes<T> {
    fn default() -> Self {
        Self { are_present: false, rates: Vec::new(), positions: Vec::new(), velocities: Vec::new() }
    }
}

impl<T: Lane> TargetLanes<T> {
    /// Loads the targets as they are `seconds` after the start of the step; lanes without a strand repeat the first.
    #[inline(always)]
    pub fn load(&mut self, members: &dyn Pack, seconds: f64, rule: &Rule, units: &[Units; MAX_LANES]) {
        if !self.are_present {
            return;
        }
        let count = members.count();
        let points = members.model(0).element_count() * rule.len();
        self.rates.resize(points, T::zero());
        self.positions.resize(points, Vec3::zero());
        self.velocities.resize(points, Vec3::zero());
        for lane in 0..T::LANES {
            let member = if lane < count { lane } else { 0 };
            let Some(at) = members.target(member) else {
                self.rates.iter_mut().for_each(|rate| rate.set_lane(lane, 0.0));
                self.positions.iter_mut().chain(&mut self.velocities).for_each(|to| put(&mut to.0, lane, &[0.0; 3], 1.0));
                continue;
            };
            let Units { length, time, .. } = units[lane];
            let (model, origin) = (members.model(member), Vec3::from(members.state(member).root.origin));
            at.target.for_each_point(at.from + seconds, &model.lengths, &rule.nodes, |p, pull| {
                self.rates[p].set_lane(lane, pull.rate * time);
                put(&mut self.positions[p].0, lane, &(pull.position - origin).0, 1.0 / length);
                put(&mut self.velocities[p].0, lane, &pull.velocity.0, time / length);
            });
        }
    }
}
