//! The virtual coupling between the device and the tool in the simulation: a spring and a damper (Colgate, Stanley and Brown
//! 1995).
//!
//! It acts on displacement and rotation between the handle in the hand and the tool's handle, the proxy. The tool has no mass of
//! its own; the device's is in the hand. So the proxy is always where coupling and hair balance, and the hand feels what the hair
//! does to the tool.

use nalgebra::Vector3;

use super::options::HapticOptions;
use crate::math::frame::Frame;
use crate::math::rotation::{from_rotation_vector, rotation_vector};

/// Mass and moment of inertia about the handle, kg and kg·m², of the hair against the tool.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct AddedMass {
    pub mass: f64,
    pub moment: f64,
}

/// In direct mode the proxy responds to the force of the last step. Hair under pressure resists with its mass over the square of
/// the step: a tool that yields more easily than that oscillates with growing amplitude (the added-mass instability of explicit
/// coupling, Causin, Gerbeau and Nobile 2005). It is damped by this multiple of the hair's momentum.
const OF_ADDED_MASS: f64 = 2.0;

/// Springs and dampers between the device and the proxy over an update.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coupling {
    damping: f64,
    angular_damping: f64,
    dt: f64,
    pub compliance: Compliance,
}

/// Displacement of the proxy per force on it within one update: 1/(k + c/dt).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Compliance {
    /// m/N.
    pub linear: f64,
    /// rad/(N·m).
    pub angular: f64,
}

impl Coupling {
    pub fn new(options: &HapticOptions, added: &AddedMass, dt: f64) -> Self {
        let damping = options.damping + OF_ADDED_MASS * added.mass / dt;
        let angular_damping = options.angular_damping + OF_ADDED_MASS * added.moment / dt;
        let compliance = Compliance {
            linear: 1.0 / (options.stiffness + damping / dt),
            angular: 1.0 / (options.angular_stiffness + angular_damping / dt),
        };
        Self { damping, angular_damping, dt, compliance }
    }

    /// Position of the proxy at the end of the update under the coupling alone: implicit Euler on k (x − xd) + c (v − vd) = 0.
    pub fn free_proxy(&self, proxy: &Frame, device: &Frame, [velocity, spin]: [Vector3<f64>; 2]) -> Frame {
        let Self { damping, angular_damping, dt, compliance } = self;
        let off = proxy.origin - device.origin;
        let turned = rotation_vector(&(proxy.rotation * device.rotation.inverse()));
        let left = (off / *dt + velocity) * (damping * compliance.linear);
        let left_turned = (turned / *dt + spin) * (angular_damping * compliance.angular);
        Frame { origin: device.origin + left, rotation: from_rotation_vector(left_turned) * device.rotation }
    }
}

/// A frame with a small displacement and rotation, in world axes.
pub(super) fn moved(frame: &Frame, by: Vector3<f64>, turn: Vector3<f64>) -> Frame {
    Frame { origin: frame.origin + by, rotation: from_rotation_vector(turn) * frame.rotation }
}
