//! The compared quantities: eight points of the strand, without the root and with the tip, at the frames of a film.

use nalgebra::Vector3;

/// Frames per second.
pub const FRAMES: u32 = 24;
/// Points of the strand, equally spaced; the last is the tip.
pub const POINTS: usize = 8;

/// Positions of the points at one time, m.
pub type Shape = [Vector3<f64>; POINTS];

/// Positions of the points at frames 1, 2, …, without the initial strand. `None` where no step ends at the frame.
#[derive(Debug, Clone, Default)]
pub struct Path {
    /// One shape per frame.
    pub frames: Vec<Option<Shape>>,
}

/// Distance of two paths, relative to the strand's length.
#[derive(Debug, Clone, Copy)]
pub struct Distance {
    /// Root mean square over frames, the tip alone.
    pub tip: f64,
    /// The largest of a frame, the tip alone.
    pub tip_most: f64,
    /// Root mean square over frames and points.
    pub shape: f64,
}

impl Path {
    /// Its distance from `other` over the first `frames` frames that both have.
    pub fn distance(&self, other: &Path, frames: usize, length: f64) -> Distance {
        let (mut tip, mut most, mut shape, mut count) = (0.0, 0.0_f64, 0.0, 0);
        for (one, two) in self.frames.iter().zip(&other.frames).take(frames) {
            let (Some(one), Some(two)) = (one, two) else { continue };
            let squares: [f64; POINTS] = std::array::from_fn(|point| (one[point] - two[point]).norm_squared());
            tip += squares[POINTS - 1];
            most = most.max(squares[POINTS - 1].sqrt());
            shape += squares.iter().sum::<f64>() / POINTS as f64;
            count += 1;
        }
        assert!(count > 0, "no frame to compare at");
        let mean = |sum: f64| (sum / f64::from(count)).sqrt() / length;
        Distance { tip: mean(tip), tip_most: most / length, shape: mean(shape) }
    }
}
