//! Motion capture in Biovision's `.bvh`: a tree of joints, then one row of numbers per frame.
//!
//! A joint's pose in its parent is a translation and then its rotations in the order of its channels (the first channel is the
//! outermost). The translation is its OFFSET; a position channel replaces its axis of that. Angles are in degrees. Numbers are
//! separated by whitespace; line ends have no meaning.

use nalgebra::{UnitQuaternion, Vector3};

use crate::error::{Error, Result};
use crate::files::io::bytes;
use crate::files::io::text::{Quote, Text, count, number};
use crate::math::frame::Frame;
use crate::math::rotation::from_rotation_vector;

/// What one number of a frame changes about its joint.
#[derive(Clone, Copy, PartialEq)]
enum Channel {
    Position(usize),
    Rotation(usize),
}

/// A joint of the tree.
struct Joint<'a> {
    name: &'a str,
    parent: Option<usize>,
    offset: Option<[f64; 3]>,
    channels: Vec<Channel>,
    /// The index of its first number in a frame's row.
    first: usize,
}

/// Reads the world motion of one joint: times (s, from 0) and poses, with positions multiplied by `metres_per_unit`. Without a
/// name, takes the first joint with "head" in its name.
pub(super) fn read(name: &str, content: &[u8], joint: Option<&str>, metres_per_unit: f64) -> Result<(Vec<f64>, Vec<Frame>)> {
    let mut text = Text::new(name, content);
    let (joints, row_length) = read_tree(&mut text)?;
    let chain = chain_to(name, &joints, joint)?;

    let (line, frame_count) = {
        expect(&mut text, "Frames:")?;
        let (line, word) = text.word("the number of frames")?;
        (line, count(&text, line, "the number of frames", word)?)
    };
    if frame_count == 0 {
        return Err(text.error(line, "the number of frames is 0; expected at least one"));
    }
    expect(&mut text, "Frame")?;
    expect(&mut text, "Time:")?;
    let (time_line, word) = text.word("the time of a frame")?;
    let frame_time = number(&text, time_line, "the time of a frame", word)?;
    // A number and the blank after it take two bytes: refuse a larger frame count before allocating for it.
    let least = (u64::from(frame_count) * row_length as u64).saturating_mul(2);
    if least > text.remaining() as u64 + 1 {
        return Err(text.error(
            line,
            format_args!("{frame_count} frames of {row_length} numbers; only {} bytes are left for them", text.remaining()),
        ));
    }
    if frame_time <= 0.0 {
        return Err(text.error(time_line, format_args!("the time of a frame is {frame_time}; expected a number above zero")));
    }

    let mut times = bytes::list(frame_count as usize)?;
    let mut frames = bytes::list(frame_count as usize)?;
    let mut row = vec![0.0; row_length];
    for frame in 0..frame_count {
        for value in &mut row {
            let (line, word) = text.word("a number of a frame")?;
            *value = number(&text, line, "a number", word)?;
        }
        let mut pose = chain.iter().fold(Frame::default(), |parent, joint| parent.compose(&local_pose(&joints[*joint], &row)));
        pose.origin *= metres_per_unit;
        pose.rotation.renormalize();
        if !pose.origin.iter().all(|value| value.is_finite()) {
            return Err(text.error(text.line(), format_args!("frame {frame} puts the joint beyond the range of numbers")));
        }
        times.push(f64::from(frame) * frame_time);
        frames.push(pose);
    }
    if let Some((line, word)) = text.next_word()? {
        return Err(text.error(line, format_args!("{} follows the last of the {frame_count} frames", Quote(word))));
    }
    Ok((times, frames))
}

/// The tree from HIERARCHY through MOTION, and the number of channels of all joints.
fn read_tree<'a>(text: &mut Text<'a>) -> Result<(Vec<Joint<'a>>, usize)> {
    expect(text, "HIERARCHY")?;
    let mut joints: Vec<Joint<'a>> = Vec::new();
    let mut row_length = 0;
    // The open joints, innermost last; `None` for an end site, which has an offset and no motion.
    let mut open: Vec<Option<usize>> = Vec::new();
    loop {
        let (line, word) = text.word("the rest of the tree of joints, and MOTION")?;
        match (word, open.last().copied()) {
            ("ROOT", None) | ("JOINT", Some(Some(_))) => {
                let name = joint_name(text, line)?;
                joints.push(Joint {
                    name,
                    parent: open.last().copied().flatten(),
                    offset: None,
                    channels: Vec::new(),
                    first: row_length,
                });
                open.push(Some(joints.len() - 1));
            }
            ("End", Some(Some(_))) => {
                expect(text, "Site")?;
                expect(text, "{")?;
                open.push(None);
            }
            ("OFFSET", Some(place)) => {
                let mut offset = [0.0; 3];
                for value in &mut offset {
                    let (line, word) = text.word("an offset")?;
                    *value = number(text, line, "an offset", word)?;
                }
                if let Some(joint) = place
                    && joints[joint].offset.replace(offset).is_some()
                {
                    return Err(text.error(line, format_args!("a second OFFSET of joint {}", Quote(joints[joint].name))));
                }
            }
            ("CHANNELS", Some(Some(joint))) => {
                if !joints[joint].channels.is_empty() {
                    return Err(text.error(line, format_args!("a second CHANNELS of joint {}", Quote(joints[joint].name))));
                }
                let channels = read_channels(text)?;
                joints[joint].first = row_length;
                row_length += channels.len();
                joints[joint].channels = channels;
            }
            ("}", Some(place)) => {
                if let Some(joint) = place
                    && joints[joint].offset.is_none()
                {
                    return Err(text.error(line, format_args!("joint {} has no OFFSET", Quote(joints[joint].name))));
                }
                open.pop();
            }
            ("MOTION", None) if row_length > 0 => return Ok((joints, row_length)),
            ("MOTION", None) => return Err(text.error(line, "no joint has a channel: there is no motion")),
            (_, None) => return Err(text.error(line, format_args!("{}; expected ROOT or MOTION", Quote(word)))),
            (_, Some(Some(joint))) => {
                let expected = "expected OFFSET, CHANNELS, JOINT, End Site or }";
                let inside = Quote(joints[joint].name);
                return Err(text.error(line, format_args!("{} in joint {inside}; {expected}", Quote(word))));
            }
            (_, Some(None)) => return Err(text.error(line, format_args!("{}; expected OFFSET or }}", Quote(word)))),
        }
    }
}

/// A joint's name, up to the brace; it may contain blanks.
fn joint_name<'a>(text: &mut Text<'a>, line: usize) -> Result<&'a str> {
    let Some((_, rest)) = text.next_line()? else { return Err(text.error(line, "the file ends; expected a joint's name")) };
    let name = match rest.trim().strip_suffix('{') {
        Some(name) => name.trim_end(),
        None => {
            expect(text, "{")?;
            rest.trim()
        }
    };
    if name.is_empty() { Err(text.error(line, "a joint without a name")) } else { Ok(name) }
}

/// A number of channels, and their names.
fn read_channels(text: &mut Text<'_>) -> Result<Vec<Channel>> {
    let (line, word) = text.word("a number of channels")?;
    let channel_count = count(text, line, "the number of channels", word)?;
    let mut channels = Vec::new();
    for _ in 0..channel_count {
        let (line, word) = text.word("a channel")?;
        let channel = match word.to_ascii_lowercase().as_str() {
            "xposition" => Channel::Position(0),
            "yposition" => Channel::Position(1),
            "zposition" => Channel::Position(2),
            "xrotation" => Channel::Rotation(0),
            "yrotation" => Channel::Rotation(1),
            "zrotation" => Channel::Rotation(2),
            _ => {
                let expected = "expected Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation";
                return Err(text.error(line, format_args!("channel {}; {expected}", Quote(word))));
            }
        };
        // A joint may turn about the same axis twice (z, x, z), but has one position.
        if matches!(channel, Channel::Position(_)) && channels.contains(&channel) {
            return Err(text.error(line, format_args!("channel {} a second time", Quote(word))));
        }
        channels.push(channel);
    }
    Ok(channels)
}

/// The joints from the root to the wanted one.
fn chain_to(name: &str, joints: &[Joint<'_>], wanted: Option<&str>) -> Result<Vec<usize>> {
    let found = match wanted {
        Some(wanted) => joints.iter().position(|joint| joint.name == wanted),
        None => joints.iter().position(|joint| joint.name.to_lowercase().contains("head")),
    };
    let Some(mut joint) = found else {
        let known = joints.iter().map(|joint| joint.name).take(100).collect::<Vec<_>>().join(", ");
        let wanted = wanted.map_or("with \"head\" in its name".to_owned(), |wanted| Quote(wanted).to_string());
        return Err(Error::file(name, format_args!("has no joint {wanted}; there are: {known}")));
    };
    let mut chain = vec![joint];
    while let Some(parent) = joints[joint].parent {
        joint = parent;
        chain.push(joint);
    }
    chain.reverse();
    Ok(chain)
}

/// A joint's pose in its parent, in file units.
fn local_pose(joint: &Joint<'_>, row: &[f64]) -> Frame {
    let mut origin = Vector3::from(joint.offset.unwrap_or_default());
    let mut rotation = UnitQuaternion::identity();
    for (channel, value) in joint.channels.iter().zip(&row[joint.first..]) {
        match channel {
            Channel::Position(axis) => origin[*axis] = *value,
            Channel::Rotation(axis) => {
                let mut turn = Vector3::zeros();
                // Whole turns are redundant, and a huge angle would lose its digits in radians.
                turn[*axis] = (value % 360.0).to_radians();
                rotation *= from_rotation_vector(turn);
            }
        }
    }
    Frame { origin, rotation }
}

fn expect(text: &mut Text<'_>, wanted: &str) -> Result<()> {
    let (line, word) = text.word(wanted)?;
    if word == wanted { Ok(()) } else { Err(text.error(line, format_args!("{}; expected {wanted}", Quote(word)))) }
}
