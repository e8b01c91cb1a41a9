//! Keeps render strands out of bodies: points that are too close move out along the distance field.

use nalgebra::Vector3;

use super::position::STEP;
use super::reach::beyond;
use crate::contact::shape::{DistanceGrid, PlaneField, Shape};
use crate::error::{Error, Result, check_finite, check_not_negative};
use crate::math::frame::Frame;

/// A body that strands stay out of.
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
    /// Its shape. A distance grid is read through tangent planes at its nodes, at some nanoseconds per point; other shapes are
    /// evaluated fully: bake a grid of a mesh.
    pub shape: &'a Shape,
    /// Its pose.
    pub pose: Frame,
    /// Its pose at the earlier moment for velocities: [`Motion::Since`](crate::groom::render_hair::Motion::Since)'s, or
    /// [`VELOCITY_STEP`](crate::groom::render_hair::VELOCITY_STEP) ago.
    pub pose_before: Frame,
    /// Distance of the body's surface outside its shape, m; 0 or above.
    pub thickness: f64,
}

impl<'a> RenderBody<'a> {
    /// A body at rest.
    pub fn new(shape: &'a Shape, pose: Frame) -> Self {
        Self { shape, pose, pose_before: pose, thickness: 0.0 }
    }

    /// Checks the numbers; `name` is the body's name in errors.
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

/// A point this close to its target has reached it, m.
const CLOSE_ENOUGH: f32 = 2e-4;
/// Attempts to bring a point out; a field that is not a distance everywhere takes more than one.
const TRIES: usize = 4;
/// Points deeper than this go out on their guide's side, m: the nearest surface may be on the other side,
const DEEP: f32 = 4e-3;
/// if the guide is within this many times their depth: a more distant one is beside something else.
const BESIDE: f32 = 4.0;
/// A direction leads out if the distance grows along it by at least this much per metre.
const STRAIGHT_OUT: f32 = 0.5;
/// Distances between a grid's nodes are known to within this fraction of its cell.
const GRID_ERROR: f32 = 0.5;
/// Points that wait for prefetched memory.
const WAITING: usize = 64;
/// Beyond this, m, no distance from a shape without a grid is evaluated: strands closer than that to their guide need none.
const FAR: f32 = 0.1;
/// The steepest rise of strands from their root to the surface, per metre of length.
const RISE: f32 = 0.25;

/// Distances around a body in its own axes.
#[derive(Debug, Clone, Copy)]
enum Field<'a> {
    /// Positions are in cells from the lowest node.
    Grid(PlaneField<'a>, &'a DistanceGrid),
    /// Positions are in m.
    Shape(&'a Shape),
}

impl Field<'_> {
    /// Distance (m) and slopes, where the surface is closer than `within` (m) or somewhat farther.
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

/// A body at one moment, in single precision relative to the strands' origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed<'a> {
    field: Field<'a>,
    /// From the world to the body's positions: rows, and the offset.
    into: [[f32; 3]; 3],
    shift: [f32; 3],
    /// Metres per unit of the body's positions.
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

    /// The distance around a point within which no point is closer to the body than `clearance`, m; below zero where some are.
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

    /// A direction in the body's axes, times a length in m, in world axes.
    #[inline(always)]
    fn out(&self, direction: [f32; 3], length: f32) -> [f32; 3] {
        let size = length * self.unit;
        [0, 1, 2].map(|axis| {
            size * ((self.into[0][axis] * direction[0] + self.into[1][axis] * direction[1]) + self.into[2][axis] * direction[2])
        })
    }
}

/// A strand's points.
pub(super) struct Points<'a> {
    /// Rows of x, y and z.
    pub rows: &'a mut [f32],
    pub stride: usize,
    pub count: usize,
    /// The strand's target length, m.
    pub length: f32,
    /// Its first guide's points relative to its root, rows as well, and that root.
    pub guide: &'a [f32],
    pub guide_root: [f32; 3],
    /// The distance around that guide's points within which there is no body, squared, m².
    pub reach: &'a [f32],
}

/// Moves points that are closer to a body than `clearance` out of it, and points just outside far enough to leave room for them:
/// one at distance `d` from the surface goes to c²/(2c − d), where c is the clearance, which is less near the root. The root
/// stays.
#[inline(always)]
pub(super) fn keep_out(bodies: &[Placed], clearance: f32, points: &mut Points) {
    // A point pushed out of one body may need a push from another.
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

/// Keeps point `k`, at this position in the body's units, out of the body.
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

/// The target of a point that is closer to a body than the clearance.
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
    // A point that does not come out must not get deeper.
    let mut best = (distance, point);
    let (mut point, mut distance, mut slopes) = (point, distance, slopes);
    let mut side = None;
    if distance < -DEEP {
        let beside = guide();
        let apart = [0, 1, 2].map(|axis| beside[axis] - point[axis]);
        let is_beside = dot(apart, apart) < (BESIDE * distance) * (BESIDE * distance);
        if is_beside && let Some((there, direction)) = body.field.at(body.place(beside), f32::INFINITY) {
            side = Some(direction);
            if dot(direction, slopes) <= 0.0 {
                // The guide is on the other side: from there it is not far.
                (point, distance, slopes) = (beside, there - body.thickness, direction);
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
        let mut direction = slopes.map(|slope| slope / size);
        if let Some(side) = side {
            let of_side = dot(side, side).sqrt();
            // If that leads along the surface or inwards, it may come out anywhere.
            if distance < 0.0 && dot(side, slopes) > STRAIGHT_OUT * of_side * size {
                direction = side.map(|slope| slope / of_side);
            }
        }
        let step = (target - distance) / dot(direction, slopes).max(STRAIGHT_OUT);
        let more = body.out(direction, step);
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
