//! The search for equilibria over the whole space of strands: it converges and reports so, and the strand then rests.

use crate::rods::*;
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Freedoms;
use superhelix::editing::EquilibriumOptions;
use superhelix::internals::step::equilibrium::{of_strand, smallest_eigenvalue};

/// A small generator of numbers in 0..1, the same on every machine.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn random_strands_find_a_stable_rest() {
    let mut draw = Draw(7);
    let (mut unconverged, mut worst) = (0, 0);
    for case in 0..200 {
        let gamma = 10_f64.powf(-3.0 + 6.0 * draw.next());
        let aspect = 1.0 + 4.0 * draw.next() * draw.next();
        let root = UnitQuaternion::from_scaled_axis(Vector3::new(draw.next(), draw.next(), draw.next()) * 6.0);
        let curl = [10.0 * (draw.next() - 0.5), 20.0 * (draw.next() - 0.5), 20.0 * (draw.next() - 0.5)];
        let mut def = strand(1 + (24.0 * draw.next()) as usize, material(gamma, aspect, 0.48), root, curl);
        def.freedoms = Freedoms::from_bits("freedoms", 1 + (7.0 * draw.next()) as u32).unwrap();
        let (curvatures, found) = of_strand(&def, GRAVITY, &EquilibriumOptions::default()).unwrap();
        assert!(curvatures.iter().flatten().all(|x| x.is_finite()), "case {case}");
        worst = worst.max(found.iterations);
        if found.converged {
            assert!(found.residual <= 1e-10 && found.smallest_eigenvalue.unwrap() > -1e-9, "case {case}: {found:?}");
            let again = smallest_eigenvalue(&def, &curvatures, GRAVITY).unwrap();
            assert!(
                (again - found.smallest_eigenvalue.unwrap()).abs() < 1e-6 * again.abs().max(1.0),
                "case {case}: {again} {found:?}"
            );
        } else {
            println!("case {case}, Γ = {gamma}: {found:?}");
            unconverged += 1;
        }
    }
    println!("{unconverged} of 200 did not converge; most iterations {worst}");
    assert_eq!(unconverged, 0);
}

#[test]
fn without_gravity_rest_is_the_natural_shape() {
    let mut def = strand(10, material(10.0, 1.3, 0.48), down(), [3.0, 12.0, -4.0]);
    def.initial = Some(vec![[20.0, -80.0, 30.0]; 10]);
    let (curvatures, found) = of_strand(&def, Vector3::zeros(), &EquilibriumOptions::default()).unwrap();
    assert!(found.converged && (found.smallest_eigenvalue.unwrap() - 1.0).abs() < 1e-12, "{found:?}");
    for (a, b) in curvatures.iter().flatten().zip(def.natural.iter().flatten()) {
        assert!((a - b).abs() * LENGTH < 1e-9, "{a} {b}");
    }
    let bad = of_strand(&def, Vector3::new(0.0, f64::NAN, 0.0), &EquilibriumOptions::default()).unwrap_err();
    assert!(bad.to_string().contains("gravity[1]"), "{bad}");
    let short = smallest_eigenvalue(&def, &[[0.0; 3]; 3], GRAVITY).unwrap_err();
    assert!(short.to_string().contains("curvatures (count)"), "{short}");
}
