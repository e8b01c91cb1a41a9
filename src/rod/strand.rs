//! The constants of a strand: its elements, material, natural shape and freedoms.

use std::ops::Deref;
use std::sync::Arc;

use super::freedoms::Freedoms;
use super::material::Material;
use super::section::Section;

/// One strand's constants, as the kernels read them. The fields of its [`Section`] read like its own: `model.stiffness`.
#[derive(Debug, Clone, PartialEq)]
pub struct StrandModel {
    /// Element lengths ℓ from root to tip, m.
    pub lengths: Box<[f64]>,
    /// Natural curvatures κⁿ, one row per element.
    pub natural: Box<[[f64; 3]]>,
    section: Arc<Section>,
    equal_length: f64,
    length: f64,
}

impl Deref for StrandModel {
    type Target = Section;

    #[inline(always)]
    fn deref(&self) -> &Section {
        &self.section
    }
}

/// The element of a chain of these lengths (m) that holds the point at an arclength, and the arclength on that element, m. An
/// arclength beyond an end gives that end; at a border the element before it.
pub fn place_on(lengths: impl ExactSizeIterator<Item = f64>, arclength: f64) -> (usize, f64) {
    let (mut rest, count) = (arclength, lengths.len());
    for (element, length) in lengths.enumerate() {
        if rest <= length || element + 1 == count {
            return (element, rest.clamp(0.0, length));
        }
        rest -= length;
    }
    (0, 0.0)
}

impl StrandModel {
    /// From a definition's fields.
    pub fn new(lengths: Vec<f64>, natural: Vec<[f64; 3]>, material: Material, freedoms: Freedoms) -> Self {
        Self::of_section(lengths, natural, Arc::new(Section::new(material, freedoms)))
    }

    /// The same with a section that other strands share.
    pub fn of_section(lengths: Vec<f64>, natural: Vec<[f64; 3]>, section: Arc<Section>) -> Self {
        let equal = lengths.iter().all(|length| (length - lengths[0]).abs() <= 1e-14 * lengths[0]);
        let equal_length = if equal { lengths.first().copied().unwrap_or_default() } else { 0.0 };
        let length = lengths.iter().sum();
        Self { lengths: lengths.into(), natural: natural.into(), section, equal_length, length }
    }

    /// The shared section.
    pub fn section(&self) -> &Arc<Section> {
        &self.section
    }

    /// Number of elements.
    pub fn element_count(&self) -> usize {
        self.lengths.len()
    }

    /// The elements' length if all equal the first, to rounding; otherwise `None`.
    #[inline(always)]
    pub fn equal_length(&self) -> Option<f64> {
        (self.equal_length > 0.0).then_some(self.equal_length)
    }

    /// L, m.
    #[inline(always)]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The element that holds the point at an arclength, and the arclength on it, m; beyond an end, that end.
    pub fn place(&self, arclength: f64) -> (usize, f64) {
        place_on(self.lengths.iter().copied(), arclength)
    }

    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        self.length() * self.linear_density
    }

    /// The force that bends the shortest element by about a radian, N.
    pub fn bending_force(&self) -> f64 {
        let shortest = self.lengths.iter().fold(f64::INFINITY, |a: f64, length| a.min(*length));
        self.stiffness.iter().fold(0.0, |a: f64, k| a.max(*k)) / (shortest * shortest)
    }

    /// The tip stiffness of a cantilever of the strand's length about its softer bending axis, 3 EI/L³, N/m, and its tip damping
    /// by internal friction, 3 γ/L³, N·s/m.
    pub fn cantilever(&self) -> [f64; 2] {
        let axis = if self.stiffness[1] <= self.stiffness[2] { 1 } else { 2 };
        let length = self.length();
        [self.stiffness[axis], self.dissipation[axis]].map(|value| 3.0 * value / (length * length * length))
    }

    /// The largest angle Ωℓ that an element turns by, rad.
    pub fn largest_angle(&self, curvatures: &[[f64; 3]]) -> f64 {
        let mut largest = 0.0_f64;
        for (row, length) in curvatures.iter().zip(&self.lengths) {
            largest = largest.max((row[0] * row[0] + row[1] * row[1] + row[2] * row[2]).sqrt() * length);
        }
        largest
    }

    /// ½ ∫ Σ EIᵢ (κᵢ − κᵢⁿ)² ds, J.
    pub fn elastic_energy(&self, curvatures: &[[f64; 3]]) -> f64 {
        let mut energy = 0.0;
        for (element, length) in self.lengths.iter().enumerate() {
            for axis in 0..3 {
                let strain = curvatures[element][axis] - self.natural[element][axis];
                energy += 0.5 * length * self.stiffness[axis] * strain * strain;
            }
        }
        energy
    }
}
