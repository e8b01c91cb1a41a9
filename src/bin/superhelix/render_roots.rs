//! Where render strands grow: given places, among the guides' roots, or scattered over a scalp, which may deform.

use nalgebra::Vector3;
use superhelix::error::Result;
use superhelix::groom::guide_roots::GuideRoots;
use superhelix::groom::scalp::{Amount, Density};

use crate::moving_scalp::{MovingScalp, ScalpFiles};

/// How far guides count that have no other beside them, m.
pub const LONE: f64 = 0.01;

/// What render strands grow on.
#[derive(Debug)]
pub enum Ground {
    /// These places, m.
    Given(Vec<Vector3<f64>>),
    /// So many in triangles of the guides' roots.
    Among(usize),
    /// So many on a mesh.
    Scalp(Box<Scattering>),
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
    /// How near to a guide's root, m; not given, near the guides where there are no maps: those need no help from the guides.
    pub within: Option<f64>,
}

/// Where strands grow.
#[derive(Debug)]
pub struct Places {
    /// At rest, m.
    pub roots: Vec<Vector3<f64>>,
    /// What takes them along, where it is not the guides.
    pub moving: Option<MovingScalp>,
}

impl Ground {
    /// The places, with guides of `per_strand` points as they are at rest, m.
    pub fn places(self, guides: &[Vector3<f64>], per_strand: usize, seed: u64) -> Result<Places> {
        let still = |roots| Places { roots, moving: None };
        let roots = || GuideRoots::new(guides.iter().step_by(per_strand).copied().collect());
        Ok(match self {
            Ground::Given(places) => still(places),
            Ground::Among(count) => still(roots()?.among(count, seed)),
            Ground::Scalp(scattering) => {
                let Scattering { scalp, count, maps, within } = *scattering;
                let roots = roots()?;
                let within = within.or_else(|| maps.is_empty().then(|| 1.5 * roots.spacing().unwrap_or(LONE)));
                let mesh = &scalp.rest;
                let scattered = mesh.scatter(Amount::Count(count), maps, within.map(|within| (&roots, within)), seed)?;
                let roots = scattered.follicles.iter().map(|follicle| mesh.scalp.place(follicle)).collect();
                Places { roots, moving: scalp.moving(scattered.follicles) }
            }
        })
    }
}
