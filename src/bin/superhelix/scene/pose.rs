//! Poses and motions, of roots, colliders and targets.

use superhelix::math::frame::Frame;
use superhelix::math::pose_spline::PoseSpline;

use super::words::in_words_of_the_scene;
use crate::json::{Complaint, Node};

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

/// A motion: poses at times.
pub fn read_motion(node: &Node) -> Result<PoseSpline, Complaint> {
    let entries = node.object(&["times", "frames"])?;
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
