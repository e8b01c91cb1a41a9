//! Definitions of render hair and of its evaluation.

use std::ffi::c_void;
use std::mem::size_of;

use nalgebra::{UnitQuaternion, Vector3};

use super::render_hair::shx_render_pose;
use crate::capi::base::buffers::{FRAME_FORMATS, PLACE_FORMATS, POINT_FORMATS, Reader, VECTOR_FORMATS, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::parallel::{shx_parallel_for_fn, workers};
use crate::capi::base::types::shx_input;
use crate::capi::base::versioned::{Versioned, initialise};
use crate::capi::simulation::solver_def::{check_flag, check_reserved};
use crate::error::{Error, Result};
use crate::groom::render_hair::{GuideSamples, RenderSettings, Space, resampled};

/// Interpolate the positions of guides: strands stay between them,
/// but curls that are out of phase cancel. The default.
pub const SHX_INTERPOLATION_POSITION: u32 = 1;
/// Interpolate lengths and curvatures of guides: strands keep their length and curls.
pub const SHX_INTERPOLATION_CURVATURE: u32 = 2;

/// How render strands are made from guides. Lengths in m. Fill it with shx_render_settings_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_render_settings {
    /// Set by shx_render_settings_init.
    pub struct_size: u32,
    /// Points per strand, including root and tip, 2 to 4096; guides are sampled at as many. Default 16.
    pub points_per_strand: u32,
    /// SHX_INTERPOLATION_. Default SHX_INTERPOLATION_POSITION.
    pub interpolation: u32,
    /// Maximum number of guides that a strand follows, 1 to 4. Default 4.
    pub guides_per_strand: u32,
    /// 0: interpolated from root to tip. 0.5 (default): interpolated at the root,
    /// gathered in wisps at the tip. 1: separate locks.
    pub curliness: f64,
    /// 1: use the curliness measured on the shape of each guide instead. Default 0.
    pub measure_curliness: u32,
    /// Wisps per guide, 1 to 10000. Default 4.
    pub wisps_per_guide: u32,
    /// Guides are not interpolated if their tips are farther apart than
    /// their roots by more than this. 0 (default): no limit.
    pub max_tip_distance: f64,
    /// The same as a fraction of the shorter guide's length. 0: no limit. Default 0.6.
    pub max_tip_ratio: f64,
    /// Radius of a wisp at root, middle and tip relative to the
    /// spacing of roots, 0 or above. Default 1, 0.6, 0.08.
    pub wisp_profile: [f64; 3],
    /// How far the cross-sections of wisps are flattened along the normal of the scalp. 0
    /// (default): as round as their patch of scalp. 1: ribbons.
    pub wisp_flatness: f64,
    /// RMS deviation of whole wisps from their path at the tip, 0 or above. Default 0.
    pub wisp_noise: f64,
    /// Waves of wisp_noise along a strand, above 0 to 1000. Default 1.5.
    pub wisp_noise_waves: f64,
    /// RMS deviation of strands from their path at the tip, 0 or above. Default 0.
    pub frizz: f64,
    /// Waves of frizz along a strand, above 0 to 1000. Default 3.
    pub frizz_waves: f64,
    /// Fraction of strands that leave their wisps, 0 to 1. Default 0.02.
    pub flyaway_fraction: f64,
    /// RMS deviation of those strands from their path at the tip, 0 or above. Default 5e-3.
    pub flyaway_distance: f64,
    /// Largest fraction by which strands are cut short, each by a random amount; 0 to less than 1. Default 0.25.
    pub length_variation: f64,
    /// Radius at the root, 0 or above. Default 40e-6.
    pub radius: f64,
    /// Radius at the tip, 0 or above. Default 15e-6.
    pub tip_radius: f64,
    /// Where the taper starts, as a fraction of the length; 0 to less than 1. Default 0.5.
    pub taper_start: f64,
    /// Shape of the taper, above -1 to below 1. 0 (default): linear. Positive: blunt ends. Negative: thin early.
    pub taper_shape: f64,
    /// Largest relative variation of radii between strands, 0 to 1. Default 0.1.
    pub radius_variation: f64,
    /// Distance from a body at which shx_solver_evaluate_render_pose starts to push strands out; above 0. Deeper
    /// points end between it and the surface, in the order of their depth. Default 2e-3.
    pub body_clearance: f64,
    /// Random seed. Default 0.
    pub seed: u64,
    /// 1 (default): strands are as long as their guides before they
    /// are cut short. 0: interpolation may shorten them.
    pub preserve_length: u32,
    /// Threads that evaluate strands. 0 or 1 (default): the calling thread. 2 to 256: a pool that lives
    /// as long as the hair and its poses. With a task system, leave it at 0 and call
    /// shx_render_pose_evaluate from your tasks, each for some of the strands.
    pub worker_count: u32,
    /// Your parallel loop instead. Default null: none.
    pub parallel_for: shx_parallel_for_fn,
    /// User pointer of parallel_for.
    pub parallel_for_user: *mut c_void,
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles, a pointer and an optional function only.
unsafe impl Versioned for shx_render_settings {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let settings = RenderSettings::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            points_per_strand: settings.points_per_strand as u32,
            interpolation: SHX_INTERPOLATION_POSITION,
            guides_per_strand: settings.guides_per_strand as u32,
            curliness: settings.curliness,
            measure_curliness: 0,
            wisps_per_guide: settings.wisps_per_guide as u32,
            max_tip_distance: 0.0,
            max_tip_ratio: settings.max_tip_ratio,
            wisp_profile: settings.wisp_profile,
            wisp_flatness: settings.flatness,
            wisp_noise: settings.clump_noise,
            wisp_noise_waves: settings.clump_noise_waves,
            frizz: settings.frizz,
            frizz_waves: settings.frizz_waves,
            flyaway_fraction: settings.flyaways,
            flyaway_distance: settings.flyaway_distance,
            length_variation: settings.length_variation,
            radius: settings.radius,
            tip_radius: settings.tip_radius,
            taper_start: settings.taper_from,
            taper_shape: settings.taper_shape,
            radius_variation: settings.radius_variation,
            body_clearance: settings.clearance,
            seed: settings.seed,
            preserve_length: u32::from(settings.preserve_length),
            worker_count: 0,
            parallel_for: None,
            parallel_for_user: std::ptr::null_mut(),
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_render_settings>() == 248 && std::mem::offset_of!(shx_render_settings, curliness) == 16);
    assert!(
        std::mem::offset_of!(shx_render_settings, wisp_profile) == 48 && std::mem::offset_of!(shx_render_settings, seed) == 184
    );
    assert!(
        std::mem::offset_of!(shx_render_settings, parallel_for) == 200
            && std::mem::offset_of!(shx_render_settings, reserved) == 216
    );
};

impl shx_render_settings {
    pub(super) fn settings(&self) -> Result<RenderSettings> {
        let space = match self.interpolation {
            SHX_INTERPOLATION_POSITION => Space::Position,
            SHX_INTERPOLATION_CURVATURE => Space::Curvature,
            other => return Err(Error::invalid("settings.interpolation", other, "one of SHX_INTERPOLATION_")),
        };
        let border = |name: &str, value: f64| {
            if value == 0.0 {
                Ok(f64::INFINITY)
            } else if value > 0.0 && value.is_finite() {
                Ok(value)
            } else {
                Err(Error::invalid(format!("settings.{name}"), value, "0 (no limit) or a finite number above 0"))
            }
        };
        let workers = workers("settings", self.worker_count, self.parallel_for, self.parallel_for_user)?;
        check_reserved("settings", &self.reserved)?;
        let settings = RenderSettings {
            points_per_strand: self.points_per_strand as usize,
            space,
            guides_per_strand: self.guides_per_strand as usize,
            curliness: self.curliness,
            measure_curliness: check_flag("settings.measure_curliness", self.measure_curliness)?,
            max_tip_distance: border("max_tip_distance", self.max_tip_distance)?,
            max_tip_ratio: border("max_tip_ratio", self.max_tip_ratio)?,
            wisps_per_guide: self.wisps_per_guide as usize,
            wisp_profile: self.wisp_profile,
            frizz: self.frizz,
            frizz_waves: self.frizz_waves,
            radius: self.radius,
            tip_radius: self.tip_radius,
            taper_from: self.taper_start,
            radius_variation: self.radius_variation,
            length_variation: self.length_variation,
            flatness: self.wisp_flatness,
            clump_noise: self.wisp_noise,
            clump_noise_waves: self.wisp_noise_waves,
            flyaways: self.flyaway_fraction,
            flyaway_distance: self.flyaway_distance,
            taper_shape: self.taper_shape,
            clearance: self.body_clearance,
            preserve_length: check_flag("settings.preserve_length", self.preserve_length)?,
            seed: self.seed,
            workers,
            instruction_set: None,
        };
        settings.check("settings.").map_err(in_words_of_c)?;
        Ok(settings)
    }
}

/// The engine's error, with the names of the C structure.
pub(super) fn in_words_of_c(error: Error) -> Error {
    error.with_fields(&[
        ("taper_from", "taper_start"),
        ("flatness", "wisp_flatness"),
        ("clump_noise", "wisp_noise"),
        ("clump_noise_waves", "wisp_noise_waves"),
        ("flyaways", "flyaway_fraction"),
        ("clearance", "body_clearance"),
    ])
}

/// Fills *settings with defaults. size is sizeof(shx_render_settings).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_settings_init(settings: *mut shx_render_settings, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that settings holds size bytes.
    unsafe { initialise("shx_render_settings_init", "settings", settings, size) }
}

/// Guides at one moment as polylines, from a cache or any other source. Fill it with shx_render_guides_init,
/// then set at least guide_count and points. The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_render_guides {
    /// Set by shx_render_guides_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Number of guides.
    pub guide_count: usize,
    /// Points of all guides, guide by guide, root first, m: SHX_FORMAT_F32X3,
    /// _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
    pub points: shx_input,
    /// Null (default): every guide has settings.points_per_strand points, uniform in
    /// arclength. Otherwise guide_count numbers, each 1 or above, that sum to points.count;
    /// guides are then resampled uniformly in arclength.
    pub point_counts: *const u32,
    /// Orientation of each follicle: any frame that moves with the head (SHX_FORMAT_FRAME, of which only
    /// the rotation matters, or _F32X4, _F64X4: quaternions x, y, z, w). count 0 (default): the rotation
    /// of the head is estimated from the root positions.
    pub roots: shx_input,
    /// Velocity of each point, m/s: SHX_FORMAT_F32X3, _F64X3. count 0 (default): none.
    pub velocities: shx_input,
    /// With velocities: angular velocity of each follicle, rad/s (same formats). count 0 (default): none.
    pub root_angular_velocities: shx_input,
    /// Must be 0.
    pub reserved: [u64; 4],
}

pub(in crate::capi) const NO_INPUT: shx_input = shx_input { data: std::ptr::null(), stride: 0, count: 0, format: 0, reserved: 0 };

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and pointers only.
unsafe impl Versioned for shx_render_guides {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            guide_count: 0,
            points: NO_INPUT,
            point_counts: std::ptr::null(),
            roots: NO_INPUT,
            velocities: NO_INPUT,
            root_angular_velocities: NO_INPUT,
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_render_guides>() == 184 && std::mem::offset_of!(shx_render_guides, points) == 16);
    assert!(std::mem::offset_of!(shx_render_guides, roots) == 56 && std::mem::offset_of!(shx_render_guides, reserved) == 152);
};

/// Fills *guides with defaults. size is sizeof(shx_render_guides).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_guides_init(guides: *mut shx_render_guides, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that guides holds size bytes.
    unsafe { initialise("shx_render_guides_init", "guides", guides, size) }
}

/// The caller's guides, copied.
pub(super) struct OwnedGuides {
    points: Vec<Vector3<f64>>,
    roots: Option<Vec<UnitQuaternion<f64>>>,
    velocities: Option<Vec<Vector3<f64>>>,
    spins: Option<Vec<Vector3<f64>>>,
}

/// Whether the host left an input out.
fn is_absent(input: &shx_input) -> bool {
    input.count == 0 && input.data.is_null()
}

/// # Safety
/// The input's memory is there.
unsafe fn vectors(argument: &str, input: &shx_input, formats: &[u32], needed: usize) -> Result<Vec<Vector3<f64>>> {
    // SAFETY: the same.
    let reader = unsafe { Reader::new(argument, input, formats)? };
    if reader.count() != needed {
        return Err(Error::invalid(format!("{argument}.count"), reader.count(), needed.to_string()));
    }
    Ok((0..needed).map(|index| reader.point(index).into()).collect())
}

impl OwnedGuides {
    /// # Safety
    /// All that the structure points to is there.
    pub unsafe fn read(guides: &shx_render_guides, per_strand: usize) -> Result<Self> {
        if guides.reserved0 != 0 {
            return Err(Error::invalid("guides.reserved0", guides.reserved0, "0"));
        }
        check_reserved("guides", &guides.reserved)?;
        let count = guides.guide_count;
        if count == 0 {
            return Err(Error::invalid("guides.guide_count", count, "at least 1"));
        }
        // SAFETY: as the caller guarantees.
        unsafe {
            let counts = if guides.point_counts.is_null() {
                None
            } else {
                Some(array("guides.point_counts", "guides.guide_count", guides.point_counts, count)?)
            };
            let total = match counts {
                Some(counts) => counts.iter().map(|count| *count as usize).fold(0, usize::saturating_add),
                None => {
                    count.checked_mul(per_strand).ok_or_else(|| Error::invalid("guides.guide_count", count, "fewer guides"))?
                }
            };
            let mut points = vectors("guides.points", &guides.points, POINT_FORMATS, total)?;
            let mut velocities = None;
            if !is_absent(&guides.velocities) {
                velocities = Some(vectors("guides.velocities", &guides.velocities, VECTOR_FORMATS, total)?);
            }
            let mut spins = None;
            if !is_absent(&guides.root_angular_velocities) {
                let input = &guides.root_angular_velocities;
                spins = Some(vectors("guides.root_angular_velocities", input, VECTOR_FORMATS, count)?);
            }
            let mut roots = None;
            if !is_absent(&guides.roots) {
                let reader = Reader::new("guides.roots", &raw const guides.roots, FRAME_FORMATS)?;
                if reader.count() != count {
                    return Err(Error::invalid("guides.roots.count", reader.count(), format!("0 or {count}")));
                }
                roots = Some((0..count).map(|index| reader.rotation("guides.roots", index)).collect::<Result<_>>()?);
            }
            if let Some(counts) = counts {
                let uniform = resampled(&points, counts, velocities.as_deref(), per_strand)?;
                (points, velocities) = (uniform.points, uniform.values);
            }
            Ok(Self { points, roots, velocities, spins })
        }
    }

    pub fn samples(&self) -> GuideSamples<'_> {
        GuideSamples {
            points: &self.points,
            roots: self.roots.as_deref(),
            velocities: self.velocities.as_deref(),
            root_angular_velocities: self.spins.as_deref(),
        }
    }
}

/// Which strands to evaluate, and relative to what. Fill it with shx_render_view_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_render_view {
    /// Set by shx_render_view_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// First strand. Default 0.
    pub first_strand: usize,
    /// Number of strands. Default SIZE_MAX: all from first_strand on.
    pub strand_count: usize,
    /// Subtracted from positions before they are rounded to floats, m. Default 0.
    pub origin: [f64; 3],
    /// For velocities: a pose of the same hair, interval seconds earlier. Null
    /// (default): velocities follow from those of the guides.
    pub previous_pose: *const shx_render_pose,
    /// Time since previous_pose, s; above 0. 0 without it.
    pub interval: f64,
    /// Root positions, m: item i is strand first_strand + i. Formats as shx_render_guides.points, or
    /// SHX_FORMAT_FRAME, of which only the origin matters (shx_scalp_root_frames). count 0
    /// (default): every root follows the roots of its guides.
    pub roots: shx_input,
    /// With previous_pose and roots: the root positions at that time.
    pub previous_roots: shx_input,
    /// Must be 0.
    pub reserved: [u64; 4],
    /// What one metre along the world's x axis becomes in the outputs: axes and rules are those of
    /// shx_sample_def. Default (1, 0, 0).
    pub x_axis: [f64; 3],
    /// The same of the y axis. Default (0, 1, 0).
    pub y_axis: [f64; 3],
    /// The same of the z axis. Default (0, 0, 1).
    pub z_axis: [f64; 3],
    /// Added to positions at last, in your units. Default 0.
    pub translation: [f64; 3],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_render_view {
    const FIRST_SIZE: usize = std::mem::offset_of!(Self, x_axis);

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            first_strand: 0,
            strand_count: usize::MAX,
            origin: [0.0; 3],
            previous_pose: std::ptr::null(),
            interval: 0.0,
            roots: NO_INPUT,
            previous_roots: NO_INPUT,
            reserved: [0; 4],
            x_axis: [1.0, 0.0, 0.0],
            y_axis: [0.0, 1.0, 0.0],
            z_axis: [0.0, 0.0, 1.0],
            translation: [0.0; 3],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_render_view>() == 256 && std::mem::offset_of!(shx_render_view, origin) == 24);
    assert!(std::mem::offset_of!(shx_render_view, previous_pose) == 48 && std::mem::offset_of!(shx_render_view, roots) == 64);
    assert!(std::mem::offset_of!(shx_render_view, reserved) == 128);
    assert!(std::mem::offset_of!(shx_render_view, x_axis) == 160);
};

/// Fills *view with defaults. size is sizeof(shx_render_view).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_render_view_init(view: *mut shx_render_view, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that view holds size bytes.
    unsafe { initialise("shx_render_view_init", "view", view, size) }
}

impl shx_render_view {
    /// Roots that the host gives, one for each of `count` strands.
    ///
    /// # Safety
    /// The input's memory is there.
    pub(super) unsafe fn roots_of(argument: &str, input: &shx_input, count: usize) -> Result<Option<Reader>> {
        if is_absent(input) {
            return Ok(None);
        }
        // SAFETY: the same.
        let reader = unsafe { Reader::new(argument, input, PLACE_FORMATS)? };
        if reader.count() != count {
            return Err(Error::invalid(
                format!("{argument}.count"),
                reader.count(),
                format!("0 or {count}, one for each strand"),
            ));
        }
        Ok(Some(reader))
    }
}
