//! Strands that lie exactly along what presses them. In the linear model a straight strand cannot yield to a push along itself:
//! no force along it moves the point on which it acts, J H⁻¹ Jᵀ is singular there, and the contact problem finds no force that
//! helps. The strand is at a maximum of the potential, on which Newton's iteration may rest though every direction leads down.
//! It is bent a little, as far as takes its end out of the overlap, and to a side chosen by its index: the same in every run.

use nalgebra::Vector3;

use super::Island;
use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind};
use crate::contact::options::ContactOptions;
use crate::coupled::constrained_strand::{ConstrainedStrand, Strands};
use crate::math::functions::trigonometry::sine_cosine;
use crate::step::Setting;
use crate::step::constrained::packs::AnyPack;

/// A point cannot yield along a direction in which its response is less than this fraction of its trace.
const STUCK: f64 = 1e-9;
/// How often in a step an island's strands are bent in this way.
const MAX_KINKS: u32 = 3;
/// The largest turn of a strand, rad.
const MAX_TURN: f64 = 1.0;
/// The side turns by this from strand to strand, rad: the golden angle.
const SIDES: f64 = 2.399_963_229_728_653;
/// Bilateral constraints are considered if they are off by more than this, m.
const OFF: f64 = 1e-8;

/// A strand to be bent, and the turn of all of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// Index among the constrained strands.
    pub strand: u32,
    /// rad.
    pub turn: f64,
}

impl Island {
    /// After convergence: the strands that have to yield along themselves and cannot.
    pub fn kinks(&mut self, strands: &(impl Strands + ?Sized), options: &ContactOptions) -> Vec<Kink> {
        let mut kinks: Vec<Kink> = Vec::new();
        if self.progress.kinked >= MAX_KINKS {
            return kinks;
        }
        for (constraint, ends) in self.constraints.iter().zip(&self.ends) {
            // The direction in which its first end has to move, and the distance.
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
                // It can yield by bending only towards the root.
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
            self.progress.kinked += 1;
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

    /// Bends it.
    pub fn bend(&mut self, kink: &Kink, setting: &Setting, pack: &mut AnyPack) {
        let (sine, cosine) = sine_cosine(SIDES * f64::from(self.index));
        let curvature = kink.turn / self.length();
        pack.bend(self.lane as usize, [curvature * cosine, curvature * sine], setting, &mut self.step);
        self.residual = f64::INFINITY;
        self.rest.stir();
        self.moved();
    }
}
