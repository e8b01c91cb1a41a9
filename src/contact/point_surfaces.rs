//! The surfaces of bodies that a strand's quadrature points may touch, for contact at points (`step/at_points/contacts.rs`).

use nalgebra::Vector3;

use super::body_at::BodyAt;
use super::ccd::entrance::{Way, WayEnd, way};
use super::options::StrandContact;
use super::permitted_overlap::PermittedOverlap;
use super::shape::{STEEPEST_DISTANCE, Surface};
use crate::math::vector::Vec3;
use crate::step::at_points::surfaces::{Entered, NEAR, NearestSurfaces, Passed, STEEPEST, SurfaceAtPoint, Surfaces};

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

    fn way(&self, start: Vec3<f64>, now: Vec3<f64>) -> f64 {
        let ways = self.near.iter().map(|index| {
            let [from, to] = self.bodies[*index as usize].way(start.into(), now.into());
            (to - from).norm_squared()
        });
        ways.fold(0.0, f64::max).sqrt()
    }

    fn passed(&self, arclength: f64, [start, now]: [Vec3<f64>; 2], nearest: &Result<NearestSurfaces, f64>) -> Passed {
        let mut passed = Passed::default();
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
