//! Render hair for pictures of guides: as `interpolate` makes it, in wisps.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::hair::GuideRoots;
use superhelix::io::Extras;
use superhelix::render::{GuideSamples, RenderHair, RenderSettings, resampled};
use superhelix::{Error, Shape, Workers};

use crate::render::frames::{Moment, Renderer};
use crate::render::guide_frames::GuideFrame;
use crate::render::roots::{Ground, LONE, Region, Scattering};
use crate::shell::failure::Failure;
use crate::surfaces::baked_body;
use crate::surfaces::moving_scalp::{MovingScalp, ScalpFiles};

/// Points of a strand.
const POINTS: usize = 25;
/// How the hair strays, as a share of the guides' median length.
const FRIZZ: f64 = 0.004;

/// Fewer guides than this are too few to grow hair among, and as many as this need none.
pub const LEAST_GUIDES: usize = 30;
/// See [`LEAST_GUIDES`].
pub const MAX_GUIDES: usize = 3000;
/// Hairs that are grown where it is not said how many.
pub const USUAL: usize = 20_000;

/// Hair that follows guides.
pub struct Grown {
    renderer: Renderer,
    moving: Option<MovingScalp>,
    /// Metres a unit of the files.
    unit: f64,
}

impl Grown {
    /// From the guides at rest, in units of `unit` metres, on a scalp or, without one that has a vertex near them, among the guides' roots.
    pub fn bind(
        guides: &[Vec<[f32; 3]>],
        unit: f64,
        count: usize,
        scalp: Option<(ScalpFiles, &Path)>,
        threads: usize,
    ) -> Result<Self, Failure> {
        let rest = frame(guides, unit)?;
        let length = median_length(&rest.points);
        let settings = RenderSettings {
            points_per_strand: POINTS,
            frizz: FRIZZ * length,
            workers: if threads == 1 { Workers::Serial } else { Workers::Pool(threads) },
            ..RenderSettings::default()
        };
        let (mut ground, mut path) = (Ground::Among(count), None);
        if let Some((scalp, of)) = scalp.filter(|(scalp, _)| carries(scalp, &rest.points)) {
            let region = Region::Suitable;
            (ground, path) = (Ground::Scalp(Box::new(Scattering { scalp, count, maps: Vec::new(), region })), Some(of));
        }
        let places = ground.places(&rest.points, POINTS, settings.seed)?;
        let hair =
            RenderHair::bind_on(&settings, &GuideSamples::at_rest(&rest.points), &places.roots, places.normals.as_deref())?;
        // A mesh without an inside keeps nothing out.
        let head = path.zip(places.still.as_ref()).and_then(|(path, (vertices, triangles))| {
            let baked = baked_body::bake(path, vertices, triangles, None, true).ok()?;
            Some(Shape::new_grid(baked.grid))
        });
        Ok(Self { renderer: Renderer::new(hair, head, unit, Extras::default()), moving: places.moving, unit })
    }

    /// The hair at a frame, whose guides are these.
    pub fn strands(&mut self, index: usize, guides: &[Vec<[f32; 3]>]) -> Result<Vec<Vec<[f32; 3]>>, Failure> {
        let roots = self.moving.as_ref().map(|scalp| scalp.roots(index)).transpose()?;
        let moment =
            Moment { name: format!("frame {index}"), time: None, guides: frame(guides, self.unit)?, roots, bodies: Vec::new() };
        let made = self.renderer.frame(&moment, None)?;
        Ok(made.strands().map(<[_]>::to_vec).collect())
    }
}

/// Whether a mesh is one that guides stand on, and as fine as that takes.
fn carries(scalp: &ScalpFiles, guides: &[Vector3<f64>]) -> bool {
    let near = || {
        let roots = GuideRoots::new(guides.iter().step_by(POINTS).copied().collect())?;
        roots.nearness(scalp.rest.scalp.vertices(), 1.5 * roots.spacing().unwrap_or(LONE))
    };
    near().is_ok_and(|near| near.iter().any(|share| *share > 0.0))
}

fn frame(guides: &[Vec<[f32; 3]>], unit: f64) -> Result<GuideFrame, Error> {
    let counts: Vec<u32> = guides.iter().map(|guide| guide.len() as u32).collect();
    let points: Vec<Vector3<f64>> = guides.iter().flatten().map(|point| Vector3::from(point.map(f64::from)) * unit).collect();
    Ok(GuideFrame { points: resampled(&points, &counts, None, POINTS)?.points, velocities: None })
}

fn median_length(points: &[Vector3<f64>]) -> f64 {
    let length = |guide: &[Vector3<f64>]| guide.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum::<f64>();
    let mut lengths: Vec<f64> = points.chunks_exact(POINTS).map(length).collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 2).copied().unwrap_or(0.0)
}
