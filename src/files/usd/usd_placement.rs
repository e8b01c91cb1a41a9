//! The placement of a prim of a USD file in its parent: its `xformOp`s.

use nalgebra::{Matrix4, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::usda_scan::Scan;
use super::usda_values::{Attribute, flat, list};
use crate::error::{Error, Result};

/// The most operations of a prim: more are a mistake, and slow to search.
const MAX_OPERATIONS: usize = 256;

/// The operations of a prim, and their order.
#[derive(Debug, Default)]
pub(in crate::files) struct Placement {
    order: Attribute<Vec<Box<str>>>,
    operations: Vec<(Box<str>, Attribute<Vec<f64>>)>,
}

impl Placement {
    /// Reads an attribute whose name begins with `xformOp`.
    pub fn take(&mut self, scan: &mut Scan<'_>, name: &str, over_time: bool) -> Result<()> {
        if name == "xformOpOrder" {
            let name = |scan: &mut Scan<'_>| scan.string().map(Box::from);
            return self.order.read(scan, over_time, |scan| list(scan, "the name of an operation", name));
        }
        let index = match self.operations.iter().position(|(there, _)| **there == *name) {
            Some(index) => index,
            None if self.operations.len() == MAX_OPERATIONS => {
                return Err(scan.error(format_args!("more than {MAX_OPERATIONS} operations")));
            }
            None => {
                self.operations.push((name.into(), Attribute::default()));
                self.operations.len() - 1
            }
        };
        self.operations[index].1.read(scan, over_time, |scan| flat(scan, "an operation", 16))
    }

    /// Whether it changes over time.
    pub fn moves(&self) -> bool {
        self.operations.iter().any(|(_, operation)| operation.times().count() > 1)
    }

    /// The times of its samples.
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        self.operations.iter().flat_map(|(_, operation)| operation.times())
    }

    /// The matrix (columns) at a time, and whether it resets to the world.
    pub fn matrix(&self, time: f64, file: &str, path: &dyn Fn() -> String) -> Result<(Matrix4<f64>, bool)> {
        let mut matrix = Matrix4::identity();
        let mut anew = false;
        for entry in self.order.at(time).into_iter().flatten() {
            if **entry == *"!resetXformStack!" {
                (matrix, anew) = (Matrix4::identity(), true);
                continue;
            }
            let (name, inverse) = entry.strip_prefix("!invert!").map_or((&**entry, false), |name| (name, true));
            let bad = |what: String| Error::file(file, format_args!("{}: {name} {what}", path()));
            let operation = self.operations.iter().find(|(there, _)| **there == *name).map(|(_, operation)| operation);
            let Some(operation) = operation else { return Err(bad("is in xformOpOrder and has no value".to_owned())) };
            let step = match operation.between(time) {
                Some((before, after, fraction)) => between(name, before, after, fraction),
                None => operation.at(time).and_then(|values| one(name, values)),
            };
            let step = step.ok_or_else(|| bad("is not a known operation, or has the wrong number of values".to_owned()))?;
            let step = if inverse { step.try_inverse().ok_or_else(|| bad("cannot be inverted".to_owned()))? } else { step };
            matrix *= step;
        }
        if matrix.iter().all(|value: &f64| value.is_finite()) {
            Ok((matrix, anew))
        } else {
            Err(Error::file(file, format_args!("{}: its placement is not finite", path())))
        }
    }
}

/// The operation's type: `xformOp:rotateXYZ:pivot` is `rotateXYZ`.
fn kind(name: &str) -> &str {
    name.split(':').nth(1).unwrap_or_default()
}

/// An operation between two samples: numbers are interpolated linearly, quaternions along the shorter arc.
fn between(name: &str, before: &[f64], after: &[f64], fraction: f64) -> Option<Matrix4<f64>> {
    if before.len() != after.len() {
        return one(name, before);
    }
    if kind(name) == "orient" {
        let turn = quaternion(before)?.slerp(&quaternion(after)?, fraction);
        return Some(turn.to_homogeneous());
    }
    let values: Vec<f64> = before.iter().zip(after).map(|(before, after)| before + (after - before) * fraction).collect();
    one(name, &values)
}

/// In the order w, x, y, z.
fn quaternion(values: &[f64]) -> Option<UnitQuaternion<f64>> {
    let [w, x, y, z] = *values else { return None };
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12)
}

/// The matrix of an operation; `None` for an unknown name or a wrong number of values.
fn one(name: &str, values: &[f64]) -> Option<Matrix4<f64>> {
    let axis = |axis: char| match axis {
        'X' => Some(Vector3::x_axis()),
        'Y' => Some(Vector3::y_axis()),
        'Z' => Some(Vector3::z_axis()),
        _ => None,
    };
    match (kind(name), values) {
        ("translate", [x, y, z]) => Some(Matrix4::new_translation(&Vector3::new(*x, *y, *z))),
        ("scale", [x, y, z]) => Some(Matrix4::new_nonuniform_scaling(&Vector3::new(*x, *y, *z))),
        ("orient", values) => quaternion(values).map(|turn| turn.to_homogeneous()),
        // USD's rows are columns here.
        ("transform", values) if values.len() == 16 => Some(Matrix4::from_column_slice(values)),
        (rotate, values) => {
            let axes = rotate.strip_prefix("rotate")?;
            // Angles are about x, y and z whatever the order; the first axis turns first.
            let single = axes.len() == 1;
            if values.len() != if single { 1 } else { 3 } || !(single || axes.len() == 3) {
                return None;
            }
            axes.chars().try_fold(Matrix4::identity(), |matrix, name| {
                let angle =
                    if single { values[0] } else { values[(name as usize).checked_sub('X' as usize).filter(|at| *at < 3)?] };
                Some(Rotation3::from_axis_angle(&axis(name)?, angle.to_radians()).to_homogeneous() * matrix)
            })
        }
    }
}
