//! The device's own contact solve: Signorini's and Coulomb's laws at the contacts of a local model, with the tool where the hand
//! has it now.
//!
//! At the fraction `s` of the model's seconds a point of contact moves by s·moved + W (λ − λ₀). At s = 0, with the tool unmoved,
//! the simulation's forces λ₀ are the solution; s = 1 is the simulation's own next step. Strands are coupled through the tool,
//! which yields by the virtual coupling. Gaps and normals are those of the tool's shapes at the current positions of strands and
//! tool, under the forces of the last update. Sweeps over the contacts (Gauss–Seidel), each with its law's exact solution, start
//! from these forces.

use nalgebra::{Matrix3, Vector3};

use super::coupling::{Compliance, moved};
use super::geometry::Tooth;
use super::local_model::LocalModel;
use crate::contact::constraint::law::contact::{Contact, Friction};
use crate::contact::constraint::law::response::Response;
use crate::contact::constraint::law::{Law, LawSolve};
use crate::math::frame::Frame;
use crate::solver::contact_compliance::BodyContact;
use crate::solver::report::Wrench;

/// Sweeps end when no force changes by more than this fraction of the largest.
const CHANGE: f64 = 1e-4;
/// Where the last sweep changes forces by more than this fraction of the largest, they are relaxed by one half.
const UNSOLVED: f64 = 0.01;
/// How far beyond the simulation's next step strands are extrapolated.
const FARTHEST: f64 = 2.0;
/// A surface whose normal has turned away from the model's by more than this cosine is a different one: the model's own surface
/// stays in use.
const SAME_SIDE: f64 = 0.2;

/// The gap of a contact that no longer exists, m.
const FAR: f64 = 1.0;

/// The largest slide of a contact into the surface within a step, m.
const MAX_SLIDE: f64 = 1e-4;

/// A contact's part in the solve.
#[derive(Debug, Clone, Copy)]
struct ContactRow {
    law: LawSolve,
    /// Displacement of the strand's point per force on it.
    own: Matrix3<f64>,
    /// The same with the tool's compliance.
    response: Matrix3<f64>,
    /// From the handle's origin to the tool's point.
    arm: Vector3<f64>,
    /// The gap's displacement with the model's forces and a rigid tool.
    unconstrained: Vector3<f64>,
    force: Vector3<f64>,
    /// The force of the last update.
    before: Vector3<f64>,
    /// How much closer the surface is than in the simulation because the contact slid within its step, m: a contact under
    /// pressure stays under pressure.
    slid: f64,
}

/// The result of a solve.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Solved {
    /// On the tool, about its handle's origin, including forces without a contact.
    pub wrench: Wrench,
    /// The tool's displacement.
    pub moved: Vector3<f64>,
    pub turned: Vector3<f64>,
    pub sweeps: u32,
    pub pressing: u32,
    /// The last change of a force relative to the largest.
    pub change: f64,
}

/// The contacts of the current local model.
#[derive(Debug)]
pub(super) struct ContactForces {
    rows: Vec<ContactRow>,
    teeth: Vec<Tooth>,
}

/// Minus the sum of the forces on strands, at the tool.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

impl Sum {
    fn add(&mut self, arm: &Vector3<f64>, force: &Vector3<f64>) {
        self.force += force;
        self.moment += arm.cross(force);
    }
}

fn law(contact: &BodyContact, normal: Vector3<f64>, response: &Matrix3<f64>, seconds: f64) -> LawSolve {
    let contact = Contact { normal, response: Response::Hard, friction: Friction::Coulomb(contact.friction) };
    LawSolve::new(&Law::Contact(contact), response, seconds)
}

impl ContactForces {
    pub fn new(most: usize, teeth: Vec<Tooth>) -> Self {
        Self { rows: Vec::with_capacity(most), teeth }
    }

    /// Starts with another model, from its own forces.
    pub fn begin(&mut self, model: &LocalModel) {
        self.rows.clear();
        for (range, response) in model.strands() {
            let size = 3 * range.len();
            for (k, contact) in model.contacts[range].iter().enumerate() {
                let own = Matrix3::from_fn(|i, j| response[(3 * k + j) * size + 3 * k + i]);
                let arm = contact.point - model.handle.origin;
                let law = law(contact, contact.normal, &own, model.seconds);
                let slid = match self.teeth.get(contact.body as usize) {
                    Some(tooth) if contact.force != Vector3::zeros() => {
                        let near = tooth.nearest(&model.handle, contact.strand_point(), contact.tangent, contact.reach);
                        near.map_or(0.0, |near| near.distance - contact.margin - contact.gap).clamp(-MAX_SLIDE, 0.0)
                    }
                    _ => 0.0,
                };
                self.rows.push(ContactRow {
                    law,
                    own,
                    response: own,
                    arm,
                    unconstrained: Vector3::zeros(),
                    force: contact.force,
                    before: contact.force,
                    slid,
                });
            }
        }
    }

    /// Displacement of the strand's point of contact `k` by the difference of the forces from the model's; `matrix` is the
    /// strand's.
    #[inline(always)]
    fn displacement_of(rows: &[ContactRow], contacts: &[BodyContact], matrix: &[f64], k: usize) -> Vector3<f64> {
        let size = 3 * contacts.len();
        // Symmetric: three columns are three rows.
        let own = &matrix[3 * k * size..][..3 * size];
        let mut sum = Vector3::zeros();
        for (j, (row, contact)) in rows.iter().zip(contacts).enumerate() {
            let by = row.force - contact.force;
            for axis in 0..3 {
                let numbers = &own[axis * size + 3 * j..][..3];
                sum[axis] += numbers[0] * by.x + numbers[1] * by.y + numbers[2] * by.z;
            }
        }
        sum
    }

    /// Evaluates strands and tool under the forces of the last update, at the fraction `part` of the model's seconds.
    fn look(&mut self, model: &LocalModel, handle: &Frame, part: f64, compliance: Compliance) -> Sum {
        let mut sum = Sum::default();
        self.rows.iter().for_each(|row| sum.add(&row.arm, &row.force));
        let (yielded, turned) = (-sum.force * compliance.linear, -sum.moment * compliance.angular);
        let tool = moved(handle, yielded, turned);
        let turn = tool.rotation * model.handle.rotation.inverse();
        sum = Sum::default();
        for (range, response) in model.strands() {
            let (rows, contacts) = (&mut self.rows[range.clone()], &model.contacts[range]);
            for (k, contact) in contacts.iter().enumerate() {
                let displacement = Self::displacement_of(rows, contacts, response, k);
                let was = contact.strand_point();
                let now = was + contact.moved * part + displacement;
                let carried = tool.origin + turn * (contact.point - model.handle.origin) - contact.point;
                let found = self
                    .teeth
                    .get(contact.body as usize)
                    .and_then(|tooth| tooth.nearest(&tool, now, contact.tangent, contact.reach));
                let slip = now - was - carried;
                let (normal, gap, point) = match found {
                    Some(near) if near.normal.dot(&(turn * contact.normal)) > SAME_SIDE => {
                        (near.normal, near.distance - contact.margin - rows[k].slid, near.point)
                    }
                    Some(_) => (contact.normal, contact.gap + contact.normal.dot(&slip), contact.point + carried),
                    None => (contact.normal, FAR, contact.point + carried),
                };
                let row = &mut rows[k];
                row.arm = point - tool.origin;
                let across = row.arm.cross_matrix();
                row.response = row.own + Matrix3::identity() * compliance.linear - across * across * compliance.angular;
                row.law = law(contact, normal, &row.response, model.seconds);
                let u = normal * gap + (slip - normal * normal.dot(&slip));
                // Without the effect of these forces.
                row.unconstrained = u - displacement + yielded + turned.cross(&row.arm);
                sum.add(&row.arm, &row.force);
            }
        }
        sum
    }

    /// The forces `age` seconds after the pose of the model's step, if the handle would be at `handle` without any force on it.
    pub fn solve(&mut self, model: &LocalModel, handle: &Frame, age: f64, max_sweeps: u32, compliance: Compliance) -> Solved {
        let part = (age / model.seconds).clamp(0.0, FARTHEST);
        let mut sum = self.look(model, handle, part, compliance);
        self.rows.iter_mut().for_each(|row| row.before = row.force);
        let mut solved = Solved::default();
        while solved.sweeps < max_sweeps && !self.rows.is_empty() {
            let (mut change, mut largest) = (0.0_f64, f64::MIN_POSITIVE);
            for (range, response) in model.strands() {
                let (rows, contacts) = (&mut self.rows[range.clone()], &model.contacts[range]);
                for k in 0..contacts.len() {
                    let mut u = Self::displacement_of(rows, contacts, response, k);
                    let row = &mut rows[k];
                    u += row.unconstrained + sum.force * compliance.linear + sum.moment.cross(&row.arm) * compliance.angular;
                    let force = row.law.solve(u - row.response * row.force);
                    let size = force.norm();
                    let most = contacts[k].max_force.max(contacts[k].force.norm());
                    let force = if size > most { force * (most / size) } else { force };
                    let by = force - row.force;
                    if by.iter().all(|x| x.is_finite()) {
                        row.force = force;
                        sum.add(&row.arm, &by);
                        change = change.max(by.norm());
                        largest = largest.max(force.norm());
                    }
                }
            }
            solved.sweeps += 1;
            solved.change = change / largest;
            if solved.change <= CHANGE {
                break;
            }
        }
        if solved.change > UNSOLVED {
            // A jammed contact has no unique solution: it must not jump between solutions.
            sum = Sum::default();
            for row in &mut self.rows {
                row.force = 0.5 * (row.force + row.before);
                sum.add(&row.arm, &row.force);
            }
        }
        solved.pressing = self.rows.iter().filter(|row| row.force != Vector3::zeros()).count() as u32;
        (solved.moved, solved.turned) = (-sum.force * compliance.linear, -sum.moment * compliance.angular);
        solved.wrench = Wrench { force: model.rest.force - sum.force, torque: model.rest.torque - sum.moment };
        solved
    }
}
