//! Strands as a solver has them, sampled for files and pictures.

use superhelix::io::{Curves, Extras};
use superhelix::{Result, Solver, StrandId};

/// Points and velocities at one moment; its memory is kept from one to the next.
#[derive(Debug)]
pub struct SampledFrame {
    /// Points a strand.
    pub samples: usize,
    units_a_metre: f64,
    /// One strand after the other.
    pub points: Vec<[f32; 3]>,
    /// The same, a second.
    pub velocities: Vec<[f32; 3]>,
}

impl SampledFrame {
    /// For so many points a strand, in such units.
    pub fn new(samples: usize, units_a_metre: f64) -> Self {
        Self { samples, units_a_metre, points: Vec::new(), velocities: Vec::new() }
    }

    /// Takes the solver's present state.
    pub fn take(&mut self, solver: &Solver, ids: &[StrandId]) -> Result<()> {
        let Self { samples, units_a_metre, points, velocities } = self;
        points.resize(ids.len() * *samples, [0.0; 3]);
        velocities.resize(ids.len() * *samples, [0.0; 3]);
        solver.sample_strands(ids, *samples, |strand, point, sample| {
            points[strand * *samples + point] = (sample.position * *units_a_metre).map(|value| value as f32).into();
            velocities[strand * *samples + point] = (sample.velocity * *units_a_metre).map(|value| value as f32).into();
        })
    }

    /// As curves with velocities.
    pub fn curves(&self) -> Result<Curves> {
        let counts = vec![self.samples as u32; self.points.len() / self.samples];
        let extras = Extras { velocities: Some(self.velocities.clone()), ..Extras::default() };
        Curves::from_counts(counts, self.points.clone())?.with_extras(extras)
    }
}
