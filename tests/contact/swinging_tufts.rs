//! An ordinary scene with hair on hair, no option set.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{Frame, Solver, SolverOptions, StrandContact, StrandDef, Workers, usual_work};

const H: f64 = 1.0 / 60.0;

/// Steps of tufts that swing by their roots.
struct Swing {
    left: u32,
    unconverged: u32,
    /// The largest force of a contact, N.
    strongest: f64,
}

/// Eight tufts of sixteen strands that are drawn across each other, rooted this far apart in units of a wisp's radius, swung by their
/// roots, everything by default.
fn swing(spacing: f64, overlaps_are_permitted: bool) -> Swing {
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
    let mut swing = Swing { left: 0, unconverged: 0, strongest: 0.0 };
    let mut dearest = 0;
    for step in 1..=30 {
        let shift = Vector3::x() * (0.02 * (4.0 * PI * f64::from(step) * H).sin());
        let frame = |def: &StrandDef| Frame { origin: def.root.origin + shift, ..def.root };
        let frames: Vec<Frame> = defs.iter().map(frame).collect();
        solver.set_root_frames(&ids, &frames, H).unwrap();
        let report = solver.step(H, 1).unwrap();
        swing.left += report.left;
        swing.unconverged += report.unconverged;
        dearest = dearest.max(report.work);
        let forces = solver.contacts().iter().map(|contact| contact.force.norm());
        swing.strongest = forces.fold(swing.strongest, f64::max);
    }
    let Swing { left, unconverged, strongest } = swing;
    let (steps, usual) = (30 * 128, usual_work(128 * 6));
    println!("{left} left, {unconverged} unconverged of {steps}, dearest {dearest} of {usual} units, at most {strongest:e} N");
    swing
}

/// No step is cut, and few strand steps are unconverged for any other reason. (With 136,800 units for as many elements all were. The
/// dearest step takes half of what it may.)
#[test]
fn the_usual_work_is_enough_for_tufts_that_swing() {
    let Swing { left, unconverged, .. } = swing(2.4, false);
    assert!(left == 0 && unconverged < 40, "{left} left, {unconverged} unconverged");
}

/// Wisps that are rooted in each other, as they are permitted to be: as easy as others, and no contact force grows beyond what hair can exert.
#[test]
fn tufts_of_wisps_that_are_rooted_in_each_other_swing() {
    let Swing { left, unconverged, strongest, .. } = swing(0.6, true);
    assert!(left == 0 && unconverged < 40, "{left} left, {unconverged} unconverged");
    assert!(strongest < 0.1, "{strongest} N");
}
