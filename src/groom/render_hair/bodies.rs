//! Strands kept out of bodies: points that are too near go out along the distance field.

use nalgebra::Vector3;

use super::position::STEP;
use super::reach::beyond;
use crate::contact::shape::{DistanceGrid, PlaneField, Shape};
use crate::error::{Error, Result, check_finite, check_not_negative};
use crate::math::frame::Frame;

/// A body that strands are kept out of.
///
/// ```
/// use superhelix::render::RenderBody;
/// use superhelix::{Frame, Shape};
///
/// let head = Shape::new_sphere(0.09)?;
/// let body = RenderBody { thickness: 5e-4, ..RenderBody::new(&head, Frame::default()) };
/// assert_eq!(body.pose, body.pose_before);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct RenderBody<'a> {
    /// Its shape. Of a distance grid tangent planes at its nodes are looked at, some nanoseconds a point; other shapes are asked in full:
    /// of a mesh make a grid.
    pub shape: &'a Shape,
    /// Where it is.
    pub pose: Frame,
    /// Where it was at the earlier moment that velocities are taken from: [`Motion::Since`](super::Motion::Since)'s, or
    /// [`VELOCITY_STEP`](super::VELOCITY_STEP) ago.
    pub pose_before: Frame,
    /// How far outside its shape the body's surface lies, m; 0 or above.
    pub thickness: f64,
}

impl<'a> RenderBody<'a> {
    /// A body that stands still.
    pub fn new(shape: &'a Shape, pose: Frame) -> Self {
        Self { shape, pose, pose_before: pose, thickness: 0.0 }
    }

    /// Checks the numbers; `name` is the body's.
    pub(super) fn check(&self, name: &str) -> Result<()> {
        check_not_negative(|| format!("{name}.thickness"), self.thickness)?;
        for (field, pose) in [("pose", &self.pose), ("pose_before", &self.pose_before)] {
            for axis in 0..3 {
                check_finite(|| format!("{name}.{field}.origin[{axis}]"), pose.origin[axis])?;
            }
            let rotation = pose.rotation_xyzw();
            if !rotation.iter().all(|number| number.is_finite()) {
                return Err(Error::invalid(format!("{name}.{field}.rotation"), format!("{rotation:?}"), "finite numbers"));
            }
        }
        Ok(())
    }
}

/// A point as near as this to where it is to go is there, m.
const CLOSE_ENOUGH: f32 = 2e-4;
/// Tries to bring a point out; a field that is no distance everywhere takes more than one.
const TRIES: usize = 4;
/// Points deeper than this go out to the side on which their guide is, m: the nearest surface may be that of the other side.
const DEEP: f32 = 4e-3;
/// If that is no farther from them than so many times their depth: what is farther is beside something else.
const BESIDE: f32 = 4.0;
/// A way out is one along which the distance grows by so much a metre at least.
const STRAIGHT_OUT: f32 = 0.5;
/// Distances between a grid's nodes are known to within so much of its cell.
const GRID_ERROR: f32 = 0.5;
/// Points that wait for what was asked for them from memory.
const WAITING: usize = 64;
/// Beyond this, m, no distance from a shape without a grid is looked up: strands that lie closer to their guide than that need none.
const FAR: f32 = 0.1;
/// The steepest that strands leave their root for the surface: so much farther from it for each metre along.
const RISE: f32 = 0.25;

/// Distances about a body in its own axes.
#[derive(Debug, Clone, Copy)]
enum Field<'a> {
    /// Places are in cells from the lowest node.
    Grid(PlaneField<'a>, &'a DistanceGrid),
    /// Places are in m.
    Shape(&'a Shape),
}

impl Field<'_> {
    /// Distance (m) and slopes, where the surface is nearer than `within` (m) or somewhat farther.
    #[inline(always)]
    fn at(&self, place: [f32; 3], within: f32) -> Option<(f32, [f32; 3])> {
        match self {
            Field::Grid(field, _) => field.at(place),
            Field::Shape(shape) => {
                let surface = shape.closest(Vector3::from(place.map(f64::from)), f64::from(within))?;
                Some((surface.distance as f32, surface.normal.map(|value| value as f32).into()))
            }
        }
    }
}

/// A body at one moment, in single precision about the strands' origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed<'a> {
    field: Field<'a>,
    /// From the world into the body's places: rows, then what is added.
    into: [[f32; 3]; 3],
    shift: [f32; 3],
    /// m a unit of the body's places.
    unit: f32,
    thickness: f32,
}

impl<'a> Placed<'a> {
    pub fn new(body: &RenderBody<'a>, pose: &Frame, origin: Vector3<f64>) -> Self {
        let (field, low, unit) = match body.shape.grid() {
            Some(grid) => (Field::Grid(grid.planes(), grid), grid.low(), grid.cell()),
            None => (Field::Shape(body.shape), Vector3::zeros(), 1.0),
        };
        let back = pose.rotation.inverse().to_rotation_matrix();
        let shift = (back * (origin - pose.origin) - low) / unit;
        Self {
            field,
            into: [0, 1, 2].map(|row| [0, 1, 2].map(|column| (back[(row, column)] / unit) as f32)),
            shift: [0, 1, 2].map(|axis| shift[axis] as f32),
            unit: unit as f32,
            thickness: body.thickness as f32,
        }
    }

    /// How far all about a point no point is nearer to the body than `clearance`, m; below zero where some are.
    pub fn room(&self, point: [f32; 3], clearance: f32) -> f32 {
        let (place, near) = (self.place(point), self.thickness + clearance);
        match &self.field {
            Field::Grid(field, grid) => match grid.closest(grid.low() + Vector3::from(place.map(f64::from)) * grid.cell()) {
                Some(surface) => surface.distance as f32 - near - GRID_ERROR * self.unit,
                None => field.outside(place) * self.unit,
            },
            Field::Shape(_) => self.field.at(place, near + FAR).map_or(FAR, |(distance, _)| distance - near),
        }
    }

    #[inline(always)]
    fn place(&self, point: [f32; 3]) -> [f32; 3] {
        [0, 1, 2].map(|row| {
            let [a, b, c] = self.into[row];
            (a * point[0] + b * point[1]) + (c * point[2] + self.shift[row])
        })
    }

    /// A direction of the body's axes, times a length in m, in the world.
    #[inline(always)]
    fn out(&self, way: [f32; 3], length: f32) -> [f32; 3] {
        let size = length * self.unit;
        [0, 1, 2].map(|axis| size * ((self.into[0][axis] * way[0] + self.into[1][axis] * way[1]) + self.into[2][axis] * way[2]))
    }
}

/// A strand's points.
pub(super) struct Points<'a> {
    /// Rows of x, y and z.
    pub rows: &'a mut [f32],
    pub stride: usize,
    pub count: usize,
    /// How long the strand is to be, m.
    pub length: f32,
    /// Its first guide's points from its root, rows as well, and that root.
    pub guide: &'a [f32],
    pub guide_root: [f32; 3],
    /// How far from that guide's points no body is near, squares, m².
    pub reach: &'a [f32],
}

/// Brings points that are nearer to a body than `clearance` out of it, or, those outside, to where those that come out leave them room: one
/// `d` from the surface goes to c²/(2c − d), c the clearance, which is less near the root. The root stays.
#[inline(always)]
pub(super) fn keep_out(bodies: &[Placed], clearance: f32, points: &mut Points) {
    // What one body pushes out another may have to push back.
    for _ in 0..bodies.len().min(2) {
        for body in bodies {
            let mut waiting = [(0, [0.0; 3]); WAITING];
            let mut count = 0;
            for at in (0..points.stride).step_by(STEP) {
                let mut near = beyond(points.rows, points.guide, points.guide_root, points.stride, points.reach, at);
                while near != 0 {
                    let k = at + near.trailing_zeros() as usize;
                    near &= near - 1;
                    let place = body.place([0, 1, 2].map(|axis| points.rows[axis * points.stride + k]));
                    if let Field::Grid(field, _) = &body.field {
                        field.ask_for(place);
                    }
                    waiting[count % WAITING] = (k, place);
                    count += 1;
                }
                if count > WAITING - STEP || at + STEP >= points.stride {
                    for (k, place) in waiting.iter().take(count) {
                        keep_point_out(body, clearance, points, *k, *place);
                    }
                    count = 0;
                }
            }
        }
    }
}

/// Keeps point `k`, which is at that place of a body's, out of it.
#[inline(always)]
fn keep_point_out(body: &Placed, clearance: f32, points: &mut Points, k: usize, place: [f32; 3]) {
    let stride = points.stride;
    let Some((distance, slopes)) = body.field.at(place, body.thickness + clearance) else { return };
    let distance = distance - body.thickness;
    let clearance = clearance.min(RISE * points.length * (k as f32 / (points.count - 1) as f32));
    if distance >= clearance {
        return;
    }
    let point = [0, 1, 2].map(|axis| points.rows[axis * stride + k]);
    let out = brought_out(body, point, (distance, slopes), clearance, || {
        [0, 1, 2].map(|axis| points.guide_root[axis] + points.guide[axis * stride + k])
    });
    (0..3).for_each(|axis| points.rows[axis * stride + k] = out[axis]);
}

/// Where a point goes that is nearer to a body than the clearance.
#[inline(always)]
fn brought_out(
    body: &Placed,
    point: [f32; 3],
    (distance, slopes): (f32, [f32; 3]),
    clearance: f32,
    guide: impl FnOnce() -> [f32; 3],
) -> [f32; 3] {
    let target = clearance * clearance / (2.0 * clearance - distance);
    let dot = |a: [f32; 3], b: [f32; 3]| (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
    // What does not come out is not to lie deeper for it.
    let mut best = (distance, point);
    let (mut point, mut distance, mut slopes) = (point, distance, slopes);
    let mut side = None;
    if distance < -DEEP {
        let beside = guide();
        let apart = [0, 1, 2].map(|axis| beside[axis] - point[axis]);
        let is_beside = dot(apart, apart) < (BESIDE * distance) * (BESIDE * distance);
        if is_beside && let Some((there, way)) = body.field.at(body.place(beside), f32::INFINITY) {
            side = Some(way);
            if dot(way, slopes) <= 0.0 {
                // The guide is beyond the middle: from where it is, it is not far.
                (point, distance, slopes) = (beside, there - body.thickness, way);
            }
        }
        if distance >= target {
            return point;
        }
    }
    for _ in 0..TRIES {
        let size = dot(slopes, slopes).sqrt();
        if size < 1e-3 {
            break;
        }
        let mut way = slopes.map(|slope| slope / size);
        if let Some(side) = side {
            let of_side = dot(side, side).sqrt();
            // Where that leads along the surface, or in, it may come out anywhere.
            if distance < 0.0 && dot(side, slopes) > STRAIGHT_OUT * of_side * size {
                way = side.map(|slope| slope / of_side);
            }
        }
        let step = (target - distance) / dot(way, slopes).max(STRAIGHT_OUT);
        let more = body.out(way, step);
        (0..3).for_each(|axis| point[axis] += more[axis]);
        match body.field.at(body.place(point), f32::INFINITY) {
            Some((now, now_slopes)) => (distance, slopes) = (now - body.thickness, now_slopes),
            None => return point,
        }
        if distance > best.0 {
            best = (distance, point);
        }
        if (target - distance).abs() < CLOSE_ENOUGH {
            break;
        }
    }
    if distance < 0.0 { best.1 } else { point }
}
