//! Render hair: many strands from few guides.

use std::ffi::c_void;
use std::sync::{Arc, RwLock};

use nalgebra::Vector3;

use super::render_def::{OwnedGuides, shx_render_guides, shx_render_settings, shx_render_view};
use crate::capi::base::buffers::{
    OutputList, OutputValue, PLACE_FORMATS, POINT_FORMATS, Reader, Writer, array, strand_ids, tangent,
};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{call, in_use, read, shx_solver};
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::types::{SHX_FORMAT_F32X3, SHX_FORMAT_F32X4, SHX_FORMAT_FRAME, shx_input, shx_output, shx_strand_id};
use crate::capi::base::versioned::read_versioned;
use crate::capi::reading::output_transform::OutputTransform;
use crate::capi::simulation::solver_def::{check_flag, check_reserved};
use crate::error::{Error, Result};
use crate::groom::render_hair::{
    GuideSamples, Motion, RenderBody, RenderHair, RenderPose, RenderSettings, StrandPoints, StrandSink, VELOCITY_STEP, View,
    resampled,
};
use crate::workers::Workers;

/// The binding of render strands to guides. shx_render_hair_create, shx_solver_create_render_hair,
/// shx_render_hair_load, shx_render_hair_without_guides and shx_render_hair_with_own_shapes make it,
/// you own it, shx_render_hair_destroy frees it. Immutable: any number of threads may use it at once.
pub struct shx_render_hair(Arc<RenderHair>);

/// The pose of the guides of a shx_render_hair at one moment. shx_render_pose_create makes
/// it, you own it, shx_render_pose_destroy frees it. Keep one for each moment that you need
/// at the same time (two for velocities between frames).
pub struct shx_render_pose(RwLock<RenderPose>);

/// # Safety
/// `hair` is null or alive.
unsafe fn hair_from<'a>(hair: *const shx_render_hair) -> Result<&'a Arc<RenderHair>> {
    // SAFETY: the same.
    unsafe { hair.as_ref() }.map(|hair| &hair.0).ok_or_else(|| Error::NullArgument { argument: "hair".into() })
}

/// # Safety
/// `pose` is null or alive.
unsafe fn pose_from<'a>(argument: &str, pose: *const shx_render_pose) -> Result<&'a RwLock<RenderPose>> {
    // SAFETY: the same.
    unsafe { pose.as_ref() }.map(|pose| &pose.0).ok_or_else(|| Error::NullArgument { argument: argument.into() })
}

/// The roots of strands, from the host.
struct Ground {
    roots: Vec<Vector3<f64>>,
    /// The scalp's, if the host passes frames.
    normals: Option<Vec<Vector3<f64>>>,
}

impl Ground {
    /// # Safety
    /// `roots` is null or a shx_input whose memory is there.
    unsafe fn read(roots: *const shx_input) -> Result<Self> {
        // SAFETY: the same.
        let reader = unsafe { Reader::new("roots", roots, PLACE_FORMATS)? };
        // SAFETY: not null, as the reader found.
        let framed = unsafe { (*roots).format } == SHX_FORMAT_FRAME;
        let count = reader.count();
        let normal = |index: usize| reader.rotation("roots", index).map(|rotation| rotation * Vector3::x());
        Ok(Self {
            roots: (0..count).map(|index| reader.point(index).into()).collect(),
            normals: if framed { Some((0..count).map(normal).collect::<Result<_>>()?) } else { None },
        })
    }
}

/// Builds the map, and spawns threads so that they leave nothing behind on the host's thread.
fn bind(settings: &RenderSettings, guides: &GuideSamples, ground: &Ground) -> Result<RenderHair> {
    made(&settings.workers, || RenderHair::bind_on(settings, guides, &ground.roots, ground.normals.as_deref()))
}

/// Makes render hair; on a thread of its own if it starts a pool.
fn made(workers: &Workers, make: impl FnOnce() -> Result<RenderHair> + Send) -> Result<RenderHair> {
    if matches!(workers, Workers::Pool(_)) { on_own_thread(make) } else { make() }
}

/// Creates render hair from guides in their rest pose. roots has the root positions of the render strands
/// at the same moment, m, one per strand: formats as shx_render_guides.points, or SHX_FORMAT_FRAME, whose
/// n0 is the normal of the scalp. settings may be null (defaults). Takes some microseconds per strand. You
/// own *out_hair; free it with shx_render_hair_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
/// SHX_ERROR_UNSUPPORTED (threads that could not be started).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_hair_create(
    settings: *const shx_render_settings,
    guides: *const shx_render_guides,
    roots: *const shx_input,
    out_hair: *mut *mut shx_render_hair,
) -> shx_result {
    // SAFETY: the caller's structures, what they point to, and place for one pointer.
    call("shx_render_hair_create", || unsafe {
        let settings = settings_from(settings)?;
        let owned = OwnedGuides::read(&read_versioned("guides", guides)?, settings.points_per_strand)?;
        let (ground, place) = (Ground::read(roots)?, OutputValue::new("out_hair", out_hair)?);
        let hair = bind(&settings, &owned.samples(), &ground)?;
        place.write(Box::into_raw(Box::new(shx_render_hair(Arc::new(hair)))));
        Ok(())
    })
}

/// # Safety
/// `settings` is null or a structure of the size that it states.
unsafe fn settings_from(settings: *const shx_render_settings) -> Result<RenderSettings> {
    if settings.is_null() {
        return Ok(RenderSettings::default());
    }
    // SAFETY: the same.
    unsafe { read_versioned("settings", settings)?.settings() }
}

/// Creates render hair whose guides are count strands of a solver in their current shapes: call it while they
/// are at rest. Otherwise as shx_render_hair_create.
/// Errors: as shx_render_hair_create; SHX_ERROR_INVALID_ID.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_create_render_hair(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    settings: *const shx_render_settings,
    roots: *const shx_input,
    out_hair: *mut *mut shx_render_hair,
) -> shx_result {
    // SAFETY: the caller's handle, count ids, structure, roots and place for one pointer.
    unsafe {
        read("shx_solver_create_render_hair", solver, |core| {
            let ids = strand_ids(ids, count)?;
            if ids.is_empty() {
                return Err(Error::invalid("count", count, "at least 1"));
            }
            let settings = settings_from(settings)?;
            let (ground, place) = (Ground::read(roots)?, OutputValue::new("out_hair", out_hair)?);
            let guides = core.render_guides(&ids, settings.points_per_strand, false)?;
            let hair = bind(&settings, &guides.samples(), &ground)?;
            place.write(Box::into_raw(Box::new(shx_render_hair(Arc::new(hair)))));
            Ok(())
        })
    }
}

/// Writes render hair to out_image, which holds capacity bytes, and its size to
/// *out_size. shx_render_hair_load restores it without binding it again. With a null
/// out_image and capacity 0 it only returns the size.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_hair_save(
    hair: *const shx_render_hair,
    out_image: *mut c_void,
    capacity: usize,
    out_size: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, place for capacity bytes and for one number.
    call("shx_render_hair_save", || unsafe {
        let (hair, size) = (hair_from(hair)?, OutputValue::new("out_size", out_size)?);
        let places = OutputList::image("out_image", out_image, capacity)?;
        let bytes = hair.to_bytes();
        if let Some(places) = places {
            places.write(&bytes)?;
        }
        size.write(bytes.len());
        Ok(())
    })
}

/// Restores render hair from size bytes that shx_render_hair_save wrote. Its strands are identical to the bit.
/// Of settings only worker_count, parallel_for and parallel_for_user are used; null: the calling thread
/// evaluates. You own *out_hair; free it with shx_render_hair_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_SNAPSHOT (not
/// render hair, corrupt, of another version), SHX_ERROR_UNSUPPORTED (threads that could not be started).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_hair_load(
    image: *const c_void,
    size: usize,
    settings: *const shx_render_settings,
    out_hair: *mut *mut shx_render_hair,
) -> shx_result {
    // SAFETY: the caller's size bytes, structure and place for one pointer.
    call("shx_render_hair_load", || unsafe {
        // A null image is a mistake even when its size is 0.
        let bytes = array("image", "size", image.cast::<u8>(), size.max(usize::from(image.is_null())))?;
        let (workers, place) = (settings_from(settings)?.workers, OutputValue::new("out_hair", out_hair)?);
        let hair = made(&workers, || RenderHair::from_bytes(bytes, workers.clone()))?;
        place.write(Box::into_raw(Box::new(shx_render_hair(Arc::new(hair)))));
        Ok(())
    })
}

/// Creates a copy of render hair without count of its guides, whose numbers as at creation are
/// in removed. The other guides keep their order. Strands that follow none of the removed
/// guides stay identical to the bit. Poses belong to the hair that they were created for. You
/// own *out_hair; free it with shx_render_hair_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (guides that do not exist, appear twice, or are
/// all guides), SHX_ERROR_UNSUPPORTED (threads that could not be started).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_hair_without_guides(
    hair: *const shx_render_hair,
    removed: *const u32,
    count: usize,
    out_hair: *mut *mut shx_render_hair,
) -> shx_result {
    // SAFETY: the caller's handle, count numbers and place for one pointer.
    call("shx_render_hair_without_guides", || unsafe {
        let (hair, removed) = (hair_from(hair)?, array("removed", "count", removed, count)?);
        let place = OutputValue::new("out_hair", out_hair)?;
        let left = || hair.without_guides(removed).map_err(|error| error.renamed("gone", "removed"));
        let left = made(&hair.settings().workers, left)?;
        place.write(Box::into_raw(Box::new(shx_render_hair(Arc::new(left)))));
        Ok(())
    })
}

/// Creates a copy of render hair whose strands have shapes of their own: while the guides are as at creation,
/// each strand is the curve that points has for it (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number
/// is ignored; m, strand by strand, root first). When guides move, the difference between a strand and its
/// guides moves with the frames of its first guide, and the strand keeps its own length. Wisps and frizz act
/// only by how they change as guides move. length_variation cuts strands short along their own shapes.
/// count must be the number of strands. point_counts: a number for each strand, 1 or above, that sum to
/// points.count; curves are then resampled uniformly in arclength. Null: each curve has
/// settings.points_per_strand points, uniform in arclength. shx_render_hair_save includes the shapes. Poses
/// belong to the hair that they were created for. You own *out_hair; free it with shx_render_hair_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (another count, a value that is not finite),
/// SHX_ERROR_UNSUPPORTED (threads that could not be started).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_hair_with_own_shapes(
    hair: *const shx_render_hair,
    points: *const shx_input,
    point_counts: *const u32,
    count: usize,
    out_hair: *mut *mut shx_render_hair,
) -> shx_result {
    // SAFETY: the caller's handle, points, count numbers or null, and place for one pointer.
    call("shx_render_hair_with_own_shapes", || unsafe {
        let (hair, place) = (hair_from(hair)?, OutputValue::new("out_hair", out_hair)?);
        let (strands, per_strand) = (hair.strand_count(), hair.settings().points_per_strand);
        if count != strands {
            return Err(Error::invalid("count", count, format!("{strands}, the number of strands")));
        }
        let reader = Reader::new("points", points, POINT_FORMATS)?;
        let counts = if point_counts.is_null() { None } else { Some(array("point_counts", "count", point_counts, count)?) };
        let needed = match counts {
            Some(counts) => counts.iter().map(|count| *count as usize).fold(0, usize::saturating_add),
            None => strands * per_strand,
        };
        if reader.count() != needed {
            return Err(Error::invalid("points.count", reader.count(), needed.to_string()));
        }
        let mut shapes: Vec<Vector3<f64>> = (0..needed).map(|index| reader.point(index).into()).collect();
        if let Some(counts) = counts {
            let in_words_of_c = |error: Error| error.renamed("guides.", "");
            shapes = resampled(&shapes, counts, None, per_strand).map_err(in_words_of_c)?.points;
        }
        let copy = || hair.copied_with_own_shapes(&shapes).map_err(|error| error.renamed("shapes", "points"));
        let copy = made(&hair.settings().workers, copy)?;
        place.write(Box::into_raw(Box::new(shx_render_hair(Arc::new(copy)))));
        Ok(())
    })
}

/// Frees render hair. Poses of it remain valid. Null is allowed.
/// Threads: any. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_hair_destroy(hair: *mut shx_render_hair) {
    call("shx_render_hair_destroy", || {
        if !hair.is_null() {
            // SAFETY: made by Box::into_raw in one of the functions above.
            drop(unsafe { Box::from_raw(hair) });
        }
        Ok(())
    });
}

/// For count strands from first on, writes the first guide of each (numbered as at creation) to
/// out_guides and the number of its wisp around that guide, from 0, to out_wisps: for colours by lock, or
/// to find the strands of a guide. Either may be null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (strands that do not exist).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_hair_wisps(
    hair: *const shx_render_hair,
    first: usize,
    count: usize,
    out_guides: *mut u32,
    out_wisps: *mut u32,
) -> shx_result {
    // SAFETY: the caller's handle and places for count numbers each.
    call("shx_render_hair_wisps", || unsafe {
        let hair = hair_from(hair)?;
        if out_guides.is_null() && out_wisps.is_null() {
            return Err(Error::NullArgument { argument: "out_guides (and out_wisps)".into() });
        }
        let total = hair.strand_count();
        if first > total {
            return Err(Error::invalid("first", first, format!("0 to {total}, the number of strands")));
        }
        if count > total - first {
            return Err(Error::invalid("count", count, format!("up to {}", total - first)));
        }
        let guides = OutputList::optional("out_guides", "count", out_guides, count)?;
        let wisps = OutputList::optional("out_wisps", "count", out_wisps, count)?;
        let range = first..first + count;
        if let Some(guides) = guides {
            let first_of = |strand: usize| hair.guides_of(strand).and_then(|mut list| list.next()).map_or(0, |(guide, _)| guide);
            guides.write_all(range.clone().map(first_of))?;
        }
        if let Some(wisps) = wisps {
            wisps.write_all(range.map(|strand| hair.wisp_of(strand).unwrap_or_default()))?;
        }
        Ok(())
    })
}

/// Creates a pose of render hair. Set its guides before you evaluate it. You
/// own *out_pose; free it with shx_render_pose_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_pose_create(hair: *const shx_render_hair, out_pose: *mut *mut shx_render_pose) -> shx_result {
    // SAFETY: the caller's handle and place for one pointer.
    call("shx_render_pose_create", || unsafe {
        let (hair, place) = (hair_from(hair)?, OutputValue::new("out_pose", out_pose)?);
        place.write(Box::into_raw(Box::new(shx_render_pose(RwLock::new(RenderPose::new(hair.clone()))))));
        Ok(())
    })
}

/// Frees a pose. Null is allowed.
/// Threads: any. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_pose_destroy(pose: *mut shx_render_pose) {
    call("shx_render_pose_destroy", || {
        if !pose.is_null() {
            // SAFETY: made by Box::into_raw in shx_render_pose_create.
            drop(unsafe { Box::from_raw(pose) });
        }
        Ok(())
    });
}

/// Sets the guides of a pose, in the number and order of shx_render_hair_create. guides.roots is allowed only
/// if it was given there. A failed call leaves the pose as it was.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY (the pose is being evaluated).
/// Threads: exclusive for the pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_pose_set_guides(pose: *mut shx_render_pose, guides: *const shx_render_guides) -> shx_result {
    // SAFETY: the caller's handle, structure and what it points to.
    call("shx_render_pose_set_guides", || unsafe {
        let mut pose = pose_from("pose", pose)?.try_write().map_err(in_use)?;
        let per_strand = pose.hair().settings().points_per_strand;
        let owned = OwnedGuides::read(&read_versioned("guides", guides)?, per_strand)?;
        pose.set(&owned.samples())
    })
}

/// Sets the guides of a pose to count strands of a solver in their current shapes, in the
/// number and order of shx_solver_create_render_hair. velocities: 1 if you will evaluate
/// velocities, else 0. A failed call leaves the pose as it was.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY.
/// Threads: shared for the solver, exclusive for the pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_render_pose(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    velocities: u32,
    pose: *mut shx_render_pose,
) -> shx_result {
    // SAFETY: the caller's handles and count ids.
    unsafe {
        read("shx_solver_set_render_pose", solver, |core| {
            let ids = strand_ids(ids, count)?;
            let velocities = check_flag("velocities", velocities)?;
            let mut pose = pose_from("pose", pose)?.try_write().map_err(in_use)?;
            let guides = pose.hair().guide_count();
            if count != guides {
                return Err(Error::invalid("count", count, format!("{guides}, the number of guides")));
            }
            core.pose_render_hair(&ids, velocities, &mut pose)
        })
    }
}

/// Evaluates render strands: item i * points_per_strand + j of each output is point j (0 is the root, the last
/// is the tip) of strand view.first_strand + i. view may be null: all strands, no origin.
/// points, m: SHX_FORMAT_F32X3, or _F32X4 with the tapered radius.
/// frames: SHX_FORMAT_F32X4, quaternions x, y, z, w of frames with n0 along the strand and n1 near that of its
/// first guide, parallel-transported from the follicle; or SHX_FORMAT_F32X3 for n0 alone, the unit tangent.
/// velocities, m/s: SHX_FORMAT_F32X3.
/// One or two of the three may be null. The arithmetic is single precision relative to the guides' roots.
/// Results are identical to the bit for any number of threads and any partition into calls. It runs on the
/// hair's own threads (settings.worker_count), on your parallel loop (settings.parallel_for), or on the
/// calling thread; you may also call it from several threads at once, each for other strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a
/// pose that was never set, velocities of guides without velocities),
/// SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_BUSY (the pose is being set).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_pose_evaluate(
    pose: *const shx_render_pose,
    view: *const shx_render_view,
    points: *const shx_output,
    frames: *const shx_output,
    velocities: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, structure, what it points to, and memory for the outputs.
    call("shx_render_pose_evaluate", || unsafe { evaluate(pose, view, [points, frames, velocities], |_| Vec::new()) })
}

/// Does the same as shx_render_pose_evaluate and keeps strands out of the current bodies of a solver, by
/// settings.body_clearance. Bodies with groups or mask 0 are ignored. Use distance grids for heads: a grid
/// costs some nanoseconds per point, a mesh some microseconds. For velocities, bodies are assumed to have
/// moved as they move now. The pose need not come from this solver.
/// Errors: as shx_render_pose_evaluate.
/// Threads: shared for the solver and the pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_evaluate_render_pose(
    solver: *const shx_solver,
    pose: *const shx_render_pose,
    view: *const shx_render_view,
    points: *const shx_output,
    frames: *const shx_output,
    velocities: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handles, structure, what it points to, and memory for the outputs.
    unsafe {
        read("shx_solver_evaluate_render_pose", solver, |core| {
            evaluate(pose, view, [points, frames, velocities], |seconds| core.render_bodies(seconds))
        })
    }
}

/// Evaluates strands into points, frames and velocities, kept out of the bodies that there are; those are asked for with how long ago the
/// earlier moment is.
///
/// # Safety
/// The handle is null or alive, the structure and what it points to are there, and the memory of the outputs.
unsafe fn evaluate<'a>(
    pose: *const shx_render_pose,
    view: *const shx_render_view,
    [points, frames, velocities]: [*const shx_output; 3],
    bodies: impl FnOnce(f64) -> Vec<RenderBody<'a>>,
) -> Result<()> {
    // SAFETY: as the caller guarantees.
    unsafe {
        let pose = pose_from("pose", pose)?.try_read().map_err(in_use)?;
        let whole = view.is_null();
        let def = if whole {
            <shx_render_view as crate::capi::base::versioned::Versioned>::defaults()
        } else {
            read_versioned("view", view)?
        };
        if def.reserved0 != 0 {
            return Err(Error::invalid("view.reserved0", def.reserved0, "0"));
        }
        check_reserved("view", &def.reserved)?;
        let total = pose.hair().strand_count();
        if def.first_strand > total {
            return Err(Error::invalid("view.first_strand", def.first_strand, format!("0 to {total}, the number of strands")));
        }
        let count = if def.strand_count == usize::MAX { total - def.first_strand } else { def.strand_count };
        if count > total - def.first_strand {
            return Err(Error::invalid("view.strand_count", count, format!("up to {}, or SIZE_MAX", total - def.first_strand)));
        }
        if points.is_null() && frames.is_null() && velocities.is_null() {
            return Err(Error::NullArgument { argument: "points (and frames, and velocities)".into() });
        }
        let per_strand = pose.hair().settings().points_per_strand;
        let needed = count
            .checked_mul(per_strand)
            .filter(|needed| *needed <= crate::capi::base::types::MAX_COUNT)
            .ok_or_else(|| Error::invalid("view.strand_count", count, "fewer strands per call"))?;
        let sink = Outputs {
            first: def.first_strand,
            per_strand,
            points: Writer::optional("points", points, &[SHX_FORMAT_F32X3, SHX_FORMAT_F32X4], needed)?,
            frames: Writer::optional("frames", frames, &[SHX_FORMAT_F32X4, SHX_FORMAT_F32X3], needed)?,
            velocities: Writer::optional("velocities", velocities, &[SHX_FORMAT_F32X3], needed)?,
            transform: OutputTransform::new("view", [def.x_axis, def.y_axis, def.z_axis], def.translation)?,
        };
        let roots =
            shx_render_view::roots_of("view.roots", &def.roots, count)?.map(|reader| Roots { reader, first: def.first_strand });
        let earlier = shx_render_view::roots_of("view.previous_roots", &def.previous_roots, count)?
            .map(|reader| Roots { reader, first: def.first_strand });
        let now = |strand: usize| roots.as_ref().map_or_else(Vector3::zeros, |roots| roots.at(strand));
        let then = |strand: usize| earlier.as_ref().map_or_else(Vector3::zeros, |roots| roots.at(strand));
        let before = if def.previous_pose.is_null() {
            if def.interval != 0.0 {
                return Err(Error::invalid("view.interval", def.interval, "0 without previous_pose"));
            }
            if earlier.is_some() {
                return Err(Error::invalid("view.previous_roots", "given", "none without previous_pose"));
            }
            None
        } else {
            Some(pose_from("view.previous_pose", def.previous_pose)?.try_read().map_err(in_use)?)
        };
        let motion = match (&sink.velocities, &before) {
            (None, _) => Motion::None,
            (Some(_), None) => Motion::Guides,
            (Some(_), Some(before)) => {
                Motion::Since { before, seconds: def.interval, roots: if earlier.is_some() { Some(&then) } else { None } }
            }
        };
        let bodies = bodies(if before.is_some() { def.interval } else { VELOCITY_STEP });
        let view = View {
            first: def.first_strand,
            count,
            origin: def.origin.into(),
            roots: if roots.is_some() { Some(&now) } else { None },
            rotations: sink.frames.is_some(),
            motion,
            bodies: &bodies,
        };
        pose.evaluate(&view, &sink).map_err(named)
    }
}

/// The engine's errors in the names of the view's fields.
fn named(error: Error) -> Error {
    const FIELDS: [(&str, &str); 6] = [
        ("first", "first_strand"),
        ("count", "strand_count"),
        ("origin", "origin"),
        ("roots", "roots"),
        ("before", "previous_pose"),
        ("seconds", "interval"),
    ];
    FIELDS.iter().fold(
        error,
        |error, (ours, theirs)| {
            if starts(&error, ours) { error.renamed(ours, &format!("view.{theirs}")) } else { error }
        },
    )
}

fn starts(error: &Error, name: &str) -> bool {
    matches!(error, Error::InvalidArgument { argument, .. } if argument.starts_with(name))
}

/// The host's roots.
struct Roots {
    reader: Reader,
    first: usize,
}

// SAFETY: memory of the caller's that stays unchanged during the call.
unsafe impl Sync for Roots {}

impl Roots {
    fn at(&self, strand: usize) -> Vector3<f64> {
        self.reader.point(strand - self.first).into()
    }
}

struct Outputs {
    first: usize,
    per_strand: usize,
    points: Option<Writer>,
    frames: Option<Writer>,
    velocities: Option<Writer>,
    transform: Option<OutputTransform>,
}

impl Outputs {
    /// The same in the host's space.
    fn take_transformed(&self, strand: &StrandPoints, transform: &OutputTransform) {
        let (first, count) = ((strand.strand - self.first) * self.per_strand, self.per_strand);
        let mapped = |[x, y, z]: [&[f32]; 3], k: usize| [x[k], y[k], z[k]].map(f64::from);
        if let Some(points) = &self.points {
            let position = |k: usize| transform.point(mapped(strand.positions, k)).map(|x| x as f32);
            if points.width() == 3 {
                points.singles(first, count, position);
            } else {
                let factor = transform.scale() * f64::from(strand.radius_factor);
                points.singles(first, count, |k| {
                    let [x, y, z] = position(k);
                    [x, y, z, (factor * f64::from(strand.radii[k])) as f32]
                });
            }
        }
        if let Some(frames) = &self.frames {
            let [x, y, z, w] = strand.rotations;
            let rotation = |k: usize| transform.quaternion([x[k], y[k], z[k], w[k]].map(f64::from));
            if frames.width() == 3 {
                frames.singles(first, count, |k| tangent(rotation(k)).map(|x| x as f32));
            } else {
                frames.singles(first, count, |k| rotation(k).map(|x| x as f32));
            }
        }
        if let Some(velocities) = &self.velocities {
            velocities.singles(first, count, |k| transform.vector(mapped(strand.velocities, k)).map(|x| x as f32));
        }
    }
}

// SAFETY: the writers point into memory that is the caller's alone during the call, and every strand comes once.
unsafe impl Sync for Outputs {}

impl StrandSink for Outputs {
    #[inline(always)]
    fn take(&self, strand: &StrandPoints) {
        if let Some(transform) = &self.transform {
            return self.take_transformed(strand, transform);
        }
        let (first, count) = ((strand.strand - self.first) * self.per_strand, self.per_strand);
        if let Some(points) = &self.points {
            let [x, y, z] = strand.positions.map(|row| &row[..count]);
            if points.width() == 3 {
                points.singles(first, count, |k| [x[k], y[k], z[k]]);
            } else {
                let radii = &strand.radii[..count];
                points.singles(first, count, |k| [x[k], y[k], z[k], strand.radius_factor * radii[k]]);
            }
        }
        if let Some(frames) = &self.frames {
            let [x, y, z, w] = strand.rotations.map(|row| &row[..count]);
            if frames.width() == 3 {
                frames.singles(first, count, |k| tangent([x[k], y[k], z[k], w[k]].map(f64::from)).map(|x| x as f32));
            } else {
                frames.singles(first, count, |k| [x[k], y[k], z[k], w[k]]);
            }
        }
        if let Some(velocities) = &self.velocities {
            let [x, y, z] = strand.velocities.map(|row| &row[..count]);
            velocities.singles(first, count, |k| [x[k], y[k], z[k]]);
        }
    }
}
