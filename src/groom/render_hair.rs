//! Render hair: a hundred thousand strands from a thousand guides, by the semi-interpolating scheme of Bertails et al. 2006,
//! section 4.1.
//!
//! [`RenderHair`] is the map: which guides each render strand follows, and how. It is built once, from the guides and the
//! positions of the strands' roots, and never changes. [`RenderPose`] holds the guides at one moment; each frame sets it and
//! evaluates it, in tiles and with any number of threads, into the caller's memory. A strand's points depend only on the map and
//! the pose, not on the thread.
//!
//! Near the root a strand is mixed from its guides, in positions or in curvatures ([`Space`]). Towards the tip it blends into its
//! wisp, a line beside its first guide, and more so the curlier the hair. Guides whose tips are far apart are not mixed.
//! docs/theory/render_hair.md has the formulas.
//!
//! Files:
//!
//! - `settings.rs`: Settings of render hair.
//! - `guides/`: The guides of render hair at one moment.
//! - `map/`: The map of render hair: which guides each strand follows, and how.
//! - `points/`: The points of render strands, mixed from their guides.

mod guides;
mod map;
pub mod points;
mod settings;

use nalgebra::Vector3;

pub use guides::guide_samples::{GuideSamples, Resampled, resampled};
pub use guides::pose::{RenderPose, VELOCITY_STEP};
pub use map::image::RENDER_HAIR_VERSION;
pub use points::bodies::RenderBody;
pub use points::evaluate::{Motion, RootsAt, StrandPoints, StrandSink, View};
pub use settings::{MAX_GUIDES, MAX_POINTS, MAX_WISPS, RenderSettings, Space};

use crate::workers::WorkerSet;
use guides::phase;
use guides::shape::Reference;
use map::strand::{RenderCurl, RenderStrand};
use points::evaluate::EvaluateScratch;
use points::own_shapes::OwnShapes;
use points::profile::Profiles;
use points::silhouette::Silhouette;

/// The turning of a curve up to which it is straight, and that from which on it is curly, rad.
const STRAIGHT: f64 = std::f64::consts::FRAC_PI_2;
const CURLY: f64 = 3.0 * std::f64::consts::PI;

/// The map from guides to render strands. Immutable: any threads may use it at the same time.
///
/// ```
/// use std::sync::{Arc, Mutex};
///
/// use superhelix::nalgebra::Vector3;
/// use superhelix::render::{GuideSamples, RenderHair, RenderPose, RenderSettings, StrandPoints, StrandSink, View};
///
/// // Two guides of 16 points that hang 2 cm apart, and hairs between them.
/// let settings = RenderSettings { points_per_strand: 16, ..RenderSettings::default() };
/// let guide = |x: f64| (0..16).map(move |k| Vector3::new(x, 0.0, -0.01 * f64::from(k)));
/// let rest: Vec<_> = guide(0.0).chain(guide(0.02)).collect();
/// let roots: Vec<_> = (0..50).map(|k| Vector3::new(4e-4 * f64::from(k), 0.0, 0.0)).collect();
/// let hair = Arc::new(RenderHair::bind(&settings, &GuideSamples::at_rest(&rest), &roots)?);
///
/// /// Counts points and strands.
/// #[derive(Default)]
/// struct Count(Mutex<(usize, usize)>);
///
/// impl StrandSink for Count {
///     fn take(&self, strand: &StrandPoints) {
///         let mut count = self.0.lock().unwrap();
///         *count = (count.0 + strand.positions[0].len(), count.1 + 1);
///     }
/// }
///
/// // Each frame: where the guides are now, and the hairs that follow them.
/// let mut pose = RenderPose::new(hair.clone());
/// let moved: Vec<_> = rest.iter().map(|point| point + Vector3::new(0.0, 0.01, 0.0)).collect();
/// pose.set(&GuideSamples::at_rest(&moved))?;
/// let count = Count::default();
/// pose.evaluate(&View::whole(&hair), &count)?;
/// assert_eq!(*count.0.lock().unwrap(), (50 * 16, 50));
/// # Ok::<(), superhelix::Error>(())
/// ```
pub struct RenderHair {
    settings: RenderSettings,
    reference: Reference,
    profiles: Profiles,
    /// For mixed curvatures.
    silhouette: Silhouette,
    strands: Vec<RenderStrand>,
    /// Empty if positions are mixed.
    curls: Vec<RenderCurl>,
    /// Of strands that have them.
    own: Option<OwnShapes>,
    workers: WorkerSet<EvaluateScratch>,
}

impl std::fmt::Debug for RenderHair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RenderHair").field("strands", &self.strands.len()).finish_non_exhaustive()
    }
}

/// How curly a curve of points is, 0 to 1: a smooth step of the total turning of its edges, from 0 at a quarter turn to 1 at one
/// and a half turns. Points that zigzag count as curly.
pub fn measured_curliness(points: &[Vector3<f64>]) -> f64 {
    let edges: Vec<_> = points.windows(2).filter_map(|edge| (edge[1] - edge[0]).try_normalize(0.0)).collect();
    let turn = |pair: &[Vector3<f64>]| phase::argument([pair[0].dot(&pair[1]), pair[0].cross(&pair[1]).norm()]);
    let turning: f64 = edges.windows(2).map(turn).sum();
    let fraction = ((turning - STRAIGHT) / (CURLY - STRAIGHT)).clamp(0.0, 1.0);
    fraction * fraction * (3.0 - 2.0 * fraction)
}

impl RenderHair {
    /// The settings of the map.
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

    /// The guides that a strand follows, nearest first, with their weights at the root, which sum to 1; `None` if `strand` is not
    /// below [`RenderHair::strand_count`].
    pub fn guides_of(&self, strand: usize) -> Option<impl Iterator<Item = (u32, f32)> + '_> {
        let strand = self.strands.get(strand)?;
        Some(
            strand
                .guides
                .iter()
                .copied()
                .zip(strand.weights)
                .enumerate()
                .filter(|(k, (_, w))| *k == 0 || *w != 0.0)
                .map(|(_, pair)| pair),
        )
    }

    /// The wisp of its first guide to which a strand belongs, from 0.
    pub fn wisp_of(&self, strand: usize) -> Option<u32> {
        self.strands.get(strand).map(|strand| strand.wisp)
    }

    /// Memory of the map, bytes.
    pub fn memory_usage(&self) -> u64 {
        let profiles =
            [&self.profiles.place, &self.profiles.wisp, &self.profiles.radius, &self.profiles.frizz, &self.profiles.clumps];
        let floats = profiles.iter().map(|row| row.capacity()).sum::<usize>() + self.reference.phases.capacity();
        let bytes = size_of::<Self>()
            + 4 * floats
            + self.strands.capacity() * size_of::<RenderStrand>()
            + self.curls.capacity() * size_of::<RenderCurl>()
            + self.own.as_ref().map_or(0, OwnShapes::memory_usage)
            + self.reference.guides * 56
            + 24 * self.reference.rest.capacity();
        bytes as u64
    }
}
