//! One strand of an island cannot be solved: strands that are not its neighbours are unaffected.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{
    BodyDef, ConstraintDef, Frame, Friction, Hold, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId,
};

use super::{GRAVITY, across, at, body, floor, point};

const H: f64 = 1.0 / 60.0;
const LENGTH: f64 = 0.1;
const APART: f64 = 0.02;
const RADIUS: f64 = 5e-4;
const MU: f64 = 0.4;

/// What happens to the first strand.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// Its tip is pinned 5 cm out of reach, along the floor: it stays under the one across it.
    Pinned,
    /// Its tip's pin is led there, and to and fro.
    Led,
    /// Two walls close on it until it is too thick by half.
    Squeezed,
}

/// The result for strands that are neither the first nor across it.
#[derive(Debug, Default)]
struct Came {
    /// The fastest that one's tip went, m/s, on an average of all but the first half second.
    creep: f64,
    /// The least that any contact of these with the floor has of what its weight draws along the floor, by strand: the steps' mean.
    least_share: f64,
    /// Steps in which no contact of these rubbed at all.
    frictionless: u32,
    unconverged: u32,
}

/// `lying` strands, with one across each two that are next to each other.
fn scene(lying: usize) -> (Solver, Vec<StrandId>) {
    // The floor's slope is half of what friction holds, along y: across the lying strands.
    let slope = (0.5 * MU).atan();
    let gravity = Vector3::new(0.0, slope.sin(), -slope.cos()) * GRAVITY;
    let options = SolverOptions { gravity, contact: super::with_hair(), ..SolverOptions::default() };
    let mut solver = Solver::new(options).unwrap();
    let limp = |length: f64, elements: usize| {
        let mut def = StrandDef::straight(length, elements);
        (def.material.youngs_modulus, def.material.viscosity, def.material.air_drag) = (1e8, 0.02, 5e-5);
        def
    };
    let mut defs = Vec::new();
    for k in 0..lying {
        let origin = Vector3::new(0.0, APART * k as f64, RADIUS);
        defs.push(StrandDef { root: at(origin), ..limp(LENGTH, 5) });
    }
    for k in 0..lying - 1 {
        // Its root beside the lower strand, its tip beyond the other.
        let origin = Vector3::new(0.04 + 0.02 * (k % 2) as f64, APART * k as f64 - 4e-3, 3.0 * RADIUS);
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
        defs.push(StrandDef { root: Frame { origin, rotation }, ..limp(0.028, 4) });
    }
    let ids = solver.add_strands(&defs).unwrap();
    let contact = StrandContact {
        radius: RADIUS,
        wisp_radius: RADIUS,
        friction: Friction::uniform(MU),
        hair_friction: Friction::uniform(MU),
        groups: 1,
        ..StrandContact::default()
    };
    solver.set_contact(&ids, Some(&contact)).unwrap();
    solver.set_contact(&ids[..1], Some(&StrandContact { groups: 3, ..contact })).unwrap();
    solver.add_bodies(vec![floor()]).unwrap();
    (solver, ids)
}

fn came(fault: Fault, lying: usize) -> Came {
    let (mut solver, ids) = scene(lying);
    // Walls take longer to close.
    let (settling, steps) = if fault == Fault::Squeezed { (60, 90) } else { (40, 60) };
    for _ in 0..settling {
        solver.step(H, 1).unwrap();
    }
    let tip = point(&solver, ids[0], LENGTH);
    let mut pins = Vec::new();
    let mut walls = Vec::new();
    match fault {
        Fault::None => {}
        Fault::Pinned | Fault::Led => {
            let target = if fault == Fault::Pinned { tip + Vector3::new(0.05, 0.0, 0.0) } else { tip };
            let pin = ConstraintDef { strand: ids[0], arclength: LENGTH, hold: Hold::Point, target: at(target), compliance: 0.0 };
            pins = solver.add_constraints(&[pin]).unwrap();
        }
        Fault::Squeezed => {
            // Boxes on either side of the strand's last quarter, which meet it alone.
            let wall = |side: f64| BodyDef {
                pose: at(Vector3::new(0.09, side * (0.01 + 2.0 * RADIUS), 0.005)),
                mask: 2,
                ..body(Shape::new_box(Vector3::new(0.01, 0.01, 0.01)).unwrap())
            };
            walls = solver.add_bodies(vec![wall(1.0), wall(-1.0)]).unwrap();
        }
    }
    // All but the first one and the one across it.
    let others: Vec<usize> = (1..ids.len()).filter(|k| *k != lying).collect();
    let lengths = |k: usize| if k < lying { LENGTH } else { 0.028 };
    let tips = |solver: &Solver| others.iter().map(|k| point(solver, ids[*k], lengths(*k))).collect::<Vec<_>>();
    let mut start = tips(&solver);
    let mut came = Came { least_share: f64::INFINITY, ..Came::default() };
    for step in 0..steps {
        match fault {
            Fault::None | Fault::Pinned => {}
            Fault::Led => {
                let turn = 0.2 * f64::from(step);
                let off = Vector3::new(0.05, 0.005 * turn.sin(), 0.0);
                solver.set_constraint_targets(&pins, &[at(tip + off * f64::from(step.min(10)) / 10.0)], H).unwrap();
            }
            Fault::Squeezed => {
                // Through it: from half a millimetre to half of its radius.
                let half = RADIUS * (2.0 - 0.05 * f64::from(step)).max(0.5);
                let pose = |side: f64| at(Vector3::new(0.09, tip.y + side * (0.01 + half), 0.005));
                solver.set_body_frames(&walls, &[pose(1.0), pose(-1.0)], H).unwrap();
            }
        }
        let report = solver.step(H, 1).unwrap();
        came.unconverged += report.contact.unconverged;
        // What begins to pull shakes them for a while; not for longer.
        if step == 29 {
            start = tips(&solver);
        }
        if step >= 30 {
            let rubs = |k: usize| {
                let of = solver.contacts().iter().filter(|contact| contact.strand == ids[k]);
                of.map(|contact| across(&contact.force, &contact.normal)).sum::<Vector3<f64>>().norm()
            };
            let least = (1..lying).map(rubs).fold(f64::INFINITY, f64::min);
            came.frictionless += u32::from(least == 0.0);
            came.least_share = came.least_share.min(least);
        }
    }
    let ways = tips(&solver).iter().zip(&start).map(|(now, start)| (now - start).norm()).fold(0.0, f64::max);
    came.creep = ways / (H * f64::from(steps - 30));
    came
}

/// 1e-5 m/s is what they are allowed to creep, also where nothing is wrong with any strand: friction there carries half of what it could. Steps in
/// which it carries nothing are none.
fn others_go_on_rubbing(fault: Fault, lying: usize) {
    let came = came(fault, lying);
    println!("{fault:?}, {} strands: {came:?}", 2 * lying - 1);
    assert!(came.creep < 1e-5 && came.frictionless == 0, "{came:?}");
}

#[test]
fn strands_on_an_incline_rest() {
    others_go_on_rubbing(Fault::None, 6);
}

#[test]
fn neighbours_of_a_strand_pinned_out_of_reach_keep_their_friction() {
    others_go_on_rubbing(Fault::Pinned, 6);
}

#[test]
fn neighbours_of_a_strand_led_out_of_reach_keep_their_friction() {
    others_go_on_rubbing(Fault::Led, 6);
}

#[test]
fn neighbours_of_a_squeezed_strand_keep_their_friction() {
    others_go_on_rubbing(Fault::Squeezed, 6);
}

/// Islands of more than twenty strands are solved differently.
#[test]
fn neighbours_of_a_strand_led_out_of_reach_keep_their_friction_in_a_larger_island() {
    others_go_on_rubbing(Fault::Led, 11);
}
