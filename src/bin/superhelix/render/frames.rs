//! Render strands from moments of guides, as curves of files, with velocities where it is known how the guides move.

use std::sync::{Arc, Mutex};
use std::time::Instant;

use nalgebra::Vector3;
use superhelix::io::{Curves, Extras};
use superhelix::render::{
    GuideSamples, Motion, RenderBody, RenderHair, RenderPose, RootsAt, StrandPoints, StrandSink, VELOCITY_STEP, View,
};
use superhelix::{Frame, Shape};

use crate::render::guide_frames::{GuideFrame, velocities};
use crate::shell::failure::Failure;

/// Guides and roots at a moment.
pub struct Moment {
    /// What it is called in errors.
    pub name: String,
    /// s, where it is known.
    pub time: Option<f64>,
    /// m.
    pub guides: GuideFrame,
    /// On a scalp that deforms, m.
    pub roots: Option<Vec<Vector3<f64>>>,
    /// What the strands are kept out of, beside the head.
    pub bodies: Vec<BodyThen>,
}

/// A body at a moment.
#[derive(Debug, Clone)]
pub struct BodyThen {
    /// Its shape.
    pub shape: Arc<Shape>,
    /// Where it is.
    pub pose: Frame,
    /// Where it was [`VELOCITY_STEP`] before.
    pub pose_before: Frame,
    /// How far outside its shape its surface lies, m.
    pub thickness: f64,
}

/// Points, widths and velocities in file units.
struct Taken {
    per_strand: usize,
    scale: f64,
    /// What positions are counted from, m.
    origin: Vector3<f64>,
    room: Mutex<Room>,
}

struct Room {
    points: Vec<[f32; 3]>,
    widths: Vec<f32>,
    velocities: Option<Vec<[f32; 3]>>,
}

impl StrandSink for Taken {
    fn take(&self, strand: &StrandPoints) {
        let mut room = self.room.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let unit = |value: f32| (f64::from(value) / self.scale) as f32;
        let place = |axis: usize, k: usize| ((f64::from(strand.positions[axis][k]) + self.origin[axis]) / self.scale) as f32;
        for k in 0..self.per_strand {
            let at = strand.strand * self.per_strand + k;
            room.points[at] = [0, 1, 2].map(|axis| place(axis, k));
            room.widths[at] = 2.0 * unit(strand.radius_factor * strand.radii[k]);
            if let Some(velocities) = &mut room.velocities {
                velocities[at] = strand.velocities.map(|row| unit(row[k]));
            }
        }
    }
}

/// Makes the frames.
pub struct Renderer {
    now: RenderPose,
    /// [`VELOCITY_STEP`] before.
    before: RenderPose,
    /// What the strands are kept out of that goes with the guides' roots; at rest its axes are the world's.
    head: Option<Shape>,
    scale: f64,
    /// Unit and axis.
    of: Extras,
    /// How long it took so far, s.
    pub seconds: f64,
}

impl Renderer {
    /// For frames of `scale` metres a unit; `of` has what else the file says.
    pub fn new(hair: RenderHair, head: Option<Shape>, scale: f64, of: Extras) -> Self {
        let pose = RenderPose::new(Arc::new(hair));
        Self { now: pose.clone(), before: pose, head, scale, of, seconds: 0.0 }
    }

    /// The strands at a moment, as curves with widths and, where it is said how guides and roots move, velocities.
    pub fn frame(&mut self, at: &Moment, moving: Option<&Velocities>) -> Result<Curves, Failure> {
        let begun = Instant::now();
        self.now.set(&GuideSamples::at_rest(&at.guides.points))?;
        let back = |points: &[Vector3<f64>], velocities: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            points.iter().zip(velocities).map(|(point, velocity)| point - velocity * VELOCITY_STEP).collect()
        };
        let mut roots_before = None;
        if let Some(moving) = moving {
            self.before.set(&GuideSamples::at_rest(&back(&at.guides.points, &moving.guides)))?;
            roots_before = at.roots.as_deref().zip(moving.roots.as_deref()).map(|(roots, velocities)| back(roots, velocities));
        }
        let (roots, roots_before) = (at.roots.as_deref().map(place_of), roots_before.as_deref().map(place_of));
        let motion = match moving {
            None => Motion::None,
            Some(_) => Motion::Since {
                before: &self.before,
                seconds: VELOCITY_STEP,
                roots: roots_before.as_ref().map(|roots| roots as RootsAt<'_>),
            },
        };
        let (count, per_strand) = (self.now.hair().strand_count(), self.now.hair().settings().points_per_strand);
        let total = count * per_strand;
        let room =
            Room { points: vec![[0.0; 3]; total], widths: vec![0.0; total], velocities: moving.map(|_| vec![[0.0; 3]; total]) };
        // Velocities are differences of floats: near the hair those are finest.
        let origin = at.guides.points[0];
        let sink = Taken { per_strand, scale: self.scale, origin, room: Mutex::new(room) };
        let roots = roots.as_ref().map(|roots| roots as RootsAt<'_>);
        let mut bodies: Vec<RenderBody> = Vec::with_capacity(at.bodies.len() + 1);
        for body in &at.bodies {
            let BodyThen { shape, pose, pose_before, thickness } = body;
            bodies.push(RenderBody { shape, pose: *pose, pose_before: *pose_before, thickness: *thickness });
        }
        if let Some(shape) = &self.head {
            let pose = self.now.head();
            let pose_before = if moving.is_some() { self.before.head() } else { pose };
            bodies.push(RenderBody { shape, pose, pose_before, thickness: 0.0 });
        }
        let view = View { origin, roots, motion, bodies: &bodies, ..View::whole(self.now.hair()) };
        self.now.evaluate(&view, &sink)?;
        let room = sink.room.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
        self.seconds += begun.elapsed().as_secs_f64();
        let curves = Curves::from_counts(vec![per_strand as u32; count], room.points)?;
        let extras = Extras { thickness: Some(room.widths), velocities: room.velocities, ..self.of.clone() };
        Ok(curves.with_extras(extras)?)
    }
}

fn place_of(places: &[Vector3<f64>]) -> impl Fn(usize) -> Vector3<f64> + Sync + '_ {
    |strand| places[strand]
}

/// How guides and roots move, m/s.
pub struct Velocities {
    guides: Vec<Vector3<f64>>,
    roots: Option<Vec<Vector3<f64>>>,
}

impl Velocities {
    /// The file's own, else by the frames before and after; none where neither is known.
    pub fn of(before: Option<&Moment>, now: &Moment, after: Option<&Moment>) -> Option<Self> {
        type List = fn(&Moment) -> Option<&[Vector3<f64>]>;
        fn timed(at: Option<&Moment>, list: List) -> Option<(f64, &[Vector3<f64>])> {
            let at = at?;
            Some((at.time?, list(at)?))
        }
        let by_frames = |list: List| velocities(timed(before, list), timed(Some(now), list)?, timed(after, list));
        let guides = now.guides.velocities.clone().or_else(|| by_frames(|at| Some(&at.guides.points)))?;
        Some(Self { guides, roots: by_frames(|at| at.roots.as_deref()) })
    }
}
