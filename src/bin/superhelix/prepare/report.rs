//! What `superhelix prepare` tells.

use std::collections::BTreeMap;

use serde::Serialize;

use super::guides::{GuidesReport, RepresentedReport};
use super::head::BodyReport;
use super::scene::Files;
use super::strands::{REASONS, StrandsReport};

/// The whole report.
#[derive(Debug, Serialize)]
pub struct PrepareReport {
    /// Version of this layout.
    pub version: u32,
    /// The strands' path.
    pub file: String,
    /// Its format.
    pub format: &'static str,
    /// How points were told apart into strands: by the "file", the "caller", "colours", "jumps", or "joined lines".
    pub strands_by: &'static str,
    /// Metres a file unit that were used.
    pub metres_per_unit: f64,
    /// Strands in the file.
    pub strands_in_file: usize,
    /// Points in the file.
    pub points_in_file: usize,
    /// How many strands were dropped for which reason.
    pub dropped_for: BTreeMap<&'static str, usize>,
    /// What was done to the strands.
    pub strands: StrandsReport,
    /// The head.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub head: Option<BodyReport>,
    /// The guides.
    pub guides: GuidesReport,
    /// Length of the scene, s.
    pub duration: f64,
    /// What was written; none in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub files: Option<Files>,
    /// The picture's path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
    /// Wall time of everything, s.
    pub seconds: f64,
}

impl PrepareReport {
    /// For people.
    pub fn in_words(&self) -> String {
        let mut text = format!(
            "{}: {}, {} strands, {} points (strands by {}), {} m a unit\n",
            self.file, self.format, self.strands_in_file, self.points_in_file, self.strands_by, self.metres_per_unit
        );
        for (reason, words) in REASONS {
            if let Some(count) = self.dropped_for.get(reason) {
                let first = self.strands.dropped.iter().find(|dropped| dropped.reason == reason);
                let first = first.map_or_else(String::new, |first| format!(" (strand {}: {})", first.strand, first.because));
                text += &format!("dropped for {words}: {count}{first}\n");
            }
        }
        let strands = &self.strands;
        if !strands.turned.is_empty() {
            text += &format!("turned, because they began at the tip: {}\n", strands.turned.len());
        }
        if let Some(roots) = &strands.roots {
            text += &format!(
                "roots put on the scalp: {} moved, {:.2} mm (rms), {:.2} mm at most\n",
                roots.moved,
                roots.rms * 1e3,
                roots.max * 1e3
            );
        }
        if let Some(inside) = &strands.inside {
            text += &format!(
                "taken out of the head: {} strands, {:.1} mm deep at most; moved {:.2} mm (rms), {:.1} mm at most; {} stay\n",
                inside.strands,
                inside.deepest * 1e3,
                inside.rms * 1e3,
                inside.max * 1e3,
                inside.left.len()
            );
        }
        if let Some(length) = &strands.length {
            text += &format!(
                "kept: {} strands of {:.1} cm (median; {:.1} to {:.1})\n",
                strands.kept,
                length.median * 1e2,
                length.min * 1e2,
                length.max * 1e2
            );
        }
        text += &self.guides.in_words();
        if let Some(files) = &self.files {
            text += &format!("scene: {} ({} s); superhelix run it\n", files.scene.display(), self.duration);
        }
        if let Some(picture) = &self.picture {
            text += &format!("picture: {picture}\n");
        }
        text += &format!("{:.2} s in all", self.seconds);
        text
    }
}

fn millimetres(of: &RepresentedReport) -> String {
    format!("{:.1} mm (rms), {:.1} mm (95 % of the strands), {:.1} mm at most", of.rms * 1e3, of.p95 * 1e3, of.worst * 1e3)
}

impl GuidesReport {
    fn in_words(&self) -> String {
        let represented = &self.represented;
        let mut text = format!(
            "guides: {} of {} asked for ({}): strands are {} from hair that grows from them\n",
            self.strands.len(),
            self.asked,
            represented.way,
            millimetres(represented)
        );
        for tried in self.tried.iter().filter(|tried| tried.way == "random") {
            text += &format!("at random: {}\n", millimetres(tried));
        }
        let mut numbers: Vec<&RepresentedReport> = self.other_numbers.iter().chain([represented]).collect();
        numbers.sort_by_key(|number| number.guides);
        let numbers: Vec<String> = numbers.iter().map(|of| format!("{}: {:.1} mm", of.guides, of.rms * 1e3)).collect();
        text += &format!("by the number of guides: {}\n", numbers.join(", "));
        let apart = &self.apart;
        text += &format!(
            "kept {:.1} mm apart: {} pairs were nearer, {} still are ({:.2} mm too near at most); moved {:.1} mm at most\n",
            2e3 * apart.radius,
            apart.pairs,
            apart.pairs_left,
            apart.deepest_left * 1e3,
            apart.moved * 1e3
        );
        if let (Some(rms), Some(max)) = (self.fit.rms_metres, self.fit.max_metres) {
            let [fewest, most] = self.elements;
            text += &format!(
                "fit: {fewest} to {most} elements; rms {:.2} mm (median strand), {:.2} mm (99 %), farthest point {:.2} mm\n",
                rms.median * 1e3,
                rms.p99 * 1e3,
                max.max * 1e3
            );
        }
        if let Some(resting) = &self.resting {
            text += &resting.in_words(self.strands.len());
        }
        let still = &self.still;
        text += &format!(
            "at rest for {} s: {:.1e} m from where they were (rms), {:.1e} m at most (strand {})\n",
            still.seconds, still.rms, still.max, still.strand
        );
        text
    }
}
