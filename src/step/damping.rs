//! How strongly Newton's iteration holds the rotations back: Levenberg's and Marquardt's parameter λ, in N·m/rad, and its memory.

/// What λ grows by where it must, and shrinks by where the model kept its promise.
const UP: f64 = 4.0;
const DOWN: f64 = 0.125;
/// The model kept its promise where the potential fell by more than this share of it.
const KEPT: f64 = 0.7;
/// It broke it below this.
const BROKEN: f64 = 0.25;

/// λ from iteration to iteration.
#[derive(Debug, Clone, Copy)]
pub struct Damping {
    /// λ now.
    pub value: f64,
    /// λ to begin with where none does not do.
    remembered: f64,
    /// The λ to try first of all.
    usual: f64,
    /// Whether the next iteration tries none first.
    try_none: bool,
}

impl Damping {
    /// None, and `usual` where that does not do.
    pub fn new(usual: f64) -> Self {
        Self { value: 0.0, remembered: usual, usual, try_none: true }
    }

    /// Begins an iteration.
    pub fn begin(&mut self) {
        self.value = if self.try_none { 0.0 } else { self.remembered };
    }

    /// The present λ does not do: a larger one.
    pub fn grow(&mut self) {
        self.value = if self.value == 0.0 { self.remembered } else { self.value * UP };
    }

    /// Learns from an iteration: the share of the promised fall that the potential kept.
    pub fn learn(&mut self, kept: f64) {
        if kept > KEPT {
            if self.value > 0.0 {
                self.remembered = self.value * DOWN;
            }
            // A λ above the usual goes down step by step; below, none is worth a try.
            self.try_none = self.value == 0.0 || self.remembered < self.usual;
        } else if kept < BROKEN {
            if self.value > 0.0 {
                self.remembered = self.value * UP;
            }
            self.try_none = false;
        } else if self.value > 0.0 {
            self.remembered = self.value;
        }
    }
}
