//! Simulated strands on more or fewer elements (`docs/theory/adaptive.md`): what is exact, and how near the rest is. `--nocapture` prints the
//! numbers of that page.

use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};
use superhelix::editing::{EquilibriumOptions, Regrid};
use superhelix::internals::math::quadrature::Rule;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::internals::step::state::rotation_matrix;
use superhelix::{Frame, Freedoms, Integrator, Material, Solver, SolverOptions, StepOptions, StrandDef, StrandId};

const LENGTH: f64 = 0.2;
const STEP: f64 = 1.0 / 60.0;
const KINDS: [(&str, [f64; 3]); 3] = [("straight", [0.0; 3]), ("wavy", [10.0, 20.0, 5.0]), ("curly", [15.0, 50.0, 0.0])];

fn hair(count: usize, natural: [f64; 3]) -> StrandDef {
    let mut def = StrandDef::straight(LENGTH, count);
    def.material = Material { youngs_modulus: 2e9, internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
    def.natural = vec![natural; count];
    def
}

fn root_at(time: f64) -> Frame {
    let (sine, cosine) = (6.0 * time).sin_cos();
    Frame {
        origin: Vector3::new(0.0, 0.05 * (1.0 - cosine), 0.0),
        rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * sine),
    }
}

/// A solver with one strand that swings on a moving root.
struct Scene {
    solver: Solver,
    id: StrandId,
    time: f64,
}

impl Scene {
    fn new(def: StrandDef, integrator: Integrator) -> Self {
        Self::with(def, StepOptions { integrator, tolerance: 1e-9, ..StepOptions::default() })
    }

    fn with(def: StrandDef, step: StepOptions) -> Self {
        let mut solver = Solver::new(SolverOptions { step, ..SolverOptions::default() }).unwrap();
        let id = solver.add_strands(&[def]).unwrap()[0];
        Self { solver, id, time: 0.0 }
    }

    fn swinging(count: usize, natural: [f64; 3]) -> Self {
        let mut scene = Self::new(hair(count, natural), Integrator::SecondOrder);
        scene.steps(20);
        scene
    }

    fn steps(&mut self, count: usize) {
        for _ in 0..count {
            self.time += STEP;
            self.solver.set_root_frames(&[self.id], &[root_at(self.time)], STEP).unwrap();
            let report = self.solver.step(STEP, 1).unwrap();
            assert_eq!(report.unconverged + report.quarantined, 0);
        }
    }

    fn copy(&self) -> Self {
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        solver.restore(&self.solver.snapshot()).unwrap();
        let id = solver.strand_ids()[0];
        Self { solver, id, time: self.time }
    }

    fn put_on(&mut self, count: usize) -> Regrid {
        self.solver.set_element_count(&[self.id], count).unwrap()[0]
    }

    /// Positions and velocities at 201 places.
    fn curve(&self) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let mut out = Vec::new();
        self.solver.sample_strands(&[self.id], 201, |_, _, sample| out.push((sample.position, sample.velocity))).unwrap();
        out
    }

    fn energies(&self) -> [f64; 3] {
        let energies = self.solver.energies(self.id).unwrap();
        [energies.kinetic, energies.elastic, energies.gravity]
    }
}

/// Largest distance of positions and of velocities.
fn apart(a: &Scene, b: &Scene) -> (f64, f64) {
    let mut largest = (0.0_f64, 0.0_f64);
    for (one, other) in a.curve().iter().zip(&b.curve()) {
        largest = (largest.0.max((one.0 - other.0).norm()), largest.1.max((one.1 - other.1).norm()));
    }
    largest
}

fn relative(a: f64, b: f64) -> f64 {
    (a - b).abs() / b.abs()
}

#[test]
fn splitting_is_exact() {
    for integrator in [Integrator::SecondOrder, Integrator::ImplicitEuler, Integrator::LinearlyImplicit] {
        for uneven in [false, true] {
            let mut def = hair(5, [10.0, 40.0, 5.0]);
            def.material.viscosity = 0.01;
            def.material.internal_friction = 0.0;
            if uneven {
                def.element_lengths = vec![0.01, 0.03, 0.02, 0.06, 0.08];
                def.freedoms = Freedoms::BEND1.union(Freedoms::BEND2);
                def.natural = (0..5).map(|k| [10.0 + f64::from(k), 40.0 - f64::from(k), f64::from(k)]).collect();
            }
            // Energies of large elements are compared with those of small ones.
            let step = StepOptions { integrator, tolerance: 1e-9, quadrature_tolerance: 1e-10, ..StepOptions::default() };
            let mut scene = Scene::with(def, step);
            scene.steps(12);
            let mut finer = scene.copy();
            let report = finer.put_on(15);
            assert!(report.exact && report.max_distance < 1e-15, "{report:?}");
            assert_eq!(finer.solver.element_lengths(finer.id).unwrap().len(), 15);
            let (distance, velocity) = apart(&scene, &finer);
            assert!(distance < 1e-14 && velocity < 1e-12, "{distance} {velocity}");
            let (before, after) = (scene.energies(), finer.energies());
            // Elastic energy to rounding; those of points to what quadrature on the larger elements leaves.
            assert!(relative(after[1], before[1]) < 1e-13, "{before:?} {after:?}");
            assert!(relative(after[0], before[0]) < 1e-9 && relative(after[2], before[2]) < 1e-9, "{before:?} {after:?}");
            // There and back: nothing has changed but rounding.
            let report = finer.put_on(5);
            assert!(report.max_distance < 1e-12, "{report:?}");
            assert_eq!(finer.solver.natural_curvatures(finer.id).unwrap(), scene.solver.natural_curvatures(scene.id).unwrap());
            assert_eq!(finer.solver.element_lengths(finer.id).unwrap(), scene.solver.element_lengths(scene.id).unwrap());
            let (distance, velocity) = apart(&scene, &finer);
            assert!(distance < 1e-12 && velocity < 1e-5, "{distance} {velocity}");
        }
    }
}

#[test]
fn the_split_strand_goes_on_as_discretisation_lets_it() {
    // After six steps: what the errors of N and 2N elements differ by, which falls as 1/N²; no kick beside it.
    let errors = [10, 20, 40].map(|count| {
        let mut coarse = Scene::swinging(count, [10.0, 20.0, 5.0]);
        let mut fine = coarse.copy();
        assert!(fine.put_on(2 * count).exact);
        coarse.steps(6);
        fine.steps(6);
        apart(&coarse, &fine).0
    });
    println!("split in two, six steps on: {errors:?} m");
    for pair in errors.windows(2) {
        assert!((3.0..5.5).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// The least root mean square distance that `count` elements can have from a strand with its root held, near `start`: an
/// independent fit by Levenberg's method with difference quotients.
fn least_distance(scene: &Scene, start: &[[f64; 3]]) -> f64 {
    let count = start.len();
    let rule = Rule::gauss_legendre(12);
    let length = LENGTH / count as f64;
    let places: Vec<f64> = (0..count).flat_map(|element| rule.nodes.iter().map(move |x| (element as f64 + x) * length)).collect();
    let mut targets = Vec::new();
    scene.solver.sample_at(scene.id, &places, |_, sample| targets.push(sample.position)).unwrap();
    let root = scene.solver.root_frame(scene.id).unwrap();
    let mut kinematics = Kinematics::default();
    let mut residuals = |unknowns: &DVector<f64>| {
        let rows: Vec<[f64; 3]> = unknowns.as_slice().chunks(3).map(|row| [row[0], row[1], row[2]]).collect();
        kinematics.update(&rotation_matrix(&root), &vec![length; count], &rows, &rule);
        let points = kinematics.points.iter().zip(&targets).enumerate();
        let off = points.flat_map(|(p, (point, target))| {
            let off = root.origin + Vector3::from(point.position) - target;
            let weight = (rule.weights[p % rule.len()] / count as f64).sqrt();
            [off.x * weight, off.y * weight, off.z * weight]
        });
        DVector::from_iterator(3 * places.len(), off)
    };
    let mut unknowns = DVector::from_iterator(3 * count, start.iter().flatten().copied());
    let mut off = residuals(&unknowns);
    let mut damping = 1e-9;
    for _ in 0..100 {
        let columns: Vec<DVector<f64>> = (0..3 * count)
            .map(|j| {
                let mut moved = unknowns.clone();
                moved[j] += 1e-4;
                (residuals(&moved) - &off) / 1e-4
            })
            .collect();
        let jacobian = DMatrix::from_columns(&columns);
        let normal = jacobian.transpose() * &jacobian;
        let damped = &normal + DMatrix::identity(3 * count, 3 * count) * (damping * normal.diagonal().max());
        let trial = &unknowns - damped.cholesky().unwrap().solve(&(jacobian.transpose() * &off));
        let there = residuals(&trial);
        if there.norm() < off.norm() {
            let gain = 1.0 - there.norm() / off.norm();
            (unknowns, off, damping) = (trial, there, damping * 0.1);
            if gain < 1e-6 {
                break;
            }
        } else {
            damping *= 30.0;
        }
    }
    off.norm()
}

#[test]
fn joining_is_as_near_as_so_few_elements_can_be() {
    println!("| hair | elements | rms, mm | least, mm | elastic energy | kinetic energy | gravity's, of m g L |");
    for (name, natural) in KINDS {
        for (from, to) in [(20, 10), (20, 7), (20, 5), (10, 5), (5, 7)] {
            let scene = Scene::swinging(from, natural);
            let mut other = scene.copy();
            let report = other.put_on(to);
            let own = other.solver.curvatures(other.id).unwrap();
            let present = scene.solver.curvatures(scene.id).unwrap();
            let picked: Vec<_> = (0..to).map(|k| present[k * from / to]).collect();
            let direct = least_distance(&scene, own).min(least_distance(&scene, &picked));
            let (before, after) = (scene.energies(), other.energies());
            let mgl = 1300.0 * std::f64::consts::PI * 2.5e-9 * LENGTH * LENGTH * 9.81;
            let (kinetic, elastic, gravity) = (after[0] / before[0], after[1] / before[1], (after[2] - before[2]) / mgl);
            println!(
                "| {name} | {from} to {to} | {:.3} | {:.3} | {elastic:.3} | {kinetic:.3} | {gravity:.4} |",
                report.rms_distance * 1e3,
                direct * 1e3
            );
            assert!(!report.exact);
            assert!(
                report.rms_distance < if to < from { 1.35 } else { 1.8 } * direct,
                "{name} {from} {to}: {report:?}, {direct}"
            );
            assert!(report.rms_distance <= report.max_distance && report.max_distance < 0.035 * LENGTH, "{report:?}");
            assert!((0.99..1.001).contains(&kinetic), "{name} {from} {to}: kinetic {kinetic}");
            assert!((0.9..1.4).contains(&elastic), "{name} {from} {to}: elastic {elastic}");
            assert!(gravity.abs() < 0.02, "{name} {from} {to}: gravity {gravity}");
        }
    }
}

#[test]
fn going_back_and_forth_does_not_drift() {
    for (name, natural) in KINDS {
        let mut scene = Scene::swinging(20, natural);
        scene.put_on(5);
        let first = scene.copy();
        let energies = scene.energies();
        for _ in 0..50 {
            for count in [20, 5, 10, 5] {
                scene.put_on(count);
            }
        }
        let (distance, velocity) = apart(&first, &scene);
        println!("{name}: 200 changes later {distance:.1e} m, {velocity:.1e} m/s");
        assert!(distance < 1e-10 && velocity < 1e-6, "{name}: {distance} {velocity}");
        for (now, then) in scene.energies().iter().zip(&energies) {
            assert!(relative(*now, *then) < 1e-8, "{now} {then}");
        }
    }
}

#[test]
fn changing_again_and_again_while_it_moves() {
    // Hanging from a still root: the initial energy of gravity and elasticity drives the swing.
    let total = |scene: &Scene| scene.energies().iter().sum::<f64>();
    for damped in [true, false] {
        for (name, natural) in KINDS {
            let mut def = hair(20, natural);
            if !damped {
                (def.material.internal_friction, def.material.air_drag) = (0.0, 0.0);
            }
            let mut scene = Scene::new(def, Integrator::SecondOrder);
            let start = total(&scene);
            let (mut most, mut swing) = (f64::MIN, 0.0_f64);
            for change in 0..60 {
                scene.solver.step(10.0 * STEP, 10).unwrap();
                scene.put_on([5, 20, 10, 20][change % 4]);
                most = most.max(total(&scene));
                swing = swing.max(scene.energies()[0]);
            }
            let gained = (most - start) / swing;
            println!(
                "{name}, {}: at most {gained:.3} of the largest kinetic energy above the start",
                if damped { "damped" } else { "undamped" }
            );
            // Each joining stretches a curl that nothing damps a little, fifteen times: that much and no more.
            assert!(gained < if damped { 0.01 } else { 0.5 }, "{name}, {damped}: {gained}");
        }
    }
}

#[test]
fn what_rests_stays_near() {
    println!("| hair | elements | moved at once, mm | after two seconds, mm | fastest, mm/s |");
    for (name, natural) in KINDS {
        for (from, to) in [(20, 10), (20, 5), (5, 20)] {
            let mut scene = Scene::new(hair(from, natural), Integrator::SecondOrder);
            assert!(scene.solver.settle(&[scene.id], &EquilibriumOptions::default()).unwrap()[0].converged);
            let mut other = scene.copy();
            let at_once = other.put_on(to).max_distance;
            let mut fastest = 0.0_f64;
            for _ in 0..120 {
                other.solver.step(STEP, 1).unwrap();
                fastest = other.curve().iter().fold(fastest, |most, (_, velocity)| most.max(velocity.norm()));
            }
            let later = apart(&scene, &other).0;
            // It moves to its own rest on that many elements: the distance is the elements' error (1/N²), and no more.
            let mut rest = other.copy();
            assert!(rest.solver.settle(&[rest.id], &EquilibriumOptions::default()).unwrap()[0].converged);
            let between = apart(&scene, &rest).0;
            println!("| {name} | {from} to {to} | {:.3} | {:.3} | {:.1} |", at_once * 1e3, later * 1e3, fastest * 1e3);
            assert!(later < 1.5 * between + 1e-5, "{name} {from} {to}: {later} {between}");
            // The rests are `between` apart: it does not swing much faster than falling over that distance would make it.
            assert!(fastest < 1.5 * (2.0 * 9.81 * (between + at_once)).sqrt() + 1e-3, "{name} {from} {to}: {fastest}");
        }
    }
}

#[test]
fn detail_of_the_natural_shape_comes_back() {
    let mut def = hair(20, [0.0; 3]);
    def.natural = (0..20).map(|k| [f64::from(k % 3), 20.0 + 15.0 * f64::from(k * k % 7), 4.0 * f64::from(k % 5)]).collect();
    let natural = def.natural.clone();
    let mut scene = Scene::new(def, Integrator::SecondOrder);
    scene.solver.settle(&[scene.id], &EquilibriumOptions::default()).unwrap();
    let before = scene.copy();
    let away = scene.put_on(5);
    let means = scene.solver.natural_curvatures(scene.id).unwrap().to_vec();
    for (k, row) in means.iter().enumerate() {
        for axis in 0..3 {
            let mean = natural[4 * k..4 * k + 4].iter().map(|row| row[axis]).sum::<f64>() / 4.0;
            assert!((row[axis] - mean).abs() < 1e-12 * mean.abs().max(1.0), "{row:?} {mean}");
        }
    }
    // A snapshot in between keeps it.
    let mut scene = scene.copy();
    let back = scene.put_on(20);
    assert!(!back.exact);
    assert_eq!(scene.solver.natural_curvatures(scene.id).unwrap(), natural);
    let (distance, _) = apart(&before, &scene);
    println!("away {:.2e} m, back {:.2e} m, off by {distance:.2e} m", away.max_distance, back.max_distance);
    // Nearer than the five elements were: strain was kept, and the detail is back.
    assert!(distance < away.max_distance, "{distance} {away:?}");
    // New natural curvatures are kept from then on.
    scene.put_on(5);
    scene.solver.set_natural_curvatures(scene.id, &[[1.0, 2.0, 3.0]; 5]).unwrap();
    scene.put_on(20);
    assert_eq!(scene.solver.natural_curvatures(scene.id).unwrap(), [[1.0, 2.0, 3.0]; 20]);
}

#[test]
fn given_lengths_and_bad_input() {
    let scene = Scene::swinging(6, KINDS[1].1);
    let mut graded = scene.copy();
    let lengths = [0.01, 0.02, 0.03, 0.04, 0.1];
    let report = graded.solver.set_element_lengths(graded.id, &lengths).unwrap();
    assert!(!report.exact && report.max_distance < 0.01, "{report:?}");
    assert_eq!(graded.solver.element_lengths(graded.id).unwrap(), lengths);
    // The number alone goes by the grading that the strand was made with.
    graded.put_on(12);
    assert!(graded.solver.element_lengths(graded.id).unwrap().iter().all(|l| (l - LENGTH / 12.0).abs() < 1e-15));
    graded.steps(5);
    // Neither the wrench nor the motion of the root is lost.
    let mut moving = scene.copy();
    moving.solver.set_root_frames(&[moving.id], &[root_at(moving.time + 0.1)], 0.1).unwrap();
    moving.solver.step(0.05, 3).unwrap();
    let wrench = moving.solver.root_wrench(moving.id).unwrap();
    moving.put_on(3);
    assert_eq!(moving.solver.root_wrench(moving.id).unwrap(), wrench);
    moving.solver.step(0.05, 3).unwrap();
    let root = moving.solver.root_frame(moving.id).unwrap();
    assert!((root.origin - root_at(moving.time + 0.1).origin).norm() < 1e-12);

    let mut solver = scene.solver;
    let hash = solver.state_hash();
    let message = |result: superhelix::Result<Regrid>| result.unwrap_err().to_string();
    assert!(message(solver.set_element_lengths(scene.id, &[])).contains("lengths (count)"));
    assert!(message(solver.set_element_lengths(scene.id, &[0.1, 0.2])).contains("lengths (sum)"));
    assert!(message(solver.set_element_lengths(scene.id, &[0.1, -0.1, 0.2])).contains("lengths[1]"));
    assert!(solver.set_element_count(&[scene.id], 0).unwrap_err().to_string().contains("element_count"));
    let gone = StrandId::from_bits(7);
    assert!(solver.set_element_count(&[scene.id, gone], 3).unwrap_err().to_string().contains("ids[1]"));
    assert_eq!(solver.state_hash(), hash);
}

/// A small generator of numbers in 0..1, the same on every machine.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Between two positive bounds, evenly in the logarithm.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

#[test]
fn any_strand_can_be_put_on_any_number_of_elements() {
    let mut draw = Draw(11);
    let mut worst = 0.0_f64;
    for case in 0..50 {
        let length = draw.between(1e-3, 3.0);
        let count = draw.between(1.0, 40.0) as usize;
        let mut def = StrandDef::straight(length, count);
        let lengths: Vec<f64> = (0..count).map(|_| draw.between(1e-3, 1.0)).collect();
        let sum: f64 = lengths.iter().sum();
        def.element_lengths = lengths.iter().map(|l| l / sum * length).collect();
        let radius = draw.between(1e-6, 1e-3).min(0.1 * length);
        def.material.radius = [radius, radius * draw.between(0.2, 1.0)];
        def.material.youngs_modulus = draw.between(1e4, 1e12);
        def.material.internal_friction = draw.between(1e-14, 1e-8);
        def.freedoms = Freedoms::from_bits("freedoms", 1 + (7.0 * draw.next()) as u32).unwrap();
        let turn = draw.between(0.01, 30.0);
        for (row, l) in def.natural.iter_mut().zip(&def.element_lengths) {
            *row = [0; 3].map(|_| (draw.next() - 0.5) * turn / l.max(length / count as f64));
        }
        let step = StepOptions { tolerance: 1e-6, max_iterations: 100, ..StepOptions::default() };
        let mut solver = Solver::new(SolverOptions { step, ..SolverOptions::default() }).unwrap();
        let ids = solver.add_strands(&[def]).unwrap();
        for change in 0..4 {
            let to = Frame {
                origin: Vector3::x() * draw.next() * length,
                rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), draw.next()),
            };
            solver.set_root_frames(&ids, &[to], 0.05).unwrap();
            solver.step(0.05, 3).unwrap();
            let before = solver.energies(ids[0]).unwrap();
            let to = draw.between(1.0, 60.0) as usize;
            let report = solver.set_element_count(&ids, to).unwrap()[0];
            let after = solver.energies(ids[0]).unwrap();
            let what = format!("case {case}, change {change} to {to}: {report:?} {before:?} {after:?}");
            assert!(report.rms_distance <= report.max_distance && report.max_distance < 2.0 * length, "{what}");
            assert!(after.kinetic <= before.kinetic * (1.0 + 1e-6), "{what}");
            assert!(after.elastic.is_finite() && after.gravity.is_finite(), "{what}");
            assert!(solver.rates(ids[0]).unwrap().iter().flatten().all(|rate| rate.is_finite()), "{what}");
            let lengths = solver.element_lengths(ids[0]).unwrap();
            assert!(lengths.len() == to && (lengths.iter().sum::<f64>() / length - 1.0).abs() < 1e-12, "{what}");
            worst = worst.max(report.max_distance / length);
            let mut last = None;
            let mut way = 0.0;
            solver
                .sample_strands(&ids, 2001, |_, _, sample| {
                    way += last.map_or(0.0, |last: Vector3<f64>| (sample.position - last).norm());
                    last = Some(sample.position);
                })
                .unwrap();
            assert!(way <= length * (1.0 + 1e-12), "{what}");
        }
    }
    println!("farthest moved: {worst:.3} of the length");
}
