//! C programs that find superhelix by pkg-config, and so by the Makefile of the examples.

use std::path::Path;
use std::process::Command;

use crate::support::{Folder, LIBRARIES, VERSION, build_library, command, is_hello, moved, needed, run, staged};

fn pkg_config(prefix: &Path) -> Command {
    let mut command = command("pkg-config");
    command.env("PKG_CONFIG_PATH", prefix.join(LIBRARIES).join("pkgconfig"));
    command
}

/// The words of a command's output.
fn words(command: &mut Command) -> Vec<String> {
    run(command).split_whitespace().map(str::to_string).collect()
}

/// The Makefile of the examples, outside the repository, with an installation.
fn makefile(folder: &Folder, prefix: &Path) -> Command {
    let mut make = command("make");
    make.arg("-C").arg(folder.examples()).arg("-j2").env("PKG_CONFIG_PATH", prefix.join(LIBRARIES).join("pkgconfig"));
    make
}

#[test]
fn examples_build_outside_the_repository_shared_and_static() {
    for prefix in [staged(), moved()] {
        let folder = Folder::with_examples();
        // All of them once; the rest is a question of paths.
        let goals: &[&str] = if prefix == staged() { &["all"] } else { &["build/shared/hello", "build/static/hello"] };
        run(makefile(&folder, prefix).args(goals));
        let [shared, linked] = ["shared", "static"].map(|linkage| folder.examples().join("build").join(linkage).join("hello"));
        assert!(needed(&shared).contains("libsuperhelix.so."), "{}", needed(&shared));
        assert!(!needed(&linked).contains("superhelix"), "{}", needed(&linked));
        let printed = run(&mut command(shared));
        is_hello(&printed);
        assert_eq!(run(&mut command(linked)), printed);
    }
}

#[test]
fn programs_are_wholly_static_with_gcc_static() {
    let folder = Folder::with_examples();
    run(makefile(&folder, moved()).args(["build/static/hello", "STATIC_FLAGS=-static"]));
    let program = folder.examples().join("build/static/hello");
    assert_eq!(needed(&program), "");
    assert!(!run(command("readelf").arg("-l").arg(&program)).contains("INTERP"));
    is_hello(&run(&mut command(program)));
}

#[test]
fn flags_name_the_installation_wherever_it_is() {
    for prefix in [staged(), moved()] {
        assert_eq!(run(pkg_config(prefix).args(["--modversion", "superhelix"])).trim(), VERSION);
        run(pkg_config(prefix).args(["--exists", &format!("superhelix = {VERSION}")]));
        let flags = words(pkg_config(prefix).args(["--cflags", "superhelix"]));
        let [include] = &flags[..] else { panic!("{flags:?}") };
        let include = Path::new(include.strip_prefix("-I").expect("a folder"));
        assert_eq!(include.canonicalize().expect("a folder"), prefix.join("include").canonicalize().expect("a folder"));
        // The shared library brings what it needs itself.
        let shared = words(pkg_config(prefix).args(["--libs", "superhelix"]));
        assert!(shared.len() == 2 && shared.iter().any(|word| word == "-lsuperhelix"), "{shared:?}");
        let linked = words(pkg_config(prefix).args(["--static", "--libs", "superhelix"]));
        assert!(linked.iter().any(|word| word == "-lm") && !linked.iter().any(|word| word == "-lgcc_s"), "{linked:?}");
    }
}

/// An installation of one library says all that it needs without --static.
#[test]
fn an_installation_of_one_library_is_enough() {
    let folder = Folder::with_examples();
    for linkage in ["shared", "static"] {
        let prefix = folder.path().join(linkage);
        build_library(&prefix, linkage);
        let package = |arguments: &[&str]| {
            words(command("pkg-config").args(arguments).arg("superhelix").env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig")))
        };
        let program = folder.path().join(format!("hello_{linkage}"));
        let mut compiler = command("cc");
        compiler.args(package(&["--cflags"])).arg(folder.examples().join("hello.c")).arg("-o").arg(&program);
        run(compiler.args(package(&["--libs"])));
        assert_eq!(needed(&program).contains("libsuperhelix.so"), linkage == "shared", "{}", needed(&program));
        is_hello(&run(command(program).env("LD_LIBRARY_PATH", prefix.join("lib"))));
    }
}
