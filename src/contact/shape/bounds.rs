//! Boxes along the axes, around what is to be kept apart cheaply.

use nalgebra::Vector3;

/// A box along the axes. May be infinite; the empty box has `low` above `high`.
///
/// ```
/// use superhelix::nalgebra::Vector3;
/// use superhelix::shapes::Bounds;
///
/// let bounds = Bounds::of_points([Vector3::new(0.0, 0.0, 0.0), Vector3::new(1.0, 2.0, 3.0)]);
/// assert!(bounds.holds(&Vector3::new(0.5, 0.5, 0.5)) && !bounds.holds(&Vector3::new(-0.5, 0.5, 0.5)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates, m.
    pub low: Vector3<f64>,
    /// Largest coordinates, m.
    pub high: Vector3<f64>,
}

impl Bounds {
    /// The box of nothing: every union with it is the other box.
    pub const EMPTY: Bounds = Bounds {
        low: Vector3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vector3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// All of space.
    pub const EVERYTHING: Bounds = Bounds {
        low: Vector3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
        high: Vector3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
    };

    /// A box from its centre and half its edges.
    pub fn around(centre: Vector3<f64>, half: Vector3<f64>) -> Self {
        Self { low: centre - half, high: centre + half }
    }

    /// The box of points.
    pub fn of_points(points: impl IntoIterator<Item = Vector3<f64>>) -> Self {
        let mut bounds = Self::EMPTY;
        for point in points {
            bounds.take(point);
        }
        bounds
    }

    /// Grows to hold a point.
    #[inline]
    pub fn take(&mut self, point: Vector3<f64>) {
        self.low = self.low.inf(&point);
        self.high = self.high.sup(&point);
    }

    /// The smallest box around both.
    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// Larger by `margin` on every side.
    #[inline]
    pub fn grown(&self, margin: f64) -> Self {
        let margin = Vector3::repeat(margin);
        Self { low: self.low - margin, high: self.high + margin }
    }

    /// Whether the two share a point.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
            && self.low.z <= other.high.z
            && other.low.z <= self.high.z
    }

    /// Whether all its coordinates are finite.
    pub fn is_finite(&self) -> bool {
        self.low.iter().chain(self.high.iter()).all(|x| x.is_finite())
    }

    /// Whether a point lies in it.
    #[inline]
    pub fn holds(&self, point: &Vector3<f64>) -> bool {
        self.low.iter().zip(point).all(|(low, x)| low <= x) && self.high.iter().zip(point).all(|(high, x)| x <= high)
    }

    /// Distance of a point from the box, m; zero inside.
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.distance_squared(point).sqrt()
    }

    /// The square of [`Bounds::distance`], m².
    #[inline]
    pub fn distance_squared(&self, point: &Vector3<f64>) -> f64 {
        (self.low - point).sup(&(point - self.high)).sup(&Vector3::zeros()).norm_squared()
    }

    /// The eight corners.
    pub fn corners(&self) -> [Vector3<f64>; 8] {
        std::array::from_fn(|corner| {
            Vector3::from_fn(|axis, _| if corner >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] })
        })
    }
}
