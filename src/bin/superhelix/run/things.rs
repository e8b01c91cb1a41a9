//! What of a scene is in the solver.

use std::path::Path;

use superhelix::{BodyId, ConstraintId, Solver, StrandId};

use crate::scene::Scene;
use crate::stepping::drawn_inside::{Becomes, DrawnInside, warn_of_hair_in_hair};

/// What is in the solver, in the scene's order.
#[derive(Debug)]
pub struct Things {
    /// The strands.
    pub strands: Vec<StrandId>,
    /// The colliders.
    pub bodies: Vec<BodyId>,
    /// The attachments.
    pub constraints: Vec<ConstraintId>,
}

impl Things {
    /// Those of a solver that holds a scene's and nothing else: a snapshot brings identifiers of its own.
    pub fn of(solver: &Solver) -> Self {
        Self { strands: solver.strand_ids(), bodies: solver.body_ids(), constraints: solver.constraint_ids() }
    }

    /// Adds a scene's colliders and attachments to a solver that has its strands.
    pub fn make(scene: &Scene, solver: &mut Solver, strands: Vec<StrandId>) -> superhelix::Result<Self> {
        let bodies = solver.add_bodies(scene.colliders.iter().map(|collider| collider.definition.clone()).collect())?;
        for (strand, id) in scene.strands.iter().zip(&strands) {
            if let Some(contact) = &strand.contact {
                solver.set_contact(&[*id], Some(contact))?;
            }
        }
        let constraints = scene.attachments.iter().map(|attachment| attachment.constraint(solver, &strands));
        let constraints = constraints.collect::<superhelix::Result<Vec<_>>>()?;
        let constraints = solver.add_constraints(&constraints)?;
        if scene.allow_overlaps {
            solver.allow_overlaps(&strands)?;
        }
        Ok(Self { strands, bodies, constraints })
    }

    /// Warns on standard error, in one line each, of strands that contact will push out of colliders and of others as soon as the scene begins.
    pub fn warn_of_overlaps(&self, scene: &Scene, path: &Path, solver: &mut Solver) -> superhelix::Result<()> {
        if scene.allow_overlaps || (self.bodies.is_empty() && !scene.options.contact.hair) {
            return Ok(());
        }
        let (name, to_keep) = (path.display().to_string(), "\"allow_overlaps\": true in \"contact\"");
        let overlaps = solver.overlaps(&self.strands)?;
        if let Some(left) = DrawnInside::left(Becomes::Parted, &overlaps) {
            left.warn(&name, self.strands.len(), "colliders", to_keep);
        }
        let radii = scene.strands.iter().map(|strand| strand.contact.as_ref().map_or(0.0, |contact| contact.wisp_radius));
        warn_of_hair_in_hair(&overlaps, radii, &name, to_keep);
        Ok(())
    }
}
