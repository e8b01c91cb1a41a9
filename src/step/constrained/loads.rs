//! The loads of a pack's strands in lanes: those of an element side by side, so that one elimination includes them all.

use super::step::{Lanes, running};
use crate::chain::load::Load;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// Loads from root to tip, and their forces. A lane with fewer loads than others has empty ones.
#[derive(Debug)]
pub(super) struct PackLoads<T> {
    pub loads: Vec<Load<T>>,
    /// World axes, N.
    pub forces: Vec<Vec3<T>>,
}

impl<T> Default for PackLoads<T> {
    fn default() -> Self {
        Self { loads: Vec::new(), forces: Vec::new() }
    }
}

impl<T: Lane> PackLoads<T> {
    /// Makes room for this many material points.
    pub fn make_room(&mut self, material_points: usize) {
        self.loads.reserve(material_points.saturating_sub(self.loads.len()));
        self.forces.reserve(material_points.saturating_sub(self.forces.len()));
    }

    /// Removes all loads.
    pub fn clear(&mut self) {
        self.loads.clear();
    }

    /// Gives every material point of the strands, of this many elements each, a place among the loads.
    #[inline(always)]
    pub fn lay_out(&mut self, elements: usize, strands: Lanes) {
        strands.iter_mut().flatten().for_each(|constrained| constrained.slots.clear());
        let mut count = 0;
        for element in 0..elements {
            let first = count;
            for constrained in strands.iter_mut().flatten() {
                let mut next = first;
                while constrained
                    .material_points
                    .get(constrained.slots.len())
                    .is_some_and(|material_point| material_point.element == element)
                {
                    constrained.slots.push(next as u32);
                    next += 1;
                }
                while count < next {
                    match self.loads.get_mut(count) {
                        Some(load) => load.clear(element),
                        None => self.loads.push(Load::none(element)),
                    }
                    count += 1;
                }
            }
        }
        self.loads.truncate(count);
    }

    /// Puts the strands' loads into their places.
    #[inline(always)]
    pub fn fill(&mut self, strands: Lanes) {
        for (lane, constrained) in running(strands) {
            for (slot, load) in constrained.slots.iter().zip(&constrained.loads) {
                self.loads[*slot as usize].set_lane(lane, load);
            }
        }
    }

    /// No force acts.
    #[inline(always)]
    pub fn rest(&mut self) {
        self.forces.clear();
        self.forces.resize(self.loads.len(), Vec3::zero());
    }

    /// The strands' forces act, minus those of their springs.
    #[inline(always)]
    pub fn pull(&mut self, strands: Lanes) {
        self.rest();
        for (lane, constrained) in running(strands) {
            for (material_point, slot) in constrained.slots.iter().enumerate() {
                let pull = constrained.forces[material_point] - constrained.pulled(material_point);
                (0..3).for_each(|axis| self.forces[*slot as usize].0[axis].set_lane(lane, pull.0[axis]));
            }
        }
    }
}
