//! Nearest points of a mesh, over all of it or over a few triangles picked beforehand.

use std::cell::Cell;

use nalgebra::Vector3;
use parry3d_f64::partitioning::{BvhNode, TraversalAction};

use super::bounds::Bounds;
use super::mesh::{Mesh, Sides};
use super::surface::Surface;
use super::triangle::{self, Part};

/// A triangle picked for queries nearby.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Candidate {
    /// Its index.
    pub index: u32,
    /// Its corners at the step's end.
    pub corners: [Vector3<f64>; 3],
    /// How far they go during the step; zero for meshes at rest.
    pub travel: [Vector3<f64>; 3],
    centre: Vector3<f64>,
    radius: f64,
}

/// The nearest place of a mesh, before its side is told.
#[derive(Debug, Clone, Copy)]
struct Nearest {
    triangle: u32,
    weights: [f64; 3],
    part: Part,
    point: Vector3<f64>,
    squared: f64,
}

impl Mesh {
    /// The nearest point of the surface, if the signed distance is below `within`; from inside a solid at any depth.
    ///
    /// For [`Sides::Both`] the distance is never negative: on which side a strand belongs is a matter of its path.
    pub fn closest(&self, point: Vector3<f64>, within: f64) -> Option<Surface> {
        let reach = match self.sides {
            Sides::Solid if self.bounds().holds(&point) => f64::INFINITY,
            Sides::Front { depth } => within.max(depth),
            _ => within,
        };
        let nearest = self.nearest(&point, reach)?;
        self.told(&point, &nearest, within)
    }

    /// The signed distance of a solid that is known to be at most `at_most` away, m.
    pub(super) fn signed_distance(&self, point: &Vector3<f64>, at_most: f64) -> f64 {
        let nearest = self.nearest(point, at_most).or_else(|| self.nearest(point, f64::INFINITY));
        nearest.and_then(|nearest| self.told(point, &nearest, f64::INFINITY)).map_or(f64::INFINITY, |surface| surface.distance)
    }

    /// Picks the triangles whose boxes over the step meet `bounds`.
    pub(in crate::contact) fn gather(&self, bounds: &Bounds, out: &mut Vec<Candidate>) {
        out.clear();
        let (low, high) = (bounds.low, bounds.high);
        self.bvh.traverse(|node: &BvhNode| {
            let (mins, maxs) = (node.mins(), node.maxs());
            if mins.x > high.x || maxs.x < low.x || mins.y > high.y || maxs.y < low.y || mins.z > high.z || maxs.z < low.z {
                return TraversalAction::Prune;
            }
            if let Some(index) = node.leaf_data() {
                let corners = self.corners(index);
                let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
                let radius = corners.iter().map(|corner| (corner - centre).norm_squared()).fold(0.0, f64::max).sqrt();
                let mut travel = [Vector3::zeros(); 3];
                if self.is_moving() {
                    let before = self.corners_before(index);
                    travel = std::array::from_fn(|corner| corners[corner] - before[corner]);
                }
                out.push(Candidate { index, corners, travel, centre, radius });
            }
            TraversalAction::Continue
        });
        // In the order of the mesh, so that of equally near triangles the first is found whatever the tree looks like.
        out.sort_unstable_by_key(|candidate| candidate.index);
    }

    /// [`Mesh::closest`] for a point near triangles that were picked with a box that holds the point and reaches at least `reach`
    /// farther on all sides. `inside`, where it is known, tells the side of a point of a solid that none of them is near to.
    pub(in crate::contact) fn closest_among(
        &self,
        candidates: &[Candidate],
        reach: f64,
        inside: Option<bool>,
        point: Vector3<f64>,
    ) -> Option<Surface> {
        let mut best = Nearest { triangle: 0, weights: [0.0; 3], part: Part::Face, point, squared: f64::INFINITY };
        let mut distance = f64::INFINITY;
        for candidate in candidates {
            let far = candidate.radius + distance;
            if (point - candidate.centre).norm_squared() > far * far {
                continue;
            }
            let found = nearest_of(candidate.index, &candidate.corners, &point);
            if found.squared < best.squared {
                best = found;
                distance = best.squared.sqrt();
            }
        }
        if distance > reach {
            // Another triangle may be nearer. It matters from inside a solid only; what was found bounds the search.
            if self.sides != Sides::Solid || inside == Some(false) || !self.bounds().holds(&point) {
                return None;
            }
            best = self.nearest(&point, distance * (1.0 + 1e-9)).unwrap_or(best);
        }
        self.told(&point, &best, reach)
    }

    /// The nearest place no farther than `reach`; of equally near triangles that of the lowest index, whatever the tree looks like: one
    /// that was refitted many times and one that is new give the same.
    fn nearest(&self, point: &Vector3<f64>, reach: f64) -> Option<Nearest> {
        let to_box = |node: &BvhNode| {
            let (mins, maxs) = (node.mins(), node.maxs());
            let x = (mins.x - point.x).max(point.x - maxs.x).max(0.0);
            let y = (mins.y - point.y).max(point.y - maxs.y).max(0.0);
            let z = (mins.z - point.z).max(point.z - maxs.z).max(0.0);
            // A little less, so that a box as far as the best triangle is still looked into.
            (x * x + y * y + z * z) * (1.0 - 1e-9) - f64::MIN_POSITIVE
        };
        let most = if reach.is_finite() { reach * reach } else { f64::MAX };
        let best: Cell<Option<Nearest>> = Cell::new(None);
        self.bvh.find_best(
            most,
            |node, _| to_box(node),
            |index, _| {
                let found = nearest_of(index, &self.corners(index), point);
                let key = |nearest: &Nearest| (nearest.squared, nearest.triangle);
                if found.squared < most && best.get().is_none_or(|best| key(&found) < key(&best)) {
                    best.set(Some(found));
                }
                Some(found.squared)
            },
        );
        best.get()
    }

    /// Tells the side of a point at its nearest place.
    fn told(&self, point: &Vector3<f64>, nearest: &Nearest, within: f64) -> Option<Surface> {
        let out = point - nearest.point;
        let distance = nearest.squared.sqrt();
        let index = nearest.triangle as usize;
        let (side, rim) = self.normals.at(nearest.triangle, &self.triangles[index], &self.neighbours[index], nearest.part);
        let behind = match self.sides {
            Sides::Solid => side.dot(&out) < 0.0,
            // Beyond a rim a point is beside the mesh, not behind it.
            Sides::Front { depth } => {
                let behind = side.dot(&out) < 0.0 && !rim;
                if behind && distance > depth {
                    return None;
                }
                behind
            }
            Sides::Both => false,
        };
        let distance_signed = if behind { -distance } else { distance };
        if distance_signed >= within {
            return None;
        }
        // On the surface itself its own normal is the way out.
        let normal = if distance > 1e-12 { out / distance_signed } else { side.try_normalize(0.0).unwrap_or_else(Vector3::x) };
        Some(Surface {
            point: nearest.point,
            normal,
            distance: distance_signed,
            feature: nearest.triangle,
            weights: nearest.weights,
        })
    }

    /// Whether the way from `from` to `to` goes through an odd number of the picked triangles.
    pub(in crate::contact) fn crosses(candidates: &[Candidate], from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        let mut odd = false;
        for candidate in candidates {
            let [a, b, c] = &candidate.corners;
            let normal = (b - a).cross(&(c - a));
            // As seen from the triangle, which may move itself.
            let [p, q, r] = candidate.travel;
            let from = &(from + (p + q + r) / 3.0);
            let way = to - from;
            let (start, end) = (normal.dot(&(from - a)), normal.dot(&(to - a)));
            if (start < 0.0) == (end < 0.0) {
                continue;
            }
            // The signed volumes of the way with the edges: all of one sign when it passes between them.
            let volume = |p: &Vector3<f64>, q: &Vector3<f64>| way.dot(&(p - from).cross(&(q - from)));
            let volumes = [volume(a, b), volume(b, c), volume(c, a)];
            if volumes.iter().all(|volume| *volume >= 0.0) || volumes.iter().all(|volume| *volume < 0.0) {
                odd = !odd;
            }
        }
        odd
    }

    /// Weights of the corners in the point of a triangle that is nearest to `point`, that point, and the way from it to `point`.
    #[inline]
    pub(in crate::contact) fn closest_on(
        corners: &[Vector3<f64>; 3],
        point: &Vector3<f64>,
    ) -> ([f64; 3], Vector3<f64>, Vector3<f64>) {
        let found = nearest_of(0, corners, point);
        (found.weights, found.point, point - found.point)
    }

    /// The unit normal of a triangle's face at the step's end; zero where it has lost its area.
    pub(in crate::contact) fn face_normal(&self, triangle: u32) -> Vector3<f64> {
        self.normals.face(triangle)
    }
}

fn nearest_of(index: u32, corners: &[Vector3<f64>; 3], point: &Vector3<f64>) -> Nearest {
    let [a, b, c] = corners;
    let (weights, part) = triangle::closest(a, b, c, point);
    let nearest = a * weights[0] + b * weights[1] + c * weights[2];
    Nearest { triangle: index, weights, part, point: nearest, squared: (point - nearest).norm_squared() }
}
