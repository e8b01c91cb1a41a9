//! The soak's tangle: wisps of 39 strands that a fast body flings into each other. Wall clock of one thread.

#[path = "../../tests/contact_soak/scenes.rs"]
mod scenes;

use superhelix::StepReport;

use crate::Outcome;

/// The scenes of the soak that are tangles.
pub const CASES: [u64; 2] = [570, 2590];

/// What a tangle's steps came to.
#[derive(Default)]
pub struct Tangled {
    /// The scene's name, with its strands, model and step.
    pub scene: String,
    /// Of all steps, ascending.
    pub seconds: Vec<f64>,
    pub most_contacts: u32,
    /// Strand steps: not converged; those of them that were left when the step's work was spent.
    pub unconverged: u32,
    pub left: u32,
    pub penetration: f64,
}

impl Tangled {
    fn add(&mut self, report: &StepReport) {
        self.seconds.push(report.seconds);
        self.most_contacts = self.most_contacts.max(report.contact.contacts);
        self.unconverged += report.unconverged;
        self.left += report.left;
        self.penetration = self.penetration.max(report.contact.penetration);
    }
}

/// All steps of a scene of many strands, or the first `most` of those with bodies and of those without.
pub fn tangled(case: u64, most: u32) -> Outcome<Tangled> {
    let (mut scene, name) = scenes::case_of(case, true);
    let mut tangled = Tangled { scene: name, ..Tangled::default() };
    let (thrown, calm) = scene.steps();
    for _ in 0..thrown.min(most) {
        tangled.add(&scene.throw());
    }
    let bodies = scene.body_ids();
    scene.solver.remove_bodies(&bodies)?;
    for _ in 0..calm.min(most) {
        tangled.add(&scene.solver.step(scene.step, 1)?);
    }
    tangled.seconds.sort_by(f64::total_cmp);
    Ok(tangled)
}
