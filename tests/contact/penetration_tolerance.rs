//! Guarantees of contact despite its savings: no contact is undetected, though strands that have not moved are not searched again; and what
//! is not solved is said not to be, and seen in the contact list.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{
    BodyDef, ContactModel, ContactOptions, ContactPartner, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef,
    StrandId,
};

const RADIUS: f64 = 1e-3;
const BALL: f64 = 0.03;
const LENGTH: f64 = 0.1;
/// The natural curvature of a strand that presses on another, 1/m.
const DOWN: f64 = 30.0;
/// Places at which a strand is sampled: with curvatures up to 100/m the line through them is within a micrometre of it.
const PLACES: usize = 301;

fn lines(solver: &Solver, ids: &[StrandId]) -> Vec<Vec<Vector3<f64>>> {
    let mut lines = vec![Vec::new(); ids.len()];
    solver.sample_strands(ids, PLACES, |strand, _, sample| lines[strand].push(sample.position)).unwrap();
    lines
}

/// Least distance of two lines.
fn apart(one: &[Vector3<f64>], other: &[Vector3<f64>]) -> f64 {
    let of_edges = |p: &Vector3<f64>, line: &[Vector3<f64>]| {
        let to_edge = |edge: &[Vector3<f64>]| {
            let way = edge[1] - edge[0];
            (p - edge[0] - way * ((p - edge[0]).dot(&way) / way.norm_squared()).clamp(0.0, 1.0)).norm()
        };
        // A centimetre away counts as far.
        line.windows(2).filter(|edge| (p - edge[0]).norm_squared() < 1e-4).map(to_edge).fold(f64::INFINITY, f64::min)
    };
    let one_way = one.iter().map(|p| of_edges(p, other)).fold(f64::INFINITY, f64::min);
    other.iter().map(|p| of_edges(p, one)).fold(one_way, f64::min)
}

/// The deepest that any strand is in the ball, and in any other strand: by sampling, not by what the engine found.
fn deepest(lines: &[Vec<Vector3<f64>>], ball: Vector3<f64>, radius: f64) -> (f64, f64) {
    let in_ball = lines.iter().flatten().map(|p| BALL + radius - (p - ball).norm()).fold(f64::NEG_INFINITY, f64::max);
    let mut in_hair = f64::NEG_INFINITY;
    for (k, one) in lines.iter().enumerate() {
        for other in &lines[..k] {
            in_hair = in_hair.max(2.0 * RADIUS - apart(one, other));
        }
    }
    (in_ball, in_hair)
}

/// Strands in two layers across each other fall onto a ball, which also goes through them: `count` of them 6 mm from each other.
fn falling(
    model: ContactModel,
    count: usize,
    options: ContactOptions,
    max_subdivisions: u32,
) -> (Solver, Vec<StrandId>, Vec<StrandDef>) {
    let contact = ContactOptions { model, hair: true, ..options };
    // A root that is turned over must be followed, without a jump.
    let mut options = SolverOptions { contact, jump_acceleration: f64::INFINITY, ..SolverOptions::default() };
    options.step.max_subdivisions = max_subdivisions;
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..count)
        .map(|k| {
            let (layer, place) = ((k % 2) as f64, (k / 2) as f64 - 0.25 * (count - 2) as f64);
            let mut def = StrandDef::straight(LENGTH, 5);
            def.material.youngs_modulus = 1e9;
            def.material.viscosity = 0.02;
            def.material.air_drag = 5e-5;
            let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * PI * layer);
            def.natural = vec![[0.0, 3.0 * (1.7 * k as f64).sin(), 3.0 * (2.3 * k as f64).cos()]; 5];
            let origin = turn * Vector3::new(-0.05, 6e-3 * place, 0.0) + Vector3::z() * (BALL + 4e-3 + 6e-3 * layer);
            def.root = Frame { origin, rotation: turn };
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    let strand = StrandContact { radius: 1e-4, wisp_radius: RADIUS, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&strand)).unwrap();
    solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(BALL).unwrap()))]).unwrap();
    (solver, ids, defs)
}

fn swung(solver: &mut Solver, ids: &[StrandId], defs: &[StrandDef], step: u32) -> Vector3<f64> {
    let way = 0.012 * Vector3::new((0.21 * f64::from(step)).sin(), (0.13 * f64::from(step)).sin(), 0.0);
    let roots: Vec<Frame> = defs.iter().map(|def| Frame { origin: def.root.origin - 0.5 * way, ..def.root }).collect();
    solver.set_root_frames(ids, &roots, 1.0 / 60.0).unwrap();
    let ball = solver.body_ids()[0];
    solver.set_body_frames(&[ball], &[Frame { origin: way, ..Frame::default() }], 1.0 / 60.0).unwrap();
    way
}

/// Wherever a step has converged, no place of any strand is deeper in anything than the tolerance: also where the search at the step's end, which
/// leaves out strands at rest, ran several times.
#[test]
fn contacts_are_found_though_resting_strands_are_not_searched_again() {
    {
        let model = ContactModel::Coulomb;
        let (mut solver, ids, defs) = falling(model, 8, ContactOptions::default(), 3);
        let tolerance = ContactOptions::default().tolerance;
        let (mut worst, mut searches, mut solved, mut contacts) = ((0.0_f64, 0.0_f64), 0, 0, 0);
        for step in 0..90 {
            let ball = swung(&mut solver, &ids, &defs, step);
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            // Initial overlaps have separated after two steps.
            if report.contact.unconverged > 0 || step < 2 {
                continue;
            }
            let (in_ball, in_hair) = deepest(&lines(&solver, &ids), ball, 1e-4);
            worst = (worst.0.max(in_ball), worst.1.max(in_hair));
            (searches, solved, contacts) = (searches + report.contact.searches, solved + 1, contacts + report.contact.contacts);
        }
        println!("{model:?}: {solved} of 90 solved, {searches} more searches, {contacts} contacts, deepest {worst:?}");
        assert!(searches > 10 && solved > 60 && contacts > 300, "{searches} {solved} {contacts}");
        // A micrometre for the lines.
        assert!(worst.0 < tolerance + 1e-6 && worst.1 < tolerance + 1e-6, "{worst:?}");
    }
}

/// An island that may not be solved fully is reported as unconverged, with its strands, and the report gives its remaining depth; the contact list
/// what pressed.
#[test]
fn islands_that_end_early_are_reported_with_their_depth() {
    for (model, halvings) in [ContactModel::Coulomb].into_iter().flat_map(|model| [(model, 0), (model, 3)]) {
        let few = ContactOptions { max_iterations: 2, ..ContactOptions::default() };
        let (mut solver, ids, defs) = falling(model, 8, few, halvings);
        let (mut told, mut deep, mut strands) = (0, 0.0_f64, 0);
        for step in 0..60 {
            let ball = swung(&mut solver, &ids, &defs, step);
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            let lines = lines(&solver, &ids);
            let sampled = deepest(&lines, ball, 1e-4);
            let of_list = |hair: bool| {
                let those =
                    solver.contacts().iter().filter(|contact| matches!(contact.partner, ContactPartner::Strand { .. }) == hair);
                those.map(|contact| -contact.gap).fold(0.0, f64::max)
            };
            // The report has the depths of the list, and more where no force acts.
            assert!(of_list(true).max(of_list(false)) <= report.contact.penetration, "{report:?}");
            // Islands are counted in each part.
            assert!(report.unconverged <= 8, "{report:?}");
            if report.contact.unconverged == 0 {
                assert_eq!(report.unconverged, 0, "{report:?}");
                continue;
            }
            // An island has a strand at least.
            assert!(report.unconverged > 0 && (halvings > 0 || report.unconverged >= report.contact.unconverged), "{report:?}");
            told += report.contact.unconverged;
            strands += report.unconverged;
            // The true depth, also where the contact was detected too late (and is not in the list, since no force acts there).
            let most = sampled.0.max(sampled.1);
            if most > 1e-4 {
                assert!(report.contact.penetration > 0.9 * most, "step {step}: {most:e} {report:?}");
                deep = deep.max(most);
            }
        }
        println!("{model:?}, {halvings} halvings: {told} islands of {strands} strands reported, {deep:e} m deep");
        // With substeps most converge.
        assert!(halvings > 0 || told > 5 && deep > 1e-4, "{told} {deep:e}");
    }
}

/// A strand between two walls that close on it cannot be outside both. It yields, and is reported; the other strands of its island hold as before,
/// and keep their friction: if the whole island yielded, they would sink into each other.
#[test]
fn an_impossible_constraint_affects_no_other_strand() {
    {
        let model = ContactModel::Coulomb;
        let (mut solver, ids, defs) = falling(model, 8, ContactOptions::default(), 3);
        // The walls meet the first strand alone.
        let contact = StrandContact { radius: 1e-4, wisp_radius: RADIUS, groups: 3, exempt_length: 0.01, ..Default::default() };
        solver.set_contact(&ids[..1], Some(&contact)).unwrap();
        let wall = |side: f64| {
            let shape = Arc::new(Shape::new_half_space(Vector3::y() * side).unwrap());
            BodyDef { mask: 2, ..BodyDef::new(shape) }
        };
        let walls = solver.add_bodies(vec![wall(1.0), wall(-1.0)]).unwrap();
        let (mut told, mut worst, mut sunk) = (0, (0.0_f64, 0.0_f64), 0.0_f64);
        for step in 0..60 {
            // From a millimetre on either side until the strand, of 0.2 mm, is 0.1 mm too thick; then they stay.
            let open = (1e-3 - 5e-5 * f64::from(step)).max(5e-5);
            let pose = |side: f64| Frame { origin: defs[0].root.origin - Vector3::y() * side * open, ..Frame::default() };
            solver.set_body_frames(&walls, &[pose(1.0), pose(-1.0)], 1.0 / 60.0).unwrap();
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!(report.quarantined, 0, "{model:?} step {step}: {report:?}");
            let all = lines(&solver, &ids);
            let others = deepest(&all[1..], Vector3::zeros(), 1e-4);
            if step < 2 {
                continue;
            }
            told += u32::from(report.contact.unconverged > 0);
            worst = (worst.0.max(others.0), worst.1.max(others.1));
            let strand = solver.contacts().iter().filter(|contact| contact.strand == ids[0]).map(|contact| -contact.gap);
            sunk = strand.fold(sunk, f64::max);
        }
        println!("{model:?}: {told} steps reported, the pinched strand {sunk:e} m deep, the others {worst:?}");
        // Where nothing else pulls at it, it is half of what is too much in either wall.
        assert!(told > 20 && sunk > 4e-5 && sunk < 1e-4, "{told} {sunk:e}");
        let tolerance = ContactOptions::default().tolerance;
        assert!(worst.0 < tolerance + 1e-6 && worst.1 < tolerance + 1e-6, "{worst:?}");
    }
}

/// Where no attempt brings a strand near convergence it keeps its initial state, and is reported; the others of its island
/// continue and do not stay in place with it.
#[test]
fn a_diverged_strand_affects_no_other() {
    // Too few iterations for a strand whose root is turned over.
    let few = ContactOptions { max_iterations: 12, ..ContactOptions::default() };
    let (mut solver, ids, defs) = falling(ContactModel::Penalty, 8, few, 0);
    for _ in 0..21 {
        assert_eq!(solver.step(1.0 / 60.0, 1).unwrap().quarantined, 0);
    }
    let before = lines(&solver, &ids);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 3.0);
    solver.set_root_frames(&ids[1..2], &[Frame { rotation: defs[1].root.rotation * turn, ..defs[1].root }], 1.0 / 60.0).unwrap();
    let report = solver.step(1.0 / 60.0, 1).unwrap();
    // All hang together.
    assert_eq!((report.contact.unconverged, report.unconverged + report.quarantined), (1, 8), "{report:?}");
    let moved = lines(&solver, &ids).iter().zip(&before).filter(|(now, before)| now != before).count() as u32;
    println!("{} of 8 rolled back, {moved} moved", report.quarantined);
    assert!(report.quarantined > 0 && report.quarantined < 8, "{report:?}");
    // (One that is rolled back has its root where the host put it.)
    assert!(moved >= report.unconverged, "{moved} {report:?}");
}

/// Hair that is drawn into hair, and pressed into it by its own shape, comes out: its contacts' springs are pushed on. (By the springs
/// alone it went right through.)
#[test]
fn strands_drawn_into_each_other_and_pressed_together_separate() {
    {
        let model = ContactModel::Coulomb;
        let contact = ContactOptions { model, hair: true, ..ContactOptions::default() };
        let options = SolverOptions { contact, gravity: Vector3::zeros(), ..SolverOptions::default() };
        let mut solver = Solver::new(options).unwrap();
        let strand = |origin: Vector3<f64>, turn: f64, natural: [f64; 3]| {
            let mut def = StrandDef::straight(LENGTH, 5);
            (def.material.youngs_modulus, def.material.viscosity, def.material.air_drag) = (4e9, 0.05, 1e-4);
            // Thick hair is stiff for its weight.
            def.material.radius = [3e-4; 2];
            def.root = Frame { origin, rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn) };
            def.natural = vec![natural; 5];
            def.initial = Some(vec![[0.0; 3]; 5]);
            def
        };
        // The upper one, three fifths of what both are thick above the lower one, would bend down through it.
        let lower = strand(Vector3::new(-0.05, 0.0, 0.0), 0.0, [0.0; 3]);
        let upper = strand(Vector3::new(0.0, -0.05, 1.2 * RADIUS), 0.5 * PI, [0.0, DOWN, 0.0]);
        let ids = solver.add_strands(&[lower, upper]).unwrap();
        let touching = StrandContact { wisp_radius: RADIUS, ..StrandContact::default() };
        solver.set_contact(&ids, Some(&touching)).unwrap();
        let (mut deep, mut force) = (Vec::new(), 0.0);
        for _ in 0..40 {
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            let lines = lines(&solver, &ids);
            force = solver.contacts().iter().map(|contact| contact.force.norm()).fold(force, f64::max);
            deep.push((2.0 * RADIUS - apart(&lines[0], &lines[1]), report.contact.unconverged));
        }
        println!("{model:?}: {deep:?} {force:e}");
        // It goes on pressing, on the side that it was drawn on.
        assert!(force > 1e-3 && !solver.contacts().is_empty(), "{force:e}");
        // Parted at 0.1 m/s it is out in a step; another to see that it is.
        let tolerance = solver.options().contact.tolerance + 1e-6;
        assert!(deep[2..].iter().all(|(deep, unconverged)| *deep < tolerance && *unconverged == 0), "{deep:?}");
    }
}

/// The reported depth is that of the current strands: contacts keep the points at which they were detected, and where strands
/// move several times their radius in a step these have slid apart and say nothing about positions. Nor does the list say more.
#[test]
fn the_reported_depth_of_hair_in_hair_is_that_of_the_strands_not_of_their_contacts() {
    const STRANDS: usize = 25;
    {
        let model = ContactModel::Coulomb;
        // So few iterations leave contacts that do not hold.
        let contact = ContactOptions { model, hair: true, max_iterations: 3, ..ContactOptions::default() };
        let mut options = SolverOptions { contact, ..SolverOptions::default() };
        options.step.max_subdivisions = 0;
        let mut solver = Solver::new(options).unwrap();
        let defs: Vec<StrandDef> = (0..STRANDS)
            .map(|k| {
                let mut def = StrandDef::straight(LENGTH * (1.0 + 0.3 * (1.3 * k as f64).sin()), 6);
                (def.material.youngs_modulus, def.material.viscosity, def.material.air_drag) = (3e9, 0.02, 2e-5);
                def.natural = vec![[0.0, 10.0 * (1.7 * k as f64).sin(), 10.0 * (2.3 * k as f64).cos()]; 6];
                let origin = 4.0 * RADIUS * Vector3::new((k % 5) as f64, (k / 5) as f64, 0.0);
                def.root = Frame { origin, rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI) };
                def
            })
            .collect();
        let ids = solver.add_strands(&defs).unwrap();
        let touching = StrandContact { wisp_radius: RADIUS, ..StrandContact::default() };
        solver.set_contact(&ids, Some(&touching)).unwrap();
        let (mut off, mut listed, mut failed) = (0.0_f64, 0.0_f64, 0);
        for step in 0..90 {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.6 * (0.25 * f64::from(step)).sin())
                * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.4 * (0.19 * f64::from(step)).sin());
            let centre = Vector3::new(0.0, 0.0, 0.05);
            let roots: Vec<Frame> = defs
                .iter()
                .map(|def| Frame { origin: centre + turn * (def.root.origin - centre), rotation: turn * def.root.rotation })
                .collect();
            solver.set_root_frames(&ids, &roots, 1.0 / 60.0).unwrap();
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            if step < 60 {
                continue;
            }
            let lines = lines(&solver, &ids);
            let depth = deepest(&lines, Vector3::repeat(1.0), 0.0).1.max(0.0);
            off = off.max((report.contact.penetration - depth).abs());
            listed = listed.max(solver.contacts().iter().fold(0.0, |a: f64, contact| a.max(-contact.gap)) - depth);
            failed += report.contact.unconverged;
        }
        println!("{model:?}, {failed} islands unconverged: reported within {off:e} m, listed {listed:e} m too deep at most");
        // Overlaps within the tolerance may be reported as none.
        let tolerance = solver.options().contact.tolerance;
        assert!(off < 1.1 * tolerance && listed < 1.1 * tolerance, "{off:e} {listed:e}");
        assert!(failed > 5, "{failed}");
    }
}

/// Strands that cross near their roots press each other with forty times their weight at once, or twenty times little by little, and overlap by no more than a
/// fifth of the tolerance; those at rest by nothing.
#[test]
fn strands_that_press_each_other_hard_do_not_sink_in() {
    for (steps, weights) in [(1, 35.0), (30, 20.0)] {
        let mut options = SolverOptions::default();
        options.contact.hair = true;
        let mut solver = Solver::new(options).unwrap();
        let (radius, side) = (2e-4, 0.008);
        let def = |origin: Vector3<f64>, turn: f64| {
            let mut def = StrandDef::straight(0.05, 8);
            def.root = Frame { origin, rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn) };
            def
        };
        // One along x, and one along y over it.
        let begins = Vector3::new(side, -side, 2.05 * radius);
        let defs = [def(Vector3::zeros(), 0.0), def(begins, 0.5 * PI)];
        let weight = 9.81 * defs[0].material.linear_density() * defs[0].length();
        let ids = solver.add_strands(&defs).unwrap();
        let contact = StrandContact { wisp_radius: radius, ..StrandContact::default() };
        solver.set_contact(&ids, Some(&contact)).unwrap();
        let mut largest = 0.0_f64;
        for step in 1..=90 {
            let down = 0.004 * (f64::from(step) / f64::from(steps)).min(1.0);
            let frame = Frame { origin: begins - Vector3::z() * down, ..defs[1].root };
            solver.set_root_frames(&ids[1..], &[frame], 1.0 / 60.0).unwrap();
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!(report.contact.unconverged + report.subdivided, 0, "{steps} steps, in {step}: {report:?}");
            assert!(
                report.contact.penetration <= 0.2 * ContactOptions::default().tolerance,
                "{steps} steps, in {step}: {report:?}"
            );
            let forces = solver.contacts().iter().map(|contact| contact.force.norm());
            largest = largest.max(forces.fold(0.0, f64::max) / weight);
            if step == 90 {
                assert!(report.contact.penetration < 1e-8 && !solver.contacts().is_empty(), "{report:?}");
            }
        }
        println!("in {steps} steps: up to {largest:.0} weights");
        assert!(largest > weights, "{largest}");
    }
}
