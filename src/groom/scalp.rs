//! A scalp: a triangle mesh with follicles, which may deform.
//!
//! A [`Follicle`] is a place on a triangle. Its frame follows from the current mesh: n0 along the normal, n1 along the direction
//! of increasing texture coordinate u. Follicles are scattered evenly ([`Scalp::scatter`]) or placed by texture coordinates
//! ([`Scalp::follicles_at`]). [`Scalp::frames`] gives frames that move with the mesh: the roots of guides for
//! [`Solver::set_root_frames`](crate::solver::Solver::set_root_frames), or of render strands.
//!
//! Files:
//!
//! - `density.rs`: The relative density of follicles over a scalp.
//! - `elimination.rs`: Sample elimination: of many random candidates the most crowded are removed, one after the other (Yuksel, "Sample elimination for generating Poisson disk sample sets", 2015).
//! - `frames.rs`: Frames of follicles on the current scalp.
//! - `scatter.rs`: Scatters follicles over a scalp as blue noise of a given density.
//! - `texture.rs`: Places follicles by texture coordinates.

mod density;
mod elimination;
mod frames;
mod scatter;
mod texture;

use nalgebra::Vector3;

pub use density::{Density, RootRegion};
pub use scatter::{Amount, MAX_FOLLICLES, ScatterOptions, Scattered};
pub use texture::Jitter;

use crate::error::{Error, Result, check_finite};

/// A place on a triangle of a scalp.
///
/// ```
/// use superhelix::hair::{Follicle, Scalp};
/// use superhelix::nalgebra::Vector3;
///
/// let corners = vec![Vector3::zeros(), Vector3::new(0.3, 0.0, 0.0), Vector3::new(0.0, 0.3, 0.0)];
/// let scalp = Scalp::new(corners, vec![[0, 1, 2]], None, Vector3::x())?;
/// let middle = Follicle { triangle: 0, shares: [1.0 / 3.0, 1.0 / 3.0] };
/// assert!((scalp.place(&middle) - Vector3::new(0.1, 0.1, 0.0)).norm() < 1e-12);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Follicle {
    /// The triangle's number.
    pub triangle: u32,
    /// Barycentric weights of its second and third corner; the first has the rest. 0 or above, together at most 1.
    pub shares: [f64; 2],
}

impl Follicle {
    /// Barycentric weights of the three corners.
    pub fn weights(&self) -> [f64; 3] {
        [1.0 - self.shares[0] - self.shares[1], self.shares[0], self.shares[1]]
    }

    /// Interpolates a quantity of the three corners.
    fn mix(&self, corners: [Vector3<f64>; 3]) -> Vector3<f64> {
        let [a, b, c] = self.weights();
        corners[0] * a + corners[1] * b + corners[2] * c
    }
}

/// How far weights may be outside their triangle and still count as on its border: the rounding of f32.
const BORDER: f64 = 1e-6;

/// A mesh at rest. Immutable: any threads may use it at the same time.
///
/// ```
/// use superhelix::hair::{Amount, Density, Scalp, ScatterOptions};
/// use superhelix::nalgebra::Vector3;
///
/// // A square of 10 cm, and follicles on it that are at least 2 mm apart.
/// let corners = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(|(x, y)| Vector3::new(x, y, 0.0));
/// let scalp = Scalp::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]], None, Vector3::x())?;
///
/// let options = ScatterOptions { amount: Amount::Spacing(2e-3), density: Density::Uniform, seed: 1 };
/// let scattered = scalp.scatter(&options)?;
/// let roots = scalp.frames(scalp.vertices(), &scattered.follicles)?;
/// assert!(roots.len() > 500 && roots[0].origin.z == 0.0);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Scalp {
    vertices: Vec<Vector3<f64>>,
    triangles: Vec<[u32; 3]>,
    /// Texture coordinates of every triangle's corners.
    uvs: Option<Vec<[[f64; 2]; 3]>>,
    /// For each corner the coordinate along which n1 lies.
    along: Vec<[f64; 3]>,
    /// The transverse coordinate, if there is one; n1 then follows a line on which it stays the same.
    across: Vec<[f64; 3]>,
}

impl Scalp {
    /// A scalp from vertices (m) in its rest pose and triangles, wound anticlockwise as seen from outside. `uvs`: texture
    /// coordinates of every triangle's corners (so seams may run through the mesh). Without them n1 follows the axis `reference`
    /// (any length above zero), projected onto the scalp at rest; where the scalp is perpendicular to that axis its direction is
    /// arbitrary.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for numbers that are not finite, indices without a vertex, mismatched counts, and if no
    /// triangle has an area.
    pub fn new(
        vertices: Vec<Vector3<f64>>,
        triangles: Vec<[u32; 3]>,
        uvs: Option<Vec<[[f64; 2]; 3]>>,
        reference: Vector3<f64>,
    ) -> Result<Self> {
        check_vertices(&vertices)?;
        for (index, triangle) in triangles.iter().enumerate() {
            if let Some(vertex) = triangle.iter().find(|vertex| **vertex as usize >= vertices.len()) {
                let expected = format!("vertices 0 to {}", vertices.len().saturating_sub(1));
                return Err(Error::invalid(format!("triangles[{index}]"), vertex, expected));
            }
        }
        for axis in 0..3 {
            check_finite(|| format!("reference[{axis}]"), reference[axis])?;
        }
        let axis = reference.try_normalize(0.0);
        let axis = axis.ok_or_else(|| Error::invalid("reference", "0", "a direction of any length above zero"))?;
        if let Some(uvs) = &uvs {
            if uvs.len() != triangles.len() {
                return Err(Error::invalid("uvs (count)", uvs.len(), format!("{}, one for each triangle", triangles.len())));
            }
            for (index, corners) in uvs.iter().enumerate() {
                for value in corners.iter().flatten() {
                    check_finite(|| format!("uvs[{index}]"), *value)?;
                }
            }
        }
        let area: f64 = triangles.iter().map(|triangle| double_area(&vertices, triangle).norm()).sum();
        if !(area > 0.0 && area.is_finite()) {
            return Err(Error::invalid("triangles", format!("{} of area {area} m^2", triangles.len()), "a mesh with an area"));
        }
        let (along, across) = match &uvs {
            Some(uvs) => (uvs.iter().map(|c| c.map(|uv| uv[0])).collect(), uvs.iter().map(|c| c.map(|uv| uv[1])).collect()),
            None => (triangles.iter().map(|t| t.map(|vertex| vertices[vertex as usize].dot(&axis))).collect(), Vec::new()),
        };
        Ok(Self { vertices, triangles, uvs, along, across })
    }

    /// Vertices at rest, m.
    pub fn vertices(&self) -> &[Vector3<f64>] {
        &self.vertices
    }

    /// Triangles.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Its area at rest, m².
    pub fn area(&self) -> f64 {
        self.triangles.iter().map(|triangle| 0.5 * double_area(&self.vertices, triangle).norm()).sum()
    }

    /// Checks a caller's follicles; `argument` is their name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first that is not on the scalp.
    pub fn check_follicles(&self, argument: &str, follicles: &[Follicle]) -> Result<()> {
        for (index, follicle) in follicles.iter().enumerate() {
            if follicle.triangle as usize >= self.triangles.len() {
                let expected = format!("below {}, the number of triangles", self.triangles.len());
                return Err(Error::invalid(format!("{argument}[{index}].triangle"), follicle.triangle, expected));
            }
            if !follicle.weights().iter().all(|weight| (-BORDER..=1.0 + BORDER).contains(weight)) {
                let (value, expected) = (format!("{:?}", follicle.shares), "shares of 0 or above, together at most 1");
                return Err(Error::invalid(format!("{argument}[{index}].shares"), value, expected));
            }
        }
        Ok(())
    }

    /// The position of a follicle on the scalp at rest, m. The follicle must be one of this scalp.
    pub fn place(&self, follicle: &Follicle) -> Vector3<f64> {
        follicle.mix(self.corners(&self.vertices, follicle.triangle))
    }

    fn corners(&self, vertices: &[Vector3<f64>], triangle: u32) -> [Vector3<f64>; 3] {
        self.triangles[triangle as usize].map(|vertex| vertices[vertex as usize])
    }

    /// Memory of the scalp, bytes.
    pub fn memory_usage(&self) -> u64 {
        let corners = self.along.capacity() + self.across.capacity() + 2 * self.uvs.as_ref().map_or(0, Vec::capacity);
        (size_of::<Self>() + 24 * (self.vertices.capacity() + corners) + 12 * self.triangles.capacity()) as u64
    }
}

fn check_vertices(vertices: &[Vector3<f64>]) -> Result<()> {
    for (index, vertex) in vertices.iter().enumerate() {
        for axis in 0..3 {
            check_finite(|| format!("vertices[{index}][{axis}]"), vertex[axis])?;
        }
    }
    Ok(())
}

/// The normal of a triangle, twice its area long.
fn double_area(vertices: &[Vector3<f64>], triangle: &[u32; 3]) -> Vector3<f64> {
    let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
    (b - a).cross(&(c - a))
}
