//! Restyling: grooms that rest as drawn, the stiffening that a strand needs to stand, the current shape as natural or rest
//! shape in the middle of a run.

use std::path::Path;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::{Stability, stability_under_gravity};
use superhelix::hair::{FitOptions, fit_polyline, natural_under_gravity};
use superhelix::internals::step::equilibrium::smallest_eigenvalue;
use superhelix::io::Curves;
use superhelix::{Error, Frame, Freedoms, Material, Solver, SolverOptions, StrandDef, StrandId};

/// Grooms have y up.
const WEIGHT: Vector3<f64> = Vector3::new(0.0, -9.81, 0.0);
/// Γ = ρSgL³/EI above which an upright rod buckles (Greenhill 1881): 9/4 of the square of the first zero of J₋₁⸝₃.
const GREENHILL: f64 = 7.837_347;

fn solver_under(gravity: Vector3<f64>) -> Solver {
    Solver::new(SolverOptions { gravity, ..SolverOptions::default() }).unwrap()
}

/// `count` strands of a groom, evenly taken from it, as drawn: their natural shape is the fitted one.
fn drawn(file: &str, scale: f64, count: usize) -> Vec<StrandDef> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/grooms").join(file);
    let curves = Curves::read(&path).unwrap();
    let every = curves.strands().count() / count;
    let strand = |points: &[[f32; 3]]| {
        let points: Vec<_> = points.iter().map(|p| Vector3::new(p[0].into(), p[1].into(), p[2].into()) * scale).collect();
        let fit = fit_polyline(&points, &FitOptions::elements(8)).unwrap();
        StrandDef { element_lengths: fit.element_lengths, root: fit.root, natural: fit.curvatures, ..StrandDef::straight(1.0, 1) }
    };
    curves.strands().step_by(every).take(count).map(strand).collect()
}

fn points(solver: &Solver, ids: &[StrandId]) -> Vec<Vector3<f64>> {
    let mut out = Vec::new();
    solver.sample_strands(ids, 17, |_, _, sample| out.push(sample.position)).unwrap();
    out
}

/// How far the points of each strand are from where they were, over its length.
fn moved(solver: &Solver, ids: &[StrandId], before: &[Vector3<f64>]) -> Vec<f64> {
    let now = points(solver, ids);
    let furthest = |(k, id): (usize, &StrandId)| {
        let apart = (17 * k..17 * k + 17).map(|p| (now[p] - before[p]).norm()).fold(0.0, f64::max);
        apart / solver.element_lengths(*id).unwrap().iter().sum::<f64>()
    };
    ids.iter().enumerate().map(furthest).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

fn run(solver: &mut Solver, seconds: f64) {
    for _ in 0..(60.0 * seconds) as usize {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
}

#[test]
fn grooms_made_sag_free_and_stiff_enough_lie_still_for_ten_seconds() {
    for (file, scale) in [
        ("blender_wavy.hair", 1.0),
        ("blender_curly.hair", 1.0),
        ("amd_ponytail_tail.tfx", 0.0031),
        ("sintel_hair_001.tfx", 0.01),
        ("fibermesh_1k.tfx", 0.0012),
    ] {
        let mut defs = drawn(file, scale, 12);
        let mut solver = solver_under(WEIGHT);
        let ids = solver.add_strands(&defs).unwrap();
        let stability = solver.shape_stability(&ids).unwrap();
        let unstable = stability.iter().filter(|s| !s.is_stable()).count();
        let scales: Vec<f64> = stability.iter().map(|s| s.youngs_scale(0.05).unwrap()).collect();

        // As drawn it sags: what follows is not for want of weight.
        let before = points(&solver, &ids);
        run(&mut solver, 1.0);
        let sagged = largest(&moved(&solver, &ids, &before));
        assert!(sagged > 1e-2, "{file} {sagged}");

        for (def, scale) in defs.iter_mut().zip(&scales) {
            def.material.youngs_modulus *= scale;
        }
        let mut solver = solver_under(WEIGHT);
        let ids = solver.add_strands(&defs).unwrap();
        solver.take_rest_shapes(&ids).unwrap();
        for (found, (before, scale)) in solver.shape_stability(&ids).unwrap().iter().zip(stability.iter().zip(&scales)) {
            let predicted = 1.0 + (before.smallest_eigenvalue - 1.0) / scale;
            assert!(found.is_stable() && (found.smallest_eigenvalue - predicted).abs() < 1e-7, "{file} {found:?} {predicted}");
        }
        let before = points(&solver, &ids);
        run(&mut solver, 10.0);
        let still = largest(&moved(&solver, &ids, &before));
        println!(
            "{file}: {unstable} of 12 unstable, E up to {:.1}-fold; moved {still:.1e} L, as drawn {sagged:.2} L",
            largest(&scales)
        );
        assert!(still < 1e-6, "{file} {still}");
    }
}

/// An upright strand of 0.1 m with that Γ.
fn upright(gamma: f64, count: usize) -> StrandDef {
    let up = UnitQuaternion::rotation_between(&Vector3::x(), &Vector3::y()).unwrap();
    let youngs_modulus = 4.0 * 1300.0 * 9.81 * 0.1_f64.powi(3) / (50e-6_f64.powi(2) * gamma);
    StrandDef {
        root: Frame { rotation: up, ..Frame::default() },
        material: Material { youngs_modulus, ..Material::default() },
        ..StrandDef::straight(0.1, count)
    }
}

#[test]
fn the_stiffening_of_an_upright_strand_is_greenhills() {
    let straight = [[0.0; 3]; 40];
    for gamma in [2.0, 20.0, 80.0] {
        let def = upright(gamma, 40);
        let stability = stability_under_gravity(&def, &straight, WEIGHT).unwrap();
        let scale = stability.youngs_scale(0.0).unwrap();
        // 40 elements find the critical load to 2e-4.
        assert!((scale / (gamma / GREENHILL).max(1.0) - 1.0).abs() < 5e-4, "{gamma} {scale}");
        assert_eq!(stability.is_stable(), gamma < GREENHILL);
        if gamma > GREENHILL {
            for margin in [0.0, 0.3] {
                let mut stiffer = def.clone();
                stiffer.material.youngs_modulus *= stability.youngs_scale(margin).unwrap();
                assert!((smallest_eigenvalue(&stiffer, &straight, WEIGHT).unwrap() - margin).abs() < 1e-8);
                let mut thicker = def.clone();
                thicker.material.radius = thicker.material.radius.map(|r| r * stability.radius_scale(margin).unwrap());
                assert!((smallest_eigenvalue(&thicker, &straight, WEIGHT).unwrap() - margin).abs() < 1e-8);
            }
        }
    }
    for margin in [-0.1, 1.0, f64::NAN] {
        let error = Stability { smallest_eigenvalue: -1.0 }.youngs_scale(margin).unwrap_err().to_string();
        assert!(error.contains("margin"), "{error}");
    }
}

#[test]
fn strands_called_unstable_fall_at_a_touch_and_strands_called_stable_do_not() {
    for (share, stands) in [(0.9, true), (1.1, false)] {
        let mut def = upright(share * GREENHILL, 20);
        def.material.internal_friction = 1e-9;
        let mut solver = solver_under(WEIGHT);
        let ids = solver.add_strands(&[def]).unwrap();
        solver.take_rest_shapes(&ids).unwrap();
        assert_eq!(solver.shape_stability(&ids).unwrap()[0].is_stable(), stands);
        let before = points(&solver, &ids);
        let mut touched = solver.shapes(&ids).unwrap();
        for row in &mut touched {
            row[1] += 0.05;
        }
        solver.set_shapes(&ids, &touched).unwrap();
        run(&mut solver, 10.0);
        let moved = moved(&solver, &ids, &before)[0];
        println!("{share} of Greenhill's: moved {moved:.2e} L");
        assert_eq!(moved < 0.05, stands, "{share} {moved}");
    }
}

/// Two curls with their roots at rest, hanging and swinging.
fn swinging() -> (Solver, Vec<StrandId>) {
    let mut defs = vec![StrandDef::straight(0.12, 6), StrandDef::straight(0.1, 4)];
    for (def, tilt) in defs.iter_mut().zip([-1.2, -0.7]) {
        def.root.rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.2, tilt));
        def.natural.fill([2.0, 15.0, 8.0]);
        def.material.youngs_modulus = 1e10;
        def.material.internal_friction = 1e-9;
    }
    defs[1].freedoms = Freedoms::BEND1.union(Freedoms::BEND2);
    let mut solver = solver_under(WEIGHT);
    let ids = solver.add_strands(&defs).unwrap();
    run(&mut solver, 0.1);
    (solver, ids)
}

#[test]
fn a_shape_taken_in_the_middle_of_a_run_is_rested_in() {
    let (mut solver, ids) = swinging();
    let (at, rates) = (points(&solver, &ids), solver.rates(ids[0]).unwrap().to_vec());
    assert!(rates.iter().flatten().any(|rate| rate.abs() > 1.0), "it swings");
    let taken = solver.shapes(&ids).unwrap();
    solver.take_rest_shapes(&ids).unwrap();
    assert!(solver.shape_stability(&ids).unwrap().iter().all(Stability::is_stable));
    // Nothing moved, nothing stopped.
    assert!(points(&solver, &ids) == at && solver.rates(ids[0]).unwrap() == rates);
    assert_eq!(solver.shapes(&ids).unwrap(), taken);
    // Swinging strands settle there, since there is friction.
    let mut left = solver_under(WEIGHT);
    left.restore(&solver.snapshot()).unwrap();
    let others = left.strand_ids();
    run(&mut left, 0.05);
    assert!(largest(&moved(&left, &others, &at)) > 1e-3, "it swings on");
    run(&mut left, 20.0);
    let came = largest(&moved(&left, &others, &at));
    assert!(came < 1e-6, "{came}");
    // Stopped strands stay.
    solver.set_shapes(&ids, &taken).unwrap();
    run(&mut solver, 10.0);
    let still = largest(&moved(&solver, &ids, &at));
    assert!(still < 1e-9, "{still}");
}

#[test]
fn a_shape_made_natural_carries_no_strain_and_sags() {
    let (mut solver, ids) = swinging();
    let at = points(&solver, &ids);
    assert!(solver.energies(ids[0]).unwrap().elastic > 0.0);
    solver.take_natural_shapes(&ids).unwrap();
    for id in &ids {
        assert_eq!(solver.natural_curvatures(*id).unwrap(), solver.curvatures(*id).unwrap());
        assert_eq!(solver.energies(*id).unwrap().elastic, 0.0);
    }
    // Without weight it is a rest shape.
    solver.set_gravity(Vector3::zeros()).unwrap();
    solver.reset_strands(&ids).unwrap();
    run(&mut solver, 1.0);
    assert!(largest(&moved(&solver, &ids, &at)) < 1e-12);
    solver.set_gravity(WEIGHT).unwrap();
    run(&mut solver, 10.0);
    assert!(largest(&moved(&solver, &ids, &at)) > 1e-3);
}

#[test]
fn a_rest_shape_has_the_closed_form_and_discards_the_original() {
    let (mut solver, ids) = swinging();
    solver.set_element_count(&ids, 3).unwrap();
    let shape = solver.curvatures(ids[0]).unwrap().to_vec();
    let mut def = StrandDef::straight(0.12, 3);
    def.material.youngs_modulus = 1e10;
    def.element_lengths = solver.element_lengths(ids[0]).unwrap().to_vec();
    def.root = solver.root_frame(ids[0]).unwrap();
    let expected = natural_under_gravity(&def, &shape, WEIGHT).unwrap();
    solver.take_rest_shapes(&ids).unwrap();
    for (a, b) in solver.natural_curvatures(ids[0]).unwrap().iter().flatten().zip(expected.iter().flatten()) {
        assert!((a - b).abs() < 1e-7 * b.abs().max(1.0), "{a} {b}");
    }
    // On other elements it is the shape taken last that is split, not the one before.
    let taken = solver.natural_curvatures(ids[0]).unwrap().to_vec();
    solver.set_element_count(&ids, 6).unwrap();
    for (element, row) in solver.natural_curvatures(ids[0]).unwrap().iter().enumerate() {
        assert_eq!(*row, taken[element / 2]);
    }
    // A frozen freedom keeps its value.
    assert!(solver.natural_curvatures(ids[1]).unwrap().iter().all(|row| row[0] == 2.0));
}

#[test]
fn bad_input_is_named_and_changes_nothing() {
    let (mut solver, ids) = swinging();
    let gone = ids[1];
    let rows = solver.shapes(&ids).unwrap();
    assert_eq!(rows.len(), 10);
    let hash = solver.state_hash();
    let text = |result: Result<(), Error>| result.unwrap_err().to_string();
    assert!(text(solver.set_shapes(&ids, &rows[..9])).contains("curvatures (count)"));
    let mut wrong = rows.clone();
    wrong[3][1] = f64::NAN;
    assert!(text(solver.set_shapes(&ids, &wrong)).contains("curvatures[3][1]"));
    let mut wrong = rows.clone();
    wrong[6][0] += 1.0;
    let frozen = text(solver.set_shapes(&ids, &wrong));
    assert!(frozen.contains("ids[1]") && frozen.contains("frozen"), "{frozen}");
    assert_eq!(solver.state_hash(), hash);

    solver.remove_strands(&[gone]).unwrap();
    let mut limp = StrandDef::straight(1e4, 2);
    limp.material.youngs_modulus = 1e-290;
    let limp = solver.add_strands(&[limp]).unwrap()[0];
    let hash = solver.state_hash();
    let limp = text(solver.take_rest_shapes(&[ids[0], limp]));
    assert!(limp.contains("ids[1]") && limp.contains("stiffness"), "{limp}");
    for ids in [[ids[0], gone]] {
        for stale in [
            text(solver.take_rest_shapes(&ids)),
            text(solver.take_natural_shapes(&ids)),
            text(solver.shape_stability(&ids).map(|_| ())),
            text(solver.shapes(&ids).map(|_| ())),
            text(solver.set_shapes(&ids, &rows)),
        ] {
            assert!(stale.contains("ids[1]"), "{stale}");
        }
    }
    assert_eq!(solver.state_hash(), hash);
}
