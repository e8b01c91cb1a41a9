//! Materials of simulated strands.

use std::mem::size_of;

use crate::capi::base::buffers::strand_ids;
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::shx_strand_id;
use crate::capi::base::versioned::{Versioned, VersionedOutput, definitions, initialise};
use crate::error::{Error, Result};
use crate::rod::material::Material;
use crate::solver::id::StrandId;

/// A structure of a material's fields and of others, see [`material_of`].
macro_rules! with_material {
    ($structure:ident, $material:expr, { $($field:ident: $value:expr),* $(,)? }) => {{
        let material: &$crate::rod::material::Material = $material;
        $structure {
            radius: material.radius,
            density: material.density,
            youngs_modulus: material.youngs_modulus,
            poisson_ratio: material.poisson_ratio,
            internal_friction: material.internal_friction,
            viscosity: material.viscosity,
            air_drag: material.air_drag,
            $($field: $value,)*
        }
    }};
}
pub(in crate::capi) use with_material;

/// The material, unchecked, of a structure that has its fields: C structures have them flat, each at its own place.
macro_rules! material_of {
    ($structure:expr) => {{
        let structure = $structure;
        $crate::rod::material::Material {
            radius: structure.radius,
            density: structure.density,
            youngs_modulus: structure.youngs_modulus,
            poisson_ratio: structure.poisson_ratio,
            internal_friction: structure.internal_friction,
            viscosity: structure.viscosity,
            air_drag: structure.air_drag,
        }
    }};
}
pub(super) use material_of;

/// Cross-section and material of a strand, as in shx_strand_def. Fill it
/// with shx_material_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_material {
    /// Set by shx_material_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Semi-axes of the cross-section along n1 and n2, m; above zero. Default 50e-6, 50e-6.
    pub radius: [f64; 2],
    /// Density, kg/m^3; above zero. Default 1300.
    pub density: f64,
    /// Young's modulus, Pa; above zero. Default 2e9.
    pub youngs_modulus: f64,
    /// Poisson's ratio; above -1, at most 0.5. Default 0.48.
    pub poisson_ratio: f64,
    /// Internal friction gamma, kg m^3/s; zero or above. Default 0.
    pub internal_friction: f64,
    /// Kelvin-Voigt damping time mu, s; zero or above. Default 0.
    pub viscosity: f64,
    /// Air drag nu, kg/(m s); zero or above. Default 0.
    pub air_drag: f64,
}

const _: () = assert!(size_of::<shx_material>() == 72);

// SAFETY: repr(C), a u32 first, no padding (asserted above), integers and doubles only.
unsafe impl Versioned for shx_material {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self::of(&Material::default())
    }
}

impl shx_material {
    pub(super) fn of(material: &Material) -> Self {
        with_material!(shx_material, material, { struct_size: size_of::<Self>() as u32, reserved0: 0 })
    }

    pub(super) fn material(&self, argument: &str) -> Result<Material> {
        if self.reserved0 != 0 {
            return Err(Error::invalid(format!("{argument}.reserved0"), self.reserved0, "0"));
        }
        let material = material_of!(self);
        material.check(argument)?;
        Ok(material)
    }
}

/// Fills *material with defaults. size is sizeof(shx_material).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_material_init(material: *mut shx_material, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that material holds size bytes.
    unsafe { initialise("shx_material_init", "material", material, size) }
}

/// Changes the cross-sections and materials of count living strands, as if they had been created with them.
/// Material i starts i * def_stride bytes after the first; def_stride is usually sizeof(shx_material).
/// def_count is count, or 1: one material for all. Shapes, natural shapes, velocities, degrees of freedom and
/// contact radii (shx_solver_set_strand_contact) stay. A strand at rest is no longer in equilibrium:
/// shx_solver_adopt_rest_shapes makes its shape a rest shape again.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "defs[3].density").
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_materials(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    defs: *const shx_material,
    def_stride: usize,
    def_count: usize,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and def_count structures.
    unsafe {
        write("shx_solver_set_materials", solver, |core, _| {
            let ids = strand_ids(ids, count)?;
            if def_count != count && def_count != 1 {
                return Err(Error::invalid("def_count", def_count, format!("{count}, one per strand, or 1 for all")));
            }
            let read = |def: &shx_material, argument: &str| def.material(argument);
            let materials = definitions("shx_material", defs, def_stride, def_count, read)?;
            core.set_materials(&ids, &materials)
        })
    }
}

/// Writes the current cross-section and material of a strand to
/// out_material, which shx_material_init has filled.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_material(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_material: *mut shx_material,
) -> shx_result {
    // SAFETY: the caller's handle and place for a material of the size that it states.
    unsafe {
        read("shx_solver_get_material", solver, |core| {
            let place = VersionedOutput::new("out_material", out_material)?;
            place.write(&shx_material::of(core.material(StrandId::from_bits(id.bits))?));
            Ok(())
        })
    }
}
