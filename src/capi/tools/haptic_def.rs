//! Definitions of haptic objects, and the state after an update.

use std::mem::{offset_of, size_of};

use crate::capi::base::errors::shx_result;
use crate::capi::base::types::shx_frame;
use crate::capi::base::versioned::{Versioned, initialise};
use crate::error::{Error, Result};
use crate::haptics::{ForceLaw, HapticOptions, HapticState, Mode};

/// The solver steps at its own rate, 60 to 240 Hz. After each step it hands over a local model of the tool's
/// contacts, and shx_haptic_update solves the contact problem of that model for the device's newest pose, at
/// the device's rate.
pub const SHX_HAPTIC_MODE_HAND_OVER: u32 = 1;
/// The solver steps at the device's rate, with few strands: shx_haptic_update returns the wrench of the last
/// step.
pub const SHX_HAPTIC_MODE_DIRECT: u32 = 2;

/// Signorini's law of contact and Coulomb's law of friction: the forces of the simulation's own contacts. The
/// default.
pub const SHX_HAPTIC_FORCE_CONTACT: u32 = 1;
/// The explicit formula of Bonanni and Kmoch (2008): each pressing contact resists the velocity of the tool,
/// by the strand's bending stiffness across it and by its internal friction along it. It costs next to
/// nothing, never drives the hand, works with every contact model, and is zero while the tool stands still.
pub const SHX_HAPTIC_FORCE_EXPLICIT: u32 = 2;

/// The force or the torque was cut to max_force or max_torque.
pub const SHX_HAPTIC_LIMIT_CLAMPED: u32 = 1;
/// It changed as fast as max_force_rate or max_torque_rate allows.
pub const SHX_HAPTIC_LIMIT_RATE: u32 = 2;
/// It was reduced to keep the hand from getting more energy than energy_allowance.
pub const SHX_HAPTIC_LIMIT_PASSIVITY: u32 = 4;
/// The local model is older than max_model_age: the force fades.
pub const SHX_HAPTIC_LIMIT_STALE: u32 = 8;

/// Definition of a haptic object. Fill it with shx_haptic_def_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_haptic_def {
    /// Set by shx_haptic_def_init.
    pub struct_size: u32,
    /// SHX_HAPTIC_MODE_HAND_OVER (default), _DIRECT.
    pub mode: u32,
    /// Frame of the handle in the axes of the first body: device poses are poses of the handle, and torques
    /// are about its origin. Default: the body's own frame.
    pub handle: shx_frame,
    /// Stiffness of the virtual coupling between device and tool, N/m; above zero. Default 500.
    pub stiffness: f64,
    /// Damping of the coupling, N s/m; zero or above. Default 1.
    pub damping: f64,
    /// Stiffness of the coupling in rotation, N m/rad; above zero. Default 1.
    pub angular_stiffness: f64,
    /// Damping of the coupling in rotation, N m s/rad; zero or above. Default 0.002.
    pub angular_damping: f64,
    /// Largest force, N; above zero. Default 5: set it to what your device can hold.
    pub max_force: f64,
    /// Largest torque, N m; above zero. Default 0.2.
    pub max_torque: f64,
    /// Largest rate of change of the force, N/s; above zero. Default 500, 0.5 N per millisecond.
    pub max_force_rate: f64,
    /// Largest rate of change of the torque, N m/s; above zero. Default 20.
    pub max_torque_rate: f64,
    /// Energy that the hand may get beyond what it gave, J; above zero. Default 0.001.
    pub energy_allowance: f64,
    /// Largest energy that the hand is credited with for what it gave, J; zero or above. Default 0.05.
    pub max_energy_credit: f64,
    /// Largest acceleration of the device in a hand, m/s^2; zero or above. The energy that an update can
    /// cost is bounded with it. Default 20.
    pub max_acceleration: f64,
    /// Largest angular acceleration of the device, rad/s^2; zero or above. Default 200.
    pub max_angular_acceleration: f64,
    /// Age from which a local model is too old, s; above zero. The force then fades within the same time.
    /// Default 0.1.
    pub max_model_age: f64,
    /// Maximum number of contacts in a local model, 1 to 4096: those that press hardest. Default 256.
    pub max_contacts: u32,
    /// Maximum number of sweeps over them per update, 1 to 1000. Default 10.
    pub max_sweeps: u32,
    /// SHX_HAPTIC_FORCE_: _CONTACT (default), _EXPLICIT.
    pub force_law: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// SHX_HAPTIC_FORCE_EXPLICIT: time by which the bending stiffness of a strand of length L is multiplied,
    /// s: a contact resists motion across the strand with explicit_time * 3 EI / L^3 N s/m. Zero or above.
    /// Default 0.1.
    pub explicit_time: f64,
    /// SHX_HAPTIC_FORCE_EXPLICIT: it resists motion along the strand with explicit_friction * 3 gamma / L^3
    /// N s/m, where gamma is the internal friction of the strand. Zero or above. Default 1.
    pub explicit_friction: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_haptic_def {
    const FIRST_SIZE: usize = 176;

    fn defaults() -> Self {
        let options = HapticOptions::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            mode: options.mode as u32,
            handle: (&options.handle).into(),
            stiffness: options.stiffness,
            damping: options.damping,
            angular_stiffness: options.angular_stiffness,
            angular_damping: options.angular_damping,
            max_force: options.max_force,
            max_torque: options.max_torque,
            max_force_rate: options.max_force_rate,
            max_torque_rate: options.max_torque_rate,
            energy_allowance: options.energy_allowance,
            max_energy_credit: options.max_energy_credit,
            max_acceleration: options.max_acceleration,
            max_angular_acceleration: options.max_angular_acceleration,
            max_model_age: options.max_age,
            max_contacts: options.max_contacts,
            max_sweeps: options.max_sweeps,
            force_law: options.force_law as u32,
            reserved0: 0,
            explicit_time: options.explicit_time,
            explicit_friction: options.explicit_friction,
        }
    }
}

impl shx_haptic_def {
    pub(super) fn options(&self) -> Result<HapticOptions> {
        let mode = match self.mode {
            SHX_HAPTIC_MODE_HAND_OVER => Mode::HandOver,
            SHX_HAPTIC_MODE_DIRECT => Mode::Direct,
            other => return Err(Error::invalid("def.mode", other, "SHX_HAPTIC_MODE_HAND_OVER or _DIRECT")),
        };
        let force_law = match self.force_law {
            SHX_HAPTIC_FORCE_CONTACT => ForceLaw::Contact,
            SHX_HAPTIC_FORCE_EXPLICIT => ForceLaw::Explicit,
            other => return Err(Error::invalid("def.force_law", other, "SHX_HAPTIC_FORCE_CONTACT or _EXPLICIT")),
        };
        if self.reserved0 != 0 {
            return Err(Error::invalid("def.reserved0", self.reserved0, "0"));
        }
        let options = HapticOptions {
            mode,
            force_law,
            explicit_time: self.explicit_time,
            explicit_friction: self.explicit_friction,
            handle: self.handle.checked("def.handle")?,
            stiffness: self.stiffness,
            damping: self.damping,
            angular_stiffness: self.angular_stiffness,
            angular_damping: self.angular_damping,
            max_force: self.max_force,
            max_torque: self.max_torque,
            max_force_rate: self.max_force_rate,
            max_torque_rate: self.max_torque_rate,
            energy_allowance: self.energy_allowance,
            max_energy_credit: self.max_energy_credit,
            max_acceleration: self.max_acceleration,
            max_angular_acceleration: self.max_angular_acceleration,
            max_contacts: self.max_contacts,
            max_sweeps: self.max_sweeps,
            max_age: self.max_model_age,
        };
        let fields = [("max_age", "max_model_age")];
        options.check("def").map_err(|error| error.with_fields(&fields))?;
        Ok(options)
    }
}

/// State after an update. Fill it with shx_haptic_state_init once; each update overwrites it.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_haptic_state {
    /// Set by shx_haptic_state_init.
    pub struct_size: u32,
    /// What limited the wrench: SHX_HAPTIC_LIMIT_ bits; 0: nothing.
    pub limits: u32,
    /// Frame of the handle in the simulation: the pose of the device, except for what the virtual coupling
    /// yields.
    pub proxy: shx_frame,
    /// Force on the tool before limits, N.
    pub contact_force: [f64; 3],
    /// Torque on the tool about the handle's origin before limits, N m.
    pub contact_torque: [f64; 3],
    /// Energy that the hand gave so far, J.
    pub energy_given: f64,
    /// Energy that the hand got so far, J.
    pub energy_received: f64,
    /// The most that energy_received ever was above energy_given, J; at most energy_allowance while the
    /// device stays within max_acceleration and dt does not change.
    pub max_energy_excess: f64,
    /// Age of the device pose that the local model was made with, s. 0 before the first model.
    pub model_age: f64,
    /// Number of local models so far.
    pub model_count: u64,
    /// Number of contacts in the local model, including those that do not press.
    pub contacts: u32,
    /// Number of those that press.
    pub pressing: u32,
    /// Number of pressing contacts beyond max_contacts: their forces remain as the simulation had them.
    pub left_out: u32,
    /// Number of sweeps of this update.
    pub sweeps: u32,
    /// Largest change of a force in the last sweep, relative to the largest force.
    pub residual: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_haptic_state {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self::of(&HapticState::default())
    }
}

const _: () = {
    assert!(size_of::<shx_haptic_def>() == 200 && offset_of!(shx_haptic_def, stiffness) == 64);
    assert!(offset_of!(shx_haptic_def, max_contacts) == 168);
    assert!(size_of::<shx_haptic_state>() == 176 && offset_of!(shx_haptic_state, contact_force) == 64);
    assert!(offset_of!(shx_haptic_state, model_count) == 144 && offset_of!(shx_haptic_state, residual) == 168);
};

impl shx_haptic_state {
    pub(super) fn of(state: &HapticState) -> Self {
        let limits = [
            (state.clamped, SHX_HAPTIC_LIMIT_CLAMPED),
            (state.rate_limited, SHX_HAPTIC_LIMIT_RATE),
            (state.passivity_limited, SHX_HAPTIC_LIMIT_PASSIVITY),
            (state.stale, SHX_HAPTIC_LIMIT_STALE),
        ];
        Self {
            struct_size: size_of::<Self>() as u32,
            limits: limits.iter().filter(|(set, _)| *set).map(|(_, bit)| bit).sum(),
            proxy: (&state.proxy).into(),
            contact_force: state.contact.force.into(),
            contact_torque: state.contact.torque.into(),
            energy_given: state.energy_given,
            energy_received: state.energy_got,
            max_energy_excess: state.energy_excess,
            model_age: state.model_age,
            model_count: state.models,
            contacts: state.contacts,
            pressing: state.pressing,
            left_out: state.left_out,
            sweeps: state.sweeps,
            residual: state.change,
        }
    }
}

/// Fills *def with defaults. size is sizeof(shx_haptic_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_def_init(def: *mut shx_haptic_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_haptic_def_init", "def", def, size) }
}

/// Fills *state with defaults. size is sizeof(shx_haptic_state).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_state_init(state: *mut shx_haptic_state, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that state holds size bytes.
    unsafe { initialise("shx_haptic_state_init", "state", state, size) }
}
