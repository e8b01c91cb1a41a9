//! Wind as a field.

use std::ffi::c_void;
use std::sync::Arc;

use crate::capi::base::errors::shx_result;
use crate::capi::base::floating_point::with_host_mode;
use crate::capi::base::guard::{shx_solver, write};
use crate::solver::WindField;

/// Your field of wind. positions has x, y, z of count points, at most 1024, in m, world. Write the air's
/// velocity at each of them (x, y, z in m/s, world) to velocities, which comes filled with zeros. seconds is
/// the time since the call of shx_solver_step began: add your own clock. It runs on the thread that called
/// shx_solver_step, in that thread's floating-point mode. It must not call the same solver (SHX_ERROR_BUSY),
/// and it must return normally: no exceptions, no longjmp.
pub type shx_wind_fn =
    Option<unsafe extern "C" fn(user: *mut c_void, seconds: f64, positions: *const f64, velocities: *mut f64, count: usize)>;

type HostFunction = unsafe extern "C" fn(*mut c_void, f64, *const f64, *mut f64, usize);

/// The host's function and its pointer.
struct HostWind {
    function: HostFunction,
    user: *mut c_void,
}

// SAFETY: user is the host's pointer, handed back and never looked at; the host may be called from any thread that steps the solver.
unsafe impl Send for HostWind {}
// SAFETY: as above.
unsafe impl Sync for HostWind {}

impl WindField for HostWind {
    fn velocities(&self, seconds: f64, positions: &[[f64; 3]], velocities: &mut [[f64; 3]]) {
        let count = positions.len().min(velocities.len());
        let (positions, velocities) = (positions.as_ptr().cast::<f64>(), velocities.as_mut_ptr().cast::<f64>());
        // SAFETY: the host's function, called as its type says, with arrays of count times three doubles that outlive the call.
        with_host_mode(|| unsafe { (self.function)(self.user, seconds, positions, velocities, count) });
    }
}

/// Adds a field of wind to the uniform wind, in place of the field that there was. Null removes it; without
/// one nothing is called and nothing is paid. Both pointers must remain valid until then, or until the solver
/// is destroyed.
/// Before each substep the field is called once for every batch of points of the strands that have air_drag
/// and are not frozen: strand by strand in the order in which they were added, from root to tip, on the
/// calling thread. So results are identical to the bit for any number of threads, and a constant field gives
/// the bits of the same uniform wind. Points are where they will be at the end of the substep if they keep
/// their velocities, and seconds is that end, so the order of the integrator remains. Pieces of a subdivided
/// substep share these velocities. A velocity that is not finite makes its strand non-finite, which is rolled
/// back and quarantined.
/// Snapshots do not contain the field: shx_solver_restore leaves it as it is, and the same steps follow only
/// if your field gives the same velocities. shx_solver_settle ignores it. SHX_INTEGRATOR_REFERENCE does not
/// support it: shx_solver_step then fails with SHX_ERROR_UNSUPPORTED.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_wind_field(
    solver: *mut shx_solver,
    function: shx_wind_fn,
    user: *mut c_void,
) -> shx_result {
    // SAFETY: the caller's handle, null or alive.
    unsafe {
        write("shx_solver_set_wind_field", solver, |core, _| {
            core.set_wind_field(function.map(|function| Arc::new(HostWind { function, user }) as Arc<dyn WindField>));
            Ok(())
        })
    }
}
