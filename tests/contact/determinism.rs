//! A scene full of contact gives the same bits for any number of threads, side by side in registers of any width, and on every machine.

use std::path::Path;

use superhelix::{InstructionSet, Workers};

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
