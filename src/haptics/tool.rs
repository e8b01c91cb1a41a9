//! The simulation's side: moves the tool's bodies with the device, and publishes their contacts after every step.

use nalgebra::Vector3;

use super::coupling::AddedMass;
use super::exchange::{Publisher, Taker};
use super::explicit_law::Resistance;
use super::geometry::Tooth;
use super::local_model::{self, Choice, read_frame, write_frame, write_resistance, write_wrench};
use super::options::{ForceLaw, HapticOptions, Mode};
use super::ring_combs::HeldComb;
use crate::error::{Error, Result, check_positive};
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;
use crate::solver::Solver;
use crate::solver::bodies::ContactPartner;
use crate::solver::contact_compliance::{BodyContact, ContactCompliance};
use crate::solver::id::{BodyId, StrandId};
use crate::solver::report::Wrench;
use crate::styling::{RingComb, RingCombReport};

/// The least distance, m, within which strands are reported to the device, and the multiple of the tool's motion in the last
/// step. Farther ones are left out unless the tool's motion closes the gap, or would do so if it turned towards the strand by
/// this sine.
const NEAR: f64 = 1e-3;
const TRAVEL_FACTOR: f64 = 2.0;
const SIDEWAYS: f64 = 0.25;
/// Decay per step of the mass of strands that have left the tool.
const FORGETS: f64 = 0.95;

/// The simulation's side of a haptic object.
#[derive(Debug)]
pub struct Tool {
    options: HapticOptions,
    bodies: Vec<BodyId>,
    /// Poses of the bodies in the handle's frame.
    places: Vec<Frame>,
    /// Largest distance of each body's points from its frame's origin, m.
    reaches: Vec<f64>,
    poses: Taker,
    models: Publisher,
    /// The handle's pose, and its pose before the last step.
    handle: [Frame; 2],
    /// The device's time of that pose; `None` before the device's first report.
    time: Option<f64>,
    seconds: f64,
    compliance: ContactCompliance,
    choice: Choice,
    combs: Vec<HeldComb>,
    /// For direct mode.
    added: AddedMass,
}

impl Tool {
    pub(super) fn new(
        solver: &Solver,
        bodies: &[BodyId],
        options: &HapticOptions,
        poses: Taker,
        models: Publisher,
    ) -> Result<Self> {
        let model = solver.options().contact.model;
        if local_model::has_contacts(options) && model.is_soft() {
            let hint = "a local model has Coulomb's law; set the solver's contact model to Coulomb, or take direct mode";
            let argument = "options.mode".into();
            return Err(Error::Unsupported { argument, value: format!("hand-over with {model:?}"), hint: hint.into() });
        }
        if bodies.is_empty() {
            return Err(Error::invalid("bodies (count)", 0, "one body or more"));
        }
        let mut poses_of_bodies = Vec::with_capacity(bodies.len());
        let mut reaches = Vec::with_capacity(bodies.len());
        for (k, id) in bodies.iter().enumerate() {
            let stale = |_| Error::InvalidId { argument: format!("bodies[{k}]"), bits: id.bits() };
            let body = solver.body(*id).map_err(stale)?;
            if bodies[..k].contains(id) {
                return Err(Error::invalid(format!("bodies[{k}]"), format!("0x{:016x}", id.bits()), "each body once"));
            }
            poses_of_bodies.push(body.pose);
            let corners = body.shape.bounds().corners().map(|corner| corner.norm());
            let reach = corners.into_iter().fold(0.0, f64::max);
            reaches.push(if reach.is_finite() { reach } else { 0.0 });
        }
        let handle = poses_of_bodies[0].compose(&options.handle);
        let to_handle = handle.inverse();
        Ok(Self {
            options: *options,
            bodies: bodies.to_vec(),
            places: poses_of_bodies.iter().map(|pose| to_handle.compose(pose)).collect(),
            reaches,
            poses,
            models,
            handle: [handle; 2],
            time: None,
            seconds: 0.0,
            compliance: ContactCompliance::default(),
            choice: Choice::default(),
            combs: Vec::new(),
            added: AddedMass::default(),
        })
    }

    /// The device's copy of the tool's bodies.
    pub(super) fn teeth(&self, solver: &Solver) -> Result<Vec<Tooth>> {
        let tooth = |(id, place): (&BodyId, &Frame)| Ok(Tooth { place: *place, shape: solver.body(*id)?.shape.clone() });
        self.bodies.iter().zip(&self.places).map(tooth).collect()
    }

    /// Pose of the tool's handle in the simulation.
    pub fn handle(&self) -> Frame {
        self.handle[0]
    }

    /// The bodies.
    pub fn bodies(&self) -> &[BodyId] {
        &self.bodies
    }

    /// Puts a ring comb into the hand, at its pose: from the next step on it goes with the handle, catches those of `strands` that its teeth run
    /// into, and the hand feels what they pull with. Strands that are removed later are forgotten. Returns the comb's index.
    ///
    /// In hand-over these forces stay what they were in the last step until the next one: take a rate of 240 Hz, or direct mode, where combs
    /// hold many strands.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `strands[i]`, or `bodies[i]` if one was removed, or the solver is another one.
    pub fn add_ring_comb(&mut self, solver: &Solver, comb: RingComb, strands: &[StrandId]) -> Result<usize> {
        self.check_bodies(solver)?;
        self.combs.push(HeldComb::new(solver, &self.handle[0], comb, strands)?);
        Ok(self.combs.len() - 1)
    }

    /// The ring combs in the hand, each with the result of the last step.
    pub fn ring_combs(&self) -> impl ExactSizeIterator<Item = (&RingComb, &RingCombReport)> {
        self.combs.iter().map(|held| (held.comb(), held.report()))
    }

    /// Lets go of all strands on the teeth of ring combs.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `bodies[i]` if one was removed, or the solver is another one.
    pub fn release_ring_combs(&mut self, solver: &mut Solver) -> Result<()> {
        self.check_bodies(solver)?;
        self.combs.iter_mut().try_for_each(|comb| comb.release(solver))
    }

    /// Prepares for steps of `dt` seconds in total: sends the bodies to the device's current pose. They take the device's first
    /// pose at once, without sweeping what lies between.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `dt` that is not finite and above zero; [`Error::InvalidId`] naming `bodies[i]` if one
    /// was removed, or the solver is another one.
    pub fn before_step(&mut self, solver: &mut Solver, dt: f64) -> Result<()> {
        check_positive(|| "dt".into(), dt)?;
        self.check_bodies(solver)?;
        let is_first = self.time.is_none();
        let handle = &mut self.handle;
        handle[1] = handle[0];
        if let Some(time) = self.poses.take(|message| {
            let time = message.number();
            handle[0] = read_frame(message);
            time
        }) {
            self.time = Some(time);
        }
        self.seconds = dt;
        if self.time.is_none() {
            return Ok(());
        }
        if is_first {
            self.handle[1] = self.handle[0];
        }
        let frame_of = |k: usize| Ok((self.bodies[k], self.handle[0].compose(&self.places[k])));
        if is_first {
            solver.teleport_bodies_of(self.bodies.len(), frame_of)?;
        } else {
            solver.set_body_frames_of(self.bodies.len(), frame_of, dt)?;
        }
        let handle = self.handle[0];
        self.combs.iter_mut().try_for_each(|comb| comb.before_step(solver, &handle, dt, is_first))
    }

    /// Publishes the tool's contacts after the step. Does nothing before the device's first report.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `bodies[i]`.
    pub fn after_step(&mut self, solver: &mut Solver) -> Result<()> {
        self.check_bodies(solver)?;
        let Some(time) = self.time else { return Ok(()) };
        let handle = self.handle[0];
        let mut wrench = Wrench::default();
        for id in &self.bodies {
            let (of_body, origin) = (solver.body_wrench(*id)?, solver.body(*id)?.pose.origin);
            wrench.force += of_body.force;
            wrench.torque += of_body.torque + (origin - handle.origin).cross(&of_body.force);
        }
        let mut rest = Wrench::default();
        for comb in &mut self.combs {
            let of_comb = comb.after_step(solver, &handle)?;
            for sum in [&mut wrench, &mut rest] {
                sum.force += of_comb.force;
                sum.torque += of_comb.torque;
            }
        }
        let mut left_out = 0;
        let (mut resistance, mut pressing) = (Resistance::default(), 0);
        if self.options.force_law == ForceLaw::Explicit {
            solver.find_contacts(&self.bodies, NEAR, &mut self.compliance)?;
            for contact in self.compliance.contacts.iter().filter(|contact| contact.force != Vector3::zeros()) {
                let [across, along] = contact.resistance;
                let (across, along) = (across * self.options.explicit_time, along * self.options.explicit_friction);
                resistance.add(&contact.tangent, &(contact.point - handle.origin), across, along);
                pressing += 1;
            }
            let coefficients = [self.options.explicit_time, self.options.explicit_friction];
            for comb in &self.combs {
                comb.resist(solver, &handle, coefficients, &mut resistance)?;
                pressing += comb.report().held as usize;
            }
        } else if self.options.mode == Mode::HandOver {
            let (travel, onward) = (self.travel(), self.handle[0].compose(&self.handle[1].inverse()));
            solver.find_contacts(&self.bodies, NEAR + TRAVEL_FACTOR * travel, &mut self.compliance)?;
            let may_close = |contact: &BodyContact| {
                let closing = (onward.origin + onward.rotation * contact.point - contact.point).dot(&contact.normal);
                contact.gap <= NEAR + TRAVEL_FACTOR * closing.max(SIDEWAYS * travel)
            };
            left_out = self.choice.choose(&self.compliance, self.options.max_contacts as usize, may_close);
            // The hand must not feel forces that come from no contact, such as the push on strands that diverged in a step.
            for (contact, chosen) in
                self.compliance.contacts.iter().enumerate().map(|(k, contact)| (contact, self.choice.is_chosen(k)))
            {
                if !chosen {
                    rest.force -= contact.force;
                    rest.torque -= (contact.point - handle.origin).cross(&contact.force);
                }
            }
            self.compliance.retain(|contact| self.choice.is_chosen(contact));
            solver.condense_contacts(self.seconds, &mut self.compliance)?;
        } else {
            self.added = self.mass_in_contact(solver);
        }
        let Self { models, compliance, options, seconds, added, .. } = self;
        models.publish(|message| {
            message.numbers(&[time, *seconds]);
            write_frame(message, &handle);
            write_wrench(message, &wrench);
            write_wrench(message, &rest);
            message.count(pressing);
            write_resistance(message, &resistance);
            message.numbers(&[added.mass, added.moment]);
            message.count(left_out as usize);
            if local_model::has_contacts(options) {
                local_model::write(compliance, message);
            } else {
                message.count(0);
                message.count(0);
            }
        });
        Ok(())
    }

    /// The mass of strands in contact with the tool, which persists for a while: a strand that lets go may be in contact again in
    /// the next step.
    fn mass_in_contact(&self, solver: &Solver) -> AddedMass {
        let mut added = AddedMass { mass: self.added.mass * FORGETS, moment: self.added.moment * FORGETS };
        let (mut now, mut last) = (AddedMass::default(), None);
        for contact in solver.contacts() {
            let ContactPartner::Body { body, .. } = contact.partner else { continue };
            if last == Some(contact.strand) || !self.bodies.contains(&body) {
                continue;
            }
            last = Some(contact.strand);
            let mass = solver.mass(contact.strand).unwrap_or(0.0);
            now.mass += mass;
            now.moment += mass * (contact.position - self.handle[0].origin).norm_squared();
        }
        self.combs.iter().for_each(|comb| comb.add_mass(solver, &self.handle[0], &mut now));
        (added.mass, added.moment) = (added.mass.max(now.mass), added.moment.max(now.moment));
        added
    }

    /// The largest displacement of any point of the tool in the last step, m.
    fn travel(&self) -> f64 {
        let [now, before] = &self.handle;
        let turn = rotation_vector(&(now.rotation * before.rotation.inverse())).norm();
        let of_body =
            |(place, reach): (&Frame, &f64)| (now.compose(place).origin - before.compose(place).origin).norm() + turn * reach;
        self.places.iter().zip(&self.reaches).map(of_body).fold(0.0, f64::max)
    }

    fn check_bodies(&self, solver: &Solver) -> Result<()> {
        for (k, id) in self.bodies.iter().enumerate() {
            solver.body(*id).map_err(|_| Error::InvalidId { argument: format!("bodies[{k}]"), bits: id.bits() })?;
        }
        Ok(())
    }
}
