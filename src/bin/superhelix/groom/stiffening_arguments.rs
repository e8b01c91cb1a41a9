//! `--stiffen`: strands made stiff enough to rest as they are drawn.

use clap::Args;
use superhelix::editing::Stiffening;

/// What is made stiffer, by its name in a scene and on the command line.
pub const STIFFENINGS: [(&str, Stiffening); 2] = [("youngs_modulus", Stiffening::YoungsModulus), ("radius", Stiffening::Radius)];

/// How unstable strands are made stable.
#[derive(Debug, Clone, Copy, Args)]
pub struct StiffeningArguments {
    /// Makes strands that would not rest stably as much stiffer as that takes, so that the smallest eigenvalue of the static Hessian against the
    /// elastic stiffness is at least this: 0 to less than 1; 0.05 is a start.
    #[arg(long, value_name = "MARGIN", value_parser = margin)]
    stiffen: Option<f64>,
    /// What makes them stiffer: youngs_modulus or radius (and then they are heavier, too).
    #[arg(long, value_name = "WHAT", default_value = "youngs_modulus", value_parser = stiffening)]
    stiffen_by: Stiffening,
}

impl StiffeningArguments {
    /// By what, and the margin.
    pub fn stiffening(&self) -> Option<(Stiffening, f64)> {
        self.stiffen.map(|margin| (self.stiffen_by, margin))
    }
}

fn margin(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| (0.0..1.0).contains(value));
    value.ok_or_else(|| "expected a number, 0 to less than 1".to_string())
}

fn stiffening(text: &str) -> Result<Stiffening, String> {
    let found = STIFFENINGS.iter().find(|(name, _)| *name == text).map(|(_, by)| *by);
    found.ok_or_else(|| "expected youngs_modulus or radius".to_string())
}
