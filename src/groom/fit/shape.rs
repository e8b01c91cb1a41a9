//! The strand under search, relative to its length: root at the origin, total length 1.

use crate::math::vector::Mat3;

/// A Super-Helix of length 1 that starts at the origin.
#[derive(Debug, Clone, Default)]
pub(super) struct Shape {
    /// Frame at the root, columns n0, n1, n2.
    pub root: Root,
    /// Curvatures times the length, one row per element.
    pub rows: Vec<[f64; 3]>,
    /// Nodes between elements: 0, …, 1; one more than rows.
    pub nodes: Vec<f64>,
}

/// A root frame; the unit matrix by default.
#[derive(Debug, Clone, Copy)]
pub(super) struct Root(pub Mat3<f64>);

impl Default for Root {
    fn default() -> Self {
        Self(Mat3::identity())
    }
}

impl Shape {
    /// Length of an element.
    pub fn length(&self, element: usize) -> f64 {
        self.nodes[element + 1] - self.nodes[element]
    }

    /// Copies `other`, reusing memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.root = other.root;
        self.rows.clone_from(&other.rows);
        self.nodes.clone_from(&other.nodes);
    }
}
