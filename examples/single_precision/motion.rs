//! The motion of the head.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Frame;
use superhelix::io::Motion as Recording;

/// A head's motion, y up.
#[derive(Debug)]
pub enum Motion {
    /// It turns by ±46° and sways by ±8 cm at 2 Hz.
    Shake,
    /// Recorded while walking.
    Walk(Recording),
    /// It rests.
    Rest,
}

impl Motion {
    /// The recorded walk.
    pub fn walk() -> Self {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/walk_figure8_head.csv");
        Self::Walk(Recording::read(path, None).expect("the walk"))
    }

    /// Its name in tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Shake => "shake",
            Self::Walk(_) => "walk",
            Self::Rest => "rest",
        }
    }

    /// The follicle's pose at `t` seconds: 9 cm to the side of the head's axis, the strand leaving outwards and half a radian down.
    pub fn root(&self, t: f64) -> Frame {
        let tilt = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -0.5);
        let follicle = Frame { origin: Vector3::new(0.09, 0.0, 0.0), rotation: tilt };
        let head = match self {
            Self::Rest => Frame::default(),
            Self::Walk(recording) => recording.at(recording.times()[0] + t),
            Self::Shake => {
                let swing = (4.0 * std::f64::consts::PI * t).sin() * (1.0 - (-(4.0 * t).powi(2)).exp());
                Frame {
                    origin: Vector3::new(0.0, 0.0, -0.08 * swing),
                    rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.8 * swing),
                }
            }
        };
        head.compose(&follicle)
    }

    /// Velocity and angular velocity of the root at the start.
    pub fn root_velocity(&self) -> (Vector3<f64>, Vector3<f64>) {
        let h = 1e-4;
        let (now, next) = (self.root(0.0), self.root(h));
        ((next.origin - now.origin) / h, (next.rotation * now.rotation.inverse()).scaled_axis() / h)
    }
}
