//! The hair of a picture, in a view's axes.

use std::ops::Range;

use nalgebra::Vector3;

/// How wide a thread is at its tip, as a share; it is as wide as at its root for the first half of its length.
const TIP: f32 = 0.3;
/// How much threads differ in width, as a share each way.
const WIDTHS: f32 = 0.25;

/// Points of threads and their widths, in file units.
#[derive(Debug)]
pub struct Threads {
    /// Right, up, towards the viewer.
    pub points: Vec<Vector3<f32>>,
    /// A thread's first point; the number of points at the end.
    pub starts: Vec<usize>,
    /// Width of each thread at its root.
    pub widths: Vec<f32>,
}

impl Threads {
    /// Strands of at least two points as `look` sees them.
    pub fn new(strands: &[Vec<[f32; 3]>], width: f32, look: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let mut threads = Self { points: Vec::new(), starts: vec![0], widths: Vec::new() };
        threads.points.reserve(strands.iter().map(Vec::len).sum());
        for (index, strand) in strands.iter().enumerate().filter(|(_, strand)| strand.len() > 1) {
            threads.points.extend(strand.iter().map(|point| Vector3::from(look(*point))));
            threads.starts.push(threads.points.len());
            threads.widths.push(width * (1.0 + WIDTHS * (2.0 * random(index as u32, 1) - 1.0)));
        }
        threads
    }

    /// Ranges of points and widths.
    pub fn strands(&self) -> impl Iterator<Item = (Range<usize>, f32)> + '_ {
        self.starts.windows(2).map(|pair| pair[0]..pair[1]).zip(self.widths.iter().copied())
    }
}

/// What is left of a thread's width, `along` from 0 at the root to 1 at the tip.
pub fn taper(along: f32) -> f32 {
    1.0 - (1.0 - TIP) * (2.0 * along - 1.0).max(0.0)
}

/// A number from 0 to 1 that belongs to a thread and a purpose: the finaliser of MurmurHash3.
pub fn random(thread: u32, purpose: u32) -> f32 {
    let mut bits = thread.wrapping_mul(0x9e37_79b9) ^ purpose.wrapping_mul(0x85eb_ca6b).wrapping_add(0x27d4_eb2f);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ (bits >> 13)).wrapping_mul(0xc2b2_ae35);
    (bits ^ (bits >> 16)) as f32 / u32::MAX as f32
}
