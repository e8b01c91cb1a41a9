//! The static library keeps its names to itself, and goes beside another Rust library into one program.

use std::path::Path;

use crate::support::{Folder, LIBRARIES, command, moved, root, run};

#[test]
fn it_defines_no_name_but_those_of_the_header() {
    let library = moved().join(LIBRARIES).join("libsuperhelix.a");
    let symbols = run(command("nm").args(["--defined-only", "--extern-only", "--format=just-symbols"]).arg(library));
    // The list of each member stands under its name.
    let mut names: Vec<&str> = symbols.lines().filter(|line| !line.is_empty() && !line.ends_with(':')).collect();
    names.sort_unstable();
    let listed = std::fs::read_to_string(root().join("include/exports.txt")).expect("exports.txt");
    assert_eq!(names, listed.lines().collect::<Vec<_>>());
}

const OTHER: &str = r#"
//! Another Rust library, with names that superhelix's dependencies have too, which unwinds and has threads of its own.
#[unsafe(no_mangle)]
pub extern "C" fn other_answer() -> i32 {
    std::panic::set_hook(Box::new(|_| {}));
    let caught = std::panic::catch_unwind(|| panic!("caught")).is_err();
    std::thread::spawn(move || if caught { 42 } else { 0 }).join().unwrap()
}

#[unsafe(no_mangle)]
pub extern "C" fn libpulp_dispatch() -> i32 {
    7
}
"#;

const HOST: &str = r#"
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include "superhelix.h"

extern "C" int other_answer();
extern "C" int libpulp_dispatch();

int main() {
  shx_solver *solver = nullptr;
  shx_strand_def strand;
  shx_strand_id id;
  if (shx_solver_create(nullptr, &solver) != SHX_OK || shx_strand_def_init(&strand, sizeof strand) != SHX_OK) return 1;
  strand.length = 0.2;
  strand.element_count = 5;
  if (shx_solver_add_strands(solver, &strand, sizeof strand, 1, &id) != SHX_OK) return 2;
  if (other_answer() != 42 || libpulp_dispatch() != 7) return 3;
  if (shx_solver_step(solver, 1.0 / 60.0, 1, nullptr) != SHX_OK) return 4;
  try {
    throw std::runtime_error("C++ unwinds as well");
  } catch (const std::exception &) {
    std::puts("both");
  }
  shx_solver_destroy(solver);
  return 0;
}
"#;

/// Whole archives too: then every name of both is there, and one that is global in both would be defined twice. (Unused sections go:
/// the standard library has weak references that an older C library lacks.)
#[test]
fn a_program_has_two_rust_libraries() {
    let folder = Folder::new();
    let other = folder.write("other.rs", OTHER);
    let other_library = folder.path().join("libother.a");
    run(command("rustc").args(["--edition", "2024", "--crate-type", "staticlib", "-O", "-o"]).arg(&other_library).arg(other));
    let host = folder.write("host.cpp", HOST);
    let libraries = moved().join(LIBRARIES);
    let package = |arguments: &[&str]| -> Vec<String> {
        let mut package = command("pkg-config");
        package.env("PKG_CONFIG_PATH", libraries.join("pkgconfig"));
        run(package.args(arguments).arg("superhelix")).split_whitespace().map(str::to_string).collect()
    };
    let link = |name: &str, inputs: &[&Path]| {
        let program = folder.path().join(name);
        let mut compiler = command("c++");
        compiler.args(["-std=c++17", "-Wall", "-Wextra", "-Werror"]).args(package(&["--cflags"]));
        compiler.arg(&host).arg("-o").arg(&program).args(inputs).args(package(&["--static", "--libs"]));
        run(&mut compiler);
        assert_eq!(run(&mut command(program)), "both\n");
    };
    link("in_turn", &[&other_library]);
    let ours = libraries.join("libsuperhelix.a");
    link("ours_first", &[&ours, &other_library]);
    let [from, to] = ["-Wl,--gc-sections,--whole-archive", "-Wl,--no-whole-archive"].map(Path::new);
    link("whole", &[from, &ours, &other_library, to]);
}
