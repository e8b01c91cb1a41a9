//! The cost of one more Newton iteration: two crowds in the same scene at the same times, one of which takes more iterations.

use crate::crowd::{Crowd, Setting};

/// Iterations of the two. The first one has no geometric terms in its Hessian, the second starts far from the minimum.
const FEW: u32 = 3;
const MANY: u32 = 9;

/// Two crowds.
pub struct Marginal {
    few: Crowd,
    many: Crowd,
    /// Steps per sample.
    steps: u32,
    /// Seconds of an iteration of one element, one per sample.
    pub samples: Vec<f64>,
}

impl Marginal {
    /// The setting's crowds; a sample takes `steps` steps.
    pub fn new(setting: &Setting, steps: u32) -> Self {
        let crowd = |iterations| Crowd::warm(&setting.clone().iterations(iterations), 12);
        Self { few: crowd(FEW), many: crowd(MANY), steps, samples: Vec::new() }
    }

    /// Takes a sample.
    pub fn take(&mut self) {
        let (few, many) = (self.few.take(self.steps), self.many.take(self.steps));
        // A strand may end earlier, where rounding hides any descent or, in f32, where only rounding moves it.
        assert!(many.iterations - few.iterations > 1.0, "{} iterations", many.iterations);
        self.samples.push((many.seconds - few.seconds) / (many.iterations - few.iterations) / self.few.elements() as f64);
    }
}
