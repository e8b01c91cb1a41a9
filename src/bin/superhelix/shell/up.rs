//! `--up`: the axis of the world that points up.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::io::{Curves, UpAxis};

use super::failure::Failure;

/// Which axis of the world points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Up {
    /// y up, as most grooms and all motion capture have it.
    Y,
    /// z up.
    Z,
}

impl Up {
    /// Index of the axis that points up.
    pub fn axis(self) -> usize {
        match self {
            Up::Y => 1,
            Up::Z => 2,
        }
    }

    /// Refuses a groom that says that another axis is up.
    pub fn check_groom(self, path: &Path, curves: &Curves) -> Result<(), Failure> {
        let (said, flag) = match curves.extras().up {
            Some(UpAxis::Y) if self != Up::Y => ("y", "y"),
            Some(UpAxis::Z) if self != Up::Z => ("z", "z"),
            _ => return Ok(()),
        };
        Err(Failure::file(path, format!("says that {said} is up: give --up {flag}")))
    }

    /// Gravity, m/s².
    pub fn gravity(self) -> Vector3<f64> {
        let mut gravity = Vector3::zeros();
        gravity[self.axis()] = -9.81;
        gravity
    }
}
