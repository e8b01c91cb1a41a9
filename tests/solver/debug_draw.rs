//! Debug drawing: how much comes, where it is, in which colours, and that it is the same for any number of workers.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::reading::{DEBUG_BATCH, DebugCanvas, DebugDraw, DebugLayer, DebugVertex};
use superhelix::{
    BodyDef, ConstraintDef, Frame, Hold, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId, Workers,
};

#[derive(Default, PartialEq, Debug)]
struct Drawn {
    lines: Vec<DebugVertex>,
    points: Vec<DebugVertex>,
    batches: usize,
}

impl DebugCanvas for Drawn {
    fn lines(&mut self, vertices: &[DebugVertex]) {
        assert!(!vertices.is_empty() && vertices.len() <= DEBUG_BATCH && vertices.len().is_multiple_of(2));
        self.lines.extend_from_slice(vertices);
        self.batches += 1;
    }

    fn points(&mut self, vertices: &[DebugVertex]) {
        assert!(!vertices.is_empty() && vertices.len() <= DEBUG_BATCH);
        self.points.extend_from_slice(vertices);
        self.batches += 1;
    }
}

fn draw(solver: &Solver, layers: &[DebugLayer]) -> Drawn {
    let layers = layers.iter().map(|layer| *layer as u32).sum();
    let mut drawn = Drawn::default();
    let before = solver.state_hash();
    solver.debug_draw(&DebugDraw { layers, ..DebugDraw::default() }, &mut drawn).unwrap();
    assert_eq!(solver.state_hash(), before);
    drawn
}

/// Strands that fall on a ball, the last two of them tied, and one pinned.
fn scene(workers: Workers) -> (Solver, Vec<StrandId>) {
    let mut solver = Solver::new(SolverOptions { workers, ..SolverOptions::default() }).unwrap();
    let defs: Vec<StrandDef> = (0..100)
        .map(|k| {
            let mut def = StrandDef::straight(0.1, 5);
            def.root.origin.y = 0.01 * k as f64;
            def.material.internal_friction = 1e-10;
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    let pose = Frame { origin: Vector3::new(0.05, 0.1, -0.06), ..Frame::default() };
    solver.add_bodies(vec![BodyDef { pose, ..BodyDef::new(Arc::new(Shape::new_sphere(0.05).unwrap())) }]).unwrap();
    solver.set_contact(&ids, Some(&StrandContact { exempt_length: 0.01, ..StrandContact::default() })).unwrap();
    let target = Frame { origin: Vector3::new(0.07, 0.5, 0.01), ..Frame::default() };
    let constraint = |strand, hold| ConstraintDef { strand, arclength: 0.08, hold, target, compliance: 0.0 };
    let tie = Hold::Tie { other: ids[99], arclength: 0.08 };
    solver.add_constraints(&[constraint(ids[98], tie), constraint(ids[50], Hold::Point)]).unwrap();
    for _ in 0..20 {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
    (solver, ids)
}

#[test]
fn centrelines_and_frames_are_where_samples_are() {
    let (solver, ids) = scene(Workers::Serial);
    let drawn = draw(&solver, &[DebugLayer::Centrelines]);
    assert_eq!((drawn.lines.len(), drawn.points.len()), (100 * 16 * 2, 0));
    assert_eq!(drawn.batches, (100 * 16 * 2_usize).div_ceil(DEBUG_BATCH));
    solver
        .sample_strands(&ids, 17, |strand, point, sample| {
            let index = 2 * (16 * strand + point.max(1) - 1) + usize::from(point > 0);
            assert!((drawn.lines[index].position - sample.position).norm() < 1e-12, "{strand} {point}");
        })
        .unwrap();
    let drawn = draw(&solver, &[DebugLayer::Frames]);
    assert_eq!(drawn.lines.len(), 100 * 6 * 3 * 2);
    solver
        .sample_strands(&ids, 6, |strand, end, sample| {
            let axes = &drawn.lines[6 * (6 * strand + end)..][..6];
            for (axis, line) in axes.chunks(2).enumerate() {
                let expected = sample.position + sample.rotation * Vector3::ith(axis, 5e-3);
                assert!((line[0].position - sample.position).norm() < 1e-12 && (line[1].position - expected).norm() < 1e-9);
            }
        })
        .unwrap();
}

#[test]
fn contacts_and_constraints_come_with_their_forces() {
    let (solver, _) = scene(Workers::Serial);
    let contacts = solver.contacts();
    assert!(contacts.len() > 3);
    let drawn = draw(&solver, &[DebugLayer::Contacts]);
    assert_eq!((drawn.points.len(), drawn.lines.len()), (contacts.len(), 4 * contacts.len()));
    for ((point, lines), contact) in drawn.points.iter().zip(drawn.lines.chunks(4)).zip(contacts) {
        assert_eq!(point.position, contact.position);
        assert!((lines[1].position - contact.position - contact.normal * 5e-3).norm() < 1e-12);
        assert!((lines[3].position - contact.position - contact.force * 100.0).norm() < 1e-12);
        assert_ne!(lines[1].colour, lines[3].colour);
    }
    let drawn = draw(&solver, &[DebugLayer::Constraints]);
    assert_eq!(drawn.points.len(), 2);
    // The pin holds: its point is at its target.
    assert!((drawn.points[1].position - Vector3::new(0.07, 0.5, 0.01)).norm() < 1e-6, "{:?}", drawn.points[1]);
}

#[test]
fn coupled_strands_have_one_colour() {
    let (solver, _) = scene(Workers::Serial);
    let drawn = draw(&solver, &[DebugLayer::Islands, DebugLayer::Centrelines]);
    assert_eq!(drawn.lines.len(), 100 * 16 * 2);
    let colours: Vec<u32> = drawn.lines.chunks(32).map(|strand| strand[0].colour).collect();
    assert_eq!(colours[98], colours[99]);
    assert_ne!(colours[97], colours[98]);
    // A ball couples nobody.
    assert_eq!(colours[..98].iter().collect::<BTreeSet<_>>().len(), 1);
}

#[test]
fn layers_bodies_and_workers() {
    let all = [DebugLayer::Centrelines, DebugLayer::Frames, DebugLayer::Contacts, DebugLayer::Bodies, DebugLayer::Constraints];
    let (solver, _) = scene(Workers::Serial);
    let expected = draw(&solver, &all);
    assert_eq!(draw(&scene(Workers::Pool(3)).0, &all), expected);
    let parts: usize = all.iter().map(|layer| draw(&solver, &[*layer]).lines.len()).sum();
    assert_eq!(parts, expected.lines.len());
    for end in &draw(&solver, &[DebugLayer::Bodies]).lines {
        assert!(((end.position - Vector3::new(0.05, 0.1, -0.06)).norm() - 0.05).abs() < 1e-12);
    }
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let (solver, _) = scene(Workers::Serial);
    let refused = |options: DebugDraw, field: &str| {
        let mut drawn = Drawn::default();
        let error = solver.debug_draw(&options, &mut drawn).unwrap_err().to_string();
        assert!(error.starts_with(&format!("options.{field} is ")) && drawn == Drawn::default(), "{error}");
    };
    let usual = DebugDraw::default();
    refused(DebugDraw { layers: 0, ..usual }, "layers");
    refused(DebugDraw { layers: 64, ..usual }, "layers");
    refused(DebugDraw { points_per_strand: 1, ..usual }, "points_per_strand");
    refused(DebugDraw { points_per_strand: 4097, ..usual }, "points_per_strand");
    refused(DebugDraw { frame_length: 0.0, ..usual }, "frame_length");
    refused(DebugDraw { normal_length: f64::NAN, ..usual }, "normal_length");
    refused(DebugDraw { force_scale: -1.0, ..usual }, "force_scale");
}
