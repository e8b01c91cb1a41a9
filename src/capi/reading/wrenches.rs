//! Writes wrenches on follicles and bodies to the caller's memory.

use crate::capi::base::buffers::{VECTOR_FORMATS, Writer, of_one};
use crate::capi::base::types::shx_output;
use crate::error::{Error, Result};
use crate::solver::report::Wrench;

/// Writes the wrench of each of the ids; one of the two outputs may be null.
///
/// # Safety
/// As [`Writer::optional`], for both outputs.
pub(crate) unsafe fn write_wrenches<I: Copy>(
    forces: *const shx_output,
    torques: *const shx_output,
    ids: &[I],
    wrench: impl Fn(I) -> Result<Wrench>,
) -> Result<()> {
    if forces.is_null() && torques.is_null() {
        return Err(Error::NullArgument { argument: "forces (and torques)".into() });
    }
    // SAFETY: the caller's outputs, as it says.
    let (forces, torques) = unsafe {
        let of = |argument, output| Writer::optional(argument, output, VECTOR_FORMATS, ids.len());
        (of("forces", forces)?, of("torques", torques)?)
    };
    // An unknown id is an error before anything is written.
    (0..ids.len()).try_for_each(|index| of_one(ids, index, &wrench).map(drop))?;
    for index in 0..ids.len() {
        let wrench = of_one(ids, index, &wrench)?;
        if let Some(forces) = &forces {
            forces.vector(index, wrench.force.into());
        }
        if let Some(torques) = &torques {
            torques.vector(index, wrench.torque.into());
        }
    }
    Ok(())
}
