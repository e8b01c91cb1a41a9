//! Follicles on a mesh: scattered, or by texture coordinates; their frames as the mesh deforms.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use crate::capi::base::buffers::{OutputList, OutputValue, POINT_FORMATS, Reader, Writer, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::{SHX_FORMAT_FRAME, shx_input, shx_output};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::capi::render::render_def::NO_INPUT;
use crate::capi::simulation::solver_def::check_reserved;
use crate::error::{Error, Result};
use crate::groom::curves::guide_roots::GuideRoots;
use crate::groom::scalp::{Amount, Density, Follicle, Jitter, RootRegion, Scalp, ScatterOptions};

/// A triangle mesh at rest that carries follicles. shx_scalp_create makes it, you own it, shx_scalp_destroy
/// frees it. Immutable: any number of threads may use it at once.
pub struct shx_scalp(Scalp);

/// A point on a triangle of a scalp.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct shx_follicle {
    /// Index of the triangle.
    pub triangle: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Barycentric coordinates of its second and third corner, 0 or
    /// above, sum at most 1; the first corner has the rest.
    pub barycentric: [f64; 2],
}

const _: () = assert!(size_of::<shx_follicle>() == 24 && offset_of!(shx_follicle, barycentric) == 8);

impl shx_follicle {
    fn new(follicle: &Follicle) -> Self {
        Self { triangle: follicle.triangle, reserved: 0, barycentric: follicle.shares }
    }
}

/// Definition of a scalp. Fill it with shx_scalp_def_init, then set vertices, triangles and triangle_count.
/// The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_scalp_def {
    /// Set by shx_scalp_def_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Vertices at rest, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is ignored).
    pub vertices: shx_input,
    /// Three vertex indices per triangle, counter-clockwise seen from outside.
    pub triangles: *const u32,
    /// Number of triangles.
    pub triangle_count: usize,
    /// Texture coordinates: u and v of the three corners of each
    /// triangle, six doubles per triangle. Null (default): none.
    pub uvs: *const f64,
    /// Without texture coordinates: the direction that n1 follows along the
    /// scalp at rest; any length above zero. Default x.
    pub reference_axis: [f64; 3],
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_scalp_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            vertices: NO_INPUT,
            triangles: std::ptr::null(),
            triangle_count: 0,
            uvs: std::ptr::null(),
            reference_axis: [1.0, 0.0, 0.0],
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_scalp_def>() == 120 && offset_of!(shx_scalp_def, triangles) == 40);
    assert!(offset_of!(shx_scalp_def, uvs) == 56 && offset_of!(shx_scalp_def, reserved) == 88);
};

/// How to scatter follicles. Fill it with shx_scatter_def_init, then set count or spacing.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_scatter_def {
    /// Set by shx_scatter_def_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Number of follicles, spread as far apart as possible; up to 10000000. 0 (default): use spacing.
    pub count: usize,
    /// Minimum distance between follicles along the scalp, m; larger where the
    /// density is below its maximum. 0 (default): use count.
    pub spacing: f64,
    /// Relative densities, 0 or above: one per vertex, or an image over
    /// the texture coordinates. Null (default): uniform.
    pub density: *const f64,
    /// Image: pixels per row. 0 (default): one density per vertex.
    pub density_width: usize,
    /// Image: rows, starting at v = 0.
    pub density_height: usize,
    /// Random seed. Default 0.
    pub seed: u64,
    /// Roots of guides, m: follicles only where guides cover the scalp, judged by their spacing, so
    /// that faces, ears and necks stay bare. It multiplies the density. Formats as
    /// shx_scalp_def.vertices. count 0 (default): everywhere.
    pub guide_roots: shx_input,
    /// With guide_roots: follicles only within this distance of a guide root,
    /// m. 0 (default): the region that the guides cover.
    pub max_guide_distance: f64,
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_scatter_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            count: 0,
            spacing: 0.0,
            density: std::ptr::null(),
            density_width: 0,
            density_height: 0,
            seed: 0,
            guide_roots: NO_INPUT,
            max_guide_distance: 0.0,
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_scatter_def>() == 128 && offset_of!(shx_scatter_def, density) == 24);
    assert!(offset_of!(shx_scatter_def, seed) == 48 && offset_of!(shx_scatter_def, reserved) == 96);
};

/// Fills *def with defaults. size is sizeof(shx_scalp_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scalp_def_init(def: *mut shx_scalp_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_scalp_def_init", "def", def, size) }
}

/// Fills *def with defaults. size is sizeof(shx_scatter_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scatter_def_init(def: *mut shx_scatter_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_scatter_def_init", "def", def, size) }
}

/// # Safety
/// `scalp` is null or alive.
unsafe fn scalp_from<'a>(scalp: *const shx_scalp) -> Result<&'a Scalp> {
    // SAFETY: the same.
    unsafe { scalp.as_ref() }.map(|scalp| &scalp.0).ok_or_else(|| Error::NullArgument { argument: "scalp".into() })
}

/// # Safety
/// `vertices` is null or a shx_input whose memory is there.
unsafe fn places(argument: &str, vertices: *const shx_input) -> Result<Vec<Vector3<f64>>> {
    // SAFETY: the same.
    let reader = unsafe { Reader::new(argument, vertices, POINT_FORMATS)? };
    Ok((0..reader.count()).map(|index| reader.point(index).into()).collect())
}

/// Creates a scalp. You own *out_scalp; free it with shx_scalp_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scalp_create(def: *const shx_scalp_def, out_scalp: *mut *mut shx_scalp) -> shx_result {
    // SAFETY: the caller's structure, what it points to, and place for one pointer.
    call("shx_scalp_create", || unsafe {
        let def = read_versioned("def", def)?;
        if def.reserved0 != 0 {
            return Err(Error::invalid("def.reserved0", def.reserved0, "0"));
        }
        check_reserved("def", &def.reserved)?;
        let vertices = places("def.vertices", &raw const def.vertices)?;
        let corners = array("def.triangles", "def.triangle_count", def.triangles.cast::<[u32; 3]>(), def.triangle_count)?;
        let uvs = if def.uvs.is_null() {
            None
        } else {
            Some(array("def.uvs", "def.triangle_count", def.uvs.cast::<[[f64; 2]; 3]>(), def.triangle_count)?.to_vec())
        };
        let place = OutputValue::new("out_scalp", out_scalp)?;
        let scalp = Scalp::new(vertices, corners.to_vec(), uvs, def.reference_axis.into())
            .map_err(|error| error.inside("def").renamed("def.reference", "def.reference_axis"))?;
        place.write(Box::into_raw(Box::new(shx_scalp(scalp))));
        Ok(())
    })
}

/// Frees a scalp. Null is allowed.
/// Threads: any. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scalp_destroy(scalp: *mut shx_scalp) {
    call("shx_scalp_destroy", || {
        if !scalp.is_null() {
            // SAFETY: made by Box::into_raw in shx_scalp_create.
            drop(unsafe { Box::from_raw(scalp) });
        }
        Ok(())
    });
}

/// Scatters follicles over a scalp at rest with blue noise, uniformly or by density, into out_follicles, which
/// holds capacity items, and writes their number to *out_count. With null out_follicles it only returns the
/// number. The same definition gives the same follicles. *out_min_distance (may be null) is the minimum
/// distance of two follicles along the scalp, m, where the density has its maximum (elsewhere it scales with
/// one over the root of the relative density); infinity if no two are close to each other. Takes some 20
/// microseconds per follicle; 30 from 150,000 on or with a spacing.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scalp_scatter(
    scalp: *const shx_scalp,
    def: *const shx_scatter_def,
    out_follicles: *mut shx_follicle,
    capacity: usize,
    out_count: *mut usize,
    out_min_distance: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, structure, what it points to, and places.
    call("shx_scalp_scatter", || unsafe {
        let (scalp, def) = (scalp_from(scalp)?, read_versioned("def", def)?);
        if def.reserved0 != 0 {
            return Err(Error::invalid("def.reserved0", def.reserved0, "0"));
        }
        check_reserved("def", &def.reserved)?;
        let count = OutputValue::new("out_count", out_count)?;
        let follicles = OutputList::optional("out_follicles", "capacity", out_follicles, capacity)?;
        let distance = OutputList::optional("out_min_distance", "out_min_distance", out_min_distance, 1)?;
        let amount = match (def.count, def.spacing) {
            (0, 0.0) => {
                return Err(Error::invalid("def.count (and def.spacing)", 0, "a number of follicles, or a spacing above 0"));
            }
            (0, spacing) => Amount::Spacing(spacing),
            (count, 0.0) => Amount::Count(count),
            (_, spacing) => return Err(Error::invalid("def.spacing", spacing, "0 with a count")),
        };
        let density = if def.density.is_null() {
            Density::Uniform
        } else if def.density_width == 0 {
            Density::Vertices(array("def.density", "def.density", def.density, scalp.vertices().len())?.to_vec())
        } else {
            let pixels = def.density_width.checked_mul(def.density_height);
            let pixels = pixels.ok_or_else(|| Error::invalid("def.density_height", def.density_height, "fewer rows"))?;
            let values = array("def.density", "def.density_height", def.density, pixels)?.to_vec();
            Density::Picture { width: def.density_width, height: def.density_height, values }
        };
        let density = match root_region(&def)? {
            Some(region) => Density::Product(vec![density, region]),
            None => density,
        };
        if let (Amount::Count(needed), Some(places)) = (amount, &follicles) {
            places.check_room(needed)?;
        }
        let options = ScatterOptions { amount, density, seed: def.seed };
        let made =
            scalp.scatter(&options).map_err(|error| error.with_fields(&[("within", "max_guide_distance")]).inside("def"))?;
        if let Some(places) = follicles {
            places.write_all(made.follicles.iter().map(shx_follicle::new))?;
        }
        if let Some(distance) = distance {
            distance.write(&[made.least_distance])?;
        }
        count.write(made.follicles.len());
        Ok(())
    })
}

/// The region of a definition's guides.
///
/// # Safety
/// What the definition points to is there.
unsafe fn root_region(def: &shx_scatter_def) -> Result<Option<Density>> {
    if def.guide_roots.count == 0 && def.guide_roots.data.is_null() {
        return if def.max_guide_distance == 0.0 {
            Ok(None)
        } else {
            Err(Error::invalid("def.max_guide_distance", def.max_guide_distance, "0 without guide_roots"))
        };
    }
    // SAFETY: the same.
    let roots = GuideRoots::new(unsafe { places("def.guide_roots", &raw const def.guide_roots)? });
    let roots = roots.map_err(|error| error.renamed("roots", "def.guide_roots"))?;
    let region = if def.max_guide_distance == 0.0 {
        let spacing = roots.spacing();
        let one =
            || Error::invalid("def.max_guide_distance", 0, "above 0: all guide roots are at one point, so they have no spacing");
        RootRegion::Covered(spacing.ok_or_else(one)?)
    } else {
        RootRegion::Within(def.max_guide_distance)
    };
    Ok(Some(Density::Roots(roots, region)))
}

/// Finds the follicles at count texture coordinates (uvs: u and v, two doubles each) and writes count items to
/// out_follicles. Each is first offset randomly, by up to jitter in u and v and less at the edge of the scalp,
/// since regular rows are visible in hair; 0: no offset. seed is the random seed.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (a scalp without
/// texture coordinates, coordinates without a triangle).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scalp_follicles_at_uvs(
    scalp: *const shx_scalp,
    uvs: *const f64,
    count: usize,
    jitter: f64,
    seed: u64,
    out_follicles: *mut shx_follicle,
) -> shx_result {
    // SAFETY: the caller's handle, coordinates and place for count items.
    call("shx_scalp_follicles_at_uvs", || unsafe {
        let scalp = scalp_from(scalp)?;
        let uvs: &[[f64; 2]] = array("uvs", "count", uvs.cast::<[f64; 2]>(), count)?;
        let places = OutputList::new("out_follicles", "count", out_follicles, count)?;
        let follicles = scalp.follicles_at(uvs, Jitter { amplitude: jitter, seed })?;
        places.write_all(follicles.iter().map(shx_follicle::new))
    })
}

/// Writes the frames of count follicles on the deformed scalp to frames (SHX_FORMAT_FRAME), as
/// shx_solver_set_root_frames and shx_render_view.roots take them. vertices: current vertices, as
/// many as at rest and in their order, m; null: at rest. n0 is the normal of the scalp, n1 the
/// direction of increasing u (or of shx_scalp_def.reference_axis). If a guide does not leave along
/// the normal, multiply the frame by its own rotation.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (another number of vertices, follicles that
/// are not on the scalp), SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scalp_root_frames(
    scalp: *const shx_scalp,
    vertices: *const shx_input,
    follicles: *const shx_follicle,
    count: usize,
    frames: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, vertices, follicles and memory for the frames.
    call("shx_scalp_root_frames", || unsafe {
        let scalp = scalp_from(scalp)?;
        let follicles = array("follicles", "count", follicles, count)?;
        let writer = Writer::required("frames", frames, &[SHX_FORMAT_FRAME], count)?;
        for (index, follicle) in follicles.iter().enumerate() {
            if follicle.reserved != 0 {
                return Err(Error::invalid(format!("follicles[{index}].reserved"), follicle.reserved, "0"));
            }
        }
        let moved = if vertices.is_null() { None } else { Some(places("vertices", vertices)?) };
        let own: Vec<_> = follicles.iter().map(|f| Follicle { triangle: f.triangle, shares: f.barycentric }).collect();
        let made = scalp
            .frames(moved.as_deref().unwrap_or_else(|| scalp.vertices()), &own)
            .map_err(|error| error.with_fields(&[("shares", "barycentric")]))?;
        for (index, frame) in made.iter().enumerate() {
            writer.frame(index, frame);
        }
        Ok(())
    })
}
