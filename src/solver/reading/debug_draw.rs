//! Debug drawing: what a solver knows, as coloured lines and points in batches.

use nalgebra::{UnitQuaternion, Vector3};

use super::sampling::Sampler;
use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::math::disjoint_sets::DisjointSets;
use crate::solver::Solver;
use crate::solver::bodies::ContactPartner;
use crate::solver::constraints::{ConstraintStatus, Hold};
use crate::solver::id::StrandId;
use crate::solver::report::StrandStatus;
use crate::solver::strands::strand::Strand;

/// Most vertices of a batch; even, so that no line is split.
pub const DEBUG_BATCH: usize = 1024;

/// What there is to draw. A set of these is the sum of their numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum DebugLayer {
    /// Centrelines, coloured by how the strand's last substep went: beige converged, orange unconverged, red quarantined, blue frozen.
    Centrelines = 1,
    /// Material frames at the ends of elements: tangent red, first normal green, second normal blue.
    Frames = 2,
    /// Contacts of the last substep: a point on the centreline, the normal (yellow), and the force on the strand (magenta).
    Contacts = 4,
    /// Centrelines coloured by island: strands that contacts or ties couple share a colour, strands alone are grey. In place of [`Self::Centrelines`].
    Islands = 8,
    /// Outlines of bodies, green.
    Bodies = 16,
    /// Constraints: a point on the strand, a line to where it is to be (cyan), and the force on the strand (magenta).
    Constraints = 32,
}

/// All layers.
const ALL_LAYERS: u32 = 63;

/// What is drawn, and how large.
///
/// ```
/// use superhelix::reading::{DebugCanvas, DebugDraw, DebugLayer, DebugVertex};
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// struct Lines(usize);
///
/// impl DebugCanvas for Lines {
///     fn lines(&mut self, vertices: &[DebugVertex]) {
///         self.0 += vertices.len() / 2;
///     }
///     fn points(&mut self, _: &[DebugVertex]) {}
/// }
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// solver.add_strands(&[StrandDef::straight(0.2, 5)])?;
/// let mut lines = Lines(0);
/// solver.debug_draw(&DebugDraw { layers: DebugLayer::Centrelines as u32, ..DebugDraw::default() }, &mut lines)?;
/// assert_eq!(lines.0, 16);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DebugDraw {
    /// Sum of [`DebugLayer`]s; at least one.
    pub layers: u32,
    /// Points of a centreline, 2 to 4096.
    pub points_per_strand: u32,
    /// Length of the axes of a frame, m; above zero.
    pub frame_length: f64,
    /// Length of a contact's normal, m; above zero.
    pub normal_length: f64,
    /// Length of a force of one newton, m/N; zero (none are drawn) or above.
    pub force_scale: f64,
}

impl Default for DebugDraw {
    fn default() -> Self {
        let layers = DebugLayer::Centrelines as u32 | DebugLayer::Contacts as u32 | DebugLayer::Bodies as u32;
        Self { layers, points_per_strand: 17, frame_length: 5e-3, normal_length: 5e-3, force_scale: 100.0 }
    }
}

impl DebugDraw {
    /// Checks every value; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        if self.layers == 0 || self.layers & !ALL_LAYERS != 0 {
            return Err(Error::invalid(format!("{argument}.layers"), self.layers, format!("a sum of layers, 1 to {ALL_LAYERS}")));
        }
        if !(2..=4096).contains(&self.points_per_strand) {
            return Err(Error::invalid(format!("{argument}.points_per_strand"), self.points_per_strand, "2 to 4096"));
        }
        check_positive(|| format!("{argument}.frame_length"), self.frame_length)?;
        check_positive(|| format!("{argument}.normal_length"), self.normal_length)?;
        check_not_negative(|| format!("{argument}.force_scale"), self.force_scale)
    }

    fn has(&self, layer: DebugLayer) -> bool {
        self.layers & layer as u32 != 0
    }
}

/// A point, or an end of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DebugVertex {
    /// World, m.
    pub position: Vector3<f64>,
    /// 0xRRGGBB.
    pub colour: u32,
    /// What it belongs to.
    pub layer: DebugLayer,
}

/// Takes batches of at most [`DEBUG_BATCH`] vertices.
pub trait DebugCanvas {
    /// Lines: a pair of vertices each.
    fn lines(&mut self, vertices: &[DebugVertex]);
    /// Points.
    fn points(&mut self, vertices: &[DebugVertex]);
}

const CONVERGED: u32 = 0x00D2_B48C;
const UNCONVERGED: u32 = 0x00FF_8C00;
const QUARANTINED: u32 = 0x00FF_0000;
const FROZEN: u32 = 0x0064_95ED;
const ALONE: u32 = 0x0080_8080;
const AXES: [u32; 3] = [0x00FF_3030, 0x0030_C030, 0x0030_60FF];
const NORMAL: u32 = 0x00FF_E000;
const FORCE: u32 = 0x00FF_00FF;
const BODY: u32 = 0x0060_B060;
const TARGET: u32 = 0x0000_D0D0;
/// Colours that are easy to tell apart.
const ISLANDS: [u32; 12] = [
    0x00E6_194B,
    0x003C_B44B,
    0x00FF_E119,
    0x0043_63D8,
    0x00F5_8231,
    0x0091_1EB4,
    0x0042_D4F4,
    0x00F0_32E6,
    0x00BF_EF45,
    0x0046_9990,
    0x009A_6324,
    0x0080_8000,
];

/// Batches on their way to a canvas.
struct Painter<'a> {
    canvas: &'a mut dyn DebugCanvas,
    lines: Vec<DebugVertex>,
    points: Vec<DebugVertex>,
    layer: DebugLayer,
}

impl Painter<'_> {
    fn line(&mut self, ends: [Vector3<f64>; 2], colour: u32) {
        self.lines.extend(ends.map(|position| DebugVertex { position, colour, layer: self.layer }));
        if self.lines.len() == DEBUG_BATCH {
            self.canvas.lines(&self.lines);
            self.lines.clear();
        }
    }

    fn arrow(&mut self, from: Vector3<f64>, along: Vector3<f64>, colour: u32) {
        if along != Vector3::zeros() {
            self.line([from, from + along], colour);
        }
    }

    fn point(&mut self, position: Vector3<f64>, colour: u32) {
        self.points.push(DebugVertex { position, colour, layer: self.layer });
        if self.points.len() == DEBUG_BATCH {
            self.canvas.points(&self.points);
            self.points.clear();
        }
    }

    fn axes(&mut self, origin: Vector3<f64>, rotation: &UnitQuaternion<f64>, length: f64) {
        for (axis, colour) in AXES.into_iter().enumerate() {
            self.line([origin, origin + rotation * Vector3::ith(axis, length)], colour);
        }
    }

    fn finish(self) {
        if !self.lines.is_empty() {
            self.canvas.lines(&self.lines);
        }
        if !self.points.is_empty() {
            self.canvas.points(&self.points);
        }
    }
}

impl Solver {
    /// Draws the state as of the last step, layer by layer, on a canvas: read-only, with memory for one batch, in an order that does not depend on
    /// workers.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `options.field`. Nothing was drawn then.
    pub fn debug_draw(&self, options: &DebugDraw, canvas: &mut dyn DebugCanvas) -> Result<()> {
        options.check("options")?;
        let room = || Vec::with_capacity(DEBUG_BATCH);
        let mut painter = Painter { canvas, lines: room(), points: room(), layer: DebugLayer::Bodies };
        if options.has(DebugLayer::Bodies) {
            self.draw_bodies(&mut painter);
        }
        if options.has(DebugLayer::Islands) {
            painter.layer = DebugLayer::Islands;
            let islands = self.islands();
            self.draw_centrelines(options, &mut painter, |index| {
                islands[index].map_or(ALONE, |island| ISLANDS[island as usize % ISLANDS.len()])
            });
        } else if options.has(DebugLayer::Centrelines) {
            painter.layer = DebugLayer::Centrelines;
            self.draw_centrelines(options, &mut painter, |index| colour_of(&self.strands[index]));
        }
        if options.has(DebugLayer::Frames) {
            painter.layer = DebugLayer::Frames;
            self.draw_frames(options, &mut painter);
        }
        if options.has(DebugLayer::Contacts) {
            painter.layer = DebugLayer::Contacts;
            for contact in self.contacts() {
                painter.point(contact.position, NORMAL);
                painter.arrow(contact.position, contact.normal * options.normal_length, NORMAL);
                painter.arrow(contact.position, contact.force * options.force_scale, FORCE);
            }
        }
        if options.has(DebugLayer::Constraints) {
            painter.layer = DebugLayer::Constraints;
            self.draw_constraints(options, &mut painter);
        }
        painter.finish();
        Ok(())
    }

    fn draw_bodies(&self, painter: &mut Painter) {
        for scene_body in &self.bodies {
            let def = scene_body.body.def();
            let place = |point: Vector3<f64>| def.pose.origin + def.pose.rotation * point;
            def.shape.outline(|a, b| painter.line([place(a), place(b)], BODY));
        }
    }

    fn draw_centrelines(&self, options: &DebugDraw, painter: &mut Painter, colour: impl Fn(usize) -> u32) {
        let last = options.points_per_strand - 1;
        for (index, strand) in self.strands.iter().enumerate() {
            let (mut sampler, length, colour) = (Sampler::new(strand, &self.rules), strand.model.length(), colour(index));
            let mut before = strand.state.root.origin;
            for point in 1..=last {
                let here = sampler.go(length * (f64::from(point) / f64::from(last))).position();
                painter.line([before, here], colour);
                before = here;
            }
        }
    }

    fn draw_frames(&self, options: &DebugDraw, painter: &mut Painter) {
        for strand in &self.strands {
            let mut sampler = Sampler::new(strand, &self.rules);
            painter.axes(strand.state.root.origin, &strand.state.root.rotation, options.frame_length);
            let mut arclength = 0.0;
            for length in strand.model.lengths.iter() {
                arclength += length;
                let place = sampler.go(arclength);
                painter.axes(place.position(), &place.rotation(), options.frame_length);
            }
        }
    }

    fn draw_constraints(&self, options: &DebugDraw, painter: &mut Painter) {
        let place = |id: StrandId, arclength: f64| {
            let strand = &self.strands[self.slots.index(id)?];
            Some(Sampler::new(strand, &self.rules).go(arclength).position())
        };
        for constraint in self.constraints.iter().filter(|constraint| constraint.state.status != ConstraintStatus::Released) {
            let Some(held) = place(constraint.def.strand, constraint.state.arclength) else { continue };
            let target = match constraint.def.hold {
                Hold::Tie { other, arclength } => place(other, arclength),
                _ => Some(constraint.motion.pose.origin),
            };
            painter.point(held, TARGET);
            if let Some(target) = target {
                painter.arrow(held, target - held, TARGET);
            }
            painter.arrow(held, constraint.state.force * options.force_scale, FORCE);
        }
    }

    /// The island of each strand, by its first strand; none for strands that nothing couples to another one. From the contacts of the last substep and
    /// the ties that there are.
    fn islands(&self) -> Vec<Option<u32>> {
        let mut sets = DisjointSets::default();
        sets.reset(self.strands.len());
        let touching = self.contacts().iter().filter_map(|contact| match contact.partner {
            ContactPartner::Strand { strand, .. } => Some((contact.strand, strand)),
            ContactPartner::Body { .. } => None,
        });
        let tied = self.constraints.iter().filter_map(|constraint| Some((constraint.def.strand, constraint.other()?)));
        let mut coupled = vec![false; self.strands.len()];
        for (a, b) in touching.chain(tied) {
            let (Some(a), Some(b)) = (self.slots.index(a), self.slots.index(b)) else { continue };
            if a == b {
                continue;
            }
            (coupled[a], coupled[b]) = (true, true);
            sets.join(a as u32, b as u32);
        }
        (0..coupled.len()).map(|index| coupled[index].then(|| sets.lowest(index as u32))).collect()
    }
}

fn colour_of(strand: &Strand) -> u32 {
    match strand.status() {
        StrandStatus::Quarantined => QUARANTINED,
        StrandStatus::Unconverged => UNCONVERGED,
        StrandStatus::Ok if strand.frozen.is_some() => FROZEN,
        StrandStatus::Ok => CONVERGED,
    }
}
