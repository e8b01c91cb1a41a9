//! Follicles on a mesh: scattered, or by texture coordinates; their frames as the mesh deforms.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use super::buffers::{POINT_FORMATS, Place, Places, Reader, Writer, array};
use super::errors::shx_result;
use super::guard::call;
use super::render_def::NO_INPUT;
use super::solver_def::check_reserved;
use super::types::{SHX_FORMAT_FRAME, shx_input, shx_output};
use super::versioned::{Versioned, initialise, read_versioned};
use crate::error::{Error, Result};
use crate::groom::guide_roots::GuideRoots;
use crate::groom::scalp::{Amount, Density, Follicle, Jitter, RootRegion, Scalp, ScatterOptions};

/// A triangle mesh at rest, on which follicles stand. Made by shx_scalp_create, owned by the caller, freed by shx_scalp_destroy. It never
/// changes, so any threads may use it at the same time.
pub struct shx_scalp(Scalp);

/// A place on a triangle of a scalp.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct shx_follicle {
    /// The triangle's number.
    pub triangle: u32,
    /// 0.
    pub reserved: u32,
    /// Shares of its second and third corner, 0 or above, together at most 1; the first has the rest.
    pub barycentric: [f64; 2],
}

const _: () = assert!(size_of::<shx_follicle>() == 24 && offset_of!(shx_follicle, barycentric) == 8);

impl shx_follicle {
    fn new(follicle: &Follicle) -> Self {
        Self { triangle: follicle.triangle, reserved: 0, barycentric: follicle.shares }
    }
}

/// What a scalp is made of. Prepare with shx_scalp_def_init, then set vertices, triangles and triangle_count. What is pointed to is read
/// during the call and not kept.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_scalp_def {
    /// Set by shx_scalp_def_init.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// Vertices at rest, m: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a fourth number is not looked at).
    pub vertices: shx_input,
    /// Three indices of vertices for each triangle, wound anticlockwise seen from outside.
    pub triangles: *const u32,
    /// How many triangles.
    pub triangle_count: usize,
    /// Null (default), or texture coordinates: u and v of the three corners of each triangle, six doubles a triangle.
    pub uvs: *const f64,
    /// Without texture coordinates: the axis that n1 follows, as it lies on the scalp at rest; any length above zero. Default x.
    pub reference_axis: [f64; 3],
    /// 0.
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

/// How follicles are scattered. Fill with shx_scatter_def_init, then set count or spacing.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_scatter_def {
    /// Set by shx_scatter_def_init.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// So many follicles, as far from each other as they come; 0 (default): by spacing. Up to 10000000.
    pub count: usize,
    /// No two nearer to each other than this, m, along the scalp; where the density is less than the largest, farther. 0 (default): by count.
    pub spacing: f64,
    /// Null (default: even), or relative densities, 0 or above: one for each vertex, or of a picture over the texture coordinates.
    pub density: *const f64,
    /// Of a picture: pixels of a row; 0 (default): a density for each vertex.
    pub density_width: usize,
    /// Of a picture: rows, from v = 0 on.
    pub density_height: usize,
    /// Seed. Default 0.
    pub seed: u64,
    /// count 0 (default: anywhere), or the roots of guides, m: only where they cover the scalp, by how far they are apart, so that faces, ears
    /// and necks stay bare. Formats as shx_scalp_def.vertices. Multiplied with the density.
    pub guide_roots: shx_input,
    /// With guide_roots: instead as near as this to one of them, m. 0 (default): what they cover.
    pub max_guide_distance: f64,
    /// 0.
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

/// Prepares a shx_scalp_def. size is sizeof(shx_scalp_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scalp_def_init(def: *mut shx_scalp_def, size: usize) -> shx_result {
    // SAFETY: the caller says that def holds size bytes.
    unsafe { initialise("shx_scalp_def_init", "def", def, size) }
}

/// Prepares a shx_scatter_def. size is sizeof(shx_scatter_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_scatter_def_init(def: *mut shx_scatter_def, size: usize) -> shx_result {
    // SAFETY: the caller says that def holds size bytes.
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

/// Makes a scalp. *out_scalp is yours; free it with shx_scalp_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT. Any thread.
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
        let place = Place::new("out_scalp", out_scalp)?;
        let scalp = Scalp::new(vertices, corners.to_vec(), uvs, def.reference_axis.into())
            .map_err(|error| error.inside("def").renamed("def.reference", "def.reference_axis"))?;
        place.write(Box::into_raw(Box::new(shx_scalp(scalp))));
        Ok(())
    })
}

/// Frees a scalp. Null is nothing to free. Any thread; nobody may use it any more.
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

/// Scatters follicles over a scalp at rest, evenly ("blue noise") or as densely as a map says, into out_follicles, which holds capacity items.
/// The same def gives the same follicles. *out_count: how many there are. out_follicles may be null, to learn that alone.
/// *out_min_distance (or null): the least distance of two of them along the scalp, m (where the density is the largest; elsewhere times the
/// root of its share of that); infinity where there are none near each other. Takes some 20 microseconds a follicle, 30 of a
/// hundred and fifty thousand or with a spacing.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
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
        let count = Place::new("out_count", out_count)?;
        let follicles = Places::optional("out_follicles", "capacity", out_follicles, capacity)?;
        let distance = Places::optional("out_min_distance", "out_min_distance", out_min_distance, 1)?;
        let amount = match (def.count, def.spacing) {
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
        let made = scalp.scatter(&options).map_err(|error| error.with_fields(&[("within", "max_guide_distance")]).inside("def"))?;
        if let Some(places) = follicles {
            places.write(&made.follicles.iter().map(shx_follicle::new).collect::<Vec<_>>())?;
        }
        if let Some(distance) = distance {
            distance.write(&[made.least_distance])?;
        }
        count.write(made.follicles.len());
        Ok(())
    })
}

/// Where a definition's guides are.
///
/// # Safety
/// What the definition points to is there.
unsafe fn root_region(def: &shx_scatter_def) -> Result<Option<Density>> {
    if def.guide_roots.count == 0 && def.guide_roots.data.is_null() {
        return if def.max_guide_distance == 0.0 { Ok(None) } else { Err(Error::invalid("def.max_guide_distance", def.max_guide_distance, "0 without guide_roots")) };
    }
    // SAFETY: the same.
    let roots = GuideRoots::new(unsafe { places("def.guide_roots", &raw const def.guide_roots)? });
    let roots = roots.map_err(|error| error.renamed("roots", "def.guide_roots"))?;
    let region = if def.max_guide_distance == 0.0 {
        let spacing = roots.spacing();
        let one = || Error::invalid("def.max_guide_distance", 0, "a distance, m: guides that are all at one place are no distance apart");
        RootRegion::Covered(spacing.ok_or_else(one)?)
    } else {
        RootRegion::Within(def.max_guide_distance)
    };
    Ok(Some(Density::Roots(roots, region)))
}

/// The follicles at count texture coordinates (uvs: u and v, two doubles each) into out_follicles, which holds count items. Each is first
/// offset at random by up to jitter in u and in v (0: not; where that would leave the scalp, by less), by the seed: rows show in hair.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (a scalp without texture coordinates, coordinates at which there is no
/// triangle). Any thread.
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
        let places = Places::new("out_follicles", "count", out_follicles, count)?;
        let follicles = scalp.follicles_at(uvs, Jitter { amplitude: jitter, seed })?;
        places.write(&follicles.iter().map(shx_follicle::new).collect::<Vec<_>>())
    })
}

/// The frames of count follicles on the scalp as it is now. vertices: as many as at rest, in their order, m (null: at rest). frames:
/// SHX_FORMAT_FRAME, as shx_solver_set_root_frames and shx_render_view.roots take them: n0 the scalp's normal, n1 the direction in which u
/// grows (or that of shx_scalp_def.reference). A guide whose root is not along the normal has its own rotation in this frame, which the
/// host puts behind it.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (another number of vertices, follicles that are not on the scalp),
/// SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
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
