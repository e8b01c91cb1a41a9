//! Levenberg–Marquardt damping of the rotations in Newton's iteration: the parameter λ, N·m/rad, from iteration to iteration.

/// How much λ grows after a failure, and shrinks after a good prediction.
const UP: f64 = 4.0;
const DOWN: f64 = 0.125;
/// The model predicted well where the potential fell by more than this fraction of the prediction.
const KEPT: f64 = 0.7;
/// It predicted badly below this fraction.
const BROKEN: f64 = 0.25;

/// λ from iteration to iteration.
#[derive(Debug, Clone, Copy)]
pub struct Damping {
    /// The current λ.
    pub value: f64,
    /// The λ to start from where an undamped iteration fails.
    remembered: f64,
    /// The first λ to try.
    usual: f64,
    /// Whether the next iteration tries λ = 0 first.
    try_none: bool,
}

impl Damping {
    /// No damping, and `usual` where that fails.
    pub fn new(usual: f64) -> Self {
        Self { value: 0.0, remembered: usual, usual, try_none: true }
    }

    /// Starts an iteration.
    pub fn begin(&mut self) {
        self.value = if self.try_none { 0.0 } else { self.remembered };
    }

    /// Increases λ after a failure.
    pub fn grow(&mut self) {
        self.value = if self.value == 0.0 { self.remembered } else { self.value * UP };
    }

    /// Learns from an iteration: `kept` is the fraction of the predicted fall that the potential achieved.
    pub fn learn(&mut self, kept: f64) {
        if kept > KEPT {
            if self.value > 0.0 {
                self.remembered = self.value * DOWN;
            }
            // A λ above the usual one falls step by step; below it, no damping is worth a try.
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
