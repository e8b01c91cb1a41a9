//! Hair types, sliders, and random variation between the strands of a head.

use std::ffi::{CStr, c_char};
use std::mem::{offset_of, size_of};

use crate::capi::base::buffers::{OutputList, Strided, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::MAX_COUNT;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::capi::hair::materials::with_material;
use crate::capi::simulation::solver_def::check_reserved;
use crate::error::{Error, Result};
use crate::groom::hair::hair_parameters::{CurlFormula, HairParameters, Sliders};
use crate::groom::hair::hair_type::{HairType, MeasuredHair};
use crate::groom::hair::variation::Variation;

/// Natural curvatures are those of the measured helix.
pub const SHX_CURL_EXACT: u32 = 0;
/// Natural curvatures by the formula of Bertails et al. 2006, for pitches much smaller than the helix radius.
pub const SHX_CURL_BERTAILS: u32 = 1;

/// A type of hair: measured properties, and how strands vary. Fill it
/// with shx_hair_type_init or shx_hair_type_from_name.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_hair_type {
    /// Set by shx_hair_type_init.
    pub struct_size: u32,
    /// SHX_CURL_. Default SHX_CURL_EXACT.
    pub curl: u32,
    /// Mean radius of the cross-section, sqrt(a1 a2), m; above 0.
    pub mean_radius: f64,
    /// Ratio of the longer to the shorter semi-axis; 1 or above.
    pub ellipticity: f64,
    /// Radius of the helix that the tip of a lock forms, m. 0: straight; helix_pitch must be 0 then.
    pub helix_radius: f64,
    /// Pitch of that helix, m; 0 or above.
    pub helix_pitch: f64,
    /// Young's modulus, Pa; above 0.
    pub youngs_modulus: f64,
    /// Poisson's ratio; above -1, at most 0.5.
    pub poisson_ratio: f64,
    /// Density, kg/m^3; above 0.
    pub density: f64,
    /// Internal friction gamma, kg m^3/s; 0 or above.
    pub internal_friction: f64,
    /// Air drag nu, kg/(m s); 0 or above.
    pub air_drag: f64,
    /// Factor on the default Coulomb coefficients of shx_strand_contact; 0 or above.
    pub friction: f64,
    /// Variation of natural twist and curvature between strands:
    /// standard deviation over mean, 0 (default) to 0.25.
    pub variation_between: f64,
    /// Variation of natural twist and curvature along a strand; the same measure and range.
    pub variation_along: f64,
    /// Variation of the radius between strands; the same measure and range.
    pub variation_thickness: f64,
    /// Natural curvature in random directions that is added along a strand:
    /// standard deviation, rad/m; 0 (default) or above.
    pub frizz: f64,
    /// Arclength over which properties vary along a strand, m; 1e-4 or above. Default 0.02.
    pub variation_period: f64,
    /// Roots turn about their tangents by up to this angle in either direction, rad; 0 (default) to pi.
    pub root_turn: f64,
    /// Random seed: another seed gives other strands of the same type.
    pub seed: u64,
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_hair_type {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self::of(&MeasuredHair::default())
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_hair_type>() == 176 && offset_of!(shx_hair_type, mean_radius) == 8);
    assert!(offset_of!(shx_hair_type, variation_between) == 88 && offset_of!(shx_hair_type, seed) == 136);
};

impl shx_hair_type {
    pub(super) fn of(hair: &MeasuredHair) -> Self {
        let none = Variation::none();
        Self {
            struct_size: size_of::<Self>() as u32,
            curl: SHX_CURL_EXACT,
            mean_radius: hair.mean_radius,
            ellipticity: hair.ellipticity,
            helix_radius: hair.helix_radius,
            helix_pitch: hair.helix_step,
            youngs_modulus: hair.youngs_modulus,
            poisson_ratio: hair.poisson_ratio,
            density: hair.density,
            internal_friction: hair.internal_friction,
            air_drag: hair.air_drag,
            friction: hair.friction,
            variation_between: none.between,
            variation_along: none.along,
            variation_thickness: none.thickness,
            frizz: none.frizz,
            variation_period: none.period,
            root_turn: none.root_turn,
            seed: 0,
            reserved: [0; 4],
        }
    }

    fn parameters(&self, argument: &str) -> Result<HairParameters> {
        check_reserved(argument, &self.reserved)?;
        let formula = match self.curl {
            SHX_CURL_EXACT => CurlFormula::Exact,
            SHX_CURL_BERTAILS => CurlFormula::Paper,
            other => return Err(Error::invalid(format!("{argument}.curl"), other, "one of SHX_CURL_")),
        };
        let measured = MeasuredHair {
            mean_radius: self.mean_radius,
            ellipticity: self.ellipticity,
            helix_radius: self.helix_radius,
            helix_step: self.helix_pitch,
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
            density: self.density,
            internal_friction: self.internal_friction,
            air_drag: self.air_drag,
            friction: self.friction,
        };
        let variation = Variation {
            between: self.variation_between,
            along: self.variation_along,
            thickness: self.variation_thickness,
            frizz: self.frizz,
            period: self.variation_period,
            root_turn: self.root_turn,
            seed: self.seed,
        };
        let in_words = |error: Error| error.renamed("hair", argument).with_fields(&[("helix_step", "helix_pitch")]);
        let parameters = HairParameters { variation, ..measured.parameters(formula).map_err(in_words)? };
        parameters.check("hair").map_err(in_words)?;
        Ok(parameters)
    }
}

/// High-level sliders, each from -1 to 1; 0 (default) changes nothing. docs/theory/hair_types.md describes
/// their effects. Fill it with shx_hair_sliders_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_hair_sliders {
    /// Set by shx_hair_sliders_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Natural curvature and twist.
    pub curliness: f64,
    /// Young's modulus.
    pub stiffness: f64,
    /// Less variation, frizz and air drag.
    pub discipline: f64,
    /// Density.
    pub weight: f64,
    /// Less friction.
    pub combing_ease: f64,
    /// Must be 0.
    pub reserved: [u64; 2],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_hair_sliders {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            curliness: 0.0,
            stiffness: 0.0,
            discipline: 0.0,
            weight: 0.0,
            combing_ease: 0.0,
            reserved: [0; 2],
        }
    }
}

const _: () = assert!(size_of::<shx_hair_sliders>() == 64 && offset_of!(shx_hair_sliders, combing_ease) == 40);

/// Fills *hair with Caucasian hair (type 1) without variation. size is sizeof(shx_hair_type).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_type_init(hair: *mut shx_hair_type, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that hair holds size bytes.
    unsafe { initialise("shx_hair_type_init", "hair", hair, size) }
}

/// Fills *sliders with defaults. size is sizeof(shx_hair_sliders).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_sliders_init(sliders: *mut shx_hair_sliders, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that sliders holds size bytes.
    unsafe { initialise("shx_hair_sliders_init", "sliders", sliders, size) }
}

/// Writes a measured type of hair, without variation, to out_hair, which shx_hair_type_init has
/// filled: "asian", "caucasian1", "caucasian2", "african" (Bertails et al. 2006, appendix B), "h1",
/// "h2", "ga1", "gc3" (Bonanni and Kmoch 2008, table 1).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (name).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_type_from_name(name: *const c_char, out_hair: *mut shx_hair_type) -> shx_result {
    call("shx_hair_type_from_name", || {
        if name.is_null() {
            return Err(Error::NullArgument { argument: "name".into() });
        }
        // SAFETY: a text that is closed by a zero, and the caller's structure of the size that it states.
        let (name, output) = unsafe { (CStr::from_ptr(name), VersionedOutput::new("out_hair", out_hair)?) };
        let kind = HairType::from_name(&name.to_string_lossy())?;
        output.write(&shx_hair_type::of(&kind.measured()));
        Ok(())
    })
}

/// Properties of a generated strand. Copy the first seven to a shx_strand_def, rotate its
/// root frame about the tangent (the x axis of the frame) by root_turn, and copy
/// friction_along and friction_against to a shx_strand_contact.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_hair_strand {
    /// Semi-axes of the cross-section along n1 and n2, m.
    pub radius: [f64; 2],
    /// Density, kg/m^3.
    pub density: f64,
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
    /// Internal friction gamma, kg m^3/s.
    pub internal_friction: f64,
    /// Kelvin-Voigt damping time mu, s.
    pub viscosity: f64,
    /// Air drag nu, kg/(m s).
    pub air_drag: f64,
    /// Rotation of the root frame about the tangent, rad.
    pub root_turn: f64,
    /// Coulomb coefficient from root to tip, against bodies and hair.
    pub friction_along: f64,
    /// The same from tip to root, against the scales.
    pub friction_against: f64,
}

const _: () = assert!(size_of::<shx_hair_strand>() == 88 && offset_of!(shx_hair_strand, root_turn) == 64);

/// Strands to generate. Fill it with shx_hair_strands_def_init, then set hair_type, strand_count,
/// element_counts and element_lengths. The library reads what it points to during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_hair_strands_def {
    /// Set by shx_hair_strands_def_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Type of hair. Default null: set it.
    pub hair_type: *const shx_hair_type,
    /// Sliders. Null (default): all 0.
    pub sliders: *const shx_hair_sliders,
    /// Number of the first strand; the others follow. The same number always gives the same strand. Default 0.
    pub first_strand: u64,
    /// Number of strands. Default 0: set it.
    pub strand_count: usize,
    /// Number of elements of each strand, 1 or more; strand_count numbers. Default null: set it.
    pub element_counts: *const u32,
    /// Lengths of all elements, strand by strand, m. Default null: set it.
    pub element_lengths: *const f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and pointers only.
unsafe impl Versioned for shx_hair_strands_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            hair_type: std::ptr::null(),
            sliders: std::ptr::null(),
            first_strand: 0,
            strand_count: 0,
            element_counts: std::ptr::null(),
            element_lengths: std::ptr::null(),
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<shx_hair_strands_def>() == 56 && offset_of!(shx_hair_strands_def, first_strand) == 24);

/// Fills *def with defaults. size is sizeof(shx_hair_strands_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_strands_def_init(def: *mut shx_hair_strands_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_hair_strands_def_init", "def", def, size) }
}

/// Generates strands of a hair type. Item i of out_strands (stride bytes apart, 0: tightly packed) has the
/// properties of strand i. Its natural twist and curvatures, rad/m, go to out_curvatures (rows of three
/// doubles, one per element, strand by strand), which holds capacity rows.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_strands(
    def: *const shx_hair_strands_def,
    out_strands: *mut shx_hair_strand,
    stride: usize,
    out_curvatures: *mut f64,
    capacity: usize,
) -> shx_result {
    call("shx_hair_strands", || {
        // SAFETY: the caller's structures, of the sizes that they state.
        let def = unsafe { read_versioned("def", def)? };
        if def.reserved0 != 0 {
            return Err(Error::invalid("def.reserved0", def.reserved0, "0"));
        }
        // SAFETY: the same.
        let mut parameters = unsafe { read_versioned("def.hair_type", def.hair_type)?.parameters("def.hair_type")? };
        if !def.sliders.is_null() {
            // SAFETY: the same.
            let sliders = unsafe { read_versioned("def.sliders", def.sliders)? };
            if sliders.reserved0 != 0 {
                return Err(Error::invalid("def.sliders.reserved0", sliders.reserved0, "0"));
            }
            check_reserved("def.sliders", &sliders.reserved)?;
            let moved = parameters.with_sliders(&Sliders {
                curliness: sliders.curliness,
                stiffness: sliders.stiffness,
                discipline: sliders.discipline,
                weight: sliders.weight,
                combing_ease: sliders.combing_ease,
            });
            parameters = moved.map_err(|error| error.inside("def"))?;
        }
        // SAFETY: the caller's arrays.
        let counts = unsafe { array("def.element_counts", "def.strand_count", def.element_counts, def.strand_count)? };
        if let Some(index) = counts.iter().position(|count| *count == 0) {
            return Err(Error::invalid(format!("def.element_counts[{index}]"), 0, "1 or more"));
        }
        let total = counts.iter().try_fold(0_usize, |sum, count| sum.checked_add(*count as usize));
        let Some(total) = total.filter(|total| *total <= MAX_COUNT) else {
            return Err(Error::invalid("def.element_counts", "too many elements", format!("at most {MAX_COUNT}")));
        };
        // SAFETY: the caller's arrays, and memory for strand_count items and capacity rows.
        let (lengths, made, rows) = unsafe {
            (
                array("def.element_lengths", "def.element_counts", def.element_lengths, total)?,
                Strided::new("out_strands", "def.strand_count", out_strands, stride, def.strand_count)?,
                OutputList::new("out_curvatures", "capacity", out_curvatures.cast::<[f64; 3]>(), capacity)?,
            )
        };
        rows.check_room(total)?;
        let friction = parameters.contact().hair_friction;
        let (mut all, mut natural) = (Vec::with_capacity(def.strand_count), Vec::with_capacity(total));
        let mut first = 0;
        for (index, count) in counts.iter().enumerate() {
            let end = first + *count as usize;
            let number = def.first_strand.wrapping_add(index as u64);
            let strand = parameters.strand(number, &lengths[first..end]).map_err(|error| match error {
                Error::InvalidArgument { argument, value, expected } if argument.starts_with("element_lengths") => {
                    Error::invalid(format!("def.element_lengths (strand {index}, {argument})"), value, expected)
                }
                other => other,
            })?;
            all.push(with_material!(shx_hair_strand, &strand.material, {
                root_turn: strand.root_turn,
                friction_along: friction.along,
                friction_against: friction.against,
            }));
            natural.extend(strand.natural);
            first = end;
        }
        rows.write(&natural)?;
        made.write_all(all.into_iter())
    })
}
