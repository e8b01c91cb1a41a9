//! Motions against independent solutions: of N = 1 element, where only the step is in error, and of the continuous rod, where the
//! elements are too. `--nocapture` prints the tables of `docs/theory/validation_physics.md`.

use crate::rods::judge::record;
use crate::rods::*;
use nalgebra::{UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::{Frame, Material, Solver, SolverOptions, StepOptions, StrandDef};

/// How a root moves: its pose at a time, s.
type Way<'a> = &'a dyn Fn(f64) -> Frame;

/// The strand of a reference case.
fn released(case: &Value, count: usize, root: UnitQuaternion<f64>, natural: [f64; 3]) -> StrandDef {
    let si = &case["si"];
    let or = |key: &str, other: &str| si.get(key).map_or_else(|| number(&si[other]), number);
    let length = number(&si["L"]);
    let mut def = StrandDef::straight(length, count);
    def.material = Material {
        radius: [or("a1", "r"), or("a2", "r")],
        density: number(&si["rho"]),
        youngs_modulus: number(&si["E"]),
        poisson_ratio: si.get("poisson").map_or(0.48, number),
        internal_friction: number(&si["gamma"]),
        air_drag: number(&si["nu"]),
        ..Material::default()
    };
    def.root.rotation = root;
    def.natural = vec![natural.map(|k| k / length); count];
    def
}

/// Largest distance of the tip from the reference over the frames of the first `seconds`, in L; `per_frame` steps in each 1/60 s.
fn error(def: &StrandDef, tips: &[Vector3<f64>], seconds: f64, per_frame: u32) -> f64 {
    error_along(def, &|_| def.root, tips, seconds, per_frame)
}

/// The same with a moving root, whose pose is set at every step.
fn error_along(def: &StrandDef, root: Way, tips: &[Vector3<f64>], seconds: f64, per_frame: u32) -> f64 {
    // What is measured is the step and the elements, down to 1e-5 L: the default 1e-4 would be seen where one element turns far.
    let step = StepOptions { quadrature_tolerance: 1e-10, ..StepOptions::default() };
    let mut solver = Solver::new(SolverOptions { step, ..SolverOptions::default() }).unwrap();
    let id = solver.add_strands(std::slice::from_ref(def)).unwrap()[0];
    let length = def.length();
    let mut worst = 0.0_f64;
    let h = 1.0 / (60.0 * f64::from(per_frame));
    for (frame, tip) in tips.iter().enumerate().skip(1).take((seconds * 60.0).round() as usize) {
        for step in 1..=per_frame {
            let t = ((frame - 1) as f64) / 60.0 + h * f64::from(step);
            solver.set_root_frames(&[id], &[root(t)], h).unwrap();
            let report = solver.step(h, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
        }
        solver.sample_at(id, &[length], |_, sample| worst = worst.max((sample.position / length - tip).norm())).unwrap();
    }
    worst
}

fn planar_tips(case: &Value) -> Vec<Vector3<f64>> {
    rows(&case["tip_x"]).iter().zip(rows(&case["tip_z"])).map(|(x, z)| Vector3::new(number(x), 0.0, number(z))).collect()
}

fn spatial_tips(case: &Value) -> Vec<Vector3<f64>> {
    rows(&case["tip"]).iter().map(triple).collect()
}

fn print(name: &str, errors: &[f64]) {
    let shown: Vec<String> = errors.iter().map(|e| format!("{e:.1e}")).collect();
    println!("| {name} | {} |", shown.join(" | "));
}

fn record_motion(name: &str, counts: &[usize], errors: &[f64]) {
    for (count, error) in counts.iter().zip(errors) {
        record("motions", "case,elements,error", format!("{name},{count},{error:.6e}"));
    }
}

fn record_steps(name: &str, rates: &[u32], errors: &[f64]) {
    for (rate, error) in rates.iter().zip(errors) {
        record(
            "steps",
            "case,step,error",
            format!("{},{:.9},{error:.6e}", name.replace('"', ""), 1.0 / (60.0 * f64::from(*rate))),
        );
    }
}

/// Moving roots: R1 translated, R2 turned (hanging rods, in the plane), D5 a curl of one element translated.
#[test]
fn moving_roots() {
    let reference = reference();
    for (name, case) in reference["dynamics_moving_root"].as_object().unwrap() {
        let turn = std::f64::consts::TAU;
        let translated = |amplitude: f64, hertz: f64, root: UnitQuaternion<f64>| {
            move |t: f64| Frame { origin: Vector3::x() * (amplitude * (1.0 - (turn * hertz * t).cos())), rotation: root }
        };
        let tips = |spatial: bool| if spatial { spatial_tips(case) } else { planar_tips(case) };
        if name.starts_with("D5") {
            let motion: Vec<f64> = rows(&case["root_motion"]).iter().map(number).collect();
            assert_eq!(motion[2..], [1.0, 0.0, 0.0]);
            let def = released(case, 1, clamp_from(&case["R0"]), triple(&case["un_L"]).into());
            let root = translated(motion[0], motion[1], def.root.rotation);
            let rates = [8, 16, 32, 64, 128];
            let errors = rates.map(|per_frame| error_along(&def, &root, &tips(true), 0.5, per_frame));
            print(name, &errors);
            record_steps(name, &rates, &errors);
            let order = (errors[3] / errors[4]).log2();
            assert!((1.8..2.3).contains(&order) && errors[4] < 1e-3, "{name}: {errors:?}");
            continue;
        }
        let shift = translated(0.02, 3.0, down());
        // The clamp's angle from +x, −π/2 at the start; `down` bends towards +x for positive κ1, about −y.
        let swing = |t: f64| Frame {
            origin: Vector3::zeros(),
            rotation: UnitQuaternion::from_axis_angle(
                &-Vector3::y_axis(),
                std::f64::consts::FRAC_PI_4 * (1.0 - (turn * 2.0 * t).cos()),
            ) * down(),
        };
        let root: Way = if name.starts_with("R1") { &shift } else { &swing };
        let at = |count: usize, per_frame: u32| {
            error_along(&released(case, count, down(), [0.0; 3]), root, &tips(false), 0.5, per_frame)
        };
        let counts = [5, 10, 20, 40];
        let elements = counts.map(|count| at(count, 64));
        let steps = [1, 4, 16].map(|per_frame| at(20, per_frame));
        print(
            &format!("{name}: N = 5, 10, 20, 40 at 1/3840 s; N = 20 at 1/60, 1/240, 1/960 s"),
            &[&elements[..], &steps[..]].concat(),
        );
        record_motion(name, &counts, &elements);
        let order = (elements[1] / elements[2]).log2();
        assert!((1.7..2.3).contains(&order), "{name}: {elements:?}");
        assert!(elements[2] < 2.7 / 400.0, "{name}: {elements:?}");
    }
}

/// One element: the error is the step's, and falls by a factor of four when the step is halved.
#[test]
fn one_element_converges_at_second_order_in_the_step() {
    let reference = reference();
    let cases = rows(&reference["discrete_N1"]["planar"])
        .iter()
        .map(|case| {
            let name = format!("{} γ {} ν {}", case["set"], case["variant"]["gamma"], case["variant"]["nu"]);
            (name, released(case, 1, UnitQuaternion::identity(), [0.0; 3]), planar_tips(case))
        })
        .chain(rows(&reference["discrete_N1"]["spatial"]).iter().map(|case| {
            let def = released(case, 1, clamp_from(&case["R0"]), triple(&case["un_L"]).into());
            (case["case"].to_string(), def, spatial_tips(case))
        }));
    for (name, def, tips) in cases {
        let rates = [8, 16, 32, 64, 128];
        let errors = rates.map(|per_frame| error(&def, &tips, 0.5, per_frame));
        print(&name, &errors);
        record_steps(&name, &rates, &errors);
        let order = (errors[3] / errors[4]).log2();
        assert!((1.8..2.3).contains(&order) && errors[4] < 1e-3, "{name}: {errors:?}");
    }
}

/// The continuous rod over half a second: at steps of 1/3840 s the error is the elements' and falls by four when their number is
/// doubled; at frame-size steps it is the step's.
#[test]
fn motions_of_the_continuous_rod() {
    let reference = reference();
    let planar = reference["dynamics_planar"].as_object().unwrap().iter().map(|(name, case)| {
        let (root, natural) = if name.starts_with('C') {
            (down(), [0.0, std::f64::consts::PI, 0.0])
        } else {
            (UnitQuaternion::identity(), [0.0; 3])
        };
        (name, case, root, natural, planar_tips(case))
    });
    let spatial =
        reference["dynamics_3d"].as_object().unwrap().iter().map(|(name, case)| {
            (name, case, clamp_from(&case["R0"]), <[f64; 3]>::from(triple(&case["un_L"])), spatial_tips(case))
        });
    for (name, case, root, natural, tips) in planar.chain(spatial) {
        let at = |count: usize, per_frame: u32| error(&released(case, count, root, natural), &tips, 0.5, per_frame);
        let elements = [5, 10, 20, 40].map(|count| at(count, 64));
        let steps = [1, 4, 16].map(|per_frame| at(20, per_frame));
        print(
            &format!("{name}: N = 5, 10, 20, 40 at 1/3840 s; N = 20 at 1/60, 1/240, 1/960 s"),
            &[&elements[..], &steps[..]].concat(),
        );
        record_motion(name, &[5, 10, 20, 40], &elements);
        for pair in elements[1..3].windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((1.7..2.3).contains(&order), "{name}: {elements:?}");
        }
        // 2.7 L/N²: the worst of these motions, a curly hair falling through a shape of high curvature at its tip.
        assert!(elements[2] < 2.7 / 400.0 && elements[3] < 1.3 * 2.7 / 1600.0, "{name}: {elements:?}");
        // At 1/960 s the step adds less than the elements have; at 1/240 s up to a fortieth of the length after half a second.
        assert!(steps[2] < 1.2 * elements[2] && steps[1] < elements[2] + 2.5e-2, "{name}: {steps:?} {elements:?}");
    }
}
