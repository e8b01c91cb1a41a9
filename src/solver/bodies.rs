//! Bodies, which strands stay outside of.
//!
//! Files:
//!
//! - `bringing_out.rs`: Brings curves out of a body of the scene before they become strands.
//! - `deep_places.rs`: Overlaps of strands with bodies and with each other in the current scene, independent of any step.
//! - `overlaps.rs`: Overlaps of strands in the current scene, and permitted overlaps.

pub(super) mod bringing_out;
pub(super) mod deep_places;
pub(super) mod overlaps;

use std::sync::{Arc, OnceLock};

use nalgebra::Vector3;

use super::Solver;
use super::id::{self, BodyId, StrandId};
use super::report::Wrench;
use crate::contact::body::{Body, BodyDef, check_pose};
use crate::contact::options::{ContactOptions, StrandContact};
use crate::contact::shape::Shape;
use crate::error::{Error, Result, check_not_negative};
use crate::math::frame::Frame;
use crate::memory;

/// A body and the solver's data about it.
#[derive(Debug, Clone)]
pub(super) struct SceneBody {
    pub id: BodyId,
    pub body: Body,
    /// The action of strands on it in the last substep.
    pub wrench: Wrench,
    /// The host's own number.
    pub user_data: u64,
    /// Whether its vertices were ever moved: its shape is then its own and changes.
    pub deforms: bool,
    /// Hash of a static shape, once requested.
    pub content: OnceLock<u128>,
}

impl SceneBody {
    pub fn new(id: BodyId, body: Body) -> Self {
        Self { id, body, wrench: Wrench::default(), user_data: 0, deforms: false, content: OnceLock::new() }
    }
}

/// A contact of a strand at the end of the last substep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The strand.
    pub strand: StrandId,
    /// Arclength on it, m.
    pub arclength: f64,
    /// The other side.
    pub partner: ContactPartner,
    /// On the strand's centreline, m, world.
    pub position: Vector3<f64>,
    /// Unit normal, world, from the partner to the strand.
    pub normal: Vector3<f64>,
    /// Force on the strand, N, world; the partner gets the opposite.
    pub force: Vector3<f64>,
    /// Distance of the surfaces along the normal at the contact, m; negative where they overlap. A body's surface counts as flat about
    /// it: a strand that slides past an edge within the substep may be farther away.
    pub gap: f64,
    /// Slip of the strand over its partner during the substep, m, world, along the surface.
    pub slip: Vector3<f64>,
}

/// The other side of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactPartner {
    /// A body.
    Body {
        /// Which.
        body: BodyId,
        /// The triangle of a mesh; otherwise 0.
        feature: u32,
    },
    /// Another strand, or the same one elsewhere.
    Strand {
        /// Which.
        strand: StrandId,
        /// Arclength on it, m.
        arclength: f64,
    },
}

/// Heap bytes of the bodies, counting each shape once.
pub(super) fn heap_bytes(bodies: &[SceneBody]) -> usize {
    let mut seen = std::collections::HashSet::new();
    let of = |body: &SceneBody| {
        let shape = &body.body.def().shape;
        // A shared shape has two counts beside it.
        let whole = 2 * size_of::<usize>() + size_of::<Shape>() + shape.heap_bytes();
        body.body.heap_bytes() + if seen.insert(Arc::as_ptr(shape)) { whole } else { 0 }
    };
    bodies.iter().map(of).sum()
}

impl Solver {
    /// Adds bodies, all or none, and returns their identifiers in the order of the definitions. Strands are in contact with them
    /// if contact is set for them ([`Solver::set_contact`]).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `bodies[i].field`.
    pub fn add_bodies(&mut self, bodies: Vec<BodyDef>) -> Result<Vec<BodyId>> {
        if self.bodies.len() + bodies.len() > id::MAX_SLOTS {
            return Err(Error::OutOfMemory { bytes: bodies.len().saturating_mul(size_of::<SceneBody>()) });
        }
        let made =
            bodies.into_iter().enumerate().map(|(k, def)| Body::new(def).map_err(|error| error.inside(&format!("bodies[{k}]"))));
        let made = made.collect::<Result<Vec<Body>>>()?;
        self.body_slots.reserve(made.len())?;
        memory::grow(&mut self.bodies, made.len())?;
        let mut ids = memory::list(made.len())?;
        for body in made {
            let Some(id) = self.body_slots.insert(self.bodies.len()) else {
                self.remove_bodies(&ids)?;
                return Err(Error::OutOfMemory { bytes: size_of::<SceneBody>() });
            };
            self.bodies.push(SceneBody::new(id, body));
            ids.push(id);
        }
        Ok(ids)
    }

    pub(super) fn body_index(&self, argument: impl FnOnce() -> String, id: BodyId) -> Result<usize> {
        self.body_slots.index(id).ok_or_else(|| Error::InvalidId { argument: argument(), bits: id.bits() })
    }

    /// Removes bodies, all or none. The others keep their identifiers and their order.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for an identifier given twice.
    pub fn remove_bodies(&mut self, ids: &[BodyId]) -> Result<()> {
        let mut gone = vec![false; self.bodies.len()];
        for (k, id) in ids.iter().enumerate() {
            let index = self.body_index(|| format!("ids[{k}]"), *id)?;
            if std::mem::replace(&mut gone[index], true) {
                return Err(Error::invalid(format!("ids[{k}]"), format!("0x{:016x}", id.bits()), "each body once"));
            }
        }
        let mut index = 0;
        let slots = &mut self.body_slots;
        self.bodies.retain(|body| {
            index += 1;
            if gone[index - 1] {
                slots.remove(body.id);
            }
            !gone[index - 1]
        });
        for (index, body) in self.bodies.iter().enumerate() {
            self.body_slots.moved(body.id, index);
        }
        // Strands record bodies' earlier poses by their indices in the list.
        for divergence in self.strands.iter_mut().filter_map(|strand| strand.divergence.as_deref_mut()) {
            divergence.bodies.clear();
        }
        self.constrained_substep.forget();
        Ok(())
    }

    /// Sends bodies to `frames` in `over_seconds` (0: within the next substep), as [`Solver::set_root_frames`] does roots.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for counts that differ or a time that is not finite and 0 or more; [`Error::InvalidId`].
    pub fn set_body_frames(&mut self, ids: &[BodyId], frames: &[Frame], over_seconds: f64) -> Result<()> {
        self.set_body_frames_of(ids.len(), listed_frames(ids, frames)?, over_seconds)
    }

    /// The same of `count` bodies and frames of any source, which is read twice: nothing is allocated.
    pub(crate) fn set_body_frames_of(
        &mut self,
        count: usize,
        frame_of: impl Fn(usize) -> Result<(BodyId, Frame)>,
        over_seconds: f64,
    ) -> Result<()> {
        check_not_negative(|| "over_seconds".into(), over_seconds)?;
        self.for_each_body_of(count, frame_of, |body, frame| body.move_to(frame, over_seconds))
    }

    /// Moves bodies to `frames` at once, at rest: they do not sweep what lies between.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for counts that differ; [`Error::InvalidId`].
    pub fn teleport_bodies(&mut self, ids: &[BodyId], frames: &[Frame]) -> Result<()> {
        self.teleport_bodies_of(ids.len(), listed_frames(ids, frames)?)
    }

    /// The same of `count` bodies and frames of any source, which is read twice: nothing is allocated.
    pub(crate) fn teleport_bodies_of(&mut self, count: usize, frame_of: impl Fn(usize) -> Result<(BodyId, Frame)>) -> Result<()> {
        self.for_each_body_of(count, frame_of, Body::place)
    }

    /// Checks all before it changes any.
    fn for_each_body_of(
        &mut self,
        count: usize,
        frame_of: impl Fn(usize) -> Result<(BodyId, Frame)>,
        change: impl Fn(&mut Body, Frame) -> Result<()>,
    ) -> Result<()> {
        for k in 0..count {
            let (id, frame) = frame_of(k)?;
            self.body_index(|| format!("ids[{k}]"), id)?;
            check_pose(format_args!("frames[{k}]"), &frame)?;
        }
        for k in 0..count {
            let (id, frame) = frame_of(k)?;
            let index = self.body_index(|| format!("ids[{k}]"), id)?;
            change(&mut self.bodies[index].body, frame)?;
        }
        Ok(())
    }

    /// Sends the vertices of a mesh (m, the body's axes) to new positions in `over_seconds` (0: within the next substep), each
    /// along a straight line at constant speed.
    ///
    /// # Errors
    /// [`Error::InvalidId`]; [`Error::Unsupported`] for a body that is not a mesh; [`Error::InvalidArgument`] for a count other
    /// than the mesh's, a number that is not finite, or a time that is not finite and 0 or more.
    pub fn set_body_vertices(&mut self, id: BodyId, vertices: &[Vector3<f64>], over_seconds: f64) -> Result<()> {
        let index = self.body_index(|| "id".into(), id)?;
        check_not_negative(|| "over_seconds".into(), over_seconds)?;
        let body = &mut self.bodies[index];
        body.body.set_vertices(vertices, over_seconds)?;
        body.deforms = true;
        body.content = OnceLock::new();
        Ok(())
    }

    /// Changes a body's thickness (m) and its factors of friction.
    ///
    /// # Errors
    /// [`Error::InvalidId`]; [`Error::InvalidArgument`] for a number that is not finite and 0 or more.
    pub fn set_body_surface(&mut self, id: BodyId, thickness: f64, friction: f64, viscous_friction: f64) -> Result<()> {
        let index = self.body_index(|| "id".into(), id)?;
        self.bodies[index].body.set_surface(thickness, friction, viscous_friction)
    }

    /// Changes a body's groups and the groups that it collides with.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn set_body_filter(&mut self, id: BodyId, group: u32, mask: u32) -> Result<()> {
        let index = self.body_index(|| "id".into(), id)?;
        self.bodies[index].body.set_filter(group, mask);
        Ok(())
    }

    /// The host's own number for a body; 0 until it is set.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn body_user_data(&self, id: BodyId) -> Result<u64> {
        Ok(self.bodies[self.body_index(|| "id".into(), id)?].user_data)
    }

    /// Sets the host's own number for a body. No step depends on it.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn set_body_user_data(&mut self, id: BodyId, user_data: u64) -> Result<()> {
        let index = self.body_index(|| "id".into(), id)?;
        self.bodies[index].user_data = user_data;
        Ok(())
    }

    /// A body's definition, at its current pose.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn body(&self, id: BodyId) -> Result<&BodyDef> {
        Ok(self.bodies[self.body_index(|| "id".into(), id)?].body.def())
    }

    /// The action of strands on a body in the last substep: force (N) and torque about its origin (N·m), world axes.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn body_wrench(&self, id: BodyId) -> Result<Wrench> {
        Ok(self.bodies[self.body_index(|| "id".into(), id)?].wrench)
    }

    /// All bodies' identifiers, in the order in which they were added.
    pub fn body_ids(&self) -> Vec<BodyId> {
        self.bodies.iter().map(|body| body.id).collect()
    }

    /// Sets the contact parameters of strands (`None`, the initial value: no contact).
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `contact.field`.
    pub fn set_contact(&mut self, ids: &[StrandId], contact: Option<&StrandContact>) -> Result<()> {
        if let Some(contact) = contact {
            contact.check("contact")?;
        }
        for index in self.indices(ids)? {
            self.strands[index].contact = contact.map(|contact| Box::new(*contact));
        }
        self.constrained_substep.forget_pairs();
        Ok(())
    }

    /// The same for different strands: one for each.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `contacts[i].field`, or for counts that differ.
    pub fn set_contacts(&mut self, ids: &[StrandId], contacts: &[StrandContact]) -> Result<()> {
        if contacts.len() != ids.len() {
            return Err(Error::invalid("contacts (count)", contacts.len(), format!("{}, one per strand", ids.len())));
        }
        for (k, contact) in contacts.iter().enumerate() {
            contact.check(&format!("contacts[{k}]"))?;
        }
        for (index, contact) in self.indices(ids)?.into_iter().zip(contacts) {
            self.strands[index].contact = Some(Box::new(*contact));
        }
        self.constrained_substep.forget_pairs();
        Ok(())
    }

    /// The contact parameters of a strand.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn contact(&self, id: StrandId) -> Result<Option<&StrandContact>> {
        Ok(self.strand("id", id)?.contact.as_deref())
    }

    /// Changes the contact options, from the next step on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `options.field`.
    pub fn set_contact_options(&mut self, options: &ContactOptions) -> Result<()> {
        options.check("options")?;
        self.options.contact = *options;
        self.constrained_substep.forget_pairs();
        Ok(())
    }

    /// The contacts at the end of the last substep that carried a force, by strand and arclength.
    pub fn contacts(&self) -> &[Contact] {
        self.constrained_substep.contacts()
    }
}

/// The identifiers and frames of two lists, one frame a body.
fn listed_frames<'a>(ids: &'a [BodyId], frames: &'a [Frame]) -> Result<impl Fn(usize) -> Result<(BodyId, Frame)> + 'a> {
    if frames.len() != ids.len() {
        return Err(Error::invalid("frames (count)", frames.len(), format!("{} frames, one per body", ids.len())));
    }
    Ok(|k| Ok((ids[k], frames[k])))
}
