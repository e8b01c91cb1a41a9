//! What `superhelix simulate` tells afterwards.

use serde::Serialize;
use superhelix::rod::material::Material;

use crate::groom_statistics::Spread;
use crate::groom_strands::Skipped;
use crate::report::Report;
use crate::settled::Settled;
use crate::simulate_body::BodyReport;

/// How well strands follow the groom's polylines.
#[derive(Debug, Serialize)]
pub struct FitReport {
    /// Root mean square distance a strand, m.
    pub rms_metres: Option<Spread>,
    /// Largest distance a strand, m.
    pub max_metres: Option<Spread>,
    /// Strands with an element that turns by more than a quarter turn: more elements are advised.
    pub strands_with_coarse_elements: usize,
}

/// How many strands were made stiffer, and how much: bending stiffness over what it was.
#[derive(Debug, Serialize)]
pub struct Stiffened {
    /// Strands.
    pub strands: usize,
    /// By how much, of these.
    pub factor: Option<Spread>,
}

impl Stiffened {
    /// By their materials and what these were.
    pub fn of<'a>(materials: impl Iterator<Item = &'a Material>, before: &Material) -> Self {
        let bending = |material: &Material| material.youngs_modulus * (material.radius[0] * material.radius[1]).powi(2);
        let factors: Vec<f64> =
            materials.map(|material| bending(material) / bending(before)).filter(|factor| *factor > 1.0 + 1e-9).collect();
        Self { strands: factors.len(), factor: Spread::of(factors) }
    }
}

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
    /// What `--stiffen` did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffened: Option<Stiffened>,
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
        if let Some(stiffened) = &self.stiffened {
            text += &match stiffened.factor {
                Some(factor) => format!(
                    "made stiffer to rest as drawn: {} of {} strands, {:.1} times (median), {:.0} times at most\n",
                    stiffened.strands, self.strands, factor.median, factor.max
                ),
                None => "made stiffer to rest as drawn: none\n".to_string(),
            };
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
            "strand-steps unconverged: {}, quarantined: {}, taken in parts: {}\n",
            report.unconverged, report.quarantined, report.subdivided
        );
        if let Some(contact) = &report.contact {
            text += &format!(
                "touches: {:.0} a step (at most {}), {:.4} mm deep at most, residual {:.1e}, {} searches and {} sweeps, unconverged: {}\n",
                contact.touches_mean,
                contact.touches_max,
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
