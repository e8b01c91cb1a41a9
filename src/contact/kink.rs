//! Strands that lie exactly along what presses them. A straight strand that is pushed along itself cannot give way in the linear model: no force along it
//! moves the place that it acts at, J H⁻¹ Jᵀ is singular there, and the contact problem finds none that helps. It is on the top of a hill, on
//! which Newton's iteration may rest, though every way leads down. Such a strand is bent a little, as far as takes its end out of what it is in, and to a side
//! that its number tells: the same each time.

use nalgebra::Vector3;

use super::constrained_strand::ConstrainedStrand;
use super::island::Island;
use super::options::ContactOptions;
use super::step_constraint::{ConstraintEnd, ConstraintKind};
use crate::math::trigonometry::sine_cosine;
use crate::step::Setting;
use crate::step::constrained_packs::AnyPack;

/// A place cannot give way along a direction in which its response is less than this part of all of it.
const STUCK: f64 = 1e-9;
/// How often in a step an island's strands are bent so.
const MAX_KINKS: u32 = 3;
/// A strand is bent by no more than this, rad.
const MAX_TURN: f64 = 1.0;
/// From strand to strand the side turns by this, rad: the golden angle.
const SIDES: f64 = 2.399_963_229_728_653;
/// What constraints are off by is looked at from here on, m.
const OFF: f64 = 1e-8;

/// A strand that is to be bent: which of the held ones, and by what turn in all, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// Index among the held strands.
    pub strand: u32,
    /// rad.
    pub turn: f64,
}

impl Island {
    /// At its end: the strands that cannot give way along themselves, and have to.
    pub fn kinks(&mut self, strands: &[ConstrainedStrand], options: &ContactOptions) -> Vec<Kink> {
        let mut kinks: Vec<Kink> = Vec::new();
        if self.kinked >= MAX_KINKS {
            return kinks;
        }
        for (constraint, ends) in self.constraints.iter().zip(&self.ends) {
            // Which way its first end has to go, and how far.
            let (direction, far) = match constraint.kind {
                ConstraintKind::Body { normal, .. } | ConstraintKind::Hair { normal, .. }
                    if constraint.gap < -0.5 * options.tolerance =>
                {
                    (normal, -constraint.gap)
                }
                ConstraintKind::Pin { target, .. } if constraint.gap > OFF => {
                    let off = target - strands[constraint.first.strand as usize].end_state(&constraint.first.material_point).now;
                    (off / off.norm().max(f64::MIN_POSITIVE), constraint.gap)
                }
                ConstraintKind::Tie { .. } if constraint.gap > OFF => {
                    let at = |end: &ConstraintEnd| strands[end.strand as usize].end_state(&end.material_point).now;
                    let off = constraint.second.as_ref().map_or(Vector3::zeros(), |second| at(second) - at(&constraint.first));
                    (off / off.norm().max(f64::MIN_POSITIVE), constraint.gap)
                }
                _ => continue,
            };
            let all = [
                Some((constraint.first, ends[0].point, direction)),
                constraint.second.map(|second| (second, ends[1].point, -direction)),
            ];
            let all = || all.iter().flatten();
            if !all().all(|(end, point, direction)| strands[end.strand as usize].is_stuck(*point, direction)) {
                continue;
            }
            for (end, _, direction) in all() {
                let strand = &strands[end.strand as usize];
                // Only towards the root can it give way by bending.
                let (root, _) = strand.step.now();
                let from_root = strand.end_state(&end.material_point).now - root;
                let length = strand.along(&end.material_point);
                if direction.dot(&from_root) < 0.0 && !kinks.iter().any(|kink| kink.strand == end.strand) {
                    // An arc of the angle θ is shorter than its length by θ²/24 of it.
                    let turn = (24.0 * far / length.max(f64::MIN_POSITIVE)).sqrt().min(MAX_TURN);
                    kinks.push(Kink { strand: end.strand, turn });
                }
            }
        }
        if !kinks.is_empty() {
            self.kinked += 1;
        }
        kinks
    }
}

impl ConstrainedStrand {
    /// Whether no force along a direction moves an attached point along it.
    fn is_stuck(&self, point: u32, direction: &Vector3<f64>) -> bool {
        let response = self.response(point);
        response.trace() > 0.0 && direction.dot(&(response * direction)) < STUCK * response.trace()
    }

    /// Bends it so.
    pub fn bend(&mut self, kink: &Kink, setting: &Setting, pack: &mut AnyPack) {
        let (sine, cosine) = sine_cosine(SIDES * f64::from(self.index));
        let curvature = kink.turn / self.length();
        pack.bend(self.lane as usize, [curvature * cosine, curvature * sine], setting, &mut self.step);
        (self.residual, self.resting) = (f64::INFINITY, false);
        self.moved();
    }
}
