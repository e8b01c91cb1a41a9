//! Programs that were compiled against an older header run with this library: those of `abi/baseline`, and one that uses every function and fills
//! every structure that states its size. Whether the header itself still fits is `make abi`'s to say.
#![cfg(target_os = "linux")]

use std::path::{Path, PathBuf};
use std::process::Command;

use superhelix::internals::capi::hair::strand_def::shx_strand_def;
use superhelix::internals::capi::simulation::solver_def::shx_solver_def;
use superhelix::internals::capi::simulation::step::shx_step_report;

use super::c_programs::{WARNINGS, build, root, run, scratch, text};

fn python(command: &str) -> String {
    text(Command::new("python3").arg(root().join("abi/abi.py")).arg(command))
}

fn constant(header: &str, name: &str) -> u32 {
    let line = header.lines().find_map(|line| line.strip_prefix(&format!("#define {name} "))).expect("the constant");
    line.trim().parse().expect("a number")
}

/// Whether the header says that older programs do not fit: then nothing is held but what `make abi-baseline` makes the next baseline.
fn is_broken_on_purpose() -> bool {
    let read = |path: &str| std::fs::read_to_string(root().join(path)).expect("a header");
    let [old, new] = ["abi/baseline/superhelix.h", "include/superhelix.h"].map(|path| constant(&read(path), "SHX_ABI_VERSION"));
    if new > old {
        println!("SHX_ABI_VERSION is {new}, the baseline's {old}: older programs are not run");
    }
    new > old
}

/// Compiles a program against a header in `include` and links it to this library.
fn compiled(name: &str, include: &Path, source: &Path) -> PathBuf {
    let path = scratch("older").join(name);
    let library = build().join("lib");
    let mut command = Command::new("cc");
    command
        .args(["-std=c99", "-O1", "-g"])
        .args(WARNINGS)
        .arg("-I")
        .arg(include)
        .args(["-x", "c"])
        .arg(source)
        .arg("-o")
        .arg(&path);
    command.args(["-x", "none"]).arg("-L").arg(&library).args(["-lsuperhelix", "-lm"]);
    command.arg(format!("-Wl,-rpath,{}", library.display()));
    run(&mut command);
    path
}

#[test]
fn a_program_with_all_of_the_baseline_runs() {
    if is_broken_on_purpose() {
        return;
    }
    let source = scratch("older").join("all.c");
    std::fs::write(&source, python("program")).expect("a file");
    let printed = text(&mut Command::new(compiled("all", &root().join("abi/baseline"), &source)));
    assert!(printed.trim_end().ends_with(": 0 wrong") && printed.contains(" functions, "), "{printed}");
}

#[test]
fn the_examples_of_the_baseline_run() {
    if is_broken_on_purpose() {
        return;
    }
    let (folder, out) = (root().join("abi/baseline"), scratch("older"));
    for (name, file) in
        [("hello", None), ("errors", None), ("comb", None), ("curls", Some("curls.obj")), ("render", Some("render.usda"))]
    {
        let program = compiled(name, &folder, &folder.join(name).with_extension("c"));
        let printed = text(Command::new(program).args(file.map(|file| out.join(file))));
        assert!(!printed.is_empty(), "{name}");
    }
}

/// A host of an older version: its structures end earlier. Made from the present header by taking fields off their ends, so that this does not wait for
/// a structure to grow.
#[test]
fn a_program_whose_structures_end_earlier_runs() {
    const SHORTER: [(&str, &str); 3] =
        [("shx_solver_def", "linear_solver"), ("shx_strand_def", "initial_curvatures"), ("shx_step_report", "substeps")];
    let mut header = std::fs::read_to_string(root().join("include/superhelix.h")).expect("the header");
    for (name, first) in SHORTER {
        let (before, rest) = header.split_once(&format!("typedef struct {name} {{\n")).expect("the structure");
        let (fields, after) = rest.split_once(&format!("\n}} {name};")).expect("its end");
        let declared = |line: &str| {
            line.trim_end_matches(';').split('[').next().and_then(|text| text.rsplit([' ', '*']).next()) == Some(first)
        };
        let kept: Vec<&str> = fields.lines().take_while(|line| !declared(line)).collect();
        assert!(kept.len() < fields.lines().count(), "{name} has no {first}");
        header = format!("{before}typedef struct {name} {{\n{}\n}} {name};{after}", kept.join("\n"));
    }
    let include = scratch("shorter");
    std::fs::write(include.join("superhelix.h"), header).expect("a file");
    let program = "#include \"superhelix.h\"
        #include <stdio.h>
        int main(void) {
          shx_solver_def def;
          shx_solver *solver;
          struct { shx_strand_def def; unsigned char after[64]; } strand = {0};
          struct { shx_step_report report; unsigned char after[64]; } told = {0};
          shx_strand_id id;
          int failed = shx_solver_def_init(&def, sizeof def) != SHX_OK || shx_solver_create(&def, &solver) != SHX_OK;
          for (int i = 0; i < 64; i++) strand.after[i] = told.after[i] = 0xee;
          failed |= shx_strand_def_init(&strand.def, sizeof strand.def) != SHX_OK;
          strand.def.length = 0.2;
          strand.def.element_count = 5;
          failed |= shx_solver_add_strands(solver, &strand.def, sizeof strand, 1, &id) != SHX_OK;
          failed |= shx_step_report_init(&told.report, sizeof told.report) != SHX_OK;
          failed |= shx_solver_step(solver, 0.01, 2, &told.report) != SHX_OK || told.report.struct_size != sizeof told.report;
          for (int i = 0; i < 64; i++) failed |= strand.after[i] != 0xee || told.after[i] != 0xee;
          shx_solver_destroy(solver);
          printf(\"sizes %u %u %u\\n\", (unsigned)sizeof def, (unsigned)sizeof strand.def, (unsigned)sizeof told.report);
          return failed;
        }\n";
    let source = include.join("shorter.c");
    std::fs::write(&source, program).expect("a file");
    let printed = text(&mut Command::new(compiled("shorter", &include, &source)));
    // Shorter than today's, or the test shows nothing.
    let today = [size_of::<shx_solver_def>(), size_of::<shx_strand_def>(), size_of::<shx_step_report>()];
    let older: Vec<usize> = printed.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    assert!(older.len() == 3 && older.iter().zip(today).all(|(older, today)| *older < today), "{printed} {today:?}");
}
