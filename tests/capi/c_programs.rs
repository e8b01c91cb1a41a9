//! The library as C programs see it: the artifacts of `scripts/build_lib.sh`, the examples and the programs of `tests/c`, against
//! the shared and the static library, under valgrind. The library is linked from what the tests were compiled to (`SHX_PROFILE=test`);
//! `SHX_PROFILE=release` takes the one that is shipped.
//!
//! Which rule of the C ABI is tested where: 1 `two_copies.c`, 2 and 4 `bad_input/`, 3 `growing_structs.c`,
//! 5 `float_mode.c`, `reentry.c`, `guard.rs`, 6 `guard.rs`, 7 `threads.c`, 8 `unload.c`, `fork.c`, `threads.c`, 9
//! `sampling.rs`, 10 `threads.c`, 11 `header.rs`, `layout.rs`, `layout.c`, here, 12 here, 13 `header.rs`.
#![cfg(target_os = "linux")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use superhelix::io::CurveCache;

pub(super) const WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];

pub(super) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs a command and wants it to succeed.
pub(super) fn run(command: &mut Command) -> Output {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.output().unwrap_or_else(|error| {
        panic!(
            "{program}: {error}. These tests need gcc, g++, make, binutils and valgrind: apt-get install build-essential valgrind"
        )
    });
    assert!(
        output.status.success(),
        "{command:?}: {}\n{}\n{}",
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    output
}

pub(super) fn text(command: &mut Command) -> String {
    String::from_utf8(run(command).stdout).expect("UTF-8")
}

/// The folder that holds lib/ and include/, built once a run.
pub(super) fn build() -> &'static Path {
    static BUILD: OnceLock<PathBuf> = OnceLock::new();
    BUILD.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c");
        let mut command = Command::new(root().join("scripts/build_lib.sh"));
        // Variables that cargo sets for this test must not reach the cargo inside, or it would rebuild everything.
        for (name, _) in std::env::vars_os() {
            let name = name.to_string_lossy();
            if name.starts_with("CARGO_PKG_") || name.starts_with("CARGO_MANIFEST") || name == "CARGO_BIN_NAME" {
                command.env_remove(&*name);
            }
        }
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
        if std::env::var_os("SHX_PROFILE").is_none() {
            command.env("SHX_PROFILE", "test");
        }
        run(command.env("SHX_BUILD_DIR", &folder).env("CARGO_TARGET_DIR", target));
        folder
    })
}

fn version() -> String {
    env!("CARGO_PKG_VERSION").to_string()
}

/// The private libraries that pkg-config states.
fn static_libraries() -> Vec<String> {
    let file = std::fs::read_to_string(build().join("lib/pkgconfig/superhelix-library.pc")).expect("superhelix-library.pc");
    let line = file.lines().find_map(|line| line.strip_prefix("Libs.private: ")).expect("Libs.private");
    line.split_whitespace().map(str::to_string).collect()
}

/// The examples, built once by their own Makefile: shared/NAME and static/NAME.
fn examples() -> &'static Path {
    static EXAMPLES: OnceLock<PathBuf> = OnceLock::new();
    EXAMPLES.get_or_init(|| {
        let out = build().join("examples");
        run(Command::new("make")
            .arg("-C")
            .arg(root().join("examples_c"))
            .args(["-j2", "all"])
            .args([format!("BUILD={}", build().display()), format!("OUT={}", out.display())]));
        out
    })
}

fn valgrind(program: &Path) -> Command {
    let mut command = Command::new("valgrind");
    // Not "possible": rayon's crossbeam-epoch keeps a few kilobytes a process behind tagged pointers.
    command.args([
        "--quiet",
        "--error-exitcode=9",
        "--leak-check=full",
        "--errors-for-leak-kinds=definite,indirect",
        "--show-leak-kinds=definite,indirect",
    ]);
    command.arg(program);
    command
}

/// A program of tests/c, linked to the shared library.
fn program(name: &str) -> PathBuf {
    let path = build().join(name);
    let library = build().join("lib");
    // These load the library themselves.
    let loads = ["unload", "two_copies", "load_memory"].contains(&name);
    let standard = if loads { "-std=gnu99" } else { "-std=c99" };
    let mut command = Command::new("cc");
    command.args([standard, "-O1", "-g"]).args(WARNINGS.iter().filter(|flag| !loads || **flag != "-Wpedantic"));
    command.arg("-I").arg(build().join("include")).arg(root().join("tests/c").join(name).with_extension("c"));
    command.arg("-o").arg(&path);
    if loads {
        command.arg("-ldl");
    } else {
        command.arg("-L").arg(&library).args(["-lsuperhelix", "-lm", "-lpthread"]);
        command.arg(format!("-Wl,-rpath,{}", library.display()));
    }
    run(&mut command);
    path
}

pub(super) fn scratch(name: &str) -> PathBuf {
    let folder = build().join("out").join(name);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn rule_12_the_shared_library_has_a_soname_and_its_links() {
    let library = build().join("lib");
    let major = version().split('.').next().expect("a version").to_string();
    let dynamic = text(Command::new("readelf").arg("-d").arg(library.join("libsuperhelix.so")));
    assert!(dynamic.contains(&format!("Library soname: [libsuperhelix.so.{major}]")), "{dynamic}");
    for link in ["libsuperhelix.so".to_string(), format!("libsuperhelix.so.{major}")] {
        let real = std::fs::canonicalize(library.join(link)).expect("a link that leads somewhere");
        assert!(real.ends_with(format!("libsuperhelix.so.{}", version())), "{}", real.display());
    }
    // Nothing but the C library and the unwinder is needed.
    for needed in dynamic.lines().filter(|line| line.contains("(NEEDED)")) {
        let known = ["libgcc_s.so", "libm.so", "libc.so", "ld-linux", "libpthread.so", "libdl.so"];
        assert!(known.iter().any(|name| needed.contains(name)), "{needed}");
    }
}

#[test]
fn rule_11_only_the_listed_symbols_are_exported() {
    let symbols = text(Command::new("nm").args(["-D", "--defined-only"]).arg(build().join("lib/libsuperhelix.so")));
    let mut names: Vec<&str> = symbols.lines().filter_map(|line| line.split_whitespace().last()).collect();
    names.sort_unstable();
    let listed = std::fs::read_to_string(root().join("include/exports.txt")).expect("exports.txt");
    assert_eq!(names, listed.lines().collect::<Vec<_>>());
    assert!(names.iter().all(|name| name.starts_with("shx_")));
}

#[test]
fn rule_5_panics_unwind_in_the_artifacts() {
    // Abort would leave no unwinder behind.
    let needed = text(Command::new("nm").args(["-D", "--undefined-only"]).arg(build().join("lib/libsuperhelix.so")));
    assert!(needed.contains("_Unwind_RaiseException"), "{needed}");
    // Nor does another profile abort.
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).expect("Cargo.toml");
    let release = manifest.split("[profile.release]").nth(1).expect("a profile").split("\n[").next().expect("its end");
    assert!(release.contains("panic = \"unwind\"") && !manifest.contains("panic = \"abort\""), "{release}");
}

#[test]
fn rule_11_layout_as_c_sees_it() {
    run(Command::new("cc").args(["-std=c99", "-c"]).args(WARNINGS).arg("-I").arg(root().join("include")).args([
        root().join("tests/c/layout.c").as_os_str(),
        "-o".as_ref(),
        build().join("layout.o").as_os_str(),
    ]));
}

#[test]
fn rule_8_dlclose_unloads_100_times() {
    run(Command::new(program("unload")).arg(build().join("lib/libsuperhelix.so")));
}

#[test]
fn rule_8_loading_200_times_leaves_nothing_on_the_heap() {
    print!("{}", text(Command::new(program("load_memory")).arg(build().join("lib/libsuperhelix.so"))));
}

/// In programs of their own: once something was allocated it is too late.
#[test]
fn the_host_may_give_its_allocator_before_anything_is_allocated() {
    let path = program("allocator");
    let hash = text(&mut Command::new(&path));
    assert_eq!(text(Command::new(&path).arg("late")), hash);
    run(&mut valgrind(&path));
}

/// As C99 and as C++17, without warnings.
#[test]
fn inline_helpers_agree_with_the_library() {
    run(&mut Command::new(program("inline")));
    let path = build().join("inline_cpp");
    let library = build().join("lib");
    let mut command = Command::new("c++");
    command.args(["-x", "c++", "-std=c++17"]).args(WARNINGS).arg("-I").arg(build().join("include"));
    command.arg(root().join("tests/c/inline.c")).arg("-o").arg(&path).arg("-L").arg(&library).args(["-lsuperhelix", "-lm"]);
    run(command.arg(format!("-Wl,-rpath,{}", library.display())));
    run(&mut Command::new(path));
}

#[test]
fn debug_drawing_and_wind_from_c() {
    let path = program("debug_draw");
    run(&mut Command::new(&path));
    run(&mut valgrind(&path));
}

#[test]
fn rule_8_fork_does_not_hang() {
    run(&mut Command::new(program("fork")));
}

#[test]
fn rule_5_floating_point_mode() {
    run(&mut Command::new(program("float_mode")));
}

#[test]
fn rule_5_reentry() {
    let path = program("reentry");
    run(&mut Command::new(&path));
    run(&mut valgrind(&path));
}

#[test]
fn rules_7_8_10_threads() {
    run(&mut Command::new(program("threads")));
}

#[test]
fn rule_3_growing_structures() {
    let path = program("growing_structs");
    run(&mut Command::new(&path));
    run(&mut valgrind(&path));
}

#[test]
fn settling_from_c() {
    let path = program("settle");
    run(&mut Command::new(&path));
    run(&mut valgrind(&path));
}

#[test]
fn contact_from_c() {
    let path = program("contact");
    run(&mut Command::new(&path));
    run(&mut valgrind(&path));
}

/// Without valgrind: the functions are those of `contact.c`.
#[test]
fn contact_and_constraints_are_read_from_c() {
    run(&mut Command::new(program("contact_reading")));
}

#[test]
fn steps_are_limited_and_cancelled_from_c() {
    let path = program("step_limits");
    run(&mut Command::new(&path));
}

#[test]
fn ring_combs_in_the_hand_from_c() {
    let path = program("haptic_ring_comb");
    run(&mut Command::new(&path));
    run(valgrind(&path).arg("300"));
}

#[test]
fn elements_change_during_a_motion() {
    let path = program("level_of_detail");
    run(&mut Command::new(&path));
    run(&mut valgrind(&path));
}

#[test]
fn strands_are_posed_from_c() {
    let path = program("posing");
    run(&mut Command::new(&path));
    run(&mut valgrind(&path));
}

#[test]
fn rule_1_two_copies_in_one_process() {
    let first = build().join("lib/libsuperhelix.so");
    let second = build().join("libsuperhelix_copy.so");
    std::fs::copy(&first, &second).expect("a copy");
    run(Command::new(program("two_copies")).arg(first).arg(second));
}

#[test]
fn friction_is_fitted_from_c() {
    let curve = root().join("tests/data/friction/pendulum_05.csv");
    let path = program("friction_fit");
    let printed = text(Command::new(&path).arg(&curve).arg("8e-6"));
    assert!(printed.starts_with("air drag 8.0"), "{printed}");
}

#[test]
fn static_library_lists_its_dependencies() {
    let libraries = static_libraries();
    for library in ["-lm", "-lpthread", "-lc"] {
        assert!(libraries.iter().any(|stated| stated == library), "{libraries:?} has no {library}");
    }
}

/// Runs an example in each linkage, plain and under valgrind, and gives what each printed.
fn example(name: &str, arguments: impl Fn(&str) -> Vec<String>) -> Vec<String> {
    let mut printed = Vec::new();
    for linkage in ["shared", "static"] {
        let path = examples().join(linkage).join(name);
        printed.push(text(Command::new(&path).args(arguments(linkage))));
        printed.push(text(valgrind(&path).args(arguments(linkage))));
    }
    printed
}

#[test]
fn the_static_examples_do_not_need_the_shared_library() {
    let path = examples().join("static/hello");
    assert!(!text(Command::new("readelf").arg("-d").arg(path)).contains("superhelix"));
}

#[test]
fn example_hello() {
    let printed = example("hello", |_| vec![]);
    assert_eq!(printed[0].lines().count(), 6, "{}", printed[0]);
    // The same bits in every build and under valgrind, whose vector registers are others.
    assert!(printed.iter().all(|text| *text == printed[0]), "{printed:#?}");
}

#[test]
fn example_errors() {
    let printed = example("errors", |_| vec![]);
    assert!(printed.iter().all(|text| text.contains("SHX_ERROR_BUSY") && text.contains("unchanged by all that")), "{printed:#?}");
}

#[test]
fn example_comb() {
    // Once under valgrind is enough: what differs by linkage, the other examples show.
    let path = |linkage: &str| examples().join(linkage).join("comb");
    let printed =
        [text(&mut Command::new(path("shared"))), text(&mut Command::new(path("static"))), text(&mut valgrind(&path("shared")))];
    assert!(printed.iter().all(|text| *text == printed[0]), "{printed:#?}");
    let lines: Vec<&str> = printed[0].lines().collect();
    assert_eq!(lines.len(), 11, "{}", printed[0]);
    // In the middle of the hair the comb feels it, by micronewtons; at the end, out of it, nothing.
    let force = |line: &str| -> f64 {
        let (_, numbers) = line.split_once('(').expect("a force");
        let numbers = numbers.split(')').next().expect("its end").split(',');
        numbers.map(|number| number.trim().parse::<f64>().expect("a number").powi(2)).sum()
    };
    assert!(lines[3..7].iter().all(|line| force(line) > 1.0) && force(lines[9]) == 0.0, "{}", printed[0]);
    // The tolerance of hard contact.
    let (_, depth) = lines[10].split_once("than ").expect("a depth");
    assert!(
        depth.split_whitespace().next().and_then(|word| word.parse::<f64>().ok()).expect("a number") <= 10.0,
        "{}",
        lines[10]
    );
}

#[test]
fn example_haptic_comb() {
    // In real time, and so not under valgrind: two seconds of combing a groom.
    let out = scratch("haptic_comb");
    let file = out.join("force.csv");
    let groom = |name: &str| root().join("tests/data/grooms").join(name);
    let mut program = Command::new(examples().join("shared/haptic_comb"));
    let printed = text(program.args([groom("sintel_hair_001.tfx"), groom("sintel_bust.obj"), out.clone(), "2".into()]));
    assert_eq!(printed.lines().count(), 5, "{printed}");
    assert!((0..3).all(|moment| out.join(format!("hair.{moment}.obj")).exists()), "{printed}");
    let felt = std::fs::read_to_string(&file).expect("the file");
    assert_eq!(felt.lines().count(), 2001);
    let force = |line: &str| -> f64 {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().expect("a number")).collect();
        numbers[4..7].iter().map(|force| force * force).sum::<f64>().sqrt()
    };
    let strongest = felt.lines().skip(1).map(force).fold(0.0, f64::max);
    assert!(strongest > 1e-5 && strongest < 3.0, "{strongest:e} N: {printed}");

    // With teeth that hold hair.
    let mut program = Command::new(examples().join("shared/haptic_comb"));
    program.arg("--rings").args([groom("sintel_hair_001.tfx"), groom("sintel_bust.obj"), out, "2".into()]);
    let printed = text(&mut program);
    let (_, rings) = printed.split_once("rings: caught ").expect("a line of the rings");
    let caught: u32 = rings.split(' ').next().and_then(|word| word.parse().ok()).expect("a number");
    assert!(caught > 0, "{printed}");
}

#[test]
fn example_styling() {
    let path = |linkage: &str| examples().join(linkage).join("styling");
    let printed = [text(&mut Command::new(path("shared"))), text(&mut Command::new(path("static")))];
    assert_eq!(printed[0], printed[1]);
    let lines: Vec<&str> = printed[0].lines().collect();
    assert_eq!(lines.len(), 7, "{}", printed[0]);
    let numbers = |line: &str| -> Vec<f64> {
        let words = line.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-' || c == 'e'));
        words.filter_map(|word| word.parse().ok()).collect()
    };
    let [hung, straightened] = [0, 2].map(|line| numbers(lines[line])[0]);
    assert!(straightened > 114.0 && straightened > hung + 5.0, "{}", printed[0]);
    let combed = numbers(lines[1]);
    assert!(combed[1] >= 3.0 && combed[0] == combed[1] && combed[2] == 0.0 && combed[3] > 1.0, "{}", printed[0]);
    let cut = numbers(lines[3]);
    assert!(cut[0] == 24.0 && (100.0..108.0).contains(&cut[1]), "{}", printed[0]);
    assert!(numbers(lines[4])[0] >= 24.0, "{}", printed[0]);
    assert_eq!(numbers(lines[5])[0], 0.0, "{}", printed[0]);
    let woken = numbers(lines[6])[0];
    assert!(woken > 0.0 && woken < 24.0, "{}", printed[0]);
}

#[test]
fn example_curls() {
    let file = |linkage: &str| scratch("curls").join(format!("{linkage}.obj"));
    let printed = example("curls", |linkage| vec![file(linkage).display().to_string()]);
    for name in ["Asian", "Caucasian 1", "Caucasian 2", "African"] {
        assert!(printed[0].contains(name));
    }
    // After three seconds a straight strand hangs its whole length, a curly one is far shorter.
    let last = printed[0].lines().rev().nth(1).expect("a line");
    let tips: Vec<f64> = last.split_whitespace().map(|number| number.parse().expect("a number")).collect();
    assert!((19.0..=20.01).contains(&tips[1]) && tips[3] < 6.0, "{last}");
    let drawn = std::fs::read_to_string(file("shared")).expect("the file");
    assert_eq!(drawn.lines().filter(|line| line.starts_with("v ")).count(), 800);
    assert_eq!(drawn.lines().filter(|line| line.starts_with("l ")).count(), 4);
    assert_eq!(drawn, std::fs::read_to_string(file("static")).expect("the file"));
}

#[test]
fn example_render() {
    let file = |linkage: &str| scratch("render").join(format!("{linkage}.usda"));
    // Once under valgrind is enough: what differs by linkage, the other examples show.
    let path = |linkage: &str| examples().join(linkage).join("render");
    let printed = [
        text(Command::new(path("shared")).arg(file("shared"))),
        text(Command::new(path("static")).arg(file("static"))),
        text(valgrind(&path("shared")).arg(file("valgrind"))),
    ];
    assert!(printed.iter().all(|text| text == "13 frames of 1200 strands from 48 guides\n"), "{printed:?}");
    let bytes = |linkage: &str| std::fs::read(file(linkage)).expect("a cache");
    assert!(bytes("shared") == bytes("static") && bytes("shared") == bytes("valgrind"));
    let cache = CurveCache::read(file("shared")).expect("a cache");
    assert_eq!(cache.times().len(), 13);
    let (first, last) = (cache.frame(0).expect("a frame"), cache.frame(12).expect("a frame"));
    let size = |v: [f32; 3]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
    let from = |a: [f32; 3], b: [f32; 3]| size([a[0] - b[0], a[1] - b[1], a[2] - b[2]]);
    let mut turned = 0.0_f32;
    for (before, after) in first.strands().zip(last.strands()) {
        assert!(before.len() == 12 && after.len() == 12);
        // Roots are on the flat triangles of the scalp: a sphere's less a third of a millimetre; strands keep their length as the hair swings.
        assert!([before[0], after[0]].iter().all(|root| (0.0892..0.0901).contains(&size(*root))), "{:?}", before[0]);
        let length = |strand: &[[f32; 3]]| strand.windows(2).map(|edge| from(edge[0], edge[1])).sum::<f32>();
        // Guides are drawn 12 cm along the scalp's normals, less what they bend, and strands are cut short by a quarter at most.
        let lengths = [length(before), length(after)];
        assert!(lengths.iter().all(|length| (0.06..0.15).contains(length)), "{lengths:?}");
        assert!((lengths[0] / lengths[1] - 1.0).abs() < 0.03, "{lengths:?}");
        turned = turned.max(from(before[0], after[0]));
    }
    // 1.19 rad after half a second, at most 7 cm from the axis.
    assert!((0.06..0.085).contains(&turned), "{turned}");
    // At first nothing moves; later velocities are those of the frames about them.
    assert!(first.extras().velocities.as_ref().expect("velocities").iter().all(|v| size(*v) < 1e-3));
    let [one, two, three] = [5, 6, 7].map(|frame| cache.frame(frame).expect("a frame"));
    let fast = two.extras().velocities.as_ref().expect("velocities");
    let mut worst = 0.0_f32;
    for (k, velocity) in fast.iter().enumerate().filter(|(k, _)| k % 12 == 0) {
        let (a, b) = (one.points()[k], three.points()[k]);
        let difference = [0, 1, 2].map(|axis| (b[axis] - a[axis]) * 12.0);
        worst = worst.max(from(*velocity, difference));
    }
    // Roots turn as 0.6 (1 − cos 6t): differences over two frames of 1/24 s err by the third derivative, (6/24)²/6 of up to 3.6 rad/s, and by the
    // chord of a turn, alike; the solver's roots are at the end of their way, where its spline may differ by as much again. Of 0.07 m: 0.01 m/s.
    assert!(worst < 0.02, "{worst}");
}

#[test]
fn example_groom() {
    let arguments = |linkage: &str| {
        let data = root().join("tests/data/grooms");
        [data.join("amd_ponytail_tail.tfx"), data.join("walk_figure8_head.csv"), scratch(&format!("groom_{linkage}"))]
            .iter()
            .map(|path| path.display().to_string())
            .chain("--scale 0.0031 --every 60 --seconds 0.2 --threads 2 --format hair".split(' ').map(str::to_string))
            .collect()
    };
    for printed in example("groom", arguments) {
        assert!(printed.contains("8 of 474 strands") && printed.contains(" 0 quarantined"), "{printed}");
    }
    let frame = |linkage: &str, number: u32| {
        std::fs::read(scratch(&format!("groom_{linkage}")).join(format!("groom.{number:04}.hair"))).expect("a frame")
    };
    assert_eq!(&frame("shared", 12)[..4], b"HAIR");
    assert_ne!(frame("shared", 12), frame("shared", 0));
    assert_eq!(frame("shared", 12), frame("static", 12));
}
