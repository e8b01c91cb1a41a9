//! Triangle mesh: its checks, its neighbours, its motion over a step.

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::flat_triangle::FlatTriangle;
use super::normals::Normals;
use crate::contact::shape::Bounds;
use crate::error::{Error, Result, check_finite, check_positive};

/// Which sides of a mesh keep strands off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sides {
    /// The mesh is closed and wound outward: what is inside is pushed out, however deep.
    Solid,
    /// One side: strands are kept on the side from which the triangles are seen wound anticlockwise. What lies behind by less than
    /// `depth` metres is pushed to the front; farther behind nothing is touched.
    Front {
        /// How far behind it acts, m, above zero.
        depth: f64,
    },
    /// Both sides, like a sheet: a strand stays on the side where the step found it. Around open rims it may pass.
    Both,
}

/// A triangle mesh. While it deforms it has vertices at a step's start and at its end; at rest they are the same.
#[derive(Debug, Clone)]
pub struct Mesh {
    pub(super) triangles: Box<[[u32; 3]]>,
    pub(super) sides: Sides,
    /// At the step's start.
    pub(super) before: Vec<Vector3<f64>>,
    /// At the step's end; nearest points are sought on these.
    pub(super) vertices: Vec<Vector3<f64>>,
    pub(super) moving: bool,
    travel: f64,
    pub(super) normals: Normals,
    /// Those at the step's start while it moves.
    pub(super) normals_before: Normals,
    /// For each edge of each triangle the triangle on its other side; `u32::MAX` at a rim.
    pub(in crate::contact::shape) neighbours: Box<[[u32; 3]]>,
    pub(super) bvh: Bvh,
    /// A ball around each triangle over the step: its centre and radius.
    pub(super) balls: Vec<(Vector3<f64>, f64)>,
    /// Each triangle at the step's end.
    pub(super) flats: Vec<FlatTriangle>,
    /// Of the vertices' bits: what was gathered from a mesh holds for all meshes of this stamp.
    stamp: u64,
    bounds: Bounds,
    edge_length: f64,
}

/// No triangle: what lies beyond a rim.
pub(super) const RIM: u32 = u32::MAX;

impl Mesh {
    /// A mesh from vertices (m, in the body's axes) and triangles (three indices each, anticlockwise seen from outside).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] that names the vertex, triangle or edge: a number that is not finite; no triangle; an index out of
    /// range; a triangle without area; for [`Sides::Solid`] an edge that is not shared by exactly two triangles wound alike, or a mesh
    /// wound inward; for [`Sides::Front`] an edge where neighbours are wound against each other, or a depth not above zero.
    pub fn new(vertices: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]>, sides: Sides) -> Result<Self> {
        check_parts(&vertices, &triangles, sides)?;
        for (index, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
            if (b - a).cross(&(c - a)).norm_squared() == 0.0 {
                return Err(Error::invalid(
                    format!("triangles[{index}]"),
                    format!("{triangle:?}"),
                    "three corners that span an area",
                ));
            }
        }
        let neighbours = neighbours(&triangles, sides)?;
        if sides == Sides::Solid {
            let volume = volume(&vertices, &triangles);
            if volume <= 0.0 {
                return Err(Error::invalid(
                    "triangles",
                    format!("wound so that the mesh holds {volume} m³"),
                    "triangles anticlockwise seen from outside",
                ));
            }
        }
        Ok(Self::assembled(vertices, triangles, sides, neighbours))
    }

    /// A mesh for [`DistanceGrid::bake`](crate::contact::shape::DistanceGrid::bake), which takes nearly closed ones: solid where every edge is on two
    /// triangles that run along it in opposite directions, else one of two sides.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] as [`Mesh::new`], but for what says of edges.
    pub fn for_baking(vertices: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        let closed = neighbours(&triangles, Sides::Solid).is_ok();
        Self::new(vertices, triangles, if closed { Sides::Solid } else { Sides::Both })
    }

    /// A mesh as it was in the middle of a run: it may have lost area or volume since it was made.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] as [`Mesh::new`], but for what says of areas and the volume.
    pub(crate) fn in_motion(
        before: Vec<Vector3<f64>>,
        vertices: Vec<Vector3<f64>>,
        triangles: Vec<[u32; 3]>,
        sides: Sides,
    ) -> Result<Self> {
        check_parts(&vertices, &triangles, sides)?;
        let neighbours = neighbours(&triangles, sides)?;
        let mut mesh = Self::assembled(vertices, triangles, sides, neighbours);
        mesh.check_replacement(&before)?;
        if before != mesh.vertices {
            mesh.before = before;
            mesh.refit();
        }
        Ok(mesh)
    }

    fn assembled(vertices: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]>, sides: Sides, neighbours: Box<[[u32; 3]]>) -> Self {
        let boxes: Vec<Aabb> = triangles.iter().map(|triangle| leaf(triangle, &vertices, &vertices)).collect();
        let mut mesh = Self {
            normals: Normals::default(),
            normals_before: Normals::default(),
            bvh: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
            bounds: Bounds::of_points(used(&triangles, &vertices)),
            edge_length: 0.0,
            triangles: triangles.into(),
            sides,
            before: vertices.clone(),
            vertices,
            moving: false,
            travel: 0.0,
            balls: Vec::new(),
            flats: Vec::new(),
            stamp: 0,
            neighbours,
        };
        mesh.normals.update(&mesh.vertices, &mesh.triangles, &mesh.neighbours);
        mesh.mark();
        mesh.edge_length = mesh.mean_edge();
        mesh
    }

    /// Vertices at the step's end, m.
    pub fn vertices(&self) -> &[Vector3<f64>] {
        &self.vertices
    }

    /// Vertices at the step's start, m.
    pub fn vertices_before(&self) -> &[Vector3<f64>] {
        &self.before
    }

    /// The triangles, three indices of vertices each.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Which sides keep strands off.
    pub fn sides(&self) -> Sides {
        self.sides
    }

    /// Whether the vertices move during the step.
    pub fn is_moving(&self) -> bool {
        self.moving
    }

    /// The box of the vertices at the step's start and end.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Mean length of the triangles' edges, m.
    pub fn edge_length(&self) -> f64 {
        self.edge_length
    }

    /// New vertices for the coming step's end, as many as there are; the present ones become those of its start. The tree of boxes is
    /// refitted, not built again.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when the count is another or a number is not finite; nothing is changed then.
    pub fn set_vertices(&mut self, vertices: &[Vector3<f64>]) -> Result<()> {
        self.check_replacement(vertices)?;
        std::mem::swap(&mut self.before, &mut self.vertices);
        self.vertices.copy_from_slice(vertices);
        self.refit();
        Ok(())
    }

    /// Checks that `vertices` could take the place of the mesh's own.
    pub(in crate::contact) fn check_replacement(&self, vertices: &[Vector3<f64>]) -> Result<()> {
        if vertices.len() != self.vertices.len() {
            return Err(Error::invalid(
                "vertices",
                format!("{} long", vertices.len()),
                format!("{} vertices, as the mesh has", self.vertices.len()),
            ));
        }
        check_vertices("vertices", vertices)
    }

    /// Leaves the vertices where the last step ended, at rest.
    pub fn rest(&mut self) {
        if self.moving {
            self.before.copy_from_slice(&self.vertices);
            self.refit();
        }
    }

    /// Sets the vertices of the step's start and end to those at the fractions `from` and `to` of the motion between two checked sets.
    pub(in crate::contact) fn advance(&mut self, first: &[Vector3<f64>], last: &[Vector3<f64>], from: f64, to: f64) {
        // Exactly the last ones at the end.
        let at = |index: usize, u: f64| if u >= 1.0 { last[index] } else { first[index] + (last[index] - first[index]) * u };
        for index in 0..first.len() {
            self.before[index] = at(index, from);
            self.vertices[index] = at(index, to);
        }
        self.refit();
    }

    /// Brings boxes and normals to the vertices. A leaf's box holds its triangle at start and end.
    fn refit(&mut self) {
        let travel =
            self.before.iter().zip(&self.vertices).map(|(before, after)| (after - before).norm_squared()).fold(0.0, f64::max);
        (self.travel, self.moving) = (travel.sqrt(), travel > 0.0);
        for (index, triangle) in self.triangles.iter().enumerate() {
            let _ = self.bvh.insert_or_update_partially(leaf(triangle, &self.before, &self.vertices), index as u32, 0.0);
        }
        self.bvh.refit_without_opt();
        self.normals.update(&self.vertices, &self.triangles, &self.neighbours);
        if self.moving && self.sides == Sides::Solid {
            self.normals_before.update(&self.before, &self.triangles, &self.neighbours);
        }
        self.mark();
        let used = used(&self.triangles, &self.vertices).chain(used(&self.triangles, &self.before));
        self.bounds = Bounds::of_points(used);
        self.edge_length = self.mean_edge();
    }

    /// Brings balls, flat triangles and stamp to the vertices.
    fn mark(&mut self) {
        self.balls.clear();
        self.flats.clear();
        for (index, triangle) in self.triangles.iter().enumerate() {
            let after = triangle.map(|vertex| self.vertices[vertex as usize]);
            let before = triangle.map(|vertex| self.before[vertex as usize]);
            let both = || after.iter().chain(&before);
            let centre = both().sum::<Vector3<f64>>() / 6.0;
            let radius = both().map(|corner| (corner - centre).norm_squared()).fold(0.0, f64::max).sqrt();
            self.balls.push((centre, radius));
            self.flats.push(FlatTriangle::new(&after, &self.normals.face(index as u32)));
        }
        let mix = |stamp: u64, bits: u64| (stamp ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        let coordinates = self.before.iter().chain(&self.vertices).flat_map(|vertex| [vertex.x, vertex.y, vertex.z]);
        let corners = self.triangles.iter().flatten();
        let stamp = coordinates.fold(self.triangles.len() as u64, |stamp, x| mix(stamp, x.to_bits()));
        self.stamp = corners.fold(stamp, |stamp, corner| mix(stamp, u64::from(*corner)));
    }

    /// Tells meshes apart by where their triangles are during the step.
    pub(in crate::contact) fn stamp(&self) -> u64 {
        self.stamp
    }

    /// How far the vertex goes that goes farthest during the step, m.
    pub(in crate::contact) fn farthest_travel(&self) -> f64 {
        self.travel
    }

    /// A triangle's corners at the step's end.
    #[inline]
    pub(in crate::contact) fn corners(&self, triangle: u32) -> [Vector3<f64>; 3] {
        self.triangles[triangle as usize].map(|vertex| self.vertices[vertex as usize])
    }

    /// A triangle's corners at the step's start.
    #[inline]
    pub(in crate::contact) fn corners_before(&self, triangle: u32) -> [Vector3<f64>; 3] {
        self.triangles[triangle as usize].map(|vertex| self.before[vertex as usize])
    }

    fn mean_edge(&self) -> f64 {
        let sum: f64 = (0..self.triangles.len() as u32)
            .map(|index| {
                let [a, b, c] = self.corners(index);
                (b - a).norm() + (c - b).norm() + (a - c).norm()
            })
            .sum();
        sum / (3 * self.triangles.len()) as f64
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        size_of_val::<[[u32; 3]]>(&self.triangles)
            + size_of_val::<[[u32; 3]]>(&self.neighbours)
            + (self.before.capacity() + self.vertices.capacity()) * size_of::<Vector3<f64>>()
            + self.flats.capacity() * size_of::<FlatTriangle>()
            + self.balls.capacity() * size_of::<(Vector3<f64>, f64)>()
            + self.normals.heap_bytes()
            + self.normals_before.heap_bytes()
            + self.bvh.heap_memory_size()
    }
}

/// The vertices that triangles use: a file may have others.
fn used<'a>(triangles: &'a [[u32; 3]], vertices: &'a [Vector3<f64>]) -> impl Iterator<Item = Vector3<f64>> + 'a {
    triangles.iter().flatten().map(|vertex| vertices[*vertex as usize])
}

/// The volume within a closed mesh, m³: negative when it is wound inward.
fn volume(vertices: &[Vector3<f64>], triangles: &[[u32; 3]]) -> f64 {
    // About a vertex, not the origin: a small mesh far away keeps its digits.
    let middle = vertices[triangles[0][0] as usize];
    let of = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize] - middle);
        a.dot(&b.cross(&c)) / 6.0
    };
    triangles.iter().map(of).sum()
}

/// A triangle's box over the step.
fn leaf(triangle: &[u32; 3], before: &[Vector3<f64>], after: &[Vector3<f64>]) -> Aabb {
    let bounds = Bounds::of_points(triangle.iter().flat_map(|vertex| [before[*vertex as usize], after[*vertex as usize]]));
    Aabb::new(Vector::from_array(bounds.low.into()), Vector::from_array(bounds.high.into()))
}

/// What holds of a mesh whatever happens to its vertices.
fn check_parts(vertices: &[Vector3<f64>], triangles: &[[u32; 3]], sides: Sides) -> Result<()> {
    if let Sides::Front { depth } = sides {
        check_positive(|| "sides.depth".into(), depth)?;
    }
    check_vertices("vertices", vertices)?;
    if triangles.is_empty() || triangles.len() >= RIM as usize {
        return Err(Error::invalid("triangles", format!("{} long", triangles.len()), "from one to 2^32 − 2 triangles"));
    }
    for (index, triangle) in triangles.iter().enumerate() {
        if let Some(corner) = triangle.iter().position(|vertex| *vertex as usize >= vertices.len()) {
            return Err(Error::invalid(
                format!("triangles[{index}][{corner}]"),
                triangle[corner],
                format!("an index below the number of vertices, {}", vertices.len()),
            ));
        }
    }
    Ok(())
}

fn check_vertices(argument: &str, vertices: &[Vector3<f64>]) -> Result<()> {
    for (index, vertex) in vertices.iter().enumerate() {
        for axis in 0..3 {
            check_finite(|| format!("{argument}[{index}][{axis}]"), vertex[axis])?;
        }
    }
    Ok(())
}

/// Finds each triangle's neighbours, and checks that they are what the sides need.
fn neighbours(triangles: &[[u32; 3]], sides: Sides) -> Result<Box<[[u32; 3]]>> {
    // An edge from both sides: its lower vertex, its higher, the triangle, which edge of it.
    let mut edges: Vec<[u32; 4]> = Vec::with_capacity(3 * triangles.len());
    for (index, triangle) in triangles.iter().enumerate() {
        for edge in 0..3 {
            let (from, to) = (triangle[edge], triangle[(edge + 1) % 3]);
            edges.push([from.min(to), from.max(to), index as u32, edge as u32]);
        }
    }
    edges.sort_unstable();
    let mut neighbours = vec![[RIM; 3]; triangles.len()];
    for shared in edges.chunk_by(|a, b| a[..2] == b[..2]) {
        let [from, to, first, _] = shared[0];
        let wound_forward = |of: &[u32; 4]| triangles[of[2] as usize][of[3] as usize] == from;
        let alike = shared.len() == 2 && wound_forward(&shared[0]) != wound_forward(&shared[1]);
        let fault = match sides {
            Sides::Solid if shared.len() != 2 => Some(format!("on {} triangles", shared.len())),
            Sides::Solid | Sides::Front { .. } if shared.len() == 2 && !alike => Some("wound alike by both its triangles".into()),
            _ => None,
        };
        if let Some(fault) = fault {
            return Err(Error::invalid(
                format!("triangles[{first}]"),
                format!("{:?}, whose edge from vertex {from} to {to} is {fault}", triangles[first as usize]),
                match sides {
                    Sides::Solid => "a closed mesh: every edge on two triangles, which run along it in opposite directions",
                    _ => "neighbours that run along their edge in opposite directions",
                },
            ));
        }
        // Where three or more meet, or neighbours are wound against each other, the neighbour across the edge gives no side: a rim.
        if alike {
            neighbours[shared[0][2] as usize][shared[0][3] as usize] = shared[1][2];
            neighbours[shared[1][2] as usize][shared[1][3] as usize] = shared[0][2];
        }
    }
    Ok(neighbours.into())
}
