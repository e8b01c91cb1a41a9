//! The surfaces of bodies that a strand's quadrature points may touch, for contact at points (`step/at_points/contacts.rs`).

use nalgebra::Vector3;

use super::body_at::BodyAt;
use super::ccd::entrance::{Way, WayEnd, way};
use super::options::StrandContact;
use super::passage_bounds;
use super::permitted_overlap::PermittedOverlap;
use super::shape::{STEEPEST_DISTANCE, Surface};
use crate::math::vector::Vec3;
use crate::step::at_points::surfaces::{
    Entered, NEAR, NearestSurfaces, Passage, PassageBounds, Passed, STEEPEST, SurfaceAtPoint, Surfaces,
};

/// How far from a point a mesh is searched beyond the distance that the surfaces keep, m: farther triangles cost more to find.
const REACH: f64 = 5e-3;
/// A surface that is farther than this from a point need not be known, m.
const KNOWN: f64 = 2e-3;
/// The radius with which a distance grid rounds a crease, in cells.
const ROUNDED_CELLS: f64 = 0.6;
/// No surface is asked for that is farther, m.
const FAR: f64 = 0.1;

const _: () = assert!(STEEPEST >= STEEPEST_DISTANCE);

/// What a strand may touch.
#[derive(Debug, Clone, Copy)]
pub struct StrandSurfaces<'a> {
    /// All bodies of the scene.
    pub bodies: &'a [BodyAt<'a>],
    /// Indices of those that it may come near.
    pub near: &'a [u32],
    /// Its contact properties.
    pub contact: &'a StrandContact,
    /// Its permitted overlap.
    pub permitted_overlap: Option<&'a PermittedOverlap>,
}

impl StrandSurfaces<'_> {
    /// How far its axis is from a body's surface where they touch, m.
    fn margin(&self, body: &BodyAt) -> f64 {
        self.contact.radius + body.thickness
    }

    /// The depth in a body that counts for none at an arclength, m.
    fn permitted(&self, arclength: f64) -> f64 {
        self.permitted_overlap.map_or(0.0, |permitted| permitted.sunk(arclength))
    }
}

impl<'a> StrandSurfaces<'a> {
    fn surface(&self, found: &Found<'a>, permitted: f64) -> SurfaceAtPoint {
        let Found { gap, body, surface } = found;
        SurfaceAtPoint {
            body: body.index,
            feature: surface.feature,
            gap: gap + permitted,
            permitted,
            margin: self.margin(body),
            rounding: body.shape.grid().map_or(0.0, |grid| ROUNDED_CELLS * grid.cell()),
            normal: body.to_world(&surface.normal).into(),
            carried: body.carried(surface).into(),
            along: self.contact.friction.along * body.friction,
            against: self.contact.friction.against * body.friction,
        }
    }
}

/// The surface of a body that is near a point.
struct Found<'a> {
    gap: f64,
    body: &'a BodyAt<'a>,
    surface: Surface,
}

impl Surfaces for StrandSurfaces<'_> {
    fn nearest(&self, arclength: f64, now: Vec3<f64>) -> Result<NearestSurfaces, f64> {
        if arclength < self.contact.exempt_length {
            // How near a surface is here says nothing of the points that take part.
            return Err(0.0);
        }
        let at = Vector3::from(now);
        let mut nearest: Result<Found, f64> = Err(FAR);
        let mut next: Option<Found> = None;
        for index in self.near {
            let body = &self.bodies[*index as usize];
            let margin = self.margin(body);
            let limit = match (&nearest, &next) {
                (Err(far), _) => *far,
                (Ok(first), None) => first.gap.max(NEAR),
                (Ok(_), Some(second)) => second.gap,
            };
            let away = body.bounds.distance(&at) - margin;
            if away > limit {
                continue;
            }
            let found = if away < KNOWN {
                let reach = if body.shape.mesh().is_some() { REACH } else { KNOWN };
                body.closest_or_least_at_end(at, margin + reach).map_err(|far| away.max(far - margin))
            } else {
                Err(away)
            };
            match (found, &mut nearest) {
                (Ok(surface), nearest) if surface.distance - margin < limit => {
                    let found = Found { gap: surface.distance - margin, body, surface };
                    let second = match nearest {
                        Ok(first) if first.gap <= found.gap => Some(found),
                        _ => std::mem::replace(nearest, Ok(found)).ok(),
                    };
                    next = second.filter(|second| second.gap < NEAR).or(next);
                }
                (Err(far), Err(least)) => *least = least.min(far),
                _ => {}
            }
        }
        let (nearest, permitted) = (nearest?, self.permitted(arclength));
        let surface = |found: &Found| self.surface(found, permitted);
        Ok(NearestSurfaces { nearest: surface(&nearest), next: next.as_ref().map(surface) })
    }

    fn depth_at_start(&self, arclength: f64, body: u32, start: Vec3<f64>) -> f64 {
        let body = &self.bodies[body as usize];
        let margin = self.margin(body);
        let surface = body.closest_at_start(start.into(), margin + REACH);
        surface.map_or(0.0, |surface| margin - surface.distance - self.permitted(arclength))
    }

    fn bound(&self, passages: &[Passage], bounds: &mut Vec<PassageBounds>) {
        bounds.clear();
        // (How near a surface is to what takes no part says nothing of the rest.)
        let takes_part = |passage: &Passage| passage.arclength >= self.contact.exempt_length;
        bounds.extend(passages.iter().map(|passage| PassageBounds {
            least: if takes_part(passage) { FAR } else { 0.0 },
            way: 0.0,
            is_free: true,
        }));
        for index in self.near {
            let body = &self.bodies[*index as usize];
            passage_bounds::add(body, self.margin(body), passages, bounds);
        }
    }

    fn passed(&self, passage: &Passage, nearest: &Result<NearestSurfaces, f64>) -> Passed {
        let (Passage { arclength, start, now }, mut passed) = (*passage, Passed::default());
        if arclength < self.contact.exempt_length {
            return passed;
        }
        // Bodies that were not found are no nearer than what was, nor than what need not be known.
        let least =
            nearest.as_ref().map_or_else(|at_least| *at_least, |found| (found.nearest.gap - found.nearest.permitted).min(KNOWN));
        for index in self.near {
            let body = &self.bodies[*index as usize];
            let ends = body.way(start.into(), now.into());
            let length = (ends[1] - ends[0]).norm();
            let margin = self.margin(body);
            let known = nearest.as_ref().ok().and_then(|found| found.iter().find(|surface| surface.body == *index));
            let distance = known.map_or(least + margin, SurfaceAtPoint::distance);
            if length < NEAR || distance - margin > body.shape.distance_slope() * length {
                continue;
            }
            let end = known
                .map_or(WayEnd::NoNearer(distance), |surface| WayEnd::At(distance, body.axes_end.tr_mul(&surface.normal.into())));
            let Way { start, entrance } = way(body.shape, ends, margin, end);
            if passed.start.is_none() && known.is_some() {
                passed.start = start.map(|distance| (*index, margin - distance - self.permitted(arclength)));
            }
            if let Some((place, surface)) = entrance {
                let place = body.end.origin + body.to_world(&place);
                let found = Found { gap: surface.distance - margin, body, surface };
                passed.entered = Some(Entered { surface: self.surface(&found, 0.0), place: place.into() });
                break;
            }
        }
        passed
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::contact::shape::{DistanceGrid, Mesh, Shape, Sides};
    use crate::math::frame::Frame;
    use crate::math::random::Seeded;

    /// The corners of a box of 20 × 30 × 40 mm, and its triangles.
    fn box_mesh() -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
        let side = |bit: u32, corner: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let corners = (0..8).map(|corner| Vector3::new(0.01 * side(0, corner), 0.015 * side(1, corner), 0.02 * side(2, corner)));
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        (corners.collect(), faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect())
    }

    fn random_place(seeded: Seeded, k: u64, half: f64) -> Vector3<f64> {
        Vector3::from_fn(|axis, _| half * (2.0 * seeded.unit(3 * k + axis as u64) - 1.0))
    }

    #[test]
    fn what_is_found_out_at_little_cost_is_true() {
        let (corners, triangles) = box_mesh();
        let grid = DistanceGrid::bake(&Mesh::new(corners.clone(), triangles.clone(), Sides::Solid).unwrap(), 2e-3, 0.02).unwrap();
        let shapes = [
            Shape::new_sphere(0.02).unwrap(),
            Shape::new_capsule(Vector3::zeros(), Vector3::new(0.0, 0.03, 0.0), 0.01).unwrap(),
            Shape::new_box(Vector3::new(0.01, 0.02, 0.03)).unwrap(),
            Shape::new_half_space(Vector3::y()).unwrap(),
            Shape::new_mesh(corners, triangles, Sides::Solid).unwrap(),
            Shape::new_grid(grid),
        ];
        let turned =
            Frame { origin: Vector3::new(0.01, -0.004, 0.02), rotation: UnitQuaternion::from_euler_angles(0.5, -0.3, 1.1) };
        let start = Frame { origin: Vector3::zeros(), rotation: UnitQuaternion::from_euler_angles(0.4, -0.3, 1.0) };
        let contact = StrandContact { exempt_length: 5e-3, ..StrandContact::default() };
        let (seeded, mut bounds) = (Seeded::new(7, 0), Vec::new());
        for (shape, far) in shapes.iter().zip([1e-9, 1e-9, 1e-9, 1e-9, 0.02, 6e-3]) {
            let bodies = [BodyAt::new(0, shape, start, turned, 1e-3)];
            let surfaces = StrandSurfaces { bodies: &bodies, near: &[0], contact: &contact, permitted_overlap: None };
            let passages: Vec<Passage> = (0..500)
                .map(|k| Passage {
                    arclength: 1e-3 * k as f64,
                    start: random_place(seeded, 2 * k, 0.06).into(),
                    now: random_place(seeded, 2 * k + 1, 0.06).into(),
                })
                .collect();
            surfaces.bound(&passages, &mut bounds);
            assert_eq!(bounds.len(), passages.len());
            let (mut loosest, mut free) = (0.0_f64, 0);
            for (passage, bounds) in passages.iter().zip(&bounds) {
                let own = start.rotation.inverse() * (Vector3::from(passage.start) - start.origin);
                let start_now = turned.origin + turned.rotation * own;
                assert!((bounds.way - (Vector3::from(passage.now) - start_now).norm()).abs() < 1e-12, "{shape:?}");
                if passage.arclength < contact.exempt_length {
                    assert!(bounds.least <= 0.0);
                    continue;
                }
                if bounds.is_free {
                    free += 1;
                    let now = turned.rotation.inverse() * (Vector3::from(passage.now) - turned.origin);
                    for step in 0..=50 {
                        let place = own.lerp(&now, f64::from(step) / 50.0);
                        let distance = shape.closest(place, 1.0).map_or(f64::INFINITY, |surface| surface.distance);
                        assert!(distance > surfaces.margin(&bodies[0]) - 1e-12, "{shape:?}: {distance} at {step} of 50");
                    }
                }
                let Some(surface) = bodies[0].closest_at_end(passage.now.into(), 1.0) else { continue };
                let gap = (surface.distance - surfaces.margin(&bodies[0])).min(FAR);
                assert!(bounds.least <= gap + 1e-12, "{shape:?}: {} where it is {gap}", bounds.least);
                loosest = loosest.max(if gap > 0.0 && bounds.least > f64::NEG_INFINITY { gap - bounds.least } else { 0.0 });
            }
            assert!(loosest < far, "{shape:?}: {loosest} less than it is");
            assert!((20..480).contains(&free), "{shape:?}: {free} of 500 are free");
        }
    }
}
