//! What strands overlap as they are now, and having it allowed: a groom that is drawn with wisps in wisps and hair in a head then bears no
//! force where it stands.

use super::Solver;
use super::id::{BodyId, StrandId};
use super::touching::{pair_options, tied};
use crate::contact::allowance::Allowance;
use crate::contact::body::BodyAt;
use crate::contact::hair_pairs::{HairPairs, PairOptions};
use crate::contact::options::StrandContact;
use crate::contact::strand_body::{self, PathBounds, Span};
use crate::contact::touch::{Partner, Place, StrandCurve, StrandPath, Touch};
use crate::contact::touches::TouchScratch;
use crate::error::{Error, Result};
use crate::rod::kinematics::{ElementState, element_states};
use crate::step::state::rotation_matrix;

/// How deep a strand is in others and in bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overlap {
    /// How deep it is in the strand that it is deepest in, m: what the distance of the centrelines lacks to the sum of the radii. 0: in none.
    pub hair: f64,
    /// Which strand that is.
    pub strand: Option<StrandId>,
    /// How deep its surface is in the body that it is deepest in, m. 0: in none.
    pub bodies: f64,
    /// Which body that is.
    pub body: Option<BodyId>,
}

/// A place where two surfaces are in each other, before anything is allowed.
#[derive(Debug, Clone, Copy)]
struct Deep {
    /// Where, and on which strand by its index in the solver.
    place: Place,
    /// The other strand's place, or which body it is.
    partner: Partner,
    /// Distance of the centrelines along the normal, m; of strand and body that of the surfaces, below zero.
    distance: f64,
    /// Up to which distance they would press, m: of strands the sum of their radii, less what a knot near by takes of it.
    room: f64,
}

/// A strand's curve as it is now.
#[derive(Debug, Default)]
struct Curve {
    elements: Vec<ElementState<f64>>,
    /// Its overlaps with bodies.
    deep: Vec<Touch>,
}

impl Solver {
    /// How deep each strand is in others (where [`ContactOptions::hair`](crate::contact::options::ContactOptions::hair) is set) and in bodies
    /// as they are now, less what it is allowed ([`Solver::allow_overlaps`]); in the order of `ids`. Strands without contact overlap nothing, what is
    /// exempt or filtered out does not count. Moves nothing; a mesh on its way is taken where it is.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn overlaps(&mut self, ids: &[StrandId]) -> Result<Vec<Overlap>> {
        let indices = self.indices(ids)?;
        let deep = self.deep();
        let mut found = vec![Overlap::default(); self.strands.len()];
        for deep in &deep {
            let a = deep.place.strand as usize;
            match deep.partner {
                Partner::Body { body, .. } => {
                    let depth = -deep.distance - self.allowed(&deep.place).1;
                    if depth > found[a].bodies {
                        (found[a].bodies, found[a].body) = (depth, Some(self.bodies[body as usize].id));
                    }
                }
                Partner::Strand(other) => {
                    let depth = deep.room.min(self.wisp_radius(&deep.place) + self.wisp_radius(&other)) - deep.distance;
                    let b = other.strand as usize;
                    for (this, that) in [(a, b), (b, a)] {
                        if depth > found[this].hair {
                            (found[this].hair, found[this].strand) = (depth, Some(self.strands[that].id));
                        }
                    }
                }
            }
        }
        Ok(indices.into_iter().map(|index| found[index]).collect())
    }

    /// Allows the strands what they overlap now, so that no touch presses as long as they stay as they are: with rest shapes
    /// ([`Solver::take_rest_shapes`]) the groom as it stands is at rest, however its wisps and bodies were drawn into each other. Where two wisps
    /// overlap both keep the same share of their radii (of a strand that is not among `ids` the other one keeps what is left), where a strand is in a body
    /// it may be as deep there; to either side as far as the element goes. What was allowed before is forgotten. Away from these places
    /// strands touch as before; bits of steps without allowances are as if this were unknown.
    ///
    /// Tells what was overlapped, in the order of `ids`, as [`Solver::overlaps`] does without allowances.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for a strand named twice. Then nothing has changed.
    pub fn allow_overlaps(&mut self, ids: &[StrandId]) -> Result<Vec<Overlap>> {
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        for index in &indices {
            self.strands[*index].allowance = None;
        }
        let overlaps = self.overlaps(ids)?;
        let mut named = vec![false; self.strands.len()];
        indices.iter().for_each(|index| named[*index] = true);
        let deep = self.deep();
        let stations = |index: usize| none_at(&self.strands[index].model.lengths);
        let mut made: Vec<Option<Allowance>> = vec![None; self.strands.len()];
        for deep in deep {
            match deep.partner {
                Partner::Body { .. } => {
                    let (index, element) = (deep.place.strand as usize, deep.place.element as usize);
                    if named[index] {
                        let allowance = made[index].get_or_insert_with(|| stations(index));
                        for sunk in &mut allowance.sunk[element..element + 2] {
                            *sunk = sunk.max(-deep.distance);
                        }
                    }
                }
                Partner::Strand(other) => {
                    // Radii of those that give way, and what is left for them.
                    let ends = [deep.place, other];
                    let gives = ends.map(|end| named[end.strand as usize]);
                    let radius = |end: usize| self.wisp_radius(&ends[end]);
                    let (mut give, mut left) = (0.0, deep.distance);
                    for end in 0..2 {
                        if gives[end] {
                            give += radius(end);
                        } else {
                            left -= radius(end);
                        }
                    }
                    for end in (0..2).filter(|end| gives[*end] && give > 0.0) {
                        let (index, element) = (ends[end].strand as usize, ends[end].element as usize);
                        let allowance = made[index].get_or_insert_with(|| stations(index));
                        for share in &mut allowance.wisp_shares[element..element + 2] {
                            *share = share.min((left / give).max(0.0));
                        }
                    }
                }
            }
        }
        for (index, allowance) in made.into_iter().enumerate() {
            if let Some(allowance) = allowance {
                self.strands[index].allowance = Some(Box::new(allowance));
            }
        }
        Ok(overlaps)
    }

    /// Says what strands may overlap (`None`: nothing, which is how they begin): one allowance for each, as [`Solver::allowance`] gave it.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `allowances[i].field`, or for counts that differ. Then nothing
    /// has changed.
    pub fn set_allowances(&mut self, ids: &[StrandId], allowances: &[Option<Allowance>]) -> Result<()> {
        if allowances.len() != ids.len() {
            return Err(Error::invalid("allowances (count)", allowances.len(), format!("{}, one a strand", ids.len())));
        }
        for (k, allowance) in allowances.iter().enumerate() {
            allowance.as_ref().map_or(Ok(()), |allowance| allowance.check(&format!("allowances[{k}]")))?;
        }
        for (index, allowance) in self.indices(ids)?.into_iter().zip(allowances) {
            self.strands[index].allowance = allowance.clone().map(Box::new);
        }
        Ok(())
    }

    /// What a strand may overlap.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn allowance(&self, id: StrandId) -> Result<Option<&Allowance>> {
        Ok(self.strand("id", id)?.allowance.as_deref())
    }

    /// What is left of the wisp's radius at a place, and how far the strand may be in a body there.
    fn allowed(&self, place: &Place) -> (f64, f64) {
        let strand = &self.strands[place.strand as usize];
        let along = || strand.model.lengths[..place.element as usize].iter().sum::<f64>() + place.s;
        strand.allowance.as_deref().map_or((1.0, 0.0), |allowance| {
            let along = along();
            (allowance.wisp_share(along), allowance.sunk(along))
        })
    }

    fn wisp_radius(&self, place: &Place) -> f64 {
        let contact = self.strands[place.strand as usize].contact.as_deref();
        contact.map_or(0.0, |contact| contact.wisp_radius) * self.allowed(place).0
    }

    /// All places where surfaces are in each other now, as a step looks for them: by strand and arclength with bodies, then between strands.
    fn deep(&mut self) -> Vec<Deep> {
        for body in &mut self.bodies {
            body.body.rest();
        }
        let bodies: Vec<BodyAt> = self.bodies.iter().enumerate().map(|(k, scene)| scene.body.still(k as u32)).collect();
        let mut curves: Vec<(usize, Curve)> = (0..self.strands.len()).map(|index| (index, Curve::default())).collect();
        let strands = &self.strands;
        self.crew.for_each(&mut curves, |(index, curve), _| {
            let (model, state) = (&strands[*index].model, &strands[*index].state);
            let Some(contact) = strands[*index].contact.as_deref() else { return };
            let frame = rotation_matrix(&state.root);
            element_states(frame, model.lengths.iter().copied(), &state.curvatures, &mut curve.elements);
            let StrandContact { exempt_length: exempt, radius, groups, mask, .. } = *contact;
            let path = path(*index as u32, state.root.origin, &curve.elements);
            let (mut bounds, mut scratch) = (PathBounds::default(), strand_body::Scratch::default());
            bounds.update(&path);
            for body in bodies.iter().filter(|body| body.meets(groups, mask)) {
                strand_body::touches(&path, &bounds, Span { exempt }, radius, body, 0.0, &mut scratch, &mut curve.deep);
            }
        });
        let in_bodies = curves.iter().flat_map(|(_, curve)| &curve.deep);
        let mut deep: Vec<Deep> = in_bodies
            .filter(|touch| touch.gap < 0.0)
            .map(|touch| Deep { place: touch.place, partner: touch.partner, distance: touch.gap, room: 0.0 })
            .collect();
        if self.options.contact.hair {
            self.deep_in_hair(&curves, &mut deep);
        }
        deep
    }

    fn deep_in_hair(&self, curves: &[(usize, Curve)], deep: &mut Vec<Deep>) {
        let (mut of, mut wisps, mut paths) = (Vec::new(), Vec::new(), Vec::new());
        for (index, curve) in curves {
            let Some(contact) = self.strands[*index].contact.as_deref().filter(|contact| contact.wisp_radius > 0.0) else {
                continue;
            };
            of.push(*index);
            wisps.push(contact.wisp());
            paths.push(path(*index as u32, self.strands[*index].state.root.origin, &curve.elements));
        }
        // As a step looks: the touches that it takes for one are one here too.
        let options = PairOptions { margin: 0.0, ..pair_options(&wisps) };
        let (mut pairs, mut ties) = (HairPairs::default(), Vec::new());
        tied(&self.constraints, |id| of.binary_search(&self.slots.index(id)?).ok(), &mut ties);
        // What could be refused was checked when it was given to the solver.
        if pairs.set(&wisps, &options).and_then(|()| pairs.set_ties(&ties)).and_then(|()| pairs.update(&paths)).is_err() {
            return;
        }
        let (mut scratch, mut touches) = (TouchScratch::default(), Vec::new());
        for group in pairs.groups() {
            touches.clear();
            pairs.touches(group, &paths, 0.0, &mut scratch, &mut touches);
            for touch in touches.iter().filter(|touch| touch.gap < 0.0) {
                let Partner::Strand(other) = touch.partner else { continue };
                let at = |path: &StrandPath, place: &Place| path.now.position(place.element as usize, place.s);
                let apart = at(&paths[group.a as usize], &touch.place) - at(&paths[group.b as usize], &other);
                let distance = touch.normal.dot(&apart);
                deep.push(Deep { place: touch.place, partner: touch.partner, distance, room: distance - touch.gap });
            }
        }
    }
}

/// An allowance of nothing, with stations where elements end.
fn none_at(lengths: &[f64]) -> Allowance {
    let mut along = vec![0.0];
    along.extend(lengths.iter().scan(0.0, |along, length| {
        *along += length;
        Some(*along)
    }));
    Allowance { wisp_shares: vec![1.0; along.len()], sunk: vec![0.0; along.len()], along }
}

fn path(index: u32, origin: nalgebra::Vector3<f64>, elements: &[ElementState<f64>]) -> StrandPath<'_> {
    let curve = StrandCurve { origin, elements };
    StrandPath { index, start: curve, now: curve }
}
