//! Render hair: a hundred thousand strands from a thousand guides, by the semi-interpolating scheme of Bertails et al. 2006, section 4.1.
//!
//! [`RenderHair`] is the map: which guides each render strand follows and how. It is made once, from the guides and the places of the strands'
//! roots, and never changes. [`RenderPose`] is where the guides are at one moment; each frame it is set anew and evaluated, in tiles and by
//! any number of threads, into the caller's memory. A strand's points depend on the map and the pose alone, not on who evaluates them.
//!
//! Near the root a strand is mixed from its guides, in positions or in curvatures ([`Space`]); towards the tip it goes over to its wisp, a
//! line beside its first guide, the more so the curlier the hair. Guides whose tips have parted are not mixed. docs/theory/render_hair.md has the
//! formulas.
//!
//! Files:
//!
//! - `align.rs`: How guides' bends are brought into step before they are mixed.
//! - `binding.rs`: Binding: whom each strand follows, where it stands, what is random about it.
//! - `bodies.rs`: Strands kept out of bodies: points that are too near go out along the distance field.
//! - `curvature.rs`: Strands mixed from their guides' lengths and bends: worked out from the root to the tip, sixteen strands side by side.
//! - `evaluate.rs`: The strands' points, in tiles, by many threads.
//! - `frames.rs`: Material frames along a strand, from its points.
//! - `guide_samples.rs`: Guides at one moment, as points.
//! - `image.rs`: A map as bytes, and back.
//! - `lengths.rs`: Strands kept as long as they are to be: points put anew on their way, as far from the root along it as wanted.
//! - `phase.rs`: How a guide's curl goes round: the angle by which its bend has turned about the guide from point to point.
//! - `pose.rs`: Where the guides are at one moment.
//! - `position.rs`: Strands mixed from their guides' places, and brought to their wisps.
//! - `profile.rs`: What depends on the place along a strand and not on the guides.
//! - `quaternion.rs`: Rotations of frames in f32.
//! - `reach.rs`: How far strands may lie from their first guide without being near a body: most of a groom's points need no other look.
//! - `sections.rs`: How a patch of scalp becomes the section of the hair that stands on it.
//! - `settings.rs`: What render strands are to look like.
//! - `shape.rs`: The guides' shapes at one moment, in the form in which strands are mixed from them.
//! - `silhouette.rs`: Strands of mixed curvatures brought to where mixed positions lead.
//! - `strand.rs`: A render strand as the map has it: whom it follows, and how.
//! - `weights.rs`: Which guides a strand follows, and with what weights.
//! - `wisps.rs`: Wisps: the strands that follow a guide first, shared among middles that lie far from each other.
//! - `without.rs`: A map that lives on when guides are gone.

mod align;
mod binding;
mod bodies;
mod curvature;
mod evaluate;
mod frames;
mod guide_samples;
mod image;
mod lengths;
mod phase;
mod pose;
mod position;
mod profile;
mod quaternion;
mod reach;
mod sections;
mod settings;
mod shape;
mod silhouette;
mod strand;
mod weights;
mod wisps;
mod without;

use nalgebra::Vector3;

pub use bodies::RenderBody;
pub use evaluate::{Motion, RootsAt, StrandPoints, StrandSink, View};
pub use guide_samples::{GuideSamples, Resampled, resampled};
pub use image::RENDER_HAIR_VERSION;
pub use pose::{RenderPose, VELOCITY_STEP};
pub use settings::{MOST_GUIDES, MOST_POINTS, MOST_WISPS, RenderSettings, Space};

use crate::workers::Crew;
use evaluate::Scratch;
use profile::Profiles;
use shape::Reference;
use silhouette::Silhouette;
use strand::{RenderCurl, RenderStrand};

/// Turning of a curve up to which it counts as straight, and from which on as curly, rad.
const STRAIGHT: f64 = std::f64::consts::FRAC_PI_2;
const CURLY: f64 = 3.0 * std::f64::consts::PI;

/// The map from guides to render strands. It does not change: any threads may use it at the same time.
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
    /// Where curvatures are mixed.
    silhouette: Silhouette,
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
                .filter(|(k, (_, w))| *k == 0 || *w != 0.0)
                .map(|(_, pair)| pair),
        )
    }

    /// Which of its first guide's wisps a strand belongs to, from 0.
    pub fn wisp_of(&self, strand: usize) -> Option<u32> {
        self.strands.get(strand).map(|strand| strand.wisp)
    }

    /// Bytes that the map holds.
    pub fn memory_usage(&self) -> u64 {
        let profiles =
            [&self.profiles.place, &self.profiles.wisp, &self.profiles.radius, &self.profiles.frizz, &self.profiles.clumps];
        let floats = profiles.iter().map(|row| row.capacity()).sum::<usize>() + self.reference.phases.capacity();
        let bytes = size_of::<Self>()
            + 4 * floats
            + self.strands.capacity() * size_of::<RenderStrand>()
            + self.curls.capacity() * size_of::<RenderCurl>()
            + self.reference.guides * 56
            + 24 * self.reference.rest.capacity();
        bytes as u64
    }
}
