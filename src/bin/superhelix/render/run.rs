//! Render strands of one run: bound to the guides at rest, made from every moment of theirs that is handed over, and written.

use std::time::Instant;

use superhelix::internals::groom::render_hair::points::own_shapes::with_own_shapes;
use superhelix::io::Extras;
use superhelix::render::{GuideSamples, RenderHair, RenderSettings};
use superhelix::{Error, Shape};

use crate::render::frames::{BodyThen, Moment, Renderer, Velocities};
use crate::render::guide_frames::GuideFrame;
use crate::render::output::RenderOutput;
use crate::render::roots::Places;
use crate::shell::failure::Failure;

/// The map of a run and the places of its strands.
#[derive(Debug)]
pub struct BoundHair {
    hair: RenderHair,
    places: Places,
    /// How long that took, s.
    seconds: f64,
}

impl BoundHair {
    /// From the guides at rest.
    pub fn bind(settings: &RenderSettings, places: Places, rest: &GuideFrame) -> Result<Self, Error> {
        let begun = Instant::now();
        let normals = places.normals.as_deref();
        let hair = RenderHair::bind_on(settings, &GuideSamples::at_rest(&rest.points), &places.roots, normals)?;
        let hair = match &places.shapes {
            Some(shapes) => with_own_shapes(hair, shapes)?,
            None => hair,
        };
        Ok(Self { hair, places, seconds: begun.elapsed().as_secs_f64() })
    }
}

/// Strands on their way from moments to files. A moment is written when the one after it is known, from which velocities may come.
pub struct RenderRun {
    renderer: Renderer,
    places: Places,
    out: RenderOutput,
    before: Option<Moment>,
    now: Option<Moment>,
    done: Done,
}

/// What a run was.
#[derive(Debug, Clone, Copy)]
pub struct Done {
    /// How many guides.
    pub guides: usize,
    /// How many strands.
    pub strands: usize,
    /// How many frames.
    pub frames: usize,
    /// Whether any frame has velocities.
    pub with_velocities: bool,
    /// How long the map took, s.
    pub bind_seconds: f64,
    /// How long the frames took, s.
    pub evaluate_seconds: f64,
}

impl RenderRun {
    /// For files of `scale` metres a unit; `of` has what else they say.
    /// `head`: what the strands are kept out of, in the world's axes at rest, that goes with the guides' roots.
    pub fn new(bound: BoundHair, head: Option<Shape>, scale: f64, of: Extras, out: RenderOutput) -> Self {
        let BoundHair { hair, places, seconds } = bound;
        let done = Done {
            guides: hair.guide_count(),
            strands: hair.strand_count(),
            frames: 0,
            with_velocities: false,
            bind_seconds: seconds,
            evaluate_seconds: 0.0,
        };
        Self { renderer: Renderer::new(hair, head, scale, of), places, out, before: None, now: None, done }
    }

    /// Takes the guides of the next frame, and bodies beside the head, at a time (s) where it is known; `name` is what the frame is called in
    /// errors.
    pub fn take(&mut self, name: String, time: Option<f64>, guides: GuideFrame, bodies: Vec<BodyThen>) -> Result<(), Failure> {
        let roots = self.places.moving.as_ref().map(|scalp| scalp.roots(self.done.frames)).transpose()?;
        self.done.frames += 1;
        let next = Moment { name, time, guides, roots, bodies };
        self.write(Some(&next))?;
        self.before = self.now.replace(next);
        Ok(())
    }

    /// Writes the last frame and ends the files.
    pub fn finish(mut self) -> Result<Done, Failure> {
        self.write(None)?;
        self.out.finish()?;
        Ok(Done { evaluate_seconds: self.renderer.seconds, ..self.done })
    }

    fn write(&mut self, after: Option<&Moment>) -> Result<(), Failure> {
        let Some(now) = &self.now else { return Ok(()) };
        let moving = if self.out.holds_velocities() { Velocities::of(self.before.as_ref(), now, after) } else { None };
        self.done.with_velocities |= moving.is_some();
        let made = self.renderer.frame(now, moving.as_ref());
        let made = made.map_err(|failure| Failure::Other(format!("{}: {failure}", now.name)))?;
        self.out.write(now.time.unwrap_or(0.0), &made)
    }
}
