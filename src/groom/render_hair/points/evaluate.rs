//! Evaluates the strands' points, in tiles and with many threads.

use nalgebra::Vector3;

use super::bodies::{Placed, Points, RenderBody, keep_out};
use super::curvature::{self, WIDTH};
use super::frames::frames;
use super::lengths::{self, Wanted, respace, taken_along};
use super::position::{Roots, mix};
use super::reach::{About, Reach};
use crate::error::{Error, Result, check_finite, check_positive};
use crate::groom::render_hair::RenderHair;
use crate::groom::render_hair::guides::pose::{RenderPose, VELOCITY_STEP};
use crate::groom::render_hair::guides::shape::{N1, PLACE, Shape};
use crate::groom::render_hair::map::strand::RenderStrand;
use crate::groom::render_hair::settings::MAX_GUIDES;
use crate::math::frame::Frame;
use crate::math::lane::Kernel;
#[cfg(target_arch = "x86_64")]
use crate::math::lane::Lane;
use crate::math::lanes::InstructionSet;
#[cfg(target_arch = "x86_64")]
use crate::math::lanes::{F64x4, F64x8};

/// Strands per task.
const TILE: usize = 8 * WIDTH;

/// Positions of the roots: maps strand `index` of the whole hair to metres.
pub type RootsAt<'a> = &'a (dyn Fn(usize) -> Vector3<f64> + Sync);

/// The source of velocities.
#[derive(Clone, Copy, Default)]
pub enum Motion<'a> {
    /// No velocities.
    #[default]
    None,
    /// The guides' own: the pose was set with velocities. Roots given by the host are assumed to move like the guides' roots.
    Guides,
    /// From the strands' positions some time ago.
    Since {
        /// The pose at that time, of the same map.
        before: &'a RenderPose,
        /// The time since then, s; above 0.
        seconds: f64,
        /// The roots' positions then, if [`View::roots`] gives the current ones.
        roots: Option<RootsAt<'a>>,
    },
}

/// What to evaluate.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// The first of the strands.
    pub first: usize,
    /// How many.
    pub count: usize,
    /// Subtracted from positions in f64, before they are narrowed to f32, m.
    pub origin: Vector3<f64>,
    /// The positions of the strands' roots (on a scalp that deforms). Without them every root follows the roots of its guides.
    pub roots: Option<RootsAt<'a>>,
    /// Whether to compute material frames.
    pub rotations: bool,
    /// The source of velocities, if they are wanted.
    pub motion: Motion<'a>,
    /// Bodies that strands stay out of, by [`RenderSettings::clearance`](crate::groom::render_hair::RenderSettings::clearance).
    pub bodies: &'a [RenderBody<'a>],
}

impl View<'_> {
    /// All strands of a map: points alone, relative to the world's origin, without bodies.
    pub fn whole(hair: &RenderHair) -> Self {
        Self {
            first: 0,
            count: hair.strand_count(),
            origin: Vector3::zeros(),
            roots: None,
            rotations: false,
            motion: Motion::None,
            bodies: &[],
        }
    }
}

/// A strand's points.
#[derive(Debug)]
pub struct StrandPoints<'a> {
    /// Index of the strand in the whole hair.
    pub strand: usize,
    /// Positions relative to the origin, m: x, y and z of every point.
    pub positions: [&'a [f32]; 3],
    /// Radius at every point of a strand of mean thickness, m; multiply by `radius_factor` for this strand's.
    pub radii: &'a [f32],
    /// This strand's thickness relative to the mean.
    pub radius_factor: f32,
    /// Frames as quaternions x, y, z, w: n0 along the strand, n1 near that of the first guide, parallel-transported from its
    /// follicle. Empty if not requested.
    pub rotations: [&'a [f32]; 4],
    /// Velocities, m/s. Empty if not requested.
    pub velocities: [&'a [f32]; 3],
}

/// Receives the points. Strands come in any order and from any thread, each once.
pub trait StrandSink: Sync {
    /// Receives a strand.
    fn take(&self, points: &StrandPoints);
}

/// A worker's memory.
#[derive(Debug, Default)]
pub(in crate::groom::render_hair) struct EvaluateScratch {
    now: Vec<f32>,
    before: Vec<f32>,
    rotations: Vec<f32>,
    guide_n1: Vec<f32>,
    room: Vec<f32>,
    lengths: lengths::Room,
    lengths_before: lengths::Room,
    reach: Reach,
    reach_before: Reach,
    bends: curvature::Room,
    bends_before: curvature::Room,
}

/// An earlier moment for velocities.
#[derive(Clone, Copy)]
struct Earlier<'a> {
    shape: &'a Shape,
    roots: Option<RootsAt<'a>>,
    /// 1/s.
    rate: f32,
    /// Whether the current roots given by the host go back like their guides' roots.
    carry: bool,
}

impl RenderPose {
    /// Evaluates some of the strands; `sink` receives each once. Uses the map's workers; or the host calls it in its own tasks
    /// for some of the strands each.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for nonexistent strands, numbers that are not finite, a pose that was never set, velocities
    /// from a pose of another map or from guides without velocities. The sink has then received nothing.
    pub fn evaluate(&self, view: &View, sink: &impl StrandSink) -> Result<()> {
        let hair = &**self.hair();
        if !self.is_set() {
            return Err(Error::invalid("pose", "never set", "a pose that was set"));
        }
        let total = hair.strands.len();
        if view.first > total {
            return Err(Error::invalid("first", view.first, format!("0 to {total}, the number of strands")));
        }
        if view.count > total - view.first {
            return Err(Error::invalid("count", view.count, format!("up to {}, of {total} strands", total - view.first)));
        }
        for axis in 0..3 {
            check_finite(|| format!("origin[{axis}]"), view.origin[axis])?;
        }
        let earlier = self.earlier(view)?;
        let check_roots = |name: &str, roots: Option<RootsAt>| -> Result<()> {
            let Some(roots) = roots else { return Ok(()) };
            for strand in view.first..view.first + view.count {
                let root = roots(strand);
                if !root.iter().all(|value| value.is_finite()) {
                    return Err(Error::invalid(format!("{name}[{strand}]"), format!("{:?}", root.as_slice()), "finite numbers"));
                }
            }
            Ok(())
        };
        for (index, body) in view.bodies.iter().enumerate() {
            body.check(&format!("bodies[{index}]"))?;
        }
        let placed = |pose: &dyn Fn(&RenderBody) -> Frame| -> Vec<Placed> {
            view.bodies.iter().map(|body| Placed::new(body, &pose(body), view.origin)).collect()
        };
        let bodies = placed(&|body| body.pose);
        let bodies_before = if earlier.is_some() { placed(&|body| body.pose_before) } else { Vec::new() };
        let around = [&bodies[..], &bodies_before[..]];
        check_roots("roots", view.roots)?;
        check_roots("roots_before", earlier.and_then(|earlier| earlier.roots))?;
        let evaluation = Reach::new_evaluation();
        let mut tiles: Vec<(usize, usize)> = (view.first..view.first + view.count)
            .step_by(TILE)
            .map(|first| (first, TILE.min(view.first + view.count - first)))
            .collect();
        let set = hair.settings.instruction_set.unwrap_or_else(InstructionSet::detected);
        hair.workers.for_each_task(&mut tiles, 1, usize::MAX, |tiles, scratch| {
            for (first, count) in tiles {
                let tile =
                    TileWork { pose: self, view, earlier, around, evaluation, first: *first, count: *count, scratch, sink };
                match set {
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => F64x8::call(tile),
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => F64x4::call(tile),
                    _ => tile.run(),
                }
            }
        });
        Ok(())
    }

    fn earlier<'a>(&'a self, view: &View<'a>) -> Result<Option<Earlier<'a>>> {
        match view.motion {
            Motion::None => Ok(None),
            Motion::Guides => {
                let Some(shape) = &self.before else {
                    return Err(Error::invalid("pose", "without velocities", "one that was set with velocities of the guides"));
                };
                let rate = (1.0 / VELOCITY_STEP) as f32;
                Ok(Some(Earlier { shape, roots: view.roots, rate, carry: view.roots.is_some() }))
            }
            Motion::Since { before, seconds, roots } => {
                if !std::sync::Arc::ptr_eq(self.hair(), before.hair()) {
                    return Err(Error::invalid("before", "a pose of another map", "one of the same"));
                }
                if !before.is_set() {
                    return Err(Error::invalid("before", "never set", "a pose that was set"));
                }
                check_positive(|| "seconds".into(), seconds)?;
                if roots.is_some() != view.roots.is_some() {
                    let (value, expected) =
                        if roots.is_some() { ("there", "none, as roots") } else { ("none", "as many as roots") };
                    return Err(Error::invalid("roots_before", value, expected));
                }
                Ok(Some(Earlier { shape: &before.now, roots, rate: (1.0 / seconds) as f32, carry: false }))
            }
        }
    }
}

/// Some strands.
struct TileWork<'a, S> {
    pose: &'a RenderPose,
    view: &'a View<'a>,
    earlier: Option<Earlier<'a>>,
    /// The bodies now and at the earlier moment.
    around: [&'a [Placed<'a>]; 2],
    evaluation: u64,
    first: usize,
    count: usize,
    scratch: &'a mut EvaluateScratch,
    sink: &'a S,
}

impl<S: StrandSink> Kernel for TileWork<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { pose, view, earlier, around, evaluation, first, count, scratch, sink } = self;
        let hair = &**pose.hair();
        let (stride, points, size) = (hair.reference.stride, hair.reference.points, hair.reference.size());
        let clearance = hair.settings.clearance as f32;
        let EvaluateScratch {
            now,
            before,
            rotations,
            guide_n1,
            room,
            lengths,
            lengths_before,
            reach,
            reach_before,
            bends,
            bends_before,
        } = scratch;
        now.resize(4 * stride, 0.0);
        before.resize(4 * stride, 0.0);
        rotations.resize(4 * stride, 0.0);
        let mut done = 0;
        while done < count {
            let begin = first + done;
            let side_by_side = WIDTH.min(count - done);
            let strands = &hair.strands[begin..begin + side_by_side];
            if hair.reference.curved {
                let curls = &hair.curls[begin..begin + side_by_side];
                curvature::bend(hair, &pose.now, strands, curls, bends);
                if let Some(earlier) = &earlier {
                    curvature::bend(hair, earlier.shape, strands, curls, bends_before);
                }
            }
            for (lane, strand) in strands.iter().enumerate() {
                let index = begin + lane;
                let given = view.roots.map(|roots| roots(index));
                let followed = follow(&pose.now, strand);
                let roots = roots(&pose.now, strand, given.unwrap_or(followed), view.origin);
                let range = 3 * stride * lane..3 * stride * (lane + 1);
                place(hair, &pose.now, index, &roots, bends.places.get(range.clone()), now);
                let about = About { evaluation, shape: &pose.now, bodies: around[0], clearance, stride, count: points, size };
                let moved = finish(hair, &about, strand, &roots, now, lengths, reach);
                if let Some(earlier) = &earlier {
                    let back = follow(earlier.shape, strand);
                    let root = match (earlier.carry, given) {
                        (true, Some(given)) => given + (back - followed),
                        _ => earlier.roots.map_or(back, |roots| roots(index)),
                    };
                    let roots = self::roots(earlier.shape, strand, root, view.origin);
                    place(hair, earlier.shape, index, &roots, bends_before.places.get(range), before);
                    let about = About { shape: earlier.shape, bodies: around[1], ..about };
                    finish(hair, &about, strand, &roots, before, lengths_before, reach_before);
                    for (before, now) in before.iter_mut().zip(now.iter()) {
                        *before = (*now - *before) * earlier.rate;
                    }
                }
                if view.rotations {
                    let rows = &pose.now.rows[strand.guides[0] as usize * hair.reference.size()..];
                    let mut across = &rows[N1 * stride..(N1 + 3) * stride];
                    if moved {
                        taken_along(&lengths.places, stride, points, across, guide_n1);
                        across = guide_n1;
                    }
                    frames(stride, points, across, now, room, rotations);
                }
                let part = |k: usize| k * stride..k * stride + points;
                let none: &[f32] = &[];
                let moving = earlier.is_some();
                sink.take(&StrandPoints {
                    strand: index,
                    positions: [&now[part(0)], &now[part(1)], &now[part(2)]],
                    radii: &hair.profiles.radius[..points],
                    radius_factor: strand.radius,
                    rotations: [0, 1, 2, 3].map(|k| if view.rotations { &rotations[part(k)] } else { none }),
                    velocities: [0, 1, 2].map(|k| if moving { &before[part(k)] } else { none }),
                });
            }
            done += side_by_side;
        }
    }
}

/// Keeps a mixed strand out of bodies and at its length. Takes rows of x, y and z, and of the target arclength of each point;
/// returns whether points were moved along.
#[inline(always)]
fn finish(
    hair: &RenderHair,
    about: &About,
    strand: &RenderStrand,
    roots: &Roots,
    rows: &mut [f32],
    lengths: &mut lengths::Room,
    reach: &mut Reach,
) -> bool {
    let About { shape, bodies, clearance, stride, count, size, .. } = *about;
    let (rows, along) = rows.split_at_mut(3 * stride);
    let pushed = !bodies.is_empty();
    if pushed {
        let (first, guide_root) = (strand.guides[0] as usize, roots.first);
        let guide = &shape.rows[first * size + PLACE * stride..][..3 * stride];
        let (length, reach) = (along[count - 1], reach.of(first, guide_root, about));
        keep_out(bodies, clearance, &mut Points { rows, stride, count, length, guide, guide_root, reach });
    }
    // Without either, a strand costs nothing more and keeps its bits.
    let wanted = if hair.settings.preserve_length || hair.own.is_some() || pushed {
        Wanted::Along(along, strand.length)
    } else if strand.length < 1.0 {
        Wanted::Fraction(strand.length)
    } else {
        return false;
    };
    respace(wanted, stride, count, rows, lengths);
    true
}

/// A strand's points: as its guides make it, from their positions or from where their curvatures take it (`bent`), with its own shape.
#[inline(always)]
fn place(hair: &RenderHair, shape: &Shape, index: usize, roots: &Roots, bent: Option<&[f32]>, out: &mut [f32]) {
    let strand = &hair.strands[index];
    mix(hair, shape, strand, roots, bent.filter(|_| hair.reference.curved), out);
    if let Some(own) = &hair.own {
        own.add(&hair.reference, shape, index, strand, out);
    }
}

/// The position of a strand's root if it follows those of its guides.
#[inline(always)]
pub(super) fn follow(shape: &Shape, strand: &RenderStrand) -> Vector3<f64> {
    let mut root = Vector3::zeros();
    for k in 0..MAX_GUIDES {
        let weight = strand.weights[k];
        if weight == 0.0 {
            continue;
        }
        let guide = strand.guides[k] as usize;
        let (turn, place) = (&shape.turns[guide], strand.roots[k]);
        for axis in 0..3 {
            let away = turn[0][axis] * place[0] + turn[1][axis] * place[1] + turn[2][axis] * place[2];
            root[axis] += f64::from(weight) * (shape.origins[guide][axis] + f64::from(away));
        }
    }
    root
}

#[inline(always)]
pub(super) fn roots(shape: &Shape, strand: &RenderStrand, own: Vector3<f64>, origin: Vector3<f64>) -> Roots {
    let first = shape.origins[strand.guides[0] as usize];
    Roots {
        own: [0, 1, 2].map(|axis| (own[axis] - origin[axis]) as f32),
        first: [0, 1, 2].map(|axis| (first[axis] - origin[axis]) as f32),
    }
}
