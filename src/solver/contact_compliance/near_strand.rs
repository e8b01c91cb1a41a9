//! A strand near a tool: the places where forces act on it, and its response there.

use nalgebra::Vector3;

use super::search::{NearPlace, Search};
use super::{BodyContact, Places};
use crate::chain::load::MaterialPoint;
use crate::contact::body_at::BodyAt;
use crate::contact::constraint::law::coefficient::Coefficient;
use crate::contact::contact_point::StrandCurve;
use crate::contact::options::StrandContact;
use crate::contact::shape::Bounds;
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, element_states};
use crate::solver::bodies::ContactPartner;
use crate::solver::constraints::{ConstraintStatus, material_point_at};
use crate::solver::strands::strand::{Strand, drawn_by, root_after};
use crate::step::Setting;
use crate::step::constrained::single::ConstrainedSingle;
use crate::step::constrained::step::ConstrainedStep;
use crate::step::pack::members::One;
use crate::step::state::{StrandState, rotation_matrix};

/// A place near a contact under pressure is no contact of its own if it is within this distance of it along the strand, m, and
/// faces the same way to within this cosine.
const ONE_PLACE: f64 = 5e-4;
const ONE_SIDE: f64 = 0.9;
/// Iterations on a strand's displacement, if by the linear model one of its places moves by more than this fraction of its
/// length.
const MAX_ITERATIONS: u32 = 1;
const LINEAR: f64 = 0.01;

/// A place where something acts on a strand.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadedPoint {
    material_point: MaterialPoint,
    along: f64,
    force: Vec3<f64>,
    /// The contact with one of the bodies, if it is one.
    pub contact: Option<BodyContact>,
}

/// A strand near the bodies, and its memory.
#[derive(Debug, Default)]
pub(super) struct NearStrand {
    /// Its index in the solver.
    pub index: u32,
    elements: Vec<ElementState<f64>>,
    search: Search,
    pub places: Vec<LoadedPoint>,
    /// The response of its places, while being computed.
    pub response: Option<Box<Response>>,
}

/// The response of a strand's places, and its memory.
#[derive(Debug, Default)]
pub(super) struct Response {
    /// Its own copy of the strand's state, for the step that starts with it.
    state: StrandState,
    alone: ConstrainedSingle,
    material_points: Vec<MaterialPoint>,
    forces: Vec<Vec3<f64>>,
}

impl Response {
    /// Reserves memory for this many places.
    fn make_room(&mut self, most: usize) {
        self.material_points.clear();
        self.material_points.reserve(most);
        self.forces.clear();
        self.forces.reserve(most);
        self.alone.make_room(most);
    }
}

impl NearStrand {
    /// Finds the places closer than `within` (m) to the bodies, and lists them with those where something acts on the strand.
    /// Lists none if no place is near.
    pub fn find(&mut self, strand: &Strand, bodies: &[BodyAt], within: f64, acting: &Places) {
        self.places.clear();
        let Some(contact) = strand.contact.as_deref() else { return };
        let Strand { model, state, .. } = strand;
        element_states(rotation_matrix(&state.root), model.lengths.iter().copied(), &state.curvatures, &mut self.elements);
        let curve = StrandCurve { origin: state.root.origin, elements: &self.elements };
        let around = around(&curve).grown(contact.radius + within);
        let met = |body: &BodyAt| body.meets(contact.groups, contact.mask) && body.is_near(&around);
        self.search.find(&curve, [contact.exempt_length, contact.radius, within], bodies, met);
        self.list_contacts(strand, contact, bodies, acting);
        if self.search.found.is_empty() && self.places.iter().all(|place| place.contact.is_none()) {
            self.places.clear();
            return;
        }
        self.list_near(strand, contact, bodies, acting);
        let key = |place: &LoadedPoint| (place.material_point.element, place.material_point.s);
        self.places.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    }

    /// Reserves memory for `most` places, so that filling them allocates nothing.
    pub fn make_room(&mut self, most: usize) {
        self.search.found.reserve(most.saturating_sub(self.search.found.len()));
        self.places.reserve(most.saturating_sub(self.places.len()));
        if let Some(response) = &mut self.response {
            response.make_room(most);
        }
    }

    /// Whether one of its places is in contact with a body, or may soon be.
    pub fn has_contacts(&self) -> bool {
        self.places.iter().any(|place| place.contact.is_some())
    }

    /// A place on it.
    fn place(&self, strand: &Strand, along: f64, force: Vector3<f64>) -> LoadedPoint {
        LoadedPoint { material_point: material_point_at(&strand.model, along), along, force: force.into(), contact: None }
    }

    /// The length of the strand between two contacts with one body is divided equally between them.
    fn divide_reach(&mut self) {
        for k in 0..self.places.len() {
            let Some(contact) = self.places[k].contact else { continue };
            let others = self.places.iter().filter(|place| place.contact.is_some_and(|other| other.body == contact.body));
            let off = |place: &LoadedPoint| place.along - self.places[k].along;
            let [before, beyond] = others.fold(contact.reach, |[before, beyond], place| match off(place) {
                off if off < 0.0 => [before.min(-0.5 * off), beyond],
                off if off > 0.0 => [before, beyond.min(0.5 * off)],
                _ => [before, beyond],
            });
            self.places[k].contact = Some(BodyContact { reach: [before, beyond], ..contact });
        }
    }

    /// Computes the response of its places.
    pub fn condense(&mut self, strand: &Strand, setting: &Setting, seconds: f64) {
        let Self { response, places, elements, .. } = self;
        let Response { state, alone, material_points, forces } = &mut **response.get_or_insert_default();
        state.clone_from(&strand.state);
        material_points.clear();
        material_points.extend(places.iter().map(|place| place.material_point));
        forces.clear();
        forces.extend(places.iter().map(|place| place.force));
        let before = (strand.state.root.origin, &elements[..]);
        let start = state.root;
        let root_at = |elapsed: f64| root_after(&strand.root_move, &start, elapsed);
        let one = One { model: &strand.model, state, root_at: &root_at, target: drawn_by(&strand.target), touches: None };
        alone.begin(&one, setting, seconds, true);
        alone.linearise(material_points, forces);
        // (The first linear model has no tension.)
        for _ in 0..MAX_ITERATIONS {
            let farthest = (0..places.len()).map(|k| displacement(&alone.step, forces, k).norm_squared()).fold(0.0, f64::max);
            if farthest <= (LINEAR * strand.model.length()).powi(2) {
                break;
            }
            alone.advance(setting, forces);
            alone.linearise(material_points, forces);
        }
        let (model, acting) = (&strand.model, &alone.step);
        let max_force = model.mass() * model.length() / (seconds * seconds) + model.bending_force();
        for (k, place) in places.iter_mut().enumerate() {
            let Some(contact) = &mut place.contact else { continue };
            let moved = ConstrainedStep::place(acting.now(), &place.material_point)
                - ConstrainedStep::place(before, &place.material_point)
                + displacement(acting, forces, k);
            (contact.moved, contact.max_force) = (moved, max_force);
        }
    }

    /// Whether all its results are finite.
    pub fn is_finite(&self) -> bool {
        let told = self.places.iter().filter_map(|place| place.contact.as_ref());
        let mut moved = told.map(|contact| contact.moved);
        moved.all(|moved| moved.iter().all(|x| x.is_finite())) && self.columns().iter().all(|x| x.is_finite())
    }

    /// The matrix of all places.
    fn columns(&self) -> &[f64] {
        self.response.as_ref().map_or(&[], |response| &response.alone.step.delassus.columns)
    }

    /// The matrix's rows and columns of the contacts alone.
    pub fn write(&self, out: &mut Vec<f64>) {
        let columns = self.columns();
        let size = 3 * self.places.len();
        let rows =
            || self.places.iter().enumerate().filter(|(_, place)| place.contact.is_some()).flat_map(|(k, _)| 3 * k..3 * k + 3);
        for column in rows() {
            out.extend(rows().map(|row| columns[column * size + row]));
        }
    }

    /// A place in contact with a body, or soon to be.
    fn contact(
        &self,
        strand: &Strand,
        contact: &StrandContact,
        bodies: &[BodyAt],
        near: &NearPlace,
        force: Vector3<f64>,
    ) -> LoadedPoint {
        let NearPlace { body, along, normal, gap } = *near;
        let mut place = self.place(strand, along, force);
        let curve = StrandCurve { origin: strand.state.root.origin, elements: &self.elements };
        let (element, s) = (place.material_point.element, place.material_point.s);
        let (friction, scale) = (contact.friction, bodies[body].friction);
        let (tangent, margin) = (curve.tangent(element, s), contact.radius + bodies[body].thickness);
        place.contact = Some(BodyContact {
            body: body as u32,
            point: curve.position(element, s) - normal * (gap + margin),
            normal,
            gap,
            margin,
            tangent,
            reach: [(along - contact.exempt_length).max(0.0), (strand.model.length() - along).max(0.0)],
            friction: Coefficient::of_scales(friction.along * scale, friction.against * scale, tangent),
            force,
            max_force: 0.0,
            resistance: strand.model.cantilever(),
            moved: Vector3::zeros(),
        });
        place
    }

    /// The contacts of the last substep.
    fn list_contacts(&mut self, strand: &Strand, contact: &StrandContact, bodies: &[BodyAt], acting: &Places) {
        let first = acting.contacts.partition_point(|(index, ..)| *index < self.index);
        for (_, along, last) in acting.contacts[first..].iter().take_while(|(index, ..)| *index == self.index) {
            let body = match last.partner {
                ContactPartner::Body { body, .. } => acting.bodies.iter().position(|id| *id == body),
                ContactPartner::Strand { .. } => None,
            };
            let place = match body {
                Some(body) => {
                    let near = NearPlace { body, along: *along, normal: last.normal, gap: last.gap };
                    self.contact(strand, contact, bodies, &near, last.force)
                }
                None => self.place(strand, *along, last.force),
            };
            self.places.push(place);
        }
    }

    /// Near places, and constraints.
    fn list_near(&mut self, strand: &Strand, contact: &StrandContact, bodies: &[BodyAt], acting: &Places) {
        for k in 0..self.search.found.len() {
            let found = self.search.found[k];
            let is_known = self.places.iter().any(|place| {
                let same =
                    |contact: &BodyContact| contact.body as usize == found.body && contact.normal.dot(&found.normal) > ONE_SIDE;
                (place.along - found.along).abs() <= ONE_PLACE && place.contact.as_ref().is_some_and(same)
            });
            if !is_known && found.along > 0.0 && found.gap >= -acting.max_depth {
                self.places.push(self.contact(strand, contact, bodies, &found, Vector3::zeros()));
            }
        }
        self.divide_reach();
        for constraint in acting.constraints.iter().filter(|constraint| constraint.state.status != ConstraintStatus::Released) {
            if constraint.def.strand == strand.id {
                self.places.push(self.place(strand, constraint.state.arclength, constraint.state.force));
            }
            if let Some(along) = constraint.tied(strand.id) {
                self.places.push(self.place(strand, along, -constraint.state.force));
            }
        }
    }
}

/// Displacement of place `k` under forces by the linear model, m.
fn displacement(acting: &ConstrainedStep, forces: &[Vec3<f64>], k: usize) -> Vector3<f64> {
    let (mut moved, size) = (Vector3::from(acting.unconstrained[k]), 3 * forces.len());
    for (column, force) in forces.iter().flat_map(|force| force.0).enumerate() {
        let rows = &acting.delassus.columns[column * size + 3 * k..][..3];
        moved += Vector3::new(rows[0], rows[1], rows[2]) * force;
    }
    moved
}

/// A box around a strand.
fn around(curve: &StrandCurve) -> Bounds {
    let of_element = |state: &ElementState<f64>| {
        let [left, right] = [state.origin_left, state.origin_right()].map(|end| curve.origin + Vector3::from(end));
        Bounds::of_points([left, right]).grown(state.off_chord())
    };
    curve.elements.iter().map(of_element).fold(Bounds::EMPTY, |all, bounds| all.union(&bounds))
}
