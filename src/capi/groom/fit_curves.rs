//! Fits strands to many curves at once.

use std::ffi::c_void;
use std::mem::{offset_of, size_of};

use nalgebra::{UnitQuaternion, Vector3};

use crate::capi::base::buffers::{FRAME_FORMATS, OutputList, POINT_FORMATS, Reader, Strided, array};
use crate::capi::base::errors::{SHX_OK, code, shx_result};
use crate::capi::base::guard::call;
use crate::capi::base::parallel::{shx_parallel_for_fn, workers};
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::types::{SHX_FORMAT_F32X3, SHX_FORMAT_F64X3, shx_frame, shx_input};
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::capi::hair::strand_def::shx_strand_def;
use crate::capi::simulation::solver_def::{check_flag, check_reserved};
use crate::error::{Error, Result, check_finite};
use crate::groom::fit::bulk::fit_each;
use crate::groom::fit::{ElementLengths, Fit, FitCurve, FitOptions, FitRoot, FitScratch, fit_curve};
use crate::rod::definition::MAX_ELEMENTS;
use crate::workers::Workers;

/// All elements of a strand have the same length.
pub const SHX_FIT_LENGTHS_EQUAL: u32 = 1;
/// Equal lengths where they fit well, otherwise free ones. The default.
pub const SHX_FIT_LENGTHS_AUTO: u32 = 2;
/// Free lengths: half the error. Strands step as fast; sampling
/// vectorises across strands with equal elements only.
pub const SHX_FIT_LENGTHS_FREE: u32 = 3;

/// Options of fitting. Fill it with shx_fit_options_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_fit_options {
    /// Set by shx_fit_options_init.
    pub struct_size: u32,
    /// Number of helical elements per strand, 1 to 100000; with a tolerance, the maximum. Default 10.
    pub element_count: u32,
    /// Above 0: use the smallest number of elements for which no point is farther than this from the strand at
    /// equal arclength, m. If element_count elements do not suffice, the strand has that many and its
    /// max_error exceeds the tolerance. 0 (default): none.
    pub tolerance: f64,
    /// SHX_FIT_LENGTHS_. Default SHX_FIT_LENGTHS_AUTO.
    pub length_mode: u32,
    /// 1 (default): elements may twist where that brings the centreline closer. 0: no twist; material frames are
    /// parallel-transported, and elements are circular arcs.
    pub twist: u32,
    /// Minimum length of an element relative to equal lengths, 0.05 to 1. Default 0.3.
    pub min_length_ratio: f64,
    /// A fit is good enough, and no other start is tried, once its RMS distance is below
    /// this fraction of the length; 0 to 1. Default 1e-3.
    pub target_rms_error: f64,
    /// If the largest distance exceeds this fraction of the length, it is reduced below it, or as far as
    /// possible, at the expense of the RMS distance; 0 to 1. Default 0.01; 1: never. A tolerance replaces it.
    pub target_max_error: f64,
    /// Expected error of the points, m; 0 or above. The length of a curve that zigzags
    /// by less is measured along its middle. Default 0.
    pub noise: f64,
    /// For curves with frames: the distance, as a fraction of the length of the curve, that counts as much as
    /// one radian between the frames; 0 or above. Default 3e-3.
    pub frame_weight: f64,
    /// Maximum number of initial guesses, 1 to 8. Default 4.
    pub max_starts: u32,
    /// Number of threads. 0 or 1 (default): the calling thread. 2 to 256: a pool for this call only.
    /// Results are identical to the bit for any number.
    pub worker_count: u32,
    /// Your parallel loop instead. Default null: none.
    pub parallel_for: shx_parallel_for_fn,
    /// User pointer of parallel_for.
    pub parallel_for_user: *mut c_void,
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles, a pointer and an optional function only.
unsafe impl Versioned for shx_fit_options {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let options = FitOptions::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            element_count: options.element_count as u32,
            tolerance: 0.0,
            length_mode: SHX_FIT_LENGTHS_AUTO,
            twist: u32::from(options.twist),
            min_length_ratio: options.least_length,
            target_rms_error: options.good,
            target_max_error: options.good_largest,
            noise: options.noise,
            frame_weight: options.frame_weight,
            max_starts: options.starts as u32,
            worker_count: 0,
            parallel_for: None,
            parallel_for_user: std::ptr::null_mut(),
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_fit_options>() == 120 && offset_of!(shx_fit_options, min_length_ratio) == 24);
    assert!(offset_of!(shx_fit_options, max_starts) == 64 && offset_of!(shx_fit_options, reserved) == 88);
};

impl shx_fit_options {
    fn options(&self) -> Result<(FitOptions, Workers)> {
        let lengths = match self.length_mode {
            SHX_FIT_LENGTHS_EQUAL => ElementLengths::Equal,
            SHX_FIT_LENGTHS_AUTO => ElementLengths::WhereNeeded,
            SHX_FIT_LENGTHS_FREE => ElementLengths::Free,
            other => return Err(Error::invalid("options.length_mode", other, "one of SHX_FIT_LENGTHS_")),
        };
        check_finite(|| "options.tolerance".into(), self.tolerance)?;
        if self.tolerance < 0.0 {
            return Err(Error::invalid("options.tolerance", self.tolerance, "0 (none) or above"));
        }
        let workers = workers("options", self.worker_count, self.parallel_for, self.parallel_for_user)?;
        check_reserved("options", &self.reserved)?;
        let options = FitOptions {
            element_count: self.element_count as usize,
            tolerance: (self.tolerance > 0.0).then_some(self.tolerance),
            lengths,
            least_length: self.min_length_ratio,
            twist: check_flag("options.twist", self.twist)?,
            starts: self.max_starts as usize,
            good: self.target_rms_error,
            good_largest: self.target_max_error,
            noise: self.noise,
            frame_weight: self.frame_weight,
        };
        options.check("options.").map_err(in_words_of_c)?;
        Ok((options, workers))
    }
}

/// The engine's error, with the names of the C structure.
fn in_words_of_c(error: Error) -> Error {
    error.with_fields(&[
        ("least_length", "min_length_ratio"),
        ("good", "target_rms_error"),
        ("good_largest", "target_max_error"),
        ("starts", "max_starts"),
    ])
}

/// Fills *options with defaults. size is sizeof(shx_fit_options).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_fit_options_init(options: *mut shx_fit_options, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that options holds size bytes.
    unsafe { initialise("shx_fit_options_init", "options", options, size) }
}

/// Curves to fit strands to. Fill it with shx_fit_input_init, then set at least points, point_counts and
/// curve_count. The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_fit_input {
    /// Set by shx_fit_input_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Number of curves. Default 0: set it.
    pub curve_count: usize,
    /// Points of all curves, curve by curve, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth
    /// number is ignored). Repeated points are skipped.
    pub points: shx_input,
    /// Number of points of each curve: curve_count numbers that sum to points.count.
    pub point_counts: *const u32,
    /// Arclength of each point, m, ascending from 0 at each
    /// root. Null (default): the sum of the segment lengths.
    pub arclengths: *const f64,
    /// Width of the hair at each point, m; 0 or above. Null (default): none.
    pub widths: *const f64,
    /// Material frame at each point (SHX_FORMAT_FRAME, of which only the rotation matters,
    /// or _F32X4, _F64X4: quaternions x, y, z, w). n1 of the strands follows their y axes
    /// as closely as possible. count 0 (default): none.
    pub frames: shx_input,
    /// Root frame of each curve (formats as frames), or the direction in which its strand leaves
    /// (SHX_FORMAT_F32X3, _F64X3; any length above zero). count 0 (default): taken from the curve.
    pub roots: shx_input,
    /// Must be 0.
    pub reserved: [u64; 4],
}

const NO_INPUT: shx_input = shx_input { data: std::ptr::null(), stride: 0, count: 0, format: 0, reserved: 0 };

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and pointers only.
unsafe impl Versioned for shx_fit_input {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            curve_count: 0,
            points: NO_INPUT,
            point_counts: std::ptr::null(),
            arclengths: std::ptr::null(),
            widths: std::ptr::null(),
            frames: NO_INPUT,
            roots: NO_INPUT,
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_fit_input>() == 168 && offset_of!(shx_fit_input, points) == 16);
    assert!(offset_of!(shx_fit_input, point_counts) == 48 && offset_of!(shx_fit_input, frames) == 72);
    assert!(offset_of!(shx_fit_input, reserved) == 136);
};

/// Fills *curves with defaults. size is sizeof(shx_fit_input).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_fit_input_init(curves: *mut shx_fit_input, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that curves holds size bytes.
    unsafe { initialise("shx_fit_input_init", "curves", curves, size) }
}

/// A strand fitted to a curve, apart from its element lengths and curvatures.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_fitted_strand {
    /// SHX_OK, or why the curve could not be fitted (SHX_ERROR_INVALID_ARGUMENT: no length, values that are not
    /// finite, and so on); the other fields are then 0.
    pub result: shx_result,
    /// Number of elements of the strand.
    pub element_count: u32,
    /// Root frame, at the first point of the curve.
    pub root: shx_frame,
    /// Length, m.
    pub length: f64,
    /// RMS distance between the points of the curve and the strand at equal arclength, m.
    pub rms_error: f64,
    /// Largest such distance, m.
    pub max_error: f64,
    /// Largest distance of a point of the curve from the closest point of the strand, m.
    pub max_distance: f64,
    /// RMS angle between n1 and the frames of the curve, rad; 0 without frames.
    pub frame_error: f64,
    /// Half the mean width, m; 0 without widths.
    pub radius: f64,
}

const _: () = assert!(size_of::<shx_fitted_strand>() == 112 && offset_of!(shx_fitted_strand, length) == 64);

impl shx_fitted_strand {
    fn of(fit: &Result<Fit>) -> Self {
        match fit {
            Ok(fit) => Self {
                result: SHX_OK,
                element_count: fit.curvatures.len() as u32,
                root: (&fit.root).into(),
                length: fit.element_lengths.iter().sum(),
                rms_error: fit.rms_error,
                max_error: fit.max_error,
                max_distance: fit.max_distance,
                frame_error: fit.frame_error,
                radius: fit.radius.unwrap_or(0.0),
            },
            Err(error) => Self {
                result: code(error),
                element_count: 0,
                root: shx_frame { origin: [0.0; 3], rotation: [0.0; 4] },
                length: 0.0,
                rms_error: 0.0,
                max_error: 0.0,
                max_distance: 0.0,
                frame_error: 0.0,
                radius: 0.0,
            },
        }
    }
}

/// The caller's curves, copied.
struct Owned {
    points: Vec<Vector3<f64>>,
    ends: Vec<usize>,
    arclengths: Option<Vec<f64>>,
    widths: Option<Vec<f64>>,
    frames: Option<Vec<UnitQuaternion<f64>>>,
    roots: Option<Vec<FitRoot>>,
}

impl Owned {
    /// # Safety
    /// All that the structure points to is there.
    unsafe fn read(curves: &shx_fit_input) -> Result<Self> {
        if curves.reserved0 != 0 {
            return Err(Error::invalid("curves.reserved0", curves.reserved0, "0"));
        }
        check_reserved("curves", &curves.reserved)?;
        // SAFETY: as the caller guarantees.
        unsafe {
            let counts = array("curves.point_counts", "curves.curve_count", curves.point_counts, curves.curve_count)?;
            let points = Reader::new("curves.points", &raw const curves.points, POINT_FORMATS)?;
            let mut ends = Vec::with_capacity(counts.len() + 1);
            ends.push(0_usize);
            for count in counts {
                ends.push(ends[ends.len() - 1].saturating_add(*count as usize));
            }
            let total = ends[ends.len() - 1];
            if total != points.count() {
                return Err(Error::invalid("curves.points.count", points.count(), format!("{total}, the sum of point_counts")));
            }
            let numbers = |argument: &str, data: *const f64| -> Result<Option<Vec<f64>>> {
                if data.is_null() { Ok(None) } else { Ok(Some(array(argument, "curves.points.count", data, total)?.to_vec())) }
            };
            Ok(Self {
                arclengths: numbers("curves.arclengths", curves.arclengths)?,
                widths: numbers("curves.widths", curves.widths)?,
                frames: rotations("curves.frames", &curves.frames, total)?,
                roots: roots(&curves.roots, counts.len())?,
                points: (0..total).map(|index| points.point(index).into()).collect(),
                ends,
            })
        }
    }

    fn curve(&self, index: usize) -> FitCurve<'_> {
        let range = self.ends[index]..self.ends[index + 1];
        FitCurve {
            points: &self.points[range.clone()],
            arclengths: self.arclengths.as_ref().map(|list| &list[range.clone()]),
            frames: self.frames.as_ref().map(|list| &list[range.clone()]),
            widths: self.widths.as_ref().map(|list| &list[range.clone()]),
            root: self.roots.as_ref().map_or(FitRoot::Curve, |roots| roots[index]),
        }
    }
}

/// Rotations, if there are any.
///
/// # Safety
/// The input's memory is there.
unsafe fn rotations(argument: &str, input: &shx_input, needed: usize) -> Result<Option<Vec<UnitQuaternion<f64>>>> {
    if input.count == 0 && input.data.is_null() {
        return Ok(None);
    }
    // SAFETY: the same.
    let reader = unsafe { Reader::new(argument, input, FRAME_FORMATS)? };
    if reader.count() != needed {
        return Err(Error::invalid(format!("{argument}.count"), reader.count(), format!("0 or {needed}")));
    }
    (0..needed).map(|index| reader.rotation(argument, index)).collect::<Result<_>>().map(Some)
}

/// Root frames or directions, if there are any.
///
/// # Safety
/// The input's memory is there.
unsafe fn roots(input: &shx_input, needed: usize) -> Result<Option<Vec<FitRoot>>> {
    let argument = "curves.roots";
    if !matches!(input.format, SHX_FORMAT_F32X3 | SHX_FORMAT_F64X3) {
        // SAFETY: the same.
        let frames = unsafe { rotations(argument, input, needed)? };
        return Ok(frames.map(|frames| frames.into_iter().map(FitRoot::Frame).collect()));
    }
    // SAFETY: the same.
    let reader = unsafe { Reader::new(argument, input, &[SHX_FORMAT_F32X3, SHX_FORMAT_F64X3])? };
    if reader.count() != needed {
        return Err(Error::invalid(format!("{argument}.count"), reader.count(), format!("0 or {needed}")));
    }
    Ok(Some((0..needed).map(|index| FitRoot::Direction(reader.point(index).into())).collect()))
}

/// Fits a strand to each of many curves, on the threads that options ask for (null: defaults). Item i
/// of out_strands (stride bytes apart, 0: tightly packed) is the result for curve i; a curve that
/// cannot be fitted does not affect the others. The rows of curve i start at i *
/// options.element_count, in out_element_lengths (m) as in out_curvatures (rad/m, rows of three
/// doubles); unused rows are 0. Both hold capacity elements: at least curve_count *
/// options.element_count. shx_strand_def_set_fit puts a fitted strand into a definition.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
/// SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_UNSUPPORTED (threads that could not be started).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_fit_strands(
    options: *const shx_fit_options,
    curves: *const shx_fit_input,
    out_strands: *mut shx_fitted_strand,
    stride: usize,
    out_element_lengths: *mut f64,
    out_curvatures: *mut f64,
    capacity: usize,
) -> shx_result {
    let body = || {
        let options = if options.is_null() {
            shx_fit_options::defaults()
        } else {
            // SAFETY: the caller's structure, of the size that it states.
            unsafe { read_versioned("options", options)? }
        };
        let (options, workers) = options.options()?;
        // SAFETY: the caller's structure and what it points to.
        let owned = unsafe { Owned::read(&read_versioned("curves", curves)?)? };
        let count = owned.ends.len() - 1;
        // SAFETY: the caller's memory for count items and capacity elements.
        let (fitted, lengths, rows) = unsafe {
            (
                Strided::new("out_strands", "curves.curve_count", out_strands, stride, count)?,
                OutputList::new("out_element_lengths", "capacity", out_element_lengths, capacity)?,
                OutputList::new("out_curvatures", "capacity", out_curvatures.cast::<[f64; 3]>(), capacity)?,
            )
        };
        let each = options.element_count;
        let needed = count.checked_mul(each).ok_or_else(|| Error::invalid("curves.curve_count", count, "fewer curves"))?;
        lengths.check_room(needed)?;
        let mut statuses = Vec::with_capacity(count);
        let (mut all_lengths, mut all_rows) = (vec![0.0; needed], vec![[0.0; 3]; needed]);
        let mut fit_all = || {
            let one = |index: usize, scratch: &mut FitScratch| fit_curve(&owned.curve(index), &options, scratch);
            fit_each(count, &options, &workers, one, |index, fit| {
                statuses.push(shx_fitted_strand::of(&fit));
                if let Ok(fit) = fit {
                    let first = index * each;
                    all_lengths[first..first + fit.element_lengths.len()].copy_from_slice(&fit.element_lengths);
                    all_rows[first..first + fit.curvatures.len()].copy_from_slice(&fit.curvatures);
                }
            })
        };
        if matches!(workers, Workers::Pool(_)) {
            // Spawning threads leaves thread-local destructors behind on the thread that does it.
            on_own_thread(fit_all)?;
        } else {
            fit_all()?;
        }
        lengths.write(&all_lengths)?;
        rows.write(&all_rows)?;
        fitted.write_all(statuses.into_iter())
    };
    call("shx_fit_strands", body)
}

/// Puts a fitted strand into a definition that shx_strand_def_init has filled: root, length, element_count,
/// element_lengths, natural_curvatures, and both semi-axes (radius) if the curve had widths. The other
/// fields stay. element_lengths (m) and curvatures (rad/m, rows of three doubles) are those of this strand:
/// for curve i of shx_fit_strands they start at i * options.element_count. The definition points to them,
/// so they must remain valid until you have used it.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the
/// curve could not be fitted: its result is not SHX_OK).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_strand_def_set_fit(
    def: *mut shx_strand_def,
    fitted: *const shx_fitted_strand,
    element_lengths: *const f64,
    curvatures: *const f64,
) -> shx_result {
    let body = || {
        // SAFETY: the caller's structures; a fitted strand, its lengths and its rows.
        let (mut filled, out, fitted) = unsafe {
            let fitted = &array("fitted", "fitted", fitted, 1)?[0];
            (read_versioned("def", def.cast_const())?, VersionedOutput::new("def", def)?, fitted)
        };
        if fitted.result != SHX_OK {
            return Err(Error::invalid("fitted.result", fitted.result, "SHX_OK, from a curve that could be fitted"));
        }
        let count = fitted.element_count as usize;
        if !(1..=MAX_ELEMENTS).contains(&count) {
            return Err(Error::invalid("fitted.element_count", count, format!("1 to {MAX_ELEMENTS}")));
        }
        // SAFETY: the caller's lengths and rows.
        unsafe {
            array("element_lengths", "fitted.element_count", element_lengths, count)?;
            array("curvatures", "fitted.element_count", curvatures.cast::<[f64; 3]>(), count)?;
        }
        (filled.root, filled.length, filled.element_count) = (fitted.root, fitted.length, fitted.element_count);
        (filled.element_lengths, filled.natural_curvatures) = (element_lengths, curvatures);
        if fitted.radius > 0.0 {
            filled.radius = [fitted.radius; 2];
        }
        out.write(&filled);
        Ok(())
    };
    call("shx_strand_def_set_fit", body)
}
