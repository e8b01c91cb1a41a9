//! The target of a strand: a curve in motion to which the strand is drawn, with a weight along it.
//!
//! Where the weight is w, a point comes to its place on the curve with the time constant τ (1 − w)/w, critically damped: at ½
//! with τ itself, at 0 not at all, and at 1 with [`SHORTEST_TIME`]. So every weight is a spring, and none is a special case.
//!
//! Files:
//!
//! - `definition.rs`: The definition of a target, as a host gives it.

pub mod definition;

use crate::error::Result;
use crate::math::frame::Frame;
use crate::math::vector::Vec3;
use definition::TargetDef;

/// The time constant at weight 1, s: short enough that weight bends a point off its target by a tenth of a micrometre.
pub const SHORTEST_TIME: f64 = 1e-4;

/// A motion that is meant to end with a step may miss its end by rounding.
const ROUNDING: f64 = 1e-12;

/// A point of the curve on its way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetPoint {
    /// Arclength of the strand's point that is drawn here, m.
    pub arclength: f64,
    /// Where the motion begins, m, world.
    pub from: Vec3<f64>,
    /// Where it ends.
    pub to: Vec3<f64>,
    /// Velocity at the start, m/s.
    pub velocity: Vec3<f64>,
}

/// Whether the curve moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TargetMotion {
    /// It has arrived and stands still.
    Rests,
    /// It is on its way.
    Moves {
        /// From start to end, s; 0: as long as the next substep.
        duration: f64,
        /// Seconds of it that are over.
        elapsed: f64,
    },
}

/// A curve in motion, and its weight along the strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// From root to tip.
    pub points: Box<[TargetPoint]>,
    /// Keys: arclength on the strand, m, and the weight there. Linear in between, constant beyond.
    pub weights: Box<[[f64; 2]]>,
    /// Time constant at weight ½, s.
    pub time_constant: f64,
    /// How far the motion is.
    pub motion: TargetMotion,
}

/// A target seen from some seconds after its present time.
#[derive(Debug, Clone, Copy)]
pub struct TargetAt<'a> {
    /// The target.
    pub target: &'a Target,
    /// Seconds from the target's present time.
    pub from: f64,
}

/// What draws a point of the strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetPull {
    /// Where the point belongs, m, world.
    pub position: Vec3<f64>,
    /// How fast that place moves, m/s.
    pub velocity: Vec3<f64>,
    /// The weight, 0 to 1; 0 for no pull.
    pub weight: f64,
    /// The inverse of the time constant, 1/s.
    pub rate: f64,
}

impl TargetPull {
    const NONE: Self = Self { position: Vec3([0.0; 3]), velocity: Vec3([0.0; 3]), weight: 0.0, rate: 0.0 };
}

/// Position and velocity at a moment of a motion, as combinations of its displacement and the displacement by its first velocity.
/// Like a root's, the motion leaves with its first velocity and arrives with its mean velocity.
struct Moment {
    position: [f64; 2],
    velocity: [f64; 2],
}

impl TargetMotion {
    /// The moment `seconds` from now.
    fn moment(&self, seconds: f64) -> Moment {
        let still = Moment { position: [1.0, 0.0], velocity: [0.0, 0.0] };
        let Self::Moves { duration, elapsed } = *self else { return still };
        let time = elapsed + seconds;
        if time > duration * (1.0 + ROUNDING) {
            return still;
        }
        let u = if time >= duration * (1.0 - ROUNDING) { 1.0 } else { time / duration };
        let rate = if duration > 0.0 { 1.0 / duration } else { 0.0 };
        Moment {
            position: [u * u * (2.0 - u), duration * u * (1.0 - u) * (1.0 - u)],
            velocity: [rate * u * (4.0 - 3.0 * u), (1.0 - u) * (1.0 - 3.0 * u)],
        }
    }
}

impl Moment {
    fn of(&self, point: &TargetPoint) -> (Vec3<f64>, Vec3<f64>) {
        let displacement = point.to - point.from;
        let mix = |[by, first]: [f64; 2]| displacement.scale(by) + point.velocity.scale(first);
        // (Without rounding at the end.)
        let position = if self.position == [1.0, 0.0] { point.to } else { point.from + mix(self.position) };
        (position, mix(self.velocity))
    }
}

impl Target {
    /// The target of a checked definition for a strand of this length. It stands still where there was none before; otherwise it
    /// leaves from where the one `before` is, and arrives after `over_seconds`.
    ///
    /// # Errors
    /// As [`TargetDef::arclengths`].
    pub fn new(def: &TargetDef, length: f64, before: Option<&Self>, over_seconds: f64) -> Result<Self> {
        let arclengths = def.arclengths(length)?;
        let mut walk = before.map(|before| (before, before.motion.moment(0.0), 0));
        let mut points = Vec::with_capacity(arclengths.len());
        for (arclength, to) in arclengths.into_iter().zip(def.points) {
            let to = Vec3::from(*to);
            let (from, velocity) =
                walk.as_mut().map_or((to, Vec3::zero()), |(before, moment, segment)| before.clamped(arclength, moment, segment));
            points.push(TargetPoint { arclength, from, to, velocity });
        }
        let motion = match before {
            Some(_) => TargetMotion::Moves { duration: over_seconds, elapsed: 0.0 },
            None => TargetMotion::Rests,
        };
        let weights = def.weights.iter().map(|[position, weight]| [position * length, *weight]).collect();
        Ok(Self { points: points.into(), weights, time_constant: def.time_constant, motion })
    }

    /// Whether it draws any part of a strand.
    pub fn acts(&self) -> bool {
        self.weights.iter().any(|[_, weight]| *weight > 0.0)
    }

    /// A motion of duration 0 takes the next substep of `h` seconds.
    pub fn begin(&mut self, h: f64) {
        if let TargetMotion::Moves { duration, .. } = &mut self.motion
            && *duration == 0.0
        {
            *duration = h;
        }
    }

    /// Goes on by `h` seconds. A motion that has ended rests from the next step on.
    pub fn advance(&mut self, h: f64) {
        if let TargetMotion::Moves { duration, elapsed } = self.motion {
            let time = elapsed + h;
            self.motion = if elapsed >= duration {
                TargetMotion::Rests
            } else if time >= duration * (1.0 - ROUNDING) {
                TargetMotion::Moves { duration, elapsed: duration }
            } else {
                TargetMotion::Moves { duration, elapsed: time }
            };
        }
    }

    /// Goes along with a root that is moved from pose to pose at once.
    pub fn carry(&mut self, from: &Frame, to: &Frame) {
        let turn = to.rotation * from.rotation.inverse();
        let carried = |point: Vec3<f64>| Vec3::from(to.origin + turn * (nalgebra::Vector3::from(point) - from.origin));
        for point in &mut self.points {
            (point.from, point.to) = (carried(point.from), carried(point.to));
            point.velocity = Vec3::from(turn * nalgebra::Vector3::from(point.velocity));
        }
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        size_of_val(&*self.points) + size_of_val(&*self.weights)
    }

    /// Calls `take` with what draws each quadrature point, `seconds` from now. A point outside the curve's arclengths is free.
    #[inline]
    pub fn for_each_point(&self, seconds: f64, lengths: &[f64], nodes: &[f64], mut take: impl FnMut(usize, &TargetPull)) {
        let moment = self.motion.moment(seconds);
        let (mut start, mut segment, mut key, mut p) = (0.0, 0, 0, 0);
        for length in lengths {
            for node in nodes {
                let arclength = start + node * length;
                let weight = self.weight(arclength, &mut key);
                let place = if weight > 0.0 { self.place(arclength, &moment, &mut segment) } else { None };
                let pull = place.map(|(position, velocity)| TargetPull { position, velocity, weight, rate: self.rate(weight) });
                take(p, &pull.unwrap_or(TargetPull::NONE));
                p += 1;
            }
            start += length;
        }
    }

    /// The weight at an arclength; `key` is the last key at or before an earlier one.
    #[inline]
    fn weight(&self, arclength: f64, key: &mut usize) -> f64 {
        let keys = &self.weights;
        while *key + 1 < keys.len() && keys[*key + 1][0] <= arclength {
            *key += 1;
        }
        let [at, weight] = keys[*key];
        match keys.get(*key + 1) {
            Some([next, then]) if arclength > at => weight + (then - weight) * ((arclength - at) / (next - at)),
            _ => weight,
        }
    }

    /// The inverse of the time constant at a weight above 0, 1/s.
    #[inline]
    fn rate(&self, weight: f64) -> f64 {
        weight / (self.time_constant * (1.0 - weight) + SHORTEST_TIME * weight)
    }

    /// Place and velocity at an arclength, `None` outside the curve; `segment` is that of an earlier one.
    #[inline]
    fn place(&self, arclength: f64, moment: &Moment, segment: &mut usize) -> Option<(Vec3<f64>, Vec3<f64>)> {
        let points = &self.points;
        let inside = arclength >= points[0].arclength && arclength <= points[points.len() - 1].arclength;
        inside.then(|| self.clamped(arclength, moment, segment))
    }

    /// The same, with the curve's ends beyond them.
    #[inline]
    fn clamped(&self, arclength: f64, moment: &Moment, segment: &mut usize) -> (Vec3<f64>, Vec3<f64>) {
        let points = &self.points;
        while *segment + 2 < points.len() && points[*segment + 1].arclength < arclength {
            *segment += 1;
        }
        let (left, right) = (&points[*segment], &points[*segment + 1]);
        let span = right.arclength - left.arclength;
        let part = if span > 0.0 { ((arclength - left.arclength) / span).clamp(0.0, 1.0) } else { 0.0 };
        let ((from, slow), (to, fast)) = (moment.of(left), moment.of(right));
        (from + (to - from).scale(part), slow + (fast - slow).scale(part))
    }
}
