//! Strands from many curves at once.

use std::ffi::c_void;
use std::mem::{offset_of, size_of};

use nalgebra::{UnitQuaternion, Vector3};

use super::buffers::{FRAME_FORMATS, POINT_FORMATS, Places, Reader, Strided, array};
use super::errors::{SHX_OK, code, shx_result};
use super::guard::call;
use super::parallel::{shx_parallel_for_fn, workers};
use super::solver_def::{check_flag, check_reserved};
use super::strand_def::shx_strand_def;
use super::thread::on_own_thread;
use super::types::{SHX_FORMAT_F32X3, SHX_FORMAT_F64X3, shx_frame, shx_input};
use super::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::{Error, Result, check_finite};
use crate::groom::fit::bulk::fit_each;
use crate::groom::fit::{ElementLengths, Fit, FitCurve, FitOptions, FitRoot, FitScratch, fit_curve};
use crate::rod::definition::MAX_ELEMENTS;
use crate::workers::Workers;

/// All elements of a strand are equally long.
pub const SHX_FIT_LENGTHS_EQUAL: u32 = 1;
/// Equally long where that is good, else free. The default.
pub const SHX_FIT_LENGTHS_AUTO: u32 = 2;
/// Free: half the error. Strands step as fast; shx_solver_sample takes strands of equal elements side by side, others one by one.
pub const SHX_FIT_LENGTHS_FREE: u32 = 3;

/// How to fit, and by whom. Fill with shx_fit_options_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_fit_options {
    /// Set by shx_fit_options_init.
    pub struct_size: u32,
    /// Helical elements a strand, 1 to 100000; with a tolerance, the most. Default 10.
    pub element_count: u32,
    /// Above 0: the smallest number of elements for which no point is farther than this from the strand at equal arclength, m. Where
    /// element_count do not keep it, the strand has that many, and its max_error says so. 0 (default): none.
    pub tolerance: f64,
    /// SHX_FIT_LENGTHS_. Default SHX_FIT_LENGTHS_AUTO.
    pub length_mode: u32,
    /// 1 (default): elements may be twisted where that brings the centreline closer. 0: no twist; material frames are carried along
    /// without turning, and elements are arcs of circles.
    pub twist: u32,
    /// The least length of an element in those of equal ones, 0.05 to 1. Default 0.3.
    pub min_length_ratio: f64,
    /// A start is good, and the last, when the root mean square distance is below this share of the length; 0 to 1. Default 1e-3.
    pub target_rms_error: f64,
    /// A strand whose largest distance is above this share of the length has it lowered below, or as far as it goes, at the cost of the root
    /// mean square; 0 to 1. Default 0.01. 1: never. With a tolerance that is used in its place.
    pub target_max_error: f64,
    /// What the points may be off by, m, 0 or above: the length of a curve that zigzags by less is taken along its middle. Default 0.
    pub noise: f64,
    /// Where curves have frames: how many metres of distance, in units of the curve's length, one radian between the frames is worth,
    /// 0 or above. Default 3e-3.
    pub frame_weight: f64,
    /// Starts tried at most, 1 to 8. Default 4.
    pub max_starts: u32,
    /// Threads: 0 or 1 (default): the calling thread; 2 to 256: a pool, there for the call alone. The results' bits do not depend on it.
    pub worker_count: u32,
    /// Or the host's parallel loop.
    pub parallel_for: shx_parallel_for_fn,
    /// Handed to parallel_for.
    pub parallel_for_user: *mut c_void,
    /// 0.
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

/// The engine's error with the names of the C structure.
fn in_words_of_c(error: Error) -> Error {
    error.with_fields(&[
        ("least_length", "min_length_ratio"),
        ("good", "target_rms_error"),
        ("good_largest", "target_max_error"),
        ("starts", "max_starts"),
    ])
}

/// Prepares a shx_fit_options. size is sizeof(shx_fit_options).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_fit_options_init(options: *mut shx_fit_options, size: usize) -> shx_result {
    // SAFETY: the caller says that options holds size bytes.
    unsafe { initialise("shx_fit_options_init", "options", options, size) }
}

/// Curves to fit strands to. Prepare with shx_fit_input_init, then set at least points, point_counts and curve_count. What is pointed
/// to is read during the call and not kept.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_fit_input {
    /// Set by shx_fit_input_init.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// How many curves.
    pub curve_count: usize,
    /// The points of all curves, one curve after the other, root first, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is
    /// not looked at). Doubled points are skipped.
    pub points: shx_input,
    /// curve_count numbers, whose sum is points.count.
    pub point_counts: *const u32,
    /// Null (default: the sum of the edges), or the arclength of each point, m: from 0 at each root, ascending.
    pub arclengths: *const f64,
    /// Null (default), or the hair's width at each point, m, 0 or above.
    pub widths: *const f64,
    /// count 0 (default), or a material frame at each point (SHX_FORMAT_FRAME, of which the rotation counts, or _F32X4, _F64X4:
    /// quaternions x, y, z, w): the strands' n1 follow the images of the y axis as well as they can.
    pub frames: shx_input,
    /// count 0 (default: from the curve), or for each curve the root's frame (formats as frames), or the direction in which the strand
    /// leaves (SHX_FORMAT_F32X3, _F64X3; any length above zero).
    pub roots: shx_input,
    /// 0.
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

/// Prepares a shx_fit_input. size is sizeof(shx_fit_input).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_fit_input_init(curves: *mut shx_fit_input, size: usize) -> shx_result {
    // SAFETY: the caller says that curves holds size bytes.
    unsafe { initialise("shx_fit_input_init", "curves", curves, size) }
}

/// A strand that was fitted to a curve, beside its element lengths and curvatures.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_fitted_strand {
    /// SHX_OK, or why the curve could not be fitted (SHX_ERROR_INVALID_ARGUMENT: no length, numbers that are not finite, ...); then
    /// the rest is 0.
    pub result: shx_result,
    /// How many elements the strand has.
    pub element_count: u32,
    /// Root frame: the curve's first point.
    pub root: shx_frame,
    /// m.
    pub length: f64,
    /// Root mean square distance between the curve's points and the strand at equal arclength, m.
    pub rms_error: f64,
    /// The largest such distance, m.
    pub max_error: f64,
    /// The largest distance of the curve's points from the strand, wherever on it the nearest place is, m.
    pub max_distance: f64,
    /// Root mean square angle between n1 and the curve's frames, rad; 0 without frames.
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
                root: shx_frame { origin: fit.root.origin.into(), rotation: fit.root.rotation_xyzw() },
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
        // SAFETY: as the caller says.
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

/// Fits a strand to each of many curves, on as many threads as options say (null: the defaults). Item i of strands (stride bytes apart,
/// 0: packed) says what came of curve i; a curve that cannot be fitted has its status and leaves the others alone. The rows of curve i
/// begin at i * options.element_count, both in out_element_lengths (m) and out_curvatures (rad/m, rows of three doubles); what a strand
/// has fewer elements than that is filled with 0. capacity says how many elements both hold: at least curve_count *
/// options.element_count. shx_strand_def_set_fit puts them into a definition.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL,
/// SHX_ERROR_UNSUPPORTED (threads that could not be started). Any thread.
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
                Places::new("out_element_lengths", "capacity", out_element_lengths, capacity)?,
                Places::new("out_curvatures", "capacity", out_curvatures.cast::<[f64; 3]>(), capacity)?,
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
        fitted.write(&statuses)
    };
    call("shx_fit_strands", body)
}

/// Puts a fitted strand into a definition that shx_strand_def_init has filled: root, length, element_count, element_lengths and
/// natural, and where the curve had widths both semi-axes (radius); the rest stays as it is. element_lengths (m) and curvatures
/// (rad/m, rows of three doubles) are the strand's own: of curve i of shx_fit_strands they begin at i * options.element_count. The
/// definition points to them: they must stay until it has been used.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the curve could not be fitted: its status is
/// not SHX_OK); then nothing has changed. Any thread.
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
            return Err(Error::invalid("fitted.result", fitted.result, "SHX_OK: a curve that could be fitted"));
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
