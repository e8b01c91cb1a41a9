//! Optional data of groom files beside the points: read from curves, written to files.

use std::ffi::c_char;
use std::mem::size_of;

use super::curves::{curves_from, path_from, shx_curves};
use crate::capi::base::buffers::{OutputList, OutputValue, POINT_FORMATS, Reader, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::{MAX_COUNT, shx_input};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::capi::simulation::solver_def::check_reserved;
use crate::error::{Error, Result, check_finite};
use crate::files::curves::{Curves, CurvesFormat, Extras, UpAxis};
use crate::files::strands::tfx::{self, TfxVersion};

/// Thickness (diameter), one float per point, file units.
pub const SHX_CURVE_ATTRIBUTE_THICKNESS: u32 = 1;
/// Transparency, one float per point, 0 to 1.
pub const SHX_CURVE_ATTRIBUTE_TRANSPARENCY: u32 = 2;
/// Colour, three floats per point, 0 to 1.
pub const SHX_CURVE_ATTRIBUTE_COLOR: u32 = 3;
/// Velocity, three floats per point, file units per second.
pub const SHX_CURVE_ATTRIBUTE_VELOCITY: u32 = 4;
/// Whether a point is pinned, one float per point, 0 or 1.
pub const SHX_CURVE_ATTRIBUTE_PINNED: u32 = 5;
/// Thickness factor, one float per strand.
pub const SHX_CURVE_ATTRIBUTE_STRAND_THICKNESS: u32 = 6;
/// Texture coordinates of the root, two floats per strand.
pub const SHX_CURVE_ATTRIBUTE_STRAND_UV: u32 = 7;
/// Arclength from the root, one float per point, file units. Only if the file has splines, which are longer
/// than the polylines through their points. For shx_fit_input.arclengths convert it to metres and doubles.
pub const SHX_CURVE_ATTRIBUTE_ARCLENGTH: u32 = 8;

/// The file does not define an up axis.
pub const SHX_UP_AXIS_UNKNOWN: u32 = 0;
/// The y axis points up.
pub const SHX_UP_AXIS_Y: u32 = 1;
/// The z axis points up.
pub const SHX_UP_AXIS_Z: u32 = 2;

/// Curves to write to a file. Fill it with shx_curve_data_init, then set at least
/// points, point_counts and strand_count. Attributes whose array is null are not
/// written. The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_curve_data {
    /// Set by shx_curve_data_init.
    pub struct_size: u32,
    /// SHX_UP_AXIS_, for formats that store it (.usda). Default SHX_UP_AXIS_UNKNOWN.
    pub up_axis: u32,
    /// Number of strands.
    pub strand_count: usize,
    /// Number of points of each strand: strand_count numbers, each 2 or more, that sum to points.count.
    pub point_counts: *const u32,
    /// Points of all strands, strand by strand, root first, file units: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4
    /// (rounded to floats; a fourth number is ignored).
    pub points: shx_input,
    /// Velocity of each point, file units per second; formats as points. count 0 (default): none.
    pub velocities: shx_input,
    /// Null, or a diameter per point, file units.
    pub thickness: *const f32,
    /// Null, or a number per point, 0 to 1.
    pub transparency: *const f32,
    /// Null, or three numbers per point, 0 to 1.
    pub colors: *const f32,
    /// Null, or a byte per point: non-zero if it is pinned.
    pub pinned: *const u8,
    /// Null, or a factor per strand.
    pub strand_thickness: *const f32,
    /// Null, or two numbers per strand.
    pub strand_uvs: *const f32,
    /// Metres per file unit, for formats that store it (.usda). 0 (default): unknown.
    pub metres_per_unit: f64,
    /// Version of a .tfx file: 2, 3 or 4. 0 (default): 4, or 2 if strands differ in their number of points.
    pub tfx_version: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Must be 0.
    pub reserved: [u64; 4],
}

const NO_INPUT: shx_input = shx_input { data: std::ptr::null(), stride: 0, count: 0, format: 0, reserved: 0 };

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_curve_data {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            up_axis: SHX_UP_AXIS_UNKNOWN,
            strand_count: 0,
            point_counts: std::ptr::null(),
            points: NO_INPUT,
            velocities: NO_INPUT,
            thickness: std::ptr::null(),
            transparency: std::ptr::null(),
            colors: std::ptr::null(),
            pinned: std::ptr::null(),
            strand_thickness: std::ptr::null(),
            strand_uvs: std::ptr::null(),
            metres_per_unit: 0.0,
            tfx_version: 0,
            reserved0: 0,
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_curve_data>() == 184 && std::mem::offset_of!(shx_curve_data, points) == 24);
    assert!(std::mem::offset_of!(shx_curve_data, thickness) == 88 && std::mem::offset_of!(shx_curve_data, tfx_version) == 144);
};

/// Fills *data with defaults. size is sizeof(shx_curve_data).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_data_init(data: *mut shx_curve_data, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that data holds size bytes.
    unsafe { initialise("shx_curve_data_init", "data", data, size) }
}

/// Vectors as floats, checked to be finite.
pub(super) fn narrowed(argument: &str, reader: &Reader) -> Result<Vec<[f32; 3]>> {
    let mut vectors = Vec::with_capacity(reader.count());
    for index in 0..reader.count() {
        let vector = reader.point(index).map(|number| number as f32);
        for number in vector {
            check_finite(|| format!("{argument}[{index}]"), f64::from(number))?;
        }
        vectors.push(vector);
    }
    Ok(vectors)
}

/// The caller's curves, copied and checked.
///
/// # Safety
/// `data` is null or points to a structure of the size that it states, and all that it points to is there.
pub(super) unsafe fn read_data(data: *const shx_curve_data) -> Result<(Curves, Option<TfxVersion>)> {
    // SAFETY: as the caller guarantees, here and below.
    let data = unsafe { read_versioned("data", data)? };
    if data.reserved0 != 0 {
        return Err(Error::invalid("data.reserved0", data.reserved0, "0"));
    }
    check_reserved("data", &data.reserved)?;
    let up = match data.up_axis {
        SHX_UP_AXIS_UNKNOWN => None,
        SHX_UP_AXIS_Y => Some(UpAxis::Y),
        SHX_UP_AXIS_Z => Some(UpAxis::Z),
        other => return Err(Error::invalid("data.up_axis", other, "one of SHX_UP_AXIS_")),
    };
    let version = match data.tfx_version {
        0 => None,
        2 => Some(TfxVersion::V2),
        3 => Some(TfxVersion::V3),
        4 => Some(TfxVersion::V4),
        other => return Err(Error::invalid("data.tfx_version", other, "0, 2, 3 or 4")),
    };
    // SAFETY: the same.
    let (counts, points) = unsafe {
        (
            array("data.point_counts", "data.strand_count", data.point_counts, data.strand_count)?,
            Reader::new("data.points", &raw const data.points, POINT_FORMATS)?,
        )
    };
    let total = counts.iter().try_fold(0_usize, |sum, count| sum.checked_add(*count as usize));
    if total.is_none_or(|total| total > MAX_COUNT || total != points.count()) {
        return Err(Error::invalid("data.points.count", points.count(), "the sum of data.point_counts"));
    }
    let points = narrowed("data.points", &points)?;
    let velocities = if data.velocities.count == 0 && data.velocities.data.is_null() {
        None
    } else {
        // SAFETY: the same.
        Some(narrowed("data.velocities", &unsafe { Reader::new("data.velocities", &raw const data.velocities, POINT_FORMATS)? })?)
    };
    let (strand_count, point_count) = (counts.len(), points.len());
    /// # Safety
    /// `data` is null or points to `count` items.
    unsafe fn optional<T: Copy>(argument: &str, data: *const T, count: usize) -> Result<Option<Vec<T>>> {
        // SAFETY: as the caller guarantees.
        if data.is_null() { Ok(None) } else { Ok(Some(unsafe { array(argument, "data.strand_count", data, count)? }.to_vec())) }
    }
    // SAFETY: the same.
    let extras = unsafe {
        Extras {
            thickness: optional("data.thickness", data.thickness, point_count)?,
            transparency: optional("data.transparency", data.transparency, point_count)?,
            colors: optional("data.colors", data.colors.cast::<[f32; 3]>(), point_count)?,
            velocities,
            arclengths: None,
            held: optional("data.pinned", data.pinned, point_count)?.map(|held| held.iter().map(|held| *held != 0).collect()),
            strand_thickness: optional("data.strand_thickness", data.strand_thickness, strand_count)?,
            strand_uvs: optional("data.strand_uvs", data.strand_uvs.cast::<[f32; 2]>(), strand_count)?,
            hair_header: None,
            metres_per_unit: (data.metres_per_unit != 0.0).then_some(data.metres_per_unit),
            up,
        }
    };
    let in_words = |error: Error| match error {
        Error::InvalidArgument { argument, value, expected } => {
            let field = argument.strip_prefix("extras.").unwrap_or(&argument);
            let field = field.strip_prefix("counts").map_or_else(|| field.to_owned(), |rest| format!("point_counts{rest}"));
            let field = field.replace("held", "pinned");
            Error::invalid(format!("data.{field}"), value, expected)
        }
        other => other,
    };
    let curves = Curves::from_counts(counts.to_vec(), points).and_then(|curves| curves.with_extras(extras)).map_err(in_words)?;
    Ok((curves, version))
}

/// Writes curves to a file: .hair (Cem Yuksel), .tfx (TressFX), .obj (Wavefront lines)
/// or .usda (USD text), by the ending of its name. Attributes that the format cannot
/// store are omitted: see the table in docs/reference/files.md.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_data_write(path: *const c_char, data: *const shx_curve_data) -> shx_result {
    call("shx_curve_data_write", || {
        // SAFETY: the caller's text, structure and what it points to.
        let (path, (curves, version)) = unsafe { (path_from(path)?, read_data(data)?) };
        match (CurvesFormat::of_name(path), version) {
            (Some(CurvesFormat::TfxV4), Some(version)) => tfx::write(path, &curves, version),
            _ => curves.write(path),
        }
    })
}

/// Writes an attribute of curves (SHX_CURVE_ATTRIBUTE_) to out_values, which holds capacity
/// floats, and its number of floats to *out_count: 0 if the file does not have it. With null
/// out_values and capacity 0 it only returns the number.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (attribute), SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_attribute(
    curves: *const shx_curves,
    attribute: u32,
    out_values: *mut f32,
    capacity: usize,
    out_count: *mut usize,
) -> shx_result {
    call("shx_curves_attribute", || {
        // SAFETY: the caller's handle, and places for one number and for capacity floats.
        let (curves, count, numbers) = unsafe {
            let numbers = if out_values.is_null() && capacity == 0 {
                None
            } else {
                Some(OutputList::new("out_values", "capacity", out_values, capacity)?)
            };
            (curves_from(curves)?, OutputValue::new("out_count", out_count)?, numbers)
        };
        let extras = curves.extras();
        let list: Vec<f32> = match attribute {
            SHX_CURVE_ATTRIBUTE_THICKNESS => extras.thickness.clone().unwrap_or_default(),
            SHX_CURVE_ATTRIBUTE_TRANSPARENCY => extras.transparency.clone().unwrap_or_default(),
            SHX_CURVE_ATTRIBUTE_COLOR => extras.colors.iter().flatten().flatten().copied().collect(),
            SHX_CURVE_ATTRIBUTE_VELOCITY => extras.velocities.iter().flatten().flatten().copied().collect(),
            SHX_CURVE_ATTRIBUTE_PINNED => extras.held.iter().flatten().map(|held| f32::from(u8::from(*held))).collect(),
            SHX_CURVE_ATTRIBUTE_STRAND_THICKNESS => extras.strand_thickness.clone().unwrap_or_default(),
            SHX_CURVE_ATTRIBUTE_ARCLENGTH => extras.arclengths.clone().unwrap_or_default(),
            SHX_CURVE_ATTRIBUTE_STRAND_UV => extras.strand_uvs.iter().flatten().flatten().copied().collect(),
            other => return Err(Error::invalid("attribute", other, "one of SHX_CURVE_ATTRIBUTE_")),
        };
        if let Some(numbers) = numbers {
            numbers.write(&list)?;
        }
        count.write(list.len());
        Ok(())
    })
}

/// Returns the metres per file unit (0 if the file does not define them) and the up axis (SHX_UP_AXIS_).
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_units(
    curves: *const shx_curves,
    out_metres_per_unit: *mut f64,
    out_up_axis: *mut u32,
) -> shx_result {
    call("shx_curves_units", || {
        // SAFETY: the caller's handle and places for a number each.
        let (curves, metres, up) = unsafe {
            (
                curves_from(curves)?,
                OutputValue::new("out_metres_per_unit", out_metres_per_unit)?,
                OutputValue::new("out_up_axis", out_up_axis)?,
            )
        };
        metres.write(curves.extras().metres_per_unit.unwrap_or(0.0));
        up.write(match curves.extras().up {
            None => SHX_UP_AXIS_UNKNOWN,
            Some(UpAxis::Y) => SHX_UP_AXIS_Y,
            Some(UpAxis::Z) => SHX_UP_AXIS_Z,
        });
        Ok(())
    })
}
