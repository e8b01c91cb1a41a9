//! Poses and motions, of roots, colliders and targets.
//!
//! Files:
//!
//! - `deformation.rs`: A mesh whose vertices move: samples in time, straight and even between them, held before the first and after the last.
//! - `motions.rs`: `motions`: poses over time that have a name, so that roots, colliders and targets share them.

pub mod deformation;
pub mod motions;

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::Frame;
use superhelix::splines::PoseSpline;

use crate::scene::words::in_words_of_the_scene;
use crate::shell::json::{Complaint, Entries, Node};
use motions::Motions;

/// A pose as an object: `origin` and `rotation`, either of which may be left out.
pub fn read_pose(node: &Node) -> Result<Frame, Complaint> {
    let entries = node.object(&["origin", "rotation"])?;
    let origin = entries.or("origin", [0.0; 3], Node::numbers)?;
    let rotation = entries.or("rotation", [0.0, 0.0, 0.0, 1.0], Node::numbers)?;
    read_frame(&node.key, origin, rotation)
}

/// A frame from its numbers; `key` names it in complaints.
pub fn read_frame(key: &str, origin: [f64; 3], rotation: [f64; 4]) -> Result<Frame, Complaint> {
    Frame::from_arrays(key, origin, rotation).map_err(in_words_of_the_scene)
}

/// Times that increase, s.
pub fn read_times(node: &Node) -> Result<Vec<f64>, Complaint> {
    let items = node.list()?;
    let times = items.iter().map(Node::number).collect::<Result<Vec<_>, _>>()?;
    for (item, pair) in items.iter().skip(1).zip(times.windows(2)) {
        if pair[1] <= pair[0] {
            return Err(item.complain(format!("a time after the one before, {}", pair[0])));
        }
    }
    Ok(times)
}

/// What says where something is at a time.
pub trait Moves {
    /// Where, s.
    fn at(&self, time: f64) -> Frame;
}

impl Moves for Arc<PoseSpline> {
    fn at(&self, time: f64) -> Frame {
        self.as_ref().at(time)
    }
}

/// How a root moves: rigidly with a frame that moves.
#[derive(Debug, Clone)]
pub struct RootMotion {
    /// The frame's motion; strands may share it.
    pub spline: Arc<PoseSpline>,
    /// The root in that frame.
    pub local: Frame,
}

impl RootMotion {
    /// Velocity of the root (m/s) and angular velocity (rad/s).
    pub fn velocity(&self, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (linear, angular) = self.spline.velocity(time);
        (linear + angular.cross(&(self.spline.at(time).rotation * self.local.origin)), angular)
    }
}

impl Moves for RootMotion {
    fn at(&self, time: f64) -> Frame {
        // The root of a strand that has the motion to itself has its bits.
        if self.local == Frame::default() { self.spline.at(time) } else { self.spline.at(time).compose(&self.local) }
    }
}

/// A root's motion: that of a frame, and where the root is in it.
pub fn read_root_motion(node: &Node, motions: &Motions) -> Result<RootMotion, Complaint> {
    let entries = node.object(&["times", "frames", "motion", "local"])?;
    Ok(RootMotion {
        spline: motions.of(node, &entries)?,
        local: entries.get_unless_null("local").map_or(Ok(Frame::default()), read_pose)?,
    })
}

/// A motion: poses at times.
pub fn read_spline(node: &Node, entries: &Entries) -> Result<PoseSpline, Complaint> {
    let (times_node, frames_node) = (entries.require("times")?, entries.require("frames")?);
    let times = read_times(times_node)?;
    let items = frames_node.list()?;
    if times.is_empty() || items.len() != times.len() {
        let expected = format!("as many as times has ({}), at least one", times.len());
        return Err(Complaint::value(&frames_node.key, format!("a list of {}", items.len()), expected));
    }
    let frames = items
        .iter()
        .map(|item| {
            let [x, y, z, qx, qy, qz, qw] = item.numbers()?;
            read_frame(&item.key, [x, y, z], [qx, qy, qz, qw])
        })
        .collect::<Result<Vec<_>, _>>()?;
    PoseSpline::new(times, frames).map_err(|error| Complaint::new(&node.key, error.to_string()))
}
