//! Options of a haptic object.

use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::math::frame::Frame;

/// The source of the force on the hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum Mode {
    /// The solver steps at its own rate and hands a local model of the tool's contacts to the device's thread, which solves
    /// contact again with the device's newest pose.
    #[default]
    HandOver = 1,
    /// The solver steps at the device's rate: the force is that of its last step.
    Direct = 2,
}

/// The force law between hair and tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum ForceLaw {
    /// Signorini's and Coulomb's laws at every contact: the solver's own forces.
    #[default]
    Contact = 1,
    /// The explicit formula of Bonanni and Kmoch (2008): each contact under pressure resists the tool's velocity, by the strand's
    /// bending stiffness across it and by its internal friction along it. Cheap and passive by itself, but independent of the
    /// hair's motion, and zero at rest.
    Explicit = 2,
}

/// Settings of a haptic object.
///
/// ```
/// use std::sync::Arc;
///
/// use superhelix::haptic::{HapticOptions, haptic};
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{BodyDef, Shape, Solver, SolverOptions};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let finger = solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(8e-3)?))])?;
/// let options = HapticOptions { max_force: 3.0, ..HapticOptions::default() };
/// let (mut tool, mut device) = haptic(&solver, &finger, &options)?;
///
/// // The solver's rate: once a step.
/// tool.before_step(&mut solver, 1.0 / 60.0)?;
/// solver.step(1.0 / 60.0, 1)?;
/// tool.after_step(&mut solver)?;
/// // The device's rate, on a thread of its own: once a millisecond.
/// let pose = device.first_pose();
/// let (wrench, _state) = device.update(&pose, Vector3::zeros(), Vector3::zeros(), 1e-3)?;
/// assert!(wrench.force.norm() <= 3.0);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HapticOptions {
    /// The source of the force.
    pub mode: Mode,
    /// The force law between hair and tool.
    pub force_law: ForceLaw,
    /// [`ForceLaw::Explicit`]: the time τ in β = τ 3 EI/L³, s; zero or above.
    pub explicit_time: f64,
    /// [`ForceLaw::Explicit`]: the number φ in f = φ 3 γ/L³; zero or above.
    pub explicit_friction: f64,
    /// The device's frame in the axes of the first body: the frame whose pose the device reports.
    pub handle: Frame,
    /// Stiffness of the virtual coupling between device and tool, N/m; above zero.
    pub stiffness: f64,
    /// Its damping, N·s/m; zero or above.
    pub damping: f64,
    /// Its stiffness against turning, N·m/rad; above zero.
    pub angular_stiffness: f64,
    /// Its damping of turning, N·m·s/rad; zero or above.
    pub angular_damping: f64,
    /// The largest force, N; above zero.
    pub max_force: f64,
    /// The largest torque, N·m; above zero.
    pub max_torque: f64,
    /// The largest rate of change of the force, N/s; above zero.
    pub max_force_rate: f64,
    /// The largest rate of change of the torque, N·m/s; above zero.
    pub max_torque_rate: f64,
    /// The largest permitted excess of energy to the hand over energy from it, J; above zero.
    pub energy_allowance: f64,
    /// The most credit for energy from the hand, J; zero or above.
    pub max_energy_credit: f64,
    /// The largest acceleration of the device by a hand, m/s²: a bound on what may happen in an update; zero or above.
    pub max_acceleration: f64,
    /// The same for rotation, rad/s²; zero or above.
    pub max_angular_acceleration: f64,
    /// Most contacts of a local model; 1 to 4096.
    pub max_contacts: u32,
    /// Most sweeps over them per update; 1 to 1000.
    pub max_sweeps: u32,
    /// The largest age of a local model, s; beyond it the force fades away within the same time; above zero.
    pub max_age: f64,
}

impl Default for HapticOptions {
    fn default() -> Self {
        Self {
            mode: Mode::default(),
            force_law: ForceLaw::default(),
            explicit_time: 0.1,
            explicit_friction: 1.0,
            handle: Frame::default(),
            stiffness: 500.0,
            damping: 1.0,
            angular_stiffness: 1.0,
            angular_damping: 2e-3,
            max_force: 5.0,
            max_torque: 0.2,
            max_force_rate: 500.0,
            max_torque_rate: 20.0,
            energy_allowance: 1e-3,
            max_energy_credit: 0.05,
            max_acceleration: 20.0,
            max_angular_acceleration: 200.0,
            max_contacts: 256,
            max_sweeps: 10,
            max_age: 0.1,
        }
    }
}

impl HapticOptions {
    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        let named = |name: &str| format!("{argument}.{name}");
        let above_zero = [
            ("stiffness", self.stiffness),
            ("angular_stiffness", self.angular_stiffness),
            ("max_force", self.max_force),
            ("max_torque", self.max_torque),
            ("max_force_rate", self.max_force_rate),
            ("max_torque_rate", self.max_torque_rate),
            ("energy_allowance", self.energy_allowance),
            ("max_age", self.max_age),
        ];
        for (name, value) in above_zero {
            check_positive(|| named(name), value)?;
        }
        let not_negative = [
            ("explicit_time", self.explicit_time),
            ("explicit_friction", self.explicit_friction),
            ("damping", self.damping),
            ("angular_damping", self.angular_damping),
            ("max_energy_credit", self.max_energy_credit),
            ("max_acceleration", self.max_acceleration),
            ("max_angular_acceleration", self.max_angular_acceleration),
        ];
        for (name, value) in not_negative {
            check_not_negative(|| named(name), value)?;
        }
        for (name, value, most) in
            [("max_contacts", self.max_contacts, MAX_CONTACTS), ("max_sweeps", self.max_sweeps, MAX_SWEEPS)]
        {
            if !(1..=most).contains(&value) {
                return Err(Error::invalid(named(name), value, format!("1 to {most}")));
            }
        }
        Ok(())
    }
}

/// See [`HapticOptions::max_contacts`].
const MAX_CONTACTS: u32 = 4096;
/// See [`HapticOptions::max_sweeps`].
const MAX_SWEEPS: u32 = 1000;
