//! A comb through the four hairs of Bonanni and Kmoch's table 1: the resistance ranks like their stiffness and friction.

use superhelix::hair::HairType;
use superhelix::haptic::HapticOptions;

use super::scene::{Rate, handed_over};
use super::typed_hair::{SLOWER, hair, stroke_of};

/// The mean drag during the downward stroke, N.
fn drag(hair_type: HairType) -> f64 {
    let way = |t: f64| stroke_of(t / SLOWER);
    let felt = handed_over(hair(hair_type), way, 1.4 * SLOWER, Rate::new(120.0, 4e-3), &HapticOptions::default());
    let down = &felt[(400.0 * SLOWER) as usize..];
    down.iter().map(|(wrench, _)| wrench.force.z).sum::<f64>() / down.len() as f64
}

#[test]
fn drag_ranks_as_stiffness_and_friction_do() {
    // Bending stiffness 9.25, 7.59, 5.66 and 5.23 nN m², friction 1 (not measured), 0.92, 1.14 and 0.94.
    let [h2, h1, gc3, ga1] = [HairType::H2, HairType::H1, HairType::Gc3, HairType::Ga1].map(drag);
    println!("H2 {h2:.3e}, H1 {h1:.3e}, GC3 {gc3:.3e}, GA1 {ga1:.3e} N");
    // The stiffest is the hardest to comb, the limpest the easiest. GC3 is limper than H1 and rougher: of two products of stiffness and friction that
    // differ by 8 % either may come out ahead.
    assert!(h2 > 1.1 * h1 && h2 > 1.1 * gc3, "{h2:e} {h1:e} {gc3:e}");
    assert!(h1 > 1.1 * ga1 && gc3 > 1.1 * ga1, "{h1:e} {gc3:e} {ga1:e}");
    assert!((h1 - gc3).abs() < 0.2 * h1, "{h1:e} {gc3:e}");
}
