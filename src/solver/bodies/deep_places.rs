//! Overlaps of strands with bodies and with each other in the current scene, independent of any step.

use crate::contact::body_at::BodyAt;
use crate::contact::broad_phase::hair_pairs::{HairPairs, HeldRoots, PairOptions};
use crate::contact::contact_point::{ContactPoint, Partner, StrandCurve, StrandPath, StrandPoint};
use crate::contact::narrow_phase::path_bounds::PathBounds;
use crate::contact::narrow_phase::strand_body::{self, Span};
use crate::contact::narrow_phase::strand_contacts::PairScratch;
use crate::contact::options::StrandContact;
use crate::coupled::detection::{NEAR, pair_options};
use crate::rod::kinematics::{ElementState, element_states};
use crate::solver::constraints::Constraint;
use crate::solver::constraints::ties::ties;
use crate::solver::id::{SlotMap, StrandId};
use crate::solver::stepping::workers::WorkerSet;
use crate::solver::strands::strand::Strand;
use crate::step::state::rotation_matrix;

/// A place where two surfaces overlap, without permitted overlaps.
#[derive(Debug, Clone, Copy)]
pub(in crate::solver) struct DeepPlace {
    /// The place, and the strand by its index in the solver.
    pub point: StrandPoint,
    /// The place on the other strand, or the body.
    pub partner: Partner,
    /// Distance of the centrelines along the normal, m; between strand and body that of the surfaces, below zero.
    pub distance: f64,
    /// The distance below which they press, m: between strands the sum of their radii, reduced by a knot near by.
    room: f64,
}

/// Places per element for the depth in bodies.
const PLACES: u32 = 16;

/// The current scene.
pub(in crate::solver) struct CurrentScene<'a> {
    pub strands: &'a [Strand],
    pub slots: &'a SlotMap<StrandId>,
    pub constraints: &'a [Constraint],
    /// At rest.
    pub bodies: &'a [BodyAt<'a>],
    /// Whether hair collides with hair.
    pub hair: bool,
    pub workers: &'a WorkerSet,
}

/// A strand's current curve.
#[derive(Debug, Default)]
struct Curve {
    elements: Vec<ElementState<f64>>,
    /// Its overlaps with bodies.
    deep: Vec<ContactPoint>,
}

impl CurrentScene<'_> {
    /// Depth of a place beyond the permitted overlap, m.
    pub fn depth(&self, deep: &DeepPlace) -> f64 {
        match deep.partner {
            Partner::Body { .. } => -deep.distance - self.allowed(&deep.point).1,
            Partner::Strand(other) => deep.room.min(self.wisp_radius(&deep.point) + self.wisp_radius(&other)) - deep.distance,
        }
    }

    /// The part of its strand's radius that a place contributes among wisps, m.
    pub fn wisp_radius(&self, place: &StrandPoint) -> f64 {
        let contact = self.strands[place.strand as usize].contact.as_deref();
        contact.map_or(0.0, |contact| contact.wisp_radius) * self.allowed(place).0
    }

    /// The remaining wisp radius at a place, and the permitted depth of the strand in a body there.
    fn allowed(&self, place: &StrandPoint) -> (f64, f64) {
        let strand = &self.strands[place.strand as usize];
        let along = || strand.model.lengths[..place.element as usize].iter().sum::<f64>() + place.s;
        strand.permitted_overlap.as_deref().map_or((1.0, 0.0), |permitted_overlap| {
            let along = along();
            (permitted_overlap.wisp_fraction(along), permitted_overlap.sunk(along))
        })
    }

    /// All places where surfaces of the selected strands overlap others, as a step detects them: by strand and arclength with
    /// bodies, then between strands of which at least one is selected.
    pub fn deep_places(&self, asked: impl Fn(usize) -> bool + Sync) -> Vec<DeepPlace> {
        let mut curves: Vec<(usize, Curve)> = (0..self.strands.len()).map(|index| (index, Curve::default())).collect();
        self.workers.for_each(&mut curves, |(index, curve), _| {
            let Strand { model, state, contact, .. } = &self.strands[*index];
            let Some(contact) = contact.as_deref() else { return };
            element_states(rotation_matrix(&state.root), model.lengths.iter().copied(), &state.curvatures, &mut curve.elements);
            if !asked(*index) {
                return;
            }
            let StrandContact { exempt_length: exempt, radius, groups, mask, .. } = *contact;
            let path = path(*index as u32, state.root.origin, &curve.elements);
            let (mut bounds, mut scratch) = (PathBounds::default(), strand_body::BodySearchScratch::default());
            bounds.update(&path);
            for body in self.bodies.iter().filter(|body| body.meets(groups, mask)) {
                strand_body::contacts(
                    &path,
                    &bounds,
                    Span { exempt, unmoved: &[] },
                    radius,
                    body,
                    NEAR,
                    &mut scratch,
                    &mut curve.deep,
                );
            }
        });
        let in_bodies = curves.iter().flat_map(|(_, curve)| &curve.deep);
        let mut deep: Vec<DeepPlace> = in_bodies
            .filter(|contact| contact.gap < 0.0)
            .map(|contact| DeepPlace { point: contact.point, partner: contact.partner, distance: contact.gap, room: 0.0 })
            .collect();
        if self.hair {
            self.deep_in_hair(&curves, &asked, &mut deep);
        }
        deep
    }

    /// Depths of elements of the selected strands in bodies, surface to surface, m: at places evenly along each overlapping
    /// element.
    pub fn depths_in_bodies(&self, asked: impl Fn(usize) -> bool + Sync) -> Vec<(StrandPoint, f64)> {
        let mut found: Vec<(usize, Vec<(StrandPoint, f64)>)> = (0..self.strands.len()).map(|index| (index, Vec::new())).collect();
        self.workers.for_each(&mut found, |(index, found), _| {
            let Strand { model, state, contact, .. } = &self.strands[*index];
            let Some(contact) = contact.as_deref().filter(|_| asked(*index)) else { return };
            let mut elements = Vec::new();
            element_states(rotation_matrix(&state.root), model.lengths.iter().copied(), &state.curvatures, &mut elements);
            let curve = StrandCurve { origin: state.root.origin, elements: &elements };
            for body in self.bodies.iter().filter(|body| body.meets(contact.groups, contact.mask)) {
                let (to_body, thickness) = (body.end.rotation.inverse(), contact.radius + body.thickness);
                for (element, length) in model.lengths.iter().enumerate() {
                    for k in 0..=PLACES {
                        let s = length * f64::from(k) / f64::from(PLACES);
                        let at = to_body * (curve.position(element, s) - body.end.origin);
                        if let Some(surface) = body.shape.closest(at, thickness) {
                            let place = StrandPoint { strand: *index as u32, element: element as u32, s };
                            found.push((place, thickness - surface.distance));
                        }
                    }
                }
            }
        });
        found.into_iter().flat_map(|(_, found)| found).collect()
    }

    fn deep_in_hair(&self, curves: &[(usize, Curve)], asked: impl Fn(usize) -> bool, deep: &mut Vec<DeepPlace>) {
        let (mut of, mut wisps, mut paths) = (Vec::new(), Vec::new(), Vec::new());
        for (index, curve) in curves {
            let Some(contact) = self.strands[*index].contact.as_deref().filter(|contact| contact.wisp_radius > 0.0) else {
                continue;
            };
            of.push(*index);
            wisps.push(contact.wisp());
            paths.push(path(*index as u32, self.strands[*index].state.root.origin, &curve.elements));
        }
        // As in a step: contacts that it merges are merged here too.
        // But what overlaps at roots overlaps beside them too, where no nearest place shows it.
        let options = PairOptions { margin: 0.0, held_roots: HeldRoots::Counted, ..pair_options(&wisps) };
        let mut pairs = HairPairs::default();
        let ties: Vec<_> = ties(self.constraints, |id| of.binary_search(&self.slots.index(id)?).ok()).collect();
        // Everything that could be refused was checked when the solver received it.
        if pairs.set(&wisps, &options).and_then(|()| pairs.set_ties(&ties)).and_then(|()| pairs.update(&paths)).is_err() {
            return;
        }
        let (mut scratch, mut contacts) = (PairScratch::default(), Vec::new());
        for group in pairs.groups().iter().filter(|group| [group.a, group.b].iter().any(|wisp| asked(of[*wisp as usize]))) {
            contacts.clear();
            pairs.contacts(group, &paths, 0.0, &mut scratch, &mut contacts);
            for contact in contacts.iter().filter(|contact| contact.gap < 0.0) {
                let Partner::Strand(other) = contact.partner else { continue };
                let at = |path: &StrandPath, place: &StrandPoint| path.now.position(place.element as usize, place.s);
                let apart = at(&paths[group.a as usize], &contact.point) - at(&paths[group.b as usize], &other);
                let distance = contact.normal.dot(&apart);
                deep.push(DeepPlace { point: contact.point, partner: contact.partner, distance, room: distance - contact.gap });
            }
        }
    }
}

fn path(index: u32, origin: nalgebra::Vector3<f64>, elements: &[ElementState<f64>]) -> StrandPath<'_> {
    let curve = StrandCurve { origin, elements };
    StrandPath { index, start: curve, now: curve, permitted_overlap: None }
}
