//! `--settle`: strands that start at rest in their static equilibrium under gravity.

use serde::Serialize;
use superhelix::editing::EquilibriumOptions;
use superhelix::{Result, Solver, SolverOptions, StrandDef};

/// How the search for the strands' rest ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Settled {
    /// Strands that found no stable rest; they start in the best shape that was found.
    pub unconverged: usize,
    /// Unstable states that were left on the way.
    pub saddles: u64,
}

/// Puts the definitions' initial shapes into their equilibrium, each searched for from where it is with its root held at its start.
/// They start at rest relative to their roots, which keep their own velocities.
pub fn settle(definitions: &mut [StrandDef], options: &SolverOptions) -> Result<Settled> {
    let mut solver = Solver::new(options.clone())?;
    let ids = solver.add_strands(definitions)?;
    let found = solver.settle(&ids, &EquilibriumOptions::default())?;
    for (definition, id) in definitions.iter_mut().zip(&ids) {
        definition.initial = Some(solver.curvatures(*id)?.to_vec());
        definition.initial_rates = None;
    }
    Ok(Settled {
        unconverged: found.iter().filter(|strand| !strand.converged).count(),
        saddles: found.iter().map(|strand| u64::from(strand.saddles)).sum(),
    })
}

impl Settled {
    /// One line on standard error when some strands found no rest.
    pub fn warn(&self, name: &str, strands: usize) {
        if self.unconverged > 0 {
            eprintln!(
                "warning: {name}: {} of {strands} strands found no stable rest; they start in the best shape found",
                self.unconverged
            );
        }
    }
}
