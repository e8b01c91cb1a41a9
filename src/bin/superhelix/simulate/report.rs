//! What `superhelix simulate` tells afterwards.

use serde::Serialize;

use crate::groom::strands::Skipped;
use crate::groom::wisp_arguments::WispReport;
use crate::simulate::body::BodyReport;
use crate::simulate::style::StyleReport;
use crate::stepping::drawn_inside::DrawnInside;
use crate::stepping::fitted::{FitReport, Resting};
use crate::stepping::report::Report;
use crate::stepping::settled::Settled;

/// The whole report.
#[derive(Debug, Serialize)]
pub struct SimulateReport {
    /// Version of this layout.
    pub version: u32,
    /// The groom's path.
    pub groom: String,
    /// Its format.
    pub format: &'static str,
    /// Metres a file unit that were used.
    pub metres_per_unit: f64,
    /// Strands in the file.
    pub strands_in_file: usize,
    /// Strands simulated.
    pub strands: usize,
    /// Helical elements a strand, at least.
    pub elements: u32,
    /// Of the strand that has most.
    pub most_elements: usize,
    /// What each strand stands for.
    pub wisps: WispReport,
    /// How strands rest as drawn, where they are to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resting: Option<Resting>,
    /// What was drawn inside the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drawn_inside: Option<DrawnInside>,
    /// Strands that could not be simulated.
    pub skipped: Vec<Skipped>,
    /// The fit.
    pub fit: FitReport,
    /// How `--settle` went.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settled: Option<Settled>,
    /// The mesh that moves with the head.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<BodyReport>,
    /// Frames, the one at the start included.
    pub frames: usize,
    /// Length of a step, s.
    pub time_step: f64,
    /// Length of the motion that was simulated, s.
    pub simulated_seconds: f64,
    /// How the style held.
    pub style: StyleReport,
    /// How the steps went.
    pub report: Report,
    /// Indices in the file of strands that were rolled back at some step.
    pub quarantined_strands: Vec<usize>,
    /// Wall time of reading and fitting, s.
    pub preparing_seconds: f64,
    /// Wall time of everything, s.
    pub total_seconds: f64,
    /// Frames written to the cache.
    pub cache_frames: u32,
    /// The cache's directory.
    pub cache: Option<String>,
    /// The picture's path.
    pub picture: Option<String>,
}

impl SimulateReport {
    /// For people.
    pub fn in_words(&self) -> String {
        let mut text = format!(
            "{}: {} of {} strands, {} elements, {} m a unit\n",
            self.groom,
            self.strands,
            self.strands_in_file,
            if self.most_elements > self.elements as usize {
                format!("{} to {}", self.elements, self.most_elements)
            } else {
                format!("{}", self.elements)
            },
            self.metres_per_unit
        );
        if self.wisps.hairs > 1.0 {
            text += &format!(
                "each strand a wisp of {:.0} hairs, hold {}: {:.1} times as stiff as they are\n",
                self.wisps.hairs, self.wisps.hold, self.wisps.stiffer
            );
        }
        if let Some(resting) = &self.resting {
            text += &resting.in_words(self.strands);
        }
        if let Some(body) = &self.body {
            text += &match (body.cell, &body.grid) {
                (Some(cell), kept) => format!(
                    "{}: {} triangles, as a grid of distances {:.1} mm apart{}\n",
                    body.mesh,
                    body.triangles,
                    cell * 1e3,
                    kept.as_ref().map_or_else(String::new, |kept| format!(" ({kept})"))
                ),
                (None, _) => format!("{}: {} triangles, as a mesh ({})\n", body.mesh, body.triangles, body.sides),
            };
        }
        if let Some(drawn) = &self.drawn_inside {
            text += &drawn.in_words();
        }
        if let (Some(rms), Some(max)) = (self.fit.rms_metres, self.fit.max_metres) {
            text += &format!(
                "fit: rms {:.2} mm (median strand), {:.2} mm (99 %), farthest point {:.2} mm\n",
                rms.median * 1e3,
                rms.p99 * 1e3,
                max.max * 1e3
            );
        }
        if let Some(settled) = &self.settled {
            text += &format!(
                "settled: {} strands without stable rest, {} unstable states left\n",
                settled.unconverged, settled.saddles
            );
        }
        if !self.skipped.is_empty() {
            text += &format!(
                "left out: {} strands, the first (strand {}): {}\n",
                self.skipped.len(),
                self.skipped[0].strand,
                self.skipped[0].because
            );
        }
        let report = &self.report;
        text += &format!(
            "{} frames, {} steps of {:.3} ms: {:.2} s of stepping for {:.2} s of motion, {:.1} iterations a step (at most {})\n",
            self.frames,
            report.steps,
            self.time_step * 1e3,
            report.seconds,
            self.simulated_seconds,
            report.iterations_mean,
            report.iterations_max
        );
        text += &format!(
            "strand-steps unconverged: {}, quarantined: {}, taken in substeps: {}\n",
            report.unconverged, report.quarantined, report.subdivided
        );
        if let Some(contact) = &report.contact {
            text += &format!(
                "contacts: {:.0} a step (at most {}), {:.4} mm deep at most, residual {:.1e}, {} searches and {} sweeps, islands unconverged: {}\n",
                contact.contacts_mean,
                contact.contacts_max,
                contact.penetration_max * 1e3,
                contact.residual_max,
                contact.searches,
                contact.sweeps,
                contact.unconverged
            );
            if contact.roots_inside_max > 0 {
                text += &format!(
                    "strands whose roots are in a body, where no force parts them: {} (see exempt length)\n",
                    contact.roots_inside_max
                );
            }
        }
        let style = &self.style;
        text += &format!(
            "style: {:.1} % of a length from where it was drawn in the end (rms), volume {:.0} %, fastest tip {:.1} m/s beside the head\n",
            style.distance * 1e2,
            style.volume * 1e2,
            style.fastest_tip
        );
        if let Some(inside) = &style.inside {
            text += &format!(
                "inside the body by more than 2 mm, roots included: {:.2} % of the points ({:.2} % at the start), {:.1} mm at most \
                 ({:.1} mm at the start)\n",
                inside.share * 1e2,
                inside.share_at_start * 1e2,
                inside.deepest * 1e3,
                inside.deepest_at_start * 1e3
            );
        }
        if let Some(cache) = &self.cache {
            text += &format!("cache: {} frames in {cache}\n", self.cache_frames);
        }
        if let Some(picture) = &self.picture {
            text += &format!("picture: {picture}\n");
        }
        text += &format!("{:.2} s in all, {:.2} s of them reading and fitting", self.total_seconds, self.preparing_seconds);
        text
    }
}
