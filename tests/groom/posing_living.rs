//! Simulated strands posed, cut, grown, mirrored, and given other materials: against strands created that way.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::{Brush, DragTarget, ElementChange, Growth, Plane, PoseOptions, Stiffening};
use superhelix::{
    BodyDef, ConstraintDef, Error, Frame, Freedoms, Hold, Material, Shape, Solver, SolverOptions, StrandDef, StrandId, Workers,
};

fn curl(elements: usize, seed: u32) -> StrandDef {
    let turn = f64::from(seed);
    StrandDef {
        natural: (0..elements).map(|k| [3.0 + k as f64, 20.0 + 2.0 * turn, -5.0 * (turn * 0.7).sin()]).collect(),
        root: Frame {
            origin: Vector3::new(0.01 * turn, 0.0, 0.2),
            rotation: UnitQuaternion::from_euler_angles(0.1 * turn, 0.4, 0.05 * turn * turn),
        },
        material: Material { radius: [50e-6, 40e-6], viscosity: 1e-3, air_drag: 1e-6, ..Material::default() },
        ..StrandDef::straight(0.2, elements)
    }
}

fn solver_of(definitions: &[StrandDef], workers: Workers) -> (Solver, Vec<StrandId>) {
    let mut solver = Solver::new(SolverOptions { workers, ..SolverOptions::default() }).unwrap();
    let ids = solver.add_strands(definitions).unwrap();
    (solver, ids)
}

fn points(solver: &Solver, id: StrandId, arclengths: &[f64]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let mut out = Vec::new();
    solver.sample_at(id, arclengths, |_, sample| out.push((sample.position, sample.velocity))).unwrap();
    out
}

fn step(solver: &mut Solver, steps: usize) {
    for _ in 0..steps {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
}

/// A strand at rest that is cut is, to the bit, one that was made shorter: at once, and after 20 steps.
#[test]
fn a_strand_that_is_cut_goes_on_as_one_that_was_made_so() {
    let definition = curl(5, 3);
    for arclength in [0.2, 0.13, 0.12, 0.01] {
        let (mut solver, ids) = solver_of(std::slice::from_ref(&definition), Workers::Serial);
        solver.cut(&ids, &[arclength]).unwrap();
        let lengths = solver.element_lengths(ids[0]).unwrap().to_vec();
        assert!((lengths.iter().sum::<f64>() - arclength).abs() < 1e-15);
        let natural = definition.natural[..lengths.len()].to_vec();
        let short = StrandDef { element_lengths: lengths, natural, ..definition.clone() };
        let (mut fresh, _) = solver_of(&[short], Workers::Serial);
        assert_eq!(solver.state_hash(), fresh.state_hash(), "{arclength}");
        step(&mut solver, 20);
        step(&mut fresh, 20);
        assert_eq!(solver.state_hash(), fresh.state_hash(), "{arclength}, after 20 steps");
    }
}

/// In the middle of a motion: curve and velocities of the rest stay the same to rounding, and its mass is its own.
#[test]
fn a_moving_strand_is_cut_and_grows_without_a_kick() {
    let (mut solver, ids) = solver_of(&[curl(6, 2)], Workers::Serial);
    solver.set_root_frames(&ids, &[Frame { origin: Vector3::new(0.1, 0.05, 0.2), ..curl(6, 2).root }], 1.0).unwrap();
    step(&mut solver, 15);
    let id = ids[0];
    let places: Vec<f64> = (0..=30).map(|k| 0.11 * f64::from(k) / 30.0).collect();
    let before = points(&solver, id, &places);
    let speed = before.iter().map(|(_, v)| v.norm()).fold(0.0, f64::max);
    assert!(speed > 0.1, "it moves: {speed}");
    solver.cut(&ids, &[0.11]).unwrap();
    for ((p, v), (q, w)) in points(&solver, id, &places).iter().zip(&before) {
        assert!((p - q).norm() < 1e-12 && (v - w).norm() < 1e-12 * speed.max(1.0), "{:e} {:e}", (p - q).norm(), (v - w).norm());
    }
    assert!(solver.has_strand(id) && (solver.element_lengths(id).unwrap().iter().sum::<f64>() - 0.11).abs() < 1e-15);
    // At rest a strand pulls at its root with its weight.
    let mut still = solver_of(&[curl(6, 2)], Workers::Serial);
    still.0.cut(&still.1, &[0.11]).unwrap();
    still.0.settle(&still.1, &Default::default()).unwrap();
    step(&mut still.0, 1);
    let weight = curl(6, 2).material.linear_density() * 0.11 * 9.81;
    let pull = still.0.root_wrench(still.1[0]).unwrap().force.z;
    assert!((pull + weight).abs() < 1e-6 * weight, "{pull} {weight}");

    for elements in [0, 2] {
        let mut grown = Solver::new(SolverOptions::default()).unwrap();
        grown.restore(&solver.snapshot()).unwrap();
        let id = grown.strand_ids()[0];
        let before = points(&grown, id, &places);
        let momentum = |solver: &Solver| solver.energies(id).unwrap().kinetic;
        let kinetic = momentum(&grown);
        grown.grow(&[id], &Growth { length: 0.02, elements, curvatures: None }).unwrap();
        let after = points(&grown, id, &places);
        // Of a longer last element the velocities are a polynomial's: near, not equal.
        let slack = if elements == 0 { 0.02 * speed } else { 1e-12 };
        for ((p, v), (q, w)) in after.iter().zip(&before) {
            assert!((p - q).norm() < 1e-12 && (v - w).norm() < slack, "{elements}: {:e} {:e}", (p - q).norm(), (v - w).norm());
        }
        let tip = points(&grown, id, &[0.11, 0.13]);
        assert!((tip[1].1 - tip[0].1).norm() < 0.6 * speed, "no kick: {:?} {:?}", tip[0].1, tip[1].1);
        assert!(momentum(&grown) > kinetic);
        step(&mut grown, 30);
        let fastest = points(&grown, id, &[0.13])[0].1.norm();
        assert!(fastest < 3.0 * speed, "{fastest} {speed}");
    }
}

#[test]
fn a_strand_at_rest_that_grows_is_one_that_was_made_so() {
    for (elements, curvatures) in [(0, None), (2, None), (3, Some([0.0, 7.0, 1.0]))] {
        let definition = curl(4, 1);
        let (mut solver, ids) = solver_of(std::slice::from_ref(&definition), Workers::Serial);
        solver.grow(&ids, &Growth { length: 0.06, elements, curvatures }).unwrap();
        let mut longer = definition.clone();
        match elements {
            0 => longer.element_lengths[3] += 0.06,
            count => {
                longer.element_lengths.extend(vec![0.06 / count as f64; count]);
                longer.natural.extend(vec![curvatures.unwrap_or(definition.natural[3]); count]);
            }
        }
        let (mut fresh, _) = solver_of(&[longer], Workers::Serial);
        assert_eq!(solver.state_hash(), fresh.state_hash(), "{elements}");
        step(&mut solver, 5);
        step(&mut fresh, 5);
        assert_eq!(solver.state_hash(), fresh.state_hash(), "{elements}");
    }
}

#[test]
fn a_material_that_is_changed_is_that_of_a_strand_made_so() {
    let definitions: Vec<StrandDef> = (0..4).map(|k| curl(5, k)).collect();
    let (mut solver, ids) = solver_of(&definitions, Workers::Serial);
    let materials: Vec<Material> = (0..4)
        .map(|k| Material {
            radius: [60e-6, 30e-6 + 1e-6 * f64::from(k)],
            youngs_modulus: 5e9,
            density: 1200.0,
            air_drag: 3e-6,
            ..Material::default()
        })
        .collect();
    solver.set_materials(&ids, &materials).unwrap();
    assert_eq!(solver.material(ids[2]).unwrap(), &materials[2]);
    let made: Vec<StrandDef> =
        definitions.iter().zip(&materials).map(|(def, material)| StrandDef { material: *material, ..def.clone() }).collect();
    let (mut fresh, _) = solver_of(&made, Workers::Serial);
    assert_eq!(solver.state_hash(), fresh.state_hash());
    step(&mut solver, 10);
    step(&mut fresh, 10);
    assert_eq!(solver.state_hash(), fresh.state_hash());

    // In motion: the same state, forces of the new material; and a snapshot preserves it.
    let before = solver.shapes(&ids).unwrap();
    solver.set_materials(&ids, &[Material::default()]).unwrap();
    assert_eq!((solver.shapes(&ids).unwrap(), solver.radius(ids[3]).unwrap()), (before, 50e-6));
    let mut other = Solver::new(SolverOptions::default()).unwrap();
    other.restore(&solver.snapshot()).unwrap();
    assert_eq!(other.state_hash(), solver.state_hash());

    let hash = solver.state_hash();
    let bad = Material { density: -1.0, ..Material::default() };
    let refused = solver.set_materials(&ids[..2], &[Material::default(), bad]).unwrap_err();
    assert!(matches!(refused, Error::InvalidArgument { ref argument, .. } if argument == "materials[1].density"), "{refused}");
    assert!(solver.set_materials(&ids, &materials[..2]).is_err());
    assert!(matches!(solver.set_materials(&[StrandId::from_bits(0)], &[bad]), Err(Error::InvalidArgument { .. })));
    assert!(matches!(solver.set_materials(&[StrandId::from_bits(0)], &materials[..1]), Err(Error::InvalidId { .. })));
    assert_eq!(solver.state_hash(), hash);
}

/// Upright limp strands: stiffened until they stand, and then they do.
#[test]
fn strands_are_stiffened_as_little_as_makes_them_stand() {
    for by in [Stiffening::YoungsModulus, Stiffening::Radius] {
        let upright = StrandDef {
            root: Frame { rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -1.5), ..Frame::default() },
            material: Material { viscosity: 0.02, ..Material::default() },
            ..StrandDef::straight(0.3, 10)
        };
        let short = StrandDef { element_lengths: vec![0.005; 10], ..upright.clone() };
        let (mut solver, ids) = solver_of(&[upright, short], Workers::Serial);
        let eigenvalues = |solver: &Solver| -> Vec<f64> {
            solver.shape_stability(&ids).unwrap().iter().map(|found| found.smallest_eigenvalue).collect()
        };
        let before = eigenvalues(&solver);
        assert!(before[0] < 0.0 && before[1] > 0.1, "{before:?}");
        let scales = solver.stiffen(&ids, by, 0.1).unwrap();
        assert!(scales[0] > 1.0 && scales[1] == 1.0, "{scales:?}");
        let after = eigenvalues(&solver);
        assert!((after[0] - 0.1).abs() < 1e-6 && (after[1] - before[1]).abs() < 1e-9, "{after:?}");
        let tip = points(&solver, ids[0], &[0.3])[0].0;
        step(&mut solver, 60);
        assert!((points(&solver, ids[0], &[0.3])[0].0 - tip).norm() < 1e-7);
        assert!(solver.stiffen(&ids, by, 1.0).is_err());
    }
}

#[test]
fn drags_and_brushes_are_the_same_for_any_workers_and_leave_others_alone() {
    let definitions: Vec<StrandDef> = (0..60).map(|k| curl(8, k % 13)).collect();
    let mut hashes = Vec::new();
    for workers in [Workers::Serial, Workers::Pool(2), Workers::Pool(3)] {
        let (mut solver, ids) = solver_of(&definitions, workers);
        step(&mut solver, 3);
        let some = &ids[..40];
        let targets: Vec<DragTarget> = some
            .iter()
            .map(|id| DragTarget {
                arclength: 0.15,
                position: points(&solver, *id, &[0.15])[0].0 + Vector3::new(0.0, 0.02, -0.01),
            })
            .collect();
        let before: Vec<_> = ids.iter().map(|id| solver.rates(*id).unwrap().to_vec()).collect();
        let found = solver.drag(some, &targets, &PoseOptions::default()).unwrap();
        for ((id, target), found) in some.iter().zip(&targets).zip(&found) {
            let (at, velocity) = points(&solver, *id, &[0.15])[0];
            assert!(((at - target.position).norm() - found.distance).abs() < 1e-12);
            assert!(found.distance < 1e-6 && velocity.norm() == 0.0);
        }
        assert!(ids[40..].iter().zip(&before[40..]).all(|(id, rates)| solver.rates(*id).unwrap() == rates));
        let centre = points(&solver, ids[45], &[0.2])[0].0;
        let shapes: Vec<_> = ids.iter().map(|id| solver.curvatures(*id).unwrap().to_vec()).collect();
        let brush = Brush { centre, radius: 0.02, falloff: 1.0, movement: Vector3::new(0.0, 0.01, 0.005) };
        let found = solver.brush(&ids, &brush, &PoseOptions::default()).unwrap();
        assert!(found[45].touched && found.iter().any(|found| !found.touched));
        for (k, id) in ids.iter().enumerate() {
            assert_eq!(solver.curvatures(*id).unwrap() != shapes[k], found[k].touched);
            if !found[k].touched && k >= 40 {
                assert_eq!(solver.rates(*id).unwrap(), before[k], "what is not brushed goes on to move");
            }
        }
        step(&mut solver, 2);
        hashes.push(solver.state_hash());
    }
    assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{hashes:x?}");
}

#[test]
fn strands_are_kept_out_of_the_solvers_bodies() {
    let strand =
        StrandDef { root: Frame { origin: Vector3::new(0.0, 0.0, 0.3), ..Frame::default() }, ..StrandDef::straight(0.25, 10) };
    let (mut solver, ids) = solver_of(&[strand.clone(), strand], Workers::Serial);
    let pose = Frame { origin: Vector3::new(0.12, 0.0, 0.24), ..Frame::default() };
    let ball = BodyDef { pose, ..BodyDef::new(Arc::new(Shape::new_sphere(0.05).unwrap())) };
    solver.add_bodies(vec![ball]).unwrap();
    let targets = [DragTarget { arclength: 0.25, position: Vector3::new(0.2, 0.0, 0.18) }; 2];
    let depth = |solver: &Solver, id| {
        let places: Vec<f64> = (0..=2000).map(|k| 0.25 * f64::from(k) / 2000.0).collect();
        let least = points(solver, id, &places).iter().map(|(at, _)| (at - pose.origin).norm()).fold(f64::INFINITY, f64::min);
        0.05 + 50e-6 - least
    };
    solver.drag(&ids[..1], &targets[..1], &PoseOptions::default()).unwrap();
    solver.drag(&ids[1..], &targets[1..], &PoseOptions { keep_out: false, ..PoseOptions::default() }).unwrap();
    assert!(
        depth(&solver, ids[0]) < 3e-6 && depth(&solver, ids[1]) > 1e-3,
        "{} {}",
        depth(&solver, ids[0]),
        depth(&solver, ids[1])
    );
    // A brush takes the other out of it.
    let brush =
        Brush { centre: Vector3::new(0.2, 0.0, 0.18), radius: 0.05, falloff: 0.0, movement: Vector3::new(0.0, 0.0, 1e-4) };
    solver.brush(&ids[1..], &brush, &PoseOptions::default()).unwrap();
    assert!(depth(&solver, ids[1]) < 3e-6, "{}", depth(&solver, ids[1]));
}

#[test]
fn images_move_as_images() {
    let definitions: Vec<StrandDef> = (1..4).map(|k| curl(5, k)).collect();
    // Gravity lies in the plane, so that the images fall as the strands do.
    let plane = Plane::new(Vector3::new(-0.1, 0.0, 0.0), Vector3::new(2.0, 1.0, 0.0)).unwrap();
    let (mut solver, ids) = solver_of(&definitions, Workers::Serial);
    step(&mut solver, 5);
    let images = solver.add_mirrored(&ids, &plane).unwrap();
    let places = [0.03, 0.1, 0.2];
    for steps in [0, 20] {
        step(&mut solver, steps);
        for (id, image) in ids.iter().zip(&images) {
            for ((p, v), (q, w)) in points(&solver, *id, &places).iter().zip(points(&solver, *image, &places)) {
                // After 20 steps: the step's tolerance of 1e-6 rad.
                let slack = if steps == 0 { 1e-13 } else { 1e-6 };
                assert!((plane.position(*p) - q).norm() < slack, "{:e}", (plane.position(*p) - q).norm());
                assert!((plane.direction(*v) - w).norm() < 1e2 * slack);
            }
        }
    }
    // A definition's image is the image of its strand.
    let def = definitions[0].mirrored(&plane);
    let (mut fresh, made) = solver_of(&definitions[..1], Workers::Serial);
    let image = fresh.add_mirrored(&made, &plane).unwrap()[0];
    assert_eq!(fresh.natural_curvatures(image).unwrap(), def.natural);
    assert_eq!(fresh.root_frame(image).unwrap(), def.root);
}

#[test]
fn elements_change_and_constraints_are_kept() {
    let (mut solver, ids) = solver_of(&[curl(5, 1), curl(5, 2)], Workers::Serial);
    let change = ElementChange { twist: 0.2, bend: [0.1, 0.0], stretch: 1.5, keep_curvature: false };
    let (natural, rows) = (solver.natural_curvatures(ids[1]).unwrap()[2], solver.curvatures(ids[1]).unwrap()[2]);
    solver.change_elements(&ids[1..], &[2], &[change]).unwrap();
    let length = 0.04 * 1.5;
    assert!((solver.element_lengths(ids[1]).unwrap()[2] - length).abs() < 1e-16);
    for axis in 0..3 {
        let more = [0.2, 0.1, 0.0][axis] / length;
        assert!((solver.curvatures(ids[1]).unwrap()[2][axis] - rows[axis] / 1.5 - more).abs() < 1e-12);
        assert!((solver.natural_curvatures(ids[1]).unwrap()[2][axis] - natural[axis] / 1.5).abs() < 1e-12);
    }
    step(&mut solver, 3);

    let target = Frame { origin: points(&solver, ids[0], &[0.18])[0].0, ..Frame::default() };
    let pin = ConstraintDef { strand: ids[0], arclength: 0.18, hold: Hold::Point, target, compliance: 0.0 };
    let tie = ConstraintDef { strand: ids[1], arclength: 0.1, hold: Hold::Tie { other: ids[0], arclength: 0.12 }, ..pin };
    let held = solver.add_constraints(&[pin, tie]).unwrap();
    let hash = solver.state_hash();
    let shrink = ElementChange { stretch: 0.05, ..ElementChange::default() };
    for refused in [
        solver.cut(&ids[..1], &[0.14]).unwrap_err(),
        solver.cut(&ids[1..], &[0.09]).unwrap_err(),
        solver.change_elements(&[ids[1], ids[0]], &[1, 0], &[ElementChange::default(), shrink]).unwrap_err(),
        solver.cut(&[ids[1], ids[1]], &[0.19, 0.19]).unwrap_err(),
        solver.cut(&ids, &[0.19, f64::NAN]).unwrap_err(),
        solver.cut(&ids, &[0.19]).unwrap_err(),
        solver.grow(&ids, &Growth { length: -1.0, elements: 0, curvatures: None }).unwrap_err(),
        solver.drag(&ids[..1], &[], &PoseOptions::default()).unwrap_err(),
        solver
            .drag(&[ids[0]; 2], &[DragTarget { arclength: 0.1, position: Vector3::zeros() }; 2], &PoseOptions::default())
            .unwrap_err(),
    ] {
        assert!(matches!(refused, Error::InvalidArgument { .. }), "{refused}");
    }
    assert_eq!(solver.state_hash(), hash);
    solver.cut(&ids[..1], &[0.181]).unwrap();
    solver.remove_constraints(&held).unwrap();
    solver.cut(&ids[..1], &[0.05]).unwrap();

    let frozen = StrandDef { freedoms: Freedoms::BEND1, ..curl(5, 1) };
    let (mut solver, ids) = solver_of(&[frozen], Workers::Serial);
    assert!(solver.change_elements(&ids, &[0], &[ElementChange { twist: 0.1, ..ElementChange::default() }]).is_err());
    solver.change_elements(&ids, &[0], &[ElementChange { bend: [0.1, 0.0], ..ElementChange::default() }]).unwrap();
}
