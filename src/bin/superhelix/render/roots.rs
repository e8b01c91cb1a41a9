//! Where render strands grow: given places, among the guides' roots, or scattered over a scalp, which may deform.

use nalgebra::Vector3;
use superhelix::Result;
use superhelix::hair::{Amount, Density, GuideRoots, RootRegion};
use superhelix::render::resampled;

use crate::surfaces::moving_scalp::{MovingScalp, ScalpFiles};

/// How far guides count that have no other beside them, m.
pub const LONE: f64 = 0.01;

/// What render strands grow on.
#[derive(Debug)]
pub enum Ground {
    /// The roots of these curves, m, root first; with whether strands are at rest as the curves are.
    Given(Vec<Vec<Vector3<f64>>>, OwnShapes),
    /// So many in triangles of the guides' roots.
    Among(usize),
    /// So many on a mesh.
    Scalp(Box<Scattering>),
}

/// What strands are that grow where the strands of a groom do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OwnShapes {
    /// As they are mixed from the guides.
    Mixed,
    /// At rest as those of the groom.
    Kept,
}

/// How roots are scattered over a scalp.
#[derive(Debug)]
pub struct Scattering {
    /// The mesh, or those of the frames.
    pub scalp: ScalpFiles,
    /// How many.
    pub count: usize,
    /// How densely; multiplied.
    pub maps: Vec<Density>,
    /// Where on it.
    pub region: Region,
}

/// Where on a mesh strands grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Region {
    /// In what the guides cover; where maps say how densely, anywhere: those need no help from the guides.
    Suitable,
    /// As near as this to a guide's root, m.
    Within(f64),
    /// Anywhere.
    Whole,
}

/// Where strands grow.
#[derive(Debug)]
pub struct Places {
    /// At rest, m.
    pub roots: Vec<Vector3<f64>>,
    /// As many points for each as guides have, m, where strands have shapes of their own.
    pub shapes: Option<Vec<Vector3<f64>>>,
    /// The scalp's, where it is known.
    pub normals: Option<Vec<Vector3<f64>>>,
    /// The scalp, unless it deforms.
    pub still: Option<StillScalp>,
    /// What takes them along, where it is not the guides.
    pub moving: Option<MovingScalp>,
}

/// A scalp that does not deform: vertices, m, and triangles.
pub type StillScalp = (Vec<Vector3<f64>>, Vec<[u32; 3]>);

impl Ground {
    /// The places, with guides of `per_strand` points as they are at rest, m.
    pub fn places(self, guides: &[Vector3<f64>], per_strand: usize, seed: u64) -> Result<Places> {
        let still = |roots| Places { roots, shapes: None, normals: None, still: None, moving: None };
        let roots = || GuideRoots::new(guides.iter().step_by(per_strand).copied().collect());
        Ok(match self {
            Ground::Given(curves, own) => {
                let roots = curves.iter().map(|curve| curve[0]).collect();
                let counts: Vec<u32> = curves.iter().map(|curve| curve.len() as u32).collect();
                let shapes = match own {
                    OwnShapes::Kept => Some(resampled(&curves.concat(), &counts, None, per_strand)?.points),
                    OwnShapes::Mixed => None,
                };
                Places { shapes, ..still(roots) }
            }
            Ground::Among(count) => still(roots()?.among(count, seed)),
            Ground::Scalp(scattering) => {
                let Scattering { scalp, count, maps, region } = *scattering;
                let roots = roots()?;
                let near = match region {
                    Region::Suitable if maps.is_empty() => Some(RootRegion::Covered(roots.spacing().unwrap_or(LONE))),
                    Region::Within(within) => Some(RootRegion::Within(within)),
                    Region::Suitable | Region::Whole => None,
                };
                let mesh = &scalp.rest.scalp;
                let scattered = scalp.rest.scatter(Amount::Count(count), maps, near.map(|region| (roots, region)), seed)?;
                let frames = mesh.frames(mesh.vertices(), &scattered.follicles)?;
                let normals = frames.iter().map(|frame| frame.rotation * Vector3::x()).collect();
                let roots = frames.iter().map(|frame| frame.origin).collect();
                let body = (mesh.vertices().to_vec(), mesh.triangles().to_vec());
                let moving = scalp.moving(scattered.follicles);
                Places { roots, shapes: None, normals: Some(normals), still: moving.is_none().then_some(body), moving }
            }
        })
    }
}
