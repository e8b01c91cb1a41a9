//! `output`: what a scene asks to be written.
//!
//! Files:
//!
//! - `timeline.rs`: When states are written and which steps lead there.

pub mod timeline;

use std::collections::BTreeSet;

use crate::shell::json::{Complaint, Entries, Node};

/// Samples a strand for `points`, `frames` and `velocities` when the scene does not say.
pub const DEFAULT_SAMPLES: usize = 33;

/// Something that a scene can ask to be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Output {
    /// Tip positions.
    Tips,
    /// Positions of samples along each strand.
    Points,
    /// Positions and material frames of samples.
    Frames,
    /// Velocities of samples.
    Velocities,
    /// Curvature rows.
    Curvatures,
    /// Rates of the curvatures.
    Rates,
    /// Energies of all strands together.
    Energies,
    /// Contacts.
    Contacts,
    /// Wrenches on the follicles and on colliders.
    Wrenches,
    /// How attachments fared.
    Attachments,
}

const OUTPUTS: [(&str, Output); 10] = [
    ("tips", Output::Tips),
    ("points", Output::Points),
    ("frames", Output::Frames),
    ("velocities", Output::Velocities),
    ("curvatures", Output::Curvatures),
    ("rates", Output::Rates),
    ("energies", Output::Energies),
    ("contacts", Output::Contacts),
    ("wrenches", Output::Wrenches),
    ("attachments", Output::Attachments),
];

impl Output {
    /// Whether this one is sampled along the strand.
    fn is_sampled(self) -> bool {
        matches!(self, Output::Points | Output::Frames | Output::Velocities)
    }
}

/// One entry of `output`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Request {
    /// What.
    pub output: Output,
    /// Samples a strand, for the sampled ones.
    pub samples: usize,
}

fn read_samples(node: &Node) -> Result<usize, Complaint> {
    Ok(node.whole(2..=1_000_000)? as usize)
}

/// Reads `output` and `samples`.
pub fn read(scene: &Entries) -> Result<(Vec<Request>, usize), Complaint> {
    let samples = scene.or("samples", DEFAULT_SAMPLES, read_samples)?;
    let Some(list) = scene.get("output") else { return Ok((vec![Request { output: Output::Tips, samples }], samples)) };
    let mut seen = BTreeSet::new();
    let mut requests = Vec::new();
    for item in list.list()? {
        let request = if item.value.is_object() {
            let entries = item.object(&["kind", "samples"])?;
            let output = entries.require("kind")?.choice(&OUTPUTS)?;
            if let Some(samples) = entries.get("samples")
                && !output.is_sampled()
            {
                return Err(samples.complain("samples only beside \"points\", \"frames\" or \"velocities\""));
            }
            Request { output, samples: entries.or("samples", samples, read_samples)? }
        } else {
            Request { output: item.choice(&OUTPUTS)?, samples }
        };
        if !seen.insert(request.output) {
            return Err(item.complain("each output once"));
        }
        requests.push(request);
    }
    Ok((requests, samples))
}
