//! The energies of a strand: kinetic, elastic and gravitational.

/// Energies of a strand or of all strands, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energies {
    /// ½ ∫ ρS |v|² ds, v the velocity of the material points.
    pub kinetic: f64,
    /// ½ ∫ Σ EIᵢ (κᵢ − κᵢⁿ)² ds.
    pub elastic: f64,
    /// −∫ ρS g·r ds, measured from the world's origin.
    pub gravity: f64,
}
