//! The virtual coupling between the device and the tool in the simulation (Colgate, Stanley and Brown 1995): a spring and a damper, to displacement and to
//! turning, between where the hand has the handle and where the tool's handle is, the proxy. The tool has no mass of its own; the device's is in the
//! hand. So the proxy is at every moment where coupling and hair are in balance, and the hand feels what the hair does to the tool.

use nalgebra::Vector3;

use super::options::HapticOptions;
use crate::math::frame::Frame;
use crate::math::rotation::{from_rotation_vector, rotation_vector};

/// How far the proxy goes for a force at it within one update: 1/(k + c/dt).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Compliance {
    /// m/N.
    pub linear: f64,
    /// rad/(N·m).
    pub angular: f64,
}

impl Compliance {
    pub fn new(options: &HapticOptions, dt: f64) -> Self {
        Self {
            linear: 1.0 / (options.stiffness + options.damping / dt),
            angular: 1.0 / (options.angular_stiffness + options.angular_damping / dt),
        }
    }
}

/// Where the proxy would be after `dt` seconds if nothing but the coupling acted on it: implicit Euler on k (x − xd) + c (v − vd) = 0.
pub(super) fn free_proxy(
    options: &HapticOptions,
    proxy: &Frame,
    device: &Frame,
    [velocity, spin]: [Vector3<f64>; 2],
    dt: f64,
) -> Frame {
    let Compliance { linear, angular } = Compliance::new(options, dt);
    let off = proxy.origin - device.origin;
    let turned = rotation_vector(&(proxy.rotation * device.rotation.inverse()));
    let left = (off / dt + velocity) * (options.damping * linear);
    let left_turned = (turned / dt + spin) * (options.angular_damping * angular);
    Frame { origin: device.origin + left, rotation: from_rotation_vector(left_turned) * device.rotation }
}

/// A frame that is moved and turned a little, in world axes.
pub(super) fn moved(frame: &Frame, by: Vector3<f64>, turn: Vector3<f64>) -> Frame {
    Frame { origin: frame.origin + by, rotation: from_rotation_vector(turn) * frame.rotation }
}
