//! The six scenes: the pose of the follicle at any time, y up, and the wind.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Frame;

use super::walk::Walk;

/// Seconds simulated.
pub const DURATION: f64 = 2.0;

/// m/s², y up.
pub const GRAVITY: [f64; 3] = [0.0, -9.81, 0.0];

/// What happens to the strand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scene {
    /// It hangs; the head sways by a centimetre to each side at ½ Hz.
    CalmSway,
    /// A head recorded while walking.
    Walk,
    /// A head that turns by ±46° and sways by ±8 cm at 2 Hz.
    HeadShake,
    /// A head that bounces by ±2 cm at 3 Hz.
    CurlyBounce,
    /// The strand cut to 3 cm on a head that turns by ±20° at 3 Hz.
    StiffBristle,
    /// It hangs from a head at rest; wind in gusts of up to 7 m/s.
    WindGust,
}

impl Scene {
    /// All six.
    pub const ALL: [Scene; 6] =
        [Scene::CalmSway, Scene::Walk, Scene::HeadShake, Scene::CurlyBounce, Scene::StiffBristle, Scene::WindGust];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        ["calm_sway", "walk", "head_shake", "curly_bounce", "stiff_bristle", "wind_gust"][self as usize]
    }

    /// The strand's length, m, for one that is `long` elsewhere.
    pub fn length(self, long: f64) -> f64 {
        if self == Scene::StiffBristle { 0.03 } else { long }
    }

    /// Pose of the head at `t` seconds. Every motion but the walk begins at rest.
    fn head(self, walk: &Walk, t: f64) -> Frame {
        let wave = |hertz: f64| (2.0 * PI * hertz * t).sin() * (1.0 - (-(4.0 * t).powi(2)).exp());
        let turned = |angle: f64| UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
        match self {
            Scene::CalmSway => Frame { origin: Vector3::new(0.01 * wave(0.5), 0.0, 0.0), ..Frame::default() },
            Scene::Walk => walk.at(t),
            Scene::HeadShake => Frame { origin: Vector3::new(0.0, 0.0, 0.08 * wave(2.0)), rotation: turned(0.8 * wave(2.0)) },
            Scene::CurlyBounce => Frame { origin: Vector3::new(0.0, 0.02 * wave(3.0), 0.0), ..Frame::default() },
            Scene::StiffBristle => Frame { rotation: turned(0.35 * wave(3.0)), ..Frame::default() },
            Scene::WindGust => Frame::default(),
        }
    }

    /// Pose of the follicle: 9 cm to the side of the head's axis. The strand leaves outwards and half a radian down; straight
    /// down in scenes where it hangs; horizontally as a bristle.
    pub fn root(self, walk: &Walk, t: f64) -> Frame {
        let down = match self {
            Scene::CalmSway | Scene::WindGust => FRAC_PI_2,
            Scene::StiffBristle => 0.0,
            _ => 0.5,
        };
        let follicle =
            Frame { origin: Vector3::new(0.09, 0.0, 0.0), rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -down) };
        self.head(walk, t).compose(&follicle)
    }

    /// Velocity and angular velocity of the root at the start, world axes.
    pub fn root_velocity(self, walk: &Walk) -> (Vector3<f64>, Vector3<f64>) {
        if self != Scene::Walk {
            return (Vector3::zeros(), Vector3::zeros());
        }
        let h = 1e-4;
        let (before, after) = (self.root(walk, -h), self.root(walk, h));
        ((after.origin - before.origin) / (2.0 * h), (after.rotation * before.rotation.inverse()).scaled_axis() / (2.0 * h))
    }

    /// The wind over the sixth of a second from `t` on, m/s. It changes only at sixths of a second, where steps of every rate
    /// end.
    pub fn wind(self, t: f64) -> Vector3<f64> {
        const SPEEDS: [f64; 12] = [0.0, 2.0, 5.0, 7.0, 4.0, 6.0, 3.0, 0.5, 0.0, 4.0, 6.0, 1.0];
        if self != Scene::WindGust {
            return Vector3::zeros();
        }
        let sixth = (6.0 * t + 1e-6).floor() as usize;
        let speed = SPEEDS[sixth.min(SPEEDS.len() - 1)];
        // It turns a little, so that the motion is not in a plane.
        let angle = 0.15 * sixth as f64;
        Vector3::new(speed * angle.cos(), 0.0, speed * angle.sin())
    }
}
