//! Nearest points of a mesh, over all of it or over a few triangles picked beforehand (`patch.rs`).

use std::cell::Cell;

use nalgebra::Vector3;
use parry3d_f64::partitioning::BvhNode;

use super::normals::Normals;
use super::patch::{Ball, Patch};
use super::triangle::{self, Part};
use super::triangle_mesh::{Mesh, Sides};
use crate::contact::shape::Surface;

/// The nearest place of a mesh, before its side is known.
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
        self.signed(&point, &nearest, within)
    }

    /// The distance of a surface that is known to be at most `at_most` away, m: signed for a solid, else without sign.
    pub(in crate::contact::shape) fn signed_distance(&self, point: &Vector3<f64>, at_most: f64) -> f64 {
        let nearest = self.nearest(point, at_most).or_else(|| self.nearest(point, f64::INFINITY));
        nearest.map_or(f64::INFINITY, |nearest| match self.sides {
            Sides::Solid => self.signed(point, &nearest, f64::INFINITY).map_or(f64::INFINITY, |surface| surface.distance),
            _ => nearest.squared.sqrt(),
        })
    }

    /// [`Mesh::closest`] for a point, among triangles so picked that all that are nearer to it than `reach` are among them. `hint`, a
    /// triangle that may be near, bounds the search. `inside`, where it is known, tells the side of a point of a solid that none is near to.
    pub(in crate::contact) fn closest_among(
        &self,
        balls: &[Ball],
        hint: &Cell<Option<u32>>,
        reach: f64,
        inside: Option<bool>,
        point: Vector3<f64>,
    ) -> Option<Surface> {
        let mut best = hint.get().unwrap_or(u32::MAX);
        let mut squared = hint.get().map_or(f64::INFINITY, |near| self.flat(near).distance_squared(&point));
        let (mut bound, first) = (squared.sqrt(), best);
        for ball in balls {
            let far = ball.radius + bound;
            if ball.triangle == first || (point - ball.centre).norm_squared() > far * far {
                continue;
            }
            let here = self.flat(ball.triangle).distance_squared(&point);
            // Of equally near triangles the first.
            if here < squared || here == squared && ball.triangle < best {
                (best, squared, bound) = (ball.triangle, here, here.sqrt());
            }
        }
        let mut best = if squared.is_finite() {
            hint.set(Some(best));
            nearest_of(best, &self.flat(best).corners, &point)
        } else {
            Nearest { triangle: 0, weights: [0.0; 3], part: Part::Face, point, squared }
        };
        if bound > reach {
            // Another triangle may be nearer. It matters behind the surface only; what was found bounds the search.
            let deepest = match self.sides {
                Sides::Solid => f64::INFINITY,
                Sides::Front { depth } => depth,
                Sides::Both => 0.0,
            };
            if deepest <= reach || inside == Some(false) || !self.bounds().grown(deepest.min(reach)).holds(&point) {
                return None;
            }
            best = self.nearest(&point, deepest.min(bound * (1.0 + 1e-9)))?;
        }
        self.signed(&point, &best, reach)
    }

    /// The surface that is nearest at the step's start to a point then, as it is at the step's end, with the distance at the start; None if
    /// it is farther than `reach`.
    pub(in crate::contact) fn closest_at_start(&self, patch: &Patch, reach: f64, point: &Vector3<f64>) -> Option<Surface> {
        let mut best: Option<Nearest> = None;
        let mut most = reach * reach;
        for index in &patch.triangles {
            let (centre, radius) = self.balls[*index as usize];
            let far = radius + most.sqrt();
            if (point - centre).norm_squared() < far * far {
                let found = nearest_of(*index, &self.corners_before(*index), point);
                if found.squared < most {
                    (best, most) = (Some(found), found.squared);
                }
            }
        }
        let nearest = best?;
        if !self.is_moving() {
            return self.signed(point, &nearest, reach);
        }
        let surface = self.signed_by(&self.normals_before, point, &nearest, reach)?;
        let index = nearest.triangle as usize;
        let (side, _) = self.normals.at(nearest.triangle, &self.triangles[index], &self.neighbours[index], nearest.part);
        let corners = self.corners(nearest.triangle);
        let now = (0..3).map(|corner| corners[corner] * nearest.weights[corner]).sum();
        Some(Surface { point: now, normal: side.try_normalize(0.0).unwrap_or(surface.normal), ..surface })
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
    fn signed(&self, point: &Vector3<f64>, nearest: &Nearest, within: f64) -> Option<Surface> {
        self.signed_by(&self.normals, point, nearest, within)
    }

    fn signed_by(&self, normals: &Normals, point: &Vector3<f64>, nearest: &Nearest, within: f64) -> Option<Surface> {
        let out = point - nearest.point;
        let index = nearest.triangle as usize;
        let (side, rim) = normals.at(nearest.triangle, &self.triangles[index], &self.neighbours[index], nearest.part);
        // Over a face its own normal keeps its digits however near the point is.
        let height = if nearest.part == Part::Face { side.dot(&out).abs() } else { nearest.squared.sqrt() };
        let below = side.dot(&out) < 0.0;
        let behind = match self.sides {
            Sides::Solid => below,
            // Beyond a rim a point is beside the mesh, not behind it.
            Sides::Front { depth } => {
                if below && !rim && height > depth {
                    return None;
                }
                below && !rim
            }
            Sides::Both => false,
        };
        let distance = if behind { -height } else { height };
        if distance >= within {
            return None;
        }
        let normal = if nearest.part == Part::Face {
            if below && !behind { -side } else { side }
        } else if height > 1e-12 {
            out / distance
        } else {
            // On an edge its own normal is the way out.
            side.try_normalize(0.0).unwrap_or_else(Vector3::x)
        };
        Some(Surface { point: nearest.point, normal, distance, feature: nearest.triangle, weights: nearest.weights })
    }

    /// Weights of the corners in the point of a triangle that is nearest to `point`, and the offset from it to `point`.
    #[inline]
    pub(in crate::contact) fn closest_on(corners: &[Vector3<f64>; 3], point: &Vector3<f64>) -> ([f64; 3], Vector3<f64>) {
        let found = nearest_of(0, corners, point);
        (found.weights, point - found.point)
    }
}

fn nearest_of(index: u32, corners: &[Vector3<f64>; 3], point: &Vector3<f64>) -> Nearest {
    let [a, b, c] = corners;
    let (weights, part) = triangle::closest(a, b, c, point);
    let nearest = a * weights[0] + b * weights[1] + c * weights[2];
    Nearest { triangle: index, weights, part, point: nearest, squared: (point - nearest).norm_squared() }
}
