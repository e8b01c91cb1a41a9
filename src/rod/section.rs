//! What strands of one make share: section, material, freedoms, and the numbers that follow from them.

use super::freedoms::Freedoms;
use super::material::Material;

/// Constants along a strand. Equal strands share one.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Section and material.
    pub material: Material,
    /// Which curvatures may change.
    pub freedoms: Freedoms,
    /// EI0, EI1, EI2, N·m².
    pub stiffness: [f64; 3],
    /// γ + μ EIᵢ, N·m²·s.
    pub dissipation: [f64; 3],
    /// ρS, kg/m.
    pub linear_density: f64,
}

impl Section {
    /// From material and freedoms.
    pub fn new(material: Material, freedoms: Freedoms) -> Self {
        let (stiffness, dissipation, linear_density) = (material.stiffness(), material.dissipation(), material.linear_density());
        Self { material, freedoms, stiffness, dissipation, linear_density }
    }
}
