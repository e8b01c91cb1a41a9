//! Projects that find superhelix by CMake, or build it from source by CMake.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{Folder, LIBRARIES, VERSION, command, is_hello, moved, needed, output, refused, root, run, staged, target};

fn configure(source: &Path, build: &Path, definitions: &[String]) -> Command {
    let mut cmake = command("cmake");
    cmake.arg("-S").arg(source).arg("-B").arg(build).args(definitions);
    cmake
}

fn build(folder: &Path) {
    run(command("cmake").arg("--build").arg(folder).args(["--parallel", "2"]));
}

#[test]
fn examples_build_outside_the_repository_shared_and_static() {
    for prefix in [staged(), moved()] {
        let folder = Folder::with_examples();
        for linkage in ["shared", "static"] {
            let out = folder.path().join(linkage);
            let static_library = if linkage == "static" { "ON" } else { "OFF" };
            let definitions = [
                format!("-DCMAKE_PREFIX_PATH={}", prefix.display()),
                format!("-Dsuperhelix_DIR={}", prefix.join(LIBRARIES).join("cmake/superhelix").display()),
                format!("-DSUPERHELIX_STATIC={static_library}"),
                "-DCMAKE_C_FLAGS=-Wall -Wextra -Wpedantic -Werror".to_string(),
            ];
            run(&mut configure(&folder.examples(), &out, &definitions));
            build(&out);
            let tests = run(command("ctest").arg("--test-dir").arg(&out));
            assert!(tests.contains("100% tests passed"), "{tests}");
            assert_eq!(needed(&out.join("hello")).contains("libsuperhelix.so."), linkage == "shared");
        }
    }
}

/// A project of one `find_package` and what follows it.
fn project(text: &str) -> (Folder, PathBuf) {
    let folder = Folder::new();
    folder.write("CMakeLists.txt", &format!("cmake_minimum_required(VERSION 3.19)\nproject(host LANGUAGES C)\n{text}\n"));
    let out = folder.path().join("build");
    (folder, out)
}

fn found(text: &str) -> Command {
    let (folder, out) = project(text);
    let definitions = [format!("-Dsuperhelix_DIR={}", moved().join(LIBRARIES).join("cmake/superhelix").display())];
    let command = configure(folder.path(), &out, &definitions);
    // The folder has to last as long as the command.
    std::mem::forget(folder);
    command
}

/// Configures a project and removes it.
fn checked(text: &str, succeeds: bool) -> String {
    let mut cmake = found(text);
    let source = cmake.get_args().nth(1).expect("a source").to_owned();
    let printed = if succeeds { run(&mut cmake) } else { refused(&mut cmake) };
    std::fs::remove_dir_all(source).expect("removed");
    printed
}

/// CMake breaks its lines where it likes.
fn in_a_row(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn versions_are_checked() {
    let parts: Vec<u32> = VERSION.split('.').map(|part| part.parse().expect("a number")).collect();
    let [major, minor, patch] = parts[..] else { panic!("{VERSION}") };
    let good = [
        String::new(),
        format!("{major}.{minor}"),
        VERSION.to_string(),
        format!("{VERSION} EXACT"),
        format!("{major}.{minor}...{}.0", major + 1),
    ];
    for wanted in good {
        checked(&format!("find_package(superhelix {wanted} REQUIRED)"), true);
    }
    let bad = [
        format!("{major}.{}", minor + 1),
        format!("{major}.{minor}.{}", patch + 1),
        format!("{}.0", major + 1),
        format!("{major}.{minor}.{} EXACT", patch + 1),
        format!("{major}.{}...{}.0", minor + 1, major + 1),
        format!("0.0.1...<{VERSION}"),
    ];
    for wanted in bad {
        let printed = checked(&format!("find_package(superhelix {wanted} REQUIRED)"), false);
        assert!(printed.contains(&format!("version: {VERSION}")), "{wanted}: {printed}");
    }
    // While versions are 0.x, an earlier minor version is another interface.
    if major == 0 && minor > 0 {
        checked(&format!("find_package(superhelix 0.{} REQUIRED)", minor - 1), false);
    }
}

#[test]
fn components_choose_the_library() {
    let kind = "get_target_property(kind superhelix::superhelix TYPE)\nmessage(STATUS \"kind ${kind}\")\n";
    let both = "foreach(name IN ITEMS shared static)\n  if(NOT TARGET superhelix::superhelix_${name})\n    message(FATAL_ERROR ${name})\n  endif()\nendforeach()\n";
    for (wanted, library) in [
        ("find_package(superhelix REQUIRED)", "SHARED_LIBRARY"),
        ("find_package(superhelix REQUIRED COMPONENTS shared)", "SHARED_LIBRARY"),
        ("find_package(superhelix REQUIRED COMPONENTS static)", "STATIC_LIBRARY"),
        ("set(superhelix_USE_STATIC_LIBS ON)\nfind_package(superhelix REQUIRED)", "STATIC_LIBRARY"),
        // Twice, as when a dependency of the project looks for it too.
        ("find_package(superhelix REQUIRED COMPONENTS static)\nfind_package(superhelix REQUIRED)", "STATIC_LIBRARY"),
        ("find_package(superhelix REQUIRED OPTIONAL_COMPONENTS python)", "SHARED_LIBRARY"),
    ] {
        let printed = checked(&format!("{wanted}\n{kind}{both}"), true);
        assert!(printed.contains(&format!("kind {library}")), "{wanted}: {printed}");
    }
    let printed = checked("find_package(superhelix REQUIRED COMPONENTS python)", false);
    assert!(in_a_row(&printed).contains("superhelix has no component \"python\""), "{printed}");
    let twice = "find_package(superhelix REQUIRED COMPONENTS static)\nfind_package(superhelix REQUIRED COMPONENTS shared)";
    let printed = checked(twice, false);
    assert!(in_a_row(&printed).contains("is the static library already"), "{printed}");
}

#[test]
fn cmake_uses_pkg_config_too() {
    let text = "find_package(PkgConfig REQUIRED)\npkg_check_modules(hair REQUIRED IMPORTED_TARGET superhelix)\n\
        add_executable(hello hello.c)\ntarget_link_libraries(hello PRIVATE PkgConfig::hair)\n\
        add_executable(hello_static hello.c)\ntarget_include_directories(hello_static PRIVATE ${hair_INCLUDE_DIRS})\n\
        target_link_libraries(hello_static PRIVATE ${hair_STATIC_LDFLAGS})";
    let (folder, out) = project(text);
    std::fs::copy(root().join("examples_c/hello.c"), folder.path().join("hello.c")).expect("hello.c");
    std::fs::copy(root().join("examples_c/check.h"), folder.path().join("check.h")).expect("check.h");
    let mut cmake = configure(folder.path(), &out, &[]);
    run(cmake.env("PKG_CONFIG_PATH", moved().join(LIBRARIES).join("pkgconfig")));
    build(&out);
    for (name, shared) in [("hello", true), ("hello_static", false)] {
        is_hello(&run(&mut command(out.join(name))));
        assert_eq!(needed(&out.join(name)).contains("libsuperhelix.so."), shared, "{name}");
    }
}

/// What makes CMake take the library out of what the tests were compiled to.
fn from_tests() -> [String; 2] {
    let profile = std::env::var("SHX_PROFILE").unwrap_or_else(|_| "test".to_string());
    [format!("-DSUPERHELIX_CARGO_PROFILE={profile}"), format!("-DSUPERHELIX_CARGO_TARGET_DIR={}", target().display())]
}

#[test]
fn fetch_content_builds_it_from_source() {
    let text = format!(
        "include(FetchContent)\nFetchContent_Declare(superhelix SOURCE_DIR \"{}\")\nFetchContent_MakeAvailable(superhelix)\n\
         add_subdirectory(hello)",
        root().display()
    );
    for linkage in ["shared", "static"] {
        let (folder, out) = project(&text);
        folder.write(
            "hello/CMakeLists.txt",
            &format!(
                "add_executable(hello {}/examples_c/hello.c)\ntarget_link_libraries(hello PRIVATE superhelix::superhelix)",
                root().display()
            ),
        );
        let mut definitions = from_tests().to_vec();
        if linkage == "shared" {
            definitions.push("-DBUILD_SHARED_LIBS=ON".to_string());
        }
        run(&mut configure(folder.path(), &out, &definitions));
        build(&out);
        let program = out.join("hello/hello");
        assert_eq!(needed(&program).contains("libsuperhelix.so."), linkage == "shared", "{}", needed(&program));
        is_hello(&run(&mut command(program)));
        // Nothing is built again for nothing.
        let again = run(command("cmake").arg("--build").arg(&out));
        assert!(!again.contains("Building superhelix by cargo"), "{again}");
    }
}

#[test]
fn the_repository_is_a_project_that_installs() {
    let folder = Folder::new();
    let out = folder.path().join("build");
    let mut definitions = from_tests().to_vec();
    definitions.push(format!("-DCMAKE_INSTALL_PREFIX={}", folder.path().join("prefix").display()));
    definitions.push("-DCMAKE_INSTALL_LIBDIR=lib64".to_string());
    run(&mut configure(root(), &out, &definitions));
    build(&out);
    is_hello(&run(&mut command(out.join("examples_c/hello"))));
    run(command("cmake").arg("--install").arg(&out));
    for file in [
        "lib64/libsuperhelix.a",
        "lib64/libsuperhelix.so",
        "lib64/cmake/superhelix/superhelixConfig.cmake",
        "include/superhelix.h",
    ] {
        assert!(folder.path().join("prefix").join(file).exists(), "{file}");
    }
    let printed = String::from_utf8_lossy(
        &output(&mut configure(root(), &folder.path().join("other"), &["-DSUPERHELIX_LINKAGE=dynamic".to_string()])).stderr,
    )
    .into_owned();
    assert!(printed.contains("SUPERHELIX_LINKAGE is 'dynamic'"), "{printed}");
}
