//! Definitions of strands.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use super::materials::{material_of, with_material};
use crate::capi::base::buffers::array;
use crate::capi::base::errors::shx_result;
use crate::capi::base::types::shx_frame;
use crate::capi::base::versioned::{Versioned, initialise};
use crate::capi::simulation::solver_def::check_reserved;
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::memory::{self, BLOCK};
use crate::rod::freedoms::Freedoms;
use crate::rod::material::Material;
use crate::solver::definition::{MAX_ELEMENTS, StrandDef};

/// The strand can twist.
pub const SHX_DOF_TWIST: u32 = 1;
/// The strand can bend about n1.
pub const SHX_DOF_BEND1: u32 = 2;
/// The strand can bend about n2.
pub const SHX_DOF_BEND2: u32 = 4;

/// Relative tolerance of the sum of element lengths against the length.
const LENGTH_TOLERANCE: f64 = 1e-9;

/// Definition of a strand. Fill it with shx_strand_def_init, then set at least element_count and length (or
/// element_lengths). The library reads the arrays during the call only. Curvature arrays have one row per
/// element, from root to tip: twist, curvature about n1, curvature about n2, rad/m.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_strand_def {
    /// Set by shx_strand_def_init.
    pub struct_size: u32,
    /// Number of helical elements, 1 to 100000. Default 0: set it.
    /// Five suit straight hair; coils need four per turn.
    pub element_count: u32,
    /// Length, m; above zero. With element_lengths: their sum, or 0.
    pub length: f64,
    /// element_count lengths from root to tip, m, each above zero. Null (default): all equal.
    pub element_lengths: *const f64,
    /// Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
    pub radius: [f64; 2],
    /// Density, kg/m^3; above zero. Default 1300.
    pub density: f64,
    /// Young's modulus, Pa; above zero. Default 2e9.
    pub youngs_modulus: f64,
    /// Poisson's ratio; above -1, at most 0.5. Default 0.48.
    pub poisson_ratio: f64,
    /// Internal friction gamma, kg m^3/s; zero or above. Default 0; hair has 5e-11 to 5e-10.
    pub internal_friction: f64,
    /// Kelvin-Voigt damping time mu, s; zero or above. Default 0.
    pub viscosity: f64,
    /// Air drag nu, kg/(m s); zero or above. Default 0; hair has 5e-6 (disciplined) to 5e-5 (fuzzy).
    pub air_drag: f64,
    /// Degrees of freedom: SHX_DOF_ bits. A curvature without its bit stays frozen at its
    /// natural value and costs nothing. Default: all three.
    pub dofs: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Frame of the follicle in world space; the strand leaves along n0. Default: at the origin, along x.
    pub root: shx_frame,
    /// Natural curvatures, element_count rows. Null (default): straight.
    pub natural_curvatures: *const f64,
    /// Your own number; the library does not use it. Default 0.
    pub user_data: u64,
    /// Initial curvatures, element_count rows. Null (default): the natural ones.
    /// Frozen curvatures must have their natural value.
    pub initial_curvatures: *const f64,
    /// Initial rates of the curvatures, rad/(m s), element_count rows. Null
    /// (default): 0. Rates of frozen curvatures must be 0.
    pub initial_rates: *const f64,
    /// Initial velocity of the root, m/s. The strand starts by moving rigidly with its root. Default 0.
    pub root_velocity: [f64; 3],
    /// Initial angular velocity of the root in world axes, rad/s. Default 0.
    pub root_angular_velocity: [f64; 3],
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_strand_def {
    const FIRST_SIZE: usize = offset_of!(shx_strand_def, initial_curvatures);

    fn defaults() -> Self {
        let root = Frame::default();
        with_material!(shx_strand_def, &Material::default(), {
            struct_size: size_of::<Self>() as u32,
            element_count: 0,
            length: 0.0,
            element_lengths: std::ptr::null(),
            dofs: Freedoms::ALL.bits(),
            reserved0: 0,
            root: (&root).into(),
            natural_curvatures: std::ptr::null(),
            user_data: 0,
            initial_curvatures: std::ptr::null(),
            initial_rates: std::ptr::null(),
            root_velocity: [0.0; 3],
            root_angular_velocity: [0.0; 3],
            reserved: [0; 4],
        })
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_strand_def>() == 264);
    assert!(offset_of!(shx_strand_def, radius) == 24 && offset_of!(shx_strand_def, dofs) == 88);
    assert!(offset_of!(shx_strand_def, root) == 96 && offset_of!(shx_strand_def, natural_curvatures) == 152);
    assert!(offset_of!(shx_strand_def, initial_curvatures) == 168 && offset_of!(shx_strand_def, root_velocity) == 184);
};

/// Reads a field. Its full name is made only for an error: for many definitions the names would cost more than all the rest.
fn named<T>(argument: &str, field: &str, take: impl Fn(&str) -> Result<T>) -> Result<T> {
    take(field).or_else(|_| take(&format!("{argument}.{field}")))
}

/// The engine's error, with the names of the C structure.
fn in_words_of_c(error: Error) -> Error {
    error.with_fields(&[("natural", "natural_curvatures"), ("initial", "initial_curvatures"), ("freedoms", "dofs")])
}

/// Rows of curvatures in the caller's memory; `None` for null.
///
/// # Safety
/// `rows` is null or points to `count` rows.
unsafe fn optional_rows(argument: &str, rows: *const f64, count: usize) -> Result<Option<Vec<[f64; 3]>>> {
    if rows.is_null() {
        return Ok(None);
    }
    // SAFETY: the same. A row is three doubles.
    unsafe { array(argument, argument, rows.cast::<[f64; 3]>(), count) }.and_then(|rows| memory::copied(rows).map(Some))
}

impl shx_strand_def {
    /// The engine's own definition, checked.
    ///
    /// # Safety
    /// The arrays that it points to hold what `element_count` says.
    pub(in crate::capi) unsafe fn definition(&self, argument: &str) -> Result<StrandDef> {
        let count = self.count(argument)?;
        if self.reserved0 != 0 {
            return Err(Error::invalid(format!("{argument}.reserved0"), self.reserved0, "0"));
        }
        check_reserved(argument, &self.reserved)?;
        let rows = |field: &str, rows: *const f64| {
            // SAFETY: the caller's rows.
            named(argument, field, |name| unsafe { optional_rows(name, rows, count) })
        };
        let natural = match rows("natural_curvatures", self.natural_curvatures)? {
            Some(rows) => rows,
            None => memory::repeated([0.0; 3], count)?,
        };
        let definition = StrandDef {
            // SAFETY: the caller's lengths.
            element_lengths: unsafe { self.element_lengths(argument, count)? },
            material: material_of!(self),
            freedoms: named(argument, "dofs", |name| Freedoms::from_bits(name, self.dofs))?,
            root: named(argument, "root", |name| self.root.checked(name))?,
            natural,
            initial: rows("initial_curvatures", self.initial_curvatures)?,
            initial_rates: rows("initial_rates", self.initial_rates)?,
            root_velocity: Vector3::from(self.root_velocity),
            root_angular_velocity: Vector3::from(self.root_angular_velocity),
            user_data: self.user_data,
        };
        definition.check(argument).map_err(in_words_of_c)?;
        Ok(definition)
    }

    fn count(&self, argument: &str) -> Result<usize> {
        let count = self.element_count as usize;
        if count == 0 || count > MAX_ELEMENTS {
            return Err(Error::invalid(format!("{argument}.element_count"), count, format!("1 to {MAX_ELEMENTS}")));
        }
        Ok(count)
    }

    /// An upper bound on the heap bytes of the engine's own definition.
    pub(super) fn bytes(&self, argument: &str) -> Result<usize> {
        let row = size_of::<f64>() + 3 * size_of::<[f64; 3]>();
        Ok(self.count(argument)? * row + 4 * BLOCK)
    }

    /// # Safety
    /// `element_lengths` is null or points to `count` lengths.
    unsafe fn element_lengths(&self, argument: &str, count: usize) -> Result<Vec<f64>> {
        if self.element_lengths.is_null() {
            if !(self.length.is_finite() && self.length > 0.0) {
                return Err(Error::invalid(format!("{argument}.length"), self.length, "a finite number above zero (m)"));
            }
            return memory::repeated(self.length / count as f64, count);
        }
        let lengths_argument = format!("{argument}.element_lengths");
        // SAFETY: the same.
        let lengths = memory::copied(unsafe { array(&lengths_argument, &lengths_argument, self.element_lengths, count)? })?;
        for (element, length) in lengths.iter().enumerate() {
            if !(length.is_finite() && *length > 0.0) {
                let expected = "a finite number above zero (m)";
                return Err(Error::invalid(format!("{lengths_argument}[{element}]"), length, expected));
            }
        }
        let sum: f64 = lengths.iter().sum();
        let agrees = (self.length - sum).abs() <= LENGTH_TOLERANCE * sum;
        if self.length != 0.0 && !agrees {
            return Err(Error::invalid(
                format!("{argument}.length"),
                self.length,
                format!("{sum}, the sum of the element lengths, or 0 to have it summed"),
            ));
        }
        Ok(lengths)
    }
}

/// Fills *def with defaults. size is sizeof(shx_strand_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_strand_def_init(def: *mut shx_strand_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_strand_def_init", "def", def, size) }
}
