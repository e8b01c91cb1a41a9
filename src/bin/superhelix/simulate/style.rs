//! How a groom's style held: where strands are beside where they were drawn, in the frame of the head that carries them.

use nalgebra::Vector3;
use serde::Serialize;
use superhelix::{Frame, Result, Shape, Solver, StrandId};

use crate::stepping::drawn_inside::INSIDE;

/// Points a strand that are looked at.
const SAMPLES: usize = 33;

/// What a run did to a style.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct StyleReport {
    /// Distance of strands from where they began, in the head's frame, at the end: root mean square, in lengths of the strand.
    pub distance: f64,
    /// How far the outer quarter of the strands was from the nearest root at the end, over how far it was at the start: mean over their points.
    pub volume: f64,
    /// The fastest tip beside the head, by its places in successive frames, m/s.
    pub fastest_tip: f64,
    /// What lay in the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inside: Option<InsideReport>,
}

/// What lay in a body.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct InsideReport {
    /// The share of all points, of all frames, that were more than 2 mm inside. Roots count: those that are drawn inside stay there.
    pub share: f64,
    /// The same at the start.
    pub share_at_start: f64,
    /// The deepest, m.
    pub deepest: f64,
    /// The same at the start, m.
    pub deepest_at_start: f64,
}

/// A style that is watched.
pub struct Style<'a> {
    body: Option<&'a Shape>,
    fps: f64,
    /// Of the first frame and the latest, head's frame, m: strand after strand.
    drawn: Vec<Vector3<f64>>,
    now: Vec<Vector3<f64>>,
    fastest: f64,
    inside: u64,
    inside_at_start: u64,
    seen: u64,
    deepest: f64,
    deepest_at_start: f64,
}

impl<'a> Style<'a> {
    /// To be watched `fps` times a second, beside a body that moves with the head.
    pub fn new(body: Option<&'a Shape>, fps: f64) -> Self {
        let (drawn, now) = (Vec::new(), Vec::new());
        Self { body, fps, drawn, now, fastest: 0.0, inside: 0, inside_at_start: 0, seen: 0, deepest: 0.0, deepest_at_start: 0.0 }
    }

    /// Looks at the solver's present state, with the head at `pose`.
    pub fn look(&mut self, solver: &Solver, ids: &[StrandId], pose: &Frame) -> Result<()> {
        let tips: Vec<_> = self.now.iter().skip(SAMPLES - 1).step_by(SAMPLES).copied().collect();
        self.now.resize(ids.len() * SAMPLES, Vector3::zeros());
        let (now, back) = (&mut self.now, pose.rotation.inverse());
        solver.sample_strands(ids, SAMPLES, |strand, point, sample| {
            now[strand * SAMPLES + point] = back * (sample.position - pose.origin);
        })?;
        for (before, after) in tips.iter().zip(self.now.iter().skip(SAMPLES - 1).step_by(SAMPLES)) {
            self.fastest = self.fastest.max((after - before).norm() * self.fps);
        }
        if let Some(body) = self.body {
            for point in &self.now {
                if let Some(surface) = body.closest(*point, 0.0) {
                    self.deepest = self.deepest.max(-surface.distance);
                    self.inside += u64::from(surface.distance < -INSIDE);
                }
            }
            self.seen += self.now.len() as u64;
        }
        if self.drawn.is_empty() {
            self.drawn.clone_from(&self.now);
            (self.inside_at_start, self.deepest_at_start) = (self.inside, self.deepest);
        }
        Ok(())
    }

    /// What became of it.
    pub fn report(&self) -> StyleReport {
        let mut square = 0.0;
        for (now, drawn) in self.now.chunks(SAMPLES).zip(self.drawn.chunks(SAMPLES)) {
            let length: f64 = drawn.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
            square += now.iter().zip(drawn).map(|(a, b)| (a - b).norm_squared()).sum::<f64>() / (length * length);
        }
        let share = |count: u64, of: u64| count as f64 / of.max(1) as f64;
        StyleReport {
            distance: (square / self.now.len().max(1) as f64).sqrt(),
            volume: self.volume(),
            fastest_tip: self.fastest,
            inside: self.body.map(|_| InsideReport {
                share: share(self.inside, self.seen),
                share_at_start: share(self.inside_at_start, self.now.len() as u64),
                deepest: self.deepest,
                deepest_at_start: self.deepest_at_start,
            }),
        }
    }

    /// See [`StyleReport::volume`].
    fn volume(&self) -> f64 {
        let roots: Vec<Vector3<f64>> = self.drawn.iter().step_by(SAMPLES).copied().collect();
        let height = |strand: &[Vector3<f64>]| -> f64 {
            let nearest =
                |point: &Vector3<f64>| roots.iter().map(|root| (root - point).norm_squared()).fold(f64::INFINITY, f64::min);
            strand.iter().map(|point| nearest(point).sqrt()).sum::<f64>() / SAMPLES as f64
        };
        let mut strands: Vec<(f64, usize)> =
            self.drawn.chunks(SAMPLES).map(height).enumerate().map(|(k, height)| (height, k)).collect();
        strands.sort_by(|a, b| b.0.total_cmp(&a.0));
        strands.truncate(strands.len().div_ceil(4));
        let before: f64 = strands.iter().map(|(height, _)| height).sum();
        let after: f64 = strands.iter().map(|(_, k)| height(&self.now[k * SAMPLES..(k + 1) * SAMPLES])).sum();
        after / before
    }
}
