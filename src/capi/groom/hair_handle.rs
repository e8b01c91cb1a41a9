//! Hair handle: what a hand feels of hair, and the experiment that measures it.

use std::ffi::{CStr, c_char};
use std::mem::{offset_of, size_of};

use super::hair_type::shx_hair_type;
use crate::analysis::combing::CombingTest;
use crate::capi::base::buffers::{OutputList, OutputValue};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::{Error, Result};
use crate::groom::hair::hair_handle::HairHandle;
use crate::groom::hair::hair_type::HairType;

/// Hair handle (Bonanni and Kmoch 2008, section 2): what a hand feels of hair, in the three groups geometry,
/// bending and friction. Fill it with shx_hair_handle_init or shx_hair_handle_from_name.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_hair_handle {
    /// Set by shx_hair_handle_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Geometry: the longer diameter of the cross-section, m; above 0.
    pub major_diameter: f64,
    /// Geometry: ratio of the longer to the shorter diameter; 1 or above.
    pub ellipticity: f64,
    /// Geometry: natural twist, rad/m; 0 where natural_curvature is 0.
    pub natural_twist: f64,
    /// Geometry: natural curvature, rad/m; 0 (straight) or above.
    pub natural_curvature: f64,
    /// Bending stiffness about the longer axis, N m^2; above 0.
    pub bending_stiffness: f64,
    /// Frictional force between hairs, N; 0 or above. 0.00693 stands for the default Coulomb coefficients.
    pub frictional_force: f64,
    /// Internal friction gamma, kg m^3/s; 0 or above.
    pub internal_friction: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_hair_handle {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self::of(&HairType::Ga1.into())
    }
}

const _: () = assert!(size_of::<shx_hair_handle>() == 64 && offset_of!(shx_hair_handle, major_diameter) == 8);

impl shx_hair_handle {
    fn of(handle: &HairHandle) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            major_diameter: handle.major_diameter,
            ellipticity: handle.ellipticity,
            natural_twist: handle.natural_twist,
            natural_curvature: handle.natural_curvature,
            bending_stiffness: handle.bending_stiffness,
            frictional_force: handle.frictional_force,
            internal_friction: handle.internal_friction,
        }
    }

    fn handle(&self) -> Result<HairHandle> {
        if self.reserved0 != 0 {
            return Err(Error::invalid("handle.reserved0", self.reserved0, "0"));
        }
        let handle = HairHandle {
            major_diameter: self.major_diameter,
            ellipticity: self.ellipticity,
            natural_twist: self.natural_twist,
            natural_curvature: self.natural_curvature,
            bending_stiffness: self.bending_stiffness,
            frictional_force: self.frictional_force,
            internal_friction: self.internal_friction,
        };
        handle.check("handle")?;
        Ok(handle)
    }
}

/// Fills *handle with that of hair GA1. size is sizeof(shx_hair_handle).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_handle_init(handle: *mut shx_hair_handle, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that handle holds size bytes.
    unsafe { initialise("shx_hair_handle_init", "handle", handle, size) }
}

/// Writes the handle of a measured type of hair to out_handle, which shx_hair_handle_init has filled. The
/// names are those of shx_hair_type_from_name; "h1", "h2", "ga1" and "gc3" are Bonanni and Kmoch 2008, table
/// 1.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (name).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_handle_from_name(name: *const c_char, out_handle: *mut shx_hair_handle) -> shx_result {
    call("shx_hair_handle_from_name", || {
        if name.is_null() {
            return Err(Error::NullArgument { argument: "name".into() });
        }
        // SAFETY: a text that is closed by a zero, and the caller's structure of the size that it states.
        let (name, output) = unsafe { (CStr::from_ptr(name), VersionedOutput::new("out_handle", out_handle)?) };
        output.write(&shx_hair_handle::of(&HairType::from_name(&name.to_string_lossy())?.into()));
        Ok(())
    })
}

/// Writes handle with two sliders moved, each from -1 to 1 (0 changes nothing), to out_handle, which
/// shx_hair_handle_init has filled; it may be handle itself. curliness acts on natural twist and curvature,
/// combing_ease on both kinds of friction, as the shx_hair_sliders of those names do.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_handle_adjust(
    handle: *const shx_hair_handle,
    curliness: f64,
    combing_ease: f64,
    out_handle: *mut shx_hair_handle,
) -> shx_result {
    call("shx_hair_handle_adjust", || {
        // SAFETY: the caller's structures of the sizes that they state.
        let (handle, output) = unsafe { (read_versioned("handle", handle)?, VersionedOutput::new("out_handle", out_handle)?) };
        output.write(&shx_hair_handle::of(&handle.handle()?.with_sliders(curliness, combing_ease)?));
        Ok(())
    })
}

/// Writes the type of hair that has this handle, without variation, to out_hair, which shx_hair_type_init has
/// filled: shx_hair_strands makes strands of it.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_hair_handle_to_type(handle: *const shx_hair_handle, out_hair: *mut shx_hair_type) -> shx_result {
    call("shx_hair_handle_to_type", || {
        // SAFETY: the caller's structures of the sizes that they state.
        let (handle, output) = unsafe { (read_versioned("handle", handle)?, VersionedOutput::new("out_hair", out_hair)?) };
        output.write(&shx_hair_type::of(&handle.handle()?.measured()));
        Ok(())
    })
}

/// A standard combing experiment. Fill it with shx_combing_test_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_combing_test {
    /// Set by shx_combing_test_init.
    pub struct_size: u32,
    /// Number of hairs side by side, 1 to 1000: forces are those of all together. Default 1.
    pub strand_count: u32,
    /// Number of elements of each, 4 to 1000; no element longer than 5 mm. Default 40.
    pub element_count: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Length of the hairs, m. Default 0.06.
    pub length: f64,
    /// Stroke, m; at most length - 0.025. Default 0.03.
    pub stroke: f64,
    /// Speed of the rods, m/s; above 0. Default 0.01: internal friction counts little then.
    pub speed: f64,
    /// Steps per second; above 0. Default 240.
    pub rate: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_combing_test {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let test = CombingTest::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            strand_count: test.strands,
            element_count: test.elements,
            reserved0: 0,
            length: test.length,
            stroke: test.stroke,
            speed: test.speed,
            rate: test.rate,
        }
    }
}

/// Result of a combing experiment; the means are over the second half of the stroke.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_combing_result {
    /// Number of steps of the stroke, and of entries in each list.
    pub step_count: u64,
    /// Force against the stroke, N: how hard the hair is to comb.
    pub mean_force: f64,
    /// Sum of the forces on the rods across the stroke, N: how stiff it is.
    pub mean_pressure: f64,
    /// mean_force / mean_pressure: how rough it is.
    pub friction: f64,
    /// Work of the stroke, J.
    pub work: f64,
}

const _: () = {
    assert!(size_of::<shx_combing_test>() == 48 && offset_of!(shx_combing_test, length) == 16);
    assert!(size_of::<shx_combing_result>() == 40);
};

impl shx_combing_test {
    fn test(&self) -> Result<CombingTest> {
        if self.reserved0 != 0 {
            return Err(Error::invalid("test.reserved0", self.reserved0, "0"));
        }
        Ok(CombingTest {
            strands: self.strand_count,
            length: self.length,
            stroke: self.stroke,
            speed: self.speed,
            elements: self.element_count,
            rate: self.rate,
        })
    }
}

/// Fills *test with defaults. size is sizeof(shx_combing_test).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_combing_test_init(test: *mut shx_combing_test, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that test holds size bytes.
    unsafe { initialise("shx_combing_test_init", "test", test, size) }
}

/// Combs hair with this handle: hairs hang from clamps, three rods close on them so that each hair bends
/// around them, and are drawn down over it. test may be null: defaults. Writes position, m, force against the
/// stroke, N, and pressure across it, N, of each step to out_stroke, out_force and out_pressure, each of
/// which holds capacity numbers or is null. Takes a fraction of a second with the defaults.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
/// SHX_ERROR_BUFFER_TOO_SMALL (the message has the number of steps).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_combing_test_run(
    test: *const shx_combing_test,
    handle: *const shx_hair_handle,
    out_stroke: *mut f64,
    out_force: *mut f64,
    out_pressure: *mut f64,
    capacity: usize,
    out_result: *mut shx_combing_result,
) -> shx_result {
    call("shx_combing_test_run", || {
        // SAFETY: the caller's structures of the sizes that they state, room for capacity numbers each and for the result.
        let (test, handle, lists, place) = unsafe {
            let test = if test.is_null() { shx_combing_test::defaults() } else { read_versioned("test", test)? };
            let lists = [
                OutputList::optional("out_stroke", "capacity", out_stroke, capacity)?,
                OutputList::optional("out_force", "capacity", out_force, capacity)?,
                OutputList::optional("out_pressure", "capacity", out_pressure, capacity)?,
            ];
            (test.test()?, read_versioned("handle", handle)?.handle()?, lists, OutputValue::new("out_result", out_result)?)
        };
        let in_words = |error: Error| error.with_fields(&[("strands", "strand_count"), ("elements", "element_count")]);
        test.check("test").map_err(in_words)?;
        for list in lists.iter().flatten() {
            list.check_room(test.steps())?;
        }
        let curve = test.run(&handle).map_err(in_words)?;
        for (list, values) in lists.into_iter().zip([&curve.stroke, &curve.force, &curve.pressure]) {
            list.map_or(Ok(()), |list| list.write(values))?;
        }
        place.write(shx_combing_result {
            step_count: curve.stroke.len() as u64,
            mean_force: curve.mean_force(),
            mean_pressure: curve.mean_pressure(),
            friction: curve.friction(),
            work: curve.work(),
        });
        Ok(())
    })
}
