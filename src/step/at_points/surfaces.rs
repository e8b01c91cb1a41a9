//! What contact at points asks of the bodies' surfaces, and what it finds (`contacts.rs`).

use crate::math::vector::Vec3;

/// How contact at points is answered.
#[derive(Debug, Clone, Copy)]
pub struct PointContactOptions {
    /// How far surfaces that overlap when the step begins come apart in it, m.
    pub separation: f64,
    /// Friction grows with the overlap down to this depth, m: what is deeper has come in by other ways than by its weight, and must come
    /// out.
    pub holding_depth: f64,
    /// The limit of iterations of a strand with contacts.
    pub max_iterations: u32,
}

/// A body's surface at a point of a strand.
#[derive(Debug, Clone, Copy)]
pub struct SurfaceAtPoint {
    /// The body's index in the scene, and its triangle.
    pub body: u32,
    /// See `body`.
    pub feature: u32,
    /// From the body's surface to the strand's, m; negative where they overlap by more than is permitted.
    pub gap: f64,
    /// The overlap that is permitted there, m.
    pub permitted: f64,
    /// How far the strand's axis is from the body's surface where they touch, m.
    pub margin: f64,
    /// The radius with which the body rounds its creases and edges, m.
    pub rounding: f64,
    /// Unit, from the body to the strand.
    pub normal: Vec3<f64>,
    /// Displacement of the surface during the step, m.
    pub carried: Vec3<f64>,
    /// Coefficients of friction, of a strand against the body, from root to tip and against its scales.
    pub along: f64,
    /// See `along`.
    pub against: f64,
}

impl SurfaceAtPoint {
    /// How far the strand's axis is from the body's surface, m; negative inside.
    pub fn distance(&self) -> f64 {
        self.gap - self.permitted + self.margin
    }
}

/// Surfaces this near may touch a point that lay on them when the step began, m; and what has gone no further has gone through nothing.
pub const NEAR: f64 = 1e-3;

/// The most that a gap changes over a unit of distance.
pub const STEEPEST: f64 = 1.25;

/// How many surfaces may hold a point at a time.
pub const SURFACES_AT_POINT: usize = 3;

/// The surfaces about a point, each of another body, from the nearest on.
#[derive(Debug, Clone, Copy)]
pub struct NearestSurfaces {
    /// The nearest.
    pub nearest: SurfaceAtPoint,
    /// The next, if it may touch the point, too.
    pub next: Option<SurfaceAtPoint>,
}

impl NearestSurfaces {
    /// Both.
    pub fn iter(&self) -> impl Iterator<Item = &SurfaceAtPoint> {
        std::iter::once(&self.nearest).chain(&self.next)
    }
}

/// A place of a strand, and its straight way in a step.
#[derive(Debug, Clone, Copy)]
pub struct Passage {
    /// Arclength from the root, m.
    pub arclength: f64,
    /// Where it was when the step began, m, world.
    pub start: Vec3<f64>,
    /// Where it is now, m, world.
    pub now: Vec3<f64>,
}

/// What is found out at little cost about a passage.
#[derive(Debug, Clone, Copy)]
pub struct PassageBounds {
    /// No gap of it is smaller than this now, overlaps that are permitted counted, m.
    pub least: f64,
    /// The longest way past one of the bodies, in that body's axes, m.
    pub way: f64,
    /// Whether it is certain that the way leads through no surface.
    pub is_free: bool,
}

/// The surfaces that a strand's points may touch, at the end of a step.
pub trait Surfaces {
    /// The nearest surfaces at a point `arclength` from the root whose place is `now`, or, where none is near, a distance that
    /// they all have at least, m.
    fn nearest(&self, arclength: f64, now: Vec3<f64>) -> Result<NearestSurfaces, f64>;
    /// How deep the point, at `start` then, was in the body when the step began, m; zero or less for outside.
    fn depth_at_start(&self, arclength: f64, body: u32, start: Vec3<f64>) -> f64;
    /// Puts what is found out at little cost about passages of the strand in `bounds`, one for each.
    fn bound(&self, passages: &[Passage], bounds: &mut Vec<PassageBounds>);
    /// What a place's straight way leads through, at whose end `nearest` was found.
    fn passed(&self, passage: &Passage, nearest: &Result<NearestSurfaces, f64>) -> Passed;
}

/// What the straight way of a point leads through.
#[derive(Debug, Clone, Copy, Default)]
pub struct Passed {
    /// The surface of a body through which it leads that began outside it; None where there is none, or where the surface that is nearest
    /// at the end faces the same way.
    pub entered: Option<Entered>,
    /// A body near its end, and the depth of the point in it when the step began, m, if that had to be known.
    pub start: Option<(u32, f64)>,
}

/// A surface through which a point has come.
#[derive(Debug, Clone, Copy)]
pub struct Entered {
    /// The surface, with its gap at `place`.
    pub surface: SurfaceAtPoint,
    /// A place by it, m, world.
    pub place: Vec3<f64>,
}

/// A contact at the end of a step.
#[derive(Debug, Clone, Copy)]
pub struct PointContact {
    /// Arclength from the root, m.
    pub arclength: f64,
    /// Its place, m, world.
    pub position: Vec3<f64>,
    /// The surface, with the gap at the end.
    pub surface: SurfaceAtPoint,
    /// Force on the strand, N.
    pub force: Vec3<f64>,
    /// Slip along the surface during the step, m.
    pub slip: Vec3<f64>,
}

/// How deep a strand is in bodies, m; below zero for outside.
#[derive(Debug, Clone, Copy)]
pub struct DepthAtPoints {
    /// Where it is deepest.
    pub deepest: f64,
    /// At its root, if that takes part in contact.
    pub root: f64,
}

impl DepthAtPoints {
    /// That of a strand that nothing is near.
    pub const NONE: Self = Self { deepest: f64::NEG_INFINITY, root: f64::NEG_INFINITY };
}
