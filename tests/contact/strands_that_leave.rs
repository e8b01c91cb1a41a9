//! Strands that leave each other while a step is solved: what pressed them at an early iterate holds them no longer.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{ContactOptions, Frame, Solver, SolverOptions, StrandContact, StrandDef};

const H: f64 = 1.0 / 60.0;

/// The root of a limp strand jumps sideways by 5 cm. Carried along with it, where the iteration begins, the strand lies on a stiff one close
/// to its tip; but its tip stays behind, and falls. The other is not there.
#[test]
fn a_strand_falls_beside_what_it_lay_on_at_the_first_iterate() {
    let step = |with: bool| {
        let contact = ContactOptions { hair: true, ..ContactOptions::default() };
        let mut solver = Solver::new(SolverOptions { contact, ..SolverOptions::default() }).unwrap();
        let limp = StrandDef::straight(0.1, 10);
        let mut stiff = StrandDef::straight(0.03, 3);
        stiff.material.youngs_modulus = 1e12;
        let across = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
        stiff.root = Frame { origin: Vector3::new(0.09, 0.04, -1.999e-3), rotation: across };
        let ids = solver.add_strands(&[limp.clone(), stiff]).unwrap();
        let strand = StrandContact { radius: 1e-4, wisp_radius: 1e-3, ..StrandContact::default() };
        solver.set_contact(&ids, Some(&strand)).unwrap();
        if !with {
            solver.remove_strands(&ids[1..]).unwrap();
        }
        solver.set_root_frames(&ids[..1], &[Frame { origin: 0.05 * Vector3::y(), ..limp.root }], H).unwrap();
        let report = solver.step(H, 1).unwrap();
        assert_eq!(report.unconverged, 0, "{report:?}");
        let mut tip = Vector3::zeros();
        solver.sample_at(ids[0], &[0.1], |_, sample| tip = sample.position).unwrap();
        tip
    };
    let [beside, alone] = [true, false].map(step);
    println!("{beside} beside it, {alone} without it");
    assert!(alone.z < -1e-3 && alone.y < 0.03, "{alone}");
    assert!((beside - alone).norm() < 1e-6, "{beside} beside it, {alone} without it");
}
