//! Overlaps of strands in the current scene, and permitted overlaps: a groom drawn with wisps in wisps and hair in a head then
//! bears no force in its drawn shape.

use std::sync::Arc;

use super::deep_places::CurrentScene;
use crate::contact::body_at::BodyAt;
use crate::contact::contact_point::Partner;
use crate::contact::permitted_overlap::PermittedOverlap;
use crate::error::{Error, Result};
use crate::solver::Solver;
use crate::solver::id::{BodyId, StrandId};

/// The depth of a strand in others and in bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overlap {
    /// Its largest depth in another strand, m: the sum of the radii minus the distance of the centrelines. 0 for none.
    pub hair: f64,
    /// The strand of that depth.
    pub strand: Option<StrandId>,
    /// The largest depth of its surface in a body, m. 0 for none.
    pub bodies: f64,
    /// The body of that depth.
    pub body: Option<BodyId>,
}

impl Solver {
    /// The current depths of each strand in others (if [`ContactOptions::hair`](crate::contact::options::ContactOptions::hair) is
    /// set) and in bodies, minus its permitted overlap ([`Solver::allow_overlaps`]); in the order of `ids`. Strands without
    /// contact overlap nothing; exempt lengths and filtered pairs do not count. Moves nothing; a moving mesh counts at its
    /// current position.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn overlaps(&mut self, ids: &[StrandId]) -> Result<Vec<Overlap>> {
        let indices = self.indices(ids)?;
        self.rest_bodies();
        let bodies = self.bodies_at_rest();
        let scene = self.current_scene(&bodies);
        let mut found = vec![Overlap::default(); self.strands.len()];
        for deep in &scene.deep_places(|_| true) {
            let (a, depth) = (deep.point.strand as usize, scene.depth(deep));
            match deep.partner {
                Partner::Body { body, .. } => {
                    if depth > found[a].bodies {
                        (found[a].bodies, found[a].body) = (depth, Some(self.bodies[body as usize].id));
                    }
                }
                Partner::Strand(other) => {
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

    /// Permits the strands their current overlaps, so that no contact presses as long as they stay: with rest shapes
    /// ([`Solver::take_rest_shapes`]) the groom is at rest as it stands, however its wisps and bodies were drawn into each other.
    /// Where two wisps overlap both keep the same fraction of their radii (for a strand outside `ids` the other one keeps what is
    /// left). Where a strand is in a body it may be as deep there, to either side over the whole element. Earlier permitted
    /// overlaps are discarded. Elsewhere strands collide as before; without permitted overlaps steps give the same bits as
    /// without this feature.
    ///
    /// Returns the overlaps, in the order of `ids`, as [`Solver::overlaps`] does without permitted overlaps.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for a strand named twice. Nothing has then changed.
    pub fn allow_overlaps(&mut self, ids: &[StrandId]) -> Result<Vec<Overlap>> {
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        for index in &indices {
            self.strands[*index].permitted_overlap = None;
        }
        let overlaps = self.overlaps(ids)?;
        let mut named = vec![false; self.strands.len()];
        indices.iter().for_each(|index| named[*index] = true);
        let bodies = self.bodies_at_rest();
        let scene = self.current_scene(&bodies);
        let material_points = |index: usize| none_at(&self.strands[index].model.lengths);
        let mut made: Vec<Option<PermittedOverlap>> = vec![None; self.strands.len()];
        for deep in scene.deep_places(|_| true) {
            match deep.partner {
                Partner::Body { .. } => {
                    let (index, element) = (deep.point.strand as usize, deep.point.element as usize);
                    if named[index] {
                        let permitted_overlap = made[index].get_or_insert_with(|| material_points(index));
                        for sunk in &mut permitted_overlap.sunk[element..element + 2] {
                            *sunk = sunk.max(-deep.distance);
                        }
                    }
                }
                Partner::Strand(other) => {
                    // Radii of the strands that yield, and what is left for them.
                    let ends = [deep.point, other];
                    let gives = ends.map(|end| named[end.strand as usize]);
                    let radius = |end: usize| scene.wisp_radius(&ends[end]);
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
                        let permitted_overlap = made[index].get_or_insert_with(|| material_points(index));
                        for fraction in &mut permitted_overlap.wisp_fractions[element..element + 2] {
                            *fraction = fraction.min((left / give).max(0.0));
                        }
                    }
                }
            }
        }
        // A contact is at the least distance; the strand must not press where it is in a body on both sides of it, or all along.
        for (place, depth) in scene.depths_in_bodies(|index| named[index]) {
            let (index, element) = (place.strand as usize, place.element as usize);
            let permitted_overlap = made[index].get_or_insert_with(|| material_points(index));
            for sunk in &mut permitted_overlap.sunk[element..element + 2] {
                *sunk = sunk.max(depth);
            }
        }
        for (index, permitted_overlap) in made.into_iter().enumerate() {
            if let Some(permitted_overlap) = permitted_overlap {
                self.strands[index].permitted_overlap = Some(Arc::new(permitted_overlap));
            }
        }
        Ok(overlaps)
    }

    /// Sets permitted overlaps (`None`, the initial value: none): one per strand, as returned by [`Solver::permitted_overlap`].
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `permitted_overlaps[i].field`, or for counts that differ.
    /// Nothing has then changed.
    pub fn set_permitted_overlaps(&mut self, ids: &[StrandId], permitted_overlaps: &[Option<PermittedOverlap>]) -> Result<()> {
        if permitted_overlaps.len() != ids.len() {
            return Err(Error::invalid(
                "permitted_overlaps (count)",
                permitted_overlaps.len(),
                format!("{}, one per strand", ids.len()),
            ));
        }
        for (k, permitted_overlap) in permitted_overlaps.iter().enumerate() {
            permitted_overlap
                .as_ref()
                .map_or(Ok(()), |permitted_overlap| permitted_overlap.check(&format!("permitted_overlaps[{k}]")))?;
        }
        for (index, permitted_overlap) in self.indices(ids)?.into_iter().zip(permitted_overlaps) {
            self.strands[index].permitted_overlap = permitted_overlap.clone().map(Arc::new);
        }
        Ok(())
    }

    /// The permitted overlap of a strand.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn permitted_overlap(&self, id: StrandId) -> Result<Option<&PermittedOverlap>> {
        Ok(self.strand("id", id)?.permitted_overlap.as_deref())
    }

    /// Discards the bodies' last motions.
    pub(in crate::solver) fn rest_bodies(&mut self) {
        for body in &mut self.bodies {
            body.body.rest();
        }
    }

    pub(in crate::solver) fn bodies_at_rest(&self) -> Vec<BodyAt<'_>> {
        self.bodies.iter().enumerate().map(|(k, scene)| scene.body.still(k as u32)).collect()
    }

    fn current_scene<'a>(&'a self, bodies: &'a [BodyAt<'a>]) -> CurrentScene<'a> {
        CurrentScene {
            strands: &self.strands,
            slots: &self.slots,
            constraints: &self.constraints,
            bodies,
            hair: self.options.contact.hair,
            workers: &self.workers,
        }
    }
}

/// A permitted overlap of nothing, with points at the ends of elements.
fn none_at(lengths: &[f64]) -> PermittedOverlap {
    let mut along = vec![0.0];
    along.extend(lengths.iter().scan(0.0, |along, length| {
        *along += length;
        Some(*along)
    }));
    PermittedOverlap { wisp_fractions: vec![1.0; along.len()], sunk: vec![0.0; along.len()], along }
}
