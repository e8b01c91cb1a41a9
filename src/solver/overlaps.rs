//! What strands overlap as they are now, and having it allowed: a groom that is drawn with wisps in wisps and hair in a head then bears no
//! force where it stands.

use super::Solver;
use super::deep_places::AsItIs;
use super::id::{BodyId, StrandId};
use crate::contact::allowance::Allowance;
use crate::contact::body::BodyAt;
use crate::contact::touch::Partner;
use crate::error::{Error, Result};

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

impl Solver {
    /// How deep each strand is in others (where [`ContactOptions::hair`](crate::contact::options::ContactOptions::hair) is set) and in bodies
    /// as they are now, less what it is allowed ([`Solver::allow_overlaps`]); in the order of `ids`. Strands without contact overlap nothing, what is
    /// exempt or filtered out does not count. Moves nothing; a mesh on its way is taken where it is.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn overlaps(&mut self, ids: &[StrandId]) -> Result<Vec<Overlap>> {
        let indices = self.indices(ids)?;
        self.rest_bodies();
        let bodies = self.bodies_at_rest();
        let scene = self.as_it_is(&bodies);
        let mut found = vec![Overlap::default(); self.strands.len()];
        for deep in &scene.deep_places(|_| true) {
            let (a, depth) = (deep.place.strand as usize, scene.depth(deep));
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
        let bodies = self.bodies_at_rest();
        let scene = self.as_it_is(&bodies);
        let stations = |index: usize| none_at(&self.strands[index].model.lengths);
        let mut made: Vec<Option<Allowance>> = vec![None; self.strands.len()];
        for deep in scene.deep_places(|_| true) {
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
                        let allowance = made[index].get_or_insert_with(|| stations(index));
                        for share in &mut allowance.wisp_shares[element..element + 2] {
                            *share = share.min((left / give).max(0.0));
                        }
                    }
                }
            }
        }
        // A touch is where the distance is least; what lies in a body on both sides of it, or all along, is to press nothing either.
        for (place, depth) in scene.depths_in_bodies(|index| named[index]) {
            let (index, element) = (place.strand as usize, place.element as usize);
            let allowance = made[index].get_or_insert_with(|| stations(index));
            for sunk in &mut allowance.sunk[element..element + 2] {
                *sunk = sunk.max(depth);
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

    /// Leaves what drew the bodies on their last ways behind.
    pub(super) fn rest_bodies(&mut self) {
        for body in &mut self.bodies {
            body.body.rest();
        }
    }

    pub(super) fn bodies_at_rest(&self) -> Vec<BodyAt<'_>> {
        self.bodies.iter().enumerate().map(|(k, scene)| scene.body.still(k as u32)).collect()
    }

    fn as_it_is<'a>(&'a self, bodies: &'a [BodyAt<'a>]) -> AsItIs<'a> {
        AsItIs {
            strands: &self.strands,
            slots: &self.slots,
            constraints: &self.constraints,
            bodies,
            hair: self.options.contact.hair,
            crew: &self.crew,
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
