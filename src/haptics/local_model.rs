//! The local model that the simulation hands over after a step: the contacts of the tool, and their response until the next step.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use super::coupling::AddedMass;
use super::exchange::{Reader, Writer};
use super::explicit_law::Resistance;
use super::options::{ForceLaw, HapticOptions, Mode};
use crate::contact::constraint::law::coefficient::Coefficient;
use crate::math::frame::Frame;
use crate::solver::contact_compliance::{BodyContact, ContactCompliance, of_strands};
use crate::solver::report::Wrench;

/// Most contacts per strand in a local model.
const MAX_PER_STRAND: usize = 16;
/// Numbers of a message beside contacts, and per contact.
const HEADER: usize = 64;
const OF_CONTACT: usize = 28;

/// Whether a message has contacts.
pub(super) fn has_contacts(options: &HapticOptions) -> bool {
    options.mode == Mode::HandOver && options.force_law == ForceLaw::Contact
}

/// Capacity of a message.
pub(super) fn capacity(options: &HapticOptions) -> usize {
    let contacts = if has_contacts(options) { options.max_contacts as usize } else { 0 };
    HEADER + contacts * (OF_CONTACT + 9 * MAX_PER_STRAND)
}

/// The contents of a message.
#[derive(Debug)]
pub(super) struct LocalModel {
    /// The device's time at which it had the pose of the step, s.
    pub time: f64,
    /// The time span of `moved` and `response`, s.
    pub seconds: f64,
    /// The handle's pose at the end of the step.
    pub handle: Frame,
    /// The action of all strands on the tool in it, about the handle's origin.
    pub wrench: Wrench,
    /// The part of it from contacts beyond the model's capacity.
    pub rest: Wrench,
    /// Contacts under pressure.
    pub pressing: u32,
    /// For the explicit law, their action on the tool.
    pub resistance: Resistance,
    /// In direct mode, the hair in contact with the tool; zero where the message has the strands' compliance.
    pub added: AddedMass,
    /// Contacts under pressure beyond the capacity.
    pub left_out: u32,
    pub contacts: Vec<BodyContact>,
    /// Contacts of each strand.
    pub counts: Vec<usize>,
    /// See [`ContactCompliance::response`].
    pub response: Vec<f64>,
}

impl LocalModel {
    /// A model with memory for the largest message.
    pub fn new(options: &HapticOptions) -> Self {
        let contacts = if has_contacts(options) { options.max_contacts as usize } else { 0 };
        Self {
            time: 0.0,
            seconds: 1.0,
            handle: Frame::default(),
            wrench: Wrench::default(),
            rest: Wrench::default(),
            pressing: 0,
            resistance: Resistance::default(),
            added: AddedMass::default(),
            left_out: 0,
            contacts: Vec::with_capacity(contacts),
            counts: Vec::with_capacity(contacts),
            response: Vec::with_capacity(contacts * 9 * MAX_PER_STRAND),
        }
    }

    /// The contacts of each strand, and its matrix.
    pub fn strands(&self) -> impl Iterator<Item = (Range<usize>, &[f64])> {
        of_strands(self.counts.iter().copied()).map(|[contacts, numbers]| (contacts, &self.response[numbers]))
    }

    /// Reads a message from [`write()`]. Allocates nothing.
    pub fn read(&mut self, message: &mut Reader) {
        (self.time, self.seconds) = (message.number(), message.number());
        self.handle = read_frame(message);
        self.wrench = read_wrench(message);
        self.rest = read_wrench(message);
        self.pressing = message.count() as u32;
        self.resistance =
            Resistance { linear: read_matrix(message), coupling: read_matrix(message), angular: read_matrix(message) };
        self.added = AddedMass { mass: message.number(), moment: message.number() };
        self.left_out = message.count() as u32;
        let (strands, contacts) = (message.count(), message.count().min(self.contacts.capacity()));
        self.counts.clear();
        self.counts.extend((0..strands.min(contacts)).map(|_| message.count()));
        self.contacts.clear();
        self.contacts.extend((0..contacts).map(|_| BodyContact {
            point: message.numbers().into(),
            normal: message.numbers().into(),
            gap: message.number(),
            body: message.count() as u32,
            margin: message.number(),
            tangent: message.numbers().into(),
            reach: message.numbers(),
            friction: Coefficient { mean: message.number(), lean: message.numbers().into() },
            force: message.numbers().into(),
            max_force: message.number(),
            moved: message.numbers().into(),
            resistance: [0.0; 2],
        }));
        let numbers: usize = self.counts.iter().map(|count| 9 * count * count).sum();
        self.response.clear();
        self.response.extend((0..numbers.min(self.response.capacity())).map(|_| message.number()));
    }
}

/// The contacts to put into a message: those under the highest force, then the nearest.
#[derive(Debug, Default)]
pub(super) struct Choice {
    order: Vec<u32>,
    is_chosen: Vec<bool>,
    /// Per strand.
    counts: Vec<usize>,
    strand_of: Vec<u32>,
}

impl Choice {
    /// Chooses among contacts under pressure and those that `may_close`. Returns how many under pressure exceed the capacity.
    pub fn choose(&mut self, from: &ContactCompliance, most: usize, may_close: impl Fn(&BodyContact) -> bool) -> u32 {
        let contacts = &from.contacts;
        self.order.clear();
        let is_wanted = |k: &u32| contacts[*k as usize].force != Vector3::zeros() || may_close(&contacts[*k as usize]);
        self.order.extend((0..contacts.len() as u32).filter(is_wanted));
        let key = |k: &u32| (contacts[*k as usize].force.norm_squared(), -contacts[*k as usize].gap);
        let compare = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
        self.order.sort_unstable_by(|a, b| compare(&key(b), &key(a)).then(a.cmp(b)));
        self.strand_of.clear();
        for (strand, count) in from.counts.iter().enumerate() {
            self.strand_of.extend((0..*count).map(|_| strand as u32));
        }
        self.is_chosen.clear();
        self.is_chosen.resize(contacts.len(), false);
        self.counts.clear();
        self.counts.resize(from.counts.len(), 0);
        let (mut left, mut left_out) = (most, 0);
        for k in &self.order {
            let (k, strand) = (*k as usize, self.strand_of[*k as usize] as usize);
            if left > 0 && self.counts[strand] < MAX_PER_STRAND {
                self.is_chosen[k] = true;
                self.counts[strand] += 1;
                left -= 1;
            } else {
                left_out += u32::from(contacts[k].force != Vector3::zeros());
            }
        }
        left_out
    }

    /// Whether a contact is chosen.
    pub fn is_chosen(&self, contact: usize) -> bool {
        self.is_chosen[contact]
    }
}

/// Writes contacts and their compliance.
pub(super) fn write(from: &ContactCompliance, message: &mut Writer) {
    message.count(from.counts.len());
    message.count(from.contacts.len());
    from.counts.iter().for_each(|count| message.count(*count as usize));
    for contact in &from.contacts {
        message.numbers(contact.point.as_slice());
        message.numbers(contact.normal.as_slice());
        message.number(contact.gap);
        message.count(contact.body as usize);
        message.number(contact.margin);
        message.numbers(contact.tangent.as_slice());
        message.numbers(&contact.reach);
        message.number(contact.friction.mean);
        message.numbers(contact.friction.lean.as_slice());
        message.numbers(contact.force.as_slice());
        message.number(contact.max_force);
        message.numbers(contact.moved.as_slice());
    }
    message.numbers(&from.response);
}

pub(super) fn write_frame(message: &mut Writer, frame: &Frame) {
    message.numbers(frame.origin.as_slice());
    message.numbers(&frame.rotation_xyzw());
}

pub(super) fn read_frame(message: &mut Reader) -> Frame {
    let (origin, [x, y, z, w]) = (message.numbers(), message.numbers());
    let rotation = nalgebra::Unit::new_unchecked(nalgebra::Quaternion::new(w, x, y, z));
    Frame { origin: Vector3::from(origin), rotation }
}

pub(super) fn write_wrench(message: &mut Writer, wrench: &Wrench) {
    message.numbers(wrench.force.as_slice());
    message.numbers(wrench.torque.as_slice());
}

fn read_wrench(message: &mut Reader) -> Wrench {
    Wrench { force: message.numbers().into(), torque: message.numbers().into() }
}

pub(super) fn write_resistance(message: &mut Writer, resistance: &Resistance) {
    for matrix in [&resistance.linear, &resistance.coupling, &resistance.angular] {
        message.numbers(matrix.as_slice());
    }
}

fn read_matrix(message: &mut Reader) -> Matrix3<f64> {
    Matrix3::from_column_slice(&message.numbers::<9>())
}
