//! An ordinary scene with hair on hair, no option set.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{Frame, Solver, SolverOptions, StrandContact, StrandDef, Workers, usual_work};

const H: f64 = 1.0 / 60.0;

/// Steps of tufts that swing by their roots.
struct Swing {
    left: usize,
    unconverged: usize,
    dearest: u64,
    /// The largest depth of a step, m, and the largest force of a contact, N.
    deepest: f64,
    strongest: f64,
}

/// Eight tufts of sixteen strands that are drawn across each other, rooted this far apart in units of a wisp's radius, swung by their
/// roots and turned by up to `turn` rad, everything by default.
fn swing(spacing: f64, overlaps_are_permitted: bool, turn: f64) -> Swing {
    let radius = 5e-4;
    let down = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5 * PI)
        * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * PI);
    let def = |k: usize| {
        let part = |by: f64| 2.0 * (k as f64 * by).fract() - 1.0;
        let mut def = StrandDef::straight(0.15, 6);
        def.material.internal_friction = 1e-10;
        def.material.air_drag = 5e-6;
        def.natural = vec![[0.0, 6.0 * part(0.618_034), 6.0 * part(0.754_878)]; 6];
        let place = Vector3::new((k % 4) as f64, 0.0, (k % 16 / 4) as f64) * (spacing * radius);
        def.root = Frame { origin: Vector3::x() * (0.4 * (k / 16) as f64) + place, rotation: down };
        def
    };
    let defs: Vec<StrandDef> = (0..128).map(def).collect();
    let mut options = SolverOptions { gravity: Vector3::y() * -9.81, workers: Workers::Pool(2), ..SolverOptions::default() };
    options.contact.hair = true;
    let mut solver = Solver::new(options).unwrap();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact { wisp_radius: radius, ..StrandContact::default() })).unwrap();
    if overlaps_are_permitted {
        solver.allow_overlaps(&ids).unwrap();
    }
    let mut swing = Swing { left: 0, unconverged: 0, dearest: 0, deepest: 0.0, strongest: 0.0 };
    for step in 1..=30 {
        let phase = (4.0 * PI * f64::from(step) * H).sin();
        let shift = Vector3::x() * (0.02 * phase);
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), turn * phase);
        let frame =
            |def: &StrandDef| Frame { origin: rotation * def.root.origin + shift, rotation: rotation * def.root.rotation };
        let frames: Vec<Frame> = defs.iter().map(frame).collect();
        solver.set_root_frames(&ids, &frames, H).unwrap();
        let report = solver.step(H, 1).unwrap();
        swing.left += report.left as usize;
        swing.unconverged += report.unconverged as usize;
        swing.dearest = swing.dearest.max(report.work);
        swing.deepest = swing.deepest.max(report.contact.penetration);
        let forces = solver.contacts().iter().map(|contact| contact.force.norm());
        swing.strongest = forces.fold(swing.strongest, f64::max);
    }
    println!(
        "{} left, {} unconverged of {}, dearest {} of {} units, {:e} m deep, {:e} N",
        swing.left,
        swing.unconverged,
        30 * 128,
        swing.dearest,
        usual_work(128 * 6),
        swing.deepest,
        swing.strongest
    );
    swing
}

/// Hardly a step is cut. (With 136,800 units for as many elements all of them were, and all strands unconverged.)
#[test]
fn the_usual_work_is_enough_for_tufts_that_swing() {
    let Swing { left, unconverged, .. } = swing(2.4, false, 0.0);
    assert!(left < 384 && unconverged < 400, "{left} left, {unconverged} unconverged");
}

/// Wisps that are rooted in each other: where they are drawn so and permitted to be, that is nearly as easy. No contact force grows beyond
/// what hair can exert: next to roots it would take thousands of newtons.
#[test]
fn tufts_of_wisps_that_are_rooted_in_each_other_swing() {
    let Swing { left, unconverged, strongest, .. } = swing(0.6, true, 0.0);
    assert!(left < 384 && unconverged < 400, "{left} left, {unconverged} unconverged");
    assert!(strongest < 0.1, "{strongest} N");
}
