//! The bodies of styling tools, from a few numbers.
//!
//! A tool has one frame. Teeth, bristles and a finger point along its z axis and start at z = 0; rows of teeth run along x, and
//! rows of bristles follow each other along y. Plates lie across y on both sides of the origin, a barrel lies along x.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};

use crate::contact::body::BodyDef;
use crate::contact::shape::Shape;
use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::math::frame::Frame;

/// The most teeth in a row, and the most rows.
pub const MAX_TEETH: u32 = 1000;

/// A styling tool. Lengths in m, above zero.
///
/// ```
/// use superhelix::tools::Tool;
/// use superhelix::{Frame, Solver, SolverOptions};
///
/// let comb = Tool::Comb { teeth: 8, spacing: 3e-3, length: 25e-3, radius: 0.6e-3 };
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let bodies = solver.add_bodies(comb.bodies(&Frame::default(), 0.0)?)?;
/// assert_eq!(bodies.len(), comb.body_count());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tool {
    /// A row of capsules, one body per tooth.
    Comb {
        /// How many, 1 to [`MAX_TEETH`].
        teeth: u32,
        /// From axis to axis.
        spacing: f64,
        /// Of a tooth, its round end included.
        length: f64,
        /// Of a tooth.
        radius: f64,
    },
    /// Rows of capsules, one body per bristle.
    Brush {
        /// Bristles in a row, 1 to [`MAX_TEETH`].
        bristles: u32,
        /// Rows, 1 to [`MAX_TEETH`]; every other row is offset by half a spacing.
        rows: u32,
        /// From axis to axis in a row.
        spacing: f64,
        /// From row to row.
        row_spacing: f64,
        /// Of a bristle.
        length: f64,
        /// Of a bristle.
        radius: f64,
    },
    /// A capsule.
    Finger {
        /// From z = 0 to the fingertip.
        length: f64,
        /// Of the finger.
        radius: f64,
    },
    /// The two plates of a straightener, facing each other.
    Plates {
        /// Along x.
        width: f64,
        /// Along z, the direction in which hair passes.
        depth: f64,
        /// Of each plate.
        thickness: f64,
    },
    /// The barrel of a curling iron, a capsule along x.
    Barrel {
        /// Its round ends included.
        length: f64,
        /// Of the barrel.
        radius: f64,
    },
}

impl Tool {
    /// A pocket comb: twelve teeth of 30 mm, 2.5 mm apart, 1 mm thick.
    pub const COMB: Tool = Tool::Comb { teeth: 12, spacing: 2.5e-3, length: 30e-3, radius: 0.5e-3 };
    /// A brush of four rows of ten bristles of 15 mm.
    pub const BRUSH: Tool =
        Tool::Brush { bristles: 10, rows: 4, spacing: 4e-3, row_spacing: 5e-3, length: 15e-3, radius: 0.5e-3 };
    /// A finger of 70 mm, 16 mm thick.
    pub const FINGER: Tool = Tool::Finger { length: 70e-3, radius: 8e-3 };
    /// Plates of 90 by 25 mm.
    pub const PLATES: Tool = Tool::Plates { width: 90e-3, depth: 25e-3, thickness: 4e-3 };
    /// A barrel of 120 mm, 25 mm thick.
    pub const BARREL: Tool = Tool::Barrel { length: 120e-3, radius: 12.5e-3 };

    /// Checks every number; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        let lengths = |fields: &[(&str, f64)]| {
            fields.iter().try_for_each(|(name, value)| check_positive(|| format!("{argument}.{name}"), *value))
        };
        let count = |name: &str, value: u32| {
            let expected = || format!("1 to {MAX_TEETH}");
            if (1..=MAX_TEETH).contains(&value) {
                Ok(())
            } else {
                Err(Error::invalid(format!("{argument}.{name}"), value, expected()))
            }
        };
        let capsule = |length: f64, radius: f64, ends: f64| {
            if length > ends * radius {
                return Ok(());
            }
            let expected = format!("more than {} m, the rounding of its ends", ends * radius);
            Err(Error::invalid(format!("{argument}.length"), length, expected))
        };
        match *self {
            Tool::Comb { teeth, spacing, length, radius } => {
                count("tooth_count", teeth)?;
                lengths(&[("spacing", spacing), ("length", length), ("radius", radius)])?;
                capsule(length, radius, 1.0)
            }
            Tool::Brush { bristles, rows, spacing, row_spacing, length, radius } => {
                count("tooth_count", bristles)?;
                count("row_count", rows)?;
                lengths(&[("spacing", spacing), ("row_spacing", row_spacing), ("length", length), ("radius", radius)])?;
                capsule(length, radius, 1.0)
            }
            Tool::Finger { length, radius } => {
                lengths(&[("length", length), ("radius", radius)])?;
                capsule(length, radius, 1.0)
            }
            Tool::Plates { width, depth, thickness } => lengths(&[("width", width), ("length", depth), ("thickness", thickness)]),
            Tool::Barrel { length, radius } => {
                lengths(&[("length", length), ("radius", radius)])?;
                capsule(length, radius, 2.0)
            }
        }
    }

    /// The number of its bodies.
    pub fn body_count(&self) -> usize {
        match *self {
            Tool::Comb { teeth, .. } => teeth as usize,
            Tool::Brush { bristles, rows, .. } => bristles as usize * rows as usize,
            Tool::Finger { .. } | Tool::Barrel { .. } => 1,
            Tool::Plates { .. } => 2,
        }
    }

    /// The axes of its capsules, in the tool's frame, and their radius; none for plates. In the order of the bodies.
    pub fn axes(&self) -> (Vec<[Vector3<f64>; 2]>, f64) {
        let row = |count: u32, spacing: f64, aside: f64, y: f64, end: f64| {
            (0..count).map(move |k| {
                let x = (f64::from(k) - 0.5 * f64::from(count - 1)) * spacing + aside;
                [Vector3::new(x, y, 0.0), Vector3::new(x, y, end)]
            })
        };
        match *self {
            Tool::Comb { teeth, spacing, length, radius } => (row(teeth, spacing, 0.0, 0.0, length - radius).collect(), radius),
            Tool::Brush { bristles, rows, spacing, row_spacing, length, radius } => {
                let axes = (0..rows).flat_map(|r| {
                    let y = (f64::from(r) - 0.5 * f64::from(rows - 1)) * row_spacing;
                    let aside = if r % 2 == 0 { -0.25 } else { 0.25 };
                    let aside = if rows > 1 { aside * spacing } else { 0.0 };
                    row(bristles, spacing, aside, y, length - radius)
                });
                (axes.collect(), radius)
            }
            Tool::Finger { length, radius } => (row(1, 1.0, 0.0, 0.0, length - radius).collect(), radius),
            Tool::Barrel { length, radius } => {
                let end = Vector3::x() * (0.5 * length - radius);
                (vec![[-end, end]], radius)
            }
            Tool::Plates { .. } => (Vec::new(), 0.0),
        }
    }

    /// The poses of its bodies with the tool at `pose`. `opening`: the distance between the plates' faces, m, zero or above;
    /// other tools ignore it.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`opening`) for a number out of range.
    pub fn frames(&self, pose: &Frame, opening: f64) -> Result<Vec<Frame>> {
        check_not_negative(|| "opening".into(), opening)?;
        if let Tool::Plates { thickness, .. } = self {
            let side = |sign: f64| {
                let offset = Vector3::y() * (sign * 0.5 * (opening + thickness));
                Frame { origin: pose.origin + pose.rotation * offset, ..*pose }
            };
            return Ok(vec![side(-1.0), side(1.0)]);
        }
        Ok(vec![*pose; self.body_count()])
    }

    /// Its bodies, at `pose`; see [`Tool::frames`].
    ///
    /// # Errors
    /// As [`Tool::check`] with the argument `tool`, and [`Tool::frames`].
    pub fn bodies(&self, pose: &Frame, opening: f64) -> Result<Vec<BodyDef>> {
        self.check("tool")?;
        let frames = self.frames(pose, opening)?;
        let shapes: Vec<Shape> = match *self {
            Tool::Plates { width, depth, thickness } => {
                let half = 0.5 * Vector3::new(width, thickness, depth);
                vec![Shape::new_box(half)?, Shape::new_box(half)?]
            }
            _ => {
                let (axes, radius) = self.axes();
                axes.into_iter().map(|[a, b]| Shape::new_capsule(a, b, radius)).collect::<Result<_>>()?
            }
        };
        let body = |(shape, pose): (Shape, Frame)| BodyDef { pose, ..BodyDef::new(Arc::new(shape)) };
        Ok(shapes.into_iter().zip(frames).map(body).collect())
    }

    /// The box in which it heats hair, in its own frame: its middle and half its edges, m. Between plates and into them by half
    /// their thickness, so that it contains strands pressed by the faces; around a barrel, a quarter of its radius beyond. `None`
    /// for other tools.
    pub fn hot_box(&self, opening: f64) -> Option<(Frame, Vector3<f64>)> {
        let half = match *self {
            Tool::Plates { width, depth, thickness } => 0.5 * Vector3::new(width, opening + thickness, depth),
            Tool::Barrel { length, radius } => Vector3::new(0.5 * length, 1.25 * radius, 1.25 * radius),
            _ => return None,
        };
        Some((Frame { origin: Vector3::zeros(), rotation: UnitQuaternion::identity() }, half))
    }
}
