//! The device's thread: takes a pose and returns a force, in bounded time, without waiting or allocating.

use nalgebra::Vector3;

use super::contact_forces::{ContactForces, Solved};
use super::coupling::{Compliance, Coupling, moved};
use super::exchange::{Publisher, Taker};
use super::geometry::Tooth;
use super::local_model::{LocalModel, write_frame};
use super::options::{ForceLaw, HapticOptions, Mode};
use super::passivity::Passivity;
use crate::error::{Result, check_finite, check_positive};
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;
use crate::solver::report::Wrench;

/// Numbers of the message with the device's pose.
pub(super) const POSE_NUMBERS: usize = 8;

/// At a hand-over the force changes from the old model's to the new one's within this fraction of the model's seconds.
const BLEND: f64 = 0.5;

/// The result of an update.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HapticState {
    /// Pose of the tool's handle: the device's pose except for the yielding of the virtual coupling.
    pub proxy: Frame,
    /// The force before any limit: what the hair does to the tool.
    pub contact: Wrench,
    /// Energy from the hand so far, J.
    pub energy_given: f64,
    /// Energy to the hand so far, J.
    pub energy_got: f64,
    /// The largest excess of energy received by the hand over energy given so far, J: at most the allowance.
    pub energy_excess: f64,
    /// Seconds since the device had the pose of the current local model's step; 0 before the first.
    pub model_age: f64,
    /// Local models so far.
    pub models: u64,
    /// Contacts of the current one.
    pub contacts: u32,
    /// Those under pressure.
    pub pressing: u32,
    /// Contacts under pressure beyond the model's capacity; their forces stay as in the simulation.
    pub left_out: u32,
    /// Sweeps in this update.
    pub sweeps: u32,
    /// The change of a force in the last of them, relative to the largest force.
    pub change: f64,
    /// Whether the force or the torque was limited to its maximum.
    pub clamped: bool,
    /// Whether it changed at the maximum rate.
    pub rate_limited: bool,
    /// Whether it was reduced for passivity.
    pub passivity_limited: bool,
    /// Whether the local model is too old, so that the force fades.
    pub stale: bool,
}

/// The device's side of a haptic object.
#[derive(Debug)]
pub struct Device {
    options: HapticOptions,
    poses: Publisher,
    models: Taker,
    model: LocalModel,
    forces: ContactForces,
    passivity: Passivity,
    /// The device's time since the first update, s.
    time: f64,
    /// The poses of device and proxy in the last update; `None` before the first.
    last: Option<(Frame, Frame)>,
    /// The output then.
    out: Wrench,
    /// Before limits.
    raw: Wrench,
    /// The difference of the new model's force from the old one's at the hand-over, and the fraction of it that remains.
    blend: (Wrench, f64),
    count: u64,
    handle: Frame,
}

impl Device {
    pub(super) fn new(options: &HapticOptions, handle: Frame, teeth: Vec<Tooth>, poses: Publisher, models: Taker) -> Self {
        Self {
            options: *options,
            poses,
            models,
            model: LocalModel::new(options),
            forces: ContactForces::new(options.max_contacts as usize, teeth),
            passivity: Passivity::new(options),
            time: 0.0,
            last: None,
            out: Wrench::default(),
            raw: Wrench::default(),
            blend: (Wrench::default(), 0.0),
            count: 0,
            handle,
        }
    }

    /// The pose of the tool's handle when the object was created.
    pub fn first_pose(&self) -> Frame {
        self.handle
    }

    /// Passes the device's current pose and velocity (m/s, rad/s, world axes), `dt` seconds after the last update, and returns
    /// the force (N) and the torque about the handle's origin (N·m) for the hand. Waits for nothing and allocates nothing; the
    /// options' contacts and sweeps bound its time.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a number that is not finite, or a `dt` that is not
    /// above zero; the last force then continues.
    pub fn update(&mut self, pose: &Frame, velocity: Vector3<f64>, spin: Vector3<f64>, dt: f64) -> Result<(Wrench, HapticState)> {
        for axis in 0..3 {
            check_finite(|| format!("pose.origin[{axis}]"), pose.origin[axis])?;
            check_finite(|| format!("velocity[{axis}]"), velocity[axis])?;
            check_finite(|| format!("velocity[{}]", axis + 3), spin[axis])?;
        }
        for (axis, value) in pose.rotation_xyzw().into_iter().enumerate() {
            check_finite(|| format!("pose.rotation[{axis}]"), value)?;
        }
        check_positive(|| "dt".into(), dt)?;
        let velocities = [velocity, spin];
        let (device, proxy) = self.last.unwrap_or((*pose, *pose));
        self.passivity.observe(
            &self.out,
            pose.origin - device.origin,
            rotation_vector(&(pose.rotation * device.rotation.inverse())),
        );
        self.time += dt;
        let mut state = HapticState::default();
        let is_new = self.take_model();
        let coupling = Coupling::new(&self.options, &self.model.added, dt);
        let free = coupling.free_proxy(&proxy, pose, velocities);
        let solved = self.answer(&free, velocities, coupling.compliance);
        state.proxy = moved(&free, solved.moved, solved.turned);
        let mut wrench = self.blended(solved.wrench, is_new, dt);
        self.raw = wrench;
        state.contact = wrench;
        self.fade(&mut wrench, &mut state);
        state.rate_limited = self.limit_rate(&mut wrench, dt);
        state.clamped = self.clamp(&mut wrench);
        state.passivity_limited = self.passivity.limit(&mut wrench, velocities, dt);
        (state.energy_given, state.energy_got) = (self.passivity.given, self.passivity.got);
        state.energy_excess = self.passivity.worst;
        (state.models, state.contacts) = (self.count, self.model.contacts.len() as u32);
        (state.pressing, state.sweeps, state.change) = (solved.pressing, solved.sweeps, solved.change);
        state.left_out = self.model.left_out;
        self.out = wrench;
        self.last = Some((*pose, state.proxy));
        let time = self.time;
        self.poses.publish(|message| {
            message.number(time);
            write_frame(message, &state.proxy);
        });
        Ok((wrench, state))
    }

    /// Takes the newest local model, if there is one.
    fn take_model(&mut self) -> bool {
        let model = &mut self.model;
        if self.models.take(|message| model.read(message)).is_none() {
            return false;
        }
        self.count += 1;
        self.forces.begin(&self.model);
        true
    }

    /// What the hair does to the tool now, if the tool would otherwise be at `free`.
    fn answer(&mut self, free: &Frame, [velocity, spin]: [Vector3<f64>; 2], compliance: Compliance) -> Solved {
        if self.count == 0 {
            return Solved::default();
        }
        let yielding = |wrench: Wrench, pressing: u32| {
            let (moved, turned) = (wrench.force * compliance.linear, wrench.torque * compliance.angular);
            Solved { wrench, moved, turned, pressing, ..Solved::default() }
        };
        match self.options.mode {
            _ if self.options.force_law == ForceLaw::Explicit => {
                yielding(self.model.resistance.wrench(&velocity, &spin), self.model.pressing)
            }
            Mode::HandOver => {
                let age = self.time - self.model.time;
                self.forces.solve(&self.model, free, age, self.options.max_sweeps, compliance)
            }
            Mode::Direct => yielding(self.model.wrench, 0),
        }
    }

    /// Blends forces at a hand-over: from the old model's to the new one's within a fraction of the model's seconds.
    fn blended(&mut self, wrench: Wrench, is_new: bool, dt: f64) -> Wrench {
        if self.options.mode == Mode::Direct {
            return wrench;
        }
        let (off, left) = &mut self.blend;
        if is_new {
            *off = Wrench { force: self.raw.force - wrench.force, torque: self.raw.torque - wrench.torque };
            *left = 1.0;
        }
        *left = (*left - dt / (BLEND * self.model.seconds)).max(0.0);
        Wrench { force: wrench.force + off.force * *left, torque: wrench.torque + off.torque * *left }
    }

    /// Fades the force of a model that is too old.
    fn fade(&self, wrench: &mut Wrench, state: &mut HapticState) {
        if self.count == 0 {
            return;
        }
        state.model_age = self.time - self.model.time;
        let over = state.model_age - self.options.max_age;
        if over > 0.0 {
            state.stale = true;
            let part = (1.0 - over / self.options.max_age).max(0.0);
            *wrench = Wrench { force: wrench.force * part, torque: wrench.torque * part };
        }
    }

    fn limit_rate(&self, wrench: &mut Wrench, dt: f64) -> bool {
        let force = toward(&mut wrench.force, self.out.force, self.options.max_force_rate * dt);
        let torque = toward(&mut wrench.torque, self.out.torque, self.options.max_torque_rate * dt);
        force || torque
    }

    fn clamp(&self, wrench: &mut Wrench) -> bool {
        let force = toward(&mut wrench.force, Vector3::zeros(), self.options.max_force);
        let torque = toward(&mut wrench.torque, Vector3::zeros(), self.options.max_torque);
        force || torque
    }
}

/// Limits a vector to a distance of `most` from another one. True if it had to.
fn toward(vector: &mut Vector3<f64>, from: Vector3<f64>, most: f64) -> bool {
    let offset = *vector - from;
    let size = offset.norm();
    if size <= most {
        return false;
    }
    *vector = from + offset * (most / size);
    true
}
