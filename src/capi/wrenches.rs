//! Writes wrenches on follicles and bodies to the caller's memory.

use super::buffers::{VECTOR_FORMATS, Writer, each};
use super::types::shx_output;
use crate::error::{Error, Result};
use crate::solver::report::Wrench;

/// Writes the wrench of each of `count` things; one of the two outputs may be null.
///
/// # Safety
/// As [`Writer::optional`], for both outputs.
pub(crate) unsafe fn write_wrenches<I: Copy>(
    count: usize,
    forces: *const shx_output,
    torques: *const shx_output,
    ids: impl FnOnce() -> Result<Vec<I>>,
    wrench: impl Fn(I) -> Result<Wrench>,
) -> Result<()> {
    if forces.is_null() && torques.is_null() {
        return Err(Error::NullArgument { argument: "forces (and torques)".into() });
    }
    let ids = ids()?;
    // SAFETY: the caller's outputs, as it says.
    let (forces, torques) = unsafe {
        (Writer::optional("forces", forces, VECTOR_FORMATS, count)?, Writer::optional("torques", torques, VECTOR_FORMATS, count)?)
    };
    for (index, wrench) in each(&ids, wrench)?.into_iter().enumerate() {
        if let Some(forces) = &forces {
            forces.vector(index, wrench.force.into());
        }
        if let Some(torques) = &torques {
            torques.vector(index, wrench.torque.into());
        }
    }
    Ok(())
}
