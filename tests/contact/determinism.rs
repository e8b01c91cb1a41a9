//! A scene full of contact gives the same bits for any number of threads, side by side in registers of any width, and on every machine.

use std::path::Path;
use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::{
    BodyDef, Frame, InstructionSet, Shape, Solver, SolverOptions, StepLimits, Stopped, StrandContact, StrandDef, Workers,
};

use crate::crowded_scene::{GOLDEN, course};

#[test]
fn any_number_of_threads_and_every_machine_give_the_same_bits() {
    let mut found = Vec::new();
    for (model, together, golden) in GOLDEN {
        let (reports, contacts, hash) = course(model, Workers::Serial, None, together);
        println!("(ContactModel::{model:?}, {together}, 0x{hash:016x}), {contacts} contacts");
        // The scene has what it is for.
        assert!(contacts > 200, "{contacts}");
        assert!(reports.iter().all(|report| report.quarantined == 0), "{reports:?}");
        for threads in [2, 3, 8] {
            let (others, _, other) = course(model, Workers::Pool(threads), None, together);
            assert_eq!(others, reports, "{model:?} on {threads} threads");
            assert_eq!(other, hash, "{model:?} on {threads} threads");
        }
        let sets = [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512];
        for set in sets.into_iter().filter(|set| *set <= InstructionSet::detected()) {
            let (others, _, other) = course(model, Workers::Serial, Some(set), together);
            assert_eq!((others, other), (reports.clone(), hash), "{model:?} by {set:?}");
        }
        found.push((model, hash, golden));
    }
    for (model, hash, golden) in found {
        assert_eq!(hash, golden, "{model:?}");
    }
}

/// Strands that share no contact iterate pack by pack where work is ample, and all together where it is not.
#[test]
fn strands_that_share_no_contact_end_the_same_way_together_and_apart() {
    let course = |work: &mut dyn FnMut(usize) -> Option<u64>| {
        let mut solver = Solver::new(SolverOptions { workers: Workers::Pool(2), ..SolverOptions::default() }).unwrap();
        let defs: Vec<StrandDef> = (0..40)
            .map(|k| {
                let mut def = StrandDef::straight(0.12, 6);
                def.natural = vec![[0.0, 3.0 + 0.2 * f64::from(k), 1.0]; 6];
                def.root.origin = Vector3::new(-0.03, 0.002 * f64::from(k % 10) - 0.01, 0.03 + 0.002 * f64::from(k / 10));
                def
            })
            .collect();
        let strands = solver.add_strands(&defs).unwrap();
        solver.set_contact(&strands, Some(&StrandContact { exempt_length: 0.005, ..StrandContact::default() })).unwrap();
        let ball = solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(0.03).unwrap()))]).unwrap();
        let (mut reports, mut contacts) = (Vec::new(), 0);
        for step in 0..30 {
            let origin = Vector3::new(0.0, 0.0, 4e-4 * f64::from(step));
            solver.set_body_frames(&ball, &[Frame { origin, ..Frame::default() }], 1.0 / 60.0).unwrap();
            let limits = StepLimits { work: work(step as usize), ..StepLimits::default() };
            let report = solver.step_within(1.0 / 60.0, 1, &limits).unwrap();
            assert_eq!(report.stopped, Stopped::No, "step {step}");
            contacts = contacts.max(report.contact.contacts);
            reports.push((report.work, report.contact, report.mean_iterations));
        }
        (reports, contacts, solver.state_hash())
    };
    let (apart, contacts, hash) = course(&mut |_| None);
    assert!(contacts > 20, "{contacts}");
    // Little more than each step needs.
    let (together, _, other) = course(&mut |step| Some(apart[step].0 + apart[step].0 / 4 + 1));
    assert_eq!(together, apart);
    assert_eq!(other, hash);
}

/// The standard library's transcendental functions are the platform's: their last bit differs from machine to machine, which no run on one
/// machine can show. Roots, and our own functions in `math`, are the same everywhere.
#[test]
fn contact_uses_no_function_of_the_platform() {
    const NAMES: [&str; 29] = [
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "atan2",
        "sin_cos",
        "sinh",
        "cosh",
        "tanh",
        "exp",
        "exp2",
        "exp_m1",
        "ln",
        "ln_1p",
        "log",
        "log2",
        "log10",
        "powf",
        "hypot",
        "cbrt",
        "angle",
        "from_scaled_axis",
        "from_axis_angle",
        "from_euler_angles",
        "scaled_axis",
        "slerp",
        "axis_angle",
    ];
    let (mut folders, mut files) = (Vec::new(), 0);
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    folders.extend([sources.join("contact"), sources.join("solver")]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            if path.file_name().is_some_and(|name| name == "tests.rs") {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            let used = text.split("#[cfg(test)]").next().unwrap();
            for (number, line) in used.lines().enumerate() {
                let code = line.split("//").next().unwrap();
                let found =
                    NAMES.iter().find(|name| [format!(".{name}("), format!("::{name}(")].iter().any(|of| code.contains(of)));
                assert!(found.is_none(), "{}:{}: {line}", path.display(), number + 1);
            }
            files += 1;
        }
    }
    assert!(files > 60, "{files}");
}
