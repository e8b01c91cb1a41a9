//! A constrained strand that takes its step alone, an iteration at a time.

use super::pack::ConstrainedPack;
use super::step::ConstrainedStep;
use crate::chain::load::MaterialPoint;
use crate::math::vector::Vec3;
use crate::step::Setting;
use crate::step::pack::members::One;

/// A constrained strand outside any pack.
#[derive(Debug, Default)]
pub struct ConstrainedSingle {
    /// Its step.
    pub step: ConstrainedStep,
    pack: ConstrainedPack<f64>,
}

impl ConstrainedSingle {
    /// Makes room for this many material points.
    pub fn make_room(&mut self, material_points: usize) {
        self.step.make_room(material_points);
        self.pack.make_room(material_points);
    }

    /// Begins a step of `h` seconds; `first_order`: by implicit Euler, whatever the setting.
    pub fn begin(&mut self, one: &One, setting: &Setting, h: f64, first_order: bool) {
        self.pack.begin(one, setting, h, first_order, &mut [Some(&mut self.step)]);
    }

    /// [`ConstrainedStep::hold`], and the first half of an iteration.
    pub fn linearise(&mut self, material_points: &[MaterialPoint], guess: &[Vec3<f64>]) {
        self.step.hold(material_points, guess, &[]);
        self.pack.linearise(&mut [Some(&mut self.step)]);
    }

    /// [`ConstrainedStep::pull`], and the second half.
    pub fn advance(&mut self, setting: &Setting, forces: &[Vec3<f64>]) {
        self.step.pull(forces);
        self.pack.advance(setting, &mut [Some(&mut self.step)]);
    }
}
