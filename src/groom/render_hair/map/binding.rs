//! Binds render strands to guides: which guides each strand follows, its place among them, and its random numbers.

use nalgebra::Vector3;

use super::sections::{Section, normals, sections};
use super::strand::{RenderCurl, RenderStrand};
use super::weights::{Followed, Guides};
use super::wisps;
use crate::error::{Error, Result, check_finite};
use crate::groom::render_hair::RenderHair;
use crate::groom::render_hair::guides::align;
use crate::groom::render_hair::guides::guide_samples::GuideSamples;
use crate::groom::render_hair::guides::phase;
use crate::groom::render_hair::guides::shape::{Reference, Shape};
use crate::groom::render_hair::measured_curliness;
use crate::groom::render_hair::points::profile::{CURVES, Profiles, gather};
use crate::groom::render_hair::points::silhouette::Silhouette;
use crate::groom::render_hair::settings::{MAX_GUIDES, RenderSettings, Space};
use crate::math::random::Seeded;
use crate::workers::WorkerSet;

/// The data for binding strands.
pub(super) struct Binder<'a> {
    settings: &'a RenderSettings,
    reference: &'a Reference,
    /// The guides at binding time.
    shape: &'a Shape,
    sections: Vec<Section>,
    /// One per guide.
    curliness: Vec<f64>,
}

impl<'a> Binder<'a> {
    pub fn new(
        settings: &'a RenderSettings,
        reference: &'a Reference,
        shape: &'a Shape,
        cells: &[Vec<u32>],
        roots: &[Vector3<f64>],
        given: Option<&[Vector3<f64>]>,
    ) -> Self {
        let normals = normals(reference, shape, cells, roots, given);
        let sections = sections(reference, shape, &normals, settings.flatness);
        let of = |guide: &[Vector3<f64>]| if settings.measure_curliness { measured_curliness(guide) } else { settings.curliness };
        let curliness = reference.rest.chunks(reference.points).map(of).collect();
        Self { settings, reference, shape, sections, curliness }
    }

    /// Strand `index` with its root at a position, in no wisp yet.
    pub fn strand(&self, index: usize, root: Vector3<f64>, followed: &Followed) -> (RenderStrand, Option<RenderCurl>) {
        let (settings, reference) = (self.settings, self.reference);
        let number = |purpose: u64| Seeded::new(settings.seed, purpose).unit(index as u64);
        let bits = |purpose: u64| Seeded::new(settings.seed, purpose).bits(index as u64);
        let mut places = [[0.0; 3]; MAX_GUIDES];
        for (place, guide) in places.iter_mut().zip(followed.guides) {
            let guide = guide as usize;
            let away = reference.rotations[guide].inverse() * (root - reference.origins[guide]);
            *place = [0, 1, 2].map(|axis| away[axis] as f32);
        }
        let first = followed.guides[0] as usize;
        let turn = phase::phasor(std::f64::consts::TAU * number(2));
        let flies = number(17) < settings.flyaways;
        let amplitude = (0.5 + number(3)) * if flies { settings.flyaway_distance.max(settings.frizz) } else { settings.frizz };
        let strand = RenderStrand {
            guides: followed.guides,
            weights: followed.weights.map(|weight| weight as f32),
            roots: places,
            middle: [0.0; 2],
            offset: self.sections[first].place(root - reference.origins[first]),
            gather: [if flies { 0.0 } else { 1.0 }, 1.0],
            frizz: (bits(2) % CURVES as u64) as u32,
            frizz_turn: turn.map(|value| (amplitude * value) as f32),
            clump: 0,
            clump_turn: [0.0; 2],
            radius: (1.0 + settings.radius_variation * (2.0 * number(4) - 1.0)) as f32,
            length: (1.0 - settings.length_variation * number(11)) as f32,
            wisp: 0,
        };
        (strand, reference.curved.then(|| align::align(reference, self.shape, followed)))
    }

    /// Sets everything that follows from the strand's wisp.
    pub fn in_wisp(&self, strand: &mut RenderStrand) {
        let (settings, reference) = (self.settings, self.reference);
        let guide = strand.guides[0] as usize;
        // A wisp's random numbers depend on its guide and its index there.
        let item = guide as u64 * crate::groom::render_hair::MAX_WISPS as u64 + u64::from(strand.wisp);
        let number = |purpose: u64| Seeded::new(settings.seed, purpose).unit(item);
        strand.clump = (Seeded::new(settings.seed, 18).bits(item) % CURVES as u64) as u32;
        let turn = phase::phasor(std::f64::consts::TAU * number(18));
        strand.clump_turn = turn.map(|value| (settings.clump_noise * (0.5 + number(19)) * value) as f32);
        if strand.gather[0] == 0.0 {
            return;
        }
        let away = reference.rotations[guide] * Vector3::from(strand.roots[0].map(f64::from));
        let [n1, n2] = self.sections[guide].across;
        let widest = settings.wisp_profile[0];
        let [a, b] = [0, 1].map(|axis| f64::from(strand.middle[axis]) + widest * f64::from(strand.offset[axis]));
        let gap = (away - n1 * a - n2 * b).norm();
        let points = reference.points;
        let length: f64 =
            reference.rest[guide * points..(guide + 1) * points].windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum();
        let (most, end) = gather(self.curliness[guide], gap, length);
        strand.gather = [most as f32, (1.0 / end) as f32];
    }
}

impl RenderHair {
    /// [`RenderHair::bind_on`] without the scalp's normals: the planes of roots around each guide replace them.
    ///
    /// # Errors
    /// As [`RenderHair::bind_on`].
    pub fn bind(settings: &RenderSettings, guides: &GuideSamples, roots: &[Vector3<f64>]) -> Result<Self> {
        Self::bind_on(settings, guides, roots, None)
    }

    /// Builds the map from guides, as they are at binding time (in their rest pose), to strands with roots at the given
    /// positions, m, at the same time. `normals`: the scalp's, unit vectors, one per root; they orient the wisps on it. Takes
    /// some microseconds per strand.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for settings out of range, mismatched counts, numbers that are not finite;
    /// [`Error::Unsupported`] where threads cannot be started.
    pub fn bind_on(
        settings: &RenderSettings,
        guides: &GuideSamples,
        roots: &[Vector3<f64>],
        normals: Option<&[Vector3<f64>]>,
    ) -> Result<Self> {
        settings.check("settings.")?;
        let points = settings.points_per_strand;
        let count = guides.check(points, None)?;
        if roots.len() > u32::MAX as usize {
            return Err(Error::invalid("roots (count)", roots.len(), "up to 4294967295"));
        }
        for (name, list) in [("roots", Some(roots)), ("normals", normals)] {
            for (index, place) in list.unwrap_or_default().iter().enumerate() {
                for axis in 0..3 {
                    check_finite(|| format!("{name}[{index}][{axis}]"), place[axis])?;
                }
            }
        }
        if let Some(normals) = normals
            && normals.len() != roots.len()
        {
            return Err(Error::invalid("normals (count)", normals.len(), format!("{}, one for each root", roots.len())));
        }
        let mut reference = Reference::new(guides, points, count, settings.space == Space::Curvature);
        let mut shape = Shape::default();
        shape.update(&reference, guides.points, &reference.rotations);
        if reference.curved {
            reference.phases = phase::phases(&reference, &shape);
            shape.update(&reference, guides.points, &reference.rotations);
        }
        let nearness = Guides::new(guides.points, points);
        let mut found = Vec::new();
        let followed = roots.iter().map(|root| nearness.of(*root, settings, &mut found)).collect::<Result<Vec<Followed>>>()?;
        let mut cells = vec![Vec::new(); count];
        for (index, followed) in followed.iter().enumerate() {
            cells[followed.guides[0] as usize].push(index as u32);
        }
        let binder = Binder::new(settings, &reference, &shape, &cells, roots, normals);
        let (mut strands, mut curls) = (Vec::with_capacity(roots.len()), Vec::new());
        for (index, (root, followed)) in roots.iter().zip(&followed).enumerate() {
            let (strand, curl) = binder.strand(index, *root, followed);
            strands.push(strand);
            curls.extend(curl);
        }
        wisps::share_out(&mut strands, count, settings.wisps_per_guide);
        strands.iter_mut().for_each(|strand| binder.in_wisp(strand));
        Self::assembled(settings.clone(), reference, strands, curls)
    }

    /// A map from its fields.
    pub(in crate::groom::render_hair) fn assembled(
        settings: RenderSettings,
        reference: Reference,
        strands: Vec<RenderStrand>,
        curls: Vec<RenderCurl>,
    ) -> Result<Self> {
        Ok(Self {
            profiles: Profiles::new(&settings, reference.stride),
            silhouette: Silhouette::new(reference.points, reference.stride),
            strands,
            curls,
            own: None,
            workers: WorkerSet::new(&settings.workers)?,
            reference,
            settings,
        })
    }
}
