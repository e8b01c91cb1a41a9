//! Render hair: a hundred thousand strands from a thousand guides, by the semi-interpolating scheme of Bertails et al. 2006, section 4.1.
//!
//! [`RenderHair`] is the map: which guides each render strand follows and how. It is made once, from the guides and the places of the strands'
//! roots, and never changes. [`RenderPose`] is where the guides are at one moment; each frame it is set anew and evaluated, in tiles and by
//! any number of threads, into the caller's memory. A strand's points depend on the map and the pose alone, not on who evaluates them.
//!
//! Near the root a strand is mixed from its guides, in positions or in curvatures ([`Space`]); towards the tip it goes over to its wisp, a
//! line beside its first guide, the more so the curlier the hair. Guides whose tips have parted are not mixed. docs/render_hair.md has the
//! formulas.

mod align;
mod curvature;
mod cut;
mod evaluate;
mod frames;
mod guide_samples;
mod phase;
mod pose;
mod position;
mod profile;
mod quaternion;
mod settings;
mod shape;
mod strand;
mod weights;
mod wisps;

use nalgebra::Vector3;

pub use evaluate::{Motion, RootsAt, StrandPoints, StrandSink, View};
pub use guide_samples::{GuideSamples, Resampled, resampled};
pub use pose::{RenderPose, VELOCITY_STEP};
pub use settings::{MOST_GUIDES, MOST_POINTS, MOST_WISPS, RenderSettings, Space};

use crate::error::{Error, Result, check_finite};
use crate::math::random::Seeded;
use crate::workers::Crew;
use evaluate::Scratch;
use profile::{FRIZZ_CURVES, Profiles, gathered};
use shape::{Reference, Shape};
use strand::{RenderCurl, RenderStrand};
use weights::Guides;

/// Turning of a curve up to which it counts as straight, and from which on as curly, rad.
const STRAIGHT: f64 = std::f64::consts::FRAC_PI_2;
const CURLY: f64 = 3.0 * std::f64::consts::PI;

/// The map from guides to render strands. It does not change: any threads may use it at the same time.
pub struct RenderHair {
    settings: RenderSettings,
    reference: Reference,
    profiles: Profiles,
    /// How far strands that follow a guide first have gone over to their wisp: a row a guide.
    gathered: Vec<f32>,
    strands: Vec<RenderStrand>,
    /// Empty where positions are mixed.
    curls: Vec<RenderCurl>,
    crew: Crew<Scratch>,
}

impl std::fmt::Debug for RenderHair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RenderHair").field("strands", &self.strands.len()).finish_non_exhaustive()
    }
}

/// How curly a curve of points is, 0 to 1: from 0 where its edges turn by a quarter turn together over a smooth step to 1 at one and a half
/// turns. Points that zigzag count as curly.
pub fn measured_curliness(points: &[Vector3<f64>]) -> f64 {
    let edges: Vec<_> = points.windows(2).filter_map(|edge| (edge[1] - edge[0]).try_normalize(0.0)).collect();
    let turn = |pair: &[Vector3<f64>]| phase::argument([pair[0].dot(&pair[1]), pair[0].cross(&pair[1]).norm()]);
    let turning: f64 = edges.windows(2).map(turn).sum();
    let share = ((turning - STRAIGHT) / (CURLY - STRAIGHT)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

impl RenderHair {
    /// The map from guides, as they are at binding (in their rest pose), to strands with their roots at the given places, m, of the same
    /// moment. Takes some microseconds a strand.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for settings out of range, counts that do not fit, numbers that are not finite; [`Error::Unsupported`]
    /// where threads cannot be started.
    pub fn bind(settings: &RenderSettings, guides: &GuideSamples, roots: &[Vector3<f64>]) -> Result<Self> {
        settings.check("settings.")?;
        let points = settings.points_per_strand;
        let count = guides.check(points, None)?;
        if roots.len() > u32::MAX as usize {
            return Err(Error::invalid("roots (count)", roots.len(), "up to 4294967295"));
        }
        for (index, root) in roots.iter().enumerate() {
            for axis in 0..3 {
                check_finite(|| format!("roots[{index}][{axis}]"), root[axis])?;
            }
        }
        let mut reference = Reference::new(guides, points, count, settings.space == Space::Curvature);
        let mut shape = Shape::default();
        shape.update(&reference, guides.points, &reference.rotations);
        if reference.curved {
            reference.phases = phase::phases(&reference, &shape);
            shape.update(&reference, guides.points, &reference.rotations);
        }
        let stride = reference.stride;
        let mut gathered_rows = Vec::with_capacity(count * stride);
        for guide in guides.points.chunks(points) {
            let curliness = if settings.measure_curliness { measured_curliness(guide) } else { settings.curliness };
            let place = |k: usize| k.min(points - 1) as f64 / (points - 1) as f64;
            gathered_rows.extend((0..stride).map(|k| gathered(curliness, place(k)) as f32));
        }
        let nearness = Guides::new(guides.points, points);
        let numbers = [2, 3, 4, 11].map(|purpose| Seeded::new(settings.seed, purpose));
        let (mut strands, mut curls) = (Vec::with_capacity(roots.len()), Vec::new());
        let mut found = Vec::new();
        for (index, root) in roots.iter().enumerate() {
            let followed = nearness.of(*root, settings, &mut found)?;
            let mut places = [[0.0; 3]; MOST_GUIDES];
            for (place, guide) in places.iter_mut().zip(followed.guides) {
                let guide = guide as usize;
                let away = reference.rotations[guide].inverse() * (root - reference.origins[guide]);
                *place = [0, 1, 2].map(|axis| away[axis] as f32);
            }
            let first = followed.guides[0] as usize;
            let rows = &shape.rows[first * reference.size()..];
            let away = root - reference.origins[first];
            let along = |row: usize| (0..3).map(|axis| f64::from(rows[(row + axis) * stride]) * away[axis]).sum::<f64>() as f32;
            let turn = phase::phasor(std::f64::consts::TAU * numbers[0].unit(index as u64));
            let amplitude = 0.5 + numbers[1].unit(index as u64);
            strands.push(RenderStrand {
                guides: followed.guides,
                weights: followed.weights.map(|weight| weight as f32),
                roots: places,
                middle: [0.0; 2],
                offset: [along(shape::N1), along(shape::N2)],
                frizz: (numbers[0].bits(index as u64) % FRIZZ_CURVES as u64) as u32,
                frizz_turn: turn.map(|value| (amplitude * value) as f32),
                radius: (1.0 + settings.radius_variation * (2.0 * numbers[2].unit(index as u64) - 1.0)) as f32,
                length: (1.0 - settings.length_variation * numbers[3].unit(index as u64)) as f32,
                wisp: 0,
            });
            if reference.curved {
                curls.push(align::align(&reference, &shape, &followed));
            }
        }
        wisps::share_out(&mut strands, count, settings.wisps_per_guide);
        Ok(Self {
            profiles: Profiles::new(settings, stride),
            gathered: gathered_rows,
            strands,
            curls,
            crew: Crew::new(&settings.workers)?,
            reference,
            settings: settings.clone(),
        })
    }

    /// What the map was made with.
    pub fn settings(&self) -> &RenderSettings {
        &self.settings
    }

    /// Number of render strands.
    pub fn strand_count(&self) -> usize {
        self.strands.len()
    }

    /// Number of guides.
    pub fn guide_count(&self) -> usize {
        self.reference.guides
    }

    /// The guides that a strand follows, the nearest first, with their weights at the root, which sum to 1; none where `strand` is not below
    /// [`RenderHair::strand_count`].
    pub fn guides_of(&self, strand: usize) -> Option<impl Iterator<Item = (u32, f32)> + '_> {
        let strand = self.strands.get(strand)?;
        Some(
            strand
                .guides
                .iter()
                .copied()
                .zip(strand.weights)
                .enumerate()
                .filter(|(k, (_, w))| *k == 0 || *w > 0.0)
                .map(|(_, pair)| pair),
        )
    }

    /// Which of its first guide's wisps a strand belongs to, from 0.
    pub fn wisp_of(&self, strand: usize) -> Option<u32> {
        self.strands.get(strand).map(|strand| strand.wisp)
    }

    /// Bytes that the map holds.
    pub fn memory_usage(&self) -> u64 {
        let floats = self.gathered.capacity()
            + self.profiles.wisp.capacity()
            + self.profiles.radius.capacity()
            + self.profiles.frizz.capacity()
            + self.reference.phases.capacity();
        let bytes = size_of::<Self>()
            + 4 * floats
            + self.strands.capacity() * size_of::<RenderStrand>()
            + self.curls.capacity() * size_of::<RenderCurl>()
            + self.reference.guides * 56;
        bytes as u64
    }
}
