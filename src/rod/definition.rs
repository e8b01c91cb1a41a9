//! The definition of a strand, as a host gives it.

use std::fmt;

use nalgebra::Vector3;

use super::freedoms::Freedoms;
use super::material::Material;
use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::frame::Frame;

/// The largest number of elements of one strand.
pub const MAX_ELEMENTS: usize = 100_000;

/// The definition of a strand. Curvature rows are (twist κ0, κ1, κ2) in rad/m, one per element.
///
/// ```
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Frame, Solver, SolverOptions, StrandDef};
///
/// // A curl: eight elements of 2.5 cm, each an arc of 60 rad/m.
/// let strand = StrandDef {
///     root: Frame { origin: Vector3::new(0.0, 0.0, 1.7), ..Frame::default() },
///     natural: vec![[0.0, 60.0, 0.0]; 8],
///     ..StrandDef::straight(0.2, 8)
/// };
/// assert!((strand.length() - 0.2).abs() < 1e-15);
/// let ids = Solver::new(SolverOptions::default())?.add_strands(&[strand])?;
/// assert_eq!(ids.len(), 1);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct StrandDef {
    /// Lengths of the helical elements from root to tip, m; at least one, each above zero.
    pub element_lengths: Vec<f64>,
    /// Section and material.
    pub material: Material,
    /// Which curvatures may change.
    pub freedoms: Freedoms,
    /// Pose of the follicle in the world: n0 (first axis) is where the strand leaves.
    pub root: Frame,
    /// Natural curvatures, one row per element.
    pub natural: Vec<[f64; 3]>,
    /// Initial curvatures, one row per element; `None` for the natural ones. Frozen freedoms must have their natural value.
    pub initial: Option<Vec<[f64; 3]>>,
    /// Initial rates of the curvatures, rad/(m·s), one row per element; `None` for rest. Frozen freedoms must have rate 0.
    pub initial_rates: Option<Vec<[f64; 3]>>,
    /// Velocity of the root's origin at the start, m/s; the strand starts by moving rigidly with its root.
    pub root_velocity: Vector3<f64>,
    /// Angular velocity of the root at the start, world axes, rad/s.
    pub root_angular_velocity: Vector3<f64>,
    /// The host's own number; the solver keeps it and never reads it.
    pub user_data: u64,
}

impl StrandDef {
    /// A straight strand of `element_count` equal elements with the default material and its root at the world's origin.
    pub fn straight(length: f64, element_count: usize) -> Self {
        Self {
            element_lengths: vec![length / element_count as f64; element_count],
            material: Material::default(),
            freedoms: Freedoms::ALL,
            root: Frame::default(),
            natural: vec![[0.0; 3]; element_count],
            initial: None,
            initial_rates: None,
            root_velocity: Vector3::zeros(),
            root_angular_velocity: Vector3::zeros(),
            user_data: 0,
        }
    }

    /// The strand's length, m.
    pub fn length(&self) -> f64 {
        self.element_lengths.iter().sum()
    }

    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        let count = self.element_lengths.len();
        if count == 0 || count > MAX_ELEMENTS {
            return Err(Error::invalid(format!("{argument}.element_count"), count, format!("1 to {MAX_ELEMENTS}")));
        }
        check_lengths(format_args!("{argument}.element_lengths"), &self.element_lengths)?;
        check_positive(|| format!("{argument}.length"), self.length())?;
        self.material.check(argument)?;
        check_rows(format_args!("{argument}.natural"), &self.natural, count)?;
        if let Some(initial) = &self.initial {
            check_rows(format_args!("{argument}.initial"), initial, count)?;
            check_frozen(format_args!("{argument}.initial"), initial, &self.natural, self.freedoms)?;
        }
        if let Some(rates) = &self.initial_rates {
            check_rows(format_args!("{argument}.initial_rates"), rates, count)?;
            check_frozen(format_args!("{argument}.initial_rates"), rates, &vec![[0.0; 3]; count], self.freedoms)?;
        }
        for axis in 0..3 {
            check_finite(|| format!("{argument}.root_velocity[{axis}]"), self.root_velocity[axis])?;
            check_finite(|| format!("{argument}.root_angular_velocity[{axis}]"), self.root_angular_velocity[axis])?;
        }
        Ok(())
    }
}

/// Checks a list of element lengths.
pub(crate) fn check_lengths(argument: impl fmt::Display, lengths: &[f64]) -> Result<()> {
    lengths.iter().enumerate().try_for_each(|(element, length)| check_positive(|| format!("{argument}[{element}]"), *length))
}

/// Checks the count and the numbers of a list of curvature rows.
pub(crate) fn check_rows(argument: impl fmt::Display, rows: &[[f64; 3]], count: usize) -> Result<()> {
    if rows.len() != count {
        return Err(Error::invalid(format!("{argument} (count)"), rows.len(), format!("{count} rows, one per element")));
    }
    for (element, row) in rows.iter().enumerate() {
        for axis in 0..3 {
            check_finite(|| format!("{argument}[{element}][{axis}]"), row[axis])?;
        }
    }
    Ok(())
}

/// Checks that frozen freedoms have the value at which they are frozen.
pub(crate) fn check_frozen(
    argument: impl fmt::Display,
    rows: &[[f64; 3]],
    frozen_at: &[[f64; 3]],
    freedoms: Freedoms,
) -> Result<()> {
    for (element, (row, frozen)) in rows.iter().zip(frozen_at).enumerate() {
        for axis in 0..3 {
            if !freedoms.contains(axis) && row[axis] != frozen[axis] {
                return Err(Error::invalid(
                    format!("{argument}[{element}][{axis}]"),
                    row[axis],
                    format!("{}, since this freedom is frozen", frozen[axis]),
                ));
            }
        }
    }
    Ok(())
}
