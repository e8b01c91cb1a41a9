//! Fast bodies: substeps in which a body moves far among strands, or a strand swings far past a thin body, are subdivided for the
//! whole scene.
//!
//! A strand that is swept along turns, and its contact slides along it. In one step the initial contact says little about the
//! final one, and thin bodies could come out behind the strand.

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::contact::body_at::BodyAt;
use crate::contact::shape::Bounds;
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;
use crate::solver::Solver;
use crate::solver::strands::strand::Strand;

/// In a substep a body moves among strands by at most this fraction of their length, or of half its own least extent, whichever
/// is more.
const PART_OF_LENGTH: f64 = 0.02;
const PART_OF_EXTENT: f64 = 0.5;
/// A body is thin if the first limit applies and half its least extent is at most this, m. A strand moves past a thin body by its
/// own speed by at most this fraction of its length.
const THIN: f64 = 0.05;
const THICK: f64 = 0.02;
const SWING: f64 = 0.25;
/// The largest number of substeps.
const MAX_PARTS: u32 = 32;
/// The largest number of substeps for a body that follows for a strand: it may take several steps.
const MAX_PARTS_TO_FOLLOW: f64 = 4.0;

/// A body that passes a strand in the next substep, as seen from the strand's root.
pub(super) struct Passing {
    /// Its pose if it moved along with the root.
    pub along: Frame,
    /// The largest displacement from there of any of its points in reach of the strand, m.
    pub travel: f64,
    /// The largest displacement per substep, m.
    pub limit: f64,
}

impl Passing {
    /// A body that comes from the pose `from`, past a strand of this `length` whose root moves from pose to pose.
    pub fn new(from: &Frame, body: &BodyAt, [root_from, root_to]: &[Frame; 2], length: f64) -> Self {
        let along = from.carried(root_from, root_to);
        let turned = rotation_vector(&(body.end.rotation * along.rotation.inverse())).norm();
        let arm = body.radius.min((root_from.origin - from.origin).norm() + length);
        let travel = (body.end.origin - along.origin).norm() + arm * turned;
        Self { along, travel, limit: limit(body, length) }
    }
}

/// The largest displacement of a body past a strand of this length per substep, m. (An infinite body is as flat from close up as
/// from afar.)
fn limit(body: &BodyAt, length: f64) -> f64 {
    let extent = body.half_extent();
    if extent.is_finite() { (PART_OF_EXTENT * extent).max(PART_OF_LENGTH * length) } else { f64::INFINITY }
}

impl Solver {
    /// Prepares all motions for a substep of `h` seconds: a motion of duration 0 takes all of it.
    pub(super) fn prepare_motions(&mut self, h: f64) {
        for body in &mut self.bodies {
            body.body.ready(h);
        }
        for constraint in &mut self.constraints {
            constraint.motion.begin(h);
        }
        for strand in &mut self.strands {
            strand.begin_moves(h);
        }
    }

    /// How many substeps the next substep of `h` seconds takes: more than one only if strands' substeps may be halved at all.
    pub(super) fn parts_of_substep(&self, h: f64) -> u32 {
        if self.options.step.max_subdivisions == 0 {
            return 1;
        }
        let going = |index: usize| {
            let body = self.bodies[index].body.at(index as u32, h);
            (body, travel(&body), body.half_extent())
        };
        let bodies = (0..self.bodies.len()).map(going).filter(|(.., extent)| extent.is_finite());
        let (mut fastest, mut crowd) = (None, None);
        let most = bodies.fold(1.0, |most, (body, travel, extent)| {
            let fastest = if extent <= THICK { *fastest.get_or_insert_with(|| self.fastest()) } else { f64::INFINITY };
            // (A thick body at rest is dealt with as quickly strand by strand.)
            let mut stays_slow =
                || crowd.get_or_insert_with(|| Crowd::of(&self.strands, h)).stays_slow(&body, travel, extent, fastest * h);
            if (travel > 0.0 || extent <= THICK) && stays_slow() {
                return most;
            }
            self.strands.iter().map(|strand| strand.parts(&body, travel, extent, fastest, h)).fold(most, f64::max)
        });
        most.ceil().min(f64::from(MAX_PARTS)) as u32
    }

    /// The largest speed of any point of a strand, m/s.
    fn fastest(&self) -> f64 {
        let squares = self.strands.iter().flat_map(|strand| &strand.state.velocities).map(|v| v.norm_squared());
        squares.fold(0.0, f64::max).sqrt()
    }
}

/// Bounds on all strands that collide, in a substep: most bodies need no look at each of them.
struct Crowd {
    /// Length of the shortest and of the longest, m.
    lengths: [f64; 2],
    /// How far a root's motion takes any of their points, m.
    carried: f64,
    /// Where the roots are when it begins.
    roots: Bounds,
    /// Whether some body still follows for a strand.
    follows: bool,
}

impl Crowd {
    fn of(strands: &[Strand], h: f64) -> Self {
        let mut all = Self { lengths: [f64::INFINITY, 0.0], carried: 0.0, roots: Bounds::EMPTY, follows: false };
        for strand in strands.iter().filter(|strand| strand.contact.is_some()) {
            let length = strand.model.length();
            all.lengths = [all.lengths[0].min(length), all.lengths[1].max(length)];
            all.roots.take(strand.state.root.origin);
            all.follows |= strand.divergence.is_some();
            if strand.root_move.is_some() {
                let (shift, angle) = shift_and_angle(&strand.root_during(h));
                all.carried = all.carried.max(shift + length * angle);
            }
        }
        all
    }

    /// Whether one substep is enough for all of them and a body of this half extent and displacement, as far as that is plain. No strand goes
    /// farther than `farthest` (m) by its own speed.
    fn stays_slow(&self, body: &BodyAt, travel: f64, extent: f64, farthest: f64) -> bool {
        let [shortest, longest] = self.lengths;
        if self.follows || travel + self.carried > (PART_OF_EXTENT * extent).max(PART_OF_LENGTH * shortest) {
            return false;
        }
        if extent > THICK || PART_OF_EXTENT * extent >= THIN * longest {
            return true;
        }
        let origin = body.start.origin;
        let arm = (self.roots.low - origin).abs().sup(&(self.roots.high - origin).abs()).norm();
        farthest + (body.end.origin - origin).norm() + arm * body.turn <= SWING * shortest
    }
}

/// How far the points of a body go at most, m.
fn travel(body: &BodyAt) -> f64 {
    (body.end.origin - body.start.origin).norm() + body.radius * body.turn
}

/// How far a root goes, m, and a bound on the angle by which it turns, rad. (An angle is at most π times the sine of its half.)
fn shift_and_angle([from, to]: &[Frame; 2]) -> (f64, f64) {
    let turn = to.rotation * from.rotation.inverse();
    ((to.origin - from.origin).norm(), PI * turn.quaternion().imag().norm())
}

impl Strand {
    /// How many substeps a strand and a body of this half extent and displacement need to pass each other; no strand is faster
    /// than `fastest` (m/s).
    fn parts(&self, at: &BodyAt, travel: f64, extent: f64, fastest: f64, h: f64) -> f64 {
        let Some(contact) = self.contact.as_deref() else { return 1.0 };
        let still = travel == 0.0 && self.root_move.is_none() && self.divergence.is_none();
        if still && extent > THICK {
            return 1.0;
        }
        let length = self.model.length();
        let is_thin = extent <= THICK && PART_OF_EXTENT * extent < THIN * length;
        if still && !is_thin || !at.meets(contact.groups, contact.mask) {
            return 1.0;
        }
        let swings = || if is_thin { self.swings_by(at, SWING * length, fastest, h) / (SWING * length) } else { 0.0 };
        if still {
            return if at.is_near(&self.reach(contact, &[self.state.root; 2])) { swings() } else { 1.0 };
        }
        let root = self.root_during(h);
        if let Some(from) = self.bodies_from().get(at.index as usize) {
            let passing = Passing::new(from, at, &root, length);
            return (passing.travel / passing.limit).min(MAX_PARTS_TO_FOLLOW);
        }
        let (shift, angle) = shift_and_angle(&root);
        let limit = limit(at, length);
        let goes_far = travel + (shift + length * angle) > limit;
        if !(goes_far || is_thin) || !at.is_near(&self.reach(contact, &root)) {
            return 1.0;
        }
        // An upper bound on its motion past the whole body: one substep is enough if that is within the limit.
        let away = (root[0].origin - at.start.origin).norm();
        if travel + shift + (away + at.radius.min(away + length)) * angle <= limit {
            return swings();
        }
        let passing = Passing::new(&at.start, at, &root, length);
        (passing.travel / passing.limit).max(swings())
    }

    /// Its motion past a body in a substep of `h` seconds by its own speed, m; 0 if at most `least`.
    fn swings_by(&self, body: &BodyAt, least: f64, fastest: f64, h: f64) -> f64 {
        let root = self.state.root.origin;
        let carried_to = body.end.origin + body.end.rotation * (body.start.rotation.inverse() * (root - body.start.origin));
        let carried = (carried_to - root) / h;
        if (fastest + carried.norm()) * h <= least {
            return 0.0;
        }
        let squares = self.state.velocities.iter().map(|v| (Vector3::from(*v) - carried).norm_squared());
        squares.fold(0.0, f64::max).sqrt() * h
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::contact::body::BodyDef;
    use crate::contact::options::StrandContact;
    use crate::contact::shape::Shape;
    use crate::math::random::signed_numbers;
    use crate::solver::definition::{SolverOptions, StrandDef};

    const H: f64 = 1e-3;

    /// Where the bounds on all strands say that a substep need not be divided, no strand says otherwise; and they say so often.
    #[test]
    fn what_holds_for_all_strands_holds_for_each() {
        let mut number = signed_numbers(11);
        let [mut told, mut divided] = [0, 0];
        for scene in 0..300 {
            let mut solver = Solver::new(SolverOptions::default()).unwrap();
            let mut point = |size: f64| size * Vector3::new(number(), number(), number());
            let speed = [0.01, 0.3, 3.0, 30.0][scene % 4];
            let defs: Vec<StrandDef> = (0..6)
                .map(|k| {
                    let mut def = StrandDef::straight(0.05 + 0.02 * f64::from(k), 3);
                    def.root = Frame { origin: point(0.05), rotation: UnitQuaternion::from_scaled_axis(point(1.0)) };
                    def
                })
                .collect();
            let ids = solver.add_strands(&defs).unwrap();
            solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
            let shapes = [Shape::new_sphere(0.08).unwrap(), Shape::new_capsule(-point(0.02), point(0.02), 0.001).unwrap()];
            let bodies = solver.add_bodies(shapes.into_iter().map(|shape| BodyDef::new(Arc::new(shape))).collect()).unwrap();
            if scene % 3 == 0 {
                solver.step(0.2 * f64::from(scene as u32 % 5) * H + H, 1).unwrap();
            }
            let frames: Vec<Frame> = bodies
                .iter()
                .map(|_| Frame { origin: point(speed * H), rotation: UnitQuaternion::from_scaled_axis(point(speed * H)) })
                .collect();
            solver.set_body_frames(&bodies, &frames, H).unwrap();
            if scene % 2 == 0 {
                let roots: Vec<Frame> =
                    defs.iter().map(|def| Frame { origin: def.root.origin + point(0.5 * speed * H), ..def.root }).collect();
                solver.set_root_frames(&ids, &roots, H).unwrap();
            }
            solver.prepare_motions(H);
            let (crowd, fastest) = (Crowd::of(&solver.strands, H), solver.fastest());
            for index in 0..2 {
                let body = solver.bodies[index].body.at(index as u32, H);
                let (travel, extent) = (travel(&body), body.half_extent());
                let parts =
                    solver.strands.iter().map(|strand| strand.parts(&body, travel, extent, fastest, H)).fold(1.0, f64::max);
                if crowd.stays_slow(&body, travel, extent, fastest * H) {
                    told += 1;
                    assert!(parts <= 1.0, "{scene} {index}: {parts}");
                }
                divided += usize::from(parts > 1.0);
            }
        }
        assert!(told > 100 && divided > 30, "{told} {divided}");
    }
}
